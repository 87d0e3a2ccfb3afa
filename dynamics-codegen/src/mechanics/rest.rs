//! Frames that stay behind while their links turn, where a mass is sooner turned than a motion and a wrench.
//!
//! In a frame that turns with its link the mass is constant, and five vectors are turned: `ω`, `U z` and `a` on the way
//! to the tips, the force and the moment on the way back. In one that is at the link and does not turn about its joint,
//! the mass is turned instead, and where the next joint is: that is less at a tip, and nothing at all for a body that is
//! the same all round its joint, whose angle then drops out. Between joints with parallel axes the turns add up to one, by
//! the sum of their angles.
//!
//! No recursion knows of it: they take the components of a mass at the configuration at hand in any frame.

use super::normal::{NormalLink, NormalTree};
use super::rotation::{PlanarTurn, Turn};
use crate::model::Motion;
use crate::spatial::{PseudoInertia, Symmetric3};
use crate::symbolic::Expr;

/// The multiplications that turning the motion and the wrench of a link takes: five vectors about z.
const OF_MOTION_AND_WRENCH: usize = 20;
/// The same where all joints so far are parallel: an acceleration and a force.
const OF_PLANAR_MOTION: usize = 8;

/// The tree at the configuration `q`, with the frames of those links at rest whose mass may be turned for less; none if
/// there is no such link.
pub fn rest<'g>(tree: &NormalTree<Expr<'g>>, q: &[Expr<'g>]) -> Option<NormalTree<Expr<'g>>> {
    let rests = at_rest(tree);
    if !rests.contains(&true) {
        return None;
    }
    let mut resting = tree.clone();
    let mut turned: Vec<Option<Angle<'g>>> = Vec::with_capacity(tree.links.len());
    for (k, link) in tree.links.iter().enumerate() {
        let before = link.parent.and_then(|parent| turned[parent]);
        let own = Angle::of(link, q);
        let angle = match (own, before) {
            (Some(own), Some(before)) => Some(own.after(before, link.turn)),
            (own, _) => own,
        };
        let rests = angle.filter(|_| rests[k]);
        let changed = &mut resting.links[k];
        if let Some(before) = before {
            changed.position = before.turn().up(link.position);
            changed.about_z = angle.map(Angle::turn);
        }
        if let Some(angle) = rests {
            changed.about_z = Some(PlanarTurn::identity());
            changed.inertia = turned_mass(link.inertia, angle.turn());
        }
        turned.push(rests);
    }
    Some(resting)
}

/// Which frames rest.
fn at_rest(tree: &NormalTree<Expr<'_>>) -> Vec<bool> {
    let mut tilts: Vec<bool> = Vec::with_capacity(tree.links.len());
    let mut rests = Vec::with_capacity(tree.links.len());
    for (k, link) in tree.links.iter().enumerate() {
        let tilts_before = match link.parent {
            Some(parent) => tilts[parent],
            None => matches!(link.motion, Motion::Ball | Motion::Free),
        };
        let is_first = link.parent.is_none();
        tilts.push(tilts_before || !(is_first || is_parallel(link)));
        let carried = match (is_first, tilts[k]) {
            (true, _) => 0,
            (false, false) => OF_PLANAR_MOTION,
            (false, true) => OF_MOTION_AND_WRENCH,
        };
        rests.push(of_resting(tree, k).is_some_and(|cost| cost < carried));
    }
    rests
}

/// The multiplications that turning the mass of link `k` takes, and the ways to what hangs on it; that must turn about
/// parallel axes.
fn of_resting(tree: &NormalTree<Expr<'_>>, k: usize) -> Option<usize> {
    let link = &tree.links[k];
    let mut cost = of_turning(link.inertia);
    for child in tree.links.iter().filter(|child| child.parent == Some(k)) {
        if !is_parallel(child) {
            return None;
        }
        let [x, y, _] = child.position.0;
        // The way to a joint is turned, and is a product more in a moment and in an acceleration.
        cost += of_pair(x, y) + 2 * usize::from(!(x.is_zero() && y.is_zero()));
    }
    (link.motion == Motion::Revolute).then_some(cost)
}

/// Whether a link turns or slides along its parent's z.
fn is_parallel(link: &NormalLink<Expr<'_>>) -> bool {
    let Turn::Planar { alpha, .. } = link.turn else { return false };
    matches!(link.motion, Motion::Revolute | Motion::Prismatic) && matches!(alpha.quarters(), Some(0 | 2))
}

/// The multiplications that turning a mass about z takes.
fn of_turning(inertia: PseudoInertia<Expr<'_>>) -> usize {
    let (first, Symmetric3 { xx, yy, xy, xz, yz, .. }) = (inertia.first, inertia.second);
    let in_plane = match (xx == yy, xy.is_zero()) {
        (true, true) => 0,
        (false, true) => 3,
        _ => 4,
    };
    of_pair(first.0[0], first.0[1]) + in_plane + of_pair(xz, yz)
}

/// The multiplications that turning a vector in the plane takes.
fn of_pair(x: Expr<'_>, y: Expr<'_>) -> usize {
    2 * [x, y].iter().filter(|x| !x.is_zero()).count()
}

fn turned_mass<'g>(inertia: PseudoInertia<Expr<'g>>, turn: PlanarTurn<Expr<'g>>) -> PseudoInertia<Expr<'g>> {
    let PseudoInertia { mass, first, second } = inertia;
    PseudoInertia { mass, first: turn.up(first), second: turn.up_symmetric(second) }
}

/// A turn about z: by a sum of coordinates, and a constant.
#[derive(Clone, Copy)]
struct Angle<'g> {
    sum: Expr<'g>,
    constant: PlanarTurn<Expr<'g>>,
}

impl<'g> Angle<'g> {
    /// That of a link against its parent; none of one that turns about more than z.
    fn of(link: &NormalLink<Expr<'g>>, q: &[Expr<'g>]) -> Option<Self> {
        let sum = match link.motion {
            Motion::Revolute => link.drive.ratio * q[link.drive.q],
            Motion::Prismatic => Expr::ZERO,
            Motion::Ball | Motion::Free => return None,
        };
        Some(Self { sum, constant: link.offset })
    }

    /// This one on a link whose parent is turned already, about the same axis or its opposite.
    fn after(self, before: Self, between: Turn<Expr<'g>>) -> Self {
        let opposite = matches!(between, Turn::Planar { alpha, .. } if alpha.quarters() == Some(2));
        let (sum, constant) = match opposite {
            true => (-before.sum, before.constant.inverse()),
            false => (before.sum, before.constant),
        };
        Self { sum: sum + self.sum, constant: constant.then(self.constant) }
    }

    fn turn(self) -> PlanarTurn<Expr<'g>> {
        PlanarTurn::of_angle(self.sum).then(self.constant)
    }
}
