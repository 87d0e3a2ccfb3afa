//! Fewer points that look the same.
//!
//! D. Douglas, T. Peucker, *Algorithms for the reduction of the number of points required to represent a digitized line
//! or its caricature*, 1973.

type Point = [f64; 2];

/// How far a line may be from the points that it leaves out, in pixels.
const TOLERANCE: f64 = 0.08;

/// What is seen of points in pixels: of each column the first, the extremes and the last, then none on a straight line
/// between its neighbours.
pub(crate) fn thinned(points: &[Point]) -> Vec<Point> {
    simplified(&columns(points))
}

/// Points in one column of pixels, one after the other, become four at most.
fn columns(points: &[Point]) -> Vec<Point> {
    let mut kept = vec![];
    // A quarter of a pixel, so that steep lines stay where they are.
    for column in points.chunk_by(|a, b| (4.0 * a[0]).floor() == (4.0 * b[0]).floor()) {
        let of = |better: fn(f64, f64) -> bool| {
            (1..column.len()).fold(0, |best, k| if better(column[k][1], column[best][1]) { k } else { best })
        };
        let mut chosen = [0, of(|a, b| a < b), of(|a, b| a > b), column.len() - 1];
        chosen.sort_unstable();
        kept.extend(
            chosen
                .iter()
                .enumerate()
                .filter(|(k, at)| *k == 0 || chosen[k - 1] != **at)
                .map(|(_, at)| column[*at]),
        );
    }
    kept
}

/// Without points that are within the tolerance of the line that stays.
fn simplified(points: &[Point]) -> Vec<Point> {
    let mut keep = vec![false; points.len()];
    let Some(last) = points.len().checked_sub(1) else { return vec![] };
    (keep[0], keep[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let far = (from + 1..to).map(|k| (k, distance(points[k], points[from], points[to])));
        let farthest = far.fold((from, TOLERANCE), |best, (k, d)| if d > best.1 { (k, d) } else { best });
        if farthest.0 > from {
            keep[farthest.0] = true;
            open.extend([(from, farthest.0), (farthest.0, to)]);
        }
    }
    points.iter().zip(keep).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

/// Of a point from the line between two others.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = along[0].hypot(along[1]);
    if length < 1e-9 {
        return to[0].hypot(to[1]);
    }
    // Beyond the ends the nearest point is an end: a path may turn back on itself.
    let part = ((along[0] * to[0] + along[1] * to[1]) / (length * length)).clamp(0.0, 1.0);
    (to[0] - part * along[0]).hypot(to[1] - part * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From every point the line that is left is near.
    #[test]
    fn nothing_that_is_seen_is_lost() {
        let wave = |k: i32| [0.05 * f64::from(k), 100.0 * (0.013 * f64::from(k)).sin()];
        let points: Vec<Point> = (0..20_000).map(wave).collect();
        let thin = thinned(&points);
        assert!(thin.len() < 3000, "{}", thin.len());
        for p in points {
            let near = thin.windows(2).map(|ab| distance(p, ab[0], ab[1])).fold(f64::INFINITY, f64::min);
            assert!(near < 0.25 + TOLERANCE, "{p:?}: {near}");
        }
    }

    #[test]
    fn what_is_short_stays() {
        assert!(thinned(&[]).is_empty());
        assert_eq!(thinned(&[[1.0, 2.0]]), [[1.0, 2.0]]);
        assert_eq!(thinned(&[[1.0, 2.0]; 3]), [[1.0, 2.0]; 2].to_vec());
        assert_eq!(thinned(&[[0.0, 0.0], [5.0, 5.0], [9.0, 9.0]]), [[0.0, 0.0], [9.0, 9.0]]);
    }

    /// A spike one sample long is the news.
    #[test]
    fn a_spike_stays() {
        let mut points: Vec<Point> = (0..50_000).map(|k| [0.01 * f64::from(k), 10.0]).collect();
        points[31_234][1] = -50.0;
        assert!(thinned(&points).iter().any(|p| p[1] == -50.0));
    }
}
