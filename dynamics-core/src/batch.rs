//! Many states at once: [`map`] calls a method in [lanes](crate::lanes), `par_map`, with feature `rayon`, on all cores.
//!
//! States come in slices and results go to one, whatever they are made of; between them stands a closure that is
//! called with as many states as there are lanes. Each result has the bits that a call with its state alone has.
//!
#![cfg_attr(feature = "derive", doc = "```")]
#![cfg_attr(not(feature = "derive"), doc = "```ignore")]
//! use dynamics_core::prelude::*;
//! # #[derive(Dynamics)]
//! # #[joint(slider: prismatic(x), world -> cart)]
//! # #[body(cart, solid = cuboid(1, [300mm, 200mm, 100mm]))]
//! # #[joint(hinge: revolute(y), cart -> pole)]
//! # #[body(pole, com = [0, 0, 0.5], solid = cylinder(100g, 5mm, 1))]
//! # struct CartPole;
//!
//! let q = vec![SVector::from([0.1, 0.2]); 1000];
//! let (v, a) = (vec![SVector::from([0.0, 1.0]); 1000], vec![SVector::from([2.0, 0.0]); 1000]);
//!
//! let mut tau = vec![SVector::zeros(); 1000];
//! batch::map((&q, &v, &a), &mut tau, |(q, v, a)| CartPole.inverse_dynamics(&q, &v, &a))?;
//! assert_eq!(tau[7], CartPole.inverse_dynamics(&q[7], &v[7], &a[7]));
//!
//! let mut answered = vec![SVector::zeros(); 1000];
//! batch::map((&q, &v, &tau), &mut answered, |(q, v, tau)| CartPole.forward_dynamics(&q, &v, &tau))?;
//! assert!((answered[999] - a[999]).amax() < 1e-12);
//!
//! let start = CartPole.forward_dynamics_derivatives(&q[0], &v[0], &tau[0]);
//! let mut derivatives = vec![start; 1000];
//! batch::map((&q, &v, &tau), &mut derivatives, |(q, v, tau)| {
//!     CartPole.forward_dynamics_derivatives(&q, &v, &tau)
//! })?;
//! assert_eq!(derivatives[512], start);
//!
//! let mut energies = vec![0.0; 1000];
//! batch::map((&q, &v), &mut energies, |(q, v)| CartPole.total_energy(&q, &v))?;
//! # Ok::<(), Error>(())
//! ```
//!
//! A robot with fields must have them in lanes: [`Native<f64>`](Native) says in how many, and a field may be of
//! another value in each state.
//!
#![cfg_attr(feature = "derive", doc = "```")]
#![cfg_attr(not(feature = "derive"), doc = "```ignore")]
//! use dynamics_core::lanes::Native;
//! use dynamics_core::prelude::*;
//!
//! #[derive(Dynamics)]
//! #[joint(hinge: revolute(y), world -> rod)]
//! #[body(rod, com = [0, 0, -l], solid = point(m))]
//! struct Pendulum<T> { m: T, l: T }
//!
//! let angles = [SVector::from([0.3]), SVector::from([0.4]), SVector::from([0.5])];
//! let pendulum = Pendulum::<Native<f64>> { m: 2.0.into(), l: 0.5.into() };
//! let mut forces = [SVector::zeros(); 3];
//! batch::map(&angles, &mut forces, |q| pendulum.gravity_forces(&q))?;
//!
//! let masses = [1.0, 2.0, 3.0];
//! let mut of_masses = [SVector::zeros(); 3];
//! batch::map((&angles, &masses), &mut of_masses, |(q, m)| Pendulum { m, ..pendulum }.gravity_forces(&q))?;
//! assert_eq!(of_masses[1], forces[1]);
//! # Ok::<(), Error>(())
//! ```

mod pack;
#[cfg(all(feature = "rayon", not(target_os = "none")))]
mod parallel;

use crate::error::Error;
use crate::lanes::{Lanes, Native};

pub use pack::{Pack, States};
#[cfg(all(feature = "rayon", not(target_os = "none")))]
pub use parallel::{par_map, par_map_in};

/// `results[k] = f(states[k])` for every `k`, in lanes as wide as the target's registers.
///
/// `states` is a slice, array or vector by reference, or a tuple of these: `&q`, `(&q, &v)`, `(&q, &v, &tau)`. Their
/// entries and the results are vectors, matrices, what the traits of a robot return, plain floats, and pairs and triples
/// of these ([`Pack`]).
///
/// # Errors
///
/// [`Error::BatchLength`] if the slices are not of one length; nothing is written then.
#[inline]
pub fn map<I: States, O: Pack<Element = I::Element>>(
    states: I,
    results: &mut [O],
    f: impl FnMut(I::Packed<Native<I::Element>>) -> O::Packed<Native<I::Element>>,
) -> Result<(), Error> {
    map_in::<Native<I::Element>, I, O>(states, results, f)
}

/// [`map`], in lanes of the type `L`: `batch::map_in::<f64x4, _, _>(…)`.
///
/// Half as wide may be quicker for a large robot, whose numbers do not stay in registers.
///
/// # Errors
///
/// Those of [`map`].
#[inline]
pub fn map_in<L: Lanes, I: States<Element = L::Element>, O: Pack<Element = L::Element>>(
    states: I,
    results: &mut [O],
    mut f: impl FnMut(I::Packed<L>) -> O::Packed<L>,
) -> Result<(), Error> {
    states.check_length(results.len())?;
    blocks::<L, I, O>(states, 0, results, &mut f);
    Ok(())
}

/// Fills `results` from the states that begin with the `first`, a block of lanes at a time.
#[inline(always)]
fn blocks<L: Lanes, I: States<Element = L::Element>, O: Pack<Element = L::Element>>(
    states: I,
    first: usize,
    results: &mut [O],
    f: &mut impl FnMut(I::Packed<L>) -> O::Packed<L>,
) {
    for (block, results) in results.chunks_mut(L::COUNT).enumerate() {
        let packed = states.pack::<L>(first + block * L::COUNT, results.len());
        O::unpack::<L, O>(&f(packed), results, |whole| whole);
    }
}
