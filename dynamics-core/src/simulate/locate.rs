//! The first event on a piece of a motion.

use super::event::{Direction, Event};
use super::numbers::{magnitude, rounding, smaller};
use super::segment::Segment;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// So many parts of a step are looked at: of what passes zero twice within one of them, a single hump is seen.
const PARTS: u32 = 8;

/// Brackets of one unit of rounding are reached by halving after so many times at the latest; ITP has one more.
const MOST_ITERATIONS: u32 = 64;

/// A moment and the state then.
#[derive(Clone, Copy)]
pub(super) struct Moment<T, const NQ: usize, const NV: usize> {
    pub(super) time: T,
    pub(super) state: State<T, NQ, NV>,
}

/// A moment, and which events have happened then.
pub(super) type Found<T, const NQ: usize, const NV: usize, const E: usize> = (Moment<T, NQ, NV>, [bool; E]);

/// Whether the search begins where a motion was put, or goes on from where one has come to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Beginning {
    Given,
    Reached,
}

/// The first moment after `from` and up to `end` at which an event has happened, and which have; `from` itself of
/// barriers that a given state goes on from.
///
/// It lies behind the zero by rounding, so that the functions have their new signs there, and a search that goes on
/// from it does not find the same again.
pub(super) fn first<R, T, V, const NQ: usize, const NV: usize, const E: usize>(
    robot: &R,
    segment: &Segment<T, NQ, NV>,
    from: Moment<T, NQ, NV>,
    end: T,
    beginning: Beginning,
    events: &[V; E],
) -> Result<Option<Found<T, NQ, NV, E>>, Error>
where
    R: Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd,
    V: Event<R, T, NQ, NV>,
{
    let at = |time: T| Moment { time, state: segment.at(robot, time) };
    let value = |event: &V, Moment { time, state }: Moment<T, NQ, NV>| event.value(robot, time, &state);
    let values = |moment| checked(events.each_ref().map(|event| value(event, moment)));
    let part = (end - from.time) / T::of(f64::from(PARTS));
    let (mut before, mut old) = (from, values(from)?);
    for k in 1..=PARTS {
        let time = if k == PARTS { end } else { part.mul_add(T::of(f64::from(k)), from.time) };
        let after = at(time);
        let new = values(after)?;
        let mut crossings = events.iter().zip(old.iter().zip(&new)).map(|(event, (old, new))| {
            crossing(event.direction(), [before.time, time], [*old, *new], |time| value(event, at(time)))
        });
        let crossings: [Option<Crossing<T>>; E] = core::array::from_fn(|_| crossings.next().flatten());
        if k == 1 && beginning == Beginning::Given {
            let mut held = events.iter().zip(old.iter().zip(&new)).zip(&crossings);
            let held = core::array::from_fn(|_| {
                held.next().is_some_and(|((event, (old, new)), crossing)| {
                    event.is_barrier() && crossing.is_none() && event.direction().goes_on(*old, *new)
                })
            });
            if held.contains(&true) {
                return Ok(Some((from, held)));
            }
        }
        let earliest = crossings.iter().flatten().map(|crossing| crossing.found);
        if let Some(time) = earliest.reduce(smaller) {
            let moment = at(time);
            let mut happened = events.iter().zip(&crossings).map(|(event, crossing)| {
                crossing.as_ref().is_some_and(|Crossing { begin, old, .. }| {
                    *begin < time && event.direction().is_passed(*old, value(event, moment))
                })
            });
            return Ok(Some((moment, core::array::from_fn(|_| happened.next().unwrap_or(false)))));
        }
        (before, old) = (after, new);
    }
    Ok(None)
}

/// A sign that changes between two times.
struct Crossing<T> {
    begin: T,
    /// The value at the beginning.
    old: T,
    /// Where it is the other one, to rounding.
    found: T,
}

/// The first crossing in a direction, between two times with their values.
fn crossing<T: Scalar + PartialOrd>(
    direction: Direction,
    [begin, end]: [T; 2],
    [old, new]: [T; 2],
    f: impl Fn(T) -> T + Copy,
) -> Option<Crossing<T>> {
    let within = |begin: T, end: T, old: T, new: T| {
        let found = || zero([begin, end], [old, new], f);
        direction.is_passed(old, new).then(|| Crossing { begin, old, found: found() })
    };
    match hump([begin, end], [old, new], f) {
        Some((top, over)) => within(begin, top, old, over).or_else(|| within(top, end, over, new)),
        None => within(begin, end, old, new),
    }
}

/// A time at which `f` has another sign than at both ends, with its value: where it goes towards zero, and comes back.
///
/// After an impact it begins on zero, so that a short flight is such a hump. By golden sections, as far as these see.
fn hump<T: Scalar + PartialOrd>([a, b]: [T; 2], [at_a, at_b]: [T; 2], f: impl Fn(T) -> T) -> Option<(T, T)> {
    const SECTIONS: usize = 48;
    let zero = T::zero();
    let above = match (at_a <= zero && at_b < zero, at_a >= zero && at_b > zero) {
        (true, _) => T::one(),
        (_, true) => -T::one(),
        _ => return None,
    };
    let over = |value: T| value * above > zero;
    let short = (b - a) * rounding::<T>().sqrt();
    let first = f(a + short);
    if over(first) {
        return Some((a + short, first));
    }
    let turns = (first - at_a) * above > zero && (f(b - short) - at_b) * above > zero;
    if !turns {
        return None;
    }
    let golden = T::of(0.618_033_988_749_895);
    let (mut a, mut b) = (a, b);
    let (mut left, mut right) = (b - (b - a) * golden, a + (b - a) * golden);
    let (mut at_left, mut at_right) = (f(left), f(right));
    for _ in 0..SECTIONS {
        if over(at_left) {
            return Some((left, at_left));
        }
        if over(at_right) {
            return Some((right, at_right));
        }
        if (at_left - at_right) * above > zero {
            (b, right, at_right) = (right, left, at_left);
            left = b - (b - a) * golden;
            at_left = f(left);
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + (b - a) * golden;
            at_right = f(right);
        }
    }
    None
}

/// The values, if all of them are numbers.
fn checked<T: Scalar + PartialOrd, const E: usize>(values: [T; E]) -> Result<[T; E], Error> {
    match values.iter().position(|value| value.partial_cmp(value).is_none()) {
        Some(index) => Err(Error::NotFinite { vector: "event", index }),
        None => Ok(values),
    }
}

/// The end of a bracket of rounding's width around a zero of `f` between two times, at which `f` has its later sign.
///
/// Interpolation, truncation and projection: never more evaluations than halving and one, and far fewer where `f` is
/// smooth.
///
/// # Source
///
/// I. Oliveira, R. Takahashi, *An enhancement of the bisection method average performance preserving minmax
/// optimality*, ACM TOMS 47 (2021) 5.
fn zero<T: Scalar + PartialOrd>(
    [mut a, mut b]: [T; 2],
    [mut at_a, mut at_b]: [T; 2],
    f: impl Fn(T) -> T,
) -> T {
    let (half, zero) = (T::of(0.5), T::zero());
    let least = (magnitude(a) + magnitude(b)) * (rounding::<T>() + rounding::<T>());
    let bias = T::of(0.2) / (b - a);
    let rises = at_a < zero;
    let mut reach = least; // of the projection: what halvings that are left would leave
    let mut halvings = 0;
    while reach < b - a && halvings < MOST_ITERATIONS {
        reach += reach;
        halvings += 1;
    }
    for _ in 0..=halvings {
        let (width, middle) = (b - a, a + (b - a) * half);
        if width <= least {
            break;
        }
        let falsi = (at_b * a - at_a * b) / (at_b - at_a);
        let aside = bias * width * width;
        let towards = |step: T| if falsi < middle { step } else { -step };
        let truncated = if aside <= magnitude(middle - falsi) { falsi + towards(aside) } else { middle };
        let room = reach - width * half;
        let projected =
            if magnitude(truncated - middle) <= room { truncated } else { middle - towards(room) };
        let next = if projected > a && projected < b { projected } else { middle };
        let value = f(next);
        let passed = if rises { value >= zero } else { value <= zero };
        if passed {
            (b, at_b) = (next, value);
        } else {
            (a, at_a) = (next, value);
        }
        reach *= half;
    }
    b
}
