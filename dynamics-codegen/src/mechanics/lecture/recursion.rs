//! What is left to be written where closed forms swell: each part of the robot beside the one that carries it.
//!
//! From these the rest follows by matrices that have names, and are not multiplied out: with `X_i` that takes twists of the
//! carrier to the part, `V_i = X_i·V_a + S_i·q̇` and `J_i` likewise, then `T`, `V`, `M = Σ J_iᵀ·ℳ_i·J_i`,
//! `C = Σ J_iᵀ·(ℳ_i·J̇_i + ℬ_i·J_i)` and `G`.
//!
//! S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix and Christoffel symbols for rigid-body
//! systems*, J. Comput. Nonlinear Dynam. 16 (2021), for `ℬ`.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::moving::{is_sum, origin};
use super::{MOST_PARTS, WITHOUT_NAMES};
use crate::closed::{Form, Matrix, Notation, Swelling, close};
use crate::mechanics::equations::{Argument, Inputs};
use crate::mechanics::plain;
use crate::model::Model;
use crate::spatial::Pose;
use crate::symbolic::{Expr, Graph};

/// A robot, part by part.
#[derive(Clone, Debug)]
pub struct Recursion {
    /// The parts that move, carriers before what they carry.
    pub parts: Vec<Part>,
    /// What rotors add to M, on its diagonal; none without rotors.
    pub rotors: Option<Matrix>,
    /// What terms of one's own add to T and to V; those of bodies far out may be too long.
    pub terms: [Result<Form, Swelling>; 2],
    /// What the mass that stands still adds to V.
    pub potential_at_rest: Form,
    /// The forces of dampers, friction and springs on the left-hand side, nothing where nothing acts.
    pub passive: Option<Matrix>,
    /// `q̇(q,v)`, where speeds are no rates of coordinates.
    pub rates: Option<Matrix>,
}

/// A part that moves, seen from the one that carries it. Its frame is where [`Body`](super::Body) has it; between the parts of
/// a joint it is the joint's.
#[derive(Clone, Debug)]
pub struct Part {
    /// The name of the body, or of the joint.
    pub name: String,
    /// What is welded to it.
    pub welded: Vec<String>,
    /// The part that carries it; none is the world.
    pub carrier: Option<usize>,
    /// `R′`, 3×3: from its axes to its carrier's.
    pub rotation: Matrix,
    /// `p′`, 3×1: the origin of its frame in its carrier's.
    pub translation: Matrix,
    /// `S`, 6×k: its twist against its carrier in its own frame, linear rows first, by the speeds of its joint.
    pub motion: Matrix,
    /// These speeds.
    pub speeds: std::ops::Range<usize>,
    /// Its mass; none has parts without mass and inertia.
    pub inertia: Option<Inertia>,
}

/// How a part resists, about the origin of its frame.
#[derive(Clone, Debug)]
pub struct Inertia {
    /// Mass, kg.
    pub mass: Form,
    /// `h = m·c`, where the frame is not at the centre of mass.
    pub first: Option<Matrix>,
    /// `𝓘`, 3×3.
    pub second: Matrix,
}

/// The parts of `model`, in the symbols of [`notation`](crate::mechanics::closed::notation).
///
/// # Errors
///
/// If there are more than [`MOST_PARTS`], or a part swells by itself.
pub fn recursion<'g>(
    model: &Model<'g>,
    graph: &'g Graph,
    notation: &Notation,
) -> Result<Recursion, Swelling> {
    let (tree, inputs) = (&model.tree, Inputs::of(model));
    if tree.links.len() > MOST_PARTS {
        return Err(Swelling);
    }
    let [q, v] = [Argument::Q, Argument::V].map(|argument| inputs.vector(graph, argument));
    let write = |exprs: &[Expr<'g>]| -> Result<Vec<Form>, Swelling> {
        Ok(close(graph, &mut notation.clone(), exprs, WITHOUT_NAMES)?.forms)
    };
    let square =
        |forms: Vec<Form>, n: usize| Matrix::of_rows(forms.chunks(n).map(<[Form]>::to_vec).collect());
    let frames: Vec<Pose<Expr<'g>>> = (0..tree.links.len()).map(|k| origin(model, graph, k)).collect();
    let mut parts = Vec::with_capacity(tree.links.len());
    for (k, (link, info)) in tree.links.iter().zip(&model.links).enumerate() {
        let seen = plain::pose_in_parent(link, &q) * frames[k];
        let pose = link.parent.map_or(seen, |parent| frames[parent].inverse() * seen);
        let columns: Vec<_> = plain::motion_subspace(link)
            .into_iter()
            .map(|(_, S)| plain::Matrix6::adjoint(frames[k].inverse()) * S)
            .collect();
        let motion: Vec<Expr<'g>> =
            (0..6).flat_map(|row| columns.iter().map(move |column| column.0[row])).collect();
        let own = link.inertia.transformed(frames[k].inverse());
        let (mass, second) = (own.mass, own.rotational().full().0);
        let is_central = !mass.is_zero() && !is_sum(graph, mass);
        let has_inertia = !mass.is_zero() || !second.concat().iter().all(|entry| entry.is_zero());
        let inertia = match has_inertia {
            false => None,
            true => Some(Inertia {
                mass: write(&[mass])?.swap_remove(0),
                first: if is_central { None } else { Some(Matrix::vector(write(&own.first.0)?)) },
                second: square(write(&second.concat())?, 3),
            }),
        };
        let others = tree.frames.iter().enumerate();
        let others = others.filter(|(at, frame)| frame.link == Some(k) && Some(*at) != info.body);
        parts.push(Part {
            name: info.body.map_or_else(|| info.joint.clone(), |body| tree.frames[body].name.clone()),
            welded: others.map(|(_, frame)| frame.name.clone()).collect(),
            carrier: link.parent,
            rotation: square(write(&pose.rotation.0.concat())?, 3),
            translation: Matrix::vector(write(&pose.translation.0)?),
            motion: square(write(&motion)?, columns.len()),
            speeds: link.drive.v..link.drive.v + columns.len(),
            inertia,
        });
    }
    let rest = -tree.gravity.dot(tree.base.first);
    let terms = [plain::kinetic_terms(tree, &q, &v), plain::potential_terms(tree, &q)];
    let [kinetic, potential] = terms.map(|term| Ok(write(&[term])?.swap_remove(0)));
    let some = |exprs: Vec<Expr<'g>>| -> Result<Option<Matrix>, Swelling> {
        let is_there = exprs.iter().any(|expr| !expr.is_zero());
        if is_there { Ok(Some(Matrix::vector(write(&exprs)?))) } else { Ok(None) }
    };
    let ones = vec![Expr::ONE; inputs.dof];
    Ok(Recursion {
        parts,
        rotors: some(plain::passive::rotors(tree, &ones))?,
        terms: [kinetic, potential],
        potential_at_rest: write(&[rest])?.swap_remove(0),
        passive: some(plain::passive::forces(tree, &q, &v))?,
        rates: if tree.is_one_dof() { None } else { some(tree.configuration_rate(&q, &v))? },
    })
}
