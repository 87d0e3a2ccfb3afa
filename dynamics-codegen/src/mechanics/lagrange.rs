//! The equations of motion a second time: by differentiating the energies, as Lagrange did.
//!
//! Of rigid-body mechanics it uses two sentences only, where the mass is and how fast it moves: with `X` the
//! 4×4 pose of a link in the world and `𝕁 = ∫ r rᵀ dm` over its homogeneous points `r = (x, y, z, 1)`,
//! `T = Σ ½ tr(Ẋ 𝕁 Ẋᵀ)` and `V = −Σ gᵀ X 𝕁 e₄`. No velocity is composed, no force is balanced, no axis is named:
//! `Ẋ = Σ E_k(X) v_k` and all that follows is calculus on expressions.
//!
//! A speed is a rate of a coordinate, or, of ball and free joints, of motion along a field `E_k` of directions; the
//! fields' brackets then enter Lagrange's equations as G. Hamel has them, and the connection as J.-L. Koszul has it.
//!
//! For tests: the expressions grow as n⁴ and repeat themselves.
//!
//! J. J. Uicker 1965; R. Paul, *Robot Manipulators*, MIT Press 1981, ch. 6; Lagrange's equations and
//! Christoffel's symbols as in R. Murray, Z. Li, S. Sastry 1994, ch. 4.2–4.3; G. Hamel, *Die
//! Lagrange-Eulerschen Gleichungen der Mechanik*, 1904.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::along::{Along, By, dot, unit};
use super::plain::{bracket, link_poses};
use super::terms::{Energy, InWorld, energies};
use crate::model::Tree;
use crate::spatial::{Pose, PseudoInertia};
use crate::symbolic::{Expr, Graph, Number, SymbolId};

/// The inputs that stand for coordinates, speeds and accelerations.
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
    /// `C_ij = Σ_k ½(∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) v_k`, and brackets.
    pub coriolis_matrix: Vec<Vec<Expr<'g>>>,
    /// `G = ∂V/∂q`
    pub gravity_forces: Vec<Expr<'g>>,
    /// `τ_i = d/dt ∂T/∂v_i − ∂T/∂q_i + ∂(V + U)/∂q_i + ∂D/∂v_i`, and brackets, with the springs' energy U and the
    /// dissipation function D.
    pub inverse_dynamics: Vec<Expr<'g>>,
}

/// Derives the equations of motion of `tree` in the symbols `at`.
pub fn derive<'g>(graph: &'g Graph, tree: &Tree<Expr<'g>>, at: Coordinates) -> Lagrange<'g> {
    let [q, v, a] = [at.q, at.v, at.a].map(|ids| ids.iter().map(|&id| graph.symbol(id)).collect::<Vec<_>>());
    let mut along = Along::new(graph, at.q, tree, &q);
    let mut by_v = By::new(graph, at.v);

    let X = link_poses(tree, &q);
    let mut T = kinetic_energy(tree, &X, &v, &mut along);
    let mut V = potential_energy(tree, &X);
    let (U, mut D) = springs_and_dissipation(tree, &q, &v);
    for (_, term) in energies(&tree.terms, &v, &mut along, &InWorld { tree, links: &X }) {
        match term {
            Energy::Potential(term) => V = V + term,
            Energy::Dissipation(term) => D = D + term,
            Energy::Kinetic(term) => T = T + term,
        }
    }

    let momentum = by_v.gradient(T);
    let M: Vec<Vec<_>> = momentum.iter().map(|&p| by_v.gradient(p)).collect();
    let G = along.gradient(V);
    let (dT, dU, dD) = (along.gradient(T), along.gradient(U), by_v.gradient(D));
    let tau = (0..tree.dof()).map(|i| {
        // The momentum's rate of change, by the chain rule: its v changes by a, its q along v.
        let momentum_rate = dot(&M[i], &a) + dot(&along.gradient(momentum[i]), &v);
        momentum_rate + dot(&momentum, &bracket(tree, &unit(i, v.len()), &v)) - dT[i] + G[i] + dU[i] + dD[i]
    });
    let tau = tau.collect();
    let C = connection(tree, &M, &momentum, &v, &mut along);
    Lagrange {
        kinetic_energy: T,
        potential_energy: V,
        mass_matrix: M,
        coriolis_matrix: C,
        gravity_forces: G,
        inverse_dynamics: tau,
    }
}

/// `T = Σ ½ tr(Ẋ 𝕁 Ẋᵀ)`
fn kinetic_energy<'g>(
    tree: &Tree<Expr<'g>>,
    X: &[Pose<Expr<'g>>],
    v: &[Expr<'g>],
    along: &mut Along<'g>,
) -> Expr<'g> {
    let mut twice = Expr::ZERO;
    for (link, &X) in tree.links.iter().zip(X) {
        let moments = moments(&link.inertia);
        for row in rows(X) {
            let rate = row.map(|entry| dot(&along.gradient(entry), v));
            for (x, moments) in rate.into_iter().zip(moments) {
                twice = twice + x * dot(&moments, &rate);
            }
        }
        let rotor = link.drive.ratio * v[link.drive.v];
        twice = twice + link.passive.armature * rotor * rotor;
    }
    twice * half()
}

/// `U = Σ ½ k (p − p₀)²` and `D = Σ ½ d s² + f √(s² + s₀²)`, whose derivatives are the passive forces.
fn springs_and_dissipation<'g>(
    tree: &Tree<Expr<'g>>,
    q: &[Expr<'g>],
    v: &[Expr<'g>],
) -> (Expr<'g>, Expr<'g>) {
    let (mut U, mut D) = (Expr::ZERO, Expr::ZERO);
    for link in tree.links.iter().filter(|link| link.motion.speeds() == 1) {
        let (passive, drive) = (link.passive, link.drive);
        let stretch = drive.ratio * q[drive.q] + drive.offset - passive.rest;
        let speed = drive.ratio * v[drive.v];
        U = U + passive.stiffness * stretch * stretch * half();
        D = D + passive.damping * speed * speed * half();
        if !passive.friction.is_zero() {
            let smoothed = speed * speed + passive.friction_speed * passive.friction_speed;
            D = D + passive.friction * smoothed.sqrt().expect("a sum of squares");
        }
    }
    (U, D)
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

/// `C_ij = ⟨∇_v E_j, E_i⟩` by Koszul's formula; without brackets that of Christoffel's symbols of `M(q)`.
fn connection<'g>(
    tree: &Tree<Expr<'g>>,
    M: &[Vec<Expr<'g>>],
    momentum: &[Expr<'g>],
    v: &[Expr<'g>],
    along: &mut Along<'g>,
) -> Vec<Vec<Expr<'g>>> {
    // dM[i][j][k] = E_k(M_ij)
    let dM: Vec<Vec<Vec<_>>> =
        M.iter().map(|row| row.iter().map(|&entry| along.gradient(entry)).collect()).collect();
    let symbol = |i: usize, j: usize, k: usize| dM[i][j][k] + dM[i][k][j] - dM[j][k][i];
    let n = v.len();
    let units: Vec<_> = (0..n).map(|k| unit(k, n)).collect();
    let brackets = |i: usize, j: usize| {
        dot(&M[i], &bracket(tree, v, &units[j]))
            - dot(&M[j], &bracket(tree, v, &units[i]))
            - dot(momentum, &bracket(tree, &units[j], &units[i]))
    };
    let entry = |i, j| (0..n).fold(brackets(i, j), |sum, k| sum + symbol(i, j, k) * v[k]) * half();
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

fn half<'g>() -> Expr<'g> {
    Number::ratio(1, 2).into()
}
