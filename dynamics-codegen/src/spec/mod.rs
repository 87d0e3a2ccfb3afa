//! What the user wrote, with its places and without judgement.
//!
//! The tokens of a derive are read here, and a URDF into the same types.

mod body;
mod cursor;
mod formula;
mod joint;
mod keys;
mod kind;
mod mimic;
mod moving;
mod options;
mod parts;
mod term;
mod text;
mod unit;
pub mod urdf;
mod values;

pub use body::{BodySpec, InertiaKind, InertiaSpec, Shape, Solid};
pub use cursor::nested_deeper_than;
pub use formula::{Factor, Formula, FormulaKind, Function, Term};
pub use joint::{Axis, AxisKind, JointAmendment, JointSpec, Placement, PlacementKind};
pub use keys::{JointKeys, Switch, default_friction_speed};
pub use kind::JointKind;
pub use mimic::{leaders, welded};
pub use moving::Moving;
pub use options::{BaseSpec, Options};
pub use term::{TermKind, TermSpec};
pub use text::plain;
pub use unit::Unit;

use std::fmt;

use cursor::Cursor;
use joint::JointLine;
use syn::spanned::Spanned;

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::symbolic::Number;

/// A name as written; the prefix of a raw identifier is not part of it.
#[derive(Clone, Debug)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Where it was written.
    pub place: Place,
}

impl Name {
    /// The name that an identifier is.
    pub fn new(ident: &proc_macro2::Ident) -> Self {
        let text = ident.to_string();
        let text = text.strip_prefix("r#").map(str::to_owned).unwrap_or(text);
        Self { text, place: ident.span().into() }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A field of the struct.
#[derive(Clone)]
pub struct Field {
    /// Its name.
    pub name: Name,
    /// Its identifier, for code.
    pub ident: syn::Ident,
    /// Its type.
    pub ty: syn::Type,
}

/// A robot as written.
#[derive(Clone)]
pub struct RobotSpec {
    /// The struct's name.
    pub ident: syn::Ident,
    /// The struct's visibility.
    pub vis: syn::Visibility,
    /// The struct's parameters, with their bounds.
    pub generics: syn::Generics,
    /// The struct's fields; none of a unit struct.
    pub fields: Vec<Field>,
    /// Fields that are numbers already, in SI units: as if these were written wherever their names are. A derive has none.
    pub known: Vec<(String, Number)>,
    /// `#[dynamics(…)]`
    pub options: Options,
    /// `#[joint(…)]`, in order.
    pub joints: Vec<JointSpec>,
    /// `#[joint(name, …)]` on joints of a file, until they are read.
    pub amendments: Vec<JointAmendment>,
    /// `#[body(…)]`, in order.
    pub bodies: Vec<BodySpec>,
    /// `#[potential(…)]`, `#[dissipation(…)]` and `#[kinetic(…)]`, in order.
    pub terms: Vec<TermSpec>,
}

impl RobotSpec {
    /// The struct's type parameters.
    pub fn type_parameters(&self) -> impl Iterator<Item = &syn::Ident> {
        self.generics.type_params().map(|parameter| &parameter.ident)
    }
}

/// Reads the input of the derive. What cannot be read is reported, and left out of the result.
pub fn parse(input: &syn::DeriveInput, diags: &mut Diagnostics) -> RobotSpec {
    let mut spec = RobotSpec {
        ident: input.ident.clone(),
        vis: input.vis.clone(),
        generics: input.generics.clone(),
        fields: fields(input, diags),
        known: vec![],
        options: Options::default(),
        joints: vec![],
        amendments: vec![],
        bodies: vec![],
        terms: vec![],
    };
    for (line, attribute) in input.attrs.iter().enumerate() {
        spec.read(attribute, line, diags);
    }
    spec
}

const HELPERS: [&str; 7] = ["dynamics", "joint", "body", "coordinate", "potential", "dissipation", "kinetic"];

/// Which helper attribute of the derive it is.
fn helper(attribute: &syn::Attribute) -> Option<&'static str> {
    HELPERS.into_iter().find(|helper| attribute.path().is_ident(helper))
}

impl RobotSpec {
    fn read(&mut self, attribute: &syn::Attribute, line: usize, diags: &mut Diagnostics) {
        let Some(helper) = helper(attribute) else { return };
        let place = Place::of(attribute);
        let syn::Meta::List(list) = &attribute.meta else {
            let message = format!("expected `#[{helper}(…)]`");
            diags.error(Code::Syntax, &place, message);
            return;
        };
        let input = Cursor::new(list.tokens.clone(), list.delimiter.span().close());
        match helper {
            "joint" => match JointLine::parse(input, place, line, diags) {
                Some(JointLine::Joint(joint)) => self.joints.push(*joint),
                Some(JointLine::Amendments(amendments)) => self.amendments.extend(amendments),
                None => {}
            },
            "body" => self.bodies.extend(BodySpec::parse(list.tokens.clone(), input, place, line, diags)),
            "coordinate" => self.joints.extend(JointSpec::coordinate(input, place, line, diags)),
            "potential" | "dissipation" | "kinetic" => {
                let kind = TermKind::named(helper);
                let term = kind.map(|kind| TermSpec::parse(kind, input, place));
                self.terms.extend(term.and_then(|term| diags.keep(term)));
            }
            _ => self.options.read(input, diags),
        }
    }
}

fn fields(input: &syn::DeriveInput, diags: &mut Diagnostics) -> Vec<Field> {
    let needed = |what: &str, place: &Place| {
        Diagnostic::new(Code::StructNeeded, place, format!("`{}` is {what}", input.ident))
    };
    match &input.data {
        syn::Data::Struct(data) => match &data.fields {
            syn::Fields::Named(named) => named.named.iter().filter_map(|found| field(found, diags)).collect(),
            syn::Fields::Unit => vec![],
            syn::Fields::Unnamed(unnamed) => {
                diags.push(needed("a tuple struct", &Place::of(unnamed)));
                vec![]
            }
        },
        syn::Data::Enum(data) => {
            diags.push(needed("an enum", &data.enum_token.span().into()));
            vec![]
        }
        syn::Data::Union(data) => {
            diags.push(needed("a union", &data.union_token.span().into()));
            vec![]
        }
    }
}

fn field(found: &syn::Field, diags: &mut Diagnostics) -> Option<Field> {
    for attribute in &found.attrs {
        if let Some(helper) = helper(attribute) {
            let message = format!("`#[{helper}]` is on a field");
            diags.error(Code::AttributeMisplaced, &Place::of(attribute), message);
        }
    }
    let ident = found.ident.clone()?;
    Some(Field { name: Name::new(&ident), ident, ty: found.ty.clone() })
}
