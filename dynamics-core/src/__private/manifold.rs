//! Ball and free joints as manifolds: `q ⊕ δ`, its inverse, and the rate of `δ`.
//!
//! Quaternions are i, j, k, w; twists are of the body in the body, linear first. There is no branch here and no
//! comparison, so that every scalar can do it, and no series about zero, so that it holds for every angle: quotients
//! that would be 0/0 at the angle zero are taken at a root of θ² + `GUARD`, or by partial fractions, and a logarithm
//! divides by nothing small.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC Press 1994, §2.3;
//! J. Solà, J. Deray, D. Atchuthan, *A micro Lie theory for state estimation in robotics*, arXiv:1812.01537, 2018.

use crate::scalar::Scalar;

/// What squares of angles are enlarged by before their root divides, in rad².
///
/// The quotients are even in the angle and change with its square by at most 1/8, so that this costs less than half
/// the last bit of an `f64`; and its own root is far from underflow in an `f32`.
const GUARD: f64 = 1e-16;

/// `q·exp(δ)`, a unit quaternion: where the orientation `q` gets to by the rotation vector `δ`, in body axes, rad.
///
/// One Newton step towards length 1 follows, so that rounding does not add up over many calls. The error is that of
/// the scalar's sine, for `δ` of every length.
#[inline]
#[must_use]
pub fn integrate_ball<T: Scalar>(q: [T; 4], delta: [T; 3]) -> [T; 4] {
    let Turn { axis, half_sine, half_cosine, .. } = Turn::by(delta);
    let [i, j, k] = scaled(axis, half_sine);
    renormalized(quaternion_product(q, [i, j, k, half_cosine]))
}

/// `q·exp(δ)` in SE(3): where a body at position and orientation `q` gets to by the screw `δ`, in m and rad, of the
/// body in the body.
#[inline]
#[must_use]
pub fn integrate_free<T: Scalar>(q: [T; 7], delta: [T; 6]) -> [T; 7] {
    let [position @ .., i, j, k, w] = q;
    let [linear, angular] = halves(delta);
    let Turn { axis, angle, half_sine, half_cosine } = Turn::by(angular);
    let two_s = half_sine + half_sine;
    // V(δ)·v with V = 1 + (1 − cos θ)/θ² δ̂ + (θ − sin θ)/θ³ δ̂²
    let sinc = two_s * half_cosine / angle;
    let along = scaled(axis, (T::one() - sinc) * dot(axis, linear));
    let across = scaled(cross(axis, linear), two_s * half_sine / angle);
    let moved = sum(sum(scaled(linear, sinc), across), along);
    let [x, y, z] = sum(position, rotated([i, j, k, w], moved));
    let [i, j, k, w] = integrate_ball([i, j, k, w], angular);
    [x, y, z, i, j, k, w]
}

/// The shortest `δ` with `q1 = q0·exp(δ)`, in rad, of length up to π; `q1` and `−q1` are one orientation.
#[inline]
#[must_use]
pub fn difference_ball<T: Scalar>(q0: [T; 4], q1: [T; 4]) -> [T; 3] {
    logarithm(quaternion_product(conjugate(q0), q1))
}

/// The shortest `δ` with `q1 = q0·exp(δ)` in SE(3), in m and rad.
#[inline]
#[must_use]
pub fn difference_free<T: Scalar>(q0: [T; 7], q1: [T; 7]) -> [T; 6] {
    let [p0 @ .., i0, j0, k0, w0] = q0;
    let [p1 @ .., i1, j1, k1, w1] = q1;
    let back = conjugate([i0, j0, k0, w0]);
    let moved = rotated(back, sum(p1, scaled(p0, -T::one())));
    let angular = logarithm(quaternion_product(back, [i1, j1, k1, w1]));
    let half = T::of(0.5);
    // V⁻¹ = 1 − δ̂/2 + (1 − (θ/2)·cot(θ/2))/θ² δ̂²
    let Turn { axis, angle, half_sine, half_cosine } = Turn::by(angular);
    let shrink = T::one() - half * angle * half_cosine / half_sine;
    let across = scaled(cross(angular, moved), -half);
    let inwards = scaled(cross(axis, cross(axis, moved)), shrink);
    let [a, b, c] = sum(sum(moved, across), inwards);
    let [d, e, f] = angular;
    [a, b, c, d, e, f]
}

/// `∂δ̇/∂δ = −½ ω̂` at δ = 0 by columns, where `q ⊕ δ` turns with the angular velocity `ω` of the body, rad/s.
#[inline]
#[must_use]
pub fn ball_tangent_rate<T: Scalar>(angular: [T; 3]) -> [[T; 3]; 3] {
    let [x, y, z] = scaled(angular, T::of(0.5));
    let o = T::zero();
    [[o, -z, y], [z, o, -x], [-y, x, o]]
}

/// `∂δ̇/∂δ = −½ ad(V)` at δ = 0 by columns, where `q ⊕ δ` moves with the twist `V` of the body, m/s and rad/s.
#[inline]
#[must_use]
pub fn free_tangent_rate<T: Scalar>(twist: [T; 6]) -> [[T; 6]; 6] {
    let [linear, angular] = halves(twist).map(ball_tangent_rate);
    let o = T::zero();
    let [column_0, column_1, column_2] = angular.map(|[x, y, z]| [x, y, z, o, o, o]);
    let [a, b, c] = linear;
    let [d, e, f] = angular;
    let [column_3, column_4, column_5] =
        [(a, d), (b, e), (c, f)].map(|([x, y, z], [u, v, w])| [x, y, z, u, v, w]);
    [column_0, column_1, column_2, column_3, column_4, column_5]
}

/// `δ̇` where `q ⊕ δ` turns with the angular velocity `ω` of the body: `ω + ½ δ×ω + g·δ×(δ×ω)`, rad/s.
///
/// For |δ| below 2π, where the chart ends; to the last bits up to ¾ of that.
#[inline]
#[must_use]
pub fn ball_rate<T: Scalar>(delta: [T; 3], angular: [T; 3]) -> [T; 3] {
    Bend::by(delta).rate(delta, angular)
}

/// `δ̇` where `q ⊕ δ` moves with the twist `V` of the body, m/s and rad/s, for rotations as [`ball_rate`] takes them.
///
/// The linear half is the angular one with its derivative along the linear half of δ: se(3) is the tangent of so(3).
#[inline]
#[must_use]
pub fn free_rate<T: Scalar>(delta: [T; 6], twist: [T; 6]) -> [T; 6] {
    let ([along, turn], [linear, angular]) = (halves(delta), halves(twist));
    let bend @ Bend { g, slope } = Bend::by(turn);
    let inner = cross(turn, angular);
    let across = scaled(cross(along, angular), T::of(0.5));
    let inwards = scaled(sum(cross(along, inner), cross(turn, cross(along, angular))), g);
    let steeper = scaled(cross(turn, inner), slope * dot(turn, along));
    let [a, b, c] = sum(sum(bend.rate(turn, linear), across), sum(inwards, steeper));
    let [d, e, f] = bend.rate(turn, angular);
    [a, b, c, d, e, f]
}

/// The transposed of the map `ω ↦ δ̇` of [`ball_rate`], of a torque.
#[inline]
#[must_use]
pub fn ball_rate_transposed<T: Scalar>(delta: [T; 3], torque: [T; 3]) -> [T; 3] {
    ball_rate(delta.map(|x| -x), torque)
}

/// The transposed of the map `V ↦ δ̇` of [`free_rate`], of a wrench.
///
/// The map is `[A B; 0 A]`, and with −δ in place of δ both blocks are their own transposes; so the halves change places.
#[inline]
#[must_use]
pub fn free_rate_transposed<T: Scalar>(delta: [T; 6], [a, b, c, d, e, f]: [T; 6]) -> [T; 6] {
    let [a, b, c, d, e, f] = free_rate(delta.map(|x| -x), [d, e, f, a, b, c]);
    [d, e, f, a, b, c]
}

/// How a chart of rotations bends at δ: `g(θ²) = (1 − (θ/2)·cot(θ/2))/θ²`, and twice its derivative by θ².
struct Bend<T> {
    g: T,
    slope: T,
}

impl<T: Scalar> Bend<T> {
    /// By the cotangent's poles, `g = Σ 2/((2πk)² − θ²)`: positive terms, which cancel nothing at any angle. Three of
    /// them, and for the others the series in `y = θ²/(2π)²`, whose coefficients are `Σ k^(−2j−2)` from k = 4 on.
    #[inline(always)]
    fn by(delta: [T; 3]) -> Self {
        const TAIL: [f64; 10] = [
            0.283_822_955_737_115_33,
            7.477_554_698_792_512e-3,
            3.463_198_719_662_865e-4,
            1.869_040_766_846_68e-5,
            1.077_540_009_655_050_5e-6,
            6.425_188_488_937_789e-8,
            3.903_650_576_060_287e-9,
            2.397_730_264_529_58e-10,
            1.482_458_312_665_928e-11,
            9.202_674_668_690_207e-13,
        ];
        /// `1/(2π)²`
        const PER_TURN: f64 = 0.025_330_295_910_584_444;
        let one = T::one();
        let y = dot(delta, delta) * T::of(PER_TURN);
        let (mut sum, mut slope) = (T::zero(), T::zero());
        for coefficient in TAIL.iter().rev() {
            slope = slope.mul_add(y, sum);
            sum = sum.mul_add(y, T::of(*coefficient));
        }
        for pole in [9.0, 4.0, 1.0] {
            let term = one / (T::of(pole) - y);
            sum += term;
            slope = term.mul_add(term, slope);
        }
        Self { g: sum * T::of(2.0 * PER_TURN), slope: slope * T::of(4.0 * PER_TURN * PER_TURN) }
    }

    #[inline(always)]
    fn rate(&self, delta: [T; 3], angular: [T; 3]) -> [T; 3] {
        let across = cross(delta, angular);
        sum(angular, sum(scaled(across, T::of(0.5)), scaled(cross(delta, across), self.g)))
    }
}

/// A rotation by δ: its axis and angle, and the sine and cosine of half the angle.
struct Turn<T> {
    /// δ/θ: of unit length, but zero where δ is.
    axis: [T; 3],
    /// θ = √(|δ|² + `GUARD`), never zero.
    angle: T,
    half_sine: T,
    half_cosine: T,
}

impl<T: Scalar> Turn<T> {
    #[inline(always)]
    fn by(delta: [T; 3]) -> Self {
        let angle = (dot(delta, delta) + T::of(GUARD)).sqrt();
        let (half_sine, half_cosine) = (angle * T::of(0.5)).sin_cos();
        Self { axis: scaled(delta, T::one() / angle), angle, half_sine, half_cosine }
    }
}

/// The rotation vector of a quaternion of any length but zero, of length up to π.
///
/// θ = 8·atan(tan(θ/8)), where tan(θ/8) = |u|·`quarter`·`eighth` comes from half angles, is below √2 − 1, and is
/// never formed: what is divided by is at least the quaternion's length.
#[inline(always)]
fn logarithm<T: Scalar>([i, j, k, w]: [T; 4]) -> [T; 3] {
    let (one, sign) = (T::one(), sign(w));
    let (u, w) = (scaled([i, j, k], sign), sign * w);
    let square = dot(u, u);
    let quarter = one / (w.mul_add(w, square).sqrt() + w); // tan(θ/4) = |u|·quarter
    let eighth = one / ((square * quarter * quarter + one).sqrt() + one); // tan(θ/8) = tan(θ/4)·eighth
    let factor = quarter * eighth;
    scaled(u, T::of(8.0) * factor * arctangent_over(square * factor * factor))
}

/// `atan(√z)/√z` for z up to (7/16)², to the last bits of an `f64`: the polynomial of fdlibm (Sun Microsystems 1993).
#[inline(always)]
fn arctangent_over<T: Scalar>(z: T) -> T {
    T::of(-1.628_582_011_536_578_2e-2)
        .mul_add(z, T::of(3.653_157_274_421_691_6e-2))
        .mul_add(z, T::of(-4.976_877_994_615_932e-2))
        .mul_add(z, T::of(5.833_570_133_790_573_5e-2))
        .mul_add(z, T::of(-6.661_073_137_387_531e-2))
        .mul_add(z, T::of(7.691_876_205_044_83e-2))
        .mul_add(z, T::of(-9.090_887_133_436_507e-2))
        .mul_add(z, T::of(1.111_111_040_546_235_6e-1))
        .mul_add(z, T::of(-1.428_571_427_250_346_6e-1))
        .mul_add(z, T::of(1.999_999_999_987_648_3e-1))
        .mul_add(z, T::of(-3.333_333_333_333_293e-1))
        .mul_add(z, T::one())
}

/// `1` or `−1`, the sign of `x`; of zero and of what is negative only by rounding, `1`.
#[inline(always)]
fn sign<T: Scalar>(x: T) -> T {
    let x = x + T::of(1.618e-18); // so that zero has a sign; its square is still no underflow in an f32
    let [sign] = renormalized([x / (x * x).sqrt()]); // of a dual number, the derivative is now exactly zero
    sign
}

/// One Newton step towards length 1: what differs from it by ε differs by 3ε²/2 afterwards.
#[inline(always)]
fn renormalized<T: Scalar, const N: usize>(x: [T; N]) -> [T; N] {
    scaled(x, T::of(-0.5).mul_add(dot(x, x), T::of(1.5)))
}

#[inline(always)]
fn quaternion_product<T: Scalar>([a, b, c, d]: [T; 4], [i, j, k, w]: [T; 4]) -> [T; 4] {
    [
        d * i + a * w + b * k - c * j,
        d * j - a * k + b * w + c * i,
        d * k + a * j - b * i + c * w,
        d * w - a * i - b * j - c * k,
    ]
}

#[inline(always)]
fn conjugate<T: Scalar>([i, j, k, w]: [T; 4]) -> [T; 4] {
    [-i, -j, -k, w]
}

/// `R(q)·x`, from body axes to those that `q` is given in.
#[inline(always)]
fn rotated<T: Scalar>([i, j, k, w]: [T; 4], x: [T; 3]) -> [T; 3] {
    let u = [i, j, k];
    let turned = cross(u, x);
    let turned = sum(turned, turned);
    sum(sum(x, scaled(turned, w)), cross(u, turned))
}

/// The linear and the angular half.
#[inline(always)]
fn halves<T: Scalar>([a, b, c, d, e, f]: [T; 6]) -> [[T; 3]; 2] {
    [[a, b, c], [d, e, f]]
}

#[inline(always)]
fn dot<T: Scalar, const N: usize>(a: [T; N], b: [T; N]) -> T {
    a.iter().zip(&b).fold(T::zero(), |sum, (a, b)| a.mul_add(*b, sum))
}

#[inline(always)]
fn cross<T: Scalar>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

#[inline(always)]
fn sum<T: Scalar>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [a + x, b + y, c + z]
}

#[inline(always)]
fn scaled<T: Scalar, const N: usize>(x: [T; N], factor: T) -> [T; N] {
    x.map(|x| x * factor)
}
