//! Sums of products of atoms with exact coefficients.

use rustc_hash::FxHashMap;

use crate::symbolic::Number;

/// A value that products are made of: a node of the graph, or a value that was extracted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Atom(u32);

impl Atom {
    pub(super) fn of(index: usize) -> Self {
        Self(u32::try_from(index).expect("fewer than 2^32 atoms"))
    }

    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An exact coefficient: its sign and its place in the table of magnitudes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Coefficient(i32);

/// The coefficient one.
pub(super) const ONE: Coefficient = Coefficient(1);

impl Coefficient {
    /// The positive coefficient at a place of the table, from one on.
    pub(super) fn of(index: usize) -> Self {
        Self(i32::try_from(index).expect("fewer than 2^31 coefficients"))
    }

    /// The place of its magnitude in the table, from one on.
    pub(super) fn index(self) -> usize {
        self.0.unsigned_abs() as usize
    }

    pub(super) fn is_unit(self) -> bool {
        self.0.abs() == 1
    }

    pub(super) fn is_positive(self) -> bool {
        self.0 > 0
    }

    pub(super) fn magnitude(self) -> Self {
        Self(self.0.abs())
    }
}

impl std::ops::Neg for Coefficient {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// A product of atoms, by its place in the table; the first is the empty product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Monomial(u32);

impl Monomial {
    pub(super) const EMPTY: Self = Self(0);

    pub(super) fn of(index: usize) -> Self {
        Self(u32::try_from(index).expect("fewer than 2^32 products"))
    }

    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A coefficient times a product of atoms.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    pub(super) coefficient: Coefficient,
    pub(super) monomial: Monomial,
}

/// The definitions of atoms by sums of terms.
pub(super) struct Definitions {
    terms: Vec<Option<Vec<Term>>>,
    monomials: Vec<Box<[Atom]>>,
    monomial_index: FxHashMap<Box<[Atom]>, Monomial>,
    magnitudes: Vec<Number>,
    magnitude_index: FxHashMap<Number, i32>,
    products: FxHashMap<(Coefficient, Coefficient), Coefficient>,
    quotients: FxHashMap<(Coefficient, Coefficient), Coefficient>,
}

impl Definitions {
    /// No definitions.
    pub(super) fn new() -> Self {
        let empty: Box<[Atom]> = Box::new([]);
        Self {
            terms: Vec::new(),
            monomials: vec![empty.clone()],
            monomial_index: std::iter::once((empty, Monomial::EMPTY)).collect(),
            magnitudes: vec![Number::ONE],
            magnitude_index: std::iter::once((Number::ONE, 1)).collect(),
            products: FxHashMap::default(),
            quotients: FxHashMap::default(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    pub(super) fn terms(&self, atom: Atom) -> Option<&[Term]> {
        self.terms[atom.index()].as_deref()
    }

    /// An atom without a definition.
    pub(super) fn new_atom(&mut self) -> Atom {
        self.terms.push(None);
        Atom::of(self.terms.len() - 1)
    }

    pub(super) fn define(&mut self, atom: Atom, terms: Vec<Term>) {
        self.terms[atom.index()] = Some(terms);
    }

    /// A new atom with this definition.
    pub(super) fn extract(&mut self, terms: Vec<Term>) -> Atom {
        self.terms.push(Some(terms));
        Atom::of(self.terms.len() - 1)
    }

    /// The atoms that are defined, in order.
    pub(super) fn order(&self) -> Vec<Atom> {
        let defined = self.terms.iter().enumerate().filter(|(_, terms)| terms.is_some());
        defined.map(|(index, _)| Atom::of(index)).collect()
    }

    pub(super) fn number_of_terms(&self) -> usize {
        self.terms.iter().flatten().map(Vec::len).sum()
    }

    pub(super) fn atoms(&self, monomial: Monomial) -> &[Atom] {
        &self.monomials[monomial.index()]
    }

    /// The product of atoms.
    pub(super) fn monomial(&mut self, mut atoms: Vec<Atom>) -> Monomial {
        atoms.sort_unstable();
        if let Some(&known) = self.monomial_index.get(atoms.as_slice()) {
            return known;
        }
        let monomial = Monomial::of(self.monomials.len());
        let atoms = atoms.into_boxed_slice();
        self.monomials.push(atoms.clone());
        self.monomial_index.insert(atoms, monomial);
        monomial
    }

    /// `a·b`
    pub(super) fn times(&mut self, a: Monomial, b: Monomial) -> Monomial {
        let atoms = self.atoms(a).iter().chain(self.atoms(b)).copied().collect();
        self.monomial(atoms)
    }

    /// `a/b`, whose atoms are among those of `a`.
    pub(super) fn without(&mut self, a: Monomial, b: Monomial) -> Monomial {
        let mut rest = self.atoms(a).to_vec();
        for atom in self.atoms(b) {
            if let Some(place) = rest.iter().position(|x| x == atom) {
                rest.remove(place);
            }
        }
        self.monomial(rest)
    }

    /// The atoms that both products have.
    pub(super) fn common(&mut self, a: Monomial, b: Monomial) -> Monomial {
        let (x, y) = (self.atoms(a), self.atoms(b));
        let (mut i, mut j) = (0, 0);
        let mut common = Vec::new();
        while i < x.len() && j < y.len() {
            let (a, b) = (x[i].index(), y[j].index());
            if a == b {
                common.push(x[i]);
            }
            i += usize::from(a <= b);
            j += usize::from(b <= a);
        }
        if common.is_empty() { Monomial::EMPTY } else { self.monomial(common) }
    }

    /// The coefficient of a value other than zero.
    pub(super) fn coefficient(&mut self, value: Number) -> Coefficient {
        let magnitude = value.abs();
        let next = i32::try_from(self.magnitudes.len() + 1).expect("fewer than 2^31 coefficients");
        let index = *self.magnitude_index.entry(magnitude).or_insert(next);
        if index == next {
            self.magnitudes.push(magnitude);
        }
        Coefficient(if value.is_negative() { -index } else { index })
    }

    pub(super) fn value(&self, coefficient: Coefficient) -> Number {
        let magnitude = self.magnitudes[coefficient.index() - 1];
        if coefficient.is_positive() { magnitude } else { -magnitude }
    }

    pub(super) fn product(&mut self, a: Coefficient, b: Coefficient) -> Coefficient {
        if a.is_unit() {
            return Coefficient(a.0 * b.0);
        }
        if b.is_unit() {
            return Coefficient(a.0 * b.0);
        }
        if let Some(&known) = self.products.get(&(a, b)) {
            return known;
        }
        let product = self.coefficient(self.value(a) * self.value(b));
        self.products.insert((a, b), product);
        product
    }

    pub(super) fn quotient(&mut self, a: Coefficient, b: Coefficient) -> Coefficient {
        if b.is_unit() {
            return Coefficient(a.0 * b.0);
        }
        if a.magnitude() == b.magnitude() {
            return Coefficient(a.0.signum() * b.0.signum());
        }
        if let Some(&known) = self.quotients.get(&(a, b)) {
            return known;
        }
        let quotient = self.value(a).checked_div(self.value(b)).expect("coefficients are not zero");
        let quotient = self.coefficient(quotient);
        self.quotients.insert((a, b), quotient);
        quotient
    }

    /// Adds a term to a sum, gathering like terms.
    pub(super) fn add_term(&mut self, terms: &mut Vec<Term>, term: Term) {
        let Some(place) = terms.iter().position(|known| known.monomial == term.monomial) else {
            terms.push(term);
            return;
        };
        let sum = self.value(terms[place].coefficient) + self.value(term.coefficient);
        if sum.is_zero() {
            terms.remove(place);
        } else {
            terms[place].coefficient = self.coefficient(sum);
        }
    }

    /// How often each atom occurs in products.
    pub(super) fn count_uses(&self) -> Vec<u32> {
        let mut uses = vec![0; self.terms.len()];
        for terms in &self.terms {
            let Some(terms) = terms else { continue };
            for term in terms {
                for atom in self.atoms(term.monomial) {
                    uses[atom.index()] += 1;
                }
            }
        }
        uses
    }

    /// Replaces atoms of `reader`'s definition that nobody else reads by their own definitions, where that
    /// keeps a sum of products. Says whether anything changed.
    pub(super) fn merge_into(&mut self, reader: Atom, uses: &[u32]) -> bool {
        let Some(terms) = self.terms(reader) else { return false };
        if !terms.iter().any(|term| self.mergeable(*term, uses).is_some()) {
            return false;
        }
        let terms = terms.to_vec();
        let mut merged = Vec::with_capacity(terms.len());
        for term in terms {
            match self.mergeable(term, uses) {
                None => self.add_term(&mut merged, term),
                Some(atom) => {
                    let inner = self.terms[atom.index()].take().expect("a mergeable atom is defined");
                    let single = self.monomial(vec![atom]);
                    let rest = self.without(term.monomial, single);
                    for part in inner {
                        let coefficient = self.product(term.coefficient, part.coefficient);
                        let monomial = self.times(rest, part.monomial);
                        self.add_term(&mut merged, Term { coefficient, monomial });
                    }
                }
            }
        }
        self.terms[reader.index()] = Some(merged);
        true
    }

    fn mergeable(&self, term: Term, uses: &[u32]) -> Option<Atom> {
        let atoms = self.atoms(term.monomial);
        for &atom in atoms {
            if uses[atom.index()] != 1 {
                continue;
            }
            let is_sum_alone = atoms.len() == 1 && term.coefficient.is_unit();
            if self.terms(atom).is_some_and(|terms| terms.len() == 1 || is_sum_alone) {
                return Some(atom);
            }
        }
        None
    }
}
