//! The state that `--state` gives: a JSON object of vectors.

use std::fmt;
use std::ops::Range;
use std::path::Path;

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::model::{JointInfo, Model};
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
    let mut state = at_rest(model);
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
            return Err(problem.help(format!("give {}", wanted(Kind::of(key), model))).into());
        };
        *vector = checked(key, numbers, model)?;
    }
    Ok(state)
}

/// The state in which all is zero, and nothing is turned.
pub(crate) fn at_rest(model: &Model<'_>) -> State {
    let mut q = vec![0.0; model.tree.coordinates()];
    model.tree.quaternions().for_each(|at| q[at + 3] = 1.0);
    let zeros = vec![0.0; model.tree.dof()];
    State { q, v: zeros.clone(), a: zeros.clone(), tau: zeros }
}

/// What a vector is of: its length is that of all coordinates, or of all speeds.
#[derive(Clone, Copy)]
enum Kind {
    Coordinates,
    Speeds,
}

impl Kind {
    /// That of the vector `q`, or of another one.
    fn of(name: &str) -> Self {
        if name == "q" { Self::Coordinates } else { Self::Speeds }
    }

    /// The entries that a joint has in such a vector.
    fn range(self, joint: &JointInfo) -> Range<usize> {
        match self {
            Self::Coordinates => joint.q.clone(),
            Self::Speeds => joint.v.clone(),
        }
    }

    fn length(self, model: &Model<'_>) -> usize {
        match self {
            Self::Coordinates => model.tree.coordinates(),
            Self::Speeds => model.tree.dof(),
        }
    }

    /// As in "2 joints", or in "7 coordinates" where a joint has several.
    fn counted(self, model: &Model<'_>) -> String {
        let length = self.length(model);
        let what = match self {
            _ if model.joints.len() == length => "joint",
            Self::Coordinates => "coordinate",
            Self::Speeds => "speed",
        };
        format!("{length} {what}{}", if length == 1 { "" } else { "s" })
    }
}

/// Reads a vector as on the command line: `0.1,-0.2`, in brackets or not.
pub(crate) fn vector(name: &str, argument: &str, model: &Model<'_>) -> Result<Vec<f64>, Failure> {
    let inner = argument.trim().trim_start_matches('[').trim_end_matches(']');
    let parsed: Result<Vec<f64>, &str> =
        inner.split(',').map(|word| word.trim().parse().map_err(|_| word.trim())).collect();
    let numbers = parsed.map_err(|word| {
        let problem = Problem::new(format!("`{}` in `--{name}` is no number", shown(word)));
        problem.help(format!("give {}, with commas between them", wanted(Kind::of(name), model)))
    })?;
    checked(name, numbers, model)
}

/// As many numbers as there are coordinates, or speeds, and all finite; and quaternions are some.
fn checked(name: &str, numbers: Vec<f64>, model: &Model<'_>) -> Result<Vec<f64>, Failure> {
    let kind = Kind::of(name);
    let joint_at = |k: usize| {
        let joint = model.joints.iter().find(|joint| kind.range(joint).contains(&k));
        joint.map_or("", |joint| &joint.name)
    };
    let problem = if numbers.len() != kind.length(model) {
        let count = numbers.len();
        let s = if count == 1 { "" } else { "s" };
        Problem::new(format!("`{name}` has {count} number{s}, and the robot has {}", kind.counted(model)))
    } else if let Some(k) = numbers.iter().position(|number| !number.is_finite()) {
        Problem::new(format!("`{name}` of the joint `{}` is {}", joint_at(k), numbers[k]))
    } else if let Some((joint, length)) = stretched(kind, &numbers, model) {
        let message = format!("the quaternion of the joint `{}` has the length {length}", joint_at(joint));
        return Err(Problem::new(message)
            .help("give i, j, k, w such that their squares add up to one")
            .into());
    } else {
        return Ok(numbers);
    };
    Err(problem.help(format!("give {}", wanted(kind, model))).into())
}

/// The first quaternion that is not of unit length, as far as one can write it.
fn stretched(kind: Kind, numbers: &[f64], model: &Model<'_>) -> Option<(usize, f64)> {
    let lengths = model.tree.quaternions().map(|at| {
        let squares = numbers.iter().skip(at).take(4).map(|x| x * x);
        (at, squares.sum::<f64>().sqrt())
    });
    match kind {
        Kind::Coordinates => lengths.into_iter().find(|(_, length)| (length - 1.0).abs() > 1e-6),
        Kind::Speeds => None,
    }
}

fn unknown(key: &str, model: &Model<'_>) -> Failure {
    let problem = Problem::new(format!("the state has an unknown key `{}`", shown(key)));
    let help = match did_you_mean(key, KEYS) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => {
            let [q, v] = [Kind::Coordinates, Kind::Speeds].map(|kind| wanted(kind, model));
            if q == v {
                format!("give `q`, `v`, `a` or `tau`, each of them {v}")
            } else {
                format!("give `q`, {q}, or `v`, `a` or `tau`, each of them {v}")
            }
        }
    };
    problem.help(help).into()
}

/// As in "2 finite numbers, of the joints slider, hinge".
fn wanted(kind: Kind, model: &Model<'_>) -> String {
    const SHOWN: usize = 16;
    let name = |joint: &JointInfo| match kind.range(joint).len() {
        1 => joint.name.clone(),
        several => format!("{} ({several})", joint.name),
    };
    let names: Vec<String> = model.joints.iter().map(name).take(SHOWN).collect();
    let (count, joints, names) = (kind.length(model), model.joints.len(), names.join(", "));
    let more = if joints > SHOWN { format!(" and {} more", joints - SHOWN) } else { String::new() };
    let (s, of) = (if count == 1 { "" } else { "s" }, if joints == 1 { "joint" } else { "joints" });
    format!("{count} finite number{s}, of the {of} {names}{more}")
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
