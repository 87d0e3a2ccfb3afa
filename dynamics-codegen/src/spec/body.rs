//! `#[body(name, mass = …, com = […], inertia = …, …)]`

use proc_macro2::{Delimiter, TokenStream};

use super::cursor::{Cursor, Result};
use super::joint::{Axis, AxisKind};
use super::values::{self, Entry, fill};
use super::{Formula, Name};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};

/// A body as written.
#[derive(Clone, Debug)]
pub struct BodySpec {
    /// Its name.
    pub name: Name,
    /// `mass = …`
    pub mass: Option<Formula>,
    /// `com = […]`
    pub com: Option<[Formula; 3]>,
    /// `inertia = …`, about the centre of mass.
    pub inertia: Option<InertiaSpec>,
    /// `inertia_rpy = […]`
    pub inertia_rpy: Option<[Formula; 3]>,
    /// `solid = …`
    pub solid: Option<Solid>,
    /// `allow(…)`
    pub allow: Option<Vec<Name>>,
    /// The contents of the attribute.
    pub written: TokenStream,
    /// The position of the line among all joints and bodies.
    pub line: usize,
    /// The whole of it.
    pub place: Place,
}

/// An inertia as written.
#[derive(Clone, Debug)]
pub struct InertiaSpec {
    /// What it is.
    pub kind: InertiaKind,
    /// Where it was written.
    pub place: Place,
}

/// The forms of an inertia.
#[derive(Clone, Debug)]
pub enum InertiaKind {
    /// `diag(ixx, iyy, izz)`
    Diagonal(Box<[Formula; 3]>),
    /// `tensor(ixx, ixy, ixz, iyy, iyz, izz)`
    Tensor(Box<[Formula; 6]>),
    /// `[[…], […], […]]`
    Matrix(Box<[[Formula; 3]; 3]>),
}

/// A homogeneous solid as written.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Its form.
    pub shape: Shape,
    /// Its mass.
    pub mass: Box<Formula>,
    /// Where it was written.
    pub place: Place,
}

/// The forms of a [`Solid`], about their centres.
#[derive(Clone, Debug)]
pub enum Shape {
    /// `cuboid(m, [l, w, h])`: the edges along x, y and z.
    Cuboid(Box<[Formula; 3]>),
    /// `cylinder(m, radius, length, axis)`; the axis is 0, 1 or 2.
    Cylinder(Box<[Formula; 2]>, usize),
    /// `sphere(m, radius)`
    Sphere(Box<Formula>),
    /// `rod(m, length, axis)`
    Rod(Box<Formula>, usize),
    /// `point(m)`
    Point,
}

const KEYS: &[&str] = &["mass", "com", "inertia", "inertia_rpy", "solid", "allow"];
const XYZ: [&str; 3] = ["x", "y", "z"];

impl BodySpec {
    /// Reads the contents of the attribute. Options that fail are reported and left out.
    pub(super) fn parse(
        written: TokenStream,
        input: Cursor,
        place: Place,
        line: usize,
        diags: &mut Diagnostics,
    ) -> Option<Self> {
        let mut items = input.items().into_iter();
        let missing = || Diagnostic::new(Code::Syntax, &place, "the body has no name");
        let name = items.next().ok_or_else(missing).and_then(|item| values::name(item, "the body's name"));
        let name = diags.keep(name.map_err(|mistake| mistake.help("write `#[body(name, mass = …, …)]`")));
        let mut body = Self {
            name: name.clone().unwrap_or_else(|| Name { text: String::new(), place: place.clone() }),
            mass: None,
            com: None,
            inertia: None,
            inertia_rpy: None,
            solid: None,
            allow: None,
            written,
            line,
            place: place.clone(),
        };
        for item in items {
            if let Some(entry) = diags.keep(Entry::parse(item, "key of a body", KEYS)) {
                body.read(entry, diags);
            }
        }
        name.map(|_| body)
    }

    fn read(&mut self, entry: Entry, diags: &mut Diagnostics) {
        let key = entry.key.clone();
        match key.text.as_str() {
            "mass" => fill(&mut self.mass, &key, entry.scalar(), diags),
            "com" => fill(&mut self.com, &key, entry.vector(XYZ), diags),
            "inertia" => fill(&mut self.inertia, &key, inertia(entry), diags),
            "inertia_rpy" => fill(&mut self.inertia_rpy, &key, entry.vector(["roll", "pitch", "yaw"]), diags),
            "solid" => fill(&mut self.solid, &key, solid(entry), diags),
            _ => fill(&mut self.allow, &key, entry.names(), diags),
        }
    }
}

fn inertia(entry: Entry) -> Result<InertiaSpec> {
    let mut value = entry.assigned()?;
    let place = value.place();
    if let Some((rows, inner)) = value.group(Delimiter::Bracket)? {
        value.finish("`]`")?;
        let kind = InertiaKind::Matrix(Box::new(matrix(rows, &inner)?));
        return Ok(InertiaSpec { kind, place });
    }
    let form = Entry::parse(value, "form of an inertia", &["diag", "tensor"])?;
    let kind = match form.key.text.as_str() {
        "diag" => InertiaKind::Diagonal(Box::new(form.arguments(["ixx", "iyy", "izz"])?)),
        _ => InertiaKind::Tensor(Box::new(form.arguments(["ixx", "ixy", "ixz", "iyy", "iyz", "izz"])?)),
    };
    Ok(InertiaSpec { kind, place })
}

fn matrix(rows: Cursor, place: &Place) -> Result<[[Formula; 3]; 3]> {
    let mut rows = rows.items();
    if rows.len() == 3 && !rows.iter_mut().any(|row| row.peek_group(Delimiter::Bracket)) {
        let message = "`inertia` is a list of three, and neither a diagonal nor a matrix";
        let wrong = Diagnostic::new(Code::Syntax, place, message);
        return Err(wrong.help("write `diag(ixx, iyy, izz)`, or all rows: `[[…], […], […]]`"));
    }
    let wrong =
        values::count_wrong(rows.len(), place, "inertia", &["three rows of three: [[…]", "[…]", "[…]]"]);
    let rows = rows.into_iter().map(|row| values::vector(row, "row", XYZ)).collect::<Result<Vec<_>>>()?;
    rows.try_into().map_err(|_| wrong)
}

const SHAPES: &[&str] = &["cuboid", "cylinder", "sphere", "rod", "point"];

fn solid(entry: Entry) -> Result<Solid> {
    let value = entry.assigned()?;
    let place = value.place();
    let mut form = Entry::parse(value, "solid", SHAPES)?;
    let (contents, inner) = form.parenthesised()?;
    let mut items = contents.items();
    let shape_name = form.key.text.as_str();
    let parts: &[&str] = match shape_name {
        "cuboid" => &["a mass", "the edges [x, y, z]"],
        "cylinder" => &["a mass", "a radius", "a length", "(if not z) an axis"],
        "sphere" => &["a mass", "a radius"],
        "rod" => &["a mass", "a length", "(if not z) an axis"],
        _ => &["a mass"],
    };
    let directed = matches!(shape_name, "cylinder" | "rod");
    let axis =
        if directed && items.len() == parts.len() { items.pop().map(named_axis).transpose()? } else { None };
    let needed = parts.len() - usize::from(directed);
    if items.len() != needed {
        return Err(values::count_wrong(items.len(), &inner, shape_name, &parts[..needed]));
    }
    let mut items = items.into_iter();
    let mut next =
        || items.next().unwrap_or_else(|| Cursor::new(TokenStream::new(), proc_macro2::Span::call_site()));
    let mass = Box::new(Formula::parse(next())?);
    let axis = axis.unwrap_or(2);
    let shape = match shape_name {
        "cuboid" => Shape::Cuboid(Box::new(values::vector(next(), "cuboid", XYZ)?)),
        "cylinder" => Shape::Cylinder(Box::new([Formula::parse(next())?, Formula::parse(next())?]), axis),
        "sphere" => Shape::Sphere(Box::new(Formula::parse(next())?)),
        "rod" => Shape::Rod(Box::new(Formula::parse(next())?), axis),
        _ => Shape::Point,
    };
    Ok(Solid { shape, mass, place })
}

/// An axis of a solid of revolution, which has no sign.
fn named_axis(item: Cursor) -> Result<usize> {
    let axis = Axis::parse(item)?;
    match axis.kind {
        AxisKind::Named { index, negative: false } => Ok(index),
        _ => Err(Diagnostic::new(Code::Syntax, &axis.place, "expected an axis: x, y or z")
            .help("turn the solid by `inertia_rpy` if its axis is oblique")),
    }
}
