//! Builds of the firmware.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Result;

/// An architecture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// Cortex-M4 and M7 with single-precision floats in hardware.
    Arm,
    /// RISC-V without floats.
    RiscV,
}

impl Target {
    pub(crate) fn triple(self) -> &'static str {
        match self {
            Self::Arm => "thumbv7em-none-eabihf",
            Self::RiscV => "riscv32imac-unknown-none-elf",
        }
    }
}

/// A profile of `Cargo.toml`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Profile {
    /// Not optimised.
    Dev,
    /// For speed, without LTO.
    Plain,
    /// For speed, with LTO.
    Release,
    /// For space, with LTO.
    Small,
}

impl Profile {
    pub(crate) const ALL: [Self; 4] = [Self::Dev, Self::Plain, Self::Release, Self::Small];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Dev => "dev",
            Self::Plain => "plain",
            Self::Release => "release",
            Self::Small => "small",
        }
    }
}

/// The folder of this workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_path_buf).unwrap_or_default()
}

/// Builds all programs; the folder that they are in.
pub(crate) fn build(target: Target, profile: Profile) -> Result<PathBuf> {
    let status = command(target, profile).args(["--quiet", "--bins"]).status();
    match status {
        Ok(status) if status.success() => {}
        Ok(_) => {
            return Err(format!("the firmware does not build for {}, {}", target.triple(), profile.name()));
        }
        Err(error) => return Err(format!("cargo: {error}")),
    }
    let folder = if profile == Profile::Dev { "debug" } else { profile.name() };
    Ok(target_folder().join(target.triple()).join(folder))
}

/// Whether the linker refuses the program that has a panic path, for that reason.
pub(crate) fn refuses_panics(target: Target, profile: Profile) -> Result<bool> {
    let arguments = ["--quiet", "--bin", "panics", "--features", "panics"];
    let output =
        command(target, profile).args(arguments).output().map_err(|error| format!("cargo: {error}"))?;
    let refused = String::from_utf8_lossy(&output.stderr).contains("discarded section");
    Ok(!output.status.success() && refused)
}

fn command(target: Target, profile: Profile) -> Command {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root()).args(["build", "--package", "firmware-board"]);
    command.args(["--target", target.triple(), "--profile", profile.name()]);
    command.env("CARGO_TARGET_DIR", target_folder()).env_remove("CARGO_ENCODED_RUSTFLAGS"); // the host's
    command
}

pub(crate) fn target_folder() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// The compiler's version, `rustc 1.95.0`; what was measured depends on it.
pub(crate) fn rustc() -> Result<String> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("--version").output().map_err(|error| format!("rustc: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}
