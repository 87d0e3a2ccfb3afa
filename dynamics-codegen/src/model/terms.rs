//! Terms of the energies: whether they are ones, and what they mean.

use super::energies::{Term, Terms};
use super::topology::WORLD;
use super::values::{Result, Values, for_each_name, is_pi};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place, did_you_mean};
use crate::spec::{Formula, FormulaKind, JointKind, JointSpec, Moving, Name, RobotSpec, TermKind, TermSpec};
use crate::symbolic::Expr;

/// Checks all terms, before there is a tree; those that have no mistake of their own.
pub(super) fn check<'s>(spec: &'s RobotSpec, diags: &mut Diagnostics) -> Vec<&'s Formula> {
    let ambiguous = ambiguous(spec, diags);
    let mut is_sound = |term: &&TermSpec| {
        let before = diags.len();
        let judge = Judge { spec, kind: term.kind };
        judge.names(&term.formula, false, diags);
        let mut is_clear = true;
        for_each_name(&term.formula, &mut |name| is_clear &= !ambiguous.contains(&&*name.text));
        diags.len() == before && is_clear && diags.keep(judge.whole(term)).is_some()
    };
    spec.terms.iter().filter(&mut is_sound).map(|term| &term.formula).collect()
}

/// Names in terms that a field has, and a joint: each is complained about once, where it comes first.
fn ambiguous<'s>(spec: &'s RobotSpec, diags: &mut Diagnostics) -> Vec<&'s str> {
    let mut found: Vec<&str> = vec![];
    for term in &spec.terms {
        for_each_name(&term.formula, &mut |name| {
            let field = spec.fields.iter().find(|field| field.name.text == name.text);
            let joint = spec.joints.iter().find(|joint| joint.name.text == name.text);
            if let (Some(field), Some(joint)) = (field, joint)
                && !found.contains(&&*field.name.text)
            {
                let what = if joint.is_bare { "coordinate" } else { "joint" };
                let message = format!("`{name}` is a field, and a {what}");
                let ambiguous = Diagnostic::new(Code::NameAmbiguous, &name.place, message);
                diags.push(ambiguous.help(format!("give the field or the {what} another name")));
                found.push(&field.name.text);
            }
        });
    }
    found
}

/// What judges one term.
struct Judge<'s> {
    spec: &'s RobotSpec,
    kind: TermKind,
}

impl<'s> Judge<'s> {
    fn joint(&self, name: &Name) -> Option<&'s JointSpec> {
        self.spec.joints.iter().find(|joint| joint.name.text == name.text)
    }

    /// Every name is one, and stands where it may.
    fn names(&self, formula: &Formula, in_rate: bool, diags: &mut Diagnostics) {
        match &formula.kind {
            FormulaKind::Number(..) => {}
            FormulaKind::Name(name) => drop(diags.keep(self.name(name))),
            FormulaKind::Negative(inner) | FormulaKind::Call(_, inner) | FormulaKind::Power(inner, _) => {
                self.names(inner, in_rate, diags);
            }
            FormulaKind::Sum(terms) => {
                terms.iter().for_each(|term| self.names(&term.formula, in_rate, diags));
            }
            FormulaKind::Product(factors) => {
                factors.iter().for_each(|factor| self.names(&factor.formula, in_rate, diags));
            }
            FormulaKind::Moving(moving) => self.moving(moving, &formula.place, in_rate, diags),
        }
    }

    fn moving(&self, moving: &Moving, place: &Place, in_rate: bool, diags: &mut Diagnostics) {
        match moving {
            Moving::Part(joint, part) => {
                if diags.keep(self.part(joint, part)) == Some(Part::Speed) {
                    self.speed(place, &format!("{joint}.{part}"), in_rate, diags);
                }
            }
            Moving::Rate(of) => {
                self.speed(place, "dot(…)", in_rate, diags);
                let before = diags.len();
                self.names(of, true, diags);
                // Of what nobody knows it is not known whether it moves.
                if diags.len() == before && !self.moves(of) && !has_speed(of) {
                    let message = format!("`dot({})` is the rate of what does not move", of.short_text());
                    diags.error(Code::TermIdle, place, message);
                }
            }
            Moving::Distance(bodies) => {
                let [a, b] = &**bodies;
                let known: Vec<_> =
                    [a, b].into_iter().filter_map(|name| diags.keep(self.body(name))).collect();
                if known.len() == 2 && a.text == b.text {
                    let message = format!("`distance({a}, {b})` is always zero");
                    diags.error(Code::TermIdle, place, message);
                }
            }
            Moving::Place(_, body) => drop(diags.keep(self.body(body))),
        }
    }

    fn name(&self, name: &Name) -> Result<()> {
        let is_field = self.spec.fields.iter().any(|field| field.name.text == name.text);
        match (is_field, self.joint(name)) {
            (true, _) => Ok(()),
            (false, Some(joint)) if joint.kind.speeds() == 1 => Ok(()),
            (false, Some(joint)) => Err(whole_joint(joint, &name.place)),
            (false, None) if is_pi(name) => Ok(()),
            (false, None) => Err(self.unknown(name, "there is neither a field nor a joint")),
        }
    }

    fn unknown(&self, name: &Name, fact: &str) -> Diagnostic {
        let (fields, joints) = (&self.spec.fields, &self.spec.joints);
        let known = fields.iter().map(|field| &*field.name.text);
        let known = known.chain(joints.iter().map(|joint| &*joint.name.text)).take(NAMES_TO_COMPARE);
        Diagnostic::new(Code::NameUnknown, &name.place, format!("{fact} `{name}`")).suggest(&name.text, known)
    }

    fn part(&self, name: &Name, part: &Name) -> Result<Part> {
        let Some(joint) = self.joint(name) else { return Err(self.unknown(name, "there is no joint")) };
        let kind = joint.kind;
        if kind.speeds() <= 1 {
            let message = format!("the joint `{name}` has one coordinate, and no part `{part}`");
            let unfit = Diagnostic::new(Code::CoordinateUnfit, &part.place, message);
            return Err(match kind.speeds() {
                0 => whole_joint(joint, &name.place),
                _ => unfit.help(format!("write `{name}`, and `dot({name})` for its speed")),
            });
        }
        if is_of_quaternion(&part.text) && kind.coordinate_parts().contains(&&*part.text) {
            let message =
                format!("`{name}.{part}` is a part of a quaternion, of which two mean one orientation");
            let unfit = Diagnostic::new(Code::CoordinateUnfit, &part.place, message);
            return Err(unfit.help(
                "say it by places of bodies, as in `z(body)` or `distance(a, b)`, or make the joint of `revolute` ones",
            ));
        }
        if kind.coordinate_parts().contains(&&*part.text) {
            return Ok(Part::Coordinate);
        }
        if kind.speed_parts().contains(&&*part.text) {
            return Ok(Part::Speed);
        }
        let message = format!("the joint `{name}` has no part `{part}`");
        let known = parts(kind);
        let unfit = Diagnostic::new(Code::CoordinateUnfit, &part.place, message);
        let listed = known.iter().map(|part| format!("`{name}.{part}`")).collect::<Vec<_>>().join(", ");
        let unfit = unfit.help(format!("use one of {listed}"));
        Err(match did_you_mean(&part.text, known.iter().copied()) {
            Some(close) => unfit.help(format!("did you mean `{name}.{close}`?")),
            None => unfit,
        })
    }

    fn body(&self, name: &Name) -> Result<()> {
        let known = || self.spec.joints.iter().filter(|joint| !joint.is_bare).map(|joint| &*joint.child.text);
        if name.text == WORLD || known().any(|known| known == name.text) {
            return Ok(());
        }
        let unknown = Diagnostic::new(Code::FrameUnknown, &name.place, format!("there is no body `{name}`"));
        Err(unknown.suggest(&name.text, known().chain([WORLD]).take(NAMES_TO_COMPARE)))
    }

    /// A speed stands where it may.
    fn speed(&self, place: &Place, text: &str, in_rate: bool, diags: &mut Diagnostics) {
        let wrong = if in_rate {
            let message = format!("`{text}` is a speed, and its rate an acceleration");
            Diagnostic::new(Code::SpeedMisplaced, place, message)
                .help("take the rate of coordinates and places")
        } else if self.kind == TermKind::Potential {
            let message = format!("`{text}` is a speed, and stands in a potential");
            Diagnostic::new(Code::SpeedMisplaced, place, message)
        } else {
            return;
        };
        diags.push(wrong);
    }

    /// Whether anything in it depends on the configuration.
    fn moves(&self, formula: &Formula) -> bool {
        match &formula.kind {
            FormulaKind::Number(..) => false,
            FormulaKind::Name(name) => self.joint(name).is_some(),
            FormulaKind::Negative(inner) | FormulaKind::Call(_, inner) | FormulaKind::Power(inner, _) => {
                self.moves(inner)
            }
            FormulaKind::Sum(terms) => terms.iter().any(|term| self.moves(&term.formula)),
            FormulaKind::Product(factors) => factors.iter().any(|factor| self.moves(&factor.formula)),
            FormulaKind::Moving(Moving::Part(_, part)) => !is_speed(part),
            FormulaKind::Moving(_) => true,
        }
    }

    /// The whole of it is a term of its kind.
    fn whole(&self, TermSpec { kind, formula, .. }: &TermSpec) -> Result<()> {
        let text = formula.short_text();
        let idle = |lack: &str| {
            let message = format!("the {} `{text}` depends on no {lack}", kind.noun());
            Err(Diagnostic::new(Code::TermIdle, &formula.place, message))
        };
        match kind {
            TermKind::Potential if !self.moves(formula) => idle("coordinate"),
            TermKind::Dissipation if !has_speed(formula) => idle("speed"),
            TermKind::Kinetic => match degree(formula)? {
                2 => Ok(()),
                degree => {
                    let message = format!("the kinetic term `{text}` is of degree {degree} in the speeds");
                    Err(Diagnostic::new(Code::NotQuadratic, &formula.place, message))
                }
            },
            _ => Ok(()),
        }
    }
}

impl TermKind {
    fn noun(self) -> &'static str {
        match self {
            Self::Potential => "potential",
            Self::Dissipation => "dissipation",
            Self::Kinetic => "kinetic term",
        }
    }
}

/// Only so many names are compared with one that is not known.
const NAMES_TO_COMPARE: usize = 1000;

/// What a part of a joint is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Coordinate,
    Speed,
}

/// Ball and free joints have speeds of their own, and these names.
fn is_speed(part: &Name) -> bool {
    [JointKind::Ball, JointKind::Free].iter().any(|kind| kind.speed_parts().contains(&&*part.text))
}

fn is_of_quaternion(part: &str) -> bool {
    JointKind::Ball.coordinate_parts().contains(&part)
}

/// The parts of a joint that may stand in a term.
fn parts(kind: JointKind) -> Vec<&'static str> {
    let own = kind.coordinate_parts().iter().copied().filter(|part| !is_of_quaternion(part));
    let speeds = kind.speed_parts().iter().copied().filter(|part| !kind.coordinate_parts().contains(part));
    own.chain(speeds).collect()
}

/// The mistake that a joint stands alone which has several coordinates, or none.
fn whole_joint(joint: &JointSpec, place: &Place) -> Diagnostic {
    let name = &joint.name;
    if joint.kind.speeds() == 0 {
        let message = format!("the joint `{name}` is fixed, and has no coordinate");
        let unfit = Diagnostic::new(Code::CoordinateUnfit, place, message);
        return unfit.help("name a joint that moves, or ask where a body is: `distance(a, b)`, `z(body)`");
    }
    let message = format!("the joint `{name}` has {} coordinates", joint.kind.coordinates());
    let named: Vec<_> = parts(joint.kind).iter().map(|part| format!("`{name}.{part}`")).collect();
    Diagnostic::new(Code::CoordinateUnfit, place, message).help(format!("name one of {}", named.join(", ")))
}

fn has_speed(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Number(..) | FormulaKind::Name(_) => false,
        FormulaKind::Negative(inner) | FormulaKind::Call(_, inner) | FormulaKind::Power(inner, _) => {
            has_speed(inner)
        }
        FormulaKind::Sum(terms) => terms.iter().any(|term| has_speed(&term.formula)),
        FormulaKind::Product(factors) => factors.iter().any(|factor| has_speed(&factor.formula)),
        FormulaKind::Moving(Moving::Rate(_)) => true,
        FormulaKind::Moving(Moving::Part(_, part)) => is_speed(part),
        FormulaKind::Moving(_) => false,
    }
}

/// The degree of a form in the speeds.
fn degree(formula: &Formula) -> Result<u32> {
    let not_a_form = |formula: &Formula, message: String| {
        Err(Diagnostic::new(Code::NotQuadratic, &formula.place, message))
    };
    match &formula.kind {
        FormulaKind::Number(..) | FormulaKind::Name(_) => Ok(0),
        FormulaKind::Negative(inner) => degree(inner),
        FormulaKind::Sum(terms) => {
            let degrees = terms.iter().map(|term| degree(&term.formula)).collect::<Result<Vec<_>>>()?;
            let other = degrees.iter().position(|degree| *degree != degrees[0]);
            let Some(other) = other else { return Ok(degrees[0]) };
            let (one, at) = (terms[0].formula.short_text(), &terms[other].formula);
            let message = format!(
                "`{one}` is of degree {} in the speeds, and `{}` of degree {}",
                degrees[0],
                at.short_text(),
                degrees[other]
            );
            not_a_form(at, message)
        }
        FormulaKind::Product(factors) => {
            let mut sum = 0;
            for factor in factors {
                let own = degree(&factor.formula)?;
                if factor.divides && own > 0 {
                    let message = format!("`{}` is a speed, and divides", factor.formula.short_text());
                    return not_a_form(&factor.formula, message);
                }
                sum += own;
            }
            Ok(sum)
        }
        FormulaKind::Power(base, exponent) => match (degree(base)?, u32::try_from(*exponent)) {
            (0, _) => Ok(0),
            (own, Ok(exponent)) => Ok(own * exponent),
            (_, Err(_)) => {
                let message = format!("`{}` is a speed, and divides", base.short_text());
                not_a_form(formula, message)
            }
        },
        FormulaKind::Call(function, inner) => match degree(inner)? {
            0 => Ok(0),
            _ => not_a_form(formula, format!("`{}` of speeds is no form of them", function.name())),
        },
        FormulaKind::Moving(Moving::Rate(_)) => Ok(1),
        FormulaKind::Moving(Moving::Part(_, part)) => Ok(is_speed(part).into()),
        FormulaKind::Moving(_) => Ok(0),
    }
}

/// Where a joint's coordinates are, as terms need it.
#[derive(Clone, Copy)]
pub(super) struct Whereabouts<'g> {
    /// The first coordinate and the first speed; of what stands still, none.
    pub(super) start: Option<(usize, usize)>,
    /// Of a joint of one degree of freedom its coordinate for the robot's.
    pub(super) ratio: Expr<'g>,
    /// The same where the robot's is zero.
    pub(super) offset: Expr<'g>,
}

/// What makes terms of formulas.
pub(super) struct Meaning<'a, 'g> {
    pub(super) spec: &'a RobotSpec,
    pub(super) values: &'a Values<'a, 'g>,
    /// For each joint of the specification.
    pub(super) courses: &'a [Whereabouts<'g>],
    /// The frames of the tree, by their names.
    pub(super) frame: &'a dyn Fn(&str) -> Option<usize>,
}

impl<'g> Meaning<'_, 'g> {
    /// All terms.
    pub(super) fn terms(&self, diags: &mut Diagnostics) -> Terms<Expr<'g>> {
        let mut terms = Terms::none();
        for TermSpec { kind, formula, .. } in &self.spec.terms {
            let Some(term) = diags.keep(self.term(formula)) else { continue };
            match kind {
                TermKind::Potential => terms.potential.push(term),
                TermKind::Dissipation => terms.dissipation.push(term),
                TermKind::Kinetic => terms.kinetic.push(term),
            }
        }
        terms
    }

    fn is_still(&self, formula: &Formula) -> bool {
        let mut still = !has_moving(formula);
        for_each_name(formula, &mut |name| still &= self.values.joint(name).is_none());
        still
    }

    fn term(&self, formula: &Formula) -> Result<Term<Expr<'g>>> {
        if self.is_still(formula) {
            return Ok(Term::Still(self.values.scalar(formula)?));
        }
        Ok(match &formula.kind {
            FormulaKind::Number(..) => Term::Still(self.values.scalar(formula)?),
            FormulaKind::Name(name) => self.coordinate(name, 0, false),
            FormulaKind::Negative(inner) => Term::Negative(Box::new(self.term(inner)?)),
            FormulaKind::Sum(terms) => {
                let term = |term: &crate::spec::Term| {
                    let value = self.term(&term.formula)?;
                    Ok(if term.negative { Term::Negative(Box::new(value)) } else { value })
                };
                Term::Sum(terms.iter().map(term).collect::<Result<_>>()?)
            }
            FormulaKind::Product(factors) => {
                // What does not move is one number, however it is written.
                let (still, moving): (Vec<_>, Vec<_>) =
                    factors.iter().cloned().partition(|factor| self.is_still(&factor.formula));
                let place = formula.place.clone();
                let mut above = match still.is_empty() {
                    true => vec![],
                    false => {
                        let kind = FormulaKind::Product(still);
                        vec![Term::Still(self.values.scalar(&Formula { kind, place })?)]
                    }
                };
                let mut below = vec![];
                for factor in &moving {
                    let value = self.term(&factor.formula)?;
                    if factor.divides { below.push(value) } else { above.push(value) }
                }
                let above = Term::Product(above);
                match below.is_empty() {
                    true => above,
                    false => Term::Quotient(Box::new([above, Term::Product(below)])),
                }
            }
            FormulaKind::Call(function, inner) => Term::Call(*function, Box::new(self.term(inner)?)),
            FormulaKind::Power(base, exponent) => {
                let power = Term::Power(Box::new(self.term(base)?), exponent.unsigned_abs());
                match *exponent < 0 {
                    true => Term::Quotient(Box::new([Term::Still(Expr::ONE), power])),
                    false => power,
                }
            }
            FormulaKind::Moving(moving) => self.moving(moving)?,
        })
    }

    fn moving(&self, moving: &Moving) -> Result<Term<Expr<'g>>> {
        let frame = |name: &Name| (self.frame)(&name.text);
        Ok(match moving {
            Moving::Part(joint, part) => {
                let kind =
                    self.spec.joints.iter().find(|known| known.name.text == joint.text).map(|j| j.kind);
                let of = |parts: &[&str]| parts.iter().position(|known| part.text == *known);
                let at = kind.and_then(|kind| of(kind.coordinate_parts()));
                match (at, kind.and_then(|kind| of(kind.speed_parts()))) {
                    (Some(index), _) => self.coordinate(joint, index, kind == Some(JointKind::Free)),
                    (None, Some(index)) => match self.course(joint).start {
                        Some((_, v)) => Term::Speed(v + index),
                        None => Term::Still(Expr::ZERO),
                    },
                    (None, None) => Term::Still(Expr::ZERO),
                }
            }
            Moving::Rate(of) => Term::Rate(Box::new(self.term(of)?)),
            Moving::Distance(bodies) => Term::Distance([frame(&bodies[0]), frame(&bodies[1])]),
            Moving::Place(axis, body) => match frame(body) {
                Some(frame) => Term::Place(*axis, frame),
                None => Term::Still(Expr::ZERO),
            },
        })
    }

    fn course(&self, name: &Name) -> Whereabouts<'g> {
        let at = self.spec.joints.iter().position(|joint| joint.name.text == name.text);
        at.map_or(Whereabouts { start: None, ratio: Expr::ONE, offset: Expr::ZERO }, |at| self.courses[at])
    }

    /// A coordinate of a joint; the position of a free one changes with all its linear speeds.
    fn coordinate(&self, name: &Name, index: usize, is_position: bool) -> Term<Expr<'g>> {
        let Whereabouts { start, ratio, offset } = self.course(name);
        let Some((q, v)) = start else { return Term::Still(offset) };
        let v = if is_position { (v, v + 3) } else { (v + index, v + index + 1) };
        Term::Coordinate { q: q + index, v, ratio, offset }
    }
}

/// Whether anything in it is what only terms have.
fn has_moving(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Number(..) | FormulaKind::Name(_) => false,
        FormulaKind::Negative(inner) | FormulaKind::Call(_, inner) | FormulaKind::Power(inner, _) => {
            has_moving(inner)
        }
        FormulaKind::Sum(terms) => terms.iter().any(|term| has_moving(&term.formula)),
        FormulaKind::Product(factors) => factors.iter().any(|factor| has_moving(&factor.formula)),
        FormulaKind::Moving(_) => true,
    }
}
