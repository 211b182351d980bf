"""Compares what the program reads of other people's files with what gemmi and MDAnalysis read of them.

    python -m venv readers && readers/bin/pip install gemmi MDAnalysis MDAnalysisTests
    cargo build --release -p spherule --example positions
    readers/bin/python tests/readers/compare.py [--list]

The files are those of two test collections, and are fetched into tests/readers/fetched, which git ignores: biopython's
source distribution (Biopython License Agreement or BSD 3-Clause; its structures are from the PDB, which are in the public
domain, CC0) and MDAnalysisTests (GPL-2.0-or-later). None of them is part of this repository.

A file counts as opened and agreed where the positions of its first frame, and of its last if there are several, are
the same, bit for bit, after rounding to f32: of PDB and mmCIF with gemmi, of the others with MDAnalysis. Of alternate
locations, both sides take the first of an atom of a residue. Prints a line a file that differs or is refused.
"""

import collections
import glob
import os
import re
import subprocess
import sys
import tarfile
import warnings

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
FETCHED = os.path.join(HERE, "fetched")
PROGRAM = os.path.join(HERE, "..", "..", "target", "release", "examples", "positions")
ENDINGS = {
    "pdb": "pdb", "ent": "pdb", "cif": "cif", "xyz": "xyz", "gro": "gro", "xtc": "xtc",
    "lammpsdump": "dump", "lammpstrj": "dump", "dump": "dump", "data": "data", "lmp": "data",
}


def fetch():
    """The folder of biopython's tests."""
    os.makedirs(FETCHED, exist_ok=True)
    found = glob.glob(os.path.join(FETCHED, "biopython-*", "Tests"))
    if not found:
        command = [sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--no-binary", ":all:", "biopython", "-d", FETCHED]
        subprocess.run(command, check=True)
        for archive in glob.glob(os.path.join(FETCHED, "biopython-*.tar.gz")):
            with tarfile.open(archive) as tar:
                tar.extractall(FETCHED, filter="data")
        found = glob.glob(os.path.join(FETCHED, "biopython-*", "Tests"))
    return found[0]


def files():
    """Structure and particle files of the supported formats, and which format each is."""
    import MDAnalysisTests

    folders = [fetch(), os.path.dirname(MDAnalysisTests.__file__)]
    for folder in folders:
        for path in sorted(glob.glob(os.path.join(folder, "**", "*"), recursive=True)):
            name = re.sub(r"\.(gz|bz2)$", "", os.path.basename(path).lower())
            ending = name.rsplit(".", 1)[-1]
            if ending in ENDINGS and os.path.isfile(path):
                yield path, ENDINGS[ending]


def ours(path, frame, topology=None):
    words = [PROGRAM, path, str(frame)] + ([topology] if topology else [])
    run = subprocess.run(words, capture_output=True)
    if run.returncode != 0:
        return None, run.stderr.decode().strip()
    return np.frombuffer(run.stdout, "<f4").reshape(-1, 3), run.stderr.decode().strip()


def by_gemmi(path):
    """Positions a model."""
    import gemmi

    if re.search(r"\.cif(\.gz)?$", path):
        structure = gemmi.make_structure_from_block(gemmi.cif.read(path)[0])
    else:
        structure = gemmi.read_pdb(path)
    models = []
    for model in structure:
        # In the order of the file, which gemmi leaves where chains or residues are split.
        rows = []
        for chain in model:
            for residue in chain:
                for atom in residue:
                    key = (chain.name, str(residue.seqid), atom.name)
                    rows.append((atom.serial, key, atom.altloc, atom.pos.tolist()))
        models.append(rows)
    return models


def first_locations(rows):
    seen, kept = set(), []
    for _, key, location, position in rows:
        if location != "\0":
            if key in seen:
                continue
            seen.add(key)
        kept.append(position)
    return np.array(kept, "f8").reshape(-1, 3).astype("f4")


def by_mdanalysis(path, kind):
    """Positions a frame, of the first and the last."""
    import MDAnalysis as mda
    from MDAnalysis.lib.util import anyopen
    from MDAnalysis.coordinates.core import get_reader_for

    if kind == "data":
        universe = mda.Universe(path, format="DATA", atom_style=None) if False else mda.Universe(path, format="DATA")
        return [universe.atoms.positions.copy()]
    formats = {"xyz": "XYZ", "gro": "GRO", "xtc": "XTC", "dump": "LAMMPSDUMP"}
    reader = get_reader_for(path, format=formats[kind])(path)
    result = [reader[0].positions.copy()]
    if reader.n_frames > 1:
        result.append((reader.n_frames - 1, reader[reader.n_frames - 1].positions.copy()))
    reader.close()
    return result


def same(one, two):
    one, two = np.ascontiguousarray(one, "f4"), np.ascontiguousarray(two, "f4")
    if one.shape != two.shape:
        return False
    if np.array_equal(one, two):
        return True
    # Readers that group atoms by chain have them in another order.
    order = lambda points: points[np.lexsort(points.T)]
    return np.array_equal(order(one), order(two))


def judge(path, kind):
    mine, why = ours(path, 0)
    if kind in ("pdb", "cif"):
        try:
            models = by_gemmi(path)
            theirs = [(at, first_locations(rows)) for at, rows in enumerate(models) if rows]
        except Exception as error:
            return "unread" if mine is None else "alone", f"gemmi: {error}; ours: {why}"
    else:
        try:
            read = by_mdanalysis(path, kind)
            theirs = [(0, read[0])] + read[1:]
        except Exception as error:
            return "unread" if mine is None else "alone", f"MDAnalysis: {str(error)[:100]}; ours: {why}"
    if not theirs:
        return "unread" if mine is None else "alone", f"no atoms by gemmi; ours: {why}"
    if mine is None:
        return "refused", why
    if not same(mine, theirs[0][1]):
        return "differs", f"{mine.shape[0]} against {theirs[0][1].shape[0]}: {mine[:1]} {theirs[0][1][:1]}"
    if len(theirs) > 1:
        at = len(theirs) - 1 if kind in ("pdb", "cif") else theirs[-1][0]
        mine, why = ours(path, at)
        if mine is None or not same(mine, theirs[-1][1]):
            return "differs", f"frame {at}: {why}"
    return "agrees", why


def main():
    warnings.simplefilter("ignore")
    counts = collections.Counter()
    for path, kind in files():
        verdict, why = judge(path, kind)
        counts[verdict] += 1
        counts[kind, verdict] += 1
        if verdict != "agrees" or "--list" in sys.argv:
            print(f"{verdict:8} {kind:5} {os.path.basename(path)}: {why[:300]}", flush=True)
    read = sum(counts[verdict] for verdict in ("agrees", "differs", "refused"))
    print(f"{counts['agrees']} of {read} files that the other reader reads agree: {100 * counts['agrees'] / read:.1f} %")
    for key, count in sorted((key, count) for key, count in counts.items() if isinstance(key, tuple)):
        print(*key, count)


main()
