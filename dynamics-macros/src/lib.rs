//! The derive macro of `dynamics-core`, which re-exports it. All thought is in `dynamics-codegen`.

use proc_macro::TokenStream;

/// Equations of motion from a robot on a struct.
#[proc_macro_derive(Dynamics, attributes(dynamics, joint, body))]
pub fn derive_dynamics(input: TokenStream) -> TokenStream {
    dynamics_codegen::derive(input.into()).into()
}
