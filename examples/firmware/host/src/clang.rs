//! The robots in C: written, compiled with the programs of `c/`, and linked for the board.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use dynamics_codegen::emit::c::Real;
use dynamics_codegen::spec::urdf::Urdf;
use dynamics_codegen::spec::{self, RobotSpec};
use dynamics_codegen::{diagnostics::Diagnostics, generate_c};

use syn::parse::Parser;

use crate::Result;
use crate::cargo::{root, target_folder};

/// The robots in C by their prefixes, and the structs that they are in Rust.
pub(crate) const ROBOTS: [(&str, &str); 4] =
    [("cart_pole", "CartPole"), ("leg", "Leg"), ("puma560", "Puma560"), ("iiwa14", "Iiwa14")];

/// What of them is written: what `c/methods.c` calls.
const OUTPUTS: &str = "#[dynamics(outputs(mass_matrix, coriolis_matrix, gravity_forces, bias_forces, \
                       equations_of_motion, inverse_dynamics, forward_dynamics, inverse_dynamics_derivatives, \
                       forward_dynamics_derivatives))]";

/// What C is compiled with, as `c/README.md` has it.
pub(crate) const FLAGS: &str = "--target=thumbv7em-none-eabihf -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard \
                                -std=c99 -O2 -ffreestanding -ffunction-sections -fno-math-errno -ffp-contract=off";

/// What a compiler is to complain about.
pub(crate) const WARNINGS: &str = "-pedantic -Wall -Wextra -Wconversion -Wdouble-promotion -Wshadow \
                                   -Wstrict-prototypes -Wmissing-prototypes -Wfloat-equal -Werror";

/// Whether a compiler of C is installed.
pub(crate) fn is_there() -> bool {
    Command::new("clang").arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Writes and compiles all; the folder that the programs are in.
pub(crate) fn build() -> Result<PathBuf> {
    let folder = target_folder().join("c");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let sources = root().join("c");
    let mut objects = vec![];
    for (prefix, name) in ROBOTS {
        let files = generate_c(&specification(name)?, prefix, Real::Float, &origin(name))
            .map_err(|mistakes| format!("{name}: {}", mistakes.into_text()))?;
        for (ending, text) in [("h", files.header), ("c", files.source)] {
            let path = folder.join(format!("{prefix}.{ending}"));
            fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        objects.push(compile(&folder.join(format!("{prefix}.c")), &folder)?);
    }
    objects.push(compile(&sources.join("board.c"), &folder)?);
    for program in ["control", "methods"] {
        let object = compile(&sources.join(format!("{program}.c")), &folder)?;
        let mut command = Command::new("clang");
        command.args(FLAGS.split_whitespace()).args(["-nostdlib", "-Wl,--gc-sections"]);
        command.arg(format!("--ld-path={}", linker()?.display()));
        command.arg(format!("-Wl,-T,{}", sources.join("board.ld").display()));
        command.args(&objects).arg(object).arg("-o").arg(folder.join(program));
        run(&mut command, program)?;
    }
    Ok(folder)
}

/// The compiler's name and version, `clang 14.0.6`.
pub(crate) fn version() -> Result<String> {
    let output =
        Command::new("clang").arg("--version").output().map_err(|error| format!("clang: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let number = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()));
    Ok(format!("clang {}", number.unwrap_or_default()))
}

fn compile(source: &Path, folder: &Path) -> Result<PathBuf> {
    let name = source.file_stem().unwrap_or_default().to_string_lossy();
    let object = folder.join(format!("{name}.o"));
    let mut command = Command::new("clang");
    command.args(FLAGS.split_whitespace()).args(WARNINGS.split_whitespace());
    command.arg("-I").arg(folder).arg("-c").arg(source).arg("-o").arg(&object);
    run(&mut command, &name)?;
    Ok(object)
}

fn run(command: &mut Command, what: &str) -> Result<()> {
    let output = command.output().map_err(|error| format!("clang: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(()) } else { Err(format!("{what} in C does not build:\n{said}")) }
}

/// The linker that Rust brings.
fn linker() -> Result<PathBuf> {
    let output = Command::new("rustc")
        .args(["--print", "target-libdir"])
        .output()
        .map_err(|error| format!("rustc: {error}"))?;
    let libraries = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let linker = libraries.parent().unwrap_or(&libraries).join("bin/gcc-ld/ld.lld");
    if linker.exists() { Ok(linker) } else { Err(format!("there is no {}", linker.display())) }
}

fn origin(name: &str) -> [String; 1] {
    [format!("@generated from `{name}` of control/src/robots.rs, by `cargo run`. Do not edit.")]
}

/// The robot of a struct of `firmware_control::robots`, with its file where it names one.
fn specification(name: &str) -> Result<RobotSpec> {
    let folder = root().join("control");
    let read = |path: &Path| fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()));
    let file = syn::parse_file(&read(&folder.join("src/robots.rs"))?).map_err(|error| error.to_string())?;
    let robot = file.items.into_iter().find_map(|item| match item {
        syn::Item::Struct(item) if item.ident == name => Some(syn::DeriveInput::from(item)),
        _ => None,
    });
    let mut robot = robot.ok_or_else(|| format!("there is no struct `{name}`"))?;
    let outputs = syn::Attribute::parse_outer.parse_str(OUTPUTS).map_err(|error| error.to_string())?;
    robot.attrs.extend(outputs);
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(&robot, &mut diags);
    if let Some(path) = spec.options.urdf.clone() {
        let text = read(&folder.join(&path.text))?;
        spec::urdf::read(&mut spec, Urdf { file: &path.text, text: &text }, &mut diags);
    }
    let mistakes = diags.into_text();
    if mistakes.is_empty() { Ok(spec) } else { Err(format!("{name}: {mistakes}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = include_str!("../../c/README.md");

    /// What the page tells authors of C to type is what is typed here.
    #[test]
    fn the_page_has_these_flags() {
        let words: Vec<&str> = PAGE.split_whitespace().collect();
        for flag in FLAGS.split_whitespace().chain(WARNINGS.split_whitespace()) {
            assert!(words.contains(&flag) || flag == "-Werror", "c/README.md has no `{flag}`");
        }
    }

    /// The options of the page say what the struct says.
    #[test]
    fn the_page_makes_the_leg_of_the_struct() {
        let urdf = fs::read_to_string(root().join("control/leg.urdf")).expect("it is there");
        let options = PAGE.split("--joint '").skip(1).filter_map(|option| option.split('\'').next());
        let joints: String = options.map(|joint| format!("#[joint({joint})]\n")).collect();
        let attributes = format!("{OUTPUTS}\n{joints}");
        let file = Urdf { file: "leg.urdf", text: &urdf };
        let Ok((typed, _)) = dynamics_codegen::read_urdf("Leg", file, &attributes) else {
            panic!("the options are no attributes: {attributes}");
        };
        let of_struct = specification("Leg").expect("it is a robot");
        let written = |spec| generate_c(spec, "leg", Real::Float, &origin("Leg")).map_err(|m| m.into_text());
        let (typed, of_struct) = (written(&typed), written(&of_struct));
        assert!(typed.is_ok() && typed == of_struct);
    }
}
