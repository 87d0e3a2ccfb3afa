//! The commands of the README are run as they stand there.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{Done, folder};

/// The words of a line, as a shell has them: quotes are single ones.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut is_quoted, mut word) = (vec![], false, String::new());
    for c in line.chars().chain([' ']) {
        match c {
            '\'' => is_quoted = !is_quoted,
            ' ' if !is_quoted => {
                words.extend(Some(std::mem::take(&mut word)).filter(|word| !word.is_empty()))
            }
            c => word.push(c),
        }
    }
    words
}

#[test]
fn the_commands_of_the_readme_run() {
    let root: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned();
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let section = readme.split("\n## From the command line\n").nth(1).unwrap();
    let block = section.split("```text\n").nth(1).unwrap().split("```").next().unwrap();
    let block = block.replace("\\\n", " ");
    // They write files, so they stand in a folder of their own.
    let here = folder("readme");
    for robot in ["iiwa14", "hyq"] {
        let file = Path::new("tests/robots").join(robot).join("model.urdf");
        std::fs::create_dir_all(here.join(file.parent().unwrap())).unwrap();
        std::fs::copy(root.join(&file), here.join(&file)).unwrap();
    }
    for example in ["robojudge", "pendulum"] {
        let file = Path::new("examples").join(example).with_extension("rs");
        std::fs::create_dir_all(here.join("examples")).unwrap();
        std::fs::copy(root.join(&file), here.join(&file)).unwrap();
    }
    let mut commands = 0;
    for line in block.lines() {
        let words = words(line);
        assert_eq!(words[0], "dynamics", "{line}");
        let mut command = Command::new(env!("CARGO_BIN_EXE_dynamics"));
        let done = Done::of(command.args(&words[1..]).current_dir(&here).output().unwrap());
        match words[1].as_str() {
            "simulate" => done.unstopped(),
            _ => done.ok(),
        };
        commands += 1;
    }
    assert!(commands >= 8 && here.join("swing.csv").exists() && here.join("iiwa14.rs").exists());
}
