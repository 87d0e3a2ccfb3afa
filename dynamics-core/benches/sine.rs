//! The sine and the cosine of every `f32` there is: `cargo bench -p dynamics-core --bench sine`, about a minute.
//!
//! Holds what `dynamics_core::trigonometry` states of them, and prints the errors by range. A build with
//! `RUSTFLAGS="-C target-cpu=native"` tries the kernel with fused multiply-adds, one without the other.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::ops::Range;
use std::thread;

use dynamics_core::scalar::FUSED;
use dynamics_core::trigonometry::sin_cos_f32;

/// The largest absolute error that is stated, up to [`STATED_UP_TO`].
const STATED: f64 = 9.4e-8;
const STATED_UP_TO: f32 = 1e4;
/// From here on both are NaN.
const END: f32 = 1_048_576.0;

/// Floats between two bounds, by their bits.
struct Span {
    name: &'static str,
    bits: Range<u32>,
}

/// The largest errors found in a span.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    /// The absolute error, and where.
    error: (f64, f32),
    /// What is left of it beyond the spacing of floats at the argument.
    beyond_spacing: f64,
}

impl Worst {
    fn max(self, other: Self) -> Self {
        let error = if other.error.0 > self.error.0 { other.error } else { self.error };
        Self { error, beyond_spacing: self.beyond_spacing.max(other.beyond_spacing) }
    }
}

fn main() {
    let bits = f32::to_bits;
    let span = |name, from, to| Span { name, bits: bits(from)..bits(to) };
    println!("With {}.\n", if FUSED { "fused multiply-adds" } else { "separate products and sums" });
    println!("{:22}{:>14}{:>16}{:>18}", "|x|", "floats", "largest error", "at");
    for span in [
        span("0 to 1e-3", 0.0, 1e-3),
        span("1e-3 to π/4", 1e-3, std::f32::consts::FRAC_PI_4),
        span("π/4 to π", std::f32::consts::FRAC_PI_4, std::f32::consts::PI),
        span("π to 100", std::f32::consts::PI, 100.0),
        span("100 to 1e4", 100.0, STATED_UP_TO.next_up()),
        span("1e4 to 2^20", STATED_UP_TO.next_up(), END),
    ] {
        let worst = over_all_cores(&span.bits, errors);
        let (error, at) = worst.error;
        println!("{:22}{:>14}{error:>16.3e}{at:>18e}", span.name, 2 * span.bits.len());
        if f32::from_bits(span.bits.start) <= STATED_UP_TO {
            assert!(error <= STATED, "the error at {at:e} is {error:e}, {STATED:e} is stated");
        } else {
            assert!(worst.beyond_spacing <= STATED, "more than the spacing: {:e}", worst.beyond_spacing);
        }
    }
    let beyond = bits(END)..1 << 31;
    over_all_cores(&beyond, |bits| {
        for x in both_signs(bits) {
            let (s, c) = sin_cos_f32(x);
            assert!(s.is_nan() && c.is_nan(), "x = {x:e}");
        }
        Worst::default()
    });
    println!("{:22}{:>14}{:>16}", "2^20, infinity, NaN", 2 * beyond.len(), "NaN");
}

/// The errors at the float and at its negative, which must be the same.
fn errors(bits: u32) -> Worst {
    let [x, negative] = both_signs(bits);
    let ((s, c), (minus_s, same_c)) = (sin_cos_f32(x), sin_cos_f32(negative));
    let odd = minus_s.to_bits() == (-s).to_bits() || x == 0.0;
    assert!(odd && same_c.to_bits() == c.to_bits(), "x = {x:e}");
    let exact = f64::from(x);
    let error = (f64::from(s) - exact.sin()).abs().max((f64::from(c) - exact.cos()).abs());
    assert!(error.is_finite(), "x = {x:e}");
    Worst { error: (error, x), beyond_spacing: error - f64::from(x.next_up() - x) }
}

fn both_signs(bits: u32) -> [f32; 2] {
    [f32::from_bits(bits), f32::from_bits(bits | 1 << 31)]
}

/// The worst of all floats in `bits`, each core taking every so manieth.
fn over_all_cores(bits: &Range<u32>, of: impl Fn(u32) -> Worst + Sync) -> Worst {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let of = &of;
        let part = |first: usize| {
            let floats = bits.clone().skip(first).step_by(cores);
            scope.spawn(move || floats.fold(Worst::default(), |worst, bits| worst.max(of(bits))))
        };
        let parts: Vec<_> = (0..cores).map(part).collect();
        parts.into_iter().fold(Worst::default(), |worst, part| match part.join() {
            Ok(other) => worst.max(other),
            Err(panic) => std::panic::resume_unwind(panic),
        })
    })
}
