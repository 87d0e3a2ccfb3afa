//! Judges each line by itself: which options go together, and numbers that cannot be meant.

use super::joints;
use super::quantities::{Quantity, Slot};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{BodySpec, Formula, FormulaKind, JointAmendment, Name, RobotSpec, plain};
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
    "inverse_dynamics_with_derivatives",
    "forward_dynamics_with_derivatives",
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
    check_file(spec, diags);
    for joint in &spec.joints {
        joints::check(joint, diags);
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

/// What is said of a file that is not there.
fn check_file(spec: &RobotSpec, diags: &mut Diagnostics) {
    for JointAmendment { name, .. } in &spec.amendments {
        let message = format!("the joint `{name}` has no kind, and there is no file that has it");
        let help = "write `#[joint(name: kind(axis), parent -> child, …)]`";
        diags.push(Diagnostic::new(Code::Syntax, &name.place, message).help(help));
    }
    if let Some(base) = &spec.options.base {
        let help = match base.is_free {
            true => "carry the first body by a free joint: `#[joint(root_joint: free, world -> body)]`",
            false => "leave `base` out: joints on `world` hold the robot",
        };
        let message = "`base` says how a file's root stands in the world, and there is no `urdf`";
        diags.push(Diagnostic::new(Code::KeyMissing, &base.place, message).help(help));
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
