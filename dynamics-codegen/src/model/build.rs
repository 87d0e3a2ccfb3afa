//! Specification to model: each phase judges, and the next builds only on what was found sound.

use std::ops::Range;

use super::composition::composition;
use super::dimensions::Units;
use super::fields::{field_type, parameters};
use super::placement::Geometry;
use super::quantities::slots;
use super::shapes::{pseudo_inertia, snap_of};
use super::terms::{self, Meaning, Whereabouts};
use super::topology::{Coordinate, Topology};
use super::values::{self, Result, Values};
use super::{
    Drive, Frame, JointInfo, Limits, Link, LinkInfo, Model, Motion, Passive, Terms, Tree, lines, physics,
};
use crate::diagnostics::Diagnostics;
use crate::spatial::{Pose, PseudoInertia, Vector3};
use crate::spec::{Formula, JointKeys, JointKind, JointSpec, RobotSpec, default_friction_speed};
use crate::symbolic::{Expr, Graph, Number};

/// The robot that a specification means, or `None` and at least one mistake.
///
/// The frames are the bodies, each where its `#[body]` was written; a child of a fixed joint without
/// `#[body]` is where its joint was written.
pub fn build<'g>(spec: &RobotSpec, graph: &'g Graph, diags: &mut Diagnostics) -> Option<Model<'g>> {
    let before = diags.len();
    let mut slots = slots(spec);
    values::check_reserved(spec, &slots, diags);
    if diags.len() > before {
        return None;
    }
    lines::check(spec, &slots, diags);
    // A term that is none tells nothing of units.
    let sound = terms::check(spec, diags);
    slots.retain(|slot| !slot.is_term() || sound.iter().any(|term| std::ptr::eq(*term, slot.formula)));
    let values = Values::new(spec, &slots, graph, diags);
    let units = Units::infer(&values, &slots, diags);
    physics::check_numbers(spec, &slots, &values, diags);
    let field_type = field_type(spec, &values, diags);
    let topology = Topology::of(spec, diags);
    if diags.len() > before {
        return None;
    }
    let topology = topology?;
    let tree = Assembly { spec, values: &values, topology: &topology }.tree(diags);
    let joints = joint_infos(spec, &topology, &values, diags);
    let parameters = parameters(&values, &units, &slots);
    let tree = tree.filter(|_| diags.len() == before)?;
    physics::check_links(spec, &topology, graph, &tree, diags);
    let actuated = joints.iter().filter(|joint| joint.actuated).flat_map(|joint| joint.v.clone()).collect();
    let name = spec.ident.to_string();
    let links = link_infos(spec, &topology, &tree);
    let parents = parents(spec, &tree);
    let model = Model { name, field_type: field_type?, parameters, joints, actuated, links, parents, tree };
    (diags.len() == before).then_some(model)
}

/// What the tree is made of.
struct Assembly<'a, 'g> {
    spec: &'a RobotSpec,
    values: &'a Values<'a, 'g>,
    topology: &'a Topology,
}

/// Where a body is: on which link, and how.
#[derive(Clone, Copy)]
struct Site<'g> {
    link: Option<usize>,
    pose: Pose<Expr<'g>>,
}

/// A joint on its own: its links, each in the frame of the one before it, and its body in the last one's; of a joint
/// that stands still, its body in the parent's.
struct Placed<'g> {
    links: Vec<Link<Expr<'g>>>,
    body: Pose<Expr<'g>>,
}

/// A joint's coordinate: `ratio` times that at `start`, and `offset`; without a start it is the offset.
struct Course<'g> {
    start: Option<Coordinate>,
    ratio: Expr<'g>,
    offset: Expr<'g>,
}

impl<'g> Assembly<'_, 'g> {
    fn tree(&self, diags: &mut Diagnostics) -> Option<Tree<Expr<'g>>> {
        let before = diags.len();
        let gravity = match &self.spec.options.gravity {
            Some(parts) => diags.keep(self.values.vector(parts)),
            None => Some(Vector3([Expr::ZERO, Expr::ZERO, Expr::Constant(Number::ratio(-981, 100))])),
        };
        let joints = 0..self.spec.joints.len();
        let placed: Vec<_> = joints.map(|joint| diags.keep(self.placed(joint))).collect();
        let masses = self.masses(diags);
        if diags.len() > before {
            return None;
        }
        let placed: Vec<_> = placed.into_iter().flatten().collect();
        let (sites, links) = self.links(&placed);
        let mut tree = Tree {
            links,
            base: PseudoInertia::zero(),
            frames: vec![],
            gravity: gravity?,
            terms: Terms::none(),
        };
        for (joint, mass) in masses.into_iter().enumerate() {
            let Some(mass) = mass else { continue };
            let mass = mass.transformed(sites[joint].pose);
            match sites[joint].link {
                Some(link) => tree.links[link].inertia = tree.links[link].inertia + mass,
                None => tree.base = tree.base + mass,
            }
        }
        tree.frames = self.frames(&sites);
        tree.terms = self.terms(&tree.frames, diags);
        (diags.len() == before).then_some(tree)
    }

    fn terms(&self, frames: &[Frame<Expr<'g>>], diags: &mut Diagnostics) -> Terms<Expr<'g>> {
        if self.spec.terms.is_empty() {
            return Terms::none();
        }
        let course = |joint: usize| {
            let Course { start, ratio, offset } = self.course(joint)?;
            Ok(Whereabouts { start: start.map(|Coordinate { q, v }| (q, v)), ratio, offset })
        };
        let courses = (0..self.spec.joints.len()).map(course).collect::<Result<Vec<_>>>();
        let Some(courses) = diags.keep(courses) else { return Terms::none() };
        let frame = |name: &str| frames.iter().position(|frame| frame.name == name);
        Meaning { spec: self.spec, values: self.values, courses: &courses, frame: &frame }.terms(diags)
    }

    fn placed(&self, joint: usize) -> Result<Placed<'g>> {
        let snap = snap_of(self.spec);
        let spec = &self.spec.joints[joint];
        let geometry = Geometry::of(spec, self.values, snap)?;
        let Course { start, ratio, offset } = self.course(joint)?;
        let pitch = self.values.scalar_or(spec.pitch.as_ref(), Expr::ONE)?;
        let Some(Coordinate { q, v }) = start else {
            return Ok(Placed { body: geometry.welded(spec.kind, offset, pitch, snap), links: vec![] });
        };
        let mut links = vec![];
        for (&(motion, nth), placement) in composition(spec.kind).iter().zip(geometry.links) {
            let step = if motion == Motion::Prismatic { pitch } else { Expr::ONE };
            links.push(Link {
                parent: None,
                motion,
                drive: Drive { q: q + nth, v: v + nth, ratio: ratio * step, offset: offset * step },
                passive: if links.is_empty() { passive(spec, self.values)? } else { Passive::none() },
                placement,
                inertia: PseudoInertia::zero(),
            });
        }
        Ok(Placed { links, body: geometry.body })
    }

    /// The joint's coordinate, by way of all those that it follows.
    fn course(&self, joint: usize) -> Result<Course<'g>> {
        let mut course = Course { start: None, ratio: Expr::ONE, offset: Expr::ZERO };
        let mut at = joint;
        loop {
            let JointSpec { kind, keys, .. } = &self.spec.joints[at];
            match (&keys.locked, self.topology.leader[at]) {
                _ if *kind == JointKind::Fixed => return Ok(course),
                (Some(locked), _) => {
                    course.offset = course.offset + course.ratio * self.values.scalar(locked)?;
                    return Ok(course);
                }
                (None, None) => {
                    course.start = self.topology.coordinate[at];
                    return Ok(course);
                }
                (None, Some(leader)) => {
                    let offset = self.values.scalar_or(keys.offset.as_ref(), Expr::ZERO)?;
                    course.offset = course.offset + course.ratio * offset;
                    course.ratio = course.ratio * self.values.scalar_or(keys.ratio.as_ref(), Expr::ONE)?;
                    at = leader;
                }
            }
        }
    }

    /// The mass of the body that each joint carries, in its own frame.
    fn masses(&self, diags: &mut Diagnostics) -> Vec<Option<PseudoInertia<Expr<'g>>>> {
        let mut mass =
            |body: usize| diags.keep(pseudo_inertia(&self.spec.bodies[body], self.spec, self.values));
        self.topology.body.iter().map(|body| body.and_then(&mut mass)).collect()
    }

    /// The place of the body that each joint carries, and the links without their masses.
    fn links(&self, placed: &[Placed<'g>]) -> (Vec<Site<'g>>, Vec<Link<Expr<'g>>>) {
        let world = Site { link: None, pose: Pose::identity() };
        let mut sites = vec![world; placed.len()];
        let mut links = vec![];
        for &joint in &self.topology.order {
            let Placed { links: own, body } = &placed[joint];
            let mut site = self.topology.carrier[joint].map_or(world, |carrier| sites[carrier]);
            for (index, link) in self.topology.links[joint].clone().zip(own) {
                links.push((
                    index,
                    Link { parent: site.link, placement: site.pose * link.placement, ..*link },
                ));
                site = Site { link: Some(index), pose: Pose::identity() };
            }
            sites[joint] = Site { pose: site.pose * *body, ..site };
        }
        links.sort_by_key(|(index, _)| *index);
        (sites, links.into_iter().map(|(_, link)| link).collect())
    }

    fn frames(&self, sites: &[Site<'g>]) -> Vec<Frame<Expr<'g>>> {
        let mut frames: Vec<(usize, Frame<_>)> = vec![];
        for ((joint, site), body) in self.spec.joints.iter().zip(sites).zip(&self.topology.body) {
            if joint.is_bare {
                continue;
            }
            let line = body.map_or(joint.line, |body| self.spec.bodies[body].line);
            frames.push((line, Frame { name: joint.child.text.clone(), link: site.link, pose: site.pose }));
        }
        frames.sort_by_key(|(line, _)| *line);
        frames.into_iter().map(|(_, frame)| frame).collect()
    }
}

/// What resists the joint's coordinate, and what turns with it.
fn passive<'g>(joint: &JointSpec, values: &Values<'_, 'g>) -> Result<Passive<Expr<'g>>> {
    let JointKeys { armature, rotor, gear, damping, friction, friction_speed, stiffness, rest, .. } =
        &*joint.keys;
    let or_none = |formula: &Option<Formula>| values.scalar_or(formula.as_ref(), Expr::ZERO);
    let gear = or_none(gear)?;
    // The regressor asks for the friction per unit of its coefficient even where that is zero.
    let default_speed = Expr::Constant(default_friction_speed());
    Ok(Passive {
        armature: or_none(armature)? + or_none(rotor)? * (gear * gear),
        damping: or_none(damping)?,
        friction: or_none(friction)?,
        friction_speed: values.scalar_or(friction_speed.as_ref(), default_speed)?,
        stiffness: or_none(stiffness)?,
        rest: or_none(rest)?,
    })
}

/// The links in their order: the last of a joint has the body, and those before it have none.
fn link_infos(spec: &RobotSpec, topology: &Topology, tree: &Tree<Expr<'_>>) -> Vec<LinkInfo> {
    let moving = spec.joints.iter().zip(&topology.links).filter(|(_, links)| !links.is_empty());
    let of_joint = |(joint, links): (&JointSpec, &Range<usize>)| {
        let body = tree.frames.iter().position(|frame| frame.name == joint.child.text);
        let name = joint.name.text.clone();
        let (first, last) = (links.start, links.end);
        let is_one_dof = joint.kind.speeds() == 1;
        links.clone().map(move |link| LinkInfo {
            joint: name.clone(),
            body: body.filter(|_| link + 1 == last),
            acts: is_one_dof && link == first,
        })
    };
    moving.flat_map(of_joint).collect()
}

/// The frame that each frame's body hangs on.
fn parents(spec: &RobotSpec, tree: &Tree<Expr<'_>>) -> Vec<Option<usize>> {
    let at = |name: &str| tree.frames.iter().position(|frame| frame.name == name);
    let carrier = |frame: &Frame<_>| spec.joints.iter().find(|joint| joint.child.text == frame.name);
    tree.frames.iter().map(|frame| at(&carrier(frame)?.parent.text)).collect()
}

/// The joints that have coordinates of their own.
fn joint_infos(
    spec: &RobotSpec,
    topology: &Topology,
    values: &Values,
    diags: &mut Diagnostics,
) -> Vec<JointInfo> {
    let joints = spec.joints.iter().zip(&topology.coordinate);
    let own = joints.filter_map(|(joint, coordinate)| Some((joint, (*coordinate)?)));
    let info = |(joint, Coordinate { q, v }): (&JointSpec, _)| {
        let (coordinates, speeds) = (joint.kind.coordinates(), joint.kind.speeds());
        JointInfo {
            name: joint.name.text.clone(),
            kind: joint.kind,
            q: q..q + coordinates,
            v: v..v + speeds,
            limits: vec![limits(joint, values, diags); speeds],
            actuated: joint.is_actuated(),
        }
    };
    own.map(info).collect()
}

/// The limits of the joint's coordinate; those of a joint that has several are none.
fn limits(joint: &JointSpec, values: &Values, diags: &mut Diagnostics) -> Limits {
    let mut number = |formula: Option<&Formula>, missing: f64| {
        let value = formula.and_then(|formula| diags.keep(values.number(formula)));
        value.map_or(missing, Number::to_f64)
    };
    let JointKeys { limits, velocity, effort, .. } = &*joint.keys;
    Limits {
        lower: number(limits.as_ref().map(|[lower, _]| lower), f64::NEG_INFINITY),
        upper: number(limits.as_ref().map(|[_, upper]| upper), f64::INFINITY),
        velocity: number(velocity.as_ref(), f64::INFINITY),
        effort: number(effort.as_ref(), f64::INFINITY),
    }
}
