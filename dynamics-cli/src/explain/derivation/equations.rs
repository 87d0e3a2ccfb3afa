//! From the energies to the forces and the state space.

use dynamics_codegen::closed::Form;
use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::lecture::{Body, Equations, Row};

use super::super::document::{Block, Math, Piece, Side, indexed, lowered, math, words};
use super::{Sides, Text, is_zero, letter, listed, of};

impl Text<'_, '_> {
    pub(super) fn mass_matrix(&mut self, bodies: &[Body], equations: &Equations) {
        self.heading("The mass matrix");
        let v = self.speeds();
        let quadratic = format!("$T = ½ {0}ᵀ·M·{0}|T = \\tfrac12 {1}^T M {1}$", v.unicode, v.latex);
        let matrix = Side::Matrix(equations.mass_matrix.clone());
        let by_speeds = format!("$∂²T/∂{0}²|\\partial^2 T/\\partial {1}^2$", v.unicode, v.latex);
        if bodies.is_empty() {
            self.text(&format!(
                "The kinetic energy is quadratic in the speeds, {quadratic}, and $M|M$ = {by_speeds}:"
            ));
            return self.equation([letter("M", "M"), matrix]);
        }
        self.text(&format!(
            "With $V_iᵇ = J_iᵇ·{0}|V_i^b = J_i^b {1}$ the kinetic energy of the bodies is {quadratic} with \
             $M = Σ J_iᵇᵀ·ℳ_i·J_iᵇ|M = \\sum_i {{J_i^b}}^T \\mathcal M_i J_i^b$.",
            v.unicode, v.latex
        ));
        let share = |i: usize| {
            letter(
                &format!("J{0}ᵇᵀ·ℳ{0}·J{0}ᵇ", lowered(i + 1)),
                &format!("{{J_{{{0}}}^b}}^T \\mathcal M_{{{0}}} J_{{{0}}}^b", i + 1),
            )
        };
        let of_terms = equations.terms.as_ref().filter(|terms| !terms.kinetic_energy.is_zero());
        if let ([_], None, None) = (bodies, &equations.rotors, of_terms) {
            return self.equation([letter("M", "M"), share(0), matrix]);
        }
        self.text(if bodies.len() == 1 { "The body adds:" } else { "The bodies add:" });
        for (i, body) in bodies.iter().enumerate() {
            self.equation([share(i), Side::Matrix(body.share.clone())]);
        }
        if let Some(rotors) = &equations.rotors {
            self.text("The rotors add, as the joints feel them:");
            let name = letter("M_rotors", "M_{\\text{rotors}}");
            self.equation([name, Side::Matrix(rotors.mass_matrix.clone())]);
        }
        if let Some(terms) = of_terms {
            self.text("The terms of the kinetic energy add:");
            let name = letter(
                &format!("∂²T_terms/∂{}²", v.unicode),
                &format!("\\partial^2 T_{{\\text{{terms}}}}/\\partial {}^2", v.latex),
            );
            self.equation([name, Side::Matrix(terms.mass_matrix.clone())]);
        }
        self.text("In all:");
        self.equation([letter("M", "M"), matrix]);
    }

    pub(super) fn coriolis(&mut self, equations: &Equations) {
        self.heading("Coriolis and centrifugal forces");
        let matrix = Side::Matrix(equations.coriolis_matrix.clone());
        let Some(symbols) = &equations.christoffel else {
            return self.coriolis_by_brackets(is_zero(&equations.coriolis_matrix), matrix);
        };
        let definition = "$Γ_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i)|\\Gamma_{ijk} = \\tfrac12 \\left( \
             \\frac{\\partial M_{ij}}{\\partial q_k} + \\frac{\\partial M_{ik}}{\\partial q_j} - \
             \\frac{\\partial M_{jk}}{\\partial q_i} \\right)$";
        if symbols.is_empty() {
            return self.text(&format!(
                "How $M|M$ changes is in Christoffel's symbols {definition}. Here $M|M$ is constant, so that all of them are \
                 zero, and $C = 0|C = 0$."
            ));
        }
        let alike =
            if self.model.tree.dof() > 1 { ", which are alike in their last two indices" } else { "" };
        self.text(&format!("How $M|M$ changes is in Christoffel's symbols {definition}{alike}."));
        match symbols.len() {
            1 => self.text("One is not zero, with the derivatives that it comes from:"),
            _ => self.text("Those that are not zero, each with the derivatives that it comes from:"),
        }
        for symbol in symbols {
            let [i, j, k] = symbol.indices;
            let entries = [(i, j, k, 1), (i, k, j, 1), (j, k, i, -1)];
            let sum = self.halves(&entries, &symbol.derivatives);
            let mut name = indexed("Γ", "\\Gamma", &[i, j, k], None);
            if j != k {
                let mirrored = indexed("Γ", "\\Gamma", &[i, k, j], None);
                name = math(
                    format!("{} = {}", name.unicode, mirrored.unicode),
                    format!("{} = {}", name.latex, mirrored.latex),
                );
            }
            self.equation([Side::Math(name), Side::Math(sum), Side::Form(symbol.value.clone())]);
        }
        self.text("With these $C_ij = Σ_k Γ_ijk·q̇_k|C_{ij} = \\sum_k \\Gamma_{ijk} \\dot q_k$, so that $Ṁ = C + Cᵀ|\\dot M = C + C^T$:");
        self.equation([letter("C", "C"), matrix]);
    }

    /// Where speeds are no rates of coordinates.
    fn coriolis_by_brackets(&mut self, is_zero: bool, matrix: Side) {
        self.text(
            "Angular velocities are no rates of coordinates: turning about x and then about y is not turning about y and then \
             about x. By how much is what the brackets of unit speeds $e_i|e_i$ say, \
             $[e_i, e_j] = e_i × e_j|[e_i, e_j] = e_i \\times e_j$ for two angular velocities of a body in its own axes, and for \
             an angular and a linear one of it; all others are zero. They enter beside the rates \
             $∂_k|\\partial_k$ at which $M|M$ changes while the speed k is one:",
        );
        let brackets = letter(
            "½ Σ_k (∂_k M_ij + ∂_j M_ik − ∂_i M_jk) v_k + ½ (e_iᵀ·M·[v, e_j] − e_jᵀ·M·[v, e_i] − vᵀ·M·[e_j, e_i])",
            "\\tfrac12 \\sum_k \\left( \\partial_k M_{ij} + \\partial_j M_{ik} - \\partial_i M_{jk} \\right) v_k + \
             \\tfrac12 \\left( e_i^T M [v, e_j] - e_j^T M [v, e_i] - v^T M [e_j, e_i] \\right)",
        );
        self.equation([letter("C_ij", "C_{ij}"), brackets]);
        self.text(
            "This is Koszul's formula; where all speeds are rates it is Christoffel's. Again \
             $Ṁ = C + Cᵀ|\\dot M = C + C^T$.",
        );
        match is_zero {
            true => self.text("Here all of it is zero: $C = 0|C = 0$."),
            false => self.equation([letter("C", "C"), matrix]),
        }
    }

    /// Half of the sum of those derivatives of entries of M that are not zero; equal ones once.
    fn halves(&self, entries: &[(usize, usize, usize, i32)], values: &[Form; 3]) -> Math {
        let mut terms: Vec<((usize, usize, usize), i32)> = Vec::new();
        for (&(i, j, k, sign), value) in entries.iter().zip(values) {
            if value.is_zero() {
                continue;
            }
            let entry = (i.min(j), i.max(j), k);
            match terms.iter_mut().find(|(known, _)| *known == entry) {
                Some((_, count)) => *count += sign,
                None => terms.push((entry, sign)),
            }
        }
        terms.retain(|(_, count)| *count != 0);
        let (mut unicode, mut latex) = (String::new(), String::new());
        let is_single = terms.len() == 1;
        for (n, ((i, j, k), count)) in terms.iter().enumerate() {
            let sign = match (n, *count < 0) {
                (0, false) => ["", ""],
                (0, true) => ["−", "-"],
                (_, false) => [" + ", " + "],
                (_, true) => [" − ", " - "],
            };
            let factor = match (is_single, count.abs()) {
                (true, 1) => ["½ ", "\\tfrac12 "],
                (false, 2) => ["2 ", "2 "],
                _ => ["", ""],
            };
            let entry = indexed("M", "M", &[*i, *j], None);
            let by = self.written(&self.symbol(Argument::Q, *k));
            unicode += &format!("{}{}∂{}/∂{}", sign[0], factor[0], entry.unicode, by.unicode);
            latex += &format!(
                "{}{}\\frac{{\\partial {}}}{{\\partial {}}}",
                sign[1], factor[1], entry.latex, by.latex
            );
        }
        if is_single {
            math(unicode, latex)
        } else {
            math(format!("½ ({unicode})"), format!("\\tfrac12 \\left( {latex} \\right)"))
        }
    }

    pub(super) fn potential(&mut self, equations: &Equations) {
        let has_terms = equations.terms.as_ref().is_some_and(|terms| !terms.potential_energy.is_zero());
        let (title, whose) = match (self.has_gravity(), has_terms) {
            (true, false) => ("Gravity", "of gravity"),
            (true, true) => ("Gravity and other potentials", "of gravity and of the terms of $V|V$"),
            (false, _) => ("Potential forces", "of the potential energy"),
        };
        self.heading(title);
        let rates = match self.is_flat() {
            true => "$G = ∂V/∂q|G = \\partial V / \\partial q$".to_owned(),
            false => "$G|G$: $G_i|G_i$ is how fast $V|V$ grows while the speed $v_i|v_i$ is one and every other is zero".to_owned(),
        };
        if equations.potential_energy.is_zero() {
            return self.text("There is no potential energy, and $G = 0|G = 0$.");
        }
        if is_zero(&equations.gravity_forces) {
            return self.text("$V|V$ is the same in every configuration, and $G = 0|G = 0$.");
        }
        self.text(&format!("The forces {whose}, on the left-hand side, are {rates}:"));
        self.equation([letter("G", "G"), Side::Matrix(equations.gravity_forces.clone())]);
    }

    /// `M·a + C·v + G`, of what is not zero.
    fn left_hand_side(&self, equations: &Equations) -> Math {
        let (a, v) = (self.accelerations(), self.speeds());
        let mut sides = math(format!("M·{}", a.unicode), format!("M {}", a.latex));
        if !is_zero(&equations.coriolis_matrix) {
            sides.unicode += &format!(" + C·{}", v.unicode);
            sides.latex += &format!(" + C {}", v.latex);
        }
        if !is_zero(&equations.gravity_forces) {
            sides.unicode += " + G";
            sides.latex += " + G";
        }
        sides
    }

    pub(super) fn lagrange(&mut self, equations: &Equations) {
        self.heading("The equations of motion");
        let sides = self.left_hand_side(equations);
        let matrices = format!("$Υ = {}|\\Upsilon = {}$", sides.unicode, sides.latex);
        let is_passive = equations.passive.is_some();
        let whose = match (is_passive, self.model.actuated.is_empty()) {
            (true, _) => "all forces that are not in $V|V$: those of the motors, and what acts by itself",
            (false, false) => "the forces of the motors",
            (false, true) => "the forces from outside; there are no motors",
        };
        let lagrange = "$d/dt ∂L/∂q̇ − ∂L/∂q = Υ|\\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot q} - \
                        \\frac{\\partial L}{\\partial q} = \\Upsilon$";
        match &equations.rows {
            None => {
                self.text(&format!(
                    "Lagrange's equations {lagrange} are of rates of coordinates. Along speeds that are none they have the \
                     brackets as well, as G. Hamel wrote them in 1904; in matrices nothing changes: {matrices}, with \
                     $Υ|\\Upsilon$ {whose}{}",
                    if is_passive { "." } else { ":" }
                ));
                if !is_passive {
                    self.forces("Υ", "\\Upsilon", equations);
                }
            }
            Some(rows) => {
                self.text(&format!("Lagrange's equations are {lagrange}, with $Υ|\\Upsilon$ {whose}."));
                self.rows(rows);
                self.text(&format!("The same in matrices is {matrices}."));
            }
        }
        if let Some(passive) = &equations.passive {
            self.text(&format!("On the left-hand side {} by", self.passive_parts()));
            self.equation([letter("P", "P"), Side::Matrix(passive.clone())]);
            let all =
                format!("$τ = Υ + P = {} + P|\\tau = \\Upsilon + P = {} + P$", sides.unicode, sides.latex);
            let whose = match self.model.actuated.is_empty() {
                true => "so that from outside there would have to come",
                false => "so that the motors give",
            };
            self.text(&format!("{whose} {all}:"));
            self.forces("τ", "\\tau", equations);
        }
    }

    fn rows(&mut self, rows: &[Row]) {
        for (i, row) in rows.iter().enumerate() {
            if rows.len() > 1 {
                let mut of_row = words("Of ");
                of_row.push(Piece::Form(self.symbol(Argument::Q, i)));
                of_row.extend(words(":"));
                self.blocks.push(Block::Text(of_row));
            }
            let q = self.written(&self.symbol(Argument::Q, i));
            let v = self.written(&self.symbol(Argument::V, i));
            let by = |x: &Math| {
                math(format!("∂L/∂{}", x.unicode), format!("\\frac{{\\partial L}}{{\\partial {}}}", x.latex))
            };
            let momentum = by(&v);
            let rate =
                math(format!("d/dt {}", momentum.unicode), format!("\\frac{{d}}{{dt}} {}", momentum.latex));
            self.equation([Side::Math(momentum), Side::Form(row.momentum.clone())]);
            self.equation([Side::Math(rate), Side::Form(row.rate.clone())]);
            self.equation([Side::Math(by(&q)), Side::Form(row.by_coordinate.clone())]);
            self.equation([of(i, "Υ", "\\Upsilon"), Side::Form(row.force.clone())]);
        }
    }

    fn forces(&mut self, unicode: &str, latex: &str, equations: &Equations) {
        let forces: Vec<Form> = equations.forces.entries().map(|(_, _, form)| form.clone()).collect();
        for (i, force) in forces.into_iter().enumerate() {
            self.equation([of(i, unicode, latex), Side::Form(force)]);
        }
    }

    /// What acts by itself, as the subject of a sentence.
    pub(super) fn passive_parts(&self) -> String {
        let parts = self.passive();
        format!("{} {}", listed(&parts), if parts == ["friction"] { "acts" } else { "act" })
    }

    pub(super) fn state_space(&mut self, sides: &Sides<'_>) {
        self.heading("The state space");
        let (dof, driven) = (self.model.tree.dof(), self.model.actuated.len());
        let (is_flat, v) = (self.is_flat(), self.speeds());
        let state = format!("$x = (q, {})|x = (q, {})$", v.unicode, v.latex);
        let tau = if sides.acts { ["τ", "\\tau"] } else { ["Υ", "\\Upsilon"] };
        let motors = match driven {
            _ if driven == dof => format!(
                "the input is the vector $u|u$ of the motors' forces, $u = {}|u = {}$",
                tau[0], tau[1]
            ),
            0 => "there is no input".to_owned(),
            _ => format!(
                "the input is the vector $u|u$ of the motors' forces, which the matrix $B|B$ of ones and zeros gives to their \
                 joints: ${} = B·u|{} = B u$",
                tau[0], tau[1]
            ),
        };
        self.text(&format!(
            "The state is {state}, and {motors}. Where $M|M$ is positive definite, the equations can be solved for the \
             accelerations, and $ẋ = f(x, u)|\\dot x = f(x, u)$ is"
        ));
        let rate = |unicode: &str, latex: &str| {
            letter(&format!("d/dt {unicode}"), &format!("\\tfrac{{d}}{{dt}} {latex}"))
        };
        match sides.rates {
            None => self.equation([rate("q", "q"), Side::Math(v.clone())]),
            Some(rates) => self.equation([rate("q", "q"), Side::Matrix(rates.clone())]),
        }
        let input = match driven {
            0 => ["", ""],
            _ if driven == dof => ["u", "u"],
            _ => ["B·u", "B u"],
        };
        let parts = [
            (driven > 0, input.map(str::to_owned)),
            (sides.turns, [format!("C·{}", v.unicode), format!("C {}", v.latex)]),
            (sides.pulls, ["G", "G"].map(str::to_owned)),
            (sides.acts, ["P", "P"].map(str::to_owned)),
        ];
        let parts: Vec<[String; 2]> =
            parts.into_iter().filter(|(is_there, _)| *is_there).map(|(_, part)| part).collect();
        let lead = if driven > 0 { ["", ""] } else { ["−", "-"] };
        let accelerations = match &parts[..] {
            [] => math("0", "0"),
            [[unicode, latex]] => {
                math(format!("{}M⁻¹·{unicode}", lead[0]), format!("{}M^{{-1}} {latex}", lead[1]))
            }
            _ => {
                let sum = |k: usize, minus: &str| {
                    parts.iter().map(|part| &*part[k]).collect::<Vec<_>>().join(minus)
                };
                math(
                    format!("M⁻¹·({}{})", lead[0], sum(0, " − ")),
                    format!("M^{{-1}} \\left( {}{} \\right)", lead[1], sum(1, " - ")),
                )
            }
        };
        self.equation([rate(&v.unicode, &v.latex), Side::Math(accelerations)]);
        if !is_flat {
            self.text(
                "A quaternion changes by half of its product with the angular velocity, and stays of length one; the place of \
                 a free body by its linear velocity, turned into the axes that the place is given in.",
            );
        }
    }
}
