//! Sums that are products or squares: `(a + b)²`, `(a + b) (a + c)`, `½ ((x − y)² + (y − z)²)`, `(√s − l)²`.
//!
//! A sum that is a quadratic polynomial in one of its symbols is a product if its discriminant is a square. That is tried for
//! short sums with the square of a symbol by itself, and no others; a difference of two squares stays as it is.

use super::Form;
use super::item::{Factor, Item, Writer};
use super::ring::Variable;
use crate::symbolic::Number;

/// Longer sums are not looked at.
const ITEMS: usize = 12;

/// A sum of items, none of which has the factors of another.
type Sum = Vec<Item>;

impl Writer<'_> {
    /// A number, and the form that it is to be multiplied with for the sum of items; `None` of what is no product, and no
    /// sum of squares.
    pub(super) fn factored(&self, items: &[Item]) -> Option<(Number, Form)> {
        let is_exact = |item: &Item| matches!(item.coefficient, Number::Exact(_));
        if !(3..=ITEMS).contains(&items.len()) || !items.iter().all(is_exact) {
            return None;
        }
        let with_roots = self.with_squares_of_roots(items);
        let items = with_roots.as_deref().unwrap_or(items);
        let of_products = items.iter().filter_map(square_of).find_map(|x| product_of_sums(items, &x));
        if let Some((scale, [a, b])) = of_products {
            let form = match a == b {
                true => self.collected(leading(a)).power(2),
                false => Form::product([self.collected(a), self.collected(b)]),
            };
            return Some((scale, form));
        }
        self.sum_of_squares(items)
    }

    /// The items with the square of a root in place of what is below it, where all of that is there.
    fn with_squares_of_roots(&self, items: &[Item]) -> Option<Sum> {
        let roots = items.iter().flat_map(|item| &item.factors).filter_map(|(factor, exponent)| {
            let Factor::Other(place) = factor else { return None };
            let Variable::Root(square) = &self.ring.variables()[*place] else { return None };
            (*exponent == 1).then_some((factor, square))
        });
        for (root, square) in roots {
            let below = self.items(square);
            let Some(first) = below.first() else { continue };
            let Some(known) = items.iter().find(|item| item.factors == first.factors) else { continue };
            let times = known.coefficient / first.coefficient;
            let rest = times_number(&below, -times).into_iter().fold(items.to_vec(), with);
            if rest.len() + below.len() == items.len() {
                return Some(with(rest, Item { coefficient: times, factors: vec![(root.clone(), 2)] }));
            }
        }
        None
    }

    /// `Σ w (x ± y)² + Σ d x²` with one of the first for each product in the sum, and no `d` below zero.
    fn sum_of_squares(&self, items: &[Item]) -> Option<(Number, Form)> {
        let mut rest: Vec<(Factor, Number)> =
            items.iter().filter_map(|item| Some((square_of(item)?, item.coefficient))).collect();
        let products = items.iter().filter(|item| square_of(item).is_none());
        let mut squares = Vec::new();
        for item in products {
            let [(x, 1), (y, 1)] = &item.factors[..] else { return None };
            let weight = item.coefficient.abs() * Number::ratio(1, 2);
            for symbol in [x, y] {
                let (_, left) = rest.iter_mut().find(|(known, _)| known == symbol)?;
                *left = *left - weight;
            }
            let sign = if item.coefficient.is_negative() { -Number::ONE } else { Number::ONE };
            squares.push((weight, vec![single(x, Number::ONE), single(y, sign)]));
        }
        rest.retain(|(_, left)| !left.is_zero());
        let scale = squares.first()?.0;
        if rest.iter().any(|(_, left)| left.is_negative()) {
            return None;
        }
        squares.extend(rest.iter().map(|(x, left)| (*left, vec![single(x, Number::ONE)])));
        let terms = squares.into_iter().map(|(weight, sum)| {
            Form::product([Form::number(weight / scale), self.collected(leading(sum)).power(2)])
        });
        Some((scale, Form::sum(terms)))
    }
}

fn single(factor: &Factor, coefficient: Number) -> Item {
    Item { coefficient, factors: vec![(factor.clone(), 1)] }
}

/// The factor of which an item is the square, but for a number.
fn square_of(item: &Item) -> Option<Factor> {
    match &item.factors[..] {
        [(factor, 2)] => Some(factor.clone()),
        _ => None,
    }
}

/// A number and two sums whose product the items are; the square of `x` is in one of them, by itself.
fn product_of_sums(items: &[Item], x: &Factor) -> Option<(Number, [Sum; 2])> {
    let of_degree = |degree: i32| -> Sum {
        let of_degree = items.iter().filter(|item| item.exponent(x) == degree).cloned();
        let without = |mut item: Item| {
            item.factors.retain(|(factor, _)| factor != x);
            item
        };
        of_degree.map(without).collect()
    };
    let [square, linear, rest] = [2, 1, 0].map(of_degree);
    let [Item { coefficient: scale, ref factors }] = square[..] else { return None };
    let has_all = 1 + linear.len() + rest.len() == items.len() && factors.is_empty();
    if !has_all || linear.is_empty() || rest.is_empty() {
        return None;
    }
    // x² + 2p x + q = (x + p + √(p² − q)) (x + p − √(p² − q))
    let p = times_number(&linear, Number::ratio(1, 2) / scale);
    let q = times_number(&rest, Number::ONE / scale);
    let discriminant = times_number(&q, -Number::ONE).into_iter().fold(times(&p, &p), with);
    let shifted = with(p, single(x, Number::ONE));
    let root = root_of(discriminant)?;
    let sums = [Number::ONE, -Number::ONE]
        .map(|sign| times_number(&root, sign).into_iter().fold(shifted.clone(), with));
    Some((scale, sums))
}

/// The sum of which this is the square.
fn root_of(sum: Sum) -> Option<Sum> {
    let [item] = &sum[..] else {
        if sum.is_empty() {
            return Some(sum);
        }
        let (scale, [a, b]) = sum.iter().filter_map(square_of).find_map(|x| product_of_sums(&sum, &x))?;
        let scale = root_of_number(scale).filter(|_| a == b)?;
        return Some(times_number(&a, scale));
    };
    let coefficient = root_of_number(item.coefficient)?;
    let halves = item.factors.iter().map(|(factor, n)| (n % 2 == 0).then(|| (factor.clone(), n / 2)));
    Some(vec![Item { coefficient, factors: halves.collect::<Option<_>>()? }])
}

fn root_of_number(value: Number) -> Option<Number> {
    let root = if value.is_negative() { None } else { value.sqrt() };
    root.filter(|root| matches!(root, Number::Exact(exact) if exact.is_rational()))
}

/// The sum with an item more.
fn with(mut sum: Sum, item: Item) -> Sum {
    match sum.iter().position(|known| known.factors == item.factors) {
        Some(place) => {
            sum[place].coefficient = sum[place].coefficient + item.coefficient;
            if sum[place].coefficient.is_zero() {
                sum.remove(place);
            }
        }
        None => sum.push(item),
    }
    sum
}

fn times(a: &[Item], b: &[Item]) -> Sum {
    let mut product = Sum::new();
    for left in a {
        for right in b {
            let mut item = left.clone();
            item.coefficient = item.coefficient * right.coefficient;
            for (factor, exponent) in &right.factors {
                item.multiply(factor.clone(), *exponent);
            }
            product = with(product, item);
        }
    }
    product
}

fn times_number(sum: &[Item], k: Number) -> Sum {
    sum.iter().map(|item| Item { coefficient: item.coefficient * k, factors: item.factors.clone() }).collect()
}

/// A sum that is squared, with the sign that is read more easily: of a coordinate and a length the coordinate is first.
fn leading(sum: Sum) -> Sum {
    let is_parameter = |item: &Item| item.factors.iter().all(|(factor, _)| factor.is_parameter());
    match &sum[..] {
        [a, b] if a.coefficient.is_negative() != b.coefficient.is_negative() => {
            let (moving, fixed) = if is_parameter(a) { (b, a) } else { (a, b) };
            let turns = moving.coefficient.is_negative() && !is_parameter(moving) && is_parameter(fixed);
            if turns { times_number(&sum, -Number::ONE) } else { sum }
        }
        _ => sum,
    }
}
