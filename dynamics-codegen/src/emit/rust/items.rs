//! The items that stand around the methods: impls, the prepared companion, the frames.

use std::fmt::Write as _;

use super::body::{self, Context, Literals};
use super::methods::{self, Written};
use super::names::{self, Names, keyword_safe};
use super::{Form, Input, Item};
use crate::mechanics::equations::{Input as Symbol, Method};
use crate::model::Limits;
use crate::model::names::{frame_type, hides_a_common_name};
use crate::passes::Cost;
use crate::symbolic::{Expr, Op};

/// Writes everything that is generated for a robot.
pub fn implementation(input: &Input<'_, '_>) -> String {
    let emitter = Emitter::new(input);
    let written = emitter.methods();
    let mut text = emitter.companion_struct();
    text.push_str(&emitter.frame_types());
    let _ =
        writeln!(text, "#[allow({}, reason = \"generated arithmetic\")]", allowed("unused, non_snake_case"));
    text.push_str("const _: () = {\n");
    text.push_str(&emitter.alias());
    let _ = writeln!(text, "    use {}::__private::*;\n", emitter.item.core);
    for part in [
        emitter.prepare(),
        emitter.table(),
        emitter.mechanism(&written),
        emitter.dynamics(&written),
        emitter.derivatives(&written),
        emitter.state_space(&written),
        emitter.frames(&written),
    ] {
        text.push_str(&part);
    }
    text.push_str(if emitter.alias().is_empty() { "};\n" } else { "};\n};\n" });
    text
}

/// The lints that generated code is free of, whatever else it does.
fn allowed(lints: &str) -> String {
    format!("{lints}, clippy::all, clippy::pedantic, clippy::nursery")
}

/// A type that impls are for.
pub(super) struct Host {
    /// The type, with its arguments.
    type_: String,
    /// Its parameters with their bounds, without the scalar of a unit struct.
    parameters: Vec<String>,
    /// Its where-clause.
    clause: String,
}

impl Host {
    /// `<T: Scalar>`; nothing without parameters.
    fn generics<'a>(&'a self, scalar: impl IntoIterator<Item = &'a String>) -> String {
        let all: Vec<&str> = self.parameters.iter().chain(scalar).map(String::as_str).collect();
        if all.is_empty() { String::new() } else { format!("<{}>", all.join(", ")) }
    }
}

pub(super) struct Emitter<'m, 'g> {
    pub(super) input: &'m Input<'m, 'g>,
    item: &'m Item,
    pub(super) dof: usize,
    /// The scalar's name in the impls.
    pub(super) scalar: String,
    /// The bound of the scalar where it is no parameter of the robot.
    pub(super) scalar_parameter: Option<String>,
    /// The parameters' names in code.
    parameters: Vec<String>,
    fields: Vec<String>,
    frame_types: Vec<String>,
}

impl<'m, 'g> Emitter<'m, 'g> {
    fn new(input: &'m Input<'m, 'g>) -> Self {
        let parameters = parameter_names(input);
        let fields = field_names(input, &parameters);
        let scalar = match &input.item.form {
            Form::Generic(parameter) => parameter.clone(),
            Form::Concrete(name) => (*name).to_owned(),
            Form::Unit => input.item.free_type_name("T"),
        };
        let is_free = input.item.form == Form::Unit;
        Self {
            input,
            scalar_parameter: is_free.then(|| format!("{scalar}: Scalar")),
            item: input.item,
            dof: input.compiled.inputs.dof,
            scalar,
            parameters,
            fields,
            frame_types: {
                let frames = &input.model.tree.frames;
                frames.iter().map(|frame| frame_type(&frame.name, &input.item.name)).collect()
            },
        }
    }

    /// Whether there is a companion apart from the robot itself.
    fn is_prepared(&self) -> bool {
        !self.fields.is_empty()
    }

    pub(super) fn companion_name(&self) -> String {
        if self.is_prepared() {
            format!("{}Prepared", self.item.bare_name())
        } else {
            self.robot_name().to_owned()
        }
    }

    /// What the robot is called inside the block: its name, or an alias where the block's imports hide that.
    fn robot_name(&self) -> &str {
        if hides_a_common_name(&self.item.name) { "ThisRobot" } else { &self.item.name }
    }

    /// The alias, and the beginning of a block that sees it.
    fn alias(&self) -> String {
        let Item { name, declared, arguments, .. } = self.item;
        if !hides_a_common_name(name) {
            return String::new();
        }
        format!("    type ThisRobot{declared} = {name}{arguments};\n    const _: () = {{\n")
    }

    /// The robot's type.
    fn robot(&self) -> Host {
        let Item { parameters, arguments, clause, .. } = self.item;
        let type_ = format!("{}{arguments}", self.robot_name());
        Host { type_, parameters: parameters.clone(), clause: clause.clone() }
    }

    /// The type that carries the arithmetic.
    pub(super) fn prepared(&self) -> Host {
        if !self.is_prepared() {
            return self.robot();
        }
        let name = self.companion_name();
        match &self.item.form {
            Form::Generic(parameter) => Host {
                type_: format!("{name}<{parameter}>"),
                parameters: vec![format!("{parameter}: Scalar")],
                clause: String::new(),
            },
            _ => Host { type_: name, parameters: vec![], clause: String::new() },
        }
    }

    fn literals(&self) -> Literals {
        match self.item.form {
            Form::Concrete(_) => Literals::Plain,
            _ => Literals::Of(self.scalar.clone()),
        }
    }

    /// What a body of the companion's impls is written with.
    pub(super) fn context<'a>(&'a self, companion: &'a str) -> Context<'a> {
        let (fields, parameters) = (&self.fields, &self.parameters);
        Context { companion, fields, parameters, literals: self.literals(), dof: self.dof }
    }

    fn methods(&self) -> Vec<Written> {
        let companion_name = self.companion_name();
        let context = self.context(&companion_name);
        let write = |method| methods::write(method, &context, &self.scalar, &self.prepared().type_);
        self.input.compiled.methods.iter().map(write).collect()
    }

    fn companion_struct(&self) -> String {
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
    fn prepare(&self) -> String {
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
        let program = &self.input.compiled.preparation;
        let context = Context {
            companion: "",
            fields: &[],
            parameters: &self.parameters,
            literals: self.literals(),
            dof: self.dof,
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

    /// The header `impl<T: Scalar> Trait for Type {`; `type_` is the host's or that of one of its frames.
    fn open(&self, host: &Host, trait_: &str, type_: &str) -> String {
        let generics = host.generics(&self.scalar_parameter);
        format!("    #[automatically_derived]\n    impl{generics} {trait_} for {type_}{} {{\n", host.clause)
    }

    /// The header of an inherent impl, or one of a trait `for ` the host, where a unit struct needs no scalar.
    pub(super) fn open_without_scalar(&self, host: &Host, trait_for: &str) -> String {
        let Host { type_, clause, .. } = host;
        format!(
            "    #[automatically_derived]\n    impl{} {trait_for}{type_}{clause} {{\n",
            host.generics(None)
        )
    }

    /// The types that the constants are implemented for: no scalar needed on a unit struct.
    fn mechanism(&self, written: &[Written]) -> String {
        let n = self.dof;
        let quoted =
            |names: Vec<&str>| names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
        let model = self.input.model;
        let joints = quoted(model.joints.iter().map(|joint| joint.name.as_str()).collect());
        let bodies = quoted(model.tree.frames.iter().map(|frame| frame.name.as_str()).collect());
        let mut constants = format!(
            "        const NQ: usize = {n};\n        const NV: usize = {n};\n        const NU: usize = {n};\n        \
             const NAME: &'static str = {:?};\n        const JOINT_NAMES: &'static [&'static str] = &[{joints}];\n        \
             const BODY_NAMES: &'static [&'static str] = &[{bodies}];\n",
            model.name
        );
        constants.push_str("        const LIMITS: &'static [JointLimits] = &[\n");
        for joint in &model.joints {
            let _ = writeln!(constants, "            {},", limits(joint.limits));
        }
        constants.push_str("        ];\n        const COST: Costs = Costs {\n");
        for method in written.iter().filter(|written| !methods::takes_robot(written.method)) {
            let _ = writeln!(constants, "            {}: {},", method.method.name(), cost(method.cost));
        }
        if self.is_prepared() {
            let _ =
                writeln!(constants, "            prepare: {},", cost(self.input.compiled.preparation.cost()));
        }
        constants.push_str("            ..Costs::ZERO\n        };\n    }\n\n");
        let prepared = self.prepared();
        let mut text = self.open_without_scalar(&prepared, "Mechanism for ") + &constants;
        if self.is_prepared() {
            text.push_str(&self.open_without_scalar(&self.robot(), "Mechanism for "));
            for (name, type_) in CONSTANTS {
                let _ = writeln!(text, "        const {name}: {type_} = <{}>::{name};", prepared.type_);
            }
            text.push_str("    }\n\n");
        }
        text
    }

    /// The companion, and the robot where it is another type.
    fn types(&self) -> Vec<Host> {
        if self.is_prepared() { vec![self.prepared(), self.robot()] } else { vec![self.robot()] }
    }

    fn dynamics(&self, written: &[Written]) -> String {
        let wanted =
            |method: Method| !methods::takes_robot(method) && !Method::OF_DERIVATIVES.contains(&method);
        self.trait_or_inherent("Dynamics", written, wanted, self.is_complete(written))
    }

    fn derivatives(&self, written: &[Written]) -> String {
        let wanted = |method: Method| Method::OF_DERIVATIVES.contains(&method);
        self.trait_or_inherent("DynamicsDerivatives", written, wanted, self.has_derivatives(written))
    }

    /// Whether `outputs(…)` left all that the trait `Dynamics` requires.
    fn is_complete(&self, written: &[Written]) -> bool {
        let has = |method: &Method| written.iter().any(|written| written.method == *method);
        let optional = |method: &Method| *method == Method::EquationsOfMotion;
        let required =
            Method::OF_ROBOT.iter().filter(|m| !Method::OF_DERIVATIVES.contains(m) && !optional(m));
        required.into_iter().all(has)
    }

    fn has_derivatives(&self, written: &[Written]) -> bool {
        let has = |method: &Method| written.iter().any(|written| written.method == *method);
        self.is_complete(written) && Method::OF_DERIVATIVES.iter().all(has)
    }

    /// An impl of the trait if all that it requires is there; otherwise the methods on their own.
    fn trait_or_inherent(
        &self,
        name: &str,
        written: &[Written],
        wanted: impl Fn(Method) -> bool,
        is_trait: bool,
    ) -> String {
        let chosen: Vec<&Written> = written.iter().filter(|w| wanted(w.method)).collect();
        if chosen.is_empty() {
            return String::new();
        }
        let trait_ = format!("{name}<{}, {1}, {1}>", self.scalar, self.dof);
        let open = |host: &Host| match is_trait {
            true => self.open(host, &trait_, &host.type_),
            false => self.open_without_scalar(host, ""),
        };
        let declared = |method: Method, text: &str| match is_trait {
            true => text.to_owned(),
            false => self.inherent(method, text),
        };
        let bodies: Vec<String> = chosen.iter().map(|w| indented(&declared(w.method, &w.text))).collect();
        let mut text = open(&self.prepared()) + &bodies.join("\n") + "    }\n\n";
        if self.is_prepared() {
            text.push_str(&open(&self.robot()));
            for Written { method, .. } in chosen {
                let forwarding = self.forwarding(*method, "&self", "self.prepare().");
                text.push_str(&declared(*method, &forwarding));
            }
            text.push_str("    }\n\n");
        }
        text
    }

    /// The text of a trait's method as that of an inherent one; on a unit struct the scalar is its parameter.
    fn inherent(&self, method: Method, text: &str) -> String {
        let generics =
            self.scalar_parameter.as_ref().map_or_else(String::new, |scalar| format!("<{scalar}>"));
        let name = method.name();
        text.replacen(&format!("fn {name}("), &format!("{}fn {name}{generics}(", self.item.visibility), 1)
    }

    /// A method of the robot that prepares and passes on.
    fn forwarding(&self, method: Method, receiver: &str, callee: &str) -> String {
        let (scalar, n) = (&self.scalar, self.dof);
        let mut arguments = receiver.to_owned();
        for argument in method.arguments() {
            let _ = write!(arguments, ", {}: &SVector<{scalar}, {n}>", argument.name());
        }
        let returned = methods::return_type(method, scalar, n);
        let passed = methods::pass_on(method);
        format!(
            "        #[inline]\n        fn {0}({arguments}) -> {returned} {{\n            {callee}{0}({passed})\n        }}\n",
            method.name()
        )
    }

    fn state_space(&self, written: &[Written]) -> String {
        let (scalar, n) = (&self.scalar, self.dof);
        let mut text = String::new();
        for host in self.types() {
            text.push_str(&self.open(&host, &format!("Configuration<{scalar}, {n}, {n}>"), &host.type_));
            let _ = write!(
                text,
                "        #[inline]\n        fn integrate(&self, q: &SVector<{scalar}, {n}>, delta: &SVector<{scalar}, {n}>) \
                 -> SVector<{scalar}, {n}> {{\n            q + delta\n        }}\n    }}\n\n"
            );
            if !self.has_derivatives(written) {
                continue;
            }
            let trait_ = format!("StateSpaceModel<{scalar}, {n}, {n}, {}, {n}>", 2 * n);
            text.push_str(&self.open(&host, &trait_, &host.type_));
            let _ = write!(
                text,
                "        #[inline]\n        fn input_map(&self) -> SMatrix<{scalar}, {n}, {n}> {{\n            \
                 SMatrix::identity()\n        }}\n    }}\n\n"
            );
        }
        text
    }

    /// The zero-sized types of the frames, in a module of their own and re-exported by a glob, so that two
    /// robots may have bodies of one name.
    fn frame_types(&self) -> String {
        let Item { name, visibility, .. } = self.item;
        let module = frames_module(name);
        // The module's own visibility bounds that of its types; `pub(super)` would mean another module in it.
        let mut text = format!(
            "/// The frames of [`{name}`], for `pose` and `jacobian`.\n#[allow({}, reason = \"generated code\")]\n\
             {visibility}mod {module} {{\n",
            allowed("dead_code, unreachable_pub")
        );
        for (type_, frame) in self.frame_types.iter().zip(&self.input.model.tree.frames) {
            let _ = writeln!(text, "    /// The frame `{}`.", frame.name);
            text.push_str("    #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]\n");
            let _ = writeln!(text, "    pub struct {type_};");
        }
        let _ = writeln!(
            text,
            "}}\n#[allow({}, reason = \"two robots may share a name\")]",
            allowed("unused_imports, unreachable_pub, ambiguous_glob_reexports")
        );
        let _ = writeln!(text, "{visibility}use {module}::*;\n");
        text
    }

    fn frames(&self, written: &[Written]) -> String {
        let mut text = String::new();
        let module = frames_module(&self.item.name);
        for (k, (type_, frame)) in self.frame_types.iter().zip(&self.input.model.tree.frames).enumerate() {
            let (scalar, n) = (&self.scalar, self.dof);
            let of_frame = [Method::Pose(k), Method::Jacobian(k), Method::WorldJacobian(k)];
            let chosen: Vec<&Written> = written.iter().filter(|w| of_frame.contains(&w.method)).collect();
            if chosen.is_empty() {
                continue;
            }
            let type_ = format!("{module}::{type_}");
            let (robot, prepared) = (self.robot(), self.prepared());
            let trait_ = |host: &Host| format!("Frame<{}, {scalar}, {n}, {n}>", host.type_);
            text.push_str(&self.open(&prepared, &trait_(&prepared), &type_));
            let _ = writeln!(text, "        const NAME: &'static str = {:?};", frame.name);
            text.push_str("        const COST: FrameCosts = FrameCosts {\n");
            for part in &chosen {
                let _ = writeln!(text, "            {}: {},", part.method.name(), cost(part.cost));
            }
            text.push_str("        };\n\n");
            let bodies: Vec<String> = chosen.iter().map(|w| indented(&w.text)).collect();
            text.push_str(&bodies.join("\n"));
            text.push_str("    }\n\n");
            if self.is_prepared() {
                text.push_str(&self.open(&robot, &trait_(&robot), &type_));
                let _ = writeln!(text, "        const NAME: &'static str = {:?};", frame.name);
                let of_prepared = format!("<Self as {}>::COST", trait_(&prepared));
                let _ = writeln!(text, "        const COST: FrameCosts = {of_prepared};\n");
                for method in &chosen {
                    let receiver = format!("robot: &{}", robot.type_);
                    let callee = format!("<Self as {}>::", trait_(&prepared));
                    let call = self.forwarding(method.method, &receiver, &callee);
                    text.push_str(&call.replace("(q)\n", "(&robot.prepare(), q)\n"));
                }
                text.push_str("    }\n\n");
            }
        }
        text
    }
}

/// The module that holds a robot's frames.
pub(super) fn frames_module(robot: &str) -> String {
    crate::model::names::snake_case(robot) + "_frames"
}

/// The constants of the trait `Mechanism`.
const CONSTANTS: [(&str, &str); 8] = [
    ("NQ", "usize"),
    ("NV", "usize"),
    ("NU", "usize"),
    ("NAME", "&'static str"),
    ("JOINT_NAMES", "&'static [&'static str]"),
    ("BODY_NAMES", "&'static [&'static str]"),
    ("LIMITS", "&'static [JointLimits]"),
    ("COST", "Costs"),
];

/// The names of the parameters in code: those of the fields, where these are names of variables and no others.
fn parameter_names(input: &Input<'_, '_>) -> Vec<String> {
    let fields = input.model.parameters.iter().map(|parameter| parameter.name.as_str());
    let mut taken = Names::default();
    let mut chosen: Vec<Option<String>> =
        fields.clone().map(|field| names::is_plain(field).then(|| taken.fresh(field))).collect();
    for (name, field) in chosen.iter_mut().zip(fields) {
        name.get_or_insert_with(|| taken.fresh(&(field.to_lowercase() + "_")));
    }
    chosen.into_iter().flatten().collect()
}

fn field_names(input: &Input<'_, '_>, parameters: &[String]) -> Vec<String> {
    let mut names = Names::with_taken(parameters.iter().map(String::as_str));
    let mut computed = 0;
    let name = |field: &Expr<'_>| {
        if let Expr::Node { id, .. } = *field
            && let Op::Symbol(symbol) = input.compiled.graph.op(id)
            && let Symbol::Parameter(k) = input.compiled.inputs.meaning(symbol)
        {
            return parameters[k].clone();
        }
        computed += 1;
        names.fresh(&format!("k{}", computed - 1))
    };
    input.compiled.companion.fields.iter().map(name).collect()
}

fn limits(limits: Limits) -> String {
    let Limits { lower, upper, velocity, effort } = limits;
    let number = |x: f64| match x {
        f64::INFINITY => "f64::INFINITY".to_owned(),
        f64::NEG_INFINITY => "f64::NEG_INFINITY".to_owned(),
        x => format!("{x:?}"),
    };
    format!(
        "JointLimits {{ lower: {}, upper: {}, velocity: {}, effort: {} }}",
        number(lower),
        number(upper),
        number(velocity),
        number(effort)
    )
}

fn cost(cost: Cost) -> String {
    let entries = [
        ("multiplications", cost.multiplications),
        ("additions", cost.additions),
        ("divisions", cost.divisions),
        ("square_roots", cost.square_roots),
        ("sines_and_cosines", cost.sines_and_cosines),
    ];
    let mut text = "Cost { ".to_owned();
    for (name, count) in entries.iter().filter(|(_, count)| *count > 0) {
        let _ = write!(text, "{name}: {count}, ");
    }
    text + "..Cost::ZERO }"
}

/// The lines, one level further in.
fn indented(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("    {line}\n") }).collect()
}
