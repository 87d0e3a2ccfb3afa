//! Riccati's equations of least cost, in continuous and in discrete time.

use nalgebra::SMatrix;

use super::balance::{factor, norm_of, scale_state};
use super::error::LinearError;
use super::lu::Lu;
use super::lyapunov::lyapunov;
use super::matrix::{is_finite, norm, norm_1, product_3, rounding, symmetric_part};
use super::poles::Time;
use super::real::Real;
use super::twice::{Twice, TwiceMatrix, twice_product, twice_sum};
use crate::product::product;

/// Doublings before they are given up: modes down to 2⁻⁶⁰ of the norm have decayed by then.
const DOUBLINGS: usize = 66;
/// Newton steps before they are given up. From afar each halves the error; near by each squares it.
const NEWTON_STEPS: usize = 60;
/// Sweeps of balancing.
const SWEEPS: usize = 30;

/// `A`, `G` and `Q` of `Aᵀ·P + P·A − P·G·P + Q = 0`, or of `P = Aᵀ·P·(1 + G·P)⁻¹·A + Q`.
#[derive(Clone, Copy)]
pub(crate) struct Riccati<T, const N: usize> {
    pub(crate) time: Time,
    pub(crate) a: SMatrix<T, N, N>,
    pub(crate) g: SMatrix<T, N, N>,
    pub(crate) q: SMatrix<T, N, N>,
}

/// P, and what remains of the equation when it is put in.
pub(crate) struct Solution<T, const N: usize> {
    pub(crate) p: SMatrix<T, N, N>,
    /// The norm of the remainder relative to the largest term, with the states in balanced units.
    pub(crate) residual: T,
}

/// What a P makes of the equation.
struct Evaluation<T, const N: usize> {
    remainder: SMatrix<T, N, N>,
    closed_loop: SMatrix<T, N, N>,
    /// The norm of the remainder relative to the largest term.
    residual: T,
}

impl<T: Real, const N: usize> Riccati<T, N> {
    /// The solution with which the closed loop is stable.
    ///
    /// In balanced units, by doubling: each step covers as many steps of time as all before it. Newton's method takes
    /// out what doubling loses where slow modes meet fast ones. A mode that costs nothing and grows makes the first
    /// miss; then the start is that of a problem in which each mode costs something.
    ///
    /// # Errors
    ///
    /// [`LinearError::RiccatiResidual`] if what remains of the equation is more than rounding, or nothing stable
    /// is found.
    ///
    /// # Source
    ///
    /// E. Chu, H. Fan, W. Lin, C. Wang, *Structure-preserving algorithms for periodic discrete-time algebraic Riccati
    /// equations*, Int. J. Control 77 (2004) 767–788; E. Chu, H. Fan, W. Lin, *A structure-preserving doubling algorithm
    /// for continuous-time algebraic Riccati equations*, Linear Algebra Appl. 396 (2005) 55–80; D. Kleinman, IEEE Trans.
    /// Automat. Control 13 (1968) 114–115; G. Hewer, same journal 16 (1971) 382–384. The matrix whose stable subspace is
    /// sought, and why balanced: A. Laub, same journal 24 (1979) 913–921.
    pub(crate) fn solve(&self) -> Result<Solution<T, N>, LinearError> {
        let (balanced, scales) = self.balanced();
        let mut best: Option<Solution<T, N>> = None;
        for attempt in 0..8 {
            let solution = balanced.start(attempt).and_then(|start| balanced.refined(start));
            let Some(solution) = solution else { continue };
            if best.as_ref().is_none_or(|best| solution.residual < best.residual) {
                best = Some(solution);
            }
            if best.as_ref().is_some_and(|best| best.residual <= Self::tolerance()) {
                break;
            }
        }
        let residual = best.as_ref().map_or(f64::INFINITY, |best| best.residual.to_f64());
        match best {
            Some(best) if best.residual <= Self::tolerance() => {
                let p = SMatrix::from_fn(|i, j| best.p[(i, j)] / scales[i] / scales[j]);
                if is_finite(&p) { Ok(Solution { p, ..best }) } else { Err(LinearError::NoConvergence) }
            }
            _ => Err(LinearError::RiccatiResidual { residual }),
        }
    }

    /// The residual that is taken for rounding.
    fn tolerance() -> T {
        T::of(100.0) * rounding::<T, N>()
    }

    /// The equation in units of the states and of the cost in which no entry is large without need, and these units: P is
    /// to be divided by them from both sides, and an input's row by its own.
    pub(crate) fn balanced(&self) -> (Self, [T; N]) {
        let mut balanced = *self;
        let cost = ratio(norm(&self.q), norm(&self.g));
        balanced.q /= cost;
        balanced.g *= cost;
        let mut scales = [T::one(); N];
        for _ in 0..SWEEPS {
            let mut changed = false;
            for i in 0..N {
                let Self { a, g, q, .. } = &mut balanced;
                let column = norm_of(|k| if k < N { a[(k, i)] } else { q[(k - N, i)] }, 2 * N);
                let row = norm_of(|k| if k < N { a[(i, k)] } else { g[(i, k - N)] }, 2 * N);
                let factor = factor(column, row);
                if factor != T::one() {
                    changed = true;
                    scales[i] *= factor;
                    scale_state(a, i, factor);
                    for k in 0..N {
                        q[(i, k)] *= factor;
                        q[(k, i)] *= factor;
                        g[(i, k)] /= factor;
                        g[(k, i)] /= factor;
                    }
                }
            }
            if !changed {
                break;
            }
        }
        let rest = ratio(norm(&balanced.q), norm(&balanced.g));
        balanced.q /= rest;
        balanced.g *= rest;
        // Roots of powers of four are exact.
        let root = cost.sqrt() * rest.sqrt();
        (balanced, scales.map(|scale| scale / root))
    }

    /// A first P. Even attempts are with Q as it is, odd ones with a cost of every state; each second one with another
    /// unit of time.
    fn start(&self, attempt: u32) -> Option<SMatrix<T, N, N>> {
        let mut problem = *self;
        if attempt % 2 == 1 {
            let size = norm_1(&self.q).max(norm_1(&self.a)).max(T::of(1e-3));
            problem.q += SMatrix::identity() * size;
        }
        match self.time {
            Time::Discrete => problem.doubled(),
            Time::Continuous => {
                let size = (norm_1(&problem.a) + norm_1(&problem.g).max(norm_1(&problem.q))) * T::of(2.0);
                let slower = (0..attempt / 2).fold(T::one(), |slower, _| slower * T::of(1.0 / 512.0));
                problem.sampled(size * slower)?.doubled()
            }
        }
    }

    /// The equation in discrete time with the same P, by Cayley's transformation.
    fn sampled(&self, rate: T) -> Option<Self> {
        let one = SMatrix::<T, N, N>::identity();
        let twice = rate + rate;
        let shifted = self.a - one * rate;
        let lu = Lu::new(&shifted)?;
        let g = lu.solve(&self.g); // (A − γ)⁻¹·G
        let lu_w = Lu::new(&(shifted.transpose() + product(&self.q, &g)))?;
        let a = one + lu_w.solve_transposed(&one) * twice;
        let q = lu.solve_transposed(&lu_w.solve(&self.q).transpose()).transpose() * twice;
        let g = lu_w.solve_transposed(&g.transpose()).transpose() * twice;
        Some(Self { time: Time::Discrete, a, g: symmetric_part(&g), q: symmetric_part(&q) })
    }

    /// The P of the equation in discrete time, by doubling.
    fn doubled(&self) -> Option<SMatrix<T, N, N>> {
        let Self { mut a, mut g, q: mut p, .. } = *self;
        for _ in 0..DOUBLINGS {
            let lu = Lu::new(&(SMatrix::identity() + product(&g, &p)))?;
            let (step, reach) = (lu.solve(&a), lu.solve(&g));
            let increase = symmetric_part(&product_3(&a.transpose(), &p, &step));
            g += symmetric_part(&product_3(&a, &reach, &a.transpose()));
            a = product(&a, &step);
            p += increase;
            if !(is_finite(&a) && is_finite(&g) && is_finite(&p)) {
                return None;
            }
            if norm(&increase) <= T::EPSILON * norm(&p) {
                break;
            }
        }
        Some(p)
    }

    /// Puts P into the equation, with twice the digits: the terms are often much larger than Q, and rounding of them would
    /// be all that Newton's method sees.
    fn evaluated(&self, p: &SMatrix<T, N, N>) -> Option<Evaluation<T, N>> {
        let Self { time, a, g, q } = self;
        let [wide_a, wide_g, wide_p, wide_q] = [a, g, p, q].map(|matrix| matrix.map(Twice::of));
        let carried = twice_product(&wide_a.transpose(), &wide_p); // Aᵀ·P
        let feedback = twice_product(&wide_g, &wide_p); // G·P
        let quadratic = twice_product(&wide_p, &feedback); // P·G·P
        let negated = |matrix: TwiceMatrix<T, N, N>| matrix.map(Twice::negated);
        let (closed_loop, linear, quadratic) = match time {
            Time::Continuous => (a - product(g, p), carried, quadratic),
            Time::Discrete => {
                // With Y near (1 + G·P)⁻¹·A, Aᵀ·P·Y + Yᵀ·P·A − Yᵀ·(P + P·G·P)·Y is Aᵀ·P·(1 + G·P)⁻¹·A but for the square of
                // its error.
                let closed_loop = Lu::new(&(SMatrix::identity() + feedback.map(Twice::rounded)))?.solve(a);
                let wide = closed_loop.map(Twice::of);
                let weight = twice_sum(&wide_p, &quadratic);
                let square = twice_product(&wide.transpose(), &twice_product(&weight, &wide));
                (closed_loop, twice_product(&carried, &wide), twice_sum(&square, &wide_p))
            }
        };
        let size = [norm(&linear.map(Twice::rounded)), norm(&quadratic.map(Twice::rounded)), norm(q)];
        let size = size.into_iter().fold(T::zero(), Real::max);
        let both = twice_sum(&linear, &linear.transpose());
        let remainder = twice_sum(&twice_sum(&both, &negated(quadratic)), &wide_q).map(Twice::rounded);
        let remainder = symmetric_part(&remainder);
        let residual = if size > T::zero() { norm(&remainder) / size } else { T::zero() };
        residual.is_finite().then_some(Evaluation { remainder, closed_loop, residual })
    }

    /// Newton's method from a P with which the closed loop is stable; `None` if it is not.
    fn refined(&self, start: SMatrix<T, N, N>) -> Option<Solution<T, N>> {
        let mut p = start;
        let mut best: Option<Solution<T, N>> = None;
        for _ in 0..NEWTON_STEPS {
            let Some(Evaluation { remainder, closed_loop, residual }) = self.evaluated(&p) else { break };
            let Ok((step, slowest)) = lyapunov(self.time, &closed_loop, &remainder) else { break };
            let boundary = if self.time == Time::Continuous { T::zero() } else { T::one() };
            if slowest >= boundary || !slowest.is_finite() {
                break;
            }
            let before = best.as_ref().map_or(T::one() / T::zero(), |best| best.residual);
            if residual < before {
                best = Some(Solution { p, residual });
            }
            let near = residual < T::EPSILON.sqrt();
            if near && residual + residual > before || norm(&step) <= T::EPSILON * norm(&p) {
                break;
            }
            p += step;
        }
        best
    }
}

/// A power of four near `√(x/y)`; one where there is none.
fn ratio<T: Real>(x: T, y: T) -> T {
    if !(x > T::zero() && y > T::zero()) {
        return T::one();
    }
    let root = (x.sqrt() / y.sqrt()).sqrt().power_of_two();
    root * root
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::random::Random;

    #[test]
    fn a_single_state_has_the_solution_of_school() {
        for (a, g, q) in [(1.0, 2.0, 3.0), (-5.0, 1e-8, 1.0), (1e6, 1.0, 0.0), (0.0, 1e9, 1e-9)] {
            let riccati = |time| Riccati {
                time,
                a: SMatrix::<f64, 1, 1>::new(a),
                g: SMatrix::<f64, 1, 1>::new(g),
                q: SMatrix::<f64, 1, 1>::new(q),
            };
            let p = riccati(Time::Continuous).solve().expect("it is stabilisable").p[0];
            let root: f64 = (a * a + g * q).sqrt();
            let exact = if a > 0.0 { (a + root) / g } else { q / (root - a) };
            assert!((p / exact - 1.0).abs() < 1e-14, "{p} for {exact}");
            // p = a²p/(1 + gp) + q: g·p² + (1 − a² − g·q)·p − q = 0
            let p = riccati(Time::Discrete).solve().expect("it is stabilisable").p[0];
            let half = (1.0 - a * a - g * q) / 2.0;
            let root = half.hypot((g * q).sqrt());
            let exact = if half < 0.0 { (root - half) / g } else { q / (root + half) };
            assert!((p / exact - 1.0).abs() < 1e-13, "{p} for {exact}");
        }
    }

    #[test]
    fn modes_that_grow_and_cost_nothing_are_mirrored() {
        let mut random = Random::new(11);
        for _ in 0..20 {
            let (a, b) = (random.matrix::<4, 4>(), random.matrix::<4, 2>());
            let riccati =
                Riccati { time: Time::Continuous, a, g: b * b.transpose(), q: SMatrix::<f64, 4, 4>::zeros() };
            let solution = riccati.solve().expect("it is stabilisable");
            let closed = a - riccati.g * solution.p;
            let growth =
                |a: &SMatrix<f64, 4, 4>| -> f64 { a.complex_eigenvalues().iter().map(|z| z.re.abs()).sum() };
            assert!(closed.complex_eigenvalues().iter().all(|z| z.re < 0.0));
            assert!((growth(&closed) - growth(&a)).abs() < 1e-9);
        }
    }
}
