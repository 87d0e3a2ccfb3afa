//! The robojudge of the lecture EECS C106A, discussion 9: its M and V, the box that it tosses, and its wave to a winner.
//!
//! `cargo run --example robojudge`, and in pictures `cargo run --example robojudge -- --plot wave.svg --animate wave.html`

use std::f64::consts::TAU;

use dynamics_core::control::ComputedTorque;
use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// A column that turns, and an arm that pitches on top of it: problem 5.
#[derive(Dynamics)]
#[dynamics(gravity = [0, 0, -g])]
#[joint(theta1: revolute(z), world -> column)]
#[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
#[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1])]
#[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
#[allow(dead_code, reason = "nothing turns the column about x or y: ix1 and iy1 are in no equation")]
#[rustfmt::skip]
struct RoboJudge {
    m1: f64, m2: f64, l1: f64, r0: f64, r1: f64, g: f64,
    ix1: f64, iy1: f64, iz1: f64, ix2: f64, iy2: f64, iz2: f64,
}

/// A box in the air, problem 4: up by z, its spin by three turns. What is between two joints has no mass.
#[derive(Dynamics)]
#[joint(height: prismatic(z), world -> air)]
#[body(air)]
#[joint(roll: revolute(x), air -> rolled)]
#[body(rolled)]
#[joint(pitch: revolute(y), rolled -> pitched)]
#[body(pitched)]
#[joint(yaw: revolute(z), pitched -> cargo)]
#[body(cargo, solid = cuboid(m, [l, w, h]))]
struct TossedBox {
    m: f64,
    l: f64,
    w: f64,
    h: f64,
}

#[rustfmt::skip]
const JUDGE: RoboJudge = RoboJudge {
    m1: 4.0, m2: 1.5, l1: 0.9, r0: 0.4, r1: 0.3, g: 9.81,
    ix1: 0.30, iy1: 0.30, iz1: 0.05, ix2: 0.06, iy2: 0.01, iz2: 0.055,
};

/// The winner's side, how high the hand is held and how far it waves, in rad, and how often, in 1/s.
const WINNER: f64 = 1.2;
const RAISED: f64 = -1.0;
const WAVE: f64 = 0.35;
const RATE: f64 = 1.5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    judge();
    toss()?;
    wave()
}

/// `M` and `V` beside the lecture's formulas.
fn judge() {
    let RoboJudge { m1, m2, l1, r0, r1, g, iz1, ix2, iy2, iz2, .. } = JUDGE;
    let q = SVector::from([0.4, 0.7]);
    let (s2, c2) = f64::sin_cos(q[1]);

    // The handout prints m2 r1 cos²(theta2), which is no inertia: the units want r1².
    let m11 = iz1 + iy2 * s2 * s2 + iz2 * c2 * c2 + m2 * r1 * r1 * c2 * c2;
    let m22 = ix2 + m2 * r1 * r1;
    let v = g * (m1 * r0 + m2 * (l1 - r1 * s2));

    let m = JUDGE.mass_matrix(&q);
    println!("The robojudge at theta = (0.4, 0.7) rad, and the lecture's formulas:");
    row("M11", m[(0, 0)], m11);
    row("M12", m[(0, 1)], 0.0);
    row("M22", m[(1, 1)], m22);
    row("V", JUDGE.potential_energy(&q), v);
    let Costs { mass_matrix, prepare, .. } = RoboJudge::COST;
    println!("M(q) takes {mass_matrix}; what depends on fields alone, once for all methods, {prepare}.\n");
}

/// The Lagrangian of the box as it leaves the hand, then its flight.
fn toss() -> Result<(), Error> {
    let parcel = TossedBox { m: 0.4, l: 0.3, w: 0.2, h: 0.1 };
    let TossedBox { m, l, w, h } = parcel;
    let (r, vz, [x, y, z]) = (1.2, 3.0, [1.0, 0.5, 2.0]);
    let (q, v) = (SVector::from([r, 0.0, 0.0, 0.0]), SVector::from([vz, x, y, z]));

    let spin = x * x * (w * w + h * h) + y * y * (l * l + h * h) + z * z * (l * l + w * w);
    let lagrangian = m / 24.0 * spin + vz * vz * m / 2.0 - m * 9.81 * r;
    println!("The box at the moment of the toss:");
    row("L", parcel.lagrangian(&q, &v), lagrangian);

    // In flight its momenta change by gravity only; the angular one is in world axes the same all the way.
    let mut simulation = Simulation::new(&parcel, State::new(q, v), 1e-3)?;
    let momentum = |state: &State<f64, 4, 4>| {
        let spin = parcel.velocity::<Cargo>(&state.q, &state.v);
        let body = [(w * w + h * h), (l * l + h * h), (l * l + w * w)].map(|square| m / 12.0 * square);
        let body = SVector::from([body[0] * spin[3], body[1] * spin[4], body[2] * spin[5]]);
        parcel.pose::<Cargo>(&state.q).transform_vector(&body)
    };
    println!("  time, s   height, m   angular momentum in the world, g m^2/s");
    for _ in 0..6 {
        let sample = simulation.steps(100).last().expect("a hundred steps have a last")?;
        let [x, y, z] = (momentum(&sample.state) * 1e3).data.0[0];
        println!("{:9.1} {:11.4}   {x:9.6} {y:9.6} {z:9.6}", sample.time, sample.state.q[0]);
    }
    Ok(())
}

/// It turns to the winner, raises its arm and waves, by computed torque.
fn wave() -> Result<(), Box<dyn std::error::Error>> {
    let judge = JUDGE.prepare();
    let hello = |time: f64| {
        let (s, c) = (TAU * RATE * time).sin_cos();
        let rate = TAU * RATE;
        Reference {
            q: SVector::from([WINNER, RAISED + WAVE * s]),
            v: SVector::from([0.0, WAVE * rate * c]),
            a: SVector::from([0.0, -WAVE * rate * rate * s]),
        }
    };
    let controller = ComputedTorque::critically_damped(SVector::from([4.0, 6.0]));
    let torque = |time, state: &_| controller.torque(&judge, state, &hello(time));
    let mut simulation = Simulation::new(&judge, State::rest(SVector::zeros()), 1e-3)?.with_input(torque);
    let mut seen = Recording::of(&judge).with_masses();
    seen.see(&simulation.sample());
    println!("\nIt waves to the winner, who is {WINNER} rad to its left:");
    println!("  time, s   column, rad   arm, rad   should be   torques, N m");
    for _ in 0..8 {
        let sample =
            seen.watch_under(simulation.steps(500), torque).last().expect("500 steps have a last")?;
        let (q, tau) = (sample.state.q, torque(sample.time, &sample.state));
        let arm = hello(sample.time).q[1];
        println!("{:9.1} {:13.5} {:10.5} {arm:11.5} {:8.3} {:6.3}", sample.time, q[0], q[1], tau[0], tau[1]);
    }
    let miss = (hello(simulation.time()).q - simulation.state().q).norm();
    println!("After four seconds it is {miss:.1e} rad from its wave.");
    if miss > 1e-4 {
        return Err("the robojudge does not wave as it should".into());
    }
    draw(|| seen.figure("A robojudge that waves"), || seen.film().tracing("arm"))
}

fn row(what: &str, derived: f64, lecture: f64) {
    println!("  {what:4} {derived:12.8}   {lecture:12.8}");
}
