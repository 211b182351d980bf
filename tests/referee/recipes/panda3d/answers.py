"""Panda3D: a CollisionRay against a CollisionSphere; t by projection of the point onto the ray."""
import numpy as np
from panda3d import core


def answer(spheres, rays):
    t = np.full(len(rays), np.inf, np.float32)
    for index, (sphere, ray) in enumerate(zip(spheres, rays)):
        x, y, z, r = map(float, sphere)
        numbers = list(map(float, ray))
        try:
            root = core.NodePath("root")
            node = core.CollisionNode("sphere")
            node.add_solid(core.CollisionSphere(x, y, z, r))
            root.attach_new_node(node)
            from_node = core.CollisionNode("ray")
            from_node.set_into_collide_mask(core.BitMask32.all_off())
            from_node.add_solid(core.CollisionRay(*numbers[:6]))
            path = root.attach_new_node(from_node)
            traverser, queue = core.CollisionTraverser(), core.CollisionHandlerQueue()
            traverser.add_collider(path, queue)
            traverser.traverse(root)
        except AssertionError:  # So it says that it takes no such ray or sphere, and that a number of its own is NaN.
            continue
        if queue.get_num_entries() > 0:
            point = np.array(queue.get_entry(0).get_surface_point(root), np.float64)
            o, d = np.float64(ray[:3]), np.float64(ray[3:6])
            found = np.dot(point - o, d) / np.dot(d, d)
            if np.isfinite(found) and found <= ray[7]:
                t[index] = max(found, 0)
    return t
