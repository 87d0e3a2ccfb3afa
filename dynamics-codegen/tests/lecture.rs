//! Each step of a derivation, come to by another road.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_codegen::closed::{Form, Matrix, evaluate};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::closed_forms;
use dynamics_codegen::mechanics::equations::{Argument, Inputs, Method};
use dynamics_codegen::mechanics::lecture::{
    Body, Excess, Inertia, Lecture, MOST_PARTS, MOST_TERMS, NoLinear, Part, lecture, recursion,
};
use dynamics_codegen::mechanics::plain::{self, Dual, Oracle};
use dynamics_codegen::model::{self, Frame, Model, Tree};
use dynamics_codegen::passes::{self, RunTime};
use dynamics_codegen::spatial::{Pose, Vector3};
use dynamics_codegen::symbolic::{Evaluator, Graph, SymbolId};

const JUDGE: &str = "
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(theta1: revolute(z), world -> column)]
    #[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
    #[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1])]
    #[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
    struct RoboJudge<T> { m1: T, m2: T, l1: T, r0: T, r1: T, g: T, ix1: T, iy1: T, iz1: T, ix2: T, iy2: T, iz2: T }";

/// Robots with what is peculiar: massless bodies, a follower, rotors, springs, dampers, friction, mass that stands still, a
/// sum of masses, a ball, nothing below.
const ROBOTS: [&str; 7] = [
    JUDGE,
    "#[joint(height: prismatic(z), world -> air)] #[body(air)]
     #[joint(roll: revolute(x), air -> rolled)] #[body(rolled)]
     #[joint(pitch: revolute(y), rolled -> pitched)] #[body(pitched)]
     #[joint(yaw: revolute(z), pitched -> cargo)] #[body(cargo, solid = cuboid(m, [l, w, h]))]
     struct TossedBox<T> { m: T, l: T, w: T, h: T }",
    "#[joint(x: prismatic(x), world -> cart, damping = c)] #[body(cart, solid = point(M))]
     #[joint(theta: revolute(y), cart -> pole, rotor = j, gear = 30, stiffness = k, rest = 0.1, friction = f, friction_speed = 0.01)]
     #[body(pole, com = [0, 0, l], solid = point(m))]
     struct CartPole<T> { M: T, m: T, l: T, c: T, j: T, k: T, f: T }",
    "#[joint(base: fixed, world -> foot)] #[body(foot, solid = point(5kg), com = [0, 0, 0.1])]
     #[joint(a: revolute(y), foot -> upper, at = [0, 0, 0.2])] #[body(upper, solid = rod(2, 0.5, z), com = [0, 0, 0.25])]
     #[joint(b: revolute([0, 3, 4]), upper -> lower, at = [0, 0, 0.5], mimic = a, ratio = -2, offset = 90deg)]
     #[body(lower, solid = rod(1, 0.4, z), com = [0, 0.1, 0.2])]
     struct Follower;",
    "#[joint(a: revolute(y), world -> rod)] #[body(rod, com = [0, 0, l / 2], solid = rod(m, l, z))]
     #[joint(grip: fixed, rod -> load, at = [0, 0, l])] #[body(load, solid = point(payload))]
     struct Loaded<T> { m: T, l: T, payload: T }",
    "#[joint(wrist: ball, world -> hand)] #[body(hand, mass = 1, com = [0, 0, 0.2], inertia = diag(0.02, 0.03, 0.04))]
     #[joint(finger: revolute(x), hand -> tip, at = [0, 0, 0.3])] #[body(tip, com = [0, 0.1, 0], solid = point(0.2))]
     struct Hand;",
    "#[joint(flight: free, world -> parcel)] #[body(parcel, solid = cuboid(1.2, [25cm, 40cm, 60cm]))]
     #[dynamics(gravity = [0, 0, -g])]
     struct Thrown<T> { g: T }",
];

/// A robot and its derivation at numbers.
struct Walk<'w, 'g> {
    model: &'w Model<'g>,
    lecture: Lecture,
    tree: Tree<f64>,
    values: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
}

/// Calls `check` with each robot at a few states.
fn for_each_walk(check: impl Fn(&Walk<'_, '_>)) {
    for text in ROBOTS {
        with_model(text, |model, graph| {
            for state in 0..3 {
                check(&Walk::at(model, graph, state));
            }
        });
    }
}

fn with_model(text: &str, run: impl for<'g> FnOnce(&Model<'g>, &'g Graph)) {
    let item: syn::DeriveInput = syn::parse_str(text).unwrap();
    let (graph, mut diags) = (Graph::new(), Diagnostics::new());
    let spec = dynamics_codegen::spec::parse(&item, &mut diags);
    let model = model::build(&spec, &graph, &mut diags);
    assert!(diags.is_empty(), "{}", diags.into_text());
    run(&model.unwrap(), &graph);
}

impl<'w, 'g> Walk<'w, 'g> {
    fn at(model: &'w Model<'g>, graph: &'g Graph, state: usize) -> Self {
        let inputs = Inputs::of(model);
        // Irrational steps: no number is like another.
        let number = |k: usize| (0.7 + 1.618_034 * (state * 50 + k) as f64) % 2.0 - 0.9;
        let mut values: Vec<f64> = model.parameters.iter().map(|parameter| parameter.sample).collect();
        let vector = |argument: Argument, before: usize| -> Vec<f64> {
            (0..inputs.size(argument)).map(|k| number(before + k)).collect()
        };
        let (mut q, v, a) = (vector(Argument::Q, 0), vector(Argument::V, 13), vector(Argument::A, 29));
        let mut evaluator = Evaluator::new(graph, |symbol: SymbolId| values[symbol.0 as usize]);
        let tree = model.tree.map(|expr| evaluator.value(expr));
        tree.normalise(&mut q);
        values.extend(q.iter().chain(&v).chain(&a));
        Self { model, lecture: lecture(model, graph), tree, values, q, v, a }
    }

    fn value(&self, form: &Form) -> f64 {
        evaluate(form, &|symbol: SymbolId| self.values[symbol.0 as usize])
    }

    fn rows(&self, matrix: &Matrix) -> Vec<Vec<f64>> {
        let row = |i: usize| (0..matrix.columns()).map(|j| self.value(matrix.entry(i, j))).collect();
        (0..matrix.rows()).map(row).collect()
    }

    fn column(&self, vector: &Matrix) -> Vec<f64> {
        self.rows(vector).concat()
    }

    fn bodies(&self) -> &[Body] {
        self.lecture.bodies.as_ref().unwrap()
    }
}

/// Both sides are of some hundred operations on numbers of the size of ten.
#[track_caller]
fn assert_close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{what}: {found} and {expected}");
    }
}

/// The lecture's lines, sign for sign; its print of M has a slip in `r₁²`.
#[test]
fn the_robojudge_is_the_lectures() {
    with_model(JUDGE, |model, graph| {
        let lecture = lecture(model, graph);
        let (notation, bodies) = (&lecture.notation, lecture.bodies.unwrap());
        let equations = lecture.equations.unwrap();
        let texts = |matrix: &Matrix| -> Vec<String> {
            (0..matrix.rows() * matrix.columns())
                .map(|k| matrix.entry(k / matrix.columns(), k % matrix.columns()).unicode(notation))
                .collect()
        };
        assert_eq!(texts(&bodies[0].jacobian).join(" "), "0 0 0 0 0 0 0 0 0 0 1 0");
        let expected = ["−r₁ cos θ₂", "0", "0", "0", "0", "−r₁", "0", "−1", "−sin θ₂", "0", "cos θ₂", "0"];
        assert_eq!(texts(&bodies[1].jacobian), expected);
        let m11 = "I_z₁ + I_y₂ sin²θ₂ + I_z₂ cos²θ₂ + m₂ r₁² cos²θ₂";
        assert_eq!(texts(&equations.mass_matrix), [m11, "0", "0", "I_x₂ + m₂ r₁²"]);
        let V = "g (m₁ r₀ + m₂ (l₁ − r₁ sin θ₂))";
        assert_eq!(equations.potential_energy.unicode(notation), V);
        let L = format!("½ ({m11}) θ̇₁² + ½ (I_x₂ + m₂ r₁²) θ̇₂² − {V}");
        assert_eq!(equations.lagrangian.unicode(notation), L);
    });
}

/// Jacobians are how poses change, and twists are what they make of speeds.
#[test]
fn a_jacobian_is_how_the_pose_changes() {
    for_each_walk(|walk| {
        let moved = walk.tree.map(Dual::constant);
        let links: Vec<usize> =
            (0..walk.tree.links.len()).filter(|&k| walk.tree.links[k].inertia.mass > 0.0).collect();
        assert_eq!(links.len(), walk.bodies().len());
        for (&k, body) in links.iter().zip(walk.bodies()) {
            let link = &walk.tree.links[k];
            let own = walk.model.links[k].body.map(|body| &walk.tree.frames[body]);
            let center = link.inertia.first.map(|moment| moment / link.inertia.mass);
            // Where a body has a first moment, its frame is its own.
            let origin = if body.first.is_some() { own.unwrap().pose.translation } else { center };
            let pose = Pose { rotation: own.unwrap().pose.rotation, translation: origin };
            let frame = Frame { name: String::new(), link: Some(k), pose: pose.map(Dual::constant) };
            let n = walk.v.len();
            let mut J = vec![vec![0.0; n]; 6];
            for j in 0..n {
                let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
                let rate = walk.tree.configuration_rate(&walk.q, &unit);
                let pose = plain::pose(&moved, &frame, &Dual::moving(&walk.q, &rate));
                let R = pose.rotation.map(|entry| entry.value);
                let linear = R.transpose() * Vector3(pose.translation.0.map(|entry| entry.tangent));
                let spin = (R.transpose() * pose.rotation.map(|entry| entry.tangent)).0;
                let column = [linear.0[0], linear.0[1], linear.0[2], spin[2][1], spin[0][2], spin[1][0]];
                J.iter_mut().zip(column).for_each(|(row, entry)| row[j] = entry);
                assert_close(&walk.rows(&body.rotation).concat(), &R.0.concat(), "R");
                assert_close(&walk.column(&body.center), &pose.translation.0.map(|entry| entry.value), "p");
            }
            assert_close(&walk.rows(&body.jacobian).concat(), &J.concat(), "J");
            let twist: Vec<f64> =
                J.iter().map(|row| row.iter().zip(&walk.v).map(|(a, b)| a * b).sum()).collect();
            assert_close(&walk.column(&body.twist), &twist, "V");
        }
    });
}

/// The Jacobian of a body whose frame is at its centre of mass is that of the frame, by the specialised recursion. All
/// numbers are fractions: others have six digits on paper.
#[test]
fn a_jacobian_is_that_of_generated_code() {
    let text = "#[joint(a: revolute(z), world -> one)] #[body(one, mass = 1, inertia = diag(0.1, 0.1, 0.1))]
        #[joint(b: revolute([0, 3, 4]), one -> two, at = [0.1, 0.2, 0.3], rpy = [90deg, 0, 180deg])]
        #[body(two, mass = 2, inertia = diag(0.1, 0.2, 0.15))]
        #[joint(c: prismatic(y), two -> three, at = [0, 0.4, 0])] #[body(three, mass = 1, inertia = diag(0.1, 0.1, 0.1))]
        struct Skew;";
    with_model(text, |model, graph| {
        let methods: Vec<Method> = (0..3).map(Method::Jacobian).collect();
        let compiled = passes::compile(model, graph, &methods, RunTime::Core);
        let walk = Walk::at(model, graph, 1);
        for (method, body) in methods.iter().zip(walk.bodies()) {
            let program = compiled.program(*method).unwrap();
            let read = |input| match input {
                dynamics_codegen::mechanics::equations::Input::Argument(Argument::Q, k) => walk.q[k],
                _ => f64::NAN,
            };
            assert_close(&walk.rows(&body.jacobian).concat(), &program.evaluate(read, &[]), &body.name);
        }
    });
}

/// What the steps come to is what Lagrange's equations come to from the energies of the plain recursion, in exact
/// arithmetic: equal to the letter.
#[test]
fn the_sums_are_the_closed_forms() {
    for text in ROBOTS {
        with_model(text, |model, graph| {
            let closed = closed_forms(model, graph).unwrap();
            let equations = lecture(model, graph).equations.unwrap();
            assert_eq!(equations.mass_matrix, closed.mass_matrix, "{text}");
            assert_eq!(equations.coriolis_matrix, closed.coriolis_matrix, "{text}");
            assert_eq!(equations.gravity_forces, closed.gravity_forces, "{text}");
            assert_eq!(equations.kinetic_energy, closed.kinetic_energy, "{text}");
            assert_eq!(equations.potential_energy, closed.potential_energy, "{text}");
            assert_eq!(equations.lagrangian, closed.lagrangian, "{text}");
        });
    }
}

/// Bodies add up: their shares of M to M, their energies to T and V.
#[test]
fn bodies_add_up() {
    for_each_walk(|walk| {
        let equations = walk.lecture.equations.as_ref().unwrap();
        let n = walk.v.len();
        let mut M = vec![0.0; n * n];
        let (mut T, mut V) = (0.0, walk.value(&equations.potential_at_rest));
        let shares = walk
            .bodies()
            .iter()
            .map(|body| &body.share)
            .chain(equations.rotors.iter().map(|rotors| &rotors.mass_matrix));
        for share in shares {
            M.iter_mut().zip(walk.rows(share).concat()).for_each(|(sum, entry)| *sum += entry);
        }
        for body in walk.bodies() {
            T += walk.value(&body.kinetic_energy);
            V += walk.value(&body.potential_energy);
        }
        T += equations.rotors.iter().map(|rotors| walk.value(&rotors.kinetic_energy)).sum::<f64>();
        assert_close(&M, &plain::mass_matrix(&walk.tree, &walk.q).concat(), "M");
        assert_close(&[T], &[plain::kinetic_energy(&walk.tree, &walk.q, &walk.v)], "T");
        assert_close(&[V], &[plain::potential_energy(&walk.tree, &walk.q)], "V");
    });
}

/// `C` by Christoffel's symbols is that of polarised bias forces, and each symbol is half the sum of its derivatives.
#[test]
fn christoffels_symbols_make_the_coriolis_matrix() {
    for_each_walk(|walk| {
        let equations = walk.lecture.equations.as_ref().unwrap();
        let expected = plain::coriolis_matrix(&walk.tree, &walk.q, &walk.v);
        assert_close(&walk.rows(&equations.coriolis_matrix).concat(), &expected.concat(), "C");
        let Some(symbols) = &equations.christoffel else {
            assert!(!walk.tree.is_one_dof());
            return;
        };
        let mut C = vec![vec![0.0; walk.v.len()]; walk.v.len()];
        for symbol in symbols {
            let ([i, j, k], value) = (symbol.indices, walk.value(&symbol.value));
            let [a, b, c] = symbol.derivatives.each_ref().map(|form| walk.value(form));
            assert_close(&[value], &[0.5 * (a + b - c)], "Γ");
            C[i][j] += value * walk.v[k];
            if j != k {
                C[i][k] += value * walk.v[j];
            }
        }
        assert_close(&C.concat(), &expected.concat(), "Γ·v");
    });
}

/// Row by row, Lagrange's equations are inverse dynamics.
#[test]
fn rows_are_inverse_dynamics() {
    for_each_walk(|walk| {
        let equations = walk.lecture.equations.as_ref().unwrap();
        let expected = plain::inverse_dynamics(&walk.tree, &walk.q, &walk.v, &walk.a);
        assert_close(&walk.column(&equations.forces), &expected, "τ");
        let rates = walk.tree.configuration_rate(&walk.q, &walk.v);
        match &equations.rates {
            Some(found) => assert_close(&walk.column(found), &rates, "q̇"),
            None => assert_eq!(rates, walk.v),
        }
        let passive = plain::passive::forces(&walk.tree, &walk.q, &walk.v);
        if let Some(found) = &equations.passive {
            assert_close(&walk.column(found), &passive, "P");
        }
        for ((row, force), passive) in equations.rows.iter().flatten().zip(&expected).zip(&passive) {
            let parts = walk.value(&row.rate) - walk.value(&row.by_coordinate);
            assert_close(&[walk.value(&row.force), parts], &[force - passive; 2], "a row");
        }
    });
}

/// The linear model has the derivatives of the recursion itself.
#[test]
fn the_linear_model_has_the_derivatives_of_inverse_dynamics() {
    for_each_walk(|walk| {
        let linear = walk.lecture.linear.as_ref().unwrap();
        let mut q = vec![0.0; walk.q.len()];
        walk.tree.normalise(&mut q);
        let still = vec![0.0; walk.v.len()];
        let found = Oracle::new(&walk.tree).inverse_dynamics_derivatives(&q, &still, &still);
        assert_close(&walk.rows(&linear.mass_matrix).concat(), &found.dtau_da.concat(), "M₀");
        assert_close(&walk.rows(&linear.stiffness).concat(), &found.dtau_dq.concat(), "K₀");
        assert_close(&walk.rows(&linear.damping).concat(), &found.dtau_dv.concat(), "D₀");
        let held = plain::inverse_dynamics(&walk.tree, &q, &still, &still);
        assert_close(&walk.column(&linear.hold), &held, "Υ₀");
        let Some(lower) = &linear.lower else { return };
        for (i, row) in walk.rows(lower).iter().enumerate() {
            let of = |rows: &[Vec<f64>]| -> Vec<f64> {
                rows[i].iter().map(|x| -x / found.dtau_da[i][i]).collect()
            };
            assert_close(row, &[of(&found.dtau_dq), of(&found.dtau_dv)].concat(), "A");
        }
    });
}

/// Terms of the energies are in all that is derived, and where they have no derivative there is no linear model.
#[test]
fn terms_of_the_energies_are_in_the_sums() {
    const ON_A_SPRING: &str = "
        #[joint(theta: revolute(y), world -> arm)] #[body(arm)]
        #[joint(r: prismatic(-z), arm -> bob)] #[body(bob, solid = point(m))]
        #[potential(k / 2 * (distance(world, bob) - l)^2)]
        struct OnASpring<T> { m: T, k: T, l: T }";
    const COUPLED: &str = "
        #[joint(a: prismatic(x), world -> one)] #[body(one, solid = point(m))]
        #[joint(b: prismatic(x), world -> two, at = [0, 0, h])] #[body(two, solid = point(m))]
        #[potential(k / 2 * (distance(one, two) - l)^2)]
        #[dissipation(c / 2 * (dot(a) - dot(b))^2)]
        #[kinetic(j / 2 * (dot(a) + dot(b))^2)]
        struct Coupled<T> { m: T, h: T, k: T, l: T, c: T, j: T }";
    for (text, flaw) in [(ON_A_SPRING, Some(NoLinear::NotSmooth)), (COUPLED, None)] {
        with_model(text, |model, graph| {
            let (closed, lecture) = (closed_forms(model, graph).unwrap(), lecture(model, graph));
            assert_eq!(lecture.linear.err(), flaw);
            let equations = lecture.equations.unwrap();
            assert!(!equations.terms.unwrap().potential_energy.is_zero());
            assert_eq!(equations.mass_matrix, closed.mass_matrix, "{text}");
            assert_eq!(equations.coriolis_matrix, closed.coriolis_matrix, "{text}");
            assert_eq!(equations.gravity_forces, closed.gravity_forces, "{text}");
            assert_eq!(equations.lagrangian, closed.lagrangian, "{text}");
        });
    }
}

/// A chain whose closed form nobody would read, with numbers and letters.
const SKEW: &str = "
    #[joint(q1: revolute(y), world -> b1)] #[body(b1, mass = m, com = [l/2, 0, 0.1], inertia = diag(0.1, 0.2, 0.15))]
    #[joint(q2: revolute(x), b1 -> b2, at = [l, 0, 0], stiffness = 3, armature = 0.02)]
    #[body(b2, mass = m, com = [l/2, 0, 0.1], inertia = diag(0.1, 0.2, 0.15))]
    #[joint(q3: universal(z, y), b2 -> b3, at = [l, 0, 0])] #[body(b3, mass = m, com = [l/2, 0, 0.1], inertia = diag(0.1, 0.2, 0.15))]
    #[joint(q4: helical(y, 10mm), b3 -> b4, at = [l, 0, 0])] #[body(b4, mass = m, com = [l/2, 0, 0.1], inertia = diag(0.1, 0.2, 0.15))]
    #[joint(q5: revolute(x), b2 -> b5, at = [l, 0, 0], mimic = q1, ratio = -2)]
    #[body(b5, mass = m, com = [l/2, 0, 0.1], inertia = diag(0.1, 0.2, 0.15))]
    struct Skew<T> { m: T, l: T }";

type Rows = Vec<Vec<f64>>;

fn product(a: &Rows, b: &Rows) -> Rows {
    let entry = |row: &Vec<f64>, j: usize| row.iter().zip(b).map(|(x, row)| x * row[j]).sum::<f64>();
    a.iter().map(|row| (0..b[0].len()).map(|j| entry(row, j)).collect()).collect()
}

fn transpose(a: &Rows) -> Rows {
    (0..a[0].len()).map(|j| a.iter().map(|row| row[j]).collect()).collect()
}

fn sum(a: &Rows, k: f64, b: &Rows) -> Rows {
    a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a + k * b).collect()).collect()
}

fn hat(p: &[f64]) -> Rows {
    vec![vec![0.0, -p[2], p[1]], vec![p[2], 0.0, -p[0]], vec![-p[1], p[0], 0.0]]
}

fn blocks([[a, b], [c, d]]: [[&Rows; 2]; 2]) -> Rows {
    let beside = |a: &Rows, b: &Rows| a.iter().zip(b).map(|(a, b)| [&a[..], b].concat()).collect::<Rows>();
    [beside(a, b), beside(c, d)].concat()
}

/// `[ω̂, v̂; 0, ω̂]`
fn ad(twist: &[f64]) -> Rows {
    let (v, w, o) = (hat(&twist[..3]), hat(&twist[3..]), vec![vec![0.0; 3]; 3]);
    blocks([[&w, &v], [&o, &w]])
}

/// The matrices that the words around a recursion speak of, from its parts: M, C and G.
fn assembled(walk: &Walk<'_, '_>, parts: &[Part]) -> [Rows; 3] {
    let n = walk.v.len();
    let (o, zero) = (vec![vec![0.0; 3]; 3], vec![vec![0.0; n]; 6]);
    let speeds: Rows = walk.v.iter().map(|&v| vec![v]).collect();
    let (mut M, mut C, mut G) = (vec![vec![0.0; n]; n], vec![vec![0.0; n]; n], vec![vec![0.0]; n]);
    let mut known: Vec<[Rows; 3]> = vec![];
    for part in parts {
        let (turned, moved) = (walk.rows(&part.rotation), walk.column(&part.translation));
        let back = transpose(&turned);
        let lever = product(&back, &hat(&moved)).iter().map(|row| row.iter().map(|x| -x).collect()).collect();
        let X = blocks([[&back, &lever], [&o, &back]]);
        let own = walk.rows(&part.motion);
        let spread: Rows = own
            .iter()
            .map(|row| {
                (0..n)
                    .map(|k| if part.speeds.contains(&k) { row[k - part.speeds.start] } else { 0.0 })
                    .collect()
            })
            .collect();
        let identity = vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 1.0]];
        let [R, J, dJ] =
            part.carrier.map_or([identity, zero.clone(), zero.clone()], |carrier| known[carrier].clone());
        let carried = product(&X, &J);
        let own_twist = transpose(&product(&spread, &speeds)).concat();
        let dJ = sum(&product(&X, &dJ), -1.0, &product(&ad(&own_twist), &carried));
        let (R, J) = (product(&R, &turned), sum(&carried, 1.0, &spread));
        if let Some(Inertia { mass, first, second }) = &part.inertia {
            let (mass, second) = (walk.value(mass), walk.rows(second));
            let first = first.as_ref().map_or(vec![0.0; 3], |first| walk.column(first));
            let (h, minus): (Rows, Rows) = (hat(&first), transpose(&hat(&first)));
            let scaled: Rows =
                (0..3).map(|i| (0..3).map(|j| if i == j { mass } else { 0.0 }).collect()).collect();
            let inertia = blocks([[&scaled, &minus], [&h, &second]]);
            let twist = transpose(&product(&J, &speeds)).concat();
            let momentum = transpose(&product(&inertia, &product(&J, &speeds))).concat();
            let (f, moment) = (transpose(&hat(&momentum[..3])), transpose(&hat(&momentum[3..])));
            let turning = sum(
                &sum(&product(&inertia, &ad(&twist)), -1.0, &product(&transpose(&ad(&twist)), &inertia)),
                1.0,
                &blocks([[&o, &f], [&f, &moment]]),
            );
            M = sum(&M, 1.0, &product(&transpose(&J), &product(&inertia, &J)));
            let rate = sum(&product(&inertia, &dJ), 0.5, &product(&turning, &J));
            C = sum(&C, 1.0, &product(&transpose(&J), &rate));
            let g: Rows = walk.tree.gravity.0.iter().map(|&g| vec![g]).collect();
            let g = transpose(&product(&transpose(&R), &g)).concat();
            let weight: Rows = g
                .iter()
                .map(|g| vec![mass * g])
                .chain(product(&h, &g.iter().map(|&g| vec![g]).collect()))
                .collect();
            G = sum(&G, -1.0, &product(&transpose(&J), &weight));
        }
        known.push([R, J, dJ]);
    }
    [M, C, G]
}

/// What is made of the parts of a recursion, in the way that the words say, is what the plain recursion has.
#[test]
fn parts_make_the_equations() {
    for text in ROBOTS.iter().chain([&SKEW]) {
        with_model(text, |model, graph| {
            let walk = Walk::at(model, graph, 1);
            let found = recursion(model, graph, &walk.lecture.notation).unwrap();
            let [mut M, C, G] = assembled(&walk, &found.parts);
            for (k, rotor) in found.rotors.iter().flat_map(|rotors| walk.column(rotors)).enumerate() {
                M[k][k] += rotor;
            }
            assert_close(&M.concat(), &plain::mass_matrix(&walk.tree, &walk.q).concat(), "M");
            assert_close(&C.concat(), &plain::coriolis_matrix(&walk.tree, &walk.q, &walk.v).concat(), "C");
            assert_close(&G.concat(), &plain::gravity_forces(&walk.tree, &walk.q), "G");
            let passive = plain::passive::forces(&walk.tree, &walk.q, &walk.v);
            let acting =
                found.passive.as_ref().map_or(vec![0.0; walk.v.len()], |passive| walk.column(passive));
            assert_close(&acting, &passive, "P");
        });
    }
}

/// What a student can read is written in closed form; beyond, and beyond what there are letters for, there is the recursion,
/// and beyond that the figure alone.
#[test]
fn a_long_derivation_goes_on_by_recursion() {
    let joint = |kind: &str, at: &str, k: usize| {
        let parent = if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) };
        format!(
            "#[joint(j{k}: {kind}, {parent} -> b{k}, at = {at})] #[body(b{k}, com = [l, 0, 0], solid = point(m))]"
        )
    };
    let chain = |kind: &str, at: &str, count: usize| {
        (0..count).map(|k| joint(kind, at, k)).collect::<String>() + "struct Chain<T> { m: T, l: T }"
    };
    let of =
        |text: &str, check: &dyn Fn(&Lecture)| with_model(text, |model, graph| check(&lecture(model, graph)));
    let coordinates = (0..15).map(|k| format!("#[coordinate(x{k}: length)] ")).collect::<String>();
    let speeds = (0..15).map(|k| format!("dot(x{k})^2")).collect::<Vec<_>>().join(" + ");
    let springs = (1..15).map(|k| format!("(x{} - x{k})^2", k - 1)).collect::<Vec<_>>().join(" + ");
    let masses = format!(
        "{coordinates} #[kinetic(m / 2 * ({speeds}))] #[potential(k / 2 * ({springs}))] struct Masses<T> {{ m: T, k: T }}"
    );
    for text in [chain("revolute(z)", "[l, 0, 0]", 4), masses] {
        of(&text, &|lecture| {
            assert!(
                lecture.equations.is_ok() && lecture.recursion.is_none() && lecture.linear.is_ok(),
                "{text}"
            );
        });
    }
    of(SKEW, &|lecture| {
        let long = lecture.equations.as_ref().unwrap_err();
        assert!(matches!(long.excess, Excess::Terms(count) if count > MOST_TERMS), "{long:?}");
        assert!(lecture.recursion.as_ref().unwrap().is_ok() && lecture.linear.is_ok());
    });
    of(&chain("revolute(z)", "[l, 0, 0]", 30), &|lecture| {
        assert_eq!(lecture.bodies.as_ref().unwrap_err().excess, Excess::Symbols);
        assert!(lecture.recursion.as_ref().unwrap().is_ok() && lecture.linear.is_err());
    });
    of(&chain("revolute(z)", "[l, 0, 0]", MOST_PARTS + 1), &|lecture| {
        assert_eq!(lecture.figure.as_ref().unwrap().joints.len(), MOST_PARTS + 1);
        assert!(lecture.recursion.as_ref().unwrap().is_err());
    });
}
