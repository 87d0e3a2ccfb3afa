//! Whether the numbers of a robot can be those of bodies. What depends on fields is not judged here.

use super::lines::NONPHYSICAL_INERTIA;
use super::quantities::{Along, Slot};
use super::topology::{Coordinate, Topology};
use super::values::Values;
use super::{Link, Motion, Tree};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::spatial::{PseudoInertia, Symmetric3};
use crate::spec::{BodySpec, Formula, InertiaKind, JointKind, JointSpec, Name, RobotSpec, Shape, plain};
use crate::symbolic::{Expr, Graph, Number, Op};

/// Checks the numbers of each body and joint by themselves.
pub(super) fn check_numbers(spec: &RobotSpec, slots: &[Slot], values: &Values, diags: &mut Diagnostics) {
    for body in &spec.bodies {
        let mass = body.mass.as_ref().or(body.solid.as_ref().map(|solid| &*solid.mass));
        if let Some((formula, mass)) = mass.and_then(|mass| Some((mass, constant(values, mass)?)))
            && mass.is_negative()
        {
            let message = format!("the mass of `{}` is {} kg", body.name, plain(mass));
            diags.error(Code::MassNegative, &formula.place, message);
        }
        check_sizes(body, values, diags);
        check_tensor(body, spec, values, diags);
    }
    for joint in &spec.joints {
        check_limits(joint, values, diags);
    }
    for slot in slots {
        check_sign(slot, values, diags);
    }
}

/// What resists does not drive, and what is a ratio is not zero.
fn check_sign(slot: &Slot, values: &Values, diags: &mut Diagnostics) {
    let Slot { formula, key, owner, .. } = *slot;
    let is_of_joint =
        matches!(key, "armature" | "rotor" | "damping" | "friction" | "stiffness" | "friction_speed");
    let is_ratio = matches!(key, "ratio" | "pitch" | "gear");
    let Some(value) = constant(values, formula).filter(|_| is_of_joint || is_ratio) else { return };
    let unit = slot.quantity.unit();
    let fact = match unit {
        "no unit" => format!("`{key}` of `{owner}` is {}", plain(value)),
        unit => format!("`{key}` of `{owner}` is {} {unit}", plain(value)),
    };
    let place = &formula.place;
    if is_of_joint && value.is_negative() {
        let drives = matches!(key, "damping" | "friction");
        let why = if drives { ": it would drive the joint" } else { "" };
        diags.error(Code::PassiveNegative, place, fact + why);
    } else if key == "friction_speed" && value.is_zero() {
        let wrong = Diagnostic::new(Code::PassiveNegative, place, fact + ": friction would jump at rest");
        diags.push(wrong.help("give the speed from which on friction is nearly all there, as in `0.01`"));
    } else if is_ratio && value.is_zero() {
        let help = match key {
            "ratio" => "give a number other than zero, or lock the joint: `locked = …`",
            "pitch" => "give a distance for each radian, or make the joint `revolute`",
            _ => "give how far the rotor turns for each unit of the joint",
        };
        diags.push(Diagnostic::new(Code::RatioZero, place, fact).help(help));
    }
}

fn constant(values: &Values, formula: &Formula) -> Option<Number> {
    values.scalar(formula).ok()?.as_number()
}

fn check_sizes(body: &BodySpec, values: &Values, diags: &mut Diagnostics) {
    let Some(solid) = &body.solid else { return };
    let sizes: Vec<&Formula> = match &solid.shape {
        Shape::Cuboid(edges) => edges.iter().collect(),
        Shape::Cylinder(size, _) => size.iter().collect(),
        Shape::Sphere(size) | Shape::Rod(size, _) => vec![&**size],
        Shape::Point => vec![],
    };
    for size in sizes {
        if let Some(value) = constant(values, size).filter(|value| value.is_negative()) {
            let message = format!("a size of `{}` is {} m", body.name, plain(value));
            diags.error(Code::SizeNegative, &size.place, message);
        }
    }
}

/// A matrix is symmetric, and a tensor is not the first rows of a matrix.
fn check_tensor(body: &BodySpec, spec: &RobotSpec, values: &Values, diags: &mut Diagnostics) {
    let name = &body.name;
    match body.inertia.as_ref().map(|inertia| &inertia.kind) {
        Some(InertiaKind::Tensor(parts)) => {
            let [ixx, ixy, ixz, iyy, iyz, izz] = parts.each_ref().map(|part| constant(values, part));
            let all = [ixx, ixz, iyz, izz].iter().all(Option::is_some);
            // Of a file the names are in the file, and there is no other form: it can be allowed. Dummies have all alike.
            let is_of_file = body.written.is_empty();
            let allowed = is_of_file && (allows(spec.options.allow.as_deref()) || ixx == ixy);
            if let (Some(ixy), Some(iyy), true) = (ixy, iyy, all && !allowed)
                && ixy == iyy
                && !ixy.is_zero()
            {
                let message = format!(
                    "ixy and iyy of `{name}` are both {} kg·m², as in a matrix read by rows",
                    plain(ixy)
                );
                let wrong = Diagnostic::new(Code::InertiaOrder, &parts[1].place.to(&parts[3].place), message);
                diags.push(match is_of_file {
                    true => {
                        wrong.help(format!("correct the components, or accept them: `{}`", allowing(body)))
                    }
                    false => wrong,
                });
            }
        }
        Some(InertiaKind::Matrix(rows)) => {
            for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                let (above, below) = (&rows[i][j], &rows[j][i]);
                if let (Ok(a), Ok(b)) = (values.scalar(above), values.scalar(below))
                    && a != b
                {
                    let (row, column) = (i + 1, j + 1);
                    let (above, below) = (above.short_text(), below.short_text());
                    let message = format!(
                        "the inertia of `{name}` is not symmetric: row {row}, column {column} is `{above}`, and row \
                         {column}, column {row} is `{below}`"
                    );
                    diags.error(Code::InertiaNotSymmetric, &rows[j][i].place, message);
                }
            }
        }
        _ => {}
    }
}

fn check_limits(joint: &JointSpec, values: &Values, diags: &mut Diagnostics) {
    let JointSpec { name, keys, .. } = joint;
    if joint.kind.speeds() != 1 {
        return;
    }
    if let Some([lower, upper]) = &keys.limits
        && let (Some(low), Some(high)) = (constant(values, lower), constant(values, upper))
        && !has_room(low, high, lower)
    {
        let (low, high) = (lower.short_text(), upper.short_text());
        let message = format!("the limits of `{name}` leave no room: from `{low}` to `{high}`");
        diags.error(Code::LimitsInverted, &lower.place.to(&upper.place), message);
    }
    let along = Along::of(joint.kind);
    for (key, limit, quantity) in
        [("velocity", &keys.velocity, along.speed), ("effort", &keys.effort, along.force)]
    {
        if let Some(limit) = limit
            && let Some(value) = constant(values, limit).filter(|value| value.is_negative())
        {
            diags.error(
                Code::LimitNegative,
                &limit.place,
                format!("the {key} limit of `{name}` is {} {}", plain(value), quantity.unit()),
            );
        }
    }
}

/// Whether there is something between the limits; a file's may be equal, as exporters write what they do not know.
fn has_room(low: Number, high: Number, lower: &Formula) -> bool {
    let order = low.cmp_value(high);
    order.is_lt() || (order.is_eq() && matches!(lower.place, Place::Text { .. }))
}

/// Checks what moves: each link with all that is welded to it.
pub(super) fn check_links(
    spec: &RobotSpec,
    topology: &Topology,
    graph: &Graph,
    tree: &Tree<Expr>,
    diags: &mut Diagnostics,
) {
    if !finite(tree, graph) {
        let message = "the numbers of the robot are too large to compute with";
        diags.error(Code::NumberOutOfRange, &Place::of(&spec.ident), message);
        return;
    }
    let loads = loads(tree);
    let in_terms: Vec<usize> = tree.coupled_by_terms().into_iter().flat_map(|(a, b)| [a, b]).collect();
    for (joint, coordinate) in spec.joints.iter().zip(&topology.coordinate) {
        if let Some(Coordinate { v, .. }) = coordinate {
            check_moved(joint, *v, (&loads, &in_terms), tree, diags);
        }
    }
    let all_allowed = allows(spec.options.allow.as_deref());
    for (bodies, link) in bodies_of_links(spec, topology).iter().zip(&tree.links).filter(|_| !all_allowed) {
        if !bodies.iter().any(|body| allows(body.allow.as_deref())) {
            check_inertia(bodies, link.inertia, diags);
        }
    }
}

/// The bodies that are welded together on each link.
fn bodies_of_links<'s>(spec: &'s RobotSpec, topology: &Topology) -> Vec<Vec<&'s BodySpec>> {
    let links = topology.links.iter().map(|links| links.end).max().unwrap_or(0);
    let mut bodies = vec![vec![]; links];
    for (link, body) in topology.link_of_body().into_iter().zip(&topology.body) {
        if let (Some(link), Some(body)) = (link, body) {
            bodies[link].push(&spec.bodies[*body]);
        }
    }
    bodies
}

/// Whether all constants are numbers, also those within expressions.
fn finite(tree: &Tree<Expr>, graph: &Graph) -> bool {
    let is_number = |value: Number| value.is_finite() && value.to_f64().is_finite();
    let mut finite = graph.ops().iter().all(|op| match *op {
        Op::Constant(k) | Op::Scale(k, _) => is_number(graph.number(k)),
        _ => true,
    });
    let _ = tree.map(|entry| {
        finite &= entry.as_number().is_none_or(is_number);
        0.0
    });
    finite
}

/// What a joint moves, as far as that decides whether it moves anything.
#[derive(Clone, Copy, Default)]
struct Load {
    mass: bool,
    /// Mass or, on a body that is said to have none, inertia.
    inertia: bool,
}

impl Load {
    fn of(body: PseudoInertia<Expr>) -> Self {
        let mass = !body.mass.is_zero();
        Self { mass, inertia: mass || has_second_moments(body) }
    }

    fn and(self, other: Self) -> Self {
        Self { mass: self.mass || other.mass, inertia: self.inertia || other.inertia }
    }
}

fn has_second_moments(body: PseudoInertia<Expr>) -> bool {
    body.second.full().0.as_flattened().iter().any(|entry| !entry.is_zero())
}

/// What each link carries beyond itself.
fn loads(tree: &Tree<Expr>) -> Vec<Load> {
    let mut beyond = vec![Load::default(); tree.links.len()];
    for (k, link) in tree.links.iter().enumerate().rev() {
        if let Some(parent) = link.parent {
            beyond[parent] = beyond[parent].and(beyond[k]).and(Load::of(link.inertia));
        }
    }
    beyond
}

/// What a speed moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Effect {
    NoMass,
    NoInertia,
    Inertia,
}

/// What the speed of a link moves, as far as that can be said without its configuration.
fn effect(link: &Link<Expr>, beyond: Load) -> Effect {
    let moved = beyond.and(Load::of(link.inertia));
    let turns = |is_nothing: bool| match (moved.inertia, !beyond.inertia && is_nothing) {
        (false, _) => Effect::NoMass,
        (true, true) => Effect::NoInertia,
        (true, false) => Effect::Inertia,
    };
    match link.motion {
        _ if !link.passive.armature.is_zero() => Effect::Inertia,
        Motion::Revolute => turns(turns_nothing(link.inertia)),
        Motion::Prismatic | Motion::Free if !moved.mass => Effect::NoMass,
        Motion::Prismatic => Effect::Inertia,
        Motion::Ball => turns(is_on_a_line(eigenvalues_of(link.inertia.second))),
        Motion::Free => turns(is_on_a_line(second_moments(link.inertia))),
    }
}

/// A joint that moves nothing makes the mass matrix singular, whatever the coordinates are. `v` is its first speed; of
/// some speeds there are kinetic terms.
fn check_moved(
    joint: &JointSpec,
    v: usize,
    (loads, in_terms): (&[Load], &[usize]),
    tree: &Tree<Expr>,
    diags: &mut Diagnostics,
) {
    let (name, child) = (&joint.name, &joint.child);
    // Followers move with it; the links that share a coordinate move something if one of them does.
    let effect_of = |speed: usize| {
        if in_terms.contains(&speed) {
            return Some(Effect::Inertia);
        }
        let driven = tree.links.iter().zip(loads).filter(|(link, _)| link.drive.v == speed);
        driven.map(|(link, beyond)| effect(link, *beyond)).max()
    };
    let effects = (v..v + joint.kind.speeds()).filter_map(|speed| Some((effect_of(speed)?, speed - v)));
    let (least, part) = effects.min().unzip();
    let place = &name.place;
    match least {
        Some(Effect::NoMass) => {
            let wrong = |message| Diagnostic::new(Code::MovesNoMass, place, message);
            diags.push(match joint.is_bare {
                true => wrong(format!("no kinetic term has the speed of `{name}`")).help(format!(
                    "give the coordinate its inertia: `#[kinetic(m / 2 * dot({name})^2)]`, or an `armature`"
                )),
                false => wrong(format!(
                    "the joint `{name}` moves no mass: neither `{child}` nor what it carries has any"
                )),
            });
        }
        Some(Effect::NoInertia) => {
            let is_round = matches!(joint.kind, JointKind::Ball | JointKind::Free);
            let part = part
                .and_then(|part| joint.kind.coordinate_parts().get(part))
                .filter(|part| !is_round && !part.is_empty());
            let message = match part {
                Some(part) => format!(
                    "the joint `{name}` turns no inertia by its coordinate `{name}.{part}`: all mass of `{child}` is on this axis"
                ),
                None if is_round => {
                    format!("the joint `{name}` turns no inertia: all mass of `{child}` is on one line")
                }
                None => format!("the joint `{name}` turns no inertia: all mass of `{child}` is on its axis"),
            };
            diags.error(Code::MovesNoInertia, place, message);
        }
        _ => {}
    }
}

/// Whether second moments are those of mass on one line, through the point that they are about.
fn is_on_a_line(moments: Option<[f64; 3]>) -> bool {
    moments.is_some_and(|[low, middle, high]| low.abs() + middle.abs() <= 1e-12 * high.abs())
}

fn turns_nothing(inertia: PseudoInertia<Expr>) -> bool {
    let moment = inertia.rotational().zz;
    let size = inertia.rotational().full().trace().as_number().map_or(0.0, Number::to_f64);
    moment.as_number().is_some_and(|moment| moment.to_f64().abs() <= 1e-12 * size)
}

fn allows(names: Option<&[Name]>) -> bool {
    names.into_iter().flatten().any(|name| name.text == NONPHYSICAL_INERTIA)
}

/// `∫r rᵀ dm` about the centre of mass is positive semidefinite, if it is known.
fn check_inertia(bodies: &[&BodySpec], inertia: PseudoInertia<Expr>, diags: &mut Diagnostics) {
    let Some(body) = bodies.iter().find(|body| body.inertia.is_some()).or(bodies.first()) else { return };
    if inertia.mass.is_zero() {
        if has_second_moments(inertia) {
            let message = format!(
                "the mass of `{}` is 0 kg, and its inertia is not zero: no distribution of mass has it",
                body.name
            );
            report_nonphysical(body, message, "give the body its mass", diags);
        }
        return;
    }
    let Some([low, middle, high]) = second_moments(inertia) else { return };
    // Rods and laminas are on the boundary; of a point mass nothing is left but the rounding of whoever wrote the file.
    let rounding = 1e-15 * inertia.second.full().trace().as_number().map_or(0.0, Number::to_f64);
    if low >= -1e-6 * high.abs().max(middle.abs()) - rounding {
        return;
    }
    let moments = [low + middle, low + high, middle + high];
    let [a, b, c] = moments.map(significant);
    let names = bodies.iter().filter(|body| body.mass.is_some() || body.solid.is_some());
    let names = names.map(|body| format!("`{}`", body.name)).collect::<Vec<_>>().join(" and ");
    let rule = if moments[0] < 0.0 {
        format!("{a} is negative")
    } else {
        format!("{c} is more than {a} + {b}, so no distribution of mass has them")
    };
    let message = format!("the principal moments of inertia of {names} are {a}, {b} and {c} kg·m²: {rule}");
    report_nonphysical(body, message, Code::InertiaNonphysical.help(), diags);
}

/// Reports an inertia together with the line that would allow it.
fn report_nonphysical(body: &BodySpec, message: String, help: &str, diags: &mut Diagnostics) {
    let place = body.inertia.as_ref().map_or(&body.place, |inertia| &inertia.place);
    let help = format!("{help}, or accept it: `{}`", allowing(body));
    diags.push(Diagnostic::new(Code::InertiaNonphysical, place, message).help(help));
}

/// The body's line with the permission; of a file, the line for all bodies.
fn allowing(body: &BodySpec) -> String {
    if body.written.is_empty() {
        return format!("#[dynamics(allow({NONPHYSICAL_INERTIA}))]");
    }
    let text: String = body.written.to_string().chars().filter(|c| !c.is_whitespace()).collect();
    let text = text.trim_end_matches(',').replace(',', ", ").replace('=', " = ");
    format!("#[body({text}, allow({NONPHYSICAL_INERTIA}))]")
}

/// The eigenvalues of `∫r rᵀ dm` about the centre of mass, in order; `None` if one of the parts is a field's.
fn second_moments(inertia: PseudoInertia<Expr>) -> Option<[f64; 3]> {
    let mass = inertia.mass.as_number().filter(|mass| mass.signum() > 0)?;
    let inverse = Expr::Constant(Number::ONE.checked_div(mass)?);
    eigenvalues_of(inertia.second + Symmetric3::outer_self(-inverse, inertia.first))
}

/// The eigenvalues of a tensor, in order; `None` if one of its parts is a field's.
fn eigenvalues_of(tensor: Symmetric3<Expr>) -> Option<[f64; 3]> {
    let Symmetric3 { xx, yy, zz, xy, xz, yz } = tensor;
    let mut entries = [0.0; 6];
    for (entry, expr) in entries.iter_mut().zip([xx, yy, zz, xy, xz, yz]) {
        *entry = expr.as_number()?.to_f64();
    }
    let [xx, yy, zz, xy, xz, yz] = entries;
    Some(eigenvalues([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
}

/// The eigenvalues of a symmetric matrix, in order: Jacobi's rotations.
fn eigenvalues(mut m: [[f64; 3]; 3]) -> [f64; 3] {
    for _ in 0..32 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if m[p][q] == 0.0 {
                continue;
            }
            let slope = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let t = slope.signum() / (slope.abs() + (slope * slope + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut m {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (first, second) = (m[p], m[q]);
            m[p] = std::array::from_fn(|k| c * first[k] - s * second[k]);
            m[q] = std::array::from_fn(|k| s * first[k] + c * second[k]);
        }
    }
    let mut values = [m[0][0], m[1][1], m[2][2]];
    values.sort_by(f64::total_cmp);
    values
}

/// A value to six significant digits.
fn significant(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
