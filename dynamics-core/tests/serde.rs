//! What is written by `serde` is read back, and looks as the documentation of the features says.

#![allow(missing_docs, reason = "the robot is named by its joints")]

use std::fmt::Debug;

use dynamics_core::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn goes_and_returns<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> String {
    let text = serde_json::to_string(value).expect("values are finite");
    let back: T = serde_json::from_str(&text).expect("what was written can be read");
    assert_eq!(back, *value, "{text}");
    text
}

#[derive(Dynamics)]
#[joint(shoulder: revolute(y), world -> upper)]
#[body(upper, solid = rod(2, 0.5, z), com = [0, 0, 0.25])]
#[joint(elbow: revolute(y), upper -> lower, at = [0, 0, 0.5], limits = [-2, 2], velocity = 3, effort = 40)]
#[body(lower, solid = rod(1, 0.4, z), com = [0, 0, 0.2])]
struct Arm;

#[test]
fn results_return_to_the_last_bit() {
    let (q, v, tau) =
        (SVector::from([0.1, 0.7]), SVector::from([1.0 / 3.0, -2.0]), SVector::from([3.0, 0.5]));
    let state = State::new(q, v);
    assert_eq!(goes_and_returns(&state), r#"{"q":[0.1,0.7],"v":[0.3333333333333333,-2.0]}"#);
    goes_and_returns(&State::new(q.map(|x: f64| x as f32), v.map(|x: f64| x as f32)));
    goes_and_returns(&Arm.equations_of_motion(&q, &v));
    goes_and_returns(&Arm.inverse_dynamics_derivatives(&q, &v, &tau));
    goes_and_returns(&Arm.forward_dynamics_derivatives(&q, &v, &tau));
    goes_and_returns(&Arm.linearize(&q, &v, &tau));
    goes_and_returns(&Arm.pose::<Lower>(&q));
    goes_and_returns(&Energy { kinetic: 1.5, potential: -0.1, elastic: 0.0 });
    goes_and_returns(&Arm::COST);
    goes_and_returns(&Arm::LIMITS[1]);
}

#[test]
fn matrices_are_written_by_columns() {
    let derivatives = ForwardDynamicsDerivatives {
        da_dq: SMatrix::from([[1.0, 2.0], [3.0, 4.0]]),
        da_dv: SMatrix::zeros(),
        da_dtau: SMatrix::zeros(),
    };
    let text = goes_and_returns(&derivatives);
    assert!(text.starts_with(r#"{"da_dq":[1.0,2.0,3.0,4.0],"#), "{text}");
}

#[test]
fn errors_are_written() {
    let text = serde_json::to_string(&Error::NotFinite { vector: "q", index: 3 }).expect("an error is plain");
    assert_eq!(text, r#"{"NotFinite":{"vector":"q","index":3}}"#);
}
