//! The steps of a derivation, made from each other in the normal form.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]
#![allow(clippy::needless_range_loop, reason = "indices are those of the formulas")]

use super::{Body, Christoffel, Equations, Rotors, Row, Terms};
use crate::closed::{Canonical, Form, Matrix, Notation, Polynomial, Swelling};
use crate::mechanics::equations::{Argument, Inputs};
use crate::mechanics::plain;
use crate::model::{Frame, Link, LinkInfo, Model};
use crate::spatial::{Pose, PseudoInertia, Vector3};
use crate::symbolic::{Expr, Graph, Number, Op, SymbolId};

/// Products of terms that are made for one robot at most.
const WORK: usize = 200_000;
/// What has more terms than this is not written out.
const TERMS: usize = 60;

/// A body in expressions.
struct Moving<'g> {
    name: String,
    welded: Vec<String>,
    mass: Expr<'g>,
    /// Of its frame, in the world.
    pose: Pose<Expr<'g>>,
    /// `m·c` in its frame, where that is not at the centre of mass.
    first: Option<Vector3<Expr<'g>>>,
    /// About the frame's origin.
    inertia: [[Expr<'g>; 3]; 3],
    jacobian: Vec<Vec<Expr<'g>>>,
    potential: Expr<'g>,
}

/// The bodies of a tree at a configuration.
fn moving<'g>(model: &Model<'g>, graph: &'g Graph, q: &[Expr<'g>]) -> Vec<Moving<'g>> {
    let tree = &model.tree;
    let with_mass = tree.links.iter().zip(&model.links).enumerate().filter(|(_, (link, _))| {
        let PseudoInertia { mass, second, .. } = link.inertia;
        !mass.is_zero() || !second.full().0.concat().iter().all(|entry| entry.is_zero())
    });
    let body = |(k, (link, info)): (usize, (&Link<Expr<'g>>, &LinkInfo))| {
        let own = info.body.map(|body| &tree.frames[body]);
        let frame = own.map_or_else(Pose::identity, |frame| frame.pose);
        let PseudoInertia { mass, first, .. } = link.inertia;
        // Of several bodies welded together the centre of mass is a quotient by a sum, which nobody reads.
        let is_own = mass.is_zero() || is_sum(graph, mass);
        let origin = if is_own { frame.translation } else { first.map(|moment| moment / mass) };
        let at_origin = Pose { translation: origin, ..frame };
        let frame = Frame { name: String::new(), link: Some(k), pose: at_origin };
        let pose = plain::pose(tree, &frame, q);
        let seen = link.inertia.transformed(at_origin.inverse());
        let first = is_own.then_some(seen.first);
        let others = tree
            .frames
            .iter()
            .enumerate()
            .filter(|(at, other)| other.link == Some(k) && Some(*at) != info.body);
        let moment = first.map_or_else(Vector3::zero, |first| pose.rotation * first);
        let potential = -(tree.gravity.dot(pose.translation) * mass + tree.gravity.dot(moment));
        Moving {
            name: own.map_or_else(|| info.joint.clone(), |own| own.name.clone()),
            welded: others.map(|(_, other)| other.name.clone()).collect(),
            mass,
            pose,
            first,
            inertia: seen.rotational().full().0,
            jacobian: plain::body_jacobian(tree, &frame, q),
            potential,
        }
    };
    with_mass.map(body).collect()
}

/// Whether an expression is a sum.
fn is_sum(graph: &Graph, expr: Expr<'_>) -> bool {
    matches!(expr, Expr::Node { id, .. } if matches!(graph.op(id), Op::Add(..) | Op::Sub(..)))
}

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
        let canonical = Canonical::new(graph, notation, &exprs, WORK)?;
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
        })
    }

    pub(super) fn bodies(&mut self) -> Result<Vec<Body>, Swelling> {
        let moving = std::mem::take(&mut self.bodies);
        moving.iter().map(|body| self.body(body)).collect()
    }

    fn body(&mut self, body: &Moving<'g>) -> Result<Body, Swelling> {
        let n = self.v.len();
        let mass = self.canonical.polynomial(body.mass)?;
        let rotation = self.all(&body.pose.rotation.0.concat())?;
        let center = self.all(&body.pose.translation.0)?;
        let inertia = self.all(&body.inertia.concat())?;
        let first = match &body.first {
            Some(first) => self.all(&first.0)?,
            None => vec![Polynomial::zero(); 3],
        };
        let jacobian: Vec<Vec<Polynomial>> =
            body.jacobian.iter().map(|row| self.all(row)).collect::<Result<_, _>>()?;
        let speeds = self.symbols(&self.v.clone())?;
        let twist: Vec<Polynomial> =
            jacobian.iter().map(|row| self.canonical.dot(row, &speeds)).collect::<Result<_, _>>()?;
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
        let mut forms = |polynomials: &[Polynomial]| self.canonical.forms(self.notation, polynomials, TERMS);
        let square =
            |entries: Vec<Form>, n: usize| Matrix::of_rows(entries.chunks(n).map(<[Form]>::to_vec).collect());
        let [mass, kinetic_energy, potential_energy] = three(forms(&[mass, kinetic, potential])?);
        Ok(Body {
            name: body.name.clone(),
            welded: body.welded.clone(),
            mass,
            inertia: square(forms(&inertia)?, 3),
            rotation: square(forms(&rotation)?, 3),
            center: Matrix::vector(forms(&center)?),
            first: match body.first {
                Some(_) => Some(Matrix::vector(forms(&first)?)),
                None => None,
            },
            jacobian: square(forms(&jacobian.concat())?, n),
            twist: Matrix::vector(forms(&twist)?),
            kinetic_energy,
            potential_energy,
            share: symmetric(&share, &mut forms)?,
        })
    }

    /// `ℳ·V` of a twist (v, ω): `(m v + ω × h, h × v + 𝓘 ω)`, where h is zero about the centre of mass.
    fn momentum(
        &mut self,
        mass: &Polynomial,
        first: &[Polynomial],
        inertia: &[Polynomial],
        twist: &[Polynomial],
    ) -> Result<Vec<Polynomial>, Swelling> {
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

    fn cross(&mut self, a: &[Polynomial], b: &[Polynomial]) -> Result<Vec<Polynomial>, Swelling> {
        let mut cross = Vec::with_capacity(3);
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let product = self.canonical.product(&a[next], &b[last])?;
            cross.push(product.plus(-Number::ONE, &self.canonical.product(&a[last], &b[next])?));
        }
        Ok(cross)
    }

    pub(super) fn equations(&mut self) -> Result<Equations, Swelling> {
        let rotors = self.rotors()?;
        let at_rest = self.canonical.polynomial(self.at_rest)?;
        self.V = self.V.plus(Number::ONE, &at_rest);
        let terms = self.terms()?;
        let L = self.T.plus(-Number::ONE, &self.V);
        let (christoffel, C, G) = match self.by_brackets.take() {
            None => {
                let symbols = self.christoffel()?;
                let C = self.coriolis_matrix(&symbols)?;
                (Some(symbols), C, self.gradient(&self.V.clone())?)
            }
            Some((C, G)) => {
                let C = C.iter().map(|row| self.all(row)).collect::<Result<Vec<_>, _>>()?;
                (None, C, self.all(&G)?)
            }
        };
        let passive = self.all(&self.passive.clone())?;
        let rates = self.all(&self.rates.clone())?;
        let speeds = self.symbols(&self.v.clone())?;
        let accelerations = self.symbols(&self.a.clone())?;
        let mut forces = Vec::with_capacity(speeds.len());
        for (i, row) in C.iter().enumerate() {
            let M = self.M[i].clone();
            let force = self.canonical.dot(&M, &accelerations)?;
            let force = force.plus(Number::ONE, &self.canonical.dot(row, &speeds)?).plus(Number::ONE, &G[i]);
            forces.push(force.plus(Number::ONE, &passive[i]));
        }
        let rows = if christoffel.is_some() { Some(self.rows(&L, &speeds, &accelerations)?) } else { None };
        let (M, T, V) = (self.M.clone(), self.T.clone(), self.V.clone());
        let mut forms = |polynomials: &[Polynomial]| self.canonical.forms(self.notation, polynomials, TERMS);
        let christoffel = match christoffel {
            None => None,
            Some(symbols) => {
                Some(symbols.iter().map(|symbol| symbol.written(&mut forms)).collect::<Result<_, _>>()?)
            }
        };
        let rows = match rows {
            None => None,
            Some(rows) => Some(
                rows.iter()
                    .map(|row| {
                        let [momentum, rate, by_coordinate] = three(forms(&row[..3])?);
                        let force = forms(&row[3..])?.swap_remove(0);
                        Ok(Row { momentum, rate, by_coordinate, force })
                    })
                    .collect::<Result<_, _>>()?,
            ),
        };
        let [kinetic_energy, potential_energy, lagrangian] = three(forms(&[T, V, L])?);
        let n = M.len();
        let coriolis = forms(&C.concat())?;
        Ok(Equations {
            rotors: match rotors {
                None => None,
                Some((energy, mass)) => Some(Rotors {
                    kinetic_energy: forms(&[energy])?.swap_remove(0),
                    mass_matrix: symmetric(&mass, &mut forms)?,
                }),
            },
            terms: match terms {
                None => None,
                Some(Added { energies, mass }) => {
                    let [kinetic_energy, potential_energy, _] = three(forms(&energies)?);
                    Some(Terms {
                        kinetic_energy,
                        potential_energy,
                        mass_matrix: symmetric(&mass, &mut forms)?,
                    })
                }
            },
            potential_at_rest: forms(&[at_rest])?.swap_remove(0),
            kinetic_energy,
            potential_energy,
            lagrangian,
            mass_matrix: symmetric(&M, &mut forms)?,
            christoffel,
            coriolis_matrix: Matrix::of_rows(coriolis.chunks(n).map(<[Form]>::to_vec).collect()),
            gravity_forces: Matrix::vector(forms(&G)?),
            rows,
            passive: match passive.iter().all(Polynomial::is_zero) {
                true => None,
                false => Some(Matrix::vector(forms(&passive)?)),
            },
            forces: Matrix::vector(forms(&forces)?),
            rates: if rates.is_empty() { None } else { Some(Matrix::vector(forms(&rates)?)) },
        })
    }

    /// Adds the rotors to T and M, and returns what they add to each.
    fn rotors(&mut self) -> Result<Option<(Polynomial, Vec<Vec<Polynomial>>)>, Swelling> {
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
    fn terms(&mut self) -> Result<Option<Added>, Swelling> {
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

    fn christoffel(&mut self) -> Result<Vec<Symbol>, Swelling> {
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
    fn coriolis_matrix(&mut self, symbols: &[Symbol]) -> Result<Vec<Vec<Polynomial>>, Swelling> {
        let n = self.v.len();
        let speeds = self.symbols(&self.v.clone())?;
        let mut C = vec![vec![Polynomial::zero(); n]; n];
        for Symbol { indices: [i, j, k], value, .. } in symbols {
            let mut add = |j: usize, k: usize| -> Result<(), Swelling> {
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
    ) -> Result<Vec<[Polynomial; 4]>, Swelling> {
        let by_q = self.gradient(L)?;
        let mut rows = Vec::with_capacity(speeds.len());
        for (i, by_q) in by_q.into_iter().enumerate() {
            let momentum = self.canonical.derivative(L, self.v[i])?;
            let mut by_v = Vec::with_capacity(speeds.len());
            for &speed in &self.v {
                by_v.push(self.canonical.derivative(&momentum, speed)?);
            }
            let along = self.gradient(&momentum)?;
            let rate = self.canonical.dot(&along, speeds)?;
            let rate = rate.plus(Number::ONE, &self.canonical.dot(&by_v, accelerations)?);
            let force = rate.plus(-Number::ONE, &by_q);
            rows.push([momentum, rate, by_q, force]);
        }
        Ok(rows)
    }

    fn gradient(&mut self, polynomial: &Polynomial) -> Result<Vec<Polynomial>, Swelling> {
        self.q.iter().map(|&symbol| self.canonical.derivative(polynomial, symbol)).collect()
    }

    fn symbols(&mut self, symbols: &[SymbolId]) -> Result<Vec<Polynomial>, Swelling> {
        symbols.iter().map(|&symbol| self.canonical.symbol(symbol)).collect()
    }

    fn all(&mut self, exprs: &[Expr<'g>]) -> Result<Vec<Polynomial>, Swelling> {
        exprs.iter().map(|&expr| self.canonical.polynomial(expr)).collect()
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

impl Symbol {
    fn written(
        &self,
        forms: &mut impl FnMut(&[Polynomial]) -> Result<Vec<Form>, Swelling>,
    ) -> Result<Christoffel, Swelling> {
        let derivatives = three(forms(&self.derivatives)?);
        let value = forms(std::slice::from_ref(&self.value))?.swap_remove(0);
        Ok(Christoffel { indices: self.indices, derivatives, value })
    }
}

/// The first three of some forms.
fn three(forms: Vec<Form>) -> [Form; 3] {
    let mut forms = forms.into_iter();
    std::array::from_fn(|_| forms.next().unwrap_or(Form::ZERO))
}

/// A symmetric matrix as it is written.
fn symmetric(
    rows: &[Vec<Polynomial>],
    forms: &mut impl FnMut(&[Polynomial]) -> Result<Vec<Form>, Swelling>,
) -> Result<Matrix, Swelling> {
    let upper = rows.iter().enumerate().map(|(k, row)| forms(&row[k..]));
    Ok(Matrix::symmetric(upper.collect::<Result<_, _>>()?))
}
