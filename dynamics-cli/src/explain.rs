//! `dynamics explain`: what a mistake is and what to do about it, by its code; and the equations of a robot, derived.

mod derivation;
mod document;
mod latex;
mod letters;
mod unicode;

use std::path::Path;

use clap::ValueEnum;
use dynamics_codegen::diagnostics::{Code, did_you_mean};
use dynamics_codegen::judged;
use dynamics_codegen::mechanics::lecture::lecture;
use dynamics_codegen::mechanics::letters::Letters;
use dynamics_codegen::symbolic::Graph;

use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::output::print;
use crate::progress::Progress;
use crate::reading::ReadingArgs;

/// Explain a mistake by its code, or derive the equations of a robot step by step
///
/// Of a code it says what the mistake is, and what to do; without anything it lists all codes. Of a robot it walks from the
/// bodies to Lagrange's equations, the state space and the linear model, as a lecture does.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// A code, as `MassNegative` or `dynamics::MassNegative`; or a file with a robot, `-` for standard input
    #[arg(value_name = "CODE or FILE")]
    asked: Option<String>,

    /// How the equations are written
    #[arg(long, value_name = "FORMAT", default_value = "unicode")]
    format: Format,

    #[command(flatten)]
    reading: ReadingArgs,
}

/// How equations are written.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// For a terminal
    Unicode,
    /// A document
    Latex,
    /// With LaTeX's mathematics between dollars
    Markdown,
}

const EXAMPLES: &str = "\
What is no code is a file; a file that is called like a code has a `./` before it.

Examples:
  dynamics explain dynamics::MassNegative
  dynamics explain arm.urdf
  dynamics explain examples/robojudge.rs --robot RoboJudge
  dynamics explain arm.rs --set 'g = 9.81' --format latex > arm.tex";

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let Some(asked) = &args.asked else {
        let line = |code: &Code| format!("{}: {}\n", code.name(), first_line(code.explanation()));
        return print(&Code::ALL.iter().map(line).collect::<String>());
    };
    let name = asked.rsplit("::").next().unwrap_or(asked);
    if let Some(code) = Code::ALL.iter().find(|code| code.name().eq_ignore_ascii_case(name)) {
        let explanation: Vec<&str> = code.explanation().lines().map(str::trim).collect();
        return print(&format!("{code}\n\n{}\n\nhelp: {}\n", explanation.join("\n"), code.help()));
    }
    let is_path = asked == "-" || asked.contains(['.', '/', '\\']) || Path::new(asked).exists();
    if is_path { derive(args, Path::new(asked)) } else { Err(unknown(asked, name)) }
}

fn unknown(asked: &str, name: &str) -> Failure {
    let problem = Problem::new(format!("there is no code `{}`, and no file", shown(asked)));
    let help = match did_you_mean(name, Code::ALL.iter().map(|code| code.name())) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => "`dynamics explain` lists all codes".to_owned(),
    };
    problem.help(help).into()
}

/// Derives the equations of a robot.
fn derive(args: &Args, file: &Path) -> Result<(), Failure> {
    let input = args.reading.read(file, |_| {})?;
    let (mut spec, report) = input.spec(&[])?;
    input.warn(&report);
    if let Some(name) = report.robot.as_deref().map(shown)
        && let Ok(ident) = syn::parse_str::<syn::Ident>(&name)
    {
        spec.ident = syn::Ident::new(&ident.to_string(), spec.ident.span());
    }
    let graph = Graph::new();
    let model = judged(&spec, &graph).map_err(|found| Failure::mistakes(found, &input))?;
    let text = {
        let _progress = Progress::of("deriving");
        let lecture = lecture(&model, &graph);
        let mut blocks = derivation::document(&model, &lecture);
        letters::settle(&mut blocks, &Letters::of(&lecture.notation));
        match args.format {
            Format::Unicode => unicode::written(&blocks, &lecture.notation),
            Format::Latex => latex::written(&blocks, &lecture.notation, latex::Kind::Whole),
            Format::Markdown => latex::written(&blocks, &lecture.notation, latex::Kind::Markdown),
        }
    };
    print(&text.trim_end().split('\n').map(shown).chain([String::new()]).collect::<Vec<_>>().join("\n"))
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default().trim()
}
