//! The specialised recursions against the oracle: whatever the joints are, every finished program computes what the
//! textbook says of the same tree.

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::equations::{Argument, Derivation, Input, Method};
use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_codegen::model::{self, FieldType, LinkInfo, Model, Tree};
use dynamics_codegen::passes::{RunTime, compile, disagreements, entries};
use dynamics_codegen::spatial::{Matrix3, PseudoInertia, Random};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph, Number};

mod random;

use random::{SHAPES, State, near_and_far, state, with_terms};

/// Two ways of some hundred operations each; mass matrices of these trees have conditions of some thousands.
const ROUNDING: f64 = 1e-10;
/// The same without a mass matrix to solve with.
const CLOSE: f64 = 1e-13;

fn constant<'g>(x: f64) -> Expr<'g> {
    Number::from_f64(x).expect("random numbers are finite").into()
}

/// All methods of a robot with so many frames.
fn all_methods(frames: usize) -> Vec<Method> {
    Method::OF_ROBOT.into_iter().chain((0..frames).flat_map(Method::of_frame)).collect()
}

fn model_of<'g>(tree: &Tree<f64>, seed: u64) -> Model<'g> {
    Model {
        name: format!("Random{seed}"),
        field_type: FieldType::Unused,
        parameters: vec![],
        joints: vec![],
        actuated: (0..tree.dof()).collect(),
        links: (tree.links.iter().enumerate())
            .map(|(k, link)| LinkInfo {
                joint: format!("joint{k}"),
                body: Some(k),
                acts: link.motion.speeds() == 1,
            })
            .collect(),
        parents: tree.links.iter().map(|link| link.parent).collect(),
        tree: tree.map(constant),
    }
}

#[test]
fn programs_compute_what_the_oracle_says_of_random_trees() {
    for seed in 0..48 {
        let tree = state(1000 + seed, 1 + seed as usize % 6, SHAPES[seed as usize % 3]).tree;
        let graph = Graph::new();
        let model = model_of(&tree, seed);
        let compiled = compile(&model, &graph, &all_methods(tree.frames.len()), RunTime::Core);
        let found = disagreements(&model, &compiled);
        let motions: Vec<_> = tree.links.iter().map(|link| link.motion).collect();
        assert!(found.is_empty(), "tree {seed} of {motions:?}: {found:?}");
    }
}

/// The momentum about the centre of mass is that of the same robot anywhere, to the last digits.
#[test]
fn momenta_are_the_same_wherever_a_robot_stands() {
    for seed in 0..24 {
        let State { tree, q, v, .. } = state(5000 + seed, 1 + seed as usize % 6, SHAPES[seed as usize % 3]);
        let (near, far) = near_and_far(&tree);
        let graph = Graph::new();
        let model = model_of(&far, seed);
        let methods = [Method::CentroidalMomentum, Method::CentroidalMomentumMatrix];
        let compiled = compile(&model, &graph, &methods, RunTime::Core);
        let found = methods.map(|method| {
            let program = compiled.program(method).expect("it is short");
            let input = |input| match input {
                Input::Argument(Argument::Q, k) => q[k],
                Input::Argument(Argument::V, k) => v[k],
                Input::Argument(..) | Input::Parameter(_) => f64::NAN,
            };
            program.evaluate(input, &[])
        });
        let oracle = Oracle::new(&near);
        let expected = [oracle.centroidal_momentum(&q, &v), oracle.centroidal_momentum_matrix(&q).concat()];
        for (found, expected) in found.iter().zip(&expected) {
            let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            let missed = expected.iter().zip(found).fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()));
            assert!(missed <= CLOSE * size, "tree {seed} is off by {missed:e} of {size:e}");
        }
    }
}

/// Terms in the energies couple what the tree does not, and their derivatives are in every method.
#[test]
fn programs_compute_what_the_oracle_says_of_trees_with_terms() {
    for seed in 0..18 {
        let State { tree, .. } =
            with_terms(state(1200 + seed, 1 + seed as usize % 6, SHAPES[seed as usize % 3]), seed);
        let graph = Graph::new();
        let model = model_of(&tree, seed);
        let compiled = compile(&model, &graph, &all_methods(0), RunTime::Core);
        let found = disagreements(&model, &compiled);
        let motions: Vec<_> = tree.links.iter().map(|link| link.motion).collect();
        assert!(found.is_empty(), "tree {seed} of {motions:?}: {found:?}");
    }
}

/// Not only by the way that was the cheapest; with axes that are parallel and opposite, as random ones are not.
#[test]
fn frames_at_rest_give_what_turning_ones_give() {
    let mut resting_trees = 0;
    for seed in 0..96 {
        let mut random = Random(seed);
        let State { mut tree, q, v, a } =
            state(3000 + seed, 2 + seed as usize % 5, SHAPES[seed as usize % 3]);
        for link in &mut tree.links {
            let opposite = Matrix3::rotation_x(-1.0, 0.0);
            let turn = [Matrix3::rotation_z(0.6, 0.8), opposite, opposite, link.placement.rotation];
            link.placement.rotation = turn[(2.0 * (random.next() + 1.0)) as usize % 4];
        }
        let graph = Graph::new();
        let model = model_of(&tree, seed);
        let turning = Derivation::of(&model, &graph);
        let Some(resting) = turning.at_rest() else { continue };
        resting_trees += 1;
        let inputs = turning.inputs;
        let mut evaluator = Evaluator::new(&graph, |symbol| match inputs.meaning(symbol) {
            Input::Parameter(_) => f64::NAN,
            Input::Argument(Argument::Q, k) => q[k],
            Input::Argument(Argument::V, k) => v[k],
            Input::Argument(Argument::A | Argument::Tau, k) => a[k],
        });
        for method in Method::OF_ROBOT.into_iter().filter(|method| method.trait_().is_of_forces()) {
            let [expected, found] = [&turning, &resting].map(|derivation| -> Vec<f64> {
                entries(&derivation.blocks(method)).into_iter().map(|x| evaluator.value(x)).collect()
            });
            let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            let missed = expected.iter().zip(&found).fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()));
            assert!(
                missed <= ROUNDING * size,
                "tree {seed}: {} is off by {missed:e} of {size:e}",
                method.name()
            );
        }
    }
    assert!(resting_trees > 20, "{resting_trees} trees have links whose frames may rest");
}

/// The rank of a matrix by rows: Gram–Schmidt with the largest column first. The smallest singular values of these
/// random ones are far from the rounding of their largest.
fn rank(rows: &[Vec<f64>]) -> usize {
    let width = rows[0].len();
    let mut columns: Vec<Vec<f64>> = (0..width).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
    let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    columns.iter_mut().for_each(|column| {
        let size = length(column).max(1e-300);
        column.iter_mut().for_each(|x| *x /= size);
    });
    for found in 0..width {
        let (largest, size) = columns
            .iter()
            .map(|column| length(column))
            .enumerate()
            .fold((0, 0.0), |best, (k, size)| if size > best.1 { (k, size) } else { best });
        if size < 1e-9 {
            return found;
        }
        let pivot: Vec<f64> = columns[largest].iter().map(|x| x / size).collect();
        for column in &mut columns {
            // Twice, for what rounding leaves the first time.
            for _ in 0..2 {
                let along: f64 = column.iter().zip(&pivot).map(|(x, y)| x * y).sum();
                column.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= along * y);
            }
        }
    }
    width
}

/// No base parameter is a combination of others, and no force that the regressor explains is lost.
#[test]
fn base_parameters_are_all_that_can_be_told_apart() {
    for seed in 0..30 {
        let mut tree = state(2000 + seed, 1 + seed as usize % 5, SHAPES[seed as usize % 3]).tree;
        let graph = Graph::new();
        let mut model = model_of(&tree, seed);
        // Sometimes a link is only a part of the joint that carries the next one.
        if let Some(part) = (tree.links.iter().filter_map(|link| link.parent)).find(|_| seed % 2 == 0) {
            tree.links[part].inertia = PseudoInertia::zero();
            model.tree = tree.map(constant);
            model.links[part].body = None;
        }
        let compiled = compile(&model, &graph, &[Method::Regressor, Method::BaseRegressor], RunTime::Core);
        let nq = tree.coordinates();
        let (wide, narrow) = (compiled.parameter_names.len(), compiled.base_parameter_names.len());
        let (mut all, mut base) = (vec![], vec![]);
        for sample in 0..4 + wide {
            let mut random = Random(1000 * sample as u64);
            let numbers: Vec<f64> = (0..100).map(|_| random.next()).collect();
            let number = |k: usize| numbers[k];
            let mut q: Vec<f64> = (0..nq).map(|k| 3.0 * number(k)).collect();
            tree.normalise(&mut q);
            let input = |input: Input| match input {
                Input::Argument(Argument::Q, k) => q[k],
                Input::Argument(Argument::V, k) => 2.0 * number(k + 30),
                Input::Argument(_, k) => 5.0 * number(k + 60),
                Input::Parameter(_) => unreachable!("every number is known"),
            };
            let rows = |method, width: usize| -> Vec<Vec<f64>> {
                let program = compiled.program(method).expect("small robots are straight lines");
                program.evaluate(input, &[]).chunks(width).map(<[f64]>::to_vec).collect()
            };
            all.extend(rows(Method::Regressor, wide));
            base.extend(rows(Method::BaseRegressor, narrow));
        }
        let motions: Vec<_> = tree.links.iter().map(|link| link.motion).collect();
        let names = &compiled.base_parameter_names;
        assert_eq!((rank(&base), rank(&all)), (narrow, narrow), "tree {seed} of {motions:?}: {names:?}");
    }
}

/// The link between the two axes of a universal joint has no mass of its own: what is told apart of it is what it gets
/// of the body beyond, in one direction if the second axis is oblique.
#[test]
fn parts_of_joints_have_no_parameters_of_their_own() {
    let body = "mass = 1.5, com = [0.1, 0.2, 0.3], inertia = tensor(0.11, 0.01, 0.02, 0.12, 0.03, 0.13)";
    let robot = format!(
        "#[joint(j0: free, world -> b0)] #[body(b0, {body})]
         #[joint(j1: universal(y, [0.978, -0.625, 0.647]), b0 -> b1, at = [0.1, 0.2, 0.3])] #[body(b1, {body})]
         struct R;"
    );
    let input: syn::DeriveInput = syn::parse_str(&robot).expect("it is Rust");
    let (mut diags, graph) = (Diagnostics::new(), Graph::new());
    let spec = spec::parse(&input, &mut diags);
    let model = model::build(&spec, &graph, &mut diags).expect("it is a robot");
    diags.check().expect("without mistakes");
    let compiled = compile(&model, &graph, &[Method::BaseRegressor], RunTime::Core);
    // Ten of the free body, seven of the other, and two of what the link between them gets of it.
    assert_eq!(compiled.base_parameter_names.len(), 19, "{:?}", compiled.base_parameter_names);
}
