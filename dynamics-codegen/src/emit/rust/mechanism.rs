//! The trait `Mechanism`: what is constant about a robot.

use std::fmt::Write as _;

use super::items::Emitter;
use super::methods::{self, Written};
use crate::mechanics::equations::Inputs;
use crate::model::{JointInfo, Limits};
use crate::passes::Cost;

impl Emitter<'_, '_> {
    /// The types that the constants are implemented for: no scalar needed on a unit struct.
    pub(super) fn mechanism(&self, written: &[Written]) -> String {
        let Inputs { coordinates, dof: n, .. } = self.sizes.inputs;
        let quoted =
            |names: Vec<&str>| names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
        let model = self.input.model;
        let joints = quoted(model.joints.iter().map(|joint| joint.name.as_str()).collect());
        let bodies = quoted(model.tree.frames.iter().map(|frame| frame.name.as_str()).collect());
        let mut constants = format!(
            "        const NQ: usize = {coordinates};\n        const NV: usize = {n};\n        const NU: usize = {};\n        \
             const NAME: &'static str = {:?};\n        const JOINT_NAMES: &'static [&'static str] = &[{joints}];\n        \
             const BODY_NAMES: &'static [&'static str] = &[{bodies}];\n",
            model.actuated.len(),
            model.name
        );
        let parent = |parent: &Option<usize>| match parent {
            Some(parent) => format!("::core::option::Option::Some({parent})"),
            None => "::core::option::Option::None".to_owned(),
        };
        let parents = model.parents.iter().map(parent).collect::<Vec<_>>().join(", ");
        let type_ = "&'static [::core::option::Option<usize>]";
        let _ = writeln!(constants, "        const BODY_PARENTS: {type_} = &[{parents}];");
        for (name, list) in [
            ("PARAMETER_NAMES", &self.input.compiled.parameter_names),
            ("BASE_PARAMETER_NAMES", &self.input.compiled.base_parameter_names),
        ] {
            if !list.is_empty() {
                let list = quoted(list.iter().map(String::as_str).collect());
                let _ = writeln!(constants, "        const {name}: &'static [&'static str] = &[{list}];");
            }
        }
        let of_joints = |names: fn(&JointInfo) -> Vec<String>| {
            let names: Vec<String> = model.joints.iter().flat_map(names).collect();
            quoted(names.iter().map(String::as_str).collect())
        };
        for (name, list) in [
            ("COORDINATE_NAMES", of_joints(JointInfo::coordinate_names)),
            ("DISPLACEMENT_NAMES", of_joints(JointInfo::displacement_names)),
            ("SPEED_NAMES", of_joints(JointInfo::speed_names)),
        ] {
            let _ = writeln!(constants, "        const {name}: &'static [&'static str] = &[{list}];");
        }
        let turns = model.joints.iter().flat_map(|joint| joint.kind.turns());
        let motions: Vec<_> =
            turns.map(|turns| if *turns { "Motion::Rotation" } else { "Motion::Translation" }).collect();
        let actuated: Vec<_> = model.actuated.iter().map(usize::to_string).collect();
        let _ = writeln!(
            constants,
            "        const MOTIONS: &'static [Motion] = &[{}];\n        const ACTUATED: &'static [usize] = &[{}];",
            motions.join(", "),
            actuated.join(", ")
        );
        constants.push_str("        const LIMITS: &'static [JointLimits] = &[\n");
        for each in model.joints.iter().flat_map(|joint| &joint.limits) {
            let _ = writeln!(constants, "            {},", limits(*each));
        }
        constants.push_str("        ];\n        const COST: Costs = Costs {\n");
        for method in written.iter().filter(|written| !methods::takes_robot(written.method)) {
            let _ = writeln!(constants, "            {}: {},", method.method.name(), cost(method.cost));
        }
        if self.is_prepared() {
            let _ = writeln!(
                constants,
                "            prepare: {},",
                cost(self.input.compiled.companion.preparation.cost())
            );
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
}

/// The constants of the trait `Mechanism`.
const CONSTANTS: [(&str, &str); 16] = [
    ("NQ", "usize"),
    ("NV", "usize"),
    ("NU", "usize"),
    ("NAME", "&'static str"),
    ("JOINT_NAMES", "&'static [&'static str]"),
    ("BODY_NAMES", "&'static [&'static str]"),
    ("COORDINATE_NAMES", "&'static [&'static str]"),
    ("DISPLACEMENT_NAMES", "&'static [&'static str]"),
    ("SPEED_NAMES", "&'static [&'static str]"),
    ("MOTIONS", "&'static [Motion]"),
    ("ACTUATED", "&'static [usize]"),
    ("BODY_PARENTS", "&'static [::core::option::Option<usize>]"),
    ("PARAMETER_NAMES", "&'static [&'static str]"),
    ("BASE_PARAMETER_NAMES", "&'static [&'static str]"),
    ("LIMITS", "&'static [JointLimits]"),
    ("COST", "Costs"),
];

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

pub(super) fn cost(cost: Cost) -> String {
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
