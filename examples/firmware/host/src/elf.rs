//! A program as it was linked: its functions, and whether there are any that must not be.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};

use crate::Result;

/// A function in flash.
#[derive(Clone, Debug)]
pub(crate) struct Function {
    /// Its name as Rust has it, without the hash.
    pub(crate) name: String,
    /// The address of its first instruction.
    pub(crate) address: u32,
    /// Its instructions and the constants between them.
    pub(crate) code: Vec<u8>,
}

/// All functions of a program, by their addresses.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) functions: Vec<Function>,
}

/// What must not be in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Forbidden {
    Panic,
    Heap,
    Double,
    Libm,
}

impl Program {
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let data = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let file = object::File::parse(&*data).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut functions: Vec<_> = file
            .symbols()
            .filter(|symbol| symbol.kind() == SymbolKind::Text)
            .filter_map(|symbol| {
                let address = symbol.address() & !1; // bit 0 says Thumb
                let section = file.section_by_index(symbol.section_index()?).ok()?;
                let code = section.data_range(address, symbol.size()).ok()??.to_vec();
                let name = format!("{:#}", rustc_demangle::demangle(symbol.name().ok()?));
                Some(Function { name, address: u32::try_from(address).ok()?, code })
            })
            .collect();
        functions.sort_by(|a, b| (a.address, &a.name).cmp(&(b.address, &b.name)));
        Ok(Self { functions })
    }

    /// The function whose code is at `address`.
    pub(crate) fn function_at(&self, address: u32) -> Option<&Function> {
        let behind = self.functions.partition_point(|function| function.address <= address);
        let candidates = self.functions.get(..behind)?.iter().rev();
        candidates.take(16).find(|function| ((address - function.address) as usize) < function.code.len())
    }

    /// The code of the function that begins at `address`.
    pub(crate) fn code_at(&self, address: u32) -> Option<&[u8]> {
        self.function_at(address)
            .filter(|function| function.address == address)
            .map(|function| &function.code[..])
    }

    /// What must not be there and is, with its name.
    pub(crate) fn forbidden(&self) -> BTreeSet<(Forbidden, &str)> {
        let names = self.functions.iter().map(|function| function.name.as_str());
        names.filter_map(|name| Some((forbidden(name)?, name))).collect()
    }
}

/// What the name of a function says of it.
fn forbidden(name: &str) -> Option<Forbidden> {
    const LIBM: [&str; 16] = [
        "sin", "cos", "sincos", "tan", "sqrt", "fma", "fmin", "fmax", "pow", "exp", "log", "atan2", "floor",
        "round", "rint", "fmod",
    ];
    let last = name.rsplit("::").next().unwrap_or(name);
    let helper = last.strip_prefix("__").unwrap_or("");
    let of_doubles = match helper.strip_prefix("aeabi_") {
        Some(helper) => helper.starts_with('d') || helper.starts_with("cd") || helper.ends_with("2d"),
        None => helper.contains("df"),
    };
    // An integer's division begins as a double's names do.
    let of_integers = ["aeabi_idiv", "aeabi_uidiv", "aeabi_ldivmod", "aeabi_uldivmod"].contains(&helper);
    let in_libm = LIBM.iter().any(|known| last == *known || last.strip_suffix('f') == Some(known));
    if name.contains("panicking") || name.contains("rust_begin_unwind") || name.contains("unwrap_failed") {
        Some(Forbidden::Panic)
    } else if name.contains("__rust_alloc")
        || name.starts_with("alloc::")
        || ["malloc", "free"].contains(&name)
    {
        Some(Forbidden::Heap)
    } else if of_doubles && !of_integers && helper != "aeabi_dmb" {
        Some(Forbidden::Double)
    } else if name.contains("libm::") || in_libm && !name.contains("firmware") && !name.contains("::") {
        Some(Forbidden::Libm)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_is_forbidden() {
        for (name, what) in [
            ("core::panicking::panic_fmt", Some(Forbidden::Panic)),
            ("__rustc::rust_begin_unwind", Some(Forbidden::Panic)),
            ("core::option::unwrap_failed", Some(Forbidden::Panic)),
            ("__rustc::__rust_alloc", Some(Forbidden::Heap)),
            ("__aeabi_dadd", Some(Forbidden::Double)),
            ("__aeabi_f2d", Some(Forbidden::Double)),
            ("__aeabi_cdcmple", Some(Forbidden::Double)),
            ("compiler_builtins::float::add::__adddf3", Some(Forbidden::Double)),
            ("__truncdfsf2", Some(Forbidden::Double)),
            ("sinf", Some(Forbidden::Libm)),
            ("cos", Some(Forbidden::Libm)),
            ("libm::math::rem_pio2f", Some(Forbidden::Libm)),
            ("__aeabi_fadd", None),
            ("__addsf3", None),
            ("__aeabi_memcpy4", None),
            ("__aeabi_uidiv", None),
            ("methods::scalar::sin_cos", None),
        ] {
            assert_eq!(forbidden(name), what, "{name}");
        }
    }
}
