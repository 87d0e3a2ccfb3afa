//! Judges the line of a joint by itself: which keys its kind has, and which go together.

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::spec::{JointKind, JointSpec, PlacementKind};

/// Checks one joint.
pub(super) fn check(joint: &JointSpec, diags: &mut Diagnostics) {
    if joint.is_bare {
        check_place_of_coordinate(joint, diags);
    }
    check_placement(joint, diags);
    check_axes(joint, diags);
    check_limits(joint, diags);
    check_keys(joint, diags);
    check_conflicts(joint, diags);
    check_companions(joint, diags);
}

/// The placement, if the joint's kind can have it.
fn placement(joint: &JointSpec) -> Option<(&'static str, &Place)> {
    let placement = joint.keys.placement.as_ref()?;
    let (key, fits) = match placement.kind {
        PlacementKind::Dh(_) => ("dh", joint.kind.takes_dh()),
        PlacementKind::ModifiedDh(_) => ("mdh", joint.kind.takes_dh()),
        PlacementKind::Screw { .. } => ("screw", joint.kind.axes() == 1),
    };
    fits.then_some((key, &placement.place))
}

/// A coordinate is nowhere.
fn check_place_of_coordinate(joint: &JointSpec, diags: &mut Diagnostics) {
    let JointSpec { name, keys, .. } = joint;
    let placement = keys.placement.as_ref().map(|placement| ("dh", &placement.place));
    let given = keys.given().filter(|(key, _)| matches!(*key, "at" | "rpy")).chain(placement);
    for (key, place) in given {
        let message = format!("`{name}` is a coordinate without a body, and has a place by `{key}`");
        let unfit = Diagnostic::new(Code::KeyNotOfKind, place, message);
        diags.push(unfit.help(
            "leave the key out, or write a joint and a body: `#[joint(name: revolute(z), world -> body, …)]`",
        ));
    }
}

fn check_placement(joint: &JointSpec, diags: &mut Diagnostics) {
    let JointSpec { name, kind, keys, .. } = joint;
    match (placement(joint), &keys.placement) {
        (None, Some(placement)) => {
            let form = match placement.kind {
                PlacementKind::Screw { .. } => "a screw, which is for joints of one axis",
                _ => "parameters of Denavit and Hartenberg, which are for joints about or along one axis",
            };
            let message = format!("the joint `{name}` is {}, and has {form}", article(*kind));
            let unfit = Diagnostic::new(Code::KeyNotOfKind, &placement.place, message);
            diags.push(unfit.help("place it by `at` and `rpy`"));
        }
        (Some((key @ ("dh" | "mdh"), place)), _) if keys.at.is_some() || keys.rpy.is_some() => {
            let other = if keys.at.is_some() { "at" } else { "rpy" };
            let message = format!("the joint `{name}` is placed twice: by `{key}` and by `{other}`");
            let conflict = Diagnostic::new(Code::KeysConflict, place, message);
            diags.push(conflict.help("keep one of the two; a `fixed` joint in between can hold the other"));
        }
        _ => {}
    }
}

fn check_axes(joint: &JointSpec, diags: &mut Diagnostics) {
    let JointSpec { name, kind, kind_place, axes, pitch, keys, .. } = joint;
    match (axes.first(), placement(joint)) {
        (None, None) if kind.axes() > 0 && keys.placement.is_none() => {
            let missing =
                Diagnostic::new(Code::AxisMissing, kind_place, format!("the joint `{name}` has no axis"));
            diags.push(missing.help(format!(
                "give {}, as in `{}`",
                kind.parts().join(" and "),
                kind.example()
            )));
        }
        (Some(axis), _) if kind.axes() == 0 => {
            let message = match kind {
                JointKind::Fixed => format!("the joint `{name}` does not move, and has an axis"),
                _ => format!("the joint `{name}` is {}, which has no axis", article(*kind)),
            };
            let unneeded = Diagnostic::new(Code::AxisUnneeded, &axis.place, message);
            diags.push(unneeded.help(format!("leave the axis out: write `{}`", kind.name())));
        }
        (Some(_), Some(_)) if joint.is_bare => {}
        (Some(axis), Some((key, _))) => {
            let message = format!("the axis of `{name}` is given twice: by `{key}` as well");
            diags.error(Code::AxisUnneeded, &axis.place, message);
        }
        (axis, _) if *kind == JointKind::Helical && pitch.is_none() => {
            let missing =
                Diagnostic::new(Code::CountWrong, kind_place, format!("the joint `{name}` has no pitch"));
            let whole = if axis.is_some() { "helical(z, 5mm / (2*pi))" } else { "helical(5mm / (2*pi))" };
            diags.push(missing.help(format!("give how far it slides for each radian, as in `{whole}`")));
        }
        _ => {}
    }
}

/// As in "a ball joint".
fn article(kind: JointKind) -> String {
    match kind {
        JointKind::Fixed => "fixed".to_owned(),
        JointKind::Universal => "a universal joint".to_owned(),
        _ => format!("a {} joint", kind.name()),
    }
}

fn check_limits(joint: &JointSpec, diags: &mut Diagnostics) {
    let JointSpec { name, kind, keys, .. } = joint;
    let (why, unneeded): (_, &[&str]) = match kind {
        JointKind::Fixed => ("does not move", &["limits", "velocity", "effort"]),
        JointKind::Continuous => ("turns without end", &["limits"]),
        _ => return,
    };
    for (_, place) in keys.given().filter(|(key, _)| unneeded.contains(key)) {
        diags.error(Code::LimitsUnneeded, place, format!("the joint `{name}` {why}, and has a limit"));
    }
}

/// The keys of a joint that has one coordinate, which others have not.
fn check_keys(joint: &JointSpec, diags: &mut Diagnostics) {
    let JointSpec { name, kind, keys, .. } = joint;
    let speeds = kind.speeds();
    let of_all: &[&str] = match speeds {
        1 => return,
        0 => &["at", "rpy", "limits", "velocity", "effort"],
        _ => &["at", "rpy", "actuated"],
    };
    let unfit: Vec<_> = keys.given().filter(|(key, _)| !of_all.contains(key)).collect();
    let Some((first, place)) = unfit.first() else { return };
    let listed = unfit.iter().map(|(key, _)| format!("`{key}`")).collect::<Vec<_>>().join(", ");
    let message = match speeds {
        0 => format!("the joint `{name}` does not move, and has {listed}"),
        _ if unfit.len() > 1 => {
            format!("{listed} are for joints of one degree of freedom, and `{name}` has {speeds}")
        }
        _ => format!("{listed} is for joints of one degree of freedom, and `{name}` has {speeds}"),
    };
    let unfit = Diagnostic::new(Code::KeyNotOfKind, place, message);
    diags.push(match (speeds, *first, place) {
        (0, ..) => unfit.help(format!("leave {listed} out, or let the joint move")),
        (_, "locked", _) => unfit.help("make the joint `fixed`, and place it by `at` and `rpy`"),
        (_, "damping" | "friction" | "armature", Place::Text { .. }) => unfit
            .help("leave passive forces out by `#[dynamics(passive = off)]`, or take them out of the file"),
        _ => unfit,
    });
}

/// Keys of which a joint has one or the other.
const CONFLICTS: &[(&str, &str, &str)] = &[
    ("mimic", "locked", "keep one of the two: a joint that is locked follows none"),
    ("mimic", "actuated", "leave `actuated` out: what drives the leader drives its followers"),
    ("mimic", "limits", "give the limits to the joint that it follows"),
    ("mimic", "velocity", "give the limit to the joint that it follows"),
    ("mimic", "effort", "give the limit to the joint that it follows"),
    ("locked", "actuated", "leave `actuated` out: a joint that is locked has no input"),
    (
        "armature",
        "rotor",
        "keep one of the two: the armature is the rotor's inertia times the square of the gear",
    ),
    (
        "armature",
        "gear",
        "keep one of the two: the armature is the rotor's inertia times the square of the gear",
    ),
];

fn check_conflicts(joint: &JointSpec, diags: &mut Diagnostics) {
    let place = |wanted: &str| joint.keys.given().find(|(key, _)| *key == wanted).map(|(_, place)| place);
    let (is_single, name) = (joint.kind.speeds() == 1, &joint.name);
    for (one, other, help) in CONFLICTS.iter().filter(|_| is_single) {
        let (Some(_), Some(place)) = (place(one), place(other)) else { continue };
        let message = format!("the joint `{name}` has both `{one}` and `{other}`");
        diags.push(Diagnostic::new(Code::KeysConflict, place, message).help(*help));
        // A joint with several of the same kind has one of the mistakes.
        return;
    }
}

/// Keys that say nothing without another one.
const COMPANIONS: &[(&str, &str, &str)] = &[
    ("ratio", "mimic", "name the joint to follow: `mimic = leader`"),
    ("offset", "mimic", "name the joint to follow: `mimic = leader`"),
    ("rotor", "gear", "give how far the rotor turns for each unit of the joint, as in `gear = 100`"),
    ("gear", "rotor", "give the rotor's inertia about its own shaft, as in `rotor = 1e-5`"),
    ("friction_speed", "friction", "give the friction, as in `friction = 0.5`"),
    ("rest", "stiffness", "give the stiffness of the spring, as in `stiffness = 10`"),
];

fn check_companions(joint: &JointSpec, diags: &mut Diagnostics) {
    let given: Vec<_> = joint.keys.given().collect();
    let has = |wanted: &str| given.iter().any(|(key, _)| *key == wanted);
    let is_single = joint.kind.speeds() == 1;
    let mut missing = vec![];
    for (key, needed, help) in COMPANIONS.iter().filter(|(_, needed, _)| is_single && !has(needed)) {
        let Some((_, place)) = given.iter().find(|(given, _)| given == key) else { continue };
        // Beside an armature they are a mistake already.
        let is_conflict = matches!(*key, "rotor" | "gear") && has("armature");
        if !missing.contains(needed) && !is_conflict {
            missing.push(needed);
            let message = format!("the joint `{}` has `{key}`, and no `{needed}`", joint.name);
            diags.push(Diagnostic::new(Code::KeyMissing, place, message).help(*help));
        }
    }
}
