//! `check()`: whether the values of a robot's fields are such that its equations mean something.

use std::fmt::Write as _;

use super::Form;
use super::items::Emitter;
use super::names::keyword_safe;

impl Emitter<'_, '_> {
    /// The method, on the robot itself: fields are finite, and masses positive.
    pub(super) fn check(&self) -> String {
        let visibility = &self.item.visibility;
        let mut text = self.open_without_scalar(&self.robot(), "");
        text.push_str(
            "        /// Whether every field that the equations read is finite, and every mass positive.\n",
        );
        text.push_str(
            "        ///\n        /// # Errors\n        ///\n        /// The first field that is not.\n",
        );
        let ordered = match &self.item.form {
            Form::Generic(parameter) => {
                format!("\n        where\n            {parameter}: ::core::cmp::PartialOrd,\n        ")
            }
            Form::Concrete(_) | Form::Unit => " ".to_owned(),
        };
        let _ = writeln!(
            text,
            "        {visibility}fn check(&self) -> ::core::result::Result<(), Error>{ordered}{{"
        );
        for parameter in &self.input.model.parameters {
            let test = match parameter.unit.as_deref() {
                Some("kg") => "unless_positive_mass",
                _ => "unless_finite_parameter",
            };
            let field = keyword_safe(&parameter.name);
            let _ = writeln!(text, "            Error::{test}({:?}, self.{field})?;", parameter.name);
        }
        text.push_str("            ::core::result::Result::Ok(())\n        }\n    }\n\n");
        text
    }
}
