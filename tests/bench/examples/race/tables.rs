//! The tables of `COMPARE.md`, one file each.

use std::fmt::Write as _;
use std::path::Path;

use dynamics_bench::contest::OUTPUTS;

use crate::agreement::Difference;
use crate::bounds::Bound;
use crate::contestants::{Contestant, Times};

/// How many times as fast as Pinocchio and as CasADi's C ours is to be.
const MARKS: [f64; 2] = [10.0, 3.0];
/// How many times as fast as Pinocchio a state is to be in lanes.
const MARK_IN_LANES: f64 = 30.0;
/// The ways of several states a call, and how many states a register of 256 bits holds then.
const IN_LANES: [(&str, Contestant, f64); 4] = [
    ("f64x4", Contestant::F64x4, 4.0),
    ("f64x8", Contestant::F64x8, 4.0),
    ("f32x8", Contestant::F32x8, 8.0),
    ("`batch::map`", Contestant::Batch, 4.0),
];

/// One cell of the race, times in nanoseconds a call.
pub(crate) struct Row {
    pub(crate) robot: String,
    pub(crate) output: &'static str,
    /// Of Pinocchio, CasADi's C, and ours.
    pub(crate) nanoseconds: [Option<f64>; 3],
    pub(crate) bound: Bound,
}

impl Row {
    /// What ours is to take: what the marks demand, or what the operations take where that is more.
    fn mark(&self) -> Option<f64> {
        let demanded = self.nanoseconds.iter().zip(MARKS).filter_map(|(time, mark)| Some((*time)? / mark));
        let demanded = demanded.fold(f64::INFINITY, f64::min);
        demanded.is_finite().then(|| demanded.max(self.bound.operations))
    }

    /// How many times as fast as the faster of the peers.
    fn times_as_fast(&self) -> Option<f64> {
        let [pinocchio, casadi, ours] = self.nanoseconds;
        Some(pinocchio.into_iter().chain(casadi).reduce(f64::min)? / ours?)
    }

    /// Whether what the marks demand is met without the bound.
    fn is_as_demanded(&self) -> bool {
        let [pinocchio, casadi, ours] = self.nanoseconds;
        let is_met = |(peer, mark): (Option<f64>, f64)| Some(peer? / ours? >= mark);
        [pinocchio, casadi].into_iter().zip(MARKS).all(|cell| is_met(cell) == Some(true))
    }
}

/// Prints a table, and writes it into the folder.
pub(crate) fn write(folder: &Path, name: &str, table: &str) {
    println!("{table}");
    std::fs::write(folder.join(format!("{name}.md")), table).expect("a table can be written");
}

/// Every output of every robot.
pub(crate) fn race(rows: &[Row], gigahertz: f64) -> String {
    let mut table = format!(
        "Nanoseconds a call; the core ran at {gigahertz:.2} GHz.\n\n\
         | robot | output | Pinocchio | CasADi | ours | × Pinocchio | × CasADi | operations | chain | mark | ours / mark |\n\
         |---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
    );
    let (mut met, mut within_chain, mut behind) = (0, 0, vec![]);
    for row in rows {
        let [pinocchio, casadi, ours] = row.nanoseconds;
        let cell = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1}"));
        let times = |peer: Option<f64>| Some(peer? / ours?);
        let of_mark = ours.zip(row.mark()).map(|(ours, mark)| ours / mark);
        let is_met = of_mark.is_some_and(|of_mark| of_mark <= 1.0);
        met += usize::from(is_met);
        within_chain += usize::from(!is_met && ours <= row.bound.chain);
        if row.times_as_fast().is_some_and(|times| times < 1.0) {
            behind.push(format!("{} of {}", row.output, row.robot));
        }
        let verdict = match of_mark {
            Some(of_mark) if of_mark <= 1.0 => format!("**{of_mark:.2}**"),
            Some(of_mark) => format!("{of_mark:.2}"),
            None => "–".to_owned(),
        };
        let cells = [pinocchio, casadi, ours, times(pinocchio), times(casadi)];
        let cells = cells.into_iter().chain([Some(row.bound.operations), row.bound.chain, row.mark()]);
        let cells: Vec<String> = cells.map(cell).collect();
        let _ = writeln!(table, "| {} | {} | {} | {verdict} |", row.robot, row.output, cells.join(" | "));
    }
    let _ = writeln!(
        table,
        "\nOurs is behind a peer in {} of {} cells{}. It is ten times as fast as Pinocchio and three times as CasADi's C in {}, \
         and meets its mark in {met}; of the others {within_chain} take less than the longest chain of a call.",
        if behind.is_empty() { "none".to_owned() } else { behind.len().to_string() },
        rows.len(),
        if behind.is_empty() { String::new() } else { format!(": {}", behind.join(", ")) },
        rows.iter().filter(|row| row.is_as_demanded()).count()
    );
    table
}

/// How many times as fast ours is, robot by robot.
pub(crate) fn short(robots: &[String], rows: &[Row]) -> String {
    let mut table = heading("robot", "Times as fast as Pinocchio / as C that CasADi generates");
    for robot in robots {
        let _ = write!(table, "| {robot} |");
        for (output, _) in OUTPUTS {
            let row = rows.iter().find(|row| row.robot == *robot && row.output == output);
            let times = |peer: usize| {
                let ratio =
                    row.and_then(|Row { nanoseconds, .. }| Some(nanoseconds[peer]? / nanoseconds[2]?));
                ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.1}"))
            };
            let _ = write!(table, " {} / {} |", times(0), times(1));
        }
        table += "\n";
    }
    let mut of_faster: Vec<f64> = rows.iter().filter_map(Row::times_as_fast).collect();
    of_faster.sort_by(f64::total_cmp);
    let [least, middle, most] = [0, of_faster.len() / 2, of_faster.len().saturating_sub(1)]
        .map(|k| of_faster.get(k).copied().unwrap_or(f64::NAN));
    let _ = writeln!(
        table,
        "\nOurs is {least:.1} to {most:.1} times as fast as the faster of the two, {middle:.1} in the median, and ahead of both \
         in {} of {}.",
        of_faster.iter().filter(|times| **times > 1.0).count(),
        of_faster.len()
    );
    table
}

/// The largest differences from Pinocchio's numbers.
pub(crate) fn agreement(robots: &[String], differences: &[Difference]) -> String {
    let mut table = heading("robot", "CasADi, ours, ours without FMA");
    for robot in robots {
        let _ = write!(table, "| {robot} |");
        for (output, _) in OUTPUTS {
            let of = |contestant| {
                let is_it = |found: &&Difference| {
                    found.robot == *robot && found.output == output && found.contestant == contestant
                };
                differences
                    .iter()
                    .find(is_it)
                    .map_or("–".to_owned(), |found| format!("{:.0e}", found.relative))
            };
            let cells = [Contestant::Casadi, Contestant::Ours, Contestant::Generic].map(of);
            let _ = write!(table, " {} |", cells.join(", "));
        }
        table += "\n";
    }
    table
}

/// A state among several in lanes, beside Pinocchio's.
pub(crate) fn lanes(rows: &[Row], times: &Times) -> String {
    let names = IN_LANES.map(|(name, ..)| format!("{name} | ×"));
    let mut table = format!(
        "| robot | output | Pinocchio | operations | {} |\n|---|---|--:|--:|{}\n",
        names.join(" | "),
        "--:|--:|".repeat(names.len())
    );
    let mut met = [0; IN_LANES.len()];
    let mut beyond = [0; IN_LANES.len()];
    for Row { robot, output, nanoseconds: [pinocchio, ..], bound } in rows {
        let Some(pinocchio) = *pinocchio else { continue };
        let bound = |states: f64| bound.in_a_lane / states;
        let _ = write!(table, "| {robot} | {output} | {pinocchio:.1} | {:.1} |", bound(IN_LANES[0].2));
        for ((_, contestant, states), (met, beyond)) in
            IN_LANES.into_iter().zip(met.iter_mut().zip(&mut beyond))
        {
            let time = times.get(robot, output, contestant).unwrap_or(f64::NAN);
            let ratio = pinocchio / time;
            let is_met = ratio >= MARK_IN_LANES;
            *met += usize::from(is_met);
            *beyond += usize::from(!is_met && bound(states) > pinocchio / MARK_IN_LANES);
            let bold = if is_met { "**" } else { "" };
            let _ = write!(table, " {time:.1} | {bold}{ratio:.1}{bold} |");
        }
        table += "\n";
    }
    let count = |counts: [usize; IN_LANES.len()]| {
        let counts = IN_LANES.iter().zip(counts).map(|((name, ..), count)| format!("{count} by {name}"));
        counts.collect::<Vec<_>>().join(", ")
    };
    let _ = writeln!(
        table,
        "\nOf {} cells, {MARK_IN_LANES} times Pinocchio are met in {}. In others the operations alone take more than \
         that: in {}.",
        rows.len(),
        count(met),
        count(beyond)
    );
    table
}

/// How much longer ours takes without fused multiply-add and wide vectors.
pub(crate) fn generic(robots: &[String], times: &Times) -> String {
    let mut table = heading("robot", "generic / native");
    for robot in robots {
        let _ = write!(table, "| {robot} |");
        for (output, _) in OUTPUTS {
            let of = |contestant| times.get(robot, output, contestant);
            let ratio =
                of(Contestant::Generic).zip(of(Contestant::Ours)).map(|(generic, ours)| generic / ours);
            let _ = write!(table, " {} |", ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.2}")));
        }
        table += "\n";
    }
    table
}

/// What computing several outputs in one call saves.
pub(crate) fn bundles(robots: &[String], times: &Times) -> String {
    let bundles: [(&str, &[&str]); 4] = [
        ("M,C,G", &["M", "C", "G"]),
        ("ID+dID", &["ID", "dID"]),
        ("FD+dFD", &["FD", "dFD"]),
        ("dFD", &["FD", "dID", "1/M"]),
    ];
    let mut table = "| robot | M, C, G in one | M + C + G | ratio | ID, ∂ID in one | ID + ∂ID | ratio \
         | FD, ∂FD in one | FD + ∂FD | ratio | ∂FD, which has M⁻¹ | FD + ∂ID + M⁻¹ | ratio |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
        .to_owned();
    for robot in robots {
        let of = |output: &str| times.get(robot, output, Contestant::Ours).unwrap_or(f64::NAN);
        let _ = write!(table, "| {robot} |");
        for (bundle, parts) in bundles {
            let (whole, sum) = (of(bundle), parts.iter().map(|part| of(part)).sum::<f64>());
            let _ = write!(table, " {whole:.1} | {sum:.1} | {:.2} |", whole / sum);
        }
        table += "\n";
    }
    table
}

fn heading(first: &str, what: &str) -> String {
    let names: Vec<&str> = OUTPUTS.iter().map(|(output, _)| *output).collect();
    let line = "--:|".repeat(names.len());
    format!("{what}:\n\n| {first} | {} |\n|---|{line}\n", names.join(" | "))
}
