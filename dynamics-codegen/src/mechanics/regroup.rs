//! Mass that may belong to a parent goes there: the base parameters.
//!
//! A distribution `(m, h_z, Σ_zz)` on a revolute joint's own axis moves with the parent as well; so does all
//! of `Σ` of a link that slides, since it turns with its parent, and the mass of a link that turns about a point, as
//! if it were at that point. After it a revolute link has seven parameters, a prismatic one four, one on a ball joint
//! nine; a free one keeps its ten. Exact for trees, from the tips to the base.
//!
//! M. Gautier, W. Khalil, *Direct calculation of minimum set of inertial parameters of serial robots*, 1990.

use super::normal::NormalTree;
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// The same dynamics and energies, with as little mass on each link as possible.
pub fn regroup<S: Scalar>(tree: &NormalTree<S>) -> NormalTree<S> {
    let mut tree = tree.clone();
    for k in (0..tree.links.len()).rev() {
        let gain = match tree.links[k].motion {
            Motion::Revolute => take_axial_mass(&mut tree, k),
            Motion::Prismatic => take_second_moment(&mut tree, k),
            Motion::Ball => take_mass(&mut tree, k),
            Motion::Free => continue,
        };
        let parent = match tree.links[k].parent {
            Some(parent) => &mut tree.links[parent].inertia,
            None => &mut tree.at_rest,
        };
        *parent = *parent + gain;
    }
    tree
}

/// Takes `(m, h_z, Σ_zz)` off the revolute link `k`; returns it in the parent's frame.
fn take_axial_mass<S: Scalar>(tree: &mut NormalTree<S>, k: usize) -> PseudoInertia<S> {
    let link = &mut tree.links[k];
    let (mass, first, second) = (link.inertia.mass, link.inertia.first.0[2], link.inertia.second.zz);
    link.inertia.mass = S::zero();
    link.inertia.first.0[2] = S::zero();
    link.inertia.second.zz = S::zero();
    let (position, axis) = (link.position, link.turn.up(Vector3::unit_z()));
    PseudoInertia {
        mass,
        first: position.scale(mass) + axis.scale(first),
        second: Symmetric3::outer_self(mass, position)
            + Symmetric3::outer_twice(position, axis.scale(first))
            + Symmetric3::outer_self(second, axis),
    }
}

/// Takes all of `Σ` off the prismatic link `k`; returns it in the parent's axes.
fn take_second_moment<S: Scalar>(tree: &mut NormalTree<S>, k: usize) -> PseudoInertia<S> {
    let link = &mut tree.links[k];
    let second = std::mem::replace(&mut link.inertia.second, Symmetric3::zero());
    let about_z = link.offset;
    let rotation = link.turn.matrix() * Matrix3::rotation_z(about_z.cos, about_z.sin);
    PseudoInertia { second: second.rotated(rotation), ..PseudoInertia::zero() }
}

/// Takes the mass off the link `k` of a ball joint; returns it in the parent's frame, at the joint's centre.
fn take_mass<S: Scalar>(tree: &mut NormalTree<S>, k: usize) -> PseudoInertia<S> {
    let link = &mut tree.links[k];
    let mass = std::mem::replace(&mut link.inertia.mass, S::zero());
    let position = link.position;
    PseudoInertia { mass, first: position.scale(mass), second: Symmetric3::outer_self(mass, position) }
}
