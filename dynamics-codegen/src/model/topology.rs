//! Who carries whom: the order of the joints, and all that can be wrong with it.

use std::ops::Range;

use rustc_hash::FxHashMap;

use super::composition::composition;
use super::mimic;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::spec::{JointSpec, Name, RobotSpec, leaders, welded};

/// The name of the root.
pub(super) const WORLD: &str = "world";

/// The most links there may be. A joint of several axes moves one for each.
const LINK_LIMIT: usize = 256;

/// The tree of joints.
pub(super) struct Topology {
    /// All joints that hang on the world, parents before children.
    pub(super) order: Vec<usize>,
    /// The joint that carries the parent of each joint; `None` is the world.
    pub(super) carrier: Vec<Option<usize>>,
    /// The described body that each joint carries.
    pub(super) body: Vec<Option<usize>>,
    /// The links that each joint is made of; none of those that stand still.
    pub(super) links: Vec<Range<usize>>,
    /// The first coordinate and the first speed of each joint that has its own.
    pub(super) coordinate: Vec<Option<Coordinate>>,
    /// The joint that each joint follows.
    pub(super) leader: Vec<Option<usize>>,
}

/// Where the coordinates of a joint begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Coordinate {
    /// Among all coordinates.
    pub(super) q: usize,
    /// Among all speeds.
    pub(super) v: usize,
}

impl Topology {
    /// Finds the tree, or all reasons why there is none.
    pub(super) fn of(spec: &RobotSpec, diags: &mut Diagnostics) -> Option<Self> {
        let before = diags.len();
        check_size(spec, diags);
        if diags.len() > before {
            return None;
        }
        mimic::check(spec, diags);
        if diags.len() == before {
            check_motion(spec, diags);
        }
        check_names(spec, diags);
        let carriers = carriers(spec, diags);
        check_bodies(spec, &carriers, diags);
        let topology = Self::connected(spec, &carriers);
        check_parents(spec, &carriers, diags);
        if diags.len() == before {
            check_cycles(spec, &topology, diags);
            check_order(spec, &topology, diags);
        }
        (diags.len() == before).then_some(topology)
    }

    fn connected(spec: &RobotSpec, carriers: &FxHashMap<&str, usize>) -> Self {
        let carrier: Vec<_> =
            spec.joints.iter().map(|joint| carriers.get(&*joint.parent.text).copied()).collect();
        let mut children = vec![vec![]; spec.joints.len()];
        let mut order = vec![];
        for (joint, carrier) in carrier.iter().enumerate() {
            match carrier {
                Some(parent) => children[*parent].push(joint),
                None if spec.joints[joint].parent.text == WORLD => order.push(joint),
                None => {}
            }
        }
        let mut next = 0;
        while let Some(&joint) = order.get(next) {
            order.append(&mut children[joint]);
            next += 1;
        }
        let is_welded = welded(&spec.joints);
        let (mut links, mut coordinate) = (vec![], vec![]);
        let (mut count, mut next) = (0, Coordinate { q: 0, v: 0 });
        for (joint, is_welded) in spec.joints.iter().zip(is_welded) {
            let own = if is_welded { 0 } else { composition(joint.kind).len() };
            links.push(count..count + own);
            count += own;
            coordinate.push(joint.has_coordinates().then_some(next));
            if joint.has_coordinates() {
                next.q += joint.kind.coordinates();
                next.v += joint.kind.speeds();
            }
        }
        let described: FxHashMap<_, _> =
            spec.bodies.iter().enumerate().map(|(i, body)| (&*body.name.text, i)).collect();
        let body = spec.joints.iter().map(|joint| described.get(&*joint.child.text).copied());
        let body = body.collect();
        Self { order, links, coordinate, leader: leaders(&spec.joints), carrier, body }
    }

    /// The link that the body of each joint is on: the last of the nearest joint from here to the world that moves,
    /// this one included.
    pub(super) fn link_of_body(&self) -> Vec<Option<usize>> {
        let mut link = vec![None; self.carrier.len()];
        for &joint in &self.order {
            let own = self.links[joint].clone().last();
            link[joint] = own.or_else(|| link[self.carrier[joint]?]);
        }
        link
    }
}

fn check_size(spec: &RobotSpec, diags: &mut Diagnostics) {
    let place = Place::of(&spec.ident);
    let links: usize = moving(spec).map(|joint| composition(joint.kind).len()).sum();
    if spec.joints.is_empty() {
        diags.error(Code::JointMissing, &place, format!("`{}` has no joint", spec.ident));
    } else if links > LINK_LIMIT {
        let message = format!("the joints of `{}` move {links} links, {LINK_LIMIT} are allowed", spec.ident);
        diags.error(Code::JointsTooMany, &place, message);
    }
}

/// At least one joint moves.
fn check_motion(spec: &RobotSpec, diags: &mut Diagnostics) {
    if moving(spec).next().is_none() {
        let message = format!("no joint of `{}` moves", spec.ident);
        diags.error(Code::DegreesOfFreedomMissing, &Place::of(&spec.ident), message);
    }
}

/// The joints that do not stand still.
fn moving(spec: &RobotSpec) -> impl Iterator<Item = &JointSpec> {
    spec.joints.iter().zip(welded(&spec.joints)).filter(|(_, is_welded)| !is_welded).map(|(joint, _)| joint)
}

/// The joint that carries each body.
fn carriers<'s>(spec: &'s RobotSpec, diags: &mut Diagnostics) -> FxHashMap<&'s str, usize> {
    let mut carriers = FxHashMap::default();
    for (i, JointSpec { child, name, is_bare, .. }) in spec.joints.iter().enumerate() {
        if child.text == WORLD {
            diags.error(Code::WorldIsChild, &child.place, format!("the joint `{name}` carries the world"));
            continue;
        }
        let first: usize = *carriers.entry(child.text.as_str()).or_insert(i);
        // What a coordinate carries nobody has named: its own name is complained about.
        if first != i && !is_bare {
            let message = format!("`{child}` is carried by `{}` and by `{name}`", spec.joints[first].name);
            diags.error(Code::ParentTwice, &child.place, message);
        }
    }
    carriers
}

/// Names given twice, and that of the world.
fn check_names(spec: &RobotSpec, diags: &mut Diagnostics) {
    let joint = |joint: &'_ JointSpec| if joint.is_bare { "coordinate" } else { "joint" };
    distinct_names(spec.joints.iter().map(|spec| (joint(spec), &spec.name)), diags);
    distinct_names(spec.bodies.iter().map(|body| ("body", &body.name)), diags);
    for body in spec.bodies.iter().filter(|body| body.name.text == WORLD) {
        let message = "`world` is where every robot stands, and cannot be described";
        diags.error(Code::NameReserved, &body.name.place, message);
    }
}

/// Names, each with what it is of.
fn distinct_names<'s>(names: impl Iterator<Item = (&'static str, &'s Name)>, diags: &mut Diagnostics) {
    let mut seen = FxHashMap::default();
    for (what, name) in names {
        let message = match seen.insert(name.text.as_str(), what) {
            None => continue,
            Some(first) if first == what => format!("there are two {what} lines for `{name}`"),
            Some(first) => format!("there are a {first} line and a {what} line for `{name}`"),
        };
        diags.error(Code::NameDuplicate, &name.place, message);
    }
}

/// Bodies that no joint carries, and moving joints whose bodies are not described.
fn check_bodies(spec: &RobotSpec, carriers: &FxHashMap<&str, usize>, diags: &mut Diagnostics) {
    let described: FxHashMap<_, _> = spec.bodies.iter().map(|body| (body.name.text.as_str(), ())).collect();
    // A joint that carries the world is turned round: its parent will be carried then.
    let turned = |name: &str| spec.joints.iter().any(|j| j.child.text == WORLD && j.parent.text == name);
    for body in spec.bodies.iter().filter(|body| body.name.text != WORLD) {
        let name = &body.name;
        if !carriers.contains_key(&*name.text) && !turned(&name.text) {
            let message = format!("no joint carries the body `{name}`");
            let help = format!("carry it by a joint, as in `#[joint({name}_joint: fixed, world -> {name})]`");
            let open = spec.joints.iter().map(|joint| &*joint.child.text);
            let open = open.filter(|child| !described.contains_key(child));
            diags.push(
                Diagnostic::new(Code::BodyUnreachable, &name.place, message)
                    .help(help)
                    .suggest(&name.text, open),
            );
        }
    }
    for joint in moving(spec).filter(|joint| !joint.is_bare) {
        let child = &joint.child;
        if child.text != WORLD && !described.contains_key(&*child.text) {
            let message = format!("the joint `{}` moves `{child}`, which no `#[body]` describes", joint.name);
            let loose = spec.bodies.iter().map(|body| &*body.name.text);
            let loose = loose.filter(|name| !carriers.contains_key(name));
            diags.push(Diagnostic::new(Code::BodyMissing, &child.place, message).suggest(&child.text, loose));
        }
    }
}

fn check_parents(spec: &RobotSpec, carriers: &FxHashMap<&str, usize>, diags: &mut Diagnostics) {
    for joint in &spec.joints {
        let parent = &joint.parent;
        let loose_body = || spec.bodies.iter().any(|body| body.name.text == parent.text);
        if parent.text == WORLD || carriers.contains_key(&*parent.text) || loose_body() {
            continue;
        }
        let message = format!("the joint `{}` is on `{parent}`, which is no body", joint.name);
        let known = spec.joints.iter().map(|joint| &*joint.child.text).chain([WORLD]);
        diags.push(Diagnostic::new(Code::ParentUnknown, &parent.place, message).suggest(&parent.text, known));
    }
}

/// With every parent known, what does not hang on the world hangs on a cycle.
fn check_cycles(spec: &RobotSpec, topology: &Topology, diags: &mut Diagnostics) {
    let mut seen = vec![false; spec.joints.len()];
    for &joint in &topology.order {
        seen[joint] = true;
    }
    for start in 0..spec.joints.len() {
        let mut path = vec![];
        let mut at = Some(start);
        while let Some(joint) = at.filter(|joint| !seen[*joint]) {
            seen[joint] = true;
            path.push(joint);
            at = topology.carrier[joint];
        }
        let Some(cycle) = at.and_then(|end| path.iter().position(|joint| *joint == end)) else { continue };
        let cycle = &path[cycle..];
        let names =
            cycle.iter().rev().chain(cycle.last()).map(|joint| spec.joints[*joint].child.text.as_str());
        let names = names.collect::<Vec<_>>().join(" -> ");
        let place = &spec.joints[cycle[0]].place;
        diags.error(Code::Cycle, place, format!("the bodies {names} carry each other"));
    }
}

/// A link's parent is the smaller one, so that joints have their coordinates in the order of their lines.
fn check_order(spec: &RobotSpec, topology: &Topology, diags: &mut Diagnostics) {
    let link = topology.link_of_body();
    for (joint, late) in spec.joints.iter().enumerate() {
        let Some(first) = topology.links[joint].clone().next() else { continue };
        let parent = topology.carrier[joint].and_then(|carrier| link[carrier]);
        let Some(parent) = parent.filter(|parent| *parent > first) else { continue };
        let carrier = topology.links.iter().position(|links| links.contains(&parent));
        let Some(carrier) = carrier.map(|carrier| &spec.joints[carrier]) else { continue };
        let message = format!("the joint `{}` moves `{}`, and comes after it", carrier.name, late.name);
        diags.error(Code::ParentAfterChild, &carrier.place, message);
    }
}
