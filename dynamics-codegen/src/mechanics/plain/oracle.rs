//! All answers about one tree in numbers, with derivatives and forward dynamics; in doubles, residuals.
//!
//! Derivatives of inverse dynamics are those of the recursion itself, by [`Dual`] numbers. Forward dynamics
//! solves with the mass matrix, and its derivatives follow from `ID(q, v, FD(q, v, τ)) = τ`.
//!
//! J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018, section II.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::dense::{Cholesky, Rows, identity, largest, magnitudes, product, times, transpose};
use super::{
    Dual, bias_forces, coriolis_matrix, energy, gravity_forces, inverse_dynamics, kinematics, mass_matrix,
    passive, whole,
};
use crate::model::Tree;
use crate::spatial::Pose;
use crate::symbolic::Real;

/// A tree whose questions are answered by the textbook.
#[derive(Clone, Copy, Debug)]
pub struct Oracle<'t, S = f64> {
    /// The tree.
    pub tree: &'t Tree<S>,
}

/// The derivatives of `τ = ID(q, v, a)`, n×n each.
#[derive(Clone, Debug)]
pub struct InverseDynamicsDerivatives<S = f64> {
    /// `∂τ/∂q`
    pub dtau_dq: Rows<S>,
    /// `∂τ/∂v`
    pub dtau_dv: Rows<S>,
    /// `∂τ/∂a = M(q)`
    pub dtau_da: Rows<S>,
}

/// The derivatives of `a = FD(q, v, τ)`, n×n each.
#[derive(Clone, Debug)]
pub struct ForwardDynamicsDerivatives<S = f64> {
    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`
    pub da_dq: Rows<S>,
    /// `∂a/∂v = −M⁻¹ ∂τ/∂v`
    pub da_dv: Rows<S>,
    /// `∂a/∂τ = M⁻¹`
    pub da_dtau: Rows<S>,
}

impl<'t, S: Real> Oracle<'t, S> {
    /// The oracle for `tree`.
    pub fn new(tree: &'t Tree<S>) -> Self {
        Self { tree }
    }

    /// `M(q)`, n×n, both halves.
    pub fn mass_matrix(&self, q: &[S]) -> Rows<S> {
        mass_matrix(self.tree, q)
    }

    /// `C(q,v)`, n×n, of Levi-Civita.
    pub fn coriolis_matrix(&self, q: &[S], v: &[S]) -> Rows<S> {
        coriolis_matrix(self.tree, q, v)
    }

    /// `G(q) = ∂V/∂q`
    pub fn gravity_forces(&self, q: &[S]) -> Vec<S> {
        gravity_forces(self.tree, q)
    }

    /// `C(q,v)·v + G(q)`
    pub fn bias_forces(&self, q: &[S], v: &[S]) -> Vec<S> {
        bias_forces(self.tree, q, v)
    }

    /// `τ = M·a + C·v + G`
    pub fn inverse_dynamics(&self, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
        inverse_dynamics(self.tree, q, v, a)
    }

    /// `a = M⁻¹ (τ − C·v − G)`; `None` if M is not positive definite to rounding.
    pub fn forward_dynamics(&self, q: &[S], v: &[S], tau: &[S]) -> Option<Vec<S>> {
        let h = self.bias_forces(q, v);
        let free: Vec<S> = tau.iter().zip(h).map(|(&tau, h)| tau - h).collect();
        Some(Cholesky::of(&self.mass_matrix(q))?.solve(&free))
    }

    /// The forces of dampers, friction and springs, n.
    pub fn passive_forces(&self, q: &[S], v: &[S]) -> Vec<S> {
        passive::forces(self.tree, q, v)
    }

    /// The energy of springs, J.
    pub fn elastic_energy(&self, q: &[S]) -> S {
        passive::elastic_energy(self.tree, q)
    }

    /// `T`, J.
    pub fn kinetic_energy(&self, q: &[S], v: &[S]) -> S {
        energy::kinetic_energy(self.tree, q, v)
    }

    /// `V`, J, zero for mass at the world's origin.
    pub fn potential_energy(&self, q: &[S]) -> S {
        energy::potential_energy(self.tree, q)
    }

    /// `L = T − V`, J.
    pub fn lagrangian(&self, q: &[S], v: &[S]) -> S {
        energy::lagrangian(self.tree, q, v)
    }

    /// The pose of the tree's frame number `frame` in the world.
    pub fn pose(&self, frame: usize, q: &[S]) -> Pose<S> {
        kinematics::pose(self.tree, &self.tree.frames[frame], q)
    }

    /// The 6×n Jacobian of a frame in its own axes, linear rows first.
    pub fn body_jacobian(&self, frame: usize, q: &[S]) -> Rows<S> {
        kinematics::body_jacobian(self.tree, &self.tree.frames[frame], q)
    }

    /// The 6×n Jacobian of a frame in world axes, linear rows first, of the frame's own origin.
    pub fn world_jacobian(&self, frame: usize, q: &[S]) -> Rows<S> {
        kinematics::world_jacobian(self.tree, &self.tree.frames[frame], q)
    }

    /// The centre of mass of all that moves, in the world.
    pub fn center_of_mass(&self, q: &[S]) -> Vec<S> {
        whole::center_of_mass(self.tree, q).0.to_vec()
    }

    /// Its Jacobian, 3×n: how it moves along each unit speed.
    pub fn center_of_mass_jacobian(&self, q: &[S]) -> Rows<S> {
        let tree = self.tree.map(Dual::constant);
        let along = |unit: &Vec<S>| -> Vec<S> {
            let moving = Dual::moving(q, &self.tree.configuration_rate(q, unit));
            whole::center_of_mass(&tree, &moving).0.map(|x| x.tangent).to_vec()
        };
        transpose(&identity(self.tree.dof()).iter().map(along).collect::<Rows<S>>())
    }

    /// The momentum about the centre of mass, linear first, in world axes.
    pub fn centroidal_momentum(&self, q: &[S], v: &[S]) -> Vec<S> {
        whole::centroidal_momentum(self.tree, q, v).0.to_vec()
    }

    /// The matrix that takes speeds to that momentum, 6×n.
    pub fn centroidal_momentum_matrix(&self, q: &[S]) -> Rows<S> {
        let units = identity(self.tree.dof());
        transpose(&units.iter().map(|unit| self.centroidal_momentum(q, unit)).collect::<Rows<S>>())
    }

    /// The twist of a frame in its own axes, linear first.
    pub fn velocity(&self, frame: usize, q: &[S], v: &[S]) -> Vec<S> {
        times(&self.body_jacobian(frame, q), v)
    }

    /// The rate of a frame's twist in its own axes, `J·a + J̇·v`, linear first: J as it changes on the way.
    pub fn acceleration(&self, frame: usize, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
        let tree = self.tree.map(Dual::constant);
        let moving = Dual::moving(q, &self.tree.configuration_rate(q, v));
        let J = kinematics::body_jacobian(&tree, &tree.frames[frame], &moving);
        let twist_rate = |row: &Vec<Dual<S>>| {
            let parts = row.iter().zip(v.iter().zip(a));
            parts.fold(S::from(0), |sum, (j, (&v, &a))| sum + (j.value * a + j.tangent * v))
        };
        J.iter().map(twist_rate).collect()
    }

    /// `∂τ/∂q` (in the tangent space), `∂τ/∂v`, `∂τ/∂a` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(&self, q: &[S], v: &[S], a: &[S]) -> InverseDynamicsDerivatives<S> {
        let tree = self.tree.map(Dual::constant);
        let (resting_q, rest) = (vec![S::from(0); q.len()], vec![S::from(0); v.len()]);
        let along = |dq: &[S], dv: &[S]| -> Vec<S> {
            let (q, v) = (Dual::moving(q, dq), Dual::moving(v, dv));
            inverse_dynamics(&tree, &q, &v, &Dual::resting(a)).into_iter().map(|tau| tau.tangent).collect()
        };
        let units: Rows<S> = identity(v.len());
        let by_q: Rows<S> =
            units.iter().map(|unit| along(&self.tree.configuration_rate(q, unit), &rest)).collect();
        let by_v: Rows<S> = units.iter().map(|unit| along(&resting_q, unit)).collect();
        InverseDynamicsDerivatives {
            dtau_dq: transpose(&by_q),
            dtau_dv: transpose(&by_v),
            dtau_da: self.mass_matrix(q),
        }
    }

    /// `∂a/∂q`, `∂a/∂v`, `∂a/∂τ` of forward dynamics; `None` if M is not positive definite to rounding.
    pub fn forward_dynamics_derivatives(
        &self,
        q: &[S],
        v: &[S],
        tau: &[S],
    ) -> Option<ForwardDynamicsDerivatives<S>> {
        let a = self.forward_dynamics(q, v, tau)?;
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.inverse_dynamics_derivatives(q, v, &a);
        let factor = Cholesky::of(&dtau_da)?;
        Some(ForwardDynamicsDerivatives {
            da_dq: factor.solve_columns(&negative(&dtau_dq)),
            da_dv: factor.solve_columns(&negative(&dtau_dv)),
            da_dtau: factor.solve_columns(&identity(v.len())),
        })
    }
}

impl Oracle<'_> {
    /// How far claimed accelerations miss the equations: `‖ID(q,v,a) − τ‖` over `‖|M||a| + |h| + |τ|‖`, in the
    /// largest entry.
    ///
    /// Of the order of the rounding for any stable solver, however ill-conditioned M is, while the error of `a`
    /// itself grows with the condition (J. Rigal, J. Gaches 1967).
    pub fn forward_dynamics_residual(&self, q: &[f64], v: &[f64], tau: &[f64], a: &[f64]) -> f64 {
        let missed =
            self.inverse_dynamics(q, v, a).iter().zip(tau).map(|(id, tau)| id - tau).collect::<Vec<_>>();
        let inertial =
            times(&magnitudes(&self.mass_matrix(q)), &a.iter().map(|a| a.abs()).collect::<Vec<_>>());
        let h = self.bias_forces(q, v);
        let scale: Vec<f64> =
            inertial.iter().zip(&h).zip(tau).map(|((ma, h), tau)| ma + h.abs() + tau.abs()).collect();
        relative(largest(&missed), largest(&scale))
    }

    /// How far a claimed `M⁻¹` misses `M·M⁻¹ = 1`: over `‖|M||M⁻¹|‖`, in the largest entry.
    pub fn inverse_mass_matrix_residual(&self, q: &[f64], claimed: &Rows) -> f64 {
        let M = self.mass_matrix(q);
        let missed = sum(&product(&M, claimed), &negative(&identity(M.len())));
        let scale = product(&magnitudes(&M), &magnitudes(claimed));
        relative(largest(missed.iter().flatten()), largest(scale.iter().flatten()))
    }

    /// How far claimed derivatives of forward dynamics miss `M·∂a/∂x = −∂τ/∂x` and `M·∂a/∂τ = 1`: the largest of
    /// the three, each over `‖|M||∂a| + |∂τ|‖ + ‖M‖` in the largest entry. The last term is the size of what
    /// acts at speeds of one: where the derivatives vanish, what is left of them is rounding of forces as large.
    pub fn forward_dynamics_derivatives_residual(
        &self,
        q: &[f64],
        v: &[f64],
        a: &[f64],
        claimed: &ForwardDynamicsDerivatives,
    ) -> f64 {
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.inverse_dynamics_derivatives(q, v, a);
        let of = |X: &Rows, B: &Rows| {
            let scale = sum(&product(&magnitudes(&dtau_da), &magnitudes(X)), &magnitudes(B));
            let missed = sum(&product(&dtau_da, X), &negative(B));
            let floor = largest(magnitudes(&dtau_da).iter().flatten());
            relative(largest(missed.iter().flatten()), largest(scale.iter().flatten()) + floor)
        };
        largest(&[
            of(&claimed.da_dq, &negative(&dtau_dq)),
            of(&claimed.da_dv, &negative(&dtau_dv)),
            of(&claimed.da_dtau, &identity(v.len())),
        ])
    }
}

/// `missed / scale`, and zero if nothing is missed.
fn relative(missed: f64, scale: f64) -> f64 {
    if missed == 0.0 { 0.0 } else { missed / scale }
}

fn negative<S: Real>(A: &Rows<S>) -> Rows<S> {
    A.iter().map(|row| row.iter().map(|&x| -x).collect()).collect()
}

fn sum(A: &Rows, B: &Rows) -> Rows {
    A.iter().zip(B).map(|(a, b)| a.iter().zip(b).map(|(x, y)| x + y).collect()).collect()
}
