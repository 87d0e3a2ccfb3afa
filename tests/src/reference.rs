//! The numbers of Pinocchio in `robots/<name>/reference.json`.

use serde_json::Value;

use crate::{Matrix, Vector};

/// The states of a reference file.
pub struct Reference {
    /// The joints, in the order of the coordinates.
    pub joint_names: Vec<String>,
    /// The link whose pose is given.
    pub tool: String,
    /// The states, the first at rest.
    pub states: Vec<ReferenceState>,
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
        Self {
            joint_names: list(&file["joints"]).iter().map(|joint| text_of(&joint["name"])).collect(),
            tool: text_of(&file["ee"]["link"]),
            states: list(&file["states"]).iter().cloned().map(ReferenceState).collect(),
        }
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
