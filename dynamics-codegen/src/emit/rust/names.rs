//! Which names are those of variables in Rust.

/// The functions that generated code calls by their names.
pub(super) const CALLED: &[&str] = &[
    "madd",
    "sin_cos",
    "sin_cos_each",
    "sqrt",
    "of",
    "of_each",
    "each",
    "vector",
    "columns",
    "forward_from_inverse",
    "inverse_of",
];

/// Whether a local variable may have the name of the field: no keyword, nothing that is called, and no capitals,
/// as constants and unit structs have, which a pattern would compare with.
pub(super) fn is_plain(field: &str) -> bool {
    keyword_safe(field) == field && !CALLED.contains(&field) && !field.contains(char::is_uppercase)
}

/// The identifier of a field: raw, if its name is a keyword.
pub(super) fn keyword_safe(field: &str) -> String {
    if syn::parse_str::<syn::Ident>(field).is_ok() { field.to_owned() } else { format!("r#{field}") }
}
