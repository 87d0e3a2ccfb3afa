//! Motions as other programs compute them: SciPy, MuJoCo, the crate `differential-equations`.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use dynamics_core::prelude::*;
use dynamics_core::simulate::Trajectory;
use serde_json::Value;

#[derive(Dynamics)]
#[dynamics(urdf = "robots/double_pendulum/model.urdf")]
struct DoublePendulum;

#[derive(Dynamics)]
#[dynamics(urdf = "robots/iiwa14/model.urdf")]
struct Iiwa14;

/// The body of `robots/trajectories.py`.
#[derive(Dynamics)]
#[joint(flight: free, world -> body)]
#[body(body, mass = 1.5, com = [0.1, -0.05, 0.2], inertia = tensor(0.04, 0.005, -0.003, 0.05, 0.004, 0.06))]
struct FreeBox;

/// `robots/<name>/trajectory.json`
fn reference(name: &str) -> Value {
    let path = format!("{}/robots/{name}/trajectory.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().expect("a list");
    list.iter().map(|number| number.as_f64().expect("a number")).collect()
}

fn state<const NQ: usize, const NV: usize>(entry: &Value) -> State<f64, NQ, NV> {
    let [q, v] = ["q", "v"].map(|name| numbers(&entry[name]));
    State::new(SVector::from_row_slice(&q), SVector::from_row_slice(&v))
}

/// The greatest difference of a coordinate or speed from those of a program, quaternions by the angle between.
fn apart<R, const NQ: usize, const NV: usize>(
    robot: &R,
    reference: &Value,
    program: &str,
    motion: &Trajectory<'_, R, f64, NQ, NV>,
) -> f64
where
    R: Configuration<f64, NQ, NV>,
{
    let times = numbers(&reference["times"]);
    let states = reference[program]["states"].as_array().expect("a list");
    assert!(times.len() == states.len() && times.len() >= 3);
    let off = |(time, entry): (&f64, &Value)| {
        let (found, expected) = (motion.at(*time).expect("within"), state::<NQ, NV>(entry));
        robot.difference(&expected.q, &found.q).amax().max((found.v - expected.v).amax())
    };
    times.iter().zip(states).map(off).fold(0.0, f64::max)
}

/// What steps within 1e-13 of speeds of 30 rad/s come to, of SciPy's and of ours, in motions that grow errors.
const SCIPY: f64 = 1e-9;
/// The error of MuJoCo's Runge and Kutta at 1/16384 s is no larger.
const MUJOCO: f64 = 1e-9;
/// The method of order 2 at 1/8192 s, where an arm whips at 300 rad/s²: a quarter of it at half the step.
const VARIATIONAL: f64 = 1e-3;

fn agrees<R, const NQ: usize, const NV: usize>(name: &str, robot: &R)
where
    R: Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    let reference = reference(name);
    let start = state::<NQ, NV>(&reference["start"]);
    let end = *numbers(&reference["times"]).last().expect("times");
    let adaptive = Adaptive::new(robot, start, Tolerances::of(1e-13)).expect("valid");
    let steps = (end * 8192.0).round() as usize;
    let fixed = Simulation::new(robot, start, 1.0 / 8192.0).expect("valid");
    let coarse = fixed.clone().with_integrator(Variational).record(steps).expect("its steps are solved");
    let motions = [
        ({ adaptive }.record(end).expect("finite"), [SCIPY, MUJOCO]),
        ({ fixed }.record(steps).expect("finite"), [5.0 * SCIPY, 5.0 * MUJOCO]),
        (coarse, [VARIATIONAL; 2]),
    ];
    for (k, (motion, bounds)) in motions.iter().enumerate() {
        for (program, bound) in ["scipy", "mujoco"].into_iter().zip(bounds) {
            let found = apart(robot, &reference, program, motion);
            assert!(found < *bound, "{name}: motion {k} is {found:.1e} from that of {program}");
        }
    }
}

#[test]
fn a_double_pendulum_swings_as_scipy_and_mujoco_say() {
    agrees("double_pendulum", &DoublePendulum);
}

#[test]
fn an_arm_falls_as_scipy_and_mujoco_say() {
    agrees("iiwa14", &Iiwa14);
}

#[test]
fn a_box_flies_as_scipy_and_mujoco_say() {
    agrees("free_box", &FreeBox);
}

/// The same equations, given to another implementation of the same method and of a better one.
struct Swing;

impl ODE<f64, [f64; 4]> for Swing {
    fn diff(&self, _time: f64, x: &[f64; 4], rate: &mut [f64; 4]) {
        let [q0, q1, v0, v1] = *x;
        let (q, v) = (SVector::from([q0, q1]), SVector::from([v0, v1]));
        let a = DoublePendulum.forward_dynamics(&q, &v, &SVector::zeros());
        *rate = [v0, v1, a[0], a[1]];
    }
}

const START: [f64; 4] = [0.4, -0.3, 1.0, -2.0];

#[test]
fn another_crate_solves_the_same_equations_alike() {
    let start = State::new(SVector::from([0.4, -0.3]), SVector::from([1.0, -2.0]));
    let exact = {
        let method = ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13);
        let solved = IVP::ode(&Swing, 0.0, 1.0, START).method(method).solve().expect("it is solved");
        *solved.y.last().expect("there are steps")
    };
    let end = |tolerance: f64| {
        let mut adaptive = Adaptive::new(&DoublePendulum, start, Tolerances::of(tolerance)).expect("valid");
        let steps = adaptive.steps(1.0).inspect(|sample| assert!(sample.is_ok())).count();
        let State { q, v } = *adaptive.state();
        let found = [q[0], q[1], v[0], v[1]];
        (found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max), steps)
    };
    let (error, _) = end(1e-13);
    assert!(error < SCIPY, "{error:e}");
    // Its steps at a looser tolerance are about as many: it is the same method with another controller and norm.
    let (error, steps) = end(1e-8);
    let method = ExplicitRungeKutta::dopri5().rtol(1e-8).atol(1e-8);
    let theirs = IVP::ode(&Swing, 0.0, 1.0, START).method(method).solve().expect("it is solved");
    let last = theirs.y.last().expect("there are steps");
    let their_error = last.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error < 1e-5 && their_error < 1e-5, "{error:e} and theirs {their_error:e}");
    let ratio = steps as f64 / theirs.t.len() as f64;
    assert!((0.4..2.5).contains(&ratio), "{steps} steps, and theirs {}", theirs.t.len());
}
