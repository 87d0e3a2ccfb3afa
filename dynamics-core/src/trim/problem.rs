//! The equations of a trim: residuals, and their derivatives by what is free.

use nalgebra::SVector;

use super::unknowns::{Equation, Unknowns};
use super::{Trim, Trimmed};
use crate::dynamics::InverseDynamicsDerivatives;
use crate::error::Error;
use crate::linearize::StateSpaceModel;
use crate::mechanism::Mechanism;
use crate::output::{OperatingPoint, Output, Row};
use crate::product::{product, transposed_product};
use crate::scalar::Scalar;
use crate::state::State;

/// Where a search is.
#[derive(Clone, Copy)]
pub(super) struct Point<T, const NQ: usize, const NV: usize, const NU: usize> {
    pub(super) state: State<T, NQ, NV>,
    pub(super) a: SVector<T, NV>,
    pub(super) u: SVector<T, NU>,
}

/// The linear equations of a step: of forces, then of outputs.
pub(super) type Equations<T, const NV: usize, const NU: usize, const NC: usize> =
    ([Equation<T, NV, NU>; NV], [Equation<T, NV, NU>; NC]);

/// What is not zero there: forces, and outputs less their targets.
#[derive(Clone, Copy)]
pub(super) struct Residual<T, const NV: usize, const NC: usize> {
    pub(super) forces: SVector<T, NV>,
    pub(super) misses: SVector<T, NC>,
}

/// What residuals are divided by.
#[derive(Clone, Copy)]
pub(super) struct Scales<T, const NC: usize> {
    pub(super) force: T,
    pub(super) outputs: SVector<T, NC>,
}

impl<T: Scalar + PartialOrd, const NV: usize, const NC: usize> Residual<T, NV, NC> {
    pub(super) fn scaled(&self, scales: &Scales<T, NC>) -> Self {
        let mut scaled = *self;
        scaled.forces.iter_mut().for_each(|force| *force /= scales.force);
        for (miss, scale) in scaled.misses.iter_mut().zip(&scales.outputs) {
            *miss /= *scale;
        }
        scaled
    }

    pub(super) fn is_finite(&self) -> bool {
        self.forces.iter().chain(&self.misses).all(|x| x.is_finite())
    }

    pub(super) fn square(&self) -> T {
        self.forces.iter().chain(&self.misses).fold(T::zero(), |sum, x| x.mul_add(*x, sum))
    }

    pub(super) fn largest(&self) -> T {
        self.forces.iter().chain(&self.misses).fold(T::zero(), |max, x| larger(max, *x))
    }
}

/// The larger one of `max` and `|x|`.
pub(super) fn larger<T: Scalar + PartialOrd>(max: T, x: T) -> T {
    let size = if x < T::zero() { -x } else { x };
    if size > max { size } else { max }
}

impl<R, T, O, const NQ: usize, const NV: usize, const NU: usize, const NC: usize>
    Trim<'_, R, T, NQ, NV, NU, O, NC>
where
    R: Mechanism,
    T: Scalar + PartialOrd,
    O: Output<R, T, NQ, NV>,
{
    fn rows<const NX: usize>(&self, point: &Point<T, NQ, NV, NU>) -> Result<[Row<T, NV>; NC], Error>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let mut rows = [Row::zero(); NC];
        let State { q, v } = point.state;
        let tau = product(&self.robot.input_map(), &point.u);
        let at = OperatingPoint { q, v, a: point.a, tau, tangent_rate: self.robot.tangent_rate(&v) };
        self.outputs.write(self.robot, &at, &mut rows)?;
        Ok(rows)
    }

    pub(super) fn residual<const NX: usize>(
        &self,
        point: &Point<T, NQ, NV, NU>,
    ) -> Result<Residual<T, NV, NC>, Error>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let State { q, v } = &point.state;
        let tau = product(&self.robot.input_map(), &point.u);
        let forces = self.robot.inverse_dynamics(q, v, &point.a) - tau;
        let mut misses = -self.targets;
        for (miss, row) in misses.iter_mut().zip(&self.rows(point)?) {
            *miss += row.value;
        }
        Ok(Residual { forces, misses })
    }

    /// The largest force at a point, and the sizes of the targets.
    pub(super) fn scales<const NX: usize>(&self, point: &Point<T, NQ, NV, NU>) -> Scales<T, NC>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let State { q, v } = &point.state;
        let tau = product(&self.robot.input_map(), &point.u);
        let forces = self.robot.inverse_dynamics(q, v, &point.a);
        let derivatives = self.robot.inverse_dynamics_derivatives(q, v, &point.a);
        let sizes = forces.iter().chain(&tau).chain(&derivatives.dtau_dq);
        let force = sizes.fold(T::zero(), |max, x| larger(max, *x));
        let mut outputs = self.targets;
        outputs.iter_mut().for_each(|target| *target = larger(T::one(), *target));
        Scales { force: if force > T::zero() { force } else { T::one() }, outputs }
    }

    /// The linear equations `J·δ = −residual`, scaled: of forces, then of outputs.
    pub(super) fn equations<const NX: usize>(
        &self,
        point: &Point<T, NQ, NV, NU>,
        scaled: &Residual<T, NV, NC>,
        scales: &Scales<T, NC>,
    ) -> Result<Equations<T, NV, NU, NC>, Error>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let State { q, v } = &point.state;
        let input_map = self.robot.input_map();
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.robot.inverse_dynamics_derivatives(q, v, &point.a);
        let ([by_q], [by_v], [by_a]) =
            ([dtau_dq.transpose().data.0], [dtau_dv.transpose().data.0], [dtau_da.transpose().data.0]);
        let by_u = (-input_map).transpose().data.0;
        let mut of_forces = [Equation::zero(); NV];
        let derivatives = by_q.iter().zip(&by_v).zip(&by_a).zip(&by_u);
        for ((equation, (((q, v), a), u)), right) in of_forces.iter_mut().zip(derivatives).zip(&scaled.forces)
        {
            *equation = self.equation(Unknowns { q: *q, v: *v, a: *a, u: *u }, scales.force, *right);
        }
        let mut of_outputs = [Equation::zero(); NC];
        let rows = self.rows(point)?;
        for (((equation, row), scale), right) in
            of_outputs.iter_mut().zip(&rows).zip(&scales.outputs).zip(&scaled.misses)
        {
            let ([q], [v], [a]) = (row.by_q.data.0, row.by_v.data.0, row.by_a.data.0);
            let [u] = transposed_product(&input_map, &row.by_tau).data.0;
            *equation = self.equation(Unknowns { q, v, a, u }, *scale, *right);
        }
        for equation in of_forces.iter().chain(&of_outputs) {
            if let Some(index) = equation.coefficients.iter().position(|x| !x.is_finite()) {
                return Err(Error::NotFinite { vector: "derivatives", index });
            }
        }
        Ok((of_forces, of_outputs))
    }

    fn equation(&self, derivatives: Unknowns<T, NV, NU>, scale: T, residual: T) -> Equation<T, NV, NU> {
        let mut coefficients = derivatives.only(&self.free);
        coefficients.iter_mut().for_each(|x| *x /= scale);
        Equation { coefficients, right: -residual }
    }

    /// Where a step leads.
    pub(super) fn moved<const NX: usize>(
        &self,
        point: &Point<T, NQ, NV, NU>,
        step: &Unknowns<T, NV, NU>,
    ) -> Point<T, NQ, NV, NU>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let Point { state: State { q, v }, a, u } = point;
        Point {
            state: State { q: self.robot.integrate(q, &SVector::from(step.q)), v: v + SVector::from(step.v) },
            a: a + SVector::from(step.a),
            u: u + SVector::from(step.u),
        }
    }

    pub(super) fn trimmed<const NX: usize>(
        &self,
        point: &Point<T, NQ, NV, NU>,
        residual: &Residual<T, NV, NC>,
        iterations: usize,
    ) -> Trimmed<T, NQ, NV, NU>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        let Point { state, a, u } = *point;
        let squares = residual.misses.iter().fold(T::zero(), |sum, miss| miss.mul_add(*miss, sum));
        let tau = product(&self.robot.input_map(), &u);
        Trimmed { state, a, u, tau, imbalance: residual.forces, miss: squares.sqrt(), iterations }
    }
}
