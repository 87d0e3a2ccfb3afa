//! The struct that the code is for, as far as the emitter needs to know it.

use quote::ToTokens as _;

use crate::model::{FieldType, Model};
use crate::spec::RobotSpec;

/// What kind of struct the robot is declared on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Form {
    /// `struct Robot<T> { … }`: generic in its scalar.
    Generic {
        /// The type parameter's name.
        parameter: String,
        /// Its bounds as written, without the colon.
        bounds: String,
    },
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
    /// The path of the run-time crate.
    pub core: String,
}

impl Item {
    /// The item that was derived for.
    pub fn of(spec: &RobotSpec, model: &Model<'_>) -> Self {
        let form = match &model.field_type {
            FieldType::Generic(parameter) => {
                let bounds = spec
                    .generics
                    .type_params()
                    .find(|known| known.ident == *parameter)
                    .map(|known| known.bounds.to_token_stream().to_string());
                Form::Generic { parameter: parameter.to_string(), bounds: bounds.unwrap_or_default() }
            }
            FieldType::F32 => Form::Concrete("f32"),
            FieldType::F64 => Form::Concrete("f64"),
            FieldType::Unused => Form::Unit,
        };
        let visibility = spec.vis.to_token_stream().to_string();
        let visibility = if visibility.is_empty() { visibility } else { visibility + " " };
        let core = spec.options.crate_path().to_token_stream().to_string().replace(' ', "");
        Self { name: spec.ident.to_string(), visibility, form, core }
    }
}
