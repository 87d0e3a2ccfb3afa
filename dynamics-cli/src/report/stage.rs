//! The robot as the page moves it: its linkage, what the reader takes hold of, and its swing.

use dynamics_codegen::model::{Link, Motion};
use dynamics_codegen::spatial;
use dynamics_core::Pose;
use dynamics_core::nalgebra::{SMatrix, SVector};
use dynamics_view::page::{Handle, HandleKind, Section, Stage};
use dynamics_view::{Body, Drive, Linkage, Measure, Mount};

use super::Subject;
use super::swing::Swing;
use crate::limits::limits;
use crate::picture::charts::parts;
use crate::picture::scene;
use crate::robot::{Robot, State};

/// Whether there is nothing to draw: no body has a place.
pub(super) fn is_empty(robot: &Robot<'_>) -> bool {
    robot.tree.frames.is_empty()
}

pub(super) fn section(robot: &Robot<'_>) -> Section {
    let section = Section::new("robot", "The robot");
    match is_empty(robot) {
        true => section.text(
            "There is nothing to draw: it has coordinates and energies, and no body with a place in the world.",
        ),
        false => section.robot(),
    }
}

pub(super) fn of(subject: &Subject<'_, '_>, swing: &Swing) -> Stage {
    let robot = subject.robot;
    let frames = swing.frames();
    let scene = scene::of(robot, subject.name.clone());
    Stage {
        linkage: linkage(robot),
        handles: handles(robot),
        start: subject.at.q.clone(),
        times: frames.iter().map(|moment| moment.time).collect(),
        motion: frames.iter().map(|moment| moment.state.q.clone()).collect(),
        charts: swing.charts(robot),
        tip: tip(&scene.bodies),
        scene,
    }
}

fn linkage(robot: &Robot<'_>) -> Linkage {
    let link = |link: &Link<f64>| dynamics_view::Link {
        parent: link.parent,
        placement: pose(&link.placement),
        drive: match link.motion {
            Motion::Revolute => Drive::Turn,
            Motion::Prismatic => Drive::Slide,
            Motion::Ball => Drive::Ball,
            Motion::Free => Drive::Free,
        },
        q: link.drive.q,
        ratio: link.drive.ratio,
        offset: link.drive.offset,
    };
    let mounts = robot.tree.frames.iter().map(|frame| Mount { link: frame.link, pose: pose(&frame.pose) });
    Linkage { links: robot.tree.links.iter().map(link).collect(), mounts: mounts.collect() }
}

fn pose(pose: &spatial::Pose<f64>) -> Pose<f64> {
    let spatial::Pose { rotation, translation } = pose;
    Pose { rotation: SMatrix::from_fn(|i, j| rotation.0[i][j]), translation: SVector::from(translation.0) }
}

/// All coordinates, in their order. What has no limits goes once around, or as far as the robot is large.
fn handles(robot: &Robot<'_>) -> Vec<Handle> {
    let size = size(robot);
    let parts = parts(robot);
    let single = parts.single.into_iter().map(|part| {
        let (kind, reach) = match part.measure {
            Measure::Angle => (HandleKind::Angle, std::f64::consts::PI),
            Measure::Distance => (HandleKind::Distance, size),
        };
        let [low, high] = limits(robot, part.q, part.v);
        let range = match (low.is_finite(), high.is_finite()) {
            (true, true) => [low, high],
            (true, false) => [low, low + 2.0 * reach],
            (false, true) => [high - 2.0 * reach, high],
            (false, false) => [-reach, reach],
        };
        Handle { name: part.name, q: part.q, kind, range }
    });
    let loose = parts.loose.into_iter().map(|joint| Handle {
        name: joint.name,
        q: joint.q,
        kind: if joint.is_free { HandleKind::Free } else { HandleKind::Ball },
        range: [-size, size],
    });
    let mut handles: Vec<Handle> = single.chain(loose).collect();
    handles.sort_by_key(|handle| handle.q);
    handles
}

/// A length that is round, and no less than the robot's at neutral.
fn size(robot: &Robot<'_>) -> f64 {
    let poses = scene::poses(robot, &State::neutral(robot).q);
    let reach = poses.iter().map(|pose| pose.translation.norm()).fold(0.0, f64::max);
    let reach = if reach > 0.0 { reach } else { 1.0 };
    let decade = 10_f64.powf(reach.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * decade).into_iter().find(|size| *size >= reach).unwrap_or(reach)
}

/// The body at the end of the longest chain; of several, the last.
fn tip(bodies: &[Body]) -> Option<String> {
    let depth = |mut k: usize| {
        let mut depth = 0;
        while let Some(parent) = bodies[k].parent.filter(|_| depth < bodies.len()) {
            (k, depth) = (parent, depth + 1);
        }
        depth
    };
    (0..bodies.len()).max_by_key(|k| depth(*k)).map(|k| bodies[k].name.clone())
}
