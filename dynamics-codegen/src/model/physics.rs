//! Whether the numbers of a robot can be those of bodies. What depends on fields is not judged here.

use super::lines::NONPHYSICAL_INERTIA;
use super::topology::Topology;
use super::values::Values;
use super::{Link, Motion, Tree};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};
use crate::spatial::{PseudoInertia, Symmetric3};
use crate::spec::{BodySpec, Formula, InertiaKind, JointKind, JointSpec, Name, RobotSpec, Shape, plain};
use crate::symbolic::{Expr, Graph, Number, Op};

/// Checks the numbers of each body and joint by themselves.
pub(super) fn check_numbers(spec: &RobotSpec, values: &Values, diags: &mut Diagnostics) {
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
    let name = &joint.name;
    if let Some([lower, upper]) = &joint.limits
        && let (Some(low), Some(high)) = (constant(values, lower), constant(values, upper))
        && !has_room(low, high, lower)
    {
        let (low, high) = (lower.short_text(), upper.short_text());
        let message = format!("the limits of `{name}` leave no room: from `{low}` to `{high}`");
        diags.error(Code::LimitsInverted, &lower.place.to(&upper.place), message);
    }
    let units = if joint.kind == JointKind::Prismatic { ["m/s", "N"] } else { ["rad/s", "N·m"] };
    for (key, limit, unit) in [("velocity", &joint.velocity, units[0]), ("effort", &joint.effort, units[1])] {
        if let Some(limit) = limit
            && let Some(value) = constant(values, limit).filter(|value| value.is_negative())
        {
            diags.error(
                Code::LimitNegative,
                &limit.place,
                format!("the {key} limit of `{name}` is {} {unit}", plain(value)),
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
    let moving: Vec<_> = spec.joints.iter().filter(|joint| joint.kind != JointKind::Fixed).collect();
    let mut moved = vec![Load::default(); tree.links.len()];
    for (k, link) in tree.links.iter().enumerate().rev() {
        let beyond = moved[k];
        moved[k] = beyond.and(Load::of(link.inertia));
        if let Some(parent) = link.parent {
            moved[parent] = moved[parent].and(moved[k]);
        }
        if let Some(joint) = moving.get(k) {
            check_moved(joint, link, moved[k], beyond, diags);
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
    let mut bodies = vec![vec![]; spec.joints.len()];
    for (link, body) in topology.links().into_iter().zip(&topology.body) {
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

/// A joint that moves nothing makes the mass matrix singular, whatever the coordinates are.
fn check_moved(joint: &JointSpec, link: &Link<Expr>, moved: Load, beyond: Load, diags: &mut Diagnostics) {
    let (name, child) = (&joint.name, &joint.child);
    let place = &joint.name.place;
    let moves = if link.motion == Motion::Revolute { moved.inertia } else { moved.mass };
    if !moves {
        let message =
            format!("the joint `{name}` moves no mass: neither `{child}` nor what it carries has any");
        diags.error(Code::MovesNoMass, place, message);
    } else if !beyond.inertia && link.motion == Motion::Revolute && turns_nothing(link.inertia) {
        let message = format!("the joint `{name}` turns no inertia: all mass of `{child}` is on its axis");
        diags.error(Code::MovesNoInertia, place, message);
    }
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
    // Rods and laminas are on the boundary; of a point mass nothing is left but the rounding of constants.
    let rounding = 1e-20 * inertia.second.full().trace().as_number().map_or(0.0, Number::to_f64);
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
    let about_com = inertia.second + Symmetric3::outer_self(-inverse, inertia.first);
    let Symmetric3 { xx, yy, zz, xy, xz, yz } = about_com;
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
