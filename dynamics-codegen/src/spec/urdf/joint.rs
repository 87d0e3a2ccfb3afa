//! `<joint name="…" type="…">` with all that is in it.

use super::elements::{Element, Text};
use super::numbers::value;
use super::reader::Reader;
use super::source::quoted;
use crate::diagnostics::{Code, Diagnostic};
use crate::spec::{Axis, AxisKind, Formula, FormulaKind, JointKeys, JointKind, JointSpec, Name, Unit};
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
    let axis = kind.and_then(|kind| axis_of(reader, axis, kind, element));
    let mut keys = Box::new(JointKeys { at, rpy, ..JointKeys::default() });
    match kind {
        Some(JointKind::Fixed) => {
            for unused in [mimic, dynamics, limit].into_iter().flatten() {
                reader.ignore(format!("`<{}>`", unused.tag()), unused.place());
            }
        }
        Some(kind) => {
            read_mimic(reader, mimic, kind, &mut keys);
            read_dynamics(reader, dynamics, &mut keys);
            read_limits(reader, limit, kind, &mut keys, element);
        }
        None => {}
    }
    let (kind, kind_text) = (kind?, kind_text?);
    reader.report.joints += 1;
    Some(JointSpec {
        name,
        kind,
        kind_place: kind_text.place(),
        axes: axis.into_iter().collect(),
        pitch: None,
        parent: parent?,
        child: child?,
        is_bare: false,
        keys,
        line,
        place: element.place(),
    })
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
    const KINDS: [(&str, JointKind); 6] = [
        ("revolute", JointKind::Revolute),
        ("continuous", JointKind::Continuous),
        ("prismatic", JointKind::Prismatic),
        ("fixed", JointKind::Fixed),
        ("floating", JointKind::Free),
        ("planar", JointKind::Planar),
    ];
    let found = KINDS.iter().find(|(known, _)| *known == text.value);
    if found.is_none() {
        let message =
            format!("{} is {}, and there is no such kind of joint", reader.owner(), quoted(text.value));
        let known = KINDS.map(|(known, _)| known);
        let unknown = Diagnostic::new(Code::JointKindUnknown, &text.place(), message);
        let unknown = unknown.help(format!("use one of {}", known.join(", ")));
        reader.diags.push(unknown.suggest(text.value, known));
    }
    found.map(|(_, kind)| *kind)
}

/// The axis; x without `<axis>`, as the format has it.
fn axis_of<'a>(
    reader: &mut Reader<'_>,
    axis: Option<Element<'a>>,
    kind: JointKind,
    joint: Element<'a>,
) -> Option<Axis> {
    let Some(element) = axis else {
        if kind.axes() == 0 {
            return None;
        }
        let place = joint.place();
        let text = format!("{} has no `<axis>`: it is x, as the format has it", reader.owner());
        reader.remark(text, place.clone());
        return Some(Axis { kind: AxisKind::Named { index: 0, negative: false }, place });
    };
    if kind.axes() == 0 {
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

/// `<limit lower="…" upper="…" velocity="…" effort="…">`, as far as it means something for the joint.
fn read_limits<'a>(
    reader: &mut Reader<'_>,
    limit: Option<Element<'a>>,
    kind: JointKind,
    keys: &mut JointKeys,
    element: Element<'a>,
) {
    let needs_limits = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
    let Some(limit) = limit else {
        if needs_limits && keys.mimic.is_none() {
            let message = format!("{} has no `<limit>`", reader.owner());
            let help = match kind {
                JointKind::Revolute => {
                    "add `<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>`, or make the joint `continuous`"
                }
                _ => "add `<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>`",
            };
            reader.diags.push(Diagnostic::new(Code::LimitsMissing, &element.place(), message).help(help));
        }
        return;
    };
    if kind.speeds() > 1 || keys.mimic.is_some() {
        reader.ignore("`<limit>`", limit.place());
        return;
    }
    let _: [_; 0] = reader.elements(limit, []);
    let [lower, upper, velocity, effort] = reader.texts(limit, ["lower", "upper", "velocity", "effort"]);
    keys.velocity = velocity.and_then(|text| reader.scalar(text, None));
    keys.effort = effort.and_then(|text| reader.scalar(text, None));
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
    let unit = unit_of(kind);
    let mut bound = |text: Option<Text<'a>>| match text {
        Some(text) => reader.scalar(text, unit),
        // The default of the format.
        None => Some(Formula { kind: FormulaKind::Number(Number::ZERO, unit), place: limit.place() }),
    };
    keys.limits = bound(lower).zip(bound(upper)).map(|(lower, upper)| [lower, upper]);
    look_at_limits(reader, kind, keys, limit);
}

/// The unit in which a file has the coordinate of a joint, where it has to be said.
fn unit_of(kind: JointKind) -> Option<Unit> {
    if kind == JointKind::Prismatic { None } else { Unit::named("rad") }
}

fn look_at_limits<'a>(reader: &mut Reader<'_>, kind: JointKind, keys: &JointKeys, limit: Element<'a>) {
    let Some([lower, upper]) = &keys.limits else { return };
    let (Some(low), Some(high)) = (value(lower), value(upper)) else { return };
    if kind == JointKind::Revolute {
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

/// `<mimic joint="…" multiplier="…" offset="…">`
fn read_mimic<'a>(
    reader: &mut Reader<'_>,
    mimic: Option<Element<'a>>,
    kind: JointKind,
    keys: &mut JointKeys,
) {
    let Some(mimic) = mimic else { return };
    let _: [_; 0] = reader.elements(mimic, []);
    let [leader, multiplier, offset] = reader.texts(mimic, ["joint", "multiplier", "offset"]);
    let leader = reader.needed(leader, "`joint`", mimic);
    keys.mimic = leader.and_then(|text| reader.named(text, "joint"));
    keys.ratio = multiplier.and_then(|text| reader.scalar(text, None));
    keys.offset = offset.and_then(|text| reader.scalar(text, unit_of(kind)));
    if let Some(offset) = keys.offset.as_ref().filter(|_| kind != JointKind::Prismatic) {
        reader.look_at_limit(offset);
    }
}

/// `<dynamics damping="…" friction="…">`, and `armature`, as some exporters write it: what is not zero acts, unless
/// it is not wanted.
fn read_dynamics<'a>(reader: &mut Reader<'_>, dynamics: Option<Element<'a>>, keys: &mut JointKeys) {
    let Some(dynamics) = dynamics else { return };
    let _: [_; 0] = reader.elements(dynamics, []);
    for text in dynamics.texts() {
        let Some(given) = reader.scalar(text, None) else { continue };
        if value(&given).is_some_and(Number::is_zero) {
            continue;
        }
        let slot = match text.name {
            "damping" => Some(&mut keys.damping),
            "friction" => Some(&mut keys.friction),
            "armature" => Some(&mut keys.armature),
            _ => None,
        };
        if !reader.passive {
            reader.ignore(format!("{} = {given}", text.what()), given.place);
        } else if let Some(slot) = slot {
            *slot = Some(given);
        } else {
            let (owner, name) = (reader.owner(), quoted(text.name));
            let message = format!("the {name} of {owner} is {given}, and no such force is known");
            let unknown = Diagnostic::new(Code::PassiveUnsupported, &given.place, message);
            reader.diags.push(unknown.suggest(text.name, ["damping", "friction", "armature"]));
        }
    }
}
