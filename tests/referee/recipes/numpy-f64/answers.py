"""A textbook in float64."""
import numpy as np
import textbook


def answer(spheres, rays):
    return textbook.answer(spheres.astype(np.float64), rays.astype(np.float64))
