//! How a polynomial in sines and cosines of some angles is written shortest.
//!
//! Modulo `sin² + cos² = 1` there are many ways. Those that are tried: powers of each angle, with `sin²` or `cos²`,
//! whichever leaves fewer terms; powers of a multiple of an angle; all products as sines of sums; and the sum of two
//! angles, or their difference, in place of one of them. What is shortest is taken, the first of equals.

use std::collections::BTreeMap;

use super::item::{Angle, Factor};
use crate::symbolic::Number;

/// The powers of sine and cosine of each angle that is there.
pub(super) type Powers = Vec<[i32; 2]>;

/// A number times sines and cosines.
pub(super) type Term = (Number, Vec<(Factor, i32)>);

/// A polynomial in sines and cosines. A map with an order: so is what comes out.
type Sum = BTreeMap<Powers, Number>;

/// Products of more sines than this are not turned into sums.
const DEGREE: i32 = 6;

/// Polynomials with more terms than this, all of them in the same angles, are written as they are.
const TERMS: usize = 24;

/// Products of more sines than [`DEGREE`] are tried as sums, but for those of more sines than this,
const HIGH_DEGREE: i32 = 20;

/// and polynomials with more terms.
const MANY: usize = 100;

/// The shortest way to write a polynomial in sines and cosines of `angles`, in which no sine has a square.
pub(super) fn shortest(angles: &[usize], terms: Vec<(Powers, Number)>) -> Vec<Term> {
    let own: Vec<Angle> = angles.iter().map(|&angle| vec![(angle, 1)]).collect();
    let sum: Sum = terms.into_iter().collect();
    let has_quotient = sum.keys().flatten().any(|[s, c]| *s < 0 || *c < 0);
    if has_quotient {
        return as_they_are(&sum, &own);
    }
    if sum.len() > TERMS || degree(&sum) > DEGREE {
        return shortest_of_many(&own, &sum);
    }
    let mut best = by_powers(&own, &sum, None);
    if best.len() < 2 {
        return best;
    }
    let mut try_this = |other: Vec<Term>| {
        if length(&other) < length(&best) {
            best = other;
        }
    };
    for k in 0..angles.len() {
        of_multiples(&own, &sum, k).into_iter().for_each(&mut try_this);
        if angles.len() > 1
            && let Some(even) = homogeneous(&sum, k)
        {
            try_this(by_powers(&own, &even, Some(k)));
        }
    }
    let waves = waves(&sum);
    try_this(waves_as_terms(&own, &waves));
    for i in 0..angles.len() {
        for j in 0..angles.len() {
            for sign in [1, -1] {
                // The angle j becomes φ = θ_j ± θ_i; of a difference the first is positive.
                if i == j {
                    continue;
                }
                let reversed = sign < 0 && i < j;
                let moved = waves.iter().map(|((frequency, is_cos), &k)| {
                    let mut frequency = frequency.clone();
                    frequency[i] -= sign * frequency[j];
                    frequency[j] = if reversed { -frequency[j] } else { frequency[j] };
                    ((frequency, *is_cos), k)
                });
                let Some(moved) = powers_of(moved, DEGREE) else { continue };
                let mut angles = own.clone();
                let (first, second) = if reversed { (i, j) } else { (j, i) };
                angles[j] = added(&own[first], &own[second], sign);
                try_this(by_powers(&angles, &moved, None));
            }
        }
    }
    best
}

/// The same of many terms or high powers: as sines of multiples, what has the same angles by itself.
fn shortest_of_many(own: &[Angle], sum: &Sum) -> Vec<Term> {
    let as_it_is = if sum.len() > TERMS { as_they_are(sum, own) } else { by_powers(own, sum, None) };
    if sum.len() > MANY || degree(sum) > HIGH_DEGREE {
        return as_it_is;
    }
    let mut parts: BTreeMap<Vec<bool>, Waves> = BTreeMap::new();
    for ((frequency, is_cos), k) in waves(sum) {
        let used = frequency.iter().map(|n| *n != 0).collect();
        parts.entry(used).or_default().insert((frequency, is_cos), k);
    }
    let of_part = |part: Waves| {
        let by_units = in_units(own, &part);
        let by_multiples = powers_of(part.iter().map(|(wave, &k)| (wave.clone(), k)), HIGH_DEGREE);
        let by_multiples = by_multiples.filter(|sum| sum.len() <= TERMS).and_then(|sum| {
            (0..own.len()).filter_map(|k| of_multiples(own, &sum, k)).min_by_key(|terms| length(terms))
        });
        let others = by_units.into_iter().chain(by_multiples);
        std::iter::once(waves_as_terms(own, &part)).chain(others).min_by_key(|terms| length(terms))
    };
    let by_parts: Vec<Term> = parts.into_values().filter_map(of_part).flatten().collect();
    if length(&by_parts) < length(&as_it_is) { by_parts } else { as_it_is }
}

/// Waves as products of powers, the unit of each angle being what all of its frequencies are multiples of.
fn in_units(own: &[Angle], waves: &Waves) -> Option<Vec<Term>> {
    let unit =
        |k: usize| waves.keys().fold(0, |divisor, (frequency, _)| gcd(divisor, frequency[k].abs())).max(1);
    let units: Vec<i32> = (0..own.len()).map(unit).collect();
    let slower = waves.iter().map(|((frequency, is_cos), &k)| {
        let frequency = frequency.iter().zip(&units).map(|(n, unit)| n / unit).collect();
        ((frequency, *is_cos), k)
    });
    let scaled = |(angle, unit): (&Angle, &i32)| angle.iter().map(|&(place, n)| (place, n * unit)).collect();
    let angles: Vec<Angle> = own.iter().zip(&units).map(scaled).collect();
    Some(by_powers(&angles, &powers_of(slower, DEGREE)?, None))
}

fn degree(sum: &Sum) -> i32 {
    sum.keys().map(|powers| powers.iter().flatten().sum::<i32>()).max().unwrap_or(0)
}

fn as_they_are(sum: &Sum, angles: &[Angle]) -> Vec<Term> {
    sum.iter().map(|(powers, k)| (*k, factors(powers, angles))).collect()
}

/// Powers of one angle times those of a multiple of it: `sin θ cos² 4θ`, if all frequencies but those of common factors
/// are multiples.
fn of_multiples(own: &[Angle], sum: &Sum, k: usize) -> Option<Vec<Term>> {
    let common = [0, 1].map(|kind| sum.keys().map(|powers| powers[k][kind]).min().unwrap_or(0));
    let without = |(powers, coefficient): (&Powers, &Number)| {
        let mut powers = powers.clone();
        powers[k] = [powers[k][0] - common[0], powers[k][1] - common[1]];
        (powers, *coefficient)
    };
    let waves = waves(&sum.iter().map(without).collect());
    let divisor = waves.keys().fold(0, |divisor, (frequency, _)| gcd(divisor, frequency[k].abs()));
    let units = [divisor / 2, divisor].into_iter().filter(|unit| *unit > 1 && divisor % unit == 0);
    let written = units.filter_map(|unit| {
        let slower = waves.iter().map(|((frequency, is_cos), &coefficient)| {
            let mut frequency = frequency.clone();
            frequency[k] /= unit;
            ((frequency, *is_cos), coefficient)
        });
        let mut angles = own.to_vec();
        angles[k].iter_mut().for_each(|(_, times)| *times *= unit);
        let mut terms = by_powers(&angles, &powers_of(slower, DEGREE)?, None);
        for (_, factors) in &mut terms {
            for (exponent, is_cos) in common.into_iter().zip([false, true]) {
                if exponent > 0 {
                    factors.push((Factor::Trig(own[k].clone(), is_cos), exponent));
                }
            }
            factors.sort_unstable();
        }
        Some(terms)
    });
    written.min_by_key(|terms| length(terms))
}

fn gcd(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// `a ± b`
fn added(a: &Angle, b: &Angle, sign: i32) -> Angle {
    let mut sum = a.clone();
    sum.extend(b.iter().map(|&(place, times)| (place, sign * times)));
    sum.sort_unstable();
    sum
}

/// How long terms are.
fn length(terms: &[Term]) -> usize {
    let term = |(k, factors): &Term| {
        let number = if k.abs().is_one() { 0 } else { 4 };
        3 + number + factors.iter().map(|(factor, n)| factor.length() + usize::from(*n != 1)).sum::<usize>()
    };
    let minus = terms.iter().filter(|(k, _)| k.is_negative()).count();
    terms.iter().map(term).sum::<usize>() + MINUS * minus.min(terms.len() - minus)
}

/// What it costs that terms have different signs.
const MINUS: usize = 16;

/// With one as `sin² + cos²` of an angle, wherever it has no power and others have; `None` where nothing changes.
fn homogeneous(sum: &Sum, k: usize) -> Option<Sum> {
    let mut even = Sum::new();
    let is_square = sum.keys().any(|powers| powers[k] == [0, 2]);
    let is_mixed = is_square && sum.keys().all(|powers| matches!(powers[k], [0, 0 | 2]));
    is_mixed.then_some(())?;
    for (powers, &coefficient) in sum {
        let squares: &[[i32; 2]] = if powers[k] == [0, 0] { &[[2, 0], [0, 2]] } else { &[[0, 2]] };
        for &square in squares {
            let mut powers = powers.clone();
            powers[k] = square;
            let known = even.entry(powers).or_insert(Number::ZERO);
            *known = *known + coefficient;
        }
    }
    even.retain(|_, k| !k.is_zero());
    Some(even)
}

fn factors(powers: &Powers, angles: &[Angle]) -> Vec<(Factor, i32)> {
    let mut factors = Vec::new();
    for ([s, c], angle) in powers.iter().zip(angles) {
        for (exponent, is_cos) in [(*s, false), (*c, true)] {
            if exponent != 0 {
                factors.push((Factor::Trig(angle.clone(), is_cos), exponent));
            }
        }
    }
    factors
}

/// By powers, the even ones of each angle but one written shortest.
fn by_powers(angles: &[Angle], sum: &Sum, but: Option<usize>) -> Vec<Term> {
    let mut sum = sum.clone();
    for k in (0..angles.len()).filter(|&k| Some(k) != but) {
        let mut groups: BTreeMap<(Powers, [i32; 2]), Vec<Number>> = BTreeMap::new();
        for (powers, &coefficient) in &sum {
            let [s, c] = powers[k];
            let mut rest = powers.clone();
            rest[k] = [0, 0];
            let even = groups.entry((rest, [s, c % 2])).or_default();
            let place = usize::try_from(c / 2).unwrap_or(0);
            even.resize(even.len().max(place + 1), Number::ZERO);
            even[place] = even[place] + coefficient;
        }
        sum = Sum::new();
        for ((rest, [s, c]), even) in groups {
            for (coefficient, sines, cosines) in shortest_even(&even) {
                let mut powers = rest.clone();
                powers[k] = [s + 2 * sines, c + 2 * cosines];
                sum.insert(powers, coefficient);
            }
        }
    }
    let mut terms: Vec<Term> = Vec::with_capacity(sum.len());
    let mut rest = sum.clone();
    for (powers, &coefficient) in &sum {
        if rest.remove(powers).is_none() {
            continue;
        }
        // k cos² − k sin² is k cos of twice the angle.
        let pair = (0..angles.len()).filter(|&k| powers[k] == [0, 2]).find(|&k| {
            let mut other = powers.clone();
            other[k] = [2, 0];
            rest.get(&other).is_some_and(|&k| k == -coefficient)
        });
        let double = |k: usize| angles[k].iter().map(|&(place, times)| (place, 2 * times)).collect::<Angle>();
        let mut single = powers.clone();
        let mut term = (coefficient, vec![]);
        if let Some(k) = pair {
            let mut other = powers.clone();
            other[k] = [2, 0];
            rest.remove(&other);
            single[k] = [0, 0];
            term.1.push((Factor::Trig(double(k), true), 1));
        } else if let Some(k) = (0..angles.len()).find(|&k| powers[k] == [1, 1])
            && is_even(coefficient)
        {
            single[k] = [0, 0];
            term = (coefficient * Number::ratio(1, 2), vec![(Factor::Trig(double(k), false), 1)]);
        }
        term.1.extend(factors(&single, angles));
        term.1.sort_unstable();
        terms.push(term);
    }
    terms
}

fn is_even(value: Number) -> bool {
    matches!(value, Number::Exact(exact) if exact.denominator() == 1 && exact.numerator() % 2 == 0)
}

/// `Σ even[k]·cos²ᵏ` as powers of `sin²` and `cos²`: of the three ways the one with fewest terms, then with fewest minus
/// signs: in cosines, in sines, in both such that all terms have one degree.
fn shortest_even(even: &[Number]) -> Vec<(Number, i32, i32)> {
    let degree = even.len() - 1;
    let number = |k: usize| i32::try_from(k).unwrap_or(0);
    let only = |terms: Vec<(Number, i32, i32)>| -> Vec<_> {
        terms.into_iter().filter(|(k, ..)| !k.is_zero()).collect()
    };
    let in_cosines = only(even.iter().enumerate().map(|(k, &c)| (c, 0, number(k))).collect());
    if in_cosines.len() < 2 && degree < 2 && !in_cosines.first().is_some_and(|term| term.2 == 0 && degree > 0)
    {
        return in_cosines;
    }
    // cos²ᵏ = (1 − sin²)ᵏ, and 1 = (sin² + cos²)ⁿ.
    let mut in_sines = vec![Number::ZERO; degree + 1];
    let mut in_both = vec![Number::ZERO; degree + 1];
    for (k, &c) in even.iter().enumerate() {
        for (j, in_sines) in in_sines.iter_mut().enumerate().take(k + 1) {
            let sign = if j % 2 == 0 { c } else { -c };
            *in_sines = *in_sines + sign * binomial(k, j);
        }
        for j in 0..=degree - k {
            in_both[k + j] = in_both[k + j] + c * binomial(degree - k, j);
        }
    }
    if let [first, second] = in_both[..]
        && first == -second
    {
        return vec![(first, 1, 0), (second, 0, 1)]; // a multiple of the cosine of twice the angle
    }
    let in_both =
        only(in_both.into_iter().enumerate().map(|(k, c)| (c, number(degree - k), number(k))).collect());
    let in_sines = only(in_sines.into_iter().enumerate().map(|(k, c)| (c, number(k), 0)).collect());
    let minus = |terms: &[(Number, i32, i32)]| terms.iter().filter(|(k, ..)| k.is_negative()).count();
    let cost = |terms: &Vec<(Number, i32, i32)>| (terms.len(), minus(terms).min(terms.len() - minus(terms)));
    [in_cosines, in_sines, in_both].into_iter().min_by_key(cost).unwrap_or_default()
}

fn binomial(n: usize, k: usize) -> Number {
    (0..k).fold(Number::ONE, |product, j| {
        let part = |k: usize| Number::integer(i64::try_from(k).unwrap_or(0));
        product * part(n - j) / part(j + 1)
    })
}

/// A sum of sines and, where so, cosines of whole multiples of the angles, the first of which is positive.
type Waves = BTreeMap<(Vec<i32>, bool), Number>;

fn add_wave(waves: &mut Waves, mut frequency: Vec<i32>, is_cos: bool, mut k: Number) {
    if frequency.iter().find(|n| **n != 0).is_some_and(|n| *n < 0) {
        frequency.iter_mut().for_each(|n| *n = -*n);
        k = if is_cos { k } else { -k };
    }
    if is_cos || frequency.iter().any(|n| *n != 0) {
        let known = waves.entry((frequency, is_cos)).or_insert(Number::ZERO);
        *known = *known + k;
    }
}

/// Products as sums.
fn waves(sum: &Sum) -> Waves {
    let mut total = Waves::new();
    let half = Number::ratio(1, 2);
    for (powers, &coefficient) in sum {
        let mut waves = Waves::new();
        waves.insert((vec![0; powers.len()], true), coefficient);
        for (angle, [s, c]) in powers.iter().enumerate() {
            for times_cos in std::iter::repeat_n(false, s.unsigned_abs() as usize)
                .chain(std::iter::repeat_n(true, c.unsigned_abs() as usize))
            {
                let mut product = Waves::new();
                for ((frequency, is_cos), k) in waves {
                    let moved = |by: i32| {
                        let mut frequency = frequency.clone();
                        frequency[angle] += by;
                        frequency
                    };
                    let (up, down) = match (is_cos, times_cos) {
                        (true, true) | (false, true) => (half, half),
                        (true, false) => (half, -half),
                        (false, false) => (-half, half),
                    };
                    add_wave(&mut product, moved(1), is_cos == times_cos, up * k);
                    add_wave(&mut product, moved(-1), is_cos == times_cos, down * k);
                }
                waves = product;
            }
        }
        for ((frequency, is_cos), k) in waves {
            add_wave(&mut total, frequency, is_cos, k);
        }
    }
    total.retain(|_, k| !k.is_zero());
    total
}

fn waves_as_terms(angles: &[Angle], waves: &Waves) -> Vec<Term> {
    let term = |((frequency, is_cos), k): (&(Vec<i32>, bool), &Number)| {
        let mut angle: Angle = Vec::new();
        for (own, &n) in angles.iter().zip(frequency) {
            angle.extend(own.iter().filter(|_| n != 0).map(|&(place, times)| (place, n * times)));
        }
        let factors = if angle.is_empty() { vec![] } else { vec![(Factor::Trig(angle, *is_cos), 1)] };
        (*k, factors)
    };
    waves.iter().map(term).collect()
}

/// Sums as products again, unless they are of high multiples.
fn powers_of(waves: impl Iterator<Item = ((Vec<i32>, bool), Number)>, degree: i32) -> Option<Sum> {
    let mut sum = Sum::new();
    for ((frequency, is_cos), k) in waves {
        if frequency.iter().map(|n| n.abs()).sum::<i32>() > degree {
            return None;
        }
        // The pair of cosine and sine of the angles so far, each a sum of powers.
        let n = frequency.len();
        let (mut cos, mut sin) = (Sum::from([(vec![[0, 0]; n], Number::ONE)]), Sum::new());
        for (angle, &times) in frequency.iter().enumerate() {
            let sign = if times < 0 { -Number::ONE } else { Number::ONE };
            for _ in 0..times.abs() {
                let next_cos = combined(&cos, &sin, angle, -sign);
                sin = combined_sin(&cos, &sin, angle, sign);
                cos = next_cos;
            }
        }
        for (powers, factor) in if is_cos { cos } else { sin } {
            let known = sum.entry(powers).or_insert(Number::ZERO);
            *known = *known + k * factor;
        }
    }
    sum.retain(|_, k| !k.is_zero());
    Some(sum)
}

/// `cos·c + sign·sin·s` of one angle more.
fn combined(cos: &Sum, sin: &Sum, angle: usize, sign: Number) -> Sum {
    let mut sum = times(cos, angle, true, Number::ONE);
    for (powers, k) in times(sin, angle, false, sign) {
        let known = sum.entry(powers).or_insert(Number::ZERO);
        *known = *known + k;
    }
    sum
}

/// `sin·c + sign·cos·s` of one angle more.
fn combined_sin(cos: &Sum, sin: &Sum, angle: usize, sign: Number) -> Sum {
    let mut sum = times(sin, angle, true, Number::ONE);
    for (powers, k) in times(cos, angle, false, sign) {
        let known = sum.entry(powers).or_insert(Number::ZERO);
        *known = *known + k;
    }
    sum
}

fn times(sum: &Sum, angle: usize, by_cos: bool, k: Number) -> Sum {
    let mut product = Sum::new();
    let mut add = |powers: Powers, k: Number| {
        let known = product.entry(powers).or_insert(Number::ZERO);
        *known = *known + k;
    };
    for (powers, &coefficient) in sum {
        let mut powers = powers.clone();
        if by_cos {
            powers[angle][1] += 1;
            add(powers, k * coefficient);
        } else if powers[angle][0] == 0 {
            powers[angle][0] = 1;
            add(powers, k * coefficient);
        } else {
            // sin² = 1 − cos²
            powers[angle][0] = 0;
            let mut lower = powers.clone();
            lower[angle][1] += 2;
            add(powers, k * coefficient);
            add(lower, -(k * coefficient));
        }
    }
    product.retain(|_, k| !k.is_zero());
    product
}
