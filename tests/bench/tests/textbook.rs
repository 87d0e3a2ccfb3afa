//! The closed form that the derived robot races is that robot.

use dynamics_bench::contest::{Entries, states};
use dynamics_bench::industrial::planar_2dof::Planar2Dof;
use dynamics_bench::textbook::DoublePendulum;
use dynamics_core::prelude::*;

/// Of each output's largest entry; a dozen operations each round by 1e-16, and solving loses two digits.
const TOLERANCE: f64 = 1e-13;

fn close(found: &impl Entries, expected: &impl Entries) {
    let (found, expected) = (found.entries(), expected.entries());
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() <= TOLERANCE * size, "{found} is not {expected}");
    }
}

#[test]
fn the_closed_form_is_the_derived_robot() {
    let (textbook, derived) = (DoublePendulum::PLANAR_2DOF, Planar2Dof);
    for s in states(&derived) {
        close(&textbook.mass_matrix(&s.q), &derived.mass_matrix(&s.q));
        close(&textbook.coriolis_matrix(&s.q, &s.v), &derived.coriolis_matrix(&s.q, &s.v));
        close(&textbook.gravity_forces(&s.q), &derived.gravity_forces(&s.q));
        close(&textbook.forward_dynamics(&s.q, &s.v, &s.a), &derived.forward_dynamics(&s.q, &s.v, &s.a));
    }
}
