//! What the coordinates and the speeds of a joint are called, behind the joint's name, and which of them turn.

use super::JointKind;

impl JointKind {
    /// Of each of its coordinates: nothing if it has one.
    pub fn coordinate_parts(self) -> &'static [&'static str] {
        match self {
            Self::Ball => &["qx", "qy", "qz", "qw"],
            Self::Free => &["x", "y", "z", "qx", "qy", "qz", "qw"],
            kind => kind.speed_parts(),
        }
    }

    /// Of each direction in which it can be displaced: that of its coordinate where it has one.
    pub fn displacement_parts(self) -> &'static [&'static str] {
        match self {
            Self::Ball => &["rx", "ry", "rz"],
            Self::Free => &["dx", "dy", "dz", "rx", "ry", "rz"],
            kind => kind.speed_parts(),
        }
    }

    /// Of each of its speeds.
    pub fn speed_parts(self) -> &'static [&'static str] {
        match self {
            Self::Cylindrical => &["angle", "distance"],
            Self::Universal => &["angle1", "angle2"],
            Self::Planar => &["x", "y", "angle"],
            Self::Translation => &["x", "y", "z"],
            Self::Ball => &["wx", "wy", "wz"],
            Self::Free => &["vx", "vy", "vz", "wx", "wy", "wz"],
            Self::Revolute | Self::Continuous | Self::Prismatic | Self::Helical | Self::Fixed => &[],
        }
    }

    /// Of each of its coordinates, whether it is an angle; else it is a distance. None of a quaternion's.
    pub fn coordinate_turns(self) -> Vec<Option<bool>> {
        match self {
            Self::Ball => vec![None; 4],
            Self::Free => [vec![Some(false); 3], vec![None; 4]].concat(),
            kind => kind.turns().iter().copied().map(Some).collect(),
        }
    }

    /// Of each of its speeds, whether it is that of an angle; else it is that of a distance.
    pub fn turns(self) -> &'static [bool] {
        match self {
            Self::Revolute | Self::Continuous | Self::Helical => &[true],
            Self::Prismatic => &[false],
            Self::Cylindrical => &[true, false],
            Self::Universal => &[true; 2],
            Self::Planar => &[false, false, true],
            Self::Translation => &[false; 3],
            Self::Ball => &[true; 3],
            Self::Free => &[false, false, false, true, true, true],
            Self::Fixed => &[],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_one_for_each() {
        for (name, kind) in JointKind::ALL {
            let of_one = |parts: &[&str]| parts.len().max(usize::from(kind != JointKind::Fixed));
            assert_eq!(of_one(kind.coordinate_parts()), kind.coordinates(), "{name}");
            assert_eq!(of_one(kind.displacement_parts()), kind.speeds(), "{name}");
            assert_eq!(of_one(kind.speed_parts()), kind.speeds(), "{name}");
            assert_eq!(kind.turns().len(), kind.speeds(), "{name}");
            assert_eq!(kind.coordinate_turns().len(), kind.coordinates(), "{name}");
        }
    }
}
