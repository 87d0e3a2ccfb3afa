//! All that hangs on each joint as one body: its mass, its momenta, the wrench on it; summed from the tips.

use super::place::Placed;
use super::{InLanes, Vectors, at, set, six_at};
use crate::__private::recursion::screw::{Twist, Wrench};
use crate::__private::recursion::vector::{Matrix, Vector};
use crate::scalar::Scalar;

/// What adds up along the tree once it is counted from the same origin.
pub(super) trait Additive<T: Scalar, const N: usize>: Copy {
    /// It for each link, number by number.
    type Lanes;
    fn read(all: &Self::Lanes, k: usize) -> Self;
    fn write(self, all: &mut Self::Lanes, k: usize);
    fn plus(self, other: Self) -> Self;
    /// The same from the parent's origin, from which this origin has the given offset.
    fn shifted(self, offset: Vector<T>) -> Self;
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// Adds to each link's value those of all that hangs on it. What goes to the link right before stays in registers.
    #[inline]
    pub(super) fn collect<X: Additive<T, N>>(&self, offsets: &[Vector<T>; N], all: &mut X::Lanes) {
        let mut carried: Option<(usize, X)> = None;
        for (k, offset) in offsets.iter().enumerate().rev() {
            let mut value = X::read(all, k);
            match carried {
                Some((parent, part)) if parent == k => value = value.plus(part),
                Some((parent, part)) => X::read(all, parent).plus(part).write(all, parent),
                None => {}
            }
            value.write(all, k);
            carried = self.parent(k).map(|parent| (parent, value.shifted(*offset)));
        }
    }

    /// Writes the links' own moments in world axes, over zeros.
    pub(super) fn moments(&self, placed: &Placed<T, N>, moments: &mut MomentsInLanes<T, N>) {
        let masses = &self.tree.masses;
        let [x, y, z] = &masses.first;
        for link in 0..NL {
            let k = Self::BEFORE + link;
            let rotation = placed.rotation(k);
            let half = rotation.product(Matrix::symmetric(six_at(&masses.second, link))).0.map(Vector);
            let axes = rotation.0.map(Vector);
            let entry = |i: usize, j: usize| match (half.get(i), axes.get(j)) {
                (Some(a), Some(b)) => a.dot(*b),
                _ => T::zero(),
            };
            let turned = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)];
            set(&mut moments.mass, k, at(&masses.mass, link));
            moments.first.set(k, rotation.times(Vector([at(x, link), at(y, link), at(z, link)])));
            for (x, value) in moments.second.iter_mut().zip(turned) {
                set(x, k, value);
            }
        }
    }
}

/// Mass by its moments about an origin: `m`, `h = ∫r dm`, `Σ = ∫r rᵀ dm` as xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy)]
pub(super) struct Moments<T> {
    pub(super) mass: T,
    pub(super) first: Vector<T>,
    pub(super) second: [T; 6],
}

impl<T: Scalar> Moments<T> {
    /// `J·w`, with the rotational inertia `J = tr(Σ)·1 − Σ`.
    #[inline(always)]
    pub(super) fn rotational_times(&self, w: Vector<T>) -> Vector<T> {
        Matrix::symmetric(self.second).trace_minus_times(w)
    }

    /// The wrench that gives a body at rest the acceleration `a`; of a velocity, the momentum.
    #[inline(always)]
    pub(super) fn wrench_of(&self, a: Twist<T>) -> Wrench<T> {
        Wrench {
            moment: self.rotational_times(a.angular) + self.first.cross(a.linear),
            force: a.angular.cross(self.first) + a.linear.scaled(self.mass),
        }
    }
}

/// [`Moments`] of each link.
#[derive(Clone)]
pub(super) struct MomentsInLanes<T, const N: usize> {
    mass: [T; N],
    first: Vectors<T, N>,
    second: [[T; N]; 6],
}

impl<T: Scalar, const N: usize> MomentsInLanes<T, N> {
    pub(super) fn zero() -> Self {
        Self { mass: [T::zero(); N], first: Vectors::zero(), second: [[T::zero(); N]; 6] }
    }

    #[inline(always)]
    pub(super) fn at(&self, k: usize) -> Moments<T> {
        Moments::read(self, k)
    }
}

impl<T: Scalar, const N: usize> Additive<T, N> for Moments<T> {
    type Lanes = MomentsInLanes<T, N>;

    #[inline(always)]
    fn read(all: &Self::Lanes, k: usize) -> Self {
        Self { mass: at(&all.mass, k), first: all.first.at(k), second: six_at(&all.second, k) }
    }

    #[inline(always)]
    fn write(self, all: &mut Self::Lanes, k: usize) {
        set(&mut all.mass, k, self.mass);
        all.first.set(k, self.first);
        for (x, value) in all.second.iter_mut().zip(self.second) {
            set(x, k, value);
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let ([a, b, c, d, e, f], [u, v, w, x, y, z]) = (self.second, other.second);
        Self {
            mass: self.mass + other.mass,
            first: self.first + other.first,
            second: [a + u, b + v, c + w, d + x, e + y, f + z],
        }
    }

    #[inline(always)]
    fn shifted(self, offset: Vector<T>) -> Self {
        let Vector([x, y, z]) = offset;
        let Vector([hx, hy, hz]) = self.first;
        let first = self.first.plus_scaled(offset, self.mass);
        let Vector([fx, fy, fz]) = first;
        let [xx, yy, zz, xy, xz, yz] = self.second;
        // Σ + f dᵀ + d hᵀ, with the first moment f from the new origin.
        let moved = |own: T, f: T, d: T, e: T, h: T| f.mul_add(d, e.mul_add(h, own));
        Self {
            mass: self.mass,
            first,
            second: [
                moved(xx, fx, x, x, hx),
                moved(yy, fy, y, y, hy),
                moved(zz, fz, z, z, hz),
                moved(xy, fx, y, x, hy),
                moved(xz, fx, z, x, hz),
                moved(yz, fy, z, y, hz),
            ],
        }
    }
}

/// `𝔹` by its blocks, `B = ∫r ṙᵀ dm = Σ ŵᵀ + h vᵀ` and the linear momentum `b = ∫ṙ dm = w × h + m v`.
#[derive(Clone, Copy)]
pub(super) struct Momenta<T> {
    first: Matrix<T>,
    zeroth: Vector<T>,
}

impl<T: Scalar> Momenta<T> {
    /// Those of a body with the velocity `w`, `v`.
    #[inline(always)]
    pub(super) fn new(moments: &Moments<T>, Twist { angular: w, linear: v }: Twist<T>) -> Self {
        let second = Matrix::symmetric(moments.second);
        Self {
            first: second.times_skew_transposed(w) + Matrix::outer(moments.first, v),
            zeroth: w.cross(moments.first) + v.scaled(moments.mass),
        }
    }

    /// The wrench of `𝔹 r̂ᵀ`: `tr(B)·r − Bᵀr` and `r × b`.
    #[inline(always)]
    pub(super) fn wrench_of(&self, r: Vector<T>) -> Wrench<T> {
        Wrench { moment: self.first.transpose().trace_minus_times(r), force: r.cross(self.zeroth) }
    }

    /// `ν` with `tr(Ŝ 𝔹 r̂ᵀ) = ν·r` for a turn `r` about any point.
    #[inline(always)]
    pub(super) fn row_of(&self, twist: Twist<T>) -> Vector<T> {
        self.first.trace_minus_times(twist.angular) + self.zeroth.cross(twist.linear)
    }
}

/// [`Momenta`] of each link.
pub(super) struct MomentaInLanes<T, const N: usize> {
    first: [Vectors<T, N>; 3],
    zeroth: Vectors<T, N>,
}

impl<T: Scalar, const N: usize> MomentaInLanes<T, N> {
    pub(super) fn zero() -> Self {
        Self { first: [Vectors::zero(); 3], zeroth: Vectors::zero() }
    }
}

impl<T: Scalar, const N: usize> Additive<T, N> for Momenta<T> {
    type Lanes = MomentaInLanes<T, N>;

    #[inline(always)]
    fn read(all: &Self::Lanes, k: usize) -> Self {
        let [x, y, z] = &all.first;
        Self { first: Matrix([x.at(k).0, y.at(k).0, z.at(k).0]), zeroth: all.zeroth.at(k) }
    }

    #[inline(always)]
    fn write(self, all: &mut Self::Lanes, k: usize) {
        for (rows, row) in all.first.iter_mut().zip(self.first.0) {
            rows.set(k, Vector(row));
        }
        all.zeroth.set(k, self.zeroth);
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { first: self.first + other.first, zeroth: self.zeroth + other.zeroth }
    }

    #[inline(always)]
    fn shifted(self, offset: Vector<T>) -> Self {
        let Matrix([x, y, z]) = self.first;
        let Vector([dx, dy, dz]) = offset;
        let row = |row: [T; 3], d: T| Vector(row).plus_scaled(self.zeroth, d).0;
        Self { first: Matrix([row(x, dx), row(y, dy), row(z, dz)]), zeroth: self.zeroth }
    }
}

/// A wrench for each link.
pub(super) struct WrenchesInLanes<T, const N: usize> {
    pub(super) moments: Vectors<T, N>,
    pub(super) forces: Vectors<T, N>,
}

impl<T: Scalar, const N: usize> WrenchesInLanes<T, N> {
    /// The moments, then the forces.
    #[inline(always)]
    pub(super) fn both(&self) -> (&Vectors<T, N>, &Vectors<T, N>) {
        (&self.moments, &self.forces)
    }

    pub(super) fn zero() -> Self {
        Self { moments: Vectors::zero(), forces: Vectors::zero() }
    }

    #[inline(always)]
    pub(super) fn at(&self, k: usize) -> Wrench<T> {
        Wrench::read(self, k)
    }
}

impl<T: Scalar, const N: usize> Additive<T, N> for Wrench<T> {
    type Lanes = WrenchesInLanes<T, N>;

    #[inline(always)]
    fn read(all: &Self::Lanes, k: usize) -> Self {
        Self { moment: all.moments.at(k), force: all.forces.at(k) }
    }

    #[inline(always)]
    fn write(self, all: &mut Self::Lanes, k: usize) {
        all.moments.set(k, self.moment);
        all.forces.set(k, self.force);
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn shifted(self, offset: Vector<T>) -> Self {
        Self::shifted(self, offset)
    }
}

/// Several at once: their chains of sums run side by side.
macro_rules! side_by_side {
    ($($part:ident $place:tt),*) => {
        impl<T: Scalar, const N: usize, $($part: Additive<T, N>),*> Additive<T, N> for ($($part,)*) {
            type Lanes = ($($part::Lanes,)*);

            #[inline(always)]
            fn read(all: &Self::Lanes, k: usize) -> Self {
                ($($part::read(&all.$place, k),)*)
            }

            #[inline(always)]
            fn write(self, all: &mut Self::Lanes, k: usize) {
                $(self.$place.write(&mut all.$place, k);)*
            }

            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                ($(self.$place.plus(other.$place),)*)
            }

            #[inline(always)]
            fn shifted(self, offset: Vector<T>) -> Self {
                ($(self.$place.shifted(offset),)*)
            }
        }
    };
}

side_by_side!(A 0, B 1);
side_by_side!(A 0, B 1, C 2);
