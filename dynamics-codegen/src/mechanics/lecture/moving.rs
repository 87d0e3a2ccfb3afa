//! The bodies of a derivation in expressions, each in a frame that a reader would choose.

use crate::mechanics::plain;
use crate::model::{Frame, Link, LinkInfo, Model};
use crate::spatial::{Pose, PseudoInertia, Vector3};
use crate::symbolic::{Expr, Graph, Op};

/// A body in expressions.
pub(super) struct Moving<'g> {
    pub(super) name: String,
    pub(super) welded: Vec<String>,
    pub(super) mass: Expr<'g>,
    /// Of its frame, in the world.
    pub(super) pose: Pose<Expr<'g>>,
    /// `m·c` in its frame, where that is not at the centre of mass.
    pub(super) first: Option<Vector3<Expr<'g>>>,
    /// About the frame's origin.
    pub(super) inertia: [[Expr<'g>; 3]; 3],
    pub(super) jacobian: Vec<Vec<Expr<'g>>>,
    pub(super) potential: Expr<'g>,
}

/// The bodies of a tree at a configuration.
pub(super) fn moving<'g>(model: &Model<'g>, graph: &'g Graph, q: &[Expr<'g>]) -> Vec<Moving<'g>> {
    let tree = &model.tree;
    let with_mass = tree.links.iter().zip(&model.links).enumerate().filter(|(_, (link, _))| {
        let PseudoInertia { mass, second, .. } = link.inertia;
        !mass.is_zero() || !second.full().0.concat().iter().all(|entry| entry.is_zero())
    });
    let body = |(k, (link, info)): (usize, (&Link<Expr<'g>>, &LinkInfo))| {
        let own = info.body.map(|body| &tree.frames[body]);
        let PseudoInertia { mass, .. } = link.inertia;
        let is_own = mass.is_zero() || is_sum(graph, mass);
        let at_origin = origin(model, graph, k);
        let frame = Frame { name: String::new(), link: Some(k), pose: at_origin };
        let pose = plain::pose(tree, &frame, q);
        let seen = link.inertia.transformed(at_origin.inverse());
        let first = is_own.then_some(seen.first);
        let others = tree
            .frames
            .iter()
            .enumerate()
            .filter(|(at, other)| other.link == Some(k) && Some(*at) != info.body);
        let moment = first.map_or_else(Vector3::zero, |first| pose.rotation * first);
        let potential = -(tree.gravity.dot(pose.translation) * mass + tree.gravity.dot(moment));
        Moving {
            name: own.map_or_else(|| info.joint.clone(), |own| own.name.clone()),
            welded: others.map(|(_, other)| other.name.clone()).collect(),
            mass,
            pose,
            first,
            inertia: seen.rotational().full().0,
            jacobian: plain::body_jacobian(tree, &frame, q),
            potential,
        }
    };
    with_mass.map(body).collect()
}

/// The frame of a link in which all of it is written: in the axes of its body, at its centre of mass. Of several bodies
/// welded together that is a quotient by a sum, which nobody reads: these, and what has no mass, have their body's frame.
pub(super) fn origin<'g>(model: &Model<'g>, graph: &Graph, k: usize) -> Pose<Expr<'g>> {
    let own = model.links[k].body.map(|body| &model.tree.frames[body]);
    let frame = own.map_or_else(Pose::identity, |frame| frame.pose);
    let PseudoInertia { mass, first, .. } = model.tree.links[k].inertia;
    match mass.is_zero() || is_sum(graph, mass) {
        true => frame,
        false => Pose { translation: first.map(|moment| moment / mass), ..frame },
    }
}

/// Whether an expression is a sum.
pub(super) fn is_sum(graph: &Graph, expr: Expr<'_>) -> bool {
    matches!(expr, Expr::Node { id, .. } if matches!(graph.op(id), Op::Add(..) | Op::Sub(..)))
}
