"""The quadratic formula as it stands in books, in the precision of its arguments."""
import numpy as np


def answer(spheres, rays):
    """t of every ray and its sphere, +inf of a miss."""
    with np.errstate(all="ignore"):
        o, d, t_min, t_max = rays[:, :3], rays[:, 3:6], rays[:, 6], rays[:, 7]
        oc = o - spheres[:, :3]
        a = (d * d).sum(1)
        b = (oc * d).sum(1)
        c = (oc * oc).sum(1) - spheres[:, 3] * spheres[:, 3]
        root = np.sqrt(b * b - a * c)
        t = np.full(len(rays), np.inf, rays.dtype)
        for candidate in [(-b + root) / a, (-b - root) / a]:  # The last that counts is the first that is met.
            t = np.where((t_min <= candidate) & (candidate <= t_max) & np.isfinite(candidate), candidate, t)
        return t
