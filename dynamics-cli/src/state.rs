//! The state that `--state` gives: vectors, or some of their entries by name.

use std::fmt;
use std::path::Path;

use dynamics_codegen::diagnostics::did_you_mean;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::Value;

use crate::entry::{Entries, Wrong};
use crate::failure::{Failure, Problem, Spot};
use crate::input::{name_of, shown};
use crate::reading::bytes_of;
use crate::robot::{Robot, State};

const KEYS: [&str; 4] = ["q", "v", "a", "tau"];
const EXAMPLE: &str = "write a JSON object, as in '{\"q\": [0.1, 0.2], \"v\": {\"hinge\": 1}}'";

/// The entries of an object, in order: a map would hide that a key is there twice.
struct Object<T>(Vec<(String, T)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OfObject<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for OfObject<T> {
            type Value = Object<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of vectors")
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Object<T>, A::Error> {
                Ok(Object(entries_of(map)?))
            }
        }
        deserializer.deserialize_map(OfObject(std::marker::PhantomData))
    }
}

fn entries_of<'de, T: Deserialize<'de>, A: MapAccess<'de>>(mut map: A) -> Result<Vec<(String, T)>, A::Error> {
    let mut entries = vec![];
    while let Some(entry) = map.next_entry()? {
        entries.push(entry);
    }
    Ok(entries)
}

/// A vector as given.
enum Vector {
    /// All entries, in order.
    All(Vec<Value>),
    /// Some, by their names.
    Some(Vec<(String, Value)>),
}

impl<'de> Deserialize<'de> for Vector {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OfEither;
        impl<'de> Visitor<'de> for OfEither {
            type Value = Vector;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of numbers, or an object of some by their names")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vector, A::Error> {
                let mut items = vec![];
                while let Some(item) = list.next_element()? {
                    items.push(item);
                }
                Ok(Vector::All(items))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Vector, A::Error> {
                Ok(Vector::Some(entries_of(map)?))
            }
        }
        deserializer.deserialize_any(OfEither)
    }
}

/// Reads a state: JSON, or `@` and the path of a file of JSON. What is not given is neutral.
pub(crate) fn read(argument: &str, file: &Path, robot: &Robot<'_>) -> Result<State, Failure> {
    let (name, text) = match argument.strip_prefix('@') {
        Some("-") if file == Path::new("-") => {
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
    let Object(given) =
        serde_json::from_str::<Object<Vector>>(&text).map_err(|error| not_json(&error, name, &text))?;
    let mut state = State::neutral(robot);
    let (mut seen, mut wrong): (Vec<&str>, Vec<Problem>) = (vec![], vec![]);
    for (key, vector) in &given {
        let slot = match key.as_str() {
            "q" => &mut state.q,
            "v" => &mut state.v,
            "a" => &mut state.a,
            _ => &mut state.tau,
        };
        let Some(entries) = Entries::of(robot, key) else {
            wrong.push(unknown_key(key));
            continue;
        };
        if seen.contains(&key.as_str()) {
            wrong.push(Problem::new(format!("the state has `{key}` twice")).help("keep one of the two"));
            continue;
        }
        seen.push(key);
        let (names, mut put) = (entries.names, |entry: usize, value: &Value| {
            let number = number(key, value, entry, &entries)?;
            if let Some(slot) = slot.get_mut(entry) {
                *slot = number;
            }
            Ok(())
        });
        match vector {
            Vector::All(items) if items.len() != names.len() => {
                let (count, needed) = (items.len(), names.len());
                let s = if count == 1 { "" } else { "s" };
                let problem = Problem::new(format!("`{key}` has {count} number{s}, and needs {needed}"));
                wrong.push(problem.help(format!("give {}", wanted(names))));
            }
            Vector::All(items) => {
                wrong.extend(items.iter().enumerate().filter_map(|(k, item)| put(k, item).err()));
            }
            Vector::Some(given) => {
                let mut put = |name: &str, value| put(position(key, name, names)?, value);
                wrong.extend(given.iter().filter_map(|(name, value)| put(name, value).err()));
            }
        }
    }
    if wrong.is_empty() {
        check_quaternions(robot, &state.q)?;
        return Ok(state);
    }
    Err(Failure::Wrong(wrong))
}

/// The value of an entry: a number, or a text with a unit.
fn number(key: &str, found: &Value, entry: usize, entries: &Entries<'_>) -> Result<f64, Problem> {
    // A number in quotes is a mistake of who wrote them.
    let is_quoted = found.as_str().is_some_and(|text| text.parse::<f64>().is_ok());
    let read = match found {
        Value::String(text) if !is_quoted => entries.number(entry, text, 0),
        found => found.as_f64().ok_or(Wrong::NoNumber),
    };
    read.map_err(|wrong| match wrong {
        Wrong::NoNumber => {
            let name = entries.names.get(entry).map_or("", String::as_str);
            let found = shown(&found.to_string());
            let title = format!("`{key}` of `{}` is {found}, and no number", shown(name));
            Problem::new(title).help(match is_quoted {
                true => "leave the quotes out, or write a unit behind the number, as in `\"30deg\"`",
                false => "give a finite number, or a text with a unit, as in `\"30deg\"`",
            })
        }
        Wrong::Of(found) => {
            let problem = Problem::new(found.message.clone()).help(found.help_text());
            Problem { code: Some(found.code.to_string()), ..problem }
        }
    })
}

/// The index of an entry, by its name.
pub(crate) fn position(key: &str, name: &str, names: &[String]) -> Result<usize, Problem> {
    names.iter().position(|known| known == name).ok_or_else(|| {
        let problem = Problem::new(format!("`{key}` has no entry `{}`", shown(name)));
        problem.help(match did_you_mean(name, names.iter().map(String::as_str)) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("give {}", wanted(names)),
        })
    })
}

/// How far the square of a quaternion's length may be from 1: that of the run time.
const UNIT: f64 = 1e-6;

/// Quaternions of unit length, as the run time's `check_configuration` has them.
pub(crate) fn check_quaternions(robot: &Robot<'_>, q: &[f64]) -> Result<(), Failure> {
    let mut wrong = vec![];
    for at in robot.tree.quaternions() {
        let quaternion = &q[at..at + 4];
        let norm = quaternion.iter().fold(0.0, |norm: f64, x| norm.hypot(*x));
        if (norm * norm - 1.0).abs() <= UNIT {
            continue;
        }
        let joint = robot.model.joints.iter().find(|joint| joint.q.contains(&at));
        let name = joint.map_or("", |joint| &joint.name);
        let last = at + 3;
        let title =
            format!("the quaternion of `{name}`, q[{at}] to q[{last}], has the norm {norm}, and not 1");
        let unit: Vec<String> = quaternion.iter().map(|x| format!("{:?}", x / norm + 0.0)).collect();
        let help = match norm > 0.0 && norm.is_finite() {
            true => format!("divided by its norm it is {}", unit.join(", ")),
            false => "no rotation is 0, 0, 0, 1".to_owned(),
        };
        wrong.push(Problem::new(title).help(help));
    }
    if wrong.is_empty() { Ok(()) } else { Err(Failure::Wrong(wrong)) }
}

fn unknown_key(key: &str) -> Problem {
    let problem = Problem::new(format!("the state has an unknown key `{}`", shown(key)));
    let help = match did_you_mean(key, KEYS) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => "give `q`, `v`, `a` or `tau`".to_owned(),
    };
    problem.help(help)
}

/// As in "2 finite numbers, of slider, hinge".
pub(crate) fn wanted(names: &[String]) -> String {
    const SHOWN: usize = 19; // a quadruped's
    const FEW: usize = 5; // are not worth to be left out
    let count = names.len();
    let shown = if count <= SHOWN + FEW { count } else { SHOWN };
    let more = if count > shown { format!(" and {} more", count - shown) } else { String::new() };
    let shown = names.iter().take(shown).map(String::as_str).collect::<Vec<_>>().join(", ");
    let s = if count == 1 { "" } else { "s" };
    format!("{count} finite number{s}, of {shown}{more}")
}

fn not_json(error: &serde_json::Error, file: String, text: &str) -> Failure {
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = message.strip_suffix(&place).unwrap_or(&message);
    let spot = Spot::in_text(file, text, error.line().max(1), column_of(text, error));
    let mut problem =
        Problem::new(format!("the state is no JSON object of vectors: {message}")).help(EXAMPLE);
    problem.spot = Some(spot.into());
    problem.into()
}

/// The column in characters, where the parser counts bytes.
fn column_of(text: &str, error: &serde_json::Error) -> usize {
    let line = text.split('\n').nth(error.line().saturating_sub(1)).unwrap_or_default();
    let before = line.get(..error.column().saturating_sub(1)).unwrap_or(line);
    before.chars().count() + 1
}
