"""MuJoCo, a ray against a geom of the type sphere, in float64."""
import mujoco
import numpy as np


def answer(spheres, rays):
    t = np.full(len(rays), np.inf)
    turn = np.eye(3).ravel()
    for index, (sphere, ray) in enumerate(zip(spheres.astype(np.float64), rays.astype(np.float64))):
        size = np.full(3, sphere[3])
        found = mujoco.mju_rayGeom(sphere[:3], turn, size, ray[:3], ray[3:6], mujoco.mjtGeom.mjGEOM_SPHERE, None)
        # It has no end of the interval.
        if 0 <= found <= ray[7]:
            t[index] = found
    return t
