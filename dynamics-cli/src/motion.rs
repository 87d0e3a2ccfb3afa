//! How a robot moves on from a state: the run time's own methods, along robots whose size is not known to Rust.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::{Motion, Tree};
use dynamics_core::__private::{ball_rate, free_rate, integrate_ball, integrate_free};
use dynamics_core::simulate::{Explicit, Flow, March, Rk4, SemiImplicitEuler, Tolerances};
use dynamics_core::{Error, Scalar};

use crate::absence::Absence;
use crate::failure::{Failure, Problem};
use crate::robot::{Robot, State};

/// How a step of a given size is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum FixedStep {
    /// The classical method of Runge and Kutta, of order 4
    Rk4,
    /// The semi-implicit method of Euler, of order 1
    Euler,
}

impl FixedStep {
    /// Goes one step along a flow.
    pub(crate) fn follow<F: Flow>(
        self,
        flow: &mut F,
        time: F::Scalar,
        from: (&F::Position, &F::Velocity),
        step: F::Scalar,
    ) -> (F::Position, F::Velocity) {
        match self {
            Self::Rk4 => Rk4.follow(flow, time, from, step),
            Self::Euler => SemiImplicitEuler.follow(flow, time, from, step),
        }
    }
}

/// How the coordinates of a robot move: those of each joint together, by the first of them and of their speeds.
#[derive(Clone)]
pub(crate) struct Links(Vec<(Motion, usize, usize)>);

impl Links {
    /// Those of a tree.
    pub(crate) fn of(tree: &Tree<f64>) -> Self {
        let mut drives: Vec<(Motion, usize, usize)> = vec![];
        for link in &tree.links {
            // Several links may share a coordinate, which moves once.
            if drives.iter().all(|(_, q, _)| *q != link.drive.q) {
                drives.push((link.motion, link.drive.q, link.drive.v));
            }
        }
        Self(drives)
    }

    /// `q ⊕ δ`, as `Configuration::integrate`, in place of q.
    pub(crate) fn integrate<T: Scalar>(&self, q: &mut [T], delta: &[T]) {
        for &(motion, at, from) in &self.0 {
            match motion {
                Motion::Revolute | Motion::Prismatic => q[at] += delta[from],
                Motion::Ball => {
                    let ball = integrate_ball(part::<T, 4>(q, at), part::<T, 3>(delta, from));
                    q[at..at + 4].copy_from_slice(&ball);
                }
                Motion::Free => {
                    let free = integrate_free(part::<T, 7>(q, at), part::<T, 6>(delta, from));
                    q[at..at + 7].copy_from_slice(&free);
                }
            }
        }
    }

    /// `δ̇` where `q ⊕ δ` moves with the velocity `v`, as `Configuration::rate`, in place of v.
    pub(crate) fn rate<T: Scalar>(&self, delta: &[T], v: &mut [T]) {
        for &(motion, _, from) in &self.0 {
            match motion {
                Motion::Revolute | Motion::Prismatic => {}
                Motion::Ball => {
                    let ball = ball_rate(part::<T, 3>(delta, from), part::<T, 3>(v, from));
                    v[from..from + 3].copy_from_slice(&ball);
                }
                Motion::Free => {
                    let free = free_rate(part::<T, 6>(delta, from), part::<T, 6>(v, from));
                    v[from..from + 6].copy_from_slice(&free);
                }
            }
        }
    }
}

fn part<T: Scalar, const N: usize>(x: &[T], from: usize) -> [T; N] {
    std::array::from_fn(|k| x[from + k])
}

/// A robot that nothing drives.
struct Unforced<'r, 'g> {
    robot: &'r Robot<'g>,
    links: Links,
    /// Why it had no acceleration somewhere on the last step.
    absent: Option<Absence>,
}

impl<'r, 'g> Unforced<'r, 'g> {
    fn of(robot: &'r Robot<'g>) -> Self {
        Self { robot, links: Links::of(&robot.tree), absent: None }
    }
}

impl Flow for Unforced<'_, '_> {
    type Scalar = f64;
    type Position = Vec<f64>;
    type Velocity = Vec<f64>;

    fn integrate(&self, q: &Vec<f64>, delta: &Vec<f64>) -> Vec<f64> {
        let mut moved = q.clone();
        self.links.integrate(&mut moved, delta);
        moved
    }

    fn rate(&self, delta: &Vec<f64>, v: &Vec<f64>) -> Vec<f64> {
        let mut rate = v.clone();
        self.links.rate(delta, &mut rate);
        rate
    }

    fn acceleration(&mut self, _time: f64, q: &Vec<f64>, v: &Vec<f64>) -> Vec<f64> {
        let zeros = vec![0.0; v.len()];
        let state = State { q: q.clone(), v: v.clone(), a: zeros.clone(), tau: zeros };
        self.robot.evaluate(Method::ForwardDynamics, &state).unwrap_or_else(|absent| {
            self.absent.get_or_insert(absent.why);
            vec![f64::NAN; v.len()]
        })
    }
}

/// A motion that goes on.
pub(crate) struct Mover<'r, 'g> {
    flow: Unforced<'r, 'g>,
    state: State,
    by: By,
}

enum By {
    Fixed(FixedStep),
    Adaptive(Box<March<f64, Vec<f64>, Vec<f64>>>),
}

impl<'r, 'g> Mover<'r, 'g> {
    /// In steps of a given size.
    pub(crate) fn fixed(robot: &'r Robot<'g>, state: State, method: FixedStep) -> Self {
        Self { flow: Unforced::of(robot), state, by: By::Fixed(method) }
    }

    /// In steps of their own size, within a tolerance.
    pub(crate) fn adaptive(robot: &'r Robot<'g>, state: State, tolerance: f64) -> Result<Self, Failure> {
        let place = (state.q.clone(), state.v.clone());
        let march =
            March::new(place, Tolerances::of(tolerance)).map_err(|error| Problem::new(error.to_string()))?;
        // Whoever asks for many steps may wait for them.
        let march = march.with_most_steps(usize::MAX);
        Ok(Self { flow: Unforced::of(robot), state, by: By::Adaptive(Box::new(march)) })
    }

    /// The state now.
    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// Goes from one time to another, in s, of a motion that ends with `end`; or says what is wrong, and when. What is at
    /// the end of each step on the way, `q` and `v`, is shown to `see`.
    pub(crate) fn advance(
        &mut self,
        [before, now]: [f64; 2],
        end: f64,
        mut see: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<(), (Failure, f64)> {
        let State { q, v, .. } = &self.state;
        self.flow.absent = None;
        let reached = match &mut self.by {
            By::Fixed(method) => Ok(method.follow(&mut self.flow, before, (q, v), now - before)),
            By::Adaptive(march) => {
                let reached = reach(march, &mut self.flow, [before, now], end, &mut see);
                reached.map_err(|error| match error {
                    Error::StepTooSmall { time } => ("no step is small enough for the tolerance", time),
                    _ => (NOT_FINITE, march.time()),
                })
            }
        };
        let finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
        match reached {
            Ok((q, v)) if finite(&q) && finite(&v) => {
                see(now, &q, &v);
                (self.state.q, self.state.v) = (q, v);
                Ok(())
            }
            lost => {
                let (title, time) = lost.err().unwrap_or((NOT_FINITE, now));
                // What grew beyond doubles is no more than that.
                let why = self.flow.absent.take().filter(|why| *why != Absence::TooLarge);
                let title = why.map_or(title.to_owned(), |why| format!("{title}: {}", why.fact()));
                Err((Problem::new(title).into(), time))
            }
        }
    }
}

/// Position and velocity at a time, where steps that end before it are shown on the way.
fn reach(
    march: &mut March<f64, Vec<f64>, Vec<f64>>,
    flow: &mut Unforced<'_, '_>,
    [before, now]: [f64; 2],
    end: f64,
    see: &mut impl FnMut(f64, &[f64], &[f64]),
) -> Result<(Vec<f64>, Vec<f64>), Error> {
    while march.time() < now {
        let time = march.time();
        if time > before {
            let (q, v) = march.reach(flow, time, end)?;
            see(time, &q, &v);
        }
        // What is behind a step by ever so little takes the next one.
        march.reach(flow, time.next_up(), end)?;
    }
    march.reach(flow, now, end)
}

const NOT_FINITE: &str = "the state is not finite";
