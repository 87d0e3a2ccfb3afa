//! `dynamics explain CODE`: what a mistake is, and what to do about it.

use dynamics_codegen::diagnostics::{Code, did_you_mean};

use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::output::print;

/// Explain a mistake by its code; without one, list all codes
#[derive(clap::Args)]
#[command(after_help = "Example:\n  dynamics explain dynamics::MassNegative")]
pub(crate) struct Args {
    /// As in `MassNegative`, or `dynamics::MassNegative`
    code: Option<String>,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let Some(asked) = &args.code else {
        let line = |code: &Code| format!("{}: {}\n", code.name(), first_line(code.explanation()));
        return print(&Code::ALL.iter().map(line).collect::<String>());
    };
    let name = asked.rsplit("::").next().unwrap_or(asked);
    let found = Code::ALL.iter().find(|code| code.name().eq_ignore_ascii_case(name));
    let Some(code) = found else {
        let problem = Problem::new(format!("there is no code `{}`", shown(asked)));
        let help = match did_you_mean(name, Code::ALL.iter().map(|code| code.name())) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => "`dynamics explain` lists all codes".to_owned(),
        };
        return Err(problem.help(help).into());
    };
    let explanation: Vec<&str> = code.explanation().lines().map(str::trim).collect();
    print(&format!("{code}\n\n{}\n\nhelp: {}\n", explanation.join("\n"), code.help()))
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default().trim()
}
