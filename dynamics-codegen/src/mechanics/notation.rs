//! What the coordinates, speeds and fields of a robot are called on paper.

use super::equations::{Argument, Inputs};
use super::joint_names::JointNames;
use crate::closed::{Name, Notation, Role};
use crate::model::{Model, Parameter};
use crate::symbolic::Number;

/// What the symbols of a robot's equations are called, in the order of [`Inputs`].
///
/// Fields have their own names. So have joints that are called by a letter, as `x` or `theta1`, which no field has. The
/// coordinates of others are θ where they turn, x, y or z where they slide along an axis of the world, and d elsewhere, with
/// the indices that are free where there are several; where a field has these letters, φ and s, and so on. Speeds and
/// accelerations have dots; those of ball and free joints are v and ω.
pub fn notation(model: &Model<'_>) -> Notation {
    let mut notation = Notation::new();
    for (parameter, name) in model.parameters.iter().zip(field_names(model)) {
        let symbol = notation.add(name, Role::Parameter);
        notation.set_rank(symbol, rank(parameter));
    }
    let names = JointNames::of(model, &notation);
    for name in &names.coordinates {
        notation.add(name.clone(), Role::Coordinate);
    }
    for name in &names.speeds {
        notation.add(name.clone(), Role::Speed);
    }
    for name in &names.speeds {
        notation.add(name.dotted(), Role::Acceleration);
    }
    let force = |letter: &str, k: usize| Name::indexed(letter, &(k + 1).to_string());
    let is_free = |letter: &&&str| (0..names.speeds.len()).all(|k| notation.is_free(&force(letter, k)));
    let letter = FORCES.iter().find(is_free).unwrap_or(&FORCES[0]);
    for k in 0..names.speeds.len() {
        notation.add(force(letter, k), Role::Force);
    }
    let inputs = Inputs::of(model);
    for at in model.tree.quaternions() {
        notation.add_quaternion([0, 1, 2, 3].map(|k| inputs.symbol(Argument::Q, at + k)));
    }
    notation
}

/// The letters of joint forces, the first that no field has.
const FORCES: [&str; 3] = ["tau", "Q", "F"];

/// Quantities that stand before others, by their exponents of kg, m and s: moments of inertia, masses, gravity, springs and
/// dampers, of joints that turn and of those that slide. With each are the letters that it has where its unit is not known:
/// of `m·g·l` alone nobody can say what has which.
const RANKS: [([i64; 3], &str); 7] = [
    ([1, 2, 0], "IJ"),
    ([1, 0, 0], "mM"),
    ([0, 1, -2], "g"),
    ([1, 2, -2], ""),
    ([1, 0, -2], "kκ"),
    ([1, 2, -1], ""),
    ([1, 0, -1], ""),
];

/// The place of masses among them.
pub(super) const RANK_OF_MASSES: u8 = 1;

/// Where a field stands among factors.
fn rank(parameter: &Parameter) -> u8 {
    let letter = Name::read(&parameter.name).letter();
    let is_its = |(unit, letters): &([i64; 3], &str)| match parameter.exponents {
        Some(exponents) => unit.map(Number::integer) == exponents,
        None => letter.is_some_and(|letter| letters.contains(letter)),
    };
    RANKS.iter().position(is_its).map_or(u8::MAX, |rank| rank as u8)
}

/// Beginnings of names, and the letters that are written for them.
type Letters = &'static [(&'static str, &'static str)];

/// The letters that quantities begin with, by their exponents of kg, m and s, and what may follow as an index.
const LETTERS: &[([i64; 3], Letters)] = &[
    ([1, 0, 0], &[("m", "m"), ("M", "M")]),
    ([0, 1, 0], &[("l", "l"), ("r", "r"), ("d", "d"), ("h", "h"), ("a", "a"), ("L", "L")]),
    ([1, 2, 0], &[("i", "I"), ("I", "I"), ("j", "J"), ("J", "J")]),
    ([0, 1, -2], &[("g", "g")]),
];

/// The names of fields. Those that are written as they are called choose first, then those whose letter and index can be
/// read off; one that comes too late is the word of the program.
fn field_names(model: &Model<'_>) -> Vec<Name> {
    let parameters = &model.parameters;
    let names: Vec<Name> = parameters.iter().map(parameter_name).collect();
    let effort = |k: usize| {
        let text = &parameters[k].name;
        [names[k].unicode() != *text, names[k] != Name::read(text)]
    };
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|&k| effort(k));
    let (mut taken, mut chosen) = (Notation::new(), names.clone());
    for k in order {
        let word = Name::word(&parameters[k].name);
        if !taken.is_free(&names[k]) && taken.is_free(&word) {
            chosen[k] = word;
        }
        let symbol = taken.add(chosen[k].clone(), Role::Parameter);
        chosen[k] = taken.letter(symbol).name.clone();
    }
    chosen
}

/// The name of a field: of a mass `mc` is m with the index c, of an inertia `ix1` is I with the index x₁. What is Greek
/// stays so: a mass `mu` is μ.
fn parameter_name(parameter: &Parameter) -> Name {
    let text = parameter.name.as_str();
    let plain = Name::read(text);
    let is_greek = plain.letter().is_some_and(|letter| !letter.is_ascii());
    let Some(exponents) = parameter.exponents.filter(|_| !is_greek) else { return plain };
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
