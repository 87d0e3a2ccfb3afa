//! Every mistake of the catalogue, with the text that users see.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::fmt::Write;

use dynamics_codegen::diagnostics::{Code, Diagnostic, Diagnostics};
use dynamics_codegen::model;
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::Graph;

/// The mistakes in the text of a whole struct.
fn mistakes_in(text: &str) -> Vec<Diagnostic> {
    let found = dynamics_codegen::generate(&syn::parse_str(text).unwrap());
    found.map_or_else(|mut diags| diags.take(), |_| vec![])
}

/// The mistakes in attributes of a struct with a few fields.
fn mistakes(lines: &str) -> Vec<Diagnostic> {
    mistakes_in(&format!(
        "{lines} struct Robot<T> {{ m: T, l: T, i: T, w: T, x: T, text: String, single: f32 }}"
    ))
}

const JOINT: &str = "#[joint(q: revolute(z), world -> a)]";
const BODY: &str = "#[body(a, mass = 1, inertia = diag(1, 1, 1))]";

/// Lines that contain one mistake; `J` and `B` stand for a sound joint and a sound body.
const LINES: &[(Code, &str)] = &[
    (Code::Syntax, "#[joint(q: revolute(z) world -> a)] B"),
    (Code::Syntax, "#[joint(q, world -> a)] B"),
    (Code::Syntax, "#[joint(q: revolute(z))] B"),
    (Code::Syntax, "#[joint(q: revolute(z), world = a)] B"),
    (Code::Syntax, "#[joint(q: revolute(up), world -> a)] B"),
    (Code::Syntax, "#[joint(q: revolute(z), world -> a, at = 3)] B"),
    (Code::Syntax, "#[joint] B"),
    (Code::Syntax, "J #[body(a, mass = 1 2, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = 2 kg, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = (2 m), inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = 2 w, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = m inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = 'c', inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass = 0x10, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(a, mass, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J #[body(mass = 1, inertia = diag(1, 1, 1))]"),
    (Code::Syntax, "J B #[dynamics(snap = maybe)]"),
    (Code::Syntax, "J B #[dynamics(base = floating)]"),
    (Code::Syntax, "J B #[dynamics(gravity = 9.81)]"),
    (Code::Syntax, "J B #[joint(q, damping = 0.1)]"),
    (Code::Syntax, "#[joint(q: revolute(z), world -> a, actuated = yes)] B"),
    (Code::Syntax, "#[joint(q: revolute(z), world -> a, mimic = 3)] B"),
    (Code::Syntax, "J #[body(a, mass = 1, inertia = [1, 1, 1])]"),
    (Code::Syntax, "J B #[dynamics(crate = 3)]"),
    (Code::Syntax, "J B #[dynamics(crate = \"a b\")]"),
    (Code::KeyUnknown, "J #[body(a, mass = 1, intertia = diag(1, 1, 1))]"),
    (Code::KeyUnknown, "J #[body(a, mass = 1, inertia = diagonal(1, 1, 1))]"),
    (Code::KeyUnknown, "J #[body(a, solid = cube(1, 1))]"),
    (Code::KeyUnknown, "J B #[dynamics(quux = 3)]"),
    (Code::KeyDuplicate, "J #[body(a, mass = 1, mass = 2, inertia = diag(1, 1, 1))]"),
    (Code::KeyDuplicate, "J B #[dynamics(snap = on)] #[dynamics(snap = on)]"),
    (Code::KeyDuplicate, "#[joint(q: revolute, world -> a, dh(0, 0, 0, 0), mdh(0, 0, 0, 0))] B"),
    (Code::KeysConflict, "#[joint(q: revolute, world -> a, dh(0, 0, 0, 0), at = [0, 0, 1])] B"),
    (Code::KeysConflict, "J B #[joint(p: revolute(z), a -> b, mimic = q, locked = 1)]"),
    (Code::KeysConflict, "J B #[joint(p: revolute(z), a -> b, mimic = q, actuated = on)] #[body(b, solid = sphere(1, 1))]"),
    (Code::KeysConflict, "J B #[joint(p: revolute(z), a -> b, mimic = q, limits = [0, 1], effort = 2)] #[body(b, solid = sphere(1, 1))]"),
    (Code::KeysConflict, "J B #[joint(p: revolute(z), a -> b, locked = 30deg, actuated = off)]"),
    (Code::KeysConflict, "#[joint(q: revolute(z), world -> a, armature = 0.1, rotor = 1e-5, gear = 100)] B"),
    (Code::KeysConflict, "#[joint(q: revolute(z), world -> a, armature = 0.1, gear = 100)] B"),
    (Code::KeyMissing, "#[joint(q: revolute(z), world -> a, ratio = 2, offset = 1)] B"),
    (Code::KeyMissing, "#[joint(q: revolute(z), world -> a, rotor = 1e-5)] B"),
    (Code::KeyMissing, "#[joint(q: revolute(z), world -> a, gear = 100)] B"),
    (Code::KeyMissing, "#[joint(q: revolute(z), world -> a, friction_speed = 0.1)] B"),
    (Code::KeyMissing, "#[joint(q: revolute(z), world -> a, rest = 0.1)] B"),
    (Code::KeyMissing, "J B #[dynamics(base = free)]"),
    (Code::KeyMissing, "J B #[dynamics(base = fixed)]"),
    (Code::KeysConflict, "J #[body(a, solid = sphere(1, 1), mass = 1)]"),
    (Code::CountWrong, "#[joint(q: revolute(z), world -> a, at = [0, 1])] B"),
    (Code::CountWrong, "#[joint(q: revolute, world -> a, dh(0, 0, 0))] B"),
    (Code::CountWrong, "J #[body(a, mass = 1, inertia = [[1, 0, 0], [0, 1, 0]])]"),
    (Code::CountWrong, "J #[body(a, solid = sphere(1))]"),
    (Code::CountWrong, "J #[body(a, solid = cylinder(1, 2, 3, x, y))]"),
    (Code::CountWrong, "#[joint(q: revolute, world -> a, screw(z))] B"),
    (Code::CountWrong, "#[joint(q: revolute(x, y), world -> a)] B"),
    (Code::CountWrong, "#[joint(q: universal(x), world -> a)] B"),
    (Code::CountWrong, "#[joint(q: helical(z), world -> a)] B"),
    (Code::CountWrong, "#[joint(q: helical([0, 1, 1]), world -> a)] B"),
    (Code::CountWrong, "#[joint(q: helical, world -> a, screw(z, [0, 0, 0]))] B"),
    (Code::NumberOutOfRange, "J #[body(a, mass = 1e400, inertia = diag(1, 1, 1))]"),
    (Code::NumberOutOfRange, "J #[body(a, mass = 1e200 * 1e200, inertia = diag(1, 1, 1))]"),
    (Code::NumberOutOfRange, "J #[body(a, mass = 1e200, com = [1e100, 0, 0], inertia = diag(1, 1, 1))]"),
    (Code::NumberOutOfRange, "J #[body(a, mass = m, com = [1e200, 0, 0], inertia = diag(1, 1, 1))]"),
    (Code::NumberOutOfRange, "#[joint(q: revolute(z), world -> a, rpy = [0, 0, 1e30rad])] B"),
    (Code::UnitUnknown, "#[joint(q: revolute(z), world -> a, rpy = [0, 0, 90degs])] B"),
    (Code::UnitUnknown, "#[joint(q: revolute(z), world -> a, at = [0, 0, 3parsecs])] B"),
    (Code::FunctionUnknown, "#[joint(q: revolute(z), world -> a, rpy = [0, 0, tan(1)])] B"),
    (Code::FunctionUnknown, "#[joint(q: revolute(z), world -> a, rpy = [0, 0, sine(1)])] B"),
    (Code::FieldUnknown, "J #[body(a, mass = mm, inertia = diag(1, 1, 1))]"),
    (Code::FieldUnknown, "J #[body(a, mass = payload, inertia = diag(1, 1, 1))]"),
    (Code::FieldTypeUnsupported, "J #[body(a, mass = text, inertia = diag(1, 1, 1))]"),
    (Code::FieldTypesDiffer, "J #[body(a, mass = m, com = [single, 0, 0], inertia = diag(1, 1, 1))]"),
    (
        Code::NameDuplicate,
        "J B #[joint(q: revolute(x), a -> b)] #[body(b, mass = 1, inertia = diag(1, 1, 1))]",
    ),
    (Code::NameDuplicate, "J B B"),
    (Code::NameDuplicate, "J B #[coordinate(y: length)] #[coordinate(y: angle)]"),
    (Code::NameDuplicate, "J B #[coordinate(q: length)]"),
    (Code::NamesCollide, "J B #[joint(f: fixed, a -> tool_0)] #[joint(g: fixed, a -> Tool0)]"),
    (Code::NamesCollide, "J B #[joint(f: fixed, a -> A)]"),
    (Code::NameReserved, "J B #[body(world, mass = 1, inertia = diag(1, 1, 1))]"),
    (Code::NameReserved, "J B #[joint(f: fixed, a -> __)]"),
    (Code::NameReserved, "#[joint(pi: revolute(z), world -> a)] B #[potential(1J * cos(pi))]"),
    (Code::JointMissing, ""),
    (Code::DegreesOfFreedomMissing, "#[joint(q: fixed, world -> a)] B"),
    (Code::DegreesOfFreedomMissing, "#[joint(q: revolute(z), world -> a, locked = 0)] B"),
    (Code::ParentUnknown, "J B #[joint(f: fixed, aa -> b)]"),
    (Code::ParentUnknown, "J B #[joint(f: fixed, shoulder -> b)]"),
    (Code::BodyMissing, "J"),
    (Code::WorldIsChild, "J B #[joint(f: fixed, a -> world)]"),
    (Code::ParentTwice, "J B #[joint(f: fixed, world -> a)]"),
    (Code::Cycle, "J B #[joint(f: fixed, b -> c)] #[joint(g: fixed, d -> b)] #[joint(h: fixed, c -> d)]"),
    (Code::Cycle, "J B #[joint(f: fixed, b -> b)]"),
    (Code::BodyUnreachable, "J B #[body(b)]"),
    (Code::ParentAfterChild, "#[joint(p: revolute(x), a -> b)] #[body(b, solid = sphere(1, 1))] J B"),
    (Code::JointKindUnknown, "#[joint(q: revolut(z), world -> a)] B"),
    (Code::JointKindUnknown, "#[joint(q: spherical, world -> a)] B"),
    (Code::JointKindUnknown, "#[joint(q: floating, world -> a)] B"),
    (Code::JointKindUnknown, "#[joint(q: gimbal, world -> a)] B"),
    (Code::KeyNotOfKind, "J B #[joint(f: fixed, a -> b, screw(z, [0, 0, 0]))]"),
    (Code::KeyNotOfKind, "J B #[joint(f: fixed, a -> b, damping = 1, locked = 1, actuated = on)]"),
    (Code::KeyNotOfKind, "#[joint(q: ball, world -> a, dh(0, 0, 0, 0))] B"),
    (Code::KeyNotOfKind, "#[joint(q: planar(z), world -> a, mdh(0, 0, 0, 0))] B"),
    (Code::KeyNotOfKind, "#[joint(q: universal(x, y), world -> a, screw(z, [0, 0, 0]))] B"),
    (Code::KeyNotOfKind, "#[joint(q: ball, world -> a, damping = 0.1, stiffness = 2)] B"),
    (Code::KeyNotOfKind, "#[joint(q: cylindrical(z), world -> a, limits = [0, 1])] B"),
    (Code::KeyNotOfKind, "#[joint(q: translation, world -> a, velocity = 1)] B"),
    (Code::KeyNotOfKind, "#[joint(q: revolute(z), world -> a)] B #[joint(p: free, a -> b, locked = 0)]"),
    (Code::KeyNotOfKind, "J B #[joint(p: ball, a -> b, mimic = q)] #[body(b, solid = sphere(1, 1))]"),
    (Code::MimicUnknown, "J B #[joint(p: revolute(z), a -> b, mimic = qq)] #[body(b, solid = sphere(1, 1))]"),
    (Code::MimicUnknown, "J B #[joint(p: revolute(z), a -> b, mimic = leader)] #[body(b, solid = sphere(1, 1))]"),
    (Code::MimicUnfit, "J B #[joint(p: revolute(z), a -> b, mimic = f)] #[body(b, solid = sphere(1, 1))] #[joint(f: fixed, a -> c)]"),
    (Code::MimicUnfit, "#[joint(q: ball, world -> a)] B #[joint(p: revolute(z), a -> b, mimic = q)] #[body(b, solid = sphere(1, 1))]"),
    (Code::MimicCycle, "#[joint(q: revolute(z), world -> a, mimic = q)] B"),
    (
        Code::MimicCycle,
        "#[joint(q: revolute(z), world -> a, mimic = p)] B #[joint(p: revolute(z), a -> b, mimic = r)] #[body(b, solid = sphere(1, 1))]
         #[joint(r: prismatic(z), b -> c, mimic = q)] #[body(c, solid = sphere(1, 1))]",
    ),
    (Code::RatioZero, "J B #[joint(p: revolute(z), a -> b, mimic = q, ratio = 1 - 1)] #[body(b, solid = sphere(1, 1))]"),
    (Code::RatioZero, "#[joint(q: helical(z, 0mm), world -> a)] B"),
    (Code::RatioZero, "#[joint(q: revolute(z), world -> a, rotor = 1e-5, gear = 0)] B"),
    (Code::PassiveNegative, "#[joint(q: revolute(z), world -> a, damping = -0.1)] B"),
    (Code::PassiveNegative, "#[joint(q: prismatic(z), world -> a, friction = -3N)] B"),
    (Code::PassiveNegative, "#[joint(q: prismatic(z), world -> a, stiffness = -3)] B"),
    (Code::PassiveNegative, "#[joint(q: revolute(z), world -> a, armature = -3)] B"),
    (Code::PassiveNegative, "#[joint(q: revolute(z), world -> a, rotor = -1e-5, gear = 10)] B"),
    (Code::PassiveNegative, "#[joint(q: revolute(z), world -> a, friction = 1, friction_speed = 0)] B"),
    (Code::AxesParallel, "#[joint(q: universal(x, [-2, 0, 0]), world -> a)] B"),
    (Code::AxisMissing, "#[joint(q: revolute, world -> a)] B"),
    (Code::AxisMissing, "#[joint(q: planar(), world -> a)] B"),
    (Code::AxisMissing, "#[joint(q: helical(5mm), world -> a)] B"),
    (Code::AxisUnneeded, "#[joint(q: revolute(z), world -> a, dh(0, 0, 0, 0))] B"),
    (Code::AxisUnneeded, "J B #[joint(f: fixed(z), a -> b)]"),
    (Code::AxisUnneeded, "#[joint(q: ball(z), world -> a)] B"),
    (Code::AxisUnneeded, "#[joint(q: helical(z, 1mm), world -> a, screw(z, [0, 0, 0]))] B"),
    (Code::AxisZero, "#[joint(q: revolute([0, 0, 1 - 1]), world -> a)] B"),
    (Code::AxisNotConstant, "#[joint(q: revolute([0, l, 1]), world -> a)] B"),
    (Code::LimitsUnneeded, "#[joint(q: continuous(z), world -> a, limits = [-1, 1])] B"),
    (Code::LimitsUnneeded, "J B #[joint(f: fixed, a -> b, effort = 3)]"),
    (Code::LimitsInverted, "#[joint(q: revolute(z), world -> a, limits = [1, -1])] B"),
    (Code::LimitNegative, "#[joint(q: revolute(z), world -> a, velocity = -3)] B"),
    (Code::ConstantNeeded, "#[joint(q: prismatic(z), world -> a, limits = [0, l])] B"),
    (Code::AngleLooksLikeDegrees, "#[joint(q: revolute(z), world -> a, rpy = [0, -90, 0])] B"),
    (Code::AngleLooksLikeDegrees, "J B #[joint(p: revolute(z), a -> b, locked = 30)]"),
    (Code::AngleLooksLikeDegrees, "#[joint(q: revolute(z), world -> a, limits = [-3, 170.5])] B"),
    (Code::InertiaMissing, "J #[body(a, mass = 1)]"),
    (Code::MassMissing, "J #[body(a, inertia = diag(1, 1, 1))]"),
    (Code::MassMissing, "J #[body(a, com = [1, 0, 0])]"),
    (Code::MassNegative, "J #[body(a, mass = -1.5, inertia = diag(1, 1, 1))]"),
    (Code::MassNegative, "J #[body(a, solid = sphere(1 - 2, 1))]"),
    (Code::SizeNegative, "J #[body(a, solid = sphere(1, -0.2))]"),
    (Code::InertiaNotSymmetric, "J #[body(a, mass = 1, inertia = [[1, 0, 0], [0, 1, 0.1], [0, 0.2, 1]])]"),
    (Code::InertiaOrder, "J #[body(a, mass = 1, inertia = tensor(1, 0.1, 0, 0.1, 1, 0))]"),
    (
        Code::InertiaNonphysical,
        "J #[body(a, mass = 1, com = [l-l, 0, 0], inertia = diag(0.066, 0.0125, 0.086))]",
    ),
    (Code::InertiaNonphysical, "J #[body(a, mass = 1, inertia = diag(-0.5, 1, 1))]"),
    (Code::InertiaNonphysical, "J #[body(a, mass = 0, inertia = diag(0, 0, 0.35))]"),
    (Code::InertiaNonphysical, "J #[body(a, mass = 0, inertia = diag(0, 0, i))]"),
    (Code::MovesNoMass, "J #[body(a)]"),
    (Code::MovesNoMass, "J #[body(a, mass = 0)]"),
    (Code::MovesNoMass, "J #[body(a, mass = 0kg, com = [1, 0, 0], inertia = diag(0, 0, 0))]"),
    (
        Code::MovesNoMass,
        "#[joint(q: prismatic(z), world -> a)] #[body(a, mass = 0, inertia = diag(0, 0, 1), allow(nonphysical_inertia))]",
    ),
    (
        Code::MassMatrixSingular,
        "J #[body(a)] #[joint(p: revolute(-z), a -> b)] #[body(b, mass = m, com = [l, 0, 0], inertia = diag(1, 1, 1))]",
    ),
    (
        Code::MassMatrixSingular,
        "#[joint(x: prismatic([1, 1, 0]), world -> a)] #[body(a)] #[joint(y: prismatic([1, -2, 0]), a -> b)] #[body(b)]
         #[joint(z: prismatic(x), b -> c)] #[body(c, solid = point(m))]",
    ),
    (Code::Syntax, "J B #[potential]"),
    (Code::Syntax, "J B #[potential()]"),
    (Code::Syntax, "J B #[kinetic(m / 2 * dot(q)^2, 3)]"),
    (Code::Syntax, "J B #[potential(w * a.)]"),
    (Code::Syntax, "J B #[potential(w * q^2^2)]"),
    (Code::Syntax, "J B #[coordinate(theta)]"),
    (Code::Syntax, "J B #[coordinate(theta: turn)]"),
    (Code::KeyNotOfKind, "J B #[coordinate(r: length, at = [0, 0, 1], armature = 2kg)]"),
    (Code::FunctionUnknown, "J B #[potential(w * dist(a, world))]"),
    (Code::CountWrong, "J B #[potential(w * distance(a))]"),
    (Code::CountWrong, "J B #[potential(w * z(a, a))]"),
    (Code::ExponentInvalid, "J B #[potential(w * q^x)]"),
    (Code::ExponentInvalid, "J B #[potential(w * q^0.5)]"),
    (Code::ExponentInvalid, "J B #[potential(w * q^-17)]"),
    (Code::ExponentInvalid, "J #[body(a, mass = m^2m, inertia = diag(1, 1, 1))]"),
    (Code::NameUnknown, "J B #[potential(w * qq^2)]"),
    (Code::NameUnknown, "J B #[potential(w * base.x^2)]"),
    (Code::NameUnknown, "J B #[kinetic(w * dot(qq)^2)]"),
    (Code::NameAmbiguous, "J B #[coordinate(x: length)] #[kinetic(w / 2 * dot(x)^2)] #[potential(m * x * l + m * x^2)]"),
    (Code::NameAmbiguous, "J B #[joint(x: prismatic(z), a -> b)] #[body(b, solid = point(1))] #[potential(w * x^2)]"),
    (Code::FrameUnknown, "J B #[potential(w * distance(a, hook)^2)]"),
    (Code::FrameUnknown, "J B #[potential(w * z(aa))]"),
    (Code::CoordinateUnfit, "J B #[joint(p: universal(x, y), a -> b)] #[body(b, solid = sphere(1, 1))] #[potential(w * p^2)]"),
    (Code::CoordinateUnfit, "J B #[joint(p: universal(x, y), a -> b)] #[body(b, solid = sphere(1, 1))] #[potential(w * p.angle^2)]"),
    (Code::CoordinateUnfit, "J B #[joint(p: ball, a -> b)] #[body(b, solid = sphere(1, 1))] #[potential(w * p.qw^2)]"),
    (Code::CoordinateUnfit, "J B #[joint(p: ball, a -> b)] #[body(b, solid = sphere(1, 1))] #[dissipation(w * dot(p)^2)]"),
    (Code::CoordinateUnfit, "J B #[potential(w * q.x^2)]"),
    (Code::CoordinateUnfit, "J B #[joint(p: fixed, a -> b)] #[potential(w * p^2)]"),
    (Code::SpeedMisplaced, "J B #[potential(w * dot(q)^2)]"),
    (Code::SpeedMisplaced, "J B #[joint(p: free, world -> b)] #[body(b, solid = sphere(1, 1))] #[potential(w * p.vx^2)]"),
    (Code::SpeedMisplaced, "J B #[kinetic(w * dot(dot(q))^2)]"),
    (Code::NotQuadratic, "J B #[kinetic(w * dot(q))]"),
    (Code::NotQuadratic, "J B #[kinetic(i / 2 * dot(q)^2 + w * q * dot(q))]"),
    (Code::NotQuadratic, "J B #[kinetic(w * q)]"),
    (Code::NotQuadratic, "J B #[kinetic(w * sqrt(dot(q)^4))]"),
    (Code::NotQuadratic, "J B #[kinetic(w * dot(q)^4 / dot(q)^2)]"),
    (Code::TermIdle, "J B #[potential(3J)]"),
    (Code::TermIdle, "J B #[dissipation(w * q^2)]"),
    (Code::TermIdle, "J B #[kinetic(w * dot(l)^2)]"),
    (Code::TermIdle, "J B #[potential(w * distance(a, a))]"),
    (Code::TermIdle, "J B #[joint(p: fixed, a -> b)] #[potential(w * distance(a, b))]"),
    (Code::ForceAtRest, "J B #[dissipation(w * dot(q))]"),
    (Code::ForceAtRest, "J B #[dissipation(w * sqrt(dot(q)^2))]"),
    (Code::PassiveNegative, "J B #[dissipation(-3Nms / 2 * dot(q)^2)]"),
    (Code::KineticNegative, "J B #[kinetic(-3kg_m2 * dot(q)^2)]"),
    (Code::DivisionByZero, "J B #[potential(w / z(a))]"),
    (Code::DivisionByZero, "J B #[potential(w / (q - q))]"),
    (Code::UnitMismatch, "J B #[joint(p: fixed, a -> b, at = [l, 0, 0])] #[potential(l * q^2)]"),
    (Code::UnitMismatch, "J B #[potential(20 * z(a)^2)]"),
    (Code::UnitMismatch, "J B #[dissipation(3Nm * dot(q)^2)]"),
    (Code::UnitMismatch, "J B #[potential(w * sin(z(a)))]"),
    (Code::UnitsDiffer, "J B #[potential(w * (q + z(a))^2)]"),
    (Code::MovesNoMass, "J B #[coordinate(r: length)] #[potential(w * r^2)]"),
    (Code::ConstantNeeded, "#[joint(q: revolute(z), world -> a, limits = [-l^2, 1])] B"),
    (
        Code::NumberOutOfRange,
        "#[dynamics(gravity = [0, -1e100, 0])] J #[body(a, com = [1e20, 0, 0], solid = sphere(1e250, 1))]",
    ),
    (Code::MovesNoInertia, "#[joint(q: universal(x, y), world -> a)] #[body(a, solid = rod(1, 0.4, y))]"),
    (Code::MovesNoInertia, "J #[body(a, mass = 0, inertia = diag(1, 0, 0), allow(nonphysical_inertia))]"),
    (Code::MovesNoMass, "#[joint(q: free, world -> a)] #[body(a)]"),
    (Code::MovesNoMass, "#[joint(q: planar(z), world -> a)] #[body(a)]"),
    (Code::MovesNoInertia, "#[joint(q: free, world -> a)] #[body(a, com = [1, 0, 0], solid = rod(1, 2, y))]"),
    (Code::MovesNoInertia, "#[joint(q: ball, world -> a)] #[body(a, com = [0, 2, 0], solid = rod(1, 2, y))]"),
    (Code::MovesNoInertia, "#[joint(q: planar(z), world -> a)] #[body(a, solid = point(1))]"),
    (Code::MovesNoInertia, "J #[body(a, com = [0, 0, l], solid = point(m))]"),
    (Code::UnitMismatch, "J #[body(a, mass = m, com = [l, 0, 0], inertia = diag(m * l, 1, 1))]"),
    (Code::UnitMismatch, "J #[body(a, mass = m, com = [l, 0, 0], inertia = diag(m * l * 1.0, 1, 1))]"),
    (Code::UnitMismatch, "J #[body(a, mass = m, com = [l, 0, 0], inertia = diag(m * l, m * l, m * l))]"),
    (Code::UnitMismatch, "#[joint(q: revolute(z), world -> a, damping = 3N)] B"),
    (Code::UnitMismatch, "#[joint(q: helical(z, 5deg), world -> a)] B"),
    (Code::UnitMismatch, "#[joint(q: prismatic(z), world -> a, rotor = 1e-5, gear = 100rad)] B"),
    (Code::UnitMismatch, "J B #[joint(p: prismatic(z), a -> b, mimic = q, ratio = 2deg)] #[body(b, solid = sphere(1, 1))]"),
    (Code::UnitMismatch, "J B #[joint(p: revolute(z), a -> b, mimic = q, offset = 2mm)] #[body(b, solid = sphere(1, 1))]"),
    (Code::UnitMismatch, "J #[body(a, mass = m, com = [m, 0, 0], inertia = diag(1, 1, 1))]"),
    (Code::UnitMismatch, "J #[body(a, mass = 90deg, inertia = diag(1, 1, 1))]"),
    (Code::UnitMismatch, "J #[body(a, mass = 3m, inertia = diag(1, 1, 1))]"),
    (Code::UnitMismatch, "#[joint(q: revolute(z), world -> a, velocity = 90deg)] B"),
    (Code::UnitMismatch, "#[joint(q: revolute(z), world -> a, at = [l * sin(l), 0, l])] B"),
    (Code::UnitMismatch, "#[joint(q: prismatic(z), world -> a, at = [l, l / w, w])] B"),
    (Code::UnitMismatch, "J #[body(a, mass = m, com = [-(l + 1mm - m), 0, 0], inertia = diag(1, 1, 1))]"),
    (Code::UnitsDiffer, "J #[body(a, mass = m, com = [l, 0, 0], inertia = diag(m * (l + l*l), 1, 1))]"),
    (Code::UnitsDiffer, "J #[body(a, mass = m, inertia = diag(m * (x + x*1mm), 1, 1))]"),
    (Code::DivisionByZero, "J #[body(a, mass = 1 / (l - l), inertia = diag(1, 1, 1))]"),
    (Code::DivisionByZero, "J #[body(a, mass = m * x / ((m + w) - m - w), inertia = diag(1, 1, 1))]"),
    (Code::RootOfNegative, "J #[body(a, mass = sqrt(1 - 2), inertia = diag(1, 1, 1))]"),
    (Code::OutputUnknown, "J B #[dynamics(outputs(mass_matrx))]"),
    (Code::AllowUnknown, "J B #[dynamics(allow(everything))]"),
];

/// Whole structs that contain one mistake.
fn structs() -> Vec<(Code, String)> {
    let deep = format!("{JOINT} #[body(a, mass = {}1{})] struct S;", "(".repeat(80), ")".repeat(80));
    let many: String = (0..1001).map(|k| format!("#[joint(q{k}: revolute(z), world -> b{k})]")).collect();
    let link = |k: usize| {
        let parent = k.checked_sub(1).map_or("world".to_owned(), |before| format!("b{before}"));
        let body = "mass = 1, com = [0.1, 0.2, 0.3], inertia = diag(1, 1, 1)";
        format!("#[joint(q{k}: revolute([1, 2, 3]), {parent} -> b{k}, at = [1, 0, 0])] #[body(b{k}, {body})]")
    };
    let long: String = (0..60).map(link).collect();
    vec![
        (Code::NestingTooDeep, deep),
        (Code::JointsTooMany, format!("{many} struct S;")),
        (Code::NameReserved, format!("{JOINT} #[body(a, solid = rod(1, pi, x))] struct S<T> {{ pi: T }}")),
        (
            Code::NameReserved,
            format!(
                "#[joint(q: revolute(z), world -> a, rpy = [0, 0, π / 4])] {BODY} struct S<T> {{ π: T }}"
            ),
        ),
        (Code::StructNeeded, "enum E { A }".to_owned()),
        (Code::StructNeeded, "union U { a: u8 }".to_owned()),
        (Code::StructNeeded, "struct S(f64);".to_owned()),
        (Code::TermsUnsupported, format!("{long} #[potential(3Nm * q0^2)] struct S;")),
        (Code::AttributeMisplaced, format!("{JOINT} {BODY} struct S {{ #[joint(q: fixed)] a: f64 }}")),
    ]
}

fn cases() -> Vec<(Code, String, Vec<Diagnostic>)> {
    let expand = |line: &str| {
        let parts = line.split(' ').map(|word| match word {
            "J" => JOINT,
            "B" => BODY,
            word => word,
        });
        parts.collect::<Vec<_>>().join(" ")
    };
    let lines = LINES.iter().map(|(code, line)| (*code, (*line).to_owned(), mistakes(&expand(line))));
    let structs = structs().into_iter().map(|(code, text)| {
        let found = mistakes_in(&text);
        (code, text, found)
    });
    lines.chain(structs).collect()
}

#[test]
fn every_mistake_is_found_once_and_explained() {
    let (mut text, mut wrong) = (String::new(), String::new());
    for (code, input, found) in cases() {
        let input: String = input.chars().take(120).collect();
        let codes: Vec<_> = found.iter().map(|found| found.code).collect();
        writeln!(text, "{code} in {input}").unwrap();
        for found in &found {
            writeln!(text, "    {}\n    help: {}", found.message, found.help_text()).unwrap();
        }
        if codes != [code] {
            writeln!(wrong, "{code} in {input}: {found:#?}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    insta::assert_snapshot!(text);
}

#[test]
fn every_code_has_a_case() {
    let covered: Vec<_> =
        LINES.iter().map(|(code, _)| *code).chain(structs().into_iter().map(|(code, _)| code)).collect();
    let of_files = include_str!("urdf/mistakes.rs").to_owned() + include_str!("urdf/hostile.rs");
    for code in Code::ALL.iter().filter(|code| **code != Code::SelfCheckFailed) {
        let of_files = of_files.contains(&format!("Code::{},", code.name()))
            || of_files.contains(&format!("Code::{})", code.name()));
        assert!(covered.contains(code) || of_files, "{code} has no case");
    }
}

const SKEWED: &str = r#"
    #[dynamics(gravity = [0, 0, -g], crate = "::dynamics_core", snap = off, outputs(mass_matrix))]
    #[joint(a: revolute, world -> one, dh(l, 90deg, 0.1 * l, -pi / 2), limits = [-1, 1], velocity = 3)]
    #[body(one, mass = m, com = [0, (l + 1) / 2, -l], inertia = tensor(i, 0, 0, i, 0, i), inertia_rpy = [0.1, 0, 0])]
    #[joint(b: prismatic([0, 1, -1]), one -> two, at = [0, 0, sqrt(l * l)], rpy = [0, 0, x])]
    #[body(two, solid = cylinder(2.5kg, 30mm, l, x), allow(nonphysical_inertia))]
    #[joint(c: continuous, two -> three, screw(-y, through = [0, 1, 0]))]
    #[body(three, mass = 1, inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]])]
    #[joint(tip: fixed, three -> tool, mdh(0, 0, l, 0))]
    #[joint(d: helical(z, 5mm / (2*pi)), one -> four, rotor = 1e-5, gear = -50, friction = 1, friction_speed = 0.1)]
    #[body(four, solid = sphere(1, 1))]
    #[joint(e: revolute([1, 1, 0]), four -> five, mimic = d, ratio = -0.5, offset = 10deg, damping = 0.1)]
    #[body(five, solid = sphere(1, 1))]
    #[joint(f: universal(x, [0, 1, 1]), five -> six, actuated = off)] #[body(six, solid = sphere(1, 1))]
    #[joint(g: prismatic(x), six -> seven, locked = 2cm, stiffness = 3, rest = l)]
    #[joint(base: free, world -> hull)] #[body(hull, solid = sphere(1, 1))]
    #[coordinate(sway: length, damping = 3)]
    #[potential(k / 2 * (distance(tool, hull) - l)^2 + 3J * cos(d) + 2N * base.z)]
    #[dissipation(2Nms / 2 * (dot(d) - base.wx)^2 + r * sqrt(dot(b)^2 + 1e-4))]
    #[kinetic(m / 2 * (dot(b)^2 + dot(sway)^2 + 2 * dot(z(tool)) * dot(x(six))) / (1 + sin(d)^-2))]
    struct Robot<T> { m: T, l: T, i: T, g: T, x: T, k: T, r: T }"#;

/// All token streams with one token left out, doubled, or changed for another one.
fn mutations(tokens: &proc_macro2::TokenStream) -> Vec<proc_macro2::TokenStream> {
    use proc_macro2::{Group, TokenStream, TokenTree};
    let trees: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let other: Vec<TokenTree> =
        "- 0 x [ ] ( 1 , 2 ) 1e400 world".parse::<TokenStream>().unwrap().into_iter().collect();
    let with = |i: usize, new: Vec<TokenTree>| -> TokenStream {
        trees[..i].iter().cloned().chain(new).chain(trees[i + 1..].iter().cloned()).collect()
    };
    let mut all = vec![];
    for (i, tree) in trees.iter().enumerate() {
        all.push(with(i, vec![]));
        all.push(with(i, vec![tree.clone(), tree.clone()]));
        all.extend(other.iter().map(|other| with(i, vec![other.clone()])));
        if let TokenTree::Group(group) = tree {
            let changed = mutations(&group.stream()).into_iter();
            all.extend(changed.map(|inner| with(i, vec![Group::new(group.delimiter(), inner).into()])));
        }
    }
    all
}

#[test]
fn no_slip_of_one_token_panics() {
    assert_eq!(mistakes_in(SKEWED).len(), 0, "{:#?}", mistakes_in(SKEWED));
    let mutated = mutations(&SKEWED.parse().unwrap());
    assert!(mutated.len() > 2000);
    for tokens in mutated {
        let Ok(input) = syn::parse2(tokens) else { continue };
        let mut diags = Diagnostics::new();
        let spec = spec::parse(&input, &mut diags);
        if diags.is_empty() {
            let graph = Graph::new();
            let built = model::build(&spec, &graph, &mut diags).is_some();
            assert_eq!(built, diags.is_empty());
        }
        assert!(diags.len() < 12, "one slip, few mistakes");
        for found in diags.take() {
            assert!(!found.message.is_empty() && !found.help_text().is_empty());
        }
    }
}
