//! Adaptive tracking on the regressor.

use nalgebra::{SMatrix, SVector};

use super::{Reference, scaled};
use crate::linearize::StateSpaceModel;
use crate::product::{product, transposed_product};
use crate::regressor::{BaseRegressor, Regressor};
use crate::scalar::Scalar;
use crate::state::State;

/// Tracks a reference without knowing the inertial parameters, which it adapts on the way.
///
/// With `s = v − v_r`, the reference velocity `v_r = v_d + Λ·e` and its rate `a_r = a_d + Λ·ė`,
///
/// > `τ = Y(q,v,v_r,a_r)·π̂ − K·s`, `dπ̂/dt = −Γ·Yᵀ·s`,
///
/// where `Y·π = M·a_r + C·v_r + G` and passive forces. Along the motion `V = ½ sᵀ·M·s + ½ (π̂−π)ᵀ·Γ⁻¹·(π̂−π)` changes by
/// `−sᵀ·K·s`, or by less with damping and friction: it never increases, since `Ṁ = C + Cᵀ`. So `s` goes to zero, and the
/// error behind it; the parameters need not become the true ones, unless the motion tells all of them apart.
///
/// `P` says which parameters: [`AllParameters`], or [`BaseParameters`], which are fewer. It remembers `π̂`. How many there
/// are, `NP`, the vector of parameters knows; where it has to be written, the robot has it as the constants
/// [`NP`](crate::Mechanism::NP) and [`NB`](crate::Mechanism::NB).
///
/// # Source
///
/// J.-J. Slotine, W. Li, *On the adaptive control of robot manipulators*, Int. J. Robotics Research 6 (1987) 49–59.
///
/// # Example
///
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use dynamics_core::control::{BaseParameters, SlotineLi};
/// use dynamics_core::prelude::*;
///
/// #[derive(Dynamics)]
/// #[joint(shoulder: revolute(y), world -> upper)]
/// #[body(upper, solid = rod(2, 0.5, z), com = [0, 0, 0.25])]
/// #[joint(elbow: revolute(y), upper -> lower, at = [0, 0, 0.5])]
/// #[body(lower, solid = rod(1, 0.4, z), com = [0, 0, 0.2])]
/// #[joint(grip: fixed, lower -> load, at = [0, 0, 0.4])]
/// #[body(load, solid = point(payload))]
/// struct Arm<T> { payload: T }
///
/// let (real, thought) = (Arm { payload: 1.0 }, Arm { payload: 0.0 }); // it does not know its load
/// let mut controller = SlotineLi {
///     bandwidth: SVector::repeat(5.0),
///     damping: SVector::repeat(20.0),
///     adaptation: SVector::repeat(2.0),
///     parameters: thought.base_parameters(),
///     family: BaseParameters,
/// };
/// let mut simulation = Simulation::new(&real, State::rest(SVector::from([0.1, 0.2])), 1e-3)?;
/// let desired = Reference::rest(SVector::from([0.4, -0.3]));
/// for _ in 0..10_000 {
///     let tracking = controller.track(&thought, simulation.state(), &desired);
///     controller.adapt(&tracking, 1e-3);
///     simulation.step_with(&tracking.tau)?;
/// }
/// assert!((simulation.state().q - desired.q).amax() < 1e-3);
///
/// // A function that is handed the controller names its size.
/// fn learnt(controller: &SlotineLi<f64, 2, { Arm::<f64>::NB }, BaseParameters>) -> f64 {
///     controller.parameters.amax()
/// }
/// # let _ = learnt(&controller);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotineLi<T, const NV: usize, const NP: usize, P = AllParameters> {
    /// `Λ`, in 1/s: how fast the error follows `s`.
    pub bandwidth: SVector<T, NV>,
    /// `K`, in N·m·s/rad or N·s/m.
    pub damping: SVector<T, NV>,
    /// `Γ`, one for each parameter; zero for one that is not adapted.
    pub adaptation: SVector<T, NP>,
    /// `π̂`, the parameters as they are thought to be.
    pub parameters: SVector<T, NP>,
    /// Which parameters these are.
    pub family: P,
}

/// What a [`SlotineLi`] block does at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracking<T, const NV: usize, const NP: usize> {
    /// The joint forces `τ`, NV.
    pub tau: SVector<T, NV>,
    /// `s = v − v_r`, NV.
    pub sliding: SVector<T, NV>,
    /// `dπ̂/dt = −Γ·Yᵀ·s`, NP.
    pub rate: SVector<T, NP>,
}

/// The parameters of [`Regressor`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AllParameters;

/// The parameters of [`BaseRegressor`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BaseParameters;

/// A choice of parameters, and the regressor `Y(q,v,a)` that goes with it.
pub trait Parameters<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize, const NP: usize> {
    /// `Y` of `ID(q,v,a) = Y·π`, NV×NP.
    fn regressor(robot: &R, q: &SVector<T, NQ>, v: &SVector<T, NV>, a: &SVector<T, NV>)
    -> SMatrix<T, NV, NP>;
}

macro_rules! parameters {
    ($family:ident, $trait:ident, $regressor:ident) => {
        impl<R, T: Scalar, const NQ: usize, const NV: usize, const NP: usize> Parameters<R, T, NQ, NV, NP>
            for $family
        where
            R: $trait<T, NQ, NV, NP> + ?Sized,
        {
            #[inline]
            fn regressor(
                robot: &R,
                q: &SVector<T, NQ>,
                v: &SVector<T, NV>,
                a: &SVector<T, NV>,
            ) -> SMatrix<T, NV, NP> {
                robot.$regressor(q, v, a)
            }
        }
    };
}
parameters!(AllParameters, Regressor, regressor);
parameters!(BaseParameters, BaseRegressor, base_regressor);

/// The regressor of Slotine and Li, `Y·π = M(q)·a_r + C(q,v)·v_r + G(q) +` springs and damping at `v_r`, NV×NP.
///
/// `C` is that of [`coriolis_matrix`](crate::Dynamics::coriolis_matrix), which makes the pair passive. It comes from the
/// regressor `Y(q,v,a)` of inverse dynamics at the mean `m = ½(v + v_r)` and half the difference `d = ½(v − v_r)`:
///
/// > `Y(q, m, a_r + ½ ad(v)·v_r) − Y(q, d, 0) + Y(q, 0, 0)`,
///
/// exactly: Coriolis forces are quadratic, so `C(m)·m − C(d)·d = ½(C(v)·v_r + C(v_r)·v)`; and without torsion
/// `C(v)·v_r − C(v_r)·v = M·ad(v)·v_r`, which is zero between one-dof joints. Friction comes out as `f(m) − f(d)`, which
/// against the true `f(v)` only ever takes from `V`.
///
/// # Cost
///
/// Three regressors.
#[inline]
pub fn slotine_li_regressor<
    P,
    R,
    T,
    const NQ: usize,
    const NV: usize,
    const NX: usize,
    const NU: usize,
    const NP: usize,
>(
    robot: &R,
    q: &SVector<T, NQ>,
    v: &SVector<T, NV>,
    v_r: &SVector<T, NV>,
    a_r: &SVector<T, NV>,
) -> SMatrix<T, NV, NP>
where
    P: Parameters<R, T, NQ, NV, NP>,
    R: StateSpaceModel<T, NQ, NV, NX, NU> + ?Sized,
    T: Scalar,
{
    let (half, rest) = (T::of(0.5), SVector::zeros());
    let (mean, difference) = ((v + v_r) * half, (v - v_r) * half);
    // tangent_rate is −½ ad(v).
    let a = a_r - product(&robot.tangent_rate(v), v_r);
    P::regressor(robot, q, &mean, &a) - P::regressor(robot, q, &difference, &rest)
        + P::regressor(robot, q, &rest, &rest)
}

impl<T: Scalar, const NV: usize, const NP: usize, P> SlotineLi<T, NV, NP, P> {
    /// The joint forces, and how the parameters are to change.
    ///
    /// # Cost
    ///
    /// Three regressors, two products of NV×NP.
    #[inline]
    pub fn track<R, const NQ: usize, const NX: usize, const NU: usize>(
        &self,
        robot: &R,
        state: &State<T, NQ, NV>,
        reference: &Reference<T, NQ, NV>,
    ) -> Tracking<T, NV, NP>
    where
        P: Parameters<R, T, NQ, NV, NP>,
        R: StateSpaceModel<T, NQ, NV, NX, NU> + ?Sized,
    {
        let (error, rate) = reference.errors(robot, state);
        let v_r = reference.v + scaled(&self.bandwidth, &error);
        let a_r = reference.a + scaled(&self.bandwidth, &rate);
        let y = slotine_li_regressor::<P, R, T, NQ, NV, NX, NU, NP>(robot, &state.q, &state.v, &v_r, &a_r);
        let sliding = state.v - v_r;
        Tracking {
            tau: product(&y, &self.parameters) - scaled(&self.damping, &sliding),
            sliding,
            rate: -scaled(&self.adaptation, &transposed_product(&y, &sliding)),
        }
    }

    /// Lets the parameters change for `step` seconds.
    #[inline]
    pub fn adapt(&mut self, tracking: &Tracking<T, NV, NP>, step: T) {
        self.parameters += tracking.rate * step;
    }
}
