//! The derivation where closed forms swell: part by part, in matrices that have names.

use dynamics_codegen::mechanics::lecture::{
    Excess, Inertia, MOST_PRODUCTS, MOST_TERMS, MOST_TERMS_IN_ALL, Part, Recursion, TooLong,
};

use dynamics_codegen::closed::{Form, Matrix, Swelling};
use dynamics_codegen::mechanics::equations::Argument;

use super::super::document::{Block, Math, Piece, Side, indexed, math, words};
use super::{Sides, Text, letter, listed, of};

impl Text<'_, '_> {
    /// Why there is no closed form, and what there is instead.
    pub(super) fn no_closed_form(&mut self, long: &TooLong) {
        let why = match long.excess {
            Excess::Terms(count) => format!(
                "{} would have {count} terms, and {MOST_TERMS} are the most that are written out",
                self.entry(long)
            ),
            Excess::All => {
                format!("with {} it would come to more than {MOST_TERMS_IN_ALL} terms", self.entry(long))
            }
            Excess::Products => format!(
                "to multiply out {} takes more than {MOST_PRODUCTS} products of terms",
                self.entry(long)
            ),
            Excess::Symbols => {
                "it has more symbols, sines and cosines than an expression can have here".to_owned()
            }
        };
        self.text(&format!(
            "In closed form nobody could read the rest: {why}. What follows has names instead: each part of the robot is \
             written beside the one that carries it, and the equations are made of these by matrices. Numbers are there all the \
             same, by `dynamics eval`, and the code, by `dynamics generate`."
        ));
    }

    /// What is too long.
    fn entry(&self, long: &TooLong) -> String {
        let (unicode, latex) = match long.letter {
            "Υ" => ("Υ", "\\Upsilon"),
            "Γ" => ("Γ", "\\Gamma"),
            "𝓘" => ("𝓘", "\\mathcal I"),
            "JᵀℳJ" => ("(JᵀℳJ)", "(J^T \\mathcal M J)"),
            letter => (letter, letter),
        };
        let name = match long.indices.is_empty() {
            true => math(unicode, latex),
            false => indexed(unicode, latex, &long.indices, None),
        };
        format!("${}|{}$", name.unicode, name.latex)
    }

    pub(super) fn by_recursion(&mut self, recursion: &Recursion) {
        self.parts(&recursion.parts);
        self.twists(&recursion.parts);
        self.energies_by_name(recursion);
        self.forces_by_name(recursion);
        let passive = recursion.passive.as_ref();
        self.heading("The equations of motion");
        let (a, v) = (self.accelerations(), self.speeds());
        let sides = format!(
            "$Υ = M·{} + C·{} + G|\\Upsilon = M {} + C {} + G$",
            a.unicode, v.unicode, a.latex, v.latex
        );
        let whose = match (passive.is_some(), self.model.actuated.is_empty()) {
            (true, _) => "all forces that are not in $V|V$: those of the motors, and what acts by itself",
            (false, false) => "the forces of the motors",
            (false, true) => "the forces from outside; there are no motors",
        };
        self.text(&format!("Lagrange's equations in matrices are {sides}, with $Υ|\\Upsilon$ {whose}."));
        if let Some(passive) = passive {
            let acting = self.passive_parts();
            self.text(&format!("On the left-hand side {acting} by"));
            self.equation([letter("P", "P"), Side::Matrix(passive.clone())]);
            self.text("so that the motors give $τ = Υ + P|\\tau = \\Upsilon + P$.");
        }
        self.state_space(&Sides {
            turns: true,
            pulls: true,
            acts: passive.is_some(),
            rates: recursion.rates.as_ref(),
        });
    }

    fn parts(&mut self, parts: &[Part]) {
        self.heading("Where the parts are");
        self.text(
            "Each part that moves has a frame in the axes that its body was described in, at its centre of mass if it has a \
             mass of one term, else where the body was described; between the motions of one joint it has the joint's. Seen \
             from part a, which carries it, part i is at $p_i′|p_i'$, and $R_i′|R_i'$ takes its axes to those of part a. In the \
             world these are $R_i = R_a·R_i′|R_i = R_a R_i'$ and $p_i = p_a + R_a·p_i′|p_i = p_a + R_a\\, p_i'$, from \
             $R = 1|R = 1$ and $p = 0|p = 0$ of the world itself on.",
        );
        for (i, part) in parts.iter().enumerate() {
            let mut named = words(&format!("Part {}, `{}`", i + 1, part.name));
            if !part.welded.is_empty() {
                let welded: Vec<String> = part.welded.iter().map(|name| format!("`{name}`")).collect();
                named.extend(words(&format!(" with {} welded to it", listed(&welded))));
            }
            let carrier =
                part.carrier.map_or("the world".to_owned(), |carrier| format!("part {}", carrier + 1));
            named.extend(words(&format!(", on {carrier}")));
            if let Some(inertia) = &part.inertia {
                named.extend(words(", of the mass "));
                named.push(Piece::Form(inertia.mass.clone()));
            }
            named.extend(words(":"));
            self.blocks.push(Block::Text(named));
            self.equation([primed(i, "R"), Side::Matrix(part.rotation.clone())]);
            self.equation([primed(i, "p"), Side::Matrix(part.translation.clone())]);
        }
    }

    fn twists(&mut self, parts: &[Part]) {
        self.heading("How they move");
        let (own, v) = (self.own_speeds(), self.speeds());
        self.text(&format!(
            "The twist $V_i = (v_i, ω_i)|V_i = (v_i, \\omega_i)$ of part i, at the origin of its frame and in its axes, is what \
             its carrier gives it and what its own joint adds, {own} being the speeds of that, and $p̂|\\hat p$ the matrix with \
             $p̂·u = p × u|\\hat p u = p \\times u$:"
        ));
        let own = self.own_speed();
        self.equation([
            of_part("V"),
            letter(&format!("X_i·V_a + S_i·{}", own.unicode), &format!("X_i V_a + S_i {}", own.latex)),
        ]);
        self.equation([
            of_part("X"),
            letter(
                "⎡R_i′ᵀ  −R_i′ᵀ·p̂_i′⎤\n⎣  0       R_i′ᵀ   ⎦",
                "\\begin{bmatrix} {R_i'}^T & -{R_i'}^T \\hat p_i' \\\\ 0 & {R_i'}^T \\end{bmatrix}",
            ),
        ]);
        self.motions(parts);
        self.text(&format!(
            "The Jacobian, with $V_i = J_i·{0}|V_i = J_i {1}$, is likewise $J_i = X_i·J_a + S_i·E_i|J_i = X_i J_a + S_i E_i$, \
             where $E_i|E_i$ takes from all speeds those of the joint. Its rate is",
            v.unicode, v.latex
        ));
        self.equation([
            letter("J̇_i", "\\dot J_i"),
            letter(
                &format!("X_i·J̇_a − ad(S_i·{})·X_i·J_a", own.unicode),
                &format!("X_i \\dot J_a - \\operatorname{{ad}}(S_i {}) X_i J_a", own.latex),
            ),
        ]);
        self.equation([
            letter("ad(v, ω)", "\\operatorname{ad}(v, \\omega)"),
            letter(
                "⎡ω̂  v̂⎤\n⎣0  ω̂⎦",
                "\\begin{bmatrix} \\hat\\omega & \\hat v \\\\ 0 & \\hat\\omega \\end{bmatrix}",
            ),
        ]);
        self.text("Of the world $V|V$, $J|J$ and $J̇|\\dot J$ are zero.");
    }

    /// How each part moves against its carrier.
    fn motions(&mut self, parts: &[Part]) {
        let speed = |speed: usize| Piece::Form(self.symbol(Argument::V, speed));
        let item = |(i, part): (usize, &Part)| -> Option<Vec<Piece>> {
            let name = indexed("S", "S", &[i], None);
            let mut item =
                vec![Piece::Math(math(format!("{} =", name.unicode), format!("{} =", name.latex)))];
            item.extend(words(" "));
            item.push(Piece::Vector(part.motion.clone()));
            item.extend(words(", by "));
            item.push(speed(part.speeds.start));
            (part.speeds.len() == 1).then_some(item)
        };
        let items: Vec<Vec<Piece>> = parts.iter().enumerate().filter_map(item).collect();
        if !items.is_empty() {
            self.text("Each of these is a column, and is written as a row:");
            self.blocks.push(Block::List(items));
        }
        for (i, part) in parts.iter().enumerate().filter(|(_, part)| part.speeds.len() > 1) {
            let speeds = part.speeds.clone().map(|speed| self.symbol(Argument::V, speed));
            let mut named = words("By ");
            named.push(Piece::Vector(Matrix::vector(speeds.collect())));
            named.extend(words(":"));
            self.blocks.push(Block::Text(named));
            self.equation([of(i, "S", "S"), Side::Matrix(part.motion.clone())]);
        }
    }

    /// The speeds of one joint.
    fn own_speed(&self) -> Math {
        if self.is_flat() { math("q̇_(i)", "\\dot q_{(i)}") } else { math("v_(i)", "v_{(i)}") }
    }

    fn own_speeds(&self) -> String {
        let own = self.own_speed();
        format!("${}|{}$", own.unicode, own.latex)
    }

    fn energies_by_name(&mut self, recursion: &Recursion) {
        self.heading("Energies");
        let heavy =
            || recursion.parts.iter().enumerate().filter_map(|(i, part)| Some((i, part.inertia.as_ref()?)));
        self.text(
            "A part of mass $m$, of the inertia tensor $𝓘|\\mathcal I$ about the origin of its frame, and of the first moment $h$, \
             the mass times the way from there to its centre, has the generalised inertia",
        );
        self.equation([
            of_part_in("ℳ", "\\mathcal M"),
            letter(
                "⎡m_i·1  −ĥ_i⎤\n⎣ ĥ_i    𝓘_i⎦",
                "\\begin{bmatrix} m_i 1 & -\\hat h_i \\\\ \\hat h_i & \\mathcal I_i \\end{bmatrix}",
            ),
        ]);
        self.text("Where no $h_i|h_i$ is written it is zero.");
        for (i, Inertia { first, second, .. }) in heavy() {
            if let Some(first) = first {
                self.equation([of(i, "h", "h"), Side::Matrix(first.clone())]);
            }
            self.equation([of(i, "𝓘", "\\mathcal I"), Side::Matrix(second.clone())]);
        }
        let v = self.speeds();
        let (mut kinetic, mut kinetic_latex) =
            ("Σ ½ V_iᵀ·ℳ_i·V_i".to_owned(), "\\sum_i \\tfrac12 V_i^T \\mathcal M_i V_i".to_owned());
        let (mut potential, mut potential_latex) = match self.has_gravity() {
            true => (
                "−Σ g⃗·(m_i p_i + R_i·h_i)".to_owned(),
                "-\\sum_i \\vec g \\cdot (m_i p_i + R_i h_i)".to_owned(),
            ),
            false => ("0".to_owned(), "0".to_owned()),
        };
        if recursion.rotors.is_some() {
            kinetic += &format!(" + ½ {0}ᵀ·M_rotors·{0}", v.unicode);
            kinetic_latex += &format!(" + \\tfrac12 {0}^T M_{{\\text{{rotors}}}} {0}", v.latex);
        }
        let [of_kinetic, of_potential] = &recursion.terms;
        if is_there(of_kinetic) {
            self.term(["T_terms", "T_{\\text{terms}}"], of_kinetic);
            kinetic += " + T_terms";
            kinetic_latex += " + T_{\\text{terms}}";
        }
        if !recursion.potential_at_rest.is_zero() {
            self.text("What stands still in the world has a part in $V|V$:");
            self.equation([letter("V₀", "V_0"), Side::Form(recursion.potential_at_rest.clone())]);
            potential += " + V₀";
            potential_latex += " + V_0";
        }
        if is_there(of_potential) {
            self.term(["V_terms", "V_{\\text{terms}}"], of_potential);
            potential += " + V_terms";
            potential_latex += " + V_{\\text{terms}}";
        }
        self.text("In all, and with the Lagrangian $L = T − V|L = T - V$:");
        self.equation([letter("T", "T"), letter(&kinetic, &kinetic_latex)]);
        self.equation([letter("V", "V"), letter(&potential, &potential_latex)]);
    }

    /// A sum of terms that are given beside the bodies.
    fn term(&mut self, [unicode, latex]: [&str; 2], term: &Result<Form, Swelling>) {
        match term {
            Ok(form) => self.equation([letter(unicode, latex), Side::Form(form.clone())]),
            Err(Swelling) => self.text(&format!(
                "The terms ${unicode}|{latex}$ that are given beside the bodies are too long once places are written in coordinates."
            )),
        }
    }

    /// M, C and G.
    fn forces_by_name(&mut self, recursion: &Recursion) {
        let (has_gravity, v) = (self.has_gravity(), self.speeds());
        let [of_kinetic, of_potential] = &recursion.terms;
        let sum = |text: &str, latex: &str, more: &[(bool, &str, &str)]| {
            let there = more.iter().filter(|(is_there, ..)| *is_there);
            let (mut text, mut latex) = (text.to_owned(), latex.to_owned());
            for (_, more, more_latex) in there {
                text += &format!(" + {more}");
                latex += &format!(" + {more_latex}");
            }
            letter(&text, &latex)
        };
        let has_terms = is_there(of_kinetic);
        self.heading("The mass matrix");
        self.text(&format!("With $V_i = J_i·{0}|V_i = J_i {1}$ the kinetic energy is $T = ½ {0}ᵀ·M·{0}|T = \\tfrac12 {1}^T M {1}$ with", v.unicode, v.latex));
        self.equation([
            letter("M", "M"),
            sum(
                "Σ J_iᵀ·ℳ_i·J_i",
                "\\sum_i J_i^T \\mathcal M_i J_i",
                &[
                    (recursion.rotors.is_some(), "M_rotors", "M_{\\text{rotors}}"),
                    (has_terms, "M_terms", "M_{\\text{terms}}"),
                ],
            ),
        ]);
        if let Some(rotors) = &recursion.rotors {
            self.text("where rotors, which turn with no body, are on the diagonal of $M_rotors|M_{\\text{rotors}}$, as the joints feel them:");
            self.equation([
                letter("diag M_rotors", "\\operatorname{diag} M_{\\text{rotors}}"),
                Side::Matrix(rotors.clone()),
            ]);
        }
        if has_terms {
            self.text(&format!(
                "and $M_terms = ∂²T_terms/∂{}²|M_{{\\text{{terms}}}} = \\partial^2 T_{{\\text{{terms}}}} / \\partial {}^2$.",
                v.unicode, v.latex
            ));
        }
        self.heading("Coriolis and centrifugal forces");
        self.text("With the momentum $(f_i, n_i) = ℳ_i·V_i|(f_i, n_i) = \\mathcal M_i V_i$ of each part,");
        self.equation([
            letter("C", "C"),
            sum(
                "Σ J_iᵀ·(ℳ_i·J̇_i + ℬ_i·J_i)",
                "\\sum_i J_i^T \\left( \\mathcal M_i \\dot J_i + \\mathcal B_i J_i \\right)",
                &[(has_terms, "C_terms", "C_{\\text{terms}}")],
            ),
        ]);
        self.equation([
            of_part_in("ℬ", "\\mathcal B"),
            letter(
                "½ (ℳ_i·ad(V_i) − ad(V_i)ᵀ·ℳ_i − 𝒫_i)",
                "\\tfrac12 \\left( \\mathcal M_i \\operatorname{ad}(V_i) - \\operatorname{ad}(V_i)^T \\mathcal M_i - \
                 \\mathcal P_i \\right)",
            ),
        ]);
        self.equation([
            of_part_in("𝒫", "\\mathcal P"),
            letter(
                "⎡ 0   f̂_i⎤\n⎣f̂_i  n̂_i⎦",
                "\\begin{bmatrix} 0 & \\hat f_i \\\\ \\hat f_i & \\hat n_i \\end{bmatrix}",
            ),
        ]);
        let of_terms = match has_terms {
            true => {
                " $C_terms|C_{\\text{terms}}$ is that of Christoffel's symbols of $M_terms|M_{\\text{terms}}$."
            }
            false => "",
        };
        let same = match self.is_flat() {
            true => "It is the matrix of Christoffel's symbols of $M|M$",
            false => {
                "It is that of the connection without torsion, and where all speeds are rates of Christoffel's symbols of $M|M$"
            }
        };
        self.text(&format!(
            "$ℬ_i|\\mathcal B_i$ is skew, so that $Ṁ = C + Cᵀ|\\dot M = C + C^T$. {same} (S. Echeandia and P. Wensing, 2021).{of_terms}"
        ));
        let has_potential = is_there(of_potential);
        if !has_gravity && !has_potential {
            self.heading("Potential forces");
            return self.text("$V|V$ is the same in every configuration, and $G = 0|G = 0$.");
        }
        self.heading(match (has_gravity, has_potential) {
            (true, false) => "Gravity",
            (true, true) => "Gravity and other potentials",
            (false, _) => "Potential forces",
        });
        self.text("The forces of the potential energy, on the left-hand side, are how fast $V|V$ grows while one speed is one and every other is zero:");
        let weights = (
            "−Σ J_iᵀ·(m_i R_iᵀ·g⃗, h_i × R_iᵀ·g⃗)",
            "-\\sum_i J_i^T \\begin{bmatrix} m_i R_i^T \\vec g \\\\ h_i \\times R_i^T \\vec g \\end{bmatrix}",
        );
        let terms = match self.is_flat() {
            true => ("∂V_terms/∂q", "\\partial V_{\\text{terms}} / \\partial q"),
            false => ("G_terms", "G_{\\text{terms}}"),
        };
        let side = match has_gravity {
            true => sum(weights.0, weights.1, &[(has_potential, terms.0, terms.1)]),
            false => letter(terms.0, terms.1),
        };
        self.equation([letter("G", "G"), side]);
    }
}

/// Whether there are such terms.
fn is_there(term: &Result<Form, Swelling>) -> bool {
    term.as_ref().map_or(true, |form| !form.is_zero())
}

/// A letter of a part as its carrier sees it.
fn primed(i: usize, name: &str) -> Side {
    let below = indexed(name, name, &[i], None);
    letter(&format!("{}′", below.unicode), &format!("{}'", below.latex))
}

/// A letter of any part.
fn of_part(name: &str) -> Side {
    of_part_in(name, name)
}

fn of_part_in(unicode: &str, latex: &str) -> Side {
    letter(&format!("{unicode}_i"), &format!("{latex}_i"))
}
