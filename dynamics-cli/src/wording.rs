//! What the compiler says of attributes of Rust, said of options.

/// A text of the compiler, for the command line: `#[joint(…)]` is `--joint '…'`, `#[dynamics(snap = off)]` is
/// `--snap off`.
pub(crate) fn for_the_command_line(text: &str) -> String {
    let mut said = String::new();
    let mut rest = text;
    while let Some(start) = rest.find("#[") {
        let Some(length) = rest[start..].find(")]") else { break };
        let (attribute, behind) = rest[start..].split_at(length + ")]".len());
        said += &rest[..start];
        said += &option(attribute).unwrap_or_else(|| attribute.to_owned());
        rest = behind;
    }
    said += rest;
    for (written, given) in [
        ("`base = free`", "`--base free`"),
        // Many a link is called so: with the words around it.
        ("instead of `base`", "instead of `--base`"),
        ("leave out `base`", "leave out `--base`"),
        ("leave `base` out", "leave `--base` out"),
        ("`base` says how", "`--base` says how"),
        ("`gravity = [0, 0, -9.81]`", "`--gravity '[0, 0, -9.81]'`"),
        (
            "name a field of the struct, or write a number",
            "write a number, or vary it, by `--vary` of `dynamics rollouts`",
        ),
        (
            "name a field of the struct, or a joint, whose coordinate it is then",
            "name a joint, whose coordinate it is then, or what `--vary` of `dynamics rollouts` varies",
        ),
        (" beside the file", " on the command line"),
        (" on the struct", " on the command line"),
    ] {
        said = said.replace(written, given);
    }
    said
}

/// The option that says what an attribute does.
fn option(attribute: &str) -> Option<String> {
    let inner = attribute.strip_prefix("#[")?.strip_suffix(")]")?;
    match inner.split_once('(')? {
        (helper @ ("joint" | "body" | "coordinate" | "potential" | "dissipation" | "kinetic"), text) => {
            Some(format!("--{helper} '{text}'"))
        }
        ("dynamics", text) => match text.strip_suffix(')').and_then(|text| text.split_once('(')) {
            Some((key, value)) => Some(format!("--{key} {value}")),
            None => text.split_once(" = ").map(|(key, value)| format!("--{key} {value}")),
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::for_the_command_line;

    #[test]
    fn attributes_are_options() {
        for (written, said) in [
            ("add `#[dynamics(allow(nonphysical_inertia))]` now", "add `--allow nonphysical_inertia` now"),
            ("`#[dynamics(snap = off)]`", "`--snap off`"),
            (
                "`#[joint(a, stiffness = 3)]` or `#[body(b, …)]`",
                "`--joint 'a, stiffness = 3'` or `--body 'b, …'`",
            ),
            (
                "write `#[joint(n: free, world -> a)]` instead of `base`",
                "write `--joint 'n: free, world -> a'` instead of `--base`",
            ),
            ("`base` is welded to `world`", "`base` is welded to `world`"),
            ("`#[potential(k / 2 * (r - r0)^2)]`", "`--potential 'k / 2 * (r - r0)^2'`"),
            ("described on the struct as well", "described on the command line as well"),
            ("`#[derive(Dynamics)]` and #[", "`#[derive(Dynamics)]` and #["),
        ] {
            assert_eq!(for_the_command_line(written), said);
        }
    }
}
