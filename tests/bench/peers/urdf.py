"""The peers' models as URDF, for ours: `python3 urdf.py MODEL…` writes ../robots/MODEL.urdf from models/MODEL.txt."""

import math
import sys

AXES = {"RX": "1 0 0", "RY": "0 1 0", "RZ": "0 0 1", "PX": "1 0 0", "PY": "0 1 0", "PZ": "0 0 1"}


def rpy(r):
    """Roll, pitch and yaw of a rotation matrix by rows: Rz(yaw) Ry(pitch) Rx(roll)."""
    return math.atan2(r[7], r[8]), math.atan2(-r[6], math.hypot(r[0], r[3])), math.atan2(r[3], r[0])


def numbers(values):
    return " ".join(repr(value) for value in values)


def convert(name):
    words = open(f"models/{name}.txt").read().split()
    count, words = int(words[0]), iter(words[1:])
    lines = [f'<robot name="{name}">']
    for _ in range(count - 1):
        index, parent, kind = int(next(words)), int(next(words)), next(words).removeprefix("JointModel")
        axis, rotation, position, mass, com, inertia = (
            [float(next(words)) for _ in range(size)] for size in (3, 9, 3, 1, 3, 9)
        )
        xx, xy, xz, _, yy, yz, _, _, zz = inertia
        lines += [
            f'  <link name="link{index}">',
            f'    <inertial><origin xyz="{numbers(com)}"/><mass value="{mass[0]!r}"/>',
            f'      <inertia ixx="{xx!r}" ixy="{xy!r}" ixz="{xz!r}" iyy="{yy!r}" iyz="{yz!r}" izz="{zz!r}"/></inertial>',
            "  </link>",
        ]
        if kind == "FreeFlyer":  # `base = free` says it
            continue
        carrier = "world" if parent == 0 else f"link{parent}"
        type_ = "prismatic" if kind.startswith("P") else "continuous"
        limit = '<limit lower="-9" upper="9" effort="9" velocity="9"/>' if type_ == "prismatic" else ""
        lines += [
            f'  <joint name="joint{index}" type="{type_}">',
            f'    <origin xyz="{numbers(position)}" rpy="{numbers(rpy(rotation))}"/>',
            f'    <parent link="{carrier}"/><child link="link{index}"/>',
            f'    <axis xyz="{AXES.get(kind) or numbers(axis)}"/>{limit}',
            "  </joint>",
        ]
        if carrier == "world" and '  <link name="world"/>' not in lines:
            lines.insert(1, '  <link name="world"/>')
    open(f"../robots/{name}.urdf", "w").write("\n".join([*lines, "</robot>", ""]))


for model in sys.argv[1:]:
    convert(model)
