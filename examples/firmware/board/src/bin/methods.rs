//! Calls every method of every robot a few times, each as a function with a name: what is measured.
#![no_std]
#![no_main]

use core::hint::black_box;

use dynamics_core::control::{ComputedTorque, StateFeedback};
use dynamics_core::prelude::*;
use firmware_board as _; // the panic handler
use firmware_control::robots::{CartPole, Iiwa14, Leg, Puma560, RoboJudge, RoboJudgePrepared};
use firmware_control::trial::{CART_POLE, IIWA14, LEG, PUMA560, ROBO_JUDGE, STEP, advanced};

/// A function per method, under the robot's name; the symbols are `methods::puma560::inverse_dynamics`, and so on.
macro_rules! measured {
    ($module:ident, $robot:ty, $setup:expr, $n:literal, $nx:literal, $nu:literal) => {
        mod $module {
            use super::*;

            type Vector = SVector<f32, $n>;
            type Matrix = SMatrix<f32, $n, $n>;
            type Feedback = StateFeedback<f32, $n, $n, $nx, $nu>;

            measured! { $robot:
                mass_matrix(q: &Vector) -> Matrix;
                coriolis_matrix(q: &Vector, v: &Vector) -> Matrix;
                gravity_forces(q: &Vector) -> Vector;
                bias_forces(q: &Vector, v: &Vector) -> Vector;
                equations_of_motion(q: &Vector, v: &Vector) -> EquationsOfMotion<f32, $n>;
                inverse_dynamics(q: &Vector, v: &Vector, a: &Vector) -> Vector;
                forward_dynamics(q: &Vector, v: &Vector, tau: &Vector) -> Vector;
                inverse_dynamics_derivatives(q: &Vector, v: &Vector, a: &Vector)
                    -> InverseDynamicsDerivatives<f32, $n>;
                forward_dynamics_derivatives(q: &Vector, v: &Vector, tau: &Vector)
                    -> ForwardDynamicsDerivatives<f32, $n>;
            }

            #[inline(never)]
            fn computed_torque(
                robot: &$robot,
                law: &ComputedTorque<f32, $n>,
                state: &State<f32, $n, $n>,
                reference: &Reference<f32, $n, $n>,
            ) -> Vector {
                law.torque(robot, state, reference)
            }

            #[inline(never)]
            fn state_feedback(robot: &$robot, law: &Feedback, state: &State<f32, $n, $n>) -> SVector<f32, $nu> {
                law.input(robot, state)
            }

            #[inline(never)]
            fn state_update(robot: &$robot, state: &State<f32, $n, $n>, tau: &Vector) -> State<f32, $n, $n> {
                advanced(robot, 0.0, state, STEP as f32, tau)
            }

            pub(super) fn all(robot: &$robot) {
                let feedback: Feedback = $setup.feedback(robot);
                let computed = ComputedTorque::critically_damped(Vector::repeat(20.0));
                for scale in [0.0_f32, 1.0, -7.3] {
                    let [q, v, a] = black_box([0.3, 0.7, -1.1]).map(|x: f32| Vector::repeat(scale * x));
                    let (state, reference) = black_box((State { q, v }, Reference { q: a, v, a }));
                    let (robot, feedback, computed) = black_box((robot, &feedback, &computed));
                    black_box(mass_matrix(robot, &q));
                    black_box(coriolis_matrix(robot, &q, &v));
                    black_box(gravity_forces(robot, &q));
                    black_box(bias_forces(robot, &q, &v));
                    black_box(equations_of_motion(robot, &q, &v));
                    black_box(inverse_dynamics(robot, &q, &v, &a));
                    black_box(forward_dynamics(robot, &q, &v, &a));
                    black_box(inverse_dynamics_derivatives(robot, &q, &v, &a));
                    black_box(forward_dynamics_derivatives(robot, &q, &v, &a));
                    black_box(computed_torque(robot, computed, &state, &reference));
                    black_box(state_feedback(robot, feedback, &state));
                    black_box(state_update(robot, &state, &a));
                }
            }
        }
    };
    ($robot:ty: $($method:ident($($name:ident: $argument:ty),*) -> $result:ty;)*) => {
        $(#[inline(never)]
        fn $method(robot: &$robot, $($name: $argument),*) -> $result {
            robot.$method($($name),*)
        })*
    };
}

measured!(robojudge, RoboJudge<f32>, ROBO_JUDGE, 2, 4, 2);
measured!(robojudge_prepared, RoboJudgePrepared<f32>, ROBO_JUDGE, 2, 4, 2);
measured!(cart_pole, CartPole, CART_POLE, 2, 4, 1);
measured!(leg, Leg, LEG, 3, 6, 3);
measured!(puma560, Puma560, PUMA560, 6, 12, 6);
measured!(iiwa14, Iiwa14, IIWA14, 7, 14, 7);

mod scalar {
    use super::*;

    /// The pair that every joint angle costs.
    #[inline(never)]
    pub(super) fn sin_cos(x: f32) -> (f32, f32) {
        Scalar::sin_cos(x)
    }
}

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let judge = RoboJudge::example();
    robojudge::all(&judge);
    robojudge_prepared::all(&judge.prepare());
    cart_pole::all(&CartPole);
    leg::all(&Leg);
    puma560::all(&Puma560);
    iiwa14::all(&Iiwa14);
    for x in [0.0, 0.3, -7.3, 1e9] {
        black_box(scalar::sin_cos(black_box(x)));
    }
    semihosting::process::exit(0)
}
