//! Trees all of whose numbers are known when the robot is compiled: they stand in memory that is never written, instead of
//! being written anew in each call. Of long robots in lanes over links that is a tenth of `M` and a twentieth of the others.

use core::any::Any;

use super::{Drive, Friction, Joint, Link, Masses, Passive, Tree};
use crate::scalar::Scalar;

impl<const NL: usize, const NQ: usize, const NV: usize> Tree<f64, NL, NQ, NV> {
    /// What `read` makes of this tree, whose numbers `single` has rounded: of the one that has numbers of type `T`, or else
    /// of a copy of this one.
    ///
    /// Which it is the compiler knows, and nothing is left of the question.
    #[inline(always)]
    pub fn read_in<T: Scalar, R>(
        &'static self,
        single: &'static Tree<f32, NL, NQ, NV>,
        read: impl FnOnce(&Tree<T, NL, NQ, NV>) -> R,
    ) -> R {
        let trees: [&dyn Any; 2] = [self, single];
        let lifted;
        read(match trees.into_iter().find_map(<dyn Any>::downcast_ref) {
            Some(tree) => tree,
            None => {
                lifted = self.lifted();
                &lifted
            }
        })
    }

    /// The same robot in another scalar.
    pub fn lifted<T: Scalar>(&self) -> Tree<T, NL, NQ, NV> {
        Tree {
            links: self.links.map(|link| Link {
                parent: link.parent,
                joint: match link.joint {
                    Joint::Revolute(drive, passive) => Joint::Revolute(drive.lifted(), passive.lifted()),
                    Joint::Prismatic(drive, passive) => Joint::Prismatic(drive.lifted(), passive.lifted()),
                    Joint::Ball { q, v } => Joint::Ball { q, v },
                    Joint::Free { q, v } => Joint::Free { q, v },
                },
                rotation: link.rotation.map(|row| row.map(T::of)),
                position: link.position.map(T::of),
            }),
            masses: Masses {
                mass: self.masses.mass.map(T::of),
                first: self.masses.first.map(|x| x.map(T::of)),
                second: self.masses.second.map(|x| x.map(T::of)),
            },
            base_mass: T::of(self.base_mass),
            base_first: self.base_first.map(T::of),
            gravity: self.gravity.map(T::of),
        }
    }
}

impl Drive<f64> {
    fn lifted<T: Scalar>(self) -> Drive<T> {
        Drive { q: self.q, v: self.v, ratio: T::of(self.ratio), offset: T::of(self.offset) }
    }
}

impl Passive<f64> {
    fn lifted<T: Scalar>(self) -> Passive<T> {
        Passive {
            armature: T::of(self.armature),
            damping: T::of(self.damping),
            friction: self
                .friction
                .map(|Friction { force, speed }| Friction { force: T::of(force), speed: T::of(speed) }),
            stiffness: T::of(self.stiffness),
            rest: T::of(self.rest),
        }
    }
}
