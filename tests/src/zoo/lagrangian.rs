//! Robots with terms of their own in their energies: springs between bodies, added masses, what couples branches.
#![allow(missing_docs, reason = "the fields have no meaning beyond their robot")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![on_a_spring::entry(), tethered::entry(), coupled_arms::entry()]
}

robot! {
    on_a_spring = OnASpring<T> { m: 0.7, k: 30.0, l: 0.4, c: 0.3, j: 0.05 }, [3], [Arm, Bob];
    /// An arm that turns, and on it a bob on a spring; a coordinate without a body that slides against both.
    #[joint(theta: revolute([0, 1, 0.2]), world -> arm)]
    #[body(arm, mass = 0.4, com = [0.05, 0.02, -0.1], inertia = diag(0.02, 0.021, 0.003))]
    #[joint(r: prismatic(-z), arm -> bob)]
    #[body(bob, solid = sphere(m, 5cm))]
    #[coordinate(slip: length, stiffness = k, armature = m / 2)]
    #[potential(k / 2 * (distance(bob, world)^2 - 2 * l * sqrt(distance(bob, world)^2 + l^2)) + k * l^2 / 3 * sin(theta) * cos(r / l))]
    #[dissipation(c / 2 * (dot(r) - dot(slip))^2 + c * l^2 / 1s * sqrt(dot(theta)^2 + 0.01))]
    #[kinetic(j / 2 * (dot(theta) + dot(slip) * cos(theta) / l)^2)]
    #[kinetic(m / 4 * dot(r * sin(theta))^2 / (1 + (r / l)^2))]
    pub struct OnASpring<T> { pub m: T, pub k: T, pub l: T, pub c: T, pub j: T }
}

robot! {
    tethered = Tethered, [free, ball, 1], [Hull, Buoy, Fin, Bow, Keel];
    /// A hull under water: water moves with it, a tether holds it, a buoy hangs on it, and springs lead from body to body.
    #[joint(base: free, world -> hull)]
    #[body(hull, mass = 3, com = [0.02, 0, -0.03], inertia = tensor(0.05, 0.002, 0.001, 0.12, 0.003, 0.13))]
    #[joint(swivel: ball, hull -> buoy, at = [0, 0.1, 0.2])]
    #[body(buoy, mass = 0.6, com = [0, 0.05, 0.2], inertia = diag(0.01, 0.012, 0.004))]
    #[joint(rudder: revolute([0, 0.3, 1]), hull -> fin, at = [-0.3, 0, 0])]
    #[body(fin, mass = 0.2, com = [-0.05, 0, 0], inertia = diag(0.0004, 0.0005, 0.0006))]
    #[joint(bow: fixed, hull -> bow, at = [0.4, 0, 0.05])]
    #[joint(keel: fixed, buoy -> keel, at = [0, 0.1, 0.4])]
    #[potential(8N_per_m / 2 * distance(world, bow)^2 - 20N * base.z + 3N * z(keel))]
    #[potential(5N_per_m / 2 * (distance(fin, keel) - 0.3)^2)]
    #[dissipation(2Ns_per_m / 2 * (base.vx^2 + 3 * base.vy^2 + 4 * base.vz^2) + 0.1Nms / 2 * (swivel.wx^2 + swivel.wz^2))]
    #[dissipation(0.3Ns_per_m / 2 * dot(distance(fin, keel))^2)]
    #[kinetic(0.4kg / 2 * base.vx^2 + 2.5kg / 2 * base.vy^2 + 0.02kg_m2 / 2 * base.wz^2 + 0.1kg * 1m * base.vy * base.wz)]
    #[kinetic(0.003kg_m2 / 2 * (dot(rudder) + sin(rudder) * swivel.wy)^2)]
    #[kinetic(0.3kg / 2 * dot(base.x)^2)]
    pub struct Tethered;
}

robot! {
    coupled_arms = CoupledArms, [8], [Left1, Left2, Left3, Left4, Right1, Right2, Right3, Right4, Palm];
    /// Two arms on one world, which a belt couples by its inertia, and a spring from hand to hand.
    #[joint(l1: revolute(z), world -> left1, at = [0, 0.2, 0])]
    #[body(left1, mass = 1.2, com = [0.1, 0, 0.05], inertia = diag(0.01, 0.02, 0.02))]
    #[joint(l2: revolute(-y), left1 -> left2, at = [0.2, 0, 0.1])]
    #[body(left2, mass = 0.9, com = [0.12, 0.01, 0], inertia = diag(0.004, 0.012, 0.012))]
    #[joint(l3: prismatic(x), left2 -> left3, at = [0.25, 0, 0])]
    #[body(left3, mass = 0.5, com = [0.05, 0, 0.01], inertia = diag(0.001, 0.003, 0.003))]
    #[joint(l4: revolute(x), left3 -> left4, at = [0.1, 0, 0])]
    #[body(left4, mass = 0.3, com = [0.02, 0.03, 0.01], inertia = diag(0.0006, 0.0008, 0.0007))]
    #[joint(r1: revolute(z), world -> right1, at = [0, -0.2, 0])]
    #[body(right1, mass = 1.2, com = [0.1, 0, 0.05], inertia = diag(0.01, 0.02, 0.02))]
    #[joint(r2: revolute(-y), right1 -> right2, at = [0.2, 0, 0.1])]
    #[body(right2, mass = 0.9, com = [0.12, -0.01, 0], inertia = diag(0.004, 0.012, 0.012))]
    #[joint(r3: revolute([0, 1, 1]), right2 -> right3, at = [0.25, 0, 0])]
    #[body(right3, mass = 0.5, com = [0.05, 0, 0.01], inertia = diag(0.001, 0.003, 0.003))]
    #[joint(r4: revolute(x), right3 -> right4, at = [0.1, 0, 0], mimic = r3, ratio = -0.5)]
    #[body(right4, mass = 0.3, com = [0.02, -0.03, 0.01], inertia = diag(0.0006, 0.0008, 0.0007))]
    #[joint(hand: revolute(z), right4 -> palm, at = [0.05, 0, 0])]
    #[body(palm, solid = sphere(0.1, 0.05))]
    #[potential(25N_per_m / 2 * (distance(left4, palm) - 0.5)^2)]
    #[kinetic(0.02kg_m2 / 2 * (dot(l1) - 2 * dot(r2) + dot(r4))^2)]
    #[dissipation(0.1Nms / 2 * (dot(l4) - dot(hand))^2)]
    pub struct CoupledArms;
}
