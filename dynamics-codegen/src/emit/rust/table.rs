//! The table of links of a robot too large for straight lines.

use std::fmt::Write as _;

use super::context::{Context, Literals};
use super::items::Emitter;
use super::methods;
use crate::emit::body;
use crate::mechanics::equations::Inputs;
use crate::model::{Drive, Link, Motion, Passive};
use crate::passes::NUMBERS_PER_LINK;
use crate::symbolic::Expr;

impl Emitter<'_, '_> {
    /// The hidden method that lends the table, if some method reads it: one that stands in memory that is never written, or
    /// one of the robot's fields, which is filled.
    pub(super) fn table(&self) -> String {
        let Some(program) = &self.input.compiled.table else { return String::new() };
        let name = self.companion_name();
        let context = self.context(&name);
        let body = body::write(program, &[], &context, 3);
        let Inputs { coordinates, dof, .. } = self.sizes.inputs;
        let sizes = format!("{}, {coordinates}, {dof}", self.input.model.tree.links.len());
        let scalar = &self.scalar;
        let generics =
            self.scalar_parameter.as_ref().map_or_else(String::new, |scalar| format!("{scalar}, "));
        let mut text = self.open_without_scalar(&self.prepared(), "");
        let _ = writeln!(
            text,
            "        /// What `read` makes of the links as given, for the recursion.\n        #[inline(always)]\n        \
             fn __table<{generics}__R>(&self, read: impl FnOnce(&recursion::Tree<{scalar}, {sizes}>) -> __R) -> __R {{"
        );
        if body.fields.is_empty() {
            let by_function = Context { literals: Literals::Of("$of".to_owned()), ..context };
            let tree = self.tree(&body::write(program, &[], &by_function, 5).results, 5);
            let _ = writeln!(
                text,
                "            macro_rules! table {{\n                ($of:path) => {{\n                    {tree}\n                }};\n            }}\n            \
                 static DOUBLE: recursion::Tree<f64, {sizes}> = table!(recursion::same);\n            \
                 #[allow(overflowing_literals, reason = \"they round to infinity\")]\n            \
                 static SINGLE: recursion::Tree<f32, {sizes}> = table!(recursion::same);\n            \
                 DOUBLE.read_in(&SINGLE, || table!({scalar}::of), read)"
            );
        } else {
            text.push_str(&methods::fields_binding(&context, &body, "Self", "self", 3));
            let _ = writeln!(text, "            read(&{})", self.tree(&body.results, 3));
        }
        text.push_str("        }\n    }\n\n");
        text
    }

    /// The tree of these numbers, an expression whose first line is indented already.
    fn tree(&self, numbers: &[String], indent: usize) -> String {
        let numbers: Vec<&str> = numbers.iter().map(String::as_str).collect();
        let links = &self.input.model.tree.links;
        let pad = "    ".repeat(indent);
        let mut text = format!("recursion::Tree {{\n{pad}    links: [\n");
        for (link, numbers) in links.iter().zip(numbers.chunks(NUMBERS_PER_LINK)) {
            let list = |from: usize, to: usize| numbers[from..to].join(", ");
            let _ = writeln!(
                text,
                "{pad}        recursion::Link {{ parent: {:?}, joint: {}, rotation: [[{}], [{}], [{}]], \
                 position: [{}] }},",
                link.parent,
                joint(link, &numbers[22..]),
                list(0, 3),
                list(3, 6),
                list(6, 9),
                list(9, 12)
            );
        }
        let (of_links, rest) = numbers.split_at(NUMBERS_PER_LINK * links.len());
        let across = |k: usize| {
            let numbers: Vec<&str> = of_links.chunks(NUMBERS_PER_LINK).map(|numbers| numbers[k]).collect();
            format!("[{}]", numbers.join(", "))
        };
        let several = |from: usize, to: usize| (from..to).map(across).collect::<Vec<_>>().join(", ");
        let _ = write!(
            text,
            "{pad}    ],\n{pad}    masses: recursion::Masses {{ mass: {}, first: [{}], second: [{}] }},\n\
             {pad}    base_mass: {},\n{pad}    base_first: [{}],\n{pad}    gravity: [{}],\n{pad}}}",
            across(12),
            several(13, 16),
            several(16, 22),
            rest[0],
            rest[1..4].join(", "),
            rest[4..7].join(", ")
        );
        text
    }
}

/// The joint of a link, whose drive and passive forces have these numbers.
fn joint(link: &Link<Expr<'_>>, numbers: &[&str]) -> String {
    let Drive { q, v, .. } = link.drive;
    let kind = match link.motion {
        Motion::Ball => return format!("recursion::Joint::Ball {{ q: {q}, v: {v} }}"),
        Motion::Free => return format!("recursion::Joint::Free {{ q: {q}, v: {v} }}"),
        Motion::Revolute => "Revolute",
        Motion::Prismatic => "Prismatic",
    };
    let [ratio, offset] = [0, 1].map(|k| numbers[k]);
    let drive = format!("recursion::Drive {{ q: {q}, v: {v}, ratio: {ratio}, offset: {offset} }}");
    format!("recursion::Joint::{kind}({drive}, {})", passive(&link.passive, &numbers[2..]))
}

fn passive(passive: &Passive<Expr<'_>>, numbers: &[&str]) -> String {
    let [armature, damping, force, speed, stiffness, rest] = [0, 1, 2, 3, 4, 5].map(|k| numbers[k]);
    let friction = match passive.friction.is_zero() {
        true => "::core::option::Option::None".to_owned(),
        false => {
            format!("::core::option::Option::Some(recursion::Friction {{ force: {force}, speed: {speed} }})")
        }
    };
    format!(
        "recursion::Passive {{ armature: {armature}, damping: {damping}, friction: {friction}, \
         stiffness: {stiffness}, rest: {rest} }}"
    )
}
