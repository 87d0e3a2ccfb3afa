//! Reads elements by what they may contain, and keeps account of the rest.

use super::elements::{Element, Text};
use super::numbers;
use super::report::{Note, Report};
use super::source::{quoted, turns_text};
use super::tree::Parts;
use super::{MISTAKE_LIMIT, joint, link};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place, did_you_mean};
use crate::spec::{Formula, Name, Unit};
use crate::symbolic::Number;

/// The longest name, in characters.
const NAME_LIMIT: usize = 256;

/// What is known while a document is read.
pub(super) struct Reader<'d> {
    pub(super) diags: &'d mut Diagnostics,
    pub(super) report: Report,
    /// Whether damping and friction are wanted.
    pub(super) passive: bool,
    /// As in "the joint `q1`".
    owner: String,
}

impl<'d> Reader<'d> {
    pub(super) fn new(passive: bool, diags: &'d mut Diagnostics) -> Self {
        Self { diags, report: Report::default(), passive, owner: "the robot".to_owned() }
    }

    /// `<robot>`
    pub(super) fn robot<'a>(&mut self, robot: Element<'a>) -> Parts {
        let mut parts = Parts::default();
        if robot.tag() != "robot" {
            let message = format!("the file is no URDF: its root is `<{}>`", robot.tag());
            self.diags.error(Code::RobotMissing, &robot.place(), message);
            return parts;
        }
        let [name, _] = self.texts(robot, ["name", "version"]);
        self.report.robot = name.map(|name| name.value.to_owned());
        for (line, element) in robot.children().enumerate() {
            match element.tag() {
                "link" if element.is_plain() => parts.links.extend(link::read(self, element, line)),
                "joint" if element.is_plain() => parts.joints.extend(joint::read(self, element, line)),
                tag => {
                    self.owner = "the robot".to_owned();
                    self.unknown(element, &["link", "joint"]);
                    if tag == "transmission" {
                        self.list_reductions(element);
                    }
                }
            }
            if self.diags.len() >= MISTAKE_LIMIT {
                break;
            }
        }
        parts
    }

    /// From here on, mistakes are of this joint or link.
    pub(super) fn enter(&mut self, kind: &str, name: &Name) {
        self.owner = format!("the {kind} {}", quoted(&name.text));
    }

    /// As in "the joint `q1`".
    pub(super) fn owner(&self) -> &str {
        &self.owner
    }

    /// The elements of an element: each of those that are known, at most once.
    pub(super) fn elements<'a, const N: usize>(
        &mut self,
        element: Element<'a>,
        known: [&str; N],
    ) -> [Option<Element<'a>>; N] {
        let mut found = [None; N];
        for child in element.children() {
            match known.iter().position(|known| *known == child.tag()).filter(|_| child.is_plain()) {
                Some(k) if found[k].is_none() => found[k] = Some(child),
                Some(_) => {
                    let message = format!("{} has two `<{}>`", self.owner, child.tag());
                    self.diags.error(Code::KeyDuplicate, &child.place(), message);
                }
                // A slip is one mistake: what was meant is not missing as well.
                None => {
                    let meant = self.unknown(child, &known);
                    let slot = known.iter().zip(&mut found).find(|(known, _)| meant == Some(**known));
                    if let Some((_, slot)) = slot {
                        slot.get_or_insert(child);
                    }
                }
            }
        }
        found
    }

    /// An element that is not read: a slip of the pen, then what was meant, or something to list.
    fn unknown<'k>(&mut self, element: Element<'_>, known: &[&'k str]) -> Option<&'k str> {
        let tag = element.tag();
        if element.is_xacro() {
            let message = format!("`<xacro:{tag}>` is left in the file");
            self.diags.error(Code::XacroLeft, &element.place(), message);
        } else if let Some(meant) = did_you_mean(tag, known.iter().copied()) {
            let message = format!("{} has an element {}", self.owner, quoted(tag));
            let unknown = Diagnostic::new(Code::KeyUnknown, &element.place(), message);
            self.diags.push(unknown.help(format!("did you mean `{meant}`?")));
            return Some(meant);
        } else {
            self.ignore(format!("`<{tag}>`"), element.place());
        }
        None
    }

    /// Lists the gears of a transmission: without the inertia of a rotor they say nothing.
    fn list_reductions(&mut self, transmission: Element<'_>) {
        let (mut joint, mut reductions) = (None, vec![]);
        for element in transmission.descendants() {
            match element.tag() {
                "joint" => joint = element.texts().find(|text| text.name == "name"),
                "mechanicalReduction" => reductions.push(element),
                _ => {}
            }
        }
        for reduction in reductions {
            let of = joint.map_or(String::new(), |name| format!(" of the joint {}", quoted(name.value)));
            let text = format!(
                "`<mechanicalReduction>` {}{of}: `rotor` and `gear` on the struct say what it moves",
                quoted(reduction.content())
            );
            self.report.ignored.push(Note::new(text, reduction.place()));
        }
    }

    /// The attributes of an element, by name.
    pub(super) fn texts<'a, const N: usize>(
        &mut self,
        element: Element<'a>,
        known: [&str; N],
    ) -> [Option<Text<'a>>; N] {
        let mut found = [None; N];
        for text in element.texts() {
            if let Some(k) = known.iter().position(|known| *known == text.name) {
                found[k] = Some(text);
            } else if let Some(meant) = did_you_mean(text.name, known) {
                let message = format!("{} has an attribute {}", self.owner, text.what());
                let unknown = Diagnostic::new(Code::KeyUnknown, &text.place(), message);
                self.diags.push(unknown.help(format!("did you mean `{meant}`?")));
                let slot = known.iter().zip(&mut found).find(|(known, _)| **known == meant);
                if let Some((_, slot)) = slot {
                    slot.get_or_insert(text);
                }
            } else {
                self.ignore(text.what(), text.place());
            }
        }
        found
    }

    /// Lists something as ignored.
    pub(super) fn ignore(&mut self, what: impl std::fmt::Display, place: Place) {
        let text = format!("{what} of {}", self.owner);
        self.report.ignored.push(Note::new(text, place));
    }

    /// Lists something as remarkable.
    pub(super) fn remark(&mut self, text: impl Into<String>, place: Place) {
        self.report.remarks.push(Note::new(text, place));
    }

    /// Something that an element must have.
    pub(super) fn needed<T>(&mut self, found: Option<T>, what: &str, within: Element<'_>) -> Option<T> {
        if found.is_none() {
            let owner = match within.tag() {
                "link" | "joint" => self.owner.clone(),
                tag => format!("`<{tag}>` of {}", self.owner),
            };
            let message = format!("{owner} has no {what}");
            let missing = Diagnostic::new(Code::ElementMissing, &within.place(), message);
            self.diags.push(missing.help(format!("add {what}")));
        }
        found
    }

    /// The name of a link or a joint.
    pub(super) fn name<'a>(&mut self, text: Option<Text<'a>>, element: Element<'a>) -> Option<Name> {
        let tag = element.tag();
        let Some(text) = text else {
            let message = format!("the {tag} has no name");
            let missing = Diagnostic::new(Code::ElementMissing, &element.place(), message);
            self.diags.push(missing.help(format!("write `<{tag} name=\"…\">`")));
            return None;
        };
        self.named(text, tag)
    }

    /// A name that is fit for one, of an element with the tag.
    pub(super) fn named<'a>(&mut self, text: Text<'a>, tag: &str) -> Option<Name> {
        let name = self.reference(text)?;
        let value = name.text.as_str();
        let wrong = if value.trim().is_empty() {
            "is empty".to_owned()
        } else if value.chars().any(char::is_control) {
            format!("{} has control characters", quoted(value))
        } else if value.chars().any(turns_text) {
            format!("{} has characters that turn the direction of text", quoted(value))
        } else if value.chars().nth(NAME_LIMIT).is_some() {
            format!("{} has more than {NAME_LIMIT} characters", quoted(value))
        } else {
            return Some(name);
        };
        let message = format!("the name of the {tag} {wrong}");
        self.diags.error(Code::NameReserved, &name.place, message);
        None
    }

    /// A name, as it stands.
    pub(super) fn reference<'a>(&mut self, text: Text<'a>) -> Option<Name> {
        match numbers::xacro_left(&text) {
            Some(left) => {
                self.diags.push(left);
                None
            }
            None => Some(Name { text: text.value.to_owned(), place: text.place() }),
        }
    }

    /// The number of an attribute.
    pub(super) fn scalar<'a>(&mut self, text: Text<'a>, unit: Option<Unit>) -> Option<Formula> {
        let number = numbers::scalar(&text, unit).map_err(|wrong| self.owned(wrong));
        self.diags.keep(number)
    }

    /// The three numbers of an attribute.
    pub(super) fn vector<'a>(
        &mut self,
        text: Text<'a>,
        parts: [&str; 3],
        unit: Option<Unit>,
    ) -> Option<[Formula; 3]> {
        let vector = numbers::vector(&text, parts, unit).map_err(|wrong| self.owned(wrong));
        self.diags.keep(vector)
    }

    /// Says in a mistake whose it is.
    fn owned(&self, mut wrong: Diagnostic) -> Diagnostic {
        wrong.message = format!("{}: {}", self.owner, wrong.message);
        wrong
    }

    /// `<origin xyz="…" rpy="…">`; what is not given is zero.
    pub(super) fn origin<'a>(&mut self, element: Option<Element<'a>>) -> [Option<[Formula; 3]>; 2] {
        let Some(element) = element else { return [None, None] };
        self.elements(element, []);
        let [xyz, rpy] = self.texts(element, ["xyz", "rpy"]);
        let xyz = xyz.and_then(|text| self.vector(text, ["x", "y", "z"], None));
        let rpy = rpy.and_then(|text| self.vector(text, ["roll", "pitch", "yaw"], Unit::named("rad")));
        for angle in rpy.iter().flatten() {
            self.look_at_angle(angle);
        }
        [xyz, rpy]
    }

    /// Suspects an angle of a frame that looks like degrees, and tells of one next to a right angle.
    fn look_at_angle(&mut self, formula: &Formula) {
        use std::f64::consts::{FRAC_PI_2, TAU};
        let angle = numbers::value(formula).map_or(0.0, Number::to_f64);
        let quarters = (angle / FRAC_PI_2).round();
        if angle.abs() > TAU {
            self.suspect_degrees(formula);
        } else if angle != 0.0 && (angle - quarters * FRAC_PI_2).abs() <= 1e-11 {
            let text = format!("{formula} in {} is taken as {}°", self.owner, 90.0 * quarters);
            self.report.snapped.push(Note::new(text, formula.place.clone()));
        }
    }

    /// Suspects a limit of more than three turns.
    pub(super) fn look_at_limit(&mut self, formula: &Formula) {
        let angle = numbers::value(formula).map_or(0.0, Number::to_f64);
        if angle.abs() > 3.0 * std::f64::consts::TAU {
            self.suspect_degrees(formula);
        }
    }

    fn suspect_degrees(&mut self, formula: &Formula) {
        let text = format!("{formula} in {} looks like degrees: it is taken as radians", self.owner);
        self.report.suspicions.push(Note::new(text, formula.place.clone()));
    }
}
