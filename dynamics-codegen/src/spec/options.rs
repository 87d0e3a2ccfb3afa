//! `#[dynamics(gravity = […], urdf = "…", base = free, crate = "…", snap = off, passive = off, outputs(…), allow(…))]`

use super::cursor::{Cursor, Result};
use super::urdf::FilePath;
use super::values::{Entry, fill};
use super::{Formula, Name, Switch};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};

/// What holds for the whole robot. Several attributes add up.
#[derive(Clone, Default)]
pub struct Options {
    /// `gravity = [x, y, z]`: the acceleration of free fall in the world.
    pub gravity: Option<[Formula; 3]>,
    /// `urdf = "path"`: the file that has the robot.
    pub urdf: Option<FilePath>,
    /// `base = free | fixed`: how the root of the file stands in the world.
    pub base: Option<BaseSpec>,
    /// `crate = "path"`: where the run-time crate is found.
    pub krate: Option<syn::Path>,
    /// `snap = on | off`: whether rotations next to right angles become right angles.
    pub snap: Option<Switch>,
    /// `passive = on | off`: whether the damping and friction of a file act.
    pub passive: Option<Switch>,
    /// `outputs(…)`: the methods to emit; without it, all.
    pub outputs: Option<Vec<Name>>,
    /// `allow(…)`
    pub allow: Option<Vec<Name>>,
}

/// `base = free` or `base = fixed`.
#[derive(Clone, Debug)]
pub struct BaseSpec {
    /// Whether the root moves freely.
    pub is_free: bool,
    /// Where it was written.
    pub place: Place,
}

const KEYS: &[&str] = &["gravity", "urdf", "base", "crate", "snap", "passive", "outputs", "allow"];

impl Options {
    /// The path of the run-time crate.
    pub fn crate_path(&self) -> syn::Path {
        self.krate.clone().unwrap_or_else(|| syn::parse_quote!(::dynamics_core))
    }

    /// Whether to snap, which is the default.
    pub fn snaps(&self) -> bool {
        self.snap.as_ref().is_none_or(|switch| switch.is_on)
    }

    /// Whether the damping and friction of a file act, which is the default.
    pub fn is_passive(&self) -> bool {
        self.passive.as_ref().is_none_or(|switch| switch.is_on)
    }

    pub(super) fn read(&mut self, input: Cursor, diags: &mut Diagnostics) {
        for item in input.items() {
            let Some(entry) = diags.keep(Entry::parse(item, "option", KEYS)) else { continue };
            let key = entry.key.clone();
            match key.text.as_str() {
                "gravity" => fill(&mut self.gravity, &key, entry.vector(["x", "y", "z"]), diags),
                "crate" => fill(&mut self.krate, &key, crate_path(entry), diags),
                "urdf" => fill(&mut self.urdf, &key, file_path(entry), diags),
                "base" => fill(&mut self.base, &key, base(entry), diags),
                "passive" => fill(&mut self.passive, &key, entry.switch(), diags),
                "snap" => fill(&mut self.snap, &key, entry.switch(), diags),
                "outputs" => fill(&mut self.outputs, &key, entry.names(), diags),
                _ => fill(&mut self.allow, &key, entry.names(), diags),
            }
        }
    }
}

/// `= "path"`
fn quoted(entry: Entry, example: &str) -> Result<(syn::LitStr, Place)> {
    let mut value = entry.assigned()?;
    let place = value.here();
    let Some(literal) = value.literal() else { return Err(value.expected("a path in quotes")) };
    value.finish("the path")?;
    match syn::Lit::new(literal) {
        syn::Lit::Str(text) => Ok((text, place)),
        _ => Err(Diagnostic::new(Code::Syntax, &place, "expected a path in quotes").help(example)),
    }
}

fn file_path(entry: Entry) -> Result<FilePath> {
    let (text, place) = quoted(entry, "write `urdf = \"robots/arm.urdf\"`")?;
    Ok(FilePath { text: text.value(), place })
}

fn crate_path(entry: Entry) -> Result<syn::Path> {
    let (text, place) = quoted(entry, "write `crate = \"::path::to::dynamics_core\"`")?;
    text.parse_with(syn::Path::parse_mod_style).map_err(|_| {
        Diagnostic::new(Code::Syntax, &place, format!("`{}` is no path of a crate", text.value()))
    })
}

/// `= free`, `= fixed`
fn base(entry: Entry) -> Result<BaseSpec> {
    const BASE: &str = "`free` or `fixed`";
    let word = entry.name(BASE)?;
    let is_free = match word.text.as_str() {
        "free" => true,
        "fixed" => false,
        _ => {
            let message = format!("expected {BASE}, found `{word}`");
            let wrong = Diagnostic::new(Code::Syntax, &word.place, message);
            return Err(wrong.help("write `base = free` or `base = fixed`"));
        }
    };
    Ok(BaseSpec { is_free, place: word.place })
}
