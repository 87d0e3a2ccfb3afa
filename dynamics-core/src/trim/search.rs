//! Levenberg's and Marquardt's iteration, and how it judges where it ends.

use super::problem::{Point, Residual, Scales, larger};
use super::unknowns::{Equation, Triangle, Unknowns};
use super::{Trim, TrimFailure, Trimmed};
use crate::error::Error;
use crate::linearize::StateSpaceModel;
use crate::mechanism::Mechanism;
use crate::output::Output;
use crate::scalar::Scalar;

/// A residual of so many roundings, relative to the largest force, is none.
const ROUNDINGS: f64 = 4096.0;
/// The damping of the first step, relative to the squares of the columns.
const DAMPING: f64 = 1e-3;
/// A step that brings less than this part of what it promised is not taken.
const WORTH: f64 = 1e-4;

/// How far it looks beside a point where the ground is level, in rad, m, rad/s or m/s.
const ASIDE: f64 = 0.03125;

/// A point and its residual.
type Beside<T, const NQ: usize, const NV: usize, const NU: usize, const NC: usize> =
    (Point<T, NQ, NV, NU>, Residual<T, NV, NC>);
/// What a search comes to.
type Found<T, const NQ: usize, const NV: usize, const NU: usize> =
    Result<Trimmed<T, NQ, NV, NU>, TrimFailure<T, NQ, NV, NU>>;

pub(super) fn search<
    R,
    T,
    O,
    const NQ: usize,
    const NV: usize,
    const NX: usize,
    const NU: usize,
    const NC: usize,
>(
    trim: &Trim<'_, R, T, NQ, NV, NU, O, NC>,
) -> Found<T, NQ, NV, NU>
where
    R: StateSpaceModel<T, NQ, NV, NX, NU> + Mechanism,
    T: Scalar + PartialOrd,
    O: Output<R, T, NQ, NV>,
{
    checked(trim).map_err(TrimFailure::Invalid)?;
    let rounding = rounding::<T>();
    let mut point = Point { state: trim.state, a: trim.a, u: trim.u };
    let mut residual = trim.residual(&point).map_err(TrimFailure::Invalid)?;
    Error::unless_finite("tau", &residual.forces).map_err(TrimFailure::Invalid)?;
    Error::unless_finite("y", &residual.misses).map_err(TrimFailure::Invalid)?;
    let scales = trim.scales(&point);

    let (mut damping, mut growth) = (T::of(DAMPING), T::of(2.0));
    let mut widths = Unknowns::all(T::zero());
    let mut equations = None;
    for iterations in 0..=trim.iterations {
        let scaled = residual.scaled(&scales);
        if scaled.largest() <= T::of(ROUNDINGS) * rounding {
            return Ok(trim.trimmed(&point, &residual, iterations));
        }
        let (of_forces, of_outputs) = match equations {
            Some(known) => known,
            None => trim.equations(&point, &scaled, &scales).map_err(TrimFailure::Invalid)?,
        };
        equations = Some((of_forces, of_outputs));
        let all = || of_forces.iter().chain(&of_outputs);
        widen(&mut widths, all());
        let slope = slope(all(), &widths, scaled.square());
        if slope <= T::of(16.0) * rounding.sqrt() {
            // Level ground: a valley, or a crest to step down from.
            let Some((next, next_residual)) = downhill(trim, &point, &scales, rounding)? else {
                return Err(TrimFailure::NoEquilibrium(trim.trimmed(&point, &residual, iterations)));
            };
            (point, residual, equations) = (next, next_residual, None);
            continue;
        }
        let step = damped_step(all(), &widths, damping).only(&trim.free);
        let next = trim.moved(&point, &step);
        let next_residual = trim.residual(&next).map_err(TrimFailure::Invalid)?;
        let promised = scaled.square() - left(all(), &step);
        let gained = scaled.square() - next_residual.scaled(&scales).square();
        if next_residual.is_finite() && gained > T::of(WORTH) * promised && promised > T::zero() {
            (point, residual, equations) = (next, next_residual, None);
            damping = at_least(damping * shrink(gained / promised), rounding);
            growth = T::of(2.0);
        } else if damping > T::one() / rounding {
            // The steps are below rounding: nothing nearby is better, or nothing that can be told from it.
            let best = trim.trimmed(&point, &residual, iterations);
            let is_level = slope <= rounding.sqrt().sqrt();
            return Err(if is_level {
                TrimFailure::NoEquilibrium(best)
            } else {
                TrimFailure::NotConverged(best)
            });
        } else {
            damping *= growth;
            growth += growth;
        }
    }
    Err(TrimFailure::NotConverged(trim.trimmed(&point, &residual, trim.iterations)))
}

/// A point beside one where no small change does anything to first order, with a smaller residual; none if it is a least
/// one. Only positions and speeds are tried, each by itself: in inputs and accelerations the equations are linear.
fn downhill<R, T, O, const NQ: usize, const NV: usize, const NX: usize, const NU: usize, const NC: usize>(
    trim: &Trim<'_, R, T, NQ, NV, NU, O, NC>,
    point: &Point<T, NQ, NV, NU>,
    scales: &Scales<T, NC>,
    rounding: T,
) -> Result<Option<Beside<T, NQ, NV, NU, NC>>, TrimFailure<T, NQ, NV, NU>>
where
    R: StateSpaceModel<T, NQ, NV, NX, NU> + Mechanism,
    T: Scalar + PartialOrd,
    O: Output<R, T, NQ, NV>,
{
    let residual = trim.residual(point).map_err(TrimFailure::Invalid)?;
    let mut least = residual.scaled(scales).square() * (T::one() - T::of(ROUNDINGS) * rounding);
    let mut best = None;
    let free = trim.free.q.iter().chain(&trim.free.v).enumerate();
    for (k, _) in free.filter(|(_, free)| **free) {
        for size in [T::of(ASIDE), T::of(-ASIDE)] {
            let mut step = Unknowns::all(T::zero());
            if let Some(entry) = step.iter_mut().nth(k) {
                *entry = size;
            }
            let next = trim.moved(point, &step);
            let residual = trim.residual(&next).map_err(TrimFailure::Invalid)?;
            let square = residual.scaled(scales).square();
            if square < least {
                least = square;
                best = Some((next, residual));
            }
        }
    }
    Ok(best)
}

/// Whether the guess and what was asked for are possible at all.
fn checked<R, T, O, const NQ: usize, const NV: usize, const NX: usize, const NU: usize, const NC: usize>(
    trim: &Trim<'_, R, T, NQ, NV, NU, O, NC>,
) -> Result<(), Error>
where
    R: StateSpaceModel<T, NQ, NV, NX, NU> + Mechanism,
    T: Scalar + PartialOrd,
{
    trim.mistake.map_or(Ok(()), Err)?;
    trim.state.check()?;
    Error::unless_finite("a", &trim.a)?;
    Error::unless_finite("u", &trim.u)?;
    Error::unless_finite("targets", &trim.targets)?;
    trim.robot.check_configuration(&trim.state.q)
}

/// The distance from 1 to the next number.
fn rounding<T: Scalar + PartialOrd>() -> T {
    let mut rounding = T::one();
    for _ in 0..128 {
        let half = rounding * T::of(0.5);
        if T::one() + half > T::one() {
            rounding = half;
        }
    }
    rounding
}

/// The steepest slope of the residual, as the cosine of its angle to a column of full width: zero where no change makes it
/// smaller.
fn slope<'e, T: Scalar + PartialOrd + 'e, const NV: usize, const NU: usize>(
    equations: impl Iterator<Item = &'e Equation<T, NV, NU>>,
    widths: &Unknowns<T, NV, NU>,
    square: T,
) -> T {
    let mut gradient = Unknowns::<T, NV, NU>::all(T::zero());
    for equation in equations {
        for (gradient, coefficient) in gradient.iter_mut().zip(equation.coefficients.iter()) {
            *gradient += coefficient * equation.right;
        }
    }
    let length = square.sqrt();
    let cosines = gradient
        .iter()
        .zip(widths.iter())
        .map(|(gradient, width)| if width > T::zero() { gradient / (width * length) } else { T::zero() });
    cosines.fold(T::zero(), larger)
}

/// Lets the width of each unknown be its largest column so far.
fn widen<'e, T: Scalar + PartialOrd + 'e, const NV: usize, const NU: usize>(
    widths: &mut Unknowns<T, NV, NU>,
    equations: impl Iterator<Item = &'e Equation<T, NV, NU>>,
) {
    let mut squares = Unknowns::<T, NV, NU>::all(T::zero());
    for equation in equations {
        for (square, coefficient) in squares.iter_mut().zip(equation.coefficients.iter()) {
            *square += coefficient * coefficient;
        }
    }
    for (width, square) in widths.iter_mut().zip(squares.iter()) {
        *width = larger(*width, square.sqrt());
    }
}

/// The step that makes `|J·δ + residual|² + damping·|widths·δ|²` least.
fn damped_step<'e, T: Scalar + PartialOrd + 'e, const NV: usize, const NU: usize>(
    equations: impl Iterator<Item = &'e Equation<T, NV, NU>>,
    widths: &Unknowns<T, NV, NU>,
    damping: T,
) -> Unknowns<T, NV, NU> {
    let mut triangle = Triangle::new();
    equations.for_each(|equation| triangle.insert(*equation));
    let root = damping.sqrt();
    for (k, width) in widths.iter().enumerate() {
        let mut row = Equation::zero();
        if let Some(entry) = row.coefficients.iter_mut().nth(k) {
            // What is held, or does nothing, has no column; it gets a step of zero.
            *entry = if width > T::zero() { root * width } else { T::one() };
        }
        triangle.insert(row);
    }
    triangle.solve()
}

/// The square of what the linear equations leave after a step.
fn left<'e, T: Scalar + 'e, const NV: usize, const NU: usize>(
    equations: impl Iterator<Item = &'e Equation<T, NV, NU>>,
    step: &Unknowns<T, NV, NU>,
) -> T {
    equations.fold(T::zero(), |sum, equation| {
        let left = equation.coefficients.dot(step) - equation.right;
        left.mul_add(left, sum)
    })
}

/// By how much the damping shrinks after a step that brought this part of what it promised (H. Nielsen, 1999).
fn shrink<T: Scalar + PartialOrd>(part: T) -> T {
    let x = part + part - T::one();
    at_least(T::one() - x * x * x, T::of(0.1))
}

fn at_least<T: PartialOrd>(x: T, least: T) -> T {
    if x < least { least } else { x }
}
