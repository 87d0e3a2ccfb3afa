//! `#[joint(name: kind(axis), parent -> child, …)]`

use proc_macro2::Delimiter;

use super::cursor::{Cursor, Result};
use super::values::{self, Entry, fill};
use super::{Formula, Name};
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
    /// Its axis in the joint's frame.
    pub axis: Option<Axis>,
    /// The body it is on.
    pub parent: Name,
    /// The body it carries.
    pub child: Name,
    /// `at = [x, y, z]`
    pub at: Option<[Formula; 3]>,
    /// `rpy = [r, p, y]`
    pub rpy: Option<[Formula; 3]>,
    /// `dh(…)`, `mdh(…)` or `screw(…)`.
    pub placement: Option<Placement>,
    /// `limits = [lower, upper]`
    pub limits: Option<[Formula; 2]>,
    /// `velocity = …`
    pub velocity: Option<Formula>,
    /// `effort = …`
    pub effort: Option<Formula>,
    /// The position of the line among all joints and bodies.
    pub line: usize,
    /// The whole of it.
    pub place: Place,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns, between limits if it has some.
    Revolute,
    /// Turns without end.
    Continuous,
    /// Slides.
    Prismatic,
    /// Does not move.
    Fixed,
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

const KEYS: &[&str] = &["at", "rpy", "dh", "mdh", "screw", "limits", "velocity", "effort"];
const XYZ: [&str; 3] = ["x", "y", "z"];

impl JointSpec {
    /// Reads the contents of the attribute. Options that fail are reported and left out.
    pub(super) fn parse(input: Cursor, place: Place, line: usize, diags: &mut Diagnostics) -> Option<Self> {
        let mut items = input.items().into_iter();
        let head = items.next().ok_or_else(|| missing("name: kind(axis)", &place)).and_then(head);
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
        let mut options = Options::default();
        for item in items {
            if let Some(entry) = diags.keep(Entry::parse(item, "key of a joint", KEYS)) {
                options.read(entry, diags);
            }
        }
        let ((name, kind, kind_place, axis), (parent, child)) = (head?, edge?);
        let Options { at, rpy, placement, limits, velocity, effort } = options;
        Some(Self {
            name,
            kind,
            kind_place,
            axis,
            parent,
            child,
            at,
            rpy,
            placement,
            limits,
            velocity,
            effort,
            line,
            place,
        })
    }
}

#[derive(Default)]
struct Options {
    at: Option<[Formula; 3]>,
    rpy: Option<[Formula; 3]>,
    placement: Option<Placement>,
    limits: Option<[Formula; 2]>,
    velocity: Option<Formula>,
    effort: Option<Formula>,
}

impl Options {
    fn read(&mut self, entry: Entry, diags: &mut Diagnostics) {
        let key = entry.key.clone();
        match key.text.as_str() {
            "at" => fill(&mut self.at, &key, entry.vector(XYZ), diags),
            "rpy" => fill(&mut self.rpy, &key, entry.vector(["roll", "pitch", "yaw"]), diags),
            "limits" => fill(&mut self.limits, &key, entry.vector(["lower", "upper"]), diags),
            "velocity" => fill(&mut self.velocity, &key, entry.scalar(), diags),
            "effort" => fill(&mut self.effort, &key, entry.scalar(), diags),
            _ => fill(&mut self.placement, &key, placement(entry), diags),
        }
    }
}

fn missing(what: &str, place: &Place) -> Diagnostic {
    Diagnostic::new(Code::Syntax, place, format!("the joint has no `{what}`"))
}

/// `name: kind(axis)`
fn head(mut item: Cursor) -> Result<(Name, JointKind, Place, Option<Axis>)> {
    let Some(name) = item.ident() else { return Err(item.expected("the joint's name")) };
    if !item.punct(':') {
        return Err(item.expected("`:` after the joint's name"));
    }
    let Some(kind) = item.ident() else { return Err(item.expected("the joint's kind")) };
    let kind_name = Name::new(&kind);
    let kind = JointKind::named(&kind_name)?;
    let axis = match item.group(Delimiter::Parenthesis)? {
        Some((inner, _)) => Some(Axis::parse(inner)?),
        None => None,
    };
    item.finish("the joint's kind")?;
    Ok((Name::new(&name), kind, kind_name.place, axis))
}

/// `parent -> child`
fn edge(mut item: Cursor) -> Result<(Name, Name)> {
    let Some(parent) = item.ident() else { return Err(item.expected("`parent -> child`")) };
    if !(item.punct('-') && item.punct('>')) {
        return Err(item.expected("`->` between the parent and the child"));
    }
    let Some(child) = item.ident() else { return Err(item.expected("the body that the joint carries")) };
    item.finish("the child")?;
    Ok((Name::new(&parent), Name::new(&child)))
}

impl JointKind {
    const ALL: [(&'static str, Self); 4] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
    ];

    fn named(name: &Name) -> Result<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name.text);
        found.map(|(_, kind)| *kind).ok_or_else(|| {
            let message = format!("there is no kind of joint `{name}`");
            let known = Self::ALL.iter().map(|(known, _)| *known);
            let unknown = Diagnostic::new(Code::JointKindUnknown, &name.place, message);
            match name.text.as_str() {
                "ball" | "spherical" | "free" | "floating" | "planar" | "universal" | "cylindrical"
                | "helical" => unknown
                    .help("use a chain of revolute and prismatic joints; a body between two needs no mass"),
                _ => unknown.suggest(&name.text, known),
            }
        })
    }
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

fn placement(mut entry: Entry) -> Result<Placement> {
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
    Ok(Placement { kind, place })
}
