//! Where the links are.

use super::{InLanes, Vectors, at, set};
use crate::__private::recursion::vector::{Matrix, Vector};
use crate::scalar::Scalar;

/// The links at a configuration, in world axes.
pub(super) struct Placed<T, const N: usize> {
    /// Where the rotations take x, y and z.
    axes: [Vectors<T, N>; 3],
    /// From the parents' origins to the links'.
    pub(super) offsets: [Vector<T>; N],
    /// From the world's origin to the links'.
    pub(super) origins: Vectors<T, N>,
    /// The joints' unit motions about the links' origins: their turn, and their slide.
    pub(super) turns: Vectors<T, N>,
    pub(super) slides: Vectors<T, N>,
}

impl<T: Scalar, const N: usize> InLanes<'_, T, N> {
    pub(super) fn place(&self, q: &[T; N]) -> Placed<T, N> {
        let mut placed = Placed {
            axes: [Vectors::zero(); 3],
            offsets: [Vector::zero(); N],
            origins: Vectors::zero(),
            turns: Vectors::zero(),
            slides: Vectors::zero(),
        };
        // Whether joints turn, as a factor: lanes do not branch.
        let (mut turns, mut slides) = ([T::zero(); N], [T::zero(); N]);
        for k in 0..N {
            set(if self.turns(k) { &mut turns } else { &mut slides }, k, T::one());
        }
        let (mut sines, mut cosines) = ([T::zero(); N], [T::zero(); N]);
        for k in 0..N {
            let (sine, cosine) = (at(q, k) * at(&turns, k)).sin_cos();
            set(&mut sines, k, sine);
            set(&mut cosines, k, cosine);
        }
        self.place_one_by_one(&sines, &cosines, q, &slides, &mut placed);
        for k in 0..N {
            let [.., z] = &placed.axes;
            let z = z.at(k);
            placed.turns.set(k, z.scaled(at(&turns, k)));
            placed.slides.set(k, z.scaled(at(&slides, k)));
        }
        placed
    }

    /// From the base to the tips; where a link follows its parent at once, the parent's pose is still in registers.
    fn place_one_by_one(
        &self,
        sines: &[T; N],
        cosines: &[T; N],
        q: &[T; N],
        slides: &[T; N],
        placed: &mut Placed<T, N>,
    ) {
        let world = (Matrix::identity(), Vector::zero());
        let mut last = (N, world);
        for (k, link) in self.tree.links.iter().enumerate() {
            let (parent, origin) = match link.parent {
                None => world,
                Some(parent) if parent == last.0 => last.1,
                Some(parent) => (placed.rotation(parent), placed.origins.at(parent)),
            };
            let own = Matrix(link.rotation);
            let rotation = parent.product(own.about_z(at(sines, k), at(cosines, k)));
            let along = own.third_column().scaled(at(q, k) * at(slides, k));
            let offset = parent.times(Vector(link.position) + along);
            let origin = origin + offset;
            for (all, axis) in placed.axes.iter_mut().zip(rotation.transpose().0) {
                all.set(k, Vector(axis));
            }
            set(&mut placed.offsets, k, offset);
            placed.origins.set(k, origin);
            last = (k, (rotation, origin));
        }
    }
}

impl<T: Scalar, const N: usize> Placed<T, N> {
    /// From the link's axes to the world's.
    #[inline(always)]
    pub(super) fn rotation(&self, k: usize) -> Matrix<T> {
        let [x, y, z] = &self.axes;
        Matrix([x.at(k).0, y.at(k).0, z.at(k).0]).transpose()
    }
}
