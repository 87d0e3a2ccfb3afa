//! The recursion over a table of links: against point masses, dual numbers and closed forms.
#![cfg(feature = "std")]

#[path = "recursion/closed_forms.rs"]
mod closed_forms;
#[path = "recursion/lanes.rs"]
mod lanes;
#[path = "recursion/laws.rs"]
mod laws;
#[path = "recursion/robots.rs"]
mod robots;

use crate::common::dual::Dual;
use crate::common::{random_numbers, random_vector};
use dynamics_core::__private::EliminationTree;
use dynamics_core::__private::recursion::{Drive, Joint, Link, Masses, Passive, Tree, same};
use dynamics_core::prelude::*;

use laws::for_each_state;
use robots::{AXES, Robot, Shape, lifted};

/// Roundings of long sums, relative to the largest entry.
const TOLERANCE: f64 = 1e-11;

/// The same behind a mass matrix of up to a hundred joints.
const TOLERANCE_OF_SOLUTIONS: f64 = 1e-8;

#[track_caller]
fn close<const R: usize, const C: usize>(a: &SMatrix<f64, R, C>, b: &SMatrix<f64, R, C>, tolerance: f64) {
    assert!(a.iter().all(|x| x.is_finite()), "{a}");
    let (error, size) = ((a - b).amax(), b.amax());
    assert!(error <= tolerance * size.max(1e-3), "{error:e} of {size:e}");
}

#[track_caller]
fn close_numbers(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs().max(1e-3), "{a:e} is not {b:e}");
}

fn with_stack(bytes: usize, run: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(bytes).spawn(run).expect("a thread with its stack");
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
}

#[test]
fn single_precision_agrees_with_double() {
    for_each_state::<18, 34, 30>("FRBPuPRfBRFuRusppR", |robot, (q, v, tau)| {
        let single = lifted::<f32, 18, 34, 30>(&robot.tree);
        let (q32, v32, tau32) = (q.map(|x| x as f32), v.map(|x| x as f32), tau.map(|x| x as f32));
        let a = single.inverse_dynamics(&q32, &v32, &tau32).map(f64::from);
        close(&a, &robot.tree.inverse_dynamics(&q, &v, &tau), 1e-4);
        let c = single.coriolis_matrix(&q32, &v32).map(f64::from);
        close(&c, &robot.tree.coriolis_matrix(&q, &v), 1e-4);
    });
}

/// A pendulum whose numbers `of` makes of those that are written.
macro_rules! pendulum {
    ($of:path) => {
        Tree {
            links: [Link {
                parent: None,
                joint: Joint::Revolute(
                    Drive { q: 0, v: 0, ratio: $of(1.0), offset: $of(0.0) },
                    Passive {
                        armature: $of(0.1),
                        damping: $of(0.0),
                        friction: None,
                        stiffness: $of(0.0),
                        rest: $of(0.0),
                    },
                ),
                rotation: [
                    [$of(1.0), $of(0.0), $of(0.0)],
                    [$of(0.0), $of(0.0), $of(-1.0)],
                    [$of(0.0), $of(1.0), $of(0.0)],
                ],
                position: [$of(0.0), $of(0.0), $of(0.3)],
            }],
            masses: Masses {
                mass: [$of(2.0)],
                first: [[$of(1.2)], [$of(0.0)], [$of(0.0)]],
                second: [[$of(0.8)], [$of(0.0)], [$of(0.0)], [$of(0.0)], [$of(0.0)], [$of(0.0)]],
            },
            base_mass: $of(0.0),
            base_first: [$of(0.0); 3],
            gravity: [$of(0.0), $of(0.0), $of(-9.81)],
        }
    };
}

#[test]
fn a_constant_tree_is_read_where_it_stands_or_filled_for_another_scalar() {
    static DOUBLE: Tree<f64, 1, 1, 1> = pendulum!(same);
    static SINGLE: Tree<f32, 1, 1, 1> = pendulum!(same);
    assert!(DOUBLE.read_in(&SINGLE, || unreachable!(), |tree| core::ptr::eq(tree, &DOUBLE)));
    assert!(DOUBLE.read_in(&SINGLE, || unreachable!(), |tree| core::ptr::eq(tree, &SINGLE)));

    let q = SVector::from([Dual { value: 0.3, tangent: 1.0 }]);
    let energy = DOUBLE.read_in(&SINGLE, || pendulum!(Dual::of), |tree| tree.potential_energy(&q));
    close_numbers(energy.value, 9.81 * (2.0 * 0.3 + 1.2 * 0.3_f64.sin()), TOLERANCE); // m·g·z of the centre of mass
    close_numbers(energy.tangent, 9.81 * 1.2 * 0.3_f64.cos(), TOLERANCE);
    let m = DOUBLE.read_in(&SINGLE, || pendulum!(Dual::of), |tree| tree.mass_matrix(&q));
    close_numbers(m[0].value, 0.8 + 0.1, TOLERANCE);
}

/// Unoptimised, and with the results (up to 240 kB) on the same stack.
#[test]
fn a_hundred_joints_fit_on_a_small_stack() {
    type Call = fn(&Tree<f64, 100, 100, 100>, &SVector<f64, 100>) -> f64;
    let calls: [Call; 8] = [
        |tree, x| tree.inverse_dynamics(x, x, x)[0],
        |tree, x| tree.forward_dynamics(x, x, x)[0],
        |tree, x| tree.lagrangian(x, x),
        |tree, x| tree.equations_of_motion(x, x).coriolis_matrix[0],
        |tree, x| tree.inverse_dynamics_derivatives(x, x, x).dtau_dq[0],
        |tree, x| tree.forward_dynamics_derivatives(x, x, x).da_dq[0],
        |tree, x| tree.inverse_mass_matrix(x)[0],
        |tree, x| tree.centroidal_momentum_matrix(x)[0],
    ];
    let tree = Box::new(Robot::<100, 100, 100>::random("RRP", Shape::Chain, 4).tree);
    for call in calls {
        let tree = tree.clone();
        with_stack(1_500 << 10, move || assert!(call(&tree, &SVector::repeat(0.5)).is_finite()));
    }
}

/// The same in lanes, on what a thread has if nobody asks for more.
#[test]
fn a_hundred_joints_in_lanes_fit_on_the_stack_of_a_thread() {
    type Call = fn(&Tree<f64, 100, 100, 100>, &SVector<f64, 100>) -> f64;
    let calls: [Call; 5] = [
        |tree, x| tree.in_lanes().mass_matrix(x)[0],
        |tree, x| tree.in_lanes().inverse_mass_matrix(x, const { &EliminationTree::CHAIN })[0],
        |tree, x| tree.in_lanes().coriolis_matrix(x, x)[0],
        |tree, x| tree.in_lanes().inverse_dynamics_derivatives(x, x, x).dtau_dq[0],
        |tree, x| {
            let by = const { &EliminationTree::CHAIN };
            tree.in_lanes().forward_dynamics_derivatives(x, x, x, by).da_dq[0]
        },
    ];
    let mut tree = Box::new(Robot::<100, 100, 100>::random("R", Shape::Chain, 4).tree);
    for (k, link) in tree.links.iter_mut().enumerate() {
        if let Joint::Revolute(drive, _) = &mut link.joint {
            *drive = Drive { q: k, v: k, ratio: 1.0, offset: 0.0 };
        }
    }
    for call in calls {
        let tree = tree.clone();
        with_stack(2 << 20, move || assert!(call(&tree, &SVector::repeat(0.5)).is_finite()));
    }
}

/// A parent that is not smaller is the world: nothing panics, nothing runs for ever.
#[test]
fn a_malformed_tree_is_still_a_tree() {
    let mut malformed = Robot::<3, 3, 3>::random("RRP", Shape::Chain, 5).tree;
    let mut rooted = malformed;
    for (link, parent) in malformed.links.iter_mut().zip([0, 2, 100]) {
        link.parent = Some(parent);
    }
    rooted.links.iter_mut().for_each(|link| link.parent = None);
    let x = SVector::from([0.4, -1.0, 2.0]);
    assert_eq!(malformed.mass_matrix(&x), rooted.mass_matrix(&x));
    assert_eq!(
        malformed.forward_dynamics_derivatives(&x, &x, &x),
        rooted.forward_dynamics_derivatives(&x, &x, &x)
    );
    let (axes, origin) = (AXES, [0.0; 3]);
    assert_eq!(malformed.pose(Some(2), axes, origin, &x), rooted.pose(Some(2), axes, origin, &x));
    assert_eq!(malformed.pose(Some(9), axes, origin, &x), Pose::identity());
}

/// A joint whose coordinates and speeds are not there stands still at zero.
#[test]
fn what_is_not_there_is_at_rest() {
    let mut whole = Robot::<3, 3, 3>::random("RRP", Shape::Chain, 6).tree;
    if let Joint::Prismatic(drive, _) = &mut whole.links[2].joint {
        drive.offset = 0.0;
    }
    let Tree { links, masses, base_mass, base_first, gravity } = whole;
    let [q, v, a] = [[0.4, -1.0, 0.0], [2.0, 0.3, 0.0], [0.8, 0.1, 0.0]].map(SVector::from);
    let tau = whole.inverse_dynamics(&q, &v, &a);
    let [short_q, short_v, short_a] = [q, v, a].map(|x| x.fixed_rows::<2>(0).into_owned());
    for joint in [
        links[2].joint,
        Joint::Ball { q: 2, v: usize::MAX },
        Joint::Ball { q: usize::MAX, v: 2 },
        Joint::Free { q: usize::MAX - 2, v: usize::MAX - 1 },
    ] {
        let mut links = links;
        links[2].joint = joint;
        let short: Tree<f64, 3, 2, 2> = Tree { links, masses, base_mass, base_first, gravity };
        let short_tau = short.inverse_dynamics(&short_q, &short_v, &short_a);
        close(&short_tau, &tau.fixed_rows::<2>(0).into_owned(), TOLERANCE);
        let m = whole.mass_matrix(&q).fixed_view::<2, 2>(0, 0).into_owned();
        close(&short.mass_matrix(&short_q), &m, TOLERANCE);
        close(&short.forward_dynamics(&short_q, &short_v, &short_tau), &short_a, TOLERANCE);
        let c = whole.coriolis_matrix(&q, &v).fixed_view::<2, 2>(0, 0).into_owned();
        close(&short.coriolis_matrix(&short_q, &short_v), &c, TOLERANCE);
        let jacobian = whole.jacobian(Some(2), AXES, [0.0; 3], &q).fixed_columns::<2>(0).into_owned();
        close(&short.jacobian(Some(2), AXES, [0.0; 3], &short_q), &jacobian, TOLERANCE);
    }
}

/// A free robot's equations are the same a billion metres away.
#[test]
fn nothing_is_lost_far_from_the_worlds_origin() {
    let robot = Robot::<4, 13, 11>::random("FRBP", Shape::Chain, 7);
    let (tree, mut random) = (&robot.tree, random_numbers(8));
    let q = robot.random_coordinates(&mut random, 2.0);
    let [v, a] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
    let mut far = q;
    far[0] = 1e9;
    assert_eq!(tree.inverse_dynamics(&far, &v, &a), tree.inverse_dynamics(&q, &v, &a));
    assert_eq!(tree.coriolis_matrix(&far, &v), tree.coriolis_matrix(&q, &v));
    assert_eq!(tree.centroidal_momentum(&far, &v), tree.centroidal_momentum(&q, &v));
    assert_eq!(tree.centroidal_momentum_matrix(&far), tree.centroidal_momentum_matrix(&q));
}
