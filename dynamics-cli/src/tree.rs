//! The tree of bodies, drawn in text.

use std::collections::BTreeMap;

use dynamics_codegen::spec::{FormulaKind, JointKind, JointSpec, RobotSpec};

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
    let moving = spec.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
    let coordinates: BTreeMap<&str, usize> =
        moving.zip(0..).map(|(joint, k)| (&*joint.child.text, k)).collect();
    let masses: BTreeMap<&str, f64> =
        spec.bodies.iter().filter_map(|body| Some((&*body.name.text, mass(body)?))).collect();

    let mut text = format!("  {WORLD}\n");
    let mut stack = branches(&carried, WORLD, 0, "  ");
    while let Some(Branch { joint, depth, left, is_last }) = stack.pop() {
        let child = joint.child.text.as_str();
        let mass = masses.get(child).map_or(String::new(), |mass| format!("  {mass} kg"));
        let carrier = match coordinates.get(child) {
            Some(k) => format!("{} ({}, q[{k}]) ─ ", joint.name, kind(joint.kind)),
            None if child == root => String::new(),
            None => format!("{} (fixed) ─ ", joint.name),
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
fn mass(body: &dynamics_codegen::spec::BodySpec) -> Option<f64> {
    match &body.mass.as_ref()?.kind {
        FormulaKind::Number(value, _) => Some(value.to_f64()).filter(|mass| *mass != 0.0),
        _ => None,
    }
}

/// The kind of a joint, as in a URDF.
pub(crate) fn kind(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
        JointKind::Fixed => "fixed",
    }
}
