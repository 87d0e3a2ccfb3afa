//! The hidden solver against nalgebra, on a chain and on a branched tree.
#![cfg(feature = "std")]

#[cfg(feature = "simd")]
use dynamics_core::__private::columns;
use dynamics_core::__private::{EliminationTree, Factors, forward_from_inverse, inverse_of};
use dynamics_core::InverseDynamicsDerivatives;
#[cfg(feature = "simd")]
use dynamics_core::lanes::{Lanes, f64x2, f64x4, f64x8};
use dynamics_core::nalgebra::SMatrix;

#[cfg(feature = "simd")]
use crate::common::{bits_of_lane, in_lanes_of};

/// A few roundings of numbers of the size of one, times a condition of some hundred.
const TOLERANCE: f64 = 1e-12;

const CHAIN: [Option<usize>; 5] = [None, Some(0), Some(1), Some(2), Some(3)];
const TREE: [Option<usize>; 7] = [None, Some(0), Some(1), Some(0), Some(3), Some(4), Some(3)];

/// Longer than a strip of lanes, and than a whole number of them.
const LONG: [Option<usize>; 21] = [
    None,
    Some(0),
    Some(1),
    Some(2),
    Some(0),
    Some(4),
    Some(5),
    None,
    Some(7),
    Some(8),
    Some(9),
    Some(10),
    Some(11),
    Some(7),
    Some(13),
    Some(14),
    None,
    Some(16),
    Some(17),
    Some(18),
    Some(19),
];
/// As many as are solved six at a time.
const SIX: [Option<usize>; 6] = [None, Some(0), Some(0), Some(2), None, Some(4)];

fn random_numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    }
}

/// A positive definite matrix with the sparsity of a tree: `Lᵀ D L`.
fn mass_matrix<const N: usize>(
    parents: &[Option<usize>; N],
    random: &mut impl FnMut() -> f64,
) -> SMatrix<f64, N, N> {
    let mut l = SMatrix::<f64, N, N>::identity();
    let mut d = SMatrix::<f64, N, N>::zeros();
    for i in 0..N {
        d[(i, i)] = random() + 1.0;
        for j in std::iter::successors(parents[i], |&k| parents[k]) {
            l[(i, j)] = random();
        }
    }
    l.transpose() * d * l
}

/// The factors, and the inverse.
fn inverted<const N: usize>(
    mut m: [[f64; N]; N],
    tree: &'static EliminationTree<N>,
) -> (Factors<f64, N>, [[f64; N]; N]) {
    let mut factors = Factors::new(tree);
    factors.invert(&mut m);
    (factors, m)
}

fn agrees<const N: usize>(parents: &[Option<usize>; N], tree: &'static EliminationTree<N>) {
    solves_for_one(parents, tree);
    #[cfg(feature = "simd")]
    {
        each_lane_has_the_bits_of_one::<f64x2, N>(parents, tree);
        each_lane_has_the_bits_of_one::<f64x4, N>(parents, tree);
        each_lane_has_the_bits_of_one::<f64x8, N>(parents, tree);
    }
}

fn solves_for_one<const N: usize>(parents: &[Option<usize>; N], tree: &'static EliminationTree<N>) {
    let mut random = random_numbers(N as u64);
    let m = mass_matrix(parents, &mut random);
    let mut matrix = || SMatrix::<f64, N, N>::from_fn(|_, _| random());
    let (factors, inverse) = inverted(m.data.0, tree);
    let inverse = InverseDynamicsDerivatives {
        dtau_dq: matrix(),
        dtau_dv: matrix(),
        dtau_da: SMatrix::from_fn(|i, j| inverse[j][i]),
    };
    let forward = forward_from_inverse(&inverse, &factors);
    assert!((m * forward.da_dq + inverse.dtau_dq).amax() < TOLERANCE);
    assert!((m * forward.da_dv + inverse.dtau_dv).amax() < TOLERANCE);
    assert!((m * forward.da_dtau - SMatrix::identity()).amax() < TOLERANCE);
    assert_eq!(forward.da_dtau, forward.da_dtau.transpose());
    assert_eq!(inverse_of(m, tree), forward.da_dtau);
}

/// Of a plane chain of N equal points, whose condition grows as N⁴, and forces that cause accelerations of one size: what is
/// solved for leaves the roundings of its sums, a product with the inverse a thousand times as much.
#[test]
fn what_is_solved_leaves_no_more_than_roundings() {
    const N: usize = 52;
    const TREE: EliminationTree<N> = EliminationTree::CHAIN;
    /// Of ‖M‖·‖X‖: two sums of N terms, each of which rounds by up to ε/2.
    const RESIDUAL: f64 = N as f64 * f64::EPSILON;
    // Where the joints are, and behind each the point of its link.
    let mut places = [[0.0_f64; 2]; N + 1];
    let mut angle = 0.0;
    for k in 0..N {
        angle += 0.1 * (k as f64).sin();
        places[k + 1] = [places[k][0] + f64::cos(angle), places[k][1] + f64::sin(angle)];
    }
    let m = SMatrix::<f64, N, N>::from_fn(|i, j| {
        let arm = |k: usize, from: usize| [0, 1].map(|axis| places[k][axis] - places[from][axis]);
        let of_point = |k: usize| {
            let ([a, b], [c, d]) = (arm(k, i), arm(k, j));
            a * c + b * d
        };
        (i.max(j) + 1..=N).map(of_point).sum()
    });
    let mut random = random_numbers(N as u64);
    let b = m * SMatrix::<f64, N, N>::from_fn(|_, _| random());
    let (factors, inverse) = inverted(m.data.0, &TREE);
    let inverse = SMatrix::<f64, N, N>::from_fn(|i, j| inverse[j][i]);
    let derivatives = InverseDynamicsDerivatives { dtau_dq: b, dtau_dv: b, dtau_da: inverse };
    let residual = |x: SMatrix<f64, N, N>| (m * x + b).norm() / (m.norm() * x.norm());
    let (solved, product) =
        (residual(forward_from_inverse(&derivatives, &factors).da_dq), residual(-inverse * b));
    assert!(solved < RESIDUAL, "{solved:e}");
    assert!(product > 1e3 * solved, "a product would do: {product:e}, and {solved:e}");
}

/// Several matrices as one, of whose scalar rows and columns are taken otherwise. In the last one there are numbers that
/// are not finite.
#[cfg(feature = "simd")]
fn each_lane_has_the_bits_of_one<L: Lanes<Element = f64>, const N: usize>(
    parents: &[Option<usize>; N],
    tree: &'static EliminationTree<N>,
) {
    let mut random = random_numbers(N as u64 + 1);
    let m: Vec<_> = (0..L::COUNT).map(|_| mass_matrix(parents, &mut random)).collect();
    let mut b: Vec<_> = m.iter().map(|_| SMatrix::<f64, N, N>::from_fn(|_, _| random())).collect();
    if let Some(last) = b.last_mut() {
        last[N / 2] = f64::NAN;
        last[N * N - 1 - N / 3] = f64::INFINITY;
    }
    let mut wide = Factors::new(tree);
    let mut inverse = in_lanes_of::<L, N, N>(&m).data.0;
    wide.invert(&mut inverse);
    let solved = wide.minus_solved(&in_lanes_of::<L, N, N>(&b).data.0);
    for (lane, (m, b)) in m.iter().zip(&b).enumerate() {
        let (factors, expected) = inverted(m.data.0, tree);
        let check = |found: [[L; N]; N], expected: [[f64; N]; N]| {
            let expected = columns(expected).map(f64::to_bits);
            let text = |x: SMatrix<u64, N, N>| format!("{:?}", x.map(f64::from_bits)); // in which NaN equals NaN
            assert_eq!(text(bits_of_lane(&columns(found), lane)), text(expected));
        };
        check(solved, factors.minus_solved(&b.data.0));
        check(inverse, expected);
    }
    let inverses = inverse_of(in_lanes_of::<L, N, N>(&m), tree);
    for (lane, m) in m.iter().enumerate() {
        assert_eq!(bits_of_lane(&inverses, lane), inverse_of(*m, tree).map(f64::to_bits));
    }
}

#[test]
fn solves_what_nalgebra_multiplies() {
    agrees(&CHAIN, const { &EliminationTree::of(CHAIN) });
    agrees(&TREE, const { &EliminationTree::of(TREE) });
    agrees(&[None], const { &EliminationTree::of([None]) });
    agrees(&SIX, const { &EliminationTree::of(SIX) });
    agrees(&LONG, const { &EliminationTree::of(LONG) });
}

/// Rows and columns of every number beyond whole strips. Where the scalar is lanes of states all goes by four, and any four
/// lengths in a row are all that there are.
#[test]
fn chains_of_every_length_are_solved() {
    fn parents<const N: usize>() -> [Option<usize>; N] {
        core::array::from_fn(|k| k.checked_sub(1))
    }
    fn chain<const N: usize>() {
        solves_for_one(&parents(), const { &EliminationTree::<N>::CHAIN });
    }
    #[cfg(feature = "simd")]
    fn lanes<const N: usize>() {
        each_lane_has_the_bits_of_one::<f64x4, N>(&parents(), const { &EliminationTree::CHAIN });
    }
    #[cfg(feature = "simd")]
    {
        lanes::<8>();
        lanes::<9>();
        lanes::<10>();
        lanes::<11>();
    }
    chain::<8>();
    chain::<9>();
    chain::<10>();
    chain::<11>();
    chain::<12>();
    chain::<13>();
    chain::<14>();
    chain::<15>();
    chain::<18>();
    chain::<23>();
}

#[test]
fn where_nothing_need_be_zero_any_matrix_will_do() {
    agrees(&TREE, const { &EliminationTree::CHAIN });
    agrees(&LONG, const { &EliminationTree::CHAIN });
}

#[test]
fn what_lies_above_the_diagonal_is_not_read() {
    let clean = mass_matrix(&TREE, &mut random_numbers(3)).transpose().data.0;
    let mut rows = clean;
    for (i, row) in rows.iter_mut().enumerate() {
        row[..i].fill(f64::NAN);
    }
    let solved = |m: &[[f64; 7]; 7]| {
        let (factors, inverse) = inverted(*m, const { &EliminationTree::of(TREE) });
        (factors.minus_solved(&[[1.0; 7], [2.0; 7]]), inverse)
    };
    assert_eq!(solved(&rows), solved(&clean));
    assert!(solved(&rows).1.as_flattened().iter().all(|x| x.is_finite()));
}

#[test]
fn nothing_to_solve_is_no_error() {
    let no_columns: [[f64; 7]; 0] = [];
    assert_eq!(
        inverted([[1.0; 7]; 7], const { &EliminationTree::CHAIN }).0.minus_solved(&no_columns),
        no_columns
    );
    let empty: [[f64; 0]; 3] = [[]; 3];
    assert_eq!(inverted([], const { &EliminationTree::CHAIN }).0.minus_solved(&empty), empty);
}
