//! Coordinates, speeds and accelerations of joints.

use super::{OperatingPoint, Output, Row};
use crate::error::Error;
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::state_space::Signal;

/// A joint's degree of freedom, by its name as the robot's [`Mechanism`] has it, or by its index in `v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// By name.
    Named(&'static str),
    /// By index, counted from 0.
    Index(usize),
}

impl From<&'static str> for Which {
    fn from(name: &'static str) -> Self {
        Self::Named(name)
    }
}

impl From<usize> for Which {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

impl Which {
    /// The index among `count`, whose names are `names`.
    pub(crate) fn find(self, names: &[&str], count: usize) -> Result<usize, Error> {
        match self {
            Self::Named(name) => {
                names.iter().position(|known| *known == name).ok_or(Error::NameUnknown { name })
            }
            Self::Index(index) if index < count => Ok(index),
            Self::Index(index) => Err(Error::IndexTooLarge { index, count }),
        }
    }
}

/// The coordinate of a joint, 1, in rad or m: `y = q_i`.
///
/// Of a ball or free joint, whose coordinates are no displacements, it is the displacement from where it is asked for,
/// such as `root_joint.rx`, and so zero there: a row of `C`, but no constraint of a trim, which has
/// [`orientation`](super::orientation) for that.
pub fn joint(which: impl Into<Which>) -> Joint {
    Joint { which: which.into(), order: Order::Position }
}

/// The speed of a joint, 1, in rad/s or m/s: `y = v_i`.
pub fn joint_speed(which: impl Into<Which>) -> Joint {
    Joint { which: which.into(), order: Order::Speed }
}

/// The acceleration of a joint, 1, in rad/s² or m/s²: `y = a_i`.
pub fn joint_acceleration(which: impl Into<Which>) -> Joint {
    Joint { which: which.into(), order: Order::Acceleration }
}

/// All displacements, NV: as [`joint`] of each.
pub const fn displacements() -> All {
    All { order: Order::Position }
}

/// All speeds, NV: `y = v`.
pub const fn speeds() -> All {
    All { order: Order::Speed }
}

/// The output of [`joint`], [`joint_speed`] and [`joint_acceleration`].
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    which: Which,
    order: Order,
}

/// The output of [`displacements`] and [`speeds`].
#[derive(Clone, Copy, Debug)]
pub struct All {
    order: Order,
}

#[derive(Clone, Copy, Debug)]
enum Order {
    Position,
    Speed,
    Acceleration,
}

impl Order {
    fn write<R: Mechanism + ?Sized, T: Scalar, const NQ: usize, const NV: usize>(
        self,
        index: usize,
        at: &OperatingPoint<T, NQ, NV>,
        row: &mut Row<T, NV>,
    ) {
        let (signal, value, derivative) = match self {
            Self::Position => {
                let value = coordinate_of::<R>(index, NQ == NV).and_then(|index| at.q.get(index));
                (Signal::displacement::<R>(index), value, &mut row.by_q)
            }
            Self::Speed => (Signal::speed::<R>(index), at.v.get(index), &mut row.by_v),
            Self::Acceleration => (Signal::acceleration::<R>(index), at.a.get(index), &mut row.by_a),
        };
        row.signal = signal;
        row.value = value.copied().unwrap_or_else(T::zero);
        if let Some(entry) = derivative.get_mut(index) {
            *entry = T::one();
        }
    }
}

/// The coordinate that a displacement changes one to one, if there is one.
fn coordinate_of<R: Mechanism + ?Sized>(index: usize, is_flat: bool) -> Option<usize> {
    match R::DISPLACEMENT_NAMES.get(index) {
        _ if is_flat => Some(index),
        Some(name) => R::COORDINATE_NAMES.iter().position(|known| known == name),
        None => None,
    }
}

impl<R: Mechanism + ?Sized, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Joint {
    const ROWS: usize = 1;

    fn write(&self, _: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let names = match self.order {
            Order::Position => R::DISPLACEMENT_NAMES,
            Order::Speed | Order::Acceleration => R::SPEED_NAMES,
        };
        let index = self.which.find(names, NV)?;
        rows.iter_mut().for_each(|row| self.order.write::<R, T, NQ, NV>(index, at, row));
        Ok(())
    }
}

impl<R: Mechanism + ?Sized, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for All {
    const ROWS: usize = NV;

    fn write(&self, _: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        for (index, row) in rows.iter_mut().enumerate() {
            self.order.write::<R, T, NQ, NV>(index, at, row);
        }
        Ok(())
    }
}
