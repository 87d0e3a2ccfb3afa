//! Why an output has no value at a state.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::mechanics::plain::{Cholesky, Oracle, Rough, rough};
use dynamics_codegen::mechanics::singular::{idle_motion_at, is_idle_everywhere};
use dynamics_codegen::model::Tree;
use dynamics_codegen::passes::{Lack, RunTime, lacks};
use dynamics_codegen::spec::TermKind::{self, Dissipation, Kinetic, Potential};
use dynamics_codegen::spec::{RobotSpec, TermSpec};

use crate::failure::{Failure, Problem};
use crate::robot::{Robot, State};

/// Why there is no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Absence {
    /// Of this robot the method would be too long.
    TooLong,
    /// It would be too long but for loops, and these have no terms of the energies.
    LoopsWithoutTerms,
    /// It is about mass, and no body that moves has any.
    Massless,
    /// These speeds can be together without moving any mass: M(q) is singular.
    Idle(Vec<String>),
    /// The same in every configuration, to the digits of a double: what is nothing at all has been refused.
    AlwaysIdle(Vec<String>),
    /// Some motion has no energy, or less.
    Indefinite,
    /// A term of the energies has no derivative, or no value.
    Rough(String, String),
    /// A number is too large for a double.
    TooLarge,
}

impl Absence {
    /// Why a robot has no method of this name.
    pub(crate) fn of_method(method: Method, robot: &Robot<'_>) -> Self {
        let lack = lacks(&robot.model, RunTime::Core).into_iter().find(|(lacking, _)| *lacking == method);
        lack.map_or(Self::TooLong, |(_, lack)| lack.into())
    }

    /// The methods that a robot has not, by reason.
    pub(crate) fn of_methods(robot: &Robot<'_>) -> Vec<(Self, Vec<String>)> {
        let mut reasons: Vec<(Self, Vec<String>)> = vec![];
        for (method, lack) in lacks(&robot.model, RunTime::Core) {
            let (why, name) = (Self::from(lack), method.name().to_owned());
            match reasons.iter_mut().find(|(known, _)| *known == why) {
                Some((_, methods)) => methods.push(name),
                None => reasons.push((why, vec![name])),
            }
        }
        reasons
    }

    /// Why a method that a robot has is not finite at a state.
    pub(crate) fn of(method: Method, state: &State, robot: &Robot<'_>) -> Self {
        if divides_by_mass(method)
            && let Some(why) = Self::of_inverse(robot, &robot.tree, state)
        {
            return why;
        }
        let concerned = |term: &TermSpec| has_terms(method, term.kind);
        rough_term(&robot.spec, &robot.tree, state, concerned).unwrap_or(Self::TooLarge)
    }

    /// Why M has no inverse at a state, if it has none.
    pub(crate) fn of_inverse(robot: &Robot<'_>, tree: &Tree<f64>, state: &State) -> Option<Self> {
        let mass_matrix = Oracle::new(tree).mass_matrix(&state.q);
        if !mass_matrix.iter().flatten().all(|entry| entry.is_finite()) {
            let is_kinetic = |term: &TermSpec| term.kind == Kinetic;
            return rough_term(&robot.spec, tree, state, is_kinetic).or(Some(Self::TooLarge));
        }
        if let Some(idle) = idle_motion_at(tree, &state.q) {
            let speeds = idle.into_iter().map(|k| robot.coordinates.v[k].clone()).collect();
            return Some(if is_idle_everywhere(tree) {
                Self::AlwaysIdle(speeds)
            } else {
                Self::Idle(speeds)
            });
        }
        Cholesky::of(&mass_matrix).is_none().then_some(Self::Indefinite)
    }

    /// The fact, for a sentence that says where.
    pub(crate) fn fact(&self) -> String {
        match self {
            Self::TooLong => "the program would be too long".to_owned(),
            Self::LoopsWithoutTerms => {
                "the program would be too long: with terms in the energies it is written without loops"
                    .to_owned()
            }
            Self::Massless => "no body that moves has mass".to_owned(),
            Self::Idle(speeds) => format!("M(q) is singular, since {}", idle(speeds)),
            Self::AlwaysIdle(speeds) => {
                format!("M(q) is singular to the digits of a double, at every `q`, since {}", idle(speeds))
            }
            Self::Indefinite => "M(q) is not positive definite".to_owned(),
            Self::Rough(term, why) => format!("`{term}` {why}"),
            Self::TooLarge => "numbers on the way become too large for a double".to_owned(),
        }
    }

    /// What to do now; the state was given by an option.
    pub(crate) fn help(&self, option: &str) -> String {
        let other = format!("choose another `q` by `{option}`");
        match self {
            Self::TooLong | Self::LoopsWithoutTerms | Self::Massless => {
                "name the outputs that are needed: `dynamics eval --only`".to_owned()
            }
            Self::Idle(speeds) if speeds.len() == 1 => format!("{other}, where it moves some mass"),
            Self::Idle(_) => {
                other + "; or, where turns meet in one point, write a `ball` joint, which has no such `q`"
            }
            Self::AlwaysIdle(speeds) => {
                format!("give a body that is moved by {} more mass or inertia", listed(speeds))
            }
            Self::Indefinite => format!("correct the inertias, or {other}"),
            Self::Rough(..) => {
                other
                    + ", or write a term that is smooth there, as with `distance(a, b)^2` or `sqrt(r^2 + 1e-6)`"
            }
            Self::TooLarge => format!("give smaller numbers to `{option}`"),
        }
    }

    /// What is wrong where outputs of these names are asked for.
    pub(crate) fn problem(&self, outputs: &[String]) -> Problem {
        let have = if outputs.len() == 1 { "has" } else { "have" };
        let title = format!("{} {have} no value at this state: {}", listed(outputs), self.fact());
        Problem::new(title).help(self.help("--state"))
    }
}

impl From<Lack> for Absence {
    fn from(lack: Lack) -> Self {
        match lack {
            Lack::TooLong => Self::TooLong,
            Lack::LoopsWithoutTerms => Self::LoopsWithoutTerms,
            Lack::Massless => Self::Massless,
        }
    }
}

/// A method without a value.
pub(crate) struct Absent {
    pub(crate) method: Method,
    pub(crate) why: Absence,
}

impl From<Absent> for Failure {
    fn from(Absent { method, why }: Absent) -> Self {
        why.problem(&[method.name().to_owned()]).into()
    }
}

/// What speeds do that move no mass.
fn idle(speeds: &[String]) -> String {
    match speeds {
        [only] => format!("`{only}` moves no mass"),
        _ => format!("{} can move together without moving any mass", listed(speeds)),
    }
}

/// As in "`a`, `b` and `c`".
pub(crate) fn listed(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Whether a method has M⁻¹ in it.
pub(crate) fn divides_by_mass(method: Method) -> bool {
    matches!(
        method,
        Method::InverseMassMatrix
            | Method::ForwardDynamics
            | Method::ForwardDynamicsDerivatives
            | Method::ForwardDynamicsWithDerivatives
    )
}

/// Whether terms of a kind are in a method.
fn has_terms(method: Method, kind: TermKind) -> bool {
    match method {
        Method::MassMatrix | Method::CoriolisMatrix | Method::KineticEnergy | Method::InverseMassMatrix => {
            kind == Kinetic
        }
        Method::GravityForces | Method::PotentialEnergy => kind == Potential,
        Method::PassiveForces => kind == Dissipation,
        _ => true,
    }
}

/// Of some of a robot's terms the first that has no value at a state, or no derivative.
pub(crate) fn rough_term(
    spec: &RobotSpec,
    tree: &Tree<f64>,
    state: &State,
    is_meant: impl Fn(&TermSpec) -> bool,
) -> Option<Absence> {
    let of_kind = |kind| spec.terms.iter().filter(move |term| term.kind == kind);
    let written = [Potential, Dissipation, Kinetic].into_iter().flat_map(of_kind);
    written.zip(tree.terms.all()).filter(|(term, _)| is_meant(term)).find_map(|(written, term)| {
        let why = match rough(term, tree, (&state.q, &state.v), |x| x <= 0.0)? {
            Rough::Division => "divides by zero".to_owned(),
            Rough::Distance => "has the distance of two points that meet, and so no derivative".to_owned(),
            Rough::Root(0.0) => "has the root of zero, and so no derivative".to_owned(),
            Rough::Root(x) => format!("has the root of {x:?}, which is no number"),
        };
        Some(Absence::Rough(written.formula.short_text(), why))
    })
}
