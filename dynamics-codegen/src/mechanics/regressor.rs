//! Joint forces as linear functions of the parameters of bodies and joints: `τ = Y(q,v,a)·π`.
//!
//! Each moving body has its mass, its first moments and its rotational inertia about the origin of its own frame;
//! each joint of one degree of freedom its armature, damping and friction, and its stiffness if it has a spring.
//!
//! C. Atkeson, C. An, J. Hollerbach, *Estimation of inertial parameters of manipulator loads and links*, 1986.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::coupling::Coupling;
use super::frames::{Axes, jacobian};
use super::motion::{LinkAcceleration, accelerations};
use super::normal::{NormalFrame, NormalLink, NormalTree};
use super::passive::{friction_per_coefficient, stretch};
use crate::spatial::{Pose, Scalar, Symmetric3, Vector3};

/// A parameter of the regressor: whose, which, and its value.
#[derive(Clone, Debug)]
pub struct RegressorColumn<S> {
    /// As in `arm.mass` and `elbow.damping`.
    pub name: String,
    /// The parameter now.
    pub value: S,
    /// The joint forces that it has a part in, per unit of it.
    pub forces: Vec<S>,
}

/// The ten parameters of a body, in Pinocchio's order.
const OF_BODY: [&str; 10] = [
    "mass",
    "mass_x",
    "mass_y",
    "mass_z",
    "inertia_xx",
    "inertia_xy",
    "inertia_yy",
    "inertia_xz",
    "inertia_yz",
    "inertia_zz",
];

/// A robot in motion, as the regressor needs it: accelerations are of the columns.
pub struct Regressed<'t, S> {
    /// Its links as they are.
    pub tree: &'t NormalTree<S>,
    /// The frame of the body that each link is, if it is one.
    pub bodies: &'t [Option<usize>],
    /// The names of the joints of each link.
    pub joints: &'t [String],
    /// Whether the joint's own parameters are those of this link.
    pub acts: &'t [bool],
    /// From the robot's speeds to those of the columns.
    pub coupling: &'t Coupling<S>,
    /// Coordinates, speeds and accelerations.
    pub state: [&'t [S]; 3],
}

impl<S: Scalar> Regressed<'_, S> {
    /// All columns: of the bodies, then of the joints.
    pub fn columns(&self) -> Vec<RegressorColumn<S>> {
        let mut columns = self.of_bodies();
        columns.extend((0..self.tree.links.len()).flat_map(|link| self.of_joint(link)));
        columns
    }

    fn of_bodies(&self) -> Vec<RegressorColumn<S>> {
        let [q, v, a] = self.state;
        let joints = self.tree.place(q);
        let motion = accelerations(self.tree, &joints, v, a);
        let mut columns: Vec<RegressorColumn<S>> = Vec::new();
        for (link, frame) in self.bodies.iter().enumerate() {
            let Some(frame) = frame.map(|frame| &self.tree.frames[frame]) else { continue };
            columns.extend(self.of_body(&self.tree.links[link], frame, &motion[link]));
        }
        columns
    }

    fn of_body(
        &self,
        link: &NormalLink<S>,
        frame: &NormalFrame<S>,
        motion: &LinkAcceleration<S>,
    ) -> Vec<RegressorColumn<S>> {
        let J = self.coupling.gather_columns(jacobian(self.tree, frame, self.state[0], Axes::Body));
        let wrenches = unit_wrenches(&motion.at(frame.pose));
        let values = parameters(link, frame.pose);
        let forces = |wrench: [S; 6]| {
            let speeds = 0..J[0].len();
            let pair = |k: usize| J.iter().zip(wrench).fold(S::zero(), |sum, (row, f)| sum + row[k] * f);
            speeds.map(pair).collect()
        };
        let columns = OF_BODY.iter().zip(values).zip(wrenches);
        columns
            .map(|((parameter, value), wrench)| RegressorColumn {
                name: format!("{}.{parameter}", frame.name),
                value,
                forces: forces(wrench),
            })
            .collect()
    }

    /// Those of a link's joint, if it has one degree of freedom.
    pub fn of_joint(&self, link: usize) -> Vec<RegressorColumn<S>> {
        let [q, v, a] = self.state;
        if !self.acts[link] {
            return vec![];
        }
        let (name, column) = (&self.joints[link], self.tree.columns_of(link).start);
        let link = &self.tree.links[link];
        let entry = |parameter: &str, value: S, force: S| {
            let mut forces = vec![S::zero(); self.tree.columns.len()];
            forces[column] = force;
            RegressorColumn {
                name: format!("{name}.{parameter}"),
                value,
                forces: self.coupling.gather(forces),
            }
        };
        let passive = link.passive;
        let mut entries = vec![
            entry("armature", passive.armature, a[column]),
            entry("damping", passive.damping, v[column]),
            entry("friction", passive.friction, friction_per_coefficient(link, v[column])),
        ];
        if !passive.stiffness.is_zero() {
            entries.push(entry("stiffness", passive.stiffness, stretch(link, q)));
        }
        entries
    }
}

/// The ten parameters of a link in the frame that has this pose in it.
fn parameters<S: Scalar>(link: &NormalLink<S>, pose: Pose<S>) -> [S; 10] {
    let inertia = link.inertia.transformed(pose.inverse());
    let [x, y, z] = inertia.first.0;
    let Symmetric3 { xx, yy, zz, xy, xz, yz } = inertia.rotational();
    [inertia.mass, x, y, z, xx, xy, yy, xz, yz, zz]
}

/// The wrench, force first, that each of the ten parameters needs to move so.
fn unit_wrenches<S: Scalar>(motion: &LinkAcceleration<S>) -> [[S; 6]; 10] {
    let LinkAcceleration { w, wd, U, a } = *motion;
    let unit = Vector3::unit;
    let six = |force: Vector3<S>, moment: Vector3<S>| {
        let ([x, y, z], [i, j, k]) = (force.0, moment.0);
        [x, y, z, i, j, k]
    };
    let first = |k: usize| six(U.column(k), unit(k).cross(a));
    // `I·ẇ + w × I·w` with one entry of I, and its mirror, one.
    let second = |i: usize, j: usize| {
        let times = |w: Vector3<S>| match i == j {
            true => unit(i).scale(w.0[i]),
            false => unit(i).scale(w.0[j]) + unit(j).scale(w.0[i]),
        };
        six(Vector3::zero(), times(wd) + w.cross(times(w)))
    };
    [
        six(a, Vector3::zero()),
        first(0),
        first(1),
        first(2),
        second(0, 0),
        second(0, 1),
        second(1, 1),
        second(0, 2),
        second(1, 2),
        second(2, 2),
    ]
}
