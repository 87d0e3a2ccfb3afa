//! Positions, orientations and velocities of frames.

use core::fmt;
use core::marker::PhantomData;

use nalgebra::{SMatrix, SVector};

use super::{OperatingPoint, Output, Row};
use crate::error::Error;
use crate::kinematics::{Frame, Pose};
use crate::product::{product, transposed_product};
use crate::scalar::Scalar;
use crate::state_space::Signal;

/// The position of the origin of `F` in the world, 3, in m. Its gradient is the linear half of the world Jacobian.
pub const fn position<F>() -> Position<F> {
    Position(PhantomData)
}

/// The rotation of `F` from where it is asked for, 3, in rad about the axes of `F`; so it is zero there.
///
/// By [`from`](Orientation::from) it is the rotation from an orientation that is given.
pub const fn orientation<F, T>() -> Orientation<F, T> {
    Orientation { from: None, frame: PhantomData }
}

/// The velocity of the origin of `F`, 3, in m/s, in the world's axes; or in those of `F`, by
/// [`in_itself`](Velocity::in_itself).
///
/// `∂(J·v)/∂q` needs no second derivatives of its own. With `B(v, w)` for the derivative of `J·v` along `w`,
/// `B(v, v) = J̇·v` is the bias acceleration; it is quadratic, so that its symmetric half follows from two
/// evaluations, `½B(v,w) + ½B(w,v) = ¼·(J̇·v|_{v+w} − J̇·v|_{v−w})`; and the equation of Maurer and Cartan gives the other
/// one, `B(v,w) − B(w,v) = ad(J·v)·J·w − J·ad(v)·w`.
///
/// # Cost
///
/// 2·NV [accelerations](Frame::acceleration) of the frame.
pub const fn velocity<F>() -> Velocity<F> {
    Velocity { angular: false, in_itself: false, frame: PhantomData }
}

/// The angular velocity of `F`, 3, in rad/s, in the world's axes; or in those of `F`, which a gyroscope measures,
/// by [`in_itself`](Velocity::in_itself).
///
/// Its gradient and its cost are those of [`velocity`].
pub const fn angular_velocity<F>() -> Velocity<F> {
    Velocity { angular: true, in_itself: false, frame: PhantomData }
}

/// An output of three numbers, in x, y and z.
pub trait Triple: Sized {
    /// Its first row alone.
    fn x(self) -> Component<Self> {
        Component { of: self, index: 0 }
    }

    /// Its second row alone.
    fn y(self) -> Component<Self> {
        Component { of: self, index: 1 }
    }

    /// Its third row alone.
    fn z(self) -> Component<Self> {
        Component { of: self, index: 2 }
    }
}

/// The output of [`position`].
pub struct Position<F>(PhantomData<fn() -> F>);

/// The output of [`orientation`].
pub struct Orientation<F, T> {
    from: Option<SMatrix<T, 3, 3>>,
    frame: PhantomData<fn() -> F>,
}

/// The output of [`velocity`] and [`angular_velocity`].
pub struct Velocity<F> {
    angular: bool,
    in_itself: bool,
    frame: PhantomData<fn() -> F>,
}

/// The output of [`Triple::x`], [`Triple::y`] and [`Triple::z`].
#[derive(Clone, Copy, Debug)]
pub struct Component<O> {
    of: O,
    index: usize,
}

impl<F, T> Orientation<F, T> {
    /// From the rotation `from`, which takes components in the frame to components in the world, on.
    ///
    /// `y = 2 sin(θ/2)·e` of the rotation by θ about the axis `e`: the rotation vector up to θ³/24, with no branch and
    /// no angle where it is not smooth but half a turn, where it is not finite.
    #[must_use]
    pub fn from(self, from: SMatrix<T, 3, 3>) -> Self {
        Self { from: Some(from), frame: PhantomData }
    }
}

impl<F> Velocity<F> {
    /// The same velocity in the axes of the frame.
    #[must_use]
    pub const fn in_itself(self) -> Self {
        Self { in_itself: true, ..self }
    }
}

impl<F> Triple for Position<F> {}
impl<F, T> Triple for Orientation<F, T> {}
impl<F> Triple for Velocity<F> {}

impl<R, T, F, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Position<F>
where
    T: Scalar,
    F: Frame<R, T, NQ, NV>,
{
    const ROWS: usize = 3;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let [values] = F::pose(robot, &at.q).translation.data.0;
        let jacobian = half(&F::world_jacobian(robot, &at.q), false);
        write(rows, F::NAME, [".x", ".y", ".z"], "m", values, &jacobian, &SMatrix::zeros());
        Ok(())
    }
}

impl<R, T, F, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Orientation<F, T>
where
    T: Scalar,
    F: Frame<R, T, NQ, NV>,
{
    const ROWS: usize = 3;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let angular = half(&F::jacobian(robot, &at.q), true);
        let (values, gradient) = match &self.from {
            None => ([T::zero(); 3], angular),
            Some(from) => {
                let turned = product(&from.transpose(), &F::pose(robot, &at.q).rotation);
                let (values, half_cosine) = doubled_sines(&turned);
                // The quaternion's u̇ = ½(w·ω + u × ω) of the angular velocity ω in the frame.
                let columns = angular.data.0.map(|omega| {
                    let [x, y, z] = cross(values.map(|y| y * T::of(0.5)), omega);
                    let [a, b, c] = omega.map(|omega| half_cosine * omega);
                    [a + x, b + y, c + z]
                });
                (values, crate::__private::columns(columns))
            }
        };
        write(rows, F::NAME, [".rx", ".ry", ".rz"], "rad", values, &gradient, &SMatrix::zeros());
        Ok(())
    }
}

impl<R, T, F, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Velocity<F>
where
    T: Scalar,
    F: Frame<R, T, NQ, NV>,
{
    const ROWS: usize = 3;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let jacobian = F::jacobian(robot, &at.q);
        let by_q = twist_by_q::<F, R, T, NQ, NV>(robot, at, &jacobian);
        let mut value: [T; 3] = of_half(&product(&jacobian, &at.v), self.angular);
        let mut by_q = half(&by_q, self.angular);
        let mut by_v = half(&jacobian, self.angular);
        let parts = match (self.angular, self.in_itself) {
            (false, false) => [".vx", ".vy", ".vz"],
            (true, false) => [".wx", ".wy", ".wz"],
            (false, true) => [".body_vx", ".body_vy", ".body_vz"],
            (true, true) => [".body_wx", ".body_wy", ".body_wz"],
        };
        if !self.in_itself {
            let Pose { rotation, .. } = F::pose(robot, &at.q);
            // The derivative of R·x along a displacement that turns F by ω is R·(ω × x + ẋ).
            let turned = half(&jacobian, true).data.0.map(|omega| cross(omega, value));
            by_q = product(&rotation, &(by_q + crate::__private::columns(turned)));
            by_v = product(&rotation, &by_v);
            [value] = product(&rotation, &SVector::from(value)).data.0;
        }
        let unit = if self.angular { "rad/s" } else { "m/s" };
        write(rows, F::NAME, parts, unit, value, &by_q, &by_v);
        Ok(())
    }
}

impl<R, T, O, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Component<O>
where
    R: ?Sized,
    T: Scalar,
    O: Triple + Output<R, T, NQ, NV>,
{
    const ROWS: usize = 1;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let mut all = [Row::zero(); 3];
        self.of.write(robot, at, &mut all)?;
        if let (Some(row), Some(component)) = (rows.first_mut(), all.get(self.index)) {
            *row = *component;
        }
        Ok(())
    }
}

/// `∂(J·v)/∂q` of the body Jacobian, 6×NV; see [`velocity`].
fn twist_by_q<F, R, T, const NQ: usize, const NV: usize>(
    robot: &R,
    at: &OperatingPoint<T, NQ, NV>,
    jacobian: &SMatrix<T, 6, NV>,
) -> SMatrix<T, 6, NV>
where
    T: Scalar,
    F: Frame<R, T, NQ, NV>,
{
    let twist = product(jacobian, &at.v);
    // −½ J·ad(v)
    let mut result = product(jacobian, &at.tangent_rate);
    let rest = SVector::zeros();
    let directions = SMatrix::<T, NV, NV>::identity().data.0;
    for ((result, column), direction) in result.data.0.iter_mut().zip(&jacobian.data.0).zip(directions) {
        let direction = SVector::from(direction);
        let ahead = F::acceleration(robot, &at.q, &(at.v + direction), &rest);
        let behind = F::acceleration(robot, &at.q, &(at.v - direction), &rest);
        let bracket = bracket(&twist, column);
        for (((result, bracket), ahead), behind) in result.iter_mut().zip(bracket).zip(&ahead).zip(&behind) {
            *result += T::of(0.25) * (*ahead - *behind) + T::of(0.5) * bracket;
        }
    }
    result
}

/// `ad(x)·y` of twists.
fn bracket<T: Scalar>(x: &SVector<T, 6>, y: &[T; 6]) -> [T; 6] {
    let ([[v0, v1, v2, w0, w1, w2]], [p0, p1, p2, r0, r1, r2]) = (x.data.0, *y);
    let (v, w, p, r) = ([v0, v1, v2], [w0, w1, w2], [p0, p1, p2], [r0, r1, r2]);
    let ([a, b, c], [d, e, f], [g, h, i]) = (cross(w, p), cross(v, r), cross(w, r));
    [a + d, b + e, c + f, g, h, i]
}

/// `2 sin(θ/2)·e` of a rotation matrix, and `cos(θ/2)`.
fn doubled_sines<T: Scalar>(rotation: &SMatrix<T, 3, 3>) -> ([T; 3], T) {
    let [[r00, r10, r20], [r01, r11, r21], [r02, r12, r22]] = rotation.data.0;
    let double_cosine = (T::one() + r00 + r11 + r22).sqrt();
    let sines = [r21 - r12, r02 - r20, r10 - r01].map(|difference| difference / double_cosine);
    (sines, double_cosine * T::of(0.5))
}

fn cross<T: Scalar>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// The linear or the angular rows.
fn half<T: Scalar, const N: usize>(matrix: &SMatrix<T, 6, N>, angular: bool) -> SMatrix<T, 3, N> {
    crate::__private::columns(matrix.data.0.map(|column| of_half(&SVector::from(column), angular)))
}

fn of_half<T: Scalar>(x: &SVector<T, 6>, angular: bool) -> [T; 3] {
    let [[a, b, c, d, e, f]] = x.data.0;
    if angular { [d, e, f] } else { [a, b, c] }
}

/// Writes three rows.
fn write<T: Scalar, const NV: usize>(
    rows: &mut [Row<T, NV>],
    name: &'static str,
    parts: [&'static str; 3],
    unit: &'static str,
    values: [T; 3],
    by_q: &SMatrix<T, 3, NV>,
    by_v: &SMatrix<T, 3, NV>,
) {
    let axes = SMatrix::<T, 3, 3>::identity().data.0;
    for (((row, part), value), axis) in rows.iter_mut().zip(parts).zip(values).zip(axes) {
        row.signal = Signal::part(name, part, unit);
        row.value = value;
        row.by_q = transposed_product(by_q, &SVector::from(axis));
        row.by_v = transposed_product(by_v, &SVector::from(axis));
    }
}

impl<F> Clone for Position<F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for Position<F> {}

impl<F> fmt::Debug for Position<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Position")
    }
}

impl<F, T: Clone> Clone for Orientation<F, T> {
    fn clone(&self) -> Self {
        Self { from: self.from.clone(), frame: PhantomData }
    }
}

impl<F, T: Copy> Copy for Orientation<F, T> where SMatrix<T, 3, 3>: Copy {}

impl<F, T: fmt::Debug> fmt::Debug for Orientation<F, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Orientation").field("from", &self.from).finish()
    }
}

impl<F> Clone for Velocity<F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F> Copy for Velocity<F> {}

impl<F> fmt::Debug for Velocity<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { angular, in_itself, .. } = self;
        f.debug_struct("Velocity").field("angular", angular).field("in_itself", in_itself).finish()
    }
}
