//! A quadruped thrown with a spin: it pulls its legs in, turns faster, and falls on its side, with its momentum kept.
//!
//! `cargo run --example hyq`, and in pictures `cargo run --example hyq -- --plot hyq.svg --animate hyq.html`

use dynamics_core::prelude::*;
use dynamics_core::simulate::{EnergyMonitor, MomentumMonitor, PlaneCrossing};
use dynamics_examples::draw;
use dynamics_view::Recording;

/// HyQ from its file, with what the file does not say: the rotors of its knees, and a load on its trunk.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/hyq.urdf", base = free)]
#[joint([lf_kfe_joint, rh_kfe_joint], rotor = 5e-5, gear = 100, damping = 0.2)]
#[joint(strap: fixed, trunk -> load, at = [0, 0, 0.1])]
#[body(load, solid = cuboid(load, [0.3, 0.2, 0.1]))]
struct Hyq<T> {
    load: T,
}

/// Legs stretched and legs folded, as the front ones have it: hip inwards, hip forwards, knee, in rad.
const STRETCHED: [f64; 3] = [0.0, 0.3, -0.6];
const FOLDED: [f64; 3] = [0.2, 1.1, -2.2];
/// The motors are springs, in N·m/rad, and dampers, in N·m·s/rad.
const SPRING: f64 = 60.0;
const DAMPER: f64 = 6.0;
/// How high the trunk's origin is when its side, with the hips, meets the ground, in m.
const HALF_WIDTH: f64 = 0.25;
/// What momenta may change by in the air, in kg·m/s and kg·m²/s: the integrator's tolerance, and some.
const CONSERVED: f64 = 1e-8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hyq = Hyq { load: 8.0 }.prepare();
    let mass = hyq.total_mass();
    let (nq, nv, nu) = (Robot::NQ, Robot::NV, Robot::NU);
    println!("{nq} coordinates, {nv} speeds, {nu} inputs, {mass:.2} kg");

    // Up with 2 m/s from 1.2 m, rolling; the hind legs mirror the front ones.
    let legs = |pose: [f64; 3]| {
        SVector::<f64, 12>::from_fn(|k, _| if k >= 6 && k % 3 > 0 { -pose[k % 3] } else { pose[k % 3] })
    };
    let (mut q, mut v) = (hyq.neutral(), SVector::zeros());
    q[2] = 1.2;
    q.fixed_rows_mut::<12>(7).copy_from(&legs(STRETCHED));
    (v[2], v[3]) = (2.0, 1.8);

    // Whatever the motors do, they push and pull within the robot.
    let motors = |_, state: &State<f64, 19, 18>| {
        let (at, speed) = (state.q.fixed_rows::<12>(7), state.v.fixed_rows::<12>(6));
        let mut tau = SVector::<f64, 18>::zeros();
        tau.fixed_rows_mut::<12>(6).copy_from(&((legs(FOLDED) - at) * SPRING - speed * DAMPER));
        tau
    };
    let mut flight = Adaptive::new(&hyq, State::new(q, v), Tolerances::of(1e-9))?.with_input(motors);
    let (mut momenta, mut energy) =
        (MomentumMonitor::new(&flight.sample()), EnergyMonitor::new(&flight.sample()));
    let mut seen = Recording::of(&hyq).with_masses();
    let side = PlaneCrossing::<Trunk, f64>::down_to(HALF_WIDTH);

    println!("  time, s   height, m   roll, rad/s   angular momentum about the centre of mass, kg m^2/s");
    let (mut landed, mut step) = (None, 0);
    while landed.is_none() && step <= 2000 {
        let arrival = flight.advance_until(f64::from(step) * 1e-3, &[&side])?;
        let Sample { time, state: State { q, v }, .. } = arrival.sample;
        momenta.observe(&arrival.sample);
        energy.observe(&arrival.sample, motors);
        seen.see_under(&arrival.sample, motors);
        if step % 100 == 0 || arrival.is_event() {
            let [x, y, z] = arrival.sample.momentum().angular.data.0[0];
            println!("{time:9.4} {:11.4} {:13.4} {x:12.7} {y:11.7} {z:11.7}", q[2], v[3]);
        }
        landed = arrival.is_event().then_some(arrival.sample);
        step += 1;
    }
    let landed = landed.ok_or("it has not come down")?;

    // The one force from outside is its weight: m·g for so many seconds.
    let weight = (momenta.linear() - mass * 9.81 * landed.time).abs();
    let (turned, work, lost) = (momenta.angular(), energy.work(), energy.dissipated());
    println!(
        "In the air the angular momentum has changed by {turned:.1e} kg m^2/s, and the linear one by m g t,"
    );
    println!(
        "but for {weight:.1e} kg m/s. The motors have put in {work:.3} J, the knees' dampers took {lost:.3} J,"
    );
    println!("and {:.1e} J of the energy are not accounted for.", energy.drift());
    let trunk = hyq.pose::<Trunk>(&landed.state.q);
    let up = trunk.rotation[(2, 1)].clamp(-1.0, 1.0).asin().to_degrees();
    let feet = [height::<RfFoot>(&hyq, &landed), height::<RhFoot>(&hyq, &landed)];
    println!("After {:.4} s it is on its side: the left one looks {up:.1} degrees up,", landed.time);
    println!("and its right feet are {:.2} and {:.2} m above the ground.", feet[0], feet[1]);

    if turned > CONSERVED || weight > CONSERVED {
        return Err("a momentum has changed in the air".into());
    }
    if up < 60.0 || feet.iter().any(|foot| *foot < 0.0) {
        return Err("it did not fall on its side".into());
    }
    draw(|| seen.figure("A quadruped, thrown"), || seen.film())
}

type Robot = HyqPrepared<f64>;

/// How high a frame is, in m.
fn height<F: Frame<Robot, f64, 19, 18>>(hyq: &Robot, sample: &Sample<'_, Robot, f64, 19, 18>) -> f64 {
    hyq.pose::<F>(&sample.state.q).translation[2]
}
