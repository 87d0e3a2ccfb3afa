//! The state that `--state` gives: a JSON object of vectors.

use std::fmt;
use std::path::Path;

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::model::Model;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::Value;

use crate::failure::{Failure, Problem, Spot};
use crate::input::{bytes_of, name_of, shown};
use crate::robot::State;

const KEYS: [&str; 4] = ["q", "v", "a", "tau"];
const EXAMPLE: &str = "write a JSON object, as in '{\"q\": [0.1, 0.2], \"v\": [1, 0]}'";

/// The entries of an object, in order: a map would hide that a key is there twice.
struct Entries(Vec<(String, Value)>);

impl<'de> Deserialize<'de> for Entries {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OfObject;
        impl<'de> Visitor<'de> for OfObject {
            type Value = Entries;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of vectors")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries, A::Error> {
                let mut entries = vec![];
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(OfObject)
    }
}

/// Reads a state: JSON, or `@` and the path of a file of JSON. What is not given is zero.
pub(crate) fn read(argument: &str, robot: &Path, model: &Model<'_>) -> Result<State, Failure> {
    let (name, text) = match argument.strip_prefix('@') {
        Some("-") if robot == Path::new("-") => {
            return Err(
                Problem::new("both the robot and the state are to be read from standard input").into()
            );
        }
        Some(path) => {
            let path = Path::new(path);
            (name_of(path), String::from_utf8_lossy(&bytes_of(path)?).into_owned())
        }
        None => ("--state".to_owned(), argument.to_owned()),
    };
    let Entries(entries) = serde_json::from_str(&text).map_err(|error| not_json(&error, name, &text))?;
    let zeros = vec![0.0; model.tree.dof()];
    let mut state = State { q: zeros.clone(), v: zeros.clone(), a: zeros.clone(), tau: zeros };
    let mut seen: Vec<&str> = vec![];
    for (key, value) in &entries {
        let vector = match key.as_str() {
            "q" => &mut state.q,
            "v" => &mut state.v,
            "a" => &mut state.a,
            "tau" => &mut state.tau,
            _ => return Err(unknown(key, model)),
        };
        if seen.contains(&key.as_str()) {
            return Err(Problem::new(format!("the state has `{key}` twice"))
                .help("keep one of the two")
                .into());
        }
        seen.push(key);
        let numbers = value.as_array().and_then(|items| items.iter().map(Value::as_f64).collect());
        let Some(numbers) = numbers else {
            let problem = Problem::new(format!("`{key}` is no list of numbers"));
            return Err(problem.help(format!("give {}", wanted(model))).into());
        };
        *vector = checked(key, numbers, model)?;
    }
    Ok(state)
}

/// Reads a vector as on the command line: `0.1,-0.2`, in brackets or not.
pub(crate) fn vector(name: &str, argument: Option<&str>, model: &Model<'_>) -> Result<Vec<f64>, Failure> {
    let Some(argument) = argument else { return Ok(vec![0.0; model.tree.dof()]) };
    let inner = argument.trim().trim_start_matches('[').trim_end_matches(']');
    let parsed: Result<Vec<f64>, &str> =
        inner.split(',').map(|word| word.trim().parse().map_err(|_| word.trim())).collect();
    let numbers = parsed.map_err(|word| {
        let problem = Problem::new(format!("`{}` in `--{name}` is no number", shown(word)));
        problem.help(format!("give {}, with commas between them", wanted(model)))
    })?;
    checked(&format!("--{name}"), numbers, model)
}

/// As many numbers as there are joints, and all finite.
fn checked(name: &str, numbers: Vec<f64>, model: &Model<'_>) -> Result<Vec<f64>, Failure> {
    let dof = model.tree.dof();
    let problem = if numbers.len() != dof {
        let count = numbers.len();
        let (s, joints) = (if count == 1 { "" } else { "s" }, if dof == 1 { "joint" } else { "joints" });
        Problem::new(format!("`{name}` has {count} number{s}, and the robot has {dof} {joints}"))
    } else if let Some(k) = numbers.iter().position(|number| !number.is_finite()) {
        let joint = model.joints.get(k).map_or("", |joint| &joint.name);
        Problem::new(format!("`{name}` of the joint `{joint}` is {}", numbers[k]))
    } else {
        return Ok(numbers);
    };
    Err(problem.help(format!("give {}", wanted(model))).into())
}

fn unknown(key: &str, model: &Model<'_>) -> Failure {
    let problem = Problem::new(format!("the state has an unknown key `{}`", shown(key)));
    let help = match did_you_mean(key, KEYS) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("give `q`, `v`, `a` or `tau`, each of them {}", wanted(model)),
    };
    problem.help(help).into()
}

/// As in "2 finite numbers, of the joints slider, hinge".
fn wanted(model: &Model<'_>) -> String {
    const SHOWN: usize = 16;
    let names: Vec<&str> = model.joints.iter().map(|joint| joint.name.as_str()).take(SHOWN).collect();
    let (count, names) = (model.joints.len(), names.join(", "));
    let more = if count > SHOWN { format!(" and {} more", count - SHOWN) } else { String::new() };
    match count {
        1 => format!("1 finite number, of the joint {names}"),
        _ => format!("{count} finite numbers, of the joints {names}{more}"),
    }
}

fn not_json(error: &serde_json::Error, file: String, text: &str) -> Failure {
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = message.strip_suffix(&place).unwrap_or(&message);
    let spot = Spot { file, line: error.line().max(1), column: column_of(text, error) };
    let mut problem =
        Problem::new(format!("the state is no JSON object of vectors: {message}")).help(EXAMPLE);
    problem.spot = Some(spot);
    Failure::Wrong { problems: vec![problem], text: text.to_owned() }
}

/// The column in characters, where the parser counts bytes.
fn column_of(text: &str, error: &serde_json::Error) -> usize {
    let line = text.split('\n').nth(error.line().saturating_sub(1)).unwrap_or_default();
    let before = line.get(..error.column().saturating_sub(1)).unwrap_or(line);
    before.chars().count() + 1
}
