//! State feedback by desired poles, for one input.

use nalgebra::{Complex, RowSVector, SMatrix, SVector};

use super::balance::balanced;
use super::complex::{modulus, quotient, real};
use super::error::{LinearError, parts};
use super::matrix::{norm, rounding};
use super::poles::poles;
use super::reach::{Staircase, reach};
use super::real::Real;
use super::singular::smallest_singular_value;
use crate::product::product;

/// The feedback `u = −k·x` with desired poles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement<T, const N: usize> {
    /// k, 1×N.
    pub gain: RowSVector<T, N>,
    /// The poles of `A − b·k` with these numbers, N: the slowest first. Where poles are close to each other, they answer
    /// to the last digits of k.
    pub poles: SVector<Complex<T>, N>,
    /// How much the closed loop has to change for it to have a desired pole exactly: the largest of them, relative to
    /// `‖A‖ + ‖b‖·‖k‖` with the states in balanced units. Rounding leaves some ε.
    pub residual: T,
}

/// The k that gives `A − b·k` the desired poles.
///
/// There is exactly one where the input reaches all modes. It is found by orthogonal transformations, one pole after the
/// other: each fixes one direction of the closed loop, and leaves a smaller problem of the same form. Ackermann's formula
/// would invert `[b Ab A²b …]`, which is singular to all digits from some ten states on.
///
/// # Errors
///
/// [`NotFinite`](LinearError::NotFinite), [`PoleWithoutConjugate`](LinearError::PoleWithoutConjugate),
/// [`NotControllable`](LinearError::NotControllable) with the pole that stays,
/// [`PoleNotAttained`](LinearError::PoleNotAttained) if the residual is more than `1000·N·ε`.
///
/// # Cost
///
/// That of [`controllability`](super::controllability), and some 20·N³ multiplications.
///
/// # Source
///
/// G. Miminis, C. Paige, *An algorithm for pole assignment of time invariant linear systems*, Int. J. Control 35 (1982)
/// 341–354, with complex shifts one by one.
///
/// # Example
///
/// ```
/// use dynamics_core::linear::place_poles;
/// use dynamics_core::nalgebra::Complex;
/// use dynamics_core::prelude::*;
///
/// let (a, b) = (SMatrix::from([[0.0, 0.0], [1.0, 0.0]]), SVector::from([0.0, 1.0])); // a mass, pushed
/// let desired = [Complex::new(-1.0_f64, 1.0), Complex::new(-1.0, -1.0)];
/// let gain = place_poles(&a, &b, &desired)?.gain;
/// assert!((gain[0] - 2.0).abs() < 1e-14 && (gain[1] - 2.0).abs() < 1e-14); // s² + 2s + 2
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn place_poles<T: Real, const N: usize>(
    a: &SMatrix<T, N, N>,
    b: &SVector<T, N>,
    desired: &[Complex<T>; N],
) -> Result<Placement<T, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    LinearError::unless_finite("b", b)?;
    let desired = paired(desired)?;
    let (balanced_a, scales) = balanced(a);
    let balanced_b = SVector::<T, N>::from_fn(|i, _| b[i] / scales[i]);
    if let Some(pole) = reach(&balanced_a, &balanced_b)?.missing().first() {
        return Err(LinearError::NotControllable { pole: parts(*pole) });
    }
    let staircase = Staircase::new(&balanced_a, &balanced_b);
    let hessenberg = SMatrix::from_fn(|i, j| if i > j + 1 { T::zero() } else { staircase.a[(i, j)] });
    let entry = staircase.b.iter().next().copied().unwrap_or_else(T::one);
    let turned = Deflation::new(&hessenberg, entry).gain(&desired);
    let balanced_k = product(&SMatrix::<T, 1, N>::from_fn(|_, j| turned[j].re), &staircase.basis.transpose());

    let closed = balanced_a - product(&balanced_b, &balanced_k);
    let size = norm(&balanced_a) + norm(&balanced_b) * norm(&balanced_k);
    let gain = RowSVector::from_fn(|_, j| balanced_k[j] / scales[j]);
    LinearError::unless_finite("k", &gain)?;
    let (mut residual, mut worst) = (T::zero(), real(T::zero()));
    for pole in desired {
        let distance = smallest_singular_value(&closed, &SMatrix::<T, N, 0>::zeros(), pole);
        let relative = if size > T::zero() { distance / size } else { T::zero() };
        if relative > residual {
            (residual, worst) = (relative, pole);
        }
    }
    if residual > T::of(100.0) * rounding::<T, N>() {
        return Err(LinearError::PoleNotAttained { pole: parts(worst), residual: residual.to_f64() });
    }
    Ok(Placement { gain, poles: poles(&(a - product(b, &gain)))?, residual })
}

/// The poles with conjugates next to each other.
fn paired<T: Real, const N: usize>(desired: &[Complex<T>; N]) -> Result<[Complex<T>; N], LinearError> {
    if let Some(row) = desired.iter().position(|pole| !(pole.re.is_finite() && pole.im.is_finite())) {
        return Err(LinearError::NotFinite { matrix: "poles", row, column: 0 });
    }
    let mut poles = *desired;
    let mut k = 0;
    while k < N {
        let pole = poles[k];
        k += 1;
        if pole.im == T::zero() {
            continue;
        }
        let Some(partner) = (k..N).find(|other| poles[*other] == pole.conj()) else {
            return Err(LinearError::PoleWithoutConjugate { pole: parts(pole) });
        };
        poles.swap(k, partner);
        k += 1;
    }
    Ok(poles)
}

/// `(H, β·e₁)` with a Hessenberg H, of which one pole after the other is fixed.
struct Deflation<T, const N: usize> {
    h: SMatrix<Complex<T>, N, N>,
    entry: Complex<T>,
    /// The rotations of columns `k, k + 1` at the step of a row: their two entries.
    rotations: [[(Complex<T>, Complex<T>); N]; N],
    /// What the gain is along the direction that each step fixes.
    fixed: [Complex<T>; N],
}

impl<T: Real, const N: usize> Deflation<T, N> {
    fn new(hessenberg: &SMatrix<T, N, N>, entry: T) -> Self {
        let zero = real(T::zero());
        Self {
            h: hessenberg.map(real),
            entry: real(entry),
            rotations: [[(zero, zero); N]; N],
            fixed: [zero; N],
        }
    }

    /// The gain, in the coordinates of H.
    fn gain(mut self, desired: &[Complex<T>; N]) -> [Complex<T>; N] {
        for (start, pole) in desired.iter().enumerate() {
            self.fix(start, *pole);
        }
        let mut gain = self.fixed;
        for start in (0..N).rev() {
            for k in start..N - 1 {
                let (x, y) = self.rotations[start][k];
                let (first, second) = (gain[k], gain[k + 1]);
                gain[k] = first * y.conj() + second * x;
                gain[k + 1] = second * y - first * x.conj();
            }
        }
        gain
    }

    /// `H − λ = R·Qᴴ` from row `start` on. The first column of Q is the closed loop's eigenvector, since the feedback
    /// moves the first row only; `Qᴴ·R + λ` without its first row and column is the problem that is left.
    fn fix(&mut self, start: usize, pole: Complex<T>) {
        let h = &mut self.h;
        for i in start..N {
            h[(i, i)] -= pole;
        }
        for k in (start..N - 1).rev() {
            let (x, y) = (h[(k + 1, k)], h[(k + 1, k + 1)]);
            let (size_x, size_y) = (modulus(x), modulus(y));
            let length = modulus(Complex::new(size_x, size_y));
            let (x, y) = (quotient(x, real(length)), quotient(y, real(length)));
            self.rotations[start][k] = (x, y);
            for row in start..N {
                let (first, second) = (h[(row, k)], h[(row, k + 1)]);
                h[(row, k)] = first * y - second * x;
                h[(row, k + 1)] = first * x.conj() + second * y.conj();
            }
        }
        self.fixed[start] = quotient(h[(start, start)], self.entry);
        for k in (start..N - 1).rev() {
            let (x, y) = self.rotations[start][k];
            for column in start..N {
                let (first, second) = (h[(k, column)], h[(k + 1, column)]);
                h[(k, column)] = first * y.conj() - second * x.conj();
                h[(k + 1, column)] = first * x + second * y;
            }
        }
        if start + 1 < N {
            self.entry *= self.rotations[start][start].0;
        }
        for i in start..N {
            h[(i, i)] += pole;
        }
    }
}

#[cfg(test)]
mod tests;
