//! The table of links of a robot too large for straight lines.

use std::fmt::Write as _;

use super::items::Emitter;
use super::{body, methods};
use crate::model::Motion;
use crate::passes::NUMBERS_PER_LINK;

impl Emitter<'_, '_> {
    /// The hidden method that fills the table, if some method reads it.
    pub(super) fn table(&self) -> String {
        let Some(program) = &self.input.compiled.table else { return String::new() };
        let name = self.companion_name();
        let context = self.context(&name);
        let body = body::write(program, &[], &context, 3);
        let numbers: Vec<&str> = body.results.iter().map(String::as_str).collect();
        let (scalar, n) = (&self.scalar, self.sizes.inputs.dof);
        let generics =
            self.scalar_parameter.as_ref().map_or_else(String::new, |scalar| format!("<{scalar}>"));
        let mut text = self.open_without_scalar(&self.prepared(), "");
        let _ = writeln!(text, "        /// The links as given, for the recursion.");
        let _ = writeln!(text, "        fn __table{generics}(&self) -> recursion::Tree<{scalar}, {n}> {{");
        text.push_str(&methods::fields_binding(&context, &body, "Self", "self", 3));
        text.push_str("            recursion::Tree {\n                links: [\n");
        for (link, numbers) in self.input.model.tree.links.iter().zip(numbers.chunks(NUMBERS_PER_LINK)) {
            let list = |from: usize, to: usize| numbers[from..to].join(", ");
            let _ = writeln!(
                text,
                "                    recursion::Link {{ parent: {:?}, prismatic: {}, rotation: [[{}], [{}], [{}]], \
                 position: [{}], mass: {}, first: [{}], second: [{}] }},",
                link.parent,
                link.motion == Motion::Prismatic,
                list(0, 3),
                list(3, 6),
                list(6, 9),
                list(9, 12),
                numbers[12],
                list(13, 16),
                list(16, 22)
            );
        }
        let rest = &numbers[NUMBERS_PER_LINK * n..];
        let _ = writeln!(
            text,
            "                ],\n                base_mass: {},\n                base_first: [{}],\n                gravity: [{}],\n            }}\n        }}\n    }}\n",
            rest[0],
            rest[1..4].join(", "),
            rest[4..7].join(", ")
        );
        text
    }
}
