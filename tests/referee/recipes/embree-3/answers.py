"""Embree 3, if the system has it (Debian: libembree3-3)."""
import embree


def answer(spheres, rays):
    return embree.answer("libembree3.so.3", 3, spheres, rays)
