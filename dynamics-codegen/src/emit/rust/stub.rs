//! What stands in for a robot that was wrong: impls that satisfy every use, so that one mistake is one error.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use super::frames::frames_module;
use super::item::{bounded, without_bounds};
use crate::diagnostics::Diagnostics;
use crate::model::names::frame_type;
use crate::spec::{self, RobotSpec};

/// Impls of everything that the robot would have had, none of which is ever run: for the scalar and the size that
/// can be read from the mistaken input, and for all where they cannot.
pub fn stub(input: &syn::DeriveInput) -> TokenStream {
    // The mistakes have been reported; what can be read serves for the names.
    let mut reported = Diagnostics::new();
    let spec = spec::parse(input, &mut reported);
    let is_read = reported.is_empty();
    let _ = reported.into_text();

    let (scalar, of_struct) = scalar(&spec);
    let free_scalar = if scalar == FREE_SCALAR { quote!(__T: Scalar,) } else { quote!() };
    // Of a robot with a file, the file has the joints.
    let is_read = is_read && spec.options.urdf.is_none();
    let [nq, nv, nu] = if is_read { sizes(&spec) } else { [0; 3] };
    let (n_q, n, free_size) = match nv {
        0 => (quote!(__N), quote!(__N), quote!(const __N: usize,)),
        _ => (quote!(#nq), quote!(#nv), quote!()),
    };
    let (x, u, free_sizes) = match nv {
        0 => (quote!(__X), quote!(__U), quote!(const __X: usize, const __U: usize,)),
        nv => {
            let x = 2 * nv;
            (quote!(#x), quote!(#nu), quote!())
        }
    };

    let core = spec.options.crate_path();
    let (name, vis) = (&input.ident, &input.vis);
    let bare = without_bounds(&input.generics);
    let (declared, arguments, _) = bare.split_for_impl();
    let bounds = &input.generics.where_clause;
    let parameters = input.generics.params.iter();
    let parameters: TokenStream = parameters
        .map(|parameter| bounded(parameter, |ident| of_struct == Some(ident)))
        .map(|p| quote!(#p,))
        .collect();
    let robot = quote!(__Robot #arguments);
    let generics = quote!(#parameters #free_scalar #free_size);
    let module = Ident::new(&frames_module(&name.to_string()), Span::call_site());
    let frames = frames(&spec);
    let has_companion = !spec.fields.is_empty() && input.generics.params.len() <= 1;
    let companion = format_ident!("{}Prepared", name);
    let companion = has_companion
        .then(|| quote!(#[allow(unused, missing_docs)] #vis type #companion #declared = #name #arguments;));
    let prepare = match spec.fields.is_empty() {
        true => {
            quote!(#vis fn prepare(&self) -> &Self { self } #vis fn check(&self) -> ::core::result::Result<(), Error> { ::core::result::Result::Ok(()) })
        }
        false => quote!(#vis fn prepare(&self) -> Self { loop {} }),
    };
    quote! {
        #[allow(unused, missing_docs, unreachable_pub)]
        #vis mod #module { #(pub struct #frames;)* }
        #[allow(unused, unreachable_pub, ambiguous_glob_reexports)]
        #vis use #module::*;
        #companion
        #[allow(unused, missing_docs, clippy::all)]
        const _: () = {
            type __Robot #declared = #name #arguments;
            const _: () = {
            use #core::__private::*;
            impl<#parameters> #robot #bounds {
                #prepare
                #vis const fn equations() -> Equations { loop {} }
            }
            impl<#parameters> Mechanism for #robot #bounds {
                const NQ: usize = #nq;
                const NV: usize = #nv;
                const NU: usize = #nu;
                const NAME: &'static str = "";
                const JOINT_NAMES: &'static [&'static str] = &[];
                const BODY_NAMES: &'static [&'static str] = &[];
                const LIMITS: &'static [JointLimits] = &[];
                const COST: Costs = Costs::ZERO;
            }
            impl<#generics> Dynamics<#scalar, #n_q, #n> for #robot #bounds {
                fn mass_matrix(&self, q: &SVector<#scalar, #n_q>) -> SMatrix<#scalar, #n, #n> { loop {} }
                fn coriolis_matrix(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>) -> SMatrix<#scalar, #n, #n> { loop {} }
                fn gravity_forces(&self, q: &SVector<#scalar, #n_q>) -> SVector<#scalar, #n> { loop {} }
                fn bias_forces(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>) -> SVector<#scalar, #n> { loop {} }
                fn inverse_dynamics(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, a: &SVector<#scalar, #n>) -> SVector<#scalar, #n> { loop {} }
                fn forward_dynamics(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, tau: &SVector<#scalar, #n>) -> SVector<#scalar, #n> { loop {} }
                fn kinetic_energy(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>) -> #scalar { loop {} }
                fn potential_energy(&self, q: &SVector<#scalar, #n_q>) -> #scalar { loop {} }
                fn lagrangian(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>) -> #scalar { loop {} }
            }
            impl<#generics> DynamicsDerivatives<#scalar, #n_q, #n> for #robot #bounds {
                fn inverse_dynamics_derivatives(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, a: &SVector<#scalar, #n>) -> InverseDynamicsDerivatives<#scalar, #n> { loop {} }
                fn forward_dynamics_derivatives(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, tau: &SVector<#scalar, #n>) -> ForwardDynamicsDerivatives<#scalar, #n> { loop {} }
            }
            impl<#generics> CentroidalDynamics<#scalar, #n_q, #n> for #robot #bounds {
                fn total_mass(&self) -> #scalar { loop {} }
                fn center_of_mass(&self, q: &SVector<#scalar, #n_q>) -> SVector<#scalar, 3> { loop {} }
                fn centroidal_momentum_matrix(&self, q: &SVector<#scalar, #n_q>) -> SMatrix<#scalar, 6, #n> { loop {} }
            }
            impl<#generics const __P: usize> Regressor<#scalar, #n_q, #n, __P> for #robot #bounds {
                fn regressor(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, a: &SVector<#scalar, #n>) -> SMatrix<#scalar, #n, __P> { loop {} }
                fn inertial_parameters(&self) -> SVector<#scalar, __P> { loop {} }
            }
            impl<#generics const __P: usize> BaseRegressor<#scalar, #n_q, #n, __P> for #robot #bounds {
                fn base_regressor(&self, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, a: &SVector<#scalar, #n>) -> SMatrix<#scalar, #n, __P> { loop {} }
                fn base_parameters(&self) -> SVector<#scalar, __P> { loop {} }
            }
            impl<#generics> EachFrame<#scalar, #n_q, #n> for #robot #bounds {
                fn each_frame<__V: FrameVisitor<Self, #scalar, #n_q, #n>>(&self, visitor: &mut __V) { loop {} }
            }
            impl<#generics> Configuration<#scalar, #n_q, #n> for #robot #bounds {
                fn integrate(&self, q: &SVector<#scalar, #n_q>, delta: &SVector<#scalar, #n>) -> SVector<#scalar, #n_q> { loop {} }
            }
            impl<#generics #free_sizes> StateSpaceModel<#scalar, #n_q, #n, #x, #u> for #robot #bounds {
                fn input_map(&self) -> SMatrix<#scalar, #n, #u> { loop {} }
            }
            #(impl<#generics> Frame<#robot, #scalar, #n_q, #n> for #module::#frames #bounds {
                const NAME: &'static str = "";
                fn pose(robot: &#robot, q: &SVector<#scalar, #n_q>) -> Pose<#scalar> { loop {} }
                fn acceleration(robot: &#robot, q: &SVector<#scalar, #n_q>, v: &SVector<#scalar, #n>, a: &SVector<#scalar, #n>) -> SVector<#scalar, 6> { loop {} }
                fn jacobian(robot: &#robot, q: &SVector<#scalar, #n_q>) -> SMatrix<#scalar, 6, #n> { loop {} }
                fn world_jacobian(robot: &#robot, q: &SVector<#scalar, #n_q>) -> SMatrix<#scalar, 6, #n> { loop {} }
            })*
            };
        };
    }
}

/// NQ, NV and NU of a specification that was read without mistakes.
fn sizes(spec: &RobotSpec) -> [usize; 3] {
    let joints = spec.joints.iter().filter(|joint| joint.has_coordinates());
    joints.fold([0; 3], |[nq, nv, nu], joint| {
        let (coordinates, speeds) = (joint.kind.coordinates(), joint.kind.speeds());
        [nq + coordinates, nv + speeds, nu + if joint.is_actuated() { speeds } else { 0 }]
    })
}

const FREE_SCALAR: &str = "__T";

/// The scalar of the impls, and the struct's parameter that it is.
fn scalar(spec: &RobotSpec) -> (Ident, Option<&Ident>) {
    let mut parameters = spec.type_parameters();
    if let (Some(only), None) = (parameters.next(), parameters.next()) {
        return (only.clone(), Some(only));
    }
    let has = |name: &str| {
        spec.fields.iter().any(|field| matches!(&field.ty, syn::Type::Path(p) if p.path.is_ident(name)))
    };
    let name = match (has("f64"), has("f32")) {
        (true, false) => "f64",
        (false, true) => "f32",
        _ => FREE_SCALAR,
    };
    (Ident::new(name, Span::call_site()), None)
}

/// The types of the frames, each once, of those names that can be types.
fn frames(spec: &RobotSpec) -> Vec<Ident> {
    let carried = spec.joints.iter().map(|joint| &joint.child.text);
    let names = spec.bodies.iter().map(|body| &body.name.text).chain(carried);
    let mut types: Vec<String> = names.map(|name| frame_type(name, &spec.ident.to_string())).collect();
    types.sort_unstable();
    types.dedup();
    types.iter().filter_map(|type_| syn::parse_str(type_).ok()).collect()
}
