//! The table of links that the run time's recursion reads, for robots too large for straight lines.

use crate::mechanics::equations::Method;
use crate::model::{Frame, Model, Passive};
use crate::spatial::{PseudoInertia, Symmetric3};
use crate::symbolic::Expr;

/// How many numbers a link has: rotation, position, mass, first and second moments, drive, passive forces.
pub const NUMBERS_PER_LINK: usize = 9 + 3 + 1 + 3 + 6 + 2 + 6;

/// The numbers of all links, then the base's mass and first moment, then gravity, then the frames' poses.
pub(super) fn entries<'g>(model: &Model<'g>) -> Vec<Expr<'g>> {
    let mut entries = Vec::with_capacity(NUMBERS_PER_LINK * model.tree.links.len() + 7);
    for link in &model.tree.links {
        entries.extend(link.placement.rotation.0.as_flattened());
        entries.extend(link.placement.translation.0);
        let PseudoInertia { mass, first, second } = link.inertia;
        let Symmetric3 { xx, yy, zz, xy, xz, yz } = second;
        entries.push(mass);
        entries.extend(first.0);
        entries.extend([xx, yy, zz, xy, xz, yz]);
        entries.extend([link.drive.ratio, link.drive.offset]);
        let Passive { armature, damping, friction, friction_speed, stiffness, rest } = link.passive;
        entries.extend([armature, damping, friction, friction_speed, stiffness, rest]);
    }
    entries.push(model.tree.base.mass);
    entries.extend(model.tree.base.first.0);
    entries.extend(model.tree.gravity.0);
    for frame in &model.tree.frames {
        entries.extend(pose_entries(frame));
    }
    entries
}

/// The link of a frame, and the numbers of the frame's pose in it, if the method is a frame's.
pub(super) fn frame<'g>(model: &Model<'g>, method: Method) -> Option<(Option<usize>, Vec<Expr<'g>>)> {
    let frame = &model.tree.frames[method.frame()?];
    Some((frame.link, pose_entries(frame)))
}

fn pose_entries<'g>(frame: &Frame<Expr<'g>>) -> Vec<Expr<'g>> {
    frame.pose.rotation.0.as_flattened().iter().copied().chain(frame.pose.translation.0).collect()
}
