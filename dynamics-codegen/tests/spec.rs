//! From tokens to a checked model: what specifications mean.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::model::{self, Model, Motion};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph};

/// The model of a specification without mistakes.
fn model<'g>(graph: &'g Graph, text: &str) -> Model<'g> {
    let mut diags = Diagnostics::new();
    let input = syn::parse_str(text).unwrap();
    let spec = spec::parse(&input, &mut diags);
    let model = model::build(&spec, graph, &mut diags);
    let errors = diags.into_text();
    model.unwrap_or_else(|| panic!("{errors}"))
}

const ROBOJUDGE: &str = r"
    #[derive(Dynamics)]
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(theta1: revolute(z), world -> column)]
    #[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
    #[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1], limits = [-90deg, 1.5], effort = 100)]
    #[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
    pub struct RoboJudge<T> {
        pub m1: T, pub m2: T, pub l1: T, pub r0: T, pub r1: T, pub g: T, pub unused: String,
        pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T, pub iz2: T,
    }";

/// The values of expressions where the parameter `k` is `k + 1`.
fn values<'g, const N: usize>(graph: &'g Graph, exprs: [Expr<'g>; N]) -> [f64; N] {
    let mut evaluator = Evaluator::new(graph, |symbol| f64::from(symbol.0 + 1));
    exprs.map(|expr| evaluator.value(expr))
}

#[test]
fn the_robojudge_is_read_as_written() {
    let graph = Graph::new();
    let model = model(&graph, ROBOJUDGE);
    let names: Vec<_> = model.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names.join(" "), "m1 m2 l1 r0 r1 g ix1 iy1 iz1 ix2 iy2 iz2");
    let [column, arm] = &model.tree.links[..] else { panic!("two links") };
    assert_eq!((column.parent, arm.parent, arm.motion), (None, Some(0), Motion::Revolute));
    assert_eq!(values(&graph, [column.inertia.mass, arm.inertia.mass]), [1.0, 2.0]);
    assert_eq!(values(&graph, column.inertia.first.0), [0.0, 0.0, 4.0]);
    assert_eq!(values(&graph, arm.placement.translation.0), [0.0, 0.0, 3.0]);
    assert_eq!(values(&graph, arm.placement.rotation.column(2).0), [-1.0, 0.0, 0.0]);
    assert_eq!(values(&graph, model.tree.gravity.0), [0.0, 0.0, -6.0]);
    let frame = &model.tree.frames[1];
    let com = frame.pose.inverse().transform_point(arm.inertia.first);
    assert_eq!((frame.name.as_str(), values(&graph, com.0)), ("arm", [0.0, 10.0, 0.0]));
    let limits = model.joints[1].limits[0];
    assert_eq!([limits.lower, limits.upper, limits.effort], [-std::f64::consts::FRAC_PI_2, 1.5, 100.0]);
}

/// The units and the samples of the parameters.
fn units(text: &str) -> String {
    let graph = Graph::new();
    let model = model(&graph, text);
    let describe =
        |p: &model::Parameter| format!("{}: {} ({})", p.name, p.unit.as_deref().unwrap_or("?"), p.sample);
    model.parameters.iter().map(describe).collect::<Vec<_>>().join(", ")
}

#[test]
fn fields_get_their_units_from_their_uses() {
    insta::assert_snapshot!(units(ROBOJUDGE), @"m1: kg (2.0451), m2: kg (1.0902), l1: m (0.7271), r0: m (0.5361), r1: m (0.3451), g: m/s² (9.7082), ix1: kg·m² (0.0498), iy1: kg·m² (0.0683), iz1: kg·m² (0.0569), ix2: kg·m² (0.0454), iy2: kg·m² (0.064), iz2: kg·m² (0.0525)");
    let derived = r"
        #[dynamics(gravity = [0, 0, -weight / load])]
        #[joint(q: revolute(z), world -> a, at = [reach / 2, root * root + 0.1, stretch * reach], rpy = [0, turn + 1, 0])]
        #[body(a, mass = load + 0.5, com = [reach, 0, 1cm * count], inertia = tensor(
            load * (reach * reach + 2 * width * width) / 12, skew, 0, density * reach * reach * width * width, 0, 1.5))]
        struct Crane { load: f32, reach: f32, root: f32, stretch: f32, turn: f32, count: f32, width: f32, density: f32,
            skew: f32, weight: f32 }";
    insta::assert_snapshot!(units(derived), @"load: kg (2.0451), reach: m (0.418), root: m^(1/2) (1.3541), stretch: 1 (0.4361), turn: 1 (0.2451), count: 1 (0.5541), width: m (0.4631), density: kg/m² (1.4443), skew: kg·m² (0.0021), weight: kg·m/s² (0.6803)");
}

#[test]
fn the_type_of_the_fields_in_use_is_the_robots() {
    let lines = "#[joint(q: revolute(z), world -> a)]";
    let field_type = |body: &str, rest: &str| {
        let graph = Graph::new();
        model(&graph, &format!("{lines} #[body(a, solid = sphere({body}, 1))] {rest}")).field_type.to_string()
    };
    assert_eq!(field_type("1", "struct R;"), "any scalar");
    assert_eq!(field_type("1", "struct R<T> { name: String, t: T }"), "T");
    assert_eq!(field_type("m", "struct R<'a, T: Copy> { name: &'a str, m: (T) }"), "T");
    assert_eq!(field_type("m", "struct R<M> { meta: M, m: f32, big: f64 }"), "f32");
    assert_eq!(field_type("m", "struct R { m: f64 }"), "f64");
    assert_eq!(field_type("r#type", "struct R { r#type: f64 }"), "f64");
    assert_eq!(field_type("pi", "struct R { other: f64 }"), "any scalar");
}

#[test]
fn what_is_impossible_alone_may_be_sound_after_welding_or_allowed() {
    let dummy = "#[joint(f: fixed, a -> b)] #[body(b, mass = 1e-6, inertia = diag(0, 0, 1e-9))]";
    let sound = "#[joint(q: revolute(z), world -> a)] #[body(a, solid = sphere(1, 0.1))]";
    let puma = "mass = 4.8, com = [0, 0, 0.07], inertia = diag(0.066, 0.0125, 0.086)";
    let joint = "#[joint(q: revolute(z), world -> a)]";
    let rod = "#[body(a, mass = 1, com = [0, 3, 0], inertia = diag(0.33333333, 0, 0.33333333))]";
    for lines in [
        format!("{sound} {dummy}"),
        format!("{joint} #[body(a, {puma}, allow(nonphysical_inertia))]"),
        format!("#[dynamics(allow(nonphysical_inertia))] {joint} #[body(a, {puma})]"),
        format!("{joint} {rod}"),
        format!("{joint} #[body(a, com = [0.3, sqrt(2), 1], solid = point(1))]"),
        format!(
            "#[joint(p: revolute([1, 2, 3]), world -> b)] #[body(b)] #[joint(q: prismatic(z), b -> a)] {rod}"
        ),
    ] {
        model(&Graph::new(), &format!("{lines} struct R;"));
    }
}

#[test]
fn a_body_without_mass_moves_what_it_carries() {
    let chain = |first: &str| {
        format!(
            "#[joint(p: revolute(z), world -> a)] #[body(a, {first})]
             #[joint(q: revolute(x), a -> b)] #[body(b, com = [0, 1, 0], solid = sphere(1, 0.1))] struct R;"
        )
    };
    let graph = Graph::new();
    for massless in ["mass = 0", "mass = 0, inertia = diag(0, 0, 0)", "com = [1, 0, 0], mass = -0kg"] {
        let inertia = model(&graph, &chain(massless)).tree.links[0].inertia;
        assert_eq!(inertia, dynamics_codegen::spatial::PseudoInertia::zero(), "{massless}");
    }
    // The first link of the PUMA 560, as it is published.
    let puma = chain("mass = 0, inertia = diag(0, 0, 0.35), allow(nonphysical_inertia)");
    let link = model(&graph, &puma).tree.links[0];
    assert_eq!(values(&graph, [link.inertia.mass, link.inertia.rotational().zz]), [0.0, 0.35]);
    let alone = "#[joint(q: revolute(z), world -> a)]
        #[body(a, mass = 0, inertia = diag(0, 0, 0.35), allow(nonphysical_inertia))] struct R;";
    assert_eq!(model(&graph, alone).tree.dof(), 1);
}

#[test]
fn a_massless_inertia_is_judged_with_what_it_is_welded_to() {
    let text = "#[joint(q: revolute(z), world -> a)] #[body(a, mass = 0, inertia = diag(0, 0, 0.01))]
        #[joint(f: fixed, a -> b)] #[body(b, solid = sphere(2, 0.3))] struct R;";
    let graph = Graph::new();
    assert_eq!(model(&graph, text).tree.dof(), 1);
}

#[test]
fn parts_of_macros_are_read_through_invisible_groups() {
    use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
    let group = |text: &str| TokenTree::from(Group::new(Delimiter::None, text.parse().unwrap()));
    let (sum, vector, name) = (group("1 + 1"), group("[0, 0, -1]"), group("a"));
    let tokens: TokenStream = quote::quote! {
        #[joint(q: revolute(z), world -> #name, at = #vector)]
        #[body(#name, solid = sphere(2 * #sum, 1))]
        struct R;
    };
    let mut diags = Diagnostics::new();
    let spec = spec::parse(&syn::parse2(tokens).unwrap(), &mut diags);
    let graph = Graph::new();
    let model = model::build(&spec, &graph, &mut diags);
    assert_eq!(diags.into_text(), "");
    let link = model.unwrap().tree.links[0];
    assert_eq!(values(&graph, [link.inertia.mass, link.placement.translation.0[2]]), [4.0, -1.0]);
}

#[test]
fn a_mistake_is_a_compile_error_with_help_and_code() {
    let mut diags = Diagnostics::new();
    let input = syn::parse_str("#[joint(q: revolute(z), world -> a, at = 3)] struct R;").unwrap();
    let _ = spec::parse(&input, &mut diags);
    let text = diags.into_compile_errors().to_string();
    assert!(text.starts_with(":: core :: compile_error ! {"), "{text}");
    assert!(text.contains(r"\n\n  = help: ") && text.contains(r"\n  = note: dynamics::Syntax"), "{text}");
}

#[test]
fn as_many_joints_as_are_allowed_are_read() {
    let mut text = String::new();
    for k in 0..256 {
        let parent = if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) };
        let line = format!(
            "#[joint(q{k}: revolute, {parent} -> b{k}, dh(0.1, 90deg, 0.2, 0.{k}))]
             #[body(b{k}, mass = 1.5, com = [0, 0.1, 0], inertia = tensor(0.2, 0.01, 0.02, 0.3, 0.03, 0.25))]"
        );
        text.push_str(&line);
    }
    assert_eq!(model(&Graph::new(), &(text + "struct Chain;")).tree.dof(), 256);
}

/// Links of files are called what their makers liked; their types are Rust.
#[test]
fn frames_have_types_of_rust_whatever_they_are_called() {
    let types = [("tool0", "Tool0"), ("1st-link", "Frame1stLink"), ("box", "BoxFrame"), ("R", "RFrame")];
    for (name, type_) in types {
        assert_eq!(dynamics_codegen::model::names::frame_type(name, "R"), type_);
    }
}
