//! The gains of the state feedback: the linear-quadratic regulator of each robot about its pose.
//!
//! `AᵀS + SA − SBR⁻¹BᵀS + Q = 0` and `K = R⁻¹BᵀS`, with `ẋ ≈ A·x + B·u` from the robot's own linearisation. The weights
//! follow A. E. Bryson and Y.-C. Ho, *Applied Optimal Control*, 1975: each is the inverse square of what is wanted at
//! most.
//!
//! Source: J. D. Roberts, *Linear model reduction and solution of the algebraic Riccati equation by use of the sign
//! function*, Int. J. Control 32 (1980), 677–687.

use std::fmt::Write as _;

use dynamics_core::prelude::*;
use firmware_control::robots::{CartPole, Iiwa14, Puma560, RoboJudge};
use firmware_control::trial::{CART_POLE, IIWA14, PUMA560, ROBO_JUDGE, Setup};
use nalgebra::{DMatrix, DVector};

use crate::Result;

/// The most that a coordinate shall be off, in rad or m.
const DEVIATION: f64 = 0.1;
/// The most that a speed shall be, in rad/s or m/s.
const SPEED: f64 = 1.0;
/// The most that an input shall accelerate what it moves, in rad/s² or m/s².
const ACCELERATION: f64 = 40.0;

/// A regulator, with what it was made of.
#[derive(Debug)]
pub(crate) struct Regulator {
    /// The constant's name in the firmware.
    constant: &'static str,
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    q: DMatrix<f64>,
    r: DMatrix<f64>,
    /// `S`, the solution of the Riccati equation.
    s: DMatrix<f64>,
    /// `K`, NU×2N.
    k: DMatrix<f64>,
}

impl Regulator {
    /// What is left of the Riccati equation, over its terms, and of `R·K = BᵀS`; infinite if `S` is not positive
    /// definite.
    pub(crate) fn residual(&self) -> f64 {
        let Self { a, b, q, r, s, k, .. } = self;
        if s.clone().cholesky().is_none() {
            return f64::INFINITY;
        }
        let (sa, bs) = (s * a, b.transpose() * s);
        let riccati = (&sa + sa.transpose() - k.transpose() * r * k + q).norm() / (q.norm() + sa.norm());
        riccati.max((r * k - &bs).norm() / bs.norm())
    }
}

/// The largest residual: the rounding of doubles, times the condition of the iteration with the stiffest robot.
pub(crate) const RICCATI: f64 = 1e-9;

/// Of all robots.
pub(crate) fn regulators() -> Result<Vec<Regulator>> {
    Ok(vec![
        regulator::<_, 2, 4, 2>("ROBO_JUDGE", &RoboJudge::example(), &ROBO_JUDGE)?,
        regulator::<_, 2, 4, 1>("CART_POLE", &CartPole, &CART_POLE)?,
        regulator::<_, 6, 12, 6>("PUMA560", &Puma560, &PUMA560)?,
        regulator::<_, 7, 14, 7>("IIWA14", &Iiwa14, &IIWA14)?,
    ])
}

fn regulator<R, const N: usize, const NX: usize, const NU: usize>(
    constant: &'static str,
    robot: &R,
    setup: &Setup<N, NU>,
) -> Result<Regulator>
where
    R: StateSpaceModel<f64, N, N, NX, NU>,
{
    let pose = SVector::from(setup.pose.map(f64::from));
    let (input_map, mass) = (robot.input_map(), robot.mass_matrix(&pose));
    let hold = input_map.tr_mul(&robot.gravity_forces(&pose)); // inputs move one joint each
    let Linearization { a, b, .. } = robot.linearize(&pose, &SVector::zeros(), &hold);
    let (a, b) =
        (DMatrix::from_column_slice(NX, NX, a.as_slice()), DMatrix::from_column_slice(NX, NU, b.as_slice()));
    let weights = (0..NX).map(|k| if k < N { DEVIATION } else { SPEED }.powi(-2));
    let q = DMatrix::from_diagonal(&DVector::from_iterator(NX, weights));
    let moved = (input_map.transpose() * mass * input_map).diagonal();
    let weights = moved.iter().map(|mass| (mass * ACCELERATION).powi(-2));
    let r = DMatrix::from_diagonal(&DVector::from_iterator(NU, weights));
    let (s, k) =
        lqr(&a, &b, &q, &r).ok_or_else(|| format!("the Riccati equation of {constant} has no solution"))?;
    Ok(Regulator { constant, a, b, q, r, s, k })
}

/// `S` and `K`, by the sign function of the Hamiltonian matrix.
fn lqr(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    q: &DMatrix<f64>,
    r: &DMatrix<f64>,
) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    const ITERATIONS: usize = 100;
    let n = a.nrows();
    let to_inputs = r.clone().try_inverse()? * b.transpose();
    let mut z = DMatrix::zeros(2 * n, 2 * n);
    z.view_mut((0, 0), (n, n)).copy_from(a);
    z.view_mut((0, n), (n, n)).copy_from(&-(b * &to_inputs));
    z.view_mut((n, 0), (n, n)).copy_from(&-q);
    z.view_mut((n, n), (n, n)).copy_from(&-a.transpose());
    for _ in 0..ITERATIONS {
        let inverse = z.clone().try_inverse()?;
        let scale = (inverse.norm() / z.norm()).sqrt();
        let next = (&z * scale + inverse / scale) * 0.5;
        let change = (&next - &z).norm();
        z = next;
        if change <= 1e-13 * z.norm() {
            break;
        }
    }
    let identity = DMatrix::identity(n, n);
    let (mut left, mut right) = (DMatrix::zeros(2 * n, n), DMatrix::zeros(2 * n, n));
    left.rows_mut(0, n).copy_from(&z.view((0, n), (n, n)));
    left.rows_mut(n, n).copy_from(&(z.view((n, n), (n, n)) + &identity));
    right.rows_mut(0, n).copy_from(&-(z.view((0, 0), (n, n)) + &identity));
    right.rows_mut(n, n).copy_from(&-z.view((n, 0), (n, n)));
    let s = left.svd(true, true).solve(&right, 1e-12).ok()?;
    let s = (&s + s.transpose()) * 0.5;
    let k = to_inputs * &s;
    Some((s, k))
}

/// The file of the firmware that has the gains.
pub(crate) fn source(regulators: &[Regulator]) -> String {
    let mut text = String::from(
        "//! The gains of the state feedback, written by `cargo run -- --bless`; `host/src/gains.rs` says what they are.\n\n\
         /// `K`, NU×2N, of `u = −K·(q − q₀, v)`, by rows.\n\
         #[derive(Clone, Copy, Debug, PartialEq)]\n\
         pub struct Gain<const N: usize, const NU: usize> {\n    \
         /// In N·m/rad or N/m.\n    \
         pub position: [[f32; N]; NU],\n    \
         /// In N·m·s/rad or N·s/m.\n    \
         pub velocity: [[f32; N]; NU],\n}\n",
    );
    for Regulator { constant, k, .. } in regulators {
        let (nu, n) = (k.nrows(), k.ncols() / 2);
        let _ = writeln!(text, "\n/// Of the `Setup` of this name.\n#[rustfmt::skip]");
        let _ = writeln!(text, "pub const {constant}: Gain<{n}, {nu}> = Gain {{");
        for (name, first) in [("position", 0), ("velocity", n)] {
            let _ = writeln!(text, "    {name}: [");
            for row in k.columns(first, n).row_iter() {
                let row: Vec<_> = row.iter().map(|&k| k as f32).collect();
                let _ = writeln!(text, "        {row:?},");
            }
            let _ = writeln!(text, "    ],");
        }
        let _ = writeln!(text, "}};");
    }
    text
}

#[cfg(test)]
mod tests {
    use firmware_control::gains::Gain;

    use super::*;

    /// The gain of the firmware as a matrix.
    fn committed<const N: usize, const NU: usize>(gain: &Gain<N, NU>) -> DMatrix<f64> {
        DMatrix::from_fn(NU, 2 * N, |i, j| {
            f64::from(if j < N { gain.position[i][j] } else { gain.velocity[i][j - N] })
        })
    }

    #[test]
    fn gains_solve_the_riccati_equation() {
        for regulator in regulators().expect("every robot has a regulator") {
            let (constant, residual) = (regulator.constant, regulator.residual());
            eprintln!("{constant}: residual {residual:.1e}");
            assert!(residual <= RICCATI, "{constant}: {residual:e}");
        }
    }

    /// What is in the firmware is that, to single precision.
    #[test]
    fn committed_gains_are_these() {
        let committed = [
            committed(&ROBO_JUDGE.gain),
            committed(&CART_POLE.gain),
            committed(&PUMA560.gain),
            committed(&IIWA14.gain),
        ];
        let found = regulators().expect("every robot has a regulator");
        for (Regulator { constant, k, .. }, committed) in found.iter().zip(committed) {
            let error = (k - &committed).amax() / k.amax();
            assert!(error <= f64::from(f32::EPSILON), "{constant}: {error:e}");
        }
    }

    /// The whole robot, not its linear model, under the gain of the firmware: after so many seconds it is there.
    fn settles<R, const N: usize, const NX: usize, const NU: usize>(robot: &R, setup: &Setup<N, NU>)
    where
        R: StateSpaceModel<f64, N, N, NX, NU>,
    {
        const SECONDS: usize = 8;
        let pose = SVector::from(setup.pose.map(f64::from));
        let hold = robot.gravity_forces(&pose);
        let gain = committed(&setup.gain);
        let input_map = robot.input_map();
        let start = State::rest(pose + SVector::from(setup.swing.map(f64::from)) * 0.25);
        let simulation = Simulation::new(robot, start, 1e-3).expect("the start is finite");
        let mut simulation = simulation.with_input(|_, state| {
            let x = DVector::from_iterator(NX, (state.q - pose).iter().chain(&state.v).copied());
            hold - input_map * SVector::<f64, NU>::from_column_slice((&gain * x).as_slice())
        });
        let last = simulation.steps(1000 * SECONDS).last().expect("there are steps");
        let last = last.expect("the robot stays finite");
        let left = (last.state.q - pose).amax().max(last.state.v.amax());
        eprintln!("{}: {left:.1e} left", setup.name);
        assert!(left <= 1e-3, "{}: {left:e} is left after {SECONDS} s", setup.name);
    }

    #[test]
    fn the_closed_loop_settles() {
        settles::<_, 2, 4, 2>(&RoboJudge::example(), &ROBO_JUDGE);
        settles::<_, 2, 4, 1>(&CartPole, &CART_POLE);
        settles::<_, 6, 12, 6>(&Puma560, &PUMA560);
        settles::<_, 7, 14, 7>(&Iiwa14, &IIWA14);
    }
}
