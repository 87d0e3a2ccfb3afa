//! Where the links are.

use core::array::from_fn;

use super::{InLanes, Vectors, entry, set};
use crate::__private::in_place::laid_down;
use crate::__private::recursion::vector::{Matrix, Vector};
use crate::scalar::Scalar;

/// The links at a configuration, in world axes.
pub(super) struct Placed<T, const N: usize> {
    /// Where the rotations take x, y and z.
    axes: [Vectors<T, N>; 3],
    /// From the parents' origins to the links'.
    pub(super) offsets: Vectors<T, N>,
    /// From the world's origin to the links', or from that of a free base.
    pub(super) origins: Vectors<T, N>,
    /// The joints' unit motions about the links' origins: their turn, and their slide.
    pub(super) turns: Vectors<T, N>,
    pub(super) slides: Vectors<T, N>,
}

/// Three numbers and one that stays zero: a register, in lanes.
type Four<T> = [T; 4];

/// Where a link is: what its rotation does to x, y and z, and its origin.
#[derive(Clone, Copy)]
struct Place<T> {
    axes: [Four<T>; 3],
    origin: Four<T>,
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// Writes where they are, into zeros: what functions return is copied.
    #[inline]
    pub(super) fn place(&self, q: &[T; NQ], placed: &mut Placed<T, N>) {
        // Whether joints turn, as a factor: lanes do not branch.
        let (mut turns, mut slides) = ([T::zero(); N], [T::zero(); N]);
        for k in Self::BASE..N {
            let (turn, slide) = if self.turns(k) { (T::one(), T::zero()) } else { (T::zero(), T::one()) };
            set(&mut turns, k, turn);
            set(&mut slides, k, slide);
        }
        let coordinates = self.coordinates(q);
        let mut angles = coordinates;
        for (angle, turns) in angles.iter_mut().zip(&turns) {
            *angle *= *turns;
        }
        let [sines, cosines] = T::sin_cos_each(angles);
        if Self::BASE > 0 {
            self.place_base(q, placed);
        }
        self.place_one_by_one(&sines, &cosines, &coordinates, &slides, placed);
        for k in Self::BASE..N {
            let [.., z] = &placed.axes;
            let z = z.at(k);
            placed.turns.set(k, z.scaled(entry(&turns, k)));
            placed.slides.set(k, z.scaled(entry(&slides, k)));
        }
    }

    /// A free base: at the origin, its own axes what it moves along and about.
    #[inline(always)]
    fn place_base(&self, q: &[T; NQ], placed: &mut Placed<T, N>) {
        let ([_, _, _, quaternion @ ..], [link, ..]) =
            (from_fn::<T, 7, _>(|i| entry(q, i)), self.tree.links.as_slice())
        else {
            return;
        };
        let axes = Matrix(link.rotation).product(Matrix::of_quaternion(quaternion)).transpose().0;
        let place = Place { axes: axes.map(|axis| four(Vector(axis))), origin: [T::zero(); 4] };
        for (k, axis) in (0..Self::BASE).zip(axes.into_iter().chain(axes)) {
            placed.write(k, &place);
            if k < 3 { &mut placed.slides } else { &mut placed.turns }.set(k, Vector(axis));
        }
    }

    /// From the base to the tips; where a link follows its parent at once, the parent's pose is still in registers.
    #[inline(always)]
    fn place_one_by_one(
        &self,
        sines: &[T; N],
        cosines: &[T; N],
        coordinates: &[T; N],
        slides: &[T; N],
        placed: &mut Placed<T, N>,
    ) {
        let (o, i) = (T::zero(), T::one());
        let world = Place { axes: [[i, o, o, o], [o, i, o, o], [o, o, i, o]], origin: [o; 4] };
        let mut last = if let Some(base) = Self::BASE.checked_sub(1) { placed.place(base) } else { world };
        for k in Self::BASE..N {
            let Some(link) = self.tree.links.get(k - Self::BEFORE) else { continue };
            let parent = match link.parent.map(|parent| parent + Self::BEFORE) {
                None => world,
                Some(parent) if parent + 1 == k => last,
                Some(parent) => placed.place(parent),
            };
            let own = Matrix(link.rotation);
            let along = own.third_column().scaled(entry(coordinates, k) * entry(slides, k));
            let [x, y, z] = own.about_z(entry(sines, k), entry(cosines, k)).transpose().0;
            let offset = combined(&parent.axes, (Vector(link.position) + along).0);
            let mut origin = parent.origin;
            for (x, y) in origin.iter_mut().zip(offset) {
                *x += y;
            }
            let (x, y, z) = (combined(&parent.axes, x), combined(&parent.axes, y), combined(&parent.axes, z));
            last = Place { axes: [x, y, z], origin };
            // LLVM would compute number by number what it writes number by number.
            placed.write(k, &laid_down::<T, _>(last));
            let [x, y, z, _] = laid_down::<T, _>(offset);
            placed.offsets.set(k, Vector([x, y, z]));
        }
    }
}

#[inline(always)]
fn four<T: Scalar>(Vector([x, y, z]): Vector<T>) -> Four<T> {
    [x, y, z, T::zero()]
}

/// `x·a + y·b + z·c` for the axes a, b and c.
#[inline(always)]
fn combined<T: Scalar>([a, b, c]: &[Four<T>; 3], [x, y, z]: [T; 3]) -> Four<T> {
    let mut sum = [T::zero(); 4];
    for (((sum, a), b), c) in sum.iter_mut().zip(a).zip(b).zip(c) {
        *sum = a.mul_add(x, b.mul_add(y, *c * z));
    }
    sum
}

impl<T: Scalar, const N: usize> Placed<T, N> {
    pub(super) fn zero() -> Self {
        Self {
            axes: [Vectors::zero(); 3],
            offsets: Vectors::zero(),
            origins: Vectors::zero(),
            turns: Vectors::zero(),
            slides: Vectors::zero(),
        }
    }

    #[inline(always)]
    fn write(&mut self, k: usize, place: &Place<T>) {
        let vector = |[x, y, z, _]: Four<T>| Vector([x, y, z]);
        for (all, axis) in self.axes.iter_mut().zip(place.axes) {
            all.set(k, vector(axis));
        }
        self.origins.set(k, vector(place.origin));
    }

    #[inline(always)]
    fn place(&self, k: usize) -> Place<T> {
        let [x, y, z] = &self.axes;
        Place { axes: [four(x.at(k)), four(y.at(k)), four(z.at(k))], origin: four(self.origins.at(k)) }
    }

    /// From the link's axes to the world's.
    #[inline(always)]
    pub(super) fn rotation(&self, k: usize) -> Matrix<T> {
        let [x, y, z] = &self.axes;
        Matrix([x.at(k).0, y.at(k).0, z.at(k).0]).transpose()
    }
}
