//! From operands to operations.

use super::{Graph, NodeId};

/// A walk to a node over what it is made of, operands before operations, without recursion: graphs may be deep.
pub struct Walk {
    stack: Vec<NodeId>,
}

impl Walk {
    /// The walk to `root`.
    pub fn to(root: NodeId) -> Self {
        Self { stack: vec![root] }
    }

    /// The next node that is not known, its operands being so; none once `root` is. It comes again until it is known.
    pub fn next(&mut self, graph: &Graph, is_known: impl Fn(NodeId) -> bool) -> Option<NodeId> {
        while let Some(&id) = self.stack.last() {
            if is_known(id) {
                self.stack.pop();
                continue;
            }
            let waiting = self.stack.len();
            for operand in graph.op(id).operands() {
                if !is_known(operand) {
                    self.stack.push(operand);
                }
            }
            if self.stack.len() == waiting {
                return Some(id);
            }
        }
        None
    }
}
