//! Methods that leave matrices to the run time's loops: `M⁻¹`, and the derivatives of forward dynamics.

use super::methods::{Shared, pass_on, return_type, shared_name, typed_arguments};
use crate::mechanics::equations::Method;
use crate::passes::Sizes;

/// The body that leaves the matrices to the run time's loops.
pub(super) fn by_loops(method: Method, parents: &[Option<usize>], sizes: Sizes, scalar: &str) -> String {
    let (arguments, returned) = (typed_arguments(method, scalar, sizes), return_type(method, scalar, sizes));
    let statements = match method {
        Method::InverseDynamicsWithDerivatives => {
            "        (self.inverse_dynamics(q, v, a), self.inverse_dynamics_derivatives(q, v, a))\n"
                .to_owned()
        }
        Method::InverseMassMatrix => {
            elimination_tree(parents) + "        inverse_of(self.mass_matrix(q), tree)\n"
        }
        _ => {
            let solved = solved(method, "&inverse", "&factors");
            format!("{}        {solved}\n", before_solving(parents))
        }
    };
    format!("    fn {}(&self{arguments}) -> {returned} {{\n{statements}    }}\n", method.name())
}

/// What the loops of a bundle and its part share: all but what is solved for. That is left to a function, which makes the
/// result where the caller wants it; a part of a result that is dropped would be copied.
pub(super) fn shared_loops(bundle: Method, parents: &[Option<usize>], sizes: Sizes, scalar: &str) -> Shared {
    let n = sizes.inputs.dof;
    let text = format!(
        "    fn {}(\n        &self{},\n        finish: impl ::core::ops::FnOnce(SVector<{scalar}, {n}>, \
         &InverseDynamicsDerivatives<{scalar}, {n}>, &Factors<{scalar}, {n}>) -> {FINISHED},\n    ) -> {FINISHED} {{\n\
         {}        finish(a, &inverse, &factors)\n    }}\n",
        bundle.name(),
        typed_arguments(bundle, scalar, sizes),
        before_solving(parents)
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
fn before_solving(parents: &[Option<usize>]) -> String {
    elimination_tree(parents)
        + "        let a = self.forward_dynamics(q, v, tau);\n        \
           let mut inverse = self.inverse_dynamics_derivatives(q, v, &a);\n        \
           let mut factors = Factors::new(tree);\n        \
           factors.invert(&mut inverse.dtau_da.data.0);\n"
}

/// The statement that names the tree of the factors.
pub(super) fn elimination_tree(parents: &[Option<usize>]) -> String {
    format!("        let tree = const {{ &EliminationTree::of({parents:?}) }};\n")
}
