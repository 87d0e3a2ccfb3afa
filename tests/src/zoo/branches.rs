//! Robots with branches that are alike, whose numbers stand side by side.
#![allow(missing_docs, reason = "the fields have no meaning beyond their robot")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![climber::entry()]
}

robot! {
    climber = Climber<T> { m: 1.3, l: 0.35, k: 4.0 }, [9],
        [Trunk, LeftThigh, LeftShin, RightThigh, RightShin, LeftArm, LeftHand, RightArm, RightHand];
    /// Two arms and two legs on a trunk that turns: two sets of two, and what couples them.
    #[joint(waist: revolute([0, 0.2, 1]), world -> trunk, stiffness = k)]
    #[body(trunk, mass = 8, com = [0.01, 0.02, 0.2], inertia = tensor(0.3, 0.01, 0.02, 0.25, 0.03, 0.1))]
    #[joint(left_hip: revolute(x), trunk -> left_thigh, at = [0, 0.1, 0])]
    #[body(left_thigh, mass = m, com = [0.01, 0.02, -0.1], inertia = diag(0.02, 0.021, 0.004))]
    #[joint(left_knee: revolute(y), left_thigh -> left_shin, at = [0, 0.02, -l])]
    #[body(left_shin, mass = 0.6, com = [0.02, 0.01, -0.15], inertia = diag(0.008, 0.009, 0.001))]
    #[joint(right_hip: revolute([-1, 0, 0]), trunk -> right_thigh, at = [0, -0.1, 0])]
    #[body(right_thigh, mass = m, com = [0.01, -0.02, -0.1], inertia = diag(0.02, 0.021, 0.004))]
    #[joint(right_knee: revolute(y), right_thigh -> right_shin, at = [0, -0.02, -l])]
    #[body(right_shin, mass = 0.6, com = [0.02, -0.01, -0.15], inertia = diag(0.008, 0.009, 0.001))]
    #[joint(left_shoulder: revolute([1, 0.5, 0]), trunk -> left_arm, at = [0.02, 0.2, 0.4])]
    #[body(left_arm, mass = 0.8, com = [0.1, 0.03, 0.02], inertia = diag(0.002, 0.01, 0.011))]
    #[joint(left_reach: prismatic([1, 0, 0.2]), left_arm -> left_hand, at = [0.2, 0.01, 0])]
    #[body(left_hand, mass = 0.3, com = [0.05, 0.01, 0], inertia = diag(0.0003, 0.001, 0.001))]
    #[joint(right_shoulder: revolute([1, -0.5, 0]), trunk -> right_arm, at = [0.02, -0.2, 0.4])]
    #[body(right_arm, mass = 0.8, com = [0.1, -0.03, 0.02], inertia = diag(0.002, 0.01, 0.011))]
    #[joint(right_reach: prismatic([1, 0, 0.2]), right_arm -> right_hand, at = [0.2, -0.01, 0])]
    #[body(right_hand, mass = 0.3, com = [0.05, -0.01, 0], inertia = diag(0.0003, 0.001, 0.001))]
    pub struct Climber<T> { pub m: T, pub l: T, pub k: T }
}
