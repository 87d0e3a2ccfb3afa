//! No method of a generated robot, no step of a simulation and no linearisation touches the heap.

use allocation_counter::measure;
use dynamics_core::Scalar;
use dynamics_tests::zoo;
use dynamics_tests::{Dual, Forms, Robot, State};

#[test]
fn the_counter_counts() {
    let info = measure(|| {
        std::hint::black_box(vec![1.0; 3]);
    });
    assert_eq!(info.count_total, 1);
}

fn allocates_nothing<T: Scalar>(name: &str, robot: &dyn Robot<T>, [q, v, a]: [&[T]; 3]) {
    let mut sum = None;
    let info = measure(|| sum = Some(robot.everything_on_the_stack(q, v, a, 4)));
    let sum = sum.expect("the closure has run");
    assert!(sum.is_ok_and(Scalar::is_finite), "{name}: {sum:?}");
    assert_eq!(info.count_total, 0, "{name} allocates {} bytes", info.bytes_total);
}

#[test]
fn nothing_at_run_time_touches_the_heap() {
    for mut entry in zoo::all() {
        let name = entry.name;
        // At rest under small forces, so that the light wrists stay in the finite.
        let State { q, v, a, .. } = &entry.states(1)[0];
        let (v, a) = (v * 1e-3, a * 1e-3);
        if let Some(Forms { robot, prepared }) = entry.double.take() {
            let state = [q.as_slice(), v.as_slice(), a.as_slice()];
            allocates_nothing(name, &*robot, state);
            allocates_nothing(name, &*prepared, state);
        }
        if let Some(Forms { robot, prepared }) = entry.single.take() {
            let [q, v, a] = [q, &v, &a].map(|x| x.map(|x| x as f32));
            let state = [q.as_slice(), v.as_slice(), a.as_slice()];
            allocates_nothing(name, &*robot, state);
            allocates_nothing(name, &*prepared, state);
        }
        if let Some(Forms { robot, prepared }) = entry.dual.take() {
            let [q, v, a] = [q, &v, &a].map(Dual::resting);
            let state = [q.as_slice(), v.as_slice(), a.as_slice()];
            allocates_nothing(name, &*robot, state);
            allocates_nothing(name, &*prepared, state);
        }
    }
}
