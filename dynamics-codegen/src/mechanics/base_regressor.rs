//! The parameters that joint forces tell apart, and the regressor of these: `τ = Y_b(q,v,a)·π_b`.
//!
//! Mass that may belong to a parent is given to it ([`regroup`](super::regroup)); what is left of a link has columns of
//! its own. Behind two axes that are not parallel these are independent. Nearer to the base, where less can move,
//! some are zero whatever the motion is, and are left out; and some are combinations of others, which take up their
//! parameters. Combinations are found in doubles, at random states; what holds at one value of the robot's fields and
//! not at another is not taken for one. Shares that are no simple numbers are then solved for in all digits.
//!
//! M. Gautier, W. Khalil, *Direct calculation of minimum set of inertial parameters of serial robots*, 1990.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::method::Inputs;
use super::motion::accelerations;
use super::normal::{NormalTree, PlacedJoint};
use super::regressor::{Regressed, RegressorColumn};
use super::regroup::{Split, split};
use super::rnea::{Wrench, link_wrench};
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Random, Scalar, Symmetric3, Vector3};
use crate::symbolic::{Evaluator, Expr, Graph, Number, Real, SymbolId};

/// The columns of the base parameters; `is_body` says of each link whether it may have mass of its own.
pub fn base_columns<'g>(
    robot: &Regressed<'_, Expr<'g>>,
    is_body: &[bool],
    symbols: &Symbols<'_, 'g>,
) -> Vec<RegressorColumn<Expr<'g>>> {
    let (tree, [q, v, a]) = (robot.tree, robot.state);
    let placed = tree.place(q);
    let motion = accelerations(tree, &placed, v, a);
    let is_coupled = !robot.coupling.is_identity();
    let is_bound: Vec<bool> =
        (0..tree.links.len()).map(|link| is_coupled || !is_body[link] || is_bound(tree, link)).collect();
    let mut columns: Vec<(RegressorColumn<Expr<'g>>, bool)> = Vec::new();
    for (k, own) in grouped(tree, is_body).into_iter().enumerate() {
        for Portion { of, value, inertia } in own {
            let forces = forces_of(tree, &placed, k, link_wrench(&inertia, &motion[k]));
            let name = format!("{}.{of}", robot.joints[k]);
            let column = RegressorColumn { name, value, forces: robot.coupling.gather(forces) };
            columns.push((column, is_bound[k]));
        }
    }
    for (link, &is_bound) in is_bound.iter().enumerate() {
        columns.extend(robot.of_joint(link).into_iter().map(|column| (column, is_bound)));
    }
    independent(columns, symbols)
}

/// Whether a link moves so little that its parameters may be entangled with others: unless it turns about a point, or
/// what carries it does, or does so about two axes that are not parallel. The link at the second of these is bound yet:
/// where the axes are at right angles its rotor acts as moments of it and of the first link do. Of robots whose joints
/// follow others all links are bound, and of others those between the parts of joints.
fn is_bound<S: Scalar>(tree: &NormalTree<S>, last: usize) -> bool {
    let mut path: Vec<usize> = tree.path_to_base(last).collect();
    path.reverse();
    // From the last turning link's frame to the frame at hand.
    let mut since: Option<Matrix3<S>> = None;
    for k in path {
        let link = &tree.links[k];
        let rotation = since.map(|since| since * link.turn.matrix());
        match link.motion {
            Motion::Ball | Motion::Free => return false,
            Motion::Prismatic => {
                let offset = Matrix3::rotation_z(link.offset.cos, link.offset.sin);
                since = rotation.map(|rotation| rotation * offset);
            }
            Motion::Revolute => {
                let axis = rotation.map(|rotation| rotation.column(2).0);
                if axis.is_some_and(|[x, y, _]| !(x.is_zero() && y.is_zero())) {
                    return k == last;
                }
                since = Some(Matrix3::identity());
            }
        }
    }
    true
}

/// The most columns among which combinations are looked for. Robots with more that are bound have parallel axes
/// throughout or many followers.
const MOST_BOUND: usize = 100;
/// What is left of a column of length one when it is a combination of others.
const NOTHING: f64 = 1e-9;

/// The columns without those that are nothing or, of bound ones, combinations of those before them.
fn independent<'g>(
    columns: Vec<(RegressorColumn<Expr<'g>>, bool)>,
    symbols: &Symbols<'_, 'g>,
) -> Vec<RegressorColumn<Expr<'g>>> {
    let is_something = |column: &RegressorColumn<Expr<'g>>| column.forces.iter().any(|x| !x.is_zero());
    let (mut columns, is_bound): (Vec<_>, Vec<bool>) =
        columns.into_iter().filter(|(column, _)| is_something(column)).unzip();
    let bound: Vec<usize> = (0..columns.len()).filter(|&k| is_bound[k]).collect();
    if bound.len() > MOST_BOUND {
        return columns;
    }
    let forces: Vec<&[Expr<'g>]> = bound.iter().map(|&k| &*columns[k].forces).collect();
    let [found, again] = [1, 2].map(|set| combinations::<f64>(sampled(&forces, symbols, set)));
    let mut is_kept = vec![true; columns.len()];
    let mut taken = vec![];
    for (place, (shares, others)) in found.iter().zip(&again).enumerate() {
        let (Some(shares), Some(others)) = (shares, others) else { continue };
        if shares.iter().zip(others).any(|(one, other)| (one - other).abs() > 1e-6) {
            continue;
        }
        is_kept[bound[place]] = false;
        taken.push((bound[place], exact_shares(place, shares, &forces, symbols)));
    }
    for (from, shares) in taken {
        let taken = columns[from].clone();
        for (at, share) in shares {
            take_up(&mut columns[bound[at]], &taken, share);
        }
    }
    let mut is_kept = is_kept.into_iter();
    columns.retain(|_| is_kept.next().unwrap_or(true));
    columns
}

/// The shares in column `place` that are not zero, as exactly as numbers are, from those found in doubles.
///
/// Shares are made of the robot's constant angles, lengths and ratios. Near simple numbers they are these; otherwise the
/// combination, of a few columns now, is solved for again.
fn exact_shares<'g>(
    place: usize,
    shares: &[f64],
    columns: &[&[Expr<'g>]],
    symbols: &Symbols<'_, 'g>,
) -> Vec<(usize, Number)> {
    let simple =
        [(1, 1), (-1, 1), (1, 2), (-1, 2), (2, 1), (-2, 1)].map(|(num, den)| Number::ratio(num, den));
    let at_share = |share: f64| simple.into_iter().find(|x| (x.to_f64() - share).abs() < NOTHING);
    let parts: Vec<usize> = (0..shares.len()).filter(|&at| shares[at].abs() >= NOTHING).collect();
    let known: Option<Vec<Number>> = parts.iter().map(|&at| at_share(shares[at])).collect();
    let solved = || {
        let involved: Vec<&[Expr<'g>]> = parts.iter().chain([&place]).map(|&at| columns[at]).collect();
        let digits: Option<Vec<Number>> = combinations(sampled(&involved, symbols, 1)).pop().flatten();
        digits.unwrap_or_else(|| {
            parts.iter().map(|&at| Number::of_double(shares[at])).chain([Number::ZERO]).collect()
        })
    };
    parts.iter().copied().zip(known.unwrap_or_else(solved)).collect()
}

/// What the graph's symbols are, for states at random.
pub struct Symbols<'t, 'g> {
    /// Where they live.
    pub graph: &'g Graph,
    /// How many of each kind there are.
    pub inputs: Inputs,
    /// The coordinates that begin unit quaternions.
    pub quaternions: &'t [usize],
}

/// The forces of the columns at random states, one after another, and at the `set`-th values of the fields.
fn sampled<'g, R: Real>(columns: &[&[Expr<'g>]], symbols: &Symbols<'_, 'g>, set: u64) -> Vec<Vec<R>> {
    let Inputs { parameters, coordinates, dof } = symbols.inputs;
    let mut samples = vec![vec![]; columns.len()];
    let felt: Vec<usize> =
        (0..dof).filter(|&row| columns.iter().any(|forces| !forces[row].is_zero())).collect();
    // Joints of a tree of their own see as many numbers of a column as there are states.
    for state in 0..columns.len() + 4 {
        // Parameters come first among the symbols, and are the same in every state.
        let mut fields = Random(set);
        let mut values: Vec<R> = (0..parameters).map(|_| R::of_double(1.1 + 0.5 * fields.next())).collect();
        let mut random = Random(100 + state as u64);
        values.extend((0..coordinates + 3 * dof).map(|_| R::of_double(2.5 * random.next())));
        for at in symbols.quaternions {
            let quaternion = &mut values[parameters + at..][..4];
            let length = dot(quaternion, quaternion).sqrt();
            quaternion.iter_mut().for_each(|x| *x = *x / length);
        }
        let mut evaluator = Evaluator::new(symbols.graph, |symbol: SymbolId| values[symbol.0 as usize]);
        for (sample, forces) in samples.iter_mut().zip(columns) {
            sample.extend(felt.iter().map(|&row| evaluator.value(forces[row])));
        }
    }
    samples
}

/// For each vector that is a combination of those before it, the shares of all of them in it.
fn combinations<R: Real>(mut vectors: Vec<Vec<R>>) -> Vec<Option<Vec<R>>> {
    let units: Vec<R> = vectors.iter().map(|vector| unit_of(vector)).collect();
    for (vector, &unit) in vectors.iter_mut().zip(&units) {
        vector.iter_mut().for_each(|x| *x = *x / unit);
    }
    let in_units = |(shares, &unit): (Option<Vec<R>>, &R)| {
        Some(shares?.into_iter().zip(&units).map(|(share, &other)| share * unit / other).collect())
    };
    combinations_of_moderate(vectors).into_iter().zip(&units).map(in_units).collect()
}

/// One, or the largest magnitude where squares would be too large or too small for a double.
fn unit_of<R: Real>(vector: &[R]) -> R {
    let largest = vector.iter().map(|x| x.magnitude()).fold(R::from(0), R::larger);
    let [least, most] = [1e-100, 1e100].map(R::of_double);
    let is_moderate = |x: R| (x - least).is_positive() && (most - x).is_positive();
    if largest.is_zero() || is_moderate(largest) { R::from(1) } else { largest }
}

/// Gram–Schmidt, twice for what rounding leaves the first time; G. Golub, C. Van Loan 2013, ch. 5.2.
fn combinations_of_moderate<R: Real>(vectors: Vec<Vec<R>>) -> Vec<Option<Vec<R>>> {
    let subtract = |x: &mut [R], k: R, y: &[R]| x.iter_mut().zip(y).for_each(|(x, &y)| *x = *x - k * y);
    let n = vectors.len();
    // Orthonormal directions, and what each is made of.
    let mut basis: Vec<(Vec<R>, Vec<R>)> = vec![];
    let mut found = Vec::with_capacity(n);
    for (k, vector) in vectors.into_iter().enumerate() {
        let size = dot(&vector, &vector).sqrt();
        let (mut left, mut made_of) = (vector, vec![R::from(0); n]);
        made_of[k] = R::from(1);
        for _ in 0..2 {
            for (direction, parts) in &basis {
                let along = dot(&left, direction);
                subtract(&mut left, along, direction);
                subtract(&mut made_of, along, parts);
            }
        }
        let length = dot(&left, &left).sqrt();
        if (length - R::of_double(NOTHING) * size).is_positive() {
            [&mut left, &mut made_of].into_iter().flatten().for_each(|x| *x = *x / length);
            basis.push((left, made_of));
            found.push(None);
        } else {
            made_of[k] = R::from(0);
            found.push(Some(made_of.iter().map(|&share| -share).collect()));
        }
    }
    found
}

fn dot<R: Real>(x: &[R], y: &[R]) -> R {
    x.iter().zip(y).fold(R::from(0), |sum, (&x, &y)| sum + x * y)
}

/// Adds to a column's parameter its share in another that goes. Names have twelve digits of it.
fn take_up<'g>(column: &mut RegressorColumn<Expr<'g>>, taken: &RegressorColumn<Expr<'g>>, share: Number) {
    column.value = column.value + Expr::from(share) * taken.value;
    let sign = if share.is_negative() { "-" } else { "+" };
    let size: f64 = format!("{:.11e}", share.abs().to_f64()).parse().unwrap_or_default();
    let factor = if size == 1.0 { String::new() } else { format!("{size} ") };
    column.name = format!("{} {sign} {factor}{}", column.name, taken.name);
}

/// What the columns between a link and the base feel of a wrench on it.
fn forces_of<'g>(
    tree: &NormalTree<Expr<'g>>,
    placed: &[PlacedJoint<Expr<'g>>],
    link: usize,
    mut wrench: Wrench<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let mut forces = vec![Expr::ZERO; tree.columns.len()];
    for at in tree.path_to_base(link) {
        for column in tree.columns_of(at) {
            forces[column] = wrench.along(tree.columns[column].direction);
        }
        if tree.links[at].parent.is_some() {
            wrench = wrench.up(&placed[at]);
        }
    }
    forces
}

/// The moments of a link, by the names that base parameters have.
const MOMENTS: [&str; 10] = [
    "mass",
    "mass_x",
    "mass_y",
    "mass_z",
    "moment_xx",
    "moment_xy",
    "moment_yy",
    "moment_xz",
    "moment_yz",
    "moment_zz",
];

/// A mass on a link, as it is while a parameter is one, and the parameter.
#[derive(Clone, Copy)]
struct Portion<'g> {
    of: &'static str,
    value: Expr<'g>,
    inertia: PseudoInertia<Expr<'g>>,
}

/// For each link the masses that only it can have. Those of a body are its moments, each by itself; a link between the
/// parts of a joint has what comes of the parameters of what it carries, and no more.
fn grouped<'g>(tree: &NormalTree<Expr<'g>>, is_body: &[bool]) -> Vec<Vec<Portion<'g>>> {
    let full = |inertia: &PseudoInertia<Expr<'g>>| -> Vec<Portion<'g>> {
        let portion = |k: usize| Portion { of: MOMENTS[k], value: entry(inertia, k), inertia: unit(k) };
        (0..MOMENTS.len()).map(portion).collect()
    };
    let mut portions: Vec<Vec<Portion<'g>>> = (tree.links.iter().zip(is_body))
        .map(|(link, &is_body)| if is_body { full(&link.inertia) } else { vec![] })
        .collect();
    for k in (0..tree.links.len()).rev() {
        let link = &tree.links[k];
        for portion in std::mem::take(&mut portions[k]) {
            let Split { stays, goes } = split(link, portion.inertia);
            match link.parent {
                Some(parent) if is_body[parent] => {
                    for (moment, known) in portions[parent].iter_mut().enumerate() {
                        known.value = known.value + portion.value * entry(&goes, moment);
                    }
                }
                Some(parent) if !is_nothing(&goes) => {
                    portions[parent].push(Portion { inertia: goes, ..portion });
                }
                _ => {}
            }
            if !is_nothing(&stays) {
                portions[k].push(Portion { inertia: stays, ..portion });
            }
        }
    }
    portions
}

fn is_nothing<S: Scalar>(inertia: &PseudoInertia<S>) -> bool {
    (0..MOMENTS.len()).all(|moment| entry(inertia, moment).is_zero())
}

fn entry<S: Scalar>(inertia: &PseudoInertia<S>, moment: usize) -> S {
    let (PseudoInertia { mass, second, .. }, [x, y, z]) = (*inertia, inertia.first.0);
    [mass, x, y, z, second.xx, second.xy, second.yy, second.xz, second.yz, second.zz][moment]
}

fn unit<S: Scalar>(moment: usize) -> PseudoInertia<S> {
    let entry = |k: usize| if k == moment { S::one() } else { S::zero() };
    PseudoInertia {
        mass: entry(0),
        first: Vector3([entry(1), entry(2), entry(3)]),
        second: Symmetric3 {
            xx: entry(4),
            xy: entry(5),
            yy: entry(6),
            xz: entry(7),
            yz: entry(8),
            zz: entry(9),
        },
    }
}
