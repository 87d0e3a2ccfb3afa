//! Linear models beside numbers of 50 digits, and beside the errors of SciPy and slycot.
//!
//! `linear/generate.py` writes `linear/reference.json`, with versions and seed.
#![allow(clippy::print_stdout, reason = "`--nocapture` shows the errors beside those of the libraries")]

use dynamics_core::linear::{
    Hold, LinearError, Time, Weights, controllability, kalman, lqr, place_poles, poles, zero_order_hold,
};
use dynamics_core::nalgebra::{Complex, RowSVector};
use dynamics_core::prelude::*;
use serde_json::Value;

/// So many times the error of the better of both libraries, and of what rounding leaves of the size, are ours.
///
/// Errors of one problem scatter by some units between algorithms that are equally sound.
const AS_GOOD_AS: f64 = 8.0;

fn reference() -> Value {
    let text = include_str!("linear/reference.json");
    serde_json::from_str(text).expect("the file is JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn matrix<const R: usize, const C: usize>(value: &Value) -> SMatrix<f64, R, C> {
    let rows: Vec<_> = value.as_array().expect("rows").iter().map(numbers).collect();
    SMatrix::from_fn(|i, j| rows[i][j])
}

fn upper<const N: usize>(value: &Value) -> SMatrix<f64, N, N> {
    let mut entries = numbers(value).into_iter();
    let mut p = SMatrix::zeros();
    for (i, j) in (0..N).flat_map(|i| (i..N).map(move |j| (i, j))) {
        p[(i, j)] = entries.next().expect("a triangle");
        p[(j, i)] = p[(i, j)];
    }
    p
}

fn complex(value: &Value) -> Vec<Complex<f64>> {
    let pair = |value: &Value| Complex::new(numbers(value)[0], numbers(value)[1]);
    value.as_array().expect("a list").iter().map(pair).collect()
}

/// The largest difference in units in which states are of size 1, relative to the largest entry there.
fn error<const R: usize, const C: usize>(
    found: &SMatrix<f64, R, C>,
    exact: &SMatrix<f64, R, C>,
    unit: impl Fn(usize, usize) -> f64,
) -> f64 {
    let scaled = |m: &SMatrix<f64, R, C>| SMatrix::<f64, R, C>::from_fn(|i, j| m[(i, j)] * unit(i, j)).amax();
    scaled(&(found - exact)) / scaled(exact)
}

/// A model of the file.
struct Case<const N: usize, const M: usize> {
    value: Value,
    a: SMatrix<f64, N, N>,
    b: SMatrix<f64, N, M>,
    weights: Weights<f64, N, M>,
    units: Vec<f64>,
    step: f64,
}

impl<const N: usize, const M: usize> Case<N, M> {
    fn new(value: &Value) -> Self {
        Self {
            a: matrix(&value["a"]),
            b: matrix(&value["b"]),
            weights: Weights::new(matrix(&value["q"]), matrix(&value["r"])),
            units: numbers(&value["units"]),
            step: value["step"].as_f64().expect("a step"),
            value: value.clone(),
        }
    }

    /// Holds: a few rounding errors of the size, times what the exponential is conditioned by: `1 + h·‖A‖`, a small number.
    fn holds_are_exact(&self) {
        const ROUNDING: f64 = 4e-15;
        let units = &self.units;
        let (phi, gamma) = zero_order_hold(&self.a, &self.b, self.step).expect("the step is good");
        let of_states = |i: usize, j: usize| units[j] / units[i];
        let of_inputs = |i: usize, _: usize| 1.0 / units[i];
        let error_phi = error(&phi, &matrix(&self.value["phi"]), of_states);
        let error_gamma = error(&gamma, &matrix(&self.value["gamma"]), of_inputs);
        let model =
            StateSpace::from_matrices(self.a, self.b, SMatrix::<f64, N, N>::identity(), SMatrix::zeros());
        let triangle = model.discretize(Hold::First, self.step).expect("the step is good");
        let error_triangle = error(&triangle.b, &matrix(&self.value["triangle"]), of_inputs);
        let theirs = [&self.value["phi_scipy"], &self.value["gamma_scipy"]];
        println!("{N}x{M} holds {error_phi:.1e} {error_gamma:.1e} {error_triangle:.1e}, SciPy {theirs:?}");
        assert!(error_phi < ROUNDING && error_gamma < ROUNDING && error_triangle < ROUNDING);
        let sampled = model.discretize(Hold::Zero, self.step).expect("the step is good");
        let back = sampled.to_continuous(Hold::Zero).expect("its poles are near 1");
        // Rounding of Φ is some ε of 1, and the rates are Φ − 1 over the step.
        let size = SMatrix::<f64, N, N>::from_fn(|i, j| self.a[(i, j)] * of_states(i, j)).amax();
        assert!(error(&back.a, &self.a, of_states) < 1e-13 * (1.0 + 1.0 / (self.step * size)));
    }

    fn poles_are_exact(&self) {
        let ours = poles(&self.a).expect("it converges");
        let size = ours.iter().fold(0.0_f64, |size, pole| size.max(pole.norm()));
        for exact in complex(&self.value["poles"]) {
            let distance = ours.iter().map(|pole| (pole - exact).norm()).fold(f64::MAX, f64::min);
            // No two of these poles are closer than a hundredth of the largest.
            assert!(distance < 1e-12 * size, "{N}x{M}: {exact} is missed by {distance:e}");
        }
    }

    /// P beside 50 digits: no worse than SciPy and slycot, both of which are sound, are on the same problem.
    fn riccati_is_as_good(&self, time: Time) {
        let (key, a, b) = match time {
            Time::Continuous => ("continuous", self.a, self.b),
            Time::Discrete => ("discrete", SMatrix::identity() + self.a * self.step, self.b * self.step),
        };
        let value = &self.value[key];
        let exact: SMatrix<f64, N, N> = upper(&value["p"]);
        let found = lqr(time, &a, &b, &self.weights).expect("it is stabilisable");
        let ours = error(&found.cost, &exact, |i, j| 1.0 / (exact[(i, i)] * exact[(j, j)]).sqrt());
        let theirs = [&value["scipy"], &value["slycot"]].map(|error| error.as_f64().unwrap_or(f64::INFINITY));
        println!("{N}x{M} {time:?}: {ours:.1e}, SciPy {:.1e}, slycot {:.1e}", theirs[0], theirs[1]);
        let rounding = 10.0 * N as f64 * f64::EPSILON;
        assert!(ours < AS_GOOD_AS * theirs[0].min(theirs[1]).max(rounding), "{N}x{M} {time:?}: {ours:e}");
        let gain: SMatrix<f64, M, N> = matrix(&value["k"]);
        let units = &self.units;
        let error_gain = error(&found.gain, &gain, |_, j| units[j]);
        assert!(error_gain < 1e3 * ours.max(rounding), "{N}x{M} {time:?}: gain {error_gain:e}");
        let dual = kalman(time, &a.transpose(), &b.transpose(), &self.weights).expect("it is detectable");
        assert_eq!(dual.covariance, found.cost);
    }

    fn holds(value: &Value) {
        let case = Self::new(value);
        case.holds_are_exact();
        case.poles_are_exact();
        case.riccati_is_as_good(Time::Continuous);
        case.riccati_is_as_good(Time::Discrete);
    }
}

#[test]
fn models_are_those_of_fifty_digits() {
    for value in reference()["models"].as_array().expect("models") {
        let shape = (numbers(&value["units"]).len(), numbers(&value["b"][0]).len());
        match shape {
            (1, 1) => Case::<1, 1>::holds(value),
            (2, 1) => Case::<2, 1>::holds(value),
            (3, 2) => Case::<3, 2>::holds(value),
            (4, 1) => Case::<4, 1>::holds(value),
            (4, 2) => Case::<4, 2>::holds(value),
            (6, 1) => Case::<6, 1>::holds(value),
            (6, 2) => Case::<6, 2>::holds(value),
            (8, 3) => Case::<8, 3>::holds(value),
            (12, 1) => Case::<12, 1>::holds(value),
            (12, 3) => Case::<12, 3>::holds(value),
            _ => panic!("no such shape: {shape:?}"),
        }
    }
}

/// Gains for desired poles, beside Ackermann's formula in 50 digits and SciPy's robust placement.
fn placed<const N: usize>(value: &Value) {
    let Case::<N, 1> { a, b, units, .. } = Case::new(value);
    let placed = &value["placed"];
    let desired = complex(&placed["desired"]).try_into().expect("as many as states");
    let found = place_poles(&a, &b, &desired).expect("it is controllable");
    let exact = RowSVector::<f64, N>::from_fn(|_, j| numbers(&placed["k"])[j]);
    let ours = error(&found.gain, &exact, |_, j| units[j]);
    let theirs = placed["scipy"].as_f64().expect("a number");
    println!("{N}: gain {ours:.1e}, SciPy {theirs:.1e}");
    assert!(ours < AS_GOOD_AS * theirs.max(10.0 * N as f64 * f64::EPSILON), "{N}: {ours:e}");
}

#[test]
fn gains_are_those_of_fifty_digits() {
    for value in
        reference()["models"].as_array().expect("models").iter().filter(|model| !model["placed"].is_null())
    {
        match numbers(&value["units"]).len() {
            1 => placed::<1>(value),
            2 => placed::<2>(value),
            4 => placed::<4>(value),
            6 => placed::<6>(value),
            12 => placed::<12>(value),
            states => panic!("no such shape: {states}"),
        }
    }
}

#[test]
fn modes_out_of_reach_are_those_that_slycot_counts() {
    for value in reference()["pairs"].as_array().expect("pairs") {
        let (a, b): (SMatrix<f64, 6, 6>, SMatrix<f64, 6, 2>) = (matrix(&value["a"]), matrix(&value["b"]));
        let reach = controllability(&a, &b).expect("it converges");
        let count = Some(reach.dimension as u64);
        assert_eq!((value["reached"].as_u64(), value["slycot"].as_u64()), (count, count));
    }
}

#[test]
fn single_precision_is_as_good_as_it_can_be() {
    let model = &reference()["models"][4];
    let Case::<6, 2> { a, b, weights, .. } = Case::new(model);
    let single = |m: &SMatrix<f64, 6, 6>| m.map(|x| x as f32);
    let narrow = Weights::new(single(&weights.q), weights.r.map(|x| x as f32));
    let found =
        lqr(Time::Continuous, &single(&a), &b.map(|x| x as f32), &narrow).expect("it is stabilisable");
    let exact: SMatrix<f64, 6, 6> = upper(&model["continuous"]["p"]);
    let unit = |i: usize, j: usize| 1.0 / (exact[(i, i)] * exact[(j, j)]).sqrt();
    let error = error(&found.cost.map(f64::from), &exact, unit);
    // What double precision loses here, in single precision: both err by about a hundred of their ε.
    println!("single precision: {error:.1e}");
    assert!(error < 500.0 * f64::from(f32::EPSILON), "{error:e}");
}

#[test]
fn errors_are_values() {
    let a = SMatrix::<f64, 2, 2>::identity();
    let none = SMatrix::<f64, 2, 1>::zeros();
    let error =
        lqr(Time::Continuous, &a, &none, &Weights::diagonal([1.0; 2], [1.0])).expect_err("it cannot be held");
    assert_eq!(error, LinearError::NotStabilizable { pole: (1.0, 0.0) });
    let message = "the mode of the pole 1.0000 does not decay, and no input reaches it; add an input, or leave the mode out \
                   of the model";
    assert_eq!(error.to_string(), message);
}
