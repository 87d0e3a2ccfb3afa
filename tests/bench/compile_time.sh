#!/usr/bin/env bash
# How long a user waits, as Markdown: `./compile_time.sh`; `| ./compare.sh compile` puts it into COMPARE.md.
#
# Crates with one robot, their dependencies built: the iiwa 14 with every method of the equations called, and with one
# output; a floating humanoid of forty joints with every method, and with forward dynamics alone. From each figure
# that of the same crate without a robot is taken, so that it is expansion, compilation and code to link, not the linker
# itself. Then the curve: chains of general joints, all outputs. `expansion` is the compiler alone, unoptimised as
# macros are.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
crate=$(mktemp -d)
trap 'rm -rf "$crate"' EXIT
export CARGO_TARGET_DIR=$crate/target
mkdir "$crate/src"
cat > "$crate/Cargo.toml" <<END
[package]
name = "one-robot"
version = "0.1.0"
edition = "2024"
[dependencies]
dynamics-core = { path = "$root/dynamics-core" }
[workspace]
END

milliseconds() { # of a command, the least of three; of one that takes long, once
    local best=999999 start end
    for _ in 1 2 3; do
        touch src/main.rs
        start=$(date +%s%N)
        "$@" > /dev/null
        end=$(date +%s%N)
        ((best = (end - start) / 1000000 < best ? (end - start) / 1000000 : best))
        if ((end - start > 3000000000)); then break; fi
    done
    echo "$best"
}

empty() { echo 'fn main() { println!("{}", dynamics_core::prelude::SVector::<f64, 7>::repeat(0.3)); }'; }

iiwa14() { # the attribute for its outputs, and what main calls
    echo 'use dynamics_core::prelude::*;'
    sed -n '/#\[derive(Dynamics/,/^\(pub \)\?struct Iiwa14;/p' "$root/examples/iiwa14.rs" | sed "s/^\(pub \)\?struct/$1\n&/"
    # Hidden from the optimiser, or else it would compute the results.
    echo 'fn main() { let [q, v, a] = std::hint::black_box([0.3, 0.2, 0.1].map(SVector::<f64, 7>::repeat)); let r = Iiwa14;'
    echo "$2 }"
}

all_methods='
    let mut sum = r.mass_matrix(&q)[3] + r.coriolis_matrix(&q, &v)[3] + r.gravity_forces(&q)[3];
    sum += r.bias_forces(&q, &v)[3] + r.inverse_dynamics(&q, &v, &a)[3] + r.forward_dynamics(&q, &v, &a)[3];
    sum += r.equations_of_motion(&q, &v).coriolis_matrix[3] + r.lagrangian(&q, &v);
    sum += r.inverse_dynamics_derivatives(&q, &v, &a).dtau_dq[3];
    sum += r.forward_dynamics_derivatives(&q, &v, &a).da_dq[3];
    println!("{sum}");'

humanoid() { # the attribute for its outputs
    echo 'use dynamics_core::prelude::*;'
    echo '#[derive(Dynamics)]'
    sed "s/^\(pub \)\?struct/$1\n&/" "$root/tests/robots/humanoid/robot.txt"
    # The quaternion of no rotation.
    echo 'fn main() { let mut q = SVector::<f64, 47>::zeros(); q[6] = 1.0; let q = std::hint::black_box(q);'
    echo 'println!("{}", Humanoid.forward_dynamics(&q, &SVector::repeat(0.2), &SVector::zeros())); }'
}

chain() { # so many joints in a row, twisted by no right angle
    echo "<robot name='chain'><link name='link0'/>"
    for k in $(seq "$1"); do
        echo "<link name='link$k'><inertial><origin xyz='0.01 -0.02 0.1' rpy='0 0.3 0'/><mass value='1.5'/>"
        echo "<inertia ixx='0.0123' ixy='1e-5' ixz='0' iyy='0.0234' iyz='0' izz='0.0198'/></inertial></link>"
        echo "<joint name='joint$k' type='continuous'><origin xyz='0 0.1 0.25' rpy='1.2 0.3 0'/>"
        echo "<parent link='link$((k - 1))'/><child link='link$k'/><axis xyz='0 0 1'/></joint>"
    done
    echo '</robot>'
}

use_of_chain() { # main with a chain of so many joints, forward dynamics called
    echo 'use dynamics_core::prelude::*;'
    echo '#[derive(Dynamics)] #[dynamics(urdf = "chain.urdf")] struct Chain;'
    echo "fn main() { let x = std::hint::black_box(SVector::<f64, $1>::repeat(0.3)); println!(\"{}\", Chain.forward_dynamics(&x, &x, &x)); }"
}

cd "$root"
cargo build --quiet --package dynamics-cli
dynamics=$CARGO_TARGET_DIR/debug/dynamics
cd "$crate"
profiles=(check build 'build --release')
declare -A base
empty > src/main.rs
for profile in "${profiles[@]}"; do
    cargo $profile --quiet
    base[$profile]=$(milliseconds cargo $profile --quiet)
done

row() { # its name
    printf '| %s |' "$1"
    for profile in "${profiles[@]}"; do
        printf ' %d |' $(($(milliseconds cargo $profile --quiet) - base[$profile]))
    done
    printf '\n'
}

printf 'Milliseconds beyond the crate without a robot, which takes %d, %d and %d:\n\n' "${base[check]}" "${base[build]}" "${base[build --release]}"
printf '| crate | `cargo check` | `cargo build` | `cargo build --release` |\n|---|--:|--:|--:|\n'
iiwa14 '' "$all_methods" > src/main.rs
row 'iiwa14, every method of the equations called'
for output in inverse_dynamics:'&q, &v, &a' mass_matrix:'&q' forward_dynamics:'&q, &v, &a'; do
    arguments=${output#*:}
    iiwa14 "#[dynamics(outputs(${output%:*}))]" "println!(\"{}\", r.${output%:*}($arguments)); let _ = (v, a);" > src/main.rs
    row "iiwa14, \`outputs(${output%:*})\`"
done
humanoid '' > src/main.rs
row 'humanoid, every method, forward dynamics called'
humanoid '#[dynamics(outputs(forward_dynamics))]' > src/main.rs
row 'humanoid, `outputs(forward_dynamics)`'

printf '\nChains of n general joints, every output:\n\n'
printf '| n | expansion, ms | lines | lines / n² | `cargo check`, s | `cargo build --release`, s |\n|--:|--:|--:|--:|--:|--:|\n'
for n in 2 4 8 16 32 64; do
    chain "$n" > chain.urdf
    use_of_chain "$n" > src/main.rs
    expansion=$(milliseconds "$dynamics" generate chain.urdf --lang rust --name Chain -o chain.rs)
    lines=$(wc -l < chain.rs)
    check=$(($(milliseconds cargo check --quiet) - base[check]))
    release=$(($(milliseconds cargo build --release --quiet) - base['build --release']))
    awk -v n="$n" -v e="$expansion" -v l="$lines" -v c="$check" -v r="$release" \
        'BEGIN { printf "| %d | %d | %d | %.1f | %.2f | %.2f |\n", n, e, l, l / n / n, c / 1000, r / 1000 }'
done
