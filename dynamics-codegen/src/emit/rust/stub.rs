//! What stands in for a robot that was wrong: impls that satisfy every use, so that one mistake is one error.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use super::items::{frame_type, frames_module};
use crate::diagnostics::Diagnostics;
use crate::spec;

/// Impls for every scalar and every size, none of which is ever run.
pub fn stub(input: &syn::DeriveInput) -> TokenStream {
    // The mistakes have been reported; what can be read serves for the names.
    let mut reported = Diagnostics::new();
    let spec = spec::parse(input, &mut reported);
    let _ = reported.into_text();
    let core = spec.options.crate_path();
    let (name, vis) = (&input.ident, &input.vis);
    let (_, arguments, bounds) = input.generics.split_for_impl();
    let parameters = input.generics.params.iter().map(|parameter| match parameter {
        syn::GenericParam::Type(known) => {
            let (ident, bounds) = (&known.ident, &known.bounds);
            quote!(#ident: #bounds)
        }
        syn::GenericParam::Lifetime(known) => quote!(#known),
        syn::GenericParam::Const(known) => {
            let (ident, ty) = (&known.ident, &known.ty);
            quote!(const #ident: #ty)
        }
    });
    let parameters: TokenStream = parameters.map(|parameter| quote!(#parameter,)).collect();
    let robot = quote!(#name #arguments);
    let sized = quote!(__T: Scalar, const __Q: usize, const __V: usize);
    let module = Ident::new(&frames_module(&name.to_string()), Span::call_site());
    let carried = spec.joints.iter().map(|joint| joint.child.text.clone());
    let mut frames: Vec<String> =
        spec.bodies.iter().map(|body| body.name.text.clone()).chain(carried).collect();
    frames.sort_unstable();
    frames.dedup();
    let frames: Vec<Ident> =
        frames.iter().map(|frame| Ident::new(&frame_type(frame), Span::call_site())).collect();
    let inner = match vis {
        syn::Visibility::Inherited => quote!(pub(super)),
        vis => quote!(#vis),
    };
    quote! {
        #[allow(missing_docs)]
        #vis mod #module { #(#inner struct #frames;)* }
        #[allow(unused_imports, ambiguous_glob_reexports)]
        #vis use #module::*;
        #[allow(unused_variables, unreachable_code, missing_docs, clippy::all)]
        const _: () = {
            use #core::__private::*;
            impl<#parameters> #robot #bounds { #vis fn prepare(&self) -> &Self { self } }
            impl<#parameters> Mechanism for #robot #bounds {
                const NQ: usize = 0;
                const NV: usize = 0;
                const NU: usize = 0;
                const NAME: &'static str = "";
                const JOINT_NAMES: &'static [&'static str] = &[];
                const BODY_NAMES: &'static [&'static str] = &[];
                const LIMITS: &'static [JointLimits] = &[];
                const COST: Costs = Costs::ZERO;
            }
            impl<#parameters #sized> Dynamics<__T, __Q, __V> for #robot #bounds {
                fn mass_matrix(&self, q: &SVector<__T, __Q>) -> SMatrix<__T, __V, __V> { loop {} }
                fn coriolis_matrix(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>) -> SMatrix<__T, __V, __V> { loop {} }
                fn gravity_forces(&self, q: &SVector<__T, __Q>) -> SVector<__T, __V> { loop {} }
                fn bias_forces(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>) -> SVector<__T, __V> { loop {} }
                fn inverse_dynamics(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>, a: &SVector<__T, __V>) -> SVector<__T, __V> { loop {} }
                fn forward_dynamics(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>, tau: &SVector<__T, __V>) -> SVector<__T, __V> { loop {} }
                fn kinetic_energy(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>) -> __T { loop {} }
                fn potential_energy(&self, q: &SVector<__T, __Q>) -> __T { loop {} }
                fn lagrangian(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>) -> __T { loop {} }
            }
            impl<#parameters #sized> DynamicsDerivatives<__T, __Q, __V> for #robot #bounds {
                fn inverse_dynamics_derivatives(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>, a: &SVector<__T, __V>) -> InverseDynamicsDerivatives<__T, __V> { loop {} }
                fn forward_dynamics_derivatives(&self, q: &SVector<__T, __Q>, v: &SVector<__T, __V>, tau: &SVector<__T, __V>) -> ForwardDynamicsDerivatives<__T, __V> { loop {} }
            }
            impl<#parameters #sized> Configuration<__T, __Q, __V> for #robot #bounds {
                fn integrate(&self, q: &SVector<__T, __Q>, delta: &SVector<__T, __V>) -> SVector<__T, __Q> { loop {} }
            }
            impl<#parameters #sized, const __X: usize, const __U: usize> StateSpaceModel<__T, __Q, __V, __X, __U> for #robot #bounds {
                fn input_map(&self) -> SMatrix<__T, __V, __U> { loop {} }
            }
            #(impl<#parameters #sized> Frame<#robot, __T, __Q, __V> for #module::#frames #bounds {
                const NAME: &'static str = "";
                fn pose(robot: &#robot, q: &SVector<__T, __Q>) -> Pose<__T> { loop {} }
                fn jacobian(robot: &#robot, q: &SVector<__T, __Q>) -> SMatrix<__T, 6, __V> { loop {} }
                fn world_jacobian(robot: &#robot, q: &SVector<__T, __Q>) -> SMatrix<__T, 6, __V> { loop {} }
            })*
        };
    }
}
