//! From tokens to a checked model: what specifications mean.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::model::{self, Model, Motion};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph};

/// The model of a specification without mistakes.
fn model<'g>(graph: &'g Graph, text: &str) -> Model<'g> {
    let mut diags = Diagnostics::new();
    let input = syn::parse_str(text).unwrap();
    let spec = spec::parse(&input, &mut diags);
    let model = model::build(&spec, graph, &mut diags);
    let errors = diags.into_text();
    model.unwrap_or_else(|| panic!("{errors}"))
}

const ROBOJUDGE: &str = r"
    #[derive(Dynamics)]
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(theta1: revolute(z), world -> column)]
    #[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
    #[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1], limits = [-90deg, 1.5], effort = 100)]
    #[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
    pub struct RoboJudge<T> {
        pub m1: T, pub m2: T, pub l1: T, pub r0: T, pub r1: T, pub g: T, pub unused: String,
        pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T, pub iz2: T,
    }";

/// The values of expressions where the parameter `k` is `k + 1`.
fn values<'g, const N: usize>(graph: &'g Graph, exprs: [Expr<'g>; N]) -> [f64; N] {
    let mut evaluator = Evaluator::new(graph, |symbol| f64::from(symbol.0 + 1));
    exprs.map(|expr| evaluator.value(expr))
}

#[test]
fn the_robojudge_is_read_as_written() {
    let graph = Graph::new();
    let model = model(&graph, ROBOJUDGE);
    let names: Vec<_> = model.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names.join(" "), "m1 m2 l1 r0 r1 g ix1 iy1 iz1 ix2 iy2 iz2");
    let [column, arm] = &model.tree.links[..] else { panic!("two links") };
    assert_eq!((column.parent, arm.parent, arm.motion), (None, Some(0), Motion::Revolute));
    assert_eq!(values(&graph, [column.inertia.mass, arm.inertia.mass]), [1.0, 2.0]);
    assert_eq!(values(&graph, column.inertia.first.0), [0.0, 0.0, 4.0]);
    assert_eq!(values(&graph, arm.placement.translation.0), [0.0, 0.0, 3.0]);
    assert_eq!(values(&graph, arm.placement.rotation.column(2).0), [-1.0, 0.0, 0.0]);
    assert_eq!(values(&graph, model.tree.gravity.0), [0.0, 0.0, -6.0]);
    let frame = &model.tree.frames[1];
    let com = frame.pose.inverse().transform_point(arm.inertia.first);
    assert_eq!((frame.name.as_str(), values(&graph, com.0)), ("arm", [0.0, 10.0, 0.0]));
    let limits = model.joints[1].limits;
    assert_eq!([limits.lower, limits.upper, limits.effort], [-std::f64::consts::FRAC_PI_2, 1.5, 100.0]);
}
