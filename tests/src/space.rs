//! The configurations of a robot: numbers, unit quaternions, and bodies that nothing holds, in the order of `q`.

use crate::Vector;

/// A piece of the configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// So many coordinates of joints of one degree of freedom.
    Lines(usize),
    /// A unit quaternion i, j, k, w, which turns with an angular velocity in its own axes.
    Ball,
    /// A position and a unit quaternion, which move with a twist in their own axes, linear first.
    Free,
}

impl Part {
    fn coordinates(self) -> usize {
        match self {
            Self::Lines(count) => count,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }

    fn speeds(self) -> usize {
        match self {
            Self::Lines(count) => count,
            Self::Ball => 3,
            Self::Free => 6,
        }
    }
}

/// The space that a robot's configuration is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Space(pub &'static [Part]);

impl Space {
    /// NQ
    pub fn coordinates(self) -> usize {
        self.0.iter().map(|part| part.coordinates()).sum()
    }

    /// NV
    pub fn speeds(self) -> usize {
        self.0.iter().map(|part| part.speeds()).sum()
    }

    /// Whether `q` is a vector, and `v` its rate.
    pub fn is_flat(self) -> bool {
        self.coordinates() == self.speeds()
    }

    /// The parts, each with where its coordinates and its speeds begin.
    fn parts(self) -> impl Iterator<Item = (Part, usize, usize)> {
        self.0.iter().scan((0, 0), |(q, v), &part| {
            let found = (part, *q, *v);
            (*q, *v) = (*q + part.coordinates(), *v + part.speeds());
            Some(found)
        })
    }

    /// Where quaternions begin in `q`.
    pub fn quaternions(self) -> Vec<usize> {
        let begin = |(part, q, _)| match part {
            Part::Lines(_) => None,
            Part::Ball => Some(q),
            Part::Free => Some(q + 3),
        };
        self.parts().filter_map(begin).collect()
    }

    /// `q` with quaternions of unit length.
    pub fn normalised(self, mut q: Vector) -> Vector {
        for at in self.quaternions() {
            let length = q.rows(at, 4).norm();
            q.rows_mut(at, 4).unscale_mut(length);
        }
        q
    }

    /// `q̇` at the speeds `v`: of a quaternion `½ q ∘ (ω, 0)`, of a free body's position `R v`.
    pub fn rate(self, q: &Vector, v: &Vector) -> Vector {
        let mut rate = Vector::zeros(q.len());
        for (part, at, from) in self.parts() {
            let (quaternion, angular) = match part {
                Part::Lines(count) => {
                    rate.rows_mut(at, count).copy_from(&v.rows(from, count));
                    continue;
                }
                Part::Ball => (at, from),
                Part::Free => {
                    let rotation = nalgebra::UnitQuaternion::new_unchecked(quaternion_at(q, at + 3));
                    rate.rows_mut(at, 3).copy_from(&(rotation * v.fixed_rows::<3>(from)));
                    (at + 3, from + 3)
                }
            };
            let turning = nalgebra::Quaternion::from_imag(v.fixed_rows::<3>(angular).into_owned());
            let rate_of_quaternion = quaternion_at(q, quaternion) * turning * 0.5;
            rate.rows_mut(quaternion, 4).copy_from(&rate_of_quaternion.coords);
        }
        rate
    }

    /// The bracket `[v, w]` of the directions in which constant speeds move the robot: of a ball's `v × w`, of a free
    /// body's `(ω_v × l_w − ω_w × l_v, ω_v × ω_w)`, of lines zero.
    pub fn bracket(self, v: &Vector, w: &Vector) -> Vector {
        let mut bracket = Vector::zeros(v.len());
        for (part, _, at) in self.parts() {
            let angular = match part {
                Part::Lines(_) => continue,
                Part::Ball => at,
                Part::Free => {
                    let [l_v, l_w] = [v, w].map(|x| x.fixed_rows::<3>(at));
                    let [o_v, o_w] = [v, w].map(|x| x.fixed_rows::<3>(at + 3));
                    bracket.rows_mut(at, 3).copy_from(&(o_v.cross(&l_w) - o_w.cross(&l_v)));
                    at + 3
                }
            };
            let turned = v.fixed_rows::<3>(angular).cross(&w.fixed_rows::<3>(angular));
            bracket.rows_mut(angular, 3).copy_from(&turned);
        }
        bracket
    }
}

/// The quaternion from `at` on, whose order is nalgebra's.
fn quaternion_at(q: &Vector, at: usize) -> nalgebra::Quaternion<f64> {
    nalgebra::Quaternion::from_vector(q.fixed_rows::<4>(at).into_owned())
}
