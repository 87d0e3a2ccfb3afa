//! A robot behind an interface without const generics, so that one loop runs over the whole zoo.

use dynamics_core::prelude::*;
use dynamics_core::state;

use crate::{Matrix, Vector};

/// How a simulation steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// [`Rk4`]
    Rk4,
    /// [`SemiImplicitEuler`]
    SemiImplicitEuler,
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
    /// `C(q,v)`
    fn coriolis_matrix(&self, q: &Vector<T>, v: &Vector<T>) -> Matrix<T>;
    /// `G(q)`
    fn gravity_forces(&self, q: &Vector<T>) -> Vector<T>;
    /// `C·v + G`
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
    /// `T − V`
    fn lagrangian(&self, q: &Vector<T>, v: &Vector<T>) -> T;
    /// `M`, `C` and `G` by the bundle.
    fn equations_of_motion(&self, q: &Vector<T>, v: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>);
    /// `∂τ/∂q`, `∂τ/∂v`, `∂τ/∂a`
    fn inverse_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> [Matrix<T>; 3];
    /// `∂a/∂q`, `∂a/∂v`, `∂a/∂τ`
    fn forward_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> [Matrix<T>; 3];
    /// `A`, `B` and the drift, with `u = τ`.
    fn linearize(&self, q: &Vector<T>, v: &Vector<T>, u: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>);
    /// The names of the frames, which are those of the bodies.
    fn frame_names(&self) -> Vec<&'static str>;
    /// Rotation and translation of a frame.
    fn pose(&self, frame: usize, q: &Vector<T>) -> (Matrix<T>, Vector<T>);
    /// The body Jacobian of a frame.
    fn jacobian(&self, frame: usize, q: &Vector<T>) -> Matrix<T>;
    /// The Jacobian of a frame in world axes.
    fn world_jacobian(&self, frame: usize, q: &Vector<T>) -> Matrix<T>;
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

type PoseOf<R, T, const N: usize> = fn(&R, &SVector<T, N>) -> Pose<T>;
type JacobianOf<R, T, const N: usize> = fn(&R, &SVector<T, N>) -> SMatrix<T, 6, N>;

/// The functions of one frame.
pub struct Frames<R, T, const N: usize> {
    name: &'static str,
    pose: PoseOf<R, T, N>,
    jacobian: JacobianOf<R, T, N>,
    world_jacobian: JacobianOf<R, T, N>,
}

/// The functions of the frame `F`.
pub fn frame<F: Frame<R, T, N, N>, R, T: Scalar, const N: usize>() -> Frames<R, T, N>
where
    R: Mechanism,
{
    Frames {
        name: F::NAME,
        pose: R::pose::<F>,
        jacobian: R::jacobian::<F>,
        world_jacobian: R::world_jacobian::<F>,
    }
}

/// A compiled robot of `N` joints and `X = 2·N` states.
pub struct Specialised<R, T, const N: usize, const X: usize> {
    /// The robot, or its prepared companion.
    pub robot: R,
    /// Its frames.
    pub frames: Vec<Frames<R, T, N>>,
}

fn fixed<T: Scalar, const N: usize>(x: &Vector<T>) -> SVector<T, N> {
    SVector::from_column_slice(x.as_slice())
}

fn vector<T: Scalar, const N: usize>(x: SVector<T, N>) -> Vector<T> {
    Vector::from_column_slice(x.as_slice())
}

fn matrix<T: Scalar, const N: usize, const K: usize>(m: SMatrix<T, N, K>) -> Matrix<T> {
    Matrix::from_column_slice(N, K, m.as_slice())
}

impl<R, T, const N: usize, const X: usize> Robot<T> for Specialised<R, T, N, X>
where
    R: StateSpaceModel<T, N, N, X, N>,
    T: Scalar + PartialOrd,
{
    fn mass_matrix(&self, q: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.mass_matrix(&fixed(q)))
    }

    fn coriolis_matrix(&self, q: &Vector<T>, v: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.coriolis_matrix(&fixed(q), &fixed(v)))
    }

    fn gravity_forces(&self, q: &Vector<T>) -> Vector<T> {
        vector(self.robot.gravity_forces(&fixed(q)))
    }

    fn bias_forces(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(self.robot.bias_forces(&fixed(q), &fixed(v)))
    }

    fn inverse_dynamics(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Vector<T> {
        vector(self.robot.inverse_dynamics(&fixed(q), &fixed(v), &fixed(a)))
    }

    fn forward_dynamics(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> Vector<T> {
        vector(self.robot.forward_dynamics(&fixed(q), &fixed(v), &fixed(tau)))
    }

    fn try_forward_dynamics(
        &self,
        q: &Vector<T>,
        v: &Vector<T>,
        tau: &Vector<T>,
    ) -> Result<Vector<T>, Error> {
        self.robot.try_forward_dynamics(&fixed(q), &fixed(v), &fixed(tau)).map(vector)
    }

    fn kinetic_energy(&self, q: &Vector<T>, v: &Vector<T>) -> T {
        self.robot.kinetic_energy(&fixed(q), &fixed(v))
    }

    fn potential_energy(&self, q: &Vector<T>) -> T {
        self.robot.potential_energy(&fixed(q))
    }

    fn lagrangian(&self, q: &Vector<T>, v: &Vector<T>) -> T {
        self.robot.lagrangian(&fixed(q), &fixed(v))
    }

    fn equations_of_motion(&self, q: &Vector<T>, v: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>) {
        let all = self.robot.equations_of_motion(&fixed(q), &fixed(v));
        (matrix(all.mass_matrix), matrix(all.coriolis_matrix), vector(all.gravity_forces))
    }

    fn inverse_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> [Matrix<T>; 3] {
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.robot.inverse_dynamics_derivatives(&fixed(q), &fixed(v), &fixed(a));
        [dtau_dq, dtau_dv, dtau_da].map(matrix)
    }

    fn forward_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> [Matrix<T>; 3] {
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            self.robot.forward_dynamics_derivatives(&fixed(q), &fixed(v), &fixed(tau));
        [da_dq, da_dv, da_dtau].map(matrix)
    }

    fn linearize(&self, q: &Vector<T>, v: &Vector<T>, u: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>) {
        let Linearization { a, b, drift } = self.robot.linearize(&fixed(q), &fixed(v), &fixed(u));
        (matrix(a), matrix(b), vector(drift))
    }

    fn frame_names(&self) -> Vec<&'static str> {
        self.frames.iter().map(|frame| frame.name).collect()
    }

    fn pose(&self, frame: usize, q: &Vector<T>) -> (Matrix<T>, Vector<T>) {
        let Pose { rotation, translation } = (self.frames[frame].pose)(&self.robot, &fixed(q));
        (matrix(rotation), vector(translation))
    }

    fn jacobian(&self, frame: usize, q: &Vector<T>) -> Matrix<T> {
        matrix((self.frames[frame].jacobian)(&self.robot, &fixed(q)))
    }

    fn world_jacobian(&self, frame: usize, q: &Vector<T>) -> Matrix<T> {
        matrix((self.frames[frame].world_jacobian)(&self.robot, &fixed(q)))
    }

    fn simulate(
        &self,
        (q, v): (&Vector<T>, &Vector<T>),
        step: T,
        count: usize,
        by: Method,
    ) -> Result<Run<T>, Error> {
        let from = state::State::new(fixed(q), fixed(v));
        let simulation = Simulation::new(&self.robot, from, step)?;
        match by {
            Method::Rk4 => run(simulation, count),
            Method::SemiImplicitEuler => run(simulation.with_integrator(SemiImplicitEuler), count),
        }
    }

    fn everything_on_the_stack(&self, q: &[T], v: &[T], a: &[T], count: usize) -> Result<T, Error> {
        let [q, v, a] = [q, v, a].map(SVector::from_column_slice);
        let (q, v, a) = (&q, &v, &a);
        let robot = &self.robot;
        let mut sum = robot.kinetic_energy(q, v) + robot.lagrangian(q, v) + robot.total_energy(q, v);
        sum += robot.mass_matrix(q)[0] + robot.coriolis_matrix(q, v)[0] + robot.gravity_forces(q)[0];
        sum += robot.bias_forces(q, v)[0]
            + robot.inverse_dynamics(q, v, a)[0]
            + robot.forward_dynamics(q, v, a)[0];
        sum += robot.try_inverse_dynamics(q, v, a)?[0] + robot.try_forward_dynamics(q, v, a)?[0];
        sum += robot.equations_of_motion(q, v).mass_matrix[0];
        sum += robot.inverse_dynamics_derivatives(q, v, a).dtau_dq[0];
        sum += robot.forward_dynamics_derivatives(q, v, a).da_dq[0];
        sum += robot.linearize(q, v, a).a[0];
        for frame in &self.frames {
            sum += (frame.pose)(robot, q).translation[0];
            sum += (frame.jacobian)(robot, q)[0] + (frame.world_jacobian)(robot, q)[0];
        }
        let from = state::State::new(*q, *v);
        for sample in Simulation::new(robot, from, T::of(1e-3))?.with_input(|_, _| *a).steps(count) {
            sum += sample?.energy().total();
        }
        let euler = Simulation::new(robot, from, T::of(1e-3))?.with_integrator(SemiImplicitEuler);
        for sample in euler.with_input(|_, _| *a).steps(count) {
            sum += sample?.energy().total();
        }
        Ok(sum)
    }
}

fn run<R, T, I, U, const N: usize>(
    mut simulation: Simulation<'_, R, T, N, N, I, U>,
    count: usize,
) -> Result<Run<T>, Error>
where
    R: Dynamics<T, N, N> + Configuration<T, N, N>,
    T: Scalar,
    I: Integrator,
    U: FnMut(T, &state::State<T, N, N>) -> SVector<T, N>,
{
    let mut energies = vec![simulation.sample().energy().total()];
    for sample in simulation.steps(count) {
        energies.push(sample?.energy().total());
    }
    let state::State { q, v } = *simulation.state();
    Ok(Run { energies, q: vector(q), v: vector(v) })
}

/// A robot, and the same after `prepare`.
pub struct Forms<T> {
    /// The struct that carries the derive.
    pub robot: Box<dyn Robot<T>>,
    /// What `prepare` returns.
    pub prepared: Box<dyn Robot<T>>,
}
