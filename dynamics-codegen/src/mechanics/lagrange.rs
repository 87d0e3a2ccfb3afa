//! The equations of motion a second time: by differentiating the energies, as Lagrange did.
//!
//! Of rigid-body mechanics it uses two sentences only, where the mass is and how fast it moves: with `X` the
//! 4×4 pose of a link in the world and `𝕁 = ∫ r rᵀ dm` over its homogeneous points `r = (x, y, z, 1)`,
//! `T = Σ ½ tr(Ẋ 𝕁 Ẋᵀ)` and `V = −Σ gᵀ X 𝕁 e₄`. No velocity is composed, no force is balanced, no axis is named:
//! `Ẋ = Σ ∂X/∂q_k v_k` and all that follows is calculus on expressions.
//!
//! For tests: the expressions grow as n⁴ and repeat themselves.
//!
//! J. J. Uicker 1965; R. Paul, *Robot Manipulators*, MIT Press 1981, ch. 6; Lagrange's equations and
//! Christoffel's symbols as in R. Murray, Z. Li, S. Sastry 1994, ch. 4.2–4.3.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::plain::link_poses;
use crate::model::Tree;
use crate::spatial::{Pose, PseudoInertia};
use crate::symbolic::{Differentiator, Expr, Graph, Number, SymbolId};

/// The inputs that stand for coordinates, speeds and accelerations, n each.
#[derive(Clone, Copy, Debug)]
pub struct Coordinates<'s> {
    /// `q`
    pub q: &'s [SymbolId],
    /// `v`
    pub v: &'s [SymbolId],
    /// `a`
    pub a: &'s [SymbolId],
}

/// The equations of motion of a tree, as expressions.
#[derive(Clone, Debug)]
pub struct Lagrange<'g> {
    /// `T(q,v)`, J.
    pub kinetic_energy: Expr<'g>,
    /// `V(q)`, J, zero for mass at the world's origin.
    pub potential_energy: Expr<'g>,
    /// `M = ∂²T/∂v²`
    pub mass_matrix: Vec<Vec<Expr<'g>>>,
    /// `C_ij = Σ_k ½(∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) v_k`
    pub coriolis_matrix: Vec<Vec<Expr<'g>>>,
    /// `G = ∂V/∂q`
    pub gravity_forces: Vec<Expr<'g>>,
    /// `τ_i = d/dt ∂T/∂v_i − ∂T/∂q_i + ∂V/∂q_i`
    pub inverse_dynamics: Vec<Expr<'g>>,
}

/// Derives the equations of motion of `tree` in the symbols `at`.
pub fn derive<'g>(graph: &'g Graph, tree: &Tree<Expr<'g>>, at: Coordinates) -> Lagrange<'g> {
    let [q, v, a] = [at.q, at.v, at.a].map(|ids| ids.iter().map(|&id| graph.symbol(id)).collect::<Vec<_>>());
    let mut by_q = By::new(graph, at.q);
    let mut by_v = By::new(graph, at.v);

    let X = link_poses(tree, &q);
    let T = kinetic_energy(tree, &X, &v, &mut by_q);
    let V = potential_energy(tree, &X);

    let dT_dv = by_v.gradient(T);
    let M: Vec<Vec<_>> = dT_dv.iter().map(|&p| by_v.gradient(p)).collect();
    let G = by_q.gradient(V);
    let dT_dq = by_q.gradient(T);
    let tau = (0..tree.dof()).map(|i| {
        // The momentum's rate of change, by the chain rule: its v changes by a, its q by v.
        let momentum_rate = dot(&M[i], &a) + dot(&by_q.gradient(dT_dv[i]), &v);
        momentum_rate - dT_dq[i] + G[i]
    });
    let tau = tau.collect();
    let C = christoffel(&M, &v, &mut by_q);
    Lagrange {
        kinetic_energy: T,
        potential_energy: V,
        mass_matrix: M,
        coriolis_matrix: C,
        gravity_forces: G,
        inverse_dynamics: tau,
    }
}

/// Derivatives by each of several inputs.
struct By<'g>(Vec<Differentiator<'g>>);

impl<'g> By<'g> {
    fn new(graph: &'g Graph, symbols: &[SymbolId]) -> Self {
        Self(symbols.iter().map(|&symbol| Differentiator::new(graph, symbol)).collect())
    }

    fn gradient(&mut self, expr: Expr<'g>) -> Vec<Expr<'g>> {
        self.0.iter_mut().map(|by| by.derivative(expr)).collect()
    }
}

/// `T = Σ ½ tr(Ẋ 𝕁 Ẋᵀ)`
fn kinetic_energy<'g>(
    tree: &Tree<Expr<'g>>,
    X: &[Pose<Expr<'g>>],
    v: &[Expr<'g>],
    by_q: &mut By<'g>,
) -> Expr<'g> {
    let mut twice = Expr::ZERO;
    for (link, &X) in tree.links.iter().zip(X) {
        let moments = moments(&link.inertia);
        for row in rows(X) {
            let rate = row.map(|entry| dot(&by_q.gradient(entry), v));
            for (x, moments) in rate.into_iter().zip(moments) {
                twice = twice + x * dot(&moments, &rate);
            }
        }
    }
    twice * half()
}

/// `V = −Σ gᵀ X 𝕁 e₄`, with the mass at rest in the world.
fn potential_energy<'g>(tree: &Tree<Expr<'g>>, X: &[Pose<Expr<'g>>]) -> Expr<'g> {
    let bodies = tree.links.iter().zip(X).map(|(link, &X)| (link.inertia, X));
    let mut V = Expr::ZERO;
    for (inertia, X) in bodies.chain([(tree.base, Pose::identity())]) {
        let [_, _, _, first] = moments(&inertia);
        for (g, row) in tree.gravity.0.into_iter().zip(rows(X)) {
            V = V - g * dot(&row, &first);
        }
    }
    V
}

/// `C(q,v)` of the Christoffel symbols of the first kind of `M(q)`.
fn christoffel<'g>(M: &[Vec<Expr<'g>>], v: &[Expr<'g>], by_q: &mut By<'g>) -> Vec<Vec<Expr<'g>>> {
    // dM[i][j][k] = ∂M_ij/∂q_k
    let dM: Vec<Vec<Vec<_>>> =
        M.iter().map(|row| row.iter().map(|&entry| by_q.gradient(entry)).collect()).collect();
    let symbol = |i: usize, j: usize, k: usize| (dM[i][j][k] + dM[i][k][j] - dM[j][k][i]) * half();
    let n = v.len();
    let entry = |i, j| (0..n).fold(Expr::ZERO, |sum, k| sum + symbol(i, j, k) * v[k]);
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// The upper three rows of the 4×4 pose; the last is `(0, 0, 0, 1)` and never moves.
fn rows(X: Pose<Expr>) -> [[Expr; 4]; 3] {
    let [[a, b, c], [d, e, f], [g, h, i]] = X.rotation.0;
    let [x, y, z] = X.translation.0;
    [[a, b, c, x], [d, e, f, y], [g, h, i, z]]
}

/// `𝕁 = [Σ h; hᵀ m]`
fn moments<'g>(body: &PseudoInertia<Expr<'g>>) -> [[Expr<'g>; 4]; 4] {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = body.second.full().0;
    let [x, y, z] = body.first.0;
    [[xx, xy, xz, x], [xy, yy, yz, y], [xz, yz, zz, z], [x, y, z, body.mass]]
}

fn dot<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Expr<'g> {
    a.iter().zip(b).fold(Expr::ZERO, |sum, (&x, &y)| sum + x * y)
}

fn half<'g>() -> Expr<'g> {
    Number::ratio(1, 2).into()
}
