//! The values of a robot's fields, where its equations have any: `--set 'm1 = 4kg'`.

use dynamics_codegen::diagnostics::{Diagnostics, did_you_mean};
use dynamics_codegen::judged;
use dynamics_codegen::model::{Model, Parameter};
use dynamics_codegen::spec::{Formula, RobotSpec};
use dynamics_codegen::symbolic::{Graph, Number};

use crate::assignment::{Assignment, Kind};
use crate::failure::{Failure, Problem};
use crate::input::{Input, shown};
use crate::quantity::{Exponents, number};

/// `--set`
const SET: Kind = Kind {
    option: "set",
    example: "--set 'm1 = 4kg'",
    forms: "write a number, with its unit or in SI units: `m1 = 4kg`, `l = 0.3`",
    separates: true,
};

/// A field and its value, before it is known what the field is.
pub(crate) struct Setting {
    assignment: Assignment,
    formula: Formula,
}

/// What options say of fields, and all mistakes in them.
pub(crate) fn settings(texts: &[String]) -> Result<Vec<Setting>, Failure> {
    let (mut settings, mut wrong): (Vec<Setting>, Vec<Problem>) = (vec![], vec![]);
    for text in texts {
        let read = Assignment::read(&SET, text.trim())
            .and_then(|assignment| Ok(Setting { formula: assignment.formula()?, assignment }));
        match read {
            Ok(setting) if settings.iter().any(|before| before.name() == setting.name()) => {
                let title = format!("`{}` is given values twice", shown(setting.name()));
                wrong.push(setting.assignment.wrong_name(title, "keep one of the two".to_owned()));
            }
            Ok(setting) => settings.push(setting),
            Err(Failure::Wrong(problems)) => wrong.extend(problems),
            Err(other) => return Err(other),
        }
    }
    if wrong.is_empty() { Ok(settings) } else { Err(Failure::Wrong(wrong)) }
}

impl Setting {
    /// The field.
    pub(crate) fn name(&self) -> &str {
        &self.assignment.name
    }
}

/// The numbers that stand for fields, in SI units. The parameters tell in which units they are.
pub(crate) fn known(
    settings: &[Setting],
    spec: &RobotSpec,
    parameters: &[Parameter],
    input: &Input,
) -> Result<Vec<(String, Number)>, Failure> {
    let (mut known, mut wrong) = (vec![], vec![]);
    for Setting { assignment, formula } in settings {
        let name = assignment.name.as_str();
        match parameters.iter().find(|parameter| parameter.name == name) {
            None => wrong.extend(unless_unused(assignment, spec, input)),
            Some(parameter) => match number(formula, exponents(parameter), name) {
                Ok(number) => known.push((name.to_owned(), number)),
                Err(found) => wrong.push(assignment.wrong(&found)),
            },
        }
    }
    if wrong.is_empty() { Ok(known) } else { Err(Failure::Wrong(wrong)) }
}

/// Fails if the numbers that stand for fields make a robot unsound, and says which of them do: without these, what is wrong
/// is not.
pub(crate) fn judge(settings: &[Setting], spec: &RobotSpec, input: &Input) -> Result<(), Failure> {
    let found = mistakes(spec);
    if found.is_empty() {
        return Ok(());
    }
    let facts = |found: &Diagnostics| found.iter().map(|found| found.message.clone()).collect::<Vec<_>>();
    let without = |setting: &Setting| {
        let mut spec = spec.clone();
        spec.known.retain(|(name, _)| name != setting.name());
        let mut found = mistakes(&spec);
        let facts = facts(&found);
        found.take();
        facts
    };
    let without: Vec<Vec<String>> = settings.iter().map(without).collect();
    let causes = |fact: &String| {
        let blamed = settings.iter().zip(&without).filter(|(_, without)| !without.contains(fact));
        let written = |Setting { assignment, formula }: &Setting| {
            format!("`{} = {}`", shown(&assignment.name), formula.short_text())
        };
        blamed.map(|(setting, _)| written(setting)).collect::<Vec<_>>().join(" or ")
    };
    let causes: Vec<String> = facts(&found).iter().map(causes).collect();
    Err(match Failure::mistakes(found, input) {
        Failure::Wrong(problems) => Failure::Wrong(
            problems.into_iter().zip(causes).map(|(problem, cause)| blame(problem, &cause)).collect(),
        ),
        other => other,
    })
}

/// A problem with what to change of `--set`, if its cause is there.
fn blame(problem: Problem, cause: &str) -> Problem {
    if cause.is_empty() {
        return problem;
    }
    let first = format!("change {cause} in `--set`");
    let help = problem.help.as_ref().map_or(first.clone(), |help| format!("{first}, or else {help}"));
    problem.help(help)
}

/// What is wrong with a robot.
fn mistakes(spec: &RobotSpec) -> Diagnostics {
    judged(spec, &Graph::new()).err().unwrap_or_default()
}

/// The exponents of kg, m and s in the unit of a parameter, if its uses tell it.
pub(crate) fn exponents(parameter: &Parameter) -> Option<Exponents> {
    parameter.exponents.map(|exponents| exponents.map(|exponent| exponent.to_f64().round() as i32))
}

/// What is wrong with a name that is no parameter. A field that no equation has may have a value.
fn unless_unused(assignment: &Assignment, spec: &RobotSpec, input: &Input) -> Option<Problem> {
    let known = || spec.fields.iter().map(|field| field.name.text.as_str());
    let name = assignment.name.as_str();
    if input.item().is_none() {
        // A URDF has no fields: there are those that options name.
        let title = format!("no option uses `{}`, and a URDF has no fields", shown(name));
        let help = format!("put it where the number would be, as in `--body 'load, mass = {}'`", shown(name));
        return Some(assignment.wrong_name(title, help));
    }
    if known().any(|field| field == name) {
        return None;
    }
    let help = match (did_you_mean(name, known()), spec.fields.len()) {
        (Some(meant), _) => format!("did you mean `{meant}`?"),
        (None, 0) => format!("put it where the number would be, as in `mass = {}`", shown(name)),
        (None, _) => format!("its fields are {}", known().collect::<Vec<_>>().join(", ")),
    };
    Some(assignment.wrong_name(format!("the robot has no field `{}`", shown(name)), help))
}

/// So many fields are in an example.
const SHOWN: usize = 4;

/// What to say of parameters without a value, if there are any.
pub(crate) fn unless_known(model: &Model<'_>, is_known: impl Fn(usize) -> bool) -> Result<(), Problem> {
    let missing: Vec<_> =
        model.parameters.iter().enumerate().filter(|(k, _)| !is_known(*k)).map(|(_, p)| p).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let named = |parameter: &&Parameter| match parameter.unit.as_deref() {
        None => format!("`{}`", parameter.name),
        Some("1") => format!("`{}` (rad, or a plain number)", parameter.name),
        Some(unit) => format!("`{}` ({unit})", parameter.name),
    };
    let list = missing.iter().map(named).collect::<Vec<_>>().join(", ");
    let (fields, have) = if missing.len() == 1 { ("field", "has") } else { ("fields", "have") };
    let problem = Problem::new(format!("the {fields} {list} {have} no value"));
    let each = if missing.len() == 1 { "it" } else { "each" };
    let some: Vec<_> = missing.iter().take(SHOWN).map(|p| format!("{} = 0.5", p.name)).collect();
    let more = if missing.len() > SHOWN { ", …" } else { "" };
    Err(problem.help(format!("give {each} one, as by `--set '{}{more}'`", some.join(", "))))
}
