//! Lanes and batches give the bits of single calls: every method, in every lane, for any number of states.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::fmt::Debug;

use dynamics_core::batch::Pack;
use dynamics_core::lanes::{Element, Lanes, Native};
use dynamics_core::prelude::*;
use dynamics_tests::random::Random;
use dynamics_tests::zoo;
use rayon::ThreadPoolBuilder;

/// Configurations, speeds, and accelerations or forces.
struct States<T, const NQ: usize, const NV: usize> {
    q: Vec<SVector<T, NQ>>,
    v: Vec<SVector<T, NV>>,
    x: Vec<SVector<T, NV>>,
}

impl<T: Element, const NQ: usize, const NV: usize> States<T, NQ, NV> {
    fn random(robot: &impl Configuration<T, NQ, NV>, count: usize) -> Self {
        let mut random = Random::of("lanes");
        let mut vector = |size: f64| SVector::<T, NV>::from_fn(|_, _| T::of(size * random.number()));
        let neutral = robot.neutral();
        let q = (0..count).map(|_| robot.integrate(&neutral, &vector(3.0))).collect();
        let [v, x] = [2.0, 8.0].map(|size| (0..count).map(|_| vector(size)).collect());
        Self { q, v, x }
    }

    /// Eleven, which end within a block of lanes of every width; three of them are not finite or lead to that.
    fn with_bad_ones(robot: &impl Configuration<T, NQ, NV>) -> Self {
        let mut states = Self::random(robot, 11);
        states.q[1][0] = T::of(f64::NAN);
        states.v[6][0] = T::of(f64::INFINITY);
        states.q[9][0] = T::of(1e18); // beyond the range of the sine
        states
    }

    /// What `lanes` gives of all states in a batch is what `single` gives of each.
    fn agree<L: Lanes<Element = T>, O: Pack<Element = T> + Debug>(
        &self,
        what: &str,
        single: impl Fn(&SVector<T, NQ>, &SVector<T, NV>, &SVector<T, NV>) -> O,
        lanes: impl Fn(&SVector<L, NQ>, &SVector<L, NV>, &SVector<L, NV>) -> O::Packed<L>,
    ) {
        let states = self.q.iter().zip(&self.v).zip(&self.x);
        let expected: Vec<O> = states.map(|((q, v), x)| single(q, v, x)).collect();
        let mut found = expected.clone();
        found.rotate_left(1); // so that each must be written
        batch::map_in::<L, _, _>((&self.q, &self.v, &self.x), &mut found, |(q, v, x)| lanes(&q, &v, &x))
            .unwrap();
        for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
            // As text, which tells zeros apart, and in which NaN equals NaN.
            let [found, expected] = [format!("{found:?}"), format!("{expected:?}")];
            assert_eq!(found, expected, "{what} of state {k} in {}", std::any::type_name::<L>());
        }
    }
}

/// Compares all methods of `$robot`, over a float and over lanes of it, on the frame `$frame`.
macro_rules! agree {
    ($float:ident, $lanes:ident, $robot:expr, $frame:ident) => {{
        let (single, wide) = ($robot, $robot);
        let name = format!("{} of {}", stringify!($robot), stringify!($frame));
        let states = States::<$float, _, _>::with_bad_ones(&single);
        macro_rules! method {
            ($method:ident($q:ident, $v:ident, $x:ident) = $r:ident => $call:expr) => {
                states.agree::<$lanes, _>(
                    &format!("{name}: {}", stringify!($method)),
                    |$q, $v, $x| {
                        let $r = &single;
                        $call
                    },
                    |$q, $v, $x| {
                        let $r = &wide;
                        $call
                    },
                )
            };
        }
        method!(mass_matrix(q, _v, _a) = r => r.mass_matrix(q));
        method!(inverse_mass_matrix(q, _v, _a) = r => r.inverse_mass_matrix(q));
        method!(coriolis_matrix(q, v, _a) = r => r.coriolis_matrix(q, v));
        method!(gravity_forces(q, _v, _a) = r => r.gravity_forces(q));
        method!(passive_forces(q, v, _a) = r => r.passive_forces(q, v));
        method!(bias_forces(q, v, _a) = r => r.bias_forces(q, v));
        method!(inverse_dynamics(q, v, a) = r => r.inverse_dynamics(q, v, a));
        method!(forward_dynamics(q, v, tau) = r => r.forward_dynamics(q, v, tau));
        method!(equations_of_motion(q, v, _a) = r => r.equations_of_motion(q, v));
        method!(inverse_derivatives(q, v, a) = r => r.inverse_dynamics_derivatives(q, v, a));
        method!(forward_derivatives(q, v, tau) = r => r.forward_dynamics_derivatives(q, v, tau));
        method!(inverse_bundle(q, v, a) = r => r.inverse_dynamics_with_derivatives(q, v, a));
        method!(forward_bundle(q, v, tau) = r => r.forward_dynamics_with_derivatives(q, v, tau));
        method!(kinetic_energy(q, v, _a) = r => r.kinetic_energy(q, v));
        method!(energies(q, v, _a) = r => (r.potential_energy(q), r.elastic_energy(q), r.lagrangian(q, v)));
        method!(configurations(q, v, _a) = r => r.integrate(q, v));
        method!(differences(q, v, _a) = r => r.difference(q, &r.integrate(q, v)));
        method!(momentum(q, v, _a) = r => (r.center_of_mass(q), r.centroidal_momentum(q, v)));
        method!(momentum_matrix(q, _v, _a) = r => r.centroidal_momentum_matrix(q));
        method!(pose(q, _v, _a) = r => r.pose::<$frame>(q));
        method!(jacobian(q, _v, _a) = r => (r.jacobian::<$frame>(q), r.world_jacobian::<$frame>(q)));
        method!(motion(q, v, a) = r => (r.velocity::<$frame>(q, v), r.acceleration::<$frame>(q, v, a)));
        method!(regressor(q, v, a) = r => r.regressor(q, v, a));
    }};
}

/// Unoptimised, the results of all methods have their own places on the stack of one function.
fn with_room(run: impl FnOnce() + Send + 'static) {
    let thread =
        std::thread::Builder::new().stack_size(64 << 20).spawn(run).expect("a thread with its stack");
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
}

macro_rules! in_all_lanes {
    ($test:ident, $robot:expr, $frame:ident, $($uses:tt)*) => {
        #[test]
        #[allow(clippy::useless_conversion, reason = "the robot of one float is made in the same words as that of lanes")]
        fn $test() {
            use $($uses)*;
            with_room(|| agree!(f64, f64x4, $robot, $frame));
            with_room(|| agree!(f64, f64x8, $robot, $frame));
            with_room(|| agree!(f32, f32x8, $robot, $frame));
            with_room(|| agree!(f32, f32x16, $robot, $frame));
        }
    };
}

in_all_lanes!(an_arm_of_seven, Iiwa14, IiwaLink7, zoo::industrial::iiwa14::{Iiwa14, iiwa14_frames::IiwaLink7});
in_all_lanes!(an_arm_of_six, Puma560, Link6, zoo::industrial::puma560::{Puma560, puma560_frames::Link6});
in_all_lanes!(a_ball_in_a_chain, BallInChain, Finger, zoo::joints::ball_in_chain::{BallInChain, Finger});
in_all_lanes!(
    a_free_body_with_fields,
    FreeBox { m: 1.5.into(), l: 0.4.into(), w: 0.3.into(), h: 0.2.into(), g: 9.81.into() },
    Parcel,
    zoo::joints::free_box::{FreeBox, Parcel}
);
in_all_lanes!(
    springs_and_friction,
    Sprung {
        k: 40.0.into(),
        slack: 0.3.into(),
        c: 0.6.into(),
        f: 0.25.into(),
        s: 0.2.into(),
        j: 0.02.into(),
        n: 6.0.into(),
        stiff: 900.0.into()
    },
    Sole,
    zoo::driven::sprung::{Sole, Sprung}
);

#[test]
fn a_quadruped() {
    use zoo::files::hyq::{Hyq, LfFoot};
    let robot = Hyq;
    let states = States::<f64, 19, 18>::with_bad_ones(&robot);
    type Wide = Native<f64>;
    states.agree::<Wide, _>(
        "τ",
        |q, v, a| robot.inverse_dynamics(q, v, a),
        |q, v, a| robot.inverse_dynamics(q, v, a),
    );
    states.agree::<Wide, _>(
        "a",
        |q, v, t| robot.forward_dynamics(q, v, t),
        |q, v, t| robot.forward_dynamics(q, v, t),
    );
    states.agree::<Wide, _>("pose", |q, _, _| robot.pose::<LfFoot>(q), |q, _, _| robot.pose::<LfFoot>(q));
}

#[test]
fn batches_of_every_length_on_any_number_of_threads() {
    let robot = zoo::industrial::scara::Scara;
    for count in [0, 1, 3, 4, 5, 8, 1000, 5000] {
        let States { q, v, x } = States::<f64, 4, 4>::random(&robot, count);
        let alone = |k: usize| robot.forward_dynamics(&q[k], &v[k], &x[k]);
        let expected: Vec<_> = (0..count).map(alone).collect();
        let mut found = vec![SVector::zeros(); count];
        batch::map((&q, &v, &x), &mut found, |(q, v, x)| robot.forward_dynamics(&q, &v, &x)).unwrap();
        assert_eq!(found, expected, "{count} states");
        for threads in 1..=3 {
            let mut found = vec![SVector::zeros(); count];
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                batch::par_map((&q, &v, &x), &mut found, |(q, v, x)| robot.forward_dynamics(&q, &v, &x))
            })
            .unwrap();
            assert_eq!(found, expected, "{count} states on {threads} threads");
        }
    }
}

#[test]
fn slices_of_other_lengths_are_told() {
    let (four, five) = ([0.0; 4], vec![0.0; 5]);
    let mut results = [7.0; 5];
    let error = Err(Error::BatchLength { results: 5, states: 4 });
    assert_eq!(batch::map(&four, &mut results, |x| x), error);
    assert_eq!(batch::map((&five, &four), &mut results, |(x, y)| x + y), error);
    assert_eq!(batch::par_map((&five[..], (&five, &four)), &mut results, |(x, (y, _))| x + y), error);
    assert_eq!(results, [7.0; 5], "nothing is written");
}
