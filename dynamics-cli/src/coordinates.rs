//! What coordinates and speeds are called: `hinge`, and where a joint has several `root_joint.x` to `root_joint.qw`.

use dynamics_codegen::model::{JointInfo, Model};

/// The names of all coordinates and speeds, in order.
pub(crate) struct Coordinates {
    /// NQ
    pub(crate) q: Vec<String>,
    /// NV
    pub(crate) v: Vec<String>,
}

impl Coordinates {
    /// Those of a robot.
    pub(crate) fn of(model: &Model<'_>) -> Self {
        let names =
            |of_joint: fn(&JointInfo) -> Vec<String>| model.joints.iter().flat_map(of_joint).collect();
        Self { q: names(JointInfo::coordinate_names), v: names(JointInfo::speed_names) }
    }
}
