//! The robot of a file as it is drawn.

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::mechanics::plain::{Oracle, Rows};
use dynamics_codegen::spatial;
use dynamics_codegen::spec::JointSpec;
use dynamics_core::Pose;
use dynamics_core::nalgebra::{SMatrix, SVector};
use dynamics_view::{Body, Joint, Placed, Scene};

use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::robot::{Robot, State};

/// Whether there is a frame of this name.
pub(super) fn check(name: &str, robot: &Robot<'_>) -> Result<(), Failure> {
    let names = || robot.tree.frames.iter().map(|frame| frame.name.as_str());
    if names().any(|known| known == name) {
        return Ok(());
    }
    let problem = Problem::new(format!("there is no frame `{}`", shown(name)));
    let help = match did_you_mean(name, names()) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => "give the name of a link".to_owned(),
    };
    Err(problem.help(help).into())
}

/// The bodies, with the joints that carry them and their masses.
pub(crate) fn of(robot: &Robot<'_>, name: String) -> Scene {
    let neutral = State::neutral(robot).q;
    let oracle = Oracle::new(&robot.tree);
    let poses = poses(robot, &neutral);
    let placed: Vec<Placed> = poses
        .into_iter()
        .enumerate()
        .map(|(frame, pose)| Placed {
            pose,
            jacobian: columns(&oracle.body_jacobian(frame, &neutral), robot.dof()),
        })
        .collect();
    let world = Placed::world(robot.dof());
    let at = |name: &str| robot.tree.frames.iter().position(|frame| frame.name == name);
    let bodies = robot.tree.frames.iter().zip(&placed).enumerate().map(|(k, (frame, place))| {
        let joint = robot.spec.joints.iter().find(|joint| joint.child.text == frame.name);
        let parent = joint.and_then(|joint| at(&joint.parent.text));
        let motions = place.motions_against(parent.map_or(&world, |parent| &placed[parent]));
        let joint = joint.filter(|_| !motions.is_empty()).map(|joint| Joint {
            name: joint.name.text.clone(),
            kind: kind(joint),
            motions: motions.into_iter().map(|(_, motion)| motion).collect(),
        });
        let (mass, com, inertia) = mass(robot, k).unwrap_or_default();
        Body { name: frame.name.clone(), parent, joint: joint.unwrap_or_default(), mass, com, inertia }
    });
    Scene { name, bodies: bodies.collect() }
}

/// The poses of all bodies.
pub(crate) fn poses(robot: &Robot<'_>, q: &[f64]) -> Vec<Pose<f64>> {
    let oracle = Oracle::new(&robot.tree);
    let pose = |frame| {
        let spatial::Pose { rotation, translation } = oracle.pose(frame, q);
        Pose {
            rotation: SMatrix::from_fn(|i, j| rotation.0[i][j]),
            translation: SVector::from(translation.0),
        }
    };
    (0..robot.tree.frames.len()).map(pose).collect()
}

fn columns(rows: &Rows, dof: usize) -> Vec<[f64; 6]> {
    (0..dof).map(|column| std::array::from_fn(|row| rows[row][column])).collect()
}

fn kind(joint: &JointSpec) -> String {
    let kind = joint.kind.name();
    match &joint.keys.mimic {
        Some(leader) => format!("{kind}, follows {leader}"),
        None => kind.to_owned(),
    }
}

/// Mass, centre of mass and inertia about it of all that moves with a body, at the one that its joint carries.
fn mass(robot: &Robot<'_>, frame: usize) -> Option<(f64, [f64; 3], [[f64; 3]; 3])> {
    let link = robot.model.links.iter().position(|link| link.body == Some(frame))?;
    let seen = robot.tree.links[link].inertia.transformed(robot.tree.frames[frame].pose.inverse());
    if seen.mass <= 0.0 {
        return None;
    }
    let com = seen.first.scale(1.0 / seen.mass);
    let [x, y, z] = com.0;
    let about = seen.rotational();
    let steiner = |a: f64, b: f64| seen.mass * (a * a + b * b);
    let (xx, yy, zz) = (about.xx - steiner(y, z), about.yy - steiner(x, z), about.zz - steiner(x, y));
    let (xy, xz, yz) =
        (about.xy + seen.mass * x * y, about.xz + seen.mass * x * z, about.yz + seen.mass * y * z);
    Some((seen.mass, com.0, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
}
