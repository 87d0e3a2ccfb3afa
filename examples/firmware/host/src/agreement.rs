//! How far single precision is from double, over the whole control loop.

use firmware_control::trial::{self, Listener};

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
    both.map(|(single, double)| {
        let errors = single.tau.iter().zip(&double.tau).map(|(a, b)| (a - b).abs());
        let size = double.tau.iter().fold(0.0, |size: f64, tau| size.max(tau.abs()));
        // A NaN is larger than any error.
        let error = errors.fold(0.0, |worst: f64, error| if error <= worst { worst } else { error });
        Agreement { robot: double.robot, law: double.law, error: error / size }
    })
    .collect()
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
