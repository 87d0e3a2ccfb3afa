//! Robots of other shapes and lengths than those of the race: `cargo bench -p dynamics-bench --bench shapes`.
//!
//! Whether the code is as fast where nobody looks: chains whose joints are no multiple of a register's lanes, five and six
//! legs, two arms, a humanoid; a long chain that nothing holds.
#![allow(clippy::print_stdout, reason = "the table is the product")]
#![allow(clippy::duplicated_attributes, reason = "joints are locked alike")]

use dynamics_bench::contest::{least, states};
use dynamics_bench::models::chain32::Chain32;
use dynamics_core::prelude::*;

/// A robot with what its traits require and the table has: without frames, momenta and regressors, which nobody asks for here
/// and which would be expanded and checked all the same.
macro_rules! measured {
    ($($item:tt)*) => {
        #[derive(Dynamics)]
        #[dynamics(outputs(
            mass_matrix, inverse_mass_matrix, coriolis_matrix, gravity_forces, bias_forces, inverse_dynamics, forward_dynamics,
            kinetic_energy, potential_energy, lagrangian, inverse_dynamics_derivatives, forward_dynamics_derivatives
        ))]
        $($item)*
    };
}

/// A chain of which some joints at the tip are locked.
macro_rules! chain {
    ($name:ident without $($joint:ident)*) => {
        measured! {
            #[dynamics(urdf = "robots/chain32.urdf")]
            $(#[joint($joint, locked = 0)])*
            struct $name;
        }
    };
}

chain!(Chain31 without joint32);
chain!(Chain30 without joint31 joint32);
chain!(Chain29 without joint30 joint31 joint32);
chain!(Chain28 without joint29 joint30 joint31 joint32);

/// Legs of three joints on a trunk that nothing holds.
macro_rules! walker {
    ($name:ident: $($hip:ident $thigh:ident $shin:ident, $upper:ident $lower:ident $foot:ident at [$($at:tt)*];)*) => {
        measured! {
            #[joint(base: free, world -> trunk)]
            #[body(trunk, mass = 12, com = [0.01, 0, 0.02], inertia = tensor(0.2, 0.001, 0.002, 0.4, 0.0003, 0.5))]
            $(
                #[joint($hip: revolute(z), trunk -> $upper, at = [$($at)*])]
                #[body($upper, mass = 0.9, com = [0.02, 0.01, 0], inertia = diag(0.001, 0.002, 0.002))]
                #[joint($thigh: revolute(y), $upper -> $lower, at = [0.05, 0, 0])]
                #[body($lower, mass = 1.1, com = [0.08, 0, 0.01], inertia = diag(0.001, 0.004, 0.004))]
                #[joint($shin: revolute(y), $lower -> $foot, at = [0.2, 0, 0])]
                #[body($foot, mass = 0.5, com = [0.1, 0, -0.02], inertia = diag(0.0005, 0.003, 0.003))]
            )*
            struct $name;
        }
    };
}

walker! { FiveLegs:
    h1 t1 s1, u1 l1 f1 at [0.3, 0, 0];
    h2 t2 s2, u2 l2 f2 at [0.09, 0.28, 0];
    h3 t3 s3, u3 l3 f3 at [-0.24, 0.17, 0];
    h4 t4 s4, u4 l4 f4 at [-0.24, -0.17, 0];
    h5 t5 s5, u5 l5 f5 at [0.09, -0.28, 0];
}

walker! { SixLegs:
    h1 t1 s1, u1 l1 f1 at [0.3, 0.15, 0];
    h2 t2 s2, u2 l2 f2 at [0, 0.2, 0];
    h3 t3 s3, u3 l3 f3 at [-0.3, 0.15, 0];
    h4 t4 s4, u4 l4 f4 at [-0.3, -0.15, 0];
    h5 t5 s5, u5 l5 f5 at [0, -0.2, 0];
    h6 t6 s6, u6 l6 f6 at [0.3, -0.15, 0];
}

/// Arms of seven joints on the world.
macro_rules! arms {
    ($name:ident: $(
        [$($at:tt)*] $a:ident $b:ident $c:ident $d:ident $e:ident $f:ident $g:ident,
        $k:ident $l:ident $m:ident $n:ident $o:ident $p:ident $q:ident;
    )*) => {
        measured! {
            $(
                #[joint($a: revolute(z), world -> $k, at = [$($at)*])]
                #[body($k, mass = 4, com = [0, 0.01, 0.1], inertia = diag(0.03, 0.03, 0.01))]
                #[joint($b: revolute(y), $k -> $l, at = [0, 0, 0.2])]
                #[body($l, mass = 4, com = [0, 0.01, 0.1], inertia = diag(0.03, 0.03, 0.01))]
                #[joint($c: revolute(z), $l -> $m, at = [0, 0, 0.2])]
                #[body($m, mass = 3, com = [0.01, 0, 0.1], inertia = diag(0.02, 0.02, 0.01))]
                #[joint($d: revolute(y), $m -> $n, at = [0, 0, 0.2])]
                #[body($n, mass = 3, com = [0.01, 0, 0.1], inertia = diag(0.02, 0.02, 0.01))]
                #[joint($e: revolute(z), $n -> $o, at = [0, 0, 0.2])]
                #[body($o, mass = 2, com = [0, 0.02, 0.1], inertia = diag(0.01, 0.01, 0.005))]
                #[joint($f: revolute(y), $o -> $p, at = [0, 0, 0.2])]
                #[body($p, mass = 2, com = [0, 0.02, 0.1], inertia = diag(0.01, 0.01, 0.005))]
                #[joint($g: revolute(z), $p -> $q, at = [0, 0, 0.1])]
                #[body($q, mass = 0.5, com = [0.01, 0, 0.02], inertia = diag(0.001, 0.001, 0.001))]
            )*
            struct $name;
        }
    };
}

arms! { OneArm:
    [0, 0.3, 0] a1 a2 a3 a4 a5 a6 a7, k1 k2 k3 k4 k5 k6 k7;
}

arms! { TwoArms:
    [0, 0.3, 0] a1 a2 a3 a4 a5 a6 a7, k1 k2 k3 k4 k5 k6 k7;
    [0, -0.3, 0] b1 b2 b3 b4 b5 b6 b7, l1 l2 l3 l4 l5 l6 l7;
}

/// Bodies on a first one, which stands in the world by the joint given.
macro_rules! bodies {
    ($name:ident, $root:ident by $base:ident $(($axis:ident))?:
        $($joint:ident $about:ident $parent:ident $body:ident [$($at:tt)*] [$($rpy:tt)*];)*
    ) => {
        measured! {
            #[joint(base: $base $(($axis))?, world -> $root)]
            #[body($root, mass = 6, com = [0.01, 0, 0.02], inertia = tensor(0.08, 0.001, 0.002, 0.09, 0.0003, 0.1))]
            $(
                #[joint($joint: revolute($about), $parent -> $body, at = [$($at)*], rpy = [$($rpy)*])]
                #[body($body, mass = 1.5, com = [0.01, 0.02, 0.1], inertia = tensor(0.012, 0.0001, 0.0002, 0.023, 0.0003, 0.02))]
            )*
            struct $name;
        }
    };
}

bodies! { Snake, b0 by free:
    j1 z b0 b1 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j2 z b1 b2 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j3 z b2 b3 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j4 z b3 b4 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j5 z b4 b5 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j6 z b5 b6 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j7 z b6 b7 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j8 z b7 b8 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j9 z b8 b9 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j10 z b9 b10 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j11 z b10 b11 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j12 z b11 b12 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j13 z b12 b13 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j14 z b13 b14 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j15 z b14 b15 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j16 z b15 b16 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j17 z b16 b17 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j18 z b17 b18 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j19 z b18 b19 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j20 z b19 b20 [0, 0.1, 0.25] [1.2, 0.3, 0];
    j21 z b20 b21 [0, 0.1, 0.25] [1.2, 0.3, 0];
}

/// A trunk with a head, arms of seven joints and legs of six.
macro_rules! humanoid {
    ($name:ident by $($base:tt)*) => {
        bodies! { $name, pelvis by $($base)*:
            waist_yaw z pelvis waist [0, 0, 0.1] [0, 0, 0];
            waist_roll x waist belly [0, 0, 0.05] [0, 0, 0];
            waist_pitch y belly chest [0, 0, 0.05] [0, 0, 0];
            neck_yaw z chest neck [0, 0, 0.4] [0, 0, 0];
            neck_pitch y neck head [0, 0, 0.05] [0, 0, 0];
            shoulder_pitch_l y chest shoulder_pitch_l_link [0, 0.2, 0.3] [0, 0, 0];
            shoulder_roll_l x shoulder_pitch_l_link shoulder_roll_l_link [0.01, 0, -0.12] [0, 0, 0];
            shoulder_yaw_l z shoulder_roll_l_link shoulder_yaw_l_link [0.01, 0, -0.12] [0, 0, 0];
            elbow_l y shoulder_yaw_l_link elbow_l_link [0.01, 0, -0.12] [0, 0, 0];
            forearm_l z elbow_l_link forearm_l_link [0.01, 0, -0.12] [0, 0, 0];
            wrist_pitch_l y forearm_l_link wrist_pitch_l_link [0.01, 0, -0.12] [0, 0, 0];
            wrist_roll_l x wrist_pitch_l_link wrist_roll_l_link [0.01, 0, -0.12] [0, 0, 0];
            shoulder_pitch_r y chest shoulder_pitch_r_link [0, -0.2, 0.3] [0, 0, 0];
            shoulder_roll_r x shoulder_pitch_r_link shoulder_roll_r_link [0.01, 0, -0.12] [0, 0, 0];
            shoulder_yaw_r z shoulder_roll_r_link shoulder_yaw_r_link [0.01, 0, -0.12] [0, 0, 0];
            elbow_r y shoulder_yaw_r_link elbow_r_link [0.01, 0, -0.12] [0, 0, 0];
            forearm_r z elbow_r_link forearm_r_link [0.01, 0, -0.12] [0, 0, 0];
            wrist_pitch_r y forearm_r_link wrist_pitch_r_link [0.01, 0, -0.12] [0, 0, 0];
            wrist_roll_r x wrist_pitch_r_link wrist_roll_r_link [0.01, 0, -0.12] [0, 0, 0];
            hip_yaw_l z pelvis hip_yaw_l_link [0, 0.1, -0.05] [0, 0, 0];
            hip_roll_l x hip_yaw_l_link hip_roll_l_link [0.01, 0, -0.12] [0, 0, 0];
            hip_pitch_l y hip_roll_l_link hip_pitch_l_link [0.01, 0, -0.12] [0, 0, 0];
            knee_l y hip_pitch_l_link knee_l_link [0.01, 0, -0.12] [0, 0, 0];
            ankle_pitch_l y knee_l_link ankle_pitch_l_link [0.01, 0, -0.12] [0, 0, 0];
            ankle_roll_l x ankle_pitch_l_link ankle_roll_l_link [0.01, 0, -0.12] [0, 0, 0];
            hip_yaw_r z pelvis hip_yaw_r_link [0, -0.1, -0.05] [0, 0, 0];
            hip_roll_r x hip_yaw_r_link hip_roll_r_link [0.01, 0, -0.12] [0, 0, 0];
            hip_pitch_r y hip_roll_r_link hip_pitch_r_link [0.01, 0, -0.12] [0, 0, 0];
            knee_r y hip_pitch_r_link knee_r_link [0.01, 0, -0.12] [0, 0, 0];
            ankle_pitch_r y knee_r_link ankle_pitch_r_link [0.01, 0, -0.12] [0, 0, 0];
            ankle_roll_r x ankle_pitch_r_link ankle_roll_r_link [0.01, 0, -0.12] [0, 0, 0];
        }
    };
}

humanoid!(Humanoid by free);
humanoid!(HeldHumanoid by revolute(z));

fn main() {
    println!("| robot | speeds | M | C | M⁻¹ | ∂ID | ∂FD |\n|---|--:|--:|--:|--:|--:|--:|");
    row("one arm", &OneArm);
    row("two arms", &TwoArms);
    row("five legs", &FiveLegs);
    row("six legs", &SixLegs);
    row("humanoid", &Humanoid);
    row("humanoid, held", &HeldHumanoid);
    row("floating chain of 21", &Snake);
    row("chain of 28", &Chain28);
    row("chain of 29", &Chain29);
    row("chain of 30", &Chain30);
    row("chain of 31", &Chain31);
    row("chain of 32", &Chain32);
}

/// A line of the table: nanoseconds a call.
fn row<R, const NQ: usize, const NV: usize>(name: &str, robot: &R)
where
    R: DynamicsDerivatives<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    let states = states(robot);
    let times = [
        least(&states, |s| robot.mass_matrix(&s.q)),
        least(&states, |s| robot.coriolis_matrix(&s.q, &s.v)),
        least(&states, |s| robot.inverse_mass_matrix(&s.q)),
        least(&states, |s| robot.inverse_dynamics_derivatives(&s.q, &s.v, &s.a)),
        least(&states, |s| robot.forward_dynamics_derivatives(&s.q, &s.v, &s.a)),
    ];
    let cells: String = times.iter().map(|time| format!(" {time:.0} |")).collect();
    println!("| {name} | {NV} |{cells}");
}
