//! A program cut into stages: what runs once, and what runs for each branch of a set.
//!
//! What is computed side by side is gathered: stretches of the trunk and stretches of branches take turns, as few as there
//! can be. A branch's stretch begins as soon as what it reads is known; of the trunk each step comes as late as those who
//! read it allow. A quadruped's methods have one stretch of legs; two where accelerations are passed on, and up to four where what
//! couples two legs is read of others.

use super::{Operation, Program, Source};

/// A stretch of a program.
#[derive(Clone, Debug)]
pub enum Stage {
    /// Steps that run once, and rows of numbers for what follows, by their places in the program.
    Trunk(Vec<usize>),
    /// What is computed of each branch.
    Branches(Branches),
}

/// What is computed of each of several branches, by the same steps.
#[derive(Clone, Debug)]
pub struct Branches {
    /// How many branches there are.
    pub lanes: usize,
    /// The steps, by their places in the program.
    pub steps: Vec<usize>,
    /// What they read that has a number for each branch, and how often.
    pub own: Vec<(Source, usize)>,
    /// What they read that is the same for all branches, but for constants, and how often.
    pub shared: Vec<(Source, usize)>,
    /// What they read of each other, and how often.
    pub within: Vec<(Source, usize)>,
    /// What others read of it.
    pub results: Vec<Source>,
}

impl Program {
    /// The stages, in the order in which they run.
    pub fn stages(&self) -> Vec<Stage> {
        if !self.has_lanes() {
            return vec![Stage::Trunk((0..self.steps.len()).collect())];
        }
        let turns = self.turns();
        let last = turns.iter().max().copied().unwrap_or(0);
        let mut stages = Vec::new();
        for turn in 0..=last {
            let steps = (0..self.steps.len()).filter(|&k| turns[k] == turn);
            if turn % 2 == 0 {
                stages.push(Stage::Trunk(steps.collect()));
                continue;
            }
            let steps: Vec<usize> = steps.collect();
            let mut widths: Vec<usize> = steps.iter().map(|&k| self.steps[k].lanes).collect();
            widths.sort_unstable();
            widths.dedup();
            for lanes in widths {
                let alike = steps.iter().copied().filter(|&k| self.steps[k].lanes == lanes).collect();
                stages.push(Stage::Branches(self.branches(lanes, alike)));
            }
        }
        stages
    }

    /// For each step in whose turn it runs: the trunk has the even ones.
    fn turns(&self) -> Vec<usize> {
        let mut turns: Vec<usize> = Vec::with_capacity(self.steps.len());
        for k in 0..self.steps.len() {
            let known = self.read_by(k).filter_map(|source| Some(turns[source.step()?])).max().unwrap_or(0);
            let is_odd = known % 2 == 1;
            turns.push(if is_odd == self.is_of_branches(k) { known } else { known + 1 });
        }
        let last = turns.iter().max().map_or(0, |last| last.next_multiple_of(2));
        // The trunk's, as late as can be.
        let mut latest = vec![last; self.steps.len()];
        for k in (0..self.steps.len()).rev() {
            let needed = if self.is_of_branches(k) {
                turns[k] - 1
            } else {
                turns[k] = latest[k];
                latest[k]
            };
            for read in self.read_by(k).filter_map(Source::step) {
                latest[read] = latest[read].min(needed);
            }
        }
        turns
    }

    /// Whether a step computes something of each branch.
    fn is_of_branches(&self, k: usize) -> bool {
        let step = self.steps[k];
        step.lanes > 1 && !matches!(step.operation, Operation::Each(_) | Operation::Turn(..))
    }

    /// What a step reads.
    pub fn read_by(&self, k: usize) -> impl Iterator<Item = Source> {
        let operation = &self.steps[k].operation;
        let row = match *operation {
            Operation::Each(row) => self.rows[row].as_slice(),
            _ => &[],
        };
        operation.operands().chain(row.iter().copied()).map(|operand| operand.source)
    }

    fn branches(&self, lanes: usize, steps: Vec<usize>) -> Branches {
        let mut is_within = vec![false; self.steps.len()];
        steps.iter().for_each(|&k| is_within[k] = true);
        let is_from_within = |source: &Source| source.step().is_some_and(|k| is_within[k]);
        let read_within = steps.iter().flat_map(|&k| self.read_by(k));
        let (mut own, mut shared, mut within) = (Vec::new(), Vec::new(), Vec::new());
        for (source, count) in self.counted(read_within) {
            match source.step() {
                Some(k) if is_within[k] => within.push((source, count)),
                Some(k) if self.steps[k].lanes > 1 => own.push((source, count)),
                _ => shared.push((source, count)),
            }
        }
        let outside = (0..self.steps.len()).filter(|&k| !is_within[k]).flat_map(|k| self.read_by(k));
        let outside = outside.chain(self.results.iter().map(|result| result.source));
        let results = self.counted(outside.filter(is_from_within)).into_iter();
        let mut results: Vec<Source> = results.map(|(source, _)| source).collect();
        // In the order in which they are computed.
        results.sort_by_key(|source| source.step());
        Branches { lanes, steps, own, shared, within, results }
    }

    /// Each source but constants once, and how often it was there.
    fn counted(&self, sources: impl Iterator<Item = Source>) -> Vec<(Source, usize)> {
        let mut places = BySource::new(self);
        let mut counted: Vec<(Source, usize)> = Vec::new();
        for source in sources.filter(|source| !matches!(source, Source::Constant(_))) {
            match places.get(source) {
                Some(&place) => {
                    let (_, count): &mut (Source, usize) = &mut counted[place];
                    *count += 1;
                }
                None => {
                    places.insert(source, counted.len());
                    counted.push((source, 1));
                }
            }
        }
        counted
    }
}

/// What is known of sources of a program.
pub struct BySource<V> {
    /// Of each step, or its sine, and of its cosine.
    of_steps: Vec<[Option<V>; 2]>,
    /// Of inputs and fields, which are few.
    of_others: Vec<(Source, V)>,
}

impl<V> BySource<V> {
    /// Nothing.
    pub fn new(program: &Program) -> Self {
        let of_steps = program.steps.iter().map(|_| [None, None]).collect();
        Self { of_steps, of_others: Vec::new() }
    }

    /// What is known of a source.
    pub fn get(&self, source: Source) -> Option<&V> {
        match source.step() {
            Some(step) => self.of_steps[step][which(source)].as_ref(),
            None => self.of_others.iter().find(|(known, _)| *known == source).map(|(_, value)| value),
        }
    }

    /// Says something of a source of which nothing is known.
    pub fn insert(&mut self, source: Source, value: V) {
        match source.step() {
            Some(step) => self.of_steps[step][which(source)] = Some(value),
            None => self.of_others.push((source, value)),
        }
    }
}

fn which(source: Source) -> usize {
    usize::from(matches!(source, Source::Cos(_)))
}
