//! From rows to lanes and back, in tiles of a few numbers, which stay in registers.
//!
//! Number by number it would cost as much as the dynamics of an arm.

use wide::{f32x4, f64x2, f64x4};

use crate::scalar::{Scalar, Zero};

/// So many tiles are side by side in the widest lanes.
const MOST: usize = 4;

/// A float of whose tiles, E×E, transposed by few instructions, the widest lanes have four.
pub(crate) trait Tile<const E: usize>: Scalar {
    fn transposed(tile: [[Self; E]; E]) -> [[Self; E]; E];
}

// Spelt out: `map` over arrays is not always inlined here.
impl Tile<2> for f64 {
    #[inline(always)]
    fn transposed([a, b]: [[Self; 2]; 2]) -> [[Self; 2]; 2] {
        let [a, b] = f64x2::transpose([f64x2::new(a), f64x2::new(b)]);
        [a.to_array(), b.to_array()]
    }
}

impl Tile<4> for f64 {
    #[inline(always)]
    fn transposed([a, b, c, d]: [[Self; 4]; 4]) -> [[Self; 4]; 4] {
        let [a, b, c, d] = f64x4::transpose([f64x4::new(a), f64x4::new(b), f64x4::new(c), f64x4::new(d)]);
        [a.to_array(), b.to_array(), c.to_array(), d.to_array()]
    }
}

impl Tile<4> for f32 {
    #[inline(always)]
    fn transposed([a, b, c, d]: [[Self; 4]; 4]) -> [[Self; 4]; 4] {
        let [a, b, c, d] = f32x4::transpose([f32x4::new(a), f32x4::new(b), f32x4::new(c), f32x4::new(d)]);
        [a.to_array(), b.to_array(), c.to_array(), d.to_array()]
    }
}

/// Where the tiles of a row of `n` begin: side by side, and the last one at the end, over its neighbour if need be.
#[inline(always)]
fn starts<const E: usize>(n: usize) -> impl Iterator<Item = usize> {
    (0..n).step_by(E).map(move |start| start.min(n.saturating_sub(E)))
}

/// Entry `i` of the result has in lane `k` entry `i` of the row of state `k`. `W` is a multiple of `E`.
#[inline(always)]
pub(super) fn lanes_of_rows<
    T: Tile<E>,
    L: Zero + Copy + From<[T; W]>,
    S,
    const N: usize,
    const W: usize,
    const E: usize,
>(
    states: &[S; W],
    row: impl Fn(&S) -> &[T; N],
) -> [L; N] {
    let mut lanes = [L::zero(); N];
    for start in starts::<E>(N) {
        let mut tiles = [[[T::zero(); E]; E]; MOST];
        for (tile, states) in tiles.iter_mut().zip(states.as_chunks::<E>().0) {
            let mut rows = [[T::zero(); E]; E];
            for (part, state) in rows.iter_mut().zip(states) {
                *part = part_of(row(state), start);
            }
            *tile = <T as Tile<E>>::transposed(rows);
        }
        for (i, lanes) in lanes.iter_mut().skip(start).take(E).enumerate() {
            let mut numbers = [T::zero(); W];
            for (four, tile) in numbers.as_chunks_mut::<E>().0.iter_mut().zip(&tiles) {
                *four = tile[i];
            }
            *lanes = L::from(numbers);
        }
    }
    lanes
}

/// Writes the rows of the `states`, of which there may be fewer than lanes; the inverse of [`lanes_of_rows`].
#[inline(always)]
pub(super) fn rows_of_lanes<'a, T: Tile<E>, L, S, const N: usize, const W: usize, const E: usize>(
    lanes: &'a [L; N],
    array: impl Fn(&'a L) -> &'a [T; W],
    states: &mut [S],
    row: impl Fn(&mut S) -> &mut [T; N],
) {
    for start in starts::<E>(N) {
        for (k, states) in states.chunks_mut(E).take(W / E).enumerate() {
            let mut tile = [[T::zero(); E]; E];
            for (four, lanes) in tile.iter_mut().zip(lanes.iter().skip(start)) {
                if let Some(lanes) = array(lanes).as_chunks::<E>().0.get(k) {
                    *four = *lanes;
                }
            }
            for (state, four) in states.iter_mut().zip(<T as Tile<E>>::transposed(tile)) {
                let row = row(state);
                match row.get_mut(start..).and_then(|row| row.first_chunk_mut::<E>()) {
                    Some(row) => *row = four,
                    None => row.iter_mut().zip(four).for_each(|(entry, value)| *entry = value),
                }
            }
        }
    }
}

/// The entries from `start` on; zeros beyond a row of fewer than `E`.
#[inline(always)]
fn part_of<T: Scalar, const N: usize, const E: usize>(row: &[T; N], start: usize) -> [T; E] {
    if let Some(part) = row.get(start..).and_then(|row| row.first_chunk()) {
        return *part;
    }
    let mut part = [T::zero(); E];
    part.iter_mut().zip(row).for_each(|(part, entry)| *part = *entry);
    part
}
