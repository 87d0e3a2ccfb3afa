//! Where joints stand and how they turn: poses from what was written.
//!
//! A link's frame has z along its axis. From the child body's frame `B` as users know it to the link's
//! frame `J` leads a constant rotation, so that axes along x, y and z cost nothing.

use super::Motion;
use super::composition::composition;
use super::values::{Result, Values};
use crate::diagnostics::{Code, Diagnostic};
use crate::spatial::{Matrix3, Pose, Vector3};
use crate::spec::{Axis, AxisKind, Formula, JointKind, JointSpec, PlacementKind};
use crate::symbolic::{Expr, Number};

/// The poses of a joint.
pub(super) struct Geometry<'g> {
    /// `X_PJ`: the frame of each of the joint's links at zero, in that of the one before it; of the first in the
    /// parent body's. Of a joint that is fixed, the child's frame in the parent's.
    pub(super) links: Vec<Pose<Expr<'g>>>,
    /// `X_JB`: the child body's frame in the last link's.
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
        let Self { links, body } = match joint.keys.placement.as_ref().map(|placement| &placement.kind) {
            Some(PlacementKind::Dh(parts)) => Self::dh(joint.kind, &Dh::of(parts, values, snap)?),
            Some(PlacementKind::ModifiedDh(parts)) => Self::modified_dh(&Dh::of(parts, values, snap)?),
            Some(PlacementKind::Screw { axis, through }) => {
                let line =
                    Pose { rotation: frame_along(axis, values)?, translation: values.vector(through)? };
                let body = line.inverse() * written_pose(joint, values, snap)?;
                Self { links: frames_of_links(joint.kind, line), body }
            }
            None => Self::about_axes(joint, values, written_pose(joint, values, snap)?)?,
        };
        for pose in links.iter().chain([&body]) {
            let finite = |entry: &Expr| entry.as_number().is_none_or(Number::is_finite);
            if !pose.rotation.0.as_flattened().iter().chain(&pose.translation.0).all(finite) {
                let message = format!("the placement of the joint `{}` is out of range", joint.name);
                return Err(Diagnostic::new(Code::NumberOutOfRange, &joint.place, message));
            }
        }
        let links = links.into_iter().map(|pose| snapped_pose(pose, snap)).collect();
        Ok(Self { links, body: snapped_pose(body, snap) })
    }

    /// The axes are in the child's frame, which at zero has the pose `written`.
    fn about_axes(joint: &JointSpec, values: &Values<'_, 'g>, written: Pose<Expr<'g>>) -> Result<Self> {
        let frames = joint.axes.iter().map(|axis| Ok(Pose::rotation(frame_along(axis, values)?)));
        let frames = frames.collect::<Result<Vec<_>>>()?;
        Ok(match (frames.as_slice(), joint.axes.as_slice()) {
            ([first, second], [_, axis]) => {
                let between = first.inverse() * *second;
                // The cosines of the second axis to the plane across the first one.
                let across = [between.rotation.0[0][2], between.rotation.0[1][2]];
                let is_nothing = |cosine: &Expr| {
                    cosine.as_number().is_some_and(|cosine| cosine.to_f64().abs() <= PARALLEL)
                };
                if across.iter().all(is_nothing) {
                    let message = format!("the two axes of the joint `{}` are parallel", joint.name);
                    return Err(Diagnostic::new(Code::AxesParallel, &axis.place, message));
                }
                Self { links: vec![written * *first, between], body: second.inverse() }
            }
            ([only], _) => Self { links: frames_of_links(joint.kind, written * *only), body: only.inverse() },
            _ => Self { links: frames_of_links(joint.kind, written), body: Pose::identity() },
        })
    }

    /// `Rz(θ)·Tz(d)·Tx(a)·Rx(α)`: the joint moves before the link's length and twist.
    fn dh(kind: JointKind, dh: &Dh<'g>) -> Self {
        let beyond = dh.along_x();
        let (link, body) = match kind {
            JointKind::Prismatic => (dh.about_z(), beyond),
            JointKind::Fixed => (dh.about_z() * beyond, Pose::identity()),
            _ => (Pose::rotation(dh.theta), Pose::translation(dh.along(2, dh.d)) * beyond),
        };
        Self { links: vec![link], body }
    }

    /// `Rx(α)·Tx(a)·Rz(θ)·Tz(d)`: the joint moves last.
    fn modified_dh(dh: &Dh<'g>) -> Self {
        Self { links: vec![dh.along_x() * dh.about_z()], body: Pose::identity() }
    }

    /// `X_PB`: the child body's frame in the parent's where the joint stands still, its one coordinate at `at`.
    /// `pitch` is one unless the joint is helical.
    pub(super) fn welded(
        &self,
        kind: JointKind,
        at: Expr<'g>,
        pitch: Expr<'g>,
        snap: Snap,
    ) -> Pose<Expr<'g>> {
        let along = |distance: Expr<'g>| Pose::translation(Vector3([Expr::ZERO, Expr::ZERO, distance]));
        let parts = composition(kind).iter().map(|(motion, _)| match motion {
            Motion::Prismatic => along(pitch * at),
            _ => Pose::rotation(turn_about(2, at, snap)),
        });
        let moved = parts.chain([Pose::identity()]);
        self.links.iter().zip(moved).fold(Pose::identity(), |pose, (link, moved)| pose * *link * moved)
            * self.body
    }
}

/// The largest cosine that is nothing but rounding.
const PARALLEL: f64 = 1e-12;

/// The frames of a joint's links, for an axis along z of the frame `at`; those that slide in a plane or in space take
/// x and y of it first.
fn frames_of_links<'g>(kind: JointKind, at: Pose<Expr<'g>>) -> Vec<Pose<Expr<'g>>> {
    // Its z is the x of the frame around it; three of them are none.
    let cycle = || {
        let columns = aligned(0, false).map(|column| column.map(Expr::Constant));
        Pose::rotation(Matrix3(columns).transpose())
    };
    match kind {
        JointKind::Planar | JointKind::Translation => vec![at * cycle(), cycle(), cycle()],
        _ => {
            let mut links = vec![Pose::identity(); composition(kind).len().max(1)];
            links[0] = at;
            links
        }
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
    let translation = values.vector_or_zero(joint.keys.at.as_ref())?;
    let rotation = match &joint.keys.rpy {
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
