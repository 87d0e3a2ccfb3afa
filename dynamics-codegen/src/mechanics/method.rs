//! What is asked of a robot: methods, their arguments, and the blocks of numbers that they return.

use crate::model::Model;
use crate::symbolic::{Expr, Graph, SymbolId};

/// What a generated method computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// `M(q)`
    MassMatrix,
    /// `C(q,v)`
    CoriolisMatrix,
    /// `G(q)`
    GravityForces,
    /// `C·v + G` and passive forces
    BiasForces,
    /// What dampers, friction and springs do.
    PassiveForces,
    /// `τ`
    InverseDynamics,
    /// `a`
    ForwardDynamics,
    /// `M⁻¹`
    InverseMassMatrix,
    /// `T`
    KineticEnergy,
    /// `V`
    PotentialEnergy,
    /// Of springs.
    ElasticEnergy,
    /// `T − V`
    Lagrangian,
    /// `M`, `C` and `G`
    EquationsOfMotion,
    /// `∂τ/∂q`, `∂τ/∂v`, `∂τ/∂a`
    InverseDynamicsDerivatives,
    /// `∂a/∂q`, `∂a/∂v`, `∂a/∂τ`
    ForwardDynamicsDerivatives,
    /// `τ` and its derivatives
    InverseDynamicsWithDerivatives,
    /// `a` and its derivatives
    ForwardDynamicsWithDerivatives,
    /// The centre of mass.
    CenterOfMass,
    /// Its Jacobian.
    CenterOfMassJacobian,
    /// The momentum about it.
    CentroidalMomentum,
    /// The matrix that takes speeds to it.
    CentroidalMomentumMatrix,
    /// The mass of all that moves.
    TotalMass,
    /// `Y` of `τ = Y·π`
    Regressor,
    /// `π`
    InertialParameters,
    /// `Y` of the parameters that can be told apart.
    BaseRegressor,
    /// These parameters.
    BaseParameters,
    /// The pose of a frame.
    Pose(usize),
    /// The body Jacobian of a frame.
    Jacobian(usize),
    /// The Jacobian of a frame in world axes.
    WorldJacobian(usize),
    /// The twist of a frame in its own axes.
    Velocity(usize),
    /// The rate of that twist.
    Acceleration(usize),
}

impl Method {
    /// The methods of robots, trait by trait.
    pub const OF_ROBOT: [Method; 26] = [
        Method::MassMatrix,
        Method::InverseMassMatrix,
        Method::CoriolisMatrix,
        Method::GravityForces,
        Method::PassiveForces,
        Method::BiasForces,
        Method::InverseDynamics,
        Method::ForwardDynamics,
        Method::KineticEnergy,
        Method::PotentialEnergy,
        Method::ElasticEnergy,
        Method::Lagrangian,
        Method::EquationsOfMotion,
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamicsDerivatives,
        Method::InverseDynamicsWithDerivatives,
        Method::ForwardDynamicsWithDerivatives,
        Method::TotalMass,
        Method::CenterOfMass,
        Method::CenterOfMassJacobian,
        Method::CentroidalMomentum,
        Method::CentroidalMomentumMatrix,
        Method::Regressor,
        Method::InertialParameters,
        Method::BaseRegressor,
        Method::BaseParameters,
    ];

    /// The methods of a frame.
    pub fn of_frame(frame: usize) -> [Method; 5] {
        [
            Method::Pose(frame),
            Method::Jacobian(frame),
            Method::WorldJacobian(frame),
            Method::Velocity(frame),
            Method::Acceleration(frame),
        ]
    }

    /// The trait that has the method.
    pub fn trait_(self) -> Trait {
        match self {
            Method::MassMatrix
            | Method::InverseMassMatrix
            | Method::CoriolisMatrix
            | Method::GravityForces
            | Method::PassiveForces
            | Method::BiasForces
            | Method::InverseDynamics
            | Method::ForwardDynamics
            | Method::KineticEnergy
            | Method::PotentialEnergy
            | Method::ElasticEnergy
            | Method::Lagrangian
            | Method::EquationsOfMotion => Trait::Dynamics,
            Method::InverseDynamicsDerivatives
            | Method::ForwardDynamicsDerivatives
            | Method::InverseDynamicsWithDerivatives
            | Method::ForwardDynamicsWithDerivatives => Trait::DynamicsDerivatives,
            Method::TotalMass
            | Method::CenterOfMass
            | Method::CenterOfMassJacobian
            | Method::CentroidalMomentum
            | Method::CentroidalMomentumMatrix => Trait::CentroidalDynamics,
            Method::Regressor | Method::InertialParameters => Trait::Regressor,
            Method::BaseRegressor | Method::BaseParameters => Trait::BaseRegressor,
            Method::Pose(_)
            | Method::Jacobian(_)
            | Method::WorldJacobian(_)
            | Method::Velocity(_)
            | Method::Acceleration(_) => Trait::Frame,
        }
    }

    /// Whether the trait has it by default where a robot has none of its own.
    pub fn is_provided(self) -> bool {
        matches!(
            self,
            Method::InverseMassMatrix
                | Method::PassiveForces
                | Method::ElasticEnergy
                | Method::EquationsOfMotion
                | Method::InverseDynamicsWithDerivatives
                | Method::ForwardDynamicsWithDerivatives
                | Method::CenterOfMassJacobian
                | Method::CentroidalMomentum
        )
    }

    /// The method's name in the trait.
    pub fn name(self) -> &'static str {
        match self {
            Method::MassMatrix => "mass_matrix",
            Method::CoriolisMatrix => "coriolis_matrix",
            Method::GravityForces => "gravity_forces",
            Method::BiasForces => "bias_forces",
            Method::PassiveForces => "passive_forces",
            Method::InverseDynamics => "inverse_dynamics",
            Method::ForwardDynamics => "forward_dynamics",
            Method::InverseMassMatrix => "inverse_mass_matrix",
            Method::KineticEnergy => "kinetic_energy",
            Method::PotentialEnergy => "potential_energy",
            Method::ElasticEnergy => "elastic_energy",
            Method::Lagrangian => "lagrangian",
            Method::EquationsOfMotion => "equations_of_motion",
            Method::InverseDynamicsDerivatives => "inverse_dynamics_derivatives",
            Method::ForwardDynamicsDerivatives => "forward_dynamics_derivatives",
            Method::InverseDynamicsWithDerivatives => "inverse_dynamics_with_derivatives",
            Method::ForwardDynamicsWithDerivatives => "forward_dynamics_with_derivatives",
            Method::CenterOfMass => "center_of_mass",
            Method::CenterOfMassJacobian => "center_of_mass_jacobian",
            Method::CentroidalMomentum => "centroidal_momentum",
            Method::CentroidalMomentumMatrix => "centroidal_momentum_matrix",
            Method::TotalMass => "total_mass",
            Method::Regressor => "regressor",
            Method::InertialParameters => "inertial_parameters",
            Method::BaseRegressor => "base_regressor",
            Method::BaseParameters => "base_parameters",
            Method::Pose(_) => "pose",
            Method::Jacobian(_) => "jacobian",
            Method::WorldJacobian(_) => "world_jacobian",
            Method::Velocity(_) => "velocity",
            Method::Acceleration(_) => "acceleration",
        }
    }

    /// Of a bundle, and of the method that gives all of it but the first block: the one and the other.
    pub fn bundle_and_part(self) -> Option<[Method; 2]> {
        use Method::{ForwardDynamicsDerivatives, ForwardDynamicsWithDerivatives};
        use Method::{InverseDynamicsDerivatives, InverseDynamicsWithDerivatives};
        match self {
            InverseDynamicsWithDerivatives | InverseDynamicsDerivatives => {
                Some([InverseDynamicsWithDerivatives, InverseDynamicsDerivatives])
            }
            ForwardDynamicsWithDerivatives | ForwardDynamicsDerivatives => {
                Some([ForwardDynamicsWithDerivatives, ForwardDynamicsDerivatives])
            }
            _ => None,
        }
    }

    /// The frame that the method belongs to.
    pub fn frame(self) -> Option<usize> {
        match self {
            Method::Pose(frame)
            | Method::Jacobian(frame)
            | Method::WorldJacobian(frame)
            | Method::Velocity(frame)
            | Method::Acceleration(frame) => Some(frame),
            _ => None,
        }
    }

    /// The arguments of the method.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, Q, Tau, V};
        match self {
            Method::MassMatrix
            | Method::InverseMassMatrix
            | Method::GravityForces
            | Method::PotentialEnergy
            | Method::ElasticEnergy
            | Method::CenterOfMass
            | Method::CenterOfMassJacobian
            | Method::CentroidalMomentumMatrix
            | Method::Pose(_)
            | Method::Jacobian(_)
            | Method::WorldJacobian(_) => &[Q],
            Method::TotalMass | Method::InertialParameters | Method::BaseParameters => &[],
            Method::CoriolisMatrix
            | Method::BiasForces
            | Method::PassiveForces
            | Method::KineticEnergy
            | Method::Lagrangian
            | Method::EquationsOfMotion
            | Method::CentroidalMomentum
            | Method::Velocity(_) => &[Q, V],
            Method::InverseDynamics
            | Method::InverseDynamicsDerivatives
            | Method::InverseDynamicsWithDerivatives
            | Method::Regressor
            | Method::BaseRegressor
            | Method::Acceleration(_) => &[Q, V, A],
            Method::ForwardDynamics
            | Method::ForwardDynamicsDerivatives
            | Method::ForwardDynamicsWithDerivatives => &[Q, V, Tau],
        }
    }
}

/// A trait of generated methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trait {
    /// The equations of motion.
    Dynamics,
    /// Their derivatives.
    DynamicsDerivatives,
    /// The robot as a whole.
    CentroidalDynamics,
    /// Forces by parameters.
    Regressor,
    /// Forces by the parameters that can be told apart.
    BaseRegressor,
    /// The kinematics of a frame.
    Frame,
}

impl Trait {
    /// Those of a robot.
    pub const OF_ROBOT: [Trait; 5] = [
        Trait::Dynamics,
        Trait::DynamicsDerivatives,
        Trait::CentroidalDynamics,
        Trait::Regressor,
        Trait::BaseRegressor,
    ];

    /// Whether its methods take the robot's mass for forces and energies, and not as parameters or as a whole.
    pub fn is_of_forces(self) -> bool {
        matches!(self, Trait::Dynamics | Trait::DynamicsDerivatives)
    }

    /// The name in the run time.
    pub fn name(self) -> &'static str {
        match self {
            Trait::Dynamics => "Dynamics",
            Trait::DynamicsDerivatives => "DynamicsDerivatives",
            Trait::CentroidalDynamics => "CentroidalDynamics",
            Trait::Regressor => "Regressor",
            Trait::BaseRegressor => "BaseRegressor",
            Trait::Frame => "Frame",
        }
    }
}

/// A vector that a method is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Argument {
    /// Coordinates.
    Q,
    /// Speeds.
    V,
    /// Accelerations.
    A,
    /// Joint forces.
    Tau,
}

impl Argument {
    /// All of them, in order.
    pub const ALL: [Argument; 4] = [Argument::Q, Argument::V, Argument::A, Argument::Tau];

    /// The argument's name.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::A => "a",
            Argument::Tau => "tau",
        }
    }
}

/// The inputs of the equations: parameters first, then coordinates, speeds, accelerations, forces.
#[derive(Clone, Copy, Debug)]
pub struct Inputs {
    /// How many parameters there are.
    pub parameters: usize,
    /// How many coordinates, NQ.
    pub coordinates: usize,
    /// How many degrees of freedom, NV.
    pub dof: usize,
}

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// The field with this index among the model's parameters.
    Parameter(usize),
    /// A component of an argument.
    Argument(Argument, usize),
}

impl Inputs {
    /// Those of a robot.
    pub fn of(model: &Model<'_>) -> Self {
        let (coordinates, dof) = (model.tree.coordinates(), model.tree.dof());
        Self { parameters: model.parameters.len(), coordinates, dof }
    }

    /// The meaning of a symbol.
    pub fn meaning(self, symbol: SymbolId) -> Input {
        let index = symbol.0 as usize;
        let Some(component) = index.checked_sub(self.parameters) else { return Input::Parameter(index) };
        match component.checked_sub(self.coordinates) {
            None => Input::Argument(Argument::Q, component),
            Some(rest) => Input::Argument(Argument::ALL[1 + rest / self.dof], rest % self.dof),
        }
    }

    /// How many components an argument has.
    pub fn size(self, argument: Argument) -> usize {
        match argument {
            Argument::Q => self.coordinates,
            Argument::V | Argument::A | Argument::Tau => self.dof,
        }
    }

    /// The symbol of a component of an argument.
    pub fn symbol(self, argument: Argument, k: usize) -> SymbolId {
        let before = match argument {
            Argument::Q => 0,
            _ => self.coordinates + (argument as usize - 1) * self.dof,
        };
        let index = self.parameters + before + k;
        SymbolId(u32::try_from(index).expect("fewer than 2^32 inputs"))
    }

    /// The components of an argument.
    pub fn vector<'g>(self, graph: &'g Graph, argument: Argument) -> Vec<Expr<'g>> {
        (0..self.size(argument)).map(|k| graph.variable(self.symbol(argument, k))).collect()
    }
}

/// A block of numbers that a method returns.
#[derive(Clone, Debug)]
pub struct Block<'g> {
    /// A letter for its entries, and the field that takes it where a method returns several.
    pub name: &'static str,
    /// The shape.
    pub shape: Shape,
    /// The entries, by rows.
    pub entries: Vec<Expr<'g>>,
}

/// The shape of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Scalar,
    /// A column.
    Vector(usize),
    /// Rows and columns.
    Matrix(usize, usize),
}

/// One method's result.
#[derive(Clone, Debug)]
pub struct Equation<'g> {
    /// Which method.
    pub method: Method,
    /// What it returns.
    pub blocks: Vec<Block<'g>>,
}
