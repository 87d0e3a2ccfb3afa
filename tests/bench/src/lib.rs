//! The robots of the races: those of the zoo whose numbers the peers have too.

/// The part of the zoo that is raced, without what only tests need: that takes minutes to optimise.
pub mod zoo {
    /// Nothing: the zoo's entries are for tests.
    pub struct Entry;

    macro_rules! robot {
        ($module:ident = $name:ident, $sizes:tt, $frames:tt; $($item:tt)*) => {
            #[doc = concat!("The robot `", stringify!($name), "`.")]
            pub mod $module {
                use dynamics_core::prelude::*;

                #[derive(Dynamics, Clone, Copy, Debug)]
                $($item)*

                pub(super) fn entry() -> super::Entry {
                    super::Entry
                }
            }
        };
    }

    use robot;

    #[path = "../../../src/zoo/industrial.rs"]
    pub mod industrial;
}
