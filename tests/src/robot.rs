//! A robot behind an interface without const generics, so that one loop runs over the whole zoo.

use dynamics_core::prelude::*;

use crate::{Matrix, Vector};

/// How a simulation steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// [`Rk4`]
    Rk4,
    /// [`SemiImplicitEuler`]
    SemiImplicitEuler,
    /// [`Variational`]
    Variational,
    /// [`Adaptive`], within 1e-11, sampled at each step
    Adaptive,
}

/// In which axes a six-vector of a frame is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// The frame's own.
    Own,
    /// Those of the world, at the origin of the frame.
    World,
}

impl Axes {
    /// Both of them.
    pub const BOTH: [Self; 2] = [Self::Own, Self::World];
}

/// What a simulation went through.
#[derive(Clone, Debug)]
pub struct Run<T> {
    /// The total energy before the first and after each step, J.
    pub energies: Vec<T>,
    /// The last coordinates.
    pub q: Vector<T>,
    /// The last speeds.
    pub v: Vector<T>,
}

/// Everything a compiled robot can be asked, in vectors and matrices of any size.
pub trait Robot<T: Scalar> {
    /// `M(q)`
    fn mass_matrix(&self, q: &Vector<T>) -> Matrix<T>;
    /// `M(q)⁻¹`
    fn inverse_mass_matrix(&self, q: &Vector<T>) -> Matrix<T>;
    /// `C(q,v)`
    fn coriolis_matrix(&self, q: &Vector<T>, v: &Vector<T>) -> Matrix<T>;
    /// `G(q)`
    fn gravity_forces(&self, q: &Vector<T>) -> Vector<T>;
    /// Of damping, friction and springs.
    fn passive_forces(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// `C·v + G` and passive forces
    fn bias_forces(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// `τ`
    fn inverse_dynamics(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Vector<T>;
    /// `a`
    fn forward_dynamics(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> Vector<T>;
    /// `a`, checked.
    ///
    /// # Errors
    ///
    /// Those of [`Dynamics::try_forward_dynamics`].
    fn try_forward_dynamics(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>)
    -> Result<Vector<T>, Error>;
    /// `T`
    fn kinetic_energy(&self, q: &Vector<T>, v: &Vector<T>) -> T;
    /// `V`
    fn potential_energy(&self, q: &Vector<T>) -> T;
    /// Of springs.
    fn elastic_energy(&self, q: &Vector<T>) -> T;
    /// `T − V`
    fn lagrangian(&self, q: &Vector<T>, v: &Vector<T>) -> T;
    /// `M`, `C` and `G` by the bundle.
    fn equations_of_motion(&self, q: &Vector<T>, v: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>);
    /// `∂τ/∂q`, `∂τ/∂v`, `∂τ/∂a`
    fn inverse_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> [Matrix<T>; 3];
    /// `∂a/∂q`, `∂a/∂v`, `∂a/∂τ`
    fn forward_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> [Matrix<T>; 3];
    /// `τ` and its derivatives by the bundle.
    fn inverse_dynamics_with_derivatives(&self, at: [&Vector<T>; 3]) -> (Vector<T>, [Matrix<T>; 3]);
    /// `a` and its derivatives by the bundle.
    fn forward_dynamics_with_derivatives(&self, at: [&Vector<T>; 3]) -> (Vector<T>, [Matrix<T>; 3]);

    /// The mass of all that moves.
    fn total_mass(&self) -> T;
    /// The centre of mass.
    fn center_of_mass(&self, q: &Vector<T>) -> Vector<T>;
    /// Its Jacobian.
    fn center_of_mass_jacobian(&self, q: &Vector<T>) -> Matrix<T>;
    /// The momentum about it.
    fn centroidal_momentum(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// `A(q)`
    fn centroidal_momentum_matrix(&self, q: &Vector<T>) -> Matrix<T>;
    /// `Y(q,v,a)`
    fn regressor(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Matrix<T>;
    /// `π`
    fn inertial_parameters(&self) -> Vector<T>;
    /// `Y_b(q,v,a)`
    fn base_regressor(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Matrix<T>;
    /// `π_b`
    fn base_parameters(&self) -> Vector<T>;

    /// `q ⊕ δ`
    fn integrate(&self, q: &Vector<T>, delta: &Vector<T>) -> Vector<T>;
    /// `q₁ ⊖ q₀`
    fn difference(&self, q0: &Vector<T>, q1: &Vector<T>) -> Vector<T>;
    /// `δ̇` where `q ⊕ δ` moves with `v`
    fn rate(&self, delta: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// The transposed of that map, of forces.
    fn rate_transposed(&self, delta: &Vector<T>, p: &Vector<T>) -> Vector<T>;
    /// Zeros, and quaternions of no rotation.
    fn neutral(&self) -> Vector<T>;
    /// Whether quaternions are of unit length.
    ///
    /// # Errors
    ///
    /// Those of [`Dynamics::check_configuration`].
    fn check_configuration(&self, q: &Vector<T>) -> Result<(), Error>;
    /// `τ = B_u·u`
    fn input_map(&self) -> Matrix<T>;
    /// `∂δ̇/∂δ`
    fn tangent_rate(&self, v: &Vector<T>) -> Matrix<T>;
    /// `A`, `B` and the drift.
    fn linearize(&self, q: &Vector<T>, v: &Vector<T>, u: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>);

    /// The names of the frames, which are those of the bodies.
    fn frame_names(&self) -> Vec<&'static str>;
    /// Rotation and translation of a frame.
    fn pose(&self, frame: usize, q: &Vector<T>) -> (Matrix<T>, Vector<T>);
    /// The Jacobian of a frame.
    fn jacobian(&self, frame: usize, axes: Axes, q: &Vector<T>) -> Matrix<T>;
    /// The velocity of a frame.
    fn velocity(&self, frame: usize, axes: Axes, q: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// The acceleration of a frame: in its own axes the rate of the twist's components.
    fn acceleration(&self, frame: usize, axes: Axes, at: [&Vector<T>; 3]) -> Vector<T>;
    /// The acceleration of a frame without that of the joints.
    fn bias_acceleration(&self, frame: usize, axes: Axes, q: &Vector<T>, v: &Vector<T>) -> Vector<T>;
    /// The joint forces of a wrench on a frame.
    fn external_forces(&self, frame: usize, axes: Axes, q: &Vector<T>, wrench: &Vector<T>) -> Vector<T>;

    /// `count` unforced steps of `step` seconds.
    ///
    /// # Errors
    ///
    /// Those of [`Simulation`].
    fn simulate(
        &self,
        from: (&Vector<T>, &Vector<T>),
        step: T,
        count: usize,
        by: Method,
    ) -> Result<Run<T>, Error>;
    /// Calls every method of the traits once, and `count` steps of each integrator, on the stack alone.
    ///
    /// # Errors
    ///
    /// Those of [`Simulation`].
    fn everything_on_the_stack(&self, q: &[T], v: &[T], a: &[T], count: usize) -> Result<T, Error>;
}

/// A robot, and the same after `prepare`.
pub struct Forms<T> {
    /// The struct that carries the derive.
    pub robot: Box<dyn Robot<T>>,
    /// What `prepare` returns.
    pub prepared: Box<dyn Robot<T>>,
}
