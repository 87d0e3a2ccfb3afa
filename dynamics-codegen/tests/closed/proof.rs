//! The closed form, the generated code and Lagrange's equations are one and the same, exactly.
//!
//! All are evaluated in a finite field. Of the generated code this is done twice: of the expressions that programs are made
//! of, the last place where numbers are exact; and of the programs, with the simplest fraction for each rounded constant.

use dynamics_codegen::closed::{Form, Matrix, Notation};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::closed_forms;
use dynamics_codegen::mechanics::equations::{Argument, Inputs, Method};
use dynamics_codegen::mechanics::lagrange;
use dynamics_codegen::passes::{Plan, RunTime};
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::symbolic::{Expr, Graph, SymbolId};
use dynamics_codegen::{checked, model, spec};

use super::field::{Point, Value};
use super::robots;

const POINTS: u64 = 4;

pub(crate) fn spec_of(source: &str) -> RobotSpec {
    let input: syn::DeriveInput = syn::parse_str(source).unwrap();
    let mut diags = Diagnostics::new();
    let spec = spec::parse(&input, &mut diags);
    diags.check().unwrap();
    spec
}

fn entries(matrix: &Matrix) -> Vec<Form> {
    let entry = |row, column| matrix.entry(row, column).clone();
    (0..matrix.rows()).flat_map(|row| (0..matrix.columns()).map(move |column| entry(row, column))).collect()
}

/// What one method computes, in closed form and by Lagrange's equations.
struct Claim<'g> {
    method: Method,
    forms: Vec<Form>,
    lagrange: Vec<Expr<'g>>,
}

/// What could be proved of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Proof {
    /// Nothing: it has numbers that are floats to the compiler, or is too large to be written.
    None,
    /// That the closed form is what Lagrange's equations say, and the expressions of the programs.
    OfExpressions,
    /// That it is what the programs compute, too: their constants could be told from their doubles.
    OfPrograms,
}

fn proof(name: &str, source: &str) -> Proof {
    let spec = spec_of(source);
    let graph = Graph::new();
    let (model, compiled) = checked(&spec, &graph, RunTime::Core).unwrap();
    let Ok(closed) = closed_forms(&model, &graph) else { return Proof::None };
    let inputs = Inputs::of(&model);

    let other = Graph::new();
    let mut diags = Diagnostics::new();
    let again = model::build(&spec, &other, &mut diags).unwrap();
    diags.check().unwrap();
    let symbols = |argument| -> Vec<SymbolId> {
        (0..inputs.size(argument)).map(|k| inputs.symbol(argument, k)).collect()
    };
    let (q, v, a) = (symbols(Argument::Q), symbols(Argument::V), symbols(Argument::A));
    let derived = lagrange::derive(&other, &again.tree, lagrange::Coordinates { q: &q, v: &v, a: &a });
    let claim = |method, forms, lagrange| Claim { method, forms, lagrange };
    let (n, [v_of, a_of]) =
        (inputs.dof, [&v, &a].map(|ids| ids.iter().map(|&id| other.symbol(id)).collect::<Vec<_>>()));
    let passive: Vec<Expr<'_>> = (0..n)
        .map(|i| {
            let moved =
                (0..n).map(|j| derived.mass_matrix[i][j] * a_of[j] + derived.coriolis_matrix[i][j] * v_of[j]);
            moved.fold(derived.inverse_dynamics[i] - derived.gravity_forces[i], |left, force| left - force)
        })
        .collect();
    // Friction has a square root of the speed, which the field has for half of its numbers.
    let is_rational = |forms: &[Form]| {
        (0..POINTS).all(|seed| {
            let point = Point::new(&closed.notation, 0x5EED + seed);
            forms.iter().all(|form| point.form(form).is_some())
        })
    };
    let of_passive = closed.passive_forces.as_ref().map(entries).filter(|forms| is_rational(forms));
    let mut claims = vec![
        claim(Method::MassMatrix, entries(&closed.mass_matrix), derived.mass_matrix.concat()),
        claim(Method::CoriolisMatrix, entries(&closed.coriolis_matrix), derived.coriolis_matrix.concat()),
        claim(Method::GravityForces, entries(&closed.gravity_forces), derived.gravity_forces.clone()),
        claim(Method::KineticEnergy, vec![closed.kinetic_energy.clone()], vec![derived.kinetic_energy]),
        claim(Method::PotentialEnergy, vec![closed.potential_energy.clone()], vec![derived.potential_energy]),
        claim(
            Method::Lagrangian,
            vec![closed.lagrangian.clone()],
            vec![derived.kinetic_energy - derived.potential_energy],
        ),
    ];
    claims.extend(of_passive.map(|forms| claim(Method::PassiveForces, forms, passive)));
    let mut proof = Proof::OfPrograms;
    for seed in 0..POINTS {
        let mut point = Point::new(&closed.notation, 0x5EED + seed);
        for (symbol, form) in &closed.definitions {
            if point.define(*symbol, form).is_none() {
                return Proof::None;
            }
        }
        let preparation = point.program(&compiled.companion.preparation, inputs, &[]);
        for Claim { method, forms, lagrange } in &claims {
            let Some(by_lagrange) = point.exprs(&other, lagrange) else { return Proof::None };
            let written: Option<Vec<Value>> = forms.iter().map(|form| point.form(form)).collect();
            let written: Vec<u64> = written.unwrap().iter().map(|value| value.residue).collect();
            assert_eq!(written, by_lagrange, "{name}: {method:?} by Lagrange's equations");

            let found = compiled.methods.iter().find(|compiled| compiled.method == *method).unwrap();
            let Plan::StraightLine { blocks, program } = &found.plan else { panic!("it is small") };
            let exprs: Vec<Expr<'_>> =
                blocks.iter().flat_map(|block| block.entries.iter().copied()).collect();
            let Some(by_code) = point.exprs(&graph, &exprs) else { return Proof::None };
            assert_eq!(written, by_code, "{name}: {method:?} in the expressions of its program");
            let run = preparation.as_deref().and_then(|fields| point.program(program, inputs, fields));
            match run {
                Some(run) => {
                    let run: Vec<u64> = run.iter().map(|value| value.residue).collect();
                    assert_eq!(written, run, "{name}: {method:?} in its program");
                }
                None => proof = Proof::OfExpressions,
            }
        }
    }
    proof
}

#[test]
fn closed_forms_are_what_the_code_computes() {
    let found: Vec<_> = robots::ROBOTS.iter().map(|(name, source)| (*name, proof(name, source))).collect();
    let of = |wanted: Proof| -> Vec<&str> {
        found.iter().filter(|(_, proof)| *proof == wanted).map(|(name, _)| *name).collect()
    };
    // All whose numbers are fractions; the others are compared in doubles.
    let all_the_way = [
        "pendulum",
        "cart_pole",
        "acrobot",
        "double_pendulum",
        "planar_3r",
        "planar_scara",
        "spherical_arm",
        "robo_judge",
        "point_mass",
        "planar_body",
        "any_toss",
        "free_box",
        "cart_with_motor",
        "two_link_arm",
        "ball_toss",
        "pendulum_on_cart",
        "pulley",
    ];
    assert_eq!(of(Proof::OfPrograms), all_the_way);
    // By way of names for parts, and with constants of many digits, or roots.
    assert_eq!(of(Proof::OfExpressions), ["stanford_arm", "inclined_pendulum"]);
}

/// A wrong sign is seen.
#[test]
fn the_field_sees_what_is_wrong() {
    let spec = spec_of(robots::ROBOTS.iter().find(|(name, _)| *name == "robo_judge").unwrap().1);
    let graph = Graph::new();
    let (model, _) = checked(&spec, &graph, RunTime::Core).unwrap();
    let closed = closed_forms(&model, &graph).unwrap();
    let value = |form: &Form, notation: &Notation| Point::new(notation, 7).form(form).unwrap().residue;
    let right = "I_z₁ + I_y₂ sin²θ₂ + I_z₂ cos²θ₂ + m₂ r₁² cos²θ₂";
    let n = &closed.notation;
    let entry = closed.mass_matrix.entry(0, 0);
    assert_eq!(value(&Form::parse_unicode(right, n).unwrap(), n), value(entry, n));
    // The slip of the lecture's print.
    let wrong = Form::parse_unicode(&right.replace("r₁²", "r₁"), n).unwrap();
    assert_ne!(value(&wrong, n), value(entry, n));
}
