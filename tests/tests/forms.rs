//! Every form of struct in every place: what is generated fits it, and gives no warning of rustc or clippy.
#![deny(missing_docs, unused, warnings, unreachable_pub)]
#![deny(clippy::all, clippy::pedantic, clippy::nursery)]
#![deny(clippy::allow_attributes_without_reason, clippy::absolute_paths, clippy::unwrap_used)]
#![deny(unused_qualifications, unused_lifetimes, single_use_lifetimes, missing_debug_implementations)]
#![deny(elided_lifetimes_in_paths, explicit_outlives_requirements, let_underscore_drop, non_ascii_idents)]
#![allow(
    clippy::float_cmp,
    clippy::redundant_pub_crate,
    clippy::needless_pub_self,
    reason = "of the tests themselves; the code that is generated answers for itself"
)]

use dynamics_core::prelude::*;

const AT: [f64; 1] = [0.3];

/// The mass matrix of a robot of one joint.
fn mass<R: Dynamics<f64, 1, 1>>(robot: &R) -> f64 {
    robot.mass_matrix(&SVector::from(AT))[0]
}

/// What all robots of this file are, in numbers: `m·l²`, with `m = 2` and `l = 0.5`.
const EXPECTED: f64 = 0.5;

/// A robot with a struct of this kind.
macro_rules! robot {
    ($(#[$attribute:meta])* [$($struct:tt)+] $m:expr, $l:expr, $($rest:tt)*) => {
        /// A point on a rod.
        #[derive(Dynamics, Debug)]
        $(#[$attribute])*
        #[joint(hinge: revolute(y), world -> rod)]
        #[body(rod, com = [$l, 0, 0], solid = point($m))]
        #[joint(weld: fixed, rod -> tip, at = [2 * $l, 0, 0])]
        $($struct)+ $($rest)*
    };
}

mod visible {
    //! All visibilities, in nested modules.

    pub(crate) mod inner {
        use dynamics_core::prelude::*;

        pub(crate) mod innermost {
            use dynamics_core::prelude::*;
            robot! {
                #[allow(unreachable_pub, reason = "that of the struct itself is not what is tested")]
                [pub struct Public<T>] m, l, { pub m: T, pub l: T }
            }
            robot! { [pub(crate) struct OfCrate<T>] m, l, { pub(crate) m: T, pub(crate) l: T } }
            robot! { [pub(in crate::visible) struct OfPath<T>] m, l, { pub(crate) m: T, pub(crate) l: T } }
            robot! { [pub(super) struct OfParent<T>] m, l, { pub(super) m: T, pub(super) l: T } }
            robot! { [pub(self) struct OfSelf<T>] m, l, { m: T, l: T } }
            robot! { [struct Private] 2, 0.5, ; }

            #[test]
            fn private_ones_work() {
                assert_eq!(super::super::super::mass(&OfSelf { m: 2.0, l: 0.5 }), 0.5);
                assert_eq!(super::super::super::mass(&Private), 0.5);
                let tip = Private.pose::<private_frames::Tip>(&SVector::from([0.0]));
                assert_eq!(tip.translation[0], 1.0);
                assert_eq!(format!("{Private:?}{:?}", OfSelf { m: 1, l: 2 }), "PrivateOfSelf { m: 1, l: 2 }");
            }
        }

        #[test]
        fn those_of_the_parent_work() {
            use innermost::{OfParent, of_parent_frames::Tip};
            let robot = OfParent { m: 2.0, l: 0.5 };
            assert_eq!(super::super::mass(&robot.prepare()), 0.5);
            assert_eq!(robot.pose::<Tip>(&SVector::from([0.0])).translation[0], 1.0);
        }
    }

    #[test]
    fn those_of_a_path_work() {
        use dynamics_core::prelude::*;
        use inner::innermost::{OfPath, of_path_frames::Tip};
        let robot = OfPath { m: 2.0, l: 0.5 };
        assert_eq!(super::mass(&robot.prepare()), 0.5);
        assert_eq!(robot.pose::<Tip>(&SVector::from([0.0])).translation[0], 1.0);
    }
}

#[test]
fn visible_robots_work_from_outside() {
    use visible::inner::innermost::{OfCrate, OfCratePrepared, Public, of_crate_frames, public_frames};
    let prepared: OfCratePrepared<f64> = OfCrate { m: 2.0, l: 0.5 }.prepare();
    assert_eq!(mass(&prepared), EXPECTED);
    assert_eq!(prepared.pose::<of_crate_frames::Tip>(&SVector::from([0.0])).translation[0], 1.0);
    let robot = Public { m: 2.0, l: 0.5 };
    assert_eq!(robot.pose::<public_frames::Rod>(&SVector::from([0.0])).translation[0], 0.0);
}

mod parameters {
    //! Bounds, where-clauses, lifetimes, constants, and parameters that are no scalar.

    use std::fmt::Debug;
    use std::marker::PhantomData;

    use dynamics_core::prelude::*;

    robot! { [pub(crate) struct Bounded<T: Copy + Debug>] m, l, { m: T, l: T } }
    robot! { [pub(crate) struct Where<T> where T: Copy + Debug, Vec<T>: Clone] m, l, { m: T, l: T } }
    robot! { [pub(crate) struct Defaulted<T = f64>] m, l, { m: T, l: T } }
    robot! { [pub(crate) struct Lifetime<'a, T: 'a + Copy>] m, l, { m: T, l: T, name: &'a str } }
    robot! { [pub(crate) struct Constant<T, const N: usize>] m, l, { m: T, l: T, more: [u8; N] } }
    robot! { [pub(crate) struct Meta<M: Debug>] m, l, { m: f64, l: f64, name: M } }
    robot! { [pub(crate) struct Two<M, T> where M: Debug] m, l, { m: T, l: T, meta: PhantomData<M> } }
    robot! { [pub(crate) struct Single] m, l, { m: f32, l: f32, name: String, more: Vec<u8> } }
    robot! { [pub(crate) struct Numbers<'a, T, U>] 2, 0.5, { t: &'a T, u: U } }
    robot! { [pub(crate) struct Half<T>] m, 0.5, { m: T, l: String } }
    robot! { [pub(crate) struct T] 2, 0.5, ; }

    #[test]
    fn all_parameters_fit() {
        let (m, l) = (2.0, 0.5);
        let mass = super::mass::<Bounded<f64>>;
        assert_eq!(mass(&Bounded { m, l }), super::EXPECTED);
        assert_eq!(super::mass(&Where { m, l }.prepare()), super::EXPECTED);
        assert_eq!(super::mass(&Defaulted { m, l }), super::EXPECTED);
        let lifetime = Lifetime { m, l, name: &String::from("rod") };
        assert_eq!(super::mass(&lifetime), super::EXPECTED, "{}", lifetime.name);
        let constant = Constant { m, l, more: [1, 2, 3] };
        assert_eq!(super::mass(&constant), super::EXPECTED, "{:?}", constant.more);
        let meta = Meta { m, l, name: "rod" };
        assert_eq!(super::mass(&meta), super::EXPECTED, "{}", meta.name);
        let two = Two { m, l, meta: PhantomData::<String> };
        assert_eq!(super::mass(&two), super::EXPECTED, "{:?}", two.meta);
        let single = Single { m: 2.0, l: 0.5, name: String::new(), more: vec![] };
        assert_eq!(single.mass_matrix(&SVector::from([0.3]))[0], 0.5_f32, "{}{:?}", single.name, single.more);
        let numbers = Numbers { t: &1, u: "u" };
        assert_eq!(super::mass(&numbers), super::EXPECTED, "{}{}", numbers.t, numbers.u);
        let half = Half { m, l: String::new() };
        assert_eq!(super::mass(&half), super::EXPECTED, "{}", half.l);
        assert_eq!(super::mass(&T), super::EXPECTED);
    }
}

mod renamed {
    //! The run-time crate under another name.

    mod facade {
        pub(crate) use dynamics_core as dynamics;
    }
    use facade::dynamics::Dynamics;

    robot! { #[dynamics(crate = "crate::renamed::facade::dynamics")] [struct Robot] m, l, { m: f64, l: f64 } }
    robot! { #[dynamics(crate = "facade::dynamics")] [struct Other] 2, 0.5, ; }

    #[test]
    fn the_path_is_used() {
        assert_eq!(super::mass(&Robot { m: 2.0, l: 0.5 }), super::mass(&Other));
    }
}

#[test]
fn a_robot_in_a_function() {
    robot! { [struct Local<T>] m, l, { m: T, l: T } }
    let robot = Local { m: 2.0, l: 0.5 };
    assert_eq!(mass(&robot.prepare()), EXPECTED);
    assert_eq!(robot.pose::<Tip>(&SVector::from([0.0])).translation[0], 1.0);
}

mod two {
    //! Two robots with bodies of the same names.

    use dynamics_core::prelude::*;

    robot! { [pub(crate) struct Left] 2, 0.5, ; }
    robot! { [pub(crate) struct Right] 2, 0.25, ; }

    #[test]
    fn each_has_its_own_frames() {
        let q = SVector::from([0.0]);
        assert_eq!(Left.pose::<left_frames::Tip>(&q).translation[0], 1.0);
        assert_eq!(Right.pose::<right_frames::Tip>(&q).translation[0], 0.5);
    }
}

mod bare {
    //! Nothing is in scope: neither a prelude nor the traits. What is generated names all it needs.
    #![no_implicit_prelude]

    robot! { [pub(crate) struct Bare<T>] m, l, { pub(crate) m: T, pub(crate) l: T } }
    robot! { [pub(crate) struct Fixed] 2, 0.5, ; }

    use ::dynamics_core::Dynamics;
    use ::std::prelude::v1::{derive, test};
    use ::std::{assert_eq, fmt::Debug};

    #[test]
    fn paths_are_absolute() {
        assert_eq!(super::mass(&Bare { m: 2.0, l: 0.5 }), super::mass(&Fixed));
    }
}

mod shadowed {
    //! The names that generated code uses mean something else here.
    #![allow(dead_code, non_upper_case_globals, reason = "they only have to be in the way")]

    use ::dynamics_core::Dynamics;

    pub(crate) const fn madd() {}
    pub(crate) const fn sin_cos() {}
    pub(crate) struct Scalar;
    pub(crate) struct SVector;
    pub(crate) struct Cost;
    pub(crate) trait Mechanism {}
    pub(crate) mod core {}
    pub(crate) mod std {}
    pub(crate) mod dynamics_core {}
    pub(crate) const M: u8 = 1;
    pub(crate) static LENGTH: u8 = 2;

    /// Fields named as the constants are.
    #[allow(non_snake_case, reason = "as in the textbook")]
    #[derive(Dynamics)]
    #[joint(hinge: revolute(y), world -> rod)]
    #[body(rod, com = [LENGTH, 0, 0], solid = point(M))]
    pub(crate) struct Robot<T> {
        M: T,
        LENGTH: T,
    }

    #[test]
    fn nothing_is_in_the_way() {
        assert_eq!(super::mass(&Robot { M: 2.0, LENGTH: 0.5 }), super::EXPECTED);
    }
}

mod manifolds {
    //! Balls, free bodies, followers and springs, with nothing in scope: what is generated for them fits as well.
    #![no_implicit_prelude]

    use ::dynamics_core::nalgebra::SVector;
    use ::dynamics_core::{
        CentroidalDynamics, Configuration, Dynamics, Mechanism, Regressor, StateSpaceModel,
    };
    use ::std::prelude::v1::{Ok, derive, test};
    use ::std::{assert_eq, fmt::Debug};

    /// A body that flies, with a ball, a spring and a follower on it.
    #[derive(Dynamics, Debug)]
    #[joint(base: free, world -> hull)]
    #[body(hull, solid = sphere(m, 20cm))]
    #[joint(socket: ball, hull -> arm, at = [l, 0, 0], actuated = off)]
    #[body(arm, solid = rod(m, l), com = [0, 0, l])]
    #[joint(slide: prismatic(z), arm -> tip, stiffness = k, friction = f, friction_speed = s)]
    #[body(tip, solid = point(m))]
    #[joint(turn: revolute(x), arm -> flag, mimic = slide, ratio = r, offset = 0.1)]
    #[body(flag, solid = point(m), com = [0, l, 0])]
    pub(crate) struct Flying<T> {
        pub(crate) m: T,
        pub(crate) l: T,
        pub(crate) k: T,
        pub(crate) f: T,
        pub(crate) s: T,
        pub(crate) r: T,
    }

    /// The same kinds in numbers.
    #[derive(Dynamics, Debug)]
    #[joint(base: free, world -> hull)]
    #[body(hull, solid = sphere(1, 20cm))]
    #[joint(socket: ball, hull -> arm, at = [0.5, 0, 0])]
    #[body(arm, solid = cuboid(1, [0.1, 0.2, 0.3]))]
    pub(crate) struct Fixed;

    #[test]
    fn they_work() {
        let flying = Flying { m: 1.0, l: 0.5, k: 2.0, f: 0.1, s: 0.2, r: 3.0 }.prepare();
        let q: SVector<f64, 12> = flying.neutral();
        assert_eq!(flying.total_mass(), 4.0);
        assert_eq!(flying.check_configuration(&q), Ok(()));
        assert_eq!(flying.gravity_forces(&q)[2], 4.0 * 9.81);
        assert_eq!(flying.input_map().ncols(), 1);
        assert_eq!(flying.inertial_parameters().len(), <Flying<f64> as Mechanism>::PARAMETER_NAMES.len());
        assert_eq!(flying.difference(&q, &flying.integrate(&q, &SVector::zeros())).amax(), 0.0);
        let q: SVector<f32, 11> = Fixed.neutral();
        assert_eq!(Fixed.mass_matrix(&q)[0], 2.0);
    }
}
