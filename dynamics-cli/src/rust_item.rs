//! A robot's struct as it was written, for a file of its code.

use dynamics_codegen::spec::RobotSpec;

use crate::rust_file::text_of;

/// A struct as it was written, by the name of the specification, public, and without what asks for the derive.
pub(crate) fn written(text: &str, item: &syn::DeriveInput, spec: &RobotSpec) -> String {
    let name = &spec.ident;
    let is_derive = |attribute: &&syn::Attribute| attribute.path().is_ident("derive");
    let mut lines: Vec<String> = item
        .attrs
        .iter()
        .filter(is_documentation)
        .map(|attribute| text_of(text, attribute).to_owned())
        .collect();
    let traits: Vec<String> =
        item.attrs.iter().filter(is_derive).flat_map(|derive| other_traits(text, derive)).collect();
    if !traits.is_empty() {
        lines.push(format!("#[derive({})]", traits.join(", ")));
    }
    let generics = text_of(text, &item.generics);
    let bounds = item.generics.where_clause.as_ref().map_or("", |bounds| text_of(text, bounds));
    let syn::Data::Struct(syn::DataStruct { fields: syn::Fields::Named(named), .. }) = &item.data else {
        let bounds = if bounds.is_empty() { String::new() } else { format!(" {bounds}") };
        lines.push(format!("pub struct {name}{generics}{bounds};"));
        return lines.join("\n") + "\n";
    };
    // A field that is a number need not be there; but a parameter of the struct must be used.
    let is_known = |ident: &syn::Ident| spec.known.iter().any(|(known, _)| ident == known);
    let is_left =
        |field: &&syn::Field| !spec.generics.params.is_empty() || !field.ident.as_ref().is_some_and(is_known);
    if !named.named.iter().any(|field| is_left(&field)) {
        lines.push(format!("pub struct {name};"));
        return lines.join("\n") + "\n";
    }
    let bounds = if bounds.is_empty() { " {".to_owned() } else { format!("\n{bounds}\n{{") };
    lines.push(format!("pub struct {name}{generics}{bounds}"));
    for field in named.named.iter().filter(is_left) {
        let documented = field.attrs.iter().filter(is_documentation);
        lines.extend(documented.map(|attribute| format!("    {}", text_of(text, attribute))));
        let field_name = field.ident.as_ref().map(ToString::to_string).unwrap_or_default();
        lines.push(format!("    pub {field_name}: {},", text_of(text, &field.ty)));
    }
    lines.push("}".to_owned());
    lines.join("\n") + "\n"
}

/// Whether an attribute is a comment for readers.
fn is_documentation(attribute: &&syn::Attribute) -> bool {
    attribute.path().is_ident("doc")
}

/// The traits of a derive that are not `Dynamics`.
fn other_traits(text: &str, derive: &syn::Attribute) -> Vec<String> {
    let list = syn::punctuated::Punctuated::<syn::Path, syn::Token![,]>::parse_terminated;
    let traits = derive.parse_args_with(list).unwrap_or_default();
    let is_other = |path: &&syn::Path| path.segments.last().is_some_and(|last| last.ident != "Dynamics");
    traits.iter().filter(is_other).map(|path| text_of(text, path).to_owned()).collect()
}
