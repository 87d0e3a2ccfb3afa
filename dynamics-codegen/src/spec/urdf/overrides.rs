//! What stands on the struct beside a file: `#[body]` of a link, and bodies and joints of its own.
//!
//! Each key of a `#[body]` replaces what the file says of the link. A `solid` replaces all of `<inertial>`; an
//! `inertia` replaces the tensor and its `rpy`.

use rustc_hash::FxHashMap;

use super::report::{Note, Report};
use super::source::quoted;
use crate::spec::BodySpec;

/// The links with what is said of them on the struct, and behind them the bodies that are no links.
pub(super) fn apply(links: Vec<BodySpec>, beside: Vec<BodySpec>, report: &mut Report) -> Vec<BodySpec> {
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
