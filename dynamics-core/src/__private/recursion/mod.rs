//! The dynamics of a tree of links by recursion over a table of its links.
//!
//! For robots so large that straight-line code would be too long: the generated code has the table, or fills it from
//! the robot's fields, and calls this. Every vector is in world axes, every moment about the origin of its own link's
//! frame; so that nothing is turned between links and no precision is lost far from the world's origin. Nothing compares scalars. A
//! `parent` that is not smaller than the link's own index counts as the world; a coordinate or a speed that is
//! not there is zero, and nothing is written to it.
//!
//! A joint is known by its *columns*: one for each of its speeds, the twist of the link at unit speed, at rest in
//! the link's own frame. Several links may move by one speed, each with its own ratio; their columns add up.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008; each file names its own source.

mod aba;
mod centroid;
mod composite;
mod constant;
mod energy;
mod factor;
mod forward;
mod frames;
mod joint;
mod lanes;
mod motion;
mod passive;
mod place;
mod rnea;
mod screw;
mod sweep;
mod vector;

use crate::__private::entry;
use crate::scalar::Scalar;
use nalgebra::SVector;

pub use constant::same;
pub use lanes::InLanes;

/// A robot of `NL` moving links with `NQ` coordinates and `NV` speeds.
#[derive(Clone, Copy, Debug)]
pub struct Tree<T, const NL: usize, const NQ: usize, const NV: usize> {
    /// The moving links, parents before children.
    pub links: [Link<T>; NL],
    /// Their masses.
    pub masses: Masses<T, NL>,
    /// Mass at rest in the world, kg: it moves nothing, and still has potential energy.
    pub base_mass: T,
    /// The first moment of that mass about the world's origin, kg·m.
    pub base_first: [T; 3],
    /// The acceleration of free fall in world axes, m/s².
    pub gravity: [T; 3],
}

/// What one moving link is made of. The link's frame is its joint's moving frame; while the joint is at zero, it
/// has the pose (`rotation`, `position`) in the parent link's frame.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    /// The parent link, always of smaller index; `None` is the world.
    pub parent: Option<usize>,
    /// How the link moves on its parent.
    pub joint: Joint<T>,
    /// `R_PJ`, by rows: from the link's axes to the parent's while the joint is at zero.
    pub rotation: [[T; 3]; 3],
    /// `p_PJ`: the origin of the link's frame in the parent's frame while the joint is at zero, m.
    pub position: [T; 3],
}

/// The links' own masses, number by number, so that loops over links run in lanes.
#[derive(Clone, Copy, Debug)]
pub struct Masses<T, const NL: usize> {
    /// The masses, kg; a link between the parts of a composed joint has none.
    pub mass: [T; NL],
    /// The first moments `h = ∫r dm` about the origins of the links' frames, in their axes, kg·m: x, y, z.
    pub first: [[T; NL]; 3],
    /// The second moments `Σ = ∫r rᵀ dm` likewise, kg·m²: xx, yy, zz, xy, xz, yz.
    pub second: [[T; NL]; 6],
}

/// How a link moves on its parent.
#[derive(Clone, Copy, Debug)]
pub enum Joint<T> {
    /// Turns about z of the link, rad.
    Revolute(Drive<T>, Passive<T>),
    /// Slides along z of the link, m.
    Prismatic(Drive<T>, Passive<T>),
    /// Turns about the link's origin: from `q` on a unit quaternion i, j, k, w that takes the link's axes to those
    /// at zero, from `v` on the angular velocity in the link's axes, rad/s.
    Ball {
        /// The first coordinate of four.
        q: usize,
        /// The first speed of three.
        v: usize,
    },
    /// Moves freely: from `q` on the position of the link's origin in the frame at zero, m, and a unit quaternion
    /// as of a ball joint; from `v` on the link's twist in its own axes, linear first, m/s and rad/s.
    Free {
        /// The first coordinate of seven.
        q: usize,
        /// The first speed of six.
        v: usize,
    },
}

/// What moves a joint of one degree of freedom: it stands at `p = ratio·q[q] + offset` and moves with
/// `s = ratio·v[v]`. Joints that follow one another have one drive each, with the same indices.
#[derive(Clone, Copy, Debug)]
pub struct Drive<T> {
    /// Which coordinate.
    pub q: usize,
    /// Which speed.
    pub v: usize,
    /// How far the joint moves with it.
    pub ratio: T,
    /// Where the joint is while the coordinate is zero.
    pub offset: T,
}

/// What a joint of one degree of freedom does by itself, in terms of its own position `p` and speed `s`: it takes
/// `damping·s + friction(s) + stiffness·(p − rest)` of the joint force, and `armature` is added to the inertia.
#[derive(Clone, Copy, Debug)]
pub struct Passive<T> {
    /// Inertia of what turns with the joint's speed alone, kg·m² (kg).
    pub armature: T,
    /// Viscous damping, N·m·s/rad (N·s/m).
    pub damping: T,
    /// Dry friction, if there is any: without it nothing is divided by the speed.
    pub friction: Option<Friction<T>>,
    /// Stiffness of the spring, N·m/rad (N/m).
    pub stiffness: T,
    /// Where the spring is at rest, rad (m).
    pub rest: T,
}

/// Dry friction made smooth: `force·s/√(s² + speed²)`.
#[derive(Clone, Copy, Debug)]
pub struct Friction<T> {
    /// What it comes to at high speeds, N·m (N).
    pub force: T,
    /// The speed at which it has grown to 1/√2 of that, rad/s (m/s); not zero.
    pub speed: T,
}

/// The entries of `x`.
#[inline(always)]
fn entries<T: Scalar, const N: usize>(x: &SVector<T, N>) -> &[T; N] {
    let [entries] = &x.data.0;
    entries
}
