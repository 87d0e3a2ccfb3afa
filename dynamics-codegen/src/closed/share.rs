//! Names for parts of expressions that are too long to be multiplied out: nodes of their graph that are used more than
//! once, and factors of products that would swell. Between the names everything is in normal form.

use super::close::Closed;
use super::expand::{Cuts, Expansion};
use super::item::Writer;
use super::ring::{Result, Swelling};
use super::{Form, Name, Notation, Role};
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op, SymbolId};

/// What has no more symbols than this is written each time.
const SHORT: usize = 3;

/// A product has so many terms at most, once it is multiplied out; its longer factors have names.
const PRODUCT: usize = 12;

/// A sum has so many terms at most.
const SUM: usize = 24;

/// The products of terms that are made for one definition at most.
const WORK: usize = 4_000;

/// How long the part of an expression is that stands between names.
#[derive(Clone, Copy)]
struct Size {
    symbols: usize,
    terms: usize,
}

/// The forms of expressions, with at most so many names for parts of them.
pub(super) fn shared<'g>(
    graph: &'g Graph,
    notation: &mut Notation,
    exprs: &[Expr<'g>],
    names: usize,
) -> Result<Closed> {
    let (order, uses) = live(graph, exprs);
    let mut sizes: NodeMap<Size> = NodeMap::new(graph);
    let mut cuts: Cuts = NodeMap::new(graph);
    let mut definitions: Vec<(SymbolId, Form)> = Vec::new();
    let mut letters = Letters { letter: free_letter(notation), count: 0 };
    for id in order {
        let op = graph.op(id);
        let mut operands: Vec<NodeId> = op.operands().collect();
        operands.sort_by_key(|&operand| std::cmp::Reverse(sizes[operand].terms));
        loop {
            let size = size_of(op, &sizes);
            let limit = if matches!(op, Op::Add(..) | Op::Sub(..)) { SUM } else { PRODUCT };
            let longest = operands.iter().copied().find(|&operand| sizes[operand].terms > 1);
            let (true, Some(longest)) = (size.terms > limit, longest) else { break };
            name(graph, notation, &mut cuts, &mut definitions, &mut letters, longest, names)?;
            sizes.get_mut(longest).expect("operands have sizes").terms = 1;
            sizes.get_mut(longest).expect("operands have sizes").symbols = 1;
        }
        let size = size_of(op, &sizes);
        sizes.insert(id, size);
        if uses[id] > 1 && size.symbols > SHORT && !matches!(op, Op::Sin(_) | Op::Cos(_)) {
            name(graph, notation, &mut cuts, &mut definitions, &mut letters, id, names)?;
            *sizes.get_mut(id).expect("it was just inserted") = Size { symbols: 1, terms: 1 };
        }
    }
    let mut forms = Vec::with_capacity(exprs.len());
    for &expr in exprs {
        forms.push(local(graph, notation, &cuts, expr, None)?);
    }
    Ok(Closed { definitions, forms })
}

/// The letter of the names, and how many there are.
struct Letters {
    letter: &'static str,
    count: usize,
}

/// Gives a node a name.
fn name(
    graph: &Graph,
    notation: &mut Notation,
    cuts: &mut Cuts,
    definitions: &mut Vec<(SymbolId, Form)>,
    letters: &mut Letters,
    id: NodeId,
    limit: usize,
) -> Result<()> {
    if cuts.contains(id) {
        return Ok(());
    }
    if definitions.len() == limit {
        return Err(Swelling);
    }
    let form = local(graph, notation, cuts, Expr::of_node(graph, id), Some(id))?;
    letters.count += 1;
    let symbol = notation.add(Name::indexed(letters.letter, &letters.count.to_string()), Role::Intermediate);
    cuts.insert(id, symbol);
    definitions.push((symbol, form));
    Ok(())
}

/// The normal form of what stands between names; `but` is the node whose own name it is.
fn local<'g>(
    graph: &'g Graph,
    notation: &Notation,
    cuts: &Cuts,
    expr: Expr<'g>,
    but: Option<NodeId>,
) -> Result<Form> {
    debug_assert!(but.is_none_or(|id| !cuts.contains(id)), "a node gets its name after its form");
    let mut expansion = Expansion::between(graph, notation, &[expr], cuts, WORK)?;
    let polynomial = expansion.polynomial(expr)?;
    Ok(Writer::new(notation, &expansion.ring).form(&polynomial))
}

fn size_of(op: Op, sizes: &NodeMap<Size>) -> Size {
    let of = |id: NodeId| sizes[id];
    let both = |a: NodeId, b: NodeId| of(a).symbols + of(b).symbols;
    match op {
        Op::Constant(_) | Op::Symbol(_) | Op::Sin(_) | Op::Cos(_) => Size { symbols: 1, terms: 1 },
        Op::Add(a, b) | Op::Sub(a, b) => Size { symbols: both(a, b), terms: of(a).terms + of(b).terms },
        Op::Mul(a, b) => Size { symbols: both(a, b), terms: of(a).terms * of(b).terms },
        Op::Scale(_, a) => Size { symbols: 1 + of(a).symbols, ..of(a) },
        Op::Div(a, b) => Size { symbols: both(a, b), terms: of(a).terms },
        Op::Sqrt(a) => Size { symbols: 1 + of(a).symbols, terms: 1 },
        Op::Opaque(a) => of(a),
    }
}

/// The nodes that expressions use, operands first, and how often they are used.
fn live(graph: &Graph, exprs: &[Expr<'_>]) -> (Vec<NodeId>, NodeMap<usize>) {
    let mut uses: NodeMap<usize> = NodeMap::new(graph);
    let mut order = Vec::new();
    let mut stack: Vec<NodeId> = Vec::new();
    for expr in exprs {
        if let Expr::Node { id, .. } = *expr {
            stack.push(id);
        }
    }
    while let Some(id) = stack.pop() {
        if let Some(count) = uses.get_mut(id) {
            *count += 1;
            continue;
        }
        uses.insert(id, 1);
        order.push(id);
        stack.extend(graph.op(id).operands());
    }
    order.sort_unstable();
    (order, uses)
}

/// A letter that no symbol has.
fn free_letter(notation: &Notation) -> &'static str {
    const LETTERS: [&str; 12] = ["k", "b", "c", "e", "w", "n", "s", "f", "r", "y", "z", "j"];
    let is_free = |letter: &&&str| !notation.has_letter(letter);
    LETTERS.iter().find(is_free).copied().unwrap_or("k")
}
