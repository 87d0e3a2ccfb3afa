//! Poses and Jacobians of frames at rest on a link, O(depth).
//!
//! From the frame down to the base: only the joints that move it are asked for their sine and cosine.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC Press 1994, ch. 3.

use nalgebra::{SMatrix, SVector};

use super::screw::Twist;
use super::vector::{Matrix, Vector};
use super::{Tree, entries};
use crate::__private::{columns, vector};
use crate::kinematics::Pose;
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// The pose in the world of a frame that has the pose (`rotation` by rows, `translation`) in the frame of
    /// `link`; in the world, without a link.
    pub fn pose(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, N>,
    ) -> Pose<T> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let Placement { rotation, origin } = self.walk(link, frame, entries(q), |_, _| ());
        Pose { rotation: columns(rotation.transpose().0), translation: vector(origin.0) }
    }

    /// The body Jacobian of the same frame, 6×N, linear rows first: in the frame's axes, of its origin.
    pub fn jacobian(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, N>,
    ) -> SMatrix<T, 6, N> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let (jacobian, _) = self.body_jacobian(link, frame, entries(q));
        columns(jacobian.map(linear_first))
    }

    /// The Jacobian of the same frame in world axes, 6×N: the velocity of its origin, then the angular velocity.
    pub fn world_jacobian(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, N>,
    ) -> SMatrix<T, 6, N> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let (jacobian, rotation) = self.body_jacobian(link, frame, entries(q));
        columns(jacobian.map(|Twist { angular, linear }| {
            linear_first(Twist { angular: rotation.times(angular), linear: rotation.times(linear) })
        }))
    }

    /// The columns of the body Jacobian, and the rotation from the frame's axes to the world's.
    fn body_jacobian(
        &self,
        link: Option<usize>,
        frame: Placement<T>,
        q: &[T; N],
    ) -> ([Twist<T>; N], Matrix<T>) {
        let mut jacobian = [Twist::zero(); N];
        let in_world = self.walk(link, frame, q, |k, Placement { rotation, origin }| {
            let [x, y, z] = rotation.0.map(Vector);
            let (Some(column), Some(link)) = (jacobian.get_mut(k), self.links.get(k)) else { return };
            let [along_x, along_y, _] = origin.0;
            *column = if link.prismatic {
                Twist { angular: Vector::zero(), linear: z }
            } else {
                Twist { angular: z, linear: y.scaled(along_x) - x.scaled(along_y) }
            };
        });
        (jacobian, in_world.rotation)
    }

    /// Takes a frame on `link` to the base; at each joint `visit` sees where it is in the joint's own frame.
    fn walk(
        &self,
        link: Option<usize>,
        frame: Placement<T>,
        q: &[T; N],
        mut visit: impl FnMut(usize, Placement<T>),
    ) -> Placement<T> {
        let mut frame = frame;
        for k in self.path_to_base(link) {
            let (Some(link), Some(q)) = (self.links.get(k), q.get(k)) else { continue };
            visit(k, frame);
            let (rotation, position) = link.pose_in_parent(*q);
            frame = Placement {
                rotation: rotation.product(frame.rotation),
                origin: position + rotation.times(frame.origin),
            };
        }
        frame
    }
}

/// Where a frame is in another.
#[derive(Clone, Copy)]
struct Placement<T> {
    rotation: Matrix<T>,
    origin: Vector<T>,
}

/// As at the public face.
fn linear_first<T>(twist: Twist<T>) -> [T; 6] {
    let Twist { angular: Vector([d, e, f]), linear: Vector([a, b, c]) } = twist;
    [a, b, c, d, e, f]
}
