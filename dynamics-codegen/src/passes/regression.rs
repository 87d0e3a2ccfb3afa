//! The check of regressors: they are multiplied by parameters, and the plain recursion knows the product.

use super::verify::distance;
use crate::mechanics::plain::inverse_dynamics;
use crate::model::{Model, Passive, Tree};
use crate::spatial::{Pose, PseudoInertia, Random, Symmetric3};

/// The parameters of the regressor, in its order: ten for each body, then those of joints.
pub(super) fn parameters(model: &Model<'_>, tree: &Tree<f64>) -> Vec<f64> {
    let bodies = bodies(model, tree);
    let of_bodies = bodies.into_iter().flat_map(|(link, pose)| ten(&tree.links[link].inertia, pose));
    let joints = tree.links.iter().zip(&model.tree.links).zip(&model.links).filter(|(_, info)| info.acts);
    let of_joints = joints.flat_map(|((link, symbolic), _)| {
        let Passive { armature, damping, friction, stiffness, .. } = link.passive;
        let spring = (!symbolic.passive.stiffness.is_zero()).then_some(stiffness);
        [armature, damping, friction].into_iter().chain(spring)
    });
    // Terms of the energies are there once.
    of_bodies.chain(of_joints).chain(tree.terms.all().map(|_| 1.0)).collect()
}

/// How far a regressor misses the forces of a robot of the same geometry with other parameters, none of them zero.
pub(super) fn regressor_off(
    found: &[f64],
    model: &Model<'_>,
    tree: &Tree<f64>,
    [q, v, a]: [&Vec<f64>; 3],
) -> f64 {
    let mut random = Random(1);
    let mut positive = || 1.5 + random.next();
    let mut other = tree.clone();
    let bodies = bodies(model, tree);
    for (k, link) in other.links.iter_mut().enumerate() {
        link.inertia = PseudoInertia::zero();
        if let Some((_, pose)) = bodies.iter().find(|(link, _)| *link == k) {
            let Symmetric3 { xx, yy, zz, xy, xz, yz } = Symmetric3::zero().map(|_: f64| positive());
            let (mass, first) = (positive(), pose.translation.map(|_| positive()));
            let inertia = PseudoInertia { mass, first, second: Symmetric3 { xx, yy, zz, xy, xz, yz } };
            link.inertia = inertia.transformed(*pose);
        }
        if model.links[k].acts {
            (link.passive.armature, link.passive.damping) = (positive(), positive());
            link.passive.friction = positive();
            if link.passive.stiffness != 0.0 {
                link.passive.stiffness = positive();
            }
        }
    }
    let expected = inverse_dynamics(&other, q, v, a);
    distance(&product(found, &parameters(model, &other)), &expected, 0.0)
}

/// `Y·π` of a matrix by rows.
pub(super) fn product(rows: &[f64], parameters: &[f64]) -> Vec<f64> {
    let row = |row: &[f64]| row.iter().zip(parameters).map(|(y, pi)| y * pi).sum();
    rows.chunks(parameters.len().max(1)).map(row).collect()
}

/// The links that are bodies, and the frames of these in them.
fn bodies(model: &Model<'_>, tree: &Tree<f64>) -> Vec<(usize, Pose<f64>)> {
    let links = model.links.iter().enumerate();
    links.filter_map(|(link, info)| Some((link, tree.frames[info.body?].pose))).collect()
}

fn ten(inertia: &PseudoInertia<f64>, pose: Pose<f64>) -> [f64; 10] {
    let inertia = inertia.transformed(pose.inverse());
    let [x, y, z] = inertia.first.0;
    let Symmetric3 { xx, yy, zz, xy, xz, yz } = inertia.rotational();
    [inertia.mass, x, y, z, xx, xy, yy, xz, yz, zz]
}
