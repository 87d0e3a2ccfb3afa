//! What is computed of each branch, as a function of its own that stands where it is called.
//!
//! It reads what a branch has of its own, and what all share, by places. The names in it are those outside.

use super::body::{Named, Statement, Writer};
use super::text::{Binding, Text, atom, join, negated, wrap};
use crate::passes::{Branches, BySource, Operand, Source};

/// What a language says of several branches in words of its own.
pub(super) trait SideBySide {
    /// A constant within a branch.
    fn constant(&self, value: f64) -> String;

    /// What the branch has of its own.
    fn own(&self, place: usize) -> String;

    /// What all branches share.
    fn shared(&self, place: usize) -> String;

    /// Hands a result over.
    fn give(&self, place: usize, value: &str) -> String;

    /// A number for each.
    fn row(&self, numbers: &[String]) -> String;

    /// One of them.
    fn one(&self, numbers: &str, branch: usize) -> String;

    /// The code of a branch, and its call; lines without indentation.
    fn call(&self, code: &BranchCode) -> String;
}

/// The parts of a call.
pub(super) struct BranchCode {
    /// How many branches there are.
    pub(super) branches: usize,
    /// What is done of each.
    pub(super) statements: Vec<Statement>,
    /// Numbers of each branch.
    pub(super) own: Vec<String>,
    /// Numbers for all of them.
    pub(super) shared: Vec<String>,
}

/// What the branches' code that is being written is given.
pub(super) struct Within {
    given: BySource<usize>,
    all: Vec<Given>,
}

struct Given {
    /// How it is read: by a call, or by its name once it has one.
    text: Text,
    /// The name that it gets where it is read first, if it is read again.
    name: Option<String>,
}

impl<'a> Writer<'a> {
    /// Writes the code of branches, and what calls it.
    pub(super) fn branches(&mut self, branches: &Branches) {
        let words = self.side_by_side();
        let (own, shared) = (self.all(&branches.own), self.all(&branches.shared));
        let reads = own.iter().chain(&shared).flat_map(|text| text.reads.iter().copied()).collect();
        self.within = Some(self.given_to(branches, &own, &shared));
        let outside = std::mem::take(&mut self.statements);
        for &step in &branches.steps {
            self.step(step);
            self.give(branches, step);
        }
        let statements = std::mem::replace(&mut self.statements, outside);
        let names: Vec<String> = branches.results.iter().map(|&result| self.name_outside(result)).collect();
        self.within = None;
        let text = |texts: Vec<Text>| texts.into_iter().map(|text| text.text).collect();
        let code = BranchCode { branches: branches.lanes, statements, own: text(own), shared: text(shared) };
        let call = atom(words.call(&code), reads);
        let statement = self.declare(Named::Rows(names.clone()), call);
        for (result, name) in branches.results.iter().zip(names) {
            let Some(step) = result.step() else { continue };
            let value = atom(name, vec![statement]);
            match (result, &mut self.values[step]) {
                (Source::Cos(_), Some((_, cos))) => *cos = Some(value),
                (_, Some((first, _))) => *first = value,
                (_, none) => *none = Some((value, None)),
            }
        }
    }

    fn all(&mut self, sources: &[(Source, usize)]) -> Vec<Text> {
        sources.iter().map(|&(source, _)| self.whole(Operand { source, negative: false })).collect()
    }

    /// What the code is given, each of which is read by a call if that is once.
    fn given_to(&mut self, branches: &Branches, own: &[Text], shared: &[Text]) -> Within {
        let words = self.side_by_side();
        let calls = (0..own.len()).map(|k| ('l', words.own(k)));
        let calls = calls.chain((0..shared.len()).map(|k| ('e', words.shared(k))));
        let mut given = BySource::new(self.program);
        let mut all = Vec::new();
        let sources = branches.own.iter().chain(&branches.shared);
        for ((&(source, uses), outside), (letter, call)) in sources.zip(own.iter().chain(shared)).zip(calls) {
            let name = (uses > 1).then(|| match is_name(&outside.text) {
                true => outside.text.clone(),
                false => self.numbered_name(letter),
            });
            given.insert(source, all.len());
            all.push(Given { text: atom(call, Vec::new()), name });
        }
        Within { given, all }
    }

    /// Hands over what a step made, as far as others read it.
    fn give(&mut self, branches: &Branches, step: usize) {
        for (place, &result) in branches.results.iter().enumerate() {
            if result.step() == Some(step) {
                let value = self.whole(Operand { source: result, negative: false });
                let text = self.side_by_side().give(place, &value.text);
                self.declare(Named::Nothing, Text { text, ..value });
            }
        }
    }

    /// What a result is called outside: as within, if it has a name there.
    fn name_outside(&mut self, result: Source) -> String {
        let within = self.whole(Operand { source: result, negative: false });
        if is_name(&within.text) { within.text } else { self.numbered_name('l') }
    }

    /// A source that the branches' code is given.
    pub(super) fn given(&mut self, source: Source) -> Option<Text> {
        let within = self.within.as_mut()?;
        let place = *within.given.get(source)?;
        let given = &mut within.all[place];
        let text = given.text.clone();
        let Some(name) = given.name.take() else { return Some(text) };
        let statement = self.declare(Named::Value(name.clone()), text);
        let named = atom(name, vec![statement]);
        self.within.as_mut()?.all[place].text = named.clone();
        Some(named)
    }

    /// Numbers side by side.
    pub(super) fn row(&mut self, row: usize) -> Text {
        let texts: Vec<Text> = self.program.rows[row].iter().map(|&operand| self.whole(operand)).collect();
        self.row_of(&texts)
    }

    fn row_of(&self, texts: &[Text]) -> Text {
        let numbers: Vec<String> = texts.iter().map(|text| text.text.clone()).collect();
        join(&texts.iter().collect::<Vec<_>>(), self.side_by_side().row(&numbers), Binding::Atom)
    }

    /// One of several numbers side by side; minus that of their negatives.
    pub(super) fn one_of(&mut self, numbers: Operand, branch: usize) -> Text {
        let row = wrap(self.whole(Operand { negative: false, ..numbers }), Binding::Atom);
        let text = join(&[&row], self.side_by_side().one(&row.text, branch), Binding::Atom);
        if numbers.negative { negated(text) } else { text }
    }

    /// The same numbers in a circle, from that of a branch on.
    pub(super) fn turned(&mut self, numbers: Operand, first: usize) -> Text {
        let lanes = numbers.source.step().map_or(1, |step| self.program.steps[step].lanes);
        let texts: Vec<Text> = (0..lanes).map(|k| self.one_of(numbers, (first + k) % lanes)).collect();
        self.row_of(&texts)
    }

    pub(super) fn side_by_side(&self) -> &'a dyn SideBySide {
        self.language.side_by_side().expect("a program with lanes is for a language with words for them")
    }
}

fn is_name(text: &str) -> bool {
    text.chars().all(|letter| letter.is_alphanumeric() || letter == '_')
        && text.starts_with(|first: char| !first.is_ascii_digit())
}
