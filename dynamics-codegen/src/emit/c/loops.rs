//! What is put together by loops: the inverse of a large M, and the derivatives of forward dynamics.
//!
//! M = L D Lᵀ with a unit triangular L, without pivots, for M is positive definite. G. Golub, C. Van Loan, *Matrix
//! Computations*, 4th ed., Johns Hopkins 2013, §4.1.2.

use super::Real;
use super::names::Robot;
use crate::mechanics::equations::Method;

/// The functions that the bodies call; `N` is the number of speeds.
const FACTOR_AND_SOLVE: &str = "\
/* M = L D L^T: L, without its unit diagonal, below the diagonal of M, and D on it. */
static void PREFIX_factor(REAL M[N][N])
{
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < i; ++j) {
            for (int k = 0; k < j; ++k) {
                M[i][j] -= M[i][k] * M[j][k];
            }
        }
        for (int j = 0; j < i; ++j) {
            const REAL entry = M[i][j] / M[j][j];
            M[i][i] -= M[i][j] * entry;
            M[i][j] = entry;
        }
    }
}

/* X becomes sign M^-1 X. */
static void PREFIX_solve(REAL sign, REAL L[N][N], REAL X[N][N])
{
    for (int i = 0; i < N; ++i) {
        for (int k = 0; k < i; ++k) {
            for (int j = 0; j < N; ++j) {
                X[i][j] -= L[i][k] * X[k][j];
            }
        }
    }
    for (int i = N - 1; i >= 0; --i) {
        const REAL scale = sign / L[i][i];
        for (int j = 0; j < N; ++j) {
            X[i][j] *= scale;
        }
        for (int k = i + 1; k < N; ++k) {
            for (int j = 0; j < N; ++j) {
                X[i][j] -= L[k][i] * X[k][j];
            }
        }
    }
}

static void PREFIX_identity(REAL X[N][N])
{
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < N; ++j) {
            X[i][j] = (i == j) ? ONE : ZERO;
        }
    }
}

";

const INVERSE: &str = "\
{
    REAL L[N][N];

    PREFIX_mass_matrix(ROBOTq, L);
    PREFIX_factor(L);
    PREFIX_identity(W);
    PREFIX_solve(ONE, L, W);
}
";

const FORWARD_DERIVATIVES: &str = "\
{
    REAL a[N];

    PREFIX_a_and_derivatives(ROBOTq, v, tau, a, da_dq, da_dv, da_dtau);
}
";

const FORWARD_WITH_DERIVATIVES: &str = "\
{
    REAL L[N][N];

    PREFIX_forward_dynamics(ROBOTq, v, tau, a);
    PREFIX_inverse_derivatives(ROBOTq, v, a, da_dq, da_dv, L);
    PREFIX_factor(L);
    PREFIX_solve(-ONE, L, da_dq);
    PREFIX_solve(-ONE, L, da_dv);
    PREFIX_identity(da_dtau);
    PREFIX_solve(ONE, L, da_dtau);
}
";

const INVERSE_WITH_DERIVATIVES: &str = "\
{
    PREFIX_inverse_dynamics(ROBOTq, v, a, tau_out);
    PREFIX_inverse_derivatives(ROBOTq, v, a, dtau_dq, dtau_dv, dtau_da);
}
";

/// The results of a method in the form of loops, and whether each is a square matrix.
pub(super) fn outputs(method: Method) -> &'static [(&'static str, bool)] {
    match method {
        Method::InverseMassMatrix => &[("W", true)],
        Method::InverseDynamicsWithDerivatives => {
            &[("tau_out", false), ("dtau_dq", true), ("dtau_dv", true), ("dtau_da", true)]
        }
        Method::ForwardDynamicsWithDerivatives => {
            &[("a", false), ("da_dq", true), ("da_dv", true), ("da_dtau", true)]
        }
        _ => &[("da_dq", true), ("da_dv", true), ("da_dtau", true)],
    }
}

/// The static functions that the bodies call.
pub(super) fn helpers(robot: &Robot, real: Real) -> String {
    filled(FACTOR_AND_SOLVE, robot, real)
}

/// The body of a method in the form of loops.
pub(super) fn body(method: Method, robot: &Robot, real: Real) -> Option<String> {
    let template = match method {
        Method::InverseMassMatrix => INVERSE.to_owned(),
        Method::ForwardDynamicsDerivatives => {
            FORWARD_WITH_DERIVATIVES.replacen("{\n", "{\n    REAL a[N];\n", 1)
        }
        Method::ForwardDynamicsWithDerivatives => FORWARD_WITH_DERIVATIVES.to_owned(),
        Method::InverseDynamicsWithDerivatives => INVERSE_WITH_DERIVATIVES.to_owned(),
        _ => return None,
    };
    Some(filled(&template, robot, real))
}

/// The body of the derivatives of `a` where there is a function that gives `a` as well.
pub(super) fn forward_derivatives_of_bundle(robot: &Robot, real: Real) -> String {
    filled(FORWARD_DERIVATIVES, robot, real)
}

/// A template with the names of a robot; `(REAL)` before a number makes a literal of it.
pub(super) fn filled(template: &str, robot: &Robot, real: Real) -> String {
    let literal = |value: f64| real.literal(value).unwrap_or_default();
    let words = [
        ("PREFIX", robot.prefix.clone()),
        ("UPPER", robot.upper.clone()),
        ("REAL", real.name().to_owned()),
        ("ROBOT", if robot.has_fields() { "robot, ".to_owned() } else { String::new() }),
        ("ZERO", literal(0.0)),
        ("ONE", literal(1.0)),
        ("[N]", format!("[{}]", robot.size("NV"))),
        ("< N;", format!("< {};", robot.size("NV"))),
        ("= N -", format!("= {} -", robot.size("NV"))),
    ];
    let mut parts = template.split("(REAL)");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let length = part.find(|c: char| !(c.is_ascii_digit() || ".e-".contains(c))).unwrap_or(part.len());
        let number = part[..length].parse().expect("templates have numbers behind `(REAL)`");
        text += &literal(number);
        text += &part[length..];
    }
    words.iter().fold(text, |text, (word, with)| text.replace(word, with))
}
