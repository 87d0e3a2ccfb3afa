//! Units of the states in which a matrix is not badly scaled.

use nalgebra::{SMatrix, SVector};

use super::real::Real;

/// Passes over all states; each state settles in two or three.
const SWEEPS: usize = 60;

/// `D⁻¹·A·D` and the diagonal D, of powers of two, for which rows and columns have about equal norms.
///
/// The eigenvalues are the same to the last bit of what is stored. States that are coupled in one direction only have
/// no best unit; they keep the one that makes the coupling no larger than the rest.
///
/// # Source
///
/// R. James, J. Langou, B. Lowery, *On matrix balancing and eigenvector computation* (2014): norms without the
/// diagonal would blow up what is nearly decoupled; here the diagonal counts.
pub(crate) fn balanced<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> (SMatrix<T, N, N>, SVector<T, N>) {
    let mut scales = SVector::repeat(T::one());
    let mut a = *a;
    for _ in 0..SWEEPS {
        let mut changed = false;
        for i in 0..N {
            let (column, row) = (norm_of(|k| a[(k, i)], N), norm_of(|k| a[(i, k)], N));
            let factor = factor(column, row);
            if factor != T::one() {
                changed = true;
                scales[i] *= factor;
                scale_state(&mut a, i, factor);
            }
        }
        if !changed {
            break;
        }
    }
    (a, scales)
}

/// `D⁻¹·A·D` for a D that differs from 1 in one entry.
pub(crate) fn scale_state<T: Real, const N: usize>(a: &mut SMatrix<T, N, N>, state: usize, factor: T) {
    for k in (0..N).filter(|k| *k != state) {
        a[(k, state)] *= factor;
        a[(state, k)] /= factor;
    }
}

/// The power of two by which a column of norm `column` is to be multiplied, and the row of norm `row` divided.
pub(crate) fn factor<T: Real>(mut column: T, mut row: T) -> T {
    let (two, half) = (T::of(2.0), T::of(0.5));
    let (zero, mut factor) = (T::zero(), T::one());
    if !(column > zero && row > zero && column.is_finite() && row.is_finite()) {
        return factor;
    }
    let before = column + row;
    while column < row * half {
        (column, row, factor) = (column * two, row * half, factor * two);
    }
    while row < column * half {
        (column, row, factor) = (column * half, row * two, factor * half);
    }
    let gained = column + row < T::of(0.95) * before;
    if gained && factor.is_finite() && factor > zero { factor } else { T::one() }
}

/// `√Σ entry(k)²` for k below `n`, without overflow.
pub(crate) fn norm_of<T: Real>(entry: impl Fn(usize) -> T, n: usize) -> T {
    let scale = (0..n).fold(T::zero(), |largest, k| largest.max(entry(k).abs()));
    if !(scale > T::zero() && scale.is_finite()) {
        return scale;
    }
    let square = |k| (entry(k) / scale) * (entry(k) / scale);
    scale * (0..n).map(square).fold(T::zero(), |sum, term| sum + term).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::matrix::norm;

    #[test]
    fn a_badly_scaled_matrix_becomes_a_well_scaled_one() {
        let good = SMatrix::<f64, 3, 3>::from([[1.0, 2.0, 3.0], [-1.0, 0.5, 2.0], [0.3, -2.0, 1.0]]);
        let bad =
            SMatrix::<f64, 3, 3>::from_fn(|i, j| good[(i, j)] * [1e8, 1.0, 1e-7][i] / [1e8, 1.0, 1e-7][j]);
        let (balanced, scales) = balanced(&bad);
        assert!(norm(&balanced) < 2.0 * norm(&good));
        let back = SMatrix::<f64, 3, 3>::from_fn(|i, j| balanced[(i, j)] * scales[i] / scales[j]);
        assert_eq!(back, bad); // powers of two
    }

    #[test]
    fn one_way_couplings_end() {
        let chain = SMatrix::<f64, 3, 3>::from([[0.0; 3], [1e300, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!(balanced(&chain).0.iter().all(|entry| entry.is_finite()));
    }
}
