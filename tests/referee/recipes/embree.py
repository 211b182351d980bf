"""Spheres of Embree 3 and 4 (RTC_GEOMETRY_TYPE_SPHERE_POINT) through their C interface."""
import ctypes as c

import numpy as np

POINTER = c.c_void_p
# FLT_LARGE of its source.
LARGEST = np.float32(1.844e18)


def answer(path, version, spheres, rays):
    """A scene of one sphere for every ray: t, +inf of a miss."""
    embree = c.CDLL(str(path))
    for name in ["rtcNewDevice", "rtcNewGeometry", "rtcNewScene"]:
        getattr(embree, name).restype = POINTER
    embree.rtcNewDevice.argtypes = [c.c_char_p]
    embree.rtcNewGeometry.argtypes = [POINTER, c.c_int]
    embree.rtcSetSharedGeometryBuffer.argtypes = [POINTER, c.c_int, c.c_uint, c.c_int, POINTER] + 3 * [c.c_size_t]
    embree.rtcNewScene.argtypes = [POINTER]
    embree.rtcAttachGeometry.argtypes = [POINTER, POINTER]
    for name in ["rtcCommitGeometry", "rtcReleaseGeometry", "rtcCommitScene", "rtcReleaseScene"]:
        getattr(embree, name).argtypes = [POINTER]
    device = embree.rtcNewDevice(b"threads=1")
    spheres = np.ascontiguousarray(spheres)
    # RTCRayHit: origin, tnear, direction, time, tfar, mask, id, flags, normal, u, v, primID, geomID, instID; 16-byte aligned.
    memory = c.create_string_buffer(256)
    start = c.addressof(memory) + -c.addressof(memory) % 16
    floats, words = (c.c_float * 24).from_address(start), (c.c_uint * 24).from_address(start)
    # RTCIntersectContext of Embree 3, which 4 has no need of.
    context = (c.c_uint * 8)(0, 0, 0, 0, 0xFFFFFFFF)
    embree.rtcIntersect1.argtypes = [POINTER, POINTER, POINTER]
    t = np.full(len(rays), np.inf, np.float32)
    for index in range(len(rays)):
        # It allows no others, and a build with assertions stops at them; so is Debian's Embree 3, which is asked for no more than
        # the ranges that `ray.valid()` lets pass.
        largest = LARGEST if version == 3 else np.finfo(np.float32).max
        if not (0 <= rays[index, 6] <= rays[index, 7] and (np.abs(rays[index, :6]) <= largest).all()):
            continue
        scene = embree.rtcNewScene(device)
        geometry = embree.rtcNewGeometry(device, 50)
        embree.rtcSetSharedGeometryBuffer(geometry, 1, 0, 0x9004, spheres[index].ctypes.data, 0, 16, 1)
        embree.rtcCommitGeometry(geometry)
        embree.rtcAttachGeometry(scene, geometry)
        embree.rtcReleaseGeometry(geometry)
        embree.rtcCommitScene(scene)
        ox, oy, oz, dx, dy, dz, near, far = map(float, rays[index])
        floats[0:9] = [ox, oy, oz, near, dx, dy, dz, 0.0, far]
        words[9:12] = [0xFFFFFFFF, 0, 0]
        words[17:20] = 3 * [0xFFFFFFFF]
        if version == 3:
            embree.rtcIntersect1(scene, c.addressof(context), start)
        else:
            embree.rtcIntersect1(scene, start, None)
        if words[18] != 0xFFFFFFFF and np.isfinite(floats[8]):
            t[index] = floats[8]
        embree.rtcReleaseScene(scene)
    return t
