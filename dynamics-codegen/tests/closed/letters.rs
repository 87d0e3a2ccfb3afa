//! What symbols are called: no two alike, in LaTeX of ASCII alone, and read back, whatever the program calls them.

use std::collections::BTreeSet;

use dynamics_codegen::closed::{Form, Name, Notation, Role, math};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::{closed_forms, notation};
use dynamics_codegen::mechanics::equations::Inputs;
use dynamics_codegen::model;
use dynamics_codegen::symbolic::{Graph, SymbolId};

use super::field::Random;
use super::proof::spec_of;
use super::robots;

/// Names that are hard: functions, Greek, accents, digits inside, other scripts, and what prints alike.
const NAMES: [&str; 64] = [
    "m",
    "m1",
    "m_1",
    "m_1_2",
    "m1_2",
    "m12",
    "m_12",
    "m_c",
    "mc",
    "m_cart",
    "mcart",
    "M",
    "M1",
    "l",
    "l_",
    "l_0",
    "l1_2",
    "x",
    "x1",
    "x_dot",
    "xdot",
    "dx",
    "q",
    "q1",
    "q_1",
    "v",
    "v_x",
    "theta",
    "theta1",
    "theta_1",
    "θ",
    "θ1",
    "θ_1",
    "theta_",
    "Theta",
    "tau",
    "τ_1",
    "tau1",
    "lambda",
    "alpha2",
    "phi",
    "d",
    "d1",
    "s",
    "w",
    "sin",
    "cos",
    "sqrt",
    "dot",
    "type",
    "é",
    "größe",
    "naïve_ß",
    "漢",
    "字1",
    "Σ",
    "Υ",
    "Pi",
    "rπ",
    "m_θ",
    "θ_é",
    "a_very_long_name_of_a_constant_that_nobody_would_ever_type",
    "İ",
    "__a__",
];

/// LaTeX's commands that names and equations are made of; documents need no package for them but amsmath.
const COMMANDS: &str = "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi rho sigma tau phi chi psi omega \
    iota upsilon pi Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega dot ddot mathrm frac sqrt sin cos cdot left right \
    begin end grave acute hat tilde mathring check bar breve mathbf mathcal mathfrak boldsymbol";

/// Why TeX would stop at a text, if it would.
fn mistake_in(latex: &str) -> Option<String> {
    if !latex.is_ascii() {
        return Some("a letter that is not ASCII".to_owned());
    }
    let mut depth = 0_i32;
    let mut rest = latex;
    while let Some(c) = rest.chars().next() {
        rest = &rest[1..];
        match c {
            '\\' => {
                let name: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
                if name.is_empty() {
                    if !rest.starts_with([',', '\\', '_', '#', '$', '%', '&', '{', '}']) {
                        return Some(format!("a command `\\{}`", &rest[..rest.len().min(4)]));
                    }
                    rest = &rest[1..];
                } else if !COMMANDS.split_whitespace().any(|known| known == name) {
                    return Some(format!("a command `\\{name}`"));
                } else {
                    rest = &rest[name.len()..];
                }
            }
            '{' => depth += 1,
            '}' => depth -= 1,
            '#' | '$' | '%' | '~' => return Some(format!("a bare `{c}`")),
            _ => {}
        }
        if depth < 0 {
            return Some("a brace that closes nothing".to_owned());
        }
    }
    (depth != 0).then(|| "a brace that is not closed".to_owned())
}

/// What holds for every notation: distinct names that are read back where they stand in products, powers and functions.
fn check(notation: &Notation) {
    let symbols: Vec<Form> =
        (0..notation.len()).map(|k| Form::Symbol(SymbolId(u32::try_from(k).unwrap()))).collect();
    let distinct = |write: fn(&Form, &Notation) -> String| {
        let texts: BTreeSet<String> = symbols.iter().map(|symbol| write(symbol, notation)).collect();
        assert_eq!(texts.len(), symbols.len(), "{texts:?}");
    };
    distinct(Form::unicode);
    distinct(Form::latex);
    distinct(Form::mathml);
    for (k, symbol) in symbols.iter().enumerate() {
        let next = &symbols[(k + 1) % symbols.len()];
        let form = Form::sum([
            Form::product([Form::integer(2), symbol.clone().power(2), next.clone(), symbol.clone().sin()]),
            Form::product([next.clone().cos().power(3), symbol.clone()]).over(next.clone()).negative(),
            Form::product([Form::integer(2), symbol.clone()]).cos(),
            Form::sum([symbol.clone(), next.clone()]).root(),
        ]);
        let (unicode, latex) = (form.unicode(notation), form.latex(notation));
        assert_eq!(Form::parse_unicode(&unicode, notation).as_ref(), Ok(&form), "{unicode}");
        assert_eq!(Form::parse_latex(&latex, notation).as_ref(), Ok(&form), "{latex}");
        assert_eq!(mistake_in(&latex), None, "{latex}");
        let xml = math(&form.mathml(notation));
        assert!(roxmltree::Document::parse(&xml).is_ok(), "{xml}");
    }
}

/// Names that are different, in random order.
fn some_names(count: usize, random: &mut Random) -> Vec<&'static str> {
    let mut left = NAMES.to_vec();
    (0..count).map(|_| left.swap_remove((random.next() % left.len() as u64) as usize)).collect()
}

#[test]
fn symbols_of_any_name_are_distinct_and_read_back() {
    for seed in 0..60 {
        let mut random = Random(seed);
        let mut notation = Notation::new();
        for text in some_names(12, &mut random) {
            let name = Name::read(text);
            notation.add(name.clone(), Role::Parameter);
            notation.add(Name::word(text), Role::Parameter);
            notation.add(name.dotted(), Role::Speed);
            notation.add(name, Role::Coordinate);
        }
        check(&notation);
    }
}

/// A robot whose fields and joints have these names.
fn robot(names: &[&str], random: &mut Random) -> String {
    const KINDS: [&str; 8] = [
        "revolute(y)",
        "revolute(x)",
        "prismatic(x)",
        "prismatic([0, 3, 4])",
        "planar(z)",
        "universal(x, y)",
        "ball",
        "cylindrical(z)",
    ];
    let raw = |name: &str| {
        if syn::parse_str::<syn::Ident>(name).is_ok() { name.to_owned() } else { format!("r#{name}") }
    };
    let (joints, fields) = names.split_at(3);
    let mut text = String::new();
    for (k, joint) in joints.iter().enumerate() {
        let kind = KINDS[(random.next() % KINDS.len() as u64) as usize];
        // Some fields have the name of a joint.
        let parent = if k == 0 || random.next().is_multiple_of(3) {
            "world".to_owned()
        } else {
            format!("body{}", k - 1)
        };
        text += &format!(
            "#[joint({}: {kind}, {parent} -> body{k})] #[body(body{k}, mass = {}, com = [0, {}, 0], inertia = diag(1, 2, {}))]\n",
            raw(joint),
            raw(fields[0]),
            raw(fields[1 + k]),
            raw(fields[4])
        );
    }
    let fields: Vec<String> = fields.iter().map(|name| format!("{}: T", raw(name))).collect();
    format!("{text} struct Robot<T> {{ {} }}", fields.join(", "))
}

#[test]
fn symbols_of_any_robot_are_distinct_and_read_back() {
    for seed in 0..120 {
        let mut random = Random(seed);
        let mut names = some_names(8, &mut random);
        if seed.is_multiple_of(2) {
            names[4] = names[0];
            names[5] = names[1];
        }
        let text = robot(&names, &mut random);
        let (graph, mut diags) = (Graph::new(), Diagnostics::new());
        let model = model::build(&spec_of(&text), &graph, &mut diags);
        diags.check().unwrap_or_else(|found| panic!("{text}: {found:?}"));
        let model = model.unwrap();
        let notation = notation(&model);
        let inputs = Inputs::of(&model);
        assert_eq!(notation.len(), inputs.parameters + inputs.coordinates + 3 * inputs.dof, "{text}");
        check(&notation);
        // A rate is that of its coordinate, and no coordinate needs a mark.
        for joint in model.joints.iter().filter(|joint| joint.q.len() == joint.v.len()) {
            for (q, v) in joint.q.clone().zip(joint.v.clone()) {
                let letter = |at: usize| &notation.letter(SymbolId(u32::try_from(at).unwrap())).name;
                let name = letter(inputs.parameters + q);
                let rates =
                    [0, inputs.dof].map(|more| letter(inputs.parameters + inputs.coordinates + v + more));
                assert_eq!(rates, [&name.dotted(), &name.dotted().dotted()], "{text}");
                let is_marked = name.unicode().ends_with(['′', '_']);
                assert!(!is_marked, "{} in {text}", name.unicode());
            }
        }
    }
}

#[test]
fn latex_of_robots_is_of_known_commands() {
    for (name, source) in robots::ROBOTS {
        let (graph, mut diags) = (Graph::new(), Diagnostics::new());
        let model = model::build(&spec_of(source), &graph, &mut diags);
        diags.check().unwrap();
        let Ok(forms) = closed_forms(&model.unwrap(), &graph) else { continue };
        let notation = &forms.notation;
        let mut texts: Vec<String> = [&forms.mass_matrix, &forms.coriolis_matrix, &forms.gravity_forces]
            .map(|m| m.latex(notation))
            .to_vec();
        texts.extend(
            [&forms.kinetic_energy, &forms.potential_energy, &forms.lagrangian]
                .map(|form| form.latex(notation)),
        );
        texts.extend(forms.definitions.iter().map(|(_, form)| form.latex(notation)));
        for text in texts {
            assert_eq!(mistake_in(&text), None, "{name}: {text}");
        }
    }
}

/// What the coordinates of a robot are called.
fn coordinates(source: &str) -> Vec<String> {
    let (graph, mut diags) = (Graph::new(), Diagnostics::new());
    let model = model::build(&spec_of(source), &graph, &mut diags);
    diags.check().unwrap_or_else(|found| panic!("{source}: {found:?}"));
    let model = model.unwrap();
    let (notation, inputs) = (notation(&model), Inputs::of(&model));
    let symbols = notation.letters()[inputs.parameters..].iter().take(inputs.coordinates);
    symbols.map(|letter| letter.name.unicode()).collect()
}

#[test]
fn coordinates_have_the_letters_of_textbooks() {
    let chain = |joints: &[&str], fields: &str| {
        let far: String = fields.split_whitespace().map(|field| format!(" + {field}")).collect();
        let line = |(k, joint): (usize, &&str)| {
            let parent = if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) };
            format!(
                "#[joint({joint}, {parent} -> b{k})] #[body(b{k}, com = [0.1m{far}, 0.2, 0.3], solid = sphere(m, 0.1))]"
            )
        };
        let lines: String = joints.iter().enumerate().map(line).collect();
        let fields: String = fields.split_whitespace().map(|field| format!("{field}: T, ")).collect();
        coordinates(&format!("{lines} struct Robot<T> {{ m: T, {fields} }}"))
    };
    let [turn, slide] = ["revolute(y)", "prismatic([0, 3, 4])"];
    let named = |names: &[(&str, &str)]| {
        names.iter().map(|(name, kind)| format!("{name}: {kind}")).collect::<Vec<_>>()
    };
    type Case<'c> = (&'c [(&'c str, &'c str)], &'c str, &'c [&'c str]);
    let cases: [Case<'_>; 9] = [
        // The Stanford arm, as in its books: the slide has the joint's number.
        (&[("waist", turn), ("shoulder", turn), ("boom", slide)], "d2 d6", &["θ₁", "θ₂", "d₃"]),
        (&[("cart", "prismatic(x)"), ("pole", turn)], "", &["x", "θ"]),
        // Own letters choose first.
        (&[("hip", turn), ("theta", turn), ("knee", turn)], "", &["θ₁", "θ", "θ₂"]),
        (&[("hip", turn), ("theta1", turn)], "", &["θ₂", "θ₁"]),
        (&[("theta", turn), ("theta_1", turn), ("theta1", turn)], "", &["θ", "θ₁", "θ₂"]),
        // A field keeps its letter.
        (&[("hip", turn), ("rod", slide)], "theta d", &["φ₁", "s₂"]),
        (&[("l", slide)], "l", &["d"]),
        (&[("hip", turn), ("knee", turn)], "theta2", &["φ₁", "φ₂"]),
        (&[("base", "planar(z)"), ("arm", turn)], "", &["x", "y", "θ", "θ₁"]),
    ];
    for (joints, fields, expected) in cases {
        let joints = named(joints);
        let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
        assert_eq!(chain(&joints, fields), expected, "{joints:?}, {fields}");
    }
    let two = "#[joint(left: prismatic(x), world -> a)] #[body(a, solid = point(m))]
        #[joint(right: prismatic(x), world -> b)] #[body(b, solid = point(m))] struct Two<T> { m: T }";
    assert_eq!(coordinates(two), ["x₁", "x₂"]);
}

/// The documentation of what is generated has no letter in two meanings.
#[test]
fn documentation_leaves_the_robot_its_letters() {
    let of = |mass: &str, length: &str| {
        let source = format!(
            "#[joint(theta: revolute(y), world -> rod)] #[body(rod, com = [0, 0, {length}], solid = point({mass}))]
             struct Robot<F> {{ {mass}: F, {length}: F }}"
        );
        dynamics_codegen::generate(&syn::parse_str(&source).unwrap()).unwrap().to_string()
    };
    let (usual, greedy) = (of("m", "l"), of("M", "L"));
    for line in ["M = [m l²]", "L = ½ m l² θ\u{307}²"] {
        assert!(usual.contains(line) && !usual.contains("of its own"), "{line} in {usual}");
    }
    for line in ["𝐌 = [M L²]", "ℒ = ½ M L² θ\u{307}²", "The robot has a letter M of its own; here this is 𝐌:"]
    {
        assert!(greedy.contains(line), "{line} in {greedy}");
    }
}
