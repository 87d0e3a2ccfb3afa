//! Symmetric matrices: Cholesky's factor, and eigenvalues by Jacobi's rotations.

use nalgebra::{SMatrix, SVector};

use super::matrix::norm;
use super::real::Real;

/// The lower factor of `A = L·Lᵀ`.
pub(crate) struct Cholesky<T, const N: usize> {
    factor: SMatrix<T, N, N>,
}

impl<T: Real, const N: usize> Cholesky<T, N> {
    /// Factors `a`, of which the lower half is read; `None` if it is not positive definite.
    ///
    /// A pivot that is nothing but rounding errors of its diagonal entry counts as zero.
    pub(crate) fn new(a: &SMatrix<T, N, N>) -> Option<Self> {
        let mut factor = SMatrix::zeros();
        for j in 0..N {
            for i in j..N {
                let mut sum = a[(i, j)];
                for k in 0..j {
                    sum -= factor[(i, k)] * factor[(j, k)];
                }
                if i > j {
                    factor[(i, j)] = sum / factor[(j, j)];
                } else if sum > T::of(N as f64) * T::EPSILON * a[(j, j)] && sum.is_finite() {
                    factor[(j, j)] = sum.sqrt();
                } else {
                    return None;
                }
            }
        }
        Some(Self { factor })
    }

    /// `L⁻¹·B`, N×C.
    pub(crate) fn solve_lower<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *b;
        for column in 0..C {
            for i in 0..N {
                for k in 0..i {
                    x[(i, column)] = x[(i, column)] - self.factor[(i, k)] * x[(k, column)];
                }
                x[(i, column)] /= self.factor[(i, i)];
            }
        }
        x
    }

    /// `A⁻¹·B`, N×C.
    pub(crate) fn solve<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = self.solve_lower(b);
        for column in 0..C {
            for i in (0..N).rev() {
                for k in i + 1..N {
                    x[(i, column)] = x[(i, column)] - self.factor[(k, i)] * x[(k, column)];
                }
                x[(i, column)] /= self.factor[(i, i)];
            }
        }
        x
    }
}

/// Sweeps of Jacobi's method before it gives up; it needs five or six.
const SWEEPS: usize = 30;

/// The eigenvalues of a symmetric matrix, in no order, each within a few ε of the norm.
pub(crate) fn symmetric_eigenvalues<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> SVector<T, N> {
    let mut a = *a;
    let negligible = T::EPSILON * norm(&a);
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                let off = a[(p, q)];
                if off.abs() > negligible {
                    rotated = true;
                    rotate(&mut a, p, q);
                }
            }
        }
        if !rotated {
            break;
        }
    }
    SVector::from_fn(|i, _| a[(i, i)])
}

/// `JᵀAJ` with the rotation in the plane (p, q) that makes the entry there zero.
fn rotate<T: Real, const N: usize>(a: &mut SMatrix<T, N, N>, p: usize, q: usize) {
    let tangent = jacobi_tangent(a[(p, p)], a[(q, q)], a[(p, q)]);
    let cosine = T::one() / tangent.mul_add(tangent, T::one()).sqrt();
    let sine = tangent * cosine;
    for k in 0..N {
        let (x, y) = (a[(k, p)], a[(k, q)]);
        a[(k, p)] = cosine * x - sine * y;
        a[(k, q)] = sine * x + cosine * y;
    }
    for k in 0..N {
        let (x, y) = (a[(p, k)], a[(q, k)]);
        a[(p, k)] = cosine * x - sine * y;
        a[(q, k)] = sine * x + cosine * y;
    }
    a[(p, q)] = T::zero();
    a[(q, p)] = T::zero();
}

/// The tangent of the smaller angle that makes `[first off; off second]` diagonal.
pub(crate) fn jacobi_tangent<T: Real>(first: T, second: T, off: T) -> T {
    let cotangent = (second - first) / (off + off); // of twice the angle
    if cotangent.abs() >= T::one() / T::EPSILON {
        return T::of(0.5) / cotangent;
    }
    let root = cotangent.mul_add(cotangent, T::one()).sqrt();
    if cotangent < T::zero() { T::one() / (cotangent - root) } else { T::one() / (cotangent + root) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_have_the_trace_and_the_determinant() {
        let a = SMatrix::<f64, 3, 3>::from([[4.0, 1.0, -2.0], [1.0, 2.0, 0.5], [-2.0, 0.5, 3.0]]);
        let values = symmetric_eigenvalues(&a);
        assert!((values.sum() - a.trace()).abs() < 1e-14);
        assert!((values.product() - a.determinant()).abs() < 1e-13);
        assert_eq!(symmetric_eigenvalues(&SMatrix::<f64, 2, 2>::zeros()), SVector::<f64, 2>::zeros());
    }

    #[test]
    fn cholesky_solves_and_refuses() {
        let a = SMatrix::<f64, 2, 2>::from([[4.0, 2.0], [2.0, 3.0]]);
        let b = SVector::from([1.0, -2.0]);
        let x = Cholesky::new(&a).expect("it is definite").solve(&b);
        assert!((a * x - b).amax() < 1e-15);
        assert!(Cholesky::new(&SMatrix::<f64, 2, 2>::from([[1.0, 1.0], [1.0, 1.0]])).is_none());
        assert!(Cholesky::new(&SMatrix::<f64, 1, 1>::from([[f64::NAN]])).is_none());
    }
}
