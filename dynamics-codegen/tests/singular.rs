//! Robots whose mass matrix has no inverse in any configuration, by counting: some masses at points have three degrees of
//! freedom each, and whoever has more joints can move some that move no mass. Robots with little mass in a joint are none.

use dynamics_codegen::diagnostics::Code;
use dynamics_codegen::spatial::Random;
use dynamics_codegen::symbolic::Graph;
use dynamics_codegen::{judged, no_files, read_struct};

const ROBOTS: usize = 60;

/// What the judges say of a robot: nothing, or the one mistake.
fn verdict(robot: &str) -> Option<(Code, String)> {
    let input = syn::parse_str(robot).expect("it is a struct");
    let (spec, _) = read_struct(&input, no_files).unwrap_or_else(|_| panic!("it can be read:\n{robot}"));
    let graph = Graph::new();
    let found = judged(&spec, &graph).err()?.take();
    let [mistake] = found.as_slice() else { panic!("several mistakes in\n{robot}\n{found:?}") };
    Some((mistake.code, mistake.message.clone()))
}

/// Some numbers with two digits, as people write them.
fn numbers<const N: usize>(random: &mut Random) -> String {
    let number = |_| format!("{:.2}", random.next());
    format!("[{}]", (0..N).map(number).collect::<Vec<_>>().join(", "))
}

/// A chain of joints on oblique axes, `armatures` in them, with a mass at a point at its end.
fn chain(joints: &[&str], armature: &str, random: &mut Random) -> String {
    let mut robot = String::new();
    for (k, kind) in joints.iter().enumerate() {
        let parent = if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) };
        let (axis, at) = (numbers::<3>(random), numbers::<3>(random));
        robot += &format!("#[joint(q{k}: {kind}({axis}), {parent} -> b{k}, at = {at}{armature})]\n");
        let is_last = k + 1 == joints.len();
        let solid = if is_last {
            format!(", com = {}, solid = point(2.3)", numbers::<3>(random))
        } else {
            String::new()
        };
        robot += &format!("#[body(b{k}{solid})]\n");
    }
    robot + "struct Chain;"
}

/// Four joints and a point, on which three are too many already where only it has mass.
const TOO_MANY: [&[&str]; 4] = [
    &["revolute", "revolute", "revolute", "revolute"],
    &["prismatic", "prismatic", "revolute", "prismatic"],
    &["revolute", "prismatic", "prismatic", "revolute"],
    &["prismatic", "revolute", "revolute", "revolute"],
];

#[test]
fn four_joints_cannot_move_one_point_in_four_ways() {
    let mut random = Random(7);
    for k in 0..ROBOTS {
        let robot = chain(TOO_MANY[k % TOO_MANY.len()], "", &mut random);
        let (code, message) = verdict(&robot).unwrap_or_else(|| panic!("nobody complained of\n{robot}"));
        assert_eq!(code, Code::MassMatrixSingular, "{message}\n{robot}");
        assert!(message.contains("M is singular"), "{message}");
    }
}

#[test]
fn three_can_and_so_can_four_with_rotors() {
    let mut random = Random(8);
    for k in 0..ROBOTS {
        let joints = TOO_MANY[k % TOO_MANY.len()];
        let robot = chain(&joints[1..], "", &mut random);
        assert_eq!(verdict(&robot), None, "{robot}");
        // Little, and there.
        let robot = chain(joints, ", armature = 1e-12", &mut random);
        assert_eq!(verdict(&robot), None, "{robot}");
    }
}

/// In a plane a point has two degrees of freedom, and these names are theirs that share it.
#[test]
fn a_point_in_a_plane_does_not_move_in_three_ways() {
    let mut random = Random(9);
    for _ in 0..ROBOTS {
        let (com, mass) = (numbers::<3>(&mut random), format!("{:.1}", 2.0 + random.next()));
        let robot = format!(
            "#[joint(x: prismatic(x), world -> a)] #[body(a)] #[joint(y: prismatic(y), a -> b)] #[body(b)]
            #[joint(t: revolute(z), b -> c)] #[body(c, solid = point({mass}), com = {com})] struct P;"
        );
        let expected = "the joints `x`, `y`, `t` can move together without moving any mass: M is singular";
        assert_eq!(verdict(&robot), Some((Code::MassMatrixSingular, expected.to_owned())), "{robot}");
    }
}

/// The speeds of one joint among themselves, on a body that has mass of its own; the hinge has no part in it.
#[test]
fn a_planar_joint_turns_a_point_for_nothing() {
    for (hinge, placed) in
        [("revolute(z)", "at = [0.1, 0.2, 0.3]"), ("free", "at = [0.11, 0.2, 0.33], rpy = [0.3, 0.4, 0.5]")]
    {
        for axis in ["[1, 2, 3]", "[1.1, 2.3, 3.7]"] {
            let robot = format!(
                "#[joint(h: {hinge}, world -> a)] #[body(a, solid = cuboid(1, [0.1, 0.2, 0.3]))]
                #[joint(p: planar({axis}), a -> b, {placed})]
                #[body(b, solid = point(2.3), com = [0.12, 0.23, 0.37])] struct P;"
            );
            let expected = "the joint `p` can move without moving any mass: M is singular";
            assert_eq!(verdict(&robot), Some((Code::MassMatrixSingular, expected.to_owned())), "{robot}");
        }
    }
}
