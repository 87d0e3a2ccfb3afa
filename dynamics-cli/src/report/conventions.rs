//! Units, frames and signs.

use dynamics_view::page::{Section, number};

use super::Subject;

pub(super) fn section(subject: &Subject<'_, '_>) -> Section {
    let robot = subject.robot;
    let fall = robot.tree.gravity.0.map(|x| number(x, 6)).join(", ");
    let potential = match robot.tree.is_one_dof() {
        true => "∂V/∂q of gravity and of terms of V, on the left-hand side",
        false => {
            "of gravity and of terms of V, on the left-hand side: how fast V grows while one speed is one and every other is \
             zero; where speeds are rates it is ∂V/∂q"
        }
    };
    let mut facts = [
        ["units", "m, kg, s, rad, N, J"],
        ["signs", "a positive τ pushes its joint in the direction in which its coordinate grows"],
        ["equation", "M·a + C·v + G + P = τ"],
        ["C", "of Levi-Civita: Ṁ = C + Cᵀ; of Christoffel's symbols where joints have one coordinate each"],
        ["G", potential],
        ["rotations", "quaternions i, j, k, w; roll, pitch and yaw about fixed x, y and z"],
        ["twists", "linear before angular"],
        ["inertias", "about the centre of mass, in the body's axes; Ixy is the entry of the tensor, −∫xy dm"],
    ]
    .map(|fact| fact.map(str::to_owned))
    .to_vec();
    facts.insert(1, ["free fall".to_owned(), format!("({fall}) m/s² in the axes of the world")]);
    if robot.tree.coordinates() != robot.dof() {
        let of_loose = "the twist of the body against its parent, in the body's own axes; deviations δ are of the tangent space";
        facts.push(["speeds of ball and free joints".to_owned(), of_loose.to_owned()]);
    }
    Section::new("conventions", "Conventions").facts(facts)
}
