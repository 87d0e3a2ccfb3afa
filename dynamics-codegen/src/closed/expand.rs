//! Expressions multiplied out: each node of a graph as a polynomial, sines of sums as products of sines.

use super::Notation;
use super::monomial::Monomial;
use super::polynomial::Polynomial;
use super::ring::{Result, Ring, Swelling, Variable};
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Number, Op, SymbolId, Walk};

/// Angles are taken this many times at most; beyond, the multiple is an angle of its own.
const MULTIPLES: i64 = 8;

/// Nodes that have names.
pub(super) type Cuts = NodeMap<SymbolId>;

/// What is known of the nodes of a graph.
pub(super) struct Expansion<'g> {
    graph: &'g Graph,
    pub(super) ring: Ring,
    known: NodeMap<Polynomial>,
    /// For each angle, a monomial, the part of it that all angles are multiples of.
    units: Vec<(Monomial, Number)>,
}

impl<'g> Expansion<'g> {
    /// The expansion of nothing yet, for these expressions, with so much work.
    pub(super) fn new(
        graph: &'g Graph,
        notation: &Notation,
        exprs: &[Expr<'g>],
        work: usize,
    ) -> Result<Self> {
        Self::between(graph, notation, exprs, &NodeMap::new(graph), work)
    }

    /// The same where some nodes have names, and are not looked into.
    pub(super) fn between(
        graph: &'g Graph,
        notation: &Notation,
        exprs: &[Expr<'g>],
        cuts: &Cuts,
        work: usize,
    ) -> Result<Self> {
        let Used { mut symbols, arguments, named } = used(graph, exprs, cuts);
        symbols.extend(named.iter().map(|&id| cuts[id]));
        symbols.sort_unstable();
        symbols.dedup();
        let ring = Ring::new(notation, &symbols, work)?;
        let mut expansion = Self { graph, ring, known: NodeMap::new(graph), units: vec![] };
        for id in named {
            let place = expansion.ring.variable(Variable::Symbol(cuts[id]))?;
            expansion.known.insert(id, Ring::polynomial(place));
        }
        let mut angles = Vec::with_capacity(arguments.len());
        for &argument in &arguments {
            angles.push(expansion.node(argument)?);
        }
        for angle in &angles {
            expansion.learn_unit(angle);
        }
        expansion.learn_angles(&angles)?;
        Ok(expansion)
    }

    /// The polynomial of an expression.
    pub(super) fn polynomial(&mut self, expr: Expr<'g>) -> Result<Polynomial> {
        match expr {
            Expr::Constant(value) if value.is_finite() => Ok(Ring::number(value)),
            Expr::Constant(_) => Err(Swelling),
            Expr::Node { id, negative, .. } => {
                let polynomial = self.node(id)?;
                Ok(if negative { polynomial.scaled(-Number::ONE) } else { polynomial })
            }
        }
    }

    fn node(&mut self, root: NodeId) -> Result<Polynomial> {
        let mut walk = Walk::to(root);
        while let Some(id) = walk.next(self.graph, |x| self.known.contains(x)) {
            let polynomial = self.apply(self.graph.op(id))?;
            self.known.insert(id, polynomial);
        }
        Ok(self.known[root].clone())
    }

    fn apply(&mut self, op: Op) -> Result<Polynomial> {
        let Self { graph, ring, known, .. } = self;
        Ok(match op {
            Op::Constant(k) => Ring::number(graph.number(k)),
            Op::Symbol(symbol) => Ring::polynomial(ring.variable(Variable::Symbol(symbol))?),
            Op::Add(a, b) => known[a].plus(Number::ONE, &known[b]),
            Op::Sub(a, b) => known[a].plus(-Number::ONE, &known[b]),
            Op::Mul(a, b) => ring.product(&known[a], &known[b])?,
            Op::Scale(k, a) => ring.product(&Ring::number(graph.number(k)), &known[a])?,
            Op::Div(a, b) => {
                let inverse = ring.inverse(&known[b])?.ok_or(Swelling)?;
                ring.product(&known[a], &inverse)?
            }
            Op::Sqrt(a) => ring.root(&known[a])?,
            Op::Opaque(a) => known[a].clone(),
            Op::Sin(a) => {
                let angle = known[a].clone();
                self.sine_and_cosine(&angle)?.0
            }
            Op::Cos(a) => {
                let angle = known[a].clone();
                self.sine_and_cosine(&angle)?.1
            }
        })
    }

    /// Makes the unit of each angle in a sum a part of what it was.
    fn learn_unit(&mut self, angle: &Polynomial) {
        for &(monomial, coefficient) in angle.terms() {
            let Number::Exact(exact) = coefficient else { continue };
            if !exact.is_rational() {
                continue;
            }
            let part = Number::parse_decimal(&exact.denominator().to_string());
            let Some(part) = part.filter(|_| exact.denominator() <= i128::from(MULTIPLES)) else { continue };
            match self.units.iter_mut().find(|(known, _)| *known == monomial) {
                // The parts of both, at least; a finer one does no harm.
                Some((_, unit)) if whole(Number::ONE / (*unit * part)).is_none() => *unit = *unit / part,
                Some(_) => {}
                None => self.units.push((monomial, Number::ONE / part)),
            }
        }
    }

    /// Makes the sines of all angles variables, in an order that does not depend on where they are met.
    fn learn_angles(&mut self, angles: &[Polynomial]) -> Result<()> {
        let mut monomials: Vec<Monomial> =
            angles.iter().flat_map(|angle| angle.terms().iter().map(|(monomial, _)| *monomial)).collect();
        monomials.sort_unstable();
        monomials.dedup();
        // The first symbols order last as monomials.
        for monomial in monomials.into_iter().rev() {
            if let Some(&(_, unit)) = self.units.iter().find(|(known, _)| *known == monomial)
                && !self.is_constant(monomial)
            {
                self.ring.angle(&Polynomial::term(monomial, unit))?;
            }
        }
        Ok(())
    }

    /// Whether a monomial has powers of π alone.
    fn is_constant(&self, monomial: Monomial) -> bool {
        monomial.with(0, 0) == Monomial::ONE
    }

    /// The sine and the cosine of a sum of angles.
    fn sine_and_cosine(&mut self, angle: &Polynomial) -> Result<(Polynomial, Polynomial)> {
        let (mut sin, mut cos) = (Polynomial::zero(), Polynomial::one());
        for &(monomial, coefficient) in angle.terms().iter().rev() {
            let (s, c) = if self.is_constant(monomial) {
                let power = monomial.exponent(0);
                let unit = if power > 0 { Number::PI } else { Number::ONE / Number::PI };
                let value = (0..power.abs()).fold(coefficient, |value, _| value * unit);
                (Ring::number(value.sin()), Ring::number(value.cos()))
            } else {
                self.multiple(monomial, coefficient)?
            };
            let ring = &mut self.ring;
            let (ss, cc) = (ring.product(&sin, &s)?, ring.product(&cos, &c)?);
            let (sc, cs) = (ring.product(&sin, &c)?, ring.product(&cos, &s)?);
            (sin, cos) = (sc.plus(Number::ONE, &cs), cc.plus(-Number::ONE, &ss));
        }
        Ok((sin, cos))
    }

    /// The sine and the cosine of a multiple of an angle.
    fn multiple(&mut self, monomial: Monomial, coefficient: Number) -> Result<(Polynomial, Polynomial)> {
        let unit =
            self.units.iter().find(|(known, _)| *known == monomial).map_or(Number::ONE, |(_, unit)| *unit);
        let (unit, times) = match whole(coefficient / unit).filter(|times| times.abs() <= MULTIPLES) {
            Some(times) => (unit, times),
            None => (coefficient.abs(), if coefficient.is_negative() { -1 } else { 1 }),
        };
        let [sin, cos] = self.ring.angle(&Polynomial::term(monomial, unit))?;
        let (s, c) = (Ring::polynomial(sin), Ring::polynomial(cos));
        let (mut sin, mut cos) = (Polynomial::zero(), Polynomial::one());
        for _ in 0..times.abs() {
            let ring = &mut self.ring;
            let (sc, cs) = (ring.product(&sin, &c)?, ring.product(&cos, &s)?);
            let (cc, ss) = (ring.product(&cos, &c)?, ring.product(&sin, &s)?);
            (sin, cos) = (sc.plus(Number::ONE, &cs), cc.plus(-Number::ONE, &ss));
        }
        Ok((if times < 0 { sin.scaled(-Number::ONE) } else { sin }, cos))
    }
}

/// A whole number, if it is a small one.
fn whole(value: Number) -> Option<i64> {
    match value {
        Number::Exact(exact) if exact.denominator() == 1 && exact.is_rational() => {
            i64::try_from(exact.numerator()).ok()
        }
        _ => None,
    }
}

/// What expressions use.
struct Used {
    symbols: Vec<SymbolId>,
    /// The arguments of their sines and cosines.
    arguments: Vec<NodeId>,
    /// The nodes with names.
    named: Vec<NodeId>,
}

fn used(graph: &Graph, exprs: &[Expr<'_>], cuts: &Cuts) -> Used {
    let mut used = Used { symbols: vec![], arguments: vec![], named: vec![] };
    let mut seen = NodeMap::new(graph);
    let mut stack: Vec<NodeId> = Vec::new();
    for expr in exprs {
        if let Expr::Node { id, .. } = *expr {
            stack.push(id);
        }
    }
    while let Some(id) = stack.pop() {
        if seen.contains(id) {
            continue;
        }
        seen.insert(id, ());
        if cuts.contains(id) {
            used.named.push(id);
            continue;
        }
        let op = graph.op(id);
        match op {
            Op::Symbol(symbol) => used.symbols.push(symbol),
            Op::Sin(argument) | Op::Cos(argument) => used.arguments.push(argument),
            _ => {}
        }
        stack.extend(op.operands());
    }
    used.arguments.sort_unstable();
    used.arguments.dedup();
    used.named.sort_unstable();
    used
}
