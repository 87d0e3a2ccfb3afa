//! The tree in normal form: the frames and masses on which the specialised recursions run.
//!
//! Every link's frame has z on its joint's axis and turns by `Rz(q + offset)` after a constant turn; the link of a
//! ball or a free joint keeps its own frame, in which its speeds are written. What is
//! constant between two joints is as sparse as the geometry allows ([`gauge`](super::gauge)), and mass that
//! can belong to a parent does ([`regroup`](super::regroup)). The world's frame is replaced by a base frame.
//!
//! W. Khalil, J.-F. Kleinfinger, *A new geometric notation for open and closed-loop robots*, ICRA 1986.

use super::columns::{Column, Direction, Twist};
use super::rotation::{PlanarTurn, Turn};
use crate::model::{Drive, Motion, Passive};
use crate::spatial::{Matrix3, Pose, PseudoInertia, Scalar, Vector3};

/// A moving link in normal form.
#[derive(Clone, Copy, Debug)]
pub struct NormalLink<S> {
    /// The parent link, of smaller index; `None` is the base.
    pub parent: Option<usize>,
    /// How the joint moves.
    pub motion: Motion,
    /// What moves it; its offset is in `offset` or `position`.
    pub drive: Drive<S>,
    /// What acts in it by itself.
    pub passive: Passive<S>,
    /// The constant turn `R_PJ` from the parent's frame to the joint's.
    pub turn: Turn<S>,
    /// The constant turn about z that adds to the joint's own. It is applied to the joint's sine and cosine, not
    /// added to its coordinate: a sum of angles is rounded like its larger part, and would spoil their reduction.
    pub offset: PlanarTurn<S>,
    /// The turn about z at the configuration at hand, where it is not the joint's own ([`rest`](super::rest)).
    pub about_z: Option<PlanarTurn<S>>,
    /// The origin of the joint's frame in the parent's frame, at `q = 0`.
    pub position: Vector3<S>,
    /// The mass that the recursions see, in the link's frame.
    pub inertia: PseudoInertia<S>,
}

/// A frame at rest on a link (on the base, without a link).
#[derive(Clone, Debug)]
pub struct NormalFrame<S> {
    /// The name of the body.
    pub name: String,
    /// The link that carries it.
    pub link: Option<usize>,
    /// Its pose in the link's frame; in the world, without a link.
    pub pose: Pose<S>,
}

/// A tree of links in normal form.
#[derive(Clone, Debug)]
pub struct NormalTree<S> {
    /// The moving links, parents before children.
    pub links: Vec<NormalLink<S>>,
    /// The base frame in the world.
    pub base: Pose<S>,
    /// Mass at rest, in the base frame. Only the potential energy sees it.
    pub at_rest: PseudoInertia<S>,
    /// The acceleration of free fall in base axes.
    pub gravity: Vector3<S>,
    /// The frames of the bodies.
    pub frames: Vec<NormalFrame<S>>,
    /// The degrees of freedom of the links, one by one.
    pub columns: Vec<Column<S>>,
}

impl<S: Scalar> NormalTree<S> {
    /// The columns of each link.
    pub fn columns_of(&self, link: usize) -> std::ops::Range<usize> {
        let begin = |link| self.columns.partition_point(|column| column.link < link);
        begin(link)..begin(link + 1)
    }

    /// The joints at the configuration `q`.
    pub fn place(&self, q: &[S]) -> Vec<PlacedJoint<S>> {
        self.links.iter().map(|link| PlacedJoint::new(link, q)).collect()
    }

    /// What each link does against its parent at the speeds `v` of the columns; of accelerations, what they add.
    pub fn joint_motions(&self, v: &[S]) -> Vec<Twist<S>> {
        let mut motions = vec![Twist::zero(); self.links.len()];
        for (column, &speed) in self.columns.iter().zip(v) {
            let motion = &mut motions[column.link];
            match column.direction {
                Direction::Along(k) => motion.linear.0[k] = speed,
                Direction::About(k) => motion.angular.0[k] = speed,
            }
        }
        motions
    }

    /// The links from `link` down to the base, `link` first.
    pub fn path_to_base(&self, link: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(link), |&k| self.links[k].parent)
    }
}

/// A joint at a configuration: the pose of the link in its parent's frame, ready to be applied.
#[derive(Clone, Copy, Debug)]
pub struct PlacedJoint<S> {
    /// The constant part of the rotation.
    pub constant: Turn<S>,
    /// The turn about the joint's own z.
    pub about_z: PlanarTurn<S>,
    /// The origin of the link's frame in the parent's frame.
    pub position: Vector3<S>,
    /// The joint's axis in the parent's frame.
    pub axis: Vector3<S>,
    /// How it moves.
    pub motion: Motion,
}

impl<S: Scalar> PlacedJoint<S> {
    fn new(link: &NormalLink<S>, q: &[S]) -> Self {
        let NormalLink { drive, position, .. } = *link;
        let axis = link.turn.up(Vector3::unit_z());
        let own = &q[drive.q..];
        let about_z = link.about_z.unwrap_or_else(|| match link.motion {
            Motion::Revolute => PlanarTurn::of_angle(drive.ratio * own[0]).then(link.offset),
            _ => link.offset,
        });
        let placed = Self { constant: link.turn, about_z, position, axis, motion: link.motion };
        match link.motion {
            Motion::Revolute => placed,
            Motion::Prismatic => Self { position: position + axis.scale(drive.ratio * own[0]), ..placed },
            Motion::Ball => Self { constant: turned(link.turn, own), ..placed },
            Motion::Free => {
                let position = position + link.turn.up(Vector3([own[0], own[1], own[2]]));
                Self { constant: turned(link.turn, &own[3..]), position, ..placed }
            }
        }
    }

    /// `R_PLᵀ v`: from the parent's axes to the link's.
    pub fn down(&self, v: Vector3<S>) -> Vector3<S> {
        self.about_z.down(self.constant.down(v))
    }

    /// `R_PL v`: from the link's axes to the parent's.
    pub fn up(&self, v: Vector3<S>) -> Vector3<S> {
        self.constant.up(self.about_z.up(v))
    }

    /// `R_PL`
    pub fn rotation(&self) -> Matrix3<S> {
        self.constant.matrix() * Matrix3::rotation_z(self.about_z.cos, self.about_z.sin)
    }

    /// Whether the rotation to the parent only permutes the axes.
    pub fn permutes_axes(&self) -> bool {
        self.rotation().0.iter().flatten().all(|x| x.as_sign().is_some())
    }

    /// Whether the joint's axis is one of the parent's axes, up to its sign.
    pub fn axis_is_a_parent_axis(&self) -> bool {
        self.axis.0.iter().all(|x| x.as_sign().is_some())
    }
}

/// The constant turn and behind it that of the unit quaternion that begins with `q`.
fn turned<S: Scalar>(constant: Turn<S>, q: &[S]) -> Turn<S> {
    Turn::General(constant.matrix() * Matrix3::of_quaternion([q[0], q[1], q[2], q[3]]))
}
