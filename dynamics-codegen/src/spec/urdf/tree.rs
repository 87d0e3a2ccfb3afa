//! How links hang together: which is the root, and in which order joints have coordinates.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::overrides;
use super::report::{Note, Report};
use super::source::quoted;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::spec::{BaseSpec, BodySpec, JointKind, JointSpec, Name, RobotSpec, welded};

const WORLD: &str = "world";
/// Only so many names are compared with one that is not known.
pub(super) const NAMES_TO_COMPARE: usize = 1000;
/// So many mistakes of one kind are reported.
const MISTAKES_OF_A_KIND: usize = 20;

/// The links and joints of a document, in its order.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) links: Vec<BodySpec>,
    pub(super) joints: Vec<JointSpec>,
}

/// Adds links and joints to a specification, which has those that stand beside the file.
pub(super) fn connect(
    spec: &mut RobotSpec,
    parts: Parts,
    robot: &Place,
    report: &mut Report,
    diags: &mut Diagnostics,
) {
    let before = diags.len();
    check_counts(&parts, spec, robot, diags);
    check_distinct("link", parts.links.iter().map(|link| &link.name), diags);
    check_distinct("joint", parts.joints.iter().map(|joint| &joint.name), diags);
    check_ends(&parts, diags);
    check_carried_once(&parts, diags);
    if diags.len() > before {
        return;
    }
    let root = root_of(&parts, spec, diags);
    if diags.len() > before {
        return;
    }
    check_base(&parts, root.as_ref(), spec, diags);
    let Parts { mut links, mut joints } = parts;
    let amendments = std::mem::take(&mut spec.amendments);
    overrides::of_joints(&mut joints, amendments, &spec.joints, report, diags);
    if diags.len() > before {
        return;
    }
    let base = spec.options.base.take();
    overrides::remark_on_friction(&joints, report);
    let lines = 1 + links.len() + joints.len() + report.ignored.len();
    if let Some(root) = root {
        report.root = root.text.clone();
        match base {
            Some(base) if base.is_free => joints.insert(0, free_root(root, &base)),
            _ => joints.extend(weld_to_world(root, spec)),
        }
    }
    if let Some(world) = links.iter().position(|link| link.name.text == WORLD) {
        let world = links.remove(world);
        if let Some(mass) = world.mass {
            let text = "the mass of the link `world`, which is where every robot stands";
            report.ignored.push(Note::new(text, mass.place));
        }
    }
    let mut beside = std::mem::take(&mut spec.bodies);
    beside.iter_mut().for_each(|body| body.line += lines);
    joints.extend(spec.joints.drain(..).map(|joint| JointSpec { line: joint.line + lines, ..joint }));
    spec.bodies = overrides::of_bodies(links, beside, report);
    spec.joints = in_order(joints, report);
}

fn check_counts(parts: &Parts, spec: &RobotSpec, robot: &Place, diags: &mut Diagnostics) {
    let is_free = spec.options.base.as_ref().is_some_and(|base| base.is_free);
    let mut joints = parts.joints.iter().chain(&spec.joints).peekable();
    if parts.links.is_empty() {
        let missing = Diagnostic::new(Code::ElementMissing, robot, "the robot has no link");
        diags.push(missing.help("add `<link name=\"…\">`"));
    } else if is_free {
        // One link alone has six degrees of freedom.
    } else if joints.peek().is_none() {
        let missing = Diagnostic::new(Code::JointMissing, robot, "the robot has no joint");
        diags.push(missing.help("add `<joint name=\"…\" type=\"…\">` between two links"));
    } else if joints.all(|joint| joint.kind == JointKind::Fixed) {
        diags.error(Code::DegreesOfFreedomMissing, robot, "no joint of the robot moves");
    }
}

fn check_distinct<'s>(kind: &str, names: impl Iterator<Item = &'s Name>, diags: &mut Diagnostics) {
    let mut seen = FxHashMap::default();
    let twice = names.filter_map(|name| match seen.entry(name.text.as_str()) {
        Entry::Vacant(free) => {
            free.insert(&name.place);
            None
        }
        Entry::Occupied(first) => Some((name, *first.get())),
    });
    for (name, first) in twice.take(MISTAKES_OF_A_KIND) {
        let line = match first {
            Place::Text { line, .. } => format!(", the first in line {line}"),
            Place::Tokens { .. } => String::new(),
        };
        let message = format!("there are two {kind}s {}{line}", quoted(&name.text));
        let duplicate = Diagnostic::new(Code::NameDuplicate, &name.place, message);
        diags.push(duplicate.help(format!("give each {kind} a name of its own")));
    }
}

/// Joints are between links that exist.
fn check_ends(parts: &Parts, diags: &mut Diagnostics) {
    let known: FxHashMap<&str, ()> = parts.links.iter().map(|link| (&*link.name.text, ())).collect();
    let ends = parts.joints.iter().flat_map(|joint| {
        [
            (joint, &joint.parent, "is on", Code::ParentUnknown),
            (joint, &joint.child, "carries", Code::ChildUnknown),
        ]
    });
    let unknown = ends.filter(|(_, link, ..)| !known.contains_key(&*link.text));
    for (joint, link, does, code) in unknown.take(MISTAKES_OF_A_KIND) {
        let (name, link_name) = (quoted(&joint.name.text), quoted(&link.text));
        let message = format!("the joint {name} {does} {link_name}, and there is no such link");
        let names = parts.links.iter().map(|link| &*link.name.text).take(NAMES_TO_COMPARE);
        let unknown = Diagnostic::new(code, &link.place, message).help("name a `<link>` of the file");
        diags.push(unknown.suggest(&link.text, names));
    }
}

fn check_carried_once(parts: &Parts, diags: &mut Diagnostics) {
    let mut carriers: FxHashMap<&str, &Name> = FxHashMap::default();
    let mut twice = vec![];
    for JointSpec { child, name, .. } in &parts.joints {
        match carriers.get(&*child.text) {
            Some(first) => twice.push((child, *first, name)),
            None => drop(carriers.insert(&child.text, name)),
        }
    }
    for (child, first, second) in twice.into_iter().take(MISTAKES_OF_A_KIND) {
        let [link, first, second] = [child, first, second].map(|name| quoted(&name.text));
        let message = format!("the link {link} is carried by {first} and by {second}");
        diags.error(Code::ParentTwice, &child.place, message);
    }
}

/// The one link that no joint carries; none if a joint beside the file carries it, or if there is a cycle, which
/// is found where all cycles are.
fn root_of(parts: &Parts, spec: &RobotSpec, diags: &mut Diagnostics) -> Option<Name> {
    let carried: FxHashMap<&str, ()> =
        parts.joints.iter().chain(&spec.joints).map(|joint| (&*joint.child.text, ())).collect();
    let roots: Vec<&Name> = parts.links.iter().map(|link| &link.name).collect();
    let roots: Vec<&Name> = roots.into_iter().filter(|link| !carried.contains_key(&*link.text)).collect();
    let (first, others) = roots.split_first()?;
    if let Some(second) = others.first() {
        let names = roots.iter().take(4).map(|link| quoted(&link.text)).collect::<Vec<_>>().join(", ");
        let more = if roots.len() > 4 { format!(" and {} more", roots.len() - 4) } else { String::new() };
        let message = format!("the robot has {} roots: no joint carries {names}{more}", roots.len());
        diags.error(Code::RootsSeveral, &second.place, message);
        return None;
    }
    Some((*first).clone())
}

/// The name of the joint that `base = free` makes.
const ROOT_JOINT: &str = "root_joint";

/// A root that is free is a link that nothing holds.
fn check_base(parts: &Parts, root: Option<&Name>, spec: &RobotSpec, diags: &mut Diagnostics) {
    let Some(BaseSpec { place, .. }) = spec.options.base.as_ref().filter(|base| base.is_free) else { return };
    let (code, message, help) = match root {
        None => {
            let is_link = |name: &Name| parts.links.iter().any(|link| link.name.text == name.text);
            // Without such a joint there is a cycle, which is found where all are.
            let Some(joint) = spec.joints.iter().find(|joint| is_link(&joint.child)) else { return };
            let link = quoted(&joint.child.text);
            let message = format!("the link {link} is carried by `{}`, and by `base = free`", joint.name);
            (Code::ParentTwice, message, format!("leave out `base`, or the joint `{}`", joint.name))
        }
        Some(root) if root.text == WORLD => {
            let message = "the root of the file is the link `world`, which cannot move".to_owned();
            (Code::WorldIsChild, message, "leave `base` out, or give the link another name".to_owned())
        }
        Some(root) => {
            let mut all = parts.joints.iter().chain(&spec.joints);
            let Some(joint) = all.find(|joint| joint.name.text == ROOT_JOINT) else { return };
            let message = format!("`base = free` is a joint `{ROOT_JOINT}`, and there is one of this name");
            let help = format!(
                "rename `{}`, or write `#[joint(name: free, {WORLD} -> {})]` instead of `base`",
                joint.name, root.text
            );
            (Code::NameDuplicate, message, help)
        }
    };
    diags.push(Diagnostic::new(code, place, message).help(help));
}

/// The joint by which the root moves freely.
fn free_root(root: Name, base: &BaseSpec) -> JointSpec {
    joint_of_root(ROOT_JOINT.to_owned(), JointKind::Free, root, base.place.clone())
}

/// The joint that holds the root in the world, unless the root is the world.
fn weld_to_world(root: Name, spec: &RobotSpec) -> Option<JointSpec> {
    let place = root.place.clone();
    let name = format!("{WORLD} -> {}, of {}", root.text, spec.ident);
    (root.text != WORLD).then(|| joint_of_root(name, JointKind::Fixed, root, place))
}

fn joint_of_root(name: String, kind: JointKind, root: Name, place: Place) -> JointSpec {
    let named = |text: String| Name { text, place: place.clone() };
    JointSpec {
        name: named(name),
        kind,
        kind_place: place.clone(),
        axes: vec![],
        pitch: None,
        parent: named(WORLD.to_owned()),
        child: root,
        is_bare: false,
        keys: Box::default(),
        line: 0,
        place: place.clone(),
    }
}

/// The joints such that those that move are in the order of their coordinates: as they are written, but that one
/// written before the one that carries it comes after that, as soon as it can.
fn in_order(joints: Vec<JointSpec>, report: &mut Report) -> Vec<JointSpec> {
    let is_welded = welded(&joints);
    let moves = |k: usize| !is_welded[k];
    let above = moving_carriers(&joints, &is_welded);
    report_merged(&joints, &above, &is_welded, report);
    let mut beyond = vec![vec![]; joints.len()];
    let mut ready = BinaryHeap::new();
    for k in (0..joints.len()).filter(|k| moves(*k)) {
        match above[k] {
            Some(carrier) => beyond[carrier].push(k),
            None => ready.push(Reverse(k)),
        }
        let have_coordinates = |carrier: usize| [k, carrier].iter().all(|k| joints[*k].has_coordinates());
        let is_late = |carrier: &usize| *carrier > k && have_coordinates(*carrier);
        if let Some(carrier) = above[k].filter(is_late) {
            let [name, carrier] = [k, carrier].map(|k| quoted(&joints[k].name.text));
            let text = format!("the joint {name} has a later coordinate than {carrier}, which carries it");
            report.remarks.push(Note::new(text, joints[k].place.clone()));
        }
    }
    let (mut order, mut is_placed) = (vec![], vec![false; joints.len()]);
    while let Some(Reverse(k)) = ready.pop() {
        order.push(k);
        is_placed[k] = true;
        ready.extend(beyond[k].drain(..).map(Reverse));
    }
    // What is on a cycle is never ready, and fixed joints have no coordinate.
    order.extend((0..joints.len()).filter(|k| !is_placed[*k]));
    let mut joints: Vec<_> = joints.into_iter().map(Some).collect();
    order.into_iter().filter_map(|k| joints[k].take()).collect()
}

/// For each joint the nearest one between it and the world that moves.
fn moving_carriers(joints: &[JointSpec], is_welded: &[bool]) -> Vec<Option<usize>> {
    let carriers: FxHashMap<&str, usize> =
        joints.iter().enumerate().map(|(k, joint)| (&*joint.child.text, k)).collect();
    let (mut children, mut queue) = (vec![vec![]; joints.len()], vec![]);
    for (k, joint) in joints.iter().enumerate() {
        match carriers.get(&*joint.parent.text) {
            Some(&carrier) => children[carrier].push(k),
            None => queue.push(k),
        }
    }
    let mut above = vec![None; joints.len()];
    while let Some(k) = queue.pop() {
        for &child in &children[k] {
            above[child] = if is_welded[k] { above[k] } else { Some(k) };
        }
        queue.append(&mut children[k]);
    }
    above
}

fn report_merged(joints: &[JointSpec], above: &[Option<usize>], is_welded: &[bool], report: &mut Report) {
    let carriers = joints.iter().zip(above).zip(is_welded).filter(|(_, is_welded)| **is_welded);
    for ((joint, above), _) in carriers {
        let carrier = above.map_or(WORLD, |k| &joints[k].child.text);
        let mut text = format!("{} is welded to {}", quoted(&joint.child.text), quoted(carrier));
        let name = quoted(&joint.name.text);
        match (&joint.keys.locked, &joint.keys.mimic) {
            (Some(locked), _) => text += &format!(": the joint {name} is locked at {}", locked.short_text()),
            (None, Some(leader)) => {
                text += &format!(": the joint {name} follows {}, which is locked", quoted(&leader.text));
            }
            _ => {}
        }
        report.merged.push(Note::new(text, joint.place.clone()));
    }
}
