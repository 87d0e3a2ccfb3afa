//! The derive never panics, whatever it is given, and always answers in whole items of Rust.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::panic::{AssertUnwindSafe, catch_unwind};

use dynamics_codegen::no_files;
use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};

const MUTANTS: usize = 2500;

/// Small robots that between them use all of the grammar.
const ROBOTS: &[&str] = &[
    r#"#[dynamics(gravity = [0, 0, -g], crate = "::dynamics_core", outputs(inverse_dynamics, mass_matrix))]
    #[joint(turn: revolute, world -> one, dh(l, 90deg, 0.1 * l, -pi / 2), limits = [-1, 1], velocity = 3)]
    #[body(one, mass = m, com = [0, (l + 1) / 2, -l], inertia = tensor(i, 0, 0, i, 0, i), inertia_rpy = [0.1, 0, 0])]
    pub struct Arm<T: Copy> { pub m: T, l: T, i: T, g: T, name: String }"#,
    r"#[dynamics(allow(nonphysical_inertia), snap = off)]
    #[joint(x: prismatic([0, 1, -1]), world -> slide, at = [0, 0, sqrt(2)], rpy = [0, 0, 30deg])]
    #[body(slide, solid = cylinder(2.5kg, 30mm, 0.4, x))]
    #[joint(tip: fixed, slide -> tool, mdh(0, 0, 1, 0))]
    struct Slide;",
    r"#[joint(h: continuous, world -> rod, screw(-y, through = [0, 1, 0]))]
    #[dynamics(outputs(forward_dynamics, pose))]
    #[body(rod, mass = 1, com = [0.5, 0, 0], inertia = [[0, 0, 0], [0, 1, 0], [0, 0, 1]], allow(nonphysical_inertia))]
    struct Rod { unused: Vec<u8>, r#type: f64 }",
    r"#[joint(a: revolute(z), world -> b)] #[body(b, mass = m, com = [r, 0, 0], inertia = diag(0, i, i))]
    #[joint(c: revolute(-x), b -> d, at = [r, 0, 0])] #[body(d, solid = cuboid(m, [r, r, 0.1]))]
    #[dynamics(outputs(mass_matrix, coriolis_matrix, gravity_forces))]
    struct Two { m: f32, r: f32, i: f32 }",
    r"#[joint(q: revolute(x), world -> ball, at = [0, 0, w])] #[body(ball, solid = sphere(2 * m, w * sin(t)))]
    struct Pendulum<T> where T: Send { m: T, w: T, t: T }",
    r"#[joint(p: universal(x, -y), world -> a, actuated = off)] #[body(a, solid = sphere(m, 1))]
    #[joint(s: helical(z, 2mm), a -> b, rotor = j, gear = 30, locked = 0.1)] #[body(b, solid = sphere(1, 1))]
    #[joint(f: prismatic(y), b -> c, mimic = t, ratio = -w, offset = 1mm, damping = 3, friction = 1, friction_speed = 0.1)]
    #[body(c, solid = sphere(1, 1))]
    #[joint(t: revolute, b -> d, screw(y, [0, w, 0]), armature = j, stiffness = 2, rest = 30deg)]
    #[body(d, solid = sphere(1, 1))]
    #[dynamics(outputs(mass_matrix, bias_forces))]
    struct Gripper { m: f64, w: f64, j: f64 }",
    r"#[joint(o: ball, world -> a)] #[body(a, solid = sphere(2, 1))] #[dynamics(outputs(mass_matrix))]
    #[joint(c: cylindrical(z), a -> b)] #[body(b, solid = sphere(1, 1))]
    struct Ball;",
    r"#[joint(o: free, world -> a)] #[body(a, solid = sphere(2, 1))] #[dynamics(outputs(gravity_forces))]
    #[joint(c: planar([1, 0, 2]), a -> b)] #[body(b, solid = sphere(1, 1))] #[joint(t: translation, a -> d)]
    #[body(d, solid = point(m))]
    struct Free<S> { m: S }",
    r"#[joint(p: prismatic(z), world -> bob)] #[body(bob, solid = point(m))] #[joint(o: ball, world -> a)] #[body(a)]
    #[joint(h: fixed, a -> hook, at = [0, 0.1, 0])] #[coordinate(t: angle, actuated = off)]
    #[potential(k / 2 * (distance(bob, hook) - l)^2 - m * l * 9.81N / 1kg * cos(t))]
    #[kinetic(m / 2 * (dot(l * sin(t))^2 + p^2 * dot(t)^2) + j * (o.wx^2 + o.wy^2 + (o.wz - dot(t))^2 / (1 + t^2)))]
    #[dissipation(c / 2 * dot(z(hook))^2 + f * sqrt(dot(p)^2 + 1e-4))]
    #[dynamics(outputs(bias_forces, mass_matrix, coriolis_matrix, lagrangian))]
    struct Swing<T> { m: T, k: T, l: T, j: T, c: T, f: T }",
];

/// What slips in: numbers of every size, names of every script, signs, groups, and other robots' words.
const STRANGE: &str = r#"
    0 -1 1e400 1e-400 1e300 1e-300 1e200 99999999999999999999999999999999999999999999 0.1e 1__0 0x1F 1e5deg 3parsecs
    1f32 1u8 90deg 3kg 2mm 1.5.2 'c' "text" b"bytes" c"c" r"raw" 'life
    ü Ω 变量 é_1 ſ ǅ ŉ ß _ __ self Self crate super r#type r#fn T f64 q v a tau m00 e0 world pi PI sin sqrt tan
    + - * / = == -> => , ; : :: . .. ! # $ & | < > ? @ ~ ^ %
    [] () {} [0, 0, 0] [1e200, 0, 0] (((1))) {1} diag(0, 0, 0) diag(1, 1, 3) point(0) sphere(1, 0) tensor(1, 1, 1)
    at = [1, 2, 3], rpy = [1, 1, 1], mass = 0, inertia = diag(0, 0, 1), allow(nonphysical_inertia), limits = [0, 1],
    mimic = q, ratio = 2, locked = 0.1, actuated = off, damping = 0.1, gear = 3, base = free, helical(z, 1mm)
    revolute fixed prismatic continuous ball free universal(x, y) cylindrical planar translation mimic ratio offset locked
    armature rotor friction friction_speed stiffness rest base mass com solid dh mdh screw through joint body dynamics
    dot(q) dot(1) distance(a, world) distance(a, b) z(a) x(world) base.x o.wx ^2 ^-1 ^0 angle length 3J 1N_per_m
    #[joint(q: fixed, world -> a)] #[body(a)] #[dynamics()] #[joint] #[doc = "x"] struct enum union impl pub where"#;

/// Numbers for the places of numbers.
const NUMBERS: &str = "0 1 2 0.3 0.02 90deg 0.5 (1/3) (-1) (pi/4) (sqrt(2)) (1-1) 12 7";

/// Numbers that are the same on every machine: splitmix64 of a counter.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) % limit.max(1) as u64) as usize
    }
}

/// The tokens of a text; what is no token on its own is left out.
fn vocabulary(text: &str) -> Vec<TokenTree> {
    text.split_whitespace().filter_map(|word| word.parse::<TokenStream>().ok()).flatten().collect()
}

/// The number of tokens, those within groups included.
fn count(tokens: &TokenStream) -> usize {
    let within = |token| if let TokenTree::Group(group) = token { count(&group.stream()) } else { 0 };
    tokens.clone().into_iter().map(|token| 1 + within(token)).sum()
}

/// Replaces the token at a position, counted as `count` does, by what `new` makes of it.
fn edit(
    tokens: TokenStream,
    at: &mut usize,
    new: &mut dyn FnMut(TokenTree) -> Vec<TokenTree>,
) -> TokenStream {
    let mut edited = vec![];
    for token in tokens {
        let here = *at == 0;
        *at = at.wrapping_sub(1);
        match token {
            token if here => edited.extend(new(token)),
            TokenTree::Group(group) => {
                edited.push(Group::new(group.delimiter(), edit(group.stream(), at, new)).into());
            }
            token => edited.push(token),
        }
    }
    edited.into_iter().collect()
}

fn token_at(tokens: &TokenStream, at: usize) -> TokenTree {
    let mut found = None;
    edit(tokens.clone(), &mut { at }, &mut |token| {
        found = Some(token.clone());
        vec![token]
    });
    found.unwrap_or_else(|| Ident::new("none", Span::call_site()).into())
}

/// The robot with other numbers in the place of some of its own: most are robots still.
fn renumbered(mut tokens: TokenStream, numbers: &[TokenTree], random: &mut Random) -> TokenStream {
    for _ in 0..1 + random.below(3) {
        let size = count(&tokens);
        let is_literal = |at: &usize| matches!(token_at(&tokens, *at), TokenTree::Literal(_));
        let literals: Vec<usize> = (0..size).filter(is_literal).collect();
        let number = numbers[random.below(numbers.len())].clone();
        let at = literals[random.below(literals.len())];
        tokens = edit(tokens, &mut { at }, &mut |_| vec![number.clone()]);
    }
    tokens
}

fn mutant(mut tokens: TokenStream, strange: &[TokenTree], random: &mut Random) -> TokenStream {
    for _ in 0..1 + random.below(3) {
        let size = count(&tokens);
        let at = random.below(size);
        let other = match random.below(2) {
            0 => token_at(&tokens, random.below(size)),
            _ => strange[random.below(strange.len())].clone(),
        };
        let kind = random.below(6);
        tokens = edit(tokens, &mut { at }, &mut |token| match kind {
            0 => vec![],
            1 => vec![token.clone(), token],
            2 => vec![token, other.clone()],
            3 => vec![other.clone(), token],
            _ => vec![other.clone()],
        });
    }
    tokens
}

/// Whether the derive answers without a panic, and in items; and whether it took the robot.
fn answer(input: &TokenStream) -> bool {
    let text = input.to_string();
    let output = catch_unwind(AssertUnwindSafe(|| dynamics_codegen::derive(input.clone(), no_files)))
        .unwrap_or_else(|_| panic!("a panic on\n{text}"));
    let mistake = syn::parse2::<syn::File>(output.clone()).err();
    assert!(mistake.is_none(), "{}\non\n{text}\nin\n{output}", mistake.unwrap());
    let output = output.to_string();
    assert!(!output.contains("NaN") && !output.contains("inf)"), "{output}\non\n{text}");
    !output.contains("compile_error")
}

/// As `answer`; moments of inertia of 1e200 among those of one may fail the self-check, sound ones may not.
fn answer_of_a_sound_robot(input: &TokenStream) -> bool {
    let output = dynamics_codegen::derive(input.clone(), no_files).to_string();
    assert!(!output.contains("SelfCheckFailed"), "{input}\n{}", output.split_at(120).0);
    answer(input)
}

#[test]
fn no_input_panics() {
    let strange = vocabulary(STRANGE);
    let robots: Vec<TokenStream> = ROBOTS.iter().map(|text| text.parse().unwrap()).collect();
    for robot in &robots {
        assert!(answer(robot), "{}", dynamics_codegen::derive(robot.clone(), no_files));
    }
    let mut random = Random(2026);
    for k in 0..MUTANTS {
        answer(&mutant(robots[k % robots.len()].clone(), &strange, &mut random));
    }
    let numbers = vocabulary(NUMBERS);
    let renumbered = |k: usize| renumbered(robots[k % robots.len()].clone(), &numbers, &mut random);
    let taken = (0..MUTANTS / 10).map(renumbered).filter(answer_of_a_sound_robot).count();
    assert!(taken > MUTANTS / 30, "only {taken} robots with other numbers were taken");
}

#[test]
fn deep_nesting_is_a_mistake() {
    for depth in [31, 40, 63, 64, 128, 1_000] {
        let (open, close) = ("(".repeat(depth), ")".repeat(depth));
        for text in [
            format!("#[joint(q: revolute(z), world -> a)] #[body(a, mass = {open}1{close})] struct R;"),
            format!("struct R {{ a: {open}u8{close} }}"),
        ] {
            assert!(!answer(&text.parse().unwrap()));
        }
    }
}

#[test]
fn numbers_whose_products_overflow_are_a_mistake() {
    let robot = "#[dynamics(gravity = [0, -1e100, 0])] #[joint(q: revolute(z), world -> a)]
        #[body(a, com = [1e20, 0, 0], solid = sphere(1e250, 1))] struct R;";
    let output = dynamics_codegen::derive(robot.parse().unwrap(), no_files).to_string();
    assert!(output.contains("NumberOutOfRange"), "{output}");
}

/// Nothing is wrong with them, and the check that the programs go through must not say so: in UTM coordinates, with a load of
/// any mass, in any gravity.
#[test]
fn no_number_of_a_sound_robot_is_taken_for_a_mistake_of_the_compiler() {
    const OUTPUTS: &str = "mass_matrix, inverse_mass_matrix, forward_dynamics, forward_dynamics_derivatives,
        forward_dynamics_with_derivatives, base_regressor, centroidal_momentum_matrix, pose";
    let arm = |gravity: &str, at: &str, load: &str| {
        format!(
            "#[dynamics(gravity = {gravity}, outputs({OUTPUTS}))] #[joint(base: fixed, world -> site, at = {at}, rpy = [0.3, 0.4, 0.5])]
            #[joint(a: revolute(y), site -> upper)] #[body(upper, solid = rod(2, 0.5, z), com = [0, 0, 0.25])]
            #[joint(b: revolute(x), upper -> lower, at = [0, 0, 0.5])]
            #[body(lower, solid = rod(1, 0.4, z), com = [0, 0, 0.2])]
            #[joint(c: revolute(z), lower -> hand, at = [0, 0, 0.4])]
            #[body(hand, mass = {load}, com = [0, 0.001, 0.03], inertia = diag(2e-4, 2e-4, 4e-5))] struct Arm;"
        )
    };
    let (earth, here) = ("[0, 0, -9.81]", "[0, 0, 0]");
    for robot in [
        arm(earth, "[500000, 5000000, 100]", "0.1"),
        arm(earth, "[5e15, 5e14, 100]", "0.1"),
        arm(earth, "[1e200, 0, 0]", "0.1"),
        arm(earth, here, "1e6"),
        arm(earth, here, "1e8"),
        arm("[0, 1e155, -9.81]", here, "0.1"),
        arm("[0, 1e-170, 0]", here, "0.1"),
    ] {
        let robot: TokenStream = robot.parse().unwrap();
        let output = dynamics_codegen::derive(robot.clone(), no_files).to_string();
        assert!(!output.contains("compile_error"), "{robot}\n{}", output.split_at(2000).0);
    }
}
