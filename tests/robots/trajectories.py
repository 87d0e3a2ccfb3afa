"""Motions of three robots, by two programs: writes tests/robots/<name>/trajectory.json.

Not by the methods of this workspace: `scipy` integrates equations of motion that are written here once more, from the
URDF, by Newton's and Euler's laws; `mujoco` has its own equations and its own Runge-Kutta method. Contacts, limits and
joint friction are off. Both must agree before anything is written.

    python3 -m venv venv && venv/bin/pip install numpy==2.* scipy==1.* mujoco==3.*
    venv/bin/python tests/robots/trajectories.py

Conventions: SI units, radians, gravity 9.81 along -z. Joints in the order of the file. A free body: the position of its
frame in the world, the quaternion i, j, k, w, then its twist in its own axes, linear before angular. There is no chance
in it, and so no seed.
"""

import json
import os
import xml.etree.ElementTree as ElementTree

import mujoco
import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

HERE = os.path.dirname(os.path.abspath(__file__))
GRAVITY = np.array([0.0, 0.0, -9.81])


def numbers(element, name, default):
    return np.array([float(x) for x in element.get(name, default).split()])


def pose(element):
    origin = element.find("origin")
    if origin is None:
        return np.eye(3), np.zeros(3)
    rpy = numbers(origin, "rpy", "0 0 0")
    return Rotation.from_euler("xyz", rpy).as_matrix(), numbers(origin, "xyz", "0 0 0")


def cross(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


class Arm:
    """A chain of revolute joints; fixed ones are joints that do not turn."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        bodies = {}
        for link in root.findall("link"):
            inertial = link.find("inertial")
            if inertial is None:
                bodies[link.get("name")] = (0.0, np.zeros(3), np.zeros((3, 3)))
                continue
            turned, com = pose(inertial)
            entry = {k: float(v) for k, v in inertial.find("inertia").attrib.items()}
            tensor = np.array(
                [
                    [entry["ixx"], entry["ixy"], entry["ixz"]],
                    [entry["ixy"], entry["iyy"], entry["iyz"]],
                    [entry["ixz"], entry["iyz"], entry["izz"]],
                ]
            )
            mass = float(inertial.find("mass").get("value"))
            bodies[link.get("name")] = (mass, com, turned @ tensor @ turned.T)
        joints = {joint.find("parent").get("link"): joint for joint in root.findall("joint")}
        children = {joint.find("child").get("link") for joint in joints.values()}
        (parent,) = [name for name in bodies if name not in children]
        self.links = []
        while parent in joints:
            joint = joints[parent]
            parent = joint.find("child").get("link")
            axis = None
            if joint.get("type") != "fixed":
                axis = numbers(joint.find("axis"), "xyz", "1 0 0")
            self.links.append((pose(joint), axis, bodies[parent]))
        self.n = sum(axis is not None for _, axis, _ in self.links)

    def forces(self, q, v, a, gravity):
        """The joint forces of a motion: Newton and Euler, all in world axes."""
        rotation, position = np.eye(3), np.zeros(3)
        omega, alpha, linear = np.zeros(3), np.zeros(3), -gravity
        outward, k = [], 0
        for (turned, offset), axis, (mass, com, tensor) in self.links:
            arm = rotation @ offset
            linear = linear + np.cross(alpha, arm) + np.cross(omega, np.cross(omega, arm))
            position = position + arm
            rotation = rotation @ turned
            world_axis = None
            if axis is not None:
                world_axis = rotation @ axis
                alpha = alpha + world_axis * a[k] + np.cross(omega, world_axis * v[k])
                omega = omega + world_axis * v[k]
                rotation = rotation @ Rotation.from_rotvec(axis * q[k]).as_matrix()
                k += 1
            center = rotation @ com
            inertia = rotation @ tensor @ rotation.T
            force = mass * (linear + np.cross(alpha, center) + np.cross(omega, np.cross(omega, center)))
            moment = inertia @ alpha + np.cross(omega, inertia @ omega)
            outward.append((position, world_axis, position + center, force, moment))
        tau, force, moment, at = [], np.zeros(3), np.zeros(3), np.zeros(3)
        for origin, axis, center, own, turning in reversed(outward):
            moment = moment + np.cross(at - origin, force) + np.cross(center - origin, own) + turning
            force, at = force + own, origin
            if axis is not None:
                tau.append(axis @ moment)
        return np.array(tau[::-1])

    def acceleration(self, q, v):
        zero = np.zeros(self.n)
        bias = self.forces(q, v, zero, GRAVITY)
        columns = [self.forces(q, zero, unit, np.zeros(3)) for unit in np.eye(self.n)]
        return np.linalg.solve(np.array(columns).T, -bias)

    def motion(self, q, v, times):
        def slope(_, x):
            return np.concatenate([x[self.n :], self.acceleration(x[: self.n], x[self.n :])])

        x = integrated(slope, np.concatenate([q, v]), times)
        return x[: self.n].T, x[self.n :].T


class Box:
    """A free body: Newton's law for its centre of mass, Euler's about it."""

    mass, com = 1.5, np.array([0.1, -0.05, 0.2])
    tensor = np.array([[0.04, 0.005, -0.003], [0.005, 0.05, 0.004], [-0.003, 0.004, 0.06]])

    def motion(self, q, v, times):
        turned = Rotation.from_quat(q[3:])
        omega = v[3:]
        center = q[:3] + turned.apply(self.com)
        speed = turned.apply(v[:3] + np.cross(omega, self.com))

        def slope(_, x):
            quaternion, omega = x[:4], x[4:]
            i, j, k, w = quaternion
            x, y, z = omega
            rate = [w * x + j * z - k * y, w * y + k * x - i * z, w * z + i * y - j * x, -i * x - j * y - k * z]
            spin = np.linalg.solve(self.tensor, -np.cross(omega, self.tensor @ omega))
            return np.concatenate([0.5 * np.array(rate), spin])

        x = integrated(slope, np.concatenate([turned.as_quat(), omega]), times)
        states = []
        for time, state in zip(times, x.T):
            turned, omega = Rotation.from_quat(state[:4]), state[4:]
            where = center + speed * time + 0.5 * GRAVITY * time**2 - turned.apply(self.com)
            along = turned.inv().apply(speed + GRAVITY * time) - np.cross(omega, self.com)
            states.append((np.concatenate([where, turned.as_quat()]), np.concatenate([along, omega])))
        return np.array([q for q, _ in states]), np.array([v for _, v in states])


def integrated(slope, start, times):
    solution = solve_ivp(
        slope, (0.0, times[-1]), start, method="DOP853", rtol=1e-13, atol=1e-13, t_eval=times
    )
    assert solution.success, solution.message
    return solution.y


def mujoco_arm(path):
    root = ElementTree.parse(path).getroot()
    for link in root.findall("link"):
        for name in ("visual", "collision"):
            for element in link.findall(name):
                link.remove(element)
    for joint in root.findall("joint"):
        for name in ("limit", "dynamics"):
            for element in joint.findall(name):
                joint.remove(element)
        if joint.get("type") == "revolute":
            joint.set("type", "continuous")
    extension = ElementTree.SubElement(root, "mujoco")
    ElementTree.SubElement(extension, "compiler", balanceinertia="false", fusestatic="true")
    return mujoco.MjModel.from_xml_string(ElementTree.tostring(root, encoding="unicode"))


def mujoco_box(box):
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = box.tensor
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><worldbody><body><freejoint/>
        <inertial pos="{' '.join(map(repr, box.com.tolist()))}" mass="{box.mass}"
        fullinertia="{xx} {yy} {zz} {xy} {xz} {yz}"/></body></worldbody></mujoco>"""
    )


def mujoco_motion(model, q, v, times, is_free):
    """Runge and Kutta at a step of 1/16384 s; of a free body MuJoCo's linear velocity is in world axes, w is first."""
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = 1.0 / 16384.0
    model.opt.gravity = GRAVITY
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    data = mujoco.MjData(model)
    if is_free:
        data.qpos = np.concatenate([q[:3], q[6:], q[3:6]])
        data.qvel = np.concatenate([Rotation.from_quat(q[3:]).apply(v[:3]), v[3:]])
    else:
        data.qpos, data.qvel = q, v
    steps, states = 0, []
    for time in times:
        while steps < round(time * 16384):
            mujoco.mj_step(model, data)
            steps += 1
        q, v = data.qpos.copy(), data.qvel.copy()
        if is_free:
            q = np.concatenate([q[:3], q[4:], q[3:4]])
            v = np.concatenate([Rotation.from_quat(q[3:]).inv().apply(v[:3]), v[3:]])
        states.append((q, v))
    return np.array([q for q, _ in states]), np.array([v for _, v in states])


def write(name, motion, model, q, v, times, is_free=False):
    q, v, times = np.array(q), np.array(v), np.array(times)
    if is_free:
        q[3:] /= np.linalg.norm(q[3:])
    by_scipy = motion.motion(q, v, times)
    by_mujoco = mujoco_motion(model, q, v, times, is_free)
    if is_free:
        for mine, theirs in zip(by_scipy[0], by_mujoco[0]):
            theirs[3:] *= np.sign(mine[3:] @ theirs[3:])
    apart = max(np.abs(a - b).max() for a, b in zip(by_scipy, by_mujoco))
    print(f"{name}: scipy and mujoco are {apart:.1e} apart")
    assert apart < 1e-9
    listed = lambda motion: [{"q": q.tolist(), "v": v.tolist()} for q, v in zip(*motion)]
    reference = {
        "robot": name,
        "generator": "tests/robots/trajectories.py",
        "times": times.tolist(),
        "start": {"q": q.tolist(), "v": v.tolist()},
        "scipy": {"version": scipy.__version__, "method": "DOP853, 1e-13", "states": listed(by_scipy)},
        "mujoco": {"version": mujoco.__version__, "method": "RK4, 1/16384 s", "states": listed(by_mujoco)},
    }
    os.makedirs(os.path.join(HERE, name), exist_ok=True)
    with open(os.path.join(HERE, name, "trajectory.json"), "w") as file:
        file.write(json.dumps(reference, separators=(",", ":")).replace('{"q"', '\n{"q"') + "\n")


def main():
    for name, q, v, times in [
        ("double_pendulum", [0.4, -0.3], [1.0, -2.0], [0.25, 0.5, 1.0]),
        (
            "iiwa14",
            [0.3, 0.6, -0.2, -1.1, 0.4, 0.8, -0.5],
            [0.5, -0.3, 0.7, 0.2, -0.9, 1.1, 2.0],
            [0.125, 0.25, 0.5],
        ),
    ]:
        path = os.path.join(HERE, name, "model.urdf")
        write(name, Arm(path), mujoco_arm(path), q, v, times)
    start = [0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5], [1.0, -2.0, 4.0, 2.0, 5.0, -3.0]
    write("free_box", Box(), mujoco_box(Box()), *start, [0.25, 0.5, 1.0], is_free=True)


if __name__ == "__main__":
    main()
