//! A piece of a motion: the states between two moments, as polynomials.

use nalgebra::SVector;

use super::flow::Vector;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The states from one moment to another: `q₀ ⊕ δ(t)` and `v(t)`, δ and v polynomials of degree 4.
///
/// So quaternions are of unit length in between too. At both ends the states are those of the steps.
pub type Segment<T, const NQ: usize, const NV: usize> = Piece<T, SVector<T, NQ>, SVector<T, NV>>;

/// A [`Segment`], with positions and velocities of any kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<T, Q, V> {
    pub(super) start: T,
    pub(super) end: T,
    pub(super) q: Q,
    pub(super) delta: Quartic<V>,
    pub(super) v: Quartic<V>,
}

impl<T: Scalar, Q, V: Vector<T>> Piece<T, Q, V> {
    /// When it begins, in s.
    #[must_use]
    pub fn start(&self) -> T {
        self.start
    }

    /// When it ends, in s.
    #[must_use]
    pub fn end(&self) -> T {
        self.end
    }

    /// Position and velocity at `time`, in s, where `integrate` is `⊕`; outside, where the polynomials lead.
    pub(super) fn follow(&self, time: T, integrate: impl Fn(&Q, &V) -> Q) -> (Q, V) {
        let part = (time - self.start) / (self.end - self.start);
        (integrate(&self.q, &self.delta.at(part)), self.v.at(part))
    }
}

impl<T: Scalar, const NQ: usize, const NV: usize> Segment<T, NQ, NV> {
    /// The motion between two states of which no more is known: δ is cubic by Hermite, v the parabola of its rate.
    ///
    /// The error goes with the fourth power of the time between in `q`, with the third in `v`.
    pub fn between<R>(robot: &R, [start, end]: [T; 2], [from, to]: [&State<T, NQ, NV>; 2]) -> Self
    where
        R: Configuration<T, NQ, NV>,
    {
        let (half, length) = (T::of(0.5), end - start);
        let way = robot.difference(&from.q, &to.q);
        let rates = [from.v * length, robot.rate(&way, &to.v) * length];
        let delta = Quartic::cubic([SVector::zeros(), way], rates);
        let middle = delta.at(half);
        let rate = (way * T::of(1.5) - (rates[0] + rates[1]) * T::of(0.25)) / length;
        // The velocity whose δ has that rate: each pass gains a factor of half the angle.
        let mut v = rate;
        for _ in 0..4 {
            v += rate - robot.rate(&middle, &v);
        }
        let bow = v * T::of(4.0) - (from.v + to.v) * T::of(2.0);
        let zero = SVector::zeros();
        Self { start, end, q: from.q, delta, v: Quartic { ends: [from.v, to.v], bows: [bow, zero, zero] } }
    }

    /// The state at `time`, in s; outside of the segment, where the polynomials lead.
    pub fn at<R>(&self, robot: &R, time: T) -> State<T, NQ, NV>
    where
        R: Configuration<T, NQ, NV>,
    {
        let (q, v) = self.follow(time, |q, delta| robot.integrate(q, delta));
        State { q, v }
    }
}

/// `(1−θ)·y₀ + θ·y₁ + θ(1−θ)·(b₀ + θ·(b₁ + (1−θ)·b₂))`, θ from 0 to 1: at both ends exactly what it is between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quartic<V> {
    pub(super) ends: [V; 2],
    pub(super) bows: [V; 3],
}

impl<T: Scalar, const N: usize> Quartic<SVector<T, N>> {
    /// The cubic polynomial of two values and their rates by θ.
    fn cubic(ends: [SVector<T, N>; 2], rates: [SVector<T, N>; 2]) -> Self {
        let way = ends[1] - ends[0];
        let bow = rates[0] - way;
        Self { ends, bows: [bow, way - rates[1] - bow, SVector::zeros()] }
    }
}

impl<V> Quartic<V> {
    fn at<T: Scalar>(&self, part: T) -> V
    where
        V: Vector<T>,
    {
        let rest = T::one() - part;
        let Self { ends: [from, to], bows: [first, second, third] } = self;
        let bow = part * rest;
        let bent = first.times(bow).plus(bow * part, second).plus(bow * part * rest, third);
        from.times(rest).plus(part, to).plus(T::one(), &bent)
    }
}
