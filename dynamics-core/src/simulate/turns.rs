//! A step that slides before it turns, so that how far it slides does not bend it.

use nalgebra::SVector;

use super::numbers::is_at_most;
use crate::product::dot;
use crate::scalar::Scalar;
use crate::state::Configuration;

/// Which speeds turn a quaternion: 1 where one does, 0 where a coordinate just grows or a free body slides.
pub(super) struct Turns<T, const NV: usize> {
    turns: SVector<T, NV>,
    any: bool,
}

/// A step `q₁ = q₀ ⊕ λ ⊕ ρ`, of a slide λ and a turn ρ: a free body goes straight, by `λ` in its axes at the start.
#[derive(Clone, Copy)]
pub(super) struct Way<T, const NQ: usize, const NV: usize> {
    /// `q₁`
    pub(super) q: SVector<T, NQ>,
    /// The mean velocity as `q₁` has it, in the axes that bodies have there.
    pub(super) v: SVector<T, NV>,
    /// ρ
    turn: SVector<T, NV>,
}

impl<T: Scalar, const NV: usize> Turns<T, NV> {
    /// Those of a robot.
    ///
    /// Slides are what commutes with itself and with what it gives: `[δ, [δ, v]] = 0`, which is the even part of `rate`.
    pub(super) fn of<R: Configuration<T, NQ, NV>, const NQ: usize>(robot: &R) -> Self {
        let ones = SVector::<T, NV>::repeat(T::one());
        let (mut turns, mut any) = (SVector::<T, NV>::zeros(), false);
        let mut delta = SVector::<T, NV>::zeros();
        for i in 0..NV {
            set(&mut delta, i, T::one());
            let even = robot.rate(&delta, &ones) + robot.rate(&-delta, &ones) - (ones + ones);
            set(&mut delta, i, T::zero());
            // Of a turn by one radian it is a sixth, in two directions.
            if !is_at_most(dot(&even, &even), T::of(1e-3)) {
                set(&mut turns, i, T::one());
                any = true;
            }
        }
        Self { turns, any }
    }

    /// The slide and the turn of a displacement, of a velocity or of a momentum.
    fn split(&self, x: &SVector<T, NV>) -> [SVector<T, NV>; 2] {
        let turn = x.zip_map(&self.turns, |x, turns| x * turns);
        [x - turn, turn]
    }

    /// The step from `q`, of the mean velocity `v` in the axes at its start.
    pub(super) fn way<R: Configuration<T, NQ, NV>, const NQ: usize>(
        &self,
        robot: &R,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        step: T,
    ) -> Way<T, NQ, NV> {
        if !self.any {
            return Way { q: robot.integrate(q, &(v * step)), v: *v, turn: SVector::zeros() };
        }
        let [slide, spin] = self.split(v);
        let turn = spin * step;
        let q = robot.integrate(&robot.integrate(q, &(slide * step)), &turn);
        Way { q, v: self.turned(robot, &-turn, v) + spin, turn }
    }

    /// `π₀`: the momentum at the start of a step whose momenta would be `M(q₀)·v₀` and `M(q₁)·v₁`.
    pub(super) fn mean_momentum<R: Configuration<T, NQ, NV>, const NQ: usize>(
        &self,
        robot: &R,
        Way { turn, .. }: &Way<T, NQ, NV>,
        [ours, theirs]: [&SVector<T, NV>; 2],
    ) -> SVector<T, NV> {
        let half = T::of(0.5);
        if !self.any {
            return (ours + theirs) * half;
        }
        let [_, spin] =
            self.split(&(robot.rate_transposed(turn, ours) + robot.rate_transposed(&-turn, theirs)));
        let [slide, _] = self.split(ours);
        let slides = slide + self.commuted(robot, turn, ours) + self.turned(robot, turn, theirs);
        (slides + spin) * half
    }

    /// `π₁`: that at its end, where the one at its start is `momentum`.
    pub(super) fn carried_momentum<R: Configuration<T, NQ, NV>, const NQ: usize>(
        &self,
        robot: &R,
        Way { turn, .. }: &Way<T, NQ, NV>,
        momentum: &SVector<T, NV>,
        [ours, theirs]: [&SVector<T, NV>; 2],
    ) -> SVector<T, NV> {
        if !self.any {
            return *momentum;
        }
        let half = T::of(0.5);
        let [_, spin] = self.split(momentum);
        let mean = momentum - self.commuted(robot, turn, ours) * half;
        self.turned(robot, &-turn, &mean) - self.commuted(robot, turn, theirs) * half + spin
    }

    /// The slides of `x` in the axes from which the turn begins, where they were in those in which it ends.
    fn turned<R: Configuration<T, NQ, NV>, const NQ: usize>(
        &self,
        robot: &R,
        turn: &SVector<T, NV>,
        x: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let ([slide, _], neutral) = (self.split(x), robot.neutral());
        let there = robot.integrate(&robot.integrate(&neutral, turn), &slide);
        let [slide, _] = self.split(&robot.difference(&neutral, &robot.integrate(&there, &-turn)));
        slide
    }

    /// The slides of `p·[ρ, ·]`, which is the odd part of the transposed rate.
    fn commuted<R: Configuration<T, NQ, NV>, const NQ: usize>(
        &self,
        robot: &R,
        turn: &SVector<T, NV>,
        p: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let [slide, _] = self.split(&(robot.rate_transposed(turn, p) - robot.rate_transposed(&-turn, p)));
        slide
    }
}

/// Sets an entry, if there is one.
fn set<T: Scalar, const NV: usize>(x: &mut SVector<T, NV>, index: usize, value: T) {
    if let Some(entry) = x.get_mut(index) {
        *entry = value;
    }
}
