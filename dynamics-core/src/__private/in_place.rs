//! Large matrices that functions return, made where the caller wants them.
//!
//! What a function returns is copied once more if it was borrowed before: by an iterator, or for a function that fills it.
//! Two matrices of a long robot fill the first cache, and for some addresses a copy of so many bytes takes longer than
//! what was computed. So the functions that return them begin with [`blank`], and write by index, in macros.

use core::hint::black_box;

use crate::product::has_lanes;
use crate::scalar::Scalar;

/// A matrix that is about to be overwritten: zeros, of which the compiler does not know. It would write zeros that it
/// knows by a call of the C library, which is slow for some addresses.
#[inline(never)]
pub(super) fn blank<T: Scalar, const R: usize, const C: usize>() -> [[T; R]; C] {
    [[black_box(T::zero()); R]; C]
}

/// What LLVM has to lay in memory: it would take apart, entry by entry, what is used so. A scalar with lanes is one
/// register an entry, and stays where it is.
#[inline(always)]
pub(super) fn laid_down<T: Scalar, X>(x: X) -> X {
    if const { has_lanes::<T>() } { x } else { black_box(x) }
}

/// `put!(matrix: [[_; R]; C], first, strip, sums)`: writes a strip of some columns from `first` on, as far as the matrix
/// has entries.
macro_rules! put {
    ($matrix:ident: [[_; $rows:ident]; $columns:ident], $first:expr, $strip:expr, $sums:expr) => {{
        let (first, strip) = ($first, $strip);
        for (w, sums) in $sums.iter().enumerate() {
            let begin = $crate::product::first_of(strip, sums.len(), $rows);
            for (i, sum) in sums.iter().enumerate() {
                let (column, row) = (first + w, begin + i);
                if column < $columns && row < $rows {
                    $matrix[column][row] = *sum;
                }
            }
        }
    }};
}
pub(super) use put;

/// Writes what is below the diagonal of an N×N matrix above it too.
macro_rules! mirror {
    ($matrix:ident, $n:ident) => {{
        use $crate::product::STRIP;

        // Lanes of a scalar are no rows: one by one.
        let blocks = if $crate::product::has_lanes::<T>() { 0 } else { $n / STRIP };
        for block in 0..blocks {
            for strip in block..blocks {
                let mut tile = [[T::zero(); STRIP]; STRIP];
                for (j, column) in tile.iter_mut().enumerate() {
                    for (i, entry) in column.iter_mut().enumerate() {
                        *entry = $matrix[block * STRIP + j][strip * STRIP + i];
                    }
                }
                for (j, column) in T::transposed(tile).iter().enumerate() {
                    for (i, entry) in column.iter().enumerate() {
                        if strip > block || i < j {
                            $matrix[strip * STRIP + j][block * STRIP + i] = *entry;
                        }
                    }
                }
            }
        }
        for j in blocks * STRIP..$n {
            for i in 0..j {
                $matrix[j][i] = $matrix[i][j];
            }
        }
    }};
}
pub(super) use mirror;
