//! The zoo: every robot with its specification as text, its values, and its compiled forms.

pub mod fixtures;
pub mod industrial;
pub mod textbook;

use dynamics_core::Costs;

use crate::{Dual, Forms};

/// A robot of the zoo.
pub struct Entry {
    /// The struct's name.
    pub name: &'static str,
    /// The struct with its attributes, as written.
    pub source: &'static str,
    /// The fields with their values here.
    pub parameters: &'static [(&'static str, f64)],
    /// The number of joints that move.
    pub n: usize,
    /// What its methods cost.
    pub costs: Costs,
    /// Its joints.
    pub joint_names: &'static [&'static str],
    /// Its bodies.
    pub body_names: &'static [&'static str],
    /// In double precision; not the robots whose fields are `f32`.
    pub double: Option<Forms<f64>>,
    /// In single precision; not the robots whose fields are `f64`.
    pub single: Option<Forms<f32>>,
    /// Over numbers of the tests' own; only robots that leave the scalar open.
    pub dual: Option<Forms<Dual>>,
}

/// All robots, small ones first.
pub fn all() -> Vec<Entry> {
    [textbook::all(), fixtures::all(), industrial::all()].into_iter().flatten().collect()
}

/// All robots with their forms in double precision.
pub fn in_double() -> impl Iterator<Item = (Entry, Forms<f64>)> {
    all().into_iter().filter_map(|mut entry| {
        let forms = entry.double.take()?;
        Some((entry, forms))
    })
}

/// Declares a robot in a module of its own: derives it, keeps its text, gives it values, and enters it.
///
/// `module = Struct<T> { field: value, … }, [joints, states], frames [Frame, …];` and then the struct as a user
/// writes it, without the derive. Instead of `<T>`, `<f64>` and `<f32>` for fields of one type, and nothing for a
/// unit struct.
macro_rules! robot {
    ($module:ident = $name:ident<T> { $($field:ident: $value:expr),* $(,)? }, $sizes:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name<f64>] [$($field: $value),*] $sizes $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot<T: Scalar>() -> $name<T> {
                    $name { $($field: T::of($value)),* }
                }
            }
            [Some(crate::zoo::forms!($sizes $frames f64, robot::<f64>()))]
            [Some(crate::zoo::forms!($sizes $frames f32, robot::<f32>()))]
            [Some(crate::zoo::forms!($sizes $frames crate::Dual, robot::<crate::Dual>()))]
        }
    };
    ($module:ident = $name:ident<f64> { $($field:ident: $value:expr),* $(,)? }, $sizes:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [$($field: $value),*] $sizes $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot() -> $name {
                    $name { $($field: $value),* }
                }
            }
            [Some(crate::zoo::forms!($sizes $frames f64, robot()))] [None] [None]
        }
    };
    ($module:ident = $name:ident<f32> { $($field:ident: $value:expr),* $(,)? }, $sizes:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [$($field: $value),*] $sizes $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot() -> $name {
                    $name { $($field: $value),* }
                }
            }
            [None] [Some(crate::zoo::forms!($sizes $frames f32, robot()))] [None]
        }
    };
    ($module:ident = $name:ident, $sizes:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [] $sizes $frames [$($item)*]
            {
                /// The robot.
                pub fn robot() -> $name {
                    $name
                }
            }
            [Some(crate::zoo::forms!($sizes $frames f64, robot()))]
            [Some(crate::zoo::forms!($sizes $frames f32, robot()))]
            [Some(crate::zoo::forms!($sizes $frames crate::Dual, robot()))]
        }
    };
    (@module $module:ident $name:ident [$concrete:ty] [$($field:ident: $value:expr),*] [$n:literal, $nx:literal]
        $frames:tt [$($item:tt)*] { $($robot:tt)* } [$double:expr] [$single:expr] [$dual:expr]
    ) => {
        #[doc = concat!("The robot [`", stringify!($name), "`](", stringify!($module), "::", stringify!($name), ").")]
        pub mod $module {
            use dynamics_core::prelude::*;

            #[derive(Dynamics, Clone, Copy, Debug, PartialEq)]
            $($item)*

            /// The robot as text, for the compiler as a library.
            pub const SOURCE: &str = stringify!($($item)*);

            $($robot)*

            /// Its entry in the zoo.
            pub fn entry() -> crate::zoo::Entry {
                crate::zoo::Entry {
                    name: <$concrete as Mechanism>::NAME,
                    source: SOURCE,
                    parameters: &[$((stringify!($field), $value as f64)),*],
                    n: $n,
                    costs: <$concrete as Mechanism>::COST,
                    joint_names: <$concrete as Mechanism>::JOINT_NAMES,
                    body_names: <$concrete as Mechanism>::BODY_NAMES,
                    double: $double,
                    single: $single,
                    dual: $dual,
                }
            }
        }
    };
}

/// The two forms of a robot over one scalar.
macro_rules! forms {
    ($sizes:tt $frames:tt $scalar:ty, $robot:expr) => {{
        let robot = $robot;
        let prepared = robot.prepare().clone(); // of a robot without fields a reference to itself
        crate::Forms {
            robot: Box::new(crate::zoo::specialised!($sizes $frames $scalar, robot)),
            prepared: Box::new(crate::zoo::specialised!($sizes $frames $scalar, prepared)),
        }
    }};
}

macro_rules! specialised {
    ([$n:literal, $nx:literal] [$($frame:ident),*] $scalar:ty, $robot:expr) => {
        crate::Specialised::<_, $scalar, $n, $nx> {
            robot: $robot,
            frames: vec![$(crate::frame::<$frame, _, $scalar, $n>()),*],
        }
    };
}

use {forms, robot, specialised};
