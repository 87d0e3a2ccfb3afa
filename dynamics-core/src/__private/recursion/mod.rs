//! The dynamics of a tree of links by recursion over a table of its links.
//!
//! For robots so large that straight-line code would be too long: the generated code fills the table and calls
//! this. Every vector is in world axes, every moment about the origin of its own link's frame; so that nothing
//! is turned between links and no precision is lost far from the world's origin. Nothing compares scalars. A
//! `parent` that is not smaller than the link's own index counts as the world.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008; each file names its own source.

mod aba;
mod composite;
mod energy;
mod forward;
mod frames;
mod motion;
mod place;
mod rnea;
mod screw;
mod sweep;
mod vector;

use crate::scalar::Scalar;
use nalgebra::SVector;

/// What one moving link is made of. The link's frame is its joint's moving frame: z is the axis, and at `q = 0`
/// it has the pose (`rotation`, `position`) in the parent link's frame.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    /// The parent link, always of smaller index; `None` is the world.
    pub parent: Option<usize>,
    /// Whether the joint slides along z by `q` (m) instead of turning about z by `q` (rad).
    pub prismatic: bool,
    /// `R_PJ`, by rows: from the link's axes at `q = 0` to the parent's.
    pub rotation: [[T; 3]; 3],
    /// `p_PJ`: the origin of the link's frame at `q = 0` in the parent's frame, m.
    pub position: [T; 3],
    /// The mass, kg.
    pub mass: T,
    /// The first moment `h = ∫r dm` about the origin of the link's frame, in its axes, kg·m.
    pub first: [T; 3],
    /// The second moment `Σ = ∫r rᵀ dm` likewise, kg·m²: xx, yy, zz, xy, xz, yz.
    pub second: [T; 6],
}

/// A robot: link `k` moves by the coordinate `k`.
#[derive(Clone, Copy, Debug)]
pub struct Tree<T, const N: usize> {
    /// The moving links, parents before children.
    pub links: [Link<T>; N],
    /// Mass at rest in the world, kg: it moves nothing, and still has potential energy.
    pub base_mass: T,
    /// The first moment of that mass about the world's origin, kg·m.
    pub base_first: [T; 3],
    /// The acceleration of free fall in world axes, m/s².
    pub gravity: [T; 3],
}

/// The entries of `x`.
#[inline(always)]
fn entries<T: Scalar, const N: usize>(x: &SVector<T, N>) -> &[T; N] {
    let [entries] = &x.data.0;
    entries
}
