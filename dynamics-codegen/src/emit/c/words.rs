//! What the comments of C say: of each function what it computes, of each result its frame, unit and sign.

use crate::mechanics::equations::Method;
use crate::passes::Cost;

/// What a function computes, of a robot with terms of its own in its energies or without.
pub(super) fn headline(method: Method, has_terms: bool) -> &'static str {
    match method {
        Method::PotentialEnergy if has_terms => "V(q), of gravity and of terms of its own, in J.",
        Method::PassiveForces if has_terms => {
            "What dampers, friction, springs and terms of dissipation do, on the side of M a."
        }
        Method::Regressor if has_terms => {
            "Y with tau = Y pi, pi the inertial parameters of all bodies, and 1 for each term of the energies."
        }
        Method::MassMatrix => "M(q), symmetric and positive definite.",
        Method::InverseMassMatrix => "The inverse of M(q).",
        Method::CoriolisMatrix => "C(q,v), the one with dM/dt = C + C^T.",
        Method::GravityForces => "G(q) = dV/dq: the joint forces that hold the robot still.",
        Method::PassiveForces => "What dampers, friction and springs do, on the side of M a.",
        Method::BiasForces => "h = C(q,v) v + G(q), and passive forces where there are any.",
        Method::InverseDynamics => "tau = M(q) a + C(q,v) v + G(q), and passive forces where there are any.",
        Method::ForwardDynamics => "a, the accelerations under the joint forces tau.",
        Method::KineticEnergy => "T = v^T M(q) v / 2, in J.",
        Method::PotentialEnergy => "V(q), of gravity, in J.",
        Method::ElasticEnergy => "The energy of springs in joints, in J.",
        Method::Lagrangian => "L = T - V, in J.",
        Method::EquationsOfMotion => "M(q), C(q,v) and G(q) in one call, which is less work than three.",
        Method::InverseDynamicsDerivatives => "The derivatives of tau by q, v and a; the last is M(q).",
        Method::ForwardDynamicsDerivatives => {
            "The derivatives of a by q, v and tau; the last is the inverse of M(q)."
        }
        Method::InverseDynamicsWithDerivatives => {
            "tau, and its derivatives by q, v and a, which share their work."
        }
        Method::ForwardDynamicsWithDerivatives => {
            "a, and its derivatives by q, v and tau, which share their work."
        }
        Method::TotalMass => "The mass of all that moves, in kg.",
        Method::CenterOfMass => "The centre of mass in the world, in m.",
        Method::CenterOfMassJacobian => "The velocity of the centre of mass for each unit speed.",
        Method::CentroidalMomentum => {
            "The momentum (kg m/s), then the angular momentum about the centre of mass (kg m^2/s), in world axes."
        }
        Method::CentroidalMomentumMatrix => "The matrix that takes v to that momentum.",
        Method::Regressor => "Y with tau = Y pi, pi the inertial parameters of all bodies.",
        Method::InertialParameters => "pi: of each body m, m c, and the moments about its frame's origin.",
        Method::BaseRegressor => "Y with tau = Y pi for the parameters that can be told apart.",
        Method::BaseParameters => "The parameters that can be told apart.",
        Method::Pose(_) => "Where the frame is: x_world = R x + p; p in m.",
        Method::Jacobian(_) => "The twist of the frame in its own axes, linear first, for each unit speed.",
        Method::WorldJacobian(_) => {
            "The velocity of the frame's origin, then the angular one, in world axes, for each unit speed."
        }
        Method::Velocity(_) => "The twist of the frame in its own axes: m/s, then rad/s.",
        Method::Acceleration(_) => "The rate of that twist: m/s^2, then rad/s^2.",
    }
}

/// The names of a method's results, by the names of its blocks.
pub(super) fn result(block: &str) -> &'static str {
    match block {
        "mass_matrix" => "M",
        "inverse_mass_matrix" => "W",
        "coriolis_matrix" => "C",
        "gravity_forces" => "G",
        "rotation" => "R",
        "translation" => "p",
        "tau" => "tau_out",
        "a" => "a",
        "dtau_dq" => "dtau_dq",
        "dtau_dv" => "dtau_dv",
        "dtau_da" => "dtau_da",
        "da_dq" => "da_dq",
        "da_dv" => "da_dv",
        "da_dtau" => "da_dtau",
        _ => "result",
    }
}

/// `193 multiplications, 183 additions, 7 sines with their cosines`
pub(super) fn describe(cost: Cost) -> String {
    let parts = [
        (cost.multiplications, "multiplications"),
        (cost.additions, "additions"),
        (cost.divisions, "divisions"),
        (cost.square_roots, "square roots"),
        (cost.sines_and_cosines, "sines with their cosines"),
    ];
    let parts = parts.iter().filter(|(count, _)| *count > 0);
    let part = |&(count, name): &(u32, &str)| match (count, name) {
        (1, "sines with their cosines") => "1 sine with its cosine".to_owned(),
        (1, name) => format!("1 {}", name.trim_end_matches('s')),
        _ => format!("{count} {name}"),
    };
    let parts: Vec<String> = parts.map(part).collect();
    if parts.is_empty() { "No arithmetic.".to_owned() } else { parts.join(", ") + "." }
}

/// The text as a comment of lines no longer than 100 characters.
pub(super) fn comment(lines: &[String]) -> String {
    let safe = |text: &str| text.replace("*/", "* /");
    match lines {
        [only] => format!("/* {} */\n", safe(only)),
        _ => {
            let lines: Vec<String> = lines.iter().map(|line| safe(line)).collect();
            format!("/* {}\n */\n", lines.join("\n * ").replace(" * \n", " *\n"))
        }
    }
}
