//! How names of joints and bodies become Rust identifiers.

use rustc_hash::FxHashMap;

use super::topology::WORLD;
use crate::diagnostics::{Code, Diagnostics};
use crate::spec::{Name, RobotSpec};

/// `left_arm2`, `LeftArm2`, `leftArm2` → `LeftArm2`
pub fn upper_camel_case(name: &str) -> String {
    let capitalised = |word: String| {
        let mut letters = word.chars();
        letters
            .next()
            .map(|first| first.to_uppercase().chain(letters).collect::<String>())
            .unwrap_or_default()
    };
    words(name).into_iter().map(capitalised).collect()
}

/// `LeftArm2`, `leftArm2`, `left_arm2` → `left_arm2`
pub fn snake_case(name: &str) -> String {
    words(name).join("_")
}

/// The words of a name, in lower case: a new one begins after an underscore or any other sign, at a capital
/// after a small letter or a digit, and at the last of several capitals before a small letter.
fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words = vec![];
    let mut word = String::new();
    for (i, &letter) in letters.iter().enumerate() {
        let before = i.checked_sub(1).map(|before| letters[before]);
        let after_small = before.is_some_and(|c| c.is_alphanumeric() && !c.is_uppercase());
        let before_small = letters.get(i + 1).is_some_and(|c| c.is_lowercase());
        if !letter.is_alphanumeric() || (letter.is_uppercase() && (after_small || before_small)) {
            words.push(std::mem::take(&mut word));
        }
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        }
    }
    words.push(word);
    words.retain(|word| !word.is_empty());
    words
}

/// The type of a frame: `tool0` is `Tool0`, and `1st-link` is `Frame1stLink`. What would hide a common name, or the
/// robot's own, is `BoxFrame`.
pub fn frame_type(frame: &str, robot: &str) -> String {
    let name = upper_camel_case(frame);
    if name.starts_with(|first: char| first.is_ascii_digit()) {
        return format!("Frame{name}");
    }
    let is_robots = name == robot || name.strip_suffix("Prepared") == Some(robot);
    if is_robots || hides_a_common_name(&name) { name + "Frame" } else { name }
}

/// Bodies become types of Rust: those whose names cannot, and those that would be the same one. Joints keep their names:
/// nothing in Rust is called after them.
pub fn check_types(spec: &RobotSpec, diags: &mut Diagnostics) {
    let robot = spec.ident.to_string();
    let mut seen: FxHashMap<String, &str> = FxHashMap::default();
    for name in framed(spec) {
        let type_ = frame_type(&name.text, &robot);
        if syn::parse_str::<syn::Ident>(&type_).is_err() {
            let message = format!("the body `{name}` would be the type `{type_}`, which is no name of Rust");
            diags.error(Code::NameReserved, &name.place, message);
            continue;
        }
        let first = *seen.entry(type_.clone()).or_insert(&name.text);
        if first != name.text {
            let message = format!("the bodies `{first}` and `{name}` would both be the type `{type_}`");
            diags.error(Code::NamesCollide, &name.place, message);
        }
    }
}

/// The names of bodies, described or carried, as they were written one after the other.
fn framed(spec: &RobotSpec) -> impl Iterator<Item = &Name> {
    let described: FxHashMap<_, _> = spec.bodies.iter().map(|body| (body.name.text.as_str(), ())).collect();
    let carried = spec.joints.iter().filter(|joint| !joint.is_bare).map(|joint| (joint.line, &joint.child));
    let carried = carried.filter(|(_, name)| !described.contains_key(name.text.as_str()));
    let mut names: Vec<_> = spec.bodies.iter().map(|body| (body.line, &body.name)).chain(carried).collect();
    names.sort_by_key(|(line, _)| *line);
    names.into_iter().map(|(_, name)| name).filter(|name| name.text != WORLD)
}

/// Whether a type of this name hides one of the standard prelude's or of the run time's.
pub fn hides_a_common_name(name: &str) -> bool {
    COMMON.contains(&name)
}

const COMMON: &[&str] = &[
    // Rust
    "Self",
    "Box",
    "Option",
    "Some",
    "None",
    "Result",
    "Ok",
    "Err",
    "String",
    "ToString",
    "ToOwned",
    "Vec",
    "Copy",
    "Clone",
    "Drop",
    "Send",
    "Sync",
    "Sized",
    "Unpin",
    "Fn",
    "FnMut",
    "FnOnce",
    "AsyncFn",
    "AsyncFnMut",
    "AsyncFnOnce",
    "Iterator",
    "IntoIterator",
    "FromIterator",
    "DoubleEndedIterator",
    "ExactSizeIterator",
    "Extend",
    "Into",
    "From",
    "TryInto",
    "TryFrom",
    "AsRef",
    "AsMut",
    "Default",
    "Eq",
    "Ord",
    "PartialEq",
    "PartialOrd",
    "Future",
    "IntoFuture",
    // The run time
    "ArrayStorage",
    "BaseRegressor",
    "Branches",
    "CentroidalDynamics",
    "Configuration",
    "Cost",
    "Costs",
    "Definition",
    "Dynamics",
    "DynamicsDerivatives",
    "EachFrame",
    "Elementwise",
    "EliminationTree",
    "Energy",
    "Equation",
    "Equations",
    "EquationsOfMotion",
    "Error",
    "Factors",
    "ForwardDynamicsDerivatives",
    "Frame",
    "FrameCosts",
    "FrameVisitor",
    "Integrator",
    "InverseDynamicsDerivatives",
    "JointLimits",
    "Kinematics",
    "Linearization",
    "Mechanism",
    "Motion",
    "One",
    "Output",
    "Pose",
    "Reference",
    "Regressor",
    "Rk4",
    "SMatrix",
    "SVector",
    "Sample",
    "Scalar",
    "SemiImplicitEuler",
    "Signal",
    "Simulation",
    "State",
    "StateSpace",
    "StateSpaceModel",
    "Trim",
    "Zero",
];

#[cfg(test)]
mod tests {
    use super::{snake_case, upper_camel_case};

    #[test]
    fn words_are_found_in_every_case() {
        for (name, camel, snake) in [
            ("left_arm2", "LeftArm2", "left_arm2"),
            ("leftArm2", "LeftArm2", "left_arm2"),
            ("IMULink", "ImuLink", "imu_link"),
            ("link_a/b", "LinkAB", "link_a_b"),
            ("__", "", ""),
            ("A", "A", "a"),
        ] {
            assert_eq!(
                (upper_camel_case(name).as_str(), snake_case(name).as_str()),
                (camel, snake),
                "{name}"
            );
        }
    }
}
