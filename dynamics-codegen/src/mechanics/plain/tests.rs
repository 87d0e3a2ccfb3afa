//! The oracle against the textbooks' closed forms.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::Oracle;
use crate::model::{Drive, Link, Motion, Passive, Terms, Tree};
use crate::spatial::{Matrix3, Pose, PseudoInertia, Symmetric3, Vector3};

/// Some ten operations on numbers up to 10², rounded by 1e-16 each.
fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (x, y) in found.iter().zip(expected) {
        assert!((x - y).abs() <= 1e-13, "found {found:?}, expected {expected:?}");
    }
}

/// The mass `m` at the point `r`.
fn point(m: f64, r: Vector3<f64>) -> PseudoInertia<f64> {
    PseudoInertia::new(m, r, Symmetric3::zero())
}

fn chain(links: Vec<(Motion, Pose<f64>, PseudoInertia<f64>)>, gravity: Vector3<f64>) -> Tree<f64> {
    let link = |(k, (motion, placement, inertia)): (usize, _)| Link {
        parent: k.checked_sub(1),
        motion,
        drive: Drive::own(k, k),
        passive: Passive::none(),
        placement,
        inertia,
    };
    let links = links.into_iter().enumerate().map(link).collect();
    Tree { links, base: PseudoInertia::zero(), frames: Vec::new(), gravity, terms: Terms::none() }
}

/// A point mass on a rod turning about z, hanging along x when q = 0: `τ = m l² a + m g l sin q`.
#[test]
fn pendulum() {
    let (m, l, g) = (2.0, 0.7, 9.81);
    let rod = (Motion::Revolute, Pose::identity(), point(m, Vector3([l, 0.0, 0.0])));
    let tree = chain(vec![rod], Vector3([g, 0.0, 0.0]));
    let oracle = Oracle::new(&tree);
    let (q, v, a) = (0.4_f64, 1.5, -0.3);
    assert_close(&oracle.mass_matrix(&[q])[0], &[m * l * l]);
    assert_close(&oracle.coriolis_matrix(&[q], &[v])[0], &[0.0]);
    assert_close(&[oracle.potential_energy(&[q])], &[-m * g * l * q.cos()]);
    let tau = m * l * l * a + m * g * l * q.sin();
    assert_close(&oracle.inverse_dynamics(&[q], &[v], &[a]), &[tau]);
}

/// Murray, Li, Sastry 1994, example 4.3: the planar arm of two links, with its printed M and C.
#[test]
fn planar_arm() {
    let (m1, m2, l1, r1, r2, i1, i2) = (3.0, 2.0, 0.5, 0.2, 0.3, 0.11, 0.07);
    let body = |m, r, i| PseudoInertia::new(m, Vector3([r, 0.0, 0.0]), Symmetric3::diagonal(0.05, i, i));
    let upper = (Motion::Revolute, Pose::identity(), body(m1, r1, i1));
    let fore = (Motion::Revolute, Pose::translation(Vector3([l1, 0.0, 0.0])), body(m2, r2, i2));
    let tree = chain(vec![upper, fore], Vector3::zero());
    let (q, v) = ([0.3, -0.8_f64], [1.1, 0.6]);
    let alpha = i1 + i2 + m1 * r1 * r1 + m2 * (l1 * l1 + r2 * r2);
    let (beta, delta) = (m2 * l1 * r2, i2 + m2 * r2 * r2);
    let (s2, c2) = q[1].sin_cos();
    let M = [alpha + 2.0 * beta * c2, delta + beta * c2, delta + beta * c2, delta];
    let C = [-beta * s2 * v[1], -beta * s2 * (v[0] + v[1]), beta * s2 * v[0], 0.0];
    let oracle = Oracle::new(&tree);
    assert_close(&oracle.mass_matrix(&q).concat(), &M);
    assert_close(&oracle.coriolis_matrix(&q, &v).concat(), &C);
}

/// A cart that slides along z, and a point mass that turns on it about an axis across: `M = [M+m, ∓ml sin; …, ml²]`.
#[test]
fn pendulum_on_a_cart() {
    let (cart, m, l, g) = (4.0, 1.5, 0.6, 9.81);
    // The pendulum's axis is the cart's −y; its mass lies ahead of the cart at q = 0. Gravity is along −x.
    let across = Pose::rotation(Matrix3::rotation_x(0.0, 1.0));
    let tree = chain(
        vec![
            (Motion::Prismatic, Pose::identity(), point(cart, Vector3::zero())),
            (Motion::Revolute, across, point(m, Vector3([0.0, l, 0.0]))),
        ],
        Vector3([-g, 0.0, 0.0]),
    );
    let (q, v) = ([0.2, 0.9_f64], [0.7, -1.3]);
    let (s, c) = q[1].sin_cos();
    let oracle = Oracle::new(&tree);
    let M = [cart + m, -m * l * s, -m * l * s, m * l * l];
    assert_close(&oracle.mass_matrix(&q).concat(), &M);
    let bias = [-m * l * c * v[1] * v[1], -m * g * l * c];
    assert_close(&oracle.bias_forces(&q, &v), &bias);
}

/// Two prismatic joints along one line, the first link massless, cannot be told apart: M is singular.
#[test]
fn singular_mass_matrix_has_no_forward_dynamics() {
    let slide = |inertia| (Motion::Prismatic, Pose::identity(), inertia);
    let load = point(1.0, Vector3::zero());
    let tree = chain(vec![slide(PseudoInertia::zero()), slide(load)], Vector3::zero());
    assert_eq!(Oracle::new(&tree).forward_dynamics(&[0.0; 2], &[0.0; 2], &[1.0; 2]), None);
}
