//! `dynamics report FILE`: a robot and its equations on one page, to be read and to be moved by hand.

mod conventions;
mod costs;
mod equations;
mod linearised;
mod notes;
mod parameters;
mod stage;
mod structure;
mod summary;
mod swing;

use std::path::PathBuf;

use dynamics_codegen::closed::{Notation, Role};
use dynamics_codegen::mechanics::equations::{Argument, Method};
use dynamics_codegen::model::Parameter;
use dynamics_codegen::symbolic::Graph;
use dynamics_view::page::Page;

use crate::failure::{Failure, Problem};
use crate::input::{Input, shown};
use crate::output::{check_writable, failed, writer};
use crate::picture::{robot_name, undrawn};
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::{Robot, State, Wanted};
use crate::simulate::{duration, step};
use crate::state;

/// Write a page about a robot: it in three dimensions, its equations, costs, swing and linear model
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// The file to write; without it, standard output
    #[arg(short, long, value_name = "HTML")]
    output: Option<PathBuf>,

    /// The title; without it, what the file calls its robot
    #[arg(long)]
    title: Option<String>,

    /// Where the robot stands, and about which its model is linear: JSON as for `eval`; without `tau`, its motors hold
    /// it if they can. What is not given is neutral
    #[arg(long, value_name = "JSON", default_value = "{}", hide_default_value = true)]
    state: String,

    /// Coordinates at the start of the swing, as for `simulate`; without it, each joint that turns is 0.3 rad off
    #[arg(long, allow_hyphen_values = true)]
    q: Option<String>,

    /// Speeds at the start of the swing; without it, zero, but for bodies that are free, which turn at 1 rad/s about
    /// each of their axes
    #[arg(long, allow_hyphen_values = true)]
    v: Option<String>,

    /// How long it swings, in seconds; without it, 3, and 1 if the robot is free to fall
    #[arg(long, value_name = "SECONDS", value_parser = duration)]
    time: Option<f64>,

    /// The step of the integration, in seconds
    #[arg(long, value_name = "SECONDS", default_value = "1e-3", value_parser = step)]
    step: f64,
}

const EXAMPLES: &str = "\
The page is one file and asks the network for nothing. It has sections of

  the robot                  in three dimensions, with a slider for each coordinate, if it has bodies
  its parameters             masses, inertias, joints, limits, dampers, springs and rotors
  its equations              M, C, G, P, T, V and L, with LaTeX to be copied
  the structure of M         which entries are zero, which constant, and on what the others depend
  costs                      operations of each method, as `count` has them
  a swing                    of the robot left to itself, until a joint that slides comes to its end
  a linear model             A, B, poles, stability, controllability, and the torques that hold the robot
  the file                   what was merged, ignored and altered

Examples:
  dynamics report arm.urdf -o arm.html
  dynamics report arm.urdf --q 0.5,0.1 --time 5 --state '{\"q\": {\"elbow\": 1.57}}' -o arm.html
  dynamics report dog.urdf --base free --state '{\"q\": {\"root_joint.z\": 0.6}}' -o dog.html";

/// What every section is about.
pub(super) struct Subject<'a, 'g> {
    robot: &'a Robot<'g>,
    graph: &'g Graph,
    input: &'a Input,
    name: String,
    /// What the symbols of its equations are called.
    notation: Notation,
    /// Its fields, with the units that their uses tell.
    fields: Vec<Parameter>,
    /// Where the robot stands.
    at: State,
}

impl Subject<'_, '_> {
    /// The letters of an argument's entries: θ₁, θ̇₁.
    fn letters(&self, argument: Argument) -> Vec<String> {
        let role = match argument {
            Argument::Q => Role::Coordinate,
            Argument::V => Role::Speed,
            Argument::A => Role::Acceleration,
            Argument::Tau => Role::Force,
        };
        let letters = self.notation.letters().iter().filter(|letter| letter.role == role);
        letters.map(|letter| letter.name.unicode()).collect()
    }
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let input = args.input.read()?;
    check_writable(args.output.as_deref(), &args.input.file)?;
    let graph = Graph::new();
    let robot = Robot::of(&input, &graph, Wanted::Only(&Method::OF_ROBOT))?;
    input.warn(&robot.report);
    let at = state::read(&args.state, &args.input.file, &robot)?;
    let start = swing::start(&robot, args.q.as_deref(), args.v.as_deref())?;
    for (state, what, option) in
        [(&at, "where the robot stands", "--state"), (&start, "where its swing begins", "--q")]
    {
        if let Err(why) = robot.moves(state) {
            let problem =
                Problem::new(format!("{what}, at q = {:?}, it cannot move: {}", state.q, why.fact()));
            return Err(problem.help(why.help(option)).into());
        }
    }
    let html = {
        let _progress = Progress::of("writing the page");
        let name = shown(&args.title.clone().unwrap_or_else(|| robot_name(&robot)));
        let (notation, fields) = equations::notation(&robot, &input)?;
        let subject = Subject { robot: &robot, graph: &graph, input: &input, name, notation, fields, at };
        page(&subject, args, start)?.html().map_err(undrawn)?
    };
    // Not before all is there: what the file had stays if nothing comes of it.
    let mut out = writer(args.output.as_deref(), &args.input.file)?;
    let done = out.write_all(html.as_bytes()).and_then(|()| out.flush());
    done.map_err(|error| failed(args.output.as_deref(), &error))
}

fn page(subject: &Subject<'_, '_>, args: &Args, start: State) -> Result<Page, Failure> {
    let time = args.time.unwrap_or_else(|| swing::usual_time(subject.robot));
    let swing = swing::Swing::of(subject.robot, start, time, args.step)?;
    let is_held = args.state.contains("tau");
    let version = env!("CARGO_PKG_VERSION");
    let page = summary::put(Page::new(&subject.name), subject);
    let page = match stage::is_empty(subject.robot) {
        true => page,
        false => page.with_stage(stage::of(subject, &swing)),
    };
    Ok(page
        .section(stage::section(subject.robot))
        .section(parameters::section(subject))
        .section(equations::section(subject)?)
        .section(structure::section(subject))
        .section(costs::section(subject.robot))
        .section(swing.section(subject))
        .section(linearised::section(subject, is_held)?)
        .section(notes::section(subject))
        .section(conventions::section(subject))
        .footer(&format!("Made by dynamics {version} from `{}`.", summary::file(subject))))
}
