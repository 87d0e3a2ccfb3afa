//! The keys of a `#[joint]`: where it is, what it is allowed, what drives it and what resists.

use super::cursor::Cursor;
use super::joint::Placement;
use super::values::{Entry, fill};
use super::{Formula, Name};
use crate::diagnostics::{Diagnostics, Place};
use crate::symbolic::Number;

/// The speed from which on friction is nearly all there, unless it is said: 0.01 rad/s or m/s.
pub fn default_friction_speed() -> Number {
    Number::ratio(1, 100)
}

/// What is said of a joint beside its kind and its bodies.
#[derive(Clone, Debug, Default)]
pub struct JointKeys {
    /// `at = [x, y, z]`
    pub at: Option<[Formula; 3]>,
    /// `rpy = [r, p, y]`
    pub rpy: Option<[Formula; 3]>,
    /// `dh(…)`, `mdh(…)` or `screw(…)`.
    pub placement: Option<Placement>,
    /// `limits = [lower, upper]`
    pub limits: Option<[Formula; 2]>,
    /// `velocity = …`
    pub velocity: Option<Formula>,
    /// `effort = …`
    pub effort: Option<Formula>,
    /// `locked = …`: the coordinate at which the joint is welded.
    pub locked: Option<Formula>,
    /// `mimic = leader`: the joint that this one follows.
    pub mimic: Option<Name>,
    /// `ratio = …`: how far a follower moves for each unit of its leader.
    pub ratio: Option<Formula>,
    /// `offset = …`: where a follower is when its leader is at zero.
    pub offset: Option<Formula>,
    /// `actuated = on | off`: whether the joint has inputs.
    pub actuated: Option<Switch>,
    /// `armature = …`: the inertia of what turns with the joint and is no body, felt at the joint.
    pub armature: Option<Formula>,
    /// `rotor = …`: the inertia of a motor, about its own shaft.
    pub rotor: Option<Formula>,
    /// `gear = …`: how far the motor's shaft turns for each unit of the joint.
    pub gear: Option<Formula>,
    /// `damping = …`
    pub damping: Option<Formula>,
    /// `friction = …`
    pub friction: Option<Formula>,
    /// `friction_speed = …`: the speed from which on friction is nearly all there.
    pub friction_speed: Option<Formula>,
    /// `stiffness = …`
    pub stiffness: Option<Formula>,
    /// `rest = …`: the coordinate at which a spring is slack.
    pub rest: Option<Formula>,
}

/// `on` or `off`.
#[derive(Clone, Debug)]
pub struct Switch {
    /// Whether it is on.
    pub is_on: bool,
    /// Where it was written.
    pub place: Place,
}

const KEYS: &[&str] = &[
    "at",
    "rpy",
    "dh",
    "mdh",
    "screw",
    "limits",
    "velocity",
    "effort",
    "locked",
    "mimic",
    "ratio",
    "offset",
    "actuated",
    "armature",
    "rotor",
    "gear",
    "damping",
    "friction",
    "friction_speed",
    "stiffness",
    "rest",
];

impl JointKeys {
    /// Reads `key = value, …`. Keys that fail are reported and left out.
    pub(super) fn parse(items: impl Iterator<Item = Cursor>, diags: &mut Diagnostics) -> Self {
        let mut keys = Self::default();
        for item in items {
            if let Some(entry) = diags.keep(Entry::parse(item, "key of a joint", KEYS)) {
                keys.read(entry, diags);
            }
        }
        keys
    }

    fn read(&mut self, entry: Entry, diags: &mut Diagnostics) {
        let key = entry.key.clone();
        let slot = match key.text.as_str() {
            "at" => return fill(&mut self.at, &key, entry.vector(["x", "y", "z"]), diags),
            "rpy" => return fill(&mut self.rpy, &key, entry.vector(["roll", "pitch", "yaw"]), diags),
            "limits" => return fill(&mut self.limits, &key, entry.vector(["lower", "upper"]), diags),
            "mimic" => return fill(&mut self.mimic, &key, entry.name("the name of a joint"), diags),
            "actuated" => return fill(&mut self.actuated, &key, entry.switch(), diags),
            "dh" | "mdh" | "screw" => {
                return fill(&mut self.placement, &key, Placement::parse(entry), diags);
            }
            "velocity" => &mut self.velocity,
            "effort" => &mut self.effort,
            "locked" => &mut self.locked,
            "ratio" => &mut self.ratio,
            "offset" => &mut self.offset,
            "armature" => &mut self.armature,
            "rotor" => &mut self.rotor,
            "gear" => &mut self.gear,
            "damping" => &mut self.damping,
            "friction" => &mut self.friction,
            "friction_speed" => &mut self.friction_speed,
            "stiffness" => &mut self.stiffness,
            _ => &mut self.rest,
        };
        fill(slot, &key, entry.scalar(), diags);
    }

    /// The keys that are given, each with its place.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, &Place)> {
        fn place(formula: &Option<Formula>) -> Option<&Place> {
            formula.as_ref().map(|formula| &formula.place)
        }
        fn first<const N: usize>(list: &Option<[Formula; N]>) -> Option<&Place> {
            list.as_ref()?.first().map(|formula| &formula.place)
        }
        let places = [
            ("at", first(&self.at)),
            ("rpy", first(&self.rpy)),
            ("limits", first(&self.limits)),
            ("velocity", place(&self.velocity)),
            ("effort", place(&self.effort)),
            ("locked", place(&self.locked)),
            ("mimic", self.mimic.as_ref().map(|leader| &leader.place)),
            ("ratio", place(&self.ratio)),
            ("offset", place(&self.offset)),
            ("actuated", self.actuated.as_ref().map(|switch| &switch.place)),
            ("armature", place(&self.armature)),
            ("rotor", place(&self.rotor)),
            ("gear", place(&self.gear)),
            ("damping", place(&self.damping)),
            ("friction", place(&self.friction)),
            ("friction_speed", place(&self.friction_speed)),
            ("stiffness", place(&self.stiffness)),
            ("rest", place(&self.rest)),
        ];
        places.into_iter().filter_map(|(key, place)| Some((key, place?)))
    }

    /// Each key that is given here, and those of `others` that are not.
    pub(super) fn or(self, others: Self) -> Self {
        Self {
            at: self.at.or(others.at),
            rpy: self.rpy.or(others.rpy),
            placement: self.placement.or(others.placement),
            limits: self.limits.or(others.limits),
            velocity: self.velocity.or(others.velocity),
            effort: self.effort.or(others.effort),
            locked: self.locked.or(others.locked),
            mimic: self.mimic.or(others.mimic),
            ratio: self.ratio.or(others.ratio),
            offset: self.offset.or(others.offset),
            actuated: self.actuated.or(others.actuated),
            armature: self.armature.or(others.armature),
            rotor: self.rotor.or(others.rotor),
            gear: self.gear.or(others.gear),
            damping: self.damping.or(others.damping),
            friction: self.friction.or(others.friction),
            friction_speed: self.friction_speed.or(others.friction_speed),
            stiffness: self.stiffness.or(others.stiffness),
            rest: self.rest.or(others.rest),
        }
    }
}
