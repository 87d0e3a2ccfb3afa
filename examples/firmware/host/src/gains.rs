//! The gains of the state feedback: the linear-quadratic regulator of each robot about its pose, designed in `f64`.
//!
//! The weights follow A. E. Bryson and Y.-C. Ho, *Applied Optimal Control*, 1975: each is the inverse square of what is
//! wanted at most.

use std::fmt::Write as _;

use dynamics_core::linear::{Lqr, Weights};
use dynamics_core::prelude::*;
use firmware_control::robots::{CartPole, Iiwa14, Leg, Puma560, RoboJudge};
use firmware_control::trial::{CART_POLE, IIWA14, LEG, PUMA560, ROBO_JUDGE, Setup};

use crate::Result;

/// The most that a coordinate shall be off, in rad or m.
const DEVIATION: f64 = 0.1;
/// The most that a speed shall be, in rad/s or m/s.
const SPEED: f64 = 1.0;
/// The most that an input shall accelerate what it moves, in rad/s² or m/s².
const ACCELERATION: f64 = 40.0;

/// The file of the firmware that has the gains.
pub(crate) fn source() -> Result<String> {
    let mut text = String::from(
        "//! The gains of the state feedback, written by `cargo run -- --bless`; `host/src/gains.rs` says what they are.\n\
         //!\n\
         //! Each is `K`, NU×2N, by rows: of the coordinates in N·m/rad or N/m, then of the speeds.\n",
    );
    write("ROBO_JUDGE", lqr::<_, 2, 4, 2>(&RoboJudge::example(), &ROBO_JUDGE), &mut text)?;
    write("CART_POLE", lqr::<_, 2, 4, 1>(&CartPole, &CART_POLE), &mut text)?;
    write("PUMA560", lqr::<_, 6, 12, 6>(&Puma560, &PUMA560), &mut text)?;
    write("IIWA14", lqr::<_, 7, 14, 7>(&Iiwa14, &IIWA14), &mut text)?;
    write("LEG", lqr::<_, 3, 6, 3>(&Leg, &LEG), &mut text)?;
    Ok(text)
}

/// The regulator of a robot about its pose.
fn lqr<R, const N: usize, const NX: usize, const NU: usize>(
    robot: &R,
    setup: &Setup<N, NX, NU>,
) -> Result<Lqr<f64, NX, NU>>
where
    R: StateSpaceModel<f64, N, N, NX, NU>,
{
    let feedback = setup.feedback(robot);
    let (pose, input_map) = (&feedback.state, robot.input_map());
    let inertia = (input_map.transpose() * robot.mass_matrix(&pose.q) * input_map).diagonal();
    let weights = Weights::diagonal(
        std::array::from_fn(|k| if k < N { DEVIATION } else { SPEED }.powi(-2)),
        std::array::from_fn(|k| (inertia[k] * ACCELERATION).powi(-2)),
    );
    let model = StateSpace::from(robot.linearize(&pose.q, &pose.v, &feedback.u));
    model.lqr(&weights).map_err(|error| format!("the gain of the {}: {error}", setup.name))
}

fn write<const NX: usize, const NU: usize>(
    constant: &str,
    lqr: Result<Lqr<f64, NX, NU>>,
    text: &mut String,
) -> Result<()> {
    let _ = writeln!(text, "\n/// Of `trial::{constant}`.\n#[rustfmt::skip]");
    let _ = writeln!(text, "pub const {constant}: [[f32; {NX}]; {NU}] = [");
    for row in lqr?.gain.row_iter() {
        let row: Vec<_> = row.iter().map(|&k| k as f32).collect();
        let _ = writeln!(text, "    {row:?},");
    }
    let _ = writeln!(text, "];");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is in the firmware is designed here, to single precision.
    #[test]
    fn committed_gains_are_these() {
        let committed = include_str!("../../control/src/gains.rs");
        assert_eq!(source().as_deref(), Ok(committed));
    }

    /// The whole robot, not its linear model, under the gain of the firmware: after so many seconds it is there.
    fn settles<R, const N: usize, const NX: usize, const NU: usize>(robot: &R, setup: &Setup<N, NX, NU>)
    where
        R: StateSpaceModel<f64, N, N, NX, NU>,
    {
        const SECONDS: usize = 8;
        let law = setup.feedback(robot);
        let start = State::rest(law.state.q + SVector::from(setup.swing.map(f64::from)) * 0.25);
        let simulation = Simulation::new(robot, start, 1e-3).expect("the start is finite");
        let mut simulation = simulation.with_input(|_, state: &State<f64, N, N>| law.torque(robot, state));
        let last = simulation.steps(1000 * SECONDS).last().expect("there are steps");
        let last = last.expect("the robot stays finite");
        let left = (last.state.q - law.state.q).amax().max(last.state.v.amax());
        eprintln!("{}: {left:.1e} left", setup.name);
        assert!(left <= 1e-3, "{}: {left:e} is left after {SECONDS} s", setup.name);
    }

    #[test]
    fn the_closed_loop_settles() {
        settles::<_, 2, 4, 2>(&RoboJudge::example(), &ROBO_JUDGE);
        settles::<_, 2, 4, 1>(&CartPole, &CART_POLE);
        settles::<_, 6, 12, 6>(&Puma560, &PUMA560);
        settles::<_, 7, 14, 7>(&Iiwa14, &IIWA14);
        settles::<_, 3, 6, 3>(&Leg, &LEG);
    }
}
