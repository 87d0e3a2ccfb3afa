//! Seeded random states, the same on every machine.

use crate::{Space, Vector};

/// The generator splitmix64 of S. Vigna.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a name: each robot has its own states.
    pub fn of(name: &str) -> Self {
        let hash = name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3) // FNV-1a
        });
        Self(hash)
    }

    /// The next number between −1 and 1.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^= x >> 31;
        (x >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// `n` numbers between −`size` and `size`.
    pub fn vector(&mut self, n: usize, size: f64) -> Vector {
        Vector::from_fn(n, |_, _| size * self.number())
    }
}

/// A robot in motion, and forces on it.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Coordinates, rad and m, and unit quaternions.
    pub q: Vector,
    /// Speeds.
    pub v: Vector,
    /// Accelerations.
    pub a: Vector,
    /// Joint forces.
    pub tau: Vector,
}

impl State {
    /// `count` states of a robot: turned anywhere, and of the size of one.
    pub fn many(name: &str, space: Space, count: usize) -> Vec<Self> {
        let mut random = Random::of(name);
        let n = space.speeds();
        let mut state = || Self {
            q: space.normalised(random.vector(space.coordinates(), 3.2)),
            v: random.vector(n, 2.0),
            a: random.vector(n, 4.0),
            tau: random.vector(n, 8.0),
        };
        (0..count).map(|_| state()).collect()
    }

    /// The state rounded to single precision, so that both precisions can start from the same one.
    pub fn in_single(&self) -> Self {
        let round = |x: &Vector| x.map(|x| f64::from(x as f32));
        Self { q: round(&self.q), v: round(&self.v), a: round(&self.a), tau: round(&self.tau) }
    }
}
