//! Poses, Jacobians and motions of frames at rest on a link, O(depth).
//!
//! From the frame down to the base: only the joints that move it are asked for their sine and cosine.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC Press 1994, ch. 3.

use nalgebra::{SMatrix, SVector};

use super::joint::Columns;
use super::screw::Twist;
use super::vector::{Matrix, Vector};
use super::{Joint, Tree, entries};
use crate::__private::{columns, vector};
use crate::kinematics::Pose;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The pose in the world of a frame that has the pose (`rotation` by rows, `translation`) in the frame of
    /// `link`; in the world, without a link.
    pub fn pose(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, NQ>,
    ) -> Pose<T> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let Placement { rotation, origin } = self.walk(link, frame, entries(q), |_, _| ());
        Pose { rotation: columns(rotation.transpose().0), translation: vector(origin.0) }
    }

    /// The body Jacobian of the same frame, 6×NV, linear rows first: in the frame's axes, of its origin.
    pub fn jacobian(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, NQ>,
    ) -> SMatrix<T, 6, NV> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let (jacobian, _) = self.body_jacobian(link, frame, entries(q));
        columns(jacobian.map(Twist::linear_first))
    }

    /// The Jacobian of the same frame in world axes, 6×NV: the velocity of its origin, then the angular velocity.
    pub fn world_jacobian(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, NQ>,
    ) -> SMatrix<T, 6, NV> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let (jacobian, rotation) = self.body_jacobian(link, frame, entries(q));
        columns(jacobian.map(|Twist { angular, linear }| {
            Twist { angular: rotation.times(angular), linear: rotation.times(linear) }.linear_first()
        }))
    }

    /// The body velocity `J·v` of the same frame, linear first: in the frame's axes, of its origin, m/s and rad/s.
    pub fn velocity(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let mut velocity = Twist::zero();
        self.walk(link, frame, entries(q), |joint, frame| {
            velocity = velocity + frame.moved_by(joint, entries(v));
        });
        vector(velocity.linear_first())
    }

    /// The rate of the body velocity, `J·a + J̇·v`, in m/s² and rad/s²; gravity has no part in it.
    ///
    /// A column of `J` that the joints between it and the frame move with `W` changes by `−W × J`.
    pub fn acceleration(
        &self,
        link: Option<usize>,
        rotation: [[T; 3]; 3],
        translation: [T; 3],
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        let frame = Placement { rotation: Matrix(rotation), origin: Vector(translation) };
        let (mut beyond, mut acceleration) = (Twist::zero(), Twist::zero());
        self.walk(link, frame, entries(q), |joint, frame| {
            let own = frame.moved_by(joint, entries(v));
            acceleration = acceleration + frame.moved_by(joint, entries(a)) + own.cross(beyond);
            beyond = beyond + own;
        });
        vector(acceleration.linear_first())
    }

    /// The columns of the body Jacobian, and the rotation from the frame's axes to the world's.
    fn body_jacobian(
        &self,
        link: Option<usize>,
        frame: Placement<T>,
        q: &[T; NQ],
    ) -> ([Twist<T>; NV], Matrix<T>) {
        let mut jacobian = [Twist::zero(); NV];
        let in_world = self.walk(link, frame, q, |joint, frame| {
            let (columns, offset) = frame.columns(joint);
            for column in columns.iter() {
                if let Some(sum) = jacobian.get_mut(column.v) {
                    *sum = *sum + column.twist().carried(offset);
                }
            }
        });
        (jacobian, in_world.rotation)
    }

    /// Takes a frame on `link` to the base; at each link on the way `visit` sees where it is in the link's frame.
    fn walk(
        &self,
        link: Option<usize>,
        frame: Placement<T>,
        q: &[T; NQ],
        mut visit: impl FnMut(&Joint<T>, Placement<T>),
    ) -> Placement<T> {
        let mut frame = frame;
        for k in self.path_to_base(link) {
            let Some(link) = self.links.get(k) else { continue };
            visit(&link.joint, frame);
            let (rotation, position) = link.pose_in_parent(q);
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

impl<T: Scalar> Placement<T> {
    /// The columns of the link's joint, in the axes of a frame that is here in the link's, about the link's origin;
    /// and how far from there the frame is.
    fn columns(self, joint: &Joint<T>) -> (Columns<T>, Vector<T>) {
        let columns = joint.columns(self.rotation.0.map(Vector));
        (columns, self.rotation.transpose().times(self.origin))
    }

    /// The frame's twist while the link's joint moves, and nothing else.
    fn moved_by(self, joint: &Joint<T>, speeds: &[T]) -> Twist<T> {
        let (columns, offset) = self.columns(joint);
        columns.at(speeds).carried(offset)
    }
}
