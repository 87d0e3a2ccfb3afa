//! The table everybody looks at: what each robot of the zoo costs. And the generated code itself, of small robots.

use std::fmt::Write as _;

use dynamics_core::{Cost, Costs};
use dynamics_tests::roads::generated;
use dynamics_tests::zoo::textbook::{cart_pole, pendulum, robo_judge};
use dynamics_tests::zoo::{self, Entry};

type Column = (&'static str, fn(&Costs) -> Cost);

const COLUMNS: [Column; 11] = [
    ("M", |costs| costs.mass_matrix),
    ("C", |costs| costs.coriolis_matrix),
    ("G", |costs| costs.gravity_forces),
    ("h", |costs| costs.bias_forces),
    ("ID", |costs| costs.inverse_dynamics),
    ("FD", |costs| costs.forward_dynamics),
    ("T-V", |costs| costs.lagrangian),
    ("M, C, G", |costs| costs.equations_of_motion),
    ("dID", |costs| costs.inverse_dynamics_derivatives),
    ("dFD", |costs| costs.forward_dynamics_derivatives),
    ("prepare", |costs| costs.prepare),
];

/// `193*183+1/7~`: multiplications, additions, divisions and roots if there are some, sines with their cosines.
fn cell(cost: Cost) -> String {
    let Cost { multiplications, additions, divisions, square_roots, sines_and_cosines } = cost;
    let mut text = format!("{multiplications}* {additions}+");
    for (count, sign) in [(divisions, "/"), (square_roots, "√"), (sines_and_cosines, "~")] {
        if count > 0 {
            let _ = write!(text, " {count}{sign}");
        }
    }
    if cost == Cost::ZERO { "-".to_owned() } else { text }
}

/// A change in a rule of the compiler shows up here: better or worse, for which robot, by how much.
#[test]
fn operations_and_lines_of_the_zoo() {
    let mut table = format!("{:<22} {:>2}", "robot", "n");
    for (name, _) in COLUMNS {
        let _ = write!(table, "  {name:<18}");
    }
    let _ = writeln!(table, "  lines");
    for entry in zoo::all() {
        let mut line = format!("{:<22} {:>2}", entry.name, entry.space.speeds());
        for (_, cost) in COLUMNS {
            let _ = write!(line, "  {:<18}", cell(cost(&entry.costs)));
        }
        let _ = writeln!(table, "{line}  {:>5}", generated(&entry).lines().count());
    }
    insta::assert_snapshot!(table);
}

#[test]
fn the_same_robot_gives_the_same_bytes() {
    for entry in zoo::all() {
        assert!(generated(&entry) == generated(&entry), "{} is generated in two ways", entry.name);
    }
}

/// The first method of this name, with its documentation: that of the prepared companion, where the arithmetic is.
fn method<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let lines: Vec<&str> = text.lines().collect();
    let is_head =
        |line: &&str| line.trim_start().trim_start_matches("pub ").starts_with(&format!("fn {name}("));
    let head = lines.iter().position(is_head).unwrap_or_else(|| panic!("there is no `{name}`"));
    let is_outside = |line: &str| !line.trim_start().starts_with(['/', '#']);
    let start = lines[..head].iter().rposition(|line| is_outside(line)).map_or(0, |before| before + 1);
    let indent = lines[head].len() - lines[head].trim_start().len();
    let closing = format!("{}}}", " ".repeat(indent));
    let end = head + lines[head..].iter().position(|line| *line == closing).expect("a function ends");
    lines[start..=end].iter().map(|line| line.get(indent..).unwrap_or_default()).collect()
}

/// Methods of a robot as text, 80 lines at the most: longer ones belong into the table.
fn excerpt(entry: &Entry, methods: &[&str]) -> String {
    let text = generated(entry);
    let parts: Vec<String> = methods.iter().map(|name| method(&text, name).join("\n")).collect();
    let excerpt = parts.join("\n\n");
    assert!(excerpt.lines().count() <= 80, "{} is no small robot", entry.name);
    excerpt
}

#[test]
fn code_of_the_pendulum() {
    let methods = ["prepare", "mass_matrix", "gravity_forces", "forward_dynamics"];
    insta::assert_snapshot!(excerpt(&pendulum::entry(), &methods));
}

#[test]
fn code_of_the_cart_pole() {
    let methods = ["prepare", "mass_matrix", "gravity_forces"];
    insta::assert_snapshot!(excerpt(&cart_pole::entry(), &methods));
}

#[test]
fn code_of_the_robojudge() {
    insta::assert_snapshot!(excerpt(&robo_judge::entry(), &["mass_matrix", "lagrangian"]));
}
