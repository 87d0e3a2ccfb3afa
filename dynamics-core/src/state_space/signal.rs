//! What an entry of a state, an input or an output is called, and its unit.

use core::fmt;

use crate::mechanism::{Mechanism, Motion};

/// One entry of a vector: its name and its unit; displayed as the name, `tool0.vx` or `hinge'`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Signal {
    /// What it belongs to, a joint or a frame; empty for what has no name.
    pub name: &'static str,
    /// What of it: `'` of a speed, `.x`, `.vx`; empty where the name says all.
    pub part: &'static str,
    /// The unit; `1` of numbers without, empty if unknown.
    pub unit: &'static str,
}

impl Signal {
    /// No name and no unit; a table shows the letter and the index instead.
    pub const UNNAMED: Self = Self { name: "", part: "", unit: "" };

    /// The signal `name` in `unit`.
    #[must_use]
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, part: "", unit }
    }

    /// The signal `part` of `name` in `unit`.
    #[must_use]
    pub const fn part(name: &'static str, part: &'static str, unit: &'static str) -> Self {
        Self { name, part, unit }
    }

    /// The displacement of a robot in the direction `index` of its tangent space: of a one-dof joint its coordinate.
    #[must_use]
    pub fn displacement<R: Mechanism + ?Sized>(index: usize) -> Self {
        Self::of::<R>(index, R::DISPLACEMENT_NAMES, "", Motion::unit)
    }

    /// The speed `v[index]` of a robot: `hinge'`, `root_joint.vx`.
    #[must_use]
    pub fn speed<R: Mechanism + ?Sized>(index: usize) -> Self {
        Self::of::<R>(index, R::SPEED_NAMES, Self::prime::<R>(index), Motion::speed_unit)
    }

    /// The acceleration `a[index]` of a robot: `hinge''`, `root_joint.vx'`.
    #[must_use]
    pub fn acceleration<R: Mechanism + ?Sized>(index: usize) -> Self {
        let part = if Self::prime::<R>(index).is_empty() { "'" } else { "''" };
        Self::of::<R>(index, R::SPEED_NAMES, part, Motion::acceleration_unit)
    }

    /// The input `u[index]` of a robot, under the name of the speed that it drives.
    #[must_use]
    pub fn input<R: Mechanism + ?Sized>(index: usize) -> Self {
        match R::ACTUATED.get(index) {
            Some(speed) => Self::of::<R>(*speed, R::SPEED_NAMES, "", Motion::force_unit),
            None => Self::UNNAMED,
        }
    }

    /// What is behind the name of a speed: nothing where it has another one than its coordinate.
    fn prime<R: Mechanism + ?Sized>(index: usize) -> &'static str {
        if R::SPEED_NAMES.get(index) == R::DISPLACEMENT_NAMES.get(index) { "'" } else { "" }
    }

    fn of<R: Mechanism + ?Sized>(
        index: usize,
        names: &'static [&'static str],
        part: &'static str,
        unit: fn(Motion) -> &'static str,
    ) -> Self {
        let Some(name) = names.get(index) else { return Self::UNNAMED };
        Self { name, part, unit: R::MOTIONS.get(index).copied().map_or("", unit) }
    }
}

impl fmt::Display for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        f.write_str(self.part)
    }
}
