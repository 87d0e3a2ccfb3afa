//! Labels beside the ends of lines, moved apart until none covers another.

/// Places as near to `wanted` as can be, in the same order, at least `gap` apart and within an interval that has room.
///
/// Where some are too near they become a row about the mean of their wishes, as in isotonic regression.
pub(crate) fn apart(wanted: &[f64], gap: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]).then(a.cmp(&b)));
    // Rows: the sum of where their first one would like to be, and how many are in them.
    let mut rows: Vec<(f64, usize)> = vec![];
    for &k in &order {
        let mut row = (wanted[k].clamp(low, high), 1);
        while let Some(&(sum, count)) = rows.last() {
            let (first, next) = (sum / count as f64, row.0 / row.1 as f64);
            if next - first >= gap * count as f64 {
                break;
            }
            rows.pop();
            row = (sum + row.0 - gap * (count * row.1) as f64, count + row.1);
        }
        rows.push(row);
    }
    let mut placed = vec![0.0; wanted.len()];
    let mut at = order.iter();
    for (sum, count) in rows {
        let length = gap * (count - 1) as f64;
        let first = (sum / count as f64).min(high - length).max(low);
        for k in 0..count {
            if let Some(&index) = at.next() {
                placed[index] = first + gap * k as f64;
            }
        }
    }
    // What was pushed back into the interval may have met its neighbour.
    let mut least = f64::NEG_INFINITY;
    for &k in &order {
        placed[k] = placed[k].max(least);
        least = placed[k] + gap;
    }
    let mut most = high;
    for &k in order.iter().rev() {
        placed[k] = placed[k].min(most);
        most = placed[k] - gap;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn what_has_room_stays() {
        assert_eq!(apart(&[50.0, 10.0, 90.0], 13.0, [0.0, 100.0]), [50.0, 10.0, 90.0]);
    }

    #[test]
    fn what_is_near_moves_apart_by_equal_parts() {
        assert_eq!(apart(&[50.0, 50.0], 10.0, [0.0, 100.0]), [45.0, 55.0]);
        assert_eq!(apart(&[0.0, 0.0, 100.0], 10.0, [0.0, 100.0]), [0.0, 10.0, 100.0]);
        assert_eq!(apart(&[99.0, 100.0, 98.0], 10.0, [0.0, 100.0]), [90.0, 100.0, 80.0]);
    }

    #[test]
    fn all_are_apart_and_within() {
        for n in 1..=20_usize {
            for turn in 0..50_usize {
                let wanted: Vec<f64> =
                    (0..n).map(|k| ((k * k * 37 + turn * 61 + k * turn) % 200) as f64).collect();
                let mut placed = apart(&wanted, 10.0, [0.0, 200.0]);
                placed.sort_by(f64::total_cmp);
                assert!(placed.windows(2).all(|pair| pair[1] - pair[0] > 10.0 - 1e-9), "{placed:?}");
                assert!(placed[0] > -1e-9 && placed[n - 1] < 200.0 + 1e-9, "{placed:?}");
            }
        }
    }
}
