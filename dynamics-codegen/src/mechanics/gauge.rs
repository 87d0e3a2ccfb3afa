//! From the frames that a user gives to frames in which little is not zero.
//!
//! A link's frame may be turned about and shifted along its joint's axis without any change of meaning. So x
//! is laid along the common normal to the next axis (the first child's, at a branch) and the origin at its
//! foot; offsets along axes that are parallel, or so nearly that the foot would be far away, are merged; the last link takes up its parent's x. The base frame is the
//! first joint's. Where a rotation depends on parameters the given frame stays.
//!
//! W. Khalil, E. Dombre, *Modeling, Identification and Control of Robots*, 2002, ch. 3.

use super::columns::columns;
use super::normal::{NormalFrame, NormalLink, NormalTree};
use super::rotation::{PlanarTurn, Turn};
use crate::model::{Drive, Motion, Tree};
use crate::spatial::{Matrix3, Pose, PseudoInertia, Vector3};
use crate::symbolic::{Expr, Number};

/// The tree with its frames chosen anew; the masses are what they were.
pub fn regauge<'g>(tree: &Tree<Expr<'g>>) -> NormalTree<Expr<'g>> {
    let mut changes: Vec<Change<'g>> = Vec::with_capacity(tree.links.len());
    let mut links = Vec::with_capacity(tree.links.len());
    let (base, base_in_first) = base_frame(tree);
    for (k, link) in tree.links.iter().enumerate() {
        let joint = match link.parent {
            None if k == 0 => base_in_first.inverse(),
            None => base.inverse() * link.placement,
            Some(parent) => changes[parent].pose().inverse() * link.placement,
        };
        let joint = tidy(joint);
        let change = Change::of_link(tree, k, joint);
        links.push(normal_link(tree, k, joint, change));
        changes.push(change);
    }
    let frames = tree.frames.iter().map(|frame| NormalFrame {
        name: frame.name.clone(),
        link: frame.link,
        pose: match frame.link {
            Some(link) => tidy(changes[link].pose().inverse() * frame.pose),
            None => frame.pose,
        },
    });
    NormalTree {
        frames: frames.collect(),
        base,
        at_rest: tree.base.transformed(base.inverse()),
        gravity: tidy_vector(base.rotation.transpose() * tree.gravity),
        columns: columns(tree.links.iter().map(|link| (link.parent, link.motion, link.drive))),
        links,
    }
}

/// A link's new frame in its old one: a turn about z and a shift along z.
#[derive(Clone, Copy)]
struct Change<'g> {
    turn: PlanarTurn<Expr<'g>>,
    shift: Expr<'g>,
}

impl<'g> Change<'g> {
    const NONE: Self = Self { turn: PlanarTurn { cos: Expr::ONE, sin: Expr::ZERO }, shift: Expr::ZERO };

    fn pose(self) -> Pose<Expr<'g>> {
        Pose {
            rotation: Matrix3::rotation_z(self.turn.cos, self.turn.sin),
            translation: Vector3::new(Expr::ZERO, Expr::ZERO, self.shift),
        }
    }

    /// The change for link `k`, whose joint has the pose `joint` in its parent's new frame.
    fn of_link(tree: &Tree<Expr<'g>>, k: usize, joint: Pose<Expr<'g>>) -> Self {
        if matches!(tree.links[k].motion, Motion::Ball | Motion::Free) {
            return Self::NONE;
        }
        let child = tree.links.iter().find(|link| link.parent == Some(k));
        let Some(child) = child else { return Self::free(joint) };
        let axis = tidy_vector(child.placement.rotation.column(2));
        let Some([x, y, z]) = constants(axis) else { return Self::NONE };
        let origin = child.placement.translation;
        if matches!(child.motion, Motion::Ball | Motion::Free) {
            // There is no axis beyond: the origin goes where the joint's centre is nearest.
            return Self { shift: origin.0[2], ..Self::to_parallel_axis(origin, Self::free(joint)) };
        }
        if (x * x + y * y).cmp_value(nearly_parallel()).is_lt() {
            return Self::to_parallel_axis(origin, Self::free(joint));
        }
        let to_foot = Self::to_common_normal(origin, [x, y, z]);
        if is_far(to_foot.shift, origin) {
            Self::to_parallel_axis(origin, Self::free(joint))
        } else {
            to_foot
        }
    }

    /// The change if nothing demands one: no turn against the parent and no offset along the axis.
    fn free(joint: Pose<Expr<'g>>) -> Self {
        let turn = match decompose(joint.rotation) {
            Some((_, beta)) => beta.inverse(),
            None => PlanarTurn::identity(),
        };
        Self { turn, shift: -joint.rotation.column(2).dot(joint.translation) }
    }

    /// x towards the next axis, which is parallel or nearly so.
    fn to_parallel_axis(origin: Vector3<Expr<'g>>, free: Self) -> Self {
        let [x, y, _] = origin.0;
        let turn = match (x.is_zero(), y.is_zero()) {
            (true, true) => free.turn,
            (false, true) => PlanarTurn::identity().plus_quarters(if x.is_negative() { 2 } else { 0 }),
            (true, false) => PlanarTurn::identity().plus_quarters(if y.is_negative() { 3 } else { 1 }),
            (false, false) => match (x.as_number(), y.as_number()) {
                (Some(x), Some(y)) => direction(x, y),
                _ => PlanarTurn::identity(),
            },
        };
        Self { turn, ..free }
    }

    /// x along the common normal to the next axis, the origin at its foot.
    fn to_common_normal(origin: Vector3<Expr<'g>>, [x, y, z]: [Number; 3]) -> Self {
        let [ox, oy, oz] = origin.0;
        let (ex, ey, ez) = (Expr::from(x), Expr::from(y), Expr::from(z));
        let along = -(ox * ex + oy * ey) / (ex * ex + ey * ey);
        let normal = direction(-y, x);
        let distance = normal.cos * ox + normal.sin * oy;
        let turn = if distance.is_negative() { normal.plus_quarters(2) } else { normal };
        Self { turn, shift: oz + along * ez }
    }
}

fn normal_link<'g>(
    tree: &Tree<Expr<'g>>,
    k: usize,
    joint: Pose<Expr<'g>>,
    change: Change<'g>,
) -> NormalLink<Expr<'g>> {
    let link = &tree.links[k];
    let keeps_frame = matches!(link.motion, Motion::Ball | Motion::Free);
    let (turn, beta) = match decompose(joint.rotation) {
        Some((turn, beta)) if !keeps_frame => (turn, beta),
        _ => (Turn::General(joint.rotation), PlanarTurn::identity()),
    };
    let inertia = link.inertia.transformed(change.pose().inverse());
    let Drive { q, v, ratio, offset } = link.drive;
    let (angle, distance) = match link.motion {
        Motion::Prismatic => (PlanarTurn::identity(), offset),
        _ => (PlanarTurn::of_angle(offset), Expr::ZERO),
    };
    NormalLink {
        parent: link.parent,
        motion: link.motion,
        drive: Drive { q, v, ratio, offset },
        passive: link.passive,
        turn,
        about_z: None,
        offset: tidy_turn(beta.then(change.turn).then(angle)),
        position: tidy_vector(joint.translation + joint.rotation.column(2).scale(change.shift + distance)),
        inertia: tidy_inertia(inertia),
    }
}

/// The base frame: the first joint's own, shifted and turned as its link's frame is, so that the first turn
/// and the first offset vanish. A turn by an odd angle stays with the joint: it would tilt gravity.
///
/// Returns its pose in the world and in the first joint's frame.
fn base_frame<'g>(tree: &Tree<Expr<'g>>) -> (Pose<Expr<'g>>, Pose<Expr<'g>>) {
    let Some(first) = tree.links.first() else { return (Pose::identity(), Pose::identity()) };
    let change = Change::of_link(tree, 0, Pose::identity());
    let turn = if change.turn.quarters().is_some() { change.turn } else { PlanarTurn::identity() };
    let in_first = Change { turn, ..change }.pose();
    (tidy(first.placement * in_first), in_first)
}

/// `R = Rz(γ)·Rx(α)·Rz(β)` of a constant rotation, with `γ = 0` where that is possible.
///
/// `γ` and `α` are read off the last column. `β` stands in the first row of `Rz(γ)ᵀR`, whatever `α` is: the last
/// row would divide by its sine, and a rotation that was snapped is orthogonal to some eleven digits only.
fn decompose<'g>(rotation: Matrix3<Expr<'g>>) -> Option<(Turn<Expr<'g>>, PlanarTurn<Expr<'g>>)> {
    let mut entries = [[Number::ZERO; 3]; 3];
    for (row, exprs) in entries.iter_mut().zip(rotation.0) {
        for (entry, expr) in row.iter_mut().zip(exprs) {
            *entry = expr.as_number()?;
        }
    }
    let [[r00, r01, r02], [r10, r11, r12], [_, _, r22]] = entries;
    let (gamma, sin_alpha) = if r02.is_zero() {
        ((Number::ONE, Number::ZERO), -r12)
    } else {
        let sin = (r02 * r02 + r12 * r12).sqrt().expect("a sum of squares");
        let quotient = |x: Number| x.checked_div(sin).expect("r02 is not zero in this branch");
        ((quotient(-r12), quotient(r02)), sin)
    };
    let (cos, sin) = gamma;
    let beta = direction(cos * r00 + sin * r10, -(cos * r01 + sin * r11));
    Some((Turn::Planar { gamma: turn(cos, sin), alpha: direction(r22, sin_alpha) }, beta))
}

fn turn<'g>(cos: Number, sin: Number) -> PlanarTurn<Expr<'g>> {
    PlanarTurn { cos: tidy_number(cos).into(), sin: tidy_number(sin).into() }
}

/// The unit vector along `(x, y)`, as a turn.
fn direction<'g>(x: Number, y: Number) -> PlanarTurn<Expr<'g>> {
    let length = if x.is_zero() {
        y.abs()
    } else if y.is_zero() {
        x.abs()
    } else {
        (x * x + y * y).sqrt().expect("a sum of squares")
    };
    let quotient = |x: Number| x.checked_div(length).expect("a direction is not the zero vector");
    turn(quotient(x), quotient(y))
}

/// The square of the sine below which axes count as parallel. The foot of their common normal is further away
/// than the links are long by the inverse of the sine, and forces computed there lose as many digits.
fn nearly_parallel() -> Number {
    Number::ratio(1, 100)
}

/// Whether the foot of the common normal is so much further away than the next joint that more is lost by its distance
/// than is won by its zeros.
fn is_far(shift: Expr<'_>, origin: Vector3<Expr<'_>>) -> bool {
    let (Some(shift), Some([x, y, z])) = (shift.as_number(), constants(origin)) else { return false };
    (Number::integer(9) * (x * x + y * y + z * z)).cmp_value(shift * shift).is_lt()
}

fn constants(v: Vector3<Expr<'_>>) -> Option<[Number; 3]> {
    let [x, y, z] = v.0;
    Some([x.as_number()?, y.as_number()?, z.as_number()?])
}

/// Rounding noise of a hundred-bit float taken out of an entry of a rotation.
fn tidy_number(value: Number) -> Number {
    let noise = Number::ratio(1, 1_000_000_000_000_000_000) * Number::ratio(1, 10_000_000);
    let near = |target: Number| (value - target).abs().cmp_value(noise).is_lt();
    [Number::ZERO, Number::ONE, -Number::ONE].into_iter().find(|&target| near(target)).unwrap_or(value)
}

fn tidy_expr(value: Expr<'_>) -> Expr<'_> {
    value.as_number().map_or(value, |value| tidy_number(value).into())
}

fn tidy_turn(turn: PlanarTurn<Expr<'_>>) -> PlanarTurn<Expr<'_>> {
    PlanarTurn { cos: tidy_expr(turn.cos), sin: tidy_expr(turn.sin) }
}

fn tidy_vector(v: Vector3<Expr<'_>>) -> Vector3<Expr<'_>> {
    v.map(tidy_expr)
}

fn tidy(pose: Pose<Expr<'_>>) -> Pose<Expr<'_>> {
    pose.map(tidy_expr)
}

fn tidy_inertia(inertia: PseudoInertia<Expr<'_>>) -> PseudoInertia<Expr<'_>> {
    inertia.map(tidy_expr)
}
