//! The items that stand around the methods: impls, the prepared companion, the frames.

use std::fmt::Write as _;

use super::body::{self, Context, Literals};
use super::methods::{self, Written};
use super::names::Names;
use super::{Form, Input, Item};
use crate::mechanics::equations::{Input as Symbol, Method};
use crate::model::Limits;
use crate::passes::Cost;
use crate::symbolic::{Expr, Op};

/// Writes everything that is generated for a robot.
pub fn implementation(input: &Input<'_, '_>) -> String {
    let emitter = Emitter::new(input);
    let written = emitter.methods();
    let mut text = emitter.companion_struct();
    text.push_str(&emitter.frame_types());
    let _ = writeln!(
        text,
        "#[allow(unused_variables, non_snake_case, clippy::all, clippy::pedantic, reason = \"generated arithmetic\")]"
    );
    text.push_str("#[rustfmt::skip]\nconst _: () = {\n");
    let _ = writeln!(text, "    use {}::__private::*;\n", emitter.item.core);
    for part in [
        emitter.prepare(),
        emitter.mechanism(&written),
        emitter.dynamics(&written),
        emitter.derivatives(&written),
        emitter.state_space(&written),
        emitter.frames(&written),
    ] {
        text.push_str(&part);
    }
    text.push_str("};\n");
    text
}

struct Emitter<'m, 'g> {
    input: &'m Input<'m, 'g>,
    item: &'m Item,
    dof: usize,
    /// The scalar's name in the impls.
    scalar: String,
    parameters: Vec<String>,
    fields: Vec<String>,
    frame_types: Vec<String>,
}

impl<'m, 'g> Emitter<'m, 'g> {
    fn new(input: &'m Input<'m, 'g>) -> Self {
        let parameters: Vec<String> = input.model.parameters.iter().map(|p| p.name.clone()).collect();
        let fields = field_names(input, &parameters);
        let scalar = match &input.item.form {
            Form::Generic { parameter, .. } => parameter.clone(),
            Form::Concrete(name) => (*name).to_owned(),
            Form::Unit => "T".to_owned(),
        };
        Self {
            input,
            item: input.item,
            dof: input.compiled.inputs.dof,
            scalar,
            parameters,
            fields,
            frame_types: frame_type_names(input),
        }
    }

    /// Whether there is a companion apart from the robot itself.
    fn is_prepared(&self) -> bool {
        !self.fields.is_empty()
    }

    fn companion_name(&self) -> String {
        if self.is_prepared() { format!("{}Prepared", self.item.name) } else { self.item.name.clone() }
    }

    /// `<T: Scalar>` of an impl.
    fn impl_generics(&self) -> String {
        match &self.item.form {
            Form::Generic { parameter, bounds } if bounds.is_empty() => format!("<{parameter}: Scalar>"),
            Form::Generic { parameter, bounds } => format!("<{parameter}: Scalar + {bounds}>"),
            Form::Concrete(_) => String::new(),
            Form::Unit => "<T: Scalar>".to_owned(),
        }
    }

    /// The robot's type.
    fn robot(&self) -> String {
        match &self.item.form {
            Form::Generic { parameter, .. } => format!("{}<{parameter}>", self.item.name),
            Form::Concrete(_) | Form::Unit => self.item.name.clone(),
        }
    }

    /// The type that carries the arithmetic.
    fn prepared(&self) -> String {
        match (&self.item.form, self.is_prepared()) {
            (_, false) => self.robot(),
            (Form::Generic { parameter, .. }, true) => format!("{}<{parameter}>", self.companion_name()),
            (_, true) => self.companion_name(),
        }
    }

    fn literals(&self) -> Literals {
        match self.item.form {
            Form::Concrete(_) => Literals::Plain,
            _ => Literals::Of(self.scalar.clone()),
        }
    }

    fn methods(&self) -> Vec<Written> {
        let companion_name = self.companion_name();
        let context = Context {
            companion: &companion_name,
            fields: &self.fields,
            parameters: &self.parameters,
            literals: self.literals(),
            dof: self.dof,
        };
        let write = |method| methods::write(method, &context, &self.scalar, &self.prepared());
        self.input.compiled.methods.iter().map(write).collect()
    }

    fn companion_struct(&self) -> String {
        if !self.is_prepared() {
            return String::new();
        }
        let Item { name, visibility, .. } = self.item;
        let (generics, scalar) = match &self.item.form {
            Form::Generic { parameter, .. } => (format!("<{parameter}>"), parameter.as_str()),
            _ => (String::new(), self.scalar.as_str()),
        };
        let mut text = format!("/// [`{name}`] after all work that depends on its parameters alone.\n");
        let _ = writeln!(text, "#[derive(Clone, Copy, Debug, PartialEq)]");
        let _ = writeln!(text, "{visibility}struct {name}Prepared{generics} {{");
        for field in &self.fields {
            let _ = writeln!(text, "    {field}: {scalar},");
        }
        text.push_str("}\n\n");
        text
    }

    /// `prepare()`: on a robot without parameters, the robot itself.
    fn prepare(&self) -> String {
        let (generics, robot) = (self.impl_generics(), self.robot());
        let generics = if self.item.form == Form::Unit { String::new() } else { generics };
        let mut text = format!("    impl{generics} {robot} {{\n");
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
            self.prepared()
        );
        let mut read: Vec<&str> = body
            .inputs
            .iter()
            .filter(|(input, _)| matches!(input, Symbol::Parameter(_)))
            .map(|(_, name)| name.as_str())
            .collect();
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

    /// The impl header `impl<T: Scalar> Trait for Type {`, inside the block.
    fn open(&self, trait_: &str, type_: &str) -> String {
        format!("    impl{} {trait_} for {type_} {{\n", self.impl_generics())
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
        let generics = if self.item.form == Form::Unit { String::new() } else { self.impl_generics() };
        let mut text = format!("    impl{generics} Mechanism for {} {{\n{constants}", self.prepared());
        if self.is_prepared() {
            let _ = writeln!(text, "    impl{generics} Mechanism for {} {{", self.robot());
            for (name, type_) in CONSTANTS {
                let _ = writeln!(text, "        const {name}: {type_} = <{}>::{name};", self.prepared());
            }
            text.push_str("    }\n\n");
        }
        text
    }

    /// The companion, and the robot where it is another type.
    fn types(&self) -> Vec<String> {
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
        let open = |type_: &str| match is_trait {
            true => self.open(&trait_, type_),
            false => self.open_inherent(type_),
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

    /// The header of an inherent impl: on a unit struct each method has the scalar as its own parameter.
    fn open_inherent(&self, type_: &str) -> String {
        let generics = if self.item.form == Form::Unit { String::new() } else { self.impl_generics() };
        format!("    impl{generics} {type_} {{\n")
    }

    /// The text of a trait's method as that of an inherent one.
    fn inherent(&self, method: Method, text: &str) -> String {
        let generics = if self.item.form == Form::Unit { self.impl_generics() } else { String::new() };
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
        for type_ in self.types() {
            text.push_str(&self.open(&format!("Configuration<{scalar}, {n}, {n}>"), &type_));
            let _ = write!(
                text,
                "        #[inline]\n        fn integrate(&self, q: &SVector<{scalar}, {n}>, delta: &SVector<{scalar}, {n}>) \
                 -> SVector<{scalar}, {n}> {{\n            q + delta\n        }}\n    }}\n\n"
            );
            if !self.has_derivatives(written) {
                continue;
            }
            text.push_str(
                &self.open(&format!("StateSpaceModel<{scalar}, {n}, {n}, {}, {n}>", 2 * n), &type_),
            );
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
        let inner = if visibility.is_empty() { "pub(super) " } else { visibility.as_str() };
        let mut text = format!(
            "/// The frames of [`{name}`], for `pose` and `jacobian`.\n{visibility}mod {module} {{\n"
        );
        for (type_, frame) in self.frame_types.iter().zip(&self.input.model.tree.frames) {
            let _ = writeln!(text, "    /// The frame `{}`.\n    #[derive(Clone, Copy, Debug)]", frame.name);
            let _ = writeln!(text, "    {inner}struct {type_};");
        }
        let _ = writeln!(
            text,
            "}}\n#[allow(unused_imports, ambiguous_glob_reexports, reason = \"two robots may share a name\")]"
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
            let trait_ = format!("Frame<{}, {scalar}, {n}, {n}>", self.prepared());
            text.push_str(&self.open(&trait_, &type_));
            let _ = writeln!(text, "        const NAME: &'static str = {:?};\n", frame.name);
            let bodies: Vec<String> = chosen.iter().map(|w| indented(&w.text)).collect();
            text.push_str(&bodies.join("\n"));
            text.push_str("    }\n\n");
            if self.is_prepared() {
                text.push_str(&self.open(&format!("Frame<{}, {scalar}, {n}, {n}>", self.robot()), &type_));
                let _ = writeln!(text, "        const NAME: &'static str = {:?};\n", frame.name);
                for method in &chosen {
                    let receiver = format!("robot: &{}", self.robot());
                    let callee = format!("<Self as Frame<{}, {scalar}, {n}, {n}>>::", self.prepared());
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

/// Type names that a glob import must not bring in: they would hide the standard ones.
const HIDDEN_BY_A_GLOB: &[&str] = &[
    "Box",
    "Option",
    "Some",
    "None",
    "Result",
    "Ok",
    "Err",
    "String",
    "Vec",
    "Copy",
    "Clone",
    "Drop",
    "Send",
    "Sync",
    "Sized",
    "Fn",
    "FnMut",
    "FnOnce",
    "Iterator",
    "Into",
    "From",
    "Default",
    "Eq",
    "Ord",
    "PartialEq",
    "PartialOrd",
    "Pose",
    "State",
    "Frame",
    "Energy",
    "Sample",
    "Error",
    "Cost",
    "Costs",
    "Scalar",
    "Dynamics",
    "Mechanism",
    "Simulation",
    "Kinematics",
    "Configuration",
    "Linearization",
    "Integrator",
    "Self",
];

fn frame_type_names(input: &Input<'_, '_>) -> Vec<String> {
    let mut names = Names::default();
    input.model.tree.frames.iter().map(|frame| names.fresh(&frame_type(&frame.name))).collect()
}

/// The type of a frame: `tool0` is `Tool0`.
pub(super) fn frame_type(frame: &str) -> String {
    let name = crate::model::names::upper_camel_case(frame);
    if HIDDEN_BY_A_GLOB.contains(&name.as_str()) { name + "Frame" } else { name }
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
