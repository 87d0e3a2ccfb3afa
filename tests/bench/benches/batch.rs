//! How long a state takes in lanes: `RUSTFLAGS="-C target-cpu=native" cargo bench -p dynamics-bench --bench batch`.
//!
//! One line a robot and method: minimum nanoseconds a state over batches of random states, one call a state
//! (`scalar`), with states that are in lanes already (`f64x4` to `f32x16`), by `batch::map` from slices and back, of
//! states that fit into the first cache (`batch`) and of many (`many`), and by `batch::par_map` of as many on one
//! thread and on two.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::hint::black_box;
use std::time::Instant;

use dynamics_bench::{industrial, models};
use dynamics_core::batch::Pack;
use dynamics_core::lanes::{Element, Lanes};
use dynamics_core::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

const FEW: usize = 64;
const MANY: usize = 16_384;
/// So many states all batches of a row have together, so that rows take about as long.
const STATES: usize = 400_000;

fn main() {
    let wanted: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wants = |name: &str| wanted.is_empty() || wanted.iter().any(|wanted| wanted == name);
    println!("robot\tmethod\tscalar\tf64x4\tf64x8\tf32x8\tf32x16\tbatch\tmany\tpar 1\tpar 2");
    if wants("double_pendulum") {
        race("double_pendulum", &industrial::planar_2dof::Planar2Dof);
    }
    if wants("puma560") {
        race("puma560", &industrial::puma560::Puma560);
    }
    if wants("iiwa14") {
        race("iiwa14", &industrial::iiwa14::Iiwa14);
    }
    if wants("hyq") {
        race("hyq", &models::hyq::Hyq);
    }
}

/// Coordinates, speeds, and accelerations or forces.
type State<T, const NQ: usize, const NV: usize> = (SVector<T, NQ>, SVector<T, NV>, SVector<T, NV>);

/// The shortest time a state that `batch` takes for `count` of them, in ns.
fn time(count: usize, mut batch: impl FnMut()) -> f64 {
    let one = |_| {
        let start = Instant::now();
        batch();
        start.elapsed().as_nanos() as f64 / count as f64
    };
    (0..STATES / count).map(one).fold(f64::INFINITY, f64::min)
}

/// [`time`] with states in lanes from the beginning.
fn in_lanes<L: Lanes, const NQ: usize, const NV: usize, O>(
    states: &[State<L::Element, NQ, NV>],
    call: impl Fn(&State<L, NQ, NV>) -> O,
) -> f64 {
    let packed = states.chunks_exact(L::COUNT).map(|states| Pack::pack::<L, _>(states, |state| state));
    let packed: Vec<_> = packed.collect();
    time(states.len(), || packed.iter().for_each(|state| _ = black_box(call(black_box(state)))))
}

/// Random states of a robot.
fn states<T: Element, R: Configuration<T, NQ, NV>, const NQ: usize, const NV: usize>(
    robot: &R,
) -> Vec<State<T, NQ, NV>> {
    let mut seed = 2026_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        T::of((seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    let mut vector = || SVector::<T, NV>::from_fn(|_, _| random());
    let neutral = robot.neutral();
    (0..MANY).map(|_| (robot.integrate(&neutral, &vector()), vector(), vector())).collect()
}

macro_rules! row {
    ($name:ident, $robot:ident, $double:ident, $single:ident, $pools:ident, $label:literal,
     |$q:ident, $v:ident, $x:ident| $call:expr) => {{
        let few = &$double[..FEW];
        let scalar = time(FEW, || {
            few.iter().for_each(|state| {
                let ($q, $v, $x) = black_box(state);
                _ = black_box($call);
            });
        });
        let lanes = [
            in_lanes::<f64x4, _, _, _>(few, |($q, $v, $x)| $call),
            in_lanes::<f64x8, _, _, _>(few, |($q, $v, $x)| $call),
            in_lanes::<f32x8, _, _, _>(&$single[..FEW], |($q, $v, $x)| $call),
            in_lanes::<f32x16, _, _, _>(&$single[..FEW], |($q, $v, $x)| $call),
        ];
        let (mut q, mut v, mut x) = (vec![], vec![], vec![]);
        $double.iter().for_each(|state| {
            q.push(state.0);
            v.push(state.1);
            x.push(state.2);
        });
        let ($q, $v, $x) = &$double[0];
        let mut results = vec![$call; MANY];
        let mut batch = |n: usize| {
            time(n, || {
                let states = (&q[..n], &v[..n], &x[..n]);
                let done = batch::map(states, &mut results[..n], |($q, $v, $x)| {
                    let ($q, $v, $x) = (&$q, &$v, &$x);
                    $call
                });
                black_box((&done, &mut results));
            })
        };
        let batches = [batch(FEW), batch(MANY)];
        let parallel = $pools.each_ref().map(|pool: &ThreadPool| {
            pool.install(|| {
                time(MANY, || {
                    let done = batch::par_map((&q, &v, &x), &mut results, |($q, $v, $x)| {
                        let ($q, $v, $x) = (&$q, &$v, &$x);
                        $call
                    });
                    black_box((&done, &mut results));
                })
            })
        });
        let times = [scalar].into_iter().chain(lanes).chain(batches).chain(parallel);
        let times: Vec<String> = times.map(|time| format!("{time:.1}")).collect();
        println!("{}\t{}\t{}", $name, $label, times.join("\t"));
    }};
}

/// Times the methods of a robot.
fn race<R, const NQ: usize, const NV: usize>(name: &str, robot: &R)
where
    R: DynamicsDerivatives<f64, NQ, NV>
        + DynamicsDerivatives<f64x4, NQ, NV>
        + DynamicsDerivatives<f64x8, NQ, NV>
        + DynamicsDerivatives<f32x8, NQ, NV>
        + DynamicsDerivatives<f32x16, NQ, NV>
        + Configuration<f64, NQ, NV>
        + Configuration<f32, NQ, NV>
        + Sync,
{
    let double: Vec<State<f64, NQ, NV>> = states(robot);
    let single: Vec<State<f32, NQ, NV>> = states(robot);
    let pools = [1, 2].map(|threads| {
        ThreadPoolBuilder::new().num_threads(threads).build().expect("the machine starts two threads")
    });
    row!(name, robot, double, single, pools, "rnea", |q, v, a| robot.inverse_dynamics(q, v, a));
    row!(name, robot, double, single, pools, "crba", |q, _v, _a| robot.mass_matrix(q));
    row!(name, robot, double, single, pools, "aba", |q, v, tau| robot.forward_dynamics(q, v, tau));
    row!(name, robot, double, single, pools, "minv", |q, _v, _a| robot.inverse_mass_matrix(q));
    row!(name, robot, double, single, pools, "drnea", |q, v, a| robot.inverse_dynamics_derivatives(q, v, a));
    row!(name, robot, double, single, pools, "daba", |q, v, tau| robot
        .forward_dynamics_derivatives(q, v, tau));
}
