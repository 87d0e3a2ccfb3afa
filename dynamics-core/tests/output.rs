//! Outputs and their derivatives, beside dual numbers that go through the nonlinear equations.
#![cfg(feature = "derive")]

use crate::common::dual::Dual;
use crate::common::leaper::{Foot, Leaper, NQ, NU, NV, NX, Thigh, leaper};
use crate::common::{random_numbers, random_vector};
use dynamics_core::output::OperatingPoint;
use dynamics_core::prelude::*;

/// Both roads are exact; this is their rounding, relative to numbers up to a hundred.
const ROUNDING: f64 = 1e-11;

/// Rows of all kinds but displacements of quaternions, which stand for no function.
const NY: usize = 30;

trait Outputs<T: Scalar>: Output<Leaper<T>, T, NQ, NV> {}
impl<T: Scalar, O: Output<Leaper<T>, T, NQ, NV>> Outputs<T> for O {}

fn outputs<T: Scalar>(from: &SMatrix<f64, 3, 3>) -> impl Outputs<T> {
    (
        (output::joint("knee"), output::joint_speed("hip.wy"), output::joint_acceleration("flight.vz")),
        (output::position::<Foot>(), output::orientation::<Foot, T>().from(from.map(T::of))),
        (output::velocity::<Foot>(), output::angular_velocity::<Foot>()),
        (output::velocity::<Thigh>().in_itself(), output::angular_velocity::<Foot>().in_itself()),
        (output::kinetic_energy(), output::potential_energy(), output::total_energy(), output::power()),
        (output::center_of_mass(), output::joint_acceleration(9)),
        output::velocity::<Foot>().z(),
    )
}

fn state(seed: u64) -> (SVector<f64, NQ>, SVector<f64, NV>, SVector<f64, NU>) {
    let mut random = random_numbers(seed);
    let q = leaper::<f64>().integrate(&leaper::<f64>().neutral(), &random_vector(&mut random, 1.5));
    (q, random_vector(&mut random, 2.0), random_vector(&mut random, 5.0))
}

/// `ε` in one direction.
fn unit<const N: usize>(index: usize) -> SVector<Dual, N> {
    SVector::from_fn(|i, _| Dual { value: 0.0, tangent: f64::from(u8::from(i == index)) })
}

fn resting<const N: usize>(x: &SVector<f64, N>) -> SVector<Dual, N> {
    x.map(Dual::of)
}

/// `y(q, v, u)`, by forward dynamics.
fn values(
    q: &SVector<Dual, NQ>,
    v: &SVector<Dual, NV>,
    u: &SVector<Dual, NU>,
    from: &SMatrix<f64, 3, 3>,
) -> SVector<Dual, NY> {
    let robot = leaper::<Dual>();
    let tau = robot.input_map() * u;
    let a = robot.forward_dynamics(q, v, &tau);
    let at = OperatingPoint { q: *q, v: *v, a, tau, tangent_rate: robot.tangent_rate(v) };
    let mut rows = [output::Row::zero(); NY];
    outputs::<Dual>(from).write(&robot, &at, &mut rows).expect("all joints exist");
    SVector::from(rows.map(|row| row.value))
}

#[test]
fn c_and_d_are_the_derivatives_of_the_outputs() {
    let robot = leaper::<f64>();
    for seed in 0..6 {
        let (q, v, u) = state(seed);
        // Some orientation that is not the foot's own.
        let from = robot.pose::<Foot>(&state(seed + 100).0).rotation;
        let model: StateSpace<f64, NX, NU, NY> =
            robot.state_space(&q, &v, &u, &outputs::<f64>(&from)).expect("a good state");
        let (q0, v0, u0) = (resting(&q), resting(&v), resting(&u));
        let dual = leaper::<Dual>();
        let compare = |found: f64, y: &SVector<Dual, NY>, row: usize, what: &str| {
            let (expected, name) = (y[row].tangent, model.outputs[row]);
            let allowed = ROUNDING * expected.abs().max(10.0);
            assert!((found - expected).abs() < allowed, "{name} by {what}: {found} is not {expected}");
        };
        for j in 0..NV {
            let by_q = values(&dual.integrate(&q0, &unit(j)), &v0, &u0, &from);
            let by_v = values(&q0, &(v0 + unit::<NV>(j)), &u0, &from);
            for row in 0..NY {
                compare(model.c[(row, j)], &by_q, row, "q");
                compare(model.c[(row, NV + j)], &by_v, row, "v");
                assert!(
                    (model.offset[row] - by_q[row].value).abs() < ROUNDING * by_q[row].value.abs().max(1.0)
                );
            }
        }
        for j in 0..NU {
            let by_u = values(&q0, &v0, &(u0 + unit::<NU>(j)), &from);
            (0..NY).for_each(|row| compare(model.d[(row, j)], &by_u, row, "u"));
        }
    }
}

/// The rate of `x = (q ⊖ q₀, v)` along the flow, by dual numbers through `⊖` and forward dynamics.
#[test]
fn a_and_b_are_the_derivatives_of_the_motion() {
    let (robot, dual) = (leaper::<f64>(), leaper::<Dual>());
    let (q, v, u) = state(7);
    let model: StateSpace<f64, NX, NU, 0> = robot.state_space(&q, &v, &u, &()).expect("a good state");
    let tau = robot.input_map() * u;
    assert_eq!(model.drift.fixed_rows::<NV>(0), v);
    assert_eq!(model.drift.fixed_rows::<NV>(NV), robot.forward_dynamics(&q, &v, &tau));
    let (q0, v0, tau0) = (resting(&q), resting(&v), resting(&tau));
    for j in 0..NX {
        let q = if j < NV { dual.integrate(&q0, &unit(j)) } else { q0 };
        let v = if j < NV { v0 } else { v0 + unit::<NV>(j - NV) };
        let a = dual.forward_dynamics(&q, &v, &tau0);
        for i in 0..NV {
            let (found, expected) = (model.a[(NV + i, j)], a[i].tangent);
            assert!(
                (found - expected).abs() < ROUNDING * expected.abs().max(10.0),
                "{i} {j}: {found} {expected}"
            );
        }
    }
    assert_eq!(model.a.fixed_view::<NV, NV>(0, NV), SMatrix::<f64, NV, NV>::identity());
    assert_eq!(model.a.fixed_view::<NV, NV>(0, 0), robot.tangent_rate(&v));
}

/// Displacements are what `⊖` says, to first order.
#[test]
fn displacements_are_those_of_the_tangent_space() {
    let robot = leaper::<f64>();
    let (q, v, u) = state(3);
    let measured = (output::displacements(), output::speeds(), output::orientation::<Foot, f64>());
    let model: StateSpace<f64, NX, NU, 23> = robot.state_space(&q, &v, &u, &measured).expect("a good state");
    assert_eq!(model.c.fixed_view::<NX, NX>(0, 0), SMatrix::<f64, NX, NX>::identity());
    assert_eq!(model.offset[9], q[11], "the knee has a coordinate");
    assert_eq!(model.offset.fixed_rows::<9>(0), SVector::<f64, 9>::zeros());
    assert_eq!(model.offset.fixed_rows::<NV>(NV), v);
    let angular = robot.jacobian::<Foot>(&q);
    assert_eq!(model.c.fixed_view::<3, NV>(20, 0), angular.fixed_rows::<3>(3));
}

#[test]
fn names_and_units_are_those_of_the_robot() {
    let (q, v, u) = state(1);
    let measured =
        (output::position::<Foot>().z(), output::joint_acceleration("knee"), output::joint("hip.ry"));
    let model: StateSpace<f64, NX, NU, 3> =
        leaper::<f64>().state_space(&q, &v, &u, &measured).expect("a good state");
    let shown = |signal: &Signal| format!("{signal} {}", signal.unit);
    let states: Vec<String> = model.states.iter().map(shown).collect();
    assert_eq!(states[..3], ["flight.dx m", "flight.dy m", "flight.dz m"]);
    assert_eq!(states[5..10], ["flight.rz rad", "hip.rx rad", "hip.ry rad", "hip.rz rad", "knee rad"]);
    assert_eq!(states[10..11], ["flight.vx m/s"]);
    assert_eq!(states[18..], ["hip.wz rad/s", "knee' rad/s"]);
    let inputs: Vec<String> = model.inputs.iter().map(shown).collect();
    assert_eq!(inputs, ["hip.wx N·m", "hip.wy N·m", "hip.wz N·m", "knee N·m"]);
    let outputs: Vec<String> = model.outputs.iter().map(shown).collect();
    assert_eq!(outputs, ["foot.z m", "knee'' rad/s²", "hip.ry rad"]);
}

#[test]
fn what_cannot_be_is_an_error() {
    let robot = leaper::<f64>();
    let (q, v, u) = state(2);
    let unknown: Result<StateSpace<f64, NX, NU, 1>, _> =
        robot.state_space(&q, &v, &u, &output::joint("ankle"));
    assert_eq!(unknown.err(), Some(Error::NameUnknown { name: "ankle" }));
    let beyond: Result<StateSpace<f64, NX, NU, 1>, _> =
        robot.state_space(&q, &v, &u, &output::joint_speed(10));
    assert_eq!(beyond.err(), Some(Error::IndexTooLarge { index: 10, count: 10 }));
    let (mut nan, mut long) = (v, q);
    nan[4] = f64::NAN;
    long[3] += 1.0;
    let model = |q, v| -> Result<StateSpace<f64, NX, NU, 0>, Error> { robot.state_space(q, v, &u, &()) };
    assert_eq!(model(&q, &nan).err(), Some(Error::NotFinite { vector: "v", index: 4 }));
    assert_eq!(model(&long, &v).err(), Some(Error::NotUnitQuaternion { index: 3 }));
    assert_eq!(model(&q, &(v * 1e200)).err(), Some(Error::NotFinite { vector: "a", index: 0 }));
}
