#![recursion_limit = "4096"]
use dynamics_core::prelude::*;

/// More joints than a stack has room for, by doubling.
macro_rules! tree {
    ([$($done:tt)*] $name:ident) => {
        #[derive(Dynamics)]
        $($done)*
        struct $name;
    };
    ([$($done:tt)*] $name:ident x $($more:tt)*) => {
        tree! { [$($done)* $($done)*] $name $($more)* }
    };
}

tree! { [#[joint(q: revolute(z), world -> a)]] Tree x x x x x x x x x x }

fn main() {
    println!("{}", Tree.prepare().mass_matrix(&SVector::<f64, 1024>::zeros())[(0, 0)]);
}
