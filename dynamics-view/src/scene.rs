//! A robot as it is drawn: its bodies, the joints that carry them, and its masses.

use dynamics_core::Pose;

use crate::error::{Error, check_numbers};

/// A robot to be drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// What it is called.
    pub name: String,
    /// Its bodies and frames.
    pub bodies: Vec<Body>,
}

/// A body or a frame, all of it in axes and from the origin of its own frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// What it is called.
    pub name: String,
    /// The body that it hangs on, by its index; the world, without one.
    pub parent: Option<usize>,
    /// How it can move against that one.
    pub joint: Joint,
    /// Its mass, kg; 0 of a frame.
    pub mass: f64,
    /// Its centre of mass, m.
    pub com: [f64; 3],
    /// Its rotational inertia about the centre of mass, kg·m², by rows.
    pub inertia: [[f64; 3]; 3],
}

/// What carries a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// What it is called; nothing, of a body that is welded.
    pub name: String,
    /// What it is, for people: `revolute`.
    pub kind: String,
    /// How it moves the body, one entry for each independent motion; those of free joints need none.
    pub motions: Vec<Motion>,
}

/// A motion of a body against the one that carries it, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// It turns about a line.
    Turn {
        /// A point of the line, m.
        through: [f64; 3],
        /// The line's direction, of length 1.
        along: [f64; 3],
    },
    /// It slides in a direction of length 1.
    Slide {
        /// The direction.
        along: [f64; 3],
    },
}

impl Motion {
    /// The motion of a twist, linear first; none of a twist that is zero. A screw is shown as its turn.
    #[must_use]
    pub fn of_twist([a, b, c, l, m, n]: [f64; 6]) -> Option<Self> {
        let (turn, slide) = (norm([l, m, n]), norm([a, b, c]));
        if turn > 0.0 {
            // The point of the axis that is nearest to the origin, ω × v / ω².
            let square = turn * turn;
            let through = [(m * c - n * b) / square, (n * a - l * c) / square, (l * b - m * a) / square];
            return Some(Self::Turn { through, along: [l / turn, m / turn, n / turn] });
        }
        (slide > 0.0).then(|| Self::Slide { along: [a / slide, b / slide, c / slide] })
    }
}

/// A body at one configuration: where it is, and its body Jacobian by columns, twists in its own axes, linear first.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// In the world.
    pub pose: Pose<f64>,
    /// One column for each speed of the robot.
    pub jacobian: Vec<[f64; 6]>,
}

impl Placed {
    /// The world: it does not move.
    #[must_use]
    pub fn world(speeds: usize) -> Self {
        Self { pose: Pose::identity(), jacobian: vec![[0.0; 6]; speeds] }
    }

    /// How this body moves against the one that carries it: the speeds that move it there, each with its motion.
    ///
    /// `J_B − Ad(X_BP)·J_P`, whose columns are zero but for those of the joint between the two.
    #[must_use]
    pub fn motions_against(&self, parent: &Self) -> Vec<(usize, Motion)> {
        let seen = self.pose.inverse() * parent.pose;
        let own = |(twist, of_parent): (&[f64; 6], &[f64; 6])| {
            let carried = moved(&seen, *of_parent);
            let size = carried.iter().chain(twist).fold(0.0, |size: f64, x| size.max(x.abs()));
            let relative: [f64; 6] = std::array::from_fn(|k| twist[k] - carried[k]);
            // What is left of equal twists is their rounding.
            relative.map(|x| if x.abs() > ROUNDING * size { x } else { 0.0 })
        };
        let relative = self.jacobian.iter().zip(&parent.jacobian).map(own);
        relative.enumerate().filter_map(|(speed, twist)| Some((speed, Motion::of_twist(twist)?))).collect()
    }
}

/// Of products of a few rotations, with room.
const ROUNDING: f64 = 1e-10;

/// `Ad(X)·V`: the same motion, seen from the frame in which its own has the pose `X`; linear first.
fn moved(pose: &Pose<f64>, [a, b, c, l, m, n]: [f64; 6]) -> [f64; 6] {
    let turn = |x: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| (0..3).map(|j| pose.rotation[(i, j)] * x[j]).sum())
    };
    let ([a, b, c], [l, m, n]) = (turn([a, b, c]), turn([l, m, n]));
    let [x, y, z] = pose.translation.data.0[0];
    [a + y * n - z * m, b + z * l - x * n, c + x * m - y * l, l, m, n]
}

fn norm(x: [f64; 3]) -> f64 {
    x.iter().fold(0.0, |norm: f64, x| norm.hypot(*x))
}

impl Scene {
    /// The bodies, those that carry others before these; in their own order as far as that goes.
    pub(crate) fn order(&self) -> Result<Vec<usize>, Error> {
        let bodies = &self.bodies;
        let mut order: Vec<usize> = vec![];
        let mut is_in = vec![false; bodies.len()];
        while order.len() < bodies.len() {
            let before = order.len();
            for (k, body) in bodies.iter().enumerate() {
                let is_carried = body.parent.is_none_or(|parent| is_in.get(parent) == Some(&true));
                if !is_in[k] && is_carried {
                    is_in[k] = true;
                    order.push(k);
                }
            }
            if order.len() == before {
                let lost = is_in.iter().position(|is_in| !is_in).unwrap_or(0);
                return Err(Error::BodyUnconnected { body: bodies[lost].name.clone() });
            }
        }
        Ok(order)
    }
}

impl Body {
    /// Whether its numbers can be drawn.
    pub(crate) fn check(&self) -> Result<(), Error> {
        check_numbers(&format!("the mass of `{}`", self.name), [self.mass])?;
        check_numbers(&format!("the centre of mass of `{}`", self.name), self.com)?;
        let inertia = self.inertia.as_flattened();
        check_numbers(&format!("the inertia of `{}`", self.name), inertia.iter().copied())?;
        for motion in &self.joint.motions {
            let (Motion::Turn { along, .. } | Motion::Slide { along }) = motion;
            let through = if let Motion::Turn { through, .. } = motion { *through } else { [0.0; 3] };
            let numbers = along.iter().chain(&through).copied();
            check_numbers(&format!("the joint of `{}`", self.name), numbers)?;
        }
        Ok(())
    }

    /// What is drawn of the mass: `5/m·∫x·xᵀdm` about the centre, the square of the ellipsoid of even density that has
    /// the same mass and inertia; xx, yy, zz, xy, xz, yz in m².
    pub(crate) fn ellipsoid(&self) -> Option<[f64; 6]> {
        if self.mass <= 0.0 {
            return None;
        }
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.inertia;
        let half = (xx + yy + zz) / 2.0;
        let squares = [half - xx, half - yy, half - zz, -xy, -xz, -yz].map(|moment| 5.0 * moment / self.mass);
        squares.iter().all(|x| x.is_finite()).then_some(squares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipsoid_of_even_density_is_itself() {
        let [a, b, c] = [0.3, 0.2, 0.1_f64];
        let mass = 2.0;
        let moment = |x: f64, y: f64| mass / 5.0 * (x * x + y * y);
        let inertia = [[moment(b, c), 0.0, 0.0], [0.0, moment(a, c), 0.0], [0.0, 0.0, moment(a, b)]];
        let found = Body { mass, inertia, ..Body::default() }.ellipsoid().expect("it has mass");
        for (found, expected) in found.iter().zip([a * a, b * b, c * c, 0.0, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
    }

    /// A point of the axis does not move, and every other one moves about it.
    #[test]
    fn the_axis_of_a_twist_stands_still() {
        let twist = [0.2, -0.4, 0.1, 0.0, 0.3, 1.2];
        let Some(Motion::Turn { through: [x, y, z], along }) = Motion::of_twist(twist) else {
            panic!("it turns")
        };
        let [a, b, c, l, m, n] = twist;
        let there = [a + m * z - n * y, b + n * x - l * z, c + l * y - m * x];
        let pitch = there[0] * along[0] + there[1] * along[1] + there[2] * along[2];
        for k in 0..3 {
            assert!((there[k] - pitch * along[k]).abs() < 1e-15, "{there:?}");
        }
        assert_eq!(
            Motion::of_twist([0.0, 0.0, -2.0, 0.0, 0.0, 0.0]),
            Some(Motion::Slide { along: [0.0, 0.0, -1.0] })
        );
        assert_eq!(Motion::of_twist([0.0; 6]), None);
    }
}
