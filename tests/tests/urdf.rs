//! Robots from their files: compiled by the derive, they give the numbers of Pinocchio.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::close::{DERIVATIVES, ROUNDING};
use dynamics_tests::reference::{Reference, ReferenceState};
use dynamics_tests::{Matrix, Vector, assert_close};

/// The PUMA 560, whose published first and third links no body can have.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/puma560/model.urdf", allow(nonphysical_inertia))]
struct Puma560;

/// The KUKA LBR iiwa 14.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/iiwa14/model.urdf")]
struct Iiwa14;

/// The Adept Cobra 600.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/scara/model.urdf")]
struct Scara;

/// A pole on a cart, whose root is the world itself.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/cartpole/model.urdf")]
struct CartPole;

/// Two links in a plane.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/double_pendulum/model.urdf")]
struct DoublePendulum;

/// The same with joints that turn without end.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/double_pendulum_continuous/model.urdf")]
struct DoublePendulumContinuous;

/// A robot's coordinates and those of its reference, which are in another order.
struct Order(Vec<usize>);

impl Order {
    fn of(names: &[&str], reference: &Reference) -> Self {
        let place = |name: &&str| reference.joint_names.iter().position(|known| known == *name);
        let order: Vec<usize> = names.iter().map(|name| place(name).expect("the joint is known")).collect();
        assert_eq!(order.len(), reference.joint_names.len());
        Self(order)
    }

    fn vector<const N: usize>(&self, vector: &Vector) -> SVector<f64, N> {
        SVector::from_fn(|i, _| vector[self.0[i]])
    }

    fn matrix(&self, matrix: &Matrix) -> Matrix {
        Matrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(self.0[i], self.0[j])])
    }
}

fn agrees<R, const N: usize>(robot: &R, name: &str)
where
    R: Mechanism + DynamicsDerivatives<f64, N, N>,
{
    let reference = Reference::of(name);
    let order = Order::of(R::JOINT_NAMES, &reference);
    let mut offsets = vec![];
    for state in &reference.states {
        state_agrees::<R, N>(robot, name, &order, state);
        let q = order.vector(&state.vector("q"));
        offsets.push(robot.potential_energy(&q) - state.number("potential_energy"));
    }
    let size = reference
        .states
        .iter()
        .fold(1.0, |size: f64, state| size.max(state.number("potential_energy").abs()));
    assert!(offsets.iter().all(|offset| (offset - offsets[0]).abs() <= ROUNDING * size), "{name}: V");
}

fn state_agrees<R, const N: usize>(robot: &R, name: &str, order: &Order, state: &ReferenceState)
where
    R: DynamicsDerivatives<f64, N, N>,
{
    let vector = |name: &str| order.vector::<N>(&state.vector(name));
    let matrix = |name: &str| order.matrix(&state.matrix(name));
    let [q, v, a, tau] = ["q", "v", "a", "tau2"].map(vector);
    let (M, inverse) = (matrix("M"), matrix("Minv"));
    assert_close!(robot.mass_matrix(&q).as_slice(), M.as_slice(), ROUNDING, "{name}: M");
    assert_close!(robot.coriolis_matrix(&q, &v).as_slice(), matrix("C").as_slice(), ROUNDING, "{name}: C");
    assert_close!(robot.gravity_forces(&q).as_slice(), vector("g").as_slice(), ROUNDING, "{name}: G");
    let found = robot.inverse_dynamics(&q, &v, &a);
    assert_close!(found.as_slice(), vector("tau").as_slice(), ROUNDING, "{name}: τ");
    let solved = ROUNDING.max(M.amax() * inverse.amax() * N as f64 * f64::EPSILON);
    let found = robot.forward_dynamics(&q, &v, &tau);
    assert_close!(found.as_slice(), vector("a_fd").as_slice(), solved, "{name}: a");
    assert_close!([robot.kinetic_energy(&q, &v)], [state.number("kinetic_energy")], ROUNDING, "{name}: T");

    // At rest some blocks are zero: what counts as such is less than the forces for a unit of acceleration.
    let close = |found: &SMatrix<f64, N, N>, expected: &str, floor: f64| {
        assert_close!(
            found.as_slice(),
            matrix(expected).as_slice(),
            DERIVATIVES,
            floor = floor,
            "{name}: {expected}"
        );
    };
    let inverse_dynamics = robot.inverse_dynamics_derivatives(&q, &v, &a);
    close(&inverse_dynamics.dtau_dq, "dtau_dq", M.amax());
    close(&inverse_dynamics.dtau_dv, "dtau_dv", M.amax());
    close(&inverse_dynamics.dtau_da, "M", 0.0);
    let forward_dynamics = robot.forward_dynamics_derivatives(&q, &v, &tau);
    let acceleration = inverse.amax() * M.amax();
    close(&forward_dynamics.da_dq, "da_dq", acceleration);
    close(&forward_dynamics.da_dv, "da_dv", acceleration);
    close(&forward_dynamics.da_dtau, "Minv", 0.0);
}

#[test]
fn puma560_agrees() {
    agrees(&Puma560, "puma560");
}

#[test]
fn iiwa14_agrees() {
    agrees(&Iiwa14, "iiwa14");
}

#[test]
fn scara_agrees() {
    agrees(&Scara, "scara");
}

#[test]
fn cart_pole_agrees() {
    agrees(&CartPole, "cartpole");
}

#[test]
fn double_pendulums_agree() {
    agrees(&DoublePendulum, "double_pendulum");
    agrees(&DoublePendulumContinuous, "double_pendulum_continuous");
}

/// Every link is a frame, the root and bare ones too.
#[test]
fn links_are_frames() {
    assert_eq!(Iiwa14::BODY_NAMES.len(), 10, "{:?}", Iiwa14::BODY_NAMES);
    let reference = Reference::of("iiwa14");
    let order = Order::of(Iiwa14::JOINT_NAMES, &reference);
    for state in &reference.states {
        let pose = Iiwa14.pose::<IiwaLinkEe>(&order.vector(&state.vector("q")));
        let (R, p) = state.tool_pose();
        assert_close!(pose.rotation.as_slice(), R.as_slice(), ROUNDING, "rotation");
        assert_close!(pose.translation.as_slice(), p.as_slice(), ROUNDING, "translation");
    }
    let limits = Iiwa14::LIMITS[0];
    assert!(limits.lower < -2.9 && limits.upper > 2.9 && limits.effort > 0.0);
}

mod payload {
    //! What is said of a robot beside its file.
    use dynamics_core::prelude::*;

    /// The arm with something in its hand, and gravity that can be chosen.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/iiwa14/model.urdf", gravity = [0, 0, -g])]
    #[joint(grip: fixed, iiwa_link_ee -> payload, at = [0, 0, reach])]
    #[body(payload, solid = point(mass))]
    struct Loaded<T> {
        mass: T,
        reach: T,
        g: T,
    }

    /// The arm, whose last link is described anew.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/iiwa14/model.urdf")]
    #[body(iiwa_link_ee, mass = mass, com = [0, 0, reach], inertia = diag(0, 0, 0))]
    struct Tooled {
        mass: f64,
        reach: f64,
    }

    #[test]
    fn a_payload_is_a_field() {
        let q = SVector::from([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        let empty = Loaded { mass: 0.0, reach: 0.3, g: 9.81 }.gravity_forces(&q);
        let bare = super::Iiwa14.gravity_forces(&q);
        assert!((empty - bare).amax() < 1e-12);
        let loaded = Loaded { mass: 2.0, reach: 0.3, g: 9.81 }.gravity_forces(&q);
        let tooled = Tooled { mass: 2.0, reach: 0.3 }.gravity_forces(&q);
        assert!((loaded - tooled).amax() < 1e-12, "{loaded} {tooled}");
        assert!((loaded - bare).amax() > 1.0);
    }
}
