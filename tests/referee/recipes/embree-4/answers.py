"""Embree 4.4, which the package embreex holds."""
import importlib.util
from pathlib import Path

import embree


def answer(spheres, rays):
    package = Path(importlib.util.find_spec("embreex").origin).parent
    library = next((package.parent / "embreex.libs").glob("libembree4*"))
    return embree.answer(library, 4, spheres, rays)
