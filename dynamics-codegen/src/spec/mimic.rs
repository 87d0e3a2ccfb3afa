//! Joints that follow others: who leads, and who does not move since its leader does not.

use rustc_hash::FxHashMap;

use super::{JointKind, JointSpec};

/// The joint that each joint follows: its own leader, not the first of a chain. `None` of those that follow none, or
/// one that does not exist.
pub fn leaders(joints: &[JointSpec]) -> Vec<Option<usize>> {
    let mut by_name = FxHashMap::default();
    for (k, joint) in joints.iter().enumerate() {
        by_name.entry(&*joint.name.text).or_insert(k);
    }
    let leader = |joint: &JointSpec| by_name.get(&*joint.keys.mimic.as_ref()?.text).copied();
    joints.iter().map(leader).collect()
}

/// Whether each joint stands still: it is fixed or locked, or follows one that is. Those that follow each other in a
/// circle do not.
pub fn welded(joints: &[JointSpec]) -> Vec<bool> {
    let leaders = leaders(joints);
    let is_still = |k: usize| joints[k].kind == JointKind::Fixed || joints[k].keys.locked.is_some();
    let mut welded: Vec<Option<bool>> = vec![None; joints.len()];
    for start in 0..joints.len() {
        let (mut path, mut at) = (vec![], start);
        let still = loop {
            match (welded[at], leaders[at]) {
                (Some(known), _) => break known,
                _ if is_still(at) => break true,
                (None, Some(leader)) if path.len() <= joints.len() => {
                    path.push(at);
                    at = leader;
                }
                _ => break false,
            }
        };
        welded[at].get_or_insert(still);
        path.into_iter().for_each(|k| welded[k] = Some(still));
    }
    welded.into_iter().map(|known| known.unwrap_or(false)).collect()
}
