//! Where joints stand and how they turn: poses from what was written.
//!
//! A link's frame has z along its axis. From the child body's frame `B` as users know it to the link's
//! frame `J` leads a constant rotation, so that axes along x, y and z cost nothing.

use super::values::{Result, Values};
use crate::diagnostics::{Code, Diagnostic};
use crate::spatial::{Matrix3, Pose, Vector3};
use crate::spec::{Axis, AxisKind, Formula, JointKind, JointSpec, PlacementKind};
use crate::symbolic::{Expr, Number};

/// The poses of a joint.
pub(super) struct Geometry<'g> {
    /// `X_PJ`: the link's frame in the parent body's frame at zero; of a fixed joint, the child's.
    pub(super) link: Pose<Expr<'g>>,
    /// `X_JB`: the child body's frame in the link's.
    pub(super) body: Pose<Expr<'g>>,
}

/// Whether constants next to 0 and ±1 in rotations become these.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Snap {
    On,
    Off,
}

type Matrix<'g> = Matrix3<Expr<'g>>;

impl<'g> Geometry<'g> {
    pub(super) fn of(joint: &JointSpec, values: &Values<'_, 'g>, snap: Snap) -> Result<Self> {
        let geometry = match joint.placement.as_ref().map(|placement| &placement.kind) {
            Some(PlacementKind::Dh(parts)) => Self::dh(joint.kind, &Dh::of(parts, values, snap)?),
            Some(PlacementKind::ModifiedDh(parts)) => Self::modified_dh(&Dh::of(parts, values, snap)?),
            Some(PlacementKind::Screw { axis, through }) => {
                let line =
                    Pose { rotation: frame_along(axis, values)?, translation: values.vector(through)? };
                Self { link: line, body: line.inverse() * written_pose(joint, values, snap)? }
            }
            None => {
                let pose = written_pose(joint, values, snap)?;
                let turned = match &joint.axis {
                    Some(axis) => Pose::rotation(frame_along(axis, values)?),
                    None => Pose::identity(),
                };
                Self { link: pose * turned, body: turned.inverse() }
            }
        };
        let Self { link, body } = geometry;
        for pose in [link, body] {
            let finite = |entry: &Expr| entry.as_number().is_none_or(Number::is_finite);
            if !pose.rotation.0.as_flattened().iter().chain(&pose.translation.0).all(finite) {
                let message = format!("the placement of the joint `{}` is out of range", joint.name);
                return Err(Diagnostic::new(Code::NumberOutOfRange, &joint.place, message));
            }
        }
        Ok(Self { link: snapped_pose(link, snap), body: snapped_pose(body, snap) })
    }

    /// `Rz(θ)·Tz(d)·Tx(a)·Rx(α)`: the joint moves before the link's length and twist.
    fn dh(kind: JointKind, dh: &Dh<'g>) -> Self {
        let beyond = dh.along_x();
        match kind {
            JointKind::Prismatic => Self { link: dh.about_z(), body: beyond },
            JointKind::Fixed => Self { link: dh.about_z() * beyond, body: Pose::identity() },
            _ => Self { link: Pose::rotation(dh.theta), body: Pose::translation(dh.along(2, dh.d)) * beyond },
        }
    }

    /// `Rx(α)·Tx(a)·Rz(θ)·Tz(d)`: the joint moves last.
    fn modified_dh(dh: &Dh<'g>) -> Self {
        Self { link: dh.along_x() * dh.about_z(), body: Pose::identity() }
    }
}

/// The four parameters of Denavit and Hartenberg.
struct Dh<'g> {
    a: Expr<'g>,
    alpha: Matrix<'g>,
    d: Expr<'g>,
    theta: Matrix<'g>,
}

impl<'g> Dh<'g> {
    fn of([a, alpha, d, theta]: &[Formula; 4], values: &Values<'_, 'g>, snap: Snap) -> Result<Self> {
        let (a, d) = (values.scalar(a)?, values.scalar(d)?);
        let alpha = turn_about(0, values.scalar(alpha)?, snap);
        let theta = turn_about(2, values.scalar(theta)?, snap);
        Ok(Self { a, alpha, d, theta })
    }

    fn along(&self, axis: usize, distance: Expr<'g>) -> Vector3<Expr<'g>> {
        let mut vector = Vector3([Expr::ZERO; 3]);
        vector.0[axis] = distance;
        vector
    }

    /// `Tx(a)·Rx(α)`
    fn along_x(&self) -> Pose<Expr<'g>> {
        Pose { rotation: self.alpha, translation: self.along(0, self.a) }
    }

    /// `Rz(θ)·Tz(d)`
    fn about_z(&self) -> Pose<Expr<'g>> {
        Pose { rotation: self.theta, translation: self.along(2, self.d) }
    }
}

/// `at` and `rpy`.
fn written_pose<'g>(joint: &JointSpec, values: &Values<'_, 'g>, snap: Snap) -> Result<Pose<Expr<'g>>> {
    let translation = values.vector_or_zero(joint.at.as_ref())?;
    let rotation = match &joint.rpy {
        Some(rpy) => rotation_of_rpy(values.vector(rpy)?, snap),
        None => Matrix3::identity(),
    };
    Ok(Pose { rotation, translation })
}

/// `Rz(yaw)·Ry(pitch)·Rx(roll)`
pub(super) fn rotation_of_rpy<'g>(rpy: Vector3<Expr<'g>>, snap: Snap) -> Matrix<'g> {
    let [roll, pitch, yaw] = rpy.0;
    let product = turn_about(2, yaw, snap) * turn_about(1, pitch, snap) * turn_about(0, roll, snap);
    snapped(product, snap)
}

fn turn_about<'g>(axis: usize, angle: Expr<'g>, snap: Snap) -> Matrix<'g> {
    let (c, s) = (angle.cos(), angle.sin());
    let turn = match axis {
        0 => Matrix3::rotation_x(c, s),
        1 => Matrix3::rotation_y(c, s),
        _ => Matrix3::rotation_z(c, s),
    };
    snapped(turn, snap)
}

fn snapped_pose<'g>(pose: Pose<Expr<'g>>, snap: Snap) -> Pose<Expr<'g>> {
    Pose { rotation: snapped(pose.rotation, snap), ..pose }
}

/// A rotation whose constant entries within 1e-11 of 0 are 0; and those within it of ±1 are ±1, where all else in
/// their row and column is 0. So 1.57079632679 is a right angle, and 1.5708, whose sine is as close to 1, is not.
fn snapped<'g>(rotation: Matrix<'g>, snap: Snap) -> Matrix<'g> {
    if snap == Snap::Off {
        return rotation;
    }
    let near = |entry: Expr<'g>, whole: i64| {
        entry.as_number().is_some_and(|value| (value - Number::integer(whole)).to_f64().abs() <= 1e-11)
    };
    let zeros = rotation.map(|entry| if near(entry, 0) { Expr::ZERO } else { entry });
    let is_alone = |row: usize, column: usize| {
        (0..3)
            .all(|k| (k == column || zeros.0[row][k].is_zero()) && (k == row || zeros.0[k][column].is_zero()))
    };
    let mut result = zeros;
    for (i, row) in result.0.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            let whole = [1, -1].into_iter().find(|&whole| near(*entry, whole) && is_alone(i, j));
            *entry = whole.map_or(*entry, |whole| Expr::Constant(Number::integer(whole)));
        }
    }
    result
}

/// A rotation whose third column is the direction of the axis.
fn frame_along<'g>(axis: &Axis, values: &Values<'_, 'g>) -> Result<Matrix<'g>> {
    let columns = match &axis.kind {
        AxisKind::Named { index, negative } => aligned(*index, *negative),
        AxisKind::Vector(parts) => {
            let [x, y, z] = &**parts;
            let direction = [values.number(x)?, values.number(y)?, values.number(z)?];
            along(direction).ok_or_else(|| {
                Diagnostic::new(Code::AxisZero, &axis.place, "the axis has no direction: it is `[0, 0, 0]`")
            })?
        }
    };
    Ok(Matrix3(columns.map(|column| column.map(Expr::Constant))).transpose())
}

/// The columns of the rotation to an axis of the frame: a permutation, with signs where it points backwards.
fn aligned(index: usize, negative: bool) -> [[Number; 3]; 3] {
    let unit = |index: usize| {
        let mut column = [Number::ZERO; 3];
        column[index % 3] = Number::ONE;
        column
    };
    let (first, second, axis) = (unit(index + 1), unit(index + 2), unit(index));
    if negative { [second, first, axis.map(|x| -x)] } else { [first, second, axis] }
}

/// The columns of a rotation to a direction; `None` of the zero vector.
fn along(direction: [Number; 3]) -> Option<[[Number; 3]; 3]> {
    let others = |index: usize| [direction[(index + 1) % 3], direction[(index + 2) % 3]];
    if let Some(index) = (0..3).find(|&i| others(i).iter().all(|x| x.is_zero()) && !direction[i].is_zero()) {
        return Some(aligned(index, direction[index].is_negative()));
    }
    // Of equal size first, so that squares neither overflow nor vanish.
    let largest = direction.iter().map(|x| x.abs()).max_by(|a, b| a.cmp_value(*b))?;
    let mut scaled = [Number::ZERO; 3];
    for (scaled, part) in scaled.iter_mut().zip(direction) {
        *scaled = part.checked_div(largest)?;
    }
    let axis = normalised(scaled)?;
    let flattest = (0..3).min_by(|&a, &b| axis[a].abs().cmp_value(axis[b].abs()))?;
    let mut first = [Number::ZERO; 3];
    if axis[flattest].is_zero() {
        first[flattest] = Number::ONE;
    } else {
        let mut unit = [Number::ZERO; 3];
        unit[flattest] = Number::ONE;
        first = normalised(cross(unit, axis))?;
    }
    Some([first, cross(axis, first), axis])
}

fn normalised(vector: [Number; 3]) -> Option<[Number; 3]> {
    let [x, y, z] = vector;
    let length = (x * x + y * y + z * z).sqrt()?;
    let mut unit = [Number::ZERO; 3];
    for (unit, part) in unit.iter_mut().zip(vector) {
        *unit = part.checked_div(length)?;
    }
    Some(unit)
}

fn cross([a, b, c]: [Number; 3], [x, y, z]: [Number; 3]) -> [Number; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}
