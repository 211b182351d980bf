"""raylib: GetRayCollisionSphere."""
import numpy as np
from raylib import ffi, rl


def answer(spheres, rays):
    t = np.full(len(rays), np.inf, np.float32)
    ray, center = ffi.new("Ray *"), ffi.new("Vector3 *")
    for index, (sphere, numbers) in enumerate(zip(spheres.tolist(), rays.tolist())):
        center.x, center.y, center.z, radius = sphere
        place, direction = ray.position, ray.direction
        place.x, place.y, place.z, direction.x, direction.y, direction.z = numbers[:6]
        found = rl.GetRayCollisionSphere(ray[0], center[0], radius)
        # It has no end of the interval.
        if found.hit and np.isfinite(found.distance) and found.distance <= numbers[7]:
            t[index] = found.distance
    return t
