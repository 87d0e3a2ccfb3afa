//! Which quantity stands in which place of a specification: the one table behind units, constants and fields.

use crate::diagnostics::Code;
use crate::spec::{
    AxisKind, BodySpec, Formula, InertiaKind, JointKeys, JointKind, JointSpec, PlacementKind, RobotSpec,
    Shape, TermKind, TermSpec, leaders,
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
    /// Of two turns, or of two distances.
    Ratio,
    /// Of a distance to a turn.
    Pitch,
    /// Of a turn to a distance.
    InversePitch,
    /// A torque for each radian per second.
    TurningDamping,
    /// A force for each metre per second.
    SlidingDamping,
    /// A torque for each radian.
    TurningStiffness,
    /// A force for each metre.
    SlidingStiffness,
    Energy,
    Power,
}

impl Quantity {
    /// The exponents of kg, m and s.
    pub(super) fn exponents(self) -> [i8; 3] {
        match self {
            Self::Mass => [1, 0, 0],
            Self::Length => [0, 1, 0],
            Self::Inertia | Self::ProductOfInertia => [1, 2, 0],
            Self::Angle | Self::Direction | Self::Ratio => [0, 0, 0],
            Self::Acceleration => [0, 1, -2],
            Self::AngularSpeed => [0, 0, -1],
            Self::Speed => [0, 1, -1],
            Self::Torque | Self::TurningStiffness => [1, 2, -2],
            Self::Force => [1, 1, -2],
            Self::Pitch => [0, 1, 0],
            Self::InversePitch => [0, -1, 0],
            Self::TurningDamping => [1, 2, -1],
            Self::SlidingDamping => [1, 0, -1],
            Self::SlidingStiffness => [1, 0, -2],
            Self::Energy => [1, 2, -2],
            Self::Power => [1, 2, -3],
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
            Self::Direction | Self::Ratio => "no unit",
            Self::AngularSpeed => "rad/s",
            Self::Speed => "m/s",
            Self::Torque => "N·m",
            Self::Force => "N",
            Self::Pitch => "m/rad",
            Self::InversePitch => "rad/m",
            Self::TurningDamping => "N·m·s/rad",
            Self::SlidingDamping => "N·s/m",
            Self::TurningStiffness => "N·m/rad",
            Self::SlidingStiffness => "N/m",
            Self::Energy => "J",
            Self::Power => "W",
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
    /// Whether coordinates and speeds may stand in it.
    pub(super) fn is_term(&self) -> bool {
        matches!(self.quantity, Quantity::Energy | Quantity::Power)
    }

    /// As in "`mass` of `arm`".
    pub(super) fn name(&self) -> String {
        match self.owner {
            "" => format!("`{}`", self.key),
            owner => format!("`{}` of `{owner}`", self.key),
        }
    }
}

/// The quantities of a joint's one coordinate, and of what acts along it.
pub(super) struct Along {
    pub(super) position: Quantity,
    pub(super) speed: Quantity,
    pub(super) force: Quantity,
    inertia: Quantity,
    damping: Quantity,
    stiffness: Quantity,
    gear: Quantity,
}

impl Along {
    const TURNING: Self = Self {
        position: Quantity::Angle,
        speed: Quantity::AngularSpeed,
        force: Quantity::Torque,
        inertia: Quantity::Inertia,
        damping: Quantity::TurningDamping,
        stiffness: Quantity::TurningStiffness,
        gear: Quantity::Ratio,
    };
    const SLIDING: Self = Self {
        position: Quantity::Length,
        speed: Quantity::Speed,
        force: Quantity::Force,
        inertia: Quantity::Mass,
        damping: Quantity::SlidingDamping,
        stiffness: Quantity::SlidingStiffness,
        gear: Quantity::InversePitch,
    };

    /// Those of a kind of joint, which has one degree of freedom.
    pub(super) fn of(kind: JointKind) -> &'static Self {
        if kind == JointKind::Prismatic { &Self::SLIDING } else { &Self::TURNING }
    }

    /// The quantity of a joint's coordinate for each unit of another joint's.
    fn ratio(&self, leader: &Self) -> Quantity {
        match (self.position, leader.position) {
            (own, of_leader) if own == of_leader => Quantity::Ratio,
            (Quantity::Length, _) => Quantity::Pitch,
            _ => Quantity::InversePitch,
        }
    }
}

/// All formulas of a specification, in the order of its lines, options first and terms last.
pub(super) fn slots(spec: &RobotSpec) -> Vec<Slot<'_>> {
    let mut table = Table { slots: vec![], owner: "" };
    let leaders = leaders(&spec.joints).into_iter().map(|leader| leader.map(|leader| &spec.joints[leader]));
    table.all("gravity", Quantity::Acceleration, spec.options.gravity.iter().flatten());
    let (mut joints, mut bodies) =
        (spec.joints.iter().zip(leaders).peekable(), spec.bodies.iter().peekable());
    loop {
        let joint_first = match (joints.peek(), bodies.peek()) {
            (Some((joint, _)), Some(body)) => joint.line <= body.line,
            (joint, _) => joint.is_some(),
        };
        match if joint_first { (joints.next(), None) } else { (None, bodies.next()) } {
            (Some((joint, leader)), _) => table.joint(joint, leader),
            (_, Some(body)) => table.body(body),
            _ => break,
        }
    }
    table.owner = "";
    for TermSpec { kind, formula, .. } in &spec.terms {
        let quantity = if *kind == TermKind::Dissipation { Quantity::Power } else { Quantity::Energy };
        table.add(kind.name(), quantity, formula);
    }
    table.slots
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

    fn joint(&mut self, joint: &'s JointSpec, leader: Option<&JointSpec>) {
        let JointSpec { kind, axes, pitch, keys, .. } = joint;
        self.owner = &joint.name.text;
        axes.iter().for_each(|axis| self.axis(&axis.kind));
        self.all("pitch", Quantity::Pitch, pitch);
        self.all("at", Quantity::Length, keys.at.iter().flatten());
        self.all("rpy", Quantity::Angle, keys.rpy.iter().flatten());
        match keys.placement.as_ref().map(|placement| &placement.kind) {
            Some(PlacementKind::Dh(parts)) => self.dh("dh", parts),
            Some(PlacementKind::ModifiedDh(parts)) => self.dh("mdh", parts),
            Some(PlacementKind::Screw { axis, through }) => {
                self.axis(&axis.kind);
                self.all("screw", Quantity::Length, through.iter());
            }
            None => {}
        }
        // Where a joint has none or several, no key has a meaning, which is a mistake of its own.
        let along = Along::of(*kind);
        if kind.speeds() <= 1 {
            self.constants("limits", along.position, Code::ConstantNeeded, keys.limits.iter().flatten());
            self.constants("velocity", along.speed, Code::ConstantNeeded, &keys.velocity);
            self.constants("effort", along.force, Code::ConstantNeeded, &keys.effort);
        }
        if kind.speeds() == 1 {
            let leader = leader.filter(|leader| leader.kind.speeds() == 1);
            self.along(keys, along, leader.map(|leader| Along::of(leader.kind)));
        }
    }

    fn along(&mut self, keys: &'s JointKeys, along: &Along, leader: Option<&Along>) {
        self.all("locked", along.position, &keys.locked);
        if let Some(leader) = leader {
            self.all("ratio", along.ratio(leader), &keys.ratio);
        }
        self.all("offset", along.position, &keys.offset);
        self.all("armature", along.inertia, &keys.armature);
        self.all("rotor", Quantity::Inertia, &keys.rotor);
        self.all("gear", along.gear, &keys.gear);
        self.all("damping", along.damping, &keys.damping);
        self.all("friction", along.force, &keys.friction);
        self.all("friction_speed", along.speed, &keys.friction_speed);
        self.all("stiffness", along.stiffness, &keys.stiffness);
        self.all("rest", along.position, &keys.rest);
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
