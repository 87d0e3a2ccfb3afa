//! A sum of items as a textbook writes it: common factors pulled out, terms collected by what they share, in order.
//!
//! Collecting is greedy, and bounded: in each step the terms that share most are put into one bracket. A bracket is worth
//! it if it saves more than itself. Squares are not torn apart: `l² + l a` stays, and sines and cosines alone are taken out of
//! three terms or more, for `I sin² + J cos² + K cos²` is easier read than with a bracket; but their squares are where there are
//! brackets anyway, or where like terms would not stand together, as those of `(A + B) sin² + C cos²`.

use super::Form;
use super::form::is_written_exactly;
use super::item::{Angle, Factor, Item, Writer, split_powers};
use crate::symbolic::Number;

/// What a pair of brackets costs, a symbol being 4.
const BRACKET: usize = 3;

/// What a bracket costs that opens right behind another one.
const DOUBLE_BRACKET: usize = 2;

/// The last rank of the quantities that a sum is collected by: inertias, masses, gravity, springs and dampers.
const WEIGHTY: u8 = 6;

/// Sums of more items are not collected.
const ITEMS: usize = 80;

/// Sums of no more items are collected by sines, whatever their terms are.
const FEW: usize = 4;

/// What is preferred to be pulled out of terms.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Prefer {
    /// What saves most.
    Gain,
    /// Masses and the like.
    Weight,
    /// Sines and cosines, but not their squares.
    Sines,
    /// Their squares.
    Squares,
}

/// A part of a sum: a number times factors, perhaps times a bracket.
#[derive(Clone, Debug)]
struct Part {
    outside: Item,
    /// The items of the bracket and how they are written.
    inside: Option<(Vec<Item>, Form)>,
}

impl Writer<'_> {
    /// The sum of items.
    pub(super) fn collected(&self, mut items: Vec<Item>) -> Form {
        sort(&mut items);
        match items.len() {
            0 => return Form::ZERO,
            1 => return self.item(&items[0]),
            2..=ITEMS => {}
            _ => return Form::sum(items.iter().map(|item| self.item(item))),
        }
        let mut best = self.by_parts(items.clone());
        let (mut outside, inside) = split_common(items);
        if let Some((scale, form)) = self.factored(&inside) {
            let number = outside.coefficient;
            outside.coefficient = number * scale;
            best = self.shorter(self.bracketed(&outside, &inside, form), best);
            outside.coefficient = number;
        }
        if outside.factors.is_empty() && outside.coefficient.abs().is_one() {
            return best;
        }
        let inner = self.by_parts(inside.clone());
        best = self.shorter(self.bracketed(&outside, &inside, inner), best);
        // `m (l² + l a)` is `m l (l + a)`, but with sines it stays.
        if inside.iter().any(Item::has_sines) {
            return best;
        }
        let (least, inside) = split_powers(inside);
        if least.is_empty() {
            return best;
        }
        least.into_iter().for_each(|(factor, exponent)| outside.multiply(factor, exponent));
        let inner = self.by_parts(inside.clone());
        self.shorter(best, self.bracketed(&outside, &inside, inner))
    }

    /// The shorter one of two forms, and the first of equals.
    fn shorter(&self, first: Form, second: Form) -> Form {
        if self.length(&first) <= self.length(&second) { first } else { second }
    }

    /// The sum of items by what they share: by masses and the like first, or by what saves most, or by sines if that is
    /// shorter.
    fn by_parts(&self, items: Vec<Item>) -> Form {
        let mut best = self.sum_of(self.parts(items.clone(), Prefer::Gain));
        if items.len() > ITEMS / 2 {
            return best;
        }
        let by_gain = best_shared(&items, Prefer::Gain, &[]);
        if best_shared(&items, Prefer::Weight, &[]) != by_gain {
            best = self.shorter(self.sum_of(self.parts(items.clone(), Prefer::Weight)), best);
        }
        // Where all have sines, as in G, or there are a few terms.
        if (items.len() <= FEW || items.iter().all(Item::has_sines))
            && best_shared(&items, Prefer::Sines, &[]) != by_gain
        {
            best = self.shorter(best, self.sum_of(self.parts(items.clone(), Prefer::Sines)));
        }
        if (has_bracket(&best) || are_apart(&items)) && share_squares(&items) {
            best = self.shorter(self.sum_of(self.parts(items, Prefer::Squares)), best);
        }
        best
    }

    /// The parts of a sum whose items have nothing in common.
    fn parts(&self, mut items: Vec<Item>, prefer: Prefer) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        let mut angles: Vec<Angle> = Vec::new();
        while let Some(shared) = best_shared(&items, prefer, &angles) {
            let (group, rest): (Vec<_>, Vec<_>) = items.into_iter().partition(|item| has_all(item, &shared));
            items = rest;
            let mut inside: Vec<Item> = group.into_iter().map(|item| without(item, &shared)).collect();
            sort(&mut inside);
            let (common, inside) = split_common(inside);
            let mut outside = common;
            for (factor, exponent) in shared {
                if let Factor::Trig(angle, _) = &factor {
                    angles.push(angle.clone());
                }
                outside.multiply(factor, exponent);
            }
            // What the group has in common, beyond what it was chosen by, is outside already.
            let form = self.collected(inside.clone());
            parts.push(Part { outside, inside: Some((inside, form)) });
        }
        parts.extend(items.into_iter().map(|outside| Part { outside, inside: None }));
        self.merge(parts)
    }

    /// Parts with the same bracket become one: `a (…) + b (…)` is `(a + b) (…)`.
    fn merge(&self, parts: Vec<Part>) -> Vec<Part> {
        let mut merged: Vec<Part> = Vec::new();
        let mut taken = vec![false; parts.len()];
        for k in 0..parts.len() {
            if taken[k] {
                continue;
            }
            let same = |other: &Part| match (&parts[k].inside, &other.inside) {
                (Some((a, _)), Some((b, _))) => a == b,
                _ => false,
            };
            let equal: Vec<usize> = (k..parts.len()).filter(|&j| same(&parts[j])).collect();
            if equal.len() < 2 {
                merged.push(parts[k].clone());
                continue;
            }
            let mut outside = Vec::new();
            for &j in &equal {
                taken[j] = true;
                outside.push(parts[j].outside.clone());
            }
            sort(&mut outside);
            let (common, rest) = split_common(outside);
            let sum = self.collected(rest.clone());
            let Some((inside, form)) = &parts[k].inside else { continue };
            let product = Form::product([sum, form.clone()]);
            let mut items = rest;
            items.extend(inside.iter().cloned());
            merged.push(Part { outside: common, inside: Some((items, product)) });
        }
        merged
    }

    /// The sum of parts in order.
    fn sum_of(&self, mut parts: Vec<Part>) -> Form {
        let key = |part: &Part| {
            let first = part.inside.as_ref().and_then(|(items, _)| items.first());
            order(&part.outside, first)
        };
        parts.sort_by_key(key);
        lead_with_plus(&mut parts, |part| !part.outside.coefficient.is_negative());
        let forms = parts.into_iter().map(|part| match part.inside {
            Some((items, form)) => self.bracketed(&part.outside, &items, form),
            None => self.item(&part.outside),
        });
        Form::sum(forms)
    }

    /// Factors around a bracket.
    fn bracketed(&self, outside: &Item, inside: &[Item], form: Form) -> Form {
        let (minus, form) = form.split_sign();
        let place = place_of_bracket(&outside.factors, inside);
        let product = self.product(outside.coefficient, &outside.factors, vec![(place, form)]);
        if minus { product.negative() } else { product }
    }

    /// How long a form is, a symbol being 4, with its brackets.
    pub(super) fn length(&self, form: &Form) -> usize {
        match form {
            Form::Number(value) if value.is_one() => 0,
            Form::Number(value) if fraction(*value).is_none_or(|(_, den)| den > 24) => 6,
            Form::Number(_) | Form::Symbol(_) => 4,
            Form::Negative(inner) => self.length(inner),
            Form::Sum(terms) => terms.iter().map(|term| self.length(term)).sum(),
            Form::Product(factors) => {
                let double = match &factors[..] {
                    [Form::Sum(_), ..] => 0,
                    _ => factors.iter().filter(|factor| opens_double(factor)).count() * DOUBLE_BRACKET,
                };
                double + factors.iter().map(|factor| self.bracket(factor)).sum::<usize>()
            }
            Form::Quotient(above, below) => self.bracket(above) + self.bracket(below),
            Form::Power(base, _) => 1 + self.bracket(base),
            Form::Sin(argument) | Form::Cos(argument) => {
                4 + match &**argument {
                    Form::Sum(terms) => 4 * terms.len(),
                    _ => 4,
                }
            }
            Form::Root(inner) => 4 + self.length(inner),
        }
    }

    fn bracket(&self, form: &Form) -> usize {
        let own = if matches!(form, Form::Sum(_)) { BRACKET } else { 0 };
        own + self.length(form)
    }
}

/// Before which of the factors a bracket stands: a sum of speeds behind all, another one before speeds, one without sines
/// before sines, one of parameters before coordinates, and a sum of single ones where the first of these would.
pub(super) fn place_of_bracket(factors: &[(Factor, i32)], inside: &[Item]) -> usize {
    let before = |is_before: &dyn Fn(&Factor) -> bool| {
        factors.iter().take_while(|(factor, _)| is_before(factor)).count()
    };
    let has = |is_so: fn(&Factor) -> bool| {
        inside.iter().any(|item| item.factors.iter().any(|(factor, _)| is_so(factor)))
    };
    let is_single = |item: &Item| matches!(&item.factors[..], [(factor, 1)] if factor.is_parameter());
    let is_speed = |item: &Item| item.factors.iter().all(|(factor, _)| factor.is_moving());
    let is_inside = |factor: &Factor| inside.iter().any(|item| item.exponent(factor) != 0);
    match inside.first().and_then(|item| item.factors.first()) {
        Some((first, _)) if inside.iter().all(is_single) => {
            before(&|factor| factor < first || factor.is_parameter() && is_inside(factor))
        }
        _ if inside.iter().all(is_speed) => factors.len(),
        _ if has(Factor::is_trig) || has(Factor::is_moving) => before(&|factor| !factor.is_moving()),
        _ if inside.iter().all(Item::is_of_parameters) => before(&Factor::is_parameter),
        _ => before(&|factor| !factor.is_moving() && !factor.is_trig()),
    }
}

/// Whether there is a bracket in a sum.
fn has_bracket(form: &Form) -> bool {
    match form {
        Form::Sum(terms) => terms.iter().any(has_bracket),
        Form::Negative(inner) => has_bracket(inner),
        Form::Product(factors) => factors.iter().any(|factor| matches!(factor, Form::Sum(_))),
        _ => false,
    }
}

/// The squares of sines and cosines that an item has.
fn squares(item: &Item) -> Vec<&Factor> {
    let is_square = |(factor, exponent): &&(Factor, i32)| factor.is_trig() && *exponent == 2;
    item.factors.iter().filter(is_square).map(|(factor, _)| factor).collect()
}

/// Whether two items have the square of one sine.
fn share_squares(items: &[Item]) -> bool {
    let all: Vec<&Factor> = items.iter().flat_map(squares).collect();
    all.iter().enumerate().any(|(k, factor)| all[..k].contains(factor))
}

/// Whether squares of one sine do not follow each other, as those in `A sin² + C cos² + B sin²`.
fn are_apart(items: &[Item]) -> bool {
    let with_squares: Vec<Vec<&Factor>> = items.iter().map(squares).filter(|all| !all.is_empty()).collect();
    let returns =
        |k: usize| with_squares[k] != with_squares[k - 1] && with_squares[..k].contains(&with_squares[k]);
    (1..with_squares.len()).any(returns)
}

/// Whether a bracket begins with another one.
fn opens_double(form: &Form) -> bool {
    let Form::Sum(terms) = form else { return false };
    let first = match terms.first() {
        Some(Form::Negative(inner)) => Some(&**inner),
        first => first,
    };
    matches!(first, Some(Form::Product(factors)) if matches!(factors.first(), Some(Form::Sum(_))))
}

/// The order of terms: what moves last, then what has no sines before what has, what is divided by a parameter behind others,
/// and by factors.
type Order = (Vec<(Factor, i32)>, [bool; 2], Vec<(Factor, i32)>);

fn order(outside: &Item, inside: Option<&Item>) -> Order {
    let trig =
        |item: &Item| item.factors.iter().filter(|(factor, _)| matches!(factor, Factor::Trig(..))).count();
    let moving = |item: &Item| {
        let moves = |(factor, exponent): &(Factor, i32)| {
            matches!(factor, Factor::Moving(..)).then(|| (factor.clone(), -*exponent))
        };
        item.factors.iter().filter_map(moves).collect::<Vec<_>>()
    };
    let is_divided = outside.factors.iter().any(|(factor, exponent)| factor.is_parameter() && *exponent < 0);
    let mut factors: Vec<(Factor, i32)> = outside.factors.clone();
    if let Some(inside) = inside {
        factors.extend(inside.factors.iter().cloned());
        factors.sort();
    }
    // Squares before products of the same first factor.
    let factors = factors.into_iter().map(|(factor, exponent)| (factor, -exponent)).collect();
    (moving(outside), [trig(outside) + inside.map_or(0, trig) > 0, is_divided], factors)
}

/// Items in order, the first without a minus if there is one.
pub(super) fn sort(items: &mut [Item]) {
    items.sort_by_key(|item| order(item, None));
    lead_with_plus(items, |item| !item.coefficient.is_negative());
}

/// Brings the first positive one to the front.
pub(super) fn lead_with_plus<T>(items: &mut [T], is_positive: impl Fn(&T) -> bool) {
    if let Some(first) = items.iter().position(is_positive) {
        items[..=first].rotate_right(1);
    }
}

/// What all items have in common, and what is left of them: a sign, a number, factors with one exponent.
pub(super) fn split_common(items: Vec<Item>) -> (Item, Vec<Item>) {
    let Some(first) = items.first() else {
        return (Item { coefficient: Number::ONE, factors: vec![] }, items);
    };
    let shared: Vec<_> = first
        .factors
        .iter()
        .filter(|shared| items.iter().all(|item| item.factors.contains(shared)))
        .cloned()
        .collect();
    let size = first.coefficient.abs();
    let size =
        if items.iter().all(|item| item.coefficient.abs() == size) { size } else { common_number(&items) };
    // A sign is common to all, or, of three and more, is that of the first in order: the rest then looks alike wherever it
    // comes from.
    let is_negative = |item: &Item| item.coefficient.is_negative();
    let leads_with_minus =
        || items.iter().min_by(|a, b| order(a, None).cmp(&order(b, None))).is_some_and(is_negative);
    let minus = items.iter().all(is_negative) || items.len() > 2 && leads_with_minus();
    let sign = if minus { -Number::ONE } else { Number::ONE };
    let coefficient = size * sign;
    let rest = items.into_iter().map(|item| {
        let mut rest = without(item, &shared);
        rest.coefficient = rest.coefficient / coefficient;
        rest
    });
    let mut rest: Vec<Item> = rest.collect();
    sort(&mut rest);
    (Item { coefficient, factors: shared }, rest)
}

/// A number that all coefficients are simple multiples of: their largest whole divisor, over their one denominator; or the
/// largest of them, where it is a decimal, as of gravity. A root is common to all or stays in the bracket.
fn common_number(items: &[Item]) -> Number {
    let radicand = |item: &Item| match item.coefficient {
        Number::Exact(exact) => exact.radicand(),
        Number::Float(_) => 1,
    };
    let shared = items.first().map_or(1, radicand);
    if shared != 1
        && items.iter().all(|item| radicand(item) == shared && is_written_exactly(item.coefficient))
        && let Some(root) = Number::integer(shared.into()).sqrt()
    {
        let mut rest = items.to_vec();
        rest.iter_mut().for_each(|item| item.coefficient = item.coefficient / root);
        return root * common_number(&rest);
    }
    let largest =
        items.iter().map(|item| item.coefficient.abs()).max_by(|a, b| a.cmp_value(*b)).unwrap_or(Number::ONE);
    let ratios = || items.iter().map(|item| item.coefficient.abs() / largest);
    let is_simple = |value: Number| fraction(value).is_some_and(|(num, den)| num <= 24 && den <= 24);
    let is_half = |ratio: Number| ratio.is_one() || ratio == Number::ratio(1, 2);
    let is_shared = || ratios().filter(|ratio| ratio.is_one()).count() > 1 || ratios().all(is_half);
    if items.len() > 2 && !is_simple(largest) && ratios().all(is_simple) && is_shared() {
        return largest;
    }
    let fractions: Vec<_> = items.iter().map_while(|item| fraction(item.coefficient.abs())).collect();
    if fractions.len() == items.len() && fractions.iter().all(|(_, den)| *den > 24 && !is_decimal(*den)) {
        let multiple = fractions.iter().fold(1, |multiple, (_, den)| multiple / gcd(multiple, *den) * den);
        let divisor = fractions.iter().fold(0, |divisor, (num, den)| gcd(divisor, num * (multiple / den)));
        if multiple < 10_000 {
            return Number::ratio(divisor.max(1), multiple);
        }
    }
    let (mut divisor, mut denominator) = (0, None);
    for item in items {
        let Some((num, den)) = rational_part(item.coefficient.abs()) else { return Number::ONE };
        // Decimals have no common denominator that anybody sees.
        if den > 500 || *denominator.get_or_insert(den) != den {
            return Number::ONE;
        }
        divisor = gcd(divisor, num);
    }
    Number::ratio(divisor.max(1), denominator.unwrap_or(1))
}

fn gcd(mut a: i64, mut b: i64) -> i64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

fn is_decimal(mut den: i64) -> bool {
    while den % 2 == 0 {
        den /= 2;
    }
    while den % 5 == 0 {
        den /= 5;
    }
    den == 1
}

/// Numerator and denominator of a fraction of moderate size.
fn fraction(value: Number) -> Option<(i64, i64)> {
    let is_rational = matches!(value, Number::Exact(exact) if exact.is_rational());
    rational_part(value).filter(|_| is_rational)
}

/// The same of a fraction times a root.
fn rational_part(value: Number) -> Option<(i64, i64)> {
    let Number::Exact(exact) = value else { return None };
    let small = |value: i128| i64::try_from(value).ok().filter(|value| value.abs() < 1_000_000);
    (exact.pi_power() == 0).then_some(())?;
    Some((small(exact.numerator())?, small(exact.denominator())?))
}

fn has_all(item: &Item, shared: &[(Factor, i32)]) -> bool {
    shared.iter().all(|shared| item.factors.contains(shared))
}

fn without(mut item: Item, shared: &[(Factor, i32)]) -> Item {
    item.factors.retain(|factor| !shared.contains(factor));
    item
}

/// Powers of factors that several items share.
type Shared = Vec<(Factor, i32)>;

/// The factors that several items share and that save most if they are pulled out of these; what is preferred comes first. Of the `angles`, terms are collected already: what else has them is, too.
fn best_shared(items: &[Item], prefer: Prefer, angles: &[Angle]) -> Option<Vec<(Factor, i32)>> {
    // Whether it has what is preferred, what it saves, what it is.
    let mut best: Option<((bool, usize), Shared)> = None;
    for (k, first) in items.iter().enumerate() {
        for second in &items[k + 1..] {
            let shared: Vec<_> =
                first.factors.iter().filter(|factor| second.factors.contains(factor)).cloned().collect();
            if shared.is_empty() || best.as_ref().is_some_and(|(_, known)| *known == shared) {
                continue;
            }
            let weight: usize = shared.iter().map(|factor| weight(factor, prefer, angles)).sum();
            let mut group = items.iter().filter(|item| has_all(item, &shared));
            let count = group.clone().count();
            // A sum of masses is read as one.
            let is_mass = |item: &Item| {
                let mut rest = item.factors.iter().filter(|factor| !shared.contains(factor));
                matches!((rest.next(), rest.next()), (Some((Factor::Symbol(rank, _), 1)), None) if *rank <= WEIGHTY)
            };
            let bracket = if group.all(is_mass) { BRACKET - 1 } else { BRACKET };
            let gain = (weight * (count - 1)).checked_sub(bracket).filter(|gain| *gain > 0);
            let Some(gain) = gain else { continue };
            let is_preferred = |factor: &(Factor, i32)| match (prefer, factor) {
                (Prefer::Weight, (Factor::Symbol(rank, _), _)) => *rank <= WEIGHTY,
                (Prefer::Sines, (Factor::Trig(..), 1)) | (Prefer::Squares, (Factor::Trig(..), 2)) => true,
                _ => false,
            };
            let worth = (shared.iter().any(is_preferred), gain);
            let is_better = match &best {
                None => true,
                Some((known, factors)) => worth > *known || worth == *known && shared < *factors,
            };
            if is_better {
                best = Some((worth, shared));
            }
        }
    }
    best.map(|(_, shared)| shared)
}

/// What it saves to write a factor once less. A length alone is left in two terms, and pulled out of three; sines are a
/// little less than that.
fn weight((factor, exponent): &(Factor, i32), prefer: Prefer, angles: &[Angle]) -> usize {
    match factor {
        Factor::Trig(..) if prefer == Prefer::Sines && *exponent == 1 => factor.length(),
        Factor::Trig(..) if prefer == Prefer::Squares && *exponent == 2 => factor.length() + 1,
        Factor::Trig(angle, _) if !angles.contains(angle) => 2,
        Factor::Symbol(rank, _) if *rank > WEIGHTY => 3,
        _ => 4,
    }
}
