//! Elliptic integrals and Jacobi's functions, by the arithmetic and geometric mean.
//!
//! M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions*, 1964, §16.4 and §17.6.

use std::f64::consts::PI;

/// The means of 1 and √(1−m) and their half differences, until these vanish.
fn means(m: f64) -> Vec<[f64; 2]> {
    let (mut a, mut g, mut means) = (1.0_f64, (1.0 - m).sqrt(), vec![[1.0, m.sqrt()]]);
    for _ in 0..8 {
        let difference = 0.5 * (a - g);
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
        means.push([a, difference]);
    }
    means
}

/// `K(m)`, the complete integral of the first kind.
pub fn quarter_period(m: f64) -> f64 {
    means(m).last().map_or(f64::NAN, |[a, _]| 0.5 * PI / a)
}

/// `sn`, `cn` and `dn` of u.
pub fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let means = means(m);
    let last = means.len() - 1;
    let mut phi = 2.0_f64.powi(last as i32) * means[last][0] * u;
    for [a, c] in means.into_iter().skip(1).rev() {
        phi = 0.5 * (phi + (c / a * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}
