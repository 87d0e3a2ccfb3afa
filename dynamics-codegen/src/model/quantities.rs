//! Which quantity stands in which place of a specification: the one table behind units, constants and fields.

use crate::diagnostics::Code;
use crate::spec::{
    AxisKind, BodySpec, Formula, InertiaKind, JointKind, JointSpec, PlacementKind, RobotSpec, Shape,
};

/// What a place needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Mass,
    Length,
    Inertia,
    /// An entry beside the diagonal.
    ProductOfInertia,
    Angle,
    Acceleration,
    Direction,
    AngularSpeed,
    Speed,
    Torque,
    Force,
}

impl Quantity {
    /// The exponents of kg, m and s.
    pub(super) fn exponents(self) -> [i8; 3] {
        match self {
            Self::Mass => [1, 0, 0],
            Self::Length => [0, 1, 0],
            Self::Inertia | Self::ProductOfInertia => [1, 2, 0],
            Self::Angle | Self::Direction => [0, 0, 0],
            Self::Acceleration => [0, 1, -2],
            Self::AngularSpeed => [0, 0, -1],
            Self::Speed => [0, 1, -1],
            Self::Torque => [1, 2, -2],
            Self::Force => [1, 1, -2],
        }
    }

    /// The unit as users write it.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::Length => "m",
            Self::Inertia | Self::ProductOfInertia => "kg·m²",
            Self::Angle => "rad",
            Self::Acceleration => "m/s²",
            Self::Direction => "no unit",
            Self::AngularSpeed => "rad/s",
            Self::Speed => "m/s",
            Self::Torque => "N·m",
            Self::Force => "N",
        }
    }
}

/// A formula in its place.
#[derive(Clone, Copy)]
pub(super) struct Slot<'s> {
    pub(super) formula: &'s Formula,
    pub(super) quantity: Quantity,
    /// The key, as `mass`.
    pub(super) key: &'static str,
    /// The joint or the body; nothing for the robot itself.
    pub(super) owner: &'s str,
    /// The mistake that a field is here, if numbers are needed.
    pub(super) constant: Option<Code>,
}

impl Slot<'_> {
    /// As in "`mass` of `arm`".
    pub(super) fn name(&self) -> String {
        match self.owner {
            "" => format!("`{}`", self.key),
            owner => format!("`{}` of `{owner}`", self.key),
        }
    }
}

/// All formulas of a specification, in the order of its lines, options first.
pub(super) fn slots(spec: &RobotSpec) -> Vec<Slot<'_>> {
    let mut table = Table { slots: vec![], owner: "" };
    table.all("gravity", Quantity::Acceleration, spec.options.gravity.iter().flatten());
    let (mut joints, mut bodies) = (spec.joints.iter().peekable(), spec.bodies.iter().peekable());
    loop {
        let joint_first = match (joints.peek(), bodies.peek()) {
            (Some(joint), Some(body)) => joint.line <= body.line,
            (joint, _) => joint.is_some(),
        };
        match if joint_first { (joints.next(), None) } else { (None, bodies.next()) } {
            (Some(joint), _) => table.joint(joint),
            (_, Some(body)) => table.body(body),
            _ => return table.slots,
        }
    }
}

struct Table<'s> {
    slots: Vec<Slot<'s>>,
    owner: &'s str,
}

impl<'s> Table<'s> {
    fn add(&mut self, key: &'static str, quantity: Quantity, formula: &'s Formula) {
        self.slots.push(Slot { formula, quantity, key, owner: self.owner, constant: None });
    }

    fn all(
        &mut self,
        key: &'static str,
        quantity: Quantity,
        formulas: impl IntoIterator<Item = &'s Formula>,
    ) {
        for formula in formulas {
            self.add(key, quantity, formula);
        }
    }

    fn constants(
        &mut self,
        key: &'static str,
        quantity: Quantity,
        code: Code,
        formulas: impl IntoIterator<Item = &'s Formula>,
    ) {
        for formula in formulas {
            self.slots.push(Slot { formula, quantity, key, owner: self.owner, constant: Some(code) });
        }
    }

    fn joint(&mut self, joint: &'s JointSpec) {
        self.owner = &joint.name.text;
        if let Some(axis) = &joint.axis {
            self.axis(&axis.kind);
        }
        self.all("at", Quantity::Length, joint.at.iter().flatten());
        self.all("rpy", Quantity::Angle, joint.rpy.iter().flatten());
        match joint.placement.as_ref().map(|placement| &placement.kind) {
            Some(PlacementKind::Dh(parts)) => self.dh("dh", parts),
            Some(PlacementKind::ModifiedDh(parts)) => self.dh("mdh", parts),
            Some(PlacementKind::Screw { axis, through }) => {
                self.axis(&axis.kind);
                self.all("screw", Quantity::Length, through.iter());
            }
            None => {}
        }
        let (position, speed, effort) = match joint.kind {
            JointKind::Prismatic => (Quantity::Length, Quantity::Speed, Quantity::Force),
            _ => (Quantity::Angle, Quantity::AngularSpeed, Quantity::Torque),
        };
        self.constants("limits", position, Code::ConstantNeeded, joint.limits.iter().flatten());
        self.constants("velocity", speed, Code::ConstantNeeded, &joint.velocity);
        self.constants("effort", effort, Code::ConstantNeeded, &joint.effort);
    }

    fn axis(&mut self, axis: &'s AxisKind) {
        if let AxisKind::Vector(parts) = axis {
            self.constants("axis", Quantity::Direction, Code::AxisNotConstant, parts.iter());
        }
    }

    fn dh(&mut self, key: &'static str, parts: &'s [Formula; 4]) {
        let [a, alpha, d, theta] = parts;
        self.all(key, Quantity::Length, [a, d]);
        self.all(key, Quantity::Angle, [alpha, theta]);
    }

    fn tensor(&mut self, parts: impl Iterator<Item = &'s Formula>, diagonal: [usize; 3]) {
        for (i, part) in parts.enumerate() {
            let beside = !diagonal.contains(&i);
            self.add("inertia", if beside { Quantity::ProductOfInertia } else { Quantity::Inertia }, part);
        }
    }

    fn body(&mut self, body: &'s BodySpec) {
        self.owner = &body.name.text;
        self.all("mass", Quantity::Mass, &body.mass);
        self.all("com", Quantity::Length, body.com.iter().flatten());
        match body.inertia.as_ref().map(|inertia| &inertia.kind) {
            Some(InertiaKind::Diagonal(parts)) => self.all("inertia", Quantity::Inertia, parts.iter()),
            Some(InertiaKind::Tensor(parts)) => self.tensor(parts.iter(), [0, 3, 5]),
            Some(InertiaKind::Matrix(rows)) => self.tensor(rows.iter().flatten(), [0, 4, 8]),
            None => {}
        }
        self.all("inertia_rpy", Quantity::Angle, body.inertia_rpy.iter().flatten());
        let Some(solid) = &body.solid else { return };
        self.add("solid", Quantity::Mass, &solid.mass);
        match &solid.shape {
            Shape::Cuboid(size) => self.all("solid", Quantity::Length, size.iter()),
            Shape::Cylinder(size, _) => self.all("solid", Quantity::Length, size.iter()),
            Shape::Sphere(size) | Shape::Rod(size, _) => self.add("solid", Quantity::Length, size),
            Shape::Point => {}
        }
    }
}
