//! The bodies, from where they are to their energies.

use dynamics_codegen::mechanics::lecture::{Body, Equations};

use super::super::document::{Block, Piece, Side, indexed, words};
use super::{Text, letter, listed, of};

impl Text<'_, '_> {
    pub(super) fn poses(&mut self, bodies: &[Body]) {
        self.heading("Where the bodies are");
        let is_central = |body: &&Body| body.first.is_none();
        let is_one = bodies.len() == 1;
        let axes = "$R_i|R_i$ takes its axes to those of the world";
        match (bodies.iter().all(|body| is_central(&body)), bodies.iter().any(|body| is_central(&body))) {
            (true, _) => self.text(&format!(
                "{} a frame at its centre of mass, in the axes that it was described in. {axes}, and $p_i|p_i$ is where its \
                 centre of mass is.",
                if is_one { "The body has" } else { "Each body has" }
            )),
            (false, true) => self.text(&format!(
                "Each body has a frame in the axes that it was described in, at $p_i|p_i$: its centre of mass, but for those \
                 that are named below. {axes}."
            )),
            (false, false) => self.text(&format!(
                "{} a frame where it was described, at $p_i|p_i$, in the axes that it was described in. {axes}.",
                if is_one { "The body has" } else { "Each body has" }
            )),
        }
        self.without_center(bodies);
        for (i, body) in bodies.iter().enumerate() {
            let mut named = words(&format!("Body {}, `{}`", i + 1, body.name));
            if !body.welded.is_empty() {
                let welded: Vec<String> = body.welded.iter().map(|name| format!("`{name}`")).collect();
                named.extend(words(&format!(" with {} welded to it", listed(&welded))));
            }
            named.extend(words(", of the mass "));
            named.push(Piece::Form(body.mass.clone()));
            named.extend(words(":"));
            self.blocks.push(Block::Text(named));
            self.equation([of(i, "R", "R"), Side::Matrix(body.rotation.clone())]);
            self.equation([of(i, "p", "p"), Side::Matrix(body.center.clone())]);
        }
    }

    /// Why some frames are not at centres of mass.
    fn without_center(&mut self, bodies: &[Body]) {
        let named = |of: &dyn Fn(&Body) -> bool| -> Vec<String> {
            bodies
                .iter()
                .filter(|body| body.first.is_some() && of(body))
                .map(|body| format!("`{}`", body.name))
                .collect()
        };
        let massless = named(&|body| body.mass.is_zero());
        let composed = named(&|body| !body.mass.is_zero());
        let have = |names: &[String]| if names.len() == 1 { "has" } else { "have" };
        if !massless.is_empty() {
            self.text(&format!("{} {} no mass, and so no centre of it.", listed(&massless), have(&massless)));
        }
        if !composed.is_empty() {
            self.text(&format!(
                "The centre of mass of {} is a quotient by a sum of masses, which would make long equations: instead of it \
                 there is the first moment $h_i|h_i$, the mass times the way from the frame's origin to the centre.",
                listed(&composed)
            ));
        }
    }

    pub(super) fn jacobians(&mut self, bodies: &[Body]) {
        let is_one = bodies.len() == 1;
        self.heading(if is_one { "How it moves" } else { "How they move" });
        let v = self.speeds();
        let zeros = match is_one || self.model.tree.dof() == 1 {
            true => "",
            false => " Speeds that do not move the body leave zeros.",
        };
        self.text(&format!(
            "The column j of the body Jacobian $J_iᵇ|J_i^b$ is the twist of body i, linear velocity first, in its own frame \
             and axes, while the speed {} is one and every other is zero.{zeros} At all speeds the twist is \
             $V_iᵇ = J_iᵇ·{}|V_i^b = J_i^b {}$:",
            if self.is_flat() { "$q̇_j|\\dot q_j$" } else { "$v_j|v_j$" },
            v.unicode,
            v.latex,
        ));
        for (i, body) in bodies.iter().enumerate() {
            let jacobian = Side::Math(indexed("J", "J", &[i], Some(("ᵇ", "b"))));
            let twist = Side::Math(indexed("V", "V", &[i], Some(("ᵇ", "b"))));
            self.equation([jacobian, Side::Matrix(body.jacobian.clone())]);
            self.equation([twist, Side::Matrix(body.twist.clone())]);
        }
    }

    /// The energies of bodies.
    pub(super) fn energies(&mut self, bodies: &[Body]) {
        self.heading("Energies");
        let has_gravity = self.has_gravity();
        if bodies.iter().any(|body| body.first.is_none()) {
            let potential = match has_gravity {
                true => {
                    ", and its potential energy is $V_i = −m_i g⃗·p_i|V_i = -m_i\\, \\vec g \\cdot p_i$, zero at the world's \
                     origin."
                }
                false => ".",
            };
            self.text(&format!(
                "A body of mass $m$ and inertia tensor $𝓘|\\mathcal I$ about its centre of mass has the generalised inertia \
                 $ℳ = diag(m, m, m, 𝓘)|\\mathcal M = \\operatorname{{diag}}(m, m, m, \\mathcal I)$. Its kinetic energy is \
                 $T_i = ½ V_iᵇᵀ·ℳ_i·V_iᵇ|T_i = \\tfrac12 {{V_i^b}}^T \\mathcal M_i V_i^b${potential}",
            ));
        }
        if bodies.iter().any(|body| body.first.is_some()) {
            let potential = match has_gravity {
                true => {
                    ", and $V = −g⃗·(m p + R·h)|V = -\\vec g \\cdot (m p + R h)$, zero at the world's origin."
                }
                false => ".",
            };
            self.text(&format!(
                "About another point than the centre of mass, with the inertia tensor $𝓘|\\mathcal I$ about that point and \
                 the first moment $h$, the kinetic energy at $Vᵇ = (v, ω)|V^b = (v, \\omega)$ is \
                 $T = ½ Vᵇᵀ·ℳ·Vᵇ = ½ m v·v + v·(ω × h) + ½ ω·𝓘·ω|T = \\tfrac12 {{V^b}}^T \\mathcal M V^b = \
                 \\tfrac12 m\\, v \\cdot v + v \\cdot (\\omega \\times h) + \
                 \\tfrac12\\, \\omega \\cdot \\mathcal I \\omega${potential}",
            ));
        }
        for (i, body) in bodies.iter().enumerate() {
            if let Some(first) = &body.first {
                self.equation([of(i, "h", "h"), Side::Matrix(first.clone())]);
            }
            self.equation([of(i, "𝓘", "\\mathcal I"), Side::Matrix(body.inertia.clone())]);
            self.equation([of(i, "T", "T"), Side::Form(body.kinetic_energy.clone())]);
            if has_gravity {
                self.equation([of(i, "V", "V"), Side::Form(body.potential_energy.clone())]);
            }
        }
    }

    /// What else has energy, and the sums.
    pub(super) fn sums(&mut self, bodies: &[Body], equations: &Equations) {
        let has_rest = !equations.potential_at_rest.is_zero();
        if has_rest {
            self.text("What stands still in the world has a part in $V|V$:");
            self.equation([letter("V₀", "V_0"), Side::Form(equations.potential_at_rest.clone())]);
        }
        if let Some(rotors) = &equations.rotors {
            self.text("Rotors, which turn with no body, have the energy");
            self.equation([
                letter("T_rotors", "T_{\\text{rotors}}"),
                Side::Form(rotors.kinetic_energy.clone()),
            ]);
        }
        if let Some(terms) = &equations.terms {
            if !bodies.is_empty() {
                self.text("Terms that are given beside the bodies:");
            }
            for (name, latex, form) in [
                ("T_terms", "T_{\\text{terms}}", &terms.kinetic_energy),
                ("V_terms", "V_{\\text{terms}}", &terms.potential_energy),
            ] {
                if !form.is_zero() && !bodies.is_empty() {
                    self.equation([letter(name, latex), Side::Form(form.clone())]);
                }
            }
        }
        let is_more = has_rest || equations.rotors.is_some() || equations.terms.is_some();
        let lagrangian = "the Lagrangian $L = T − V|L = T - V$";
        match (bodies.len(), is_more) {
            (0, _) => self.text(&format!("The energies, as they are given, and {lagrangian}:")),
            (1, false) => {
                let potential = if self.has_gravity() { "$V = V₁|V = V_1$" } else { "$V = 0|V = 0$" };
                self.text(&format!(
                    "There is no other energy: $T = T₁|T = T_1$, {potential}, and {lagrangian}:"
                ));
            }
            (_, false) => self.text(&format!("The sums over all bodies, and {lagrangian}:")),
            (_, true) => self.text(&format!("The sums of all of these, and {lagrangian}:")),
        }
        for (name, form) in [
            ("T", &equations.kinetic_energy),
            ("V", &equations.potential_energy),
            ("L", &equations.lagrangian),
        ] {
            if name == "L" || is_more || bodies.len() != 1 {
                self.equation([letter(name, name), Side::Form(form.clone())]);
            }
        }
        let has_springs = self.model.tree.links.iter().any(|link| !link.passive.stiffness.is_zero());
        if has_springs {
            self.text(
                "The springs in the joints are not in $V|V$: their energy $½ k (q − q₀)²|\\tfrac12 k (q - q_0)^2$ is counted \
                 apart, as the elastic energy, and their forces are in $P|P$, where the equations of motion are. A spring \
                 written as a term of the energies, `#[potential(k / 2 * (theta - rest)^2)]`, is in $V|V$.",
            );
        }
    }
}
