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

mod joints {
    //! What is said of a file's joints: compared with the equations of the robot as the file has it.
    use dynamics_core::prelude::*;

    use super::DoublePendulum;

    /// Two roads in doubles.
    const ROUNDING: f64 = 1e-14;

    /// The second link is held at an angle.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint2, locked = angle)]
    struct Locked {
        angle: f64,
    }

    /// The second joint follows the first one.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint2, mimic = joint1, ratio = ratio, offset = 0.1)]
    struct Coupled {
        ratio: f64,
    }

    /// A motor, a damper and a spring.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint1, rotor = 1e-5, gear = 50, damping = d, actuated = off)]
    #[joint(joint2, stiffness = 3, rest = 0.2, friction = 0.5, friction_speed = 0.1)]
    struct Resisted<T> {
        d: T,
    }

    /// Nothing holds it.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", base = free, outputs(mass_matrix, gravity_forces))]
    struct Floating;

    #[test]
    fn a_lock_takes_a_row_and_a_column() {
        let (locked, q, v) = (Locked { angle: 0.7 }, [0.3, 0.7], [1.1, 0.0]);
        let [M, h] = of_file(q, v);
        let found = locked.mass_matrix(&SVector::from([q[0]]))[(0, 0)];
        assert!((found - M[0]).abs() < ROUNDING, "{found} {M:?}");
        let found = locked.bias_forces(&SVector::from([q[0]]), &SVector::from([v[0]]))[0];
        assert!((found - h[0]).abs() < ROUNDING, "{found} {h:?}");
        assert_eq!((Locked::NV, Locked::JOINT_NAMES), (1, &["joint1"][..]));
    }

    /// `WᵀMW` and `Wᵀh` of the columns that move together: `Ẇ` is zero.
    #[test]
    fn a_follower_adds_to_its_leader() {
        let (ratio, q, v) = (-0.5, 0.3, 1.1);
        let [M, h] = of_file([q, ratio * q + 0.1], [v, ratio * v]);
        let coupled = Coupled { ratio };
        let found = coupled.mass_matrix(&SVector::from([q]))[(0, 0)];
        let expected = M[0] + ratio * (M[1] + M[2]) + ratio * ratio * M[3];
        assert!((found - expected).abs() < ROUNDING, "{found} {expected}");
        let found = coupled.bias_forces(&SVector::from([q]), &SVector::from([v]))[0];
        let expected = h[0] + ratio * h[1];
        assert!((found - expected).abs() < ROUNDING, "{found} {expected}");
    }

    #[test]
    fn what_resists_is_added_to_the_bias() {
        let (q, v) = ([0.3, -0.4], [1.1, 0.2]);
        let [M, h] = of_file(q, v);
        let resisted = Resisted { d: 0.8 };
        let found = resisted.mass_matrix(&SVector::from(q));
        let rotor = 1e-5 * 50.0 * 50.0;
        assert!((found[(0, 0)] - M[0] - rotor).abs() < ROUNDING && (found[(1, 1)] - M[3]).abs() < ROUNDING);
        let found = resisted.bias_forces(&SVector::from(q), &SVector::from(v));
        let friction = 0.5 * v[1] / f64::hypot(v[1], 0.1);
        let passive = [0.8 * v[0], friction + 3.0 * (q[1] - 0.2)];
        for k in 0..2 {
            assert!((found[k] - h[k] - passive[k]).abs() < ROUNDING, "{k}: {found} {h:?}");
        }
        assert_eq!((Resisted::<f64>::NU, Resisted::<f64>::NV), (1, 2));
    }

    #[test]
    fn a_free_base_carries_what_stood_on_the_world() {
        let upright = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.3, -0.4];
        let [M, _] = of_file([0.3, -0.4], [0.0; 2]);
        let found = Floating.mass_matrix(&SVector::from(upright));
        for (k, expected) in M.iter().enumerate() {
            let (row, column) = (6 + k / 2, 6 + k % 2);
            assert!((found[(row, column)] - expected).abs() < ROUNDING, "{row} {column}: {found}");
        }
        let weight = Floating.gravity_forces(&SVector::from(upright))[2];
        assert!((weight - 9.81 * found[(0, 0)]).abs() < 10.0 * ROUNDING, "{weight} {found}");
        assert_eq!((Floating::NQ, Floating::NV, Floating::NU), (9, 8, 2));
        assert_eq!(Floating::JOINT_NAMES, ["root_joint", "joint1", "joint2"]);
    }

    /// M by rows, and `C·v + G`, of the pendulum as the file has it.
    fn of_file(q: [f64; 2], v: [f64; 2]) -> [Vec<f64>; 2] {
        let (q, v) = (SVector::from(q), SVector::from(v));
        let M = DoublePendulum.mass_matrix(&q);
        [
            vec![M[(0, 0)], M[(0, 1)], M[(1, 0)], M[(1, 1)]],
            DoublePendulum.bias_forces(&q, &v).as_slice().to_vec(),
        ]
    }
}
