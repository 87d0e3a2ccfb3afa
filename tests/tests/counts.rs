//! The table everybody looks at: what each robot of the zoo costs. And the generated code itself, of small robots.

use std::fmt::Write as _;
use std::sync::OnceLock;

use dynamics_core::{Cost, Costs};
use dynamics_tests::roads::generated;
use dynamics_tests::zoo::textbook::{cart_pole, pendulum, robo_judge};
use dynamics_tests::zoo::{self, Entry};

type Column = (&'static str, fn(&Costs) -> Cost);

const EQUATIONS: [Column; 14] = [
    ("M", |costs| costs.mass_matrix),
    ("1/M", |costs| costs.inverse_mass_matrix),
    ("C", |costs| costs.coriolis_matrix),
    ("G", |costs| costs.gravity_forces),
    ("h", |costs| costs.bias_forces),
    ("ID", |costs| costs.inverse_dynamics),
    ("FD", |costs| costs.forward_dynamics),
    ("T-V", |costs| costs.lagrangian),
    ("M, C, G", |costs| costs.equations_of_motion),
    ("dID", |costs| costs.inverse_dynamics_derivatives),
    ("ID, dID", |costs| costs.inverse_dynamics_with_derivatives),
    ("dFD", |costs| costs.forward_dynamics_derivatives),
    ("FD, dFD", |costs| costs.forward_dynamics_with_derivatives),
    ("prepare", |costs| costs.prepare),
];

const WHOLE: [Column; 9] = [
    ("passive", |costs| costs.passive_forces),
    ("T", |costs| costs.kinetic_energy),
    ("V", |costs| costs.potential_energy),
    ("c", |costs| costs.center_of_mass),
    ("J of c", |costs| costs.center_of_mass_jacobian),
    ("A", |costs| costs.centroidal_momentum_matrix),
    ("A v", |costs| costs.centroidal_momentum),
    ("Y", |costs| costs.regressor),
    ("Y base", |costs| costs.base_regressor),
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

/// The costs of every robot, with what `last` says of it at the end of its line; columns as wide as they must be.
fn table(columns: &[Column], (heading, last): (&str, fn(&Entry) -> String)) -> String {
    let names = columns.iter().map(|(name, _)| (*name).to_owned());
    let head = ["robot", "n"].map(str::to_owned).into_iter().chain(names).chain([heading.to_owned()]);
    let mut lines: Vec<Vec<String>> = vec![head.collect()];
    lines.extend(zoo::all().iter().map(|entry| {
        let first = [entry.name.to_owned(), entry.space.speeds().to_string()];
        let costs = columns.iter().map(|(_, cost)| cell(cost(&entry.costs)));
        first.into_iter().chain(costs).chain([last(entry)]).collect()
    }));
    let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns.len() + 3).map(width).collect();
    let mut table = String::new();
    for line in &lines {
        let cells: Vec<String> =
            line.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}")).collect();
        let _ = writeln!(table, "{}", cells.join("  ").trim_end());
    }
    table
}

/// The code of every robot, generated once.
fn zoo_generated() -> &'static [String] {
    static TEXTS: OnceLock<Vec<String>> = OnceLock::new();
    TEXTS.get_or_init(|| zoo::on_all_cores(|entry| generated(&entry)))
}

/// A change in a rule of the compiler shows up here: better or worse, for which robot, by how much.
#[test]
fn operations_and_lines_of_the_zoo() {
    let lines = |entry: &Entry| {
        let k = zoo::all().iter().position(|other| other.name == entry.name);
        zoo_generated()[k.expect("it is in the zoo")].lines().count().to_string()
    };
    insta::assert_snapshot!(table(&EQUATIONS, ("lines", lines)));
}

/// The robot as a whole, and its parameters: how many there are, and how many can be told apart.
#[test]
fn operations_of_the_whole_and_of_parameters() {
    let parameters =
        |entry: &Entry| format!("{} of {}", entry.base_parameter_names.len(), entry.parameter_names.len());
    insta::assert_snapshot!(table(&WHOLE, ("parameters", parameters)));
}

#[test]
fn the_same_robot_gives_the_same_bytes() {
    let again = zoo::on_all_cores(|entry| generated(&entry));
    for (entry, (text, again)) in zoo::all().iter().zip(zoo_generated().iter().zip(again)) {
        assert!(again == *text, "{} is generated in two ways", entry.name);
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
    let methods = ["prepare", "mass_matrix"];
    insta::assert_snapshot!(excerpt(&cart_pole::entry(), &methods));
}

#[test]
fn code_of_the_robojudge() {
    insta::assert_snapshot!(excerpt(&robo_judge::entry(), &["mass_matrix", "lagrangian"]));
}
