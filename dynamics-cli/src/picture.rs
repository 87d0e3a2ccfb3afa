//! What a simulation is drawn as: charts as SVG, and an animation as one HTML file.

pub(crate) mod charts;
pub(crate) mod scene;

use std::path::{Path, PathBuf};

use dynamics_codegen::mechanics::equations::Method;
use dynamics_core::Energy;
use dynamics_view::{Figure, Film};

use crate::failure::{Failure, Problem};
use crate::output::{check_writable, failed, writer};
use crate::robot::{Robot, State};
use crate::simulate::energies;
use charts::Wish;

/// The options of pictures.
#[derive(clap::Args)]
pub(crate) struct PictureArgs {
    /// Draw charts, as SVG
    #[arg(long, value_name = "SVG")]
    plot: Option<PathBuf>,

    /// What the charts are of, with commas between: `angles`, `speeds`, `energy`, `phase:NAME`, `poles`
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = charts::wish,
          default_value = "angles,speeds,energy", requires = "plot")]
    plot_of: Vec<Wish>,

    /// Draw the moving robot, as one HTML file that a browser opens
    #[arg(long, value_name = "HTML")]
    animate: Option<PathBuf>,

    /// In the animation, draw the path of a frame: the name of a link
    #[arg(long, value_name = "FRAME", requires = "animate")]
    trace: Option<String>,
}

impl PictureArgs {
    /// Whether there is anything to draw.
    pub(crate) fn is_asked_for(&self) -> bool {
        self.plot.is_some() || self.animate.is_some()
    }

    /// What has to be computed besides the motion.
    pub(crate) fn methods(&self) -> &'static [Method] {
        match self.plot.is_some() && self.plot_of.contains(&Wish::Poles) {
            true => &[Method::InverseDynamicsDerivatives, Method::ForwardDynamicsDerivatives],
            false => &[],
        }
    }
}

/// A moment of the motion.
pub(crate) struct Moment {
    pub(crate) time: f64,
    pub(crate) state: State,
    pub(crate) energy: Energy<f64>,
}

/// More moments than these are on no screen.
const MOMENTS: u64 = 8192;
/// Frames of an animation: so many a second, and so many in all.
const RATE: f64 = 60.0;
const FRAMES: f64 = 3600.0;

/// The moments of a simulation, as many as a picture needs.
pub(crate) struct Recording<'a, 'g> {
    args: &'a PictureArgs,
    robot: &'a Robot<'g>,
    input: &'a Path,
    moments: Vec<Moment>,
    steps: u64,
    stride: u64,
}

impl<'a, 'g> Recording<'a, 'g> {
    /// An empty one of so many steps. What would be refused at the end is refused now, and files that cannot be written
    /// are found out before anybody waits.
    pub(crate) fn of(
        args: &'a PictureArgs,
        input: &'a Path,
        robot: &'a Robot<'g>,
        steps: u64,
    ) -> Result<Self, Failure> {
        if args.plot.is_some() {
            args.plot_of.iter().try_for_each(|wish| charts::check(wish, robot))?;
        }
        if let Some(frame) = &args.trace {
            scene::check(frame, robot)?;
        }
        if args.plot.is_some() && args.plot == args.animate {
            let problem = Problem::new("`--plot` and `--animate` name the same file");
            return Err(problem.help("give each a file of its own").into());
        }
        if args.animate.is_some() && robot.tree.frames.is_empty() {
            let problem = Problem::new("`--animate` has nothing to draw: the robot has no body with a place");
            return Err(problem.help("draw charts by `--plot`, or describe its bodies").into());
        }
        for path in [&args.plot, &args.animate].into_iter().flatten() {
            check_writable(Some(path), input)?;
        }
        Ok(Self { args, robot, input, moments: vec![], steps, stride: steps.div_ceil(MOMENTS).max(1) })
    }

    /// Keeps the state after step `k`, if it is one of those that are drawn.
    pub(crate) fn see(&mut self, k: u64, time: f64, state: &State) -> Result<(), Failure> {
        if self.args.is_asked_for() && (k.is_multiple_of(self.stride) || k == self.steps) {
            let [kinetic, potential, elastic, _] = energies(self.robot, state)?;
            let energy = Energy { kinetic, potential, elastic };
            self.moments.push(Moment { time, state: state.clone(), energy });
        }
        Ok(())
    }

    /// Draws, and writes.
    pub(crate) fn write(self) -> Result<(), Failure> {
        let name = robot_name(self.robot);
        if let Some(path) = &self.args.plot {
            let mut figure = Figure::new(&name);
            for wish in &self.args.plot_of {
                figure = figure.with_all(charts::of(wish, self.robot, &self.moments)?);
            }
            self.put(path, &figure.svg().map_err(undrawn)?)?;
        }
        if let Some(path) = &self.args.animate {
            self.put(path, &self.film(name).html().map_err(undrawn)?)?;
        }
        Ok(())
    }

    fn film(&self, name: String) -> Film {
        let frames = thinned(&self.moments);
        let mut film = Film::new(scene::of(self.robot, name));
        for moment in &frames {
            film.push(moment.time, scene::poses(self.robot, &moment.state.q));
        }
        if let Some(frame) = &self.args.trace {
            film = film.tracing(frame);
        }
        let of = |wish| charts::over_time(wish, self.robot, &frames);
        film.with_charts([Wish::Angles, Wish::Speeds, Wish::Energy].iter().flat_map(of))
    }

    fn put(&self, path: &Path, text: &str) -> Result<(), Failure> {
        let mut out = writer(Some(path), self.input)?;
        let done = out.write_all(text.as_bytes()).and_then(|()| out.flush());
        done.map_err(|error| failed(Some(path), &error))
    }
}

/// As many moments as an animation has frames: the nearest ones after equal times, and the last.
pub(crate) fn thinned(moments: &[Moment]) -> Vec<&Moment> {
    let end = moments.last().map_or(0.0, |last| last.time);
    let between = f64::max(1.0 / RATE, end / FRAMES);
    let mut next = 0.0;
    let mut chosen = vec![];
    for (k, moment) in moments.iter().enumerate() {
        // Times are multiples of a step but for rounding.
        if moment.time >= next - 1e-6 * between || k + 1 == moments.len() {
            chosen.push(moment);
            next = between * ((moment.time / between + 1e-6).floor() + 1.0);
        }
    }
    chosen
}

/// What the file calls its robot.
pub(crate) fn robot_name(robot: &Robot<'_>) -> String {
    robot.report.robot.as_deref().filter(|name| !name.is_empty()).unwrap_or("robot").to_owned()
}

/// What cannot be drawn.
pub(crate) fn undrawn(error: dynamics_view::Error) -> Failure {
    let help = match error {
        dynamics_view::Error::NotDrawable { .. } => "give a shorter time, or smaller numbers at the start",
        _ => "leave the picture out; and please report this, with the file",
    };
    Problem::new(error.to_string()).help(help).into()
}
