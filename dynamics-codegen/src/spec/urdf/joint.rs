//! `<joint name="…" type="…">` with all that is in it.

use super::elements::{Element, Text};
use super::numbers::value;
use super::reader::Reader;
use super::source::quoted;
use crate::diagnostics::{Code, Diagnostic};
use crate::spec::{Axis, AxisKind, Formula, FormulaKind, JointKind, JointSpec, Name, Unit};
use crate::symbolic::Number;

const PARTS: [&str; 7] = ["origin", "parent", "child", "axis", "limit", "dynamics", "mimic"];

/// The joint that an element is.
pub(super) fn read<'a>(reader: &mut Reader<'_>, element: Element<'a>, line: usize) -> Option<JointSpec> {
    let [name, kind] = reader.texts(element, ["name", "type"]);
    let name = reader.name(name, element)?;
    reader.enter("joint", &name);
    let kind_text = reader.needed(kind, "`type`", element);
    let [origin, parent, child, axis, limit, dynamics, mimic] = reader.elements(element, PARTS);
    let parent = link_of(reader, parent, "`<parent link=\"…\"/>`", element);
    let child = link_of(reader, child, "`<child link=\"…\"/>`", element);
    let [at, rpy] = reader.origin(origin);
    let kind = kind_text.and_then(|text| kind_of(reader, text));
    let moves = kind.is_some_and(|kind| kind != JointKind::Fixed);
    if let Some(mimic) = mimic.filter(|_| moves) {
        let message = format!("{} mimics another one", reader.owner());
        let unsupported = Diagnostic::new(Code::JointUnsupported, &mimic.place(), message);
        reader.diags.push(unsupported.help("take `<mimic>` out to make the joint free, or make it `fixed`"));
    }
    if let Some(dynamics) = dynamics.filter(|_| moves) {
        read_dynamics(reader, dynamics);
    }
    for unused in [mimic, dynamics].into_iter().flatten().filter(|_| kind == Some(JointKind::Fixed)) {
        reader.ignore(format!("`<{}>`", unused.tag()), unused.place());
    }
    let (kind, kind_text) = (kind?, kind_text?);
    let axis = axis_of(reader, axis, kind, element);
    let mut joint = JointSpec {
        name,
        kind,
        kind_place: kind_text.place(),
        axis,
        parent: parent?,
        child: child?,
        at,
        rpy,
        placement: None,
        limits: None,
        velocity: None,
        effort: None,
        line,
        place: element.place(),
    };
    read_limits(reader, limit, &mut joint, element);
    reader.report.joints += 1;
    Some(joint)
}

fn link_of<'a>(
    reader: &mut Reader<'_>,
    end: Option<Element<'a>>,
    what: &str,
    joint: Element<'a>,
) -> Option<Name> {
    let end = reader.needed(end, what, joint)?;
    let _: [_; 0] = reader.elements(end, []);
    let [link] = reader.texts(end, ["link"]);
    let link = reader.needed(link, "`link`", end)?;
    reader.reference(link)
}

fn kind_of<'a>(reader: &mut Reader<'_>, text: Text<'a>) -> Option<JointKind> {
    const KINDS: [&str; 6] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];
    let (owner, kind) = (reader.owner(), quoted(text.value));
    let wrong = match text.value {
        "revolute" => return Some(JointKind::Revolute),
        "continuous" => return Some(JointKind::Continuous),
        "prismatic" => return Some(JointKind::Prismatic),
        "fixed" => return Some(JointKind::Fixed),
        "floating" | "planar" => {
            let message = format!("{owner} is {kind}, which is not supported yet");
            let help = "use a chain of `prismatic` and `continuous` joints; links between two need no mass";
            Diagnostic::new(Code::JointUnsupported, &text.place(), message).help(help)
        }
        _ => {
            let message = format!("{owner} is {kind}, and there is no such kind of joint");
            Diagnostic::new(Code::JointKindUnknown, &text.place(), message).suggest(text.value, KINDS)
        }
    };
    reader.diags.push(wrong);
    None
}

/// The axis; x without `<axis>`, as the format has it.
fn axis_of<'a>(
    reader: &mut Reader<'_>,
    axis: Option<Element<'a>>,
    kind: JointKind,
    joint: Element<'a>,
) -> Option<Axis> {
    let Some(element) = axis else {
        if kind == JointKind::Fixed {
            return None;
        }
        let place = joint.place();
        let text = format!("{} has no `<axis>`: it is x, as the format has it", reader.owner());
        reader.remark(text, place.clone());
        return Some(Axis { kind: AxisKind::Named { index: 0, negative: false }, place });
    };
    if kind == JointKind::Fixed {
        reader.ignore("`<axis>`", element.place());
        return None;
    }
    let _: [_; 0] = reader.elements(element, []);
    let [xyz] = reader.texts(element, ["xyz"]);
    let text = reader.needed(xyz, "`xyz`", element)?;
    let direction = reader.vector(text, ["x", "y", "z"], None)?;
    let place = text.place();
    let parts = direction.each_ref().map(|part| value(part).map_or(0.0, Number::to_f64));
    let length = parts.iter().fold(0.0_f64, |length, part| length.hypot(*part));
    if length == 0.0 {
        let message =
            format!("{}: the axis is {}, which is no direction", reader.owner(), quoted(text.value));
        let help = "give a direction, as `<axis xyz=\"0 0 1\"/>`";
        reader.diags.push(Diagnostic::new(Code::AxisZero, &place, message).help(help));
        return None;
    }
    if (length - 1.0).abs() > 1e-9 {
        let text =
            format!("the axis of {} has the length {length}: it is taken as a direction", reader.owner());
        reader.remark(text, place.clone());
    }
    Some(Axis { kind: AxisKind::Vector(Box::new(direction)), place })
}

/// `<limit lower="…" upper="…" velocity="…" effort="…">`, as far as it means something for the kind of joint.
fn read_limits<'a>(
    reader: &mut Reader<'_>,
    limit: Option<Element<'a>>,
    joint: &mut JointSpec,
    element: Element<'a>,
) {
    let needs_limits = matches!(joint.kind, JointKind::Revolute | JointKind::Prismatic);
    let Some(limit) = limit else {
        if needs_limits {
            let message = format!("{} has no `<limit>`", reader.owner());
            let help = match joint.kind {
                JointKind::Revolute => {
                    "add `<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>`, or make the joint `continuous`"
                }
                _ => "add `<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>`",
            };
            reader.diags.push(Diagnostic::new(Code::LimitsMissing, &element.place(), message).help(help));
        }
        return;
    };
    if joint.kind == JointKind::Fixed {
        reader.ignore("`<limit>`", limit.place());
        return;
    }
    let _: [_; 0] = reader.elements(limit, []);
    let [lower, upper, velocity, effort] = reader.texts(limit, ["lower", "upper", "velocity", "effort"]);
    joint.velocity = velocity.and_then(|text| reader.scalar(text, None));
    joint.effort = effort.and_then(|text| reader.scalar(text, None));
    for (name, given) in [("velocity", velocity), ("effort", effort)] {
        if given.is_none() {
            let text = format!("`<limit>` of {} has no `{name}`: it is unlimited", reader.owner());
            reader.remark(text, limit.place());
        }
    }
    if !needs_limits {
        for text in [lower, upper].into_iter().flatten() {
            reader.ignore(text.what(), text.place());
        }
        return;
    }
    let unit = if joint.kind == JointKind::Revolute { Unit::named("rad") } else { None };
    let mut bound = |text: Option<Text<'a>>| match text {
        Some(text) => reader.scalar(text, unit),
        // The default of the format.
        None => Some(Formula { kind: FormulaKind::Number(Number::ZERO, unit), place: limit.place() }),
    };
    joint.limits = bound(lower).zip(bound(upper)).map(|(lower, upper)| [lower, upper]);
    look_at_limits(reader, joint, limit);
}

fn look_at_limits<'a>(reader: &mut Reader<'_>, joint: &JointSpec, limit: Element<'a>) {
    let Some([lower, upper]) = &joint.limits else { return };
    let (Some(low), Some(high)) = (value(lower), value(upper)) else { return };
    if joint.kind == JointKind::Revolute {
        reader.look_at_limit(lower);
        reader.look_at_limit(upper);
    }
    if low.cmp_value(high).is_gt() {
        let message = format!("{}: the limits are inverted, from {lower} to {upper}", reader.owner());
        let inverted = Diagnostic::new(Code::LimitsInverted, &lower.place, message);
        reader.diags.push(inverted.help("write the smaller one as `lower`"));
    } else if low == high {
        let text = format!("the limits of {} leave no room: both are {lower}", reader.owner());
        reader.remark(text, limit.place());
    }
}

/// `<dynamics damping="…" friction="…">`: what is not zero acts, unless it is not wanted.
fn read_dynamics<'a>(reader: &mut Reader<'_>, dynamics: Element<'a>) {
    let _: [_; 0] = reader.elements(dynamics, []);
    for text in dynamics.texts() {
        let Some(given) = reader.scalar(text, None) else { continue };
        let Some(number) = value(&given).filter(|number| !number.is_zero()) else { continue };
        let (owner, name) = (reader.owner(), quoted(text.name));
        if number.is_negative() {
            let message = format!("the {name} of {owner} is {given}: it would drive the joint");
            reader.diags.error(Code::PassiveNegative, &given.place, message);
        } else if reader.passive {
            let message =
                format!("the {name} of {owner} is {given}, and passive forces are not supported yet");
            reader.diags.error(Code::PassiveUnsupported, &given.place, message);
        } else {
            reader.ignore(format!("{} = {given}", text.what()), given.place);
        }
    }
}
