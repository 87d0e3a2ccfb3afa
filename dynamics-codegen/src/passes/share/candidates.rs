//! Which pairs are worth a value of their own.

use super::cost;
use super::terms::{Atom, Coefficient, Definitions, Monomial, ONE, Term};

/// The longest sum whose pairs of terms are looked at.
const LONGEST_SUM: usize = 40;

/// A pair, where it occurs, and what it saves.
pub(super) struct Candidate {
    /// Multiplications and additions fewer.
    pub(super) saves: i64,
    pair: Pair,
    places: Vec<Place>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Pair {
    /// `a·b`
    Product(Atom, Atom),
    /// `k·a`
    Multiple(Coefficient, Atom),
    /// `k·x + l·y`
    Sum { x: Monomial, k: Coefficient, y: Monomial, l: Coefficient },
}

/// An occurrence: the definition, the term (for a sum both, and their common factor).
#[derive(Clone, Copy)]
struct Place {
    reader: Atom,
    first: Monomial,
    second: Monomial,
    factor: Monomial,
    /// The coefficient of the first term.
    scale: Coefficient,
    /// The coefficient of the second term.
    other: Coefficient,
}

/// Where pairs occur: a list for each first part, by the second. Sorting short lists is quicker than hashing where
/// nothing is optimised, and no order depends on a hash.
struct Occurrences<K> {
    by_first: Vec<Vec<(K, Place)>>,
}

impl<K: Ord + Copy> Occurrences<K> {
    fn new() -> Self {
        Self { by_first: Vec::new() }
    }

    fn add(&mut self, first: usize, second: K, place: Place) {
        if first >= self.by_first.len() {
            self.by_first.resize_with(first + 1, Vec::new);
        }
        self.by_first[first].push((second, place));
    }

    /// Hands out each pair with its places, in order.
    fn for_each(self, mut f: impl FnMut(usize, K, &[(K, Place)])) {
        for (first, mut list) in self.by_first.into_iter().enumerate() {
            list.sort_by_key(|(second, _)| *second);
            let mut rest = list.as_slice();
            while let [(second, _), ..] = rest {
                let end = rest.iter().position(|(other, _)| other != second).unwrap_or(rest.len());
                f(first, *second, &rest[..end]);
                rest = &rest[end..];
            }
        }
    }
}

fn places<K>(occurrences: &[(K, Place)]) -> Vec<Place> {
    occurrences.iter().map(|(_, place)| *place).collect()
}

/// All pairs that save something, the best first.
pub(super) fn find(definitions: &mut Definitions) -> Vec<Candidate> {
    let mut products: Occurrences<Atom> = Occurrences::new();
    let mut multiples: Occurrences<Atom> = Occurrences::new();
    let mut sums: Occurrences<(Monomial, Coefficient)> = Occurrences::new();
    for reader in definitions.order() {
        let terms = definitions.terms(reader).unwrap_or_default().to_vec();
        for term in &terms {
            collect_products(definitions, reader, term, &mut products, &mut multiples);
        }
        if terms.len() <= LONGEST_SUM {
            collect_sums(definitions, reader, &terms, &mut sums);
        }
    }
    let mut found: Vec<Candidate> = Vec::new();
    let mut repeated = |pair: Pair, occurrences: &[(Atom, Place)]| {
        if occurrences.len() >= 2 {
            let saves = occurrences.len() as i64 - 1;
            found.push(Candidate { saves, pair, places: places(occurrences) });
        }
    };
    products.for_each(|a, b, occurrences| repeated(Pair::Product(Atom::of(a), b), occurrences));
    multiples.for_each(|k, a, occurrences| repeated(Pair::Multiple(Coefficient::of(k), a), occurrences));
    sums.for_each(|x, (y, ratio), occurrences| {
        if may_save(occurrences) {
            found.extend(sum_candidate(definitions, (Monomial::of(x), y, ratio), places(occurrences)));
        }
    });
    found.sort_by(|a, b| b.saves.cmp(&a.saves).then(a.pair.cmp(&b.pair)));
    found
}

fn collect_products(
    definitions: &Definitions,
    reader: Atom,
    term: &Term,
    products: &mut Occurrences<Atom>,
    multiples: &mut Occurrences<Atom>,
) {
    let place = Place {
        reader,
        first: term.monomial,
        second: Monomial::EMPTY,
        factor: Monomial::EMPTY,
        scale: term.coefficient,
        other: ONE,
    };
    let atoms = definitions.atoms(term.monomial);
    for (i, &a) in atoms.iter().enumerate() {
        for (j, &b) in atoms.iter().enumerate().skip(i + 1) {
            let seen = atoms[..i].contains(&a) || atoms[i + 1..j].contains(&b);
            if !seen {
                products.add(a.index(), b, place);
            }
        }
        if !term.coefficient.is_unit() && !atoms[..i].contains(&a) {
            multiples.add(term.coefficient.index(), a, place);
        }
    }
}

fn collect_sums(
    definitions: &mut Definitions,
    reader: Atom,
    terms: &[Term],
    sums: &mut Occurrences<(Monomial, Coefficient)>,
) {
    for (i, a) in terms.iter().enumerate() {
        for b in &terms[i + 1..] {
            let factor = definitions.common(a.monomial, b.monomial);
            let (x, y) = if factor == Monomial::EMPTY {
                (a.monomial, b.monomial)
            } else {
                (definitions.without(a.monomial, factor), definitions.without(b.monomial, factor))
            };
            let (a, b, x, y) = if x <= y { (a, b, x, y) } else { (b, a, y, x) };
            let ratio = definitions.quotient(b.coefficient, a.coefficient);
            let place = Place {
                reader,
                first: a.monomial,
                second: b.monomial,
                factor,
                scale: a.coefficient,
                other: b.coefficient,
            };
            sums.add(x.index(), (y, ratio), place);
        }
    }
}

/// Whether a sum can save something: one that occurs once only if that factors something out of it.
fn may_save<K>(occurrences: &[(K, Place)]) -> bool {
    let [(_, place)] = occurrences else { return true };
    let same_size = place.scale.magnitude() == place.other.magnitude();
    place.factor != Monomial::EMPTY || (same_size && !place.scale.is_unit())
}

/// The best scale at which to share `x + ratio·y`, if any saves something.
fn sum_candidate(
    definitions: &mut Definitions,
    (x, y, ratio): (Monomial, Monomial, Coefficient),
    places: Vec<Place>,
) -> Option<Candidate> {
    let mut scales = vec![ONE];
    if !ratio.is_unit() {
        scales.extend(places.iter().take(8).map(|place| place.scale.magnitude()));
        // The scale at which the second coefficient is a unit.
        scales.push(definitions.quotient(ONE, ratio).magnitude());
    }
    scales.sort_unstable();
    scales.dedup();
    let best = scales.into_iter().map(|k| {
        let l = definitions.product(k, ratio);
        (savings(definitions, x, k, y, l, &places), k, l)
    });
    let (saves, k, l) = best.max_by(|a, b| a.0.cmp(&b.0).then(b.1.cmp(&a.1)))?;
    (saves > 0).then_some(Candidate { saves, pair: Pair::Sum { x, k, y, l }, places })
}

fn savings(
    definitions: &mut Definitions,
    x: Monomial,
    k: Coefficient,
    y: Monomial,
    l: Coefficient,
    places: &[Place],
) -> i64 {
    let size = |definitions: &Definitions, monomial: Monomial| definitions.atoms(monomial).len();
    let mut used: Vec<(Atom, Monomial)> = Vec::new();
    let mut saves = -(cost(size(definitions, x), k) + cost(size(definitions, y), l) + 1);
    for place in places {
        let keys = [(place.reader, place.first), (place.reader, place.second)];
        if keys.iter().any(|key| used.contains(key)) {
            continue;
        }
        used.extend(keys);
        let left = definitions.quotient(place.scale, k);
        saves += cost(size(definitions, place.first), place.scale)
            + cost(size(definitions, place.second), place.other)
            + 1
            - cost(size(definitions, place.factor) + 1, left);
    }
    saves
}

impl Candidate {
    /// The definitions that change.
    pub(super) fn readers(&self) -> Vec<Atom> {
        let mut readers: Vec<Atom> = self.places.iter().map(|place| place.reader).collect();
        readers.sort_unstable();
        readers.dedup();
        readers
    }

    /// Gives the pair a value of its own and rewrites its readers.
    pub(super) fn apply(&self, definitions: &mut Definitions) {
        let (sum, consumed, scale) = match self.pair {
            Pair::Product(a, b) => {
                let monomial = definitions.monomial(vec![a, b]);
                (vec![Term { coefficient: ONE, monomial }], monomial, ONE)
            }
            Pair::Multiple(k, a) => {
                let monomial = definitions.monomial(vec![a]);
                (vec![Term { coefficient: k, monomial }], monomial, k)
            }
            Pair::Sum { x, k, y, l } => {
                let terms = vec![Term { coefficient: k, monomial: x }, Term { coefficient: l, monomial: y }];
                (terms, Monomial::EMPTY, k)
            }
        };
        let atom = definitions.extract(sum);
        let single = definitions.monomial(vec![atom]);
        for place in &self.places {
            let mut terms = definitions.terms(place.reader).unwrap_or_default().to_vec();
            let is_sum = matches!(self.pair, Pair::Sum { .. });
            let holds = |monomial: Monomial| terms.iter().any(|term| term.monomial == monomial);
            if !holds(place.first) || (is_sum && !holds(place.second)) {
                continue;
            }
            terms.retain(|term| term.monomial != place.first && !(is_sum && term.monomial == place.second));
            let rest = if is_sum { place.factor } else { definitions.without(place.first, consumed) };
            let coefficient = definitions.quotient(place.scale, scale);
            let monomial = definitions.times(rest, single);
            definitions.add_term(&mut terms, Term { coefficient, monomial });
            definitions.define(place.reader, terms);
        }
    }
}
