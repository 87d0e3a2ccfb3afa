//! Terms on the way to paper: a number times factors, in the order in which these are written.

use super::monomial::Monomial;
use super::notation::{Notation, Role};
use super::quotient::Other;
use super::ring::{Ring, Variable};
use super::{Form, Polynomial};
use crate::symbolic::{Number, SymbolId};

/// A sum of multiples of the ring's angles, by their places among these, in order.
pub(super) type Angle = Vec<(usize, i32)>;

/// A factor, in the order of a textbook: numbers, masses, what weighs, lengths, coordinates, sines, speeds.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factor {
    /// π
    Pi,
    /// A symbol, after those of smaller rank.
    Symbol(u8, SymbolId),
    /// A root, what divides, or a sine in an angle, by its place in the ring.
    Other(usize),
    /// The sine or, if so, the cosine of an angle.
    Trig(Angle, bool),
    /// A speed, or what else the motion has; accelerations before speeds.
    Moving(u8, SymbolId),
}

impl Factor {
    /// The factor of a symbol.
    pub(super) fn symbol(symbol: SymbolId, notation: &Notation) -> Self {
        let letter = notation.letter(symbol);
        match letter.role {
            Role::Parameter | Role::Intermediate => Self::Symbol(letter.rank, symbol),
            Role::Coordinate => Self::Symbol(u8::MAX, symbol),
            Role::Acceleration => Self::Moving(0, symbol),
            Role::Speed => Self::Moving(1, symbol),
            Role::Force => Self::Moving(2, symbol),
        }
    }

    /// How long it is on paper, a symbol being 4.
    pub(super) fn length(&self) -> usize {
        match self {
            Self::Pi | Self::Symbol(..) | Self::Moving(..) => 4,
            Self::Other(_) => 12,
            Self::Trig(angle, _) => {
                let multiples = angle.iter().filter(|(_, times)| *times != 1).count();
                4 + 4 * angle.len() + 2 * multiples
            }
        }
    }

    /// Whether it is a sine or a cosine.
    pub(super) fn is_trig(&self) -> bool {
        matches!(self, Self::Trig(..))
    }

    /// Whether it moves.
    pub(super) fn is_moving(&self) -> bool {
        matches!(self, Self::Moving(..))
    }

    /// Whether it is one with the body's parameters alone.
    pub(super) fn is_parameter(&self) -> bool {
        matches!(self, Self::Pi) || matches!(self, Self::Symbol(rank, _) if *rank < u8::MAX)
    }
}

/// A number times powers of factors, these in order, none twice.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Item {
    pub(super) coefficient: Number,
    pub(super) factors: Vec<(Factor, i32)>,
}

impl Item {
    /// The exponent of a factor.
    pub(super) fn exponent(&self, factor: &Factor) -> i32 {
        self.factors.iter().find(|(known, _)| known == factor).map_or(0, |(_, exponent)| *exponent)
    }

    /// Whether there is a sine or a cosine among its factors.
    pub(super) fn has_sines(&self) -> bool {
        self.factors.iter().any(|(factor, _)| factor.is_trig())
    }

    /// Whether its factors are parameters alone.
    pub(super) fn is_of_parameters(&self) -> bool {
        self.factors.iter().all(|(factor, _)| factor.is_parameter())
    }

    /// The product with another factor's power.
    pub(super) fn multiply(&mut self, factor: Factor, exponent: i32) {
        let place = self.factors.iter().position(|(known, _)| *known >= factor);
        match place {
            Some(place) if self.factors[place].0 == factor => {
                self.factors[place].1 += exponent;
                if self.factors[place].1 == 0 {
                    self.factors.remove(place);
                }
            }
            Some(place) => self.factors.insert(place, (factor, exponent)),
            None => self.factors.push((factor, exponent)),
        }
    }
}

/// The powers of factors that all items have, the least of each, and the items without them.
pub(super) fn split_powers(mut items: Vec<Item>) -> (Vec<(Factor, i32)>, Vec<Item>) {
    let Some((first, others)) = items.split_first() else { return (vec![], items) };
    let least = |(factor, exponent): &(Factor, i32)| {
        let of_others = others.iter().map(|item| item.exponent(factor));
        (factor.clone(), of_others.fold(*exponent, i32::min))
    };
    let shared: Vec<_> = first.factors.iter().map(least).filter(|(_, least)| *least > 0).collect();
    for item in &mut items {
        for (factor, exponent) in &shared {
            item.multiply(factor.clone(), -exponent);
        }
    }
    (shared, items)
}

/// What writes factors.
pub(super) struct Writer<'a> {
    pub(super) notation: &'a Notation,
    pub(super) ring: &'a Ring,
    /// The places of the ring's angles: sine and cosine.
    pub(super) angles: Vec<[usize; 2]>,
    /// Roots and what divides.
    pub(super) others: Vec<Other>,
}

impl<'a> Writer<'a> {
    /// The writer for a ring.
    pub(super) fn new(notation: &'a Notation, ring: &'a Ring) -> Self {
        let mut angles = Vec::new();
        for (cos, variable) in ring.variables().iter().enumerate() {
            if let Variable::Cos(angle) = variable
                && let Some(sin) = ring.place(&Variable::Sin(angle.clone()))
            {
                angles.push([sin, cos]);
            }
        }
        let mut writer = Self { notation, ring, angles, others: vec![] };
        for (place, variable) in ring.variables().iter().enumerate() {
            let other = match variable {
                Variable::Root(inner) => Other::root(place, inner, &writer),
                Variable::Inverse(inner) => Other::below(place, inner, &writer),
                _ => continue,
            };
            writer.others.push(other);
        }
        writer
    }

    /// The factor of a variable that is no sine.
    pub(super) fn factor(&self, place: usize) -> Factor {
        match &self.ring.variables()[place] {
            Variable::Pi => Factor::Pi,
            Variable::Symbol(symbol) => Factor::symbol(*symbol, self.notation),
            _ => Factor::Other(place),
        }
    }

    /// A monomial without sines as a product of factors.
    pub(super) fn plain(&self, monomial: &Monomial) -> Item {
        let mut item = Item { coefficient: Number::ONE, factors: vec![] };
        for (place, exponent) in monomial.exponents() {
            item.multiply(self.factor(place), exponent);
        }
        self.tidy(item)
    }

    /// How an item is written: what divides stands below.
    pub(super) fn item(&self, item: &Item) -> Form {
        self.product(item.coefficient, &item.factors, vec![])
    }

    pub(super) fn form_of_factor(&self, factor: &Factor) -> Form {
        match factor {
            Factor::Pi => Form::Number(Number::PI),
            Factor::Symbol(_, symbol) | Factor::Moving(_, symbol) => Form::Symbol(*symbol),
            Factor::Other(place) => match self.others.iter().find(|other| other.place == *place) {
                Some(other) => other.form.clone(),
                None => self.form_of_variable(*place),
            },
            Factor::Trig(angle, is_cos) => {
                let angle = self.angle(angle);
                if *is_cos { angle.cos() } else { angle.sin() }
            }
        }
    }

    /// A variable as it is written by itself.
    fn form_of_variable(&self, place: usize) -> Form {
        match &self.ring.variables()[place] {
            Variable::Pi => Form::Number(Number::PI),
            Variable::Symbol(symbol) => Form::Symbol(*symbol),
            Variable::Sin(angle) => self.form(angle).sin(),
            Variable::Cos(angle) => self.form(angle).cos(),
            Variable::Root(inner) => self.form(inner).root(),
            Variable::Inverse(inner) => self.form(inner),
        }
    }

    /// A sum of multiples of angles.
    fn angle(&self, angle: &Angle) -> Form {
        let mut sum = Polynomial::zero();
        for &(place, times) in angle {
            if let Some(&[_, cos]) = self.angles.get(place)
                && let Variable::Cos(unit) = &self.ring.variables()[cos]
            {
                sum = sum.plus(Number::integer(times.into()), unit);
            }
        }
        let mut items: Vec<Item> = sum
            .terms()
            .iter()
            .map(|(monomial, coefficient)| {
                let mut item = self.plain(monomial);
                item.coefficient = item.coefficient * *coefficient;
                item
            })
            .collect();
        items.sort_by(|a, b| {
            (a.coefficient.is_negative(), &a.factors).cmp(&(b.coefficient.is_negative(), &b.factors))
        });
        Form::sum(items.iter().map(|item| self.item(item)))
    }
}
