//! A rigid body that moves freely, its frame away from its centre of mass and its axes.

use dynamics_core::__private::{difference_free, free_rate, free_rate_transposed, integrate_free, vector};
use dynamics_core::nalgebra::{
    Matrix3, Matrix6, Quaternion, Rotation3, UnitQuaternion, Vector3, Vector4, Vector6,
};
use dynamics_core::prelude::*;

/// q is the position and the orientation i, j, k, w of the body's frame; v is its twist in itself.
#[derive(Clone, Copy, Debug)]
pub struct FreeBox {
    pub mass: f64,
    /// In the body's frame.
    pub com: Vector3<f64>,
    /// About the centre of mass, in axes of the body's frame.
    pub inertia: Matrix3<f64>,
    pub gravity: Vector3<f64>,
    /// M and M⁻¹, which do not depend on q.
    matrix: Matrix6<f64>,
    inverse: Matrix6<f64>,
}

/// A frame at a corner, turned.
pub struct Corner;

impl FreeBox {
    /// Its principal moments of inertia, in kg·m².
    pub const MOMENTS: [f64; 3] = [0.02, 0.05, 0.06];

    pub fn new(com: Vector3<f64>, gravity: Vector3<f64>) -> Self {
        let (mass, axes) = (1.5, Self::principal_axes());
        let inertia = axes * Matrix3::from_diagonal(&Vector3::from(Self::MOMENTS)) * axes.transpose();
        let c = com.cross_matrix();
        let matrix = blocks(Matrix3::identity() * mass, -mass * c, mass * c, inertia - mass * c * c);
        let i = inertia.try_inverse().expect("a box has moments of inertia");
        let inverse = blocks(Matrix3::identity() / mass - c * i * c, c * i, -i * c, i);
        Self { mass, com, inertia, gravity, matrix, inverse }
    }

    pub fn tossed() -> Self {
        Self::new(Vector3::new(0.1, -0.05, 0.2), Vector3::new(0.3, -0.2, -9.81))
    }

    /// In space, where nothing pulls.
    pub fn drifting() -> Self {
        Self::new(Self::tossed().com, Vector3::zeros())
    }

    pub fn principal_axes() -> Rotation3<f64> {
        Rotation3::from_euler_angles(0.4, -0.7, 1.1)
    }

    pub fn rotation(q: &SVector<f64, 7>) -> Rotation3<f64> {
        let [[_, _, _, i, j, k, w]] = q.data.0;
        UnitQuaternion::new_unchecked(Quaternion::from(Vector4::new(i, j, k, w))).to_rotation_matrix()
    }

    pub fn center_of_mass(&self, q: &SVector<f64, 7>) -> Vector3<f64> {
        q.fixed_rows::<3>(0) + Self::rotation(q) * self.com
    }

    pub fn inverse(&self) -> &Matrix6<f64> {
        &self.inverse
    }
}

pub fn blocks(a: Matrix3<f64>, b: Matrix3<f64>, c: Matrix3<f64>, d: Matrix3<f64>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    for (row, column, block) in [(0, 0, a), (0, 3, b), (3, 0, c), (3, 3, d)] {
        matrix.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    }
    matrix
}

fn stacked(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|i, _| if i < 3 { linear[i] } else { angular[i - 3] })
}

fn halves(x: &Vector6<f64>) -> [Vector3<f64>; 2] {
    [x.fixed_rows::<3>(0).into(), x.fixed_rows::<3>(3).into()]
}

impl Mechanism for FreeBox {
    const NQ: usize = 7;
    const NV: usize = 6;
    const NU: usize = 6;
    const NAME: &'static str = "FreeBox";
    const JOINT_NAMES: &'static [&'static str] = &["float"];
    const BODY_NAMES: &'static [&'static str] = &["box"];
    const LIMITS: &'static [JointLimits] = &[JointLimits::NONE; 6];
    const COST: Costs = Costs::ZERO;
}

impl Dynamics<f64, 7, 6> for FreeBox {
    fn mass_matrix(&self, _q: &SVector<f64, 7>) -> SMatrix<f64, 6, 6> {
        self.matrix
    }
    /// Levi-Civita's on a group: `½ (M ad(V) − ad(V)ᵀ M − K)`, where `K·x = ad(x)ᵀ·(M V)`.
    fn coriolis_matrix(&self, _q: &SVector<f64, 7>, v: &SVector<f64, 6>) -> SMatrix<f64, 6, 6> {
        let ([linear, angular], mass_matrix) = (halves(v), self.matrix);
        let o = Matrix3::zeros();
        let ad = blocks(angular.cross_matrix(), linear.cross_matrix(), o, angular.cross_matrix());
        let [p, l] = halves(&(mass_matrix * v)).map(|x| x.cross_matrix());
        (mass_matrix * ad - ad.transpose() * mass_matrix - blocks(o, p, p, l)) * 0.5
    }
    fn gravity_forces(&self, q: &SVector<f64, 7>) -> SVector<f64, 6> {
        let weight = self.mass * (Self::rotation(q).inverse() * self.gravity);
        -stacked(weight, self.com.cross(&weight))
    }
    /// Newton's and Euler's equations about the origin of the body's frame.
    fn bias_forces(&self, q: &SVector<f64, 7>, v: &SVector<f64, 6>) -> SVector<f64, 6> {
        let [linear, angular] = halves(v);
        let [p, l] = halves(&(self.matrix * v));
        self.gravity_forces(q) + stacked(angular.cross(&p), linear.cross(&p) + angular.cross(&l))
    }
    fn inverse_dynamics(
        &self,
        q: &SVector<f64, 7>,
        v: &SVector<f64, 6>,
        a: &SVector<f64, 6>,
    ) -> SVector<f64, 6> {
        self.matrix * a + self.bias_forces(q, v)
    }
    fn forward_dynamics(
        &self,
        q: &SVector<f64, 7>,
        v: &SVector<f64, 6>,
        tau: &SVector<f64, 6>,
    ) -> SVector<f64, 6> {
        self.inverse * (tau - self.bias_forces(q, v))
    }
    fn kinetic_energy(&self, _q: &SVector<f64, 7>, v: &SVector<f64, 6>) -> f64 {
        0.5 * v.dot(&(self.matrix * v))
    }
    fn potential_energy(&self, q: &SVector<f64, 7>) -> f64 {
        -self.mass * self.gravity.dot(&self.center_of_mass(q))
    }
    fn lagrangian(&self, q: &SVector<f64, 7>, v: &SVector<f64, 6>) -> f64 {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
    fn check_configuration(&self, q: &SVector<f64, 7>) -> Result<(), Error> {
        let [[_, _, _, q3, q4, q5, q6]] = q.data.0;
        Error::unless_unit_quaternion(3, [q3, q4, q5, q6])
    }
}

impl Configuration<f64, 7, 6> for FreeBox {
    fn integrate(&self, q: &SVector<f64, 7>, delta: &SVector<f64, 6>) -> SVector<f64, 7> {
        let ([q], [delta]) = (q.data.0, delta.data.0);
        vector(integrate_free(q, delta))
    }
    fn difference(&self, q0: &SVector<f64, 7>, q1: &SVector<f64, 7>) -> SVector<f64, 6> {
        let ([q0], [q1]) = (q0.data.0, q1.data.0);
        vector(difference_free(q0, q1))
    }
    fn rate(&self, delta: &SVector<f64, 6>, v: &SVector<f64, 6>) -> SVector<f64, 6> {
        let ([delta], [v]) = (delta.data.0, v.data.0);
        vector(free_rate(delta, v))
    }
    fn rate_transposed(&self, delta: &SVector<f64, 6>, p: &SVector<f64, 6>) -> SVector<f64, 6> {
        let ([delta], [p]) = (delta.data.0, p.data.0);
        vector(free_rate_transposed(delta, p))
    }
    fn neutral(&self) -> SVector<f64, 7> {
        vector([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    }
}

impl Corner {
    pub fn offset() -> Vector3<f64> {
        Vector3::new(0.3, 0.2, -0.4)
    }
    pub fn rotation() -> Rotation3<f64> {
        Rotation3::from_euler_angles(-1.2, 0.3, 0.8)
    }
}

impl Frame<FreeBox, f64, 7, 6> for Corner {
    const NAME: &'static str = "corner";

    fn pose(_robot: &FreeBox, q: &SVector<f64, 7>) -> Pose<f64> {
        let rotation = FreeBox::rotation(q);
        Pose {
            rotation: *(rotation * Self::rotation()).matrix(),
            translation: q.fixed_rows::<3>(0) + rotation * Self::offset(),
        }
    }
    fn jacobian(_robot: &FreeBox, _q: &SVector<f64, 7>) -> SMatrix<f64, 6, 6> {
        let back = *Self::rotation().inverse().matrix();
        blocks(back, -back * Self::offset().cross_matrix(), Matrix3::zeros(), back)
    }
    fn world_jacobian(_robot: &FreeBox, q: &SVector<f64, 7>) -> SMatrix<f64, 6, 6> {
        let rotation = *FreeBox::rotation(q).matrix();
        blocks(rotation, -rotation * Self::offset().cross_matrix(), Matrix3::zeros(), rotation)
    }
    fn acceleration(
        robot: &FreeBox,
        q: &SVector<f64, 7>,
        _v: &SVector<f64, 6>,
        a: &SVector<f64, 6>,
    ) -> SVector<f64, 6> {
        Self::jacobian(robot, q) * a
    }
}

impl CentroidalDynamics<f64, 7, 6> for FreeBox {
    fn total_mass(&self) -> f64 {
        self.mass
    }
    fn center_of_mass(&self, q: &SVector<f64, 7>) -> SVector<f64, 3> {
        FreeBox::center_of_mass(self, q)
    }
    fn centroidal_momentum_matrix(&self, q: &SVector<f64, 7>) -> SMatrix<f64, 6, 6> {
        let rotation = *Self::rotation(q).matrix();
        let linear = -rotation * self.com.cross_matrix() * self.mass;
        blocks(rotation * self.mass, linear, Matrix3::zeros(), rotation * self.inertia)
    }
}
