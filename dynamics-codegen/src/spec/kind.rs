//! The kinds of joints, and what each has: axes, coordinates, speeds.

use super::Name;
use super::cursor::Result;
use crate::diagnostics::{Code, Diagnostic};

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis by an angle, between limits if it has some.
    Revolute,
    /// Turns about its axis without end.
    Continuous,
    /// Slides along its axis by a distance.
    Prismatic,
    /// Turns about its axis by an angle, and slides along it by a pitch for each radian.
    Helical,
    /// Turns about its axis by an angle, and slides along it by a distance.
    Cylindrical,
    /// Turns about a first axis, and about a second one, which the first turn carries.
    Universal,
    /// Slides by two distances in the plane across its normal, and turns about it by an angle.
    Planar,
    /// Slides by three distances along x, y and z.
    Translation,
    /// Turns about a point: a quaternion.
    Ball,
    /// Moves freely: a position and a quaternion.
    Free,
    /// Does not move.
    Fixed,
}

impl JointKind {
    /// Every kind, with its name.
    pub const ALL: [(&'static str, Self); 11] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("helical", Self::Helical),
        ("cylindrical", Self::Cylindrical),
        ("universal", Self::Universal),
        ("planar", Self::Planar),
        ("translation", Self::Translation),
        ("ball", Self::Ball),
        ("free", Self::Free),
        ("fixed", Self::Fixed),
    ];

    /// The kinds under the names that other formats and textbooks give them.
    const ALIASES: [(&'static str, &'static str); 12] = [
        ("hinge", "revolute"),
        ("rotational", "revolute"),
        ("slide", "prismatic"),
        ("slider", "prismatic"),
        ("linear", "prismatic"),
        ("screw", "helical"),
        ("cartesian", "translation"),
        ("translational", "translation"),
        ("spherical", "ball"),
        ("quaternion", "ball"),
        ("floating", "free"),
        ("weld", "fixed"),
    ];

    /// The name as written.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// How many coordinates a joint of the kind has; a quaternion has four.
    pub fn coordinates(self) -> usize {
        match self {
            Self::Ball => 4,
            Self::Free => 7,
            _ => self.speeds(),
        }
    }

    /// How many degrees of freedom a joint of the kind has.
    pub fn speeds(self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute | Self::Continuous | Self::Prismatic | Self::Helical => 1,
            Self::Cylindrical | Self::Universal => 2,
            Self::Planar | Self::Translation | Self::Ball => 3,
            Self::Free => 6,
        }
    }

    /// How many axes one has to give.
    pub fn axes(self) -> usize {
        match self {
            Self::Translation | Self::Ball | Self::Free | Self::Fixed => 0,
            Self::Universal => 2,
            _ => 1,
        }
    }

    /// Whether the parameters of Denavit and Hartenberg are made for it.
    pub fn takes_dh(self) -> bool {
        matches!(self, Self::Revolute | Self::Continuous | Self::Prismatic | Self::Fixed)
    }

    /// What is in its parentheses.
    pub fn parts(self) -> &'static [&'static str] {
        match self {
            Self::Universal => &["the first axis", "the second axis"],
            Self::Helical => &["an axis", "a pitch"],
            Self::Planar => &["the normal"],
            kind if kind.axes() == 0 => &[],
            _ => &["an axis"],
        }
    }

    /// How it is written, as in `universal(x, y)`.
    pub fn example(self) -> String {
        match self {
            Self::Helical => "helical(z, 5mm / (2*pi))".to_owned(),
            Self::Universal => "universal(x, y)".to_owned(),
            kind if kind.axes() == 0 => kind.name().to_owned(),
            kind => format!("{}(z)", kind.name()),
        }
    }

    /// The kind of a name.
    pub(super) fn named(name: &Name) -> Result<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name.text);
        found.map(|(_, kind)| *kind).ok_or_else(|| {
            let message = format!("there is no kind of joint `{name}`");
            let unknown = Diagnostic::new(Code::JointKindUnknown, &name.place, message);
            match Self::ALIASES.iter().find(|(alias, _)| *alias == name.text) {
                Some((_, known)) => unknown.help(format!("did you mean `{known}`?")),
                None => unknown.suggest(&name.text, Self::ALL.iter().map(|(known, _)| *known)),
            }
        })
    }
}
