//! What the coordinates, speeds and fields of a robot are called on paper.

use super::equations::{Argument, Inputs};
use crate::closed::{Name, Notation, Role};
use crate::model::{JointInfo, Model, Motion, Parameter};
use crate::symbolic::{Expr, Number};

/// What the symbols of a robot's equations are called, in the order of [`Inputs`].
///
/// Fields have their own names. So have joints that are called by a letter, as `x` or `theta1`; the coordinates of others
/// are θ where they turn, x, y or z where they slide along an axis of the world, and d elsewhere, with an index where there
/// are several. Speeds and accelerations have dots; those of ball and free joints are v and ω.
pub fn notation(model: &Model<'_>) -> Notation {
    let mut notation = Notation::new();
    for parameter in &model.parameters {
        let symbol = notation.add(parameter_name(parameter), Role::Parameter);
        let rank = |unit: &[i64; 3]| Some(unit.map(Number::integer)) == parameter.exponents;
        notation.set_rank(symbol, RANKS.iter().position(rank).map_or(u8::MAX, |rank| rank as u8));
    }
    let names = JointNames::of(model);
    for name in &names.coordinates {
        notation.add(name.clone(), Role::Coordinate);
    }
    for name in &names.speeds {
        notation.add(name.clone(), Role::Speed);
    }
    for name in &names.speeds {
        notation.add(name.dotted(), Role::Acceleration);
    }
    for k in 0..names.speeds.len() {
        notation.add(Name::indexed("tau", &(k + 1).to_string()), Role::Force);
    }
    let inputs = Inputs::of(model);
    for at in model.tree.quaternions() {
        notation.add_quaternion([0, 1, 2, 3].map(|k| inputs.symbol(Argument::Q, at + k)));
    }
    notation
}

/// Quantities that stand before others, by their exponents of kg, m and s: moments of inertia, masses, gravity.
const RANKS: [[i64; 3]; 3] = [[1, 2, 0], [1, 0, 0], [0, 1, -2]];

/// Beginnings of names, and the letters that are written for them.
type Letters = &'static [(&'static str, &'static str)];

/// The letters that quantities begin with, by their exponents of kg, m and s, and what may follow as an index.
const LETTERS: &[([i64; 3], Letters)] = &[
    ([1, 0, 0], &[("m", "m"), ("M", "M")]),
    ([0, 1, 0], &[("l", "l"), ("r", "r"), ("d", "d"), ("h", "h"), ("a", "a"), ("L", "L")]),
    ([1, 2, 0], &[("i", "I"), ("I", "I"), ("j", "J"), ("J", "J")]),
    ([0, 1, -2], &[("g", "g")]),
];

/// The name of a field: of a mass `mc` is m with the index c, of an inertia `ix1` is I with the index x₁.
fn parameter_name(parameter: &Parameter) -> Name {
    let text = parameter.name.as_str();
    let plain = Name::read(text);
    let Some(exponents) = parameter.exponents else { return plain };
    let unit = |unit: &[i64; 3]| unit.map(Number::integer) == exponents;
    let letters = LETTERS.iter().find(|(known, _)| unit(known)).map_or(&[][..], |(_, letters)| letters);
    for (letter, written) in letters {
        let Some(index) = text.strip_prefix(letter) else { continue };
        let index = index.strip_prefix('_').unwrap_or(index);
        let axis = index.trim_end_matches(|c: char| c.is_ascii_digit());
        let is_axes = axis.len() == 2 && axis.chars().all(|c| matches!(c, 'x'..='z'));
        let is_letter = axis.len() < 2 && axis.chars().all(|c| c.is_ascii_alphabetic());
        if is_letter || is_axes {
            return Name::indexed(written, index);
        }
    }
    plain
}

/// The names of coordinates and speeds.
struct JointNames {
    coordinates: Vec<Name>,
    speeds: Vec<Name>,
}

impl JointNames {
    fn of(model: &Model<'_>) -> Self {
        let mut names = Self { coordinates: vec![], speeds: vec![] };
        let generic = model.joints.iter().filter(|joint| own_name(joint).is_none());
        let indexed = generic.clone().filter(|joint| slide_letter(model, joint).is_none()).count();
        let mut several = generic.filter(|joint| joint.v.len() != 1);
        let (first, second) = (several.next(), several.next());
        // Two of one kind have parts of one name.
        let is_ambiguous = first.is_some() && second.is_some() && {
            let ball = |joint: &&JointInfo| joint.q.len() != joint.v.len();
            let kinds = [true, false].map(|is_ball| {
                model.joints.iter().filter(|joint| joint.v.len() != 1 && ball(joint) == is_ball).count()
            });
            kinds.iter().any(|count| *count > 1)
        };
        let (mut lines, mut others) = (0, 0);
        for joint in &model.joints {
            if joint.q.len() == 1 {
                let name = own_name(joint).unwrap_or_else(|| match slide_letter(model, joint) {
                    Some(letter) => Name::read(letter),
                    None => {
                        lines += 1;
                        let index = if indexed > 1 { lines.to_string() } else { String::new() };
                        Name::indexed(if slides(model, joint) { "d" } else { "theta" }, &index)
                    }
                });
                names.speeds.push(name.dotted());
                names.coordinates.push(name);
                continue;
            }
            others += 1;
            let index = if is_ambiguous { others.to_string() } else { String::new() };
            names.coordinates.extend(parts(&joint.coordinate_names(), joint, &index));
            match joint.v.len() == joint.q.len() {
                true => {
                    let own = names.coordinates[joint.q.clone()].iter().map(Name::dotted);
                    names.speeds.extend(own.collect::<Vec<_>>());
                }
                false => names.speeds.extend(parts(&joint.speed_names(), joint, &index)),
            }
        }
        names
    }
}

/// The name of a joint that is called by a letter.
fn own_name(joint: &JointInfo) -> Option<Name> {
    let name = Name::read(&joint.name);
    (joint.q.len() == 1 && name.is_letter()).then_some(name)
}

fn slides(model: &Model<'_>, joint: &JointInfo) -> bool {
    let link = model.tree.links.iter().find(|link| link.drive.v == joint.v.start);
    link.is_some_and(|link| link.motion == Motion::Prismatic)
}

/// The axis of the world that a joint slides along, unless a field has that name.
fn slide_letter(model: &Model<'_>, joint: &JointInfo) -> Option<&'static str> {
    let link = model.tree.links.iter().find(|link| link.drive.v == joint.v.start)?;
    if joint.v.len() != 1 || link.motion != Motion::Prismatic || link.parent.is_some() {
        return None;
    }
    let axis = link.placement.rotation.0.map(|row| row[2]);
    let along = axis.iter().position(|&component| component == Expr::ONE)?;
    let letter = ["x", "y", "z"][along];
    let is_taken = model.parameters.iter().any(|parameter| parameter.name == letter)
        || model.joints.iter().any(|joint| joint.name == letter);
    (!is_taken).then_some(letter)
}

/// Parts of joints that are words, and their letters.
const WORDS: [(&str, &str); 2] = [("angle", "theta"), ("distance", "d")];

/// The names of a joint's several coordinates or speeds: the last parts of what they are called, as `x`, `qw`, `wz`.
fn parts(names: &[String], joint: &JointInfo, index: &str) -> Vec<Name> {
    let part = |name: &String| {
        let part = name.strip_prefix(&joint.name).unwrap_or(name).trim_start_matches('.').to_owned();
        if let Some((_, letter)) =
            WORDS.iter().find(|(word, _)| part.trim_end_matches(|c: char| c.is_ascii_digit()) == *word)
        {
            let digits = part.trim_start_matches(|c: char| !c.is_ascii_digit());
            return Name::indexed(letter, &format!("{digits}{index}"));
        }
        let (letter, axis) = part.split_at(part.chars().next().map_or(0, char::len_utf8));
        let letter = if letter == "w" && !axis.is_empty() { "omega" } else { letter };
        Name::indexed(letter, &format!("{axis}{index}"))
    };
    names.iter().map(part).collect()
}
