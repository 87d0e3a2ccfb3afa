//! Names of C: what may be one, and what everything about a robot is called.

use std::collections::BTreeSet;

use super::Input;
use crate::mechanics::equations::{Input as Symbol, Method};
use crate::symbolic::{Expr, Op};

/// How many characters of a name C99 promises to tell apart.
const LIMIT: usize = 31;

/// The longest prefix: behind it stands `_` and the longest of the functions' names.
pub const PREFIX_LIMIT: usize = LIMIT - 1 - "equations_of_motion".len();

/// The names of arguments, which no other variable may have.
pub(super) const ARGUMENTS: &[&str] =
    &["robot", "fields", "ignored", "q", "v", "a", "tau", "f", "h", "p", "pi", "twist", "rate"];

/// Words that nothing may be called by: C's and those of C++.
#[rustfmt::skip]
pub(super) const KEYWORDS: &[&str] = &[
    "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern",
    "float", "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed",
    "sizeof", "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "and",
    "asm", "bool", "catch", "class", "delete", "explicit", "export", "false", "friend", "mutable", "namespace",
    "new", "not", "operator", "or", "private", "protected", "public", "template", "this", "throw", "true", "try",
    "typeid", "typename", "using", "virtual", "wchar_t", "xor",
];

/// Whether `prefix` can stand before all names.
///
/// # Errors
///
/// What is wrong with it.
pub fn check_prefix(prefix: &str) -> Result<(), String> {
    let starts = prefix.starts_with(|c: char| c.is_ascii_lowercase());
    let is_word = prefix.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !starts || !is_word {
        return Err("a prefix is of small letters, digits and `_`, and begins with a letter".to_owned());
    }
    if prefix.len() > PREFIX_LIMIT {
        return Err(format!(
            "a prefix has at most {PREFIX_LIMIT} characters, so that no name has more than the {LIMIT} that C99 tells apart"
        ));
    }
    if KEYWORDS.contains(&prefix) { Err(format!("`{prefix}` is a word of C")) } else { Ok(()) }
}

/// What the parts of a robot are called.
pub(super) struct Robot {
    /// `iiwa14`
    pub(super) prefix: String,
    /// `IIWA14`
    pub(super) upper: String,
    /// The struct's fields, which are the model's parameters.
    pub(super) parameters: Vec<String>,
    /// Those of the prepared robot.
    pub(super) fields: Vec<String>,
    frames: Vec<String>,
}

impl Robot {
    pub(super) fn of(input: &Input<'_, '_>) -> Self {
        let prefix = input.prefix.to_owned();
        let mut taken = BTreeSet::new();
        let names = input.model.parameters.iter().map(|parameter| parameter.name.as_str());
        let parameters: Vec<String> = names.map(|name| word(name, LIMIT, &mut taken)).collect();
        let mut computed = 0;
        let mut field = |value: &Expr<'_>| {
            if let Expr::Node { id, .. } = *value
                && let Op::Symbol(symbol) = input.compiled.graph.op(id)
                && let Symbol::Parameter(k) = input.compiled.inputs.meaning(symbol)
            {
                return parameters[k].clone();
            }
            computed += 1;
            word(&format!("k{}", computed - 1), LIMIT, &mut taken)
        };
        let fields = input.compiled.companion.fields.iter().map(&mut field).collect();
        // Behind a frame's name stands `_` and the longest name of a method of frames.
        let room = LIMIT - prefix.len() - "__world_jacobian".len();
        let mut taken = BTreeSet::new();
        let frames = input.model.tree.frames.iter();
        let frames =
            frames.map(|frame| word(last_words(&frame.name.to_ascii_lowercase(), room), room, &mut taken));
        let frames = frames.collect();
        Self { upper: prefix.to_ascii_uppercase(), prefix, parameters, fields, frames }
    }

    /// Whether the functions are given a robot.
    pub(super) fn has_fields(&self) -> bool {
        !self.fields.is_empty()
    }

    /// `iiwa14_mass_matrix`, `iiwa14_tool0_pose`
    pub(super) fn function(&self, method: Method) -> String {
        let (prefix, name) = (&self.prefix, short(method));
        match method.frame() {
            Some(frame) => format!("{prefix}_{}_{name}", self.frames[frame]),
            None => format!("{prefix}_{name}"),
        }
    }

    /// `IIWA14_NV`
    pub(super) fn size(&self, name: &str) -> String {
        format!("{}_{name}", self.upper)
    }
}

/// A method's name, shortened where C's names would be too long.
fn short(method: Method) -> &'static str {
    match method {
        Method::InverseDynamicsDerivatives => "inverse_derivatives",
        Method::ForwardDynamicsDerivatives => "forward_derivatives",
        Method::InverseDynamicsWithDerivatives => "tau_and_derivatives",
        Method::ForwardDynamicsWithDerivatives => "a_and_derivatives",
        Method::CenterOfMassJacobian => "com_jacobian",
        Method::CentroidalMomentumMatrix => "momentum_matrix",
        Method::CentroidalMomentum => "momentum",
        Method::InertialParameters => "parameters",
        _ => method.name(),
    }
}

/// The last words of a name that fit: names of frames differ at their ends.
fn last_words(name: &str, room: usize) -> &str {
    let starts = name.match_indices('_').map(|(at, _)| at + 1);
    std::iter::once(0).chain(starts).map(|at| &name[at..]).find(|rest| rest.len() <= room).unwrap_or(name)
}

/// A name that is new: `wanted` with `_` for what C has no letters for, shortened to `room`, numbered if it is taken.
fn word(wanted: &str, room: usize, taken: &mut BTreeSet<String>) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut name: String = wanted.chars().map(letter).collect();
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name.insert(0, 'x');
    }
    name.truncate(room);
    let mut chosen = name.clone();
    let mut number = 1;
    while KEYWORDS.contains(&chosen.as_str()) || !taken.insert(chosen.clone()) {
        number += 1;
        let suffix = format!("_{number}");
        chosen = name.clone();
        chosen.truncate(room.saturating_sub(suffix.len()));
        chosen.push_str(&suffix);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_new_and_short_and_of_c() {
        let mut taken = BTreeSet::new();
        let names = ["θ1", "int", "left foot", "left-foot", "a_very_long_name", "a_very_long_nail", "9"];
        let words: Vec<_> = names.iter().map(|name| word(name, 11, &mut taken)).collect();
        assert_eq!(words, ["x_1", "int_2", "left_foot", "left_foot_2", "a_very_long", "a_very_lo_2", "x9"]);
    }

    #[test]
    fn frames_keep_their_ends() {
        assert_eq!(last_words("iiwa_link_7", 9), "link_7");
        assert_eq!(last_words("tool0", 9), "tool0");
        assert_eq!(last_words("gripperfinger", 9), "gripperfinger");
        assert_eq!(last_words("größe_2", 4), "2");
    }

    #[test]
    fn every_function_has_room() {
        let longest = Method::OF_ROBOT.into_iter().map(|method| short(method).len()).max();
        assert_eq!(longest, Some(LIMIT - 1 - PREFIX_LIMIT));
        let of_frame = Method::of_frame(0).into_iter().map(|method| short(method).len()).max();
        assert_eq!(of_frame, Some("world_jacobian".len()));
    }

    #[test]
    fn a_prefix_is_checked() {
        assert_eq!(check_prefix("iiwa14"), Ok(()));
        for bad in ["", "9a", "Iiwa", "a b", "a_long_prefix", "float"] {
            assert!(check_prefix(bad).is_err(), "{bad}");
        }
    }
}
