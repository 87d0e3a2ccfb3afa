//! The steps of a derivation, made from each other in the normal form.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]
#![allow(clippy::needless_range_loop, reason = "indices are those of the formulas")]

use super::length::terms;
use super::moving::{Moving, moving};
use super::{
    Body, Christoffel, Equations, Excess, MOST_PRODUCTS, MOST_TERMS, MOST_TERMS_IN_ALL, Rotors, Row, Terms,
    TooLong,
};
use crate::closed::{Canonical, Form, Matrix, Notation, Polynomial, Swelling};
use crate::mechanics::equations::{Argument, Inputs};
use crate::mechanics::plain;
use crate::model::Model;
use crate::symbolic::{Expr, Graph, Number, SymbolId};

/// An expression of more terms is not brought into a readable shape at all: that takes its time.
const RAW: usize = 300;

/// Why a step cannot be written.
pub(super) enum Stop {
    /// It takes too many products of terms.
    Work,
    /// An entry is too long.
    Long(TooLong),
}

impl From<Swelling> for Stop {
    fn from(Swelling: Swelling) -> Self {
        Self::Work
    }
}

type Result<T, E = Stop> = std::result::Result<T, E>;

/// The steps on their way, in the normal form.
pub(super) struct Steps<'m, 'g> {
    model: &'m Model<'g>,
    notation: &'m Notation,
    canonical: Canonical<'g>,
    bodies: Vec<Moving<'g>>,
    q: Vec<SymbolId>,
    v: Vec<SymbolId>,
    a: Vec<SymbolId>,
    passive: Vec<Expr<'g>>,
    /// Of the coordinates, where speeds are none.
    rates: Vec<Expr<'g>>,
    at_rest: Expr<'g>,
    /// What terms of one's own add to T and V.
    terms: [Expr<'g>; 2],
    /// Where speeds are no rates of coordinates, C and G by the plain recursion.
    by_brackets: Option<(Vec<Vec<Expr<'g>>>, Vec<Expr<'g>>)>,
    /// Of all bodies.
    M: Vec<Vec<Polynomial>>,
    T: Polynomial,
    V: Polynomial,
    /// What is made at present.
    at: Place,
    /// How many terms are written already.
    length: usize,
}

/// Where in a derivation something stands.
#[derive(Clone, Copy)]
struct Place {
    letter: &'static str,
    /// The index of all of it, from zero.
    index: Option<usize>,
}

impl<'m, 'g> Steps<'m, 'g> {
    pub(super) fn new(
        model: &'m Model<'g>,
        graph: &'g Graph,
        notation: &'m Notation,
    ) -> Result<Self, Swelling> {
        let inputs = Inputs::of(model);
        let [q, v, a] =
            [Argument::Q, Argument::V, Argument::A].map(|argument| inputs.vector(graph, argument));
        let bodies = moving(model, graph, &q);
        let passive = plain::passive::forces(&model.tree, &q, &v);
        let rates = match model.tree.is_one_dof() {
            true => vec![],
            false => model.tree.configuration_rate(&q, &v),
        };
        let at_rest = -model.tree.gravity.dot(model.tree.base.first);
        let terms = [plain::kinetic_terms(&model.tree, &q, &v), plain::potential_terms(&model.tree, &q)];
        let n = inputs.dof;
        let mut exprs: Vec<Expr<'g>> = [&q[..], &v, &a, &passive, &rates, &[at_rest], &terms].concat();
        for body in &bodies {
            exprs.extend([body.mass, body.potential]);
            exprs.extend(body.pose.translation.0.into_iter().chain(body.pose.rotation.0.concat()));
            exprs.extend(body.inertia.concat().into_iter().chain(body.jacobian.concat()));
            exprs.extend(body.first.iter().flat_map(|first| first.0));
        }
        let by_brackets = (!model.tree.is_one_dof())
            .then(|| (plain::coriolis_matrix(&model.tree, &q, &v), plain::gravity_forces(&model.tree, &q)));
        if let Some((C, G)) = &by_brackets {
            exprs.extend(C.concat().iter().chain(G));
        }
        let canonical = Canonical::new(graph, notation, &exprs, MOST_PRODUCTS)?;
        let [q, v, a] = [Argument::Q, Argument::V, Argument::A]
            .map(|argument| (0..inputs.size(argument)).map(|k| inputs.symbol(argument, k)).collect());
        let (M, zero) = (vec![vec![Polynomial::zero(); n]; n], Polynomial::zero);
        Ok(Self {
            model,
            notation,
            canonical,
            bodies,
            q,
            v,
            a,
            passive,
            rates,
            at_rest,
            terms,
            by_brackets,
            M,
            T: zero(),
            V: zero(),
            at: Place { letter: "T", index: None },
            length: 0,
        })
    }

    /// What stopped, in words.
    pub(super) fn too_long(&self, stop: Stop) -> TooLong {
        match stop {
            Stop::Long(long) => long,
            Stop::Work => {
                let indices = self.at.index.into_iter().collect();
                TooLong { letter: self.at.letter, indices, excess: Excess::Products }
            }
        }
    }

    /// From here on something else is made.
    fn at(&mut self, letter: &'static str, index: Option<usize>) {
        self.at = Place { letter, index };
    }

    /// How the entries of what is made are written, each at its place in this.
    fn forms(
        &mut self,
        polynomials: &[Polynomial],
        place: impl Fn(usize) -> Vec<usize>,
    ) -> Result<Vec<Form>> {
        let mut forms = Vec::with_capacity(polynomials.len());
        for (k, polynomial) in polynomials.iter().enumerate() {
            let written = self.canonical.forms(self.notation, std::slice::from_ref(polynomial), RAW);
            let form = written.ok().and_then(|mut forms| forms.pop());
            let count = form.as_ref().map_or(polynomial.len(), terms);
            self.length += count;
            let excess = match form {
                Some(form) if count <= MOST_TERMS && self.length <= MOST_TERMS_IN_ALL => {
                    forms.push(form);
                    continue;
                }
                Some(_) if count <= MOST_TERMS => Excess::All,
                _ => Excess::Terms(count),
            };
            let Place { letter, index } = self.at;
            let indices = index.into_iter().chain(place(k)).collect();
            return Err(Stop::Long(TooLong { letter, indices, excess }));
        }
        Ok(forms)
    }

    fn form(&mut self, polynomial: &Polynomial) -> Result<Form> {
        Ok(self.forms(std::slice::from_ref(polynomial), |_| vec![])?.swap_remove(0))
    }

    fn vector(&mut self, polynomials: &[Polynomial]) -> Result<Matrix> {
        Ok(Matrix::vector(self.forms(polynomials, |k| vec![k])?))
    }

    fn matrix(&mut self, entries: &[Polynomial], columns: usize) -> Result<Matrix> {
        let forms = self.forms(entries, |k| vec![k / columns, k % columns])?;
        Ok(Matrix::of_rows(forms.chunks(columns).map(<[Form]>::to_vec).collect()))
    }

    fn symmetric(&mut self, rows: &[Vec<Polynomial>]) -> Result<Matrix> {
        let n = rows.len();
        let places: Vec<[usize; 2]> = (0..n).flat_map(|i| (i..n).map(move |j| [i, j])).collect();
        let upper: Vec<Polynomial> = places.iter().map(|&[i, j]| rows[i][j].clone()).collect();
        let mut forms = self.forms(&upper, |k| places[k].to_vec())?.into_iter();
        Ok(Matrix::symmetric((0..n).map(|i| forms.by_ref().take(n - i).collect()).collect()))
    }

    pub(super) fn bodies(&mut self) -> Result<Vec<Body>> {
        let moving = std::mem::take(&mut self.bodies);
        moving.iter().enumerate().map(|(i, body)| self.body(i, body)).collect()
    }

    fn body(&mut self, at: usize, body: &Moving<'g>) -> Result<Body> {
        let n = self.v.len();
        self.at("V", Some(at));
        let mass = self.canonical.polynomial(body.mass)?;
        let rotation = self.all(&body.pose.rotation.0.concat())?;
        let center = self.all(&body.pose.translation.0)?;
        let inertia = self.all(&body.inertia.concat())?;
        let first = match &body.first {
            Some(first) => self.all(&first.0)?,
            None => vec![Polynomial::zero(); 3],
        };
        let jacobian: Vec<Vec<Polynomial>> =
            body.jacobian.iter().map(|row| self.all(row)).collect::<Result<_>>()?;
        let speeds = self.symbols(&self.v.clone())?;
        let mut twist = Vec::with_capacity(6);
        for row in &jacobian {
            twist.push(self.canonical.dot(row, &speeds)?);
        }
        self.at("T", Some(at));
        let columns: Vec<Vec<Polynomial>> =
            (0..n).map(|j| jacobian.iter().map(|row| row[j].clone()).collect()).collect();
        let mut momenta = Vec::with_capacity(n);
        for column in &columns {
            momenta.push(self.momentum(&mass, &first, &inertia, column)?);
        }
        let mut share = vec![vec![Polynomial::zero(); n]; n];
        for i in 0..n {
            for j in i..n {
                share[i][j] = self.canonical.dot(&columns[i], &momenta[j])?;
                share[j][i] = share[i][j].clone();
                self.M[i][j] = self.M[i][j].plus(Number::ONE, &share[i][j]);
                self.M[j][i] = self.M[i][j].clone();
            }
        }
        let momentum = self.momentum(&mass, &first, &inertia, &twist)?;
        let kinetic = self.canonical.dot(&twist, &momentum)?.scaled(Number::ratio(1, 2));
        let potential = self.canonical.polynomial(body.potential)?;
        self.T = self.T.plus(Number::ONE, &kinetic);
        self.V = self.V.plus(Number::ONE, &potential);
        let written = |steps: &mut Self, letter| steps.at(letter, Some(at));
        written(self, "m");
        let mass = self.form(&mass)?;
        written(self, "𝓘");
        let inertia = self.matrix(&inertia, 3)?;
        written(self, "R");
        let rotation = self.matrix(&rotation, 3)?;
        written(self, "p");
        let center = self.vector(&center)?;
        written(self, "h");
        let first = match body.first {
            Some(_) => Some(self.vector(&first)?),
            None => None,
        };
        written(self, "J");
        let jacobian = self.matrix(&jacobian.concat(), n)?;
        written(self, "V");
        let twist = self.vector(&twist)?;
        written(self, "T");
        let (kinetic_energy, potential_energy) = (self.form(&kinetic)?, self.form(&potential)?);
        written(self, "JᵀℳJ");
        Ok(Body {
            name: body.name.clone(),
            welded: body.welded.clone(),
            mass,
            inertia,
            rotation,
            center,
            first,
            jacobian,
            twist,
            kinetic_energy,
            potential_energy,
            share: self.symmetric(&share)?,
        })
    }

    /// `ℳ·V` of a twist (v, ω): `(m v + ω × h, h × v + 𝓘 ω)`, where h is zero about the centre of mass.
    fn momentum(
        &mut self,
        mass: &Polynomial,
        first: &[Polynomial],
        inertia: &[Polynomial],
        twist: &[Polynomial],
    ) -> Result<Vec<Polynomial>> {
        let (v, w) = twist.split_at(3);
        let (turned, moved) = (self.cross(w, first)?, self.cross(first, v)?);
        let mut momentum = Vec::with_capacity(6);
        for (linear, turned) in v.iter().zip(&turned) {
            momentum.push(self.canonical.product(mass, linear)?.plus(Number::ONE, turned));
        }
        for (row, moved) in inertia.chunks(3).zip(&moved) {
            momentum.push(self.canonical.dot(row, w)?.plus(Number::ONE, moved));
        }
        Ok(momentum)
    }

    fn cross(&mut self, a: &[Polynomial], b: &[Polynomial]) -> Result<Vec<Polynomial>> {
        let mut cross = Vec::with_capacity(3);
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let product = self.canonical.product(&a[next], &b[last])?;
            cross.push(product.plus(-Number::ONE, &self.canonical.product(&a[last], &b[next])?));
        }
        Ok(cross)
    }

    pub(super) fn equations(&mut self) -> Result<Equations> {
        self.at("T", None);
        let rotors = self.rotors()?;
        let at_rest = self.canonical.polynomial(self.at_rest)?;
        self.V = self.V.plus(Number::ONE, &at_rest);
        let terms = self.terms()?;
        let (T, V) = (self.T.clone(), self.V.clone());
        let L = T.plus(-Number::ONE, &V);
        let rotors = match rotors {
            None => None,
            Some((energy, mass)) => {
                Some(Rotors { kinetic_energy: self.form(&energy)?, mass_matrix: self.symmetric(&mass)? })
            }
        };
        let terms = match terms {
            None => None,
            Some(Added { energies: [kinetic, potential], mass }) => Some(Terms {
                kinetic_energy: self.form(&kinetic)?,
                potential_energy: self.form(&potential)?,
                mass_matrix: self.symmetric(&mass)?,
            }),
        };
        let kinetic_energy = self.form(&T)?;
        self.at("V", None);
        let (potential_at_rest, potential_energy) = (self.form(&at_rest)?, self.form(&V)?);
        self.at("L", None);
        let lagrangian = self.form(&L)?;
        self.at("M", None);
        let mass_matrix = self.symmetric(&self.M.clone())?;
        let n = self.v.len();
        self.at("C", None);
        let (christoffel, C, G) = match self.by_brackets.take() {
            None => {
                let symbols = self.christoffel()?;
                let C = self.coriolis_matrix(&symbols)?;
                (Some(symbols), C, self.gradient(&V)?)
            }
            Some((C, G)) => {
                let C = C.iter().map(|row| self.all(row)).collect::<Result<Vec<_>>>()?;
                (None, C, self.all(&G)?)
            }
        };
        let coriolis_matrix = self.matrix(&C.concat(), n)?;
        self.at("Γ", None);
        let christoffel = match christoffel {
            None => None,
            Some(symbols) => Some(symbols.iter().map(|symbol| self.symbol(symbol)).collect::<Result<_>>()?),
        };
        self.at("G", None);
        let gravity_forces = self.vector(&G)?;
        self.at("Υ", None);
        let passive = self.all(&self.passive.clone())?;
        let rates = self.all(&self.rates.clone())?;
        let speeds = self.symbols(&self.v.clone())?;
        let accelerations = self.symbols(&self.a.clone())?;
        let mut forces = Vec::with_capacity(n);
        for (i, row) in C.iter().enumerate() {
            let M = self.M[i].clone();
            let force = self.canonical.dot(&M, &accelerations)?;
            let force = force.plus(Number::ONE, &self.canonical.dot(row, &speeds)?).plus(Number::ONE, &G[i]);
            forces.push(force.plus(Number::ONE, &passive[i]));
        }
        let rows = match christoffel.is_some() {
            true => Some(self.rows(&L, &speeds, &accelerations)?),
            false => None,
        };
        Ok(Equations {
            rotors,
            terms,
            potential_at_rest,
            kinetic_energy,
            potential_energy,
            lagrangian,
            mass_matrix,
            christoffel,
            coriolis_matrix,
            gravity_forces,
            rows,
            passive: match passive.iter().all(Polynomial::is_zero) {
                true => None,
                false => Some(self.vector(&passive)?),
            },
            forces: self.vector(&forces)?,
            rates: if rates.is_empty() { None } else { Some(self.vector(&rates)?) },
        })
    }

    fn symbol(&mut self, symbol: &Symbol) -> Result<Christoffel> {
        let [a, b, c] = &symbol.derivatives;
        let derivatives = [self.form(a)?, self.form(b)?, self.form(c)?];
        Ok(Christoffel { indices: symbol.indices, derivatives, value: self.form(&symbol.value)? })
    }

    /// Adds the rotors to T and M, and returns what they add to each.
    fn rotors(&mut self) -> Result<Option<(Polynomial, Vec<Vec<Polynomial>>)>> {
        let n = self.v.len();
        let unit = |k: usize| (0..n).map(|i| if i == k { Expr::ONE } else { Expr::ZERO }).collect::<Vec<_>>();
        let mut added = Vec::with_capacity(n);
        for k in 0..n {
            added.push(self.all(&plain::passive::rotors(&self.model.tree, &unit(k)))?);
        }
        if added.iter().flatten().all(Polynomial::is_zero) {
            return Ok(None);
        }
        let speeds = self.symbols(&self.v.clone())?;
        let mut kinetic = Polynomial::zero();
        for i in 0..n {
            let momentum = self.canonical.dot(&added[i], &speeds)?;
            let twice = self.canonical.product(&momentum, &speeds[i])?;
            kinetic = kinetic.plus(Number::ratio(1, 2), &twice);
            for j in 0..n {
                self.M[i][j] = self.M[i][j].plus(Number::ONE, &added[i][j]);
            }
        }
        self.T = self.T.plus(Number::ONE, &kinetic);
        Ok(Some((kinetic, added)))
    }

    /// Adds terms of one's own to T, V and M, and returns what they are, and what they add to M.
    fn terms(&mut self) -> Result<Option<Added>> {
        let [kinetic, potential] = self.terms;
        let [kinetic, potential] =
            [self.canonical.polynomial(kinetic)?, self.canonical.polynomial(potential)?];
        if kinetic.is_zero() && potential.is_zero() {
            return Ok(None);
        }
        self.T = self.T.plus(Number::ONE, &kinetic);
        self.V = self.V.plus(Number::ONE, &potential);
        let mut added = Vec::with_capacity(self.v.len());
        for (i, speed) in self.v.clone().into_iter().enumerate() {
            let momentum = self.canonical.derivative(&kinetic, speed)?;
            let mut row = Vec::with_capacity(self.v.len());
            for (j, speed) in self.v.clone().into_iter().enumerate() {
                let entry = self.canonical.derivative(&momentum, speed)?;
                self.M[i][j] = self.M[i][j].plus(Number::ONE, &entry);
                row.push(entry);
            }
            added.push(row);
        }
        Ok(Some(Added { energies: [kinetic, potential], mass: added }))
    }

    fn christoffel(&mut self) -> Result<Vec<Symbol>> {
        let n = self.v.len();
        let mut dM = vec![vec![vec![]; n]; n];
        for i in 0..n {
            for j in i..n {
                dM[i][j] = self.gradient(&self.M[i][j].clone())?;
                dM[j][i] = dM[i][j].clone();
            }
        }
        let mut symbols = Vec::new();
        for i in 0..n {
            for j in 0..n {
                for k in j..n {
                    let derivatives = [&dM[i][j][k], &dM[i][k][j], &dM[j][k][i]].map(Polynomial::clone);
                    let twice = derivatives[0].plus(Number::ONE, &derivatives[1]);
                    let value = twice.plus(-Number::ONE, &derivatives[2]).scaled(Number::ratio(1, 2));
                    if !value.is_zero() {
                        symbols.push(Symbol { indices: [i, j, k], derivatives, value });
                    }
                }
            }
        }
        Ok(symbols)
    }

    /// `C_ij = Σ_k Γ_ijk·q̇_k`
    fn coriolis_matrix(&mut self, symbols: &[Symbol]) -> Result<Vec<Vec<Polynomial>>> {
        let n = self.v.len();
        let speeds = self.symbols(&self.v.clone())?;
        let mut C = vec![vec![Polynomial::zero(); n]; n];
        for Symbol { indices: [i, j, k], value, .. } in symbols {
            let mut add = |j: usize, k: usize| -> Result<()> {
                C[*i][j] = C[*i][j].plus(Number::ONE, &self.canonical.product(value, &speeds[k])?);
                Ok(())
            };
            add(*j, *k)?;
            if j != k {
                add(*k, *j)?;
            }
        }
        Ok(C)
    }

    /// Momentum, its rate, the derivative by the coordinate, and the force, of each coordinate.
    fn rows(
        &mut self,
        L: &Polynomial,
        speeds: &[Polynomial],
        accelerations: &[Polynomial],
    ) -> Result<Vec<Row>> {
        let by_q = self.gradient(L)?;
        let mut rows = Vec::with_capacity(speeds.len());
        for (i, by_q) in by_q.into_iter().enumerate() {
            self.at("Υ", Some(i));
            let momentum = self.canonical.derivative(L, self.v[i])?;
            let mut by_v = Vec::with_capacity(speeds.len());
            for speed in self.v.clone() {
                by_v.push(self.canonical.derivative(&momentum, speed)?);
            }
            let along = self.gradient(&momentum)?;
            let rate = self.canonical.dot(&along, speeds)?;
            let rate = rate.plus(Number::ONE, &self.canonical.dot(&by_v, accelerations)?);
            let force = rate.plus(-Number::ONE, &by_q);
            rows.push(Row {
                momentum: self.form(&momentum)?,
                rate: self.form(&rate)?,
                by_coordinate: self.form(&by_q)?,
                force: self.form(&force)?,
            });
        }
        Ok(rows)
    }

    fn gradient(&mut self, polynomial: &Polynomial) -> Result<Vec<Polynomial>> {
        let mut gradient = Vec::with_capacity(self.q.len());
        for symbol in self.q.clone() {
            gradient.push(self.canonical.derivative(polynomial, symbol)?);
        }
        Ok(gradient)
    }

    fn symbols(&mut self, symbols: &[SymbolId]) -> Result<Vec<Polynomial>> {
        symbols.iter().map(|&symbol| Ok(self.canonical.symbol(symbol)?)).collect()
    }

    fn all(&mut self, exprs: &[Expr<'g>]) -> Result<Vec<Polynomial>> {
        exprs.iter().map(|&expr| Ok(self.canonical.polynomial(expr)?)).collect()
    }
}

/// What terms of one's own add.
struct Added {
    /// To T and to V.
    energies: [Polynomial; 2],
    /// To M.
    mass: Vec<Vec<Polynomial>>,
}

/// A Christoffel symbol in the normal form.
struct Symbol {
    indices: [usize; 3],
    derivatives: [Polynomial; 3],
    value: Polynomial,
}
