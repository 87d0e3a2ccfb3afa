"""MuJoCo in the race of rollouts: steps a second, and where they end.

mujoco_rollouts.py URDF STARTS.csv STEPS STEP THREADS: STARTS.csv has columns `start.q.JOINT` and `start.v.JOINT`. Prints
lines of tabs: `rate`, method, threads, steps a second; and `end`, method, rollout, coordinates, speeds.

The robot is the file's, with gravity, and without contacts, limits and sensors: mj_step computes what moves, and nothing
else. `RK4` is the classical method of Runge and Kutta; `Euler` the semi-implicit one, which without damping is v += h a,
q += h v.
"""

import csv
import sys
import time

import mujoco
import numpy as np
from mujoco import rollout

TURNS = 5


def main():
    urdf, starts, steps, step, threads = sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]), int(sys.argv[5])
    spec = mujoco.MjSpec.from_file(urdf)
    spec.compiler.fusestatic = False
    spec.compiler.balanceinertia = False
    model = spec.compile()
    model.opt.timestep = step
    model.opt.gravity[:] = [0, 0, -9.81]
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_SENSOR | mujoco.mjtDisableBit.mjDSBL_WARMSTART
    assert model.ngeom == 0 and model.neq == 0 and not model.dof_damping.any() and not model.dof_armature.any()
    joints = [model.joint(k).name for k in range(model.njnt)]
    with open(starts) as file:
        rows = [row for row in csv.DictReader(file) if float(row["time"]) == 0]
    state = [[0.0] + [float(row[f"start.{x}.{joint}"]) for x in "qv" for joint in joints] for row in rows]
    state = np.array(state)
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    assert mujoco.mj_stateSize(model, kind) == state.shape[1]

    for name, method in [("RK4", mujoco.mjtIntegrator.mjINT_RK4), ("Euler", mujoco.mjtIntegrator.mjINT_EULER)]:
        model.opt.integrator = method
        # One after another, in one loop of C a rollout.
        data = mujoco.MjData(model)
        best, ends = np.inf, None
        for _ in range(TURNS):
            here = []
            begun = time.perf_counter()
            for start in state:
                mujoco.mj_setState(model, data, start, kind)
                mujoco.mj_step(model, data, steps)
                here.append(np.concatenate([data.qpos, data.qvel]))
            best = min(best, time.perf_counter() - begun)
            ends = here
        print("rate", name, 1, len(state) * steps / best, sep="\t")
        for k, end in enumerate(ends):
            print("end", name, k, *(repr(float(x)) for x in end), sep="\t")
        # On all threads, by its own module for that.
        datas = [mujoco.MjData(model) for _ in range(threads)]
        with rollout.Rollout(nthread=threads) as pool:
            best = np.inf
            for _ in range(TURNS):
                begun = time.perf_counter()
                pool.rollout(model, datas, state, nstep=steps)
                best = min(best, time.perf_counter() - begun)
        print("rate", name, threads, len(state) * steps / best, sep="\t")


main()
