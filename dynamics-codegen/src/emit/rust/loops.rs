//! Methods that leave matrices to the run time's loops: `M⁻¹`, and the derivatives of forward dynamics.

use super::context::Context;
use super::methods::{Shared, pass_on, return_type, shared_name, shortened, typed_arguments};
use crate::emit::body;
use crate::emit::names;
use crate::mechanics::equations::{Input, Method};
use crate::passes::{Program, Sizes};

/// The body that leaves the matrices to the run time's loops.
pub(super) fn by_loops(
    method: Method,
    parents: &[Option<usize>],
    factoring: Option<&Program>,
    context: &Context<'_>,
    scalar: &str,
) -> String {
    let sizes = context.sizes;
    let (arguments, returned) = (typed_arguments(method, scalar, sizes), return_type(method, scalar, sizes));
    let statements = match method {
        Method::InverseDynamicsWithDerivatives => {
            "        (self.inverse_dynamics(q, v, a), self.inverse_dynamics_derivatives(q, v, a))\n"
                .to_owned()
        }
        Method::InverseMassMatrix => {
            elimination_tree(parents) + "        inverse_of(&self.mass_matrix(q), tree)\n"
        }
        _ => {
            let solved = solved(method, "&inverse", "&factors");
            format!("{}        {solved}\n", before_solving(parents, factoring, context))
        }
    };
    format!("    fn {}(&self{arguments}) -> {returned} {{\n{statements}    }}\n", method.name())
}

/// What the loops of a bundle and its part share: all but what is solved for. That is left to a function, which makes the
/// result where the caller wants it; a part of a result that is dropped would be copied.
pub(super) fn shared_loops(
    bundle: Method,
    parents: &[Option<usize>],
    factoring: Option<&Program>,
    context: &Context<'_>,
    scalar: &str,
) -> Shared {
    let n = context.sizes.inputs.dof;
    let text = format!(
        "    fn {}(\n        &self{},\n        finish: impl ::core::ops::FnOnce(SVector<{scalar}, {n}>, \
         &InverseDynamicsDerivatives<{scalar}, {n}>, &Factors<{scalar}, {n}>) -> {FINISHED},\n    ) -> {FINISHED} {{\n\
         {}        finish(a, &inverse, &factors)\n    }}\n",
        bundle.name(),
        typed_arguments(bundle, scalar, context.sizes),
        before_solving(parents, factoring, context)
    );
    Shared { text, parameter: Some(FINISHED) }
}

/// What the function returns that finishes the shared loops.
const FINISHED: &str = "__Finished";

/// The body that finishes the shared loops.
pub(super) fn by_shared_loops(method: Method, bundle: Method, scalar: &str, sizes: Sizes) -> String {
    let a = if method == bundle { "a" } else { "_" };
    format!(
        "    fn {}(&self{}) -> {} {{\n        self.{}({}, |{a}, inverse, factors| {})\n    }}\n",
        method.name(),
        typed_arguments(method, scalar, sizes),
        return_type(method, scalar, sizes),
        shared_name(bundle),
        pass_on(method),
        solved(method, "inverse", "factors")
    )
}

/// What comes of the acceleration, the derivatives of inverse dynamics, and the factors.
fn solved(method: Method, inverse: &str, factors: &str) -> String {
    let derivatives = format!("forward_from_inverse({inverse}, {factors})");
    match method {
        Method::ForwardDynamicsWithDerivatives => format!("(a, {derivatives})"),
        _ => derivatives,
    }
}

/// The statements from the arguments to what is solved with.
fn before_solving(parents: &[Option<usize>], factoring: Option<&Program>, context: &Context<'_>) -> String {
    let mut text = elimination_tree(parents);
    text.push_str("        let a = self.forward_dynamics(q, v, tau);\n");
    text.push_str("        let inverse = self.inverse_dynamics_derivatives(q, v, &a);\n");
    text.push_str(&match factoring {
        Some(program) => factors(program, context),
        None => "        let mut factors = Factors::new(tree);\n        factors.factor(&inverse.dtau_da.data.0);\n"
            .to_owned(),
    });
    text
}

/// The statement that names the tree of the factors.
pub(super) fn elimination_tree(parents: &[Option<usize>]) -> String {
    format!("        let tree = const {{ &EliminationTree::of({parents:?}) }};\n")
}

/// The statements from the mass matrix to its factors.
fn factors(program: &Program, context: &Context<'_>) -> String {
    let n = context.sizes.inputs.dof;
    let parameters: Vec<String> = (0..n * n).map(|k| names::entry("m", k / n, Some(k % n), n)).collect();
    let (fields, literals) = (&[], context.literals.clone());
    let context = Context { fields, parameters: &parameters, literals, ..*context };
    let matrix = (0..n * n).map(|k| names::entry("r", k / n, Some(k % n), n));
    let wanted: Vec<String> = matrix.chain((0..n).map(|k| names::entry("d", k, None, n))).collect();
    let body = body::write(program, &wanted, &context, 2);
    let is_read = |k: usize| body.inputs.iter().any(|(input, _)| *input == Input::Parameter(k));
    let column = |j: usize| {
        let entry = |i: usize| if is_read(n * i + j) { parameters[n * i + j].as_str() } else { "_" };
        format!("[{}]", shortened(&(0..n).map(entry).collect::<Vec<_>>()))
    };
    let entries: Vec<&str> = body.results.iter().map(String::as_str).collect();
    let (r, d) = entries.split_at(n * n);
    let lines = |texts: Vec<String>| {
        texts.iter().map(|text| format!("                {text},\n")).collect::<String>()
    };
    let columns = |step: usize, skip: usize| {
        let column = |k: usize| {
            let entries: Vec<&str> = (0..n).map(|i| r[k * skip + i * step]).collect();
            format!("[{}]", entries.join(", "))
        };
        lines((0..n).map(column).collect())
    };
    format!(
        "        let [\n{}        ] = inverse.dtau_da.data.0;\n\n{}\n        let factors = Factors {{\n            tree,\n            \
         r: [\n{}            ],\n            r_transposed: [\n{}            ],\n            inverse_d: [{}],\n        }};\n",
        lines((0..n).map(column).collect()),
        body.statements,
        columns(n, 1),
        columns(1, n),
        d.join(", ")
    )
}
