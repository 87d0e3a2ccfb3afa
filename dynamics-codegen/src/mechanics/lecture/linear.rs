//! The linear model about the neutral state, at rest.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::figure::neutral;
use super::{Linear, NoLinear, WITHOUT_NAMES};
use crate::closed::{Form, Matrix, Notation, close};
use crate::mechanics::equations::Inputs;
use crate::mechanics::plain::{self, Dual};
use crate::mechanics::singular::is_singular;
use crate::model::{Model, Tree};
use crate::symbolic::{Evaluator, Expr, Graph};

/// The linear model where all coordinates are zero, and quaternions no rotation; displacements are along speeds.
pub(super) fn linear<'g>(
    model: &Model<'g>,
    graph: &'g Graph,
    notation: &Notation,
) -> Result<Linear, NoLinear> {
    let (tree, n) = (&model.tree, Inputs::of(model).dof);
    let q = neutral(model);
    let still = vec![Expr::ZERO; n];
    let unit = |k: usize| (0..n).map(|i| if i == k { Expr::ONE } else { Expr::ZERO }).collect::<Vec<_>>();

    if !tree.terms.all().all(|term| plain::is_smooth(term, tree, &q)) {
        return Err(NoLinear::NotSmooth);
    }
    let M = plain::mass_matrix(tree, &q);
    if (0..n).any(|k| M[k][k].is_zero()) || has_no_inverse(model, graph, &M) {
        return Err(NoLinear::Singular);
    }
    let moved: Tree<Dual<Expr<'g>>> = tree.map(Dual::constant);
    // What holds against gravity and springs, and how it changes along each speed.
    let held = |direction: &[Expr<'g>]| {
        let q = Dual::moving(&q, direction);
        let passive = plain::passive::forces(&moved, &q, &Dual::resting(&still));
        let gravity = plain::gravity_forces(&moved, &q);
        gravity.into_iter().zip(passive).map(|(a, b)| a + b).collect::<Vec<_>>()
    };
    let along = |k: usize| held(&tree.configuration_rate(&q, &unit(k)));
    let damped =
        |k: usize| plain::passive::forces(&moved, &Dual::resting(&q), &Dual::moving(&still, &unit(k)));
    let hold: Vec<Expr<'g>> = held(&vec![Expr::ZERO; q.len()]).iter().map(|force| force.value).collect();
    let columns = |of: &dyn Fn(usize) -> Vec<Dual<Expr<'g>>>| {
        let columns: Vec<Vec<_>> = (0..n).map(of).collect();
        (0..n)
            .flat_map(|i| columns.iter().map(move |column| column[i].tangent).collect::<Vec<_>>())
            .collect::<Vec<_>>()
    };
    let (K, D) = (columns(&along), columns(&damped));
    let is_diagonal = (0..n * n).all(|k| k / n == k % n || M[k / n][k % n].is_zero());
    let solved = |k: usize, entry: &Expr<'g>| -(*entry / M[k / n][k / n]);
    let lower = (0..if is_diagonal { n } else { 0 }).flat_map(|i| {
        let row = |of: &[Expr<'g>]| (i * n..(i + 1) * n).map(|k| solved(k, &of[k])).collect::<Vec<_>>();
        [row(&K), row(&D)].concat()
    });
    let lower: Vec<Expr<'g>> = lower.collect();
    let all = [M.concat(), K, D, hold, lower].concat();
    let mut forms = close(graph, &mut notation.clone(), &all, WITHOUT_NAMES)?.forms.into_iter();
    let mut square = || Matrix::of_rows((0..n).map(|_| forms.by_ref().take(n).collect()).collect());
    let (mass_matrix, stiffness, damping) = (square(), square(), square());
    let hold = Matrix::vector(forms.by_ref().take(n).collect());
    let lower =
        is_diagonal.then(|| Matrix::of_rows((0..n).map(|_| forms.by_ref().take(2 * n).collect()).collect()));
    let is_driven = |i: usize, input: &usize| if *input == i { Form::ONE } else { Form::ZERO };
    let inputs = (0..n).map(|i| model.actuated.iter().map(|input| is_driven(i, input)).collect());
    Ok(Linear { mass_matrix, stiffness, damping, hold, lower, inputs: Matrix::of_rows(inputs.collect()) })
}

/// Whether M has no inverse, with values of their size for the fields.
fn has_no_inverse<'g>(model: &Model<'g>, graph: &'g Graph, M: &[Vec<Expr<'g>>]) -> bool {
    let mut evaluator = Evaluator::new(graph, |symbol| model.parameters[symbol.0 as usize].sample);
    let M: Vec<Vec<f64>> =
        M.iter().map(|row| row.iter().map(|&entry| evaluator.value(entry)).collect()).collect();
    is_singular(&M)
}
