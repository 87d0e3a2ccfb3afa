//! `dynamics generate FILE --lang rust` or `c`: the code of a robot, as files to commit.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use dynamics_codegen::emit::c::{PREFIX_LIMIT, Real, check_prefix};
use dynamics_codegen::model::names::{hides_a_common_name, snake_case, upper_camel_case};
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::spec::urdf::Report;
use dynamics_codegen::{generate_c, generate_rust};

use crate::failure::{Failure, Problem};
use crate::input::{Input, name_of, shown};
use crate::output::{check_writable, failed, print, writer};
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::NAME;
use crate::rust_item;

/// Write the code of a robot: a file to commit and to include by `mod`, or a header and a source in C99
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// The language
    #[arg(long)]
    lang: Language,

    /// The type of all numbers in C; in Rust a robot serves every scalar
    #[arg(long, value_name = "TYPE", default_value = "float")]
    scalar: Scalar,

    /// The struct's name, or what all names in C begin with; without it, the robot's in the file
    #[arg(long)]
    name: Option<String>,

    /// The methods to write, with commas between them, as in `#[dynamics(outputs(…))]`; without it, all
    #[arg(long, value_name = "METHODS")]
    outputs: Option<String>,

    /// The file to write; without it, standard output. In C the folder for NAME.h and NAME.c; without it, this one
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,

    /// Write nothing, and fail if OUT is not what would be written
    #[arg(long)]
    check: bool,
}

/// A language that code is written in.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Language {
    /// `no_std`, for the crate `dynamics-core`
    Rust,
    /// C99, for nothing
    C,
}

/// The types of numbers in C.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Scalar {
    Float,
    Double,
}

const EXAMPLES: &str = "\
Examples:
  dynamics generate arm.urdf --lang rust --name Arm -o src/arm.rs
  dynamics generate arm.urdf --lang rust --name Arm -o src/arm.rs --check
  dynamics generate dog.urdf --lang rust --base free --joint 'knee, rotor = 5e-5, gear = 100'
  dynamics generate arm.urdf --lang c --scalar float --name arm -o firmware/src
  dynamics generate arm.urdf --lang c --outputs inverse_dynamics,pose -o firmware/src";

/// A file of code.
struct File {
    /// `None` is standard output.
    path: Option<PathBuf>,
    text: String,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    if args.check && args.lang == Language::Rust && args.output.is_none() {
        let problem = Problem::new("`--check` of a file in Rust needs `--output`");
        return Err(Failure::CommandLine(problem.help("name the file by `-o`").into()));
    }
    let given = args.name.as_deref().map(|name| checked(name, args.lang)).transpose()?;
    let input = args.input.read_with(|attributes| {
        if let Some(outputs) = &args.outputs {
            attributes.add("outputs", "#[dynamics(outputs(", outputs, "))]");
        }
    })?;
    if args.lang == Language::Rust && !args.check {
        check_writable(args.output.as_deref(), &args.input.file)?;
    }
    let (mut spec, report) = input.spec(&[])?;
    input.warn(&report);
    let name = match given {
        Some(name) => name.to_owned(),
        None => name_in_file(&report, args.lang),
    };
    if args.lang == Language::Rust {
        spec.ident = syn::Ident::new(&name, spec.ident.span());
    }
    let files = {
        let _progress = Progress::of(&format!("generating {name}"));
        match args.lang {
            Language::Rust => vec![File { path: args.output.clone(), text: rust(args, &input, &spec)? }],
            Language::C => c(args, &input, &spec, &name)?,
        }
    };
    for File { path, text } in &files {
        match path {
            Some(path) if args.check => compare(args, &input, path, &name, text)?,
            Some(path) => {
                let mut file = writer(Some(path), &args.input.file)?;
                let written = file.write_all(text.as_bytes()).and_then(|()| file.flush());
                written.map_err(|error| failed(Some(path), &error))?;
            }
            None => print(text)?,
        }
    }
    Ok(())
}

/// A name as given, if it can be one.
fn checked(name: &str, lang: Language) -> Result<&str, Failure> {
    let why = match lang {
        Language::Rust if syn::parse_str::<syn::Ident>(name).is_ok() => None,
        Language::Rust => Some("this is no identifier of Rust".to_owned()),
        Language::C => check_prefix(name).err(),
    };
    let refused = |why| Problem::new(format!("`--name {}`: {why}", shown(name))).help("give another name");
    why.map_or(Ok(name), |why| Err(Failure::CommandLine(refused(why).into())))
}

/// The robot's name as that of a type or a prefix, if it can be one.
fn name_in_file(report: &Report, lang: Language) -> String {
    match lang {
        Language::Rust => rust_name(report),
        Language::C => prefix(report),
    }
}

/// The name of a robot's struct, if nobody gives it another one.
pub(crate) fn rust_name(report: &Report) -> String {
    let name = upper_camel_case(report.robot.as_deref().unwrap_or_default());
    let fits = syn::parse_str::<syn::Ident>(&name).is_ok() && !hides_a_common_name(&name);
    if fits { name } else { NAME.to_owned() }
}

fn prefix(report: &Report) -> String {
    let letter = |c: &char| c.is_ascii_alphanumeric() || *c == '_';
    let name = snake_case(report.robot.as_deref().unwrap_or_default());
    let mut prefix: String = name.chars().filter(letter).take(PREFIX_LIMIT).collect();
    prefix.truncate(prefix.trim_end_matches('_').len());
    if check_prefix(&prefix).is_ok() { prefix } else { NAME.to_lowercase() }
}

/// What stands first in a file: what it was made from, and how to make it again.
fn origin(args: &Args, input: &Input, name: &str) -> [String; 2] {
    // Where the file is differs from machine to machine, and must not make a difference.
    let file = file_name(args);
    let version = env!("CARGO_PKG_VERSION");
    let made = format!("@generated by dynamics {version} from {file}. Do not edit.");
    [made, format!("Again: dynamics generate {file}{}", options(args, input, name))]
}

fn file_name(args: &Args) -> String {
    let file = args.input.file.file_name().filter(|file| *file != "-");
    file.map_or("standard input".to_owned(), |file| shown(&file.to_string_lossy()))
}

/// All options but the place of the output.
fn options(args: &Args, input: &Input, name: &str) -> String {
    let lang = match (args.lang, args.scalar) {
        (Language::Rust, _) => "rust",
        (Language::C, Scalar::Float) => "c --scalar float",
        (Language::C, Scalar::Double) => "c --scalar double",
    };
    format!(" --lang {lang} --name {name}{}", input.flags())
}

/// The header and the source.
fn c(args: &Args, input: &Input, spec: &RobotSpec, name: &str) -> Result<Vec<File>, Failure> {
    let wrong = |found| Failure::mistakes(found, input);
    let real = match args.scalar {
        Scalar::Float => Real::Float,
        Scalar::Double => Real::Double,
    };
    let written = generate_c(spec, name, real, &origin(args, input, name)).map_err(wrong)?;
    for left in &written.left_out {
        // Nobody is left to be told that there is nobody to tell.
        let _ =
            writeln!(std::io::stderr(), "left out: `{}`, for which the robot is too large", left.function);
    }
    let folder = args.output.clone().unwrap_or_default();
    if !args.check && !folder.as_os_str().is_empty() {
        std::fs::create_dir_all(&folder).map_err(|error| failed(Some(&folder), &error))?;
    }
    let file = |ending: &str, text: String| {
        let path = Some(folder.join(format!("{name}.{ending}")));
        File { path, text }
    };
    Ok(vec![file("h", written.header), file("c", written.source)])
}

fn rust(args: &Args, input: &Input, spec: &RobotSpec) -> Result<String, Failure> {
    let spec = RobotSpec { vis: syn::parse_quote!(pub), ..spec.clone() };
    let name = spec.ident.to_string();
    let [made, again] = origin(args, input, &name);
    let file = file_name(args);
    let item = match input.item() {
        Some(item) => rust_item::written(&input.text, item, &spec),
        None => format!(
            "/// The robot of `{file}`: its methods are those of the traits of `dynamics_core`.\n\
             #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]\n\
             pub struct {name};\n"
        ),
    };
    let code = generate_rust(&spec).map_err(|found| Failure::mistakes(found, input))?;
    Ok(format!(
        "// {made}\n\
         // {again} -o …\n\
         #![allow(unreachable_pub, reason = \"generated code\")]\n\n{item}\n{code}"
    ))
}

fn compare(args: &Args, input: &Input, path: &Path, name: &str, text: &str) -> Result<(), Failure> {
    let found = match std::fs::read(path) {
        Ok(found) => String::from_utf8_lossy(&found).replace("\r\n", "\n"),
        Err(error) => {
            let problem = Problem::new(format!("{} cannot be read: {error}", name_of(path)));
            return Err(problem.help(again(args, input, path, name)).into());
        }
    };
    if found == text {
        return Ok(());
    }
    let same = found.lines().zip(text.lines()).take_while(|(found, new)| found == new).count();
    let title = format!("{} is stale: it differs from line {} on", name_of(path), same + 1);
    Err(Problem::new(title).help(again(args, input, path, name)).into())
}

/// How to bring a file up to date.
fn again(args: &Args, input: &Input, path: &Path, name: &str) -> String {
    let (file, options) = (name_of(&args.input.file), options(args, input, name));
    let output = match args.lang {
        Language::Rust => Some(path),
        Language::C => path.parent().filter(|folder| !folder.as_os_str().is_empty()),
    };
    let output = output.map_or(String::new(), |output| format!(" -o {}", name_of(output)));
    format!("run `dynamics generate {file}{options}{output}`")
}
