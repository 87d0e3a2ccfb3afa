//! Lyapunov's and Stein's equation: what a motion that decays costs.

use nalgebra::{Complex, SMatrix};

use super::complex::{modulus, quotient, real};
use super::error::LinearError;
use super::matrix::symmetric_part;
use super::poles::Time;
use super::real::Real;
use super::schur::{ComplexSchur, Schur};

/// The symmetric X of `Aᵀ·X + X·A + Q = 0`, or in discrete time of `Aᵀ·X·A − X + Q = 0`; and the pole of A furthest to
/// the right, or from the origin.
///
/// By the complex Schur form of A, column by column: no iteration, and no worse where slow and fast modes meet.
///
/// # Source
///
/// R. Bartels, G. Stewart, *Solution of the matrix equation AX + XB = C*, Comm. ACM 15 (1972) 820–826; A. Barraud,
/// IEEE Trans. Automat. Control 22 (1977) 883–885.
pub(crate) fn lyapunov<T: Real, const N: usize>(
    time: Time,
    a: &SMatrix<T, N, N>,
    q: &SMatrix<T, N, N>,
) -> Result<(SMatrix<T, N, N>, T), LinearError> {
    let ComplexSchur { triangle: t, basis } = Schur::new("A", a)?.to_complex();
    let right = multiplied(&basis.map(|entry| entry.conj()).transpose(), &multiplied(&q.map(real), &basis));
    let mut x = SMatrix::<Complex<T>, N, N>::zeros();
    for j in 0..N {
        // What the columns that are known contribute to this one.
        let mut known = [real(T::zero()); N];
        for (i, sum) in known.iter_mut().enumerate() {
            for k in 0..j {
                *sum += x[(i, k)] * t[(k, j)];
            }
        }
        for i in 0..N {
            let mut sum = right[(i, j)];
            match time {
                // (conj(tᵢᵢ) + tⱼⱼ)·xᵢⱼ
                Time::Continuous => {
                    sum += known[i];
                    for k in 0..i {
                        sum += t[(k, i)].conj() * x[(k, j)];
                    }
                    x[(i, j)] = -quotient(sum, t[(i, i)].conj() + t[(j, j)]);
                }
                // (conj(tᵢᵢ)·tⱼⱼ − 1)·xᵢⱼ
                Time::Discrete => {
                    for k in 0..i {
                        sum += t[(k, i)].conj() * (known[k] + x[(k, j)] * t[(j, j)]);
                    }
                    sum += t[(i, i)].conj() * known[i];
                    x[(i, j)] = -quotient(sum, t[(i, i)].conj() * t[(j, j)] - real(T::one()));
                }
            }
        }
    }
    let back = multiplied(&basis, &multiplied(&x, &basis.map(|entry| entry.conj()).transpose()));
    let growth = (0..N).map(|i| match time {
        Time::Continuous => t[(i, i)].re,
        Time::Discrete => modulus(t[(i, i)]),
    });
    let slowest = growth.reduce(Real::max).unwrap_or(-T::one());
    Ok((symmetric_part(&back.map(|entry| entry.re)), slowest))
}

/// `A·B` of complex matrices.
pub(crate) fn multiplied<T: Real, const N: usize>(
    a: &SMatrix<Complex<T>, N, N>,
    b: &SMatrix<Complex<T>, N, N>,
) -> SMatrix<Complex<T>, N, N> {
    SMatrix::from_fn(|i, j| (0..N).fold(real(T::zero()), |sum, k| sum + a[(i, k)] * b[(k, j)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::random::Random;

    #[test]
    fn both_equations_hold() {
        let mut random = Random::new(10);
        for _ in 0..30 {
            let a = random.matrix::<6, 6>();
            let q = symmetric_part(&random.matrix::<6, 6>());
            let stable = a - SMatrix::<f64, 6, 6>::identity() * 3.0;
            let (x, slowest) = lyapunov(Time::Continuous, &stable, &q).expect("it converges");
            assert!(slowest < 0.0 && (stable.transpose() * x + x * stable + q).norm() < 1e-14 * 20.0);
            let stable = a / 4.0;
            let (x, slowest) = lyapunov(Time::Discrete, &stable, &q).expect("it converges");
            assert!(slowest < 1.0 && (stable.transpose() * x * stable - x + q).norm() < 1e-14 * 20.0);
        }
    }
}
