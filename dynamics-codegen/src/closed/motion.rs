//! A polynomial on paper: what belongs to each product of speeds, and what does not move.

use super::Form;
use super::collect::{lead_with_plus, place_of_bracket, split_common};
use super::item::{Factor, Item, Writer, split_powers};
use super::monomial::Monomial;
use super::polynomial::Polynomial;
use super::ring::Variable;
use super::trig;
use crate::symbolic::Number;

/// What stands before the brackets, a bracket, speeds that all products of a sum share, and this sum.
struct Term {
    outside: Item,
    inside: Vec<Item>,
    shared_motion: Item,
    motion: Vec<Item>,
}

impl Term {
    /// The product of two sums.
    fn of(items: Vec<Item>, motion: Vec<Item>) -> Self {
        let (mut outside, mut inside) = split_common(items);
        if !outside.factors.is_empty() && !inside.iter().any(Item::has_sines) {
            let (least, rest) = split_powers(inside);
            least.into_iter().for_each(|(factor, exponent)| outside.multiply(factor, exponent));
            inside = rest;
        }
        let (mut shared_motion, motion) = split_powers(motion);
        let (number, motion) = split_common(motion);
        shared_motion.extend(number.factors);
        outside.coefficient = outside.coefficient * number.coefficient;
        let shared_motion = Item { coefficient: Number::ONE, factors: shared_motion };
        Self { outside, inside, shared_motion, motion }
    }

    /// Whether both have the same before their brackets, but for the sign.
    fn is_alike(&self, other: &Self) -> bool {
        let (a, b) = (&self.outside, &other.outside);
        a.factors == b.factors && a.coefficient.abs() == b.coefficient.abs()
    }
}

/// Powers of speeds.
type Motion = Vec<(Factor, i32)>;

/// Polynomials with no more terms are written as one product, perhaps.
const SINGLE: usize = 4;

/// The products of speeds that are multiplied with one polynomial, but for its sign; squares together with others if it
/// has several terms. A half stands in front of squares.
fn groups(moving: Vec<(Motion, Polynomial)>) -> Vec<(Polynomial, Vec<Item>)> {
    let mut groups: Vec<(Polynomial, Vec<Item>)> = Vec::new();
    for (motion, polynomial) in moving {
        let opposite = polynomial.scaled(-Number::ONE);
        let is_square = is_square(&motion);
        let same = |(known, items): &&mut (Polynomial, Vec<Item>)| {
            let is_of_kind = polynomial.len() > 1 || self::is_square(&items[0].factors) == is_square;
            is_of_kind && (*known == polynomial || *known == opposite)
        };
        match groups.iter_mut().find(same) {
            Some((known, items)) => {
                let sign = if *known == polynomial { Number::ONE } else { -Number::ONE };
                items.push(Item { coefficient: sign, factors: motion });
            }
            None => groups.push((polynomial, vec![Item { coefficient: Number::ONE, factors: motion }])),
        }
    }
    for (polynomial, items) in &mut groups {
        if items.iter().all(|item| is_square(&item.factors)) {
            *polynomial = polynomial.scaled(Number::integer(2));
            for item in items {
                item.coefficient = item.coefficient * Number::ratio(1, 2);
            }
        }
    }
    groups
}

fn is_square(motion: &[(Factor, i32)]) -> bool {
    matches!(motion, [(_, 2)])
}

fn minus_signs(form: &Form) -> usize {
    let own = match form {
        Form::Negative(_) => 1,
        Form::Number(value) => usize::from(value.is_negative()),
        _ => 0,
    };
    own + form.parts().into_iter().map(minus_signs).sum::<usize>()
}

impl Writer<'_> {
    /// A polynomial as a textbook writes it.
    pub(super) fn form(&self, polynomial: &Polynomial) -> Form {
        let polynomial = &polynomial.with_fractions();
        let moving = self.by_motion(polynomial);
        match &moving[..] {
            [] => Form::ZERO,
            [(motion, polynomial)] if motion.is_empty() => self.collected(self.items(polynomial)),
            _ => self.form_of_motion(moving),
        }
    }

    /// How many terms a polynomial has on paper, its sines written shortest; beyond `most` they are not counted.
    pub(super) fn terms(&self, polynomial: &Polynomial, most: usize) -> usize {
        let count = |sum: usize, (_, part): &(Motion, Polynomial)| {
            let sum = sum + self.items(part).len();
            if sum > most { Err(sum) } else { Ok(sum) }
        };
        self.by_motion(polynomial).iter().try_fold(0, count).unwrap_or_else(|sum| sum)
    }

    /// The polynomials that each product of speeds is multiplied with.
    fn by_motion(&self, polynomial: &Polynomial) -> Vec<(Motion, Polynomial)> {
        let mut moving: Vec<(Motion, Vec<_>)> = Vec::new();
        for (monomial, coefficient) in polynomial.terms() {
            let (mut motion, mut rest) = (Vec::new(), *monomial);
            for (place, exponent) in monomial.exponents() {
                if let Variable::Symbol(_) = self.ring.variables()[place]
                    && let factor @ Factor::Moving(..) = self.factor(place)
                {
                    motion.push((factor, exponent));
                    rest = rest.with(place, 0);
                }
            }
            motion.sort();
            match moving.iter_mut().find(|(known, _)| *known == motion) {
                Some((_, terms)) => terms.push((rest, *coefficient)),
                None => moving.push((motion, vec![(rest, *coefficient)])),
            }
        }
        // Squares of the first speed, its products, squares of the second, and so on; what does not move is last.
        let key = |motion: &[(Factor, i32)]| {
            let powers = motion.iter().map(|(factor, n)| (factor.clone(), -n)).collect::<Vec<_>>();
            (powers.is_empty(), powers)
        };
        moving.sort_by_key(|(motion, _)| key(motion));
        moving.into_iter().map(|(motion, terms)| (motion, Polynomial::of_terms(terms))).collect()
    }

    /// A sum over products of speeds: `½ (…) θ̇₁² + (…) θ̇₁ θ̇₂`. Those with one coefficient share it, and those that
    /// differ in a bracket alone share what stands before it.
    fn form_of_motion(&self, mut moving: Vec<(Motion, Polynomial)>) -> Form {
        let at_rest = moving.pop_if(|(motion, _)| motion.is_empty()).map(|(_, polynomial)| polynomial);
        let as_product = self.single_terms(&moving);
        let by_groups = self.sum_of_groups(groups(moving));
        let is_short = |form: &Form| self.length(form) <= self.length(&by_groups);
        let moving = as_product.filter(is_short).unwrap_or(by_groups);
        let at_rest = at_rest.map_or(Form::ZERO, |rest| self.at_rest(&rest));
        Form::sum([moving, at_rest])
    }

    /// What does not move: subtracted, as V is in T − V, or added, as G is in M q̈ + G, whichever has less signs; either
    /// looks as it does alone.
    fn at_rest(&self, rest: &Polynomial) -> Form {
        let added = self.collected(self.items(rest));
        let subtracted = match self.collected(self.items(&rest.scaled(-Number::ONE))) {
            Form::Sum(terms) => Form::sum(terms.into_iter().map(Form::negative)),
            form => form.negative(),
        };
        if minus_signs(&added) < minus_signs(&subtracted) { added } else { subtracted }
    }

    /// `½ m (ṙ² + r² θ̇²)`: what has one term for each product of speeds, and something of the body in all of them.
    fn single_terms(&self, moving: &[(Motion, Polynomial)]) -> Option<Form> {
        let mut terms = Vec::with_capacity(moving.len());
        for (motion, polynomial) in moving {
            let mut items = if polynomial.len() <= SINGLE { self.items(polynomial) } else { return None };
            let item = items.pop().filter(|_| items.is_empty())?;
            terms.push((motion, item));
        }
        let (motion, items): (Vec<_>, Vec<_>) = terms.into_iter().unzip();
        let is_one_group = items.iter().all(|item| item.factors == items[0].factors);
        let (shared, items) = split_powers(items);
        let inside = items.into_iter().zip(&motion).map(|(mut item, motion)| {
            for (factor, exponent) in motion.iter() {
                item.multiply(factor.clone(), *exponent);
            }
            item
        });
        let (mut outside, mut inside) = split_common(inside.collect());
        for (factor, exponent) in shared {
            outside.multiply(factor, exponent);
        }
        if is_one_group {
            // `½ k (θ̇₁ + θ̇₂)²`, and `c (2 ẋ₂ − ẋ₁ − ẋ₃)`; others are groups.
            let is_linear = |motion: &&Motion| matches!(motion[..], [(_, 1)]);
            let (scale, sum) = match self.factored(&inside) {
                Some(factored) => factored,
                None if motion.iter().all(is_linear) => (Number::ONE, self.sum(&mut outside, inside)),
                None => return None,
            };
            outside.coefficient = outside.coefficient * scale;
            return Some(self.product(outside.coefficient, &outside.factors, vec![(usize::MAX, sum)]));
        }
        if !outside.factors.iter().any(|(factor, _)| factor.is_parameter()) {
            return None;
        }
        // Halves of squares stand before all: `½ m (ẋ² + 2 l cos θ ẋ θ̇ + l² θ̇²)`.
        let half = Number::ratio(1, 2);
        let is_whole = |value: Number| matches!(value, Number::Exact(exact) if exact.denominator() == 1 && exact.is_rational());
        let is_multiple = |item: &Item| is_whole(item.coefficient * Number::integer(2));
        if inside.iter().any(|item| item.coefficient == half) && inside.iter().all(is_multiple) {
            outside.coefficient = outside.coefficient * half;
            for item in &mut inside {
                item.coefficient = item.coefficient * Number::integer(2);
            }
        }
        let place = place_of_bracket(&outside.factors, &inside);
        let sum = self.sum(&mut outside, inside);
        Some(self.product(outside.coefficient, &outside.factors, vec![(place, sum)]))
    }

    /// The terms of a bracket, one without a minus first if there is one: then there is none before the bracket.
    fn sum(&self, outside: &mut Item, mut inside: Vec<Item>) -> Form {
        let is_positive = |item: &Item| !item.coefficient.is_negative();
        if outside.coefficient.is_negative() && !inside.iter().all(is_positive) {
            outside.coefficient = -outside.coefficient;
            inside.iter_mut().for_each(|item| item.coefficient = -item.coefficient);
        }
        lead_with_plus(&mut inside, is_positive);
        Form::sum(inside.iter().map(|item| self.item(item)))
    }

    /// The sum of polynomials, each times a sum of products of speeds.
    fn sum_of_groups(&self, groups: Vec<(Polynomial, Vec<Item>)>) -> Form {
        let terms: Vec<Term> = groups
            .into_iter()
            .map(|(polynomial, motion)| Term::of(self.items(&polynomial), motion))
            .collect();
        let mut taken = vec![false; terms.len()];
        let (mut shared, mut single) = (Vec::new(), Vec::new());
        for (k, term) in terms.iter().enumerate() {
            if taken[k] {
                continue;
            }
            let alike: Vec<usize> =
                (k..terms.len()).filter(|&j| !taken[j] && term.is_alike(&terms[j])).collect();
            let has_sines = |&j: &usize| terms[j].inside.iter().any(Item::has_sines);
            if alike.len() > 2 && !term.outside.factors.is_empty() && !alike.iter().any(has_sines) {
                let Item { coefficient, factors } = &term.outside;
                let inner = alike.iter().map(|&j| {
                    let form = self.inner_term(&terms[j]);
                    let is_opposite = terms[j].outside.coefficient.is_negative() != coefficient.is_negative();
                    if is_opposite { form.negative() } else { form }
                });
                let sum = Form::sum(inner);
                shared.push(self.product(*coefficient, factors, vec![(usize::MAX, sum)]));
                for j in alike {
                    taken[j] = true;
                }
            } else {
                single.push(self.term(term));
            }
        }
        let mut forms = shared;
        forms.append(&mut single);
        if let Some(first) = forms.iter().position(|form| !matches!(form, Form::Negative(_))) {
            forms[..=first].rotate_right(1);
        }
        Form::sum(forms)
    }

    /// `outside · (inside) · motion`
    fn term(&self, term: &Term) -> Form {
        let place = place_of_bracket(&term.outside.factors, &term.inside);
        let mut others = vec![(place, self.inside(term)), (usize::MAX, self.speeds(term))];
        others.retain(|(_, form)| !form.is_one());
        self.product(term.outside.coefficient, &term.outside.factors, others)
    }

    /// `motion · (inside)`, for a bracket: with the motion first, two brackets do not open at once.
    fn inner_term(&self, term: &Term) -> Form {
        match self.inside(term) {
            sum @ Form::Sum(_) => Form::product([self.speeds(term), sum]),
            form => Form::product([form, self.speeds(term)]),
        }
    }

    fn inside(&self, term: &Term) -> Form {
        match &term.inside[..] {
            [only] if only.factors.is_empty() => Form::number(only.coefficient),
            inside => self.collected(inside.to_vec()),
        }
    }

    fn speeds(&self, term: &Term) -> Form {
        let (scale, sum) = self
            .factored(&term.motion)
            .unwrap_or_else(|| (Number::ONE, Form::sum(term.motion.iter().map(|item| self.item(item)))));
        let shared = self.item(&term.shared_motion);
        let first = |item: &Item| item.factors.first().map(|(factor, _)| factor.clone());
        match term.motion.first().and_then(first) < first(&term.shared_motion) {
            true => Form::product([Form::number(scale), sum, shared]),
            false => Form::product([Form::number(scale), shared, sum]),
        }
    }

    /// The items of a polynomial without speeds, its sines written shortest.
    pub(super) fn items(&self, polynomial: &Polynomial) -> Vec<Item> {
        let is_trig =
            |place: usize| matches!(self.ring.variables()[place], Variable::Sin(_) | Variable::Cos(_));
        let mut groups: Vec<(Monomial, Vec<_>)> = Vec::new();
        for (monomial, coefficient) in polynomial.terms() {
            let mut rest = *monomial;
            let mut angles = Vec::new();
            for (place, exponent) in monomial.exponents() {
                if is_trig(place) {
                    rest = rest.with(place, 0);
                    angles.push((place, exponent));
                }
            }
            match groups.iter_mut().find(|(known, _)| *known == rest) {
                Some((_, terms)) => terms.push((angles, *coefficient)),
                None => groups.push((rest, vec![(angles, *coefficient)])),
            }
        }
        let mut items = Vec::new();
        for (rest, terms) in groups {
            let plain = self.plain(&rest);
            for (coefficient, factors) in self.shortest(&terms) {
                let mut item = plain.clone();
                item.coefficient = item.coefficient * coefficient;
                for (factor, exponent) in factors {
                    item.multiply(factor, exponent);
                }
                items.push(item);
            }
        }
        items
    }

    fn shortest(&self, terms: &[(Vec<(usize, i32)>, Number)]) -> Vec<trig::Term> {
        let has = |angle: &[usize; 2]| {
            terms.iter().any(|(powers, _)| powers.iter().any(|(place, _)| angle.contains(place)))
        };
        let used: Vec<usize> = (0..self.angles.len()).filter(|&k| has(&self.angles[k])).collect();
        if used.is_empty() {
            return terms.iter().map(|(_, k)| (*k, vec![])).collect();
        }
        let exponent = |powers: &[(usize, i32)], place: usize| {
            powers.iter().find(|(known, _)| *known == place).map_or(0, |(_, exponent)| *exponent)
        };
        let powers = terms.iter().map(|(powers, k)| {
            let of_angle = |&angle: &usize| self.angles[angle].map(|place| exponent(powers, place));
            (used.iter().map(of_angle).collect(), *k)
        });
        trig::shortest(&used, powers.collect())
    }
}
