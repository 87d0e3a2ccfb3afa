//! Sums and products, flattened, and what they have in common computed once.
//!
//! A trace is first read as sums of products: chains that nobody else reads are merged, like terms are
//! gathered, and what cancels is gone. Then, round by round, the pairs whose sharing saves most become values
//! of their own: a product of two atoms, a multiple of one, a sum of two terms up to a common factor (which
//! also factors `a·b + a·c`). Coefficients are exact; two are merged only if they are equal.
//!
//! Greedy extraction of common pairs goes back to M. Breuer, *Generation of optimal code for expressions via
//! factorization*, CACM 1969.

mod candidates;
mod terms;

use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op};
use terms::{Atom, Coefficient, Definitions, ONE, Term};

/// A program with more terms than this is flattened but not searched: the search would not pay for its time.
const LARGEST_SEARCH: usize = 5_000;
/// How often the best pairs are looked for.
const ROUNDS: usize = 60;

/// Equal expressions with fewer operations; `is_leaf` are the nodes that cost nothing.
pub fn share<'g>(graph: &'g Graph, results: &[Expr<'g>], is_leaf: impl Fn(NodeId) -> bool) -> Vec<Expr<'g>> {
    let mut flat = Flattened::of(graph, results, &is_leaf);
    flat.merge_single_uses();
    if flat.definitions.number_of_terms() <= LARGEST_SEARCH {
        for _ in 0..ROUNDS {
            if !flat.extract_best() {
                break;
            }
            flat.merge_single_uses();
        }
    }
    flat.rebuild(results)
}

/// A graph as definitions of atoms by sums of products.
struct Flattened<'g> {
    graph: &'g Graph,
    definitions: Definitions,
    /// What each atom stands for; those that come later were extracted.
    origins: Vec<Origin>,
    atoms: NodeMap<Atom>,
    /// The atoms that results and opaque operations read: those keep their own value.
    pinned: Vec<Atom>,
}

/// What an atom stands for.
struct Origin {
    node: NodeId,
    is_read: bool,
    /// Whether it is computed otherwise: a quotient, a root, a sine.
    is_opaque: bool,
}

impl<'g> Flattened<'g> {
    fn of(graph: &'g Graph, results: &[Expr<'g>], is_leaf: &impl Fn(NodeId) -> bool) -> Self {
        let uses = count_uses(graph, results, is_leaf);
        let mut flat = Self {
            graph,
            definitions: Definitions::new(),
            origins: Vec::new(),
            atoms: NodeMap::new(graph),
            pinned: Vec::new(),
        };
        let mut waiting: Vec<Atom> = Vec::new();
        for result in results {
            if let Expr::Node { id, .. } = *result {
                flat.pin(id, &mut waiting);
            }
        }
        while let Some(atom) = waiting.pop() {
            let origin = &mut flat.origins[atom.index()];
            let id = origin.node;
            if std::mem::replace(&mut origin.is_read, true) || is_leaf(id) {
                continue;
            }
            match graph.op(id) {
                Op::Constant(_) | Op::Symbol(_) => {}
                Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Scale(..) => {
                    let terms = flat.terms_of(id, &uses, is_leaf);
                    for term in &terms {
                        waiting.extend_from_slice(flat.definitions.atoms(term.monomial));
                    }
                    flat.definitions.define(atom, terms);
                }
                op => {
                    flat.origins[atom.index()].is_opaque = true;
                    for operand in op.operands() {
                        flat.pin(operand, &mut waiting);
                    }
                }
            }
        }
        flat
    }

    /// The atom of a node, made if it is new.
    fn atom(&mut self, id: NodeId) -> Atom {
        if let Some(&known) = self.atoms.get(id) {
            return known;
        }
        let atom = self.definitions.new_atom();
        self.origins.push(Origin { node: id, is_read: false, is_opaque: false });
        self.atoms.insert(id, atom);
        atom
    }

    fn pin(&mut self, id: NodeId, waiting: &mut Vec<Atom>) {
        let atom = self.atom(id);
        self.pinned.push(atom);
        waiting.push(atom);
    }

    /// The terms of a sum or product, through operands that nobody else reads.
    fn terms_of(
        &mut self,
        root: NodeId,
        uses: &NodeMap<usize>,
        is_leaf: &impl Fn(NodeId) -> bool,
    ) -> Vec<Term> {
        let mut terms = Vec::new();
        let mut stack = vec![(root, false)];
        while let Some((id, negative)) = stack.pop() {
            let inside = id == root || (uses[id] == 1 && !is_leaf(id));
            match self.graph.op(id) {
                Op::Add(a, b) if inside => stack.extend([(b, negative), (a, negative)]),
                Op::Sub(a, b) if inside => stack.extend([(b, !negative), (a, negative)]),
                _ => {
                    let mut term = self.product_of(id, inside, uses, is_leaf);
                    if negative {
                        term.coefficient = -term.coefficient;
                    }
                    self.definitions.add_term(&mut terms, term);
                }
            }
        }
        terms
    }

    fn product_of(
        &mut self,
        root: NodeId,
        inside: bool,
        uses: &NodeMap<usize>,
        is_leaf: &impl Fn(NodeId) -> bool,
    ) -> Term {
        let (mut coefficient, mut atoms) = (ONE, Vec::new());
        let mut stack = vec![(root, inside)];
        while let Some((id, inside)) = stack.pop() {
            let enters = |x: NodeId| (x, uses[x] == 1 && !is_leaf(x));
            match self.graph.op(id) {
                Op::Mul(a, b) if inside => stack.extend([enters(a), enters(b)]),
                Op::Scale(k, a) if inside => {
                    let value = self.definitions.coefficient(self.graph.number(k));
                    coefficient = self.definitions.product(coefficient, value);
                    stack.push(enters(a));
                }
                Op::Constant(k) => {
                    let value = self.definitions.coefficient(self.graph.number(k));
                    coefficient = self.definitions.product(coefficient, value);
                }
                _ => atoms.push(self.atom(id)),
            }
        }
        Term { coefficient, monomial: self.definitions.monomial(atoms) }
    }

    /// Writes a definition that is read once into its reader.
    fn merge_single_uses(&mut self) {
        loop {
            let mut uses = self.definitions.count_uses();
            for atom in &self.pinned {
                uses[atom.index()] += 2;
            }
            let mut changed = false;
            for atom in self.definitions.order() {
                changed |= self.definitions.merge_into(atom, &uses);
            }
            if !changed {
                return;
            }
        }
    }

    /// Extracts a batch of the pairs that save most; says whether there was one.
    fn extract_best(&mut self) -> bool {
        let candidates = candidates::find(&mut self.definitions);
        let Some(best) = candidates.first().map(|candidate| candidate.saves) else { return false };
        let mut touched = vec![false; self.definitions.len()];
        for candidate in &candidates {
            if 2 * candidate.saves < best {
                break;
            }
            let readers = candidate.readers();
            if readers.iter().any(|reader| touched.get(reader.index()).copied().unwrap_or(true)) {
                continue;
            }
            candidate.apply(&mut self.definitions);
            for reader in readers {
                touched[reader.index()] = true;
            }
        }
        true
    }

    /// The results as expressions again.
    fn rebuild(&mut self, results: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut known: Vec<Option<Expr<'g>>> = vec![None; self.definitions.len()];
        let mut rebuilt = Vec::with_capacity(results.len());
        for result in results {
            rebuilt.push(match *result {
                Expr::Constant(_) => *result,
                Expr::Node { id, negative, .. } => {
                    let value = self.expression(self.atoms[id], &mut known);
                    if negative { -value } else { value }
                }
            });
        }
        rebuilt
    }

    /// The expression of an atom, operands first, without recursion.
    fn expression(&self, root: Atom, known: &mut [Option<Expr<'g>>]) -> Expr<'g> {
        let mut stack = vec![root];
        while let Some(&atom) = stack.last() {
            let waiting = stack.len();
            if known[atom.index()].is_some() {
                stack.pop();
                continue;
            }
            self.push_unknown(atom, known, &mut stack);
            if stack.len() == waiting {
                known[atom.index()] = Some(self.value(atom, known));
            }
        }
        value_of(root, known)
    }

    /// The atoms that an atom is made of and whose expressions are not known yet.
    fn push_unknown(&self, atom: Atom, known: &[Option<Expr<'g>>], stack: &mut Vec<Atom>) {
        let mut push = |atom: Atom| {
            if known[atom.index()].is_none() {
                stack.push(atom);
            }
        };
        if let Some(terms) = self.definitions.terms(atom) {
            for term in terms {
                for &atom in self.definitions.atoms(term.monomial) {
                    push(atom);
                }
            }
        } else if let Some(op) = self.opaque_op(atom) {
            for operand in op.operands() {
                push(self.atoms[operand]);
            }
        }
    }

    fn opaque_op(&self, atom: Atom) -> Option<Op> {
        let origin = self.origins.get(atom.index()).filter(|origin| origin.is_opaque)?;
        Some(self.graph.op(origin.node))
    }

    fn value(&self, atom: Atom, known: &[Option<Expr<'g>>]) -> Expr<'g> {
        if let Some(terms) = self.definitions.terms(atom) {
            let mut sum = Expr::ZERO;
            for first in [true, false] {
                for term in terms {
                    if term.coefficient.is_positive() == first {
                        sum = sum + self.term(term, known);
                    }
                }
            }
            return sum;
        }
        let of = |id: NodeId| value_of(self.atoms[id], known);
        match self.opaque_op(atom) {
            Some(Op::Div(a, b)) => of(a) / of(b),
            Some(Op::Sin(a)) => of(a).sin(),
            Some(Op::Cos(a)) => of(a).cos(),
            Some(Op::Sqrt(a)) => of(a).sqrt().expect("a root that was made before"),
            Some(Op::Opaque(a)) => of(a).opaque(),
            _ => Expr::of_node(self.graph, self.origins[atom.index()].node),
        }
    }

    fn term(&self, term: &Term, known: &[Option<Expr<'g>>]) -> Expr<'g> {
        let atoms = self.definitions.atoms(term.monomial).iter();
        let product = atoms.map(|&atom| value_of(atom, known)).reduce(|a, b| a * b);
        let value = Expr::Constant(self.definitions.value(term.coefficient));
        product.map_or(value, |product| value * product)
    }
}

fn value_of<'g>(atom: Atom, known: &[Option<Expr<'g>>]) -> Expr<'g> {
    known[atom.index()].expect("operands are known before what is made of them")
}

/// How often live nodes read each other; results count twice, so that they keep their own value.
fn count_uses(graph: &Graph, results: &[Expr<'_>], is_leaf: &impl Fn(NodeId) -> bool) -> NodeMap<usize> {
    let mut uses = NodeMap::new(graph);
    let mut stack = Vec::new();
    let mut read = |id: NodeId, times: usize, stack: &mut Vec<NodeId>| match uses.get_mut(id) {
        Some(count) => *count += times,
        None => {
            uses.insert(id, times);
            if !is_leaf(id) {
                stack.push(id);
            }
        }
    };
    for result in results {
        if let Expr::Node { id, .. } = *result {
            read(id, 2, &mut stack);
        }
    }
    while let Some(id) = stack.pop() {
        let op = graph.op(id);
        let times = if matches!(op, Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Scale(..)) { 1 } else { 2 };
        for operand in op.operands() {
            read(operand, times, &mut stack);
        }
    }
    uses
}

/// What a term costs: its multiplications.
fn cost(atoms: usize, coefficient: Coefficient) -> i64 {
    let factors = atoms as i64 + i64::from(!coefficient.is_unit());
    (factors - 1).max(0)
}
