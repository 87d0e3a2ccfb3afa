//! Terms of one's own in the energies, against the equations of the textbooks, worked out by hand.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::collections::HashMap;

use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::passes::RunTime;
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::Graph;

/// Some ten operations on numbers up to 10², rounded by 1e-16 each.
const ROUNDING: f64 = 1e-12;

/// A state of a robot: the values of its fields, and q, v and a, which is τ as well.
struct At<'a> {
    fields: &'a [(&'a str, f64)],
    q: &'a [f64],
    v: &'a [f64],
    a: &'a [f64],
}

/// What the methods of a robot give.
fn results(robot: &str, at: &At<'_>) -> HashMap<&'static str, Vec<f64>> {
    let input = syn::parse_str(robot).expect("it is Rust");
    let (graph, mut diags) = (Graph::new(), dynamics_codegen::diagnostics::Diagnostics::new());
    let spec = spec::parse(&input, &mut diags);
    diags.check().unwrap_or_else(|diags| panic!("{}", diags.into_text()));
    let checked = dynamics_codegen::checked(&spec, &graph, RunTime::Core);
    let (model, compiled) = checked.unwrap_or_else(|diags| panic!("{}", diags.into_text()));
    let input = |input: Input| match input {
        Input::Parameter(k) => {
            let name = &model.parameters[k].name;
            at.fields.iter().find(|(known, _)| known == name).expect("every field has a value").1
        }
        Input::Argument(Argument::Q, k) => at.q[k],
        Input::Argument(Argument::V, k) => at.v[k],
        Input::Argument(Argument::A | Argument::Tau, k) => at.a[k],
    };
    let prepared = compiled.companion.preparation.evaluate(input, &[]);
    let methods = Method::OF_ROBOT.into_iter();
    methods
        .filter_map(|method| Some((method.name(), compiled.program(method)?.evaluate(input, &prepared))))
        .collect()
}

#[track_caller]
fn assert_close(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for (x, y) in found.iter().zip(expected) {
        assert!((x - y).abs() <= ROUNDING * size, "{what} is {found:?}, expected {expected:?}");
    }
}

/// A bob on a spring that swings: `m r̈ = m r θ̇² + m g cos θ − k (r − l)`, `m r² θ̈ = −2 m r ṙ θ̇ − m g r sin θ`.
#[test]
fn elastic_pendulum() {
    let (m, k, l, c, g) = (0.7, 30.0, 0.4, 0.2, 9.81);
    let (q, v, a) = ([0.6_f64, 0.55], [1.1, -0.4], [0.3, 0.9]);
    let fields = [("m", m), ("k", k), ("l", l), ("c", c)];
    let at = At { fields: &fields, q: &q, v: &v, a: &a };
    let ([theta, r], [w, u]) = (q, v);
    let (s, cos) = theta.sin_cos();
    let M = [m * r * r, 0.0, 0.0, m];
    let C = [m * r * u, m * r * w, -m * r * w, 0.0];
    let G = [m * g * r * s, -m * g * cos + k * (r - l)];
    let damping = [0.0, c * u];
    let bias = [2.0 * m * r * u * w + G[0], -m * r * w * w + G[1] + damping[1]];
    let T = m / 2.0 * (u * u + r * r * w * w);
    let V = -m * g * r * cos + k / 2.0 * (r - l) * (r - l);
    let of_springs = "#[potential(k / 2 * (r - l)^2)] #[dissipation(c / 2 * dot(r)^2)]";
    let fields = "struct Pendulum<T> { m: T, k: T, l: T, c: T }";
    for robot in [
        // On joints: a massless arm that turns, and a bob that slides along it.
        format!(
            "#[joint(theta: revolute(y), world -> arm)] #[body(arm)] #[joint(r: prismatic(-z), arm -> bob)] \
             #[body(bob, solid = point(m))] {of_springs} {fields}"
        ),
        // The same spring between two points.
        format!(
            "#[joint(theta: revolute(y), world -> arm)] #[body(arm)] #[joint(r: prismatic(-z), arm -> bob)] \
             #[body(bob, solid = point(m))] #[potential(k / 2 * (distance(bob, world) - l)^2)] \
             #[dissipation(c / 2 * dot(distance(world, bob))^2)] {fields}"
        ),
        // Without a tree.
        format!(
            "#[coordinate(theta: angle)] #[coordinate(r: length)] \
             #[kinetic(m / 2 * (dot(r)^2 + r^2 * dot(theta)^2))] #[potential(-m * 9.81 * r * cos(theta))] \
             {of_springs} {fields}"
        )
        .replace("9.81", "g")
        .replace("c: T }", "c: T, g: T }"),
        // By Cartesian coordinates of the bob.
        format!(
            "#[coordinate(theta: angle)] #[coordinate(r: length)] \
             #[kinetic(m / 2 * (dot(r * sin(theta))^2 + dot(r * cos(theta))^2))] \
             #[potential(-m * g * r * cos(theta))] {of_springs} {fields}"
        )
        .replace("c: T }", "c: T, g: T }"),
    ] {
        let with_g = [at.fields, &[("g", g)]].concat();
        let found = results(&robot, &At { fields: &with_g, ..at });
        assert_close("M", &found["mass_matrix"], &M);
        assert_close("C", &found["coriolis_matrix"], &C);
        assert_close("G", &found["gravity_forces"], &G);
        assert_close("h", &found["bias_forces"], &bias);
        assert_close("passive forces", &found["passive_forces"], &damping);
        assert_close("tau", &found["inverse_dynamics"], &[M[0] * a[0] + bias[0], M[3] * a[1] + bias[1]]);
        let solved = [(a[0] - bias[0]) / M[0], (a[1] - bias[1]) / M[3]];
        assert_close("a", &found["forward_dynamics"], &solved);
        assert_close("T", &found["kinetic_energy"], &[T]);
        assert_close("V", &found["potential_energy"], &[V]);
        assert_close("L", &found["lagrangian"], &[T - V]);
        assert!(!found.contains_key("elastic_energy"), "the spring is a potential");
    }
}

/// A bead on a hoop that turns at Ω about the vertical: `m R² θ̈ = m R² Ω² sin θ cos θ − m g R sin θ`. What turns with the
/// hoop is a potential; that the hoop is driven needs no coordinate.
#[test]
fn bead_on_a_rotating_hoop() {
    let (m, R, W, g) = (0.2, 0.5, 7.0, 9.81);
    let (q, v, a) = ([0.8_f64], [1.3], [0.4]);
    let robot = "#[joint(theta: revolute(-y), world -> bead)] #[body(bead, com = [0, 0, -R], solid = point(m))] \
                 #[potential(-m / 2 * (W * R * sin(theta))^2)] struct Bead<T> { m: T, R: T, W: T }";
    let found = results(robot, &At { fields: &[("m", m), ("R", R), ("W", W)], q: &q, v: &v, a: &a });
    let (s, c) = q[0].sin_cos();
    let G = m * g * R * s - m * R * R * W * W * s * c;
    assert_close("G", &found["gravity_forces"], &[G]);
    assert_close("a", &found["forward_dynamics"], &[(a[0] - G) / (m * R * R)]);
    // A linear model about the equilibrium at cos θ = g/(R Ω²) oscillates: it is stable there.
    let stable = (g / (R * W * W)).acos();
    let at = At { fields: &[("m", m), ("R", R), ("W", W)], q: &[stable], v: &[0.0], a: &[0.0] };
    let derivatives = &results(robot, &at)["forward_dynamics_derivatives"];
    assert_close("∂a/∂θ", &derivatives[..1], &[-W * W * stable.sin() * stable.sin()]);
}

/// Two carts on one line, coupled by a spring and a damper, and each to its wall: three springs, two masses.
#[test]
fn two_carts() {
    let (m1, m2, k, c) = (2.0, 1.2, 15.0, 0.6);
    let (q, v, a) = ([0.11, 0.47], [0.3, -0.8], [1.0, 2.0]);
    let robot = "#[joint(x1: prismatic(x), world -> one, stiffness = k)] #[body(one, solid = point(m1))] \
                 #[joint(x2: prismatic(x), world -> two, at = [0.3, 0, 0])] #[body(two, solid = point(m2))] \
                 #[potential(k / 2 * (x2 - x1)^2 + k / 2 * x2^2)] #[dissipation(c / 2 * (dot(x2) - dot(x1))^2)] \
                 struct Carts<T> { m1: T, m2: T, k: T, c: T }";
    let fields = [("m1", m1), ("m2", m2), ("k", k), ("c", c)];
    let found = results(robot, &At { fields: &fields, q: &q, v: &v, a: &a });
    assert_close("V", &found["potential_energy"], &[k / 2.0 * ((q[1] - q[0]).powi(2) + q[1] * q[1])]);
    assert_close("U", &found["elastic_energy"], &[k / 2.0 * q[0] * q[0]]);
    let derivatives = &found["forward_dynamics_derivatives"];
    let stiffness = [-2.0 * k / m1, k / m1, k / m2, -2.0 * k / m2];
    let damping = [-c / m1, c / m1, c / m2, -c / m2];
    assert_close("∂a/∂q", &derivatives[..4], &stiffness);
    assert_close("∂a/∂v", &derivatives[4..8], &damping);
    let forces = [k * (2.0 * q[0] - q[1]) - c * (v[1] - v[0]), k * (2.0 * q[1] - q[0]) + c * (v[1] - v[0])];
    assert_close("a", &found["forward_dynamics"], &[(a[0] - forces[0]) / m1, (a[1] - forces[1]) / m2]);
}

/// Furuta's pendulum from its kinetic energy alone, beside the same robot as a tree.
#[test]
fn furuta_pendulum() {
    let fields = [("m", 0.3), ("L", 0.25), ("l", 0.15), ("J", 0.01), ("g", 9.81)];
    let at = At { fields: &fields, q: &[0.4, 0.9], v: &[1.2, -2.0], a: &[0.5, 3.0] };
    let tree = results(
        "#[joint(phi: revolute(z), world -> arm, armature = J)] #[body(arm)] \
         #[joint(theta: revolute(-x), arm -> bob, at = [L, 0, 0])] #[body(bob, com = [0, 0, l], solid = point(m))] \
         #[dynamics(gravity = [0, 0, -g])] struct Furuta<T> { m: T, L: T, l: T, J: T, g: T }",
        &at,
    );
    let lagrangian = results(
        "#[coordinate(phi: angle)] #[coordinate(theta: angle)] \
         #[kinetic(J / 2 * dot(phi)^2)] \
         #[kinetic(m / 2 * ((L^2 + l^2 * sin(theta)^2) * dot(phi)^2 + l^2 * dot(theta)^2 \
            + 2 * L * l * cos(theta) * dot(phi) * dot(theta)))] \
         #[potential(m * g * l * cos(theta))] struct Furuta<T> { m: T, L: T, l: T, J: T, g: T }",
        &at,
    );
    for method in Method::OF_ROBOT {
        let name = method.name();
        if let (Some(expected), Some(found)) = (tree.get(name), lagrangian.get(name))
            && method.trait_().is_of_forces()
        {
            assert_close(name, found, expected);
        }
    }
    assert!(!lagrangian.contains_key("center_of_mass"), "nothing has mass");
}

/// Two branches that nothing but a kinetic term couples, and the third that stays apart.
#[test]
fn kinetic_terms_couple_branches() {
    let body = |name: &str| format!("#[body({name}, solid = point(1), com = [0.5, 0, 0])]");
    let robot = format!(
        "#[dynamics(gravity = [0, 0, 0])] #[joint(a: revolute(z), world -> a)] {} #[joint(b: revolute(z), world -> b)] {} \
         #[joint(c: revolute(z), world -> c)] {} #[kinetic(J / 2 * (dot(a) + 2 * dot(c))^2)] struct R<T> {{ J: T }}",
        body("a"),
        body("b"),
        body("c")
    );
    let J = 0.3;
    let at = At { fields: &[("J", J)], q: &[0.1, 0.2, 0.3], v: &[1.0, 2.0, 3.0], a: &[1.0, -1.0, 2.0] };
    let found = results(&robot, &at);
    let M = [0.25 + J, 0.0, 2.0 * J, 0.0, 0.25, 0.0, 2.0 * J, 0.0, 0.25 + 4.0 * J];
    assert_close("M", &found["mass_matrix"], &M);
    assert_close("C", &found["coriolis_matrix"], &[0.0; 9]);
    let det = M[0] * M[8] - M[2] * M[2];
    let inverse = [M[8] / det, 0.0, -M[2] / det, 0.0, 4.0, 0.0, -M[2] / det, 0.0, M[0] / det];
    assert_close("M^-1", &found["inverse_mass_matrix"], &inverse);
}

/// A free body under water: its added mass is in its own axes, and turns with it, as Kirchhoff's equations say.
#[test]
fn added_mass_of_a_body_under_water() {
    let robot = "#[dynamics(gravity = [0, 0, 0])] #[joint(base: free, world -> hull)] \
                 #[body(hull, mass = 2, inertia = diag(0.1, 0.2, 0.3))] \
                 #[kinetic(mx / 2 * base.vx^2 + my / 2 * base.vy^2 + iz / 2 * base.wz^2)] \
                 #[dissipation(c / 3 * sqrt(base.vx^2 + 1e-6) * base.vx^2)] \
                 struct Hull<T> { mx: T, my: T, iz: T, c: T }";
    let (mx, my, iz, c) = (0.4, 1.5, 0.05, 0.7);
    let q = [0.3, -0.2, 0.5, 0.1, 0.5, -0.1, 0.854_400_374_531_753_1];
    let (v, a) = ([0.6, -0.4, 0.2, 0.7, -0.9, 1.1], [0.0; 6]);
    let found =
        results(robot, &At { fields: &[("mx", mx), ("my", my), ("iz", iz), ("c", c)], q: &q, v: &v, a: &a });
    let (m, i) = ([2.0 + mx, 2.0 + my, 2.0], [0.1, 0.2, 0.3 + iz]);
    let M: Vec<f64> = (0..36).map(|k| if k % 7 == 0 { [m, i].concat()[k / 7] } else { 0.0 }).collect();
    assert_close("M", &found["mass_matrix"], &M);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let (u, w) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
    let p = std::array::from_fn(|k| m[k] * u[k]);
    let h = std::array::from_fn(|k| i[k] * w[k]);
    let (force, turned, carried) = (cross(w, p), cross(w, h), cross(u, p));
    let root = (v[0] * v[0] + 1e-6_f64).sqrt();
    let drag = c / 3.0 * (v[0].powi(3) / root + 2.0 * root * v[0]);
    let moment: [f64; 3] = std::array::from_fn(|k| turned[k] + carried[k]);
    let expected = [force[0] + drag, force[1], force[2], moment[0], moment[1], moment[2]];
    assert_close("h", &found["bias_forces"], &expected);
}

/// `τ = Y·π`: a term has a column, whose parameter is one.
#[test]
fn regressors_have_a_column_for_each_term() {
    let robot = "#[joint(x: prismatic(x), world -> cart)] #[body(cart, solid = point(m))] \
                 #[joint(hinge: revolute(y), cart -> pole)] #[body(pole, com = [0, 0, 0.5], solid = point(1kg))] \
                 #[potential(k / 2 * x^2)] #[kinetic(J / 2 * (dot(x) / 0.1m + dot(hinge))^2)] \
                 #[dissipation(c / 2 * dot(hinge)^2)] struct R<T> { m: T, k: T, J: T, c: T }";
    let fields = [("m", 2.0), ("k", 3.0), ("J", 0.02), ("c", 0.4)];
    let at = At { fields: &fields, q: &[0.3, 0.9], v: &[1.2, -0.7], a: &[0.8, 2.0] };
    let found = results(robot, &at);
    for (matrix, parameters) in [("regressor", "inertial_parameters"), ("base_regressor", "base_parameters")]
    {
        let (Y, pi) = (&found[matrix], &found[parameters]);
        assert_eq!(&pi[pi.len() - 3..], [1.0; 3]);
        let product: Vec<f64> =
            Y.chunks(pi.len()).map(|row| row.iter().zip(pi).map(|(y, pi)| y * pi).sum()).collect();
        assert_close(matrix, &product, &found["inverse_dynamics"]);
    }
}
