//! The numbers of a robot: masses, joints, limits, and what acts in joints by itself.

use dynamics_codegen::model::Parameter;
use dynamics_codegen::spec::plain;
use dynamics_core::Pose;
use dynamics_view::page::{Section, Table, number};
use dynamics_view::{Body, Motion};

use super::Subject;
use crate::picture::scene;
use crate::robot::State;
use crate::{check, tree};

const DIGITS: usize = 6;

pub(super) fn section(subject: &Subject<'_, '_>) -> Section {
    let robot = subject.robot;
    let bodies = scene::of(robot, String::new()).bodies;
    let mut section = Section::new("parameters", "Parameters")
        .text("All numbers are in SI units, angles in radians.")
        .preformatted("The tree of bodies", &tree(subject));
    if !subject.fields.is_empty() {
        section = section.table(fields(subject));
    }
    if !bodies.is_empty() {
        section = of_bodies(section, subject, &bodies);
    }
    section = section.table(table("Coordinates and limits", &check::joint_rows(robot)));
    let followers = check::followers(&robot.spec);
    if !followers.is_empty() {
        section = section
            .heading("Joints that follow others")
            .list(followers.lines().map(|line| format!("`{}`", line.trim())));
    }
    let terms = without_margin(&check::terms(&robot.spec));
    let section = match terms.is_empty() {
        true => section,
        false => section
            .heading("Terms of the energies")
            .preformatted("What is added to the potential, the dissipation and the kinetic energy", &terms),
    };
    let passive = check::passive_rows(robot);
    match passive.is_empty() {
        true if robot.tree.frames.is_empty() => section,
        true => section.text("No rotors, dampers, friction or springs act in the joints."),
        false => section.heading("What acts in joints by itself").table(table(
            "Inertia of rotors, as the joint feels it; damping; friction; stiffness of springs",
            &passive,
        )),
    }
}

/// What the fields are called in the equations, and their values.
fn fields(subject: &Subject<'_, '_>) -> Table {
    let row = |field: &Parameter| {
        let known = subject.robot.spec.known.iter().find(|(name, _)| *name == field.name);
        let value = known.map_or(String::new(), |(_, value)| plain(*value).replacen('-', "−", 1));
        let unit = field.unit.clone().filter(|unit| unit != "1").unwrap_or_default();
        let letter = subject.notation.letter(field.symbol).name.unicode();
        vec![format!("`{}`", field.name), letter, value, unit]
    };
    Table::new("Fields", "llrl")
        .head(["field", "symbol", "value", "unit"])
        .rows(subject.fields.iter().map(row))
}

/// What bodies weigh, and what carries them.
fn of_bodies(section: Section, subject: &Subject<'_, '_>, bodies: &[Body]) -> Section {
    section
        .heading("Masses")
        .table(masses(bodies))
        .remark(
            "Each with all that is welded to it. The centre of mass c is in the body's own frame, the inertia about \
             c in the body's axes.",
        )
        .heading("Joints")
        .table(joints(subject, bodies))
        .remark(
            "The frame of a body is where its joint at zero puts it in the frame of its parent; its axis is in the \
             body's own frame.",
        )
}

/// The tree as `check` draws it, without its margin.
fn tree(subject: &Subject<'_, '_>) -> String {
    let drawn = tree::draw(&subject.robot.spec, &subject.robot.report.root);
    without_margin(&drawn)
}

fn without_margin(text: &str) -> String {
    text.lines().map(|line| line.strip_prefix("  ").unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// Rows with their head before them; the columns behind the names are numbers.
fn table(caption: &str, rows: &[Vec<String>]) -> Table {
    let Some((head, rows)) = rows.split_first() else { return Table::new(caption, "") };
    let first_number = head.iter().position(|name| name == "lower" || name == "armature").unwrap_or(1);
    let columns: String = (0..head.len()).map(|k| if k < first_number { 'l' } else { 'r' }).collect();
    let shown = rows.iter().map(|row| row.iter().map(|cell| cell.replacen('-', "−", 1)).collect());
    Table::new(caption, &columns).head(head.iter().map(String::as_str)).rows(shown)
}

fn masses(bodies: &[Body]) -> Table {
    let head = ["body", "mass, kg", "c, m", "Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz, kg·m²"];
    let row = |body: &Body| {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = body.inertia;
        // What is left of a product of inertia by moving it to another frame is rounding.
        let short = |moment: f64| if moment.abs() <= 1e-12 * (xx + yy + zz) { 0.0 } else { moment };
        let moments = [xx, yy, zz, xy, xz, yz].map(|moment| number(short(moment), DIGITS));
        let name = format!("`{}`", body.name);
        [vec![name, number(body.mass, DIGITS), vector(body.com)], moments.to_vec()].concat()
    };
    Table::new("Bodies with mass that move", "lrlrrrrrr")
        .head(head)
        .rows(bodies.iter().filter(|body| body.mass > 0.0).map(row))
}

fn joints(subject: &Subject<'_, '_>, bodies: &[Body]) -> Table {
    let poses = scene::poses(subject.robot, &State::neutral(subject.robot).q);
    let row = |(k, body): (usize, &Body)| {
        let of_parent = body.parent.map_or(Pose::identity(), |parent| poses[parent]);
        let pose = of_parent.inverse() * poses[k];
        let parent = body.parent.map_or("world", |parent| &bodies[parent].name);
        let axes: Vec<String> = body.joint.motions.iter().map(axis).collect();
        // A free joint has all six.
        let axes = if axes.len() > 3 { "any".to_owned() } else { axes.join(", ") };
        vec![
            format!("`{}`", body.joint.name),
            body.joint.kind.clone(),
            format!("`{parent}` → `{}`", body.name),
            vector(pose.translation.data.0[0]),
            vector(angles(&pose)),
            axes,
        ]
    };
    let own = bodies.iter().enumerate().filter(|(_, body)| !body.joint.kind.is_empty());
    Table::new("Joints that move", "llllll")
        .head(["joint", "kind", "from, to", "x y z, m", "roll pitch yaw", "axis"])
        .rows(own.map(row))
}

fn axis(motion: &Motion) -> String {
    let (Motion::Turn { along, .. } | Motion::Slide { along }) = motion;
    vector(*along)
}

/// Three numbers; what is rounding of a size of one is zero.
fn vector(entries: [f64; 3]) -> String {
    let short = |x: f64| if x.abs() < 1e-12 { 0.0 } else { x };
    entries.map(|x| number(short(x), DIGITS)).join("  ")
}

/// Roll, pitch and yaw about fixed axes, as URDF has them.
fn angles(pose: &Pose<f64>) -> [f64; 3] {
    let r = |i: usize, j: usize| pose.rotation[(i, j)];
    [r(2, 1).atan2(r(2, 2)), (-r(2, 0)).clamp(-1.0, 1.0).asin(), r(1, 0).atan2(r(0, 0))]
}
