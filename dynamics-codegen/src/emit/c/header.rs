//! The header: what the robot is, in which units and frames, and the declarations.

use std::fmt::Write as _;

use super::functions::{Function, LeftOut};
use super::names::Robot;
use super::words::comment;
use super::{Input, configuration};
use crate::model::{JointInfo, Limits};

const CONVENTIONS: &[&str] = &[
    "M(q) a + C(q,v) v + G(q) + passive forces = tau",
    "",
    "SI units and radians. Gravity is that of the robot's description. Joint forces are positive along",
    "the axes, so that v^T tau is the power put in. Six-vectors are linear first, then angular. A",
    "quaternion is i, j, k, w, and of unit length; the velocity of a ball joint is the angular velocity of",
    "its body in the body's axes, that of a free joint the twist of its body. Derivatives by q are by such",
    "motions.",
    "",
    "Matrices are by rows. An entry has the unit of its row over that of its column: M[i][k] and",
    "dtau_da[i][k] that of tau[i] over that of a[k], dtau_dq[i][k] that of tau[i] over that of q[k].",
    "",
    "Every function is a pure one: it reads its arguments, writes its results, and keeps nothing, so that",
    "it may be interrupted and called from everywhere. Straight lines have no branch but that of the",
    "sine's range: the worst case is the only case. What is not finite comes out as not finite. Results",
    "must not overlap arguments.",
];

/// The first lines of both files.
pub(super) fn banner(input: &Input<'_, '_>) -> String {
    comment(input.origin) + "\n"
}

/// Writes the file.
pub(super) fn write(
    input: &Input<'_, '_>,
    robot: &Robot,
    functions: &[Function],
    left_out: &[LeftOut],
) -> String {
    let guard = robot.size("H");
    let sizes = input.compiled.sizes().inputs;
    let mut text = banner(input);
    let _ = writeln!(text, "#ifndef {guard}\n#define {guard}\n");
    text.push_str(&comment(&about(input)));
    let _ = write!(
        text,
        "\n#define {} {}\n#define {} {}\n\n",
        robot.size("NQ"),
        sizes.coordinates,
        robot.size("NV"),
        sizes.dof
    );
    text.push_str("#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
    if robot.has_fields() {
        text.push_str(&structs(input, robot));
    }
    let _ = writeln!(
        text,
        "/* Zeros, and quaternions of no rotation. */\n{};\n\n\
         /* Where q gets to by delta = v dt: a step of time on the configurations. moved may be q. */\n{};\n\n\
         /* The delta by which q0 gets to q1; of orientations the shorter way, up to half a turn. */\n{};\n",
        configuration::neutral(robot, input.real),
        configuration::integrate(robot, input.real),
        configuration::difference(robot, input.real)
    );
    for function in functions {
        let _ = writeln!(text, "{}{};\n", function.comment, function.signature);
    }
    if !left_out.is_empty() {
        let mut lines = vec!["The robot is too large for these in straight lines:".to_owned()];
        lines.extend(left_out.iter().map(|left| format!("  {}: {}", left.function, left.headline)));
        text.push_str(&comment(&lines));
        text.push('\n');
    }
    let _ = writeln!(text, "#ifdef __cplusplus\n}}\n#endif\n\n#endif");
    text
}

/// The conventions, and a table of the coordinates.
fn about(input: &Input<'_, '_>) -> Vec<String> {
    let mut lines: Vec<String> = CONVENTIONS.iter().map(|&line| line.to_owned()).collect();
    let joints = &input.model.joints;
    lines.push(String::new());
    lines.push("Coordinates, with their units and limits:".to_owned());
    let coordinates = joints.iter().flat_map(JointInfo::coordinate_names).enumerate();
    lines.extend(coordinates.map(|(k, name)| format!("  q[{k}]  {name}{}", of_coordinate(input, k))));
    lines.push(String::new());
    lines.push("Speeds (also the entries of a and tau), with the units of v and of tau:".to_owned());
    let speeds = joints.iter().flat_map(JointInfo::speed_names).enumerate();
    lines.extend(speeds.map(|(k, name)| format!("  v[{k}]  {name}{}", of_speed(input, k))));
    lines
}

/// `, rad, -2.967 to 2.967`
fn of_coordinate(input: &Input<'_, '_>, k: usize) -> String {
    let joint = input.model.joints.iter().find(|joint| joint.q.contains(&k));
    let unit = match joint.and_then(|joint| joint.kind.coordinate_turns()[k - joint.q.start]) {
        Some(true) => ", rad",
        Some(false) => ", m",
        None => "",
    };
    let joint = joint.filter(|joint| joint.q.len() == joint.v.len());
    let limits = joint.and_then(|joint| joint.limits.get(k - joint.q.start));
    let range = limits.map_or(String::new(), |Limits { lower, upper, .. }| match (lower, upper) {
        (&f64::NEG_INFINITY, &f64::INFINITY) => String::new(),
        (&f64::NEG_INFINITY, upper) => format!(", at most {upper}"),
        (lower, &f64::INFINITY) => format!(", at least {lower}"),
        (lower, upper) => format!(", {lower} to {upper}"),
    });
    format!("{unit}{range}")
}

/// `, rad/s, N m, |v| <= 1.7, |tau| <= 320`
fn of_speed(input: &Input<'_, '_>, k: usize) -> String {
    let joint = input.model.joints.iter().find(|joint| joint.v.contains(&k));
    let units = joint.map_or("", |joint| match joint.kind.turns()[k - joint.v.start] {
        true => ", rad/s, N m",
        false => ", m/s, N",
    });
    let limits = joint.and_then(|joint| joint.limits.get(k - joint.v.start));
    let bound = |name: &str, value: f64| {
        if value.is_finite() { format!(", |{name}| <= {value}") } else { String::new() }
    };
    let bounds =
        limits.map_or(String::new(), |limits| bound("v", limits.velocity) + &bound("tau", limits.effort));
    let passive = if joint.is_some_and(|joint| !joint.actuated) { ", without a motor" } else { "" };
    format!("{units}{bounds}{passive}")
}

/// The fields of the robot, and what is made of them once.
fn structs(input: &Input<'_, '_>, robot: &Robot) -> String {
    let (prefix, real) = (&robot.prefix, input.real.name());
    let mut text = "/* What is known at run time only. */\ntypedef struct {\n".to_owned();
    for (name, parameter) in robot.parameters.iter().zip(&input.model.parameters) {
        let unit = parameter.unit.as_deref().map_or(String::new(), |unit| format!(" /* {} */", ascii(unit)));
        let _ = writeln!(text, "    {real} {name};{unit}");
    }
    let _ = writeln!(
        text,
        "}} {prefix}_fields;\n\n/* All that depends on the fields alone, by {prefix}_prepare. */"
    );
    text.push_str("typedef struct {\n");
    for field in &robot.fields {
        let _ = writeln!(text, "    {real} {field};");
    }
    let _ = writeln!(
        text,
        "}} {prefix}_robot;\n\n/* To be called once, and again when a field changes. {} */\n{};\n",
        super::words::describe(input.compiled.companion.preparation.cost()),
        prepare(robot)
    );
    text
}

/// A unit in the letters of every source file: `kg m^2`.
fn ascii(unit: &str) -> String {
    unit.replace('·', " ").replace('²', "^2").replace('³', "^3").replace('⁻', "^-").replace('¹', "1")
}

pub(super) fn prepare(Robot { prefix, .. }: &Robot) -> String {
    format!("void {prefix}_prepare(const {prefix}_fields *fields, {prefix}_robot *robot)")
}
