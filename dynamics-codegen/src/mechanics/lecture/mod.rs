//! The equations of motion step by step, as a lecture walks from the bodies to `Υ = M·q̈ + C·q̇ + G`.
//!
//! Every body has its frame at its centre of mass, or where that is a quotient by a sum of masses, where it was described,
//! and in the axes that it was described in; what is written of it is in these. The steps are made from each other: `T` from the twists, `M` from the Jacobians, Christoffel's symbols from
//! `M`, and so on. [`closed_forms`](super::closed::closed_forms) comes to the same by another road.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC 1994, ch. 4.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

mod figure;
mod length;
mod linear;
mod moving;
mod recursion;
mod steps;

use super::closed::notation;
use super::equations::{Argument, Inputs};
use crate::closed::{Canonical, Form, Limits, Matrix, Notation, Swelling};
use crate::model::{Model, Motion};
use crate::symbolic::Graph;
pub use recursion::{Inertia, Part, Recursion, recursion};
use steps::Steps;

/// What has more terms on paper is not written out.
pub const MOST_TERMS: usize = 100;

/// A derivation has no more terms than this in all: some thirty pages.
pub const MOST_TERMS_IN_ALL: usize = 8_000;

/// Products of terms that are made for one robot at most.
pub const MOST_PRODUCTS: usize = 2_000_000;

/// Robots of more parts that move are not derived by recursion either: it would fill a book.
pub const MOST_PARTS: usize = 60;

/// Linear models of more degrees of freedom have matrices that nobody reads.
pub const MOST_LINEAR: usize = 15;

/// A step has all that it says in it; figures of long chains are sums of many lengths.
const WITHOUT_NAMES: Limits = Limits { work: 200_000, terms: 200, names: 0 };

/// What is too long to be written out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TooLong {
    /// What it is called: `M`, `Υ`, `T`.
    pub letter: &'static str,
    /// Its indices, from zero: of a body, and of the entry.
    pub indices: Vec<usize>,
    /// Why.
    pub excess: Excess,
}

/// In what something is too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// It has so many terms, and [`MOST_TERMS`] are allowed.
    Terms(usize),
    /// With it the derivation has more than [`MOST_TERMS_IN_ALL`].
    All,
    /// Multiplying it out takes more than [`MOST_PRODUCTS`].
    Products,
    /// The robot has more symbols, and sines and cosines, than one expression can have.
    Symbols,
}

/// All steps. Where closed forms would be too long to read, there is the recursion instead.
#[derive(Clone, Debug)]
pub struct Lecture {
    /// What the symbols are called: those of [`Inputs`].
    pub notation: Notation,
    /// The robot where its coordinates are zero.
    pub figure: Result<Figure, Swelling>,
    /// The bodies that move and have mass, parents before children.
    pub bodies: Result<Vec<Body>, TooLong>,
    /// Their equations.
    pub equations: Result<Equations, TooLong>,
    /// The robot part by part, where one of these is too long.
    pub recursion: Option<Result<Recursion, Swelling>>,
    /// The linear model about the neutral state.
    pub linear: Result<Linear, NoLinear>,
}

/// A robot in its zero configuration.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The joints, each part of one that has several; parents before children.
    pub joints: Vec<Joint>,
    /// The acceleration of free fall, in the world, 3×1.
    pub gravity: Matrix,
}

/// A joint, or a part of one, where coordinates are zero.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// The body that it carries; none between the parts of a joint.
    pub body: Option<String>,
    /// The body that carries it; none between the parts of a joint, and of the world.
    pub parent: Option<String>,
    /// Whether the world carries it.
    pub is_on_world: bool,
    /// Whether it carries nothing: a coordinate that terms of the energies are written in.
    pub is_bare: bool,
    /// How it moves.
    pub motion: Motion,
    /// Its axis in the world, 3×1.
    pub axis: Matrix,
    /// A point on it, 3×1.
    pub point: Matrix,
    /// By how much it turns or slides, if it has one degree of freedom.
    pub coordinate: Form,
    /// Its first coordinate.
    pub q: usize,
    /// Its first speed.
    pub v: usize,
}

/// A body, from where it is to its energies.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name; it stands for all that is welded to it.
    pub name: String,
    /// What is welded to it.
    pub welded: Vec<String>,
    /// Mass, kg.
    pub mass: Form,
    /// `𝓘`, 3×3, about the origin of its frame.
    pub inertia: Matrix,
    /// `R`, 3×3: from its axes to the world's.
    pub rotation: Matrix,
    /// `p`, 3×1: the origin of its frame in the world.
    pub center: Matrix,
    /// `h = m·c` in its frame, where that is not at the centre of mass: of a body without mass, and of several welded
    /// together, whose centre of mass is a quotient by a sum of masses.
    pub first: Option<Matrix>,
    /// `Jᵇ`, 6×n, linear rows first.
    pub jacobian: Matrix,
    /// `Vᵇ = Jᵇ·v`, 6×1.
    pub twist: Matrix,
    /// `T = ½ Vᵇᵀ·ℳ·Vᵇ`
    pub kinetic_energy: Form,
    /// `V = −m·gᵀ·p`, and `−gᵀ·R·h`
    pub potential_energy: Form,
    /// `Jᵇᵀ·ℳ·Jᵇ`, n×n.
    pub share: Matrix,
}

/// From the sum of the energies to the forces.
#[derive(Clone, Debug)]
pub struct Equations {
    /// What rotors add, which turn with no body; none without rotors.
    pub rotors: Option<Rotors>,
    /// Terms of one's own in the energies; none if there are none.
    pub terms: Option<Terms>,
    /// What the mass that stands still adds to V.
    pub potential_at_rest: Form,
    /// `T`
    pub kinetic_energy: Form,
    /// `V`
    pub potential_energy: Form,
    /// `L = T − V`
    pub lagrangian: Form,
    /// `M = Σ Jᵇᵀ·ℳ·Jᵇ`
    pub mass_matrix: Matrix,
    /// Christoffel's symbols that are not zero, those with j ≤ k; nothing where a speed is no rate of a coordinate.
    pub christoffel: Option<Vec<Christoffel>>,
    /// `C`
    pub coriolis_matrix: Matrix,
    /// `G`
    pub gravity_forces: Matrix,
    /// Lagrange's equations; nothing where a speed is no rate of a coordinate.
    pub rows: Option<Vec<Row>>,
    /// The forces of dampers, friction and springs on the left-hand side, nothing where nothing acts.
    pub passive: Option<Matrix>,
    /// `M·a + C·v + G`, and what acts passively: the forces of the motors.
    pub forces: Matrix,
    /// `q̇(q,v)`, where speeds are no rates of coordinates.
    pub rates: Option<Matrix>,
}

/// What rotors add to the energies: their inertia, as the joints feel it.
#[derive(Clone, Debug)]
pub struct Rotors {
    /// To `T`.
    pub kinetic_energy: Form,
    /// To `M`, on its diagonal.
    pub mass_matrix: Matrix,
}

/// What terms of one's own add to the energies.
#[derive(Clone, Debug)]
pub struct Terms {
    /// To `T`.
    pub kinetic_energy: Form,
    /// To `V`.
    pub potential_energy: Form,
    /// To `M`: `∂²T/∂v²`.
    pub mass_matrix: Matrix,
}

/// `Γ_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i)`
#[derive(Clone, Debug)]
pub struct Christoffel {
    /// i, j and k, from zero.
    pub indices: [usize; 3],
    /// The three derivatives.
    pub derivatives: [Form; 3],
    /// Half of their sum.
    pub value: Form,
}

/// A row of `d/dt ∂L/∂q̇ − ∂L/∂q = Υ`.
#[derive(Clone, Debug)]
pub struct Row {
    /// `∂L/∂q̇`
    pub momentum: Form,
    /// `d/dt ∂L/∂q̇`
    pub rate: Form,
    /// `∂L/∂q`
    pub by_coordinate: Form,
    /// Their difference.
    pub force: Form,
}

/// Why there is no linear model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoLinear {
    /// It, or what it is made from, is too long.
    Swelling,
    /// M is singular where all coordinates are zero.
    Singular,
    /// A term of the energies has no derivative there.
    NotSmooth,
}

impl From<Swelling> for NoLinear {
    fn from(Swelling: Swelling) -> Self {
        Self::Swelling
    }
}

/// `M₀·δa + D₀·δv + K₀·δq = B·δu` about a state at rest.
#[derive(Clone, Debug)]
pub struct Linear {
    /// `M` there.
    pub mass_matrix: Matrix,
    /// `K₀ = ∂(G + passive)/∂q`
    pub stiffness: Matrix,
    /// `D₀ = ∂passive/∂v`
    pub damping: Matrix,
    /// `G + passive` there: the forces that hold the robot.
    pub hold: Matrix,
    /// `(−M₀⁻¹·K₀, −M₀⁻¹·D₀)`, n×2n, where M₀ is diagonal.
    pub lower: Option<Matrix>,
    /// Which input drives which speed, n×m.
    pub inputs: Matrix,
}

/// Derives the equations of `model`, step by step.
pub fn lecture<'g>(model: &Model<'g>, graph: &'g Graph) -> Lecture {
    let notation = notation(model);
    let figure = figure::figure(model, graph, &notation);
    let (bodies, equations) = closed(model, graph, &notation);
    let is_long = bodies.is_err() || equations.is_err();
    let recursion = is_long.then(|| recursion::recursion(model, graph, &notation));
    let linear = match model.tree.dof() > MOST_LINEAR || matches!(recursion, Some(Err(Swelling))) {
        true => Err(NoLinear::Swelling),
        false => linear::linear(model, graph, &notation),
    };
    Lecture { notation, figure, bodies, equations, recursion, linear }
}

/// The steps in closed form.
fn closed<'g>(
    model: &Model<'g>,
    graph: &'g Graph,
    notation: &Notation,
) -> (Result<Vec<Body>, TooLong>, Result<Equations, TooLong>) {
    let symbols = TooLong { letter: "T", indices: vec![], excess: Excess::Symbols };
    let inputs = Inputs::of(model);
    let count = model.parameters.len() + inputs.size(Argument::Q) + 2 * inputs.dof;
    if count >= Canonical::MOST_SYMBOLS {
        return (Err(symbols.clone()), Err(symbols));
    }
    let Ok(mut steps) = Steps::new(model, graph, notation) else {
        return (Err(symbols.clone()), Err(symbols));
    };
    let bodies = steps.bodies().map_err(|stop| steps.too_long(stop));
    let equations = match &bodies {
        Ok(_) => steps.equations().map_err(|stop| steps.too_long(stop)),
        Err(long) => Err(long.clone()),
    };
    (bodies, equations)
}
