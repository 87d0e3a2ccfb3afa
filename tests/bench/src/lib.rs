//! The robots of the races: those of the zoo whose numbers the peers have too.
//!
//! Only the derived impls: what the tests add to the zoo takes minutes to optimise.

pub mod contest;
pub mod textbook;

/// A robot as the compiler reads it.
pub struct Entry {
    /// The struct's name.
    pub name: &'static str,
    /// The struct with its attributes, as written.
    pub source: &'static str,
}

mod declaration {
    macro_rules! robot {
        ($module:ident = $name:ident, $sizes:tt, $frames:tt; $($item:tt)*) => {
            #[doc = concat!("The robot `", stringify!($name), "`.")]
            pub mod $module {
                use dynamics_core::prelude::*;

                #[derive(Dynamics, Clone, Copy, Debug)]
                $($item)*

                pub(super) fn entry() -> crate::Entry {
                    crate::Entry { name: stringify!($name), source: stringify!($($item)*) }
                }
            }
        };
    }

    pub(super) use robot;
}

use declaration::robot;

/// The peers' own models, which `peers/urdf.py` writes as files.
pub mod models {
    use super::{Entry, robot};

    /// All of them.
    pub fn all() -> Vec<Entry> {
        vec![hyq::entry(), chain4::entry(), chain16::entry(), chain32::entry()]
    }

    robot! {
        hyq = Hyq, [19, 18], [];
        /// A quadruped, floating.
        #[dynamics(urdf = "robots/hyq.urdf", base = free)]
        pub struct Hyq;
    }

    robot! {
        chain4 = Chain4, [4], [];
        /// Four joints with oblique axes in a row.
        #[dynamics(urdf = "robots/chain4.urdf")]
        pub struct Chain4;
    }

    robot! {
        chain16 = Chain16, [16], [];
        /// Sixteen.
        #[dynamics(urdf = "robots/chain16.urdf")]
        pub struct Chain16;
    }

    robot! {
        chain32 = Chain32, [32], [];
        /// Thirty-two.
        #[dynamics(urdf = "robots/chain32.urdf")]
        pub struct Chain32;
    }
}

#[path = "../../src/zoo/industrial.rs"]
pub mod industrial;
