#!/usr/bin/env python3
"""How long the same instructions take in fewer and in more bytes: `encodings.py [PROGRAM]`, on x86-64 without AVX-512, with
gcc and binutils.

PROGRAM is `ours` of the race, which `peers/race.sh` builds, if no other is given. Of its straight lines the machine code is
taken apart and put together again: as it is; with addresses in all registers that are free, so that what lies within their
reach on the stack is found by a displacement of one byte instead of four; and with prefixes and displacements as long as they
can be. Each is timed at six places within a page, in turn, on one core, with random numbers for states, and must write the
same bytes. Prints COMPARE.md's table: bytes, and the least and the most nanoseconds that any place took.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
PROGRAM = Path(sys.argv[1] if len(sys.argv) > 1 else TARGET / "native/release/examples/ours").resolve()
METHODS = [
    ("iiwa14", "C", "coriolis_matrix"),
    ("chain4", "dID", "inverse_dynamics_derivatives"),
    ("puma560", "dFD", "forward_dynamics_derivatives"),
    ("iiwa14", "dID", "inverse_dynamics_derivatives"),
    ("iiwa14", "dFD", "forward_dynamics_derivatives"),
    ("chain4", "dFD", "forward_dynamics_derivatives"),
    ("hyq", "1/M", "inverse_mass_matrix"),
    ("hyq", "dID", "inverse_dynamics_derivatives"),
    ("hyq", "dFD", "forward_dynamics_derivatives"),
    ("chain16", "ID", "inverse_dynamics"),
    ("chain16", "M", "mass_matrix"),
    ("chain16", "FD", "forward_dynamics"),
    ("chain16", "1/M", "inverse_mass_matrix"),
    ("chain32", "ID", "inverse_dynamics"),
    ("chain32", "FD", "forward_dynamics"),
]
OFFSETS = [0, 16, 32, 48, 256, 1040]  # of the code in a page
CONSTANTS = 0x20000  # so much of the program, which begins at address zero, has all of them
SPARE = ["rbx", "rbp", "r8", "r9", "r10", "r11", "r13", "r14", "r15", "r12"]
ON_STACK = re.compile(r"(-?0x[0-9a-f]+)?\(%rsp\)")
MAIN = """
#include <stdio.h>
#include <string.h>
#include <time.h>
typedef void method(void *, const void *, const double *, const double *, const double *);
static unsigned char out[32768];
static double q[256][40], v[256][40], a[256][40];
static char robot[64];
static double random_number(void) {
    static unsigned long s = 2026;
    s = s * 6364136223846793005ul + 1442695040888963407ul;
    return (double)(s >> 12) / (double)(1ul << 51) - 1;
}
extern method %(names)s;
int main(void) {
    method *methods[] = {%(names)s};
    enum { COUNT = sizeof methods / sizeof *methods };
    double least[COUNT];
    for (int i = 0; i < 256; i++)
        for (int j = 0; j < 40; j++) { q[i][j] = 3 * random_number(); v[i][j] = random_number(); a[i][j] = random_number(); }
    for (int turn = 0; turn < 120; turn++)
        for (int k = 0; k < COUNT; k++) {
            struct timespec before, after;
            clock_gettime(CLOCK_MONOTONIC, &before);
            for (int i = 0; i < 256; i++) methods[k](out, robot, q[i], v[i], a[i]);
            clock_gettime(CLOCK_MONOTONIC, &after);
            double t = ((after.tv_sec - before.tv_sec) * 1e9 + after.tv_nsec - before.tv_nsec) / 256;
            if (turn == 0 || t < least[k]) least[k] = t;
        }
    for (int k = 0; k < COUNT; k++) {
        unsigned long hash = 14695981039346656037ul; /* of Fowler, Noll and Vo */
        for (int i = 0; i < 256; i++) {
            memset(out, 0xff, sizeof out);
            methods[k](out, robot, q[i], v[i], a[i]);
            for (unsigned j = 0; j < sizeof out; j++) hash = (hash ^ out[j]) * 1099511628211ul;
        }
        printf("%%.1f %%lx\\n", least[k], hash);
    }
}
"""


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def instructions_of(robot, method):
    """Of the method: assembler's lines, with constants at `RO` and what they are from there."""
    symbol = re.compile(rf"^(\w+) (\w+) t .*::{robot}::.*::{method}$", re.M)
    found = symbol.search(output_of("nm", "-S", "-C", PROGRAM))
    assert found, f"{PROGRAM} has no {method} of {robot}"
    address, size = (int(x, 16) for x in found.groups())
    listing = output_of("objdump", "-d", "--no-show-raw-insn", f"--start-address={address}", f"--stop-address={address + size}", PROGRAM)
    lines = []
    for text, constant in re.findall(r"^\s*[0-9a-f]+:\t([^#\n]*)(?:# ([0-9a-f]+))?", listing, re.M):
        assert int(constant or "0", 16) < CONSTANTS, f"a constant lies beyond {CONSTANTS:#x}: {text}"
        lines.append(re.sub(r"-?0x[0-9a-f]+\(%rip\)", f"RO+0x{constant}(%rip)", text.strip()))
    while not lines[-1].startswith("ret"):
        lines.pop()  # what fills up to the next function
    called = [line for line in lines if re.match(r"call|j", line)]
    assert not called, f"{robot}'s {method} is no straight line: {called[0]}"
    return lines


def in_few_bytes(lines):
    used = " ".join(lines)
    spare = [r for r in SPARE if not re.search(rf"%{r}[dwb]?\b", used)]
    framed = max((k for k, line in enumerate(lines) if re.match(r"sub +\$0x[0-9a-f]+,%rsp", line)), default=0)
    short = []
    for number, line in enumerate(lines):
        found = ON_STACK.search(line)
        offset = int(found[1] or "0", 16) if found else 0
        base = (offset + 128) // 256
        if number > framed and 1 <= base <= len(spare):
            line = ON_STACK.sub(f"{offset - 256 * base}(%{spare[base - 1]})", line)
        short.append(line)
        if number == framed:  # a large frame is made in steps
            short += [f"lea {256 * (k + 1)}(%rsp),%{register}" for k, register in enumerate(spare)]
    return short


def in_many_bytes(lines):
    def longer(line):
        wide = "{vex3} " if line.startswith("v") else ""
        return wide + ("{disp32} " if "(" in line and "%rip" not in line else "") + line

    return [longer(line) for line in lines]


def measured(robot, method):
    """Bytes, least and most nanoseconds of each of the three ways."""
    lines = instructions_of(robot, method)
    saved = ["rbx", "rbp", "r12", "r13", "r14", "r15"]
    text, names = f'.section .rodata\n.p2align 12\nRO: .incbin "{PROGRAM}",0,{CONSTANTS}\n.text\n', []
    for way, body in enumerate([lines, in_few_bytes(lines), in_many_bytes(lines)]):
        for offset in OFFSETS:
            name = f"way{way}_{offset}"
            names.append(name)
            pushed, popped = ("\n".join(f"{verb} %{r}" for r in order) for verb, order in [("push", saved), ("pop", saved[::-1])])
            text += f".globl {name}\n{name}:\n{pushed}\nsub $8,%rsp\ncall body_{name}\nadd $8,%rsp\n{popped}\nret\n"
            text += f".p2align 12\n.fill {offset}\nbody_{name}:\n" + "\n".join(body) + f"\n.size body_{name},.-body_{name}\n"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "ways.s").write_text(text + '.section .note.GNU-stack,"",@progbits\n')
        (Path(folder) / "main.c").write_text(MAIN % {"names": ", ".join(names)})
        program = f"{folder}/ways"
        output_of("gcc", "-O1", "-o", program, f"{folder}/main.c", f"{folder}/ways.s")
        sizes = [int(size, 16) for size in re.findall(r"^\w+ (\w+) t body_way\d_0$", output_of("nm", "-S", program), re.M)]
        results = [line.split() for line in output_of(program).splitlines()]
    assert len({written for _, written in results}) == 1, f"{robot}'s {method}: not all ways write the same"
    times = [float(time) for time, _ in results]
    count = len(OFFSETS)
    ways = [times[way * count : (way + 1) * count] for way in range(3)]
    return len(lines), [(size, min(way), max(way)) for size, way in zip(sizes, ways)]


def main():
    os.sched_setaffinity(0, {0})
    print("| robot | output | instructions | bytes | ns | in few bytes | ns | in many bytes | ns |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|")
    for robot, output, method in METHODS:
        count, ways = measured(robot, method)
        cells = " | ".join(f"{size} | {least:.0f} – {most:.0f}" for size, least, most in ways)
        print(f"| {robot} | {output} | {count} | {cells} |", flush=True)


main()
