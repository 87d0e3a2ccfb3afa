//! The robots of the races: those of the zoo whose numbers the peers have too.
//!
//! Only the derived impls: what the tests add to the zoo takes minutes to optimise.

/// Nothing: the zoo's entries are for tests.
pub struct Entry;

mod declaration {
    macro_rules! robot {
        ($module:ident = $name:ident, $sizes:tt, $frames:tt; $($item:tt)*) => {
            #[doc = concat!("The robot `", stringify!($name), "`.")]
            pub mod $module {
                use dynamics_core::prelude::*;

                #[derive(Dynamics, Clone, Copy, Debug)]
                $($item)*

                pub(super) fn entry() -> crate::Entry {
                    crate::Entry
                }
            }
        };
    }

    pub(super) use robot;
}

use declaration::robot;

/// The peers' own models, which `peers/urdf.py` writes as files.
pub mod models {
    use dynamics_core::prelude::*;

    /// A quadruped, floating.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/hyq.urdf", base = free)]
    pub struct Hyq;

    /// Four joints with oblique axes in a row.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/chain4.urdf")]
    pub struct Chain4;

    /// Sixteen.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/chain16.urdf")]
    pub struct Chain16;

    /// Thirty-two.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/chain32.urdf")]
    pub struct Chain32;
}

#[path = "../../src/zoo/industrial.rs"]
pub mod industrial;
