//! Says to the linker where memory is, and that a panic path is an error.

use std::env;
use std::fs;
use std::path::Path;

fn main() {
    let variable = |name: &str| env::var(name).unwrap_or_default();
    let memory = match variable("CARGO_CFG_TARGET_ARCH").as_str() {
        "arm" => "arm.x",
        "riscv32" => "riscv32.x",
        _ => return, // `cargo check` on the host
    };
    let out = variable("OUT_DIR");
    let link = Path::new(env!("CARGO_MANIFEST_DIR")).join("link");
    fs::copy(link.join(memory), Path::new(&out).join("memory.x"))
        .expect("a build may write to its own folder");
    println!("cargo::rustc-link-search={out}");
    if variable("OPT_LEVEL") != "0" {
        println!("cargo::rustc-link-arg-bins=-T{}", link.join("no_panic.x").display());
    }
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rerun-if-changed=link");
}
