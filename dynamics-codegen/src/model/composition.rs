//! What a joint is made of: links that each turn about or slide along one axis, or turn or move freely.
//!
//! Between the links of one joint there is no mass.

use super::Motion;
use crate::spec::JointKind;

/// The links of a kind of joint, from the parent to the child; none of a fixed one. Each has its motion, and the
/// first of the joint's coordinates that it moves by: the two of a helical joint share one, and the second slides by
/// the pitch for each radian.
pub(super) fn composition(kind: JointKind) -> &'static [(Motion, usize)] {
    use Motion::{Ball, Free, Prismatic, Revolute};
    match kind {
        JointKind::Revolute | JointKind::Continuous => &[(Revolute, 0)],
        JointKind::Prismatic => &[(Prismatic, 0)],
        JointKind::Helical => &[(Revolute, 0), (Prismatic, 0)],
        JointKind::Cylindrical => &[(Revolute, 0), (Prismatic, 1)],
        JointKind::Universal => &[(Revolute, 0), (Revolute, 1)],
        JointKind::Planar => &[(Prismatic, 0), (Prismatic, 1), (Revolute, 2)],
        JointKind::Translation => &[(Prismatic, 0), (Prismatic, 1), (Prismatic, 2)],
        JointKind::Ball => &[(Ball, 0)],
        JointKind::Free => &[(Free, 0)],
        JointKind::Fixed => &[],
    }
}
