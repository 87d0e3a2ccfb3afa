//! Systems of textbooks on mechanics and robotics: how their equations look on a slide.

/// Their names, and their structs as users write them.
pub(crate) const SYSTEMS: &[(&str, &str)] = &[
    (
        "planar_3r",
        r#"#[dynamics(gravity = [0, -g, 0])]
#[joint(q1: revolute(z), world -> a)]
#[body(a, mass = m1, com = [c1, 0, 0], inertia = diag(0, i1, i1))]
#[joint(q2: revolute(z), a -> b, at = [l1, 0, 0])]
#[body(b, mass = m2, com = [c2, 0, 0], inertia = diag(0, i2, i2))]
#[joint(q3: revolute(z), b -> c, at = [l2, 0, 0])]
#[body(c, mass = m3, com = [c3, 0, 0], inertia = diag(0, i3, i3))]
struct Planar3<T> { m1: T, m2: T, m3: T, l1: T, l2: T, c1: T, c2: T, c3: T, i1: T, i2: T, i3: T, g: T }"#,
    ),
    (
        "planar_4r",
        r#"#[dynamics(gravity = [0, -g, 0])]
#[joint(q1: revolute(z), world -> a)]
#[body(a, com = [l, 0, 0], solid = point(m))]
#[joint(q2: revolute(z), a -> b, at = [l, 0, 0])]
#[body(b, com = [l, 0, 0], solid = point(m))]
#[joint(q3: revolute(z), b -> c, at = [l, 0, 0])]
#[body(c, com = [l, 0, 0], solid = point(m))]
#[joint(q4: revolute(z), c -> d, at = [l, 0, 0])]
#[body(d, com = [l, 0, 0], solid = point(m))]
struct Planar4<T> { m: T, l: T, g: T }"#,
    ),
    (
        "furuta_pendulum",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta1: revolute(z), world -> arm)]
#[body(arm, mass = m1, com = [l1, 0, 0], inertia = diag(0, j1, j1))]
#[joint(theta2: revolute(x), arm -> pendulum, at = [r, 0, 0])]
#[body(pendulum, mass = m2, com = [0, 0, -l2], inertia = diag(j2, j2, 0))]
struct Furuta<T> { m1: T, m2: T, r: T, l1: T, l2: T, j1: T, j2: T, g: T }"#,
    ),
    (
        "spinning_top",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(phi: revolute(z), world -> a)]
#[body(a)]
#[joint(theta: revolute(x), a -> b)]
#[body(b)]
#[joint(psi: revolute(z), b -> c)]
#[body(c, mass = m, com = [0, 0, l], inertia = diag(i1, i1, i3))]
struct Top<T> { m: T, l: T, i1: T, i3: T, g: T }"#,
    ),
    (
        "wrist",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(phi: revolute(z), world -> a)]
#[body(a)]
#[joint(theta: revolute(y), a -> b)]
#[body(b)]
#[joint(psi: revolute(z), b -> c)]
#[body(c, mass = m, com = [0, 0, d], inertia = diag(a, b, c))]
struct Wrist<T> { m: T, d: T, a: T, b: T, c: T, g: T }"#,
    ),
    (
        "gyroscope",
        r#"#[joint(alpha: revolute(z), world -> outer)]
#[body(outer, mass = 1, inertia = diag(a1, b1, c1))]
#[joint(beta: revolute(x), outer -> inner)]
#[body(inner, mass = 1, inertia = diag(a2, b2, c2))]
#[joint(gamma: revolute(y), inner -> rotor)]
#[body(rotor, mass = 1, inertia = diag(a3, c3, a3))]
struct Gyroscope<T> { a1: T, b1: T, c1: T, a2: T, b2: T, c2: T, a3: T, c3: T }"#,
    ),
    (
        "polar_arm",
        r#"#[dynamics(gravity = [0, -g, 0])]
#[joint(theta: revolute(z), world -> a)]
#[body(a, mass = m1, com = [c, 0, 0], inertia = diag(0, i1, i1))]
#[joint(r: prismatic(x), a -> b)]
#[body(b, mass = m2, inertia = diag(0, i2, i2))]
struct Polar<T> { m1: T, m2: T, c: T, i1: T, i2: T, g: T }"#,
    ),
    (
        "elbow_out_of_plane",
        r#"#[joint(q1: revolute(z), world -> a)]
#[body(a, com = [a1 / 2, 0, 0], solid = point(m1))]
#[joint(q2: revolute(-y), a -> b, at = [a1, 0, 0])]
#[body(b, com = [a2 / 2, 0, 0], solid = point(m2))]
struct Elbow<T> { m1: T, m2: T, a1: T, a2: T }"#,
    ),
    (
        "bead_on_a_turning_hoop",
        r#"#[coordinate(theta: angle)]
#[kinetic(m / 2 * r^2 * dot(theta)^2)]
#[potential(-m * g * r * cos(theta) - m / 2 * r^2 * w^2 * sin(theta)^2)]
struct Bead<T> { m: T, r: T, g: T, w: T }"#,
    ),
    (
        "bead_on_a_parabola",
        r#"#[coordinate(x: length)]
#[kinetic(m / 2 * dot(x)^2 * (1 + 4 * a^2 * x^2))]
#[potential(m * g * a * x^2)]
struct Parabola<T> { m: T, a: T, g: T }"#,
    ),
    (
        "central_force",
        r#"#[coordinate(r: length)]
#[coordinate(theta: angle)]
#[kinetic(m / 2 * (dot(r)^2 + r^2 * dot(theta)^2))]
#[potential(-k / r)]
struct Planet<T> { m: T, k: T }"#,
    ),
    (
        "pull_of_two_springs",
        r#"#[coordinate(x: length)]
#[coordinate(y: length)]
#[kinetic(m / 2 * (dot(x)^2 + dot(y)^2))]
#[potential(f * sqrt(x^2 + y^2) + k / 2 * (sqrt((x - a)^2 + y^2) - l)^2)]
struct Pull<T> { m: T, f: T, k: T, a: T, l: T }"#,
    ),
    (
        "slider_with_a_quotient",
        r#"#[coordinate(q: angle)]
#[kinetic(m / 2 * l^2 * dot(q)^2 * (1 + 1 / (1 + sin(q)^2)))]
#[potential(m * g * l * sin(q) / (2 + cos(q)))]
struct Slider<T> { m: T, l: T, g: T }"#,
    ),
    (
        "logarithmic_mass",
        r#"#[coordinate(x: length)]
#[coordinate(theta: angle)]
#[kinetic(m / 2 * a^2 * dot(x)^2 / x^2 + m / 2 * a^2 * dot(theta)^2)]
#[potential(m * g * a^2 / x * sin(theta))]
struct Logarithmic<T> { m: T, a: T, g: T }"#,
    ),
    (
        "elastic_pendulum",
        r#"#[coordinate(theta: angle)]
#[coordinate(r: length)]
#[kinetic(m / 2 * (dot(r)^2 + r^2 * dot(theta)^2))]
#[potential(k / 2 * (r - l)^2 - m * g * r * cos(theta))]
struct Elastic<T> { m: T, k: T, l: T, g: T }"#,
    ),
    (
        "chain_of_springs",
        r#"#[coordinate(x1: length)]
#[coordinate(x2: length)]
#[coordinate(x3: length)]
#[kinetic(m / 2 * (dot(x1)^2 + dot(x2)^2 + dot(x3)^2))]
#[potential(k / 2 * ((x1 - x2)^2 + (x2 - x3)^2))]
struct Chain<T> { m: T, k: T }"#,
    ),
    (
        "two_masses_with_springs",
        r#"#[coordinate(x1: length)]
#[coordinate(x2: length)]
#[kinetic(m1 / 2 * dot(x1)^2 + m2 / 2 * dot(x2)^2)]
#[potential(k1 / 2 * x1^2 + k2 / 2 * (x2 - x1 - l)^2 + k3 / 2 * x2^2)]
struct TwoMasses<T> { m1: T, m2: T, k1: T, k2: T, k3: T, l: T }"#,
    ),
    (
        "wilberforce_pendulum",
        r#"#[coordinate(z: length)]
#[coordinate(theta: angle)]
#[kinetic(m / 2 * dot(z)^2 + j / 2 * dot(theta)^2)]
#[potential(k / 2 * z^2 + d / 2 * theta^2 + e / 2 * z * theta)]
struct Wilberforce<T> { m: T, j: T, k: T, d: T, e: T }"#,
    ),
    (
        "wedge_and_block",
        r#"#[coordinate(x: length)]
#[coordinate(s: length)]
#[kinetic(m1 / 2 * dot(x)^2 + m2 / 2 * (dot(x)^2 + dot(s)^2 + 2 * dot(x) * dot(s) * cos(alpha)))]
#[potential(-m2 * g * s * sin(alpha))]
struct Wedge<T> { m1: T, m2: T, g: T, alpha: T }"#,
    ),
    (
        "cart_with_two_poles",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(x: prismatic(x), world -> cart)]
#[body(cart, solid = point(m))]
#[joint(theta1: revolute(y), cart -> long)]
#[body(long, com = [0, 0, l1], solid = point(m1))]
#[joint(theta2: revolute(y), cart -> short)]
#[body(short, com = [0, 0, l2], solid = point(m2))]
struct TwoPoles<T> { m: T, m1: T, m2: T, l1: T, l2: T, g: T }"#,
    ),
    (
        "double_pendulum_of_rods",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta1: revolute(y), world -> upper)]
#[body(upper, com = [0, 0, -l / 2], solid = rod(m, l))]
#[joint(theta2: revolute(y), upper -> lower, at = [0, 0, -l])]
#[body(lower, com = [0, 0, -l / 2], solid = rod(m, l))]
struct Rods<T> { m: T, l: T, g: T }"#,
    ),
    (
        "tilted_hinge",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta: revolute(z), world -> door, rpy = [alpha, 0, 0])]
#[body(door, com = [b / 2, 0, 0], solid = point(m))]
struct Door<T> { m: T, b: T, g: T, alpha: T }"#,
    ),
    (
        "inclined_axes",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(q1: revolute(z), world -> a)]
#[body(a, mass = m1, inertia = diag(0, 0, j))]
#[joint(q2: revolute(x), a -> b, rpy = [0, 30deg, 0])]
#[body(b, com = [0, l, 0], solid = point(m2))]
struct Inclined<T> { m1: T, m2: T, j: T, l: T, g: T }"#,
    ),
    (
        "spring_to_the_wall",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta: revolute(y), world -> arm)]
#[body(arm, com = [0, 0, -l], solid = point(m))]
#[joint(bob: fixed, arm -> tip, at = [0, 0, -l])]
#[joint(nail: fixed, world -> peg, at = [a, 0, 0])]
#[potential(k / 2 * (distance(peg, tip) - s)^2)]
struct SpringToTheWall<T> { m: T, l: T, k: T, a: T, s: T, g: T }"#,
    ),
    (
        "cams",
        r#"#[coordinate(t: angle)]
#[coordinate(u: angle)]
#[kinetic(j / 2 * (dot(t)^2 + dot(u)^2))]
#[potential(k * cos(2 * t)^2 * sin(t / 2) + k * cos(t + sin(u)) + k * sin(t) * cos(4 * u)^2)]
struct Cams<T> { j: T, k: T }"#,
    ),
    (
        "ballbot",
        r#"#[coordinate(phi: angle)]
#[coordinate(theta: angle)]
#[kinetic((i_b + m_b * r^2) / 2 * dot(phi)^2 + i_B / 2 * dot(theta)^2)]
#[kinetic(m_B / 2 * (dot(r * phi + l * sin(theta))^2 + dot(l * cos(theta))^2))]
#[potential(m_B * g * l * cos(theta))]
struct Ballbot<T> { m_b: T, m_B: T, i_b: T, i_B: T, r: T, l: T, g: T }"#,
    ),
    (
        "compass_walker",
        r#"#[coordinate(theta_s: angle)]
#[coordinate(theta_n: angle)]
#[kinetic(m / 2 * a^2 * dot(theta_s)^2 + m_h / 2 * (a + b)^2 * dot(theta_s)^2)]
#[kinetic(m / 2 * dot((a + b) * sin(theta_s) - b * sin(theta_n))^2)]
#[kinetic(m / 2 * dot((a + b) * cos(theta_s) - b * cos(theta_n))^2)]
#[potential((m * (2 * a + b) + m_h * (a + b)) * g * cos(theta_s) - m * g * b * cos(theta_n))]
struct Compass<T> { m: T, m_h: T, a: T, b: T, g: T }"#,
    ),
    (
        "masses_in_a_row",
        r#"#[coordinate(x1: length)]
#[coordinate(x2: length)]
#[coordinate(x3: length)]
#[kinetic(m / 2 * (dot(x1) + dot(x2))^2)]
#[kinetic(mu / 2 * dot(x3)^2)]
#[potential(k / 2 * x1^2 + kappa / 2 * (x2 - x1)^2 + kappa / 2 * (x3 - x2)^2)]
struct Row<T> { m: T, mu: T, k: T, kappa: T }"#,
    ),
];
