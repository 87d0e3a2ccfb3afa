//! The items that stand around the methods: impls, the prepared companion, the frames.

use std::fmt::Write as _;

use super::context::{Context, Literals};
use super::methods::{self, Written};
use super::names;
use super::{Form, Input, Item};
use crate::emit::names::Names;
use crate::mechanics::equations::{Input as Symbol, Inputs, Method, Trait};
use crate::model::names::{frame_type, hides_a_common_name};
use crate::passes::Sizes;
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
    let shared = emitter.shared(&written);
    for part in [
        emitter.prepare(),
        emitter.check(),
        emitter.equations(),
        emitter.table(),
        emitter.mechanism(&written),
        shared,
    ] {
        text.push_str(&part);
    }
    for trait_ in Trait::OF_ROBOT {
        text.push_str(&emitter.trait_or_inherent(trait_, &written));
    }
    text.push_str(&emitter.configuration(&written));
    text.push_str(&emitter.frames(&written));
    text.push_str(if emitter.alias().is_empty() { "};\n" } else { "};\n};\n" });
    text
}

/// The lints that generated code is free of, whatever else it does.
pub(super) fn allowed(lints: &str) -> String {
    format!("{lints}, clippy::all, clippy::pedantic, clippy::nursery")
}

/// A type that impls are for.
pub(super) struct Host {
    /// The type, with its arguments.
    pub(super) type_: String,
    /// Its parameters with their bounds, without the scalar of a unit struct.
    pub(super) parameters: Vec<String>,
    /// Its where-clause.
    pub(super) clause: String,
}

impl Host {
    /// `<T: Scalar>`; nothing without parameters.
    pub(super) fn generics<'a>(&'a self, scalar: impl IntoIterator<Item = &'a String>) -> String {
        let all: Vec<&str> = self.parameters.iter().chain(scalar).map(String::as_str).collect();
        if all.is_empty() { String::new() } else { format!("<{}>", all.join(", ")) }
    }
}

pub(super) struct Emitter<'m, 'g> {
    pub(super) input: &'m Input<'m, 'g>,
    pub(super) item: &'m Item,
    pub(super) sizes: Sizes,
    /// The scalar's name in the impls.
    pub(super) scalar: String,
    /// The bound of the scalar where it is no parameter of the robot.
    pub(super) scalar_parameter: Option<String>,
    /// The parameters' names in code.
    pub(super) parameters: Vec<String>,
    pub(super) fields: Vec<String>,
    pub(super) frame_types: Vec<String>,
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
            sizes: input.compiled.sizes(),
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
    pub(super) fn is_prepared(&self) -> bool {
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
    pub(super) fn robot(&self) -> Host {
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

    pub(super) fn literals(&self) -> Literals {
        match self.item.form {
            Form::Concrete(_) => Literals::Plain,
            _ => Literals::Of(format!("{}::of", self.scalar)),
        }
    }

    /// What a body of the companion's impls is written with.
    pub(super) fn context<'a>(&'a self, companion: &'a str) -> Context<'a> {
        let (fields, parameters) = (&self.fields, &self.parameters);
        Context {
            companion,
            fields,
            parameters,
            literals: self.literals(),
            sizes: self.sizes,
            is_passive: self.is_passive(),
            closed: self.input.closed,
        }
    }

    /// Whether something acts by itself, as springs and dampers do.
    pub(super) fn is_passive(&self) -> bool {
        self.input.compiled.methods.iter().any(|compiled| compiled.method == Method::PassiveForces)
    }

    fn methods(&self) -> Vec<Written> {
        let companion_name = self.companion_name();
        let context = self.context(&companion_name);
        let write = |method| methods::write(method, &context, &self.scalar, &self.prepared().type_);
        self.input.compiled.methods.iter().map(write).collect()
    }

    /// The header `impl<T: Scalar> Trait for Type {`; `type_` is the host's or that of one of its frames.
    pub(super) fn open(&self, host: &Host, trait_: &str, type_: &str) -> String {
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

    /// The companion, and the robot where it is another type.
    pub(super) fn types(&self) -> Vec<Host> {
        if self.is_prepared() { vec![self.prepared(), self.robot()] } else { vec![self.robot()] }
    }

    /// Whether `outputs(…)` left all that the trait requires.
    pub(super) fn is_complete(&self, trait_: Trait, written: &[Written]) -> bool {
        let has = |method: &Method| written.iter().any(|written| written.method == *method);
        let of_trait =
            |all: Trait| Method::OF_ROBOT.into_iter().filter(move |m| m.trait_() == all && !m.is_provided());
        // The derivatives build on the dynamics.
        let builds_on = if trait_ == Trait::DynamicsDerivatives { Trait::Dynamics } else { trait_ };
        of_trait(trait_).chain(of_trait(builds_on)).all(|method| has(&method))
    }

    /// The trait with its arguments: `Dynamics<T, 7, 6>`.
    fn with_arguments(&self, trait_: Trait) -> String {
        let more = match trait_ {
            Trait::Regressor => format!(", {}>", self.sizes.parameters),
            Trait::BaseRegressor => format!(", {}>", self.sizes.base_parameters),
            _ => return self.of_sizes(trait_.name()),
        };
        self.of_sizes(trait_.name()).replace('>', &more)
    }

    /// An impl of the trait if all that it requires is there; otherwise the methods on their own.
    fn trait_or_inherent(&self, trait_: Trait, written: &[Written]) -> String {
        let chosen: Vec<&Written> = written.iter().filter(|w| w.method.trait_() == trait_).collect();
        if chosen.is_empty() {
            return String::new();
        }
        let is_trait = self.is_complete(trait_, written);
        let open = |host: &Host| match is_trait {
            true => self.open(host, &self.with_arguments(trait_), &host.type_),
            false => self.open_without_scalar(host, ""),
        };
        let declared = |method: Method, text: &str| match is_trait {
            true => text.to_owned(),
            false => self.inherent(method, text),
        };
        let check = match trait_ {
            Trait::Dynamics if is_trait => self.check_configuration(),
            _ => String::new(),
        };
        let bodies: Vec<String> = chosen.iter().map(|w| indented(&declared(w.method, &w.text))).collect();
        let mut text = open(&self.prepared()) + &bodies.join("\n") + &check + "    }\n\n";
        if self.is_prepared() {
            text.push_str(&open(&self.robot()));
            for Written { method, .. } in chosen {
                let documentation = match self.input.closed {
                    Some(_) => indented(&methods::documentation(*method, &self.context(""))),
                    None => String::new(),
                };
                let forwarding = self.forwarding(*method, "&self", "self.prepare().");
                text.push_str(&declared(*method, &(documentation + &forwarding)));
            }
            text.push_str(&check);
            text.push_str("    }\n\n");
        }
        text
    }

    /// The bodies that bundles and their parts share.
    fn shared(&self, written: &[Written]) -> String {
        let body = |written: &Written| {
            let (name, shared) = (written.method.name(), written.shared.as_ref()?);
            let parameters: Vec<&str> =
                self.scalar_parameter.as_deref().into_iter().chain(shared.parameter).collect();
            let generics =
                if parameters.is_empty() { String::new() } else { format!("<{}>", parameters.join(", ")) };
            let header =
                format!("#[inline(always)]\n    fn {}{generics}(", methods::shared_name(written.method));
            Some(indented(&shared.text.replacen(&format!("fn {name}("), &header, 1)))
        };
        let bodies: Vec<String> = written.iter().filter_map(body).collect();
        if bodies.is_empty() {
            return String::new();
        }
        self.open_without_scalar(&self.prepared(), "") + &bodies.join("\n") + "    }\n\n"
    }

    /// The text of a trait's method as that of an inherent one; on a unit struct the scalar is its parameter.
    fn inherent(&self, method: Method, text: &str) -> String {
        let generics =
            self.scalar_parameter.as_ref().map_or_else(String::new, |scalar| format!("<{scalar}>"));
        let name = method.name();
        text.replacen(&format!("fn {name}("), &format!("{}fn {name}{generics}(", self.item.visibility), 1)
    }

    /// A method of the robot that prepares and passes on.
    pub(super) fn forwarding(&self, method: Method, receiver: &str, callee: &str) -> String {
        let arguments = receiver.to_owned() + &methods::typed_arguments(method, &self.scalar, self.sizes);
        let returned = methods::return_type(method, &self.scalar, self.sizes);
        let passed = methods::pass_on(method);
        format!(
            "        #[inline]\n        fn {0}({arguments}) -> {returned} {{\n            {callee}{0}({passed})\n        }}\n",
            method.name()
        )
    }

    /// A trait of the robot's scalar and sizes: `Dynamics<T, 7, 6>`.
    pub(super) fn of_sizes(&self, trait_: &str) -> String {
        let Inputs { coordinates, dof, .. } = self.sizes.inputs;
        format!("{trait_}<{}, {coordinates}, {dof}>", self.scalar)
    }
}

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

/// The lines, one level further in.
pub(super) fn indented(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("    {line}\n") }).collect()
}
