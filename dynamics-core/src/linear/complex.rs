//! Arithmetic of complex numbers that neither overflows between nor needs a standard library.

use nalgebra::Complex;

use super::real::Real;

/// A complex number without an imaginary part.
pub(crate) fn real<T: Real>(x: T) -> Complex<T> {
    Complex::new(x, T::zero())
}

/// `|z|`, without overflow between.
pub(crate) fn modulus<T: Real>(z: Complex<T>) -> T {
    let (re, im) = (z.re.abs(), z.im.abs());
    let (large, small) = if re > im { (re, im) } else { (im, re) };
    if !(large > T::zero() && large.is_finite()) {
        return large + small;
    }
    let ratio = small / large;
    large * ratio.mul_add(ratio, T::one()).sqrt()
}

/// `z/w` by Smith's rule, without overflow between.
pub(crate) fn quotient<T: Real>(z: Complex<T>, w: Complex<T>) -> Complex<T> {
    if w.re.abs() >= w.im.abs() {
        let ratio = w.im / w.re;
        let divisor = w.im.mul_add(ratio, w.re);
        Complex::new(z.im.mul_add(ratio, z.re) / divisor, (z.im - z.re * ratio) / divisor)
    } else {
        let ratio = w.re / w.im;
        let divisor = w.re.mul_add(ratio, w.im);
        Complex::new(z.re.mul_add(ratio, z.im) / divisor, (z.im * ratio - z.re) / divisor)
    }
}

/// The root of `z` with a real part that is not negative.
pub(crate) fn square_root<T: Real>(z: Complex<T>) -> Complex<T> {
    let half = T::of(0.5);
    let large = ((modulus(z) + z.re.abs()) * half).sqrt();
    if large == T::zero() || !large.is_finite() {
        return z;
    }
    let small = z.im * half / large;
    if z.re >= T::zero() {
        Complex::new(large, small)
    } else if z.im >= T::zero() {
        Complex::new(small, large)
    } else {
        Complex::new(-small, -large)
    }
}

/// `ln z`, with an imaginary part in (−π, π]; −∞ of zero.
///
/// By square roots until `z` is near 1, then the series of `2·artanh((z − 1)/(z + 1))`: within 8 ε of the modulus of
/// the result.
pub(crate) fn logarithm<T: Real>(z: Complex<T>) -> Complex<T> {
    let one = real(T::one());
    if z.re == T::zero() && z.im == T::zero() {
        return real(-T::one() / T::zero());
    }
    let (mut root, mut factor) = (z, T::of(2.0));
    // The exponent of a double halves to nothing in eleven roots.
    for _ in 0..16 {
        if modulus(root - one) <= T::of(0.5) {
            break;
        }
        root = square_root(root);
        factor *= T::of(2.0);
    }
    let ratio = quotient(root - one, root + one);
    let square = ratio * ratio;
    // |ratio| ≤ 1/3: what is left out is below 9⁻¹⁷.
    let term = |sum: Complex<T>, k: i32| sum * square + real(T::one() / T::of(f64::from(2 * k + 1)));
    let series = (0..17).rev().fold(real(T::zero()), term);
    let result = ratio * series;
    Complex::new(result.re * factor, result.im * factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_are_those_of_the_standard_library() {
        let near = [(1.0 + 1e-9, 1e-12), (0.999, -0.02), (0.5, 0.5)];
        let far = [(-1.0, 0.0), (-1.0, -1e-9), (1e-300, 0.0), (0.0, 3e200), (-7.0, 0.1), (0.1, -40.0)];
        for (re, im) in near.into_iter().chain(far) {
            let ours = logarithm(Complex::new(re, im));
            let exact = Complex::new(0.5 * f64::ln_1p((re - 1.0) * (re + 1.0) + im * im), f64::atan2(im, re));
            let exact =
                if exact.re.is_finite() { exact } else { Complex::new(f64::hypot(re, im).ln(), exact.im) };
            let error = modulus(ours - exact);
            assert!(error <= 8.0 * f64::EPSILON * modulus(exact), "ln({re} + {im}i): {ours} for {exact}");
        }
        assert_eq!(logarithm(Complex::new(0.0, 0.0)).re, f64::NEG_INFINITY);
    }

    #[test]
    fn moduli_and_quotients_do_not_overflow() {
        let large = Complex::new(3e300, 4e300);
        assert_eq!(modulus(large), 5e300);
        assert_eq!(quotient(large, large), Complex::new(1.0, 0.0));
        assert_eq!(modulus(Complex::new(0.0, 0.0)), 0.0);
    }
}
