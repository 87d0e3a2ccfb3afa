//! The tree of bodies, drawn in text.

use std::collections::BTreeMap;
use std::ops::Range;

use dynamics_codegen::spec::{FormulaKind, JointSpec, RobotSpec};

/// Deeper branches are drawn no further to the right.
const DEEPEST: usize = 48;
const WORLD: &str = "world";

/// A joint that is yet to be drawn, and the lines to the left of it.
struct Branch<'s> {
    joint: &'s JointSpec,
    depth: usize,
    left: String,
    is_last: bool,
}

/// Draws the tree: each body with the joint that carries it, children in the order of the document.
pub(crate) fn draw(spec: &RobotSpec, root: &str) -> String {
    let mut carried: BTreeMap<&str, Vec<&JointSpec>> = BTreeMap::new();
    for joint in &spec.joints {
        carried.entry(&joint.parent.text).or_default().push(joint);
    }
    carried.values_mut().for_each(|joints| joints.sort_by_key(|joint| joint.line));
    let coordinates = coordinates(spec);
    let masses: BTreeMap<&str, String> =
        spec.bodies.iter().filter_map(|body| Some((&*body.name.text, mass(body)?))).collect();

    let mut text = format!("  {WORLD}\n");
    let mut stack = branches(&carried, WORLD, 0, "  ");
    while let Some(Branch { joint, depth, left, is_last }) = stack.pop() {
        let child = joint.child.text.as_str();
        let mass = masses.get(child).map_or(String::new(), |mass| format!("  {mass}"));
        let (name, kind) = (&joint.name, joint.kind.name());
        let carrier = match (coordinates.get(child), &joint.keys.locked, &joint.keys.mimic) {
            (Some(q), ..) => format!("{name} ({kind}, {}) ─ ", entries("q", q)),
            (None, Some(locked), _) => format!("{name} ({kind}, locked at {}) ─ ", locked.short_text()),
            (None, None, Some(leader)) => format!("{name} ({kind}, follows {leader}) ─ "),
            _ if child == root => String::new(),
            _ => format!("{name} ({kind}) ─ "),
        };
        let (carrier, child) = match joint.is_bare {
            true => (
                format!(
                    "{name} (coordinate, {})",
                    coordinates.get(child).map_or("locked".to_owned(), |q| entries("q", q))
                ),
                "",
            ),
            false => (carrier, child),
        };
        let corner = if is_last { "└─ " } else { "├─ " };
        text += &format!("{left}{corner}{carrier}{child}{mass}\n");
        let line = if is_last { "   " } else { "│  " };
        let left = if depth < DEEPEST { left + line } else { left };
        stack.extend(branches(&carried, child, depth + 1, &left));
    }
    text
}

/// What a body carries, the first one at the end.
fn branches<'s>(
    carried: &BTreeMap<&str, Vec<&'s JointSpec>>,
    parent: &str,
    depth: usize,
    left: &str,
) -> Vec<Branch<'s>> {
    let joints = carried.get(parent).map_or(&[][..], Vec::as_slice);
    let branch = |(k, joint): (usize, &&'s JointSpec)| Branch {
        joint,
        depth,
        left: left.to_owned(),
        is_last: k + 1 == joints.len(),
    };
    joints.iter().enumerate().map(branch).rev().collect()
}

/// The mass as written, unless it is zero.
fn mass(body: &dynamics_codegen::spec::BodySpec) -> Option<String> {
    let of_solid = body.solid.as_ref().map(|solid| &*solid.mass);
    let mass = body.mass.as_ref().or(of_solid)?;
    match &mass.kind {
        FormulaKind::Number(value, _) if value.is_zero() => None,
        FormulaKind::Number(value, None) => Some(format!("{} kg", value.to_f64())),
        FormulaKind::Number(value, Some(unit)) => Some(format!("{} {}", value.to_f64(), unit.name)),
        _ => Some(mass.short_text()),
    }
}

/// The coordinates of the joint that carries each body.
fn coordinates(spec: &RobotSpec) -> BTreeMap<&str, Range<usize>> {
    let own = spec.joints.iter().filter(|joint| joint.has_coordinates());
    let places = own.scan(0, |next, joint| {
        let start = *next;
        *next += joint.kind.coordinates();
        Some((&*joint.child.text, start..*next))
    });
    places.collect()
}

/// As `q[3]`, or `q[0..7]` of several.
pub(crate) fn entries(letter: &str, range: &Range<usize>) -> String {
    let Range { start, end } = range;
    if range.len() == 1 { format!("{letter}[{start}]") } else { format!("{letter}[{start}..{end}]") }
}
