//! Derivatives of expressions: by inputs, and along the directions in which the configuration moves.

use crate::model::Tree;
use crate::symbolic::{Differentiator, Expr, Graph, SymbolId};

/// Derivatives by each of several inputs.
pub(super) struct By<'g>(Vec<Differentiator<'g>>);

impl<'g> By<'g> {
    pub(super) fn new(graph: &'g Graph, symbols: &[SymbolId]) -> Self {
        Self(symbols.iter().map(|&symbol| Differentiator::new(graph, symbol)).collect())
    }

    pub(super) fn gradient(&mut self, expr: Expr<'g>) -> Vec<Expr<'g>> {
        self.0.iter_mut().map(|by| by.derivative(expr)).collect()
    }
}

/// Derivatives along the directions in which the configuration moves at each unit speed.
pub(super) struct Along<'g> {
    by_q: By<'g>,
    q: Vec<Expr<'g>>,
    /// The rates of the coordinates.
    directions: Vec<Vec<Expr<'g>>>,
}

impl<'g> Along<'g> {
    pub(super) fn new(graph: &'g Graph, symbols: &[SymbolId], tree: &Tree<Expr<'g>>, q: &[Expr<'g>]) -> Self {
        let n = tree.dof();
        let directions = (0..n).map(|k| tree.configuration_rate(q, &unit(k, n)));
        Self { by_q: By::new(graph, symbols), q: q.to_vec(), directions: directions.collect() }
    }

    /// The coordinate `k`.
    pub(super) fn coordinate(&self, k: usize) -> Expr<'g> {
        self.q[k]
    }

    pub(super) fn gradient(&mut self, expr: Expr<'g>) -> Vec<Expr<'g>> {
        let by_q = self.by_q.gradient(expr);
        self.directions.iter().map(|direction| dot(&by_q, direction)).collect()
    }
}

pub(super) fn unit<'g>(k: usize, n: usize) -> Vec<Expr<'g>> {
    (0..n).map(|i| if i == k { Expr::ONE } else { Expr::ZERO }).collect()
}

pub(super) fn dot<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Expr<'g> {
    a.iter().zip(b).fold(Expr::ZERO, |sum, (&x, &y)| sum + x * y)
}
