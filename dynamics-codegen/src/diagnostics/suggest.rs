//! "Did you mean": the known name closest to one that is not.

/// The closest of the `known` names, if it is close enough to be a slip: the first one of the fewest edits. One letter is
/// no slip of another.
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = name.chars().count();
    let allowed = (length / 3).max(1).min(length.saturating_sub(1));
    let close = known.into_iter().map(|candidate| (distance(name, candidate), candidate));
    let (_, best) = close.filter(|(edits, _)| *edits <= allowed).min_by_key(|(edits, _)| *edits)?;
    Some(best)
}

/// The edits from one word to another: insertions, deletions, replacements, swaps of neighbours.
/// Case is not an edit; a wide difference in length is not looked at closer.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<_>, Vec<_>) = (a.to_lowercase().chars().collect(), b.to_lowercase().chars().collect());
    if a.len().abs_diff(b.len()) > 8 || a.len().max(b.len()) > 64 {
        return usize::MAX;
    }
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut edits = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                edits = edits.min(rows[i - 2][j - 2] + 1);
            }
            row.push(edits);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::did_you_mean;

    #[test]
    fn a_slip_is_found_and_a_different_word_is_not() {
        assert_eq!(did_you_mean("intertia", ["mass", "inertia", "com"]), Some("inertia"));
        assert_eq!(did_you_mean("amss", ["mass", "inertia"]), Some("mass"));
        assert_eq!(did_you_mean("Column", ["column"]), Some("column"));
        assert_eq!(did_you_mean("colour", ["mass", "inertia"]), None);
        assert_eq!(did_you_mean("", ["mass"]), None);
        assert_eq!(did_you_mean("c", ["m", "C"]), Some("C"));
        assert_eq!(did_you_mean("c", ["m", "cm"]), None);
    }
}
