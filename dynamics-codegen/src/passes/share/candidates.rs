//! Which pairs are worth a value of their own.

use rustc_hash::FxHashMap;

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

/// All pairs that save something, the best first.
pub(super) fn find(definitions: &mut Definitions) -> Vec<Candidate> {
    let mut products: FxHashMap<(Atom, Atom), Vec<Place>> = FxHashMap::default();
    let mut multiples: FxHashMap<(Coefficient, Atom), Vec<Place>> = FxHashMap::default();
    let mut sums: FxHashMap<(Monomial, Monomial, Coefficient), Vec<Place>> = FxHashMap::default();
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
    let repeated = |places: &Vec<Place>| places.len() >= 2;
    let saved = |places: &Vec<Place>| places.len() as i64 - 1;
    for ((a, b), places) in sorted(products).into_iter().filter(|(_, places)| repeated(places)) {
        found.push(Candidate { saves: saved(&places), pair: Pair::Product(a, b), places });
    }
    for ((k, a), places) in sorted(multiples).into_iter().filter(|(_, places)| repeated(places)) {
        found.push(Candidate { saves: saved(&places), pair: Pair::Multiple(k, a), places });
    }
    for (key, places) in sorted(sums) {
        found.extend(sum_candidate(definitions, key, places));
    }
    found.sort_by(|a, b| b.saves.cmp(&a.saves).then(a.pair.cmp(&b.pair)));
    found
}

/// The entries of a map in the order of their keys: nothing may depend on a hash.
fn sorted<K: Ord + Copy, V>(map: FxHashMap<K, V>) -> Vec<(K, V)> {
    let mut entries: Vec<(K, V)> = map.into_iter().collect();
    entries.sort_unstable_by_key(|(key, _)| *key);
    entries
}

fn collect_products(
    definitions: &Definitions,
    reader: Atom,
    term: &Term,
    products: &mut FxHashMap<(Atom, Atom), Vec<Place>>,
    multiples: &mut FxHashMap<(Coefficient, Atom), Vec<Place>>,
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
                products.entry((a, b)).or_default().push(place);
            }
        }
        if !term.coefficient.is_unit() && !atoms[..i].contains(&a) {
            multiples.entry((term.coefficient.magnitude(), a)).or_default().push(place);
        }
    }
}

fn collect_sums(
    definitions: &mut Definitions,
    reader: Atom,
    terms: &[Term],
    sums: &mut FxHashMap<(Monomial, Monomial, Coefficient), Vec<Place>>,
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
            sums.entry((x, y, ratio)).or_default().push(place);
        }
    }
}

/// The best scale at which to share `x + ratio·y`, if any saves something.
fn sum_candidate(
    definitions: &mut Definitions,
    (x, y, ratio): (Monomial, Monomial, Coefficient),
    places: Vec<Place>,
) -> Option<Candidate> {
    if let [place] = places.as_slice() {
        let same_size = place.scale.magnitude() == place.other.magnitude();
        if place.factor == Monomial::EMPTY && (!same_size || place.scale.is_unit()) {
            return None;
        }
    }
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
