//! Judges each line by itself: which options go together, and numbers that cannot be meant.

use super::quantities::{Quantity, Slot};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{
    BodySpec, Formula, FormulaKind, JointKind, JointSpec, Name, PlacementKind, RobotSpec, plain,
};
use crate::symbolic::Number;

/// The methods that `outputs(…)` may name.
pub const OUTPUTS: &[&str] = &[
    "mass_matrix",
    "inverse_mass_matrix",
    "coriolis_matrix",
    "gravity_forces",
    "passive_forces",
    "bias_forces",
    "inverse_dynamics",
    "forward_dynamics",
    "kinetic_energy",
    "potential_energy",
    "elastic_energy",
    "lagrangian",
    "equations_of_motion",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
    "total_mass",
    "center_of_mass",
    "center_of_mass_jacobian",
    "centroidal_momentum",
    "centroidal_momentum_matrix",
    "regressor",
    "inertial_parameters",
    "base_regressor",
    "base_parameters",
    "pose",
    "jacobian",
    "world_jacobian",
    "velocity",
    "acceleration",
];

/// The one thing that `allow(…)` may name.
pub(super) const NONPHYSICAL_INERTIA: &str = "nonphysical_inertia";

/// Checks all lines.
pub(super) fn check(spec: &RobotSpec, slots: &[Slot], diags: &mut Diagnostics) {
    for output in spec.options.outputs.iter().flatten().filter(|output| !OUTPUTS.contains(&&*output.text)) {
        let message = format!("there is no output `{output}`");
        let unknown = Diagnostic::new(Code::OutputUnknown, &output.place, message);
        diags.push(
            unknown
                .help(format!("use one of {}", OUTPUTS.join(", ")))
                .suggest(&output.text, OUTPUTS.iter().copied()),
        );
    }
    check_allowed(spec.options.allow.as_deref(), diags);
    for joint in &spec.joints {
        check_axis(joint, diags);
        check_placement(joint, diags);
        check_limits(joint, diags);
    }
    for body in &spec.bodies {
        check_allowed(body.allow.as_deref(), diags);
        check_body(body, diags);
    }
    for slot in slots {
        check_angle(slot, diags);
    }
}

fn check_allowed(names: Option<&[Name]>, diags: &mut Diagnostics) {
    for name in names.into_iter().flatten().filter(|name| name.text != NONPHYSICAL_INERTIA) {
        let message = format!("there is nothing called `{name}` to allow");
        diags.push(
            Diagnostic::new(Code::AllowUnknown, &name.place, message)
                .suggest(&name.text, [NONPHYSICAL_INERTIA]),
        );
    }
}

fn check_axis(joint: &JointSpec, diags: &mut Diagnostics) {
    let (name, kind) = (&joint.name, joint.kind);
    match (&joint.axis, &joint.placement) {
        (None, None) if kind != JointKind::Fixed => {
            diags.error(Code::AxisMissing, &joint.kind_place, format!("the joint `{name}` has no axis"));
        }
        (Some(axis), _) if kind == JointKind::Fixed => {
            let message = format!("the joint `{name}` does not move, and has an axis");
            let unneeded = Diagnostic::new(Code::AxisUnneeded, &axis.place, message);
            diags.push(unneeded.help("leave the axis out: write `fixed`"));
        }
        (Some(axis), Some(placement)) => {
            let key = key_of(&placement.kind);
            let message = format!("the axis of `{name}` is given twice: by `{key}` as well");
            diags.error(Code::AxisUnneeded, &axis.place, message);
        }
        _ => {}
    }
}

fn key_of(placement: &PlacementKind) -> &'static str {
    match placement {
        PlacementKind::Dh(_) => "dh",
        PlacementKind::ModifiedDh(_) => "mdh",
        PlacementKind::Screw { .. } => "screw",
    }
}

fn check_placement(joint: &JointSpec, diags: &mut Diagnostics) {
    let Some(placement) = &joint.placement else { return };
    let (name, key) = (&joint.name, key_of(&placement.kind));
    if key == "screw" && joint.kind == JointKind::Fixed {
        let message = format!("the joint `{name}` does not move, and has a screw");
        let conflict = Diagnostic::new(Code::KeysConflict, &placement.place, message);
        diags.push(conflict.help("place it by `at` and `rpy`"));
    } else if key != "screw" && (joint.at.is_some() || joint.rpy.is_some()) {
        let other = if joint.at.is_some() { "at" } else { "rpy" };
        let message = format!("the joint `{name}` is placed twice: by `{key}` and by `{other}`");
        let conflict = Diagnostic::new(Code::KeysConflict, &placement.place, message);
        diags.push(conflict.help("keep one of the two; a `fixed` joint in between can hold the other"));
    }
}

fn check_limits(joint: &JointSpec, diags: &mut Diagnostics) {
    let name = &joint.name;
    let [lower, _] = match &joint.limits {
        Some(limits) => limits.each_ref().map(Some),
        None => [None; 2],
    };
    let (why, unneeded) = match joint.kind {
        JointKind::Fixed => ("does not move", [lower, joint.velocity.as_ref(), joint.effort.as_ref()]),
        JointKind::Continuous => ("turns without end", [lower, None, None]),
        _ => return,
    };
    for limit in unneeded.into_iter().flatten() {
        diags.error(Code::LimitsUnneeded, &limit.place, format!("the joint `{name}` {why}, and has a limit"));
    }
}

fn check_body(body: &BodySpec, diags: &mut Diagnostics) {
    let name = &body.name;
    if let Some(solid) = &body.solid {
        let given = [("mass", body.mass.is_some()), ("inertia", body.inertia.is_some())];
        for (key, _) in given.into_iter().filter(|(_, given)| *given) {
            let message = format!("the {key} of `{name}` is given twice: by `{key}` and by `solid`");
            diags.error(Code::KeysConflict, &solid.place, message);
        }
        return;
    }
    match (&body.mass, &body.inertia) {
        (Some(mass), None) if !is_zero(mass) => {
            diags.error(Code::InertiaMissing, &mass.place, format!("`{name}` has a mass, and no inertia"));
        }
        (None, Some(inertia)) => {
            diags.error(Code::MassMissing, &inertia.place, format!("`{name}` has an inertia, and no mass"));
        }
        (None, None) => {
            let given = [("com", &body.com), ("inertia_rpy", &body.inertia_rpy)];
            let given = given.into_iter().find_map(|(key, parts)| Some((key, &parts.as_ref()?[0])));
            if let Some((key, part)) = given {
                diags.error(Code::MassMissing, &part.place, format!("`{name}` has `{key}`, and no mass"));
            }
        }
        (Some(_), _) => {}
    }
}

/// Whether a literal says zero: a body without mass has no inertia to give.
fn is_zero(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Number(value, _) => value.is_zero(),
        FormulaKind::Negative(inner) => is_zero(inner),
        _ => false,
    }
}

/// Angles without a unit: more than one turn of a frame, more than three turns of a joint, are not meant.
fn check_angle(slot: &Slot, diags: &mut Diagnostics) {
    let turns = if slot.constant.is_some() { 3 } else { 1 };
    let Some(angle) = slot.formula.bare_literal().filter(|_| slot.quantity == Quantity::Angle) else {
        return;
    };
    if angle.abs().cmp_value(Number::integer(2 * turns) * Number::PI).is_gt() {
        let message = format!(
            "{} is {} rad, {:.1} turns",
            slot.name(),
            plain(angle),
            angle.abs().to_f64() / std::f64::consts::TAU
        );
        let help = format!("angles are in radians: write `{}deg`, or `{0}rad` if it is meant", plain(angle));
        diags.push(Diagnostic::new(Code::AngleLooksLikeDegrees, &slot.formula.place, message).help(help));
    }
}
