//! The zoo: every robot with its specification as text, its values, and its compiled forms.

pub mod branches;
pub mod driven;
pub mod files;
pub mod fixtures;
pub mod industrial;
pub mod joints;
pub mod lagrangian;
pub mod textbook;

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use dynamics_core::Costs;

use crate::{Dual, Forms, Space, State};

/// A robot of the zoo.
pub struct Entry {
    /// The struct's name.
    pub name: &'static str,
    /// The struct with its attributes, as written.
    pub source: &'static str,
    /// The fields with their values here.
    pub parameters: &'static [(&'static str, f64)],
    /// Where its configuration is.
    pub space: Space,
    /// What its methods cost.
    pub costs: Costs,
    /// Its joints.
    pub joint_names: &'static [&'static str],
    /// Its bodies.
    pub body_names: &'static [&'static str],
    /// Its inertial parameters.
    pub parameter_names: &'static [&'static str],
    /// Its base parameters.
    pub base_parameter_names: &'static [&'static str],
    /// In double precision; not the robots whose fields are `f32`.
    pub double: Option<Forms<f64>>,
    /// In single precision; not the robots whose fields are `f64`.
    pub single: Option<Forms<f32>>,
    /// Over numbers of the tests' own; only robots that leave the scalar open.
    pub dual: Option<Forms<Dual>>,
}

impl Entry {
    /// Random states, the same in every test.
    pub fn states(&self, count: usize) -> Vec<State> {
        State::many(self.name, self.space, count)
    }
}

/// All robots, small ones first.
pub fn all() -> Vec<Entry> {
    let small =
        [textbook::all(), fixtures::all(), joints::all(), driven::all(), lagrangian::all(), branches::all()];
    small.into_iter().chain([industrial::all(), files::all()]).flatten().collect()
}

/// All robots with their forms in double precision.
pub fn in_double() -> impl Iterator<Item = (Entry, Forms<f64>)> {
    all().into_iter().filter_map(|mut entry| {
        let forms = entry.double.take()?;
        Some((entry, forms))
    })
}

/// What `ask` answers of each robot, in the order of the zoo: asked on all cores, the largest robots first.
///
/// For what takes long. A compiled robot stays on its thread, so every thread has a zoo of its own.
pub fn on_all_cores<R: Send>(ask: impl Fn(Entry) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let some = || {
        let (mut robots, mut answers) = (all().into_iter().map(Some).collect::<Vec<_>>(), vec![]);
        while let Some(k) = robots.len().checked_sub(1 + next.fetch_add(1, Ordering::Relaxed)) {
            answers.extend(robots[k].take().map(|robot| (k, ask(robot))));
        }
        answers
    };
    let mut answers: Vec<(usize, R)> = thread::scope(|scope| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(some)).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)))
            .collect()
    });
    answers.sort_by_key(|(k, _)| *k);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

/// Declares a robot in a module of its own: derives it, keeps its text, gives it values, and enters it.
///
/// `module = Struct<T> { field: value, … }, [parts], [Frame, …];` and then the struct as a user writes it, without the
/// derive. Instead of `<T>`, `<f64>` and `<f32>` for fields of one type; a unit struct has nothing, or `as f64` if it is
/// so large that one scalar will do. The parts are those of the configuration, in order: `free`, `ball`, or the number
/// of joints of one degree of freedom.
macro_rules! robot {
    ($module:ident = $name:ident<T> { $($field:ident: $value:expr),* $(,)? }, $parts:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name<f64>] [$($field: $value),*] $parts $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot<T: Scalar>() -> $name<T> {
                    $name { $($field: T::of($value)),* }
                }
            }
            [Some(crate::zoo::forms!($frames [$name<f64>] f64, robot::<f64>()))]
            [Some(crate::zoo::forms!($frames [$name<f64>] f32, robot::<f32>()))]
            [Some(crate::zoo::forms!($frames [$name<f64>] crate::Dual, robot::<crate::Dual>()))]
        }
    };
    ($module:ident = $name:ident<f64> { $($field:ident: $value:expr),* $(,)? }, $parts:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [$($field: $value),*] $parts $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot() -> $name {
                    $name { $($field: $value),* }
                }
            }
            [Some(crate::zoo::forms!($frames [$name] f64, robot()))] [None] [None]
        }
    };
    ($module:ident = $name:ident<f32> { $($field:ident: $value:expr),* $(,)? }, $parts:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [$($field: $value),*] $parts $frames [$($item)*]
            {
                /// The robot with the values of the zoo.
                pub fn robot() -> $name {
                    $name { $($field: $value),* }
                }
            }
            [None] [Some(crate::zoo::forms!($frames [$name] f32, robot()))] [None]
        }
    };
    ($module:ident = $name:ident, $parts:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [] $parts $frames [$($item)*]
            {
                /// The robot.
                pub fn robot() -> $name {
                    $name
                }
            }
            [Some(crate::zoo::forms!($frames [$name] f64, robot()))]
            [Some(crate::zoo::forms!($frames [$name] f32, robot()))]
            [Some(crate::zoo::forms!($frames [$name] crate::Dual, robot()))]
        }
    };
    ($module:ident = $name:ident as f64, $parts:tt, $frames:tt; $($item:tt)*) => {
        crate::zoo::robot! { @module $module $name [$name] [] $parts $frames [$($item)*]
            {
                /// The robot.
                pub fn robot() -> $name {
                    $name
                }
            }
            [Some(crate::zoo::forms!($frames [$name] f64, robot()))] [None] [None]
        }
    };
    (@module $module:ident $name:ident [$concrete:ty] [$($field:ident: $value:expr),*] [$($part:tt),*]
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
                    space: crate::Space(&[$(crate::zoo::part!($part)),*]),
                    costs: <$concrete as Mechanism>::COST,
                    joint_names: <$concrete as Mechanism>::JOINT_NAMES,
                    body_names: <$concrete as Mechanism>::BODY_NAMES,
                    parameter_names: <$concrete as Mechanism>::PARAMETER_NAMES,
                    base_parameter_names: <$concrete as Mechanism>::BASE_PARAMETER_NAMES,
                    double: $double,
                    single: $single,
                    dual: $dual,
                }
            }
        }
    };
}

macro_rules! part {
    (free) => {
        crate::Part::Free
    };
    (ball) => {
        crate::Part::Ball
    };
    ($count:literal) => {
        crate::Part::Lines($count)
    };
}

/// The two forms of a robot over one scalar; the sizes are those of `$sized`.
macro_rules! forms {
    ($frames:tt [$sized:ty] $scalar:ty, $robot:expr) => {{
        let robot = $robot;
        let prepared = robot.prepare().clone(); // of a robot without fields a reference to itself
        crate::Forms {
            robot: Box::new(crate::specialised!($frames [$sized] $scalar, robot)),
            prepared: Box::new(crate::specialised!($frames [$sized] $scalar, prepared)),
        }
    }};
}

use {forms, part, robot};
