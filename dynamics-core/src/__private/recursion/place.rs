//! The robot at a configuration: every link's axes, its place beside its parent, and its mass, in world axes.
//!
//! P. Wensing, S. Kim, J.-J. Slotine, *Linear matrix inequalities for physically consistent inertial parameter
//! identification*, RA-L 2018, for mass by its moments of order 0, 1 and 2.

use core::ops::Add;

use super::joint::Columns;
use super::screw::{Twist, Wrench};
use super::vector::{Matrix, Vector};
use super::{Masses, Tree, entry};
use crate::scalar::Scalar;

/// A link at a configuration.
#[derive(Clone, Copy)]
pub(super) struct Body<T> {
    /// How its joint moves it.
    pub(super) columns: Columns<T>,
    /// From the link's axes to the world's.
    rotation: Matrix<T>,
    /// From the parent's origin to the link's.
    pub(super) offset: Vector<T>,
    /// The link's own mass.
    pub(super) moments: Moments<T>,
}

impl<T: Scalar> Body<T> {
    /// The world, as a parent.
    fn world() -> Self {
        Self {
            columns: Columns::none(),
            rotation: Matrix::identity(),
            offset: Vector::zero(),
            moments: Moments::zero(),
        }
    }
}

impl<T: Scalar, const NL: usize> Masses<T, NL> {
    /// Those of a link, in its own axes.
    #[inline(always)]
    pub(super) fn of(&self, k: usize) -> Moments<T> {
        let first = Vector(self.first.each_ref().map(|x| entry(x, k)));
        let second = Matrix::symmetric(self.second.each_ref().map(|x| entry(x, k)));
        Moments { mass: entry(&self.mass, k), first, second }
    }
}

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The links at the configuration `q`.
    pub(super) fn place(&self, q: &[T; NQ]) -> [Body<T>; NL] {
        self.base_to_tip(self.links.iter().enumerate(), Body::world(), |(k, link), parent| {
            let (rotation, position) = link.pose_in_parent(q);
            let rotation = parent.rotation.product(rotation);
            Body {
                columns: link.joint.columns(rotation.transpose().0.map(Vector)),
                rotation,
                offset: parent.rotation.times(position),
                moments: self.masses.of(k).turned(rotation),
            }
        })
    }

    /// The origins of all links, counted from where the world's is at `base`.
    pub(super) fn origins(&self, bodies: &[Body<T>; NL], base: Vector<T>) -> [Vector<T>; NL] {
        self.base_to_tip(bodies, base, |body, parent| parent + body.offset)
    }
}

/// The first moment of all links, which have their origins there, kg·m.
pub(super) fn first_moment<T: Scalar>(bodies: &[Body<T>], origins: &[Vector<T>]) -> Vector<T> {
    bodies.iter().zip(origins).fold(Vector::zero(), |sum, (body, origin)| {
        sum + body.moments.first + origin.scaled(body.moments.mass)
    })
}

/// Mass by its moments about an origin: `m`, `h = ∫r dm`, `Σ = ∫r rᵀ dm`.
#[derive(Clone, Copy)]
pub(super) struct Moments<T> {
    /// kg
    pub(super) mass: T,
    /// kg·m
    pub(super) first: Vector<T>,
    /// kg·m²
    pub(super) second: Matrix<T>,
}

impl<T: Scalar> Moments<T> {
    /// No mass.
    pub(super) fn zero() -> Self {
        Self { mass: T::zero(), first: Vector::zero(), second: Matrix::zero() }
    }

    fn turned(self, rotation: Matrix<T>) -> Self {
        Self {
            mass: self.mass,
            first: rotation.times(self.first),
            second: rotation.product(self.second).product(rotation.transpose()),
        }
    }

    /// The same mass about the parent's origin, from which this origin has the given offset.
    pub(super) fn shifted(self, offset: Vector<T>) -> Self {
        let first = self.first + offset.scaled(self.mass);
        Self {
            mass: self.mass,
            first,
            second: self.second + Matrix::outer(first, offset) + Matrix::outer(offset, self.first),
        }
    }

    /// `J·w`, with the rotational inertia `J = tr(Σ)·1 − Σ`.
    #[inline(always)]
    pub(super) fn rotational_times(&self, w: Vector<T>) -> Vector<T> {
        self.second.trace_minus_times(w)
    }

    /// The wrench that gives a body at rest the acceleration `a`; of a velocity, the momentum.
    #[inline(always)]
    pub(super) fn wrench_of(&self, a: Twist<T>) -> Wrench<T> {
        Wrench {
            moment: self.rotational_times(a.angular) + self.first.cross(a.linear),
            force: a.angular.cross(self.first) + a.linear.scaled(self.mass),
        }
    }

    /// The wrench that a body needs for its speed alone: `w × Jw` and `w × (w × h)`.
    #[inline(always)]
    pub(super) fn centripetal_wrench(&self, w: Vector<T>) -> Wrench<T> {
        Wrench { moment: w.cross(self.rotational_times(w)), force: w.cross(w.cross(self.first)) }
    }
}

impl<T: Scalar> Add for Moments<T> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { mass: self.mass + rhs.mass, first: self.first + rhs.first, second: self.second + rhs.second }
    }
}
