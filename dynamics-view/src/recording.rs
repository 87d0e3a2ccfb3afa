//! A robot of the derive, watched while it moves: its charts, and its film.

use dynamics_core::nalgebra::SVector;
use dynamics_core::simulate::EnergyMonitor;
use dynamics_core::{
    Configuration, Dynamics, EachFrame, Energy, Frame, FrameVisitor, Mechanism, Regressor, Sample, State,
};

use crate::chart::{Account, Chart};
use crate::coordinates::{Coordinate, Coordinates, Loose, Measure};
use crate::figure::Figure;
use crate::film::Film;
use crate::scene::{Body, Joint, Motion, Placed, Scene};

/// What was seen of a robot: states and energies over time.
///
/// # Example
///
/// ```
/// use dynamics_core::prelude::*;
/// use dynamics_view::{Error as Undrawn, Recording};
///
/// /// The charts of a second of a robot left to itself, and its film.
/// fn drawn<R>(robot: &R, start: State<f64, 2, 2>) -> Result<(String, String), Undrawn>
/// where
///     R: Mechanism + Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> + EachFrame<f64, 2, 2>,
/// {
///     let mut seen = Recording::of(robot);
///     let mut simulation = Simulation::new(robot, start, 1e-3).expect("the state is finite");
///     seen.see(&simulation.sample());
///     for sample in simulation.steps(1000) {
///         seen.see(&sample.expect("it stays finite"));
///     }
///     Ok((seen.figure("A swing").svg()?, seen.film().html()?))
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Recording<'r, R, const NQ: usize, const NV: usize> {
    robot: &'r R,
    scene: Scene,
    coordinates: Coordinates,
    seen: Vec<Seen<NQ, NV>>,
    monitor: Option<EnergyMonitor<f64, NQ, NV>>,
}

#[derive(Clone, Copy, Debug)]
struct Seen<const NQ: usize, const NV: usize> {
    time: f64,
    state: State<f64, NQ, NV>,
    energy: Energy<f64>,
    /// None where the input is not known.
    account: Option<Account>,
}

/// An animation has no more frames than this many a second.
const RATE: f64 = 60.0;

impl<'r, R, const NQ: usize, const NV: usize> Recording<'r, R, NQ, NV>
where
    R: Mechanism + Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV> + EachFrame<f64, NQ, NV>,
{
    /// Nothing seen yet. Joints are found by the Jacobians of the bodies that they join.
    #[must_use]
    pub fn of(robot: &'r R) -> Self {
        let mut placed = Places { robot, q: robot.neutral(), found: vec![] };
        robot.each_frame(&mut placed);
        let placed = placed.found;
        let world = Placed::world(NV);
        let parent = |k: usize| R::BODY_PARENTS.get(k).copied().flatten();
        let motions: Vec<Vec<(usize, Motion)>> = placed
            .iter()
            .enumerate()
            .map(|(k, body)| body.motions_against(parent(k).map_or(&world, |parent| &placed[parent])))
            .collect();
        let joints = Joints::of(&motions, R::JOINT_NAMES, R::MOTIONS);
        let bodies = R::BODY_NAMES.iter().zip(motions).enumerate().map(|(k, (name, motions))| Body {
            name: (*name).to_owned(),
            parent: parent(k),
            joint: joints.of_body(&motions),
            ..Body::default()
        });
        let scene = Scene { name: R::NAME.to_owned(), bodies: bodies.collect() };
        Self { robot, scene, coordinates: joints.coordinates(NQ > NV), seen: vec![], monitor: None }
    }

    /// With the masses of its bodies, as its inertial parameters have them.
    #[must_use]
    pub fn with_masses<const NP: usize>(mut self) -> Self
    where
        R: Regressor<f64, NQ, NV, NP>,
    {
        let parameters = self.robot.inertial_parameters();
        for body in &mut self.scene.bodies {
            let named = R::PARAMETER_NAMES.iter().position(|name| *name == format!("{}.mass", body.name));
            if let Some(at) = named
                && let Some([mass, x, y, z, xx, xy, yy, xz, yz, zz]) =
                    parameters.as_slice().get(at..at + 10).and_then(|ten| <[f64; 10]>::try_from(ten).ok())
                && mass > 0.0
            {
                let [a, b, c] = [x / mass, y / mass, z / mass];
                body.mass = mass;
                body.com = [a, b, c];
                // From about the origin to about the centre of mass.
                let [xy, xz, yz] = [xy + mass * a * b, xz + mass * a * c, yz + mass * b * c];
                body.inertia = [
                    [xx - mass * (b * b + c * c), xy, xz],
                    [xy, yy - mass * (a * a + c * c), yz],
                    [xz, yz, zz - mass * (a * a + b * b)],
                ];
            }
        }
        self
    }

    /// Keeps a moment of a simulation. What drives the robot is not known, and so the change of its energy is all that is
    /// drawn of that.
    pub fn see(&mut self, sample: &Sample<'_, R, f64, NQ, NV>) {
        let Sample { time, state, .. } = *sample;
        // At the start nothing has been done yet.
        let account = self.seen.is_empty().then(Account::default);
        if account.is_some() {
            self.monitor = Some(EnergyMonitor::new(sample));
        }
        self.seen.push(Seen { time, state, energy: sample.energy(), account });
    }

    /// Keeps a moment of a simulation, since whose last one the joint forces were `τ = input(time, state)`, in N·m or N.
    ///
    /// Where every moment but the first was kept so, their work is drawn, what dampers took, and what is left of the energy's change: the
    /// error. Of forces that were held, `seen.see_under(&sample, |_, _| tau)`.
    pub fn see_under(
        &mut self,
        sample: &Sample<'_, R, f64, NQ, NV>,
        input: impl FnMut(f64, &State<f64, NQ, NV>) -> SVector<f64, NV>,
    ) {
        let monitor = self.monitor.get_or_insert_with(|| EnergyMonitor::new(sample));
        monitor.observe(sample, input);
        let (work, dissipated, imbalance) = (monitor.work(), monitor.dissipated(), monitor.imbalance());
        let account = Some(Account { work, dissipated, imbalance });
        let Sample { time, state, .. } = *sample;
        self.seen.push(Seen { time, state, energy: sample.energy(), account });
    }

    /// Keeps every moment that passes, and passes it on: `seen.watch(simulation.steps(1000)).last()`.
    pub fn watch<'s, E>(
        &'s mut self,
        samples: impl Iterator<Item = Result<Sample<'r, R, f64, NQ, NV>, E>> + 's,
    ) -> impl Iterator<Item = Result<Sample<'r, R, f64, NQ, NV>, E>> + 's {
        samples.inspect(|sample| {
            if let Ok(sample) = sample {
                self.see(sample);
            }
        })
    }

    /// [`watch`](Self::watch), of a motion under the joint forces `τ = input(time, state)`.
    pub fn watch_under<'s, E>(
        &'s mut self,
        samples: impl Iterator<Item = Result<Sample<'r, R, f64, NQ, NV>, E>> + 's,
        mut input: impl FnMut(f64, &State<f64, NQ, NV>) -> SVector<f64, NV> + 's,
    ) -> impl Iterator<Item = Result<Sample<'r, R, f64, NQ, NV>, E>> + 's {
        samples.inspect(move |sample| {
            if let Ok(sample) = sample {
                self.see_under(sample, &mut input);
            }
        })
    }

    /// What its coordinates are.
    #[must_use]
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// The charts of coordinates, speeds and energy.
    #[must_use]
    pub fn charts(&self) -> Vec<Chart> {
        self.charts_of(&self.seen.iter().collect::<Vec<_>>())
    }

    /// The phase portrait of a joint of one coordinate; none, if there is no such joint.
    #[must_use]
    pub fn phase(&self, joint: &str) -> Option<Chart> {
        let (q, v) = rows(self.seen.iter());
        self.coordinates.phase(joint, &q, &v)
    }

    /// All charts on a page.
    #[must_use]
    pub fn figure(&self, title: &str) -> Figure {
        Figure::new(title).with_all(self.charts())
    }

    /// The film, with its charts: at most sixty of the moments a second.
    #[must_use]
    pub fn film(&self) -> Film {
        let mut film = Film::new(self.scene.clone());
        let mut chosen: Vec<&Seen<NQ, NV>> = vec![];
        for (k, seen) in self.seen.iter().enumerate() {
            // Times are multiples of a step but for rounding.
            let is_due = chosen.last().is_none_or(|last| seen.time - last.time >= (1.0 - 1e-6) / RATE);
            if is_due || k + 1 == self.seen.len() {
                chosen.push(seen);
                let mut places = Poses { robot: self.robot, q: &seen.state.q, found: vec![] };
                self.robot.each_frame(&mut places);
                film.push(seen.time, places.found);
            }
        }
        film.with_charts(self.charts_of(&chosen))
    }

    fn charts_of(&self, seen: &[&Seen<NQ, NV>]) -> Vec<Chart> {
        let times: Vec<f64> = seen.iter().map(|seen| seen.time).collect();
        let energy: Vec<Energy<f64>> = seen.iter().map(|seen| seen.energy).collect();
        let (q, v) = rows(seen.iter().copied());
        let mut charts = self.coordinates.charts(&times, &q);
        charts.extend(self.coordinates.speed_charts(&times, &v));
        match seen.iter().map(|seen| seen.account).collect::<Option<Vec<Account>>>() {
            Some(accounts) => charts.extend(Chart::energy_account(&times, &energy, &accounts)),
            None => charts.extend(Chart::energy(&times, &energy)),
        }
        charts
    }
}

/// Coordinates and speeds at each moment.
fn rows<'a, const NQ: usize, const NV: usize>(
    seen: impl Iterator<Item = &'a Seen<NQ, NV>>,
) -> (Vec<&'a [f64]>, Vec<&'a [f64]>) {
    seen.map(|seen| (seen.state.q.as_slice(), seen.state.v.as_slice())).unzip()
}

/// All frames with their Jacobians.
struct Places<'a, R, const NQ: usize> {
    robot: &'a R,
    q: SVector<f64, NQ>,
    found: Vec<Placed>,
}

impl<R, const NQ: usize, const NV: usize> FrameVisitor<R, f64, NQ, NV> for Places<'_, R, NQ> {
    fn visit<F: Frame<R, f64, NQ, NV>>(&mut self) {
        let jacobian = F::jacobian(self.robot, &self.q);
        self.found.push(Placed { pose: F::pose(self.robot, &self.q), jacobian: jacobian.data.0.to_vec() });
    }
}

/// The poses of all frames.
struct Poses<'a, R, const NQ: usize> {
    robot: &'a R,
    q: &'a SVector<f64, NQ>,
    found: Vec<dynamics_core::Pose<f64>>,
}

impl<R, const NQ: usize, const NV: usize> FrameVisitor<R, f64, NQ, NV> for Poses<'_, R, NQ> {
    fn visit<F: Frame<R, f64, NQ, NV>>(&mut self) {
        self.found.push(F::pose(self.robot, self.q));
    }
}

/// The joints with speeds of their own: the speeds of each, and how they move; in the order of speeds.
struct Joints<'n> {
    own: Vec<(Vec<usize>, Vec<Motion>)>,
    names: &'n [&'n str],
}

impl<'n> Joints<'n> {
    /// Joints that follow another one have its speeds, and are one with it here. A speed by which no body moves, as
    /// `by_speed` has some, is that of a coordinate without one.
    fn of(
        motions: &[Vec<(usize, Motion)>],
        names: &'n [&'n str],
        by_speed: &[dynamics_core::Motion],
    ) -> Self {
        let mut own: Vec<(Vec<usize>, Vec<Motion>)> = vec![];
        for joint in motions.iter().filter(|joint| !joint.is_empty()) {
            let (speeds, motions): (Vec<usize>, Vec<Motion>) = joint.iter().copied().unzip();
            if own.iter().all(|(known, _)| *known != speeds) {
                own.push((speeds, motions));
            }
        }
        for (speed, motion) in by_speed.iter().enumerate() {
            if own.iter().all(|(known, _)| !known.contains(&speed)) {
                let along = [0.0, 0.0, 1.0];
                own.push((
                    vec![speed],
                    vec![match motion {
                        dynamics_core::Motion::Rotation => Motion::Turn { through: [0.0; 3], along },
                        dynamics_core::Motion::Translation => Motion::Slide { along },
                    }],
                ));
            }
        }
        own.sort_by(|a, b| a.0.cmp(&b.0));
        Self { own, names }
    }

    fn name(&self, k: usize) -> String {
        self.names.get(k).map_or_else(|| format!("joint {k}"), |name| (*name).to_owned())
    }

    fn of_body(&self, motions: &[(usize, Motion)]) -> Joint {
        let (speeds, motions): (Vec<usize>, Vec<Motion>) = motions.iter().copied().unzip();
        let Some(k) = self.own.iter().position(|(known, _)| *known == speeds) else {
            return Joint::default();
        };
        Joint { name: self.name(k), kind: kind(&motions).to_owned(), motions }
    }

    /// Where there are more coordinates than speeds, six motions are a free joint and three turns a ball.
    fn coordinates(&self, has_quaternions: bool) -> Coordinates {
        let mut found = Coordinates::default();
        let mut q = 0;
        for (k, (speeds, motions)) in self.own.iter().enumerate() {
            let (name, v) = (self.name(k), speeds[0]);
            match kind(motions) {
                kind @ ("free" | "ball") if has_quaternions => {
                    let is_free = kind == "free";
                    found.loose.push(Loose { name, q, v, is_free });
                    q += if is_free { 7 } else { 4 };
                }
                _ => {
                    for (part, motion) in motions.iter().enumerate() {
                        let name =
                            if motions.len() == 1 { name.clone() } else { format!("{name}.{}", part + 1) };
                        let is_turn = matches!(motion, Motion::Turn { .. });
                        let measure = if is_turn { Measure::Angle } else { Measure::Distance };
                        found.single.push(Coordinate { name, q, v: v + part, measure });
                        q += 1;
                    }
                }
            }
        }
        found
    }
}

fn kind(motions: &[Motion]) -> &'static str {
    let turns = motions.iter().filter(|motion| matches!(motion, Motion::Turn { .. })).count();
    match (turns, motions.len()) {
        (0, 1) => "prismatic",
        (1, 1) => "revolute",
        (1, 2) => "cylindrical",
        (2, 2) => "universal",
        (1, 3) => "planar",
        (0, 3) => "translation",
        (3, 3) => "ball",
        (3, 6) => "free",
        _ => "several",
    }
}
