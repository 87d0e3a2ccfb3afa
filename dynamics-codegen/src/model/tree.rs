//! The kinematic tree in numbers or expressions: moving links, frames, gravity.

use crate::spatial::{Pose, PseudoInertia, Scalar, Vector3};

/// How a joint of one degree of freedom moves its link, along or about the joint frame's z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Turns about z by the angle q, rad.
    Revolute,
    /// Slides along z by the distance q, m.
    Prismatic,
}

/// A moving link, its joint, and its place in the tree. Link `k` has the coordinate `k`.
///
/// The link's frame is the joint's moving frame: z is the axis, and at `q = 0` it has the pose `placement`
/// in the parent link's frame (in the world's, without a parent).
#[derive(Clone, Copy, Debug)]
pub struct Link<S> {
    /// The parent link, always of smaller index; `None` is the world.
    pub parent: Option<usize>,
    /// Revolute or prismatic.
    pub motion: Motion,
    /// `X_PJ`
    pub placement: Pose<S>,
    /// All mass that moves with the link, welded bodies included, in the link's frame.
    pub inertia: PseudoInertia<S>,
}

/// A body's frame or a named frame, at rest on a link (on the world, without a link).
#[derive(Clone, Debug)]
pub struct Frame<S> {
    /// The name of the body.
    pub name: String,
    /// The link that carries it.
    pub link: Option<usize>,
    /// Its pose in the link's frame.
    pub pose: Pose<S>,
}

/// A tree of links: all that the recursions need.
#[derive(Clone, Debug)]
pub struct Tree<S> {
    /// The moving links, parents before children.
    pub links: Vec<Link<S>>,
    /// Mass at rest in the world: it moves nothing, and still has potential energy.
    pub base: PseudoInertia<S>,
    /// The frames, in the order of the bodies.
    pub frames: Vec<Frame<S>>,
    /// The acceleration of free fall in world axes, m/s².
    pub gravity: Vector3<S>,
}

impl<S: Scalar> Tree<S> {
    /// The number of degrees of freedom.
    pub fn dof(&self) -> usize {
        self.links.len()
    }

    /// The tree with `f` applied to each quantity.
    pub fn map<R: Scalar>(&self, mut f: impl FnMut(S) -> R) -> Tree<R> {
        let link = |link: &Link<S>, f: &mut dyn FnMut(S) -> R| Link {
            parent: link.parent,
            motion: link.motion,
            placement: link.placement.map(&mut *f),
            inertia: link.inertia.map(f),
        };
        Tree {
            links: self.links.iter().map(|l| link(l, &mut f)).collect(),
            base: self.base.map(&mut f),
            frames: self
                .frames
                .iter()
                .map(|frame| Frame {
                    name: frame.name.clone(),
                    link: frame.link,
                    pose: frame.pose.map(&mut f),
                })
                .collect(),
            gravity: self.gravity.map(f),
        }
    }
}
