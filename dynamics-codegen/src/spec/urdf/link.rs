//! `<link name="…">` with its `<inertial>`.

use super::elements::Element;
use super::numbers::value;
use super::reader::Reader;
use crate::diagnostics::{Code, Diagnostic};
use crate::spec::{BodySpec, Formula, InertiaKind, InertiaSpec};
use crate::symbolic::Number;

const TENSOR: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

/// The body that a link is. Without `<inertial>`, it has no mass.
pub(super) fn read<'a>(reader: &mut Reader<'_>, element: Element<'a>, line: usize) -> Option<BodySpec> {
    let [name] = reader.texts(element, ["name"]);
    let name = reader.name(name, element)?;
    reader.enter("link", &name);
    let mut body = BodySpec {
        name,
        mass: None,
        com: None,
        inertia: None,
        inertia_rpy: None,
        solid: None,
        allow: None,
        written: proc_macro2::TokenStream::new(),
        line,
        place: element.place(),
    };
    let [inertial] = reader.elements(element, ["inertial"]);
    if let Some(inertial) = inertial {
        read_inertial(reader, inertial, &mut body);
    }
    reader.report.links += 1;
    reader.report.mass += body.mass.as_ref().and_then(value).map_or(0.0, Number::to_f64);
    Some(body)
}

fn read_inertial<'a>(reader: &mut Reader<'_>, inertial: Element<'a>, body: &mut BodySpec) {
    let [origin, mass, inertia] = reader.elements(inertial, ["origin", "mass", "inertia"]);
    let _: [_; 0] = reader.texts(inertial, []);
    [body.com, body.inertia_rpy] = reader.origin(origin);
    if let Some(mass) = reader.needed(mass, "`<mass value=\"…\"/>`", inertial) {
        let _: [_; 0] = reader.elements(mass, []);
        let [text] = reader.texts(mass, ["value"]);
        let text = reader.needed(text, "`value`", mass);
        body.mass = text.and_then(|text| reader.scalar(text, None));
    }
    let is_massless = body.mass.as_ref().and_then(value).is_some_and(Number::is_zero);
    match inertia {
        Some(inertia) => body.inertia = tensor(reader, inertia),
        None if is_massless => {}
        None if body.mass.is_some() => {
            let message = format!("{} has a mass, and no inertia", reader.owner());
            let missing = Diagnostic::new(Code::InertiaMissing, &inertial.place(), message);
            let help = "add `<inertia ixx=\"…\" ixy=\"…\" ixz=\"…\" iyy=\"…\" iyz=\"…\" izz=\"…\"/>`; zeros make it a point mass";
            reader.diags.push(missing.help(help));
        }
        None => {}
    }
}

/// All six components, none of which has a default.
fn tensor<'a>(reader: &mut Reader<'_>, element: Element<'a>) -> Option<InertiaSpec> {
    let _: [_; 0] = reader.elements(element, []);
    let texts = reader.texts(element, TENSOR);
    let mut parts = Vec::with_capacity(TENSOR.len());
    for (name, text) in TENSOR.iter().zip(texts) {
        let text = reader.needed(text, &format!("`{name}`"), element);
        parts.extend(text.and_then(|text| reader.scalar(text, None)));
    }
    let parts: Box<[Formula; 6]> = parts.try_into().ok()?;
    Some(InertiaSpec { kind: InertiaKind::Tensor(parts), place: element.place() })
}
