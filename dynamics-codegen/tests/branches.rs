//! What is computed side by side, branches that are alike and columns that are solved for: what is found, and that it
//! computes what one after the other does.

use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::passes::{Branches, Compiled, Operation, Plan, Program, RunTime, Source, Stage};
use dynamics_codegen::spatial::Random;
use dynamics_codegen::spec::urdf::Urdf;
use dynamics_codegen::symbolic::Graph;
use dynamics_codegen::{checked, read_urdf, read_urdf_with};

/// Some thousand operations in two orders; mass matrices of these trees have conditions of some hundreds.
const ROUNDING: f64 = 1e-11;

/// A file of links and joints, numbers of which are random.
struct File {
    text: String,
    links: usize,
    random: Random,
}

impl File {
    fn new(seed: u64) -> Self {
        let text = "<robot name=\"r\"><link name=\"l0\"><inertial><mass value=\"9\"/>\
                    <inertia ixx=\"0.5\" iyy=\"0.6\" izz=\"0.7\" ixy=\"0.01\" ixz=\"0.02\" iyz=\"0.03\"/></inertial></link>";
        Self { text: text.to_owned(), links: 1, random: Random(seed) }
    }

    /// A link on another one, with its number; `axis` and `at` are of its joint.
    fn link(&mut self, parent: usize, kind: &str, axis: [f64; 3], at: [f64; 3]) -> usize {
        let k = self.links;
        self.links += 1;
        let [a, b, c, m] = [0; 4].map(|_| self.random.next());
        let (axis, at) = (axis.map(|x| x.to_string()).join(" "), at.map(|x| x.to_string()).join(" "));
        self.text += &format!(
            "<link name=\"l{k}\"><inertial><origin xyz=\"{a} {b} {c}\"/><mass value=\"{}\"/>\
             <inertia ixx=\"0.05\" iyy=\"0.06\" izz=\"0.07\" ixy=\"0.001\" ixz=\"0.002\" iyz=\"0.003\"/></inertial></link>\
             <joint name=\"j{k}\" type=\"{kind}\"><parent link=\"l{parent}\"/><child link=\"l{k}\"/>\
             <origin xyz=\"{at}\"/><axis xyz=\"{axis}\"/><limit effort=\"1\" velocity=\"1\" lower=\"-1\" upper=\"1\"/></joint>",
            1.0 + m.abs()
        );
        k
    }

    fn end(self) -> String {
        self.text + "</robot>"
    }
}

/// So many legs on a body: the second half are mirror images of the first.
fn legs(count: usize) -> String {
    let mut file = File::new(count as u64);
    for leg in 0..count {
        let side = if 2 * leg < count { 1.0 } else { -1.0 };
        let hip = file.link(0, "continuous", [side, 0.0, 0.0], [0.1 * leg as f64, 0.2 * side, 0.0]);
        let thigh = file.link(hip, "continuous", [0.0, side, 0.0], [0.0, 0.1 * side, 0.0]);
        file.link(thigh, "continuous", [0.0, 1.0, 0.0], [0.0, 0.0, -0.3]);
    }
    file.end()
}

/// An arm of so many joints, the first about this axis.
fn arm(joints: usize, first: [f64; 3]) -> String {
    let mut file = File::new(100 + joints as u64);
    let mut link = file.link(0, "continuous", first, [0.0, 0.0, 0.2]);
    for joint in 1..joints {
        let axis = [[0.0, 1.0, 0.0], [0.0, 0.6, 0.8]][joint % 2];
        link = file.link(link, "continuous", axis, [0.1, 0.0, 0.3]);
    }
    file.end()
}

/// Two arms, each with a sliding wrist and a hand of three fingers.
fn hands() -> String {
    let mut file = File::new(77);
    for side in [1.0, -1.0] {
        let arm = file.link(0, "continuous", [0.0, 1.0, 0.0], [0.0, 0.3 * side, 0.1]);
        let wrist = file.link(arm, "prismatic", [1.0, 0.0, 0.0], [0.4, 0.0, 0.0]);
        for finger in 0..3 {
            file.link(wrist, "continuous", [0.0, 0.0, side], [0.1, 0.05 * f64::from(finger), 0.02]);
        }
    }
    file.end()
}

fn program<'c>(compiled: &'c Compiled<'_>, method: Method) -> Option<&'c Program> {
    let found = compiled.methods.iter().find(|compiled| compiled.method == method)?;
    match &found.plan {
        Plan::StraightLine { program, .. } => Some(program),
        _ => None,
    }
}

/// Every step is in one stage, after all that it reads, and branches are given what they read.
fn assert_stages_are_whole(program: &Program) {
    let mut is_done = vec![false; program.steps.len()];
    for stage in program.stages() {
        let given = match &stage {
            Stage::Trunk(_) => None,
            Stage::Branches(Branches { own, shared, .. }) => {
                let given: Vec<Source> = own.iter().chain(shared).map(|&(source, _)| source).collect();
                assert!(given.iter().filter_map(|source| source.step()).all(|step| is_done[step]));
                Some(given)
            }
        };
        let (Stage::Trunk(steps) | Stage::Branches(Branches { steps, .. })) = &stage;
        let first = is_done.clone();
        for &step in steps {
            for source in program.read_by(step) {
                let is_from_here = source.step().is_some_and(|read| is_done[read] && !first[read]);
                let is_at_hand = match (&given, source) {
                    (_, Source::Constant(_)) => true,
                    (Some(given), _) => is_from_here || given.contains(&source),
                    (None, _) => source.step().is_none_or(|read| is_done[read]),
                };
                assert!(is_at_hand, "step {step} reads {source:?}");
            }
            assert!(!std::mem::replace(&mut is_done[step], true), "step {step} is in two stages");
        }
    }
    assert!(is_done.into_iter().all(|is_done| is_done));
}

/// What `look` finds in the programs of a robot.
fn with_compiled<R>(text: &str, attributes: &str, look: impl FnOnce(&Compiled<'_>) -> R) -> R {
    let (graph, urdf) = (Graph::new(), Urdf { file: "robot.urdf", text });
    let spec = match read_urdf("Robot", urdf, attributes) {
        Ok((spec, _)) => spec,
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    };
    match checked(&spec, &graph, RunTime::Core) {
        Ok((_, compiled)) => look(&compiled),
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    }
}

/// The widest step of inverse dynamics, once every method was compared with what is computed one after the other.
fn lanes_of(text: &str, attributes: &str) -> usize {
    let urdf = Urdf { file: "robot.urdf", text };
    let spec = match read_urdf("Robot", urdf, attributes) {
        Ok((spec, _)) => spec,
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    };
    let (graph, plain_graph) = (Graph::new(), Graph::new());
    let of = |graph, run_time| match checked(&spec, graph, run_time) {
        Ok((_, compiled)) => compiled,
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    };
    // Each was compared with the plain recursion already.
    let (compiled, plain) = (of(&graph, RunTime::Core), of(&plain_graph, RunTime::None));
    let mut random = Random(5);
    let mut values: Vec<Vec<f64>> = (0..4).map(|_| (0..64).map(|_| random.next()).collect()).collect();
    // Half a turn is a unit quaternion.
    values[0][3..7].copy_from_slice(&[0.6, 0.0, 0.0, 0.8]);
    let read = |input| match input {
        Input::Argument(argument, k) => match argument {
            Argument::Q => values[0][k],
            Argument::V => values[1][k],
            Argument::A => values[2][k],
            Argument::Tau => values[3][k],
        },
        Input::Parameter(_) => unreachable!("there are none"),
    };
    for method in Method::OF_ROBOT {
        let (Some(one), Some(other)) = (program(&compiled, method), program(&plain, method)) else {
            continue;
        };
        assert_stages_are_whole(one);
        let (one, other) = (one.evaluate(read, &[]), other.evaluate(read, &[]));
        let size = other.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        for (a, b) in one.iter().zip(&other) {
            assert!((a - b).abs() <= ROUNDING * size, "{method:?}: {a} and {b}, of {size}");
        }
    }
    let steps = &program(&compiled, Method::InverseDynamics).expect("it is a straight line").steps;
    steps.iter().map(|step| step.lanes).max().unwrap_or(0)
}

#[test]
fn legs_of_any_number_are_computed_side_by_side() {
    for count in 2..=6 {
        assert_eq!(lanes_of(&legs(count), "#[dynamics(base = free)]"), count);
    }
}

#[test]
fn so_is_what_couples_two_legs_and_all_legs() {
    for count in 3..=6 {
        with_compiled(&legs(count), "#[dynamics(base = free)]", |compiled| {
            for method in [Method::InverseMassMatrix, Method::ForwardDynamicsDerivatives] {
                let program = program(compiled, method).expect("it is a straight line");
                let mut turns =
                    program.steps.iter().filter(|step| matches!(step.operation, Operation::Turn(..)));
                assert!(turns.any(|step| step.lanes == count), "{method:?} of {count} legs");
                let (together, alone) = (program.instructions(), program.one_by_one().instructions());
                assert!(2 * together < alone, "{method:?} of {count} legs: {together} of {alone}");
            }
        });
    }
}

/// The straight line of two arms is no longer than that of one: loops over fourteen links would take nine times as long.
#[test]
fn two_arms_are_as_short_as_one() {
    let mut file = File::new(14);
    for side in [-1.0, 1.0] {
        let mut parent = 0;
        for joint in 0..7 {
            let axis = if joint % 2 == 0 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
            let at = if joint == 0 { [0.0, side, 0.0] } else { [0.0, 0.0, 0.2] };
            parent = file.link(parent, "continuous", axis, at);
        }
    }
    with_compiled(&file.end(), "", |compiled| {
        for method in [Method::CoriolisMatrix, Method::EquationsOfMotion, Method::InverseDynamicsDerivatives]
        {
            let program = program(compiled, method).expect("it is a straight line");
            assert!(program.steps.iter().any(|step| step.lanes == 2), "{method:?}");
        }
    });
}

#[test]
fn legs_are_a_few_stretches_of_code() {
    with_compiled(&legs(4), "#[dynamics(base = free)]", |compiled| {
        let stretches = |method| {
            let stages = program(compiled, method).expect("it is a straight line").stages();
            stages.iter().filter(|stage| matches!(stage, Stage::Branches(_))).count()
        };
        // From the trunk to the feet and back; for accelerations the trunk's is passed on once more.
        for method in [Method::MassMatrix, Method::InverseDynamics, Method::InverseDynamicsDerivatives] {
            assert_eq!(stretches(method), 1, "{method:?}");
        }
        assert_eq!(stretches(Method::ForwardDynamics), 2);
        // What couples two legs reads what was computed of others.
        for method in [Method::InverseMassMatrix, Method::ForwardDynamicsDerivatives] {
            assert!((2..=4).contains(&stretches(method)), "{method:?}: {}", stretches(method));
        }
    });
}

#[test]
fn so_are_branches_with_branches_of_their_own() {
    assert_eq!(lanes_of(&hands(), ""), 2);
    assert_eq!(lanes_of(&hands(), "#[dynamics(base = free)]"), 2);
}

#[test]
fn a_joint_more_makes_a_branch_another_one() {
    let mut file = File::new(9);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let first = file.link(0, "continuous", axes[0], [0.0, 0.2, 0.0]);
    file.link(first, "continuous", axes[1], [0.0, 0.0, -0.3]);
    file.link(0, "continuous", axes[0], [0.0, -0.2, 0.0]);
    assert_eq!(lanes_of(&file.end(), ""), 1);
}

#[test]
fn joints_that_follow_others_are_left_alone() {
    let attributes = "#[dynamics(base = free)] #[joint(j4, mimic = j1)]";
    assert_eq!(lanes_of(&legs(2), attributes), 1);
}

#[test]
fn what_acts_in_one_branch_alone_is_zero_in_the_others() {
    let attributes = "#[dynamics(base = free)] #[joint(j2, stiffness = 3, rest = 0.2, damping = 0.3)]";
    assert_eq!(lanes_of(&legs(4), attributes), 4);
}

#[test]
fn fields_in_branches_are_prepared() {
    let (text, attributes) =
        (legs(4), "#[dynamics(base = free)] #[joint([j1, j4], damping = d, armature = 2 * rotor)]");
    let spec = match read_urdf_with(
        "Robot",
        &["d", "rotor"],
        Urdf { file: "robot.urdf", text: &text },
        attributes,
    ) {
        Ok((spec, _)) => spec,
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    };
    let graph = Graph::new();
    match checked(&spec, &graph, RunTime::Core) {
        Ok((_, compiled)) => {
            let program = program(&compiled, Method::InverseDynamics).expect("it is a straight line");
            assert!(program.has_lanes());
            assert_eq!(compiled.companion.fields.len(), 2, "the damping and the rotor's inertia");
        }
        Err(mistakes) => panic!("{}", mistakes.into_compile_errors()),
    }
}

#[test]
fn all_columns_that_an_arm_solves_for_are_one() {
    for joints in 5..=7 {
        // About the vertical nothing changes with the first joint: its column is zero.
        for (first, columns) in [([1.0, 0.0, 0.0], 2 * joints), ([0.0, 0.0, 1.0], 2 * joints - 1)] {
            let text = arm(joints, first);
            assert_eq!(lanes_of(&text, ""), 1);
            with_compiled(&text, "", |compiled| {
                for method in [Method::ForwardDynamicsDerivatives, Method::ForwardDynamicsWithDerivatives] {
                    let program = program(compiled, method).expect("it is a straight line");
                    let widest = program.steps.iter().map(|step| step.lanes).max();
                    assert_eq!(widest, Some(columns), "{method:?} of {joints} joints");
                    let stages = program.stages();
                    let stretches = stages.iter().filter(|stage| matches!(stage, Stage::Branches(_))).count();
                    assert_eq!(stretches, 1, "{method:?} of {joints} joints");
                }
            });
        }
    }
}

#[test]
fn so_are_those_of_joints_that_follow_others_and_of_springs_and_dampers() {
    let attributes = "#[joint(j7, mimic = j2)] #[joint(j3, stiffness = 3, damping = 0.2, armature = 0.1)]";
    assert_eq!(lanes_of(&arm(7, [1.0, 0.0, 0.0]), attributes), 1);
    with_compiled(&arm(7, [1.0, 0.0, 0.0]), attributes, |compiled| {
        let program = program(compiled, Method::ForwardDynamicsDerivatives).expect("it is a straight line");
        assert!(program.steps.iter().any(|step| step.lanes == 12));
    });
}

#[test]
fn of_a_few_joints_and_on_a_free_base_each_column_is_solved_for_alone() {
    for (text, attributes) in
        [(arm(4, [1.0, 0.0, 0.0]), ""), (arm(1, [1.0, 0.0, 0.0]), "#[dynamics(base = free)]")]
    {
        assert_eq!(lanes_of(&text, attributes), 1);
        with_compiled(&text, attributes, |compiled| {
            let program =
                program(compiled, Method::ForwardDynamicsDerivatives).expect("it is a straight line");
            assert!(!program.has_lanes());
        });
    }
}
