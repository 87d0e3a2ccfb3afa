//! The compiler behind `dynamics-core`: a robot's specification in, its specialised equations of motion out.
//!
//! ```text
//! tokens ─► RobotSpec ─► Model ─► Equation ─► Program ─► text
//!         spec        model    mechanics    passes     emit
//! ```
//!
//! An ordinary library: the derive macro of `dynamics-macros` is one call of [`derive()`], and tests, build
//! scripts and command lines may make the same one. It does no input or output, depends on no clock and no
//! hash order, and never panics on any input: a panic is a bug of this crate.

pub mod closed;
pub mod diagnostics;
pub mod emit;
pub mod mechanics;
pub mod model;
pub mod passes;
pub mod spatial;
pub mod spec;
pub mod symbolic;

use diagnostics::{Code, Diagnostic, Diagnostics};
use passes::RunTime;
use proc_macro2::{Span, TokenStream};
use spec::RobotSpec;
use spec::urdf::{Report, Urdf};
use symbolic::Graph;

/// Robots of more links have no equations in closed form in their code.
const LINKS_IN_CLOSED_FORM: usize = 4;
/// Nor have those whose equations need more names for their parts: nobody reads them.
const NAMES_IN_CLOSED_FORM: usize = 24;

/// The deepest nesting of groups that is read at all: what reads tokens recurses.
const NESTING_LIMIT: usize = 64;

/// Expands `#[derive(Dynamics)]`.
///
/// Wrong input becomes `compile_error!`s at the user's tokens and a stub of every impl, so that one mistake in
/// a robot is reported once and not again at every use of the robot. A file that the robot names is had from
/// `read`, by its path from the crate's root: the compiler itself reads none.
pub fn derive(input: TokenStream, read: impl FnOnce(&str) -> Result<Vec<u8>, String>) -> TokenStream {
    let mut diags = Diagnostics::new();
    if diags.keep(check_nesting(&input)).is_none() {
        return diags.into_compile_errors();
    }
    let input: syn::DeriveInput = match syn::parse2(input) {
        Ok(input) => input,
        Err(error) => return error.into_compile_error(),
    };
    match generate_with(&input, read) {
        Ok(text) => text.parse().expect("generated text is made of whole tokens"),
        Err(diagnostics) => {
            let mut again = Diagnostics::new();
            let file = spec::parse(&input, &mut again).options.urdf;
            again.take(); // they are among the others
            let mut tokens = match file {
                Some(path) => diagnostics.into_compile_errors_of(&path.place),
                None => diagnostics.into_compile_errors(),
            };
            tokens.extend(emit::rust::stub(&input));
            tokens
        }
    }
}

/// A `read` for [`derive()`] where there are no files.
///
/// # Errors
///
/// Always.
pub fn no_files(_: &str) -> Result<Vec<u8>, String> {
    Err("there are no files here".to_owned())
}

/// The code for a robot whose struct says all, as text.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
pub fn generate(input: &syn::DeriveInput) -> Result<String, Diagnostics> {
    generate_with(input, no_files)
}

/// The code for a robot, as text; a file that it names is had from `read`, and tracked by the code.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
pub fn generate_with(
    input: &syn::DeriveInput,
    read: impl FnOnce(&str) -> Result<Vec<u8>, String>,
) -> Result<String, Diagnostics> {
    let (spec, _) = read_struct(input, read)?;
    let code = generate_rust(&spec)?;
    let Some(path) = &spec.options.urdf else { return Ok(code) };
    // The path is one of the crate: absolute, the code would differ from machine to machine.
    let tracked = format!(
        "const _: &[u8] = ::core::include_bytes!(::core::concat!(::core::env!(\"CARGO_MANIFEST_DIR\"), {:?}));\n",
        format!("/{}", path.text)
    );
    Ok(code + &tracked)
}

/// The robot of a struct as it was written, and what became of the file that it names, if it names one: that is had from
/// `read`.
///
/// # Errors
///
/// All mistakes in the attributes, or in the file.
pub fn read_struct(
    input: &syn::DeriveInput,
    read: impl FnOnce(&str) -> Result<Vec<u8>, String>,
) -> Result<(RobotSpec, Option<Report>), Diagnostics> {
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(input, &mut diags); //            what was written
    diags.check()?;
    let Some(path) = spec.options.urdf.clone() else { return Ok((spec, None)) };
    let checked = spec::urdf::check_path(&path);
    let bytes = checked.and_then(|()| {
        read(&path.text).map_err(|why| {
            let message = format!("the file `{}` cannot be read: {why}", path.text);
            Diagnostic::new(Code::FileUnreadable, &path.place, message)
        })
    });
    let mut report = None;
    if let Some(bytes) = diags.keep(bytes)
        && let Some(text) = diags.keep(spec::urdf::text_of(&path.text, &bytes))
    {
        report = Some(spec::urdf::read(&mut spec, Urdf { file: &path.text, text }, &mut diags));
    }
    diags.check()?;
    Ok((spec, report))
}

/// The robot of a URDF as it was written, for a public unit struct `name`, and what became of the file. `attributes`
/// stand on the struct, as `#[dynamics(snap = off)] #[joint(elbow, damping = 0.1)]`.
///
/// # Errors
///
/// All mistakes in the attributes, or in the file.
pub fn read_urdf(name: &str, urdf: Urdf<'_>, attributes: &str) -> Result<(RobotSpec, Report), Diagnostics> {
    read_urdf_with(name, &[], urdf, attributes)
}

/// [`read_urdf`] for a struct with these fields, which the attributes may use.
///
/// # Errors
///
/// All mistakes in names and attributes, or in the file.
pub fn read_urdf_with(
    name: &str,
    fields: &[&str],
    urdf: Urdf<'_>,
    attributes: &str,
) -> Result<(RobotSpec, Report), Diagnostics> {
    let mut diags = Diagnostics::new();
    let (ident, attributes) = (diags.keep(identifier(name)), diags.keep(read_attributes(attributes)));
    let idents: Vec<_> = fields.iter().filter_map(|field| diags.keep(identifier(field))).collect();
    diags.check()?;
    let (Some(ident), Some(attributes)) = (ident, attributes) else { return Err(diags) };
    let input = match idents.as_slice() {
        [] => syn::parse_quote!(#(#attributes)* pub struct #ident;),
        fields => syn::parse_quote!(#(#attributes)* pub struct #ident<T> { #(pub #fields: T),* }),
    };
    let mut spec = spec::parse(&input, &mut diags);
    if let Some(path) = &spec.options.urdf {
        diags.error(Code::KeysConflict, &path.place, "the file is given already");
    }
    diags.check()?;
    let report = spec::urdf::read(&mut spec, urdf, &mut diags);
    diags.check()?;
    Ok((spec, report))
}

/// The name of a struct. It has no place: nobody wrote the struct.
fn identifier(name: &str) -> Result<syn::Ident, Diagnostic> {
    let place = Span::call_site().into();
    let wrong = |error| Diagnostic::new(Code::Syntax, &place, format!("the name `{name}`: {error}"));
    let mut ident = syn::parse_str::<syn::Ident>(name).map_err(wrong)?;
    ident.set_span(Span::call_site());
    Ok(ident)
}

/// Attributes as they stand on a struct.
///
/// # Errors
///
/// What is no attribute in the text.
pub fn read_attributes(text: &str) -> Result<Vec<syn::Attribute>, Diagnostic> {
    let wrong = |error: syn::Error| Diagnostic::new(Code::Syntax, &error.span().into(), error.to_string());
    let tokens: TokenStream = text.parse().map_err(|error: proc_macro2::LexError| wrong(error.into()))?;
    check_nesting(&tokens)?;
    syn::parse::Parser::parse2(syn::Attribute::parse_outer, tokens).map_err(wrong)
}

/// What reads tokens recurses.
fn check_nesting(tokens: &TokenStream) -> Result<(), Diagnostic> {
    if !spec::nested_deeper_than(tokens, NESTING_LIMIT) {
        return Ok(());
    }
    let message = format!("groups are nested more than {NESTING_LIMIT} deep");
    Err(Diagnostic::new(Code::NestingTooDeep, &Span::call_site().into(), message))
}

/// The code for the robot of a URDF, for build scripts and command lines: that which the derive on
/// `pub struct name;` with these attributes has, without the struct and without tracking the file.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
pub fn generate_urdf(name: &str, urdf: Urdf<'_>, attributes: &str) -> Result<String, Diagnostics> {
    let (spec, _) = read_urdf(name, urdf, attributes)?;
    generate_rust(&spec)
}

/// The code for a robot that was read: all but its struct.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
pub fn generate_rust(spec: &RobotSpec) -> Result<String, Diagnostics> {
    check_types(spec)?;
    let graph = Graph::new();
    let (model, compiled) = checked(spec, &graph, RunTime::Core)?;
    let item = emit::rust::Item::of(spec, &model);
    // Of large robots they are too long, and finding that out takes its time.
    let is_short = model.tree.links.len() <= LINKS_IN_CLOSED_FORM;
    let closed = is_short.then(|| mechanics::closed::closed_forms(&model, &graph).ok()).flatten();
    let closed = closed.filter(|closed| closed.definitions.len() <= NAMES_IN_CLOSED_FORM);
    let (item, model, compiled) = (&item, &model, &compiled);
    Ok(emit::rust::implementation(&emit::rust::Input { item, model, compiled, closed: closed.as_ref() }))
}

/// A robot in C, with everything about it named by `prefix`; `origin` says in its first lines where it comes from.
///
/// # Errors
///
/// All mistakes of the first phase that found any, and [`Code::NumberOutOfRange`] where a number is too large for the
/// type.
///
/// # Panics
///
/// If [`emit::c::check_prefix`] refuses the prefix.
pub fn generate_c(
    spec: &RobotSpec,
    prefix: &str,
    real: emit::c::Real,
    origin: &[String],
) -> Result<emit::c::Files, Diagnostics> {
    assert_eq!(emit::c::check_prefix(prefix), Ok(()), "a prefix is checked before");
    let graph = Graph::new();
    let (model, compiled) = checked(spec, &graph, RunTime::None)?;
    let mut diags = Diagnostics::new();
    if emit::c::overflows(&compiled, real) {
        let message = format!("the numbers of `{}` are too large for `{}`", spec.ident, real.name());
        diags.error(Code::NumberOutOfRange, &spec.ident.span().into(), message);
    }
    diags.check()?;
    Ok(emit::c::files(&emit::c::Input { prefix, real, origin, model: &model, compiled: &compiled }))
}

/// A robot judged, and its programs: the whole compiler between reading and writing, in order. Each phase sees only
/// the one before it, and runs only if that found nothing wrong.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
pub fn checked<'g>(
    spec: &RobotSpec,
    graph: &'g Graph,
    run_time: RunTime,
) -> Result<(model::Model<'g>, passes::Compiled<'g>), Diagnostics> {
    let model = judged(spec, graph)?; //      a checked kinematic tree
    let mut diags = Diagnostics::new();
    let outputs =
        spec.options.outputs.as_ref().map(|names| names.iter().map(|name| &*name.text).collect::<Vec<_>>());
    let methods = passes::methods(outputs.as_deref(), &model, run_time);
    check_lengths(spec, &passes::without_terms(&methods, &model, run_time), &mut diags);
    diags.check()?;
    let compiled = passes::compile(&model, graph, &methods, run_time); // derived, simplified, scheduled
    check_constants(spec, &compiled, &mut diags);
    diags.check()?;
    check_against_plain_recursion(spec, &model, &compiled, &mut diags);
    diags.check()?;
    Ok((model, compiled))
}

/// A robot as judged, of which nothing has been derived.
///
/// # Errors
///
/// All mistakes of the first phase that found any.
///
/// # Panics
///
/// Never but by a bug of this crate.
pub fn judged<'g>(spec: &RobotSpec, graph: &'g Graph) -> Result<model::Model<'g>, Diagnostics> {
    let mut diags = Diagnostics::new();
    let model = model::build(spec, graph, &mut diags);
    diags.check()?;
    let model = model.expect("a model that is not built has been complained about");
    check_terms(spec, &model, graph, &mut diags);
    check_motions(spec, &model, graph, &mut diags);
    diags.check()?;
    Ok(model)
}

/// Bodies are types in Rust, and nowhere else. What else is wrong is said with those that cannot be.
fn check_types(spec: &RobotSpec) -> Result<(), Diagnostics> {
    let mut diags = Diagnostics::new();
    model::names::check_types(spec, &mut diags);
    if !diags.is_empty() {
        let others = judged(spec, &Graph::new()).err();
        others.into_iter().flat_map(|mut others| others.take()).for_each(|other| diags.push(other));
    }
    diags.check()
}

/// What cannot be seen in a formula: points that are always one, and what is always zero.
fn check_terms(spec: &RobotSpec, model: &model::Model<'_>, graph: &Graph, diags: &mut Diagnostics) {
    use mechanics::plain::Flaw;
    use spec::TermKind::{Dissipation, Kinetic, Potential};
    if spec.terms.is_empty() {
        return;
    }
    let of_kind = |kind| spec.terms.iter().filter(move |term| term.kind == kind);
    let terms = [Potential, Dissipation, Kinetic].into_iter().flat_map(of_kind);
    for (term, flaw) in terms.zip(mechanics::terms::flaws(model, graph)) {
        let formula = &term.formula;
        let (code, fact) = match flaw {
            Some(Flaw::DivisionByZero) => {
                (Code::DivisionByZero, "divides by what is zero in every configuration")
            }
            Some(Flaw::NoDistance) => (Code::TermIdle, "has a distance that is zero in every configuration"),
            Some(Flaw::ForceAtRest) => (Code::ForceAtRest, "acts at rest, or is not smooth there"),
            Some(Flaw::Drives) => (Code::PassiveNegative, "drives what it should resist"),
            None => continue,
        };
        diags.error(code, &formula.place, format!("`{}` {fact}", formula.short_text()));
    }
    let first = spec.terms.iter().find(|term| term.kind == Kinetic);
    if let Some(first) = first.filter(|_| diags.is_empty())
        && mechanics::singular::idle_motion(model, graph).is_none()
        && mechanics::terms::is_indefinite(model, graph)
    {
        let message = "with the kinetic terms, some motion has negative energy: M is not positive definite";
        diags.error(Code::KineticNegative, &first.place, message);
    }
}

/// Bodies that are sound one by one can leave joints whose motions cancel each other.
fn check_motions(spec: &spec::RobotSpec, model: &model::Model<'_>, graph: &Graph, diags: &mut Diagnostics) {
    let Some(idle) = mechanics::singular::idle_motion(model, graph) else { return };
    let moving = model.joints.iter().filter(|joint| idle.iter().any(|speed| joint.v.contains(speed)));
    let of_spec = |moving: &model::JointInfo| spec.joints.iter().find(|joint| joint.name.text == moving.name);
    let joints: Vec<_> = moving.filter_map(of_spec).collect();
    let names: Vec<_> = joints.iter().map(|joint| format!("`{}`", joint.name)).collect();
    let message = match names.as_slice() {
        [only] if idle.len() == 1 => format!("the joint {only} moves no inertia in any configuration"),
        [only] => format!("the joint {only} can move without moving any mass: M is singular"),
        _ => format!(
            "the joints {} can move together without moving any mass: M is singular",
            names.join(", ")
        ),
    };
    let place = joints.first().map_or_else(|| spec.ident.span().into(), |joint| joint.name.place.clone());
    let mistake = Diagnostic::new(Code::MassMatrixSingular, &place, message);
    diags.push(match names.len() {
        1 => mistake
            .help("give a body that it moves more mass or inertia, or use a joint that moves in fewer ways"),
        _ => mistake,
    });
}

/// What would be a recursion over a table of links, or calls one, which has no terms.
fn check_lengths(spec: &RobotSpec, methods: &[mechanics::equations::Method], diags: &mut Diagnostics) {
    if let (false, Some(term)) = (methods.is_empty(), spec.terms.first()) {
        let names: Vec<_> = methods.iter().map(|method| format!("`{}`", method.name())).collect();
        let message = format!(
            "a robot with terms in its energies is written without loops, and {} would be too long for a compiler",
            names.join(", ")
        );
        diags.error(Code::TermsUnsupported, &term.place, message);
    }
}

/// Numbers that are sound one by one can have products beyond the range of doubles.
fn check_constants(spec: &spec::RobotSpec, compiled: &passes::Compiled<'_>, diags: &mut Diagnostics) {
    if compiled.programs().any(passes::Program::has_constant_out_of_range) {
        let message = format!("the numbers of `{}` are too large: their products overflow", spec.ident);
        diags.error(Code::NumberOutOfRange, &spec.ident.span().into(), message);
    }
}

/// The expansion checks itself: a program that computes something else is a mistake of the compiler.
fn check_against_plain_recursion(
    spec: &spec::RobotSpec,
    model: &model::Model<'_>,
    compiled: &passes::Compiled<'_>,
    diags: &mut Diagnostics,
) {
    for found in passes::disagreements(model, compiled) {
        let method = found.method.name();
        let message =
            format!("the generated `{method}` is off by {:.1e} from the plain recursion", found.error);
        diags.error(Code::SelfCheckFailed, &spec.ident.span().into(), message);
    }
}
