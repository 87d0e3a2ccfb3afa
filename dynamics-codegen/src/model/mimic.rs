//! Joints that follow others: whether there is one to follow, and the motion of the first of a chain.

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{JointSpec, RobotSpec, leaders};

/// Checks what each follower follows.
pub(super) fn check(spec: &RobotSpec, diags: &mut Diagnostics) {
    let leaders = leaders(&spec.joints);
    for (joint, leader) in spec.joints.iter().zip(&leaders).filter(|(joint, _)| joint.kind.speeds() == 1) {
        let Some(name) = &joint.keys.mimic else { continue };
        let wrong = match leader.map(|leader| &spec.joints[leader]) {
            None => {
                let message =
                    format!("the joint `{}` mimics `{name}`, and there is no such joint", joint.name);
                let others = spec.joints.iter().filter(|other| other.kind.speeds() == 1);
                let others = others.map(|other| &*other.name.text).filter(|other| *other != joint.name.text);
                let unknown = Diagnostic::new(Code::MimicUnknown, &name.place, message);
                unknown.suggest(&name.text, others.take(NAMES_TO_COMPARE))
            }
            Some(leader) if leader.kind.speeds() != 1 => {
                let has = match leader.kind.speeds() {
                    0 => "does not move".to_owned(),
                    speeds => format!("has {speeds} degrees of freedom"),
                };
                let message = format!("the joint `{}` mimics `{name}`, which {has}", joint.name);
                Diagnostic::new(Code::MimicUnfit, &name.place, message)
            }
            Some(_) => continue,
        };
        diags.push(wrong);
    }
    check_cycles(&spec.joints, &leaders, diags);
}

/// Only so many names are compared with one that is not known.
const NAMES_TO_COMPARE: usize = 1000;

/// Each circle once, at its first joint.
fn check_cycles(joints: &[JointSpec], leaders: &[Option<usize>], diags: &mut Diagnostics) {
    let mut seen = vec![false; joints.len()];
    for start in 0..joints.len() {
        let (mut path, mut at) = (vec![], Some(start));
        while let Some(joint) = at.filter(|joint| !seen[*joint]) {
            seen[joint] = true;
            path.push(joint);
            at = leaders[joint];
        }
        let Some(first) = at.and_then(|end| path.iter().position(|joint| *joint == end)) else { continue };
        let circle = &path[first..];
        let name = |k: &usize| format!("`{}`", joints[*k].name);
        let message = match circle {
            [only] => format!("the joint {} mimics itself", name(only)),
            _ => {
                let names: Vec<_> = circle.iter().chain(circle.first()).map(name).collect();
                format!("the joints {} mimic each other in a circle", names.join(" -> "))
            }
        };
        let leader = circle.first().and_then(|first| joints[*first].keys.mimic.as_ref());
        let Some(leader) = leader else { continue };
        let cycle = Diagnostic::new(Code::MimicCycle, &leader.place, message);
        diags.push(if circle.len() == 1 {
            cycle.help("name another joint, or leave `mimic` out")
        } else {
            cycle
        });
    }
}
