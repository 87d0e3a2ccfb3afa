//! How long a form is to a reader.

use crate::closed::Form;

/// How many terms are written in all sums of a form, in brackets too; the sum of angles in a sine is one thing.
pub(super) fn terms(form: &Form) -> usize {
    1 + signs(form)
}

/// The signs between terms.
fn signs(form: &Form) -> usize {
    let within = || form.parts().into_iter().map(signs).sum::<usize>();
    match form {
        Form::Sin(_) | Form::Cos(_) => 0,
        Form::Sum(parts) => parts.len().saturating_sub(1) + within(),
        _ => within(),
    }
}
