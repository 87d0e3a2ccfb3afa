//! A row of steps within tolerances, along any flow.

use super::clock::Clock;
use super::controller::{Controller, fifth_root};
use super::dopri5::{Attempt, Start, attempt};
use super::flow::{Flow, Vector};
use super::numbers::{larger, magnitude, rounding, smaller};
use super::segment::Piece;
use super::tolerances::{Part, Tolerances};
use crate::error::Error;
use crate::scalar::Scalar;

/// Steps by the method of Dormand and Prince, one after the other, each of the size that keeps its error within
/// [`Tolerances`].
///
/// [`Adaptive`](super::Adaptive) is this for a robot, with [events](super::Event); here is what it takes for any [`Flow`].
///
/// # Example
///
#[cfg_attr(feature = "std", doc = "```")]
#[cfg_attr(not(feature = "std"), doc = "```ignore")]
/// use dynamics_core::simulate::{Flow, March, Tolerances};
///
/// /// A stone that falls through air.
/// struct Stone;
///
/// impl Flow for Stone {
///     type Scalar = f64;
///     type Position = Vec<f64>;
///     type Velocity = Vec<f64>;
///     fn integrate(&self, q: &Vec<f64>, delta: &Vec<f64>) -> Vec<f64> {
///         vec![q[0] + delta[0]]
///     }
///     fn acceleration(&mut self, _time: f64, _q: &Vec<f64>, v: &Vec<f64>) -> Vec<f64> {
///         vec![-9.81 - 0.5 * v[0]]
///     }
/// }
///
/// let mut fall = March::new((vec![100.0], vec![0.0]), Tolerances::of(1e-10))?;
/// for k in 1..=10 {
///     let (_, v) = fall.reach(&mut Stone, 0.1 * f64::from(k), 1.0)?; // from the steps' own polynomials
///     let expected = -9.81 / 0.5 * (1.0 - (-0.05 * f64::from(k)).exp());
///     assert!((v[0] - expected).abs() < 1e-8);
/// }
/// # Ok::<(), dynamics_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct March<T, Q, V> {
    tolerances: Tolerances<T>,
    sizes: Sizes<T>,
    controller: Controller<T>,
    front: Front<T, Q, V>,
}

/// The bounds of steps.
#[derive(Clone, Copy, Debug)]
struct Sizes<T> {
    least: T,
    greatest: Option<T>,
    most: usize,
    /// The next one, if there was one before.
    next: Option<T>,
}

/// How far the steps have got.
#[derive(Clone, Copy, Debug)]
struct Front<T, Q, V> {
    clock: Clock<T>,
    q: Q,
    v: V,
    acceleration: Option<V>,
    /// The step that led there.
    piece: Option<Piece<T, Q, V>>,
}

impl<T: Scalar, Q, V> Front<T, Q, V> {
    fn at(time: T, (q, v): (Q, V)) -> Self {
        Self { clock: Clock::at(time), q, v, acceleration: None, piece: None }
    }
}

impl<T: Scalar + PartialOrd, Q: Vector<T>, V: Vector<T>> March<T, Q, V> {
    /// From `(q, v)` at time 0 on. The first step finds its own size.
    ///
    /// # Errors
    ///
    /// [`Error::ToleranceNotPositive`]; [`Error::NotFinite`] of `q` and `v`.
    pub fn new(place: (Q, V), tolerances: Tolerances<T>) -> Result<Self, Error> {
        tolerances.check()?;
        Error::unless_all_finite("q", place.0.entries())?;
        Error::unless_all_finite("v", place.1.entries())?;
        let sizes = Sizes { least: T::zero(), greatest: None, most: 1_000_000, next: None };
        Ok(Self { tolerances, sizes, controller: Controller::new(), front: Front::at(T::zero(), place) })
    }

    /// The same in steps from `least` to `greatest`, in s; the last one before a given time may be shorter.
    ///
    /// # Errors
    ///
    /// [`Error::StepNotPositive`] if one is not positive and finite, or `least` is above `greatest`.
    pub fn with_steps(mut self, least: T, greatest: T) -> Result<Self, Error> {
        let positive = least > T::zero() && greatest >= least && greatest.is_finite();
        if !positive {
            return Err(Error::StepNotPositive);
        }
        self.sizes = Sizes { least, greatest: Some(greatest), ..self.sizes };
        Ok(self)
    }

    /// The same with at most so many steps in each call, tried ones too; a million without it.
    #[must_use]
    pub fn with_most_steps(mut self, most: usize) -> Self {
        self.sizes.most = most;
        self
    }

    /// The end of the last step, in s.
    #[must_use]
    pub fn time(&self) -> T {
        self.front.clock.time
    }

    /// The last step; none before the first.
    pub(super) fn piece(&self) -> Option<&Piece<T, Q, V>> {
        self.front.piece.as_ref()
    }

    /// How many steps a call may take.
    pub(super) fn most_steps(&self) -> usize {
        self.sizes.most
    }

    /// Goes on from another place, at `time`.
    pub(super) fn restart(&mut self, time: T, place: (Q, V)) {
        self.front = Front::at(time, place);
    }
}

impl<T: Scalar + PartialOrd + Into<f64>, Q: Vector<T>, V: Vector<T>> March<T, Q, V> {
    /// Position and velocity at `time`, in s, which is not before the last step: by steps that may lead beyond it, up to
    /// `until`.
    ///
    /// # Errors
    ///
    /// [`Error::TimeNotAhead`] if `time` is before the last step, or not finite. Those of
    /// [`Adaptive::advance_to`](super::Adaptive::advance_to).
    pub fn reach<F>(&mut self, flow: &mut F, time: T, until: T) -> Result<(Q, V), Error>
    where
        F: Flow<Scalar = T, Position = Q, Velocity = V>,
    {
        let since = self.front.piece.as_ref().map_or(self.front.clock.time, Piece::start);
        let ahead = time >= since && time.is_finite() && until.is_finite();
        if !ahead {
            return Err(Error::TimeNotAhead);
        }
        let mut left = self.sizes.most;
        while self.front.clock.time < time {
            self.step(flow, larger(time, until), &mut left)?;
        }
        Ok(self.at(time, |q, delta| flow.integrate(q, delta)))
    }

    /// Position and velocity at a time on the last step, where `integrate` is `⊕`.
    pub(super) fn at(&self, time: T, integrate: impl Fn(&Q, &V) -> Q) -> (Q, V) {
        match &self.front.piece {
            Some(piece) if time < self.front.clock.time => piece.follow(time, integrate),
            _ => (self.front.q.clone(), self.front.v.clone()),
        }
    }

    /// Moves the front on by one step, and not beyond `until`.
    pub(super) fn step<F>(&mut self, flow: &mut F, until: T, left: &mut usize) -> Result<(), Error>
    where
        F: Flow<Scalar = T, Position = Q, Velocity = V>,
    {
        let clock = self.front.clock;
        let acceleration = self.acceleration(flow)?;
        let mut next = match self.sizes.next {
            Some(step) => step,
            None => self.first_step(flow, &acceleration, until - clock.time),
        };
        let time = clock.time.into();
        let mut failure = Error::StepTooSmall { time };
        loop {
            let step = self.bounded(next, until - clock.time).ok_or(failure)?;
            *left = left.checked_sub(1).ok_or(Error::TooManySteps { time })?;
            let ends = step == until - clock.time;
            let after = if ends { Clock::at(until) } else { clock.after(step) };
            let (q, v) = (&self.front.q, &self.front.v);
            let start = Start { q, v, acceleration: &acceleration, times: [clock.time, after.time], step };
            let reached = attempt(flow, &start, &self.tolerances);
            let (error, sound) = (reached.error, reached.check());
            if sound.is_ok() && error <= T::one() {
                let suggested = step * self.controller.accepted(error);
                // A step that was cut short by its end says little of the next one.
                self.sizes.next = Some(if ends { larger(suggested, next) } else { suggested });
                let Attempt { q, v, acceleration, piece, .. } = reached;
                let (acceleration, piece) = (Some(acceleration), Some(piece));
                self.front = Front { clock: after, q, v, acceleration, piece };
                return Ok(());
            }
            failure = sound.err().unwrap_or(Error::StepTooSmall { time });
            if step <= self.sizes.least {
                return Err(failure);
            }
            next = larger(step * self.controller.rejected(error), self.sizes.least);
        }
    }

    /// The acceleration at the front.
    fn acceleration<F>(&self, flow: &mut F) -> Result<V, Error>
    where
        F: Flow<Scalar = T, Position = Q, Velocity = V>,
    {
        let Front { clock, q, v, acceleration, .. } = &self.front;
        match acceleration {
            Some(acceleration) => Ok(acceleration.clone()),
            None => flow.try_acceleration(clock.time, q, v),
        }
    }

    /// The step within its bounds, and within the time that remains; none that is too small.
    fn bounded(&self, step: T, remaining: T) -> Option<T> {
        let Sizes { least, greatest, .. } = self.sizes;
        let step = greatest.map_or(step, |greatest| smaller(step, greatest));
        // The time that rounding resolves.
        let grain = magnitude(self.front.clock.time) * rounding::<T>() * T::of(16.0);
        if step.mul_add(T::of(1e-2), step) >= remaining {
            return Some(remaining);
        }
        let in_halves = step + step >= remaining && least + least <= remaining;
        let step = if in_halves { remaining * T::of(0.5) } else { step };
        let sound = step >= larger(grain, T::of(1e-30));
        sound.then_some(larger(step, least))
    }

    /// A first step, by how fast speeds change, and how fast that does.
    ///
    /// # Source
    ///
    /// E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, Springer 1993, §II.4.
    fn first_step<F>(&self, flow: &mut F, acceleration: &V, remaining: T) -> T
    where
        F: Flow<Scalar = T, Position = Q, Velocity = V>,
    {
        let Front { clock, q, v, .. } = &self.front;
        let norm = |x: &V| self.tolerances.norm([Part { x: x.entries(), sizes: [v.entries(); 2] }]);
        let (size, rate) = (norm(v), norm(acceleration));
        let small = T::of(1e-5);
        let guess = if size > small && rate > small { T::of(0.01) * (size / rate) } else { T::of(1e-6) };
        let guess = smaller(guess, remaining);
        let (q, after) = (flow.integrate(q, &v.times(guess)), v.clone().plus(guess, acceleration));
        let change = flow.acceleration(clock.time + guess, &q, &after).plus(-T::one(), acceleration);
        let bend = larger(rate, norm(&change) / guess);
        let smooth = if bend > T::of(1e-15) { fifth_root(T::of(0.01) / bend) } else { remaining };
        let step = smaller(smaller(guess * T::of(100.0), smooth), remaining);
        larger(step, self.sizes.least)
    }
}
