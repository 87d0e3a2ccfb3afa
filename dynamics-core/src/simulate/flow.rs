//! What a method steps along: how positions move, and how velocities change.
//!
//! Methods know no robot. They are written over a [`Flow`], and so are one text for a robot whose sizes are known to Rust,
//! for eight of them in lanes, and for one whose size is only known when it is read from a file.

use core::marker::PhantomData;

use nalgebra::SVector;

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `q̇ = v`, `v̇ = a(t, q, v)`, on a manifold of positions.
///
/// Of a [derived robot](crate::Dynamics) there is no need to know it: [`Simulation`](super::Simulation) and
/// [`Adaptive`](super::Adaptive) have one inside. It is for what moves and is no type: with the feature `std`, positions and
/// velocities may be `Vec`s.
///
/// # Example
///
#[cfg_attr(feature = "std", doc = "```")]
#[cfg_attr(not(feature = "std"), doc = "```ignore")]
/// use dynamics_core::simulate::{Explicit, Flow, Rk4};
///
/// /// Balls on a chain of springs, as many as there are.
/// struct Chain;
///
/// impl Flow for Chain {
///     type Scalar = f64;
///     type Position = Vec<f64>;
///     type Velocity = Vec<f64>;
///     fn integrate(&self, q: &Vec<f64>, delta: &Vec<f64>) -> Vec<f64> {
///         q.iter().zip(delta).map(|(q, delta)| q + delta).collect()
///     }
///     fn acceleration(&mut self, _time: f64, q: &Vec<f64>, _v: &Vec<f64>) -> Vec<f64> {
///         let at = |k: usize| q.get(k).copied().unwrap_or(0.0);
///         (0..q.len()).map(|k| at(k.wrapping_sub(1)) - 2.0 * q[k] + at(k + 1)).collect()
///     }
/// }
///
/// let (mut q, mut v) = (vec![0.1, 0.0, 0.0, 0.0], vec![0.0; 4]);
/// for step in 0..100 {
///     (q, v) = Rk4.follow(&mut Chain, 0.01 * f64::from(step), (&q, &v), 0.01);
/// }
/// assert!(q[3] > 0.0);
/// ```
pub trait Flow {
    /// The numbers.
    type Scalar: Scalar;
    /// Positions `q`: of ball and free joints quaternions.
    type Position: Vector<Self::Scalar>;
    /// Velocities `v`, accelerations, and displacements δ.
    type Velocity: Vector<Self::Scalar>;

    /// `q ⊕ δ`, as [`Configuration::integrate`].
    fn integrate(&self, q: &Self::Position, delta: &Self::Velocity) -> Self::Position;

    /// `δ̇` where `q ⊕ δ` moves with the velocity `v`, as [`Configuration::rate`]; `v` on a vector space, and as provided.
    fn rate(&self, delta: &Self::Velocity, v: &Self::Velocity) -> Self::Velocity {
        let _ = delta;
        v.clone()
    }

    /// `v̇` at a time, in s. What has none may be NaN.
    fn acceleration(&mut self, time: Self::Scalar, q: &Self::Position, v: &Self::Velocity) -> Self::Velocity;

    /// `v̇`, or why there is none.
    ///
    /// # Errors
    ///
    /// As provided, [`Error::NotFinite`] of `a`.
    fn try_acceleration(
        &mut self,
        time: Self::Scalar,
        q: &Self::Position,
        v: &Self::Velocity,
    ) -> Result<Self::Velocity, Error> {
        let a = self.acceleration(time, q, v);
        Error::unless_all_finite("a", a.entries())?;
        Ok(a)
    }
}

/// Numbers in a row, of a length that Rust knows or does not.
pub trait Vector<T: Scalar>: Clone {
    /// All of them.
    fn entries(&self) -> &[T];

    /// All of them.
    fn entries_mut(&mut self) -> &mut [T];

    /// `part·x`
    #[inline]
    #[must_use]
    fn times(&self, part: T) -> Self {
        let mut product = self.clone();
        for entry in product.entries_mut() {
            *entry *= part;
        }
        product
    }

    /// `x + part·y`, of two of one length.
    #[inline]
    #[must_use]
    fn plus(mut self, part: T, y: &Self) -> Self {
        for (entry, y) in self.entries_mut().iter_mut().zip(y.entries()) {
            *entry = y.mul_add(part, *entry);
        }
        self
    }
}

impl<T: Scalar, const N: usize> Vector<T> for SVector<T, N> {
    #[inline(always)]
    fn entries(&self) -> &[T] {
        self.data.as_slice()
    }
    #[inline(always)]
    fn entries_mut(&mut self) -> &mut [T] {
        self.data.as_mut_slice()
    }
    // The same, entry by entry: in registers and not in memory.
    #[inline(always)]
    fn times(&self, part: T) -> Self {
        self.map(|entry| entry * part)
    }
    #[inline(always)]
    fn plus(self, part: T, y: &Self) -> Self {
        self.zip_map(y, |entry, y| y.mul_add(part, entry))
    }
}

/// A robot under an input.
#[derive(Debug)]
pub(super) struct Driven<'r, R, T, U, const NQ: usize, const NV: usize> {
    pub(super) robot: &'r R,
    pub(super) input: U,
    state: PhantomData<fn(T) -> State<T, NQ, NV>>,
}

impl<'r, R, T, U, const NQ: usize, const NV: usize> Driven<'r, R, T, U, NQ, NV> {
    /// The robot under the joint forces `τ = input(time, state)`.
    #[inline(always)]
    pub(super) fn new(robot: &'r R, input: U) -> Self {
        Self { robot, input, state: PhantomData }
    }
}

impl<R, T, U: Clone, const NQ: usize, const NV: usize> Clone for Driven<'_, R, T, U, NQ, NV> {
    fn clone(&self) -> Self {
        Self::new(self.robot, self.input.clone())
    }
}

impl<R, T, U, const NQ: usize, const NV: usize> Flow for Driven<'_, R, T, U, NQ, NV>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar,
    U: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
{
    type Scalar = T;
    type Position = SVector<T, NQ>;
    type Velocity = SVector<T, NV>;

    #[inline(always)]
    fn integrate(&self, q: &SVector<T, NQ>, delta: &SVector<T, NV>) -> SVector<T, NQ> {
        self.robot.integrate(q, delta)
    }

    #[inline(always)]
    fn rate(&self, delta: &SVector<T, NV>, v: &SVector<T, NV>) -> SVector<T, NV> {
        self.robot.rate(delta, v)
    }

    #[inline(always)]
    fn acceleration(&mut self, time: T, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, NV> {
        let tau = (self.input)(time, &State::new(*q, *v));
        self.robot.forward_dynamics(q, v, &tau)
    }

    fn try_acceleration(
        &mut self,
        time: T,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
    ) -> Result<SVector<T, NV>, Error> {
        let tau = (self.input)(time, &State::new(*q, *v));
        self.robot.try_forward_dynamics(q, v, &tau)
    }
}
