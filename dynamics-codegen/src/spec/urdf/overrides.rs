//! What stands on the struct beside a file: more on its links and joints, and bodies and joints of its own.
//!
//! Each key of a `#[body]` replaces what the file says of the link. A `solid` replaces all of `<inertial>`; an
//! `inertia` replaces the tensor and its `rpy`. Each key of a `#[joint(name, …)]` replaces what the file says of the
//! joint; a `rotor` replaces an armature, and a joint that is to follow another one loses its limits.

use rustc_hash::FxHashMap;

use super::numbers::value;
use super::report::{Note, Report};
use super::source::quoted;
use super::tree::NAMES_TO_COMPARE;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{BodySpec, JointAmendment, JointKeys, JointKind, JointSpec, default_friction_speed, plain};

/// The links with what is said of them on the struct, and behind them the bodies that are no links.
pub(super) fn of_bodies(links: Vec<BodySpec>, beside: Vec<BodySpec>, report: &mut Report) -> Vec<BodySpec> {
    let mut bodies = links;
    let known: FxHashMap<String, usize> =
        bodies.iter().enumerate().map(|(k, body)| (body.name.text.clone(), k)).collect();
    let mut seen = vec![false; bodies.len()];
    for body in beside {
        match known.get(&body.name.text) {
            // A second line for a link is a mistake, which is found where all names are.
            Some(&k) if !seen[k] => {
                seen[k] = true;
                let text = format!("{} is described on the struct as well", quoted(&body.name.text));
                report.remarks.push(Note::new(text, body.place.clone()));
                replace(&mut bodies[k], body);
            }
            _ => bodies.push(body),
        }
    }
    bodies
}

fn replace(link: &mut BodySpec, body: BodySpec) {
    let BodySpec { mass, com, inertia, inertia_rpy, solid, allow, written, place, name, .. } = body;
    if solid.is_some() {
        (link.mass, link.com, link.inertia, link.inertia_rpy) = (None, None, None, None);
    }
    if inertia.is_some() {
        link.inertia_rpy = None;
    }
    (link.written, link.place, link.name) = (written, place, name);
    link.mass = mass.or(link.mass.take());
    link.com = com.or(link.com.take());
    link.inertia = inertia.or(link.inertia.take());
    link.inertia_rpy = inertia_rpy.or(link.inertia_rpy.take());
    link.solid = solid;
    link.allow = allow;
}

/// Changes the joints of a file as the struct says. `beside` are the joints that the struct has of its own.
pub(super) fn of_joints(
    joints: &mut [JointSpec],
    amendments: Vec<JointAmendment>,
    beside: &[JointSpec],
    report: &mut Report,
    diags: &mut Diagnostics,
) {
    let known: FxHashMap<String, usize> =
        joints.iter().enumerate().map(|(k, joint)| (joint.name.text.clone(), k)).collect();
    let mut seen = vec![false; joints.len()];
    for JointAmendment { name, keys, place } in amendments {
        let shown = quoted(&name.text);
        match known.get(&name.text) {
            Some(&k) if !seen[k] => {
                seen[k] = true;
                report.remarks.push(Note::new(format!("{shown} is described on the struct as well"), place));
                amend(&mut joints[k], *keys, report, diags);
            }
            None if beside.iter().all(|joint| joint.name.text != name.text) => {
                let message = format!("there is no joint {shown} in the file");
                let names = joints.iter().map(|joint| &*joint.name.text).take(NAMES_TO_COMPARE);
                let unknown = Diagnostic::new(Code::JointUnknown, &name.place, message);
                diags.push(unknown.suggest(&name.text, names));
            }
            _ => diags.error(
                Code::NameDuplicate,
                &name.place,
                format!("there are two joint lines for {shown}"),
            ),
        }
    }
}

/// Says from which speed on the friction of a file acts, which files do not.
pub(super) fn remark_on_friction(joints: &[JointSpec], report: &mut Report) {
    for JointSpec { name, kind, keys, .. } in joints {
        let (Some(friction), None) = (&keys.friction, &keys.friction_speed) else { continue };
        if value(friction).is_some_and(|value| !value.is_zero()) {
            let unit = if *kind == JointKind::Prismatic { "m/s" } else { "rad/s" };
            let speed = plain(default_friction_speed());
            let text = format!(
                "the friction of the joint {} is smooth below some {speed} {unit}: `friction_speed` \
                 on the struct sets another speed",
                quoted(&name.text)
            );
            report.remarks.push(Note::new(text, friction.place.clone()));
        }
    }
}

/// Puts the keys of the struct before those of the file, and takes out what these replace.
fn amend(joint: &mut JointSpec, keys: JointKeys, report: &mut Report, diags: &mut Diagnostics) {
    let shown = quoted(&joint.name.text);
    if let Some(placement) = &keys.placement {
        let message = format!("the joint {shown} is placed twice: by the file as well");
        let conflict = Diagnostic::new(Code::KeysConflict, &placement.place, message);
        diags.push(conflict.help("move the joint of a file by `at` and `rpy`"));
    }
    let of_file = joint.keys.as_mut();
    if keys.rotor.is_some() || keys.gear.is_some() {
        of_file.armature = None;
    }
    if keys.locked.is_some() || keys.mimic.is_some() {
        (of_file.mimic, of_file.ratio, of_file.offset) = (None, None, None);
    }
    if keys.mimic.is_some() {
        let limits = of_file.limits.take().map(|[lower, _]| lower);
        let limits = [limits, of_file.velocity.take(), of_file.effort.take()];
        if let Some(limit) = limits.into_iter().flatten().next() {
            let text = format!("`<limit>` of the joint {shown}, which follows another one");
            report.ignored.push(Note::new(text, limit.place));
        }
    }
    *of_file = keys.or(std::mem::take(of_file));
}
