//! All that hangs on each joint as one body: its mass, its momenta, the wrench on it; summed from the tips.

use core::mem::replace;

use super::place::Placed;
use super::{InLanes, Vectors, add, entry, set, six_at};
use crate::__private::recursion::screw::{Twist, Wrench};
use crate::__private::recursion::vector::{Matrix, Vector};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// Adds to each link's numbers those of all that hangs on it, as they are. What goes to the link right before stays in
    /// registers, and the sums of all numbers run side by side.
    #[inline(always)]
    fn sum<const K: usize>(&self, mut numbers: [&mut [T; N]; K]) {
        let mut sums = [T::zero(); K];
        for k in (0..N).rev() {
            for (x, sum) in numbers.iter_mut().zip(&mut sums) {
                *sum += entry(x.as_slice(), k);
                set(x.as_mut_slice(), k, *sum);
            }
            if self.is_chain {
                continue;
            }
            let parts = replace(&mut sums, [T::zero(); K]);
            match self.parent(k) {
                Some(parent) if parent + 1 == k => sums = parts,
                Some(parent) => {
                    for (x, part) in numbers.iter_mut().zip(parts) {
                        add(x.as_mut_slice(), parent, part);
                    }
                }
                None => {}
            }
        }
    }

    /// Adds to the parents' numbers what each link gives them: along a chain in lanes.
    #[inline(always)]
    fn give<const K: usize>(&self, mut numbers: [&mut [T; N]; K], gift: impl Fn(usize) -> [T; K]) {
        if self.is_chain {
            for k in 1..N {
                let gift = gift(k);
                for (x, gift) in numbers.iter_mut().zip(gift) {
                    add(x.as_mut_slice(), k - 1, gift);
                }
            }
            return;
        }
        for k in 0..N {
            let Some(parent) = self.parent(k) else { continue };
            for (x, gift) in numbers.iter_mut().zip(gift(k)) {
                add(x.as_mut_slice(), parent, gift);
            }
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
            let product = |i: usize, j: usize| match (half.get(i), axes.get(j)) {
                (Some(a), Some(b)) => a.dot(*b),
                _ => T::zero(),
            };
            let turned =
                [product(0, 0), product(1, 1), product(2, 2), product(0, 1), product(0, 2), product(1, 2)];
            set(&mut moments.mass, k, entry(&masses.mass, link));
            moments.first.set(k, rotation.times(Vector([entry(x, link), entry(y, link), entry(z, link)])));
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
        Moments { mass: entry(&self.mass, k), first: self.first.at(k), second: six_at(&self.second, k) }
    }
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// Adds to each link's moments those of all that hangs on it, each about its own link's origin.
    #[inline(never)]
    pub(super) fn collect_moments(&self, placed: &Placed<T, N>, moments: &mut MomentsInLanes<T, N>) {
        let MomentsInLanes { mass, first, second } = moments;
        self.sum([mass]);
        self.give(first.0.each_mut(), |k| placed.offsets.at(k).scaled(entry(mass, k)).0);
        self.sum(first.0.each_mut());
        // Σ + f dᵀ + d hᵀ, with the first moment f from the parent's origin.
        self.give(second.each_mut(), |k| {
            let (Vector([x, y, z]), Vector([hx, hy, hz])) = (placed.offsets.at(k), first.at(k));
            let Vector([fx, fy, fz]) = first.at(k).plus_scaled(placed.offsets.at(k), entry(mass, k));
            [
                fx.mul_add(x, x * hx),
                fy.mul_add(y, y * hy),
                fz.mul_add(z, z * hz),
                fx.mul_add(y, x * hy),
                fx.mul_add(z, x * hz),
                fy.mul_add(z, y * hz),
            ]
        });
        self.sum(second.each_mut());
    }

    /// The same of momenta.
    #[inline(never)]
    pub(super) fn collect_momenta(&self, placed: &Placed<T, N>, momenta: &mut MomentaInLanes<T, N>) {
        let MomentaInLanes { first, zeroth } = momenta;
        self.sum(zeroth.0.each_mut());
        for (axis, row) in first.iter_mut().enumerate() {
            self.give(row.0.each_mut(), |k| {
                let Vector(offset) = placed.offsets.at(k);
                zeroth.at(k).scaled(entry(&offset, axis)).0
            });
        }
        let [Vectors([a, b, c], _), Vectors([d, e, f], _), Vectors([g, h, i], _)] = first;
        self.sum([a, b, c, d, e, f, g, h, i]);
    }

    /// The same of wrenches.
    #[inline(never)]
    pub(super) fn collect_wrenches(&self, placed: &Placed<T, N>, wrenches: &mut WrenchesInLanes<T, N>) {
        let WrenchesInLanes { moments, forces } = wrenches;
        self.sum(forces.0.each_mut());
        self.give(moments.0.each_mut(), |k| placed.offsets.at(k).cross(forces.at(k)).0);
        self.sum(moments.0.each_mut());
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

    #[inline(always)]
    pub(super) fn at(&self, k: usize) -> Momenta<T> {
        let [x, y, z] = &self.first;
        Momenta { first: Matrix([x.at(k).0, y.at(k).0, z.at(k).0]), zeroth: self.zeroth.at(k) }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, momenta: Momenta<T>) {
        for (rows, row) in self.first.iter_mut().zip(momenta.first.0) {
            rows.set(k, Vector(row));
        }
        self.zeroth.set(k, momenta.zeroth);
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
        Wrench { moment: self.moments.at(k), force: self.forces.at(k) }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, wrench: Wrench<T>) {
        self.moments.set(k, wrench.moment);
        self.forces.set(k, wrench.force);
    }
}
