//! How a robot moves on from a state: the run time's way, for robots whose size is not known to Rust.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::{Motion, Tree};
use dynamics_core::__private::{integrate_ball, integrate_free};

use crate::failure::Failure;
use crate::robot::{Robot, State};

/// `q ⊕ δ`, as `Configuration::integrate`: where `q` gets to under the constant velocity `δ` in one unit of time.
fn integrate(tree: &Tree<f64>, q: &[f64], delta: &[f64]) -> Vec<f64> {
    let mut moved = q.to_vec();
    for link in &tree.links {
        let (at, from) = (link.drive.q, link.drive.v);
        match link.motion {
            // Several links may share a coordinate.
            Motion::Revolute | Motion::Prismatic => moved[at] = q[at] + delta[from],
            Motion::Ball => {
                let ball = integrate_ball(part::<4>(q, at), part::<3>(delta, from));
                moved[at..at + 4].copy_from_slice(&ball);
            }
            Motion::Free => {
                let free = integrate_free(part::<7>(q, at), part::<6>(delta, from));
                moved[at..at + 7].copy_from_slice(&free);
            }
        }
    }
    moved
}

fn part<const N: usize>(x: &[f64], from: usize) -> [f64; N] {
    std::array::from_fn(|k| x[from + k])
}

/// The state after a step `h`, in s, by `dynamics_core`'s `Rk4`: the classical method of Runge and Kutta, with two `⊕`
/// where on a manifold one would lose order (Celledoni, Marthinsen, Owren 2003).
pub(crate) fn stepped(robot: &Robot<'_>, state: &State, h: f64) -> Result<State, Failure> {
    let along = |q: &[f64], delta: &[f64]| integrate(&robot.tree, q, delta);
    let at = |q: Vec<f64>, v: &[f64]| State { q, v: v.to_vec(), ..state.clone() };
    let acceleration = |state: &State| robot.evaluate(Method::ForwardDynamics, state);
    let State { q, v: v1, .. } = state;

    let a1 = acceleration(state)?;
    let v2 = sum(&[(1.0, v1), (0.5 * h, &a1)]);
    let q2 = along(q, &sum(&[(0.5 * h, v1)]));
    let a2 = acceleration(&at(q2.clone(), &v2))?;
    let v3 = sum(&[(1.0, v1), (0.5 * h, &a2)]);
    let a3 = acceleration(&at(along(q, &sum(&[(0.5 * h, &v2)])), &v3))?;
    let v4 = sum(&[(1.0, v1), (h, &a3)]);
    let a4 = acceleration(&at(along(&q2, &sum(&[(h, &v3), (-0.5 * h, v1)])), &v4))?;

    let [one, two, three] = [1.0, 2.0, 3.0].map(|k| k * h / 12.0);
    let first = sum(&[(three, v1), (two, &v2), (two, &v3), (-one, &v4)]);
    let second = sum(&[(three, &v4), (two, &v2), (two, &v3), (-one, v1)]);
    let q = along(&along(q, &first), &second);
    let [one, two] = [h / 6.0, h / 3.0];
    Ok(at(q, &sum(&[(1.0, v1), (one, &a1), (two, &a2), (two, &a3), (one, &a4)])))
}

/// The sum of vectors, each times its factor.
fn sum(terms: &[(f64, &Vec<f64>)]) -> Vec<f64> {
    let length = terms.first().map_or(0, |(_, x)| x.len());
    (0..length).map(|k| terms.iter().map(|(factor, x)| factor * x[k]).sum()).collect()
}
