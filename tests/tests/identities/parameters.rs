//! Joint forces as a linear function of inertial parameters.

use dynamics_tests::close::ROUNDING;
use dynamics_tests::{Forms, Matrix, State, Vector, assert_close, zoo};

use crate::for_each_state;

/// Combinations with shares that are no simple numbers have these to twelve digits.
const SHARES: f64 = 1e-11;

/// `Y·π = τ` and `Y_b·π_b = τ`
#[test]
fn regressors_give_the_joint_forces() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let tau = robot.inverse_dynamics(q, v, a);
        let product = |what: &str, tolerance: f64, Y: Matrix, parameters: Vector| {
            assert_eq!(Y.ncols(), parameters.len(), "{name}");
            let terms = (Y.abs() * parameters.abs()).amax();
            let found = &Y * &parameters;
            assert_close!(found.as_slice(), tau.as_slice(), tolerance, floor = terms, "{name}: {what}");
        };
        product("Y·π", ROUNDING, robot.regressor(q, v, a), robot.inertial_parameters());
        product("Y_b·π_b", SHARES, robot.base_regressor(q, v, a), robot.base_parameters());
    });
}

/// No column of `Y_b` is made of the others, and `Y` says no more than `Y_b`: over many states both have the rank NB.
#[test]
fn base_parameters_are_as_few_as_there_can_be() {
    /// A singular value below this part of the largest is rounding; columns are made of the same size first.
    const RANK: f64 = 1e-9;
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let base = robot.base_parameters().len();
        let states = entry.states(4 + 3 * base / entry.space.speeds());
        let stacked = |regressor: &dyn Fn(&State) -> Matrix| {
            let blocks: Vec<Matrix> = states.iter().map(regressor).collect();
            let rows: Vec<_> = blocks.iter().flat_map(|block| block.row_iter()).collect();
            let mut all = Matrix::from_rows(&rows);
            let largest = all.amax();
            for mut column in all.column_iter_mut() {
                let size = column.norm();
                column.scale_mut(if size > ROUNDING * largest { 1.0 / size } else { 0.0 });
            }
            let values = all.singular_values();
            values.iter().filter(|value| **value > RANK * values.max()).count()
        };
        let [of_all, of_base] = [
            stacked(&|State { q, v, a, .. }| robot.regressor(q, v, a)),
            stacked(&|State { q, v, a, .. }| robot.base_regressor(q, v, a)),
        ];
        let expected = match entry.name {
            // Shares in combinations are numbers: two that would be the pinion's radius, a field, are not found.
            "Gripper" => [base - 2, base - 2],
            // The same of one that has the length of the shaft in it.
            "Cardan" => [base - 1, base - 1],
            _ => [base, base],
        };
        assert_eq!([of_all, of_base], expected, "{}: the ranks of Y and Y_b", entry.name);
    }
}

/// Each has its own, and the masses are those of all that moves.
#[test]
fn every_parameter_has_a_name() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let count = robot.inertial_parameters().len();
        assert_eq!(entry.parameter_names.len(), count, "{}", entry.name);
        assert_eq!(entry.base_parameter_names.len(), robot.base_parameters().len(), "{}", entry.name);
        let mut names = entry.parameter_names.to_vec();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{}: {names:?}", entry.name);
        let total: f64 = (entry.parameter_names.iter().zip(&robot.inertial_parameters()))
            .filter(|(name, _)| name.ends_with(".mass"))
            .map(|(_, mass)| mass)
            .sum();
        assert_close!([total], [robot.total_mass()], ROUNDING, "{}: the sum of masses", entry.name);
    }
}
