//! How joints move bodies: forward kinematics, in numbers, for pages that move a robot by hand.

use dynamics_core::Pose;
use dynamics_core::nalgebra::{Quaternion, SMatrix, SVector, UnitQuaternion};
use serde_json::{Value, json};

use crate::error::{Error, check_numbers};

/// A tree of links, each moved against its parent by some entries of `q`, and the bodies that rest on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Linkage {
    /// The links, parents before children.
    pub links: Vec<Link>,
    /// Where the bodies of a scene are, in its order.
    pub mounts: Vec<Mount>,
}

/// A link: its pose in its parent's is `placement` followed by its joint's own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The link that carries it; the world, without one.
    pub parent: Option<usize>,
    /// Its pose there where its joint is at zero.
    pub placement: Pose<f64>,
    /// How its joint moves it.
    pub drive: Drive,
    /// The index of its (first) coordinate.
    pub q: usize,
    /// Of a turn or a slide: it goes by `ratio·q + offset`.
    pub ratio: f64,
    /// See `ratio`; rad or m.
    pub offset: f64,
}

/// The motions of which all joints are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// About the link's z by an angle, rad.
    Turn,
    /// Along the link's z by a distance, m.
    Slide,
    /// By a quaternion i, j, k, w.
    Ball,
    /// By a position in the axes of the placement, and a quaternion i, j, k, w.
    Free,
}

/// Where a body rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// On which link; on the world, without one.
    pub link: Option<usize>,
    /// Its pose there.
    pub pose: Pose<f64>,
}

impl Drive {
    /// How many coordinates it takes.
    fn coordinates(self) -> usize {
        match self {
            Self::Turn | Self::Slide => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Turn => "turn",
            Self::Slide => "slide",
            Self::Ball => "ball",
            Self::Free => "free",
        }
    }
}

impl Link {
    /// What its joint adds to its placement; quaternions of any length are taken for rotations.
    fn moved(&self, q: &[f64]) -> Pose<f64> {
        let q = &q[self.q..];
        let x = self.ratio * q[0] + self.offset;
        let (s, c) = x.sin_cos();
        let turn = |q: &[f64]| {
            let [i, j, k, w] = std::array::from_fn(|n| q[n]);
            *UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)).to_rotation_matrix().matrix()
        };
        let (rotation, translation) = match self.drive {
            Drive::Turn => (SMatrix::from([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]), SVector::zeros()),
            Drive::Slide => (SMatrix::identity(), SVector::from([0.0, 0.0, x])),
            Drive::Ball => (turn(q), SVector::zeros()),
            Drive::Free => (turn(&q[3..]), SVector::from([q[0], q[1], q[2]])),
        };
        Pose { rotation, translation }
    }
}

impl Linkage {
    /// The poses of all bodies in the world.
    ///
    /// # Errors
    ///
    /// [`Error::LengthsDiffer`] where a link asks for a coordinate that there is not; [`Error::LinkUnconnected`] of a
    /// link before its parent, and of a body on a link that there is not.
    pub fn poses(&self, q: &[f64]) -> Result<Vec<Pose<f64>>, Error> {
        self.check(q.len())?;
        let mut links: Vec<Pose<f64>> = vec![];
        let of = |links: &[Pose<f64>], k: Option<usize>| k.map_or(Pose::identity(), |k| links[k]);
        for link in &self.links {
            links.push(of(&links, link.parent) * link.placement * link.moved(q));
        }
        Ok(self.mounts.iter().map(|mount| of(&links, mount.link) * mount.pose).collect())
    }

    /// Whether it is whole, and moved by so many coordinates.
    pub(crate) fn check(&self, coordinates: usize) -> Result<(), Error> {
        for (k, link) in self.links.iter().enumerate() {
            if link.parent.is_some_and(|parent| parent >= k) {
                return Err(Error::LinkUnconnected { link: k });
            }
            let needed = link.q + link.drive.coordinates();
            if needed > coordinates {
                let what = format!("the configuration, of which link {k} needs {needed} numbers,");
                return Err(Error::LengthsDiffer { what, expected: needed, found: coordinates });
            }
            check_pose(&format!("the placement of link {k}"), &link.placement)?;
            check_numbers(&format!("the drive of link {k}"), [link.ratio, link.offset])?;
        }
        for (k, mount) in self.mounts.iter().enumerate() {
            if let Some(link) = mount.link.filter(|link| *link >= self.links.len()) {
                return Err(Error::LinkUnconnected { link });
            }
            check_pose(&format!("the mount of body {k}"), &mount.pose)?;
        }
        Ok(())
    }

    /// The links for a page.
    pub(crate) fn data(&self) -> Vec<Value> {
        let link = |link: &Link| {
            json!({
                "parent": link.parent,
                "at": entries(&link.placement),
                "motion": link.drive.name(),
                "q": link.q,
                "ratio": link.ratio,
                "offset": link.offset,
            })
        };
        self.links.iter().map(link).collect()
    }
}

fn check_pose(what: &str, pose: &Pose<f64>) -> Result<(), Error> {
    check_numbers(what, entries(pose))
}

/// A position, and a rotation by rows.
pub(crate) fn entries(pose: &Pose<f64>) -> [f64; 12] {
    std::array::from_fn(|k| match k.checked_sub(3) {
        None => pose.translation[k],
        Some(k) => pose.rotation[(k / 3, k % 3)],
    })
}
