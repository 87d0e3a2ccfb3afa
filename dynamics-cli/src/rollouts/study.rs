//! What varies from one rollout to the next, and its value in each: a number of the seed and of the rollout alone.

use dynamics_codegen::diagnostics::did_you_mean;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution as _, StandardNormal, StandardUniform};

use super::variation::{Distribution, Given, Values};
use crate::failure::{Failure, Problem};
use crate::fields;
use crate::input::shown;
use crate::quantity::Exponents;
use crate::robot::Robot;

/// What a value is given to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// A parameter of the model.
    Field(usize),
    /// A coordinate at the start.
    Coordinate(usize),
    /// A speed at the start.
    Speed(usize),
}

/// A quantity that varies.
pub(super) struct Axis {
    /// As it was named.
    pub(super) name: String,
    pub(super) target: Target,
    values: Values,
    /// So many points of the grid, one after another, have the same of the listed values.
    stride: u64,
}

/// All rollouts: so many of each point of the grid.
pub(super) struct Study {
    pub(super) axes: Vec<Axis>,
    seed: u64,
    count: u64,
    /// How many rollouts there are.
    pub(super) rollouts: u64,
}

impl Study {
    /// Finds what the options name, and reports all that is wrong with them.
    pub(super) fn of(robot: &Robot<'_>, given: &[Given], count: u64, seed: u64) -> Result<Self, Failure> {
        let mut wrong = vec![];
        let mut axes: Vec<Axis> = vec![];
        for given in given {
            let found = target(robot, given).map_err(Failure::from);
            match found.and_then(|(target, unit)| Ok((target, given.values(unit)?))) {
                Ok((target, _)) if axes.iter().any(|axis| axis.target == target) => {
                    let title = format!("`{}` is given values twice", given.assignment.name);
                    wrong.push(given.assignment.wrong_name(title, "keep one of the two".to_owned()));
                }
                Ok((target, values)) => {
                    axes.push(Axis { name: given.assignment.name.clone(), target, values, stride: 1 });
                }
                Err(Failure::Wrong(problems)) => wrong.extend(problems),
                Err(other) => return Err(other),
            }
        }
        if !wrong.is_empty() {
            return Err(Failure::Wrong(wrong));
        }
        let mut points: u64 = 1;
        for axis in axes.iter_mut().rev() {
            axis.stride = points;
            if let Values::Listed(values) = &axis.values {
                points = points.saturating_mul(values.len() as u64);
            }
        }
        let rollouts = points.saturating_mul(count);
        if rollouts > MOST_ROLLOUTS {
            let problem =
                Problem::new(format!("{points} points of a grid, {count} times each, are too many rollouts"));
            return Err(problem.help("give a smaller `--count`, or fewer values to `--grid`").into());
        }
        let study = Self { axes, seed, count, rollouts };
        study.check_masses(robot, given)?;
        Ok(study)
    }

    /// The value of an axis in a rollout. Each has numbers of its own: neither the order in which they are asked for nor
    /// other axes behind it make a difference. All points of a grid draw the same ones, so that they can be compared.
    pub(super) fn value(&self, axis: usize, rollout: u64) -> f64 {
        let Axis { values, stride, .. } = &self.axes[axis];
        match values {
            Values::Listed(values) => {
                let at = rollout / self.count / stride % (values.len() as u64).max(1);
                values[at as usize]
            }
            Values::Drawn(distribution, [a, b]) => {
                let mut random = ChaCha8Rng::seed_from_u64(self.seed);
                random.set_stream(rollout % self.count);
                random.set_word_pos((axis as u128) << 32); // more words than a draw ever takes
                match distribution {
                    Distribution::Normal => {
                        let standard: f64 = StandardNormal.sample(&mut random);
                        a + b * standard
                    }
                    Distribution::Uniform => a + (b - a) * uniform(&mut random),
                    Distribution::LogUniform => {
                        (a.ln() + (b.ln() - a.ln()) * uniform(&mut random)).exp().clamp(*a, *b)
                    }
                }
            }
        }
    }

    /// Masses that are negative, before anything is simulated.
    fn check_masses(&self, robot: &Robot<'_>, given: &[Given]) -> Result<(), Failure> {
        for (k, (axis, given)) in self.axes.iter().zip(given).enumerate() {
            let Target::Field(field) = axis.target else { continue };
            if robot.model.parameters[field].unit.as_deref() != Some("kg") {
                continue;
            }
            let Some(rollout) = (0..self.rollouts).find(|&rollout| self.value(k, rollout) < 0.0) else {
                continue;
            };
            let value = self.value(k, rollout);
            let title = format!("the mass `{}` is {value:?} kg in rollout {rollout}", axis.name);
            let help = "give masses of 0 or more; `uniform` and `loguniform` have bounds, `normal` has none";
            return Err(given.assignment.wrong_value(title, help).into());
        }
        Ok(())
    }
}

/// More rollouts cannot be counted in doubles.
const MOST_ROLLOUTS: u64 = 1 << 53;

fn uniform(random: &mut ChaCha8Rng) -> f64 {
    StandardUniform.sample(random)
}

/// The prefix and the rest of the name of a coordinate or a speed; fields have no prefix.
pub(super) fn start(name: &str) -> Option<(char, &str)> {
    name.strip_prefix("q.").map(|rest| ('q', rest)).or(name.strip_prefix("v.").map(|rest| ('v', rest)))
}

/// What an option names, and its unit.
fn target(robot: &Robot<'_>, given: &Given) -> Result<(Target, Option<Exponents>), Problem> {
    let name = given.assignment.name.as_str();
    let unknown = |title: String, known: &[String], otherwise: String| {
        let meant =
            did_you_mean(start(name).map_or(name, |(_, rest)| rest), known.iter().map(String::as_str));
        given
            .assignment
            .wrong_name(title, meant.map_or(otherwise, |meant| format!("did you mean `{meant}`?")))
    };
    let Some((prefix, rest)) = start(name) else {
        let found = robot.model.parameters.iter().position(|parameter| parameter.name == name);
        let Some(found) = found else {
            if robot.spec.known.iter().any(|(known, _)| known == name) {
                let title = format!("`{name}` is given values twice, by `--set` as well");
                return Err(given.assignment.wrong_name(title, "keep one of the two".to_owned()));
            }
            let known: Vec<String> = robot.model.parameters.iter().map(|p| p.name.clone()).collect();
            let help = format!(
                "put it where the number would be, as in --body 'load, mass = {name}'; coordinates and speeds at the \
                 start are `q.` and `v.` and a name"
            );
            return Err(unknown(format!("no option uses `{}`", shown(name)), &known, help));
        };
        return Ok((Target::Field(found), fields::exponents(&robot.model.parameters[found])));
    };
    let names = if prefix == 'q' { &robot.coordinates.q } else { &robot.coordinates.v };
    let Some(at) = names.iter().position(|known| known == rest) else {
        let what = if prefix == 'q' { "coordinate" } else { "speed" };
        let help = format!("give one of {}", names.join(", "));
        return Err(unknown(format!("there is no {what} `{}`", shown(rest)), names, help));
    };
    if prefix == 'v' {
        return Ok((Target::Speed(at), Some(robot.coordinates.units_of_v[at])));
    }
    match robot.coordinates.units_of_q[at] {
        Some(unit) => Ok((Target::Coordinate(at), Some(unit))),
        None => Err(given.assignment.wrong_name(
            format!("`{name}` is a part of a quaternion, which cannot vary alone"),
            "give the orientation at the start by `--q`, and vary positions and speeds".to_owned(),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Study, Target};
    use crate::rollouts::variation::{Distribution, Values};

    fn study(values: Vec<Values>, count: u64) -> Study {
        let axis = |values| Axis { name: String::new(), target: Target::Field(0), values, stride: 1 };
        let axes = values.into_iter().map(axis).collect();
        Study { axes, seed: 7, count, rollouts: count }
    }

    /// The mean of `N` draws is off by `σ/√N`, their variance by `σ²·√(2/N)`; four times that is exceeded once in
    /// sixteen thousand times, and the seed is fixed.
    #[test]
    fn draws_have_the_moments_of_their_distribution() {
        const N: u64 = 20_000;
        let size = (N as f64).sqrt();
        let study = study(
            vec![
                Values::Drawn(Distribution::Uniform, [1.0, 3.0]),
                Values::Drawn(Distribution::Normal, [0.5, 2.0]),
                Values::Drawn(Distribution::LogUniform, [1.0, 100.0]),
            ],
            N,
        );
        let draws = |axis: usize| (0..N).map(|rollout| study.value(axis, rollout)).collect::<Vec<_>>();
        let moments = |x: &[f64]| {
            let mean = x.iter().sum::<f64>() / N as f64;
            (mean, x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / N as f64)
        };
        let logs: Vec<f64> = draws(2).iter().map(|x| x.log10()).collect();
        for (draws, expected, variance) in
            [(draws(0), 2.0, 1.0 / 3.0), (draws(1), 0.5, 4.0), (logs, 1.0, 1.0 / 3.0)]
        {
            let (mean, found) = moments(&draws);
            assert!((mean - expected).abs() < 4.0 * f64::sqrt(variance) / size, "{mean}");
            assert!((found - variance).abs() < 4.0 * variance * f64::sqrt(2.0) / size, "{found}");
        }
        assert!(draws(0).iter().all(|x| (1.0..3.0).contains(x)));
        assert!(draws(2).iter().all(|x| (1.0..=100.0).contains(x)));
        let correlation =
            draws(0).iter().zip(draws(1)).map(|(x, y)| (x - 2.0) * (y - 0.5)).sum::<f64>() / N as f64;
        assert!(correlation.abs() < 4.0 * f64::sqrt(4.0 / 3.0) / size, "{correlation}");
    }

    #[test]
    fn an_axis_more_changes_no_other_one() {
        let normal = || Values::Drawn(Distribution::Normal, [0.0, 1.0]);
        let (one, two) = (study(vec![normal()], 9), study(vec![normal(), normal()], 9));
        for rollout in 0..9 {
            assert_eq!(one.value(0, rollout), two.value(0, rollout));
            assert_ne!(two.value(0, rollout), two.value(1, rollout));
            assert!(rollout == 0 || one.value(0, rollout) != one.value(0, rollout - 1));
        }
    }
}
