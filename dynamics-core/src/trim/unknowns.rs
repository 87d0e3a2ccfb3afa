//! What is looked for, and least squares over it, one row at a time.

use crate::scalar::Scalar;

/// One value for each displacement, speed, acceleration and input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknowns<X, const NV: usize, const NU: usize> {
    pub(super) q: [X; NV],
    pub(super) v: [X; NV],
    pub(super) a: [X; NV],
    pub(super) u: [X; NU],
}

impl<X: Copy, const NV: usize, const NU: usize> Unknowns<X, NV, NU> {
    pub(super) const fn all(x: X) -> Self {
        Self { q: [x; NV], v: [x; NV], a: [x; NV], u: [x; NU] }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = X> {
        self.q.iter().chain(&self.v).chain(&self.a).chain(&self.u).copied()
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut X> {
        self.q.iter_mut().chain(&mut self.v).chain(&mut self.a).chain(&mut self.u)
    }

    fn get(&self, index: usize) -> Option<X> {
        self.iter().nth(index)
    }
}

impl<T: Scalar, const NV: usize, const NU: usize> Unknowns<T, NV, NU> {
    pub(super) fn dot(&self, other: &Self) -> T {
        self.iter().zip(other.iter()).fold(T::zero(), |sum, (a, b)| a.mul_add(b, sum))
    }

    /// Zero where nothing is free.
    pub(super) fn only(mut self, free: &Unknowns<bool, NV, NU>) -> Self {
        for (x, free) in self.iter_mut().zip(free.iter()) {
            if !free {
                *x = T::zero();
            }
        }
        self
    }
}

/// A row `coefficients·z = right` of a system of equations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equation<T, const NV: usize, const NU: usize> {
    pub(super) coefficients: Unknowns<T, NV, NU>,
    pub(super) right: T,
}

impl<T: Scalar, const NV: usize, const NU: usize> Equation<T, NV, NU> {
    pub(super) fn zero() -> Self {
        Self { coefficients: Unknowns::all(T::zero()), right: T::zero() }
    }
}

/// The triangle `R·z = Qᵀ·b` of the least-squares problem of all rows that it has taken in.
pub(super) struct Triangle<T, const NV: usize, const NU: usize> {
    rows: Unknowns<Equation<T, NV, NU>, NV, NU>,
}

impl<T: Scalar + PartialOrd, const NV: usize, const NU: usize> Triangle<T, NV, NU> {
    pub(super) fn new() -> Self {
        Self { rows: Unknowns::all(Equation::zero()) }
    }

    /// Takes in one more row, by rotations.
    pub(super) fn insert(&mut self, mut new: Equation<T, NV, NU>) {
        for (k, row) in self.rows.iter_mut().enumerate() {
            let (Some(a), Some(b)) = (row.coefficients.get(k), new.coefficients.get(k)) else { return };
            if b == T::zero() {
                continue;
            }
            let length = (a * a + b * b).sqrt();
            let (cosine, sine) = (a / length, b / length);
            let rotate = |x: &mut T, y: &mut T| {
                (*x, *y) = (cosine * *x + sine * *y, cosine * *y - sine * *x);
            };
            for (x, y) in row.coefficients.iter_mut().zip(new.coefficients.iter_mut()).skip(k) {
                rotate(x, y);
            }
            rotate(&mut row.right, &mut new.right);
        }
    }

    /// The solution `z`, by substitution from the last row upwards; not finite if a row has a zero on its diagonal.
    pub(super) fn solve(&self) -> Unknowns<T, NV, NU> {
        let mut z = Unknowns::all(T::zero());
        let count = 3 * NV + NU;
        for k in (0..count).rev() {
            let Some(row) = self.rows.get(k) else { continue };
            let rest = row.coefficients.dot(&z); // z is still zero from k upwards
            let value = row.coefficients.get(k).map(|diagonal| (row.right - rest) / diagonal);
            if let (Some(z), Some(value)) = (z.iter_mut().nth(k), value) {
                *z = value;
            }
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The normal equations hold, at the solution and at no other point.
    #[test]
    fn residuals_are_across_the_columns() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
        };
        let mut rows = [Equation::<f64, 2, 1>::zero(); 12];
        let mut triangle = Triangle::new();
        for row in &mut rows {
            row.coefficients.iter_mut().for_each(|x| *x = random());
            row.right = random();
            triangle.insert(*row);
        }
        let z = triangle.solve();
        for column in 0..7 {
            let sum: f64 = rows
                .iter()
                .map(|row| {
                    row.coefficients.get(column).unwrap_or(f64::NAN) * (row.coefficients.dot(&z) - row.right)
                })
                .sum();
            assert!(sum.abs() < 1e-13, "column {column}: {sum}");
        }
        assert!(z.iter().any(|z| z.abs() > 0.1));
    }
}
