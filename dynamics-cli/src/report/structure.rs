//! The structure of the mass matrix: what is zero, what is constant, and what the rest depends on.

use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::plain::{Oracle, Rows};
use dynamics_view::page::{Cell, Pattern, Section};

use super::Subject;
use crate::picture::charts::parts;
use crate::robot::{Robot, State};

/// So many configurations are tried, for each of which every coordinate is changed.
const TRIALS: usize = 6;
/// What an entry changes by rounding, relative to `√(Mᵢᵢ·Mⱼⱼ)`; it has some hundred roundings.
const ROUNDING: f64 = 1e-11;

/// Coordinates that are changed together: one, or those of a joint with a quaternion.
struct Variable {
    name: String,
    q: Vec<usize>,
}

pub(super) fn section(subject: &Subject<'_, '_>) -> Section {
    let robot = subject.robot;
    let letters = subject.letters(Argument::Q);
    let variables = variables(robot, &letters);
    let cells = cells(robot, &variables);
    let columns = subject.letters(Argument::V);
    let rows = robot.coordinates.v.iter().zip(&columns).map(|(name, letter)| match name == letter {
        true => name.clone(),
        false => format!("`{name}` {letter}"),
    });
    let pattern = Pattern {
        caption: "On what the entries of M depend".to_owned(),
        rows: rows.collect(),
        columns,
        variables: variables.into_iter().map(|variable| variable.name).collect(),
        cells: cells.clone(),
    };
    Section::new("structure", "The structure of M")
        .text(&told(&cells))
        .pattern(pattern)
        .remark(&format!(
            "Found at {TRIALS} configurations, of which each coordinate was changed alone; changes below {} of the \
             diagonal count as rounding.",
            dynamics_view::page::number(ROUNDING, 1)
        ))
}

/// How many entries are what.
fn told(cells: &[Vec<Cell>]) -> String {
    let of_half = || cells.iter().enumerate().flat_map(|(i, row)| &row[i..]);
    let count = |is: fn(&Cell) -> bool| of_half().filter(|cell| is(cell)).count();
    let (all, zero) = (of_half().count(), count(|cell| *cell == Cell::Zero));
    let constant = count(|cell| matches!(cell, Cell::Constant(_)));
    let varying = all - zero - constant;
    format!(
        "M(q) is symmetric, and positive definite where the robot stands. Its {all} entries on and above the diagonal: {zero} always zero, \
         {constant} constant, {varying} dependent on the configuration."
    )
}

fn variables(robot: &Robot<'_>, letters: &[String]) -> Vec<Variable> {
    let parts = parts(robot);
    let single = parts.single.iter().map(|part| Variable { name: letters[part.q].clone(), q: vec![part.q] });
    let loose = parts.loose.iter().flat_map(|part| {
        let from = if part.is_free { part.q + 3 } else { part.q };
        let position = (part.q..from).map(|q| Variable { name: letters[q].clone(), q: vec![q] });
        let turn = Variable { name: format!("R({})", part.name), q: (from..from + 4).collect() };
        position.chain([turn]).collect::<Vec<_>>()
    });
    let mut all: Vec<Variable> = single.chain(loose).collect();
    all.sort_by_key(|variable| variable.q.clone());
    all
}

/// What each entry is, by rows.
fn cells(robot: &Robot<'_>, variables: &[Variable]) -> Vec<Vec<Cell>> {
    let (n, oracle) = (robot.dof(), Oracle::new(&robot.tree));
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut configuration = || {
        let mut q: Vec<f64> = (0..robot.tree.coordinates()).map(|_| random.next()).collect();
        robot.tree.normalise(&mut q);
        q
    };
    let neutral = oracle.mass_matrix(&State::neutral(robot).q);
    let mut is_zero = vec![vec![true; n]; n];
    let mut depends = vec![vec![vec![false; variables.len()]; n]; n];
    for _ in 0..TRIALS {
        let (q, other) = (configuration(), configuration());
        let here = oracle.mass_matrix(&q);
        each(&here, |i, j, entry, size| is_zero[i][j] &= entry.abs() <= ROUNDING * size);
        for (k, variable) in variables.iter().enumerate() {
            let mut changed = q.clone();
            variable.q.iter().for_each(|at| changed[*at] = other[*at]);
            let there = oracle.mass_matrix(&changed);
            each(&there, |i, j, entry, size| {
                is_zero[i][j] &= entry.abs() <= ROUNDING * size;
                depends[i][j][k] |= (entry - here[i][j]).abs() > ROUNDING * size;
            });
        }
    }
    let cell = |i: usize, j: usize| {
        let on: Vec<usize> = (0..variables.len()).filter(|k| depends[i][j][*k]).collect();
        match (on.is_empty(), is_zero[i][j]) {
            (true, true) => Cell::Zero,
            (true, false) => Cell::Constant(neutral[i][j]),
            (false, _) => Cell::Varies(on),
        }
    };
    (0..n).map(|i| (0..n).map(|j| cell(i, j)).collect()).collect()
}

/// Every entry with its size, `√(Mᵢᵢ·Mⱼⱼ)`, which none exceeds.
fn each(m: &Rows, mut see: impl FnMut(usize, usize, f64, f64)) {
    for (i, row) in m.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            see(i, j, *entry, (m[i][i] * m[j][j]).abs().sqrt());
        }
    }
}

/// Numbers between −1 and 1 that are the same each time: S. Vigna's splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
