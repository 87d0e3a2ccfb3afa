//! A chain of sixteen joints on a base that nothing holds, with an arm of two: its matrices are computed in lanes over links.

crate::robot! {
    Floating, &[Part::Free, Part::Lines(18)];
    /// Alike links one after the other, and what acts in joints by itself.
    #[dynamics(outputs(equations_of_motion, coriolis_matrix, inverse_dynamics, forward_dynamics,
        inverse_dynamics_derivatives, forward_dynamics_derivatives, forward_dynamics_with_derivatives))]
    #[joint(base: free, world -> b0, at = [1, 2, 3], rpy = [0.3, 0.2, 0.1])]
    #[body(b0, mass = 1.2, com = [0.02, 0.01, 0.03], inertia = tensor(0.002, 0.0001, 0, 0.003, 0.0002, 0.003))]
    #[joint(j1: revolute(y), b0 -> b1, at = [0.05, 0, 0])]
    #[body(b1, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j2: revolute([1, 0, 0.5]), b1 -> b2, at = [0.05, 0, 0])]
    #[body(b2, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j3: revolute(x), b2 -> b3, at = [0.05, 0, 0], damping = 0.01, armature = 1e-4)]
    #[body(b3, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j4: revolute(-y), b3 -> b4, at = [0.05, 0, 0])]
    #[body(b4, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j5: revolute([0, 1, 1]), b4 -> b5, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b5, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j6: prismatic(x), b5 -> b6, at = [0.05, 0, 0])]
    #[body(b6, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j7: revolute(z), b6 -> b7, at = [0.05, 0, 0], stiffness = 0.4, rest = 0.3)]
    #[body(b7, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j8: revolute(y), b7 -> b8, at = [0.05, 0, 0])]
    #[body(b8, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j9: revolute([1, 0, 0.5]), b8 -> b9, at = [0.05, 0, 0])]
    #[body(b9, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j10: revolute(x), b9 -> b10, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b10, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j11: revolute(-y), b10 -> b11, at = [0.05, 0, 0])]
    #[body(b11, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j12: revolute([0, 1, 1]), b11 -> b12, at = [0.05, 0, 0], friction = 0.02, friction_speed = 0.1)]
    #[body(b12, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j13: prismatic(x), b12 -> b13, at = [0.05, 0, 0])]
    #[body(b13, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j14: revolute(z), b13 -> b14, at = [0.05, 0, 0])]
    #[body(b14, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j15: revolute(y), b14 -> b15, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b15, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j16: revolute([1, 0, 0.5]), b15 -> b16, at = [0.05, 0, 0])]
    #[body(b16, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j17: revolute(x), b9 -> b17, at = [0.05, 0, 0])]
    #[body(b17, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j18: revolute(-y), b17 -> b18, at = [0.05, 0, 0])]
    #[body(b18, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    struct Floating;
}

#[test]
fn matrices_are_in_lanes() {
    let text = crate::generated(&entry());
    for call in [
        "coriolis_matrix(q, v)",
        "inverse_dynamics_derivatives(q, v, a)",
        "forward_dynamics_derivatives(q, v, tau, tree)",
        "forward_dynamics_with_derivatives(q, v, tau, tree)",
    ] {
        let call = format!("self.__table(|table| table.in_lanes().{call})");
        assert!(text.contains(&call), "there is no `{call}`");
    }
    assert!(
        text.contains("static DOUBLE: recursion::Tree<f64, "),
        "its numbers stand in memory that is never written"
    );
}

/// The accelerations that come of M and its factors are as exact as those of the articulated bodies.
#[test]
fn accelerations_with_their_derivatives_answer_the_forces() {
    for_each_state(&entry(), |oracle, StateOf { q, v, tau, .. }, _| {
        let [qs, vs, forces] = [q, v, tau].map(Vector::as_slice);
        let (q, v, tau) = (fixed(q), fixed(v), fixed(tau));
        let (a, derivatives) = Floating.forward_dynamics_with_derivatives(&q, &v, &tau);
        let residual = oracle.forward_dynamics_residual(qs, vs, forces, a.as_slice());
        assert!(residual <= ROUNDING, "a misses τ by {residual:.1e}");
        assert_eq!(derivatives, Floating.forward_dynamics_derivatives(&q, &v, &tau));
    });
}
