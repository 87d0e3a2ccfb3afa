//! How configurations move: the traits `Configuration` and `StateSpaceModel`, and the check of quaternions.

use std::fmt::Write as _;

use super::items::{Emitter, Host};
use super::methods::Written;
use crate::mechanics::equations::{Inputs, Trait};
use crate::model::Motion;

/// A joint with coordinates of its own, and where they begin.
struct Own {
    motion: Motion,
    q: usize,
    v: usize,
}

impl Own {
    /// `prefix0, prefix1, …` of its coordinates, in brackets unless it is one.
    fn coordinates(&self, prefix: &str) -> String {
        list(prefix, self.q, self.motion.coordinates())
    }

    /// The same of its speeds.
    fn speeds(&self, prefix: &str) -> String {
        list(prefix, self.v, self.motion.speeds())
    }
}

fn list(prefix: &str, from: usize, count: usize) -> String {
    let names: Vec<String> = (from..from + count).map(|k| format!("{prefix}{k}")).collect();
    if count == 1 { names.concat() } else { format!("[{}]", names.join(", ")) }
}

impl Emitter<'_, '_> {
    /// Joints with coordinates of their own, in the order of these.
    fn own_joints(&self) -> Vec<Own> {
        let mut joints: Vec<Own> = vec![];
        let mut next = 0;
        for link in &self.input.model.tree.links {
            if link.drive.q == next {
                joints.push(Own { motion: link.motion, q: link.drive.q, v: link.drive.v });
                next += link.motion.coordinates();
            }
        }
        joints
    }

    fn is_flat(&self) -> bool {
        self.sizes.inputs.coordinates == self.sizes.inputs.dof
    }

    /// `Configuration`, and `StateSpaceModel` where there are derivatives.
    pub(super) fn configuration(&self, written: &[Written]) -> String {
        let mut text = String::new();
        for host in self.types() {
            text.push_str(&self.open(&host, &self.of_sizes("Configuration"), &host.type_));
            text.push_str(&self.integrate());
            if !self.is_flat() {
                text.push_str(&self.difference());
                text.push_str(&self.rate("rate", "v"));
                text.push_str(&self.rate("rate_transposed", "p"));
                text.push_str(&self.neutral());
            }
            text.push_str("    }\n\n");
            if self.is_complete(Trait::DynamicsDerivatives, written) {
                text.push_str(&self.state_space(&host));
            }
        }
        text
    }

    fn integrate(&self) -> String {
        let Inputs { coordinates, dof, .. } = self.sizes.inputs;
        let scalar = &self.scalar;
        let mut text = format!(
            "        #[inline]\n        fn integrate(&self, q: &SVector<{scalar}, {coordinates}>, \
             delta: &SVector<{scalar}, {dof}>) -> SVector<{scalar}, {coordinates}> {{\n"
        );
        if self.is_flat() {
            return text + "            q + delta\n        }\n";
        }
        let _ = writeln!(text, "            let [{}] = q.data.0;", list("q", 0, coordinates));
        let _ = writeln!(text, "            let [{}] = delta.data.0;", in_brackets("d", dof));
        let mut results = vec![];
        for joint in self.own_joints() {
            let (q, d) = (joint.coordinates("q"), joint.speeds("d"));
            let function = match joint.motion {
                Motion::Ball => "integrate_ball",
                Motion::Free => "integrate_free",
                Motion::Revolute | Motion::Prismatic => {
                    results.push(format!("{q} + {d}"));
                    continue;
                }
            };
            let _ = writeln!(text, "            let {q} = {function}({q}, {d});");
            results.push(q.trim_matches(['[', ']']).to_owned());
        }
        let _ = writeln!(text, "            vector([{}])\n        }}", results.join(", "));
        text
    }

    fn difference(&self) -> String {
        let Inputs { coordinates, dof, .. } = self.sizes.inputs;
        let scalar = &self.scalar;
        let mut text = format!(
            "        #[inline]\n        fn difference(&self, q0: &SVector<{scalar}, {coordinates}>, \
             q1: &SVector<{scalar}, {coordinates}>) -> SVector<{scalar}, {dof}> {{\n"
        );
        for (letter, argument) in [("p", "q0"), ("q", "q1")] {
            let _ = writeln!(text, "            let [{}] = {argument}.data.0;", list(letter, 0, coordinates));
        }
        let mut results = vec![];
        for joint in self.own_joints() {
            let (p, q, d) = (joint.coordinates("p"), joint.coordinates("q"), joint.speeds("d"));
            let function = match joint.motion {
                Motion::Ball => "difference_ball",
                Motion::Free => "difference_free",
                Motion::Revolute | Motion::Prismatic => {
                    results.push(format!("{q} - {p}"));
                    continue;
                }
            };
            let _ = writeln!(text, "            let {d} = {function}({p}, {q});");
            results.push(d.trim_matches(['[', ']']).to_owned());
        }
        let _ = writeln!(text, "            vector([{}])\n        }}", results.join(", "));
        text
    }

    /// `rate`, of velocities, or `rate_transposed`, of forces.
    fn rate(&self, method: &str, argument: &str) -> String {
        let (scalar, n) = (&self.scalar, self.sizes.inputs.dof);
        let mut text = format!(
            "        #[inline]\n        fn {method}(&self, delta: &SVector<{scalar}, {n}>, \
             {argument}: &SVector<{scalar}, {n}>) -> SVector<{scalar}, {n}> {{\n"
        );
        for (prefix, vector) in [("d", "delta"), (argument, argument)] {
            let _ = writeln!(text, "            let [{}] = {vector}.data.0;", in_brackets(prefix, n));
        }
        for joint in self.own_joints() {
            let function = match joint.motion {
                Motion::Ball => format!("ball_{method}"),
                Motion::Free => format!("free_{method}"),
                Motion::Revolute | Motion::Prismatic => continue,
            };
            let (d, x) = (joint.speeds("d"), joint.speeds(argument));
            let _ = writeln!(text, "            let {x} = {function}({d}, {x});");
        }
        let _ = writeln!(
            text,
            "            vector([{}])\n        }}",
            list(argument, 0, n).trim_matches(['[', ']'])
        );
        text
    }

    /// Zeros and quaternions of no rotation.
    fn neutral(&self) -> String {
        let (scalar, coordinates) = (&self.scalar, self.sizes.inputs.coordinates);
        let last: Vec<usize> = self.input.model.tree.quaternions().map(|first| first + 3).collect();
        let entry = |k: usize| self.number(if last.contains(&k) { "1.0" } else { "0.0" });
        let entries: Vec<String> = (0..coordinates).map(entry).collect();
        format!(
            "        #[inline]\n        fn neutral(&self) -> SVector<{scalar}, {coordinates}> {{\n            \
             vector([{}])\n        }}\n",
            entries.join(", ")
        )
    }

    fn number(&self, value: &str) -> String {
        match self.literals() {
            super::context::Literals::Plain => value.to_owned(),
            super::context::Literals::Of(function) => format!("{function}({value})"),
        }
    }

    fn state_space(&self, host: &Host) -> String {
        let (scalar, n) = (&self.scalar, self.sizes.inputs.dof);
        let actuated = &self.input.model.actuated;
        let inputs = actuated.len();
        let trait_ = self.of_sizes("StateSpaceModel").replace('>', &format!(", {}, {inputs}>", 2 * n));
        let mut text = self.open(host, &trait_, &host.type_);
        let _ = writeln!(
            text,
            "        #[inline]\n        fn input_map(&self) -> SMatrix<{scalar}, {n}, {inputs}> {{"
        );
        if inputs == n {
            text.push_str("            SMatrix::identity()\n        }\n");
        } else {
            text.push_str("            columns([\n");
            for &speed in actuated {
                let entry = |k: usize| self.number(if k == speed { "1.0" } else { "0.0" });
                let entries: Vec<String> = (0..n).map(entry).collect();
                let _ = writeln!(text, "                [{}],", entries.join(", "));
            }
            text.push_str("            ])\n        }\n");
        }
        if !self.is_flat() {
            text.push_str(&self.tangent_rate());
        }
        text + "    }\n\n"
    }

    fn tangent_rate(&self) -> String {
        let (scalar, n) = (&self.scalar, self.sizes.inputs.dof);
        let mut text = format!(
            "        #[inline]\n        fn tangent_rate(&self, v: &SVector<{scalar}, {n}>) -> SMatrix<{scalar}, {n}, {n}> {{\n            \
             let [{}] = v.data.0;\n            let mut rate = SMatrix::zeros();\n",
            in_brackets("v", n)
        );
        for joint in self.own_joints() {
            let function = match joint.motion {
                Motion::Ball => "ball_tangent_rate",
                Motion::Free => "free_tangent_rate",
                Motion::Revolute | Motion::Prismatic => continue,
            };
            let _ = writeln!(
                text,
                "            put_on_diagonal(&mut rate, {}, {function}({}));",
                joint.v,
                joint.speeds("v")
            );
        }
        text + "            rate\n        }\n"
    }

    /// The override of `Dynamics::check_configuration`, if there is a quaternion.
    pub(super) fn check_configuration(&self) -> String {
        let (scalar, coordinates) = (&self.scalar, self.sizes.inputs.coordinates);
        let quaternions: Vec<usize> = self.input.model.tree.quaternions().collect();
        if quaternions.is_empty() {
            return String::new();
        }
        let mut text = format!(
            "\n        fn check_configuration(&self, q: &SVector<{scalar}, {coordinates}>) -> ::core::result::Result<(), Error> {{\n            \
             let [{}] = q.data.0;\n",
            list("q", 0, coordinates)
        );
        for first in quaternions {
            let quaternion = list("q", first, 4);
            let _ = writeln!(text, "            Error::unless_unit_quaternion({first}, {quaternion})?;");
        }
        text + "            ::core::result::Result::Ok(())\n        }\n"
    }
}

/// A pattern of a vector's entries, in brackets even if it is one.
fn in_brackets(prefix: &str, count: usize) -> String {
    if count == 1 { format!("[{prefix}0]") } else { list(prefix, 0, count) }
}
