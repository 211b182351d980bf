"""Asks one recipe: answers_of.py FOLDER SPHERES RAYS T; prints the seconds that it took."""
import importlib.util
import sys
import time
from pathlib import Path

import numpy as np

folder, spheres, rays, t = map(Path, sys.argv[1:])
sys.path.insert(0, str(folder.parent))
spec = importlib.util.spec_from_file_location("answers", folder / "answers.py")
answers = importlib.util.module_from_spec(spec)
spec.loader.exec_module(answers)
spheres, rays = np.load(spheres), np.load(rays)
answers.answer(spheres[:64], rays[:64])
start = time.perf_counter()
found = answers.answer(spheres, rays)
seconds = time.perf_counter() - start
np.save(t, found)
print(f"\n{seconds}")
