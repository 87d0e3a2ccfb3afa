//! The exponential of a matrix and its two integrals: exact holds are made of these.

use nalgebra::SMatrix;

use super::balance::balanced;
use super::error::LinearError;
use super::matrix::{is_finite, norm_1};
use super::real::Real;
use crate::product::product;

/// The last power in the series. Below, `‖Xᵏ‖ ≤ 2⁻ᵏ` for k ≥ 12: what is left out is under 2⁻¹³·2/15! < 2·10⁻¹⁶ of φ₂.
const DEGREE: usize = 13;

/// `φ₀ = e^X`, `φ₁ = ∫₀¹ e^{sX} ds` and `φ₂ = ∫₀¹ (1 − s)·e^{sX} ds`, each N×N.
///
/// X may be singular: `φ₁ = (e^X − 1)·X⁻¹` is their definition only where it is not.
pub(crate) struct Exponential<T, const N: usize> {
    /// `Σ Xᵏ/k!`.
    pub(crate) phi_0: SMatrix<T, N, N>,
    /// `Σ Xᵏ/(k + 1)!`.
    pub(crate) phi_1: SMatrix<T, N, N>,
    /// `Σ Xᵏ/(k + 2)!`.
    pub(crate) phi_2: SMatrix<T, N, N>,
}

impl<T: Real, const N: usize> Exponential<T, N> {
    /// The three of `X = a·step`, by scaling and squaring; the series is that of φ₂, and `φ₁ = 1 + X·φ₂`,
    /// `φ₀ = 1 + X·φ₁` lose nothing.
    ///
    /// Only powers beyond the twelfth are left out, so it is the norms of such powers that set the scaling, and not
    /// the norm of X: a large entry of a nilpotent part costs no squarings, and no digits.
    ///
    /// # Errors
    ///
    /// [`LinearError::Step`] if the results are not finite.
    ///
    /// # Source
    ///
    /// N. Higham, SIAM J. Matrix Anal. Appl. 26 (2005) 1179–1193; A. Al-Mohy, N. Higham, same journal 31 (2009)
    /// 970–989, theorem 4.2 for the norms of powers; B. Skaflestad, W. Wright, *The scaling and modified squaring
    /// method for matrix functions related to the exponential*, Appl. Numer. Math. 59 (2009) 783–799.
    pub(crate) fn new(a: &SMatrix<T, N, N>, step: T) -> Result<Self, LinearError> {
        let (balanced, scales) = balanced(&(a * step));
        let squarings = squarings(&balanced);
        let mut x = balanced;
        for _ in 0..squarings {
            x *= T::of(0.5);
        }
        let mut exponential = Self::series(&x);
        for _ in 0..squarings {
            exponential = exponential.doubled();
        }
        let Self { phi_0, phi_1, phi_2 } = &mut exponential;
        for phi in [phi_0, phi_1, phi_2] {
            *phi = SMatrix::from_fn(|i, j| phi[(i, j)] * (scales[i] / scales[j]));
            if !is_finite(phi) {
                return Err(LinearError::Step { step: step.to_f64() });
            }
        }
        Ok(exponential)
    }

    /// Horner's scheme for φ₂.
    fn series(x: &SMatrix<T, N, N>) -> Self {
        let one = SMatrix::<T, N, N>::identity();
        // Σ Xᵏ/(k+2)! = ½·(1 + X/3·(1 + X/4·(1 + …)))
        let mut sum = one;
        for k in (1..=DEGREE).rev() {
            sum = one + product(x, &sum) * T::of(1.0 / (k + 2) as f64);
        }
        let phi_2 = sum * T::of(0.5);
        let phi_1 = one + product(x, &phi_2);
        Self { phi_0: one + product(x, &phi_1), phi_1, phi_2 }
    }

    /// The three of 2X.
    fn doubled(&self) -> Self {
        let Self { phi_0, phi_1, phi_2 } = self;
        Self {
            phi_0: product(phi_0, phi_0),
            phi_1: (product(phi_0, phi_1) + phi_1) * T::of(0.5),
            phi_2: (product(phi_0, phi_2) + phi_1 + phi_2) * T::of(0.25),
        }
    }
}

/// How often X is halved until the fourth and the fifth root of the norms of its fourth and fifth power are ½ at most.
fn squarings<T: Real, const N: usize>(x: &SMatrix<T, N, N>) -> u32 {
    /// More than the exponents of a double have.
    const LIMIT: u32 = 1100;
    let half = T::of(0.5);
    let norm = norm_1(x);
    // First so far that powers do not overflow.
    let (mut count, mut scale) = (0, T::one());
    while norm * scale > T::of(1e6) && count < LIMIT {
        (count, scale) = (count + 1, scale * half);
    }
    let scaled = x * scale;
    let square = product(&scaled, &scaled);
    let fourth = product(&square, &square);
    let (mut fourth, mut fifth) = (norm_1(&fourth), norm_1(&product(&fourth, &scaled)));
    let (bound_4, bound_5) = (T::of(1.0 / 16.0), T::of(1.0 / 32.0));
    while (fourth > bound_4 || fifth > bound_5) && count < LIMIT {
        (count, fourth, fifth) = (count + 1, fourth * bound_4, fifth * bound_5);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::random::Random;

    fn relative(a: &SMatrix<f64, 4, 4>, b: &SMatrix<f64, 4, 4>) -> f64 {
        (a - b).norm() / b.norm()
    }

    #[test]
    fn it_is_the_exponential_of_nalgebra_and_holds_its_own_equations() {
        let mut random = Random::new(4);
        for scale in [1e-6, 0.1, 1.0, 10.0] {
            let a = random.matrix::<4, 4>() * scale;
            let Exponential { phi_0, phi_1, phi_2 } = Exponential::new(&a, 1.0).expect("it is finite");
            let one = SMatrix::<f64, 4, 4>::identity();
            // The condition of the exponential is about the norm of A; nalgebra's own error is of that size too.
            let tolerance = 1e-14 * (1.0 + a.norm());
            assert!(relative(&phi_0, &a.exp()) < tolerance, "{scale}");
            assert!(relative(&(one + a * phi_1), &phi_0) < tolerance);
            assert!(relative(&(one + a * phi_2), &phi_1) < tolerance);
        }
    }

    #[test]
    fn a_nilpotent_matrix_is_exact_and_needs_no_squaring() {
        let chain = SMatrix::<f64, 4, 4>::from_fn(|i, j| f64::from(u8::from(i + 1 == j)) * 1e3);
        assert_eq!(squarings(&chain), 0);
        let phi = Exponential::new(&chain, 0.01).expect("it is finite");
        let factorials = [1.0, 1.0, 2.0, 6.0, 24.0, 120.0];
        for (shift, phi) in [phi.phi_0, phi.phi_1, phi.phi_2].into_iter().enumerate() {
            for (i, j) in (0..4).flat_map(|i| (i..4).map(move |j| (i, j))) {
                let exact = 10f64.powi((j - i) as i32) / factorials[j - i + shift];
                assert!((phi[(i, j)] / exact - 1.0).abs() < 4e-16 * 4.0, "{i} {j}");
            }
        }
    }

    #[test]
    fn what_overflows_is_an_error_and_what_decays_is_zero() {
        let one = SMatrix::<f64, 2, 2>::identity();
        assert!(matches!(Exponential::new(&one, 1e4), Err(LinearError::Step { .. })));
        assert!(Exponential::new(&one, 1e300).is_err());
        let decayed = Exponential::new(&-one, 1e12).expect("it is finite");
        assert_eq!(decayed.phi_0[(0, 0)], 0.0);
        assert!((decayed.phi_1[(0, 0)] * 1e12 - 1.0).abs() < 1e-14);
        assert!((decayed.phi_2[(1, 1)] * 1e12 - 1.0).abs() < 1e-11);
    }
}
