//! The functions of one frame, without the frame's type.

use dynamics_core::prelude::*;

type OfPosition<R, T, O, const NQ: usize> = fn(&R, &SVector<T, NQ>) -> O;
type OfVelocity<R, T, const NQ: usize, const NV: usize> =
    fn(&R, &SVector<T, NQ>, &SVector<T, NV>) -> SVector<T, 6>;
type OfAcceleration<R, T, const NQ: usize, const NV: usize> =
    fn(&R, &SVector<T, NQ>, &SVector<T, NV>, &SVector<T, NV>) -> SVector<T, 6>;
type OfWrench<R, T, const NQ: usize, const NV: usize> =
    fn(&R, &SVector<T, NQ>, &SVector<T, 6>) -> SVector<T, NV>;

/// The functions of one frame; pairs are in the frame's own axes and in the world's.
pub struct Frames<R, T, const NQ: usize, const NV: usize> {
    pub(crate) name: &'static str,
    pub(crate) pose: OfPosition<R, T, Pose<T>, NQ>,
    pub(crate) jacobian: [OfPosition<R, T, SMatrix<T, 6, NV>, NQ>; 2],
    pub(crate) velocity: [OfVelocity<R, T, NQ, NV>; 2],
    pub(crate) acceleration: [OfAcceleration<R, T, NQ, NV>; 2],
    pub(crate) bias_acceleration: [OfVelocity<R, T, NQ, NV>; 2],
    pub(crate) external_forces: [OfWrench<R, T, NQ, NV>; 2],
}

/// The functions of the frame `F`.
pub fn frame<F, R, T, const NQ: usize, const NV: usize>() -> Frames<R, T, NQ, NV>
where
    F: Frame<R, T, NQ, NV>,
    R: Mechanism,
    T: Scalar,
{
    Frames {
        name: F::NAME,
        pose: R::pose::<F>,
        jacobian: [R::jacobian::<F>, R::world_jacobian::<F>],
        velocity: [R::velocity::<F>, R::world_velocity::<F>],
        acceleration: [R::acceleration::<F>, R::world_acceleration::<F>],
        bias_acceleration: [R::bias_acceleration::<F>, R::world_bias_acceleration::<F>],
        external_forces: [R::external_forces::<F>, R::world_external_forces::<F>],
    }
}
