//! How far every output is from the truth: the derived Rust and the plain recursion, in double and in single precision,
//! against the plain recursion in some thirty digits.
//!
//! The reference has the robot's numbers as exactly as the compiler has them, and fields and state as the bits that are
//! given: rounding the robot's numbers counts as an error, rounding the state does not. Of quaternions, which are not
//! quite of unit length when they are rounded, it takes the direction: what the missing length does counts as well.

mod derived;
mod format;
mod plain;

pub use format::{Format, Single};

use dynamics_codegen::symbolic::Number;

use crate::roads::{Roads, travel};
use crate::zoo::Entry;
use crate::{Robot, State};

/// One output of a robot at a state, in numbers of any precision.
#[derive(Clone, Debug)]
pub struct Output<S> {
    /// In symbols.
    pub name: &'static str,
    /// Its numbers; of frames a block for each.
    pub blocks: Vec<Vec<S>>,
}

/// Errors `‖x − x̂‖/‖x̂‖` of one output over states (and frames), in the norms of Euclid and Frobenius.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// The median.
    pub typical: f64,
    /// The largest.
    pub worst: f64,
}

/// The errors of one output of a robot, by two roads in one precision.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The output in symbols.
    pub output: &'static str,
    /// Those of the derived Rust.
    pub derived: Errors,
    /// Those of the plain recursion.
    pub plain: Errors,
}

/// The errors in double precision of all outputs of a robot that are not zero, over `count` random states; none of a
/// robot that has no such form.
pub fn in_double(entry: &Entry, count: usize) -> Vec<Row> {
    let rows = |forms: &crate::Forms<f64>| measure::<f64>(entry, &*forms.robot, count);
    entry.double.as_ref().map(rows).unwrap_or_default()
}

/// [`in_double`] in single precision.
pub fn in_single(entry: &Entry, count: usize) -> Vec<Row> {
    let rows = |forms: &crate::Forms<f32>| measure::<Single>(entry, &*forms.robot, count);
    entry.single.as_ref().map(rows).unwrap_or_default()
}

/// The errors over `count` random states, which are rounded to the format before anything is computed.
fn measure<S: Format>(entry: &Entry, robot: &dyn Robot<S::Float>, count: usize) -> Vec<Row> {
    let states = entry.states(count);
    let samples: Vec<Sample> =
        travel(entry, |roads| states.iter().map(|state| sample::<S>(roads, robot, state)).collect());
    let outputs = 0..samples.first().map_or(0, Vec::len);
    let row = |k: usize| {
        let errors = |road: usize| {
            let of_states = samples.iter().map(|sample| sample[k].1[road].as_slice());
            Errors::of(of_states.collect::<Vec<_>>().concat())
        };
        Some(Row { output: samples[0][k].0, derived: errors(0)?, plain: errors(1)? })
    };
    outputs.filter_map(row).collect()
}

impl Errors {
    fn of(mut errors: Vec<f64>) -> Option<Self> {
        errors.sort_by(f64::total_cmp);
        Some(Self { typical: *errors.get(errors.len() / 2)?, worst: *errors.last()? })
    }
}

/// Names of outputs, each with the errors of the derived Rust and of the plain recursion, one for each block.
type Sample = Vec<(&'static str, [Vec<f64>; 2])>;

/// The errors at one state.
fn sample<S: Format>(roads: &Roads<'_>, robot: &dyn Robot<S::Float>, state: &State) -> Sample {
    let at = [&state.q, &state.v, &state.a, &state.tau];
    let derived = derived::outputs(robot, &at.map(|x| x.map(S::float)));
    let at = at.map(|x| x.iter().map(|&x| S::round(x)).collect::<Vec<S>>());
    let plain = plain::outputs(&roads.model, &roads.tree_in(S::round), at.each_ref().map(Vec::as_slice));
    let mut at = at.map(|x| x.into_iter().map(exact).collect::<Vec<Number>>());
    let tree = roads.tree_in(|field| exact(S::round(field)));
    tree.normalise(&mut at[0]);
    let truth = plain::outputs(&roads.model, &tree, at.each_ref().map(Vec::as_slice));
    assert!(derived.len() == truth.len() && plain.len() == truth.len(), "outputs are left out");
    let outputs = truth.iter().zip(&derived).zip(plain);
    outputs
        .map(|((truth, derived), plain)| {
            (truth.name, [errors(derived, truth), errors(&plain.map(exact), truth)])
        })
        .collect()
}

/// The number that a float is.
fn exact<S: Format>(x: S) -> Number {
    Number::from_f64(x.to_f64()).expect("floats here are finite")
}

impl<S> Output<S> {
    fn map<R>(self, mut f: impl FnMut(S) -> R) -> Output<R> {
        let blocks = self.blocks.into_iter().map(|block| block.into_iter().map(&mut f).collect()).collect();
        Output { name: self.name, blocks }
    }
}

/// What is below is zero: thirty digits of numbers that are at most some thousand.
const ZERO: f64 = 1e-24;

/// `‖x − x̂‖/‖x̂‖` of each block that is not zero, and that the robot has.
fn errors(found: &Output<Number>, truth: &Output<Number>) -> Vec<f64> {
    assert_eq!((found.name, found.blocks.len()), (truth.name, truth.blocks.len()), "outputs differ");
    let error = |(found, truth): (&Vec<Number>, &Vec<Number>)| {
        assert!(found.is_empty() || found.len() == truth.len(), "blocks differ in size");
        let missed = norm(found.iter().zip(truth).map(|(&found, &truth)| found - truth));
        let size = norm(truth.iter().copied());
        (size > ZERO && !found.is_empty()).then_some(missed / size)
    };
    found.blocks.iter().zip(&truth.blocks).filter_map(error).collect()
}

/// The root of the sum of squares.
fn norm(x: impl Iterator<Item = Number>) -> f64 {
    x.map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt()
}
