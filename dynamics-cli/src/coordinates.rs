//! What coordinates and speeds are called, `hinge`, and where a joint has several `root_joint.x` to `root_joint.qw`; and
//! their units.

use dynamics_codegen::model::{JointInfo, Model};

use crate::quantity::Exponents;

/// The names and the units of all coordinates and speeds, in order.
pub(crate) struct Coordinates {
    /// NQ
    pub(crate) q: Vec<String>,
    /// NV
    pub(crate) v: Vec<String>,
    /// That of each coordinate; none of a quaternion's.
    pub(crate) units_of_q: Vec<Option<Exponents>>,
    /// That of each speed.
    pub(crate) units_of_v: Vec<Exponents>,
}

impl Coordinates {
    /// Those of a robot.
    pub(crate) fn of(model: &Model<'_>) -> Self {
        let names =
            |of_joint: fn(&JointInfo) -> Vec<String>| model.joints.iter().flat_map(of_joint).collect();
        let length = |turns| if turns { 0 } else { 1 };
        let of_q = model.joints.iter().flat_map(|joint| joint.kind.coordinate_turns());
        let of_v = model.joints.iter().flat_map(|joint| joint.kind.turns().iter().copied());
        Self {
            q: names(JointInfo::coordinate_names),
            v: names(JointInfo::speed_names),
            units_of_q: of_q.map(|turns| turns.map(|turns| [0, length(turns), 0])).collect(),
            units_of_v: of_v.map(|turns| [0, length(turns), -1]).collect(),
        }
    }
}
