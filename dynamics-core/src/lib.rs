//! The run time of generated robot dynamics.
//!
//! For a robot with coordinates q and velocities v, this crate gives names and types to the terms of
//!
//! > M(q)·v̇ + C(q,v)·v + G(q) = τ
//!
//! and works with them: [`Dynamics`] and its derivatives, [frames](Kinematics), the
//! [centre of mass](CentroidalDynamics), [inertial parameters](Regressor), [simulation](Simulation),
//! [linearisation](StateSpaceModel) with [outputs](output), [linear analysis and design](linear), [equilibria](trim),
//! [controllers](control). The derive macro writes the implementations, specialised to one robot. No `unsafe`; without
//! the features `std`, a default, and `rayon` no heap, no panics and no standard library.
//!
//! # Conventions
//!
//! | | |
//! |---|---|
//! | units | SI and radians |
//! | gravity | 9.81 m/s² along −z of the world unless the robot says otherwise |
//! | `C` | Levi-Civita: C·v + G is exact and Ṁ = C + Cᵀ; between one-dof joints the Christoffel matrix |
//! | `G` | ∂V/∂q, on the left-hand side: the forces that hold the robot still |
//! | `tau` | positive along the joint's axis; vᵀτ is the power put in |
//! | passive forces | of damping, friction and springs, on the left-hand side, beside `G`; armature is part of `M` |
//! | `V` | of gravity, and of the robot's own potentials; the energy of springs in joints is apart, and part of every total |
//! | six-vectors | linear first, then angular |
//! | quaternions | i, j, k, w, of unit length; before them, in a free joint, the position |
//! | velocity of a free joint | the twist of the body, in the body |
//! | derivatives by `q` | in the tangent space: by δ of `q ⊕ δ` |
//! | inertial parameters | m, m·c, then xx, xy, yy, xz, yz, zz of the inertia about the origin of the body's frame |
//! | poses | map coordinates in the frame to coordinates in the world |
//! | not finite, singular, no unit quaternion | IEEE 754 in plain methods, an [`Error`] from `try_…` methods and simulation |
//!
//! # Features
//!
//! | | |
//! |---|---|
//! | `derive` (default) | the derive macro `Dynamics` |
//! | `std` (default) | square root and fused multiply-add of the platform; the latter needs a target that has it, for x86 `-C target-cpu=native` or the like. [Recorded motions][Trajectory] and [flows](simulate::Flow) of any size, which have a heap |
//! | `libm` | square roots by the crate `libm` where there is no `std`; without either, by code of our own |
//! | `simd` (default) | [lanes]: `f64x2` to `f64x8`, `f32x4` to `f32x16` as scalars, and a robot's sines in them; [batches][batch] of states from slices |
//! | `rayon` | batches over all cores; implies `simd` and `std`, has a heap, and panics if threads cannot be started |
//! | `serde` | `Serialize` for states, poses, equations, derivatives, linear models, energies, costs, limits and errors, and `Deserialize` for all but errors; matrices as nalgebra writes them, by columns |
//! | `defmt` | `Format` for the same types, for the log of a microcontroller |
//!
//! Any set of them works together. On a target without an operating system `std` and `rayon` are refused; there
//! `default-features = false, features = ["derive"]` is all that is needed.
//!
#![cfg_attr(feature = "std", doc = "[Trajectory]: simulate::Trajectory")]
#![cfg_attr(not(feature = "std"), doc = "[Trajectory]: #features")]
#![cfg_attr(not(feature = "simd"), doc = "[lanes]: #features\n[batch]: #features")]
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(
    all(feature = "std", target_os = "none"),
    allow(
        unconditional_recursion,
        reason = "without `std` a square root calls itself; the error below is enough"
    )
)]

#[cfg(all(feature = "std", target_os = "none"))]
compile_error!(
    "the feature `std` of `dynamics-core` needs an operating system, and this target has none; \
     write `default-features = false, features = [\"derive\"]` where you depend on it, and leave out `rayon`"
);

#[cfg(all(any(feature = "std", test), not(target_os = "none")))]
extern crate std;

#[doc(hidden)]
pub mod __private;
#[cfg(feature = "simd")]
pub mod batch;
pub mod centroidal;
pub mod control;
pub mod dynamics;
pub mod equations;
pub mod error;
pub mod kinematics;
#[cfg(feature = "simd")]
pub mod lanes;
pub mod linear;
pub mod linearize;
pub mod mechanism;
pub mod output;
mod product;
pub mod regressor;
#[cfg(feature = "simd")]
pub mod rollout;
pub mod scalar;
pub mod simulate;
#[cfg(any(test, not(any(feature = "std", feature = "libm"))))]
mod square_root;
pub mod state;
pub mod state_space;
pub mod trigonometry;
pub mod trim;

pub use nalgebra;

#[cfg(feature = "derive")]
pub use dynamics_macros::Dynamics;

pub use centroidal::CentroidalDynamics;
pub use dynamics::{
    Dynamics, DynamicsDerivatives, EquationsOfMotion, ForwardDynamicsDerivatives, InverseDynamicsDerivatives,
};
pub use equations::{Definition, Equation, Equations};
pub use error::Error;
pub use kinematics::{EachFrame, Frame, FrameVisitor, Kinematics, Pose};
pub use linearize::{Linearization, StateSpaceModel};
pub use mechanism::{Cost, Costs, FrameCosts, JointLimits, Mechanism, Motion};
pub use regressor::{BaseRegressor, Regressor};
pub use scalar::Scalar;
pub use simulate::{
    Adaptive, Energy, Integrator, Rk4, Sample, SemiImplicitEuler, Simulation, Tolerances, Variational,
};
pub use state::{Configuration, State};
pub use state_space::{Signal, StateSpace};
pub use trim::{Trim, TrimFailure, Trimmed};

/// Everything a program with a robot needs: `use dynamics_core::prelude::*;`.
pub mod prelude {
    pub use crate::control::{self, Reference};
    pub use crate::output::{self, Output, Triple as _};
    pub use crate::{
        Adaptive, BaseRegressor, CentroidalDynamics, Configuration, Cost, Costs, Dynamics,
        DynamicsDerivatives, EachFrame, Energy, EquationsOfMotion, Error, ForwardDynamicsDerivatives, Frame,
        FrameCosts, FrameVisitor, Integrator, InverseDynamicsDerivatives, JointLimits, Kinematics,
        Linearization, Mechanism, Motion, Pose, Regressor, Rk4, Sample, Scalar, SemiImplicitEuler, Signal,
        Simulation, State, StateSpace, StateSpaceModel, Tolerances, Trim, Variational,
    };
    #[cfg(feature = "simd")]
    pub use crate::{
        batch,
        lanes::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8},
        rollout::{Rollout, Rollouts},
    };
    pub use nalgebra::{SMatrix, SVector};
}
