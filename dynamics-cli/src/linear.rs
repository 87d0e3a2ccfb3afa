//! The linear model at a state, for robots whose size is not known to Rust.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::Motion;
use dynamics_core::__private::{ball_tangent_rate, free_tangent_rate};
use dynamics_core::linear::{Reach, Stability, Time, Verdict, controllability, poles, stability};
use dynamics_core::nalgebra::{DMatrix, SMatrix, Schur};

use crate::failure::Failure;
use crate::robot::{Robot, State};

/// `A = [0 1; ∂a/∂q ∂a/∂v]`, 2·NV × 2·NV, as `linearize` has it; of ball and free joints in the tangent space.
pub(crate) fn state_matrix(robot: &Robot<'_>, state: &State) -> Result<DMatrix<f64>, Failure> {
    let n = robot.dof();
    let entries = robot.evaluate(Method::ForwardDynamicsDerivatives, state)?;
    let mut a = DMatrix::<f64>::zeros(2 * n, 2 * n);
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        for j in 0..n {
            a[(n + i, j)] = entries[i * n + j];
            a[(n + i, n + j)] = entries[(n + i) * n + j];
        }
    }
    let mut put = |from: usize, rows: &[&[f64]]| {
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                a[(from + i, from + j)] = *entry;
            }
        }
    };
    let v = &state.v;
    for link in &robot.tree.links {
        let from = link.drive.v;
        match link.motion {
            Motion::Revolute | Motion::Prismatic => {}
            Motion::Ball => {
                let rate = ball_tangent_rate::<f64>(std::array::from_fn(|k| v[from + k]));
                put(from, &rate.each_ref().map(|row| &row[..]));
            }
            Motion::Free => {
                let rate = free_tangent_rate::<f64>(std::array::from_fn(|k| v[from + k]));
                put(from, &rate.each_ref().map(|row| &row[..]));
            }
        }
    }
    Ok(a)
}

/// `B = [0; ∂a/∂u]`: the columns of `M⁻¹` that have a motor.
pub(crate) fn input_matrix(robot: &Robot<'_>, state: &State) -> Result<DMatrix<f64>, Failure> {
    let (n, inputs) = (robot.dof(), &robot.model.actuated);
    let entries = robot.evaluate(Method::ForwardDynamicsDerivatives, state)?;
    let mut b = DMatrix::<f64>::zeros(2 * n, inputs.len());
    for (u, speed) in inputs.iter().enumerate() {
        for i in 0..n {
            b[(n + i, u)] = entries[(2 * n + i) * n + speed];
        }
    }
    Ok(b)
}

/// All eigenvalues, real part first; nothing where the search for them does not end.
pub(crate) fn eigenvalues(a: DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    const ROUNDS: usize = 10_000;
    let schur = Schur::try_new(a, f64::EPSILON, ROUNDS)?;
    Some(schur.complex_eigenvalues().iter().map(|pole| [pole.re, pole.im]).collect())
}

/// What the run time's analysis says of a linear model.
pub(crate) struct Judgement {
    /// The poles, the slowest first.
    pub(crate) poles: Vec<[f64; 2]>,
    /// Whether motions end.
    pub(crate) verdict: Verdict,
    /// How much of its norm A has to change for a pole to be on the boundary.
    pub(crate) margin: f64,
    /// How many of the states the inputs reach.
    pub(crate) reached: usize,
    /// How far the nearest model is that lacks a mode.
    pub(crate) distance: f64,
    /// The poles of modes that no input reaches.
    pub(crate) missing: Vec<[f64; 2]>,
}

/// Judges a model by the run time, which needs its size when it is compiled: up to 18 degrees of freedom. Nothing beyond
/// these, and where no eigenvalues are found.
pub(crate) fn judge(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Option<Judgement> {
    macro_rules! sizes {
        ($($n:literal $twice:literal),*) => {
            match a.nrows() / 2 {
                $($n => judged::<$twice, $n>(a, b),)*
                _ => None,
            }
        };
    }
    sizes!(1 2, 2 4, 3 6, 4 8, 5 10, 6 12, 7 14, 8 16, 9 18, 10 20, 11 22, 12 24, 13 26, 14 28, 15 30, 16 32, 17 34, 18 36)
}

fn judged<const N: usize, const M: usize>(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Option<Judgement> {
    let a = SMatrix::<f64, N, N>::from_fn(|i, j| a[(i, j)]);
    // Joints without a motor have columns of zeros, which reach nothing.
    let b = SMatrix::<f64, N, M>::from_fn(|i, j| if j < b.ncols() { b[(i, j)] } else { 0.0 });
    let found = poles(&a).ok()?;
    let Stability { verdict, margin, .. } = stability(Time::Continuous, &a).ok()?;
    let reach: Reach<f64, N> = controllability(&a, &b).ok()?;
    let pair = |pole: &dynamics_core::nalgebra::Complex<f64>| [pole.re, pole.im];
    Some(Judgement {
        poles: found.iter().map(pair).collect(),
        verdict,
        margin,
        reached: reach.dimension,
        distance: reach.distance,
        missing: reach.missing().iter().map(pair).collect(),
    })
}
