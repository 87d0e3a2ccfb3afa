//! Terms on the way to paper: a number times factors, in the order in which these are written.

use super::notation::{Notation, Role};
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
    /// A speed, or what else the motion has.
    Moving(SymbolId),
}

impl Factor {
    /// The factor of a symbol.
    pub(super) fn symbol(symbol: SymbolId, notation: &Notation) -> Self {
        let letter = notation.letter(symbol);
        match letter.role {
            Role::Parameter | Role::Intermediate => Self::Symbol(letter.rank, symbol),
            Role::Coordinate => Self::Symbol(u8::MAX, symbol),
            Role::Speed | Role::Acceleration | Role::Force => Self::Moving(symbol),
        }
    }

    /// How long it is on paper, a symbol being 4.
    pub(super) fn length(&self) -> usize {
        match self {
            Self::Pi | Self::Symbol(..) | Self::Moving(_) => 4,
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
        matches!(self, Self::Moving(_))
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

/// What writes factors.
pub(super) struct Writer<'a> {
    pub(super) notation: &'a Notation,
    pub(super) ring: &'a Ring,
    /// The places of the ring's angles: sine and cosine.
    pub(super) angles: Vec<[usize; 2]>,
    /// The forms of roots and of what divides.
    pub(super) others: Vec<(usize, Form)>,
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
            match variable {
                Variable::Root(inner) => {
                    let form = writer.form(inner).root();
                    writer.others.push((place, form));
                }
                Variable::Inverse(inner) => {
                    let form = writer.form(inner);
                    writer.others.push((place, form));
                }
                _ => {}
            }
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

    /// How an item is written: what divides stands below.
    pub(super) fn item(&self, item: &Item) -> Form {
        self.product(item.coefficient, &item.factors, vec![])
    }

    /// A number times factors times other forms, which stand where factors of their kind would: `(place, form)` is
    /// before the factor with that place.
    pub(super) fn product(
        &self,
        coefficient: Number,
        factors: &[(Factor, i32)],
        others: Vec<(usize, Form)>,
    ) -> Form {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut others = others.into_iter().peekable();
        for k in 0..=factors.len() {
            while let Some((_, form)) = others.next_if(|(place, _)| *place <= k) {
                above.push(form);
            }
            let Some((factor, exponent)) = factors.get(k) else { continue };
            let form = self.form_of_factor(factor);
            let is_inverse = matches!(factor, Factor::Other(place) if matches!(self.ring.variables()[*place], Variable::Inverse(_)));
            let power = form.power(exponent.unsigned_abs());
            if (*exponent < 0) != is_inverse { below.push(power) } else { above.push(power) }
        }
        above.extend(others.map(|(_, form)| form));
        let magnitude = coefficient.abs();
        let (num, den) = match magnitude {
            Number::Exact(exact) if is_below(exact.numerator(), exact.denominator()) && !above.is_empty() => {
                let whole = |value: i128| Number::parse_decimal(&value.to_string()).unwrap_or(Number::ONE);
                (whole(exact.numerator()), whole(exact.denominator()))
            }
            _ => (magnitude, Number::ONE),
        };
        below.insert(0, Form::Number(den));
        let below = Form::product(below);
        let number = Form::number(num);
        let form = if below.is_one() {
            Form::product(std::iter::once(number).chain(above))
        } else {
            // What divides stands below what the body is, and not below brackets, sines and speeds.
            let is_short = |form: &Form| match form {
                Form::Power(base, _) => matches!(**base, Form::Symbol(_)) && !self.is_moving(base),
                form => matches!(form, Form::Symbol(_) | Form::Number(_)) && !self.is_moving(form),
            };
            let divided = above.iter().take_while(|form| is_short(form)).count();
            let divided = if divided == 0 && num.is_one() { above.len() } else { divided };
            let rest = above.split_off(divided);
            let quotient = Form::product(std::iter::once(number).chain(above)).over(below);
            Form::product(std::iter::once(quotient).chain(rest))
        };
        if coefficient.is_negative() { form.negative() } else { form }
    }

    fn is_moving(&self, form: &Form) -> bool {
        matches!(form, Form::Symbol(symbol) if self.notation.letter(*symbol).role > Role::Coordinate)
    }

    fn form_of_factor(&self, factor: &Factor) -> Form {
        match factor {
            Factor::Pi => Form::Number(Number::PI),
            Factor::Symbol(_, symbol) | Factor::Moving(symbol) => Form::Symbol(*symbol),
            Factor::Other(place) => match self.others.iter().find(|(known, _)| known == place) {
                Some((_, form)) => form.clone(),
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
                let mut item = Item { coefficient: *coefficient, factors: vec![] };
                for (place, exponent) in monomial.exponents() {
                    item.multiply(self.factor(place), exponent);
                }
                item
            })
            .collect();
        items.sort_by(|a, b| {
            (a.coefficient.is_negative(), &a.factors).cmp(&(b.coefficient.is_negative(), &b.factors))
        });
        Form::sum(items.iter().map(|item| self.item(item)))
    }
}

/// Whether a coefficient is written as a fraction with the denominator below: thirds and the like, with small numbers.
fn is_below(num: i128, den: i128) -> bool {
    let mut rest = den >> den.trailing_zeros();
    while rest % 5 == 0 {
        rest /= 5;
    }
    let is_decimal = rest == 1;
    let is_half = den == 2 || den == 4 && num != 1;
    den > 1 && !is_half && (!is_decimal || den <= 32 && num == 1 && den.count_ones() == 1)
}
