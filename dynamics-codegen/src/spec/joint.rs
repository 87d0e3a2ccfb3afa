//! `#[joint(name: kind(axis), parent -> child, …)]`, and `#[joint(name, …)]` of joints that a file has.

use proc_macro2::Delimiter;

use super::cursor::{Cursor, Result};
use super::keys::JointKeys;
use super::values::{self, Entry};
use super::{Formula, FormulaKind, JointKind, Name};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};

/// A joint as written.
#[derive(Clone, Debug)]
pub struct JointSpec {
    /// Its name.
    pub name: Name,
    /// How it moves.
    pub kind: JointKind,
    /// Where the kind was written.
    pub kind_place: Place,
    /// Its axes in the joint's frame, as many as were written.
    pub axes: Vec<Axis>,
    /// How far a helical joint slides for each radian.
    pub pitch: Option<Formula>,
    /// The body it is on.
    pub parent: Name,
    /// The body it carries.
    pub child: Name,
    /// Whether it is a mere coordinate, of which no body says where it is.
    pub is_bare: bool,
    /// All else.
    pub keys: Box<JointKeys>,
    /// The position of the line among all joints and bodies.
    pub line: usize,
    /// The whole of it.
    pub place: Place,
}

/// `#[joint(name, …)]`: more on a joint that a file has.
#[derive(Clone, Debug)]
pub struct JointAmendment {
    /// The joint's name.
    pub name: Name,
    /// What replaces what the file says, or adds to it.
    pub keys: Box<JointKeys>,
    /// The whole of it.
    pub place: Place,
}

/// A line of either form.
pub(super) enum JointLine {
    Joint(Box<JointSpec>),
    Amendments(Vec<JointAmendment>),
}

/// A direction as written.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What it is.
    pub kind: AxisKind,
    /// Where it was written.
    pub place: Place,
}

/// The forms of an [`Axis`].
#[derive(Clone, Debug)]
pub enum AxisKind {
    /// x, y or z (0, 1, 2), or its negative.
    Named {
        /// Which.
        index: usize,
        /// Whether it points the other way.
        negative: bool,
    },
    /// `[a, b, c]`, of any length but zero.
    Vector(Box<[Formula; 3]>),
}

/// A placement that defines the axis as well.
#[derive(Clone, Debug)]
pub struct Placement {
    /// What it is.
    pub kind: PlacementKind,
    /// Where it was written.
    pub place: Place,
}

/// The forms of a [`Placement`].
#[derive(Clone, Debug)]
pub enum PlacementKind {
    /// `dh(a, alpha, d, theta)`: `Rz(θ)·Tz(d)·Tx(a)·Rx(α)`
    Dh(Box<[Formula; 4]>),
    /// `mdh(a, alpha, d, theta)`: `Rx(α)·Tx(a)·Rz(θ)·Tz(d)`
    ModifiedDh(Box<[Formula; 4]>),
    /// `screw(axis, through)`: a line in the parent's frame.
    Screw {
        /// The direction of the line.
        axis: Axis,
        /// A point on it.
        through: Box<[Formula; 3]>,
    },
}

const XYZ: [&str; 3] = ["x", "y", "z"];

impl JointSpec {
    /// Whether the joint has coordinates of its own: it is neither welded nor does it follow another one.
    pub fn has_coordinates(&self) -> bool {
        self.kind != JointKind::Fixed && self.keys.locked.is_none() && self.keys.mimic.is_none()
    }

    /// Whether the joint's speeds have inputs: unless it is said, those of all but `free` ones.
    pub fn is_actuated(&self) -> bool {
        self.keys.actuated.as_ref().map_or(self.kind != JointKind::Free, |switch| switch.is_on)
    }
}

impl JointSpec {
    /// Reads `name: angle, key = value, …` or `name: length, …`: a coordinate without a body.
    pub(super) fn coordinate(
        input: Cursor,
        place: Place,
        line: usize,
        diags: &mut Diagnostics,
    ) -> Option<Self> {
        let mut items = input.items().into_iter();
        let missing = || Diagnostic::new(Code::Syntax, &place, "the coordinate has no `name: angle`");
        let head = items.next().ok_or_else(missing).and_then(|mut item| {
            let Some(name) = item.name() else { return Err(item.expected("the coordinate's name")) };
            if !item.punct(':') {
                return Err(item.expected("`:` after the coordinate's name"));
            }
            const KIND: &str = "`angle` or `length`";
            let Some(kind) = item.ident() else { return Err(item.expected(KIND)) };
            let kind_name = Name::new(&kind);
            let kind = match kind_name.text.as_str() {
                "angle" => JointKind::Revolute,
                "length" => JointKind::Prismatic,
                _ => {
                    let message = format!("expected {KIND}, found `{kind_name}`");
                    return Err(Diagnostic::new(Code::Syntax, &kind_name.place, message));
                }
            };
            item.finish("the coordinate's kind")?;
            Ok((name, kind, kind_name.place))
        });
        let form = |mistake: Diagnostic| match mistake.code {
            Code::Syntax => mistake.help("write `#[coordinate(theta: angle)]` or `#[coordinate(r: length)]`"),
            _ => mistake,
        };
        let head = diags.keep(head.map_err(form));
        let keys = Box::new(JointKeys::parse(items, diags));
        let (name, kind, kind_place) = head?;
        Some(Self {
            kind,
            axes: vec![Axis {
                kind: AxisKind::Named { index: 2, negative: false },
                place: kind_place.clone(),
            }],
            kind_place,
            pitch: None,
            parent: Name { text: "world".to_owned(), place: place.clone() },
            // No body can be called so.
            child: Name { text: format!("\0{name}"), place: name.place.clone() },
            name,
            is_bare: true,
            keys,
            line,
            place,
        })
    }
}

impl JointLine {
    /// Reads the contents of the attribute. Keys that fail are reported and left out.
    pub(super) fn parse(input: Cursor, place: Place, line: usize, diags: &mut Diagnostics) -> Option<Self> {
        let mut items = input.items();
        let names_a_joint = |first: &mut Cursor| first.is_a_name() || first.peek_group(Delimiter::Bracket);
        if items.len() > 1
            && !items.iter().any(Cursor::has_arrow)
            && items.first_mut().is_some_and(names_a_joint)
        {
            return Some(Self::Amendments(amendments(items, &place, diags)));
        }
        let keys = items.split_off(items.len().min(2)).into_iter();
        let mut items = items.into_iter();
        let head = items.next().ok_or_else(|| missing("name: kind(axis)", &place)).and_then(Head::parse);
        let edge = match (&head, items.next()) {
            (Err(_), None) => Ok(None),
            // The comma behind the head may be what is missing.
            (Err(mistake), Some(item)) if mistake.code == Code::Syntax => Ok(edge(item).ok()),
            (Ok(_), None) => Err(missing("parent -> child", &place)),
            (_, Some(item)) => edge(item).map(Some),
        };
        let form = |mistake: Diagnostic| match mistake.code {
            Code::Syntax => mistake.help("write `#[joint(name: kind(axis), parent -> child, …)]`"),
            _ => mistake,
        };
        let (head, edge) = (diags.keep(head.map_err(form)), diags.keep(edge.map_err(form)).flatten());
        let keys = Box::new(JointKeys::parse(keys, diags));
        let (Head { name, kind, kind_place, axes, pitch }, (parent, child)) = (head?, edge?);
        Some(Self::Joint(Box::new(JointSpec {
            name,
            kind,
            kind_place,
            axes,
            pitch,
            parent,
            child,
            is_bare: false,
            keys,
            line,
            place,
        })))
    }
}

/// `name, key = value, …`, or `[name, …], key = value, …` for all of these joints.
fn amendments(items: Vec<Cursor>, place: &Place, diags: &mut Diagnostics) -> Vec<JointAmendment> {
    let mut items = items.into_iter();
    let names = items.next().map_or(Ok(vec![]), |mut first| match first.group(Delimiter::Bracket)? {
        Some((mut list, _)) => {
            first.finish("the joints' names")?;
            if list.is_empty() {
                return Err(list.expected("the name of a joint"));
            }
            list.items().into_iter().map(|item| values::name(item, "the name of a joint")).collect()
        }
        None => Ok(vec![values::name(first, "the name of a joint")?]),
    });
    let keys = Box::new(JointKeys::parse(items, diags));
    let form = |mistake: Diagnostic| mistake.help("write `#[joint(name, …)]` or `#[joint([name, name], …)]`");
    let names: Vec<Name> = diags.keep(names.map_err(form)).unwrap_or_default();
    let of = |name| JointAmendment { name, keys: keys.clone(), place: place.clone() };
    names.into_iter().map(of).collect()
}

fn missing(what: &str, place: &Place) -> Diagnostic {
    Diagnostic::new(Code::Syntax, place, format!("the joint has no `{what}`"))
}

/// `name: kind(axis, …)`
struct Head {
    name: Name,
    kind: JointKind,
    kind_place: Place,
    axes: Vec<Axis>,
    pitch: Option<Formula>,
}

impl Head {
    fn parse(mut item: Cursor) -> Result<Self> {
        let Some(name) = item.name() else { return Err(item.expected("the joint's name")) };
        if !item.punct(':') {
            return Err(item.expected("`:` after the joint's name"));
        }
        let Some(kind) = item.ident() else { return Err(item.expected("the joint's kind")) };
        let kind_name = Name::new(&kind);
        let kind = JointKind::named(&kind_name)?;
        let (axes, pitch) = match item.group(Delimiter::Parenthesis)? {
            Some((inner, place)) => parts(kind, inner.items(), &place)?,
            None => (vec![], None),
        };
        item.finish("the joint's kind")?;
        Ok(Self { name, kind, kind_place: kind_name.place, axes, pitch })
    }
}

/// The axes, and the pitch of a helical joint, which may stand alone where the axis is given elsewhere.
fn parts(kind: JointKind, mut items: Vec<Cursor>, place: &Place) -> Result<(Vec<Axis>, Option<Formula>)> {
    let (count, needed) = (items.len(), kind.parts());
    let wrong = || {
        let help = format!("give {}: `{}`", needed.join(" and "), kind.example());
        values::count_wrong(count, place, kind.name(), needed).help(help)
    };
    let is_lone = kind == JointKind::Helical && count == 1;
    // The axis of a joint that has none is for those to judge who know why.
    if count > 0 && count != needed.len() && !needed.is_empty() && !is_lone {
        return Err(wrong());
    }
    let mut pitch = items.pop_if(|_| kind == JointKind::Helical);
    let is_vector = is_lone && pitch.as_mut().is_some_and(|item| item.peek_group(Delimiter::Bracket));
    let pitch = pitch.filter(|_| !is_vector).map(Formula::parse).transpose()?;
    if is_vector || (is_lone && pitch.as_ref().is_some_and(is_named_axis)) {
        return Err(wrong());
    }
    Ok((items.into_iter().map(Axis::parse).collect::<Result<_>>()?, pitch))
}

/// Whether a lone formula is an axis rather than a pitch.
fn is_named_axis(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Name(name) => XYZ.contains(&&*name.text),
        FormulaKind::Negative(inner) => is_named_axis(inner),
        _ => false,
    }
}

/// `parent -> child`
fn edge(mut item: Cursor) -> Result<(Name, Name)> {
    let Some(parent) = item.name() else { return Err(item.expected("`parent -> child`")) };
    if !(item.punct('-') && item.punct('>')) {
        return Err(item.expected("`->` between the parent and the child"));
    }
    let Some(child) = item.name() else { return Err(item.expected("the body that the joint carries")) };
    item.finish("the child")?;
    Ok((parent, child))
}

impl Axis {
    pub(super) fn parse(mut input: Cursor) -> Result<Self> {
        let place = input.place();
        if input.peek_group(Delimiter::Bracket) {
            let kind = AxisKind::Vector(Box::new(values::vector(input, "axis", XYZ)?));
            return Ok(Self { kind, place });
        }
        const AXIS: &str = "an axis: x, y, z, -x, -y, -z or `[a, b, c]`";
        let negative = input.punct('-');
        let Some(ident) = input.ident() else { return Err(input.expected(AXIS)) };
        let Some(index) = XYZ.iter().position(|known| ident == known) else {
            let message = format!("expected {AXIS}, found `{ident}`");
            return Err(Diagnostic::new(Code::Syntax, &place, message));
        };
        input.finish("the axis")?;
        Ok(Self { kind: AxisKind::Named { index, negative }, place })
    }
}

impl Placement {
    /// Reads `dh(…)`, `mdh(…)` or `screw(…)`.
    pub(super) fn parse(mut entry: Entry) -> Result<Self> {
        let place = entry.place.clone();
        const PARTS: [&str; 4] = ["a", "alpha", "d", "theta"];
        let kind = match entry.key.text.as_str() {
            "dh" => PlacementKind::Dh(Box::new(entry.arguments(PARTS)?)),
            "mdh" => PlacementKind::ModifiedDh(Box::new(entry.arguments(PARTS)?)),
            _ => {
                let (contents, inner) = entry.parenthesised()?;
                let items = contents.items();
                let count = items.len();
                let Ok([axis, mut through]) = <[Cursor; 2]>::try_from(items) else {
                    return Err(values::count_wrong(count, &inner, "screw", &["an axis", "a point on it"]));
                };
                if through.ident().is_some_and(|key| key == "through") && !through.punct('=') {
                    return Err(through.expected("`=` after `through`"));
                }
                let through = Box::new(values::vector(through, "through", XYZ)?);
                PlacementKind::Screw { axis: Axis::parse(axis)?, through }
            }
        };
        Ok(Self { kind, place })
    }
}
