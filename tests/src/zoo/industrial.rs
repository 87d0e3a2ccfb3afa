//! Robots whose numbers are published, and checked against Pinocchio.
#![allow(missing_docs, reason = "frames and constants are named by the specifications")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![
        reference_cart_pole::entry(),
        planar_2dof::entry(),
        planar_2dof_continuous::entry(),
        scara::entry(),
        puma560::entry(),
        puma560_by_dh::entry(),
        iiwa14::entry(),
    ]
}

robot! {
    puma560_by_dh = Puma560ByDh, [6],
    [Link1, Link2, Link3, Link4, Link5, Link6];
    /// PUMA 560 by Denavit and Hartenberg's parameters, centres and moments in the distal frames: B. Armstrong,
    /// O. Khatib, J. Burdick 1986, as collected by P. Corke, B. Armstrong-Hélouvry 1994.
    #[joint(joint1: revolute, world -> link1, dh(0, 90deg, 671.83mm, 0), limits = [-160deg, 160deg])]
    #[body(link1, mass = 0, inertia = diag(0, 0.35, 0), allow(nonphysical_inertia))]
    #[joint(joint2: revolute, link1 -> link2, dh(431.8mm, 0, 0, 0), limits = [-110deg, 110deg])]
    #[body(link2, mass = 17.4, com = [-0.3638, 0.006, 0.2275], inertia = diag(0.13, 0.524, 0.539))]
    #[joint(joint3: revolute, link2 -> link3, dh(20.3mm, -90deg, 150.05mm, 0), limits = [-135deg, 135deg])]
    #[body(link3, mass = 4.8, com = [-0.0203, -0.0141, 0.07], inertia = diag(0.066, 0.086, 0.0125),
        allow(nonphysical_inertia))]
    #[joint(joint4: revolute, link3 -> link4, dh(0, 90deg, 431.8mm, 0), limits = [-266deg, 266deg])]
    #[body(link4, mass = 0.82, com = [0, 0.019, 0], inertia = diag(1.8e-3, 1.3e-3, 1.8e-3))]
    #[joint(joint5: revolute, link4 -> link5, dh(0, -90deg, 0, 0), limits = [-100deg, 100deg])]
    #[body(link5, mass = 0.34, inertia = diag(0.3e-3, 0.4e-3, 0.3e-3))]
    #[joint(joint6: revolute, link5 -> link6, dh(0, 0, 0, 0), limits = [-266deg, 266deg])]
    #[body(link6, mass = 0.09, com = [0, 0, 0.032], inertia = diag(0.15e-3, 0.15e-3, 0.04e-3))]
    pub struct Puma560ByDh;
}

robot! {
    puma560 = Puma560, [6],
    [Link1, Link2, Link3, Link4, Link5, Link6, Tool];
    /// PUMA 560 by the numbers of `puma560/model.urdf`.
    ///
    /// The published first link has a moment and no mass.
    #[joint(joint1: revolute(z), world -> link1, limits = [-2.792526803190927, 2.792526803190927])]
    #[body(link1, mass = 0, com = [0, 0, 0.6718299999999999], inertia = diag(0, 0.35, 0),
        inertia_rpy = [1.5707963267948966, 0, 0], allow(nonphysical_inertia))]
    #[joint(joint2: revolute(z), link1 -> link2, at = [0, 0, 0.6718299999999999],
        rpy = [1.5707963267948966, 0, 0], limits = [-1.9198621771937625, 1.9198621771937625])]
    #[body(link2, mass = 17.4, com = [0.068, 0.006, 0.2275], inertia = diag(0.13, 0.524, 0.539))]
    #[joint(joint3: revolute(z), link2 -> link3, at = [0.4318, 0, 0],
        limits = [-2.356194490192345, 2.356194490192345])]
    #[body(link3, mass = 4.8, com = [0, 0.07, 0.16415000000000002], inertia = diag(0.066, 0.086, 0.0125),
        inertia_rpy = [-1.5707963267948966, 0, 0], allow(nonphysical_inertia))]
    #[joint(joint4: revolute(z), link3 -> link4, at = [0.0203, 0, 0.15005],
        rpy = [-1.5707963267948966, 0, 0], limits = [-4.642575810304916, 4.642575810304916])]
    #[body(link4, mass = 0.82, com = [0, 4.218847493575595e-18, 0.45080000000000003],
        inertia = diag(0.0018, 0.0013, 0.0018), inertia_rpy = [1.5707963267948966, 0, 0])]
    #[joint(joint5: revolute(z), link4 -> link5, at = [0, 0, 0.4318], rpy = [1.5707963267948966, 0, 0],
        limits = [-1.7453292519943295, 1.7453292519943295])]
    #[body(link5, mass = 0.34, inertia = diag(0.0003, 0.0004, 0.0003),
        inertia_rpy = [-1.5707963267948966, 0, 0])]
    #[joint(joint6: revolute(z), link5 -> link6, rpy = [-1.5707963267948966, 0, 0],
        limits = [-4.642575810304916, 4.642575810304916])]
    #[body(link6, mass = 0.09, com = [0, 0, 0.032], inertia = diag(0.00015, 0.00015, 4e-05))]
    #[joint(tool_joint: fixed, link6 -> tool)]
    pub struct Puma560;
}

robot! {
    iiwa14 = Iiwa14, [7],
    [IiwaLink0, IiwaLink1, IiwaLink2, IiwaLink3, IiwaLink4, IiwaLink5, IiwaLink6, IiwaLink7, IiwaLinkEe];
    /// KUKA's LBR iiwa 14 by the numbers of `iiwa14/model.urdf`; its foot is mass at rest.
    #[joint(iiwa_base_joint: fixed, world -> iiwa_link_0)]
    #[body(iiwa_link_0, mass = 5, com = [-0.1, 0, 0.07], inertia = diag(0.05, 0.06, 0.03))]
    #[joint(iiwa_joint_1: revolute(z), iiwa_link_0 -> iiwa_link_1, at = [0, 0, 0.1575],
        limits = [-2.96705972839, 2.96705972839])]
    #[body(iiwa_link_1, mass = 5.76, com = [0, -0.03, 0.12], inertia = diag(0.033, 0.0333, 0.0123))]
    #[joint(iiwa_joint_2: revolute(z), iiwa_link_1 -> iiwa_link_2, at = [0, 0, 0.2025],
        rpy = [1.570796326794897, 0, 3.141592653589793], limits = [-2.09439510239, 2.09439510239])]
    #[body(iiwa_link_2, mass = 6.35, com = [0.0003, 0.059, 0.042], inertia = diag(0.0305, 0.0304, 0.011))]
    #[joint(iiwa_joint_3: revolute(z), iiwa_link_2 -> iiwa_link_3, at = [0, 0.2045, 0],
        rpy = [1.570796326794897, 0, 3.141592653589793], limits = [-2.96705972839, 2.96705972839])]
    #[body(iiwa_link_3, mass = 3.5, com = [0, 0.03, 0.13], inertia = diag(0.025, 0.0238, 0.0076))]
    #[joint(iiwa_joint_4: revolute(z), iiwa_link_3 -> iiwa_link_4, at = [0, 0, 0.2155],
        rpy = [1.570796326794897, 0, 0], limits = [-2.09439510239, 2.09439510239])]
    #[body(iiwa_link_4, mass = 3.5, com = [0, 0.067, 0.034], inertia = diag(0.017, 0.0164, 0.006))]
    #[joint(iiwa_joint_5: revolute(z), iiwa_link_4 -> iiwa_link_5, at = [0, 0.1845, 0],
        rpy = [-1.570796326794897, 3.141592653589793, 0], limits = [-2.96705972839, 2.96705972839])]
    #[body(iiwa_link_5, mass = 3.5, com = [0.0001, 0.021, 0.076], inertia = diag(0.01, 0.0087, 0.00449))]
    #[joint(iiwa_joint_6: revolute(z), iiwa_link_5 -> iiwa_link_6, at = [0, 0, 0.2155],
        rpy = [1.570796326794897, 0, 0], limits = [-2.09439510239, 2.09439510239])]
    #[body(iiwa_link_6, mass = 1.8, com = [0, 0.0006, 0.0004], inertia = diag(0.0049, 0.0047, 0.0036))]
    #[joint(iiwa_joint_7: revolute(z), iiwa_link_6 -> iiwa_link_7, at = [0, 0.081, 0],
        rpy = [-1.570796326794897, 3.141592653589793, 0], limits = [-3.05432619099, 3.05432619099])]
    #[body(iiwa_link_7, mass = 1.2, com = [0, 0, 0.02], inertia = diag(0.001, 0.001, 0.001))]
    #[joint(tool0_joint: fixed, iiwa_link_7 -> iiwa_link_ee, at = [0, 0, 0.045],
        rpy = [0, -1.570796326794897, 0])]
    pub struct Iiwa14;
}

robot! {
    scara = Scara, [4],
    [Link1, Link2, Link3, Link4, Tool];
    /// A SCARA with the kinematics of Adept's Cobra 600, by `scara/model.urdf`.
    #[joint(joint1: revolute(z), world -> link1, limits = [-1.8325957145940461, 1.8325957145940461])]
    #[body(link1, mass = 11.17, com = [0.1625, 0, 0.397], inertia = tensor(0.03, 0, 0.002, 0.12, 0, 0.13))]
    #[joint(joint2: revolute(z), link1 -> link2, at = [0.325, 0, 0.387],
        limits = [-2.6179938779914944, 2.6179938779914944])]
    #[body(link2, mass = 6.82, com = [0.1375, -0.0019999999999999966, 0.03],
        inertia = tensor(0.015, 0, 0, 0.06, 0.0005, 0.07), inertia_rpy = [3.141592653589793, 0, 0])]
    #[joint(joint3: prismatic(z), link2 -> link3, at = [0.275, 0, 0], rpy = [3.141592653589793, 0, 0],
        limits = [0, 0.21])]
    #[body(link3, mass = 1.6, com = [0, 0, -0.08], inertia = diag(0.012, 0.012, 0.0009))]
    #[joint(joint4: revolute(z), link3 -> link4, limits = [-6.283185307179586, 6.283185307179586])]
    #[body(link4, mass = 0.45, com = [0.004, 0, 0.02], inertia = tensor(0.0006, 2e-05, 0, 0.0005, 0, 0.0004))]
    #[joint(tool_joint: fixed, link4 -> tool)]
    pub struct Scara;
}

robot! {
    reference_cart_pole = ReferenceCartPole, [2],
    [Cart, Pole, Tip];
    /// The cart-pole of `cartpole/model.urdf`.
    #[joint(slider: prismatic(x), world -> cart, limits = [-2, 2])]
    #[body(cart, mass = 1, inertia = diag(0.01, 0.01, 0.01))]
    #[joint(hinge: revolute(y), cart -> pole, limits = [-3.2, 3.2])]
    #[body(pole, mass = 0.1, com = [0, 0, 0.5],
        inertia = diag(0.008333333333333333, 0.008333333333333333, 1e-05))]
    #[joint(tipj: fixed, pole -> tip, at = [0, 0, 1])]
    pub struct ReferenceCartPole;
}

robot! {
    planar_2dof = Planar2Dof, [2],
    [BaseLink, Link1, Link2];
    /// The double pendulum of `double_pendulum/model.urdf`; its base is mass at rest.
    #[joint(base: fixed, world -> base_link)]
    #[body(base_link, mass = 0.10159, com = [0.0030299, 2.6279E-13, 0.02912],
        inertia = tensor(2.636E-05, -1.007E-16, -2.3835E-06, 1.8042E-05, -4.6617E-09, 1.8795E-05))]
    #[joint(joint1: revolute(x), base_link -> link1, at = [0.0060872, 0, 0.035])]
    #[body(link1, mass = 0.26703, com = [0.0086107, 2.1727E-06, 0.036012],
        inertia = tensor(0.00040827, 1.2675E-09, 1.8738E-05, 0.00038791, 3.5443E-08, 3.6421E-05))]
    #[joint(joint2: revolute(x), link1 -> link2, at = [0.023, 0, 0.1])]
    #[body(link2, mass = 0.33238, com = [-0.0050107, 1.9371E-10, 0.10088],
        inertia = tensor(0.0011753, -3.854E-13, -2.9304E-08, 0.0011666, -5.2365E-12, 1.4553E-05))]
    pub struct Planar2Dof;
}

robot! {
    planar_2dof_continuous = Planar2DofContinuous, [2],
    [Link1, Link2];
    /// The double pendulum of `double_pendulum_continuous/model.urdf`: without limits.
    #[joint(joint1: continuous(x), world -> link1, at = [0.0060872, 0, 0.035])]
    #[body(link1, mass = 0.26703, com = [0.0086107, 2.1727E-06, 0.036012],
        inertia = tensor(0.00040827, 1.2675E-09, 1.8738E-05, 0.00038791, 3.5443E-08, 3.6421E-05))]
    #[joint(joint2: continuous(x), link1 -> link2, at = [0.023, 0, 0.1])]
    #[body(link2, mass = 0.33238, com = [-0.0050107, 1.9371E-10, 0.10088],
        inertia = tensor(0.0011753, -3.854E-13, -2.9304E-08, 0.0011666, -5.2365E-12, 1.4553E-05))]
    pub struct Planar2DofContinuous;
}
