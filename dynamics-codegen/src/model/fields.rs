//! The fields that the equations use: their common type, their units, and values to try.

use quote::ToTokens;

use super::dimensions::{Units, is_quantity, unit_of};
use super::quantities::{Quantity, Slot};
use super::values::{Values, for_each_name};
use super::{FieldType, Parameter};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{Field, RobotSpec};
use crate::symbolic::{Number, SymbolId};

/// The type that all fields in use have.
pub(super) fn field_type(spec: &RobotSpec, values: &Values, diags: &mut Diagnostics) -> Option<FieldType> {
    let mut common: Option<(&Field, FieldType)> = None;
    for field in values.inputs().map(|field| &spec.fields[field]) {
        let Some(own) = diags.keep(type_of(field, spec)) else { continue };
        match &common {
            None => common = Some((field, own)),
            Some((_, first)) if *first == own => {}
            Some((first_field, first)) => {
                let (a, b) = (&first_field.name, &field.name);
                let message = format!("the field `{a}` is `{first}`, and the field `{b}` is `{own}`");
                diags.error(Code::FieldTypesDiffer, &field.name.place, message);
            }
        }
    }
    let mut parameters = spec.type_parameters();
    let of_struct = match (parameters.next(), parameters.next()) {
        (Some(only), None) => FieldType::Generic(only.clone()),
        _ => FieldType::Unused,
    };
    Some(common.map_or(of_struct, |(_, common)| common))
}

fn type_of(field: &Field, spec: &RobotSpec) -> Result<FieldType, Diagnostic> {
    let ident = match bare(&field.ty) {
        syn::Type::Path(path) if path.qself.is_none() => path.path.get_ident(),
        _ => None,
    };
    let generic = ident.and_then(|ident| spec.type_parameters().find(|parameter| *parameter == ident));
    match (generic, ident) {
        (Some(parameter), _) => Ok(FieldType::Generic(parameter.clone())),
        (None, Some(ident)) if ident == "f64" => Ok(FieldType::F64),
        (None, Some(ident)) if ident == "f32" => Ok(FieldType::F32),
        _ => {
            let ty: String =
                field.ty.to_token_stream().to_string().chars().filter(|c| *c != ' ').take(48).collect();
            let message =
                format!("the robot uses the field `{}`, and its type `{ty}` is no scalar", field.name);
            Err(Diagnostic::new(Code::FieldTypeUnsupported, &field.name.place, message))
        }
    }
}

/// The type without parentheses, and without the invisible groups that macros make.
fn bare(mut ty: &syn::Type) -> &syn::Type {
    loop {
        ty = match ty {
            syn::Type::Group(group) => &group.elem,
            syn::Type::Paren(paren) => &paren.elem,
            _ => return ty,
        };
    }
}

/// The parameters, in order of declaration.
pub(super) fn parameters(values: &Values, units: &Units, slots: &[Slot]) -> Vec<Parameter> {
    let mut products = vec![false; values.fields().len()];
    for slot in slots.iter().filter(|slot| slot.quantity == Quantity::ProductOfInertia) {
        for_each_name(slot.formula, &mut |name| {
            if let Some(field) = values.field(name) {
                products[field] = true;
            }
        });
    }
    let parameter = |(k, field): (usize, usize)| {
        let unit = units.of_field(field);
        Parameter {
            name: values.fields()[field].name.text.clone(),
            symbol: SymbolId(u32::try_from(k).unwrap_or(u32::MAX)),
            sample: sample(k, unit, products[field]),
            unit: unit.map(unit_of),
            exponents: unit,
        }
    };
    values.inputs().enumerate().map(parameter).collect()
}

/// A value for the parameter `k`: distinct, of the size robots have, and such that inertias obey the triangle
/// rule by a wide margin.
fn sample(k: usize, unit: Option<[Number; 3]>, product_of_inertia: bool) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let spread = ((k + 1) as f64 * GOLDEN).fract();
    let is = |quantity| unit.is_some_and(|unit| is_quantity(unit, quantity));
    let (from, to) = match () {
        () if product_of_inertia => (0.001, 0.003),
        () if is(Quantity::Mass) => (0.5, 3.0),
        () if is(Quantity::Length) => (0.3, 0.8),
        () if is(Quantity::Inertia) => (0.04, 0.07),
        () if is(Quantity::Angle) => (0.2, 0.7),
        () if is(Quantity::Acceleration) => (9.0, 10.0),
        () => (0.5, 1.5),
    };
    ((from + (to - from) * spread) * 1e4).round() / 1e4
}
