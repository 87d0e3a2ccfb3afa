//! The kinematic tree in numbers or expressions: moving links, frames, gravity.

use super::Terms;
use crate::spatial::{Matrix3, Pose, PseudoInertia, Scalar, Vector3};
use crate::symbolic::Real;

/// How a joint moves its link. All kinds of joints are made of these four, with massless links between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Turns about the joint frame's z by an angle, rad.
    Revolute,
    /// Slides along z by a distance, m.
    Prismatic,
    /// Turns about a point: a unit quaternion i, j, k, w; the speed is the angular velocity in the link's own axes.
    Ball,
    /// Is not held: the position in the joint's frame, then a unit quaternion; the speed is the link's twist
    /// against its parent in its own axes, linear first.
    Free,
}

impl Motion {
    /// How many coordinates it has.
    pub fn coordinates(self) -> usize {
        match self {
            Self::Revolute | Self::Prismatic => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }

    /// How many speeds.
    pub fn speeds(self) -> usize {
        match self {
            Self::Revolute | Self::Prismatic => 1,
            Self::Ball => 3,
            Self::Free => 6,
        }
    }
}

/// Which of the robot's coordinates move a joint. Of one degree of freedom it is moved by `ratio·q[q] + offset` at
/// the speed `ratio·v[v]`: joints that follow another one have that one's indices. A ball and a free joint have the
/// coordinates from `q` on and the speeds from `v` on, their ratio is one, and their offset zero.
#[derive(Clone, Copy, Debug)]
pub struct Drive<S> {
    /// The index of the (first) coordinate.
    pub q: usize,
    /// The index of the (first) speed.
    pub v: usize,
    /// Of the joint's speed to the robot's.
    pub ratio: S,
    /// Of the joint's coordinate, rad or m.
    pub offset: S,
}

impl<S: Scalar> Drive<S> {
    /// A joint with coordinates of its own.
    pub fn own(q: usize, v: usize) -> Self {
        Self { q, v, ratio: S::one(), offset: S::zero() }
    }
}

/// What acts in a joint of one degree of freedom by itself: on its own coordinate p at its own speed s the force
/// `damping·s + friction·s/√(s² + friction_speed²) + stiffness·(p − rest)`, on the left-hand side.
#[derive(Clone, Copy, Debug)]
pub struct Passive<S> {
    /// The inertia of rotors as the joint feels it, kg·m² or kg.
    pub armature: S,
    /// N·m·s/rad or N·s/m
    pub damping: S,
    /// Coulomb friction, N·m or N.
    pub friction: S,
    /// The speed within which friction changes its sign, rad/s or m/s; positive where there is friction.
    pub friction_speed: S,
    /// N·m/rad or N/m
    pub stiffness: S,
    /// The coordinate at which the spring rests, rad or m.
    pub rest: S,
}

impl<S: Scalar> Passive<S> {
    /// Nothing acts.
    pub fn none() -> Self {
        let o = S::zero();
        Self { armature: o, damping: o, friction: o, friction_speed: o, stiffness: o, rest: o }
    }

    /// All of it with `f` applied.
    pub fn map<R>(self, mut f: impl FnMut(S) -> R) -> Passive<R> {
        Passive {
            armature: f(self.armature),
            damping: f(self.damping),
            friction: f(self.friction),
            friction_speed: f(self.friction_speed),
            stiffness: f(self.stiffness),
            rest: f(self.rest),
        }
    }
}

/// A moving link, its joint, and its place in the tree.
///
/// The link's frame is the joint's moving frame: z is the axis, and where the joint's coordinate is zero (its pose
/// none) it has the pose `placement` in the parent link's frame (in the world's, without a parent).
#[derive(Clone, Copy, Debug)]
pub struct Link<S> {
    /// The parent link, always of smaller index; `None` is the world.
    pub parent: Option<usize>,
    /// How the joint moves.
    pub motion: Motion,
    /// What moves it.
    pub drive: Drive<S>,
    /// What acts in it by itself.
    pub passive: Passive<S>,
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
    /// The moving links, parents before children, those with coordinates of their own in the order of these.
    pub links: Vec<Link<S>>,
    /// Mass at rest in the world: it moves nothing, and still has potential energy.
    pub base: PseudoInertia<S>,
    /// The frames, in the order of the bodies.
    pub frames: Vec<Frame<S>>,
    /// The acceleration of free fall in world axes, m/s².
    pub gravity: Vector3<S>,
    /// What is added to the energies.
    pub terms: Terms<S>,
}

impl<S> Tree<S> {
    /// NQ, the number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.links.iter().map(|link| link.drive.q + link.motion.coordinates()).max().unwrap_or(0)
    }

    /// NV, the number of degrees of freedom.
    pub fn dof(&self) -> usize {
        self.links.iter().map(|link| link.drive.v + link.motion.speeds()).max().unwrap_or(0)
    }

    /// Whether every joint has one degree of freedom.
    pub fn is_one_dof(&self) -> bool {
        self.links.iter().all(|link| link.motion.speeds() == 1)
    }

    /// For each coordinate that begins a unit quaternion its index.
    pub fn quaternions(&self) -> impl Iterator<Item = usize> + '_ {
        self.links.iter().filter_map(|link| match link.motion {
            Motion::Ball => Some(link.drive.q),
            Motion::Free => Some(link.drive.q + 3),
            Motion::Revolute | Motion::Prismatic => None,
        })
    }
}

impl<S: Real> Tree<S> {
    /// Makes quaternions of unit length; what is all zeros becomes no rotation.
    pub fn normalise(&self, q: &mut [S]) {
        for at in self.quaternions() {
            let quaternion = &mut q[at..at + 4];
            let length = quaternion.iter().fold(S::from(0), |sum, &x| sum + x * x).sqrt();
            match length.is_positive() {
                true => quaternion.iter_mut().for_each(|x| *x = *x / length),
                false => quaternion[3] = S::from(1),
            }
        }
    }
}

impl<S: Scalar> Tree<S> {
    /// `q̇`, NQ, at the speeds `v`: of a quaternion `½ q ∘ (ω, 0)`, of a free joint's position `R v`.
    pub fn configuration_rate(&self, q: &[S], v: &[S]) -> Vec<S> {
        let mut rate = vec![S::zero(); q.len()];
        for link in &self.links {
            let (at, from) = (link.drive.q, link.drive.v);
            let (quaternion, angular) = match link.motion {
                Motion::Revolute | Motion::Prismatic => {
                    rate[at] = v[from];
                    continue;
                }
                Motion::Ball => (at, from),
                Motion::Free => {
                    let linear = Vector3([v[from], v[from + 1], v[from + 2]]);
                    let rotation = Matrix3::of_quaternion([q[at + 3], q[at + 4], q[at + 5], q[at + 6]]);
                    rate[at..at + 3].copy_from_slice(&(rotation * linear).0);
                    (at + 3, from + 3)
                }
            };
            let [i, j, k, w] = [0, 1, 2, 3].map(|c| q[quaternion + c]);
            let [x, y, z] = [0, 1, 2].map(|c| v[angular + c]);
            let half = S::one() / S::from(2);
            let turned = [
                w * x + j * z - k * y,
                w * y + k * x - i * z,
                w * z + i * y - j * x,
                -(i * x + j * y + k * z),
            ];
            for (rate, turned) in rate[quaternion..].iter_mut().zip(turned) {
                *rate = half * turned;
            }
        }
        rate
    }

    /// The tree with `f` applied to each quantity.
    pub fn map<R: Scalar>(&self, mut f: impl FnMut(S) -> R) -> Tree<R> {
        let link = |link: &Link<S>, f: &mut dyn FnMut(S) -> R| Link {
            parent: link.parent,
            motion: link.motion,
            drive: Drive {
                q: link.drive.q,
                v: link.drive.v,
                ratio: f(link.drive.ratio),
                offset: f(link.drive.offset),
            },
            passive: link.passive.map(&mut *f),
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
            gravity: self.gravity.map(&mut f),
            terms: self.terms.map(&mut f),
        }
    }
}
