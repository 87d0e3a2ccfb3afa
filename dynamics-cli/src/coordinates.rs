//! What coordinates and speeds are called: `hinge`, and where a joint has several `root_joint.x` to `root_joint.qw`.

use dynamics_codegen::model::Model;
use dynamics_codegen::spec::{JointKind, RobotSpec};

/// The names of all coordinates and speeds, in order.
pub(crate) struct Coordinates {
    /// NQ
    pub(crate) q: Vec<String>,
    /// NV
    pub(crate) v: Vec<String>,
}

impl Coordinates {
    /// Those of a robot.
    pub(crate) fn of(spec: &RobotSpec, model: &Model<'_>) -> Self {
        let own = spec.joints.iter().filter(|joint| joint.has_coordinates());
        let joints: Vec<_> = model.joints.iter().zip(own.map(|joint| joint.kind)).collect();
        let names = |parts: fn(JointKind) -> &'static [&'static str]| {
            let of_joint =
                |(joint, kind): &(&dynamics_codegen::model::JointInfo, JointKind)| match parts(*kind) {
                    [] => vec![joint.name.clone()],
                    parts => parts.iter().map(|part| format!("{}.{part}", joint.name)).collect(),
                };
            joints.iter().flat_map(of_joint).collect()
        };
        Self { q: names(coordinates), v: names(speeds) }
    }
}

/// What is behind a joint's name for each of its coordinates; nothing if it has one.
fn coordinates(kind: JointKind) -> &'static [&'static str] {
    match kind {
        JointKind::Ball => &["qx", "qy", "qz", "qw"],
        JointKind::Free => &["x", "y", "z", "qx", "qy", "qz", "qw"],
        _ => speeds(kind),
    }
}

/// The same for each of its speeds.
fn speeds(kind: JointKind) -> &'static [&'static str] {
    match kind {
        JointKind::Cylindrical => &["angle", "distance"],
        JointKind::Universal => &["angle1", "angle2"],
        JointKind::Planar => &["x", "y", "angle"],
        JointKind::Translation => &["x", "y", "z"],
        JointKind::Ball => &["wx", "wy", "wz"],
        JointKind::Free => &["vx", "vy", "vz", "wx", "wy", "wz"],
        JointKind::Revolute
        | JointKind::Continuous
        | JointKind::Prismatic
        | JointKind::Helical
        | JointKind::Fixed => &[],
    }
}
