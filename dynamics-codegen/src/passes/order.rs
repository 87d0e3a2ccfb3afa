//! In which order a program runs.
//!
//! Each result comes with all that it needs before the next one, and of two operands first that with the longer chain
//! of operations: few values wait then, which registers hold, and the longest chain of all waits for nothing. Inverse
//! dynamics of a chain of sixteen takes a quarter less than in the order in which it was derived. Sines stand together,
//! as many as the run time computes side by side, where the first of them is needed: earlier, other work would wait for
//! them.
//!
//! R. Sethi, J. D. Ullman, *The generation of optimal code for arithmetic expressions*, Journal of the ACM 17, 1970.

use crate::symbolic::{Graph, NodeId, NodeMap, Op};

/// So many angles stand together.
const TOGETHER: usize = 4;

/// The nodes that `results` need, each after its operands. `known` are the same in another such order.
pub(super) fn order(
    graph: &Graph,
    known: &[NodeId],
    results: &[NodeId],
    operands: impl Fn(NodeId) -> [Option<NodeId>; 2],
) -> Vec<NodeId> {
    let mut heights: NodeMap<u32> = NodeMap::new(graph);
    for &id in known {
        let below = operands(id).into_iter().flatten().map(|operand| heights[operand] + 1);
        heights.insert(id, below.max().unwrap_or(0));
    }
    let nodes = Nodes { graph, operands: &operands, heights };
    let apart = Walk::of(&nodes, Vec::new()).through(results);
    let sines = apart.into_iter().filter(|&id| nodes.angle(id).is_some()).collect();
    Walk::of(&nodes, sines).through(results)
}

/// What is known of the nodes.
struct Nodes<'a> {
    graph: &'a Graph,
    operands: &'a dyn Fn(NodeId) -> [Option<NodeId>; 2],
    /// The longest chain of operations up to each.
    heights: NodeMap<u32>,
}

impl Nodes<'_> {
    /// The angle, if the node is a sine or cosine that is to be computed.
    fn angle(&self, id: NodeId) -> Option<NodeId> {
        match self.graph.op(id) {
            Op::Sin(_) | Op::Cos(_) => (self.operands)(id)[0],
            _ => None,
        }
    }
}

struct Walk<'a> {
    nodes: &'a Nodes<'a>,
    done: NodeMap<()>,
    order: Vec<NodeId>,
    /// The sines and cosines in the order in which they are reached, if they are to stand together; the last one first.
    sines: Vec<NodeId>,
}

impl<'a> Walk<'a> {
    fn of(nodes: &'a Nodes<'a>, mut sines: Vec<NodeId>) -> Self {
        sines.reverse();
        Self { nodes, done: NodeMap::new(nodes.graph), order: Vec::new(), sines }
    }

    fn through(mut self, results: &[NodeId]) -> Vec<NodeId> {
        for &result in results {
            self.reach(result);
        }
        self.order
    }

    /// A node, after all that it needs.
    fn reach(&mut self, root: NodeId) {
        let mut stack = vec![(root, false)];
        while let Some((id, is_ready)) = stack.pop() {
            if self.done.contains(id) {
                continue;
            }
            if is_ready {
                if self.nodes.angle(id).is_some() {
                    self.add_sines();
                }
                self.add(id);
                continue;
            }
            stack.push((id, true));
            let height = |operand: Option<NodeId>| operand.map(|id| self.nodes.heights[id]);
            let [a, b] = (self.nodes.operands)(id);
            let later = if height(b) > height(a) { [a, b] } else { [b, a] };
            stack.extend(later.into_iter().flatten().map(|operand| (operand, false)));
        }
    }

    fn add(&mut self, id: NodeId) {
        if !self.done.contains(id) {
            self.done.insert(id, ());
            self.order.push(id);
        }
    }

    /// The next sines and cosines, after their angles.
    fn add_sines(&mut self) {
        let (mut angles, mut together) = (Vec::new(), Vec::new());
        while let Some(&next) = self.sines.last() {
            let angle = self.nodes.angle(next);
            if !angles.contains(&angle) {
                if angles.len() == TOGETHER {
                    break;
                }
                angles.push(angle);
            }
            together.push(next);
            self.sines.pop();
        }
        for angle in angles.into_iter().flatten() {
            self.reach(angle);
        }
        for sine in together {
            self.add(sine);
        }
    }
}

pub(super) fn both(mut operands: impl Iterator<Item = NodeId>) -> [Option<NodeId>; 2] {
    [operands.next(), operands.next()]
}
