//! Random robots, as the recursion sees them and as the point masses that they are made of.

use dynamics_core::__private::recursion::{Drive, Friction, Joint, Link, Masses, Passive, Tree};
use dynamics_core::nalgebra::{Matrix3, Quaternion, Rotation3, Vector3};
use dynamics_core::prelude::*;

use crate::common::dual::{Dual, moving};
use crate::common::{random_numbers, random_vector};

/// A robot as the recursion sees it, and as the point masses it is made of.
pub(crate) struct Robot<const NL: usize, const NQ: usize, const NV: usize> {
    pub(crate) tree: Tree<f64, NL, NQ, NV>,
    points: Vec<(Option<usize>, f64, Vector3<f64>)>,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Chain,
    Branched,
    /// As branched; the coordinates and speeds of the last link come first.
    Backwards,
}

pub(crate) fn rows(m: &Matrix3<f64>) -> [[f64; 3]; 3] {
    m.transpose().data.0
}

pub(crate) fn by_rows<T: Scalar>(rows: [[T; 3]; 3]) -> SMatrix<T, 3, 3> {
    SMatrix::<T, 3, 3>::from(rows).transpose()
}

pub(crate) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A joint that moves as its coordinate does.
pub(crate) fn drive(index: usize) -> Drive<f64> {
    Drive { q: index, v: index, ratio: 1.0, offset: 0.0 }
}

/// A joint that does nothing by itself.
pub(crate) const INERT: Passive<f64> =
    Passive { armature: 0.0, damping: 0.0, friction: None, stiffness: 0.0, rest: 0.0 };

/// A link in its parent's place, without mass.
pub(crate) fn bare(parent: Option<usize>, joint: Joint<f64>) -> Link<f64> {
    Link { parent, joint, rotation: AXES, position: [0.0; 3] }
}

/// No mass anywhere.
pub(crate) const fn massless<const NL: usize>() -> Masses<f64, NL> {
    Masses { mass: [0.0; NL], first: [[0.0; NL]; 3], second: [[0.0; NL]; 6] }
}

impl<const NL: usize, const NQ: usize, const NV: usize> Robot<NL, NQ, NV> {
    /// Oblique joints, six point masses on each link that has mass, two in the world.
    ///
    /// A letter for each link, again and again: Revolute, Prismatic, Ball, Free; `u`, `p` as R, P without mass,
    /// the next link hangs on them; `f`, `s` turning and sliding by the drive of the link before.
    pub(crate) fn random(joints: &str, shape: Shape, seed: u64) -> Self {
        let mut random = random_numbers(seed);
        let mut points = Vec::new();
        let mut add_points = |owner, count, random: &mut dyn FnMut() -> f64| {
            for _ in 0..count {
                points.push((owner, 0.3 + 0.2 * random(), Vector3::from_fn(|_, _| 0.4 * random())));
            }
        };
        add_points(None, 2, &mut random);
        let letters: Vec<char> = joints.chars().cycle().take(NL).collect();
        let drives = Drives::new(&letters, shape, [NQ, NV]);
        let links = core::array::from_fn(|k| {
            let massless = "up".contains(letters[k]);
            add_points(Some(k), if massless { 0 } else { 6 }, &mut random);
            let carried = k > 0 && "up".contains(letters[k - 1]);
            let back = match shape {
                Shape::Branched | Shape::Backwards if !carried => 1 + (2.0 * (random() + 1.0)) as usize,
                _ => 1,
            };
            let [roll, pitch, yaw]: [f64; 3] = core::array::from_fn(|_| 3.0 * random());
            Link {
                rotation: rows(Rotation3::from_euler_angles(roll, pitch, yaw).matrix()),
                position: core::array::from_fn(|_| 0.3 * random()),
                ..bare(k.checked_sub(back), drives.joint(k, &letters, &mut random))
            }
        });
        let gravity = [0.7, -0.4, -9.81];
        let mut tree = Tree { links, masses: massless(), base_mass: 0.0, base_first: [0.0; 3], gravity };
        for &(owner, m, r) in &points {
            tree.add_point(owner, m, r);
        }
        Self { tree, points }
    }

    /// Coordinates of the given size, quaternions of unit length.
    pub(crate) fn random_coordinates(&self, random: &mut impl FnMut() -> f64, size: f64) -> SVector<f64, NQ> {
        let mut q = random_vector(random, size);
        for [x, y, z, w] in self.quaternions() {
            let length = [x, y, z, w].iter().map(|&i| q[i] * q[i]).sum::<f64>().sqrt();
            [x, y, z, w].iter().for_each(|&i| q[i] /= length);
        }
        q
    }

    fn quaternions(&self) -> impl Iterator<Item = [usize; 4]> {
        self.tree.links.iter().filter_map(|link| match link.joint {
            Joint::Ball { q, .. } => Some([q, q + 1, q + 2, q + 3]),
            Joint::Free { q, .. } => Some([q + 3, q + 4, q + 5, q + 6]),
            Joint::Revolute(..) | Joint::Prismatic(..) => None,
        })
    }

    /// `q ⊕ v·ε`: how the coordinates move at the speeds `v`.
    pub(crate) fn flow(&self, q: &SVector<f64, NQ>, v: &SVector<f64, NV>) -> SVector<Dual, NQ> {
        let mut rate = SVector::zeros();
        let turn = |rate: &mut SVector<f64, NQ>, at: usize, v_at: usize| {
            let quaternion = Quaternion::from(q.fixed_rows::<4>(at).into_owned());
            let w = Quaternion::from_imag(v.fixed_rows::<3>(v_at).into_owned());
            rate.fixed_rows_mut::<4>(at).copy_from(&(quaternion * w * 0.5).coords);
        };
        for link in &self.tree.links {
            match link.joint {
                Joint::Revolute(drive, _) | Joint::Prismatic(drive, _) => rate[drive.q] = v[drive.v],
                Joint::Ball { q: at, v } => turn(&mut rate, at, v),
                Joint::Free { q: at, v: v_at } => {
                    let turned = turned_by(q.fixed_rows::<4>(at + 3).into_owned().data.0[0]);
                    rate.fixed_rows_mut::<3>(at).copy_from(&(turned * v.fixed_rows::<3>(v_at)));
                    turn(&mut rate, at + 3, v_at + 3);
                }
            }
        }
        moving(q, &rate)
    }

    /// The joints of one degree of freedom.
    pub(crate) fn driven(&self) -> impl Iterator<Item = (Drive<f64>, Passive<f64>)> {
        self.tree.links.iter().filter_map(|link| match link.joint {
            Joint::Revolute(drive, passive) | Joint::Prismatic(drive, passive) => Some((drive, passive)),
            Joint::Ball { .. } | Joint::Free { .. } => None,
        })
    }

    /// How the fields of two speeds fail to commute: by the brackets of rotations and of rigid motions.
    pub(crate) fn bracket(&self, x: &SVector<f64, NV>, y: &SVector<f64, NV>) -> SVector<f64, NV> {
        let mut bracket = SVector::<f64, NV>::zeros();
        let at = |x: &SVector<f64, NV>, v: usize| x.fixed_rows::<3>(v).into_owned();
        for link in &self.tree.links {
            match link.joint {
                Joint::Revolute(..) | Joint::Prismatic(..) => {}
                Joint::Ball { v, .. } => {
                    bracket.fixed_rows_mut::<3>(v).copy_from(&at(x, v).cross(&at(y, v)));
                }
                Joint::Free { v, .. } => {
                    let ([x, w], [y, u]) = ([at(x, v), at(x, v + 3)], [at(y, v), at(y, v + 3)]);
                    bracket.fixed_rows_mut::<3>(v).copy_from(&(w.cross(&y) + x.cross(&u)));
                    bracket.fixed_rows_mut::<3>(v + 3).copy_from(&w.cross(&u));
                }
            }
        }
        bracket
    }

    /// Where each point mass of the moving links is, or of the world.
    pub(crate) fn positions<T: Scalar>(
        &self,
        q: &SVector<T, NQ>,
        moving: bool,
    ) -> impl Iterator<Item = (f64, SVector<T, 3>)> {
        let poses = self.poses(q);
        let points = self.points.iter().filter(move |(owner, ..)| owner.is_some() == moving);
        points.map(move |(owner, m, r)| {
            let pose = owner.map_or(Pose::identity(), |owner| poses[owner]);
            (*m, pose.transform_point(&r.map(T::of)))
        })
    }

    fn poses<T: Scalar>(&self, q: &SVector<T, NQ>) -> Vec<Pose<T>> {
        let mut poses: Vec<Pose<T>> = Vec::new();
        for link in &self.tree.links {
            let parent = link.parent.map_or(Pose::identity(), |parent| poses[parent]);
            let (rotation, position) = (by_rows(link.rotation), Vector3::from(link.position));
            let fixed = Pose { rotation: rotation.map(T::of), translation: position.map(T::of) };
            poses.push(parent * fixed * pose_of_joint(&link.joint, q));
        }
        poses
    }
}

fn position<T: Scalar, const NQ: usize>(drive: &Drive<f64>, q: &SVector<T, NQ>) -> T {
    T::of(drive.ratio) * q[drive.q] + T::of(drive.offset)
}

fn pose_of_joint<T: Scalar, const NQ: usize>(joint: &Joint<f64>, q: &SVector<T, NQ>) -> Pose<T> {
    let (o, i) = (T::zero(), T::one());
    match joint {
        Joint::Revolute(drive, _) => {
            let (s, c) = position(drive, q).sin_cos();
            Pose { rotation: by_rows([[c, -s, o], [s, c, o], [o, o, i]]), ..Pose::identity() }
        }
        Joint::Prismatic(drive, _) => {
            Pose { translation: [o, o, position(drive, q)].into(), ..Pose::identity() }
        }
        Joint::Ball { q: at, .. } => {
            Pose { rotation: turned_by(core::array::from_fn(|i| q[at + i])), ..Pose::identity() }
        }
        Joint::Free { q: at, .. } => Pose {
            rotation: turned_by(core::array::from_fn(|i| q[at + 3 + i])),
            translation: SVector::from_fn(|i, _| q[at + i]),
        },
    }
}

/// The rotation `r + 2 w u × r + 2 u × (u × r)` of a unit quaternion `(u, w)`.
fn turned_by<T: Scalar>([x, y, z, w]: [T; 4]) -> SMatrix<T, 3, 3> {
    let o = T::zero();
    let cross = by_rows([[o, -z, y], [z, o, -x], [-y, x, o]]);
    let product = |a: &SMatrix<T, 3, 3>, b: &SMatrix<T, 3, 3>| {
        SMatrix::<T, 3, 3>::from_fn(|i, j| (0..3).fold(o, |sum, k| sum + a[(i, k)] * b[(k, j)]))
    };
    SMatrix::identity() + (cross.map(|x| x * w) + product(&cross, &cross)).map(|x| x + x)
}

/// Which coordinates and speeds belong to which link.
struct Drives(Vec<[usize; 2]>);

impl Drives {
    fn new(letters: &[char], shape: Shape, ends: [usize; 2]) -> Self {
        let mut next = [0, 0];
        let mut firsts: Vec<[usize; 2]> = Vec::new();
        for letter in letters {
            let counts = match letter {
                'B' => [4, 3],
                'F' => [7, 6],
                'f' | 's' => [0, 0],
                _ => [1, 1],
            };
            let mut first = if counts == [0, 0] { firsts[firsts.len() - 1] } else { next };
            next = [next[0] + counts[0], next[1] + counts[1]];
            if shape == Shape::Backwards && counts != [0, 0] {
                first = [ends[0] - next[0], ends[1] - next[1]];
            }
            firsts.push(first);
        }
        assert_eq!(next, ends, "so many coordinates and speeds has it");
        Self(firsts)
    }

    fn joint(&self, k: usize, letters: &[char], random: &mut impl FnMut() -> f64) -> Joint<f64> {
        let [q, v] = self.0[k];
        let follows = "fs".contains(letters[k]);
        let (ratio, offset) = (if follows { -0.7 } else { 1.0 } + 0.2 * random(), 0.3 * random());
        let mut positive = || 0.2 + 0.1 * random();
        let friction = Friction { force: positive(), speed: positive() };
        let passive = Passive {
            armature: positive(),
            damping: positive(),
            friction: k.is_multiple_of(2).then_some(friction),
            stiffness: positive(),
            rest: positive(),
        };
        match letters[k] {
            'R' | 'u' | 'f' => Joint::Revolute(Drive { q, v, ratio, offset }, passive),
            'P' | 'p' | 's' => Joint::Prismatic(Drive { q, v, ratio, offset }, passive),
            'B' => Joint::Ball { q, v },
            'F' => Joint::Free { q, v },
            letter => panic!("no joint is called {letter}"),
        }
    }
}

pub(crate) trait AddPoint {
    fn add_point(&mut self, owner: Option<usize>, m: f64, r: Vector3<f64>);
}

impl<const NL: usize, const NQ: usize, const NV: usize> AddPoint for Tree<f64, NL, NQ, NV> {
    fn add_point(&mut self, owner: Option<usize>, m: f64, r: Vector3<f64>) {
        let [[x, y, z]] = r.data.0;
        let Some(owner) = owner else {
            self.base_mass += m;
            self.base_first.iter_mut().zip([x, y, z]).for_each(|(h, x)| *h += m * x);
            return;
        };
        let masses = &mut self.masses;
        masses.mass[owner] += m;
        masses.first.iter_mut().zip([x, y, z]).for_each(|(h, x)| h[owner] += m * x);
        let products = [x * x, y * y, z * z, x * y, x * z, y * z];
        masses.second.iter_mut().zip(products).for_each(|(sigma, x)| sigma[owner] += m * x);
    }
}

/// The robot in another scalar.
pub(crate) fn lifted<T: Scalar, const NL: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, NL, NQ, NV>,
) -> Tree<T, NL, NQ, NV> {
    let drive = |d: Drive<f64>| Drive { q: d.q, v: d.v, ratio: T::of(d.ratio), offset: T::of(d.offset) };
    let passive = |p: Passive<f64>| Passive {
        armature: T::of(p.armature),
        damping: T::of(p.damping),
        friction: p.friction.map(|f| Friction { force: T::of(f.force), speed: T::of(f.speed) }),
        stiffness: T::of(p.stiffness),
        rest: T::of(p.rest),
    };
    Tree {
        links: tree.links.map(|link| Link {
            parent: link.parent,
            joint: match link.joint {
                Joint::Revolute(d, p) => Joint::Revolute(drive(d), passive(p)),
                Joint::Prismatic(d, p) => Joint::Prismatic(drive(d), passive(p)),
                Joint::Ball { q, v } => Joint::Ball { q, v },
                Joint::Free { q, v } => Joint::Free { q, v },
            },
            rotation: link.rotation.map(|row| row.map(T::of)),
            position: link.position.map(T::of),
        }),
        masses: Masses {
            mass: tree.masses.mass.map(T::of),
            first: tree.masses.first.map(|x| x.map(T::of)),
            second: tree.masses.second.map(|x| x.map(T::of)),
        },
        base_mass: T::of(tree.base_mass),
        base_first: tree.base_first.map(T::of),
        gravity: tree.gravity.map(T::of),
    }
}
