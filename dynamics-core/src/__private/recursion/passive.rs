//! What joints do by themselves: armature, damping, friction and springs, O(N).
//!
//! E. Todorov, T. Erez, Y. Tassa, *MuJoCo: a physics engine for model-based control*, IROS 2012, for armature and
//! springs at joints.

use nalgebra::{SMatrix, SVector};

use super::sweep::{add, add_entry};
use super::{Drive, Friction, Passive, Tree, entries, entry};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The passive joint forces, NV, on the left-hand side: damping, friction and springs.
    pub fn passive_forces(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, NV> {
        let mut forces = [T::zero(); NV];
        for (drive, passive) in self.driven() {
            let force = passive.force(drive.position(entries(q)), drive.speed(entries(v)));
            add(&mut forces, drive.v, drive.ratio * force);
        }
        vector(forces)
    }

    /// The energy `½ Σ stiffness·(p − rest)²` in the springs of the joints, J.
    pub fn elastic_energy(&self, q: &SVector<T, NQ>) -> T {
        let twice = self.driven().map(|(drive, passive)| {
            let stretch = drive.position(entries(q)) - passive.rest;
            passive.stiffness * stretch * stretch
        });
        twice.fold(T::zero(), T::add) * T::of(0.5)
    }

    /// The armatures' part of the joint forces, for accelerations `a`.
    pub(super) fn add_armature_forces(&self, a: &[T; NV], forces: &mut [T; NV]) {
        for (drive, passive) in self.driven() {
            add(forces, drive.v, drive.reflected(passive.armature) * entry(a, drive.v));
        }
    }

    /// `Σ armature·s²`
    pub(super) fn twice_energy_of_armatures(&self, v: &[T; NV]) -> T {
        let twice = self.driven().map(|(drive, passive)| {
            let speed = drive.speed(v);
            passive.armature * speed * speed
        });
        twice.fold(T::zero(), T::add)
    }

    /// The armatures' part of the mass matrix.
    pub(super) fn add_armatures(&self, m: &mut SMatrix<T, NV, NV>) {
        for (speed, armature) in self.armatures() {
            add_entry(m, speed, speed, armature);
        }
    }

    /// The derivatives of the passive forces by position and by speed.
    pub(super) fn add_passive_slopes(
        &self,
        v: &[T; NV],
        dtau_dq: &mut SMatrix<T, NV, NV>,
        dtau_dv: &mut SMatrix<T, NV, NV>,
    ) {
        for (speed, [by_place, by_speed]) in self.passive_slopes(v) {
            add_entry(dtau_dq, speed, speed, by_place);
            add_entry(dtau_dv, speed, speed, by_speed);
        }
    }

    /// What stands on the diagonal of the mass matrix, by speeds.
    #[inline(always)]
    pub(super) fn armatures(&self) -> impl Iterator<Item = (usize, T)> {
        self.driven().map(|(drive, passive)| (drive.v, drive.reflected(passive.armature)))
    }

    /// What stands on the diagonals of the derivatives by position and by speed, by speeds.
    #[inline(always)]
    pub(super) fn passive_slopes(&self, v: &[T; NV]) -> impl Iterator<Item = (usize, [T; 2])> {
        self.driven().map(|(drive, passive)| {
            let slopes = [passive.stiffness, passive.slope(drive.speed(v))];
            (drive.v, slopes.map(|slope| drive.reflected(slope)))
        })
    }

    fn driven(&self) -> impl Iterator<Item = (&Drive<T>, &Passive<T>)> {
        self.links.iter().filter_map(|link| link.joint.driven())
    }
}

impl<T: Scalar> Drive<T> {
    /// `ratio²·x`: a coefficient of the joint's own position, speed or acceleration, as the drive feels it.
    pub(super) fn reflected(&self, x: T) -> T {
        self.ratio * self.ratio * x
    }
}

impl<T: Scalar> Passive<T> {
    fn force(&self, position: T, speed: T) -> T {
        let friction = self.friction.map_or_else(T::zero, |friction| friction.force(speed));
        self.damping * speed + friction + self.stiffness * (position - self.rest)
    }

    /// `∂force/∂speed`
    fn slope(&self, speed: T) -> T {
        self.damping + self.friction.map_or_else(T::zero, |friction| friction.slope(speed))
    }
}

impl<T: Scalar> Friction<T> {
    fn force(&self, speed: T) -> T {
        self.force * speed / self.norm(speed)
    }

    /// `∂force/∂speed`
    fn slope(&self, speed: T) -> T {
        let (norm, threshold) = (self.norm(speed), self.speed);
        self.force / norm * (threshold / norm) * (threshold / norm)
    }

    fn norm(&self, speed: T) -> T {
        (speed * speed + self.speed * self.speed).sqrt()
    }
}
