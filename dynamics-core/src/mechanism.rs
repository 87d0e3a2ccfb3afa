//! What is constant about a robot: sizes, names, limits, and what its equations cost.

use core::fmt;

/// The constants of a robot, without type parameters, so that `Iiwa14::JOINT_NAMES` is all one writes.
pub trait Mechanism {
    /// The number of configuration coordinates, the length of `q`.
    const NQ: usize;
    /// The number of velocities, the length of `v`, `a` and `tau`.
    const NV: usize;
    /// The number of actuators, the length of `u`.
    const NU: usize;
    /// The robot's name.
    const NAME: &'static str;
    /// The moving joints, in the order of their coordinates; a free joint is one.
    const JOINT_NAMES: &'static [&'static str];
    /// The bodies, parents before children; the world is not one of them.
    const BODY_NAMES: &'static [&'static str];
    /// The coordinates, in the order of `q`: the joint's name, or where it has several `root_joint.x`, `root_joint.qw`.
    const COORDINATE_NAMES: &'static [&'static str] = &[];
    /// The directions of the tangent space, in the order of `v`: `δ` of `q ⊕ δ`.
    ///
    /// The name of the coordinate where there is one; `.rx` to `.rz` of the rotations of a ball or free joint about the
    /// body's axes, `.dx` to `.dz` of the displacements of a free one along them.
    const DISPLACEMENT_NAMES: &'static [&'static str] = &[];
    /// The speeds, in the order of `v`: the joint's name, or where it has several `root_joint.vx`, `root_joint.wz`.
    const SPEED_NAMES: &'static [&'static str] = &[];
    /// Whether each speed is that of an angle or of a distance, in the order of `v`.
    const MOTIONS: &'static [Motion] = &[];
    /// The speed that each input drives, by its index in `v`, in the order of `u`.
    const ACTUATED: &'static [usize] = &[];
    /// For each body the index of the one that it hangs on; `None` is the world. Empty where nobody said.
    const BODY_PARENTS: &'static [Option<usize>] = &[];
    /// The limits, one entry per velocity coordinate, in the order of `v`.
    const LIMITS: &'static [JointLimits];
    /// The inertial parameters `π`, in their order in [`Regressor`](crate::Regressor); empty without one.
    const PARAMETER_NAMES: &'static [&'static str] = &[];
    /// The base parameters `π_b`, in their order in [`BaseRegressor`](crate::BaseRegressor); empty without one.
    const BASE_PARAMETER_NAMES: &'static [&'static str] = &[];
    /// The number of inertial parameters, the length of `π`; zero without a [`Regressor`](crate::Regressor).
    const NP: usize = Self::PARAMETER_NAMES.len();
    /// The number of base parameters, the length of `π_b`; zero without a [`BaseRegressor`](crate::BaseRegressor).
    const NB: usize = Self::BASE_PARAMETER_NAMES.len();
    /// The operations each method takes; on a robot with parameters, after `prepare`. Of a method so long that it
    /// recurses over a table of links, an estimate, as its documentation says; all others are counted.
    const COST: Costs;
}

/// What a velocity coordinate moves by, and so its units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// An angle: rad, rad/s, rad/s², N·m.
    Rotation,
    /// A distance: m, m/s, m/s², N.
    Translation,
}

impl Motion {
    /// The unit of the coordinate: `rad` or `m`.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Rotation => "rad",
            Self::Translation => "m",
        }
    }

    /// The unit of the speed: `rad/s` or `m/s`.
    #[must_use]
    pub const fn speed_unit(self) -> &'static str {
        match self {
            Self::Rotation => "rad/s",
            Self::Translation => "m/s",
        }
    }

    /// The unit of the acceleration: `rad/s²` or `m/s²`.
    #[must_use]
    pub const fn acceleration_unit(self) -> &'static str {
        match self {
            Self::Rotation => "rad/s²",
            Self::Translation => "m/s²",
        }
    }

    /// The unit of the joint force: `N·m` or `N`.
    #[must_use]
    pub const fn force_unit(self) -> &'static str {
        match self {
            Self::Rotation => "N·m",
            Self::Translation => "N",
        }
    }
}

/// The limits of one velocity coordinate, in rad, rad/s, N·m (prismatic: m, m/s, N).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointLimits {
    /// The least coordinate; −∞ if there is none.
    pub lower: f64,
    /// The greatest coordinate; ∞ if there is none.
    pub upper: f64,
    /// The greatest speed; ∞ if there is none.
    pub velocity: f64,
    /// The greatest joint force; ∞ if there is none.
    pub effort: f64,
}

impl JointLimits {
    /// No limits: every bound is infinite.
    pub const NONE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        velocity: f64::INFINITY,
        effort: f64::INFINITY,
    };
}

impl Default for JointLimits {
    fn default() -> Self {
        Self::NONE
    }
}

/// The operations of one straight-line function; displayed like `193 mul, 183 add, 7 sincos`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cost {
    /// Products, those within a fused multiply-add too.
    pub multiplications: u32,
    /// Sums and differences, those within a fused multiply-add too.
    pub additions: u32,
    /// Quotients and reciprocals.
    pub divisions: u32,
    /// Square roots.
    pub square_roots: u32,
    /// Evaluations of a sine with its cosine.
    pub sines_and_cosines: u32,
}

impl Cost {
    /// No operations.
    pub const ZERO: Self =
        Self { multiplications: 0, additions: 0, divisions: 0, square_roots: 0, sines_and_cosines: 0 };
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entries = [
            (self.multiplications, "mul"),
            (self.additions, "add"),
            (self.divisions, "div"),
            (self.square_roots, "sqrt"),
            (self.sines_and_cosines, "sincos"),
        ];
        let mut separator = "";
        for (count, name) in entries {
            if count > 0 {
                write!(f, "{separator}{count} {name}")?;
                separator = ", ";
            }
        }
        if separator.is_empty() { f.write_str("nothing") } else { Ok(()) }
    }
}

/// The operations of every method of a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Costs {
    /// Of [`mass_matrix`](crate::Dynamics::mass_matrix).
    pub mass_matrix: Cost,
    /// Of [`inverse_mass_matrix`](crate::Dynamics::inverse_mass_matrix).
    pub inverse_mass_matrix: Cost,
    /// Of [`coriolis_matrix`](crate::Dynamics::coriolis_matrix).
    pub coriolis_matrix: Cost,
    /// Of [`gravity_forces`](crate::Dynamics::gravity_forces).
    pub gravity_forces: Cost,
    /// Of [`passive_forces`](crate::Dynamics::passive_forces).
    pub passive_forces: Cost,
    /// Of [`bias_forces`](crate::Dynamics::bias_forces).
    pub bias_forces: Cost,
    /// Of [`inverse_dynamics`](crate::Dynamics::inverse_dynamics).
    pub inverse_dynamics: Cost,
    /// Of [`forward_dynamics`](crate::Dynamics::forward_dynamics).
    pub forward_dynamics: Cost,
    /// Of [`kinetic_energy`](crate::Dynamics::kinetic_energy).
    pub kinetic_energy: Cost,
    /// Of [`potential_energy`](crate::Dynamics::potential_energy).
    pub potential_energy: Cost,
    /// Of [`elastic_energy`](crate::Dynamics::elastic_energy).
    pub elastic_energy: Cost,
    /// Of [`lagrangian`](crate::Dynamics::lagrangian).
    pub lagrangian: Cost,
    /// Of [`equations_of_motion`](crate::Dynamics::equations_of_motion).
    pub equations_of_motion: Cost,
    /// Of [`inverse_dynamics_derivatives`](crate::DynamicsDerivatives::inverse_dynamics_derivatives).
    pub inverse_dynamics_derivatives: Cost,
    /// Of [`inverse_dynamics_with_derivatives`](crate::DynamicsDerivatives::inverse_dynamics_with_derivatives).
    pub inverse_dynamics_with_derivatives: Cost,
    /// Of [`forward_dynamics_derivatives`](crate::DynamicsDerivatives::forward_dynamics_derivatives).
    pub forward_dynamics_derivatives: Cost,
    /// Of [`forward_dynamics_with_derivatives`](crate::DynamicsDerivatives::forward_dynamics_with_derivatives).
    pub forward_dynamics_with_derivatives: Cost,
    /// Of [`total_mass`](crate::CentroidalDynamics::total_mass).
    pub total_mass: Cost,
    /// Of [`center_of_mass`](crate::CentroidalDynamics::center_of_mass).
    pub center_of_mass: Cost,
    /// Of [`center_of_mass_jacobian`](crate::CentroidalDynamics::center_of_mass_jacobian).
    pub center_of_mass_jacobian: Cost,
    /// Of [`centroidal_momentum`](crate::CentroidalDynamics::centroidal_momentum).
    pub centroidal_momentum: Cost,
    /// Of [`centroidal_momentum_matrix`](crate::CentroidalDynamics::centroidal_momentum_matrix).
    pub centroidal_momentum_matrix: Cost,
    /// Of [`regressor`](crate::Regressor::regressor).
    pub regressor: Cost,
    /// Of [`inertial_parameters`](crate::Regressor::inertial_parameters).
    pub inertial_parameters: Cost,
    /// Of [`base_regressor`](crate::BaseRegressor::base_regressor).
    pub base_regressor: Cost,
    /// Of [`base_parameters`](crate::BaseRegressor::base_parameters).
    pub base_parameters: Cost,
    /// Of `prepare`, the work that depends on parameters alone.
    pub prepare: Cost,
}

impl Costs {
    /// No operations anywhere.
    pub const ZERO: Self = Self {
        mass_matrix: Cost::ZERO,
        inverse_mass_matrix: Cost::ZERO,
        coriolis_matrix: Cost::ZERO,
        gravity_forces: Cost::ZERO,
        passive_forces: Cost::ZERO,
        bias_forces: Cost::ZERO,
        inverse_dynamics: Cost::ZERO,
        forward_dynamics: Cost::ZERO,
        kinetic_energy: Cost::ZERO,
        potential_energy: Cost::ZERO,
        elastic_energy: Cost::ZERO,
        lagrangian: Cost::ZERO,
        equations_of_motion: Cost::ZERO,
        inverse_dynamics_derivatives: Cost::ZERO,
        inverse_dynamics_with_derivatives: Cost::ZERO,
        forward_dynamics_derivatives: Cost::ZERO,
        forward_dynamics_with_derivatives: Cost::ZERO,
        total_mass: Cost::ZERO,
        center_of_mass: Cost::ZERO,
        center_of_mass_jacobian: Cost::ZERO,
        centroidal_momentum: Cost::ZERO,
        centroidal_momentum_matrix: Cost::ZERO,
        regressor: Cost::ZERO,
        inertial_parameters: Cost::ZERO,
        base_regressor: Cost::ZERO,
        base_parameters: Cost::ZERO,
        prepare: Cost::ZERO,
    };
}

/// The operations of the methods of a [`Frame`](crate::Frame).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrameCosts {
    /// Of `pose`.
    pub pose: Cost,
    /// Of `jacobian`.
    pub jacobian: Cost,
    /// Of `world_jacobian`.
    pub world_jacobian: Cost,
    /// Of `velocity`.
    pub velocity: Cost,
    /// Of `acceleration`.
    pub acceleration: Cost,
}

impl FrameCosts {
    /// No operations.
    pub const ZERO: Self = Self {
        pose: Cost::ZERO,
        jacobian: Cost::ZERO,
        world_jacobian: Cost::ZERO,
        velocity: Cost::ZERO,
        acceleration: Cost::ZERO,
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn zero_entries_are_left_out() {
        let cost = Cost { multiplications: 193, additions: 183, sines_and_cosines: 7, ..Cost::ZERO };
        assert_eq!(cost.to_string(), "193 mul, 183 add, 7 sincos");
        assert_eq!(Cost { divisions: 1, ..Cost::ZERO }.to_string(), "1 div");
        assert_eq!(Cost::ZERO.to_string(), "nothing");
    }

    #[test]
    fn zero_is_the_default() {
        assert_eq!(Costs::ZERO, Costs::default());
        assert_eq!(FrameCosts::ZERO, FrameCosts::default());
    }
}
