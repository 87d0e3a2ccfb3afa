//! The numbers of Pinocchio in `robots/<name>/reference.json`.

#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::ops::Range;

use serde_json::Value;

use crate::{Matrix, Vector};

/// A reference file.
pub struct Reference {
    /// The joints, in the order of the coordinates.
    pub joints: Vec<ReferenceJoint>,
    /// The link whose pose is given.
    pub tool: String,
    /// The states, the first at rest.
    pub states: Vec<ReferenceState>,
}

/// A joint of a reference file, with the body that it carries.
pub struct ReferenceJoint {
    /// The name in the URDF.
    pub name: String,
    /// Its coordinates in `q`.
    pub q: Range<usize>,
    /// Its speeds in `v`.
    pub v: Range<usize>,
    /// The ten parameters of the body about the origin of the joint's frame, in the regressor's order.
    pub parameters: [f64; 10],
}

/// One state of a reference file.
pub struct ReferenceState(Value);

impl Reference {
    /// Reads the file of a robot.
    ///
    /// # Panics
    ///
    /// If it is not there, or not as expected.
    pub fn of(robot: &str) -> Self {
        let path = format!("{}/robots/{robot}/reference.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let file: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
        let joints = list(&file["joints"]).iter().scan((0, 0), |(q, v), joint| {
            // Not by `idx_q`: Pinocchio's own coordinates of a continuous joint are a cosine and a sine.
            let (coordinates, speeds) =
                if text_of(&joint["type"]).contains("FreeFlyer") { (7, 6) } else { (1, 1) };
            let (from_q, from_v) = (*q, *v);
            (*q, *v) = (*q + coordinates, *v + speeds);
            let name = text_of(&joint["name"]);
            Some(ReferenceJoint {
                name,
                q: from_q..*q,
                v: from_v..*v,
                parameters: parameters(&joint["inertia"]),
            })
        });
        Self {
            joints: joints.collect(),
            tool: text_of(&file["ee"]["link"]),
            states: list(&file["states"]).iter().cloned().map(ReferenceState).collect(),
        }
    }

    /// Where the coordinates of a robot with these joints are in the reference, which may have another order.
    ///
    /// # Panics
    ///
    /// If the joints are not the same.
    pub fn order(&self, joint_names: &[&str]) -> Order {
        assert_eq!(joint_names.len(), self.joints.len(), "{joint_names:?}");
        let place = |name: &&str| self.joints.iter().position(|joint| joint.name == *name);
        let joints: Vec<usize> = joint_names
            .iter()
            .map(|name| place(name).unwrap_or_else(|| panic!("{name} is unknown")))
            .collect();
        let all = |of: fn(&ReferenceJoint) -> Range<usize>| {
            joints.iter().flat_map(|&k| of(&self.joints[k])).collect()
        };
        Order { q: all(|joint| joint.q.clone()), v: all(|joint| joint.v.clone()), joints }
    }
}

/// Where a robot's coordinates, speeds and joints are in those of its reference.
pub struct Order {
    q: Vec<usize>,
    v: Vec<usize>,
    /// The place of each joint.
    pub joints: Vec<usize>,
}

impl Order {
    /// The coordinates in the robot's order.
    pub fn coordinates(&self, q: &Vector) -> Vector {
        q.select_rows(&self.q)
    }

    /// Speeds, accelerations or forces in the robot's order.
    pub fn speeds(&self, v: &Vector) -> Vector {
        v.select_rows(&self.v)
    }

    /// A matrix between these in the robot's order.
    pub fn matrix(&self, matrix: &Matrix) -> Matrix {
        self.columns(matrix).select_rows(&self.v)
    }

    /// A matrix with columns for speeds, in the robot's order.
    pub fn columns(&self, matrix: &Matrix) -> Matrix {
        matrix.select_columns(&self.v)
    }

    /// A regressor of ten columns for each body, in the robot's order.
    pub fn regressor(&self, Y: &Matrix) -> Matrix {
        let columns: Vec<usize> = self.joints.iter().flat_map(|joint| 10 * joint..10 * joint + 10).collect();
        Y.select_rows(&self.v).select_columns(&columns)
    }
}

impl ReferenceState {
    /// The number with this name.
    ///
    /// # Panics
    ///
    /// If there is none.
    pub fn number(&self, name: &str) -> f64 {
        number(&self.0[name])
    }

    /// The vector with this name.
    ///
    /// # Panics
    ///
    /// If there is none.
    pub fn vector(&self, name: &str) -> Vector {
        vector(&self.0[name])
    }

    /// The matrix with this name.
    ///
    /// # Panics
    ///
    /// If there is none.
    pub fn matrix(&self, name: &str) -> Matrix {
        matrix(&self.0[name])
    }

    /// The rotation and translation of the tool.
    pub fn tool_pose(&self) -> (Matrix, Vector) {
        (matrix(&self.0["ee"]["R"]), vector(&self.0["ee"]["p"]))
    }

    /// A Jacobian of the tool: `J_local` in its own axes, `J_lwa` in the world's.
    pub fn tool_jacobian(&self, name: &str) -> Matrix {
        matrix(&self.0["ee"][name])
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("a list is expected, not {value}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number is expected, not {value}"))
}

fn text_of(value: &Value) -> String {
    value.as_str().unwrap_or_else(|| panic!("a text is expected, not {value}")).to_owned()
}

fn vector(value: &Value) -> Vector {
    Vector::from_iterator(list(value).len(), list(value).iter().map(number))
}

fn matrix(value: &Value) -> Matrix {
    let rows = list(value);
    let columns = list(&rows[0]).len();
    Matrix::from_row_iterator(rows.len(), columns, rows.iter().flat_map(list).map(number))
}

/// `m`, `m·c`, and the inertia about the origin: that about the centre of mass and `m (|c|²·1 − c·cᵀ)`.
fn parameters(body: &Value) -> [f64; 10] {
    let (mass, center, inertia) = (number(&body["mass"]), vector(&body["com"]), matrix(&body["I_com"]));
    let about_origin = Matrix::identity(3, 3) * center.norm_squared() - &center * center.transpose();
    let I = inertia + about_origin * mass;
    let [x, y, z] = [0, 1, 2].map(|k| mass * center[k]);
    [mass, x, y, z, I[(0, 0)], I[(0, 1)], I[(1, 1)], I[(0, 2)], I[(1, 2)], I[(2, 2)]]
}
