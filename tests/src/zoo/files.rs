//! Robots from files, with what is said beside them.
#![allow(
    missing_docs,
    reason = "frames are named by the files, and fields have no meaning beyond their robot"
)]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![loaded_scara::entry(), puma560_with_rotors::entry(), hyq::entry()]
}

robot! {
    puma560_with_rotors = Puma560WithRotors as f64, [6],
    [Base, Link1, Link2, Link3, Link4, Link5, Link6, Tool];
    /// The PUMA 560 of `puma560_armature/model.urdf` with the rotors that a URDF has no word for.
    #[dynamics(urdf = "robots/puma560_armature/model.urdf", allow(nonphysical_inertia))]
    #[joint([joint1], armature = 0.784029968642)]
    #[joint([joint2], armature = 2.324814845)]
    #[joint([joint3], armature = 0.576873331938)]
    #[joint([joint4], armature = 0.19079062612368)]
    #[joint([joint5], armature = 0.17070629165700002)]
    #[joint([joint6], armature = 0.19406450566800004)]
    pub struct Puma560WithRotors;
}

robot! {
    loaded_scara = LoadedScara<T> { m: 1.6, reach: 0.07, c: 0.3, k: 25.0 }, [3],
    [Base, Link1, Link2, Link3, Link4, Tool, Payload];
    /// The SCARA of a file with a payload that is a field, a spring and a damper beside it, and one joint locked.
    #[dynamics(urdf = "robots/scara/model.urdf")]
    #[joint(joint1, damping = c, rotor = 3e-5, gear = 100)]
    #[joint(joint2, stiffness = k, rest = 0.4, actuated = off)]
    #[joint(joint4, locked = 30deg)]
    #[joint(grip: fixed, tool -> payload, at = [reach, 0, 0.02], rpy = [0, 0.2, 0])]
    #[body(payload, solid = cuboid(m, [10cm, 6cm, 4cm]))]
    #[body(link4, mass = m / 4)]
    pub struct LoadedScara<T> { pub m: T, pub reach: T, pub c: T, pub k: T }
}

robot! {
    hyq = Hyq as f64, [free, 12],
    [BaseLink, Trunk, LfHipassembly, LfUpperleg, LfLowerleg, LfFoot, RfHipassembly, RfUpperleg, RfLowerleg, RfFoot,
        LhHipassembly, LhUpperleg, LhLowerleg, LhFoot, RhHipassembly, RhUpperleg, RhLowerleg, RhFoot, TrunkImu];
    /// The quadruped HyQ of `hyq/model.urdf`, standing on nothing.
    #[dynamics(urdf = "robots/hyq/model.urdf", base = free)]
    pub struct Hyq;
}
