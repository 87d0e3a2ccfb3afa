//! What the equations of a robot look like on paper.

use core::fmt;

/// `M`, `C`, `G`, `P`, `T`, `V` and `L` of a robot in closed form, SI units, as the derive writes them.
///
/// They come from the same robot as the code, and are compared with it exactly where this is tested. A field of the struct
/// has its own name, the coordinates those of their joints if these are letters (`theta1` is θ₁), and speeds have dots.
/// `Robot::equations()` is there for robots of at most four links whose forms are short enough to be read.
///
/// It prints as one equation after the other, in Unicode.
///
/// # Cost
///
/// None: constants, which are linked where they are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equations {
    /// `M(q)`, n×n.
    pub mass_matrix: Equation,
    /// `C(q,v)`, n×n, with `Ṁ = C + Cᵀ`.
    pub coriolis_matrix: Equation,
    /// `G(q) = ∂V/∂q`, n×1, on the left-hand side.
    pub gravity_forces: Equation,
    /// `P(q,v)` of `τ = M·a + C·v + G + P`, n×1: dampers, friction, springs and terms of dissipation; none where nothing
    /// acts by itself.
    pub passive_forces: Option<Equation>,
    /// `T(q,v)`, J.
    pub kinetic_energy: Equation,
    /// `V(q)`, J.
    pub potential_energy: Equation,
    /// `L = T − V`, J.
    pub lagrangian: Equation,
    /// Names for parts of them, each in those before it; none where they are short without.
    pub definitions: &'static [Definition],
}

/// A form in two notations.
///
/// It prints in Unicode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equation {
    /// As text: a matrix has a line for each row, with brackets that reach over all of them.
    pub unicode: &'static str,
    /// For LaTeX's mathematics, with the package `amsmath`; without dollars.
    pub latex: &'static str,
}

/// A name for a part of equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name.
    pub name: Equation,
    /// What it stands for.
    pub value: Equation,
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.unicode)
    }
}

impl fmt::Display for Equations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (letter, equation) in [
            ("M", Some(self.mass_matrix)),
            ("C", Some(self.coriolis_matrix)),
            ("G", Some(self.gravity_forces)),
            ("P", self.passive_forces),
            ("T", Some(self.kinetic_energy)),
            ("V", Some(self.potential_energy)),
            ("L", Some(self.lagrangian)),
        ] {
            let Some(equation) = equation else { continue };
            let rows = equation.unicode.lines().count();
            for (k, row) in equation.unicode.lines().enumerate() {
                // A matrix has its letter on its middle line.
                if k == rows.saturating_sub(1) / 2 {
                    writeln!(f, "{letter} = {row}")?;
                } else {
                    writeln!(f, "    {row}")?;
                }
            }
        }
        for Definition { name, value } in self.definitions {
            writeln!(f, "{name} = {value}")?;
        }
        Ok(())
    }
}
