//! Masses and inertias from what was written: tensors, and the textbook's solids.

use super::placement::{Snap, rotation_of_rpy};
use super::values::{Result, Values};
use crate::spatial::{PseudoInertia, Scalar, Symmetric3};
use crate::spec::{BodySpec, InertiaKind, InertiaSpec, RobotSpec, Shape, Solid};
use crate::symbolic::{Expr, Number};

/// The mass of a body, in its own frame.
pub(super) fn pseudo_inertia<'g>(
    body: &BodySpec,
    spec: &RobotSpec,
    values: &Values<'_, 'g>,
) -> Result<PseudoInertia<Expr<'g>>> {
    let (mass, tensor) = match (&body.solid, &body.mass, &body.inertia) {
        (Some(solid), ..) => of_solid(solid, values)?,
        (None, Some(mass), Some(inertia)) => (values.scalar(mass)?, of_tensor(inertia, values)?),
        _ => return Ok(PseudoInertia::zero()),
    };
    let tensor = match &body.inertia_rpy {
        Some(rpy) => tensor.rotated(rotation_of_rpy(values.vector(rpy)?, snap_of(spec))),
        None => tensor,
    };
    Ok(PseudoInertia::new(mass, values.vector_or_zero(body.com.as_ref())?, tensor))
}

/// Whether the specification snaps rotations.
pub(super) fn snap_of(spec: &RobotSpec) -> Snap {
    if spec.options.snaps() { Snap::On } else { Snap::Off }
}

fn of_tensor<'g>(inertia: &InertiaSpec, values: &Values<'_, 'g>) -> Result<Symmetric3<Expr<'g>>> {
    let [xx, xy, xz, yy, yz, zz] = match &inertia.kind {
        InertiaKind::Diagonal(parts) => {
            let [xx, yy, zz] = values.vector(parts)?.0;
            return Ok(Symmetric3::diagonal(xx, yy, zz));
        }
        InertiaKind::Tensor(parts) => parts.each_ref(),
        InertiaKind::Matrix(rows) => {
            let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = &**rows;
            [xx, xy, xz, yy, yz, zz]
        }
    };
    let (diagonal, products) = ([xx, yy, zz], [xy, xz, yz]);
    let [xx, yy, zz] =
        [values.scalar(diagonal[0])?, values.scalar(diagonal[1])?, values.scalar(diagonal[2])?];
    let [xy, xz, yz] =
        [values.scalar(products[0])?, values.scalar(products[1])?, values.scalar(products[2])?];
    Ok(Symmetric3 { xx, yy, zz, xy, xz, yz })
}

/// The mass, and the inertia about the centre.
fn of_solid<'g>(solid: &Solid, values: &Values<'_, 'g>) -> Result<(Expr<'g>, Symmetric3<Expr<'g>>)> {
    let mass = values.scalar(&solid.mass)?;
    let part = |den: i64| mass * Expr::Constant(Number::ratio(1, den));
    let tensor = match &solid.shape {
        Shape::Cuboid(edges) => {
            let [l, w, h] = values.vector(edges)?.0.map(|edge| edge * edge);
            Symmetric3::diagonal(part(12) * (w + h), part(12) * (l + h), part(12) * (l + w))
        }
        Shape::Cylinder(size, axis) => {
            let (radius, length) = (values.scalar(&size[0])?, values.scalar(&size[1])?);
            let across = part(12) * (Expr::from(3) * (radius * radius) + length * length);
            about_axis(*axis, part(2) * (radius * radius), across)
        }
        Shape::Sphere(radius) => {
            let radius = values.scalar(radius)?;
            let moment = Expr::Constant(Number::ratio(2, 5)) * mass * (radius * radius);
            Symmetric3::diagonal(moment, moment, moment)
        }
        Shape::Rod(length, axis) => {
            let length = values.scalar(length)?;
            about_axis(*axis, Expr::ZERO, part(12) * (length * length))
        }
        Shape::Point => Symmetric3::zero(),
    };
    Ok((mass, tensor))
}

fn about_axis<S: Scalar>(axis: usize, along: S, across: S) -> Symmetric3<S> {
    let mut moments = [across; 3];
    moments[axis] = along;
    let [xx, yy, zz] = moments;
    Symmetric3::diagonal(xx, yy, zz)
}
