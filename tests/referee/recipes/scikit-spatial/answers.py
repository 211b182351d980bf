"""scikit-spatial: where a line meets a sphere, in float64; t by projection onto the line."""
import numpy as np
from skspatial.objects import Line, Sphere


def answer(spheres, rays):
    t = np.full(len(rays), np.inf)
    for index, (sphere, ray) in enumerate(zip(spheres.astype(np.float64), rays.astype(np.float64))):
        o, d = ray[:3], ray[3:6]
        try:
            points = Sphere(sphere[:3], sphere[3]).intersect_line(Line(o, d))
        except ValueError:  # So it says that they do not meet, or that it takes no such line or sphere.
            continue
        roots = sorted(np.dot(point - o, d) / np.dot(d, d) for point in points)
        t[index] = next((root for root in roots if ray[6] <= root <= ray[7] and np.isfinite(root)), np.inf)
    return t
