//! A polynomial on paper: what belongs to each product of speeds, and what does not move.

use super::Form;
use super::collect::{place_of_bracket, split_common};
use super::item::{Factor, Item, Writer};
use super::monomial::Monomial;
use super::polynomial::Polynomial;
use super::ring::Variable;
use super::trig;
use crate::symbolic::Number;

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

    /// The polynomials that each product of speeds is multiplied with.
    fn by_motion(&self, polynomial: &Polynomial) -> Vec<(Vec<(Factor, i32)>, Polynomial)> {
        let mut moving: Vec<(Vec<(Factor, i32)>, Vec<_>)> = Vec::new();
        for (monomial, coefficient) in polynomial.terms() {
            let (mut motion, mut rest) = (Vec::new(), *monomial);
            for (place, exponent) in monomial.exponents() {
                if let Variable::Symbol(_) = self.ring.variables()[place]
                    && let factor @ Factor::Moving(_) = self.factor(place)
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
        // Squares of the first speed, its products, squares of the second, and so on.
        let key = |motion: &[(Factor, i32)]| {
            motion.iter().map(|(factor, n)| (factor.clone(), -n)).collect::<Vec<_>>()
        };
        moving.sort_by(|(a, _), (b, _)| key(a).cmp(&key(b)));
        moving.into_iter().map(|(motion, terms)| (motion, Polynomial::of_terms(terms))).collect()
    }

    /// A sum over products of speeds: `½ (…) θ̇₁² + (…) θ̇₁ θ̇₂`. Those with one coefficient share it, and those that
    /// differ in a bracket alone share what stands before it.
    fn form_of_motion(&self, moving: Vec<(Vec<(Factor, i32)>, Polynomial)>) -> Form {
        let half = Number::ratio(1, 2);
        let mut at_rest = None;
        let mut groups: Vec<(Polynomial, Vec<Item>)> = Vec::new();
        for (motion, polynomial) in moving {
            if motion.is_empty() {
                at_rest = Some(polynomial);
                continue;
            }
            // Half a square: the half stands in front, whatever the rest is.
            let is_energy = motion.iter().map(|(_, n)| *n).sum::<i32>() == 2 && motion.len() == 1;
            let outside = if is_energy { half } else { Number::ONE };
            let polynomial = polynomial.scaled(Number::ONE / outside);
            let opposite = polynomial.scaled(-Number::ONE);
            let same = |(known, items): &&mut (Polynomial, Vec<Item>)| {
                items[0].coefficient.abs() == outside && (*known == polynomial || *known == opposite)
            };
            match groups.iter_mut().find(same) {
                Some((known, items)) => {
                    let sign = if *known == polynomial { Number::ONE } else { -Number::ONE };
                    items.push(Item { coefficient: outside * sign, factors: motion });
                }
                None => groups.push((polynomial, vec![Item { coefficient: outside, factors: motion }])),
            }
        }
        let moving = self.sum_of_groups(groups);
        // What does not move is subtracted, as V is in T − V, and looks as it does alone.
        let rest = at_rest.map(|rest| self.collected(self.items(&rest.scaled(-Number::ONE))));
        let subtracted = match rest {
            None => vec![],
            Some(Form::Sum(terms)) => terms.into_iter().map(Form::negative).collect(),
            Some(form) => vec![form.negative()],
        };
        Form::sum(std::iter::once(moving).chain(subtracted))
    }

    fn sum_of_groups(&self, groups: Vec<(Polynomial, Vec<Item>)>) -> Form {
        // What stands before the brackets: a number and factors that all terms of a coefficient share.
        let split = groups.into_iter().map(|(polynomial, motion)| {
            let (outside, inside) = split_common(self.items(&polynomial));
            let (common, motion) = split_common(motion);
            let coefficient = outside.coefficient * common.coefficient;
            let mut motion_outside = common;
            motion_outside.coefficient = Number::ONE;
            (Item { coefficient, ..outside }, inside, motion_outside, motion)
        });
        let split: Vec<_> = split.collect();
        let mut taken = vec![false; split.len()];
        let mut forms: Vec<(bool, Form)> = Vec::new();
        for k in 0..split.len() {
            if taken[k] {
                continue;
            }
            let (outside, ..) = &split[k];
            let is_alike = |other: &Item| {
                other.factors == outside.factors && other.coefficient.abs() == outside.coefficient.abs()
            };
            let alike: Vec<usize> =
                (k..split.len()).filter(|&j| !taken[j] && is_alike(&split[j].0)).collect();
            let is_worth_it = alike.len() > 2 && !outside.factors.is_empty();
            if is_worth_it {
                let negative = outside.coefficient.is_negative();
                let terms = alike.iter().map(|&j| {
                    taken[j] = true;
                    let (other, inside, motion_outside, motion) = &split[j];
                    let sign =
                        if other.coefficient.is_negative() == negative { Number::ONE } else { -Number::ONE };
                    self.moving_term(
                        &Item { coefficient: sign, factors: vec![] },
                        inside,
                        motion_outside,
                        motion,
                        true,
                    )
                });
                let sum = Form::sum(terms);
                forms.push((
                    true,
                    self.product(outside.coefficient, &outside.factors, vec![(usize::MAX, sum)]),
                ));
            } else {
                let (outside, inside, motion_outside, motion) = &split[k];
                taken[k] = true;
                forms.push((false, self.moving_term(outside, inside, motion_outside, motion, false)));
            }
        }
        if forms.iter().any(|(is_shared, _)| *is_shared) {
            forms.sort_by_key(|(is_shared, _)| !is_shared);
        }
        if let Some(first) = forms.iter().position(|(_, form)| !matches!(form, Form::Negative(_))) {
            forms[..=first].rotate_right(1);
        }
        Form::sum(forms.into_iter().map(|(_, form)| form))
    }

    /// `outside · (inside) · motion`; the motion first where that avoids two brackets at once.
    fn moving_term(
        &self,
        outside: &Item,
        inside: &[Item],
        motion_outside: &Item,
        motion: &[Item],
        motion_first: bool,
    ) -> Form {
        let inner = match inside {
            [only] if only.factors.is_empty() => Form::number(only.coefficient),
            _ => self.collected(inside.to_vec()),
        };
        let motion = match motion {
            [only] if only.factors.is_empty() => Form::ONE,
            _ => Form::sum(motion.iter().map(|item| self.item(item))),
        };
        let moving = Form::product([self.item(motion_outside), motion]);
        if motion_first && matches!(inner, Form::Sum(_)) {
            let before = self.item(outside);
            return Form::product([before, moving, inner]);
        }
        let place = place_of_bracket(&outside.factors, inside);
        let mut others = vec![(place, inner), (usize::MAX, moving)];
        others.retain(|(_, form)| !form.is_one());
        others.sort_by_key(|(place, _)| *place);
        self.product(outside.coefficient, &outside.factors, others)
    }

    /// The items of a polynomial without speeds, its sines written shortest.
    fn items(&self, polynomial: &Polynomial) -> Vec<Item> {
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
            let mut plain = Item { coefficient: Number::ONE, factors: vec![] };
            for (place, exponent) in rest.exponents() {
                plain.multiply(self.factor(place), exponent);
            }
            for (coefficient, factors) in self.shortest(&terms) {
                let mut item = plain.clone();
                item.coefficient = coefficient;
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
