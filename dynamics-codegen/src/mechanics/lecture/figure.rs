//! The figure of a robot, in its zero configuration.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::{Figure, Joint, WITHOUT_NAMES};
use crate::closed::{Closed, Matrix, Notation, Swelling, close};
use crate::mechanics::equations::{Argument, Inputs};
use crate::mechanics::plain;
use crate::model::Model;
use crate::symbolic::{Expr, Graph};

/// Where all coordinates are zero, and quaternions no rotation.
pub(super) fn neutral<'g>(model: &Model<'g>) -> Vec<Expr<'g>> {
    let mut q = vec![Expr::ZERO; model.tree.coordinates()];
    model.tree.quaternions().for_each(|at| q[at + 3] = Expr::ONE);
    q
}

/// The joints and gravity.
pub(super) fn figure<'g>(
    model: &Model<'g>,
    graph: &'g Graph,
    notation: &Notation,
) -> Result<Figure, Swelling> {
    let tree = &model.tree;
    let q = Inputs::of(model).vector(graph, Argument::Q);
    // Where the joint itself is at zero: its moving frame less its offset.
    let poses = plain::link_poses(tree, &neutral(model));
    let mut exprs = Vec::new();
    for (link, pose) in tree.links.iter().zip(&poses) {
        exprs.extend(pose.rotation.column(2).0);
        exprs.extend(pose.translation.0);
        exprs.push(link.drive.ratio * q[link.drive.q] + link.drive.offset);
    }
    exprs.extend(tree.gravity.0);
    let Closed { forms, .. } = close(graph, &mut notation.clone(), &exprs, WITHOUT_NAMES)?;
    let vector = |at: usize| Matrix::vector(forms[at..at + 3].to_vec());
    let joint = |(k, info): (usize, &crate::model::LinkInfo)| Joint {
        name: info.joint.clone(),
        body: info.body.map(|body| tree.frames[body].name.clone()),
        parent: tree.links[k]
            .parent
            .and_then(|parent| model.links[parent].body)
            .map(|body| tree.frames[body].name.clone()),
        is_on_world: tree.links[k].parent.is_none(),
        is_bare: info.body.is_none() && tree.links.iter().all(|link| link.parent != Some(k)),
        motion: tree.links[k].motion,
        axis: vector(7 * k),
        point: vector(7 * k + 3),
        coordinate: forms[7 * k + 6].clone(),
        q: tree.links[k].drive.q,
        v: tree.links[k].drive.v,
    };
    let joints = model.links.iter().enumerate().map(joint).collect();
    Ok(Figure { joints, gravity: vector(7 * tree.links.len()) })
}
