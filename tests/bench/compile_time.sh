#!/bin/sh
# How long a user's crate with one robot takes to check and to build, its dependencies built: `./compile_time.sh` for
# the iiwa 14 of the examples, where main calls every method of the equations; `./compile_time.sh humanoid` for a
# floating humanoid of forty joints, of which forward dynamics is called. Expansion is part of it.
set -e
root=$(cd "$(dirname "$0")/../.." && pwd)
crate=$(mktemp -d)
trap 'rm -rf "$crate"' EXIT
mkdir "$crate/src"
cat > "$crate/Cargo.toml" <<END
[package]
name = "one-iiwa14"
version = "0.1.0"
edition = "2024"
[dependencies]
dynamics-core = { path = "$root/dynamics-core" }
[workspace]
END
(
    echo 'use dynamics_core::prelude::*;'
    if [ "$1" = humanoid ]; then
        echo '#[derive(Dynamics)]'
        cat "$root/tests/robots/humanoid/robot.txt"
        cat <<END
fn main() {
    let (q, v): (SVector<f64, 47>, _) = (Humanoid.neutral(), SVector::repeat(0.2));
    println!("{}", Humanoid.forward_dynamics(&q, &v, &SVector::zeros()));
}
END
        exit
    fi
    sed -n '/#\[derive(Dynamics/,/^\(pub \)\?struct Iiwa14;/p' "$root/examples/iiwa14.rs"
    cat <<END
fn main() {
    let (q, v, a) = (SVector::<f64, 7>::repeat(0.3), SVector::repeat(0.2), SVector::repeat(0.1));
    let r = Iiwa14;
    let mut sum = r.mass_matrix(&q)[3] + r.coriolis_matrix(&q, &v)[3] + r.gravity_forces(&q)[3];
    sum += r.bias_forces(&q, &v)[3] + r.inverse_dynamics(&q, &v, &a)[3] + r.forward_dynamics(&q, &v, &a)[3];
    sum += r.equations_of_motion(&q, &v).coriolis_matrix[3] + r.lagrangian(&q, &v);
    sum += r.inverse_dynamics_derivatives(&q, &v, &a).dtau_dq[3];
    sum += r.forward_dynamics_derivatives(&q, &v, &a).da_dq[3];
    println!("{sum}");
}
END
) > "$crate/src/main.rs"
cd "$crate"
for command in check build 'build --release'; do
    cargo $command --quiet
    touch src/main.rs
    start=$(date +%s%N)
    cargo $command --quiet
    end=$(date +%s%N)
    printf 'cargo %-16s %5d ms\n' "$command" $(((end - start) / 1000000))
done
