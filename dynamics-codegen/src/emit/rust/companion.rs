//! The prepared companion: a struct with everything that depends on the parameters alone.

use std::fmt::Write as _;

use super::context::Context;
use super::items::{Emitter, allowed};
use super::names::keyword_safe;
use super::{Form, Item, methods};
use crate::emit::body;
use crate::mechanics::equations::Input as Symbol;

impl Emitter<'_, '_> {
    pub(super) fn companion_struct(&self) -> String {
        if !self.is_prepared() {
            return String::new();
        }
        let Item { name, visibility, .. } = self.item;
        let (generics, scalar) = match &self.item.form {
            Form::Generic(parameter) => (format!("<{parameter}>"), parameter.as_str()),
            _ => (String::new(), self.scalar.as_str()),
        };
        let mut text = format!("/// [`{name}`] after all work that depends on its parameters alone.\n");
        let _ = writeln!(text, "#[allow({}, reason = \"generated code\")]", allowed("dead_code"));
        text.push_str(
            "#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]\n",
        );
        let _ = writeln!(text, "{visibility}struct {}{generics} {{", self.companion_name());
        for field in &self.fields {
            let _ = writeln!(text, "    {field}: {scalar},");
        }
        text.push_str("}\n\n");
        text
    }

    /// `prepare()`: on a robot without parameters, the robot itself.
    pub(super) fn prepare(&self) -> String {
        let mut text = self.open_without_scalar(&self.robot(), "");
        if !self.is_prepared() {
            text.push_str(
                "        /// The robot itself: no work depends on parameters alone.\n        #[inline]\n",
            );
            let _ = writeln!(
                text,
                "        {}fn prepare(&self) -> &Self {{\n            self\n        }}",
                self.item.visibility
            );
            text.push_str("    }\n\n");
            return text;
        }
        let program = &self.input.compiled.companion.preparation;
        let context = Context {
            companion: "",
            fields: &[],
            parameters: &self.parameters,
            literals: self.literals(),
            sizes: self.sizes,
            is_passive: self.is_passive(),
            closed: None,
        };
        let body = body::write(program, &self.fields, &context, 3);
        let _ = writeln!(
            text,
            "        /// Does all work that depends on the parameters alone, once.\n        ///\n        /// {}.",
            methods::describe(program.cost())
        );
        let visibility = &self.item.visibility;
        let _ = writeln!(
            text,
            "        #[inline]\n        {visibility}fn prepare(&self) -> {} {{",
            self.prepared().type_
        );
        let read = body.inputs.iter().filter_map(|(input, name)| match input {
            Symbol::Parameter(k) => Some((keyword_safe(&self.input.model.parameters[*k].name), name)),
            Symbol::Argument(..) => None,
        });
        let binding = |(field, name): (String, &String)| {
            if field == *name { field } else { format!("{field}: {name}") }
        };
        let mut read: Vec<String> = read.map(binding).collect();
        read.sort_unstable();
        let _ = writeln!(text, "            let Self {{ {}, .. }} = *self;\n", read.join(", "));
        text.push_str(&body.statements);
        if !body.statements.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "            {} {{", self.companion_name());
        for (field, value) in self.fields.iter().zip(&body.results) {
            if field == value {
                let _ = writeln!(text, "                {field},");
            } else {
                let _ = writeln!(text, "                {field}: {value},");
            }
        }
        text.push_str("            }\n        }\n    }\n\n");
        text
    }
}
