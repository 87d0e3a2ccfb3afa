//! The table of links of a robot too large for straight lines.

use std::fmt::Write as _;

use super::items::Emitter;
use super::methods;
use crate::emit::body;
use crate::mechanics::equations::Inputs;
use crate::model::{Drive, Link, Motion, Passive};
use crate::passes::NUMBERS_PER_LINK;
use crate::spatial::Scalar as _;
use crate::symbolic::Expr;

impl Emitter<'_, '_> {
    /// The hidden method that fills the table, if some method reads it.
    pub(super) fn table(&self) -> String {
        let Some(program) = &self.input.compiled.table else { return String::new() };
        let name = self.companion_name();
        let context = self.context(&name);
        let body = body::write(program, &[], &context, 3);
        let numbers: Vec<&str> = body.results.iter().map(String::as_str).collect();
        let scalar = &self.scalar;
        let Inputs { coordinates, dof, .. } = self.sizes.inputs;
        let links = &self.input.model.tree.links;
        let generics =
            self.scalar_parameter.as_ref().map_or_else(String::new, |scalar| format!("<{scalar}>"));
        let mut text = self.open_without_scalar(&self.prepared(), "");
        let _ = writeln!(text, "        /// The links as given, for the recursion.");
        let _ = writeln!(
            text,
            "        fn __table{generics}(&self) -> recursion::Tree<{scalar}, {}, {coordinates}, {dof}> {{",
            links.len()
        );
        text.push_str(&methods::fields_binding(&context, &body, "Self", "self", 3));
        text.push_str("            recursion::Tree {\n                links: [\n");
        for (link, numbers) in links.iter().zip(numbers.chunks(NUMBERS_PER_LINK)) {
            let list = |from: usize, to: usize| numbers[from..to].join(", ");
            let _ = writeln!(
                text,
                "                    recursion::Link {{ parent: {:?}, joint: {}, rotation: [[{}], [{}], [{}]], \
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
        let _ = writeln!(
            text,
            "                ],\n                masses: recursion::Masses {{ mass: {}, first: [{}], second: [{}] }},",
            across(12),
            several(13, 16),
            several(16, 22)
        );
        let _ = writeln!(
            text,
            "                base_mass: {},\n                base_first: [{}],\n                gravity: [{}],\n            }}\n        }}\n    }}\n",
            rest[0],
            rest[1..4].join(", "),
            rest[4..7].join(", ")
        );
        text
    }
}

/// The joint of a link, whose drive and passive forces have these numbers.
fn joint(link: &Link<Expr<'_>>, numbers: &[&str]) -> String {
    let Drive { q, v, ratio, offset } = link.drive;
    let kind = match link.motion {
        Motion::Ball => return format!("recursion::Joint::Ball {{ q: {q}, v: {v} }}"),
        Motion::Free => return format!("recursion::Joint::Free {{ q: {q}, v: {v} }}"),
        Motion::Revolute => "Revolute",
        Motion::Prismatic => "Prismatic",
    };
    let drive = match ratio.as_sign() == Some(1) && offset.is_zero() {
        true => format!("recursion::Drive::own({q}, {v})"),
        false => {
            format!("recursion::Drive {{ q: {q}, v: {v}, ratio: {}, offset: {} }}", numbers[0], numbers[1])
        }
    };
    format!("recursion::Joint::{kind}({drive}, {})", passive(&link.passive, &numbers[2..]))
}

fn passive(passive: &Passive<Expr<'_>>, numbers: &[&str]) -> String {
    let Passive { armature, damping, friction, stiffness, .. } = passive;
    if [armature, damping, friction, stiffness].iter().all(|value| value.is_zero()) {
        return "recursion::Passive::none()".to_owned();
    }
    let [armature, damping, force, speed, stiffness, rest] = [0, 1, 2, 3, 4, 5].map(|k| numbers[k]);
    let friction = match friction.is_zero() {
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
