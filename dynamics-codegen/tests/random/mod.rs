//! Random robots in motion: trees with oblique axes, branches, skewed inertias and mass at rest; of the shape `Any`
//! with all kinds of joints, followers, rotors, dampers, friction and springs.

use dynamics_codegen::model::{Drive, Frame, Link, Motion, Passive, Term, Terms, Tree};
use dynamics_codegen::spatial::{Matrix3, Pose, PseudoInertia, Symmetric3, Vector3};
use dynamics_codegen::spec::Function;

/// Marsaglia's xorshift64.
struct Random(u64);

impl Random {
    /// Uniform in −1..1.
    fn symmetric(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn chance(&mut self) -> bool {
        self.symmetric() < 0.0
    }

    fn below(&mut self, n: usize) -> usize {
        (((self.symmetric() + 1.0) / 2.0 * n as f64) as usize).min(n - 1)
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3([self.symmetric(), self.symmetric(), self.symmetric()]).scale(size)
    }

    fn numbers(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| size * self.symmetric()).collect()
    }

    fn pose(&mut self) -> Pose<f64> {
        let [r, p, y] = self.vector(3.0).0;
        let rotation = Matrix3::rotation_z(y.cos(), y.sin())
            * Matrix3::rotation_y(p.cos(), p.sin())
            * Matrix3::rotation_x(r.cos(), r.sin());
        Pose { rotation, translation: self.vector(0.6) }
    }

    /// Six point masses, off the origin: full in every moment, and physical by construction.
    fn body(&mut self) -> PseudoInertia<f64> {
        let offset = self.vector(0.3);
        (0..6).fold(PseudoInertia::zero(), |sum, _| {
            sum + point(0.2 + self.symmetric().abs(), offset + self.vector(0.4))
        })
    }

    /// A tree of `n` links; of the shape `Any` joints are of all kinds, and some follow others.
    fn tree(&mut self, n: usize, shape: Shape) -> Tree<f64> {
        let mut links: Vec<Link<f64>> = Vec::new();
        let (mut q, mut v) = (0, 0);
        for k in 0..n {
            let parent = match shape {
                Shape::Chain => k.checked_sub(1),
                // Sometimes a second tree on the same world.
                Shape::Branched | Shape::Any => self.below(k + 1).checked_sub(1),
            };
            let motion = match (shape, self.below(8)) {
                (Shape::Any, 0) => Motion::Free,
                (Shape::Any, 1 | 2) => Motion::Ball,
                (Shape::Branched | Shape::Any, 3..6) => Motion::Prismatic,
                _ => Motion::Revolute,
            };
            let leader = links.iter().rev().find(|link| link.motion.speeds() == 1).map(|link| link.drive);
            let follows = shape == Shape::Any && motion.speeds() == 1 && self.below(4) == 0;
            let drive = match leader.filter(|_| follows) {
                Some(leader) => Drive { ratio: 1.5 * self.symmetric(), offset: self.symmetric(), ..leader },
                None => {
                    let own = Drive::own(q, v);
                    (q, v) = (q + motion.coordinates(), v + motion.speeds());
                    own
                }
            };
            let passive = match shape == Shape::Any && motion.speeds() == 1 && self.chance() {
                true => self.passive(),
                false => Passive { friction_speed: 0.1, ..Passive::none() },
            };
            // A massless link between joints is legal, as long as something follows it.
            let is_massless = k == 1 && shape == Shape::Chain && n > 3;
            let inertia = if is_massless { PseudoInertia::zero() } else { self.body() };
            links.push(Link { parent, motion, drive, passive, placement: self.pose(), inertia });
        }
        let carriers = (0..n).map(Some).chain([None]);
        let frames = carriers.map(|link| Frame { name: format!("on {link:?}"), link, pose: self.pose() });
        let frames = frames.collect();
        Tree { links, base: self.body(), frames, gravity: self.vector(10.0), terms: Terms::none() }
    }

    fn passive(&mut self) -> Passive<f64> {
        Passive {
            armature: self.symmetric().abs(),
            damping: self.symmetric().abs(),
            friction: self.symmetric().abs(),
            friction_speed: 0.1 + self.symmetric().abs(),
            stiffness: 5.0 * self.symmetric().abs(),
            rest: self.symmetric(),
        }
    }
}

/// Terms in the energies of a tree.
impl Random {
    fn any<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }

    fn size(&mut self) -> Term<f64> {
        Term::Still(0.2 + self.symmetric().abs())
    }

    /// A coordinate, or where frames are.
    fn place(&mut self, tree: &Tree<f64>) -> Term<f64> {
        let coordinates: Vec<Term<f64>> = tree.links.iter().flat_map(coordinates).collect();
        match self.below(4) {
            0 => Term::Place(self.below(3), self.below(tree.frames.len())),
            1 => {
                let a = self.below(tree.frames.len());
                Term::Distance([Some(a), (0..a).last().filter(|_| self.chance())])
            }
            _ if coordinates.is_empty() => Term::Place(0, 0),
            _ => self.any(&coordinates),
        }
    }

    /// A speed, or how fast a place changes.
    fn speed(&mut self, tree: &Tree<f64>) -> Term<f64> {
        let of_joints = tree.links.iter().filter(|link| link.motion.speeds() > 1);
        let own: Vec<usize> =
            of_joints.flat_map(|link| link.drive.v..link.drive.v + link.motion.speeds()).collect();
        match self.chance() && !own.is_empty() {
            true => Term::Speed(self.any(&own)),
            false => Term::Rate(Box::new(self.place(tree))),
        }
    }

    fn terms(&mut self, tree: &Tree<f64>) -> Terms<f64> {
        let square = |x: Term<f64>| Term::Power(Box::new(x), 2);
        let times = |k: Term<f64>, x: Term<f64>| Term::Product(vec![k, x]);
        let call = |function, x: Term<f64>| Term::Call(function, Box::new(x));
        let plus = |a: Term<f64>, b: Term<f64>| Term::Sum(vec![a, b]);
        let spring = Term::Sum(vec![self.place(tree), Term::Negative(Box::new(self.size()))]);
        let wave = times(call(Function::Sin, self.place(tree)), call(Function::Cos, self.place(tree)));
        let root = call(Function::Sqrt, plus(square(self.place(tree)), self.size()));
        let well = Term::Quotient(Box::new([self.size(), plus(square(self.place(tree)), self.size())]));
        let friction = call(Function::Sqrt, plus(square(self.speed(tree)), self.size()));
        // A linear form whose coefficients change.
        let mixed = times(call(Function::Sin, self.place(tree)), self.speed(tree));
        let (mixed, own) = (plus(mixed, self.speed(tree)), self.speed(tree));
        let weight = plus(square(self.place(tree)), self.size());
        Terms {
            potential: vec![times(self.size(), square(spring)), wave, root, well],
            dissipation: vec![times(self.size(), square(self.speed(tree))), friction],
            kinetic: vec![times(self.size(), square(mixed)), times(weight, square(own))],
        }
    }
}

/// The coordinates of a link that may stand in a term.
fn coordinates(link: &Link<f64>) -> Vec<Term<f64>> {
    let Drive { q, v, ratio, offset } = link.drive;
    match link.motion {
        Motion::Revolute | Motion::Prismatic => vec![Term::Coordinate { q, v: (v, v + 1), ratio, offset }],
        Motion::Ball => vec![],
        Motion::Free => {
            let one = |k: usize| Term::Coordinate { q: q + k, v: (v, v + 3), ratio, offset };
            (0..3).map(one).collect()
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Chain,
    Branched,
    Any,
}

/// The mass `m` at the point `r`.
fn point(m: f64, r: Vector3<f64>) -> PseudoInertia<f64> {
    PseudoInertia::new(m, r, Symmetric3::zero())
}

/// A robot in motion.
#[allow(dead_code, reason = "some tests choose states of their own")]
pub(crate) struct State {
    pub(crate) tree: Tree<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) a: Vec<f64>,
}

pub(crate) fn state(seed: u64, n: usize, shape: Shape) -> State {
    let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ seed.wrapping_mul(0xD134_2543_DE82_EF95));
    // The first numbers of nearby seeds resemble each other.
    random.numbers(20, 1.0);
    let tree = random.tree(n, shape);
    let (mut q, n) = (random.numbers(tree.coordinates(), 3.0), tree.dof());
    tree.normalise(&mut q);
    State { tree, q, v: random.numbers(n, 2.0), a: random.numbers(n, 4.0) }
}

/// A tree, and the same tree in a place given by the coordinates that surveyors use. What rounding takes from it there is
/// taken from it here too.
#[allow(dead_code, reason = "some tests have no use for it")]
pub(crate) fn near_and_far(tree: &Tree<f64>) -> (Tree<f64>, Tree<f64>) {
    let moved = |tree: &Tree<f64>, by: Vector3<f64>| {
        let mut tree = tree.clone();
        for link in tree.links.iter_mut().filter(|link| link.parent.is_none()) {
            link.placement.translation = link.placement.translation + by;
        }
        tree
    };
    let place = Vector3([500_000.0, 5_000_000.0, 100.0]);
    let far = moved(tree, place);
    (moved(&far, -place), far)
}

/// The same robot, with terms in its energies.
#[allow(dead_code, reason = "some tests have no use for it")]
pub(crate) fn with_terms(mut state: State, seed: u64) -> State {
    let mut random = Random(0xA076_1D64_78BD_642F ^ seed.wrapping_mul(0xE703_7ED1_A0B4_28DB));
    random.numbers(20, 1.0);
    state.tree.terms = random.terms(&state.tree);
    state
}

/// All of them, the simplest first.
pub(crate) const SHAPES: [Shape; 3] = [Shape::Chain, Shape::Branched, Shape::Any];
