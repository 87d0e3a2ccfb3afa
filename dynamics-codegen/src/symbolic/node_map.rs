//! What is known of some nodes of a graph: a table, for hashing is slow where nothing is optimised.

use std::ops::Index;

use super::{Graph, NodeId};

/// A map from the nodes of one graph.
pub struct NodeMap<T> {
    /// For each node the place of its value, from one on; zero if it has none.
    places: Vec<u32>,
    values: Vec<T>,
}

impl<T> NodeMap<T> {
    /// An empty map with room for the nodes that `graph` has now; it grows with later ones.
    pub fn new(graph: &Graph) -> Self {
        Self { places: vec![0; graph.len()], values: Vec::new() }
    }

    /// The node's value.
    pub fn get(&self, node: NodeId) -> Option<&T> {
        match self.places.get(node.index()) {
            None | Some(0) => None,
            Some(&place) => Some(&self.values[place as usize - 1]),
        }
    }

    /// The node's value, to be changed.
    pub fn get_mut(&mut self, node: NodeId) -> Option<&mut T> {
        match self.places.get(node.index()) {
            None | Some(0) => None,
            Some(&place) => Some(&mut self.values[place as usize - 1]),
        }
    }

    /// Whether the node has a value.
    pub fn contains(&self, node: NodeId) -> bool {
        self.get(node).is_some()
    }

    /// All values, in the order in which they came.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// Gives a value to a node that has none.
    pub fn insert(&mut self, node: NodeId, value: T) {
        if node.index() >= self.places.len() {
            self.places.resize(2 * node.index() + 1, 0);
        }
        self.values.push(value);
        self.places[node.index()] = u32::try_from(self.values.len()).expect("fewer than 2^32 nodes");
    }
}

impl<T> Index<NodeId> for NodeMap<T> {
    type Output = T;

    fn index(&self, node: NodeId) -> &T {
        self.get(node).expect("a node is known before it is asked for")
    }
}
