//! How far single precision is from double, over the whole control loop.

use dynamics_core::control::ComputedTorque;
use dynamics_core::prelude::*;
use firmware_control::robots::Leg;
use firmware_control::trial::{self, LEG, Listener, STEP, STEPS, advanced};

use crate::Result;

/// The largest error of a joint force under one law, over the largest joint force.
///
/// Half an ulp is 6e-8. The torques are the end of some hundred roundings each, and of two hundred steps, each from the
/// state that the one before left; the laws are stable, so that errors do not grow with time. What is measured is an
/// eighth of this at most.
pub(crate) const TOLERANCE: f64 = 2e-5;

/// One law with one robot.
#[derive(Clone, Debug)]
pub(crate) struct Agreement {
    pub(crate) robot: &'static str,
    pub(crate) law: &'static str,
    /// `max |τ₃₂ − τ₆₄| / max |τ₆₄|`
    pub(crate) error: f64,
}

/// Of all trials.
pub(crate) fn agreements() -> Vec<Agreement> {
    let (mut single, mut double) = (Recorder::default(), Recorder::default());
    trial::all::<f32>(&mut single);
    trial::all::<f64>(&mut double);
    let both = single.0.iter().zip(&double.0);
    both.map(|(single, double)| Agreement {
        robot: double.robot,
        law: double.law,
        error: error(&single.tau, &double.tau),
    })
    .collect()
}

/// Of the program `c/control.c`, which prints the bits of its torques, with the same motion in Rust and `f64`.
pub(crate) fn agreement_of_c(printed: &str) -> Result<Agreement> {
    let bits = |word: &str| u32::from_str_radix(word, 16).map_err(|error| format!("`{word}`: {error}"));
    let found = printed.split_whitespace().map(|word| Ok(f64::from(f32::from_bits(bits(word)?))));
    let found: Vec<f64> = found.collect::<Result<_>>()?;

    let pose = LEG.rest::<f64>();
    let law = ComputedTorque::critically_damped(SVector::repeat(20.0));
    let mut state = State::rest(pose.q + SVector::from(LEG.swing.map(f64::from)));
    let mut expected = vec![];
    for _ in 0..STEPS {
        let tau = law.torque(&Leg, &state, &Reference::rest(pose.q));
        state = advanced(&Leg, 0.0, &state, STEP, &tau);
        expected.extend(&tau);
    }
    if found.len() != expected.len() {
        return Err(format!("the program in C prints {} torques, not {}", found.len(), expected.len()));
    }
    Ok(Agreement { robot: "leg", law: "computed torque, in C", error: error(&found, &expected) })
}

/// `max |x − y| / max |y|`; a NaN is larger than any error.
fn error(x: &[f64], y: &[f64]) -> f64 {
    let errors = x.iter().zip(y).map(|(x, y)| (x - y).abs());
    let size = y.iter().fold(0.0, |size: f64, y| size.max(y.abs()));
    errors.fold(0.0, |worst: f64, error| if error <= worst { worst } else { error }) / size
}

#[derive(Debug)]
struct Record {
    robot: &'static str,
    law: &'static str,
    tau: Vec<f64>,
}

#[derive(Debug, Default)]
struct Recorder(Vec<Record>);

impl<T: Copy + Into<f64>> Listener<T> for Recorder {
    fn begin(&mut self, robot: &'static str, law: &'static str) {
        self.0.push(Record { robot, law, tau: vec![] });
    }

    fn step(&mut self, tau: &[T]) {
        if let Some(record) = self.0.last_mut() {
            record.tau.extend(tau.iter().map(|&tau| tau.into()));
        }
    }

    fn end(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_is_within_the_tolerance() {
        for Agreement { robot, law, error } in agreements() {
            eprintln!("{robot}, {law}: {error:.1e}");
            assert!(error <= TOLERANCE, "{robot}, {law}: {error:e}");
        }
    }
}
