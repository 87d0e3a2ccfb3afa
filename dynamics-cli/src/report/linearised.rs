//! The linear model about the state in which the robot stands, and what holds it there.

use dynamics_codegen::mechanics::equations::{Argument, Method};
use dynamics_codegen::model::JointInfo;
use dynamics_core::linear::Verdict;
use dynamics_core::nalgebra::DMatrix;
use dynamics_view::page::{Matrix, Section, Table, number};
use dynamics_view::{Chart, Figure, Plane};

use super::Subject;
use crate::absence::Absence;
use crate::failure::Failure;
use crate::linear::{Judgement, eigenvalues, input_matrix, judge, state_matrix};
use crate::robot::{Robot, State};

/// Models of more degrees of freedom are not printed: nobody reads so many numbers.
const LARGEST: usize = 10;
/// Poles in a table.
const MOST_POLES: usize = 40;
/// Forces and accelerations below this part of the largest one are rounding.
const ROUNDING: f64 = 1e-9;
/// Poles that are smaller than this part of the largest one are zero, or next to it.
const DOUBLE: f64 = 1e-7;
/// The width of the picture of poles, in pixels.
const WIDTH: f64 = 460.0;

/// What acts at the operating point.
struct Holding {
    /// At the torques of the model.
    state: State,
    /// `τ` of `M·0 + C·v + G + passive`: what would keep the speeds as they are.
    needed: Vec<f64>,
    /// The accelerations at the torques of the model.
    a: Vec<f64>,
    /// Whether these are zero but for rounding.
    is_equilibrium: bool,
}

pub(super) fn section(subject: &Subject<'_, '_>, is_held: bool) -> Result<Section, Failure> {
    let robot = subject.robot;
    let section = Section::new("linear", "The linear model");
    if robot.dof() == 0 {
        return Ok(section.text("Nothing moves."));
    }
    let derivatives = Method::ForwardDynamicsDerivatives;
    if !robot.has(derivatives) {
        let why = Absence::of_method(derivatives, robot).fact();
        return Ok(section.text(&format!(
            "It is made of the derivatives of forward dynamics, which this robot has not: {why}."
        )));
    }
    let holding = holding(robot, &subject.at, is_held)?;
    let (a, b) = (state_matrix(robot, &holding.state)?, input_matrix(robot, &holding.state)?);
    let section = section.text(&told(&holding, is_held)).table(torques(subject, &holding));
    let section = matrices(section, subject, &a, &b);
    Ok(judged(section, robot, &a, &b, &holding))
}

/// Torques that hold the robot if its motors can, those of the state if there are some, and else none.
fn holding(robot: &Robot<'_>, at: &State, is_held: bool) -> Result<Holding, Failure> {
    let still = State { a: vec![0.0; robot.dof()], ..at.clone() };
    let needed = robot.evaluate(Method::InverseDynamics, &still)?;
    let size = needed.iter().fold(0.0, |size: f64, force| size.max(force.abs()));
    let is_driven = |speed: &usize| robot.model.actuated.contains(speed);
    let lacking = (0..robot.dof()).filter(|k| !is_driven(k)).any(|k| needed[k].abs() > ROUNDING * size);
    let tau = match (is_held, lacking) {
        (true, _) => at.tau.clone(),
        (false, true) => vec![0.0; robot.dof()],
        (false, false) => needed.clone(),
    };
    let state = State { tau, ..at.clone() };
    let a = robot.evaluate(Method::ForwardDynamics, &state)?;
    // What the torques, and gravity, could do at most: beside it the rest is rounding.
    let possible = robot.evaluate(
        Method::ForwardDynamics,
        &State { tau: needed.iter().map(|x| -x).collect(), ..at.clone() },
    )?;
    let possible = possible.iter().fold(0.0, |size: f64, a| size.max(a.abs()));
    let is_equilibrium =
        at.v.iter().all(|v| *v == 0.0) && a.iter().all(|a| a.abs() <= ROUNDING * possible.max(1.0));
    Ok(Holding { state, needed, a, is_equilibrium })
}

fn told(holding: &Holding, is_held: bool) -> String {
    let first = "Small deviations from the state in which the robot stands go on by ẋ = A·x + B·u";
    let of_torques = match (is_held, holding.is_equilibrium) {
        (true, true) => "the torques that are given hold it there.",
        (true, false) => {
            "the torques that are given do not hold it there: what follows is true for a short while."
        }
        (false, true) => "the torques below hold it there.",
        (false, false) => {
            "no torques of its motors keep it there as it is: the model is that of the robot without torques, and what \
             follows is true for a short while."
        }
    };
    format!(
        "{first}, where x are the deviations of q and v, and u those of the motors' torques; {of_torques}"
    )
}

fn torques(subject: &Subject<'_, '_>, holding: &Holding) -> Table {
    let robot = subject.robot;
    let speeds = subject.letters(Argument::V);
    let mut caption = "At the operating point".to_owned();
    let v = &holding.state.v;
    if v.iter().all(|v| *v == 0.0) {
        caption += ", at rest";
    }
    let head = ["speed", "symbol", "τ to hold it, N·m or N", "τ of the model", "acceleration"];
    let size = holding.needed.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let short = |x: f64| if x.abs() <= 1e-13 * size.max(1e-3) { 0.0 } else { x };
    let row = |k: usize| {
        let own = match robot.model.actuated.contains(&k) {
            true => number(short(holding.state.tau[k]), 5),
            false => "no motor".to_owned(),
        };
        let a = if holding.is_equilibrium { 0.0 } else { short(holding.a[k]) };
        vec![
            format!("`{}`", robot.coordinates.v[k]),
            speeds[k].clone(),
            number(short(holding.needed[k]), 5),
            own,
            number(a, 4),
        ]
    };
    Table::new(&caption, "llrrr").head(head).rows((0..robot.dof()).map(row))
}

fn matrices(section: Section, subject: &Subject<'_, '_>, a: &DMatrix<f64>, b: &DMatrix<f64>) -> Section {
    let robot = subject.robot;
    let n = robot.dof();
    if n > LARGEST {
        return section.text(&format!(
            "A has {0} rows and columns, and B {0} rows and {1}: more numbers than anybody reads. They are printed for up to \
             {LARGEST} degrees of freedom; `dynamics eval --only da_dq,da_dv,Minv` has them all.",
            2 * n,
            b.ncols()
        ));
    }
    let speeds = subject.letters(Argument::V);
    let states: Vec<String> = displacements(subject).into_iter().chain(speeds).collect();
    let forces = subject.letters(Argument::Tau);
    let inputs = robot.model.actuated.iter().map(|speed| forces[*speed].clone()).collect();
    let rows = |m: &DMatrix<f64>| -> Vec<Vec<f64>> {
        (0..m.nrows()).map(|i| (0..m.ncols()).map(|j| m[(i, j)]).collect()).collect()
    };
    let section = section.matrix(Matrix {
        name: "A".to_owned(),
        caption: "by which the deviations act on their own rates".to_owned(),
        rows: states.clone(),
        columns: states.clone(),
        entries: rows(a),
    });
    match b.ncols() {
        0 => section.text("There are no motors, and so no B."),
        _ => section.matrix(Matrix {
            name: "B".to_owned(),
            caption: "by which torques act on them".to_owned(),
            rows: states,
            columns: inputs,
            entries: rows(b),
        }),
    }
}

/// The letters of deviations: `δθ₁`, and of joints with quaternions `δrx`, in the axes of the body.
fn displacements(subject: &Subject<'_, '_>) -> Vec<String> {
    let letters = subject.letters(Argument::Q);
    let of_joint = |joint: &JointInfo| -> Vec<String> {
        if joint.q.len() == joint.v.len() {
            return joint.q.clone().map(|q| format!("δ{}", letters[q])).collect();
        }
        let names = joint.displacement_names();
        names.iter().map(|name| format!("δ{}", name.rsplit('.').next().unwrap_or(name))).collect()
    };
    subject.robot.model.joints.iter().flat_map(of_joint).collect()
}

fn judged(
    section: Section,
    robot: &Robot<'_>,
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    holding: &Holding,
) -> Section {
    let judgement = judge(a, b);
    let poles = match &judgement {
        Some(judgement) => judgement.poles.clone(),
        None => sorted(eigenvalues(a.clone()).unwrap_or_default()),
    };
    let poles: Vec<[f64; 2]> = poles.into_iter().map(|pole| cleared(pole, a.norm())).collect();
    let section = section.heading("Poles");
    if poles.is_empty() {
        return section.text("The poles cannot be found.");
    }
    let chart = Chart::poles(Plane::Continuous).set("poles", poles.iter().copied());
    let section = section
        .figure(
            "The poles of the linear model, in the complex plane",
            Figure::new("").with(chart).wide(WIDTH),
        )
        .table(table(&poles));
    match judgement {
        Some(judgement) => section.list(sentences(&judgement, robot, holding, a.norm())),
        None => section.remark(
            "Stability and controllability are judged, beyond what rounding can decide, for robots of up to 18 degrees of \
             freedom.",
        ),
    }
}

/// The slowest first.
fn sorted(mut poles: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    poles.sort_by(|one, other| other[0].total_cmp(&one[0]));
    poles
}

/// A pole without what is rounding, beside the norm of A. A double pole at zero is found within the root of what rounding
/// is, so that what is that small is zero.
fn cleared([re, im]: [f64; 2], norm: f64) -> [f64; 2] {
    let frequency = re.hypot(im);
    if frequency <= DOUBLE * norm {
        return [0.0; 2];
    }
    [re, im].map(|x| if x.abs() <= 1e-12 * frequency { 0.0 } else { x })
}

/// Poles with positive imaginary part stand for their pair; those at zero are one row.
fn table(poles: &[[f64; 2]]) -> Table {
    let zeros = poles.iter().filter(|pole| **pole == [0.0; 2]).count();
    let row = |[re, im]: &[f64; 2]| {
        let frequency = re.hypot(*im);
        if frequency == 0.0 {
            let count = if zeros > 1 { format!("0, {zeros} times") } else { "0".to_owned() };
            return vec![count, "0".to_owned(), String::new(), "stays, or drifts".to_owned()];
        }
        let pole = match *im {
            0.0 => number(*re, 5),
            im => format!("{} ± {}i", number(*re, 5), number(im, 5)),
        };
        vec![pole, number(frequency, 5), number(-re / frequency, 4), time(*re, *im)]
    };
    let mut upper: Vec<&[f64; 2]> = poles.iter().filter(|[_, im]| *im >= 0.0).collect();
    let first = upper.iter().position(|pole| **pole == [0.0; 2]);
    let mut k = 0;
    upper.retain(|pole| {
        k += 1;
        **pole != [0.0; 2] || first == Some(k - 1)
    });
    let caption = match upper.len() > MOST_POLES {
        true => format!("The slowest {MOST_POLES} of {} poles and pairs", upper.len()),
        false => "Poles, the slowest first, with natural frequency ω and damping ratio ζ".to_owned(),
    };
    Table::new(&caption, "lrrl")
        .head(["pole, 1/s", "ω, rad/s", "ζ", "in time"])
        .rows(upper.into_iter().take(MOST_POLES).map(row))
}

/// What a pole does, in seconds.
fn time(re: f64, im: f64) -> String {
    let size = re.hypot(im);
    let of_size = match re {
        _ if re.abs() <= 1e-9 * size => String::new(),
        re if re > 0.0 => format!("doubles in {} s", number(std::f64::consts::LN_2 / re, 3)),
        re => format!("halves in {} s", number(std::f64::consts::LN_2 / -re, 3)),
    };
    let turns = if im.abs() <= 1e-9 * size {
        String::new()
    } else {
        format!("period {} s", number(std::f64::consts::TAU / im.abs(), 3))
    };
    [turns, of_size].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

fn sentences(judgement: &Judgement, robot: &Robot<'_>, holding: &Holding, norm: f64) -> Vec<String> {
    let Judgement { verdict, margin, reached, distance, missing, .. } = judgement;
    let all = 2 * robot.dof();
    let margin = number(*margin, 2);
    let about = if holding.is_equilibrium { "The equilibrium" } else { "The model" };
    let stability = match verdict {
        Verdict::Stable => format!(
            "{about} is stable: all small deviations decay, and would if A changed by less than {margin} of its norm."
        ),
        Verdict::Marginal => format!(
            "{about} is marginal: no small deviation grows exponentially, and some do not decay; the linear model alone does \
             not tell what becomes of them."
        ),
        Verdict::Unstable => format!("{about} is unstable: some small deviations grow exponentially."),
    };
    let distance = number(*distance, 2);
    let control = match (robot.model.actuated.len(), missing.is_empty() && reached == &all) {
        (0, _) => "It has no motors.".to_owned(),
        (_, true) => format!(
            "It is controllable: its motors reach all {all} states; the nearest model that lacks one is {distance} of the \
             norms of A and B away."
        ),
        (_, false) => {
            let mut lost: Vec<(String, usize)> = vec![];
            for pole in missing.iter().map(|pole| cleared(*pole, norm)) {
                let text = match pole {
                    [re, 0.0] => number(re, 3),
                    [re, im] => format!(
                        "{} {} {}i",
                        number(re, 3),
                        if im < 0.0 { "−" } else { "+" },
                        number(im.abs(), 3)
                    ),
                };
                match lost.iter_mut().find(|(known, _)| *known == text) {
                    Some((_, count)) => *count += 1,
                    None => lost.push((text, 1)),
                }
            }
            let times = |(pole, count): &(String, usize)| match count {
                1 => pole.clone(),
                count => format!("{pole} ({count} times)"),
            };
            let poles: Vec<String> = lost.iter().map(times).collect();
            format!(
                "It is not controllable: its motors reach {reached} of {all} states. The modes that they miss have the poles \
                 {}.",
                poles.join(", ")
            )
        }
    };
    vec![stability, control]
}
