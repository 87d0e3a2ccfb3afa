#!/bin/sh
# Steps a second, beside MuJoCo's on the same robot from the same file; fails if they do not end in the same states. Writes
# the table of COMPARE.md. Needs python3 with venv and pip.
set -e
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
[ -d .venv-mujoco ] || { python3 -m venv .venv-mujoco && .venv-mujoco/bin/pip -q install mujoco==4.0.0; }
RUSTFLAGS="" cargo build -q --release -p dynamics-cli
RUSTFLAGS="-C target-cpu=native" cargo build -q --release -p dynamics-cli -p dynamics-bench --bin dynamics --example rollouts --target-dir "$target/native"
mkdir -p "$target/rollouts"
[ "$1" != --build ] || exit 0
"$target/native/release/examples/rollouts" "$root/tests/robots/iiwa14/model.urdf" "$target/rollouts" \
    "$target/release/dynamics" "$target/native/release/dynamics" .venv-mujoco/bin/python mujoco_rollouts.py \
    > "$target/rollouts/table.md"
../compare.sh rollouts < "$target/rollouts/table.md"
