//! The words around a derivation: from the figure of a robot to its equations, as a lecture walks.
//!
//! A sentence stands only where it is true of the robot before it: of what the robot has not, nothing is said.

mod bodies;
mod equations;
mod figure;
mod linear;
mod recursion;

use dynamics_codegen::closed::{Form, Matrix};
use dynamics_codegen::mechanics::equations::{Argument, Inputs};
use dynamics_codegen::mechanics::lecture::{Body, Equations, Lecture, MOST_LINEAR, MOST_PARTS, NoLinear};
use dynamics_codegen::mechanics::letters::own;
use dynamics_codegen::model::{Model, Passive};
use dynamics_codegen::symbolic::Expr;

use super::document::{Block, Math, Side, indexed, math, words};
use crate::digits::{DIGITS, is_rounded};

/// Writes all steps, to the one that would be too long.
pub(super) fn document(model: &Model<'_>, lecture: &Lecture) -> Vec<Block> {
    let mut text = Text { model, lecture, blocks: vec![], sections: 0 };
    text.title();
    text.figure();
    text.steps();
    text.rounded()
}

struct Text<'d, 'g> {
    model: &'d Model<'g>,
    lecture: &'d Lecture,
    blocks: Vec<Block>,
    /// How many there are as yet.
    sections: usize,
}

impl Text<'_, '_> {
    fn heading(&mut self, title: &str) {
        self.sections += 1;
        self.blocks.push(Block::Heading(format!("{}. {title}", self.sections)));
    }

    fn text(&mut self, text: &str) {
        self.blocks.push(Block::Text(words(text)));
    }

    fn equation(&mut self, sides: impl IntoIterator<Item = Side>) {
        self.blocks.push(Block::Equation(sides.into_iter().collect()));
    }

    /// Whether every speed is the rate of a coordinate.
    fn is_flat(&self) -> bool {
        self.model.tree.is_one_dof()
    }

    /// What the speeds are called.
    fn speeds(&self) -> Math {
        if self.is_flat() { math("q̇", "\\dot q") } else { math("v", "v") }
    }

    /// What the accelerations are called.
    fn accelerations(&self) -> Math {
        if self.is_flat() { math("q̈", "\\ddot q") } else { math("v̇", "\\dot v") }
    }

    /// Whether anything has weight.
    fn is_heavy(&self) -> bool {
        let tree = &self.model.tree;
        let has_mass = tree.links.iter().map(|link| &link.inertia).chain([&tree.base]);
        has_mass
            .into_iter()
            .any(|inertia| !inertia.mass.is_zero() || !inertia.first.0.iter().all(|x| x.is_zero()))
    }

    fn has_gravity(&self) -> bool {
        self.is_heavy() && !self.model.tree.gravity.0.iter().all(|component| component.is_zero())
    }

    /// What acts in the joints by itself.
    fn passive(&self) -> Vec<String> {
        let tree = &self.model.tree;
        let acting = tree.links.iter().map(|link| &link.passive);
        let has = |of: fn(&Passive<Expr<'_>>) -> bool| acting.clone().any(of);
        let parts = [
            (has(|passive| !passive.damping.is_zero()), "dampers"),
            (has(|passive| !passive.friction.is_zero()), "friction"),
            (has(|passive| !passive.stiffness.is_zero()), "springs"),
            (!tree.terms.dissipation.is_empty(), "the terms of the dissipation"),
        ];
        parts.into_iter().filter(|(is_there, _)| *is_there).map(|(_, name)| name.to_owned()).collect()
    }

    fn is_passive(&self) -> bool {
        !self.passive().is_empty()
    }

    fn symbol(&self, argument: Argument, k: usize) -> Form {
        Form::Symbol(Inputs::of(self.model).symbol(argument, k))
    }

    fn written(&self, form: &Form) -> Math {
        let notation = &self.lecture.notation;
        math(own(&form.unicode(notation)), own(&form.latex(notation)))
    }

    fn title(&mut self) {
        self.blocks.push(Block::Title(words(&format!("The equations of motion of `{}`", self.model.name))));
        let dof = self.model.tree.dof();
        let degrees =
            if dof == 1 { "one degree of freedom".to_owned() } else { format!("{dof} degrees of freedom") };
        self.text(&format!("A robot of {degrees}. All is in SI units and radians."));
    }

    fn steps(&mut self) {
        let lecture = self.lecture;
        match (&lecture.bodies, &lecture.equations, &lecture.recursion) {
            (Ok(bodies), Ok(equations), _) => self.in_closed_form(bodies, equations),
            (Err(long), ..) | (_, Err(long), _) => match &lecture.recursion {
                Some(Ok(recursion)) => {
                    self.no_closed_form(long);
                    self.by_recursion(recursion);
                }
                _ => return self.too_long(),
            },
        }
        match &lecture.linear {
            Ok(linear) => self.linear(linear),
            Err(NoLinear::Swelling) => self.text(&format!(
                "The linear model would be too long to be read: it is written for up to {MOST_LINEAR} degrees of freedom, as long \
                 as no entry of its matrices swells. `dynamics report` has it in numbers."
            )),
            Err(NoLinear::Singular) => self.text(
                "There is no linear model where all coordinates are zero: M is singular there, so that some motion has no \
                 inertia.",
            ),
            Err(NoLinear::NotSmooth) => self.text(
                "There is no linear model where all coordinates are zero: a term of the energies has no derivative there.",
            ),
        }
    }

    fn in_closed_form(&mut self, bodies: &[Body], equations: &Equations) {
        if !bodies.is_empty() {
            self.poses(bodies);
            self.jacobians(bodies);
        }
        self.energies(bodies);
        self.sums(bodies, equations);
        self.mass_matrix(bodies, equations);
        self.coriolis(equations);
        self.potential(equations);
        self.lagrange(equations);
        self.state_space(&Sides {
            turns: !is_zero(&equations.coriolis_matrix),
            pulls: !is_zero(&equations.gravity_forces),
            acts: equations.passive.is_some(),
            rates: equations.rates.as_ref(),
        });
    }

    /// Not even the recursion can be read.
    fn too_long(&mut self) {
        self.text(&format!(
            "What comes next would be too long to be read: {MOST_PARTS} parts that move are the most that are written out, and \
             this robot has {}, or one of them swells by itself. Numbers are there all the same, by `dynamics eval`, and the \
             code, by `dynamics generate`.",
            self.model.tree.links.len()
        ));
    }

    /// The blocks with numbers that people can read; if any is rounded, the first text says so.
    fn rounded(mut self) -> Vec<Block> {
        let is_rounded = self.blocks.iter().flat_map(Block::forms).any(is_rounded);
        if is_rounded && let Some(Block::Text(first)) = self.blocks.get_mut(1) {
            first.extend(words(&format!(
                " Numbers have up to {DIGITS} digits here, and are rounded where they would have more; the code that is generated \
                 has all of them."
            )));
        }
        self.blocks.iter_mut().for_each(Block::shorten);
        self.blocks
    }
}

/// What is on the left-hand side beside `M·a`, and what the rates of coordinates are.
struct Sides<'d> {
    /// Whether there is `C·v`.
    turns: bool,
    /// Whether there is `G`.
    pulls: bool,
    /// Whether there is `P`.
    acts: bool,
    /// `q̇`, where speeds are no rates.
    rates: Option<&'d Matrix>,
}

/// A letter of a body.
fn of(i: usize, unicode: &str, latex: &str) -> Side {
    Side::Math(indexed(unicode, latex, &[i], None))
}

/// A letter.
fn letter(unicode: &str, latex: &str) -> Side {
    Side::Math(math(unicode, latex))
}

/// Whether all entries are zero.
fn is_zero(matrix: &Matrix) -> bool {
    matrix.entries().all(|(_, _, form)| form.is_zero())
}

/// Things in a row: `a`, `a and b`, `a, b and c`.
fn listed(things: &[String]) -> String {
    match things {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}
