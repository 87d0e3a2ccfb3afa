//! Mass that may belong to a parent goes there: the base parameters.
//!
//! A distribution `(m, h_z, Σ_zz)` on a revolute joint's own axis moves with the parent as well; so does all
//! of `Σ` of a link that slides, since it turns with its parent, and the mass of a link that turns about a point, as
//! if it were at that point. After it a revolute link has seven parameters, a prismatic one four, one on a ball joint
//! nine; a free one keeps its ten. Exact for trees, from the tips to the base.
//!
//! M. Gautier, W. Khalil, *Direct calculation of minimum set of inertial parameters of serial robots*, 1990.

use super::normal::{NormalLink, NormalTree};
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// The same dynamics and energies, with as little mass on each link as possible.
pub fn regroup<S: Scalar>(tree: &NormalTree<S>) -> NormalTree<S> {
    let mut tree = tree.clone();
    for k in (0..tree.links.len()).rev() {
        let link = &tree.links[k];
        let Split { stays, goes } = split(link, link.inertia);
        let parent = link.parent;
        tree.links[k].inertia = stays;
        let parent = match parent {
            Some(parent) => &mut tree.links[parent].inertia,
            None => &mut tree.at_rest,
        };
        *parent = *parent + goes;
    }
    tree
}

/// A mass on a link in two parts.
pub struct Split<S> {
    /// What only the link can have, in its frame.
    pub stays: PseudoInertia<S>,
    /// What the parent may have as well, in the parent's frame.
    pub goes: PseudoInertia<S>,
}

/// Splits a mass on a link into what stays and what goes.
pub fn split<S: Scalar>(link: &NormalLink<S>, inertia: PseudoInertia<S>) -> Split<S> {
    let goes = match link.motion {
        Motion::Revolute => axial_mass(link, inertia),
        Motion::Prismatic => {
            let rotation = link.turn.matrix() * Matrix3::rotation_z(link.offset.cos, link.offset.sin);
            PseudoInertia { second: inertia.second.rotated(rotation), ..PseudoInertia::zero() }
        }
        Motion::Ball => {
            let (mass, position) = (inertia.mass, link.position);
            let second = Symmetric3::outer_self(mass, position);
            PseudoInertia { mass, first: position.scale(mass), second }
        }
        Motion::Free => PseudoInertia::zero(),
    };
    let mut stays = inertia;
    match link.motion {
        Motion::Revolute => {
            (stays.mass, stays.first.0[2], stays.second.zz) = (S::zero(), S::zero(), S::zero());
        }
        Motion::Prismatic => stays.second = Symmetric3::zero(),
        Motion::Ball => stays.mass = S::zero(),
        Motion::Free => {}
    }
    Split { stays, goes }
}

/// `(m, h_z, Σ_zz)` of a mass on a revolute link, in the parent's frame.
fn axial_mass<S: Scalar>(link: &NormalLink<S>, inertia: PseudoInertia<S>) -> PseudoInertia<S> {
    let (mass, first, second) = (inertia.mass, inertia.first.0[2], inertia.second.zz);
    let (position, axis) = (link.position, link.turn.up(Vector3::unit_z()));
    PseudoInertia {
        mass,
        first: position.scale(mass) + axis.scale(first),
        second: Symmetric3::outer_self(mass, position)
            + Symmetric3::outer_twice(position, axis.scale(first))
            + Symmetric3::outer_self(second, axis),
    }
}
