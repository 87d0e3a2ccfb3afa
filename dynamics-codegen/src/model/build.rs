//! Specification to model: each phase judges, and the next builds only on what was found sound.

use super::dimensions::Units;
use super::fields::{field_type, parameters};
use super::placement::Geometry;
use super::quantities::slots;
use super::shapes::{pseudo_inertia, snap_of};
use super::topology::Topology;
use super::values::Values;
use super::{Drive, Frame, JointInfo, Limits, Link, LinkInfo, Model, Motion, Passive, Tree, lines, physics};
use crate::diagnostics::Diagnostics;
use crate::spatial::{Pose, PseudoInertia, Vector3};
use crate::spec::{Formula, JointKind, JointSpec, RobotSpec};
use crate::symbolic::{Expr, Graph, Number};

/// The robot that a specification means, or `None` and at least one mistake.
///
/// The frames are the bodies, each where its `#[body]` was written; a child of a fixed joint without
/// `#[body]` is where its joint was written.
pub fn build<'g>(spec: &RobotSpec, graph: &'g Graph, diags: &mut Diagnostics) -> Option<Model<'g>> {
    let before = diags.len();
    let slots = slots(spec);
    lines::check(spec, &slots, diags);
    let values = Values::new(spec, &slots, graph, diags);
    let units = Units::infer(&values, &slots, diags);
    physics::check_numbers(spec, &values, diags);
    let field_type = field_type(spec, &values, diags);
    let topology = Topology::of(spec, diags);
    if diags.len() > before {
        return None;
    }
    let topology = topology?;
    let tree = Assembly { spec, values: &values, topology: &topology }.tree(diags);
    let joints = joint_infos(spec, &values, diags);
    let parameters = parameters(&values, &units, &slots);
    let tree = tree.filter(|_| diags.len() == before)?;
    physics::check_links(spec, &topology, graph, &tree, diags);
    let links = link_infos(spec, &tree);
    let (name, actuated) = (spec.ident.to_string(), (0..tree.dof()).collect());
    let model = Model { name, field_type: field_type?, parameters, joints, actuated, links, tree };
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

impl<'g> Assembly<'_, 'g> {
    fn tree(&self, diags: &mut Diagnostics) -> Option<Tree<Expr<'g>>> {
        let before = diags.len();
        let geometry: Vec<_> = self.spec.joints.iter().map(|joint| self.geometry(joint, diags)).collect();
        let gravity = match &self.spec.options.gravity {
            Some(parts) => diags.keep(self.values.vector(parts)),
            None => Some(Vector3([Expr::ZERO, Expr::ZERO, Expr::Constant(Number::ratio(-981, 100))])),
        };
        let geometry: Vec<_> = geometry.into_iter().flatten().collect();
        let masses = self.masses(diags);
        if diags.len() > before {
            return None;
        }
        let (sites, links) = self.links(&geometry);
        let mut tree = Tree { links, base: PseudoInertia::zero(), frames: vec![], gravity: gravity? };
        for (joint, mass) in masses.into_iter().enumerate() {
            let Some(mass) = mass else { continue };
            let mass = mass.transformed(sites[joint].pose);
            match sites[joint].link {
                Some(link) => tree.links[link].inertia = tree.links[link].inertia + mass,
                None => tree.base = tree.base + mass,
            }
        }
        tree.frames = self.frames(&sites);
        Some(tree)
    }

    fn geometry(&self, joint: &JointSpec, diags: &mut Diagnostics) -> Option<Geometry<'g>> {
        diags.keep(Geometry::of(joint, self.values, snap_of(self.spec)))
    }

    /// The mass of the body that each joint carries, in its own frame.
    fn masses(&self, diags: &mut Diagnostics) -> Vec<Option<PseudoInertia<Expr<'g>>>> {
        let mut mass =
            |body: usize| diags.keep(pseudo_inertia(&self.spec.bodies[body], self.spec, self.values));
        self.topology.body.iter().map(|body| body.and_then(&mut mass)).collect()
    }

    /// The place of the body that each joint carries, and the links without their masses.
    fn links(&self, geometry: &[Geometry<'g>]) -> (Vec<Site<'g>>, Vec<Link<Expr<'g>>>) {
        let world = Site { link: None, pose: Pose::identity() };
        let mut sites = vec![world; self.spec.joints.len()];
        let mut links = vec![];
        for &joint in &self.topology.order {
            let parent = self.topology.carrier[joint].map_or(world, |carrier| sites[carrier]);
            let placement = parent.pose * geometry[joint].link;
            sites[joint] = match self.topology.coordinate[joint] {
                None => Site { pose: placement * geometry[joint].body, ..parent },
                Some(coordinate) => {
                    let motion = match self.spec.joints[joint].kind {
                        JointKind::Prismatic => Motion::Prismatic,
                        _ => Motion::Revolute,
                    };
                    let (inertia, passive) = (PseudoInertia::zero(), Passive::none());
                    let drive = Drive::own(coordinate, coordinate);
                    let parent = parent.link;
                    links.push((coordinate, Link { parent, motion, drive, passive, placement, inertia }));
                    Site { link: Some(coordinate), pose: geometry[joint].body }
                }
            };
        }
        links.sort_by_key(|(coordinate, _)| *coordinate);
        (sites, links.into_iter().map(|(_, link)| link).collect())
    }

    fn frames(&self, sites: &[Site<'g>]) -> Vec<Frame<Expr<'g>>> {
        let mut frames: Vec<(usize, Frame<_>)> = vec![];
        for ((joint, site), body) in self.spec.joints.iter().zip(sites).zip(&self.topology.body) {
            let line = body.map_or(joint.line, |body| self.spec.bodies[body].line);
            frames.push((line, Frame { name: joint.child.text.clone(), link: site.link, pose: site.pose }));
        }
        frames.sort_by_key(|(line, _)| *line);
        frames.into_iter().map(|(_, frame)| frame).collect()
    }
}

fn link_infos(spec: &RobotSpec, tree: &Tree<Expr<'_>>) -> Vec<LinkInfo> {
    let moving = spec.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
    let body = |joint: &JointSpec| tree.frames.iter().position(|frame| frame.name == joint.child.text);
    moving.map(|joint| LinkInfo { joint: joint.name.text.clone(), body: body(joint) }).collect()
}

fn joint_infos(spec: &RobotSpec, values: &Values, diags: &mut Diagnostics) -> Vec<JointInfo> {
    let moving = spec.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
    moving
        .map(|joint| JointInfo { name: joint.name.text.clone(), limits: limits(joint, values, diags) })
        .collect()
}

fn limits(joint: &JointSpec, values: &Values, diags: &mut Diagnostics) -> Limits {
    let mut number = |formula: Option<&Formula>, missing: f64| {
        let value = formula.and_then(|formula| diags.keep(values.number(formula)));
        value.map_or(missing, Number::to_f64)
    };
    Limits {
        lower: number(joint.limits.as_ref().map(|[lower, _]| lower), f64::NEG_INFINITY),
        upper: number(joint.limits.as_ref().map(|[_, upper]| upper), f64::INFINITY),
        velocity: number(joint.velocity.as_ref(), f64::INFINITY),
        effort: number(joint.effort.as_ref(), f64::INFINITY),
    }
}
