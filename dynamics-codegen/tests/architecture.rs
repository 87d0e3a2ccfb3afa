//! The invariants of `ARCHITECTURE.md` that can be read off the sources.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::fs;
use std::path::{Path, PathBuf};

use dynamics_codegen::diagnostics::Code;
use dynamics_codegen::model::names::hides_a_common_name;

/// The modules of the compiler. Each may use those before it, and none after.
const LADDER: &[&str] =
    &["diagnostics", "symbolic", "closed", "spatial", "spec", "model", "mechanics", "passes", "emit"];

/// Files longer than this are two files.
const LINE_LIMIT: usize = 600;

/// A source file, by its path from the workspace's root.
struct Source {
    path: String,
    text: String,
}

impl Source {
    /// The lines without comments, with their numbers from 1.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let uncommented = |line| str::split(line, "//").next().unwrap_or_default();
        self.text.lines().enumerate().map(move |(i, line)| (i + 1, uncommented(line)))
    }

    /// The modules that lead to the file from its crate's root: `spec`, `joint`.
    fn module(&self) -> Vec<&str> {
        let (_, inner) = self.path.split_once("src/").unwrap();
        let mut module: Vec<_> = inner.strip_suffix(".rs").unwrap().split('/').collect();
        module.pop_if(|last| matches!(*last, "mod" | "lib"));
        module
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The packages of the workspace, by their folders.
fn members() -> Vec<String> {
    let manifest = read("Cargo.toml");
    let list = manifest.split("members = [").nth(1).unwrap().split(']').next().unwrap();
    list.split(',').map(|member| member.trim().trim_matches('"').to_owned()).collect()
}

/// The packages of the firmware, which are a workspace of their own.
const FIRMWARE: [&str; 3] =
    ["examples/firmware/control", "examples/firmware/board", "examples/firmware/host"];

/// The packages of both workspaces.
fn packages() -> Vec<String> {
    members().into_iter().chain(FIRMWARE.map(str::to_owned)).collect()
}

/// All Rust files under a folder, in order; not what tests of error messages are about.
fn sources(folder: &str) -> Vec<Source> {
    let (mut files, mut folders) = (vec![], vec![root().join(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if path.is_dir() && !matches!(name, "ui" | "target" | "snapshots") {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    let source = |path: PathBuf| Source {
        text: fs::read_to_string(&path).unwrap(),
        path: path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/"),
    };
    files.into_iter().map(source).collect()
}

/// The names under a table of a manifest, as `[dependencies]`.
fn keys(manifest: &str, table: &str) -> Vec<String> {
    let lines = manifest.lines().skip_while(|line| line.trim() != table).skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let name = |line: &str| line.split(['.', '=', ' ', '#']).next().unwrap().to_owned();
    lines.map(name).filter(|name| !name.is_empty()).collect()
}

/// The first name of each path that starts at the crate's root, with its line; all names of `crate::{a, b::{c, d}}`.
fn used_modules(source: &Source) -> Vec<(usize, String)> {
    let code: String = source.code().map(|(_, line)| format!("{line}\n")).collect();
    let mut used = vec![];
    for (at, prefix) in code.match_indices("crate::") {
        let line = code[..at].matches('\n').count() + 1;
        let path = &code[at + prefix.len()..];
        let (mut depth, mut starts, mut name) = (0, true, String::new());
        for letter in path.chars() {
            if letter.is_alphanumeric() || letter == '_' {
                name.extend(starts.then_some(letter));
                continue;
            }
            if !name.is_empty() {
                used.push((line, std::mem::take(&mut name)));
                starts = false;
            }
            depth += i32::from(letter == '{') - i32::from(letter == '}');
            starts = depth == 1 && (matches!(letter, '{' | ',') || starts && letter.is_whitespace());
            if depth <= 0 {
                break;
            }
        }
    }
    used
}

#[test]
fn modules_use_only_those_before_them() {
    for (rung, module) in LADDER.iter().enumerate() {
        for source in sources(&format!("dynamics-codegen/src/{module}")) {
            for (line, used) in used_modules(&source) {
                let used_rung = LADDER.iter().position(|known| *known == used);
                let allowed = used_rung.is_some_and(|used| used <= rung);
                assert!(allowed, "{}:{line}: `{module}` must not know `{used}`", source.path);
            }
        }
    }
}

/// What leaves a module does so by `crate::…`, where the test above sees it.
#[test]
fn no_path_climbs_out_of_a_rung() {
    for source in sources("dynamics-codegen/src") {
        let mut depth = source.module().len();
        for (line, code) in source.code() {
            depth += usize::from(code.contains("mod tests {"));
            let climbs = (1..).take_while(|&n| code.contains(&"super::".repeat(n))).count();
            assert!(climbs < depth.max(1), "{}:{line}: write `crate::…`", source.path);
        }
    }
}

#[test]
fn the_ladder_is_all_there_is() {
    let found: Vec<_> = sources("dynamics-codegen/src")
        .iter()
        .filter_map(|source| source.module().first().map(|&first| first.to_owned()))
        .collect();
    for module in &found {
        assert!(LADDER.contains(&module.as_str()), "`{module}` has no rung");
    }
    let map = read("ARCHITECTURE.md");
    for module in LADDER {
        assert!(found.iter().any(|known| known == module), "there is no `{module}`");
        assert!(map.contains(&format!("`{module}`")), "ARCHITECTURE.md does not name `{module}`");
    }
    assert!(map.lines().count() <= 200, "ARCHITECTURE.md is a map, not a book");
}

#[test]
fn paths_are_read_as_rust_reads_them() {
    let text = "use crate::a::{b, c};\nuse crate::{\n    d::e,\n    f::{g, h} as l, // crate::i\n};\nlet x = crate::j;";
    let source = Source { path: "src/k.rs".to_owned(), text: text.to_owned() };
    let names: Vec<_> =
        used_modules(&source).into_iter().map(|(line, name)| format!("{line}{name}")).collect();
    assert_eq!(names, ["1a", "2d", "2f", "6j"]);
}

#[test]
fn every_file_says_what_it_is_and_is_short() {
    for source in members().iter().flat_map(|member| sources(member)) {
        let Source { path, text } = source;
        assert!(text.starts_with("//! "), "{path} does not open with `//! `");
        let lines = text.lines().count();
        assert!(lines <= LINE_LIMIT, "{path} has {lines} lines, {LINE_LIMIT} are allowed");
    }
}

#[test]
fn every_file_is_reached() {
    for member in ["dynamics-codegen", "dynamics-core"] {
        let all = sources(&format!("{member}/src"));
        for source in &all {
            let module = source.module();
            let Some((name, parent)) = module.split_last() else { continue };
            let parent = all.iter().find(|candidate| candidate.module() == parent).unwrap();
            let reached = parent.text.contains(&format!("mod {name};"));
            assert!(reached, "{} has no `mod {name};`, which {} needs", parent.path, source.path);
        }
    }
}

/// Where a manifest says what is tested, and Cargo looks for nothing else, nothing else is there.
#[test]
fn no_test_is_left_out() {
    for member in members() {
        let manifest = read(&format!("{member}/Cargo.toml"));
        if manifest.contains("\ntest = false\ndoctest = false") {
            for Source { path, text } in sources(&format!("{member}/src")) {
                assert!(!text.contains("#[test]") && !text.contains("/ ```"), "{path} is not tested");
            }
        }
        if manifest.contains("autotests = false") {
            let tests = sources(&format!("{member}/tests"));
            let name_of = |source: &Source| {
                let file = source.path.strip_prefix(&format!("{member}/tests/")).unwrap();
                file.strip_suffix(".rs").unwrap().to_owned()
            };
            let is_program =
                |source: &&Source| manifest.contains(&format!("[[test]]\nname = \"{}\"", name_of(source)));
            let programs: Vec<_> = tests.iter().filter(is_program).collect();
            for source in &tests {
                let name = name_of(source);
                let names_it = |program: &&Source| program.text.contains(&format!("\nmod {name};"));
                let is_part = name.contains('/') || programs.iter().any(names_it);
                assert!(is_part || is_program(&source), "{} is not run", source.path);
            }
        }
    }
}

#[test]
fn unsafe_code_is_forbidden_everywhere() {
    let forbids = |manifest: &str| manifest.contains("unsafe_code = \"forbid\"");
    assert!(forbids(&read("Cargo.toml")) && forbids(&read("examples/firmware/Cargo.toml")));
    for member in packages() {
        let manifest = read(&format!("{member}/Cargo.toml"));
        assert!(
            manifest.contains("[lints]\nworkspace = true") || forbids(&manifest),
            "{member} forbids nothing"
        );
    }
}

/// What the table of invariants names as held by a test is a test.
#[test]
fn invariants_are_held_by_tests_that_exist() {
    let map = read("ARCHITECTURE.md");
    let table = map.split("## Invariants").nth(1).unwrap().split("\n## ").next().unwrap();
    let tests = sources("dynamics-codegen/tests");
    let names = table.split('`').skip(1).step_by(2);
    let is_test = |name: &&str| name.matches('_').count() >= 2 && !name.contains(['/', '.']);
    for name in names.filter(is_test).filter(|name| *name != "iter_over_hash_type") {
        let heading = format!("\nfn {name}()");
        assert!(tests.iter().any(|test| test.text.contains(&heading)), "there is no test `{name}`");
    }
}

/// Nothing of the run time, of the compiler that runs it, or of the outside world.
#[test]
fn the_compiler_depends_on_text_alone() {
    let manifest = read("dynamics-codegen/Cargo.toml");
    assert_eq!(keys(&manifest, "[dependencies]"), ["syn", "quote", "proc-macro2", "rustc-hash", "roxmltree"]);
    let forbidden = [
        "std::fs",
        "std::env",
        "std::io",
        "std::net",
        "std::process",
        "std::time",
        "std::thread::spawn",
        "collections::Hash",
        "proc_macro::",
        "println!",
        "nalgebra::",
    ];
    for source in sources("dynamics-codegen/src") {
        for (line, code) in source.code() {
            let found = forbidden.iter().find(|forbidden| code.contains(**forbidden));
            assert!(found.is_none(), "{}:{line}: the compiler uses `{}`", source.path, found.unwrap());
        }
    }
}

/// The files of the run time that have a heap: what they do is to record, and to move what has no size before it is
/// read. Their `mod`s stand behind the feature `std`.
const ON_THE_HEAP: [&str; 2] = ["trajectory", "heap"];

#[test]
fn the_run_time_has_no_heap() {
    let simulate = read("dynamics-core/src/simulate.rs");
    let is_gated = |name: &&str| simulate.contains(&format!("#[cfg(feature = \"std\")]\nmod {name};"));
    assert!(ON_THE_HEAP.iter().all(is_gated), "what has a heap is not behind `std`");
    let heap = ON_THE_HEAP.map(|name| format!("dynamics-core/src/simulate/{name}.rs"));
    for source in sources("dynamics-core/src").into_iter().filter(|source| !heap.contains(&source.path)) {
        for (line, code) in source.code() {
            let found =
                ["alloc::", "Vec<", "vec!", "Box<", "String"].into_iter().find(|word| code.contains(word));
            assert!(
                found.is_none() || code.contains("std::string"),
                "{}:{line}: {}",
                source.path,
                found.unwrap()
            );
        }
    }
}

/// What generated code imports would hide a robot or a frame of that name.
#[test]
fn names_that_generated_code_imports_are_known() {
    let text = read("dynamics-core/src/__private.rs");
    let imports = text.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    let words = imports.flat_map(|import| import.split(|c: char| !c.is_alphanumeric()));
    let types: Vec<&str> = words.filter(|word| word.starts_with(char::is_uppercase)).collect();
    assert!(types.contains(&"Factors"), "{types:?}");
    let unknown: Vec<_> = types.iter().filter(|name| !hides_a_common_name(name)).collect();
    assert!(unknown.is_empty(), "not in `COMMON` of model/names.rs: {unknown:?}");
}

#[test]
fn every_dependency_has_its_reason() {
    let reasons = read("DESIGN.md");
    for member in packages() {
        let manifest = read(&format!("{member}/Cargo.toml"));
        let tables = manifest.lines().filter(|line| line.starts_with('[') && line.ends_with("dependencies]"));
        let of_all = tables.flat_map(|table| keys(&manifest, table));
        for name in of_all.filter(|name| !name.starts_with("dynamics-") && !name.starts_with("firmware-")) {
            assert!(
                reasons.contains(&format!("| `{name}` |")),
                "DESIGN.md does not say why {member} needs {name}"
            );
        }
    }
}

#[test]
fn the_reference_of_the_derive_is_complete() {
    let reference = read("dynamics-macros/src/lib.rs");
    for code in Code::ALL {
        assert!(
            reference.contains(&format!("`{}`", code.name())),
            "`{}` is not in the reference",
            code.name()
        );
    }
    for source in sources("dynamics-codegen/src/spec") {
        for list in source.text.split("const KEYS: &[&str] = &[").skip(1) {
            let keys = list.split(']').next().unwrap().split(',').map(|key| key.trim().trim_matches('"'));
            for key in keys.filter(|key| !key.is_empty()) {
                let documented =
                    [" =", "("].iter().any(|next| reference.contains(&format!("| `{key}{next}")));
                assert!(documented, "`{key}` of {} is not in the reference", source.path);
            }
        }
    }
}
