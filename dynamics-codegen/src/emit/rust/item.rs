//! The struct that the code is for, as far as the emitter needs to know it.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::model::{FieldType, Model};
use crate::spec::RobotSpec;

/// What kind of struct the robot is declared on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Form {
    /// `struct Robot<T> { … }`: generic in its scalar, the type parameter of this name.
    Generic(String),
    /// Fields of one floating-point type.
    Concrete(&'static str),
    /// No fields that matter: the equations serve every scalar.
    Unit,
}

/// The Rust item that the code is for.
#[derive(Clone, Debug)]
pub struct Item {
    /// The struct's name.
    pub name: String,
    /// Its visibility as written, with a trailing space if there is one.
    pub visibility: String,
    /// Its form.
    pub form: Form,
    /// Its parameters with their bounds, and that of a scalar: `'a`, `T: Scalar + Copy`.
    pub parameters: Vec<String>,
    /// Its parameters without bounds, in brackets if there are any: `<'a, T, const N: usize>`.
    pub declared: String,
    /// Their names: `<'a, T, N>`.
    pub arguments: String,
    /// Its where-clause, with a leading space if there is one.
    pub clause: String,
    /// The path of the run-time crate.
    pub core: String,
}

impl Item {
    /// The item that was derived for.
    pub fn of(spec: &RobotSpec, model: &Model<'_>) -> Self {
        let form = match &model.field_type {
            FieldType::Generic(parameter) => Form::Generic(parameter.to_string()),
            FieldType::F32 => Form::Concrete("f32"),
            FieldType::F64 => Form::Concrete("f64"),
            FieldType::Unused => Form::Unit,
        };
        let bare = without_bounds(&spec.generics);
        let (declared, arguments, _) = bare.split_for_impl();
        let (_, _, clause) = spec.generics.split_for_impl();
        let visibility = text(&spec.vis);
        let clause = text(&clause);
        Self {
            name: spec.ident.to_string(),
            visibility: if visibility.is_empty() { visibility } else { visibility + " " },
            parameters: spec.generics.params.iter().map(|parameter| with_bounds(parameter, &form)).collect(),
            declared: text(&declared),
            arguments: text(&arguments),
            clause: if clause.is_empty() { clause } else { format!(" {clause}") },
            core: text(&spec.options.crate_path()).replace(' ', ""),
            form,
        }
    }

    /// The name without the prefix of a raw identifier.
    pub fn bare_name(&self) -> &str {
        self.name.strip_prefix("r#").unwrap_or(&self.name)
    }

    /// `wanted`, or something like it that is neither the struct's name nor one of its parameters.
    pub fn free_type_name(&self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        let is_taken = |name: &str| {
            let mut words = self.declared.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            self.name == name || words.any(|word| word == name)
        };
        while is_taken(&name) {
            name.push('_');
        }
        name
    }
}

/// The parameters without their bounds and defaults.
pub(super) fn without_bounds(generics: &syn::Generics) -> syn::Generics {
    let mut bare = generics.clone();
    for parameter in &mut bare.params {
        match parameter {
            syn::GenericParam::Type(known) => {
                known.bounds.clear();
                known.default = None;
            }
            syn::GenericParam::Lifetime(known) => known.bounds.clear(),
            syn::GenericParam::Const(known) => known.default = None,
        }
    }
    bare
}

/// A parameter as an impl declares it; the scalar is bounded by `Scalar` as well.
fn with_bounds(parameter: &syn::GenericParam, form: &Form) -> String {
    let is_scalar = |ident: &syn::Ident| *form == Form::Generic(ident.to_string());
    bounded(parameter, is_scalar).to_string()
}

/// A parameter as an impl declares it, bounded by `Scalar` as well if it is the scalar.
pub(super) fn bounded(parameter: &syn::GenericParam, is_scalar: impl Fn(&syn::Ident) -> bool) -> TokenStream {
    match parameter {
        syn::GenericParam::Type(known) => {
            let (ident, bounds) = (&known.ident, &known.bounds);
            match (is_scalar(ident), bounds.is_empty()) {
                (true, true) => quote!(#ident: Scalar),
                (true, false) => quote!(#ident: Scalar + #bounds),
                (false, true) => quote!(#ident),
                (false, false) => quote!(#ident: #bounds),
            }
        }
        syn::GenericParam::Lifetime(known) => quote!(#known),
        syn::GenericParam::Const(known) => {
            let (ident, ty) = (&known.ident, &known.ty);
            quote!(const #ident: #ty)
        }
    }
}

fn text(syntax: &impl ToTokens) -> String {
    syntax.to_token_stream().to_string()
}
