//! The specialised recursions against the oracle: whatever the joints are, every finished program computes what the
//! textbook says of the same tree.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::{FieldType, Model};
use dynamics_codegen::passes::{compile, disagreements};
use dynamics_codegen::symbolic::{Expr, Graph, Number};

mod random;

use random::{SHAPES, state};

fn constant<'g>(x: f64) -> Expr<'g> {
    Number::from_f64(x).expect("random numbers are finite").into()
}

/// All methods of a robot with so many frames.
fn all_methods(frames: usize) -> Vec<Method> {
    let of_frame = |k| {
        [
            Method::Pose(k),
            Method::Jacobian(k),
            Method::WorldJacobian(k),
            Method::Velocity(k),
            Method::Acceleration(k),
        ]
    };
    let more = [Method::PassiveForces, Method::InverseMassMatrix, Method::ElasticEnergy];
    Method::OF_ROBOT.into_iter().chain(more).chain((0..frames).flat_map(of_frame)).collect()
}

#[test]
fn programs_compute_what_the_oracle_says_of_random_trees() {
    for seed in 0..48 {
        let tree = state(1000 + seed, 1 + seed as usize % 6, SHAPES[seed as usize % 3]).tree;
        let graph = Graph::new();
        let model = Model {
            name: format!("Random{seed}"),
            field_type: FieldType::Unused,
            parameters: vec![],
            joints: vec![],
            tree: tree.map(constant),
        };
        let compiled = compile(&model, &graph, &all_methods(tree.frames.len()));
        let found = disagreements(&model, &compiled);
        let motions: Vec<_> = tree.links.iter().map(|link| link.motion).collect();
        assert!(found.is_empty(), "tree {seed} of {motions:?}: {found:?}");
    }
}
