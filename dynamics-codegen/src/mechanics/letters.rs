//! The letters of the equations themselves, as M for the mass matrix: where the robot has such a letter, they give way.
//!
//! A field that is called M is M on paper, for the name is its owner's. The mass matrix is 𝐌 beside it: matrices and vectors
//! are bold then, energies script, and other numbers Fraktur, as books print them that have few letters left.

use super::notation::RANK_OF_MASSES;
use crate::closed::{Notation, Role};

/// A letter of the equations.
#[derive(Debug)]
pub struct Letter {
    /// As it is written where the robot has no such letter.
    plain: char,
    /// The same in LaTeX: a letter, or a command.
    plain_latex: &'static str,
    /// As it is written beside the robot's own.
    pub unicode: &'static str,
    /// The same in LaTeX.
    pub latex: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

macro_rules! letters {
    ($($plain:literal $plain_latex:literal: $unicode:literal $latex:literal, $meaning:literal;)+) => {
        &[$(Letter { plain: $plain, plain_latex: $plain_latex, unicode: $unicode, latex: $latex, meaning: $meaning },)+]
    };
}

/// All of them. What has an arrow, is script anyway, or stands lowered or raised, is no robot's.
const ALL: &[Letter] = letters! {
    'A' "A": "𝐀" r"{\mathbf A}", "the matrix of the linear model";
    'B' "B": "𝐁" r"{\mathbf B}", "the matrix of inputs";
    'C' "C": "𝐂" r"{\mathbf C}", "the Coriolis matrix";
    'D' "D": "𝐃" r"{\mathbf D}", "the damping of the linear model";
    'E' "E": "𝐄" r"{\mathbf E}", "the map from speeds to rates of coordinates";
    'G' "G": "𝐆" r"{\mathbf G}", "the vector of potential forces";
    'J' "J": "𝐉" r"{\mathbf J}", "a Jacobian";
    'K' "K": "𝐊" r"{\mathbf K}", "the stiffness of the linear model";
    'L' "L": "ℒ" r"{\mathcal L}", "the Lagrangian";
    'M' "M": "𝐌" r"{\mathbf M}", "the mass matrix";
    'P' "P": "𝐏" r"{\mathbf P}", "the vector of passive forces";
    'R' "R": "𝐑" r"{\mathbf R}", "a rotation";
    'T' "T": "𝒯" r"{\mathcal T}", "the kinetic energy";
    'V' "V": "𝒱" r"{\mathcal V}", "the potential energy, and with a raised b a twist";
    'a' "a": "𝐚" r"{\mathbf a}", "the vector of accelerations";
    'e' "e": "𝐞" r"{\mathbf e}", "a unit speed";
    'f' "f": "𝐟" r"{\mathbf f}", "the rate of the state";
    'h' "h": "𝐡" r"{\mathbf h}", "a first moment";
    'm' "m": "𝔪" r"{\mathfrak m}", "the mass of a body";
    'p' "p": "𝐩" r"{\mathbf p}", "a place";
    'q' "q": "𝐪" r"{\mathbf q}", "the vector of coordinates";
    't' "t": "𝔱" r"{\mathfrak t}", "time";
    'u' "u": "𝐮" r"{\mathbf u}", "the vector of motor forces";
    'v' "v": "𝐯" r"{\mathbf v}", "the vector of speeds";
    'x' "x": "𝐱" r"{\mathbf x}", "the state";
    'Γ' r"\Gamma": "𝚪" r"{\boldsymbol\Gamma}", "Christoffel's symbol";
    'Υ' r"\Upsilon": "𝚼" r"{\boldsymbol\Upsilon}", "the vector of joint forces";
    'δ' r"\delta": "𝛅" r"{\boldsymbol\delta}", "a small change";
    'τ' r"\tau": "𝛕" r"{\boldsymbol\tau}", "the vector of joint forces";
    'ω' r"\omega": "𝛚" r"{\boldsymbol\omega}", "an angular velocity";
};

/// Letters with dots that are one sign of Unicode.
const DOTTED: [(char, char, char); 3] = [('Ṁ', 'M', '\u{307}'), ('ẋ', 'x', '\u{307}'), ('ẍ', 'x', '\u{308}')];

/// Commands of LaTeX whose next argument is no letter of the equations: it is words, or another alphabet.
const OTHERS: [&str; 6] = ["text", "operatorname", "mathcal", "mathrm", "vec", "mathbf"];

/// Which letters a robot has.
#[derive(Clone, Debug)]
pub struct Letters {
    taken: Vec<char>,
}

impl Letters {
    /// The letters of a robot's fields, coordinates and speeds. `q₁`, `q₂` and so on are the parts of the vector q, in their
    /// order, and do not take its letter; nor do masses take m, which is a mass.
    pub fn of(notation: &Notation) -> Self {
        let of_role = |role: Role| notation.letters().iter().filter(move |letter| letter.role == role);
        let several = of_role(Role::Coordinate).count() > 1;
        let is_part = |(k, name): (usize, &crate::closed::Name)| {
            let index = if several { (k + 1).to_string() } else { String::new() };
            name.letter() != Some('q')
                || name.number() == Some(&*index)
                || !several && name.number() == Some("1")
        };
        let are_parts = of_role(Role::Coordinate).map(|letter| &letter.name).enumerate().all(is_part);
        let is_taken = |letter: &&crate::closed::Letter| match letter.role {
            Role::Force | Role::Intermediate => false,
            Role::Parameter => letter.name.letter() != Some('m') || letter.rank != RANK_OF_MASSES,
            _ => !(are_parts && letter.name.letter() == Some('q')),
        };
        Self {
            taken: notation
                .letters()
                .iter()
                .filter(is_taken)
                .filter_map(|letter| letter.name.letter())
                .collect(),
        }
    }

    fn is_taken(&self, letter: &Letter) -> bool {
        self.taken.contains(&letter.plain)
    }

    /// The letter that gives way to the robot's own.
    fn other(&self, plain: char) -> Option<&'static Letter> {
        ALL.iter().find(|letter| letter.plain == plain && self.is_taken(letter))
    }

    /// Mathematics of the equations, as `M = Σ J_iᵇᵀ·ℳ_i·J_iᵇ`, with the letters that are left. Words of several letters, and
    /// what stands lowered, stay.
    pub fn unicode(&self, text: &str) -> String {
        let mut written = String::new();
        each_letter(text, |sign, is_letter| {
            let (plain, dot) = DOTTED
                .iter()
                .find(|(dotted, ..)| *dotted == sign)
                .map_or((sign, None), |(_, plain, dot)| (*plain, Some(*dot)));
            match self.other(plain).filter(|_| is_letter) {
                Some(letter) => written.extend(letter.unicode.chars().chain(dot)),
                None => written.push(sign),
            }
        });
        written
    }

    /// The same in LaTeX.
    pub fn latex(&self, text: &str) -> String {
        let mut written = String::new();
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            if first == OWN[0] {
                let (own, after) = rest[first.len_utf8()..].split_once(OWN[1]).unwrap_or((rest, ""));
                written.push_str(own);
                rest = after;
                continue;
            }
            let length = match first {
                '\\' => {
                    1 + rest[1..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len() - 1).max(1)
                }
                '_' | '^' => 1 + argument(&rest[1..]),
                _ => first.len_utf8(),
            };
            let (token, after) = rest.split_at(length);
            let is_other = token.strip_prefix('\\').is_some_and(|name| OTHERS.contains(&name));
            let (token, after) =
                if is_other { rest.split_at(length + argument(after)) } else { (token, after) };
            let letter = ALL.iter().find(|letter| letter.plain_latex == token && self.is_taken(letter));
            written.push_str(letter.map_or(token, |letter| letter.latex));
            rest = after;
        }
        // Those of what stands lowered.
        written.replace(OWN, "")
    }

    /// The letters of mathematics in Unicode that give way, each once.
    pub fn given_way(&self, text: &str) -> Vec<&'static Letter> {
        let mut found: Vec<&'static Letter> = Vec::new();
        each_letter(text, |sign, is_letter| {
            let plain =
                DOTTED.iter().find(|(dotted, ..)| *dotted == sign).map_or(sign, |(_, plain, _)| *plain);
            let letter = self.other(plain).filter(|_| is_letter);
            found.extend(letter.filter(|letter| found.iter().all(|known| known.plain != letter.plain)));
        });
        found
    }
}

/// What a page says of letters that gave way, one at least: `so 𝐌 is the mass matrix here, and ℒ the Lagrangian.`
pub fn told(given_way: &[&Letter], written: impl Fn(&Letter) -> String) -> String {
    let meaning = |(k, letter): (usize, &&Letter)| {
        let verb = if k == 0 { "is " } else { "" };
        format!("{} {verb}{}", written(letter), letter.meaning)
    };
    let all: Vec<String> = given_way.iter().enumerate().map(meaning).collect();
    let separator = if all.len() > 2 { ", and " } else { " and " };
    let all = match all.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{}{separator}{last}", others.join(", ")),
        _ => all.concat(),
    };
    format!("The robot's own letters keep their meaning, and those of the equations give way: {all}.")
}

/// What stands between these marks in mathematics is of the robot, and keeps its letters.
const OWN: [char; 2] = ['\u{e000}', '\u{e001}'];

/// Marks a part of mathematics, in either notation, as the robot's own. [`Letters::unicode`] and [`Letters::latex`] take the
/// marks away.
pub fn own(text: &str) -> String {
    format!("{}{text}{}", OWN[0], OWN[1])
}

/// Visits each sign of mathematics in Unicode, with whether it is a letter by itself: no part of a word, and not lowered.
/// Small changes and differentials are letters with a sign before them, as `δq` and `dt`.
fn each_letter(text: &str, mut visit: impl FnMut(char, bool)) {
    let is_letter = |c: char| c.is_alphabetic() && !matches!(c, 'ᵇ' | 'ᵀ');
    let signs: Vec<char> = text.chars().collect();
    let mut at = 0;
    while at < signs.len() {
        if signs[at] == OWN[0] {
            let own =
                signs[at + 1..].iter().take_while(|c| **c != OWN[1]).inspect(|c| visit(**c, false)).count();
            at += own + 2;
            continue;
        }
        let end = signs[at..].iter().position(|c| !is_letter(*c)).map_or(signs.len(), |length| at + length);
        let is_lowered = at > 0 && signs[at - 1] == '_';
        let is_alone = matches!(signs[at..end], [_] | ['δ' | 'd', _]);
        for sign in &signs[at..end] {
            visit(*sign, is_alone && !is_lowered);
        }
        at = end;
        if let Some(sign) = signs.get(end).filter(|sign| **sign != OWN[0]) {
            visit(*sign, false);
            at += 1;
        }
    }
}

/// The length of a command, which is a word or one sign.
fn command(text: &str) -> usize {
    let name = text[1..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len() - 1);
    let sign = text[1..].chars().next().map_or(0, char::len_utf8);
    1 + name.max(sign)
}

/// The length of what a command of LaTeX takes next, with the spaces before it: a group, a command, or a sign.
fn argument(text: &str) -> usize {
    let space = text.len() - text.trim_start().len();
    let rest = &text[space..];
    if rest.starts_with(OWN[0]) {
        return space + rest.find(OWN[1]).map_or(rest.len(), |end| end + OWN[1].len_utf8());
    }
    let mut depth = 0_usize;
    for (at, c) in rest.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            '\\' if depth == 0 => return space + command(rest),
            _ => {}
        }
        if depth == 0 {
            return space + at + c.len_utf8();
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::Letters;
    use crate::closed::{Name, Notation, Role};

    fn letters(fields: &[&str], coordinates: &[&str]) -> Letters {
        let mut notation = Notation::new();
        for field in fields {
            notation.add(Name::read(field), Role::Parameter);
        }
        for role in [Role::Coordinate, Role::Speed] {
            for coordinate in coordinates {
                let name = Name::read(coordinate);
                notation.add(if role == Role::Speed { name.dotted() } else { name }, role);
            }
        }
        Letters::of(&notation)
    }

    #[test]
    fn letters_give_way_where_a_robot_has_them() {
        let robot = letters(&["M", "L1", "J", "omega"], &["x", "theta"]);
        for (plain, other) in [
            ("M = Σ J_iᵇᵀ·ℳ_i·J_iᵇ", "𝐌 = Σ 𝐉_iᵇᵀ·ℳ_i·𝐉_iᵇ"),
            ("ẋ = f(x, u)", "𝐱\u{307} = f(𝐱, u)"),
            ("Ṁ = C + Cᵀ", "𝐌\u{307} = C + Cᵀ"),
            ("∂²T_terms/∂q̇²", "∂²T_terms/∂q̇²"),
            ("diag(m, m, m, 𝓘)", "diag(m, m, m, 𝓘)"),
            ("d/dt ∂L/∂q̇", "d/dt ∂ℒ/∂q̇"),
            ("δx = (δq, δq̇)", "δ𝐱 = (δq, δq̇)"),
            ("Vᵇ = (v, ω)", "Vᵇ = (v, 𝛚)"),
            ("C_ij = Σ_k Γ_ijk·q̇_k", "C_ij = Σ_k Γ_ijk·q̇_k"),
        ] {
            assert_eq!(robot.unicode(plain), other);
        }
        for (plain, other) in [
            (
                r"M = \sum_i {J_i^b}^T \mathcal M_i J_i^b",
                r"{\mathbf M} = \sum_i {{\mathbf J}_i^b}^T \mathcal M_i {\mathbf J}_i^b",
            ),
            (r"\dot x = f(x, u)", r"\dot {\mathbf x} = f({\mathbf x}, u)"),
            (
                r"\operatorname{diag}(m, \mathcal M)_M^{M} \text{M}",
                r"\operatorname{diag}(m, \mathcal M)_M^{M} \text{M}",
            ),
            (
                r"\frac{d}{dt} \frac{\partial L}{\partial \dot q}",
                r"\frac{d}{dt} \frac{\partial {\mathcal L}}{\partial \dot q}",
            ),
            (r"V^b = (v, \omega)", r"V^b = (v, {\boldsymbol\omega})"),
            (
                r"M_{\text{rotors}}^{-1} \left( M \right)\, M",
                r"{\mathbf M}_{\text{rotors}}^{-1} \left( {\mathbf M} \right)\, {\mathbf M}",
            ),
        ] {
            assert_eq!(robot.latex(plain), other);
        }
        assert_eq!(robot.unicode(&format!("∂L/∂{}L", super::own("L\u{307}₁ M"))), "∂ℒ/∂L\u{307}₁ Mℒ");
        assert_eq!(robot.latex(&format!("L_{}{}", super::own("{M}"), super::own("L"))), "{\\mathcal L}_{M}L");
        let given: Vec<&str> =
            robot.given_way("ẋ M L M_M J diag").iter().map(|letter| letter.unicode).collect();
        assert_eq!(given, ["𝐱", "𝐌", "ℒ", "𝐉"]);
    }

    #[test]
    fn coordinates_in_their_order_are_parts_of_their_vector() {
        for (coordinates, expected) in [
            (&["q1", "q2"][..], "q"),
            (&["q"], "q"),
            (&["q1"], "q"),
            (&["q2", "q1"], "𝐪"),
            (&["q", "theta"], "𝐪"),
            (&["theta", "q2"], "q"),
        ] {
            assert_eq!(letters(&[], coordinates).unicode("q"), expected, "{coordinates:?}");
        }
        assert_eq!(letters(&["q"], &["theta"]).unicode("q̇"), "𝐪\u{307}");
    }
}
