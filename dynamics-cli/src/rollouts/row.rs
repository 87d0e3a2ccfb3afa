//! Vectors of lanes that come and go with each step, without asking for memory each time.

use std::cell::RefCell;
use std::rc::Rc;

use dynamics_core::simulate::Vector;

use super::engine::Wide;

/// Where vectors that are gone leave their memory.
#[derive(Clone, Default)]
pub(super) struct Shelf(Rc<RefCell<Vec<Vec<Wide>>>>);

impl Shelf {
    /// A vector of these entries.
    pub(super) fn row(&self, entries: impl IntoIterator<Item = Wide>) -> Row {
        let mut row = Row { entries: self.0.borrow_mut().pop().unwrap_or_default(), shelf: self.clone() };
        row.entries.clear();
        row.entries.extend(entries);
        row
    }
}

/// A vector whose memory is used again: lanes are aligned so wide that the allocator is slow with them.
pub(super) struct Row {
    entries: Vec<Wide>,
    shelf: Shelf,
}

impl Clone for Row {
    fn clone(&self) -> Self {
        self.shelf.row(self.entries.iter().copied())
    }
}

impl Drop for Row {
    fn drop(&mut self) {
        self.shelf.0.borrow_mut().push(std::mem::take(&mut self.entries));
    }
}

impl Vector<Wide> for Row {
    fn entries(&self) -> &[Wide] {
        &self.entries
    }
    fn entries_mut(&mut self) -> &mut [Wide] {
        &mut self.entries
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_goes_back_to_its_shelf() {
        let shelf = Shelf::default();
        let row = shelf.row([Wide::from(1.0), Wide::from(2.0)]);
        let sum = row.clone().plus(Wide::from(2.0), &row);
        assert_eq!(sum.entries(), [Wide::from(3.0), Wide::from(6.0)]);
        let memory = sum.entries.as_ptr();
        drop(sum);
        assert_eq!(shelf.0.borrow().len(), 1);
        let next = row.clone();
        assert_eq!((next.entries.as_ptr(), next.entries()), (memory, row.entries()));
        assert!(shelf.0.borrow().is_empty());
    }
}
