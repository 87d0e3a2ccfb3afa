//! The words around a derivation: from the figure of a robot to its equations, as a lecture walks.

use dynamics_codegen::closed::{Form, Matrix};
use dynamics_codegen::mechanics::equations::{Argument, Inputs};
use dynamics_codegen::mechanics::lecture::{Body, Equations, Joint, Lecture, Linear, MOST_DOF, NoLinear};
use dynamics_codegen::mechanics::letters::own;
use dynamics_codegen::model::{Model, Motion};

use super::document::{Block, Math, Piece, Side, indexed, lowered, math, words};

/// Writes all steps, to the one that would be too long.
pub(super) fn document(model: &Model<'_>, lecture: &Lecture) -> Vec<Block> {
    let mut text = Text { model, lecture, blocks: vec![] };
    text.title();
    text.figure();
    text.steps();
    text.blocks
}

struct Text<'d, 'g> {
    model: &'d Model<'g>,
    lecture: &'d Lecture,
    blocks: Vec<Block>,
}

impl Text<'_, '_> {
    fn heading(&mut self, number: usize, title: &str) {
        self.blocks.push(Block::Heading(format!("{number}. {title}")));
    }

    fn text(&mut self, text: &str) {
        self.blocks.push(Block::Text(words(text)));
    }

    fn equation(&mut self, sides: impl IntoIterator<Item = Side>) {
        self.blocks.push(Block::Equation(sides.into_iter().collect()));
    }

    fn is_flat(&self) -> bool {
        self.model.tree.is_one_dof()
    }

    fn title(&mut self) {
        self.blocks.push(Block::Title(words(&format!("The equations of motion of `{}`", self.model.name))));
        let dof = self.model.tree.dof();
        let degrees =
            if dof == 1 { "one degree of freedom".to_owned() } else { format!("{dof} degrees of freedom") };
        self.text(&format!("A robot of {degrees}. All is in SI units and radians."));
    }

    fn figure(&mut self) {
        self.heading(1, "The robot, where its coordinates are zero");
        let Ok(figure) = &self.lecture.figure else { return self.too_long("The figure") };
        let joints = figure.joints.iter().map(|joint| self.joint(joint)).collect();
        self.blocks.push(Block::List(joints));
        let mut gravity = words("All falls with the acceleration $g⃗|\\vec g$ = ");
        gravity.push(Piece::Vector(figure.gravity.clone()));
        gravity.extend(words(" in the world."));
        self.blocks.push(Block::Text(gravity));
    }

    fn joint(&self, joint: &Joint) -> Vec<Piece> {
        let what = joint.body.as_ref().map_or("what follows".to_owned(), |body| format!("`{body}`"));
        let carrier = match (&joint.parent, joint.is_on_world) {
            (_, true) => " on the world".to_owned(),
            (Some(parent), _) => format!(" on `{parent}`"),
            (None, _) => String::new(),
        };
        let verb = match joint.motion {
            Motion::Revolute => "turns",
            Motion::Prismatic => "slides",
            Motion::Ball => "turns freely",
            Motion::Free => "moves freely",
        };
        let mut text = words(&format!("`{}`: {what} {verb}{carrier}", joint.name));
        match joint.motion {
            Motion::Revolute => {
                text.extend(words(" about the axis "));
                text.push(Piece::Vector(joint.axis.clone()));
                text.extend(words(" through the point "));
                text.push(Piece::Vector(joint.point.clone()));
            }
            Motion::Prismatic => {
                text.extend(words(" along "));
                text.push(Piece::Vector(joint.axis.clone()));
            }
            Motion::Ball => {
                text.extend(words(" about the point "));
                text.push(Piece::Vector(joint.point.clone()));
            }
            Motion::Free => {}
        }
        match joint.motion {
            Motion::Revolute | Motion::Prismatic => {
                text.extend(words(", by "));
                text.push(Piece::Form(joint.coordinate.clone()));
            }
            Motion::Ball => text.extend(self.named(", by the unit quaternion ", Argument::Q, joint.q, 4)),
            Motion::Free => {
                text.extend(self.named(", to the place ", Argument::Q, joint.q, 3));
                text.extend(self.named(", turned by the unit quaternion ", Argument::Q, joint.q + 3, 4));
            }
        }
        match joint.motion {
            Motion::Ball => {
                text.extend(self.named(", at the angular velocity in its own axes ", Argument::V, joint.v, 3))
            }
            Motion::Free => {
                text.extend(self.named(", at the twist in its own axes ", Argument::V, joint.v, 6))
            }
            Motion::Revolute | Motion::Prismatic => {}
        }
        text.extend(words("."));
        text
    }

    fn named(&self, before: &str, argument: Argument, first: usize, count: usize) -> Vec<Piece> {
        let symbols = (first..first + count).map(|k| self.symbol(argument, k));
        let mut text = words(before);
        text.push(Piece::Vector(Matrix::vector(symbols.collect())));
        text
    }

    fn symbol(&self, argument: Argument, k: usize) -> Form {
        Form::Symbol(Inputs::of(self.model).symbol(argument, k))
    }

    fn written(&self, form: &Form) -> Math {
        let notation = &self.lecture.notation;
        math(own(&form.unicode(notation)), own(&form.latex(notation)))
    }

    fn steps(&mut self) {
        let lecture = self.lecture;
        let Ok(bodies) = &lecture.bodies else { return self.too_long("What comes next") };
        self.poses(bodies);
        self.jacobians(bodies);
        self.energies(bodies);
        let Ok(equations) = &lecture.equations else { return self.too_long("The sum of all bodies") };
        self.sums(equations);
        self.mass_matrix(bodies, equations);
        self.coriolis(equations);
        self.gravity(equations);
        self.lagrange(equations);
        self.state_space(equations);
        match &lecture.linear {
            Ok(linear) => self.linear(linear),
            Err(NoLinear::Swelling) => self.too_long("The linear model"),
            Err(NoLinear::Undefined) => self.text(
                "There is no linear model where all coordinates are zero: M is singular there, or a term of the energies has \
                 no derivative.",
            ),
        }
    }

    fn too_long(&mut self, what: &str) {
        let dof = self.model.tree.dof();
        let why = if dof > MOST_DOF {
            format!(
                "the robot has {dof} degrees of freedom, and {MOST_DOF} are the most that are written out"
            )
        } else {
            "an entry has more than 60 terms, or takes more than 200,000 products of terms to find".to_owned()
        };
        self.text(&format!(
            "{what} would be too long to be read: {why}. Numbers are there all the same, by `dynamics eval`, and the \
             code, by `dynamics generate`."
        ));
    }

    fn poses(&mut self, bodies: &[Body]) {
        self.heading(2, "Where the bodies are");
        self.text(
            "Each body has a frame at its centre of mass, in the axes that it was described in. $R_i|R_i$ takes its axes to \
             those of the world, and $p_i|p_i$ is where its centre of mass is. What is welded to a body is a part of it.",
        );
        if bodies.iter().any(|body| body.first.is_some()) {
            self.text(
                "A body of no mass has no such centre, and that of several bodies welded together is a quotient by the sum of \
                 their masses, which makes long equations: these have their frames where they were described, at $p_i|p_i$, \
                 and a first moment $h_i|h_i$, the mass times the way from there to its centre.",
            );
        }
        for (i, body) in bodies.iter().enumerate() {
            let mut named = words(&format!("Body {}, `{}`, of the mass ", i + 1, body.name));
            named.push(Piece::Form(body.mass.clone()));
            named.extend(words(":"));
            self.blocks.push(Block::Text(named));
            self.equation([of(i, "R", "R"), Side::Matrix(body.rotation.clone())]);
            self.equation([of(i, "p", "p"), Side::Matrix(body.center.clone())]);
        }
    }

    fn jacobians(&mut self, bodies: &[Body]) {
        self.heading(3, "How they move");
        let [v, latex] = if self.is_flat() { ["q̇", "\\dot q"] } else { ["v", "v"] };
        self.text(&format!(
            "The column j of the body Jacobian $J_iᵇ|J_i^b$ is the twist of body i, linear velocity first, in its own frame \
             and axes, while joint j moves at one unit of speed and no other moves. Joints that do not carry the body leave \
             zeros. All together give the twist $V_iᵇ = J_iᵇ·{v}|V_i^b = J_i^b {latex}$:",
        ));
        for (i, body) in bodies.iter().enumerate() {
            let jacobian = Side::Math(indexed("J", "J", &[i], Some(("ᵇ", "b"))));
            let twist = Side::Math(indexed("V", "V", &[i], Some(("ᵇ", "b"))));
            self.equation([jacobian, Side::Matrix(body.jacobian.clone())]);
            self.equation([twist, Side::Matrix(body.twist.clone())]);
        }
    }

    fn energies(&mut self, bodies: &[Body]) {
        self.heading(4, "Energies");
        self.text(
            "A body of mass $m$ and inertia tensor $𝓘|\\mathcal I$ about its centre of mass has the generalised inertia \
             $ℳ = diag(m, m, m, 𝓘)|\\mathcal M = \\operatorname{diag}(m, m, m, \\mathcal I)$. Its kinetic energy is \
             $T_i = ½ V_iᵇᵀ·ℳ_i·V_iᵇ|T_i = \\tfrac12 {V_i^b}^T \\mathcal M_i V_i^b$, and its potential energy is \
             $V_i = −m_i g⃗·p_i|V_i = -m_i\\, \\vec g \\cdot p_i$, zero at the world's origin.",
        );
        if bodies.iter().any(|body| body.first.is_some()) {
            self.text(
                "About another point than the centre of mass the generalised inertia has the first moment as well: with \
                 $Vᵇ = (v, ω)|V^b = (v, \\omega)$ it is $T = ½ m v·v + v·(ω × h) + ½ ω·𝓘·ω|T = \\tfrac12 m\\, v \\cdot v + \
                 v \\cdot (\\omega \\times h) + \\tfrac12\\, \\omega \\cdot \\mathcal I \\omega$, and \
                 $V = −g⃗·(m p + R·h)|V = -\\vec g \\cdot (m p + R h)$.",
            );
        }
        for (i, body) in bodies.iter().enumerate() {
            if let Some(first) = &body.first {
                self.equation([of(i, "h", "h"), Side::Matrix(first.clone())]);
            }
            self.equation([of(i, "𝓘", "\\mathcal I"), Side::Matrix(body.inertia.clone())]);
            self.equation([of(i, "T", "T"), Side::Form(body.kinetic_energy.clone())]);
            self.equation([of(i, "V", "V"), Side::Form(body.potential_energy.clone())]);
        }
    }

    fn sums(&mut self, equations: &Equations) {
        let mut sum = "The sums over all bodies".to_owned();
        if equations.rotors.is_some() {
            sum += ", and over the rotors, which turn with no body";
        }
        if equations.terms.is_some() {
            sum += ", with the terms below";
        }
        self.text(&format!("{sum}, and the Lagrangian $L = T − V|L = T - V$:"));
        if !equations.potential_at_rest.is_zero() {
            let at_rest = Side::Form(equations.potential_at_rest.clone());
            self.text("What stands still in the world has a part in $V|V$:");
            self.equation([Side::Math(math("V₀", "V_0")), at_rest]);
        }
        if let Some(terms) = &equations.terms {
            self.text("Terms of the energies that belong to no body:");
            for (name, latex, form) in [
                ("T_terms", "T_{\\text{terms}}", &terms.kinetic_energy),
                ("V_terms", "V_{\\text{terms}}", &terms.potential_energy),
            ] {
                if !form.is_zero() {
                    self.equation([Side::Math(math(name, latex)), Side::Form(form.clone())]);
                }
            }
        }
        for (letter, form) in [
            ("T", &equations.kinetic_energy),
            ("V", &equations.potential_energy),
            ("L", &equations.lagrangian),
        ] {
            self.equation([Side::Math(math(letter, letter)), Side::Form(form.clone())]);
        }
    }

    fn mass_matrix(&mut self, bodies: &[Body], equations: &Equations) {
        self.heading(5, "The mass matrix");
        let speeds = if self.is_flat() { ["q̇", "\\dot q"] } else { ["v", "v"] };
        let [v, v_latex] = speeds;
        self.text(&format!(
            "With $V_iᵇ = J_iᵇ·{v}|V_i^b = J_i^b {v_latex}$ the kinetic energy is \
             $T = ½ {v}ᵀ·M·{v}|T = \\tfrac12 {v_latex}^T M {v_latex}$ with \
             $M = Σ J_iᵇᵀ·ℳ_i·J_iᵇ|M = \\sum_i {{J_i^b}}^T \\mathcal M_i J_i^b$. The bodies add:",
        ));
        for (i, body) in bodies.iter().enumerate() {
            let k = lowered(i + 1);
            let share = math(
                format!("J{k}ᵇᵀ·ℳ{k}·J{k}ᵇ"),
                format!("{{J_{{{0}}}^b}}^T \\mathcal M_{{{0}}} J_{{{0}}}^b", i + 1),
            );
            self.equation([Side::Math(share), Side::Matrix(body.share.clone())]);
        }
        if let Some(rotors) = &equations.rotors {
            self.text("The rotors add, as the joints feel them:");
            self.equation([Side::Math(math("M_rotors", "M_{\\text{rotors}}")), Side::Matrix(rotors.clone())]);
        }
        if let Some(terms) = equations.terms.as_ref().filter(|terms| !terms.kinetic_energy.is_zero()) {
            self.text("The terms of the kinetic energy add:");
            let name = math("∂²T_terms/∂q̇²", "\\partial^2 T_{\\text{terms}}/\\partial \\dot q^2");
            self.equation([Side::Math(name), Side::Matrix(terms.mass_matrix.clone())]);
        }
        self.text("In all:");
        self.equation([Side::Math(math("M", "M")), Side::Matrix(equations.mass_matrix.clone())]);
    }

    fn coriolis(&mut self, equations: &Equations) {
        self.heading(6, "Coriolis and centrifugal forces");
        let matrix = Side::Matrix(equations.coriolis_matrix.clone());
        let Some(symbols) = &equations.christoffel else {
            self.text(
                "Angular velocities are no rates of coordinates: turning about x and then about y is not turning about y and \
                 then about x. By how much is what the brackets $[e_i, e_j]$ of unit speeds say, and these enter beside the \
                 derivatives of $M|M$: $C_ij = ⟨∇_v e_j, e_i⟩|C_{ij} = \\langle \\nabla_v e_j, e_i \\rangle$ by Koszul's formula, \
                 again with $Ṁ = C + Cᵀ|\\dot M = C + C^T$:",
            );
            self.equation([Side::Math(math("C", "C")), matrix]);
            return;
        };
        self.text(
            "How $M|M$ changes is in Christoffel's symbols \
             $Γ_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i)|\\Gamma_{ijk} = \\tfrac12 \\left( \
             \\frac{\\partial M_{ij}}{\\partial q_k} + \\frac{\\partial M_{ik}}{\\partial q_j} - \
             \\frac{\\partial M_{jk}}{\\partial q_i} \\right)$, which are alike in their last two indices.",
        );
        if symbols.is_empty() {
            self.text("Here $M|M$ is constant, and all of them are zero; so is $C|C$.");
        } else {
            self.text("Those that are not zero, each with the derivatives that it comes from:");
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
        self.equation([Side::Math(math("C", "C")), matrix]);
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

    fn gravity(&mut self, equations: &Equations) {
        self.heading(7, "Gravity");
        match self.is_flat() {
            true => self.text("The forces of gravity, on the left-hand side, are $G = ∂V/∂q|G = \\partial V / \\partial q$:"),
            false => self.text("The forces of gravity, on the left-hand side, are $G|G$, the rates of $V|V$ along unit speeds:"),
        }
        self.equation([Side::Math(math("G", "G")), Side::Matrix(equations.gravity_forces.clone())]);
    }

    fn lagrange(&mut self, equations: &Equations) {
        self.heading(8, "The equations of motion");
        let [a, v] = if self.is_flat() { ["q̈|\\ddot q", "q̇|\\dot q"] } else { ["v̇|\\dot v", "v|v"] };
        let both = |text: &str| -> [String; 2] {
            let (unicode, latex) = text.split_once('|').unwrap_or((text, text));
            [unicode.to_owned(), latex.to_owned()]
        };
        let ([a, a_latex], [v, v_latex]) = (both(a), both(v));
        let matrices = format!("$M·{a} + C·{v} + G|M {a_latex} + C {v_latex} + G$");
        match &equations.rows {
            None => {
                self.text(
                    "Lagrange's equations $d/dt ∂L/∂q̇ − ∂L/∂q = Υ|\\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot q} - \
                     \\frac{\\partial L}{\\partial q} = \\Upsilon$ are of rates of coordinates. Along speeds that are none they \
                     have the brackets as well, as G. Hamel wrote them in 1904; in matrices nothing changes.",
                );
                self.text(&format!("The joint forces are $Υ|\\Upsilon$ = {matrices}:"));
            }
            Some(rows) => {
                self.text(
                    "Lagrange's equations are $d/dt ∂L/∂q̇ − ∂L/∂q = Υ|\\frac{d}{dt} \\frac{\\partial L}{\\partial \\dot q} - \
                     \\frac{\\partial L}{\\partial q} = \\Upsilon$, with the forces $Υ|\\Upsilon$ of the joints. Row by row:",
                );
                for (i, row) in rows.iter().enumerate() {
                    let mut of_row = words("Of ");
                    of_row.push(Piece::Form(self.symbol(Argument::Q, i)));
                    of_row.extend(words(":"));
                    self.blocks.push(Block::Text(of_row));
                    let q = self.written(&self.symbol(Argument::Q, i));
                    let v = self.written(&self.symbol(Argument::V, i));
                    let by = |top: &str, x: &Math| {
                        math(
                            format!("{top}∂L/∂{}", x.unicode),
                            format!(
                                "{}\\frac{{\\partial L}}{{\\partial {}}}",
                                if top.is_empty() { "" } else { "\\frac{d}{dt} " },
                                x.latex
                            ),
                        )
                    };
                    self.equation([Side::Math(by("", &v)), Side::Form(row.momentum.clone())]);
                    self.equation([Side::Math(by("d/dt ", &v)), Side::Form(row.rate.clone())]);
                    self.equation([Side::Math(by("", &q)), Side::Form(row.by_coordinate.clone())]);
                    self.equation([of(i, "Υ", "\\Upsilon"), Side::Form(row.force.clone())]);
                }
                self.text(&format!("The same in matrices is $Υ|\\Upsilon$ = {matrices}."));
            }
        }
        if let Some(passive) = &equations.passive {
            self.text("Dampers, friction and springs act as well, on the left-hand side by");
            self.equation([Side::Math(math("P", "P")), Side::Matrix(passive.clone())]);
            self.text(&format!("so that the motors give $Υ|\\Upsilon$ = {matrices} + $P|P$:"));
        }
        if equations.rows.is_none() || equations.passive.is_some() {
            let forces: Vec<Form> = equations.forces.entries().map(|(_, _, form)| form.clone()).collect();
            for (i, force) in forces.into_iter().enumerate() {
                self.equation([of(i, "Υ", "\\Upsilon"), Side::Form(force)]);
            }
        }
    }

    fn state_space(&mut self, equations: &Equations) {
        self.heading(9, "The state space");
        let (dof, driven) = (self.model.tree.dof(), self.model.actuated.len());
        let is_flat = self.is_flat();
        let state = if is_flat { "$x = (q, q̇)|x = (q, \\dot q)$" } else { "$x = (q, v)|x = (q, v)$" };
        let motors = match driven {
            _ if driven == dof => "the vector $u|u$ of the motors' forces drives it",
            0 => "no motor drives it",
            _ => {
                "the vector $u|u$ of the motors' forces drives it, which the matrix $B|B$ of ones and zeros gives to their joints"
            }
        };
        self.text(&format!(
            "The state is {state}, and {motors}. Where $M|M$ is positive definite, the equations can be solved for the \
             accelerations, and $ẋ = f(x, u)|\\dot x = f(x, u)$ is"
        ));
        let (p, input) = (equations.passive.is_some(), driven);
        let input = match input {
            0 => ["", ""],
            _ if driven == dof => ["u ", "u "],
            _ => ["B·u ", "B u "],
        };
        let [v, v_latex] = if is_flat { ["q̇", "\\dot q"] } else { ["v", "v"] };
        let rate = |unicode: &str, latex: &str| {
            Side::Math(math(format!("d/dt {unicode}"), format!("\\tfrac{{d}}{{dt}} {latex}")))
        };
        match is_flat {
            true => self.equation([rate("q", "q"), Side::Math(math(v, v_latex))]),
            false => self.equation([rate("q", "q"), Side::Math(math("E(q)·v", "E(q)\\, v"))]),
        }
        self.equation([
            rate(v, v_latex),
            Side::Math(math(
                format!("M⁻¹·({}− C·{v} − G{})", input[0], if p { " − P" } else { "" }),
                format!(
                    "M^{{-1}} \\left( {}- C {v_latex} - G{} \\right)",
                    input[1],
                    if p { " - P" } else { "" }
                ),
            )),
        ]);
        if !is_flat {
            self.text(
                "where $E(q)|E(q)$ turns linear velocities into the world's axes, and makes of angular velocities the rates of \
                 quaternions, half of the product of both.",
            );
        }
    }

    fn linear(&mut self, linear: &Linear) {
        self.heading(10, "Linear, about the zero configuration at rest");
        let is_held = linear.hold.entries().any(|(_, _, form)| !form.is_zero());
        if is_held {
            self.text("The robot does not stay there by itself. The forces that hold it:");
            self.equation([Side::Math(math("Υ₀", "\\Upsilon_0")), Side::Matrix(linear.hold.clone())]);
            if self.model.actuated.len() < self.model.tree.dof() {
                self.text("Where there is no motor for one of them that is not zero, nothing holds it there, and the linear model is of no equilibrium.");
            }
        } else {
            self.text("The robot stays there, with no force of its motors.");
        }
        let is_driven = linear.inputs.columns() > 0;
        let [forces, forces_latex] = if is_driven { ["B·δu", "B\\, \\delta u"] } else { ["0", "0"] };
        self.text(&format!(
            "Small motions $δq|\\delta q$ about it, by small forces $δu|\\delta u$ more, obey \
             $M₀·δq̈ + D₀·δq̇ + K₀·δq = {forces}|M_0\\, \\delta \\ddot q + D_0\\, \\delta \\dot q + K_0\\, \\delta q = {forces_latex}$ \
             with",
        ));
        let is_damped = linear.damping.entries().any(|(_, _, form)| !form.is_zero());
        self.equation([Side::Math(math("M₀", "M_0")), Side::Matrix(linear.mass_matrix.clone())]);
        if is_damped {
            self.equation([Side::Math(math("D₀", "D_0")), Side::Matrix(linear.damping.clone())]);
        }
        self.equation([Side::Math(math("K₀", "K_0")), Side::Matrix(linear.stiffness.clone())]);
        if is_driven {
            self.equation([Side::Math(math("B", "B")), Side::Matrix(linear.inputs.clone())]);
        }
        if !is_damped {
            self.text("and $D₀ = 0|D_0 = 0$, for nothing is damped.");
        }
        let driven = if is_driven { ["+ M₀⁻¹·B·δu", "+ M_0^{-1} B\\, \\delta u"] } else { ["", ""] };
        let damped = if is_damped {
            ["− M₀⁻¹·D₀·δq̇ ", "- M_0^{-1} D_0\\, \\delta \\dot q "]
        } else {
            ["", ""]
        };
        self.text(
            "As a state space, of the state $δx = (δq, δq̇)|\\delta x = (\\delta q, \\delta \\dot q)$, it is",
        );
        self.equation([
            Side::Math(math("d/dt δq", "\\tfrac{d}{dt} \\delta q")),
            Side::Math(math("δq̇", "\\delta \\dot q")),
        ]);
        self.equation([
            Side::Math(math("d/dt δq̇", "\\tfrac{d}{dt} \\delta \\dot q")),
            Side::Math(math(
                format!("−M₀⁻¹·K₀·δq {}{}", damped[0], driven[0]).trim_end(),
                format!("-M_0^{{-1}} K_0\\, \\delta q {}{}", damped[1], driven[1]).trim_end(),
            )),
        ]);
        if let Some(lower) = &linear.lower {
            self.text(
                "$M₀|M_0$ is diagonal, and the lower half of the state matrix A is easily written out:",
            );
            self.equation([
                Side::Math(math("(−M₀⁻¹·K₀, −M₀⁻¹·D₀)", "\\left( -M_0^{-1} K_0,\\ -M_0^{-1} D_0 \\right)")),
                Side::Matrix(lower.clone()),
            ]);
        }
    }
}

/// A letter of a body.
fn of(i: usize, unicode: &str, latex: &str) -> Side {
    Side::Math(indexed(unicode, latex, &[i], None))
}
