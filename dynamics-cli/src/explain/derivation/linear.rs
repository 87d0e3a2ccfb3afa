//! Small motions about the zero configuration.

use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::lecture::Linear;
use dynamics_codegen::model::Motion;

use super::super::document::{Side, math};
use super::{Text, is_zero, letter, listed};

impl Text<'_, '_> {
    pub(super) fn linear(&mut self, linear: &Linear) {
        self.heading("Linear, about the zero configuration at rest");
        self.hold(linear);
        self.deviations();
        let is_driven = linear.inputs.columns() > 0;
        let [forces, forces_latex] = if is_driven { ["B·δu", "B\\, \\delta u"] } else { ["0", "0"] };
        let small = if is_driven { ", by small forces $δu|\\delta u$ more," } else { "" };
        let is_damped = !is_zero(&linear.damping);
        let is_stiff = !is_zero(&linear.stiffness);
        let (v, a) = (self.speeds(), self.accelerations());
        let (mut left, mut left_latex) =
            (format!("M₀·δ{}", a.unicode), format!("M_0\\, \\delta {}", a.latex));
        if is_damped {
            left += &format!(" + D₀·δ{}", v.unicode);
            left_latex += &format!(" + D_0\\, \\delta {}", v.latex);
        }
        if is_stiff {
            left += " + K₀·δq";
            left_latex += " + K_0\\, \\delta q";
        }
        let is_still =
            self.lecture.equations.as_ref().is_ok_and(|equations| is_zero(&equations.coriolis_matrix));
        let turning =
            if is_still { "" } else { "; the forces of Coriolis are quadratic in the speeds, and gone" };
        self.text(&format!(
            "Small motions $δq|\\delta q$ about it{small} obey ${left} = {forces}|{left_latex} = {forces_latex}${turning}. \
             There"
        ));
        self.equation([letter("M₀", "M_0"), letter("M", "M"), Side::Matrix(linear.mass_matrix.clone())]);
        if is_damped {
            let by = letter(
                &format!("∂P/∂{}", v.unicode),
                &format!("\\frac{{\\partial P}}{{\\partial {}}}", v.latex),
            );
            self.equation([letter("D₀", "D_0"), by, Side::Matrix(linear.damping.clone())]);
        }
        let [of, of_latex] = if self.is_passive() { ["(G + P)", "(G + P)"] } else { ["G", "G"] };
        let by = letter(&format!("∂{of}/∂q"), &format!("\\frac{{\\partial {of_latex}}}{{\\partial q}}"));
        match (is_stiff, self.is_flat()) {
            (true, true) => self.equation([letter("K₀", "K_0"), by, Side::Matrix(linear.stiffness.clone())]),
            (true, false) => {
                self.equation([letter("K₀", "K_0"), Side::Matrix(linear.stiffness.clone())]);
                self.text(&format!(
                    "where column j of $K₀|K_0$ is how ${of}|{of_latex}$ changes along the j-th deviation."
                ));
            }
            (false, _) => {}
        }
        match self.model.actuated.len() {
            0 => {}
            driven if driven == self.model.tree.dof() => {
                self.text("Every speed has its motor: $B = 1|B = 1$.")
            }
            _ => self.equation([letter("B", "B"), Side::Matrix(linear.inputs.clone())]),
        }
        if !is_stiff {
            self.text("Nothing pulls it back or drives it away: $K₀ = 0|K_0 = 0$.");
        }
        if !is_damped {
            self.text("Nothing is damped: $D₀ = 0|D_0 = 0$.");
        }
        self.state_matrices(linear, is_driven, is_damped, is_stiff);
    }

    /// What holds the robot there, and whether it can.
    fn hold(&mut self, linear: &Linear) {
        if is_zero(&linear.hold) {
            let driven = !self.model.actuated.is_empty();
            return self.text(if driven {
                "The robot stays there, with no force of its motors."
            } else {
                "The robot stays there."
            });
        }
        self.text("The robot does not stay there by itself. To hold it takes the forces");
        let [name, latex] = if self.is_passive() { ["τ₀", "\\tau_0"] } else { ["Υ₀", "\\Upsilon_0"] };
        self.equation([letter(name, latex), Side::Matrix(linear.hold.clone())]);
        let lacking: Vec<String> = (0..self.model.tree.dof())
            .filter(|k| !self.model.actuated.contains(k) && !linear.hold.entry(*k, 0).is_zero())
            .map(|k| {
                let speed = self.written(&self.symbol(Argument::V, k));
                let coordinate = self.written(&self.symbol(Argument::Q, k));
                match self.is_flat() {
                    true => format!("${}|{}$", coordinate.unicode, coordinate.latex),
                    false => format!("${}|{}$", speed.unicode, speed.latex),
                }
            })
            .collect();
        if !lacking.is_empty() {
            self.text(&format!(
                "No motor drives {}, so that it is no equilibrium of the robot alone: what follows is true while something \
                 else holds it with that force.",
                listed(&lacking)
            ));
        }
    }

    /// What deviations are, where coordinates have quaternions.
    fn deviations(&mut self) {
        let has = |motion: Motion| self.model.tree.links.iter().any(|link| link.motion == motion);
        let quaternion = "the unit quaternion (0, 0, 0, 1) becomes \
                          $(½ δr, 1)|(\\tfrac12 \\delta r,\\, 1)$ to the first order";
        if has(Motion::Ball) {
            self.text(&format!(
                "The deviation $δq|\\delta q$ of a ball joint is a small rotation vector $δr|\\delta r$, three numbers in the \
                 axes of the body: {quaternion}, and $d/dt δq = δv|\\tfrac{{d}}{{dt}} \\delta q = \\delta v$."
            ));
        }
        if has(Motion::Free) {
            self.text(&format!(
                "The deviation $δq|\\delta q$ of a free joint is a small displacement and then a small rotation vector \
                 $δr|\\delta r$, six numbers in the axes of the body: {quaternion}, and \
                 $d/dt δq = δv|\\tfrac{{d}}{{dt}} \\delta q = \\delta v$."
            ));
        }
    }

    fn state_matrices(&mut self, linear: &Linear, is_driven: bool, is_damped: bool, is_stiff: bool) {
        let v = self.speeds();
        self.text(&format!(
            "As a state space, of the state $δx = (δq, δ{})|\\delta x = (\\delta q, \\delta {})$, it is",
            v.unicode, v.latex
        ));
        self.equation([
            letter("d/dt δq", "\\tfrac{d}{dt} \\delta q"),
            letter(&format!("δ{}", v.unicode), &format!("\\delta {}", v.latex)),
        ]);
        let damping = [format!("M₀⁻¹·D₀·δ{}", v.unicode), format!("M_0^{{-1}} D_0\\, \\delta {}", v.latex)];
        let parts = [
            (is_stiff, true, ["M₀⁻¹·K₀·δq", "M_0^{-1} K_0\\, \\delta q"].map(str::to_owned)),
            (is_damped, true, damping),
            (is_driven, false, ["M₀⁻¹·B·δu", "M_0^{-1} B\\, \\delta u"].map(str::to_owned)),
        ];
        let (mut unicode, mut latex) = (String::new(), String::new());
        for (_, is_minus, [text, in_latex]) in parts.into_iter().filter(|(is_there, ..)| *is_there) {
            let [sign, latex_sign] = match (unicode.is_empty(), is_minus) {
                (true, true) => ["−", "-"],
                (true, false) => ["", ""],
                (false, true) => [" − ", " - "],
                (false, false) => [" + ", " + "],
            };
            unicode += &format!("{sign}{text}");
            latex += &format!("{latex_sign}{in_latex}");
        }
        let sides = if unicode.is_empty() { math("0", "0") } else { math(unicode, latex) };
        self.equation([
            letter(&format!("d/dt δ{}", v.unicode), &format!("\\tfrac{{d}}{{dt}} \\delta {}", v.latex)),
            Side::Math(sides),
        ]);
        let Some(lower) = linear.lower.as_ref().filter(|lower| !is_zero(lower)) else { return };
        self.text("$M₀|M_0$ is diagonal, and the lower half of the state matrix A is easily written out:");
        self.equation([
            letter("(−M₀⁻¹·K₀, −M₀⁻¹·D₀)", "\\left( -M_0^{-1} K_0,\\ -M_0^{-1} D_0 \\right)"),
            Side::Matrix(lower.clone()),
        ]);
    }
}
