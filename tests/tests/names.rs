//! Names that are odd and legal: of fields, bodies, joints and robots. They compile, and the numbers are right.
#![allow(non_snake_case, non_camel_case_types, reason = "that is what is tested")]

use dynamics_core::prelude::*;

/// `M = m·l² + i`, `G = m·g·l·cos q` of a rod about a horizontal axis: `[M, G, C·v, τ, a]` at one state.
fn answers<R: Dynamics<f64, 1, 1>>(robot: &R) -> [f64; 5] {
    let (q, v, a) = (SVector::from([0.3]), SVector::from([0.7]), SVector::from([-0.4]));
    let torque = robot.inverse_dynamics(&q, &v, &a);
    let acceleration = robot.forward_dynamics(&q, &v, &torque)[0];
    let coriolis = (robot.coriolis_matrix(&q, &v) * v)[0];
    [robot.mass_matrix(&q)[0], robot.gravity_forces(&q)[0], coriolis, torque[0], acceleration]
}

fn assert_is_a_rod<R: Dynamics<f64, 1, 1>>(robot: &R, name: &str) {
    let (mass, length, moment) = (2.0, 0.5, 0.1);
    let inertia = mass * length * length + moment;
    let weight = mass * 9.81 * length * f64::cos(0.3);
    let expected = [inertia, weight, 0.0, weight - 0.4 * inertia, -0.4];
    for (found, expected) in answers(robot).into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{name}: {found} is not {expected}");
    }
}

/// A rod whose mass, length and moment are fields of these names.
macro_rules! rods {
    ($($test:ident: $mass:ident, $length:ident, $moment:ident;)+) => {
        $(
            #[test]
            fn $test() {
                #[derive(Dynamics)]
                #[joint(hinge: revolute(-y), world -> rod)]
                #[body(rod, mass = $mass, com = [$length, 0, 0], inertia = diag(0, $moment, $moment))]
                struct Robot<T> {
                    $mass: T,
                    $length: T,
                    $moment: T,
                }
                let robot = Robot { $mass: 2.0, $length: 0.5, $moment: 0.1 };
                assert_is_a_rod(&robot, stringify!($test));
                assert_is_a_rod(&robot.prepare(), stringify!($test));
                let pose = robot.pose::<Rod>(&SVector::from([0.3]));
                assert!((pose.rotation[(2, 0)] - f64::sin(0.3)).abs() < 1e-15);
            }
        )+
    };
}

rods! {
    arguments_as_fields: q, v, a;
    other_arguments_as_fields: tau, q0, v0;
    components_as_fields: a0, tau0, self_;
    temporaries_as_fields: e0, e1, m00;
    sines_as_fields: s0, c0, s1;
    capitals_as_fields: T, M, Q;
    prepared_values_as_fields: k0, k1, k2;
    functions_as_fields: madd, sin_cos, sqrt;
    more_functions_as_fields: vector, columns, of;
    the_robot_as_a_field: robot, this, factor;
    keywords_as_fields: r#type, r#fn, r#box;
    keywords_and_their_substitutes_as_fields: r#type, type_, r#match;
    greek_fields: μ, λ, Θ;
    other_scripts_as_fields: 质量, длина, é;
    underscores_as_fields: _m, __l, _i_;
    units_as_fields: kg, mm, deg;
    names_of_the_grammar_as_fields: mass, com, world;
    common_types_as_fields: Box, Rod, Scalar;
}

/// A ball and a free body with fields, joints and bodies of the names that quaternions and steps along a manifold have.
#[test]
fn names_of_manifolds() {
    #[derive(Dynamics)]
    #[joint(free: free, world -> q)]
    #[body(q, mass = w, inertia = diag(i, j, k))]
    #[joint(ball: ball, q -> delta, at = [d0, p0, rate])]
    #[body(delta, mass = w, com = [d0, 0, 0], inertia = diag(i, j, k))]
    #[joint(planar: planar(z), delta -> neutral)]
    #[body(neutral, mass = w, inertia = diag(i, j, k))]
    struct Quaternion<T> {
        i: T,
        j: T,
        k: T,
        w: T,
        d0: T,
        p0: T,
        rate: T,
    }
    let robot = Quaternion { i: 0.1, j: 0.1, k: 0.1, w: 2.0, d0: 0.5, p0: 0.25, rate: 0.125 };
    let q = robot.neutral();
    assert_eq!(robot.mass_matrix(&q)[(0, 0)], 6.0);
    assert_eq!(robot.pose::<Delta>(&q).translation, SVector::from([0.5, 0.25, 0.125]));
    let moved = robot.prepare().integrate(&q, &SVector::from_fn(|k, _| f64::from(u8::from(k < 3))));
    assert_eq!(robot.pose::<Neutral>(&moved).translation, SVector::from([1.5, 1.25, 1.125]));
}

/// Bodies that would hide something common, and joints that could be no identifier.
mod bodies {
    use dynamics_core::prelude::*;

    #[derive(Dynamics)]
    #[joint(self: revolute(z), world -> self)]
    #[body(self, solid = sphere(1, 1))]
    #[joint(r#type: revolute(z), self -> r#box, at = [1, 0, 0])]
    #[body(r#box, solid = sphere(1, 1))]
    #[joint(Type: revolute(z), r#box -> option, at = [1, 0, 0])]
    #[body(option, solid = sphere(1, 1))]
    #[joint(_type: fixed, option -> vec, at = [1, 0, 0])]
    #[joint(__: fixed, vec -> Some)]
    #[joint(_1: fixed, Some -> none)]
    #[joint(crate: fixed, none -> drop)]
    #[joint(f: fixed, drop -> pose)]
    #[joint(world: fixed, pose -> odd)]
    #[joint(copy: fixed, odd -> t)]
    #[joint(string: fixed, t -> fn_)]
    pub(crate) struct Odd;

    #[test]
    fn bodies_do_not_hide_common_types() {
        let some: Option<Box<Vec<String>>> = None;
        assert!(some.is_none());
        assert_eq!(Odd::JOINT_NAMES, ["self", "type", "Type"]);
        assert_eq!(Odd::BODY_NAMES[..4], ["self", "box", "option", "vec"]);
        let q = SVector::from([0.0, 0.0, 0.0]);
        let robot = Odd;
        for pose in [
            robot.pose::<VecFrame>(&q),
            robot.pose::<SomeFrame>(&q),
            robot.pose::<NoneFrame>(&q),
            robot.pose::<DropFrame>(&q),
            robot.pose::<PoseFrame>(&q),
            robot.pose::<OddFrame>(&q),
            robot.pose::<T>(&q),
            robot.pose::<FnFrame>(&q),
        ] {
            let pose: Pose<f64> = pose;
            assert_eq!(pose.translation[0], 3.0);
        }
        assert_eq!(robot.pose::<SelfFrame>(&q).translation[0], 0.0);
        assert_eq!(robot.pose::<BoxFrame>(&q).translation[0], 1.0);
        assert_eq!(robot.pose::<OptionFrame>(&q).translation[0], 2.0);
    }
}

/// Robots that are called as something that generated code uses, each with a body of its own name.
macro_rules! robots {
    ($($module:ident: $robot:ident;)+) => {
        $(
            mod $module {
                use dynamics_core::{Dynamics, Kinematics as _, Mechanism as _};

                #[derive(Dynamics)]
                #[joint(q: revolute(-y), world -> $robot)]
                #[body($robot, mass = m, com = [0.5, 0, 0], inertia = diag(0, 0.1, 0.1))]
                pub(crate) struct $robot<T> {
                    m: T,
                }

                #[derive(Dynamics)]
                #[joint(q: revolute(-y), world -> link)]
                #[body(link, mass = 2, com = [0.5, 0, 0], inertia = diag(0, 0.1, 0.1))]
                pub(crate) struct Unit;

                #[test]
                fn works() {
                    let robot = $robot { m: 2.0 };
                    super::assert_is_a_rod(&robot, stringify!($robot));
                    super::assert_is_a_rod(&robot.prepare(), stringify!($robot));
                    super::assert_is_a_rod(&Unit, "Unit");
                    assert_eq!($robot::<f64>::NAME, stringify!($robot));
                    let pose = Unit.pose::<Link>(&[0.0].into());
                    assert_eq!(pose.translation[0], 0.0);
                }
            }
        )+
    };
}

robots! {
    a_box: Box;
    an_option: Option;
    a_vec: Vec;
    a_pose: Pose;
    a_state: State;
    a_frame: Frame;
    a_scalar: Scalar;
    a_vector: SVector;
    an_error: Error;
    a_cost: Cost;
    a_clone: Clone;
    a_list: EachFrame;
    a_visitor: FrameVisitor;
    a_small_name: arm;
}
