"""What the tests of the second opinion share: both programs in a folder, and files that the program could have written.
Whoever imports it is called with the program and the source folder: sys.argv is CLUES SOURCES."""
import contextlib
import importlib.util
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from fractions import Fraction

CLUES, SOURCES = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
SCRIPT = SOURCES / "validate" / "second_opinion" / "second_opinion.py"
FOUND = SOURCES / "tests" / "differential" / "found"
spec = importlib.util.spec_from_file_location("second_opinion", SCRIPT)
second_opinion = importlib.util.module_from_spec(spec)
spec.loader.exec_module(second_opinion)

SCREENS = """OFF
13 5 0
-20 -20 4\n20 -20 4\n20 20 4\n-20 20 4\n-6 -4 2\n6 -4 2\n0 8 2\n-0.5 -0.5 2.25\n0.5 -0.5 2.25\n0 0.5 2.25\n9 0 2\n10 0 2\n9 1 2
3 0 2 1\n3 0 3 2\n3 4 6 5\n3 7 9 8\n3 10 12 11
"""
CELL = "box:-0.25,-0.25,-0.25,0.25,0.25,0"
BLIND = "sh -c ': > {pvs}'"


class Folder(unittest.TestCase):
    """A folder for each test, and both programs run in it."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def clues(self, *arguments, out=None, codes=(0,)):
        ran = subprocess.run([CLUES, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertIn(ran.returncode, codes, f"{arguments}: {ran.stdout[-500:]}{ran.stderr[-500:]}")
        if out:
            self.write(out, ran.stdout)
        return ran.returncode

    def opinion(self, *arguments):
        """Exit code and output; in this process, as starting Python takes longer than most of this."""
        out = io.StringIO()
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out), contextlib.chdir(self.folder):
                code = second_opinion.main([str(a) for a in arguments])
        except SystemExit as e:
            code = e.code
        return code, out.getvalue()

    def accept(self, *arguments):
        code, text = self.opinion(*arguments)
        self.assertEqual(code, 0, f"{arguments}: {text}")
        counts = Counter()
        for n, what in re.findall(r"^(?:confirmed|(?=not)): (\d+) (.*)$", text, re.M):
            counts[what] += int(n)
        return counts

    def reject(self, says, *arguments, code=1):
        got, text = self.opinion(*arguments)
        self.assertEqual(got, code, f"{arguments}, {says}: {text}")
        self.assertIn(says, text)
        if code == 2:
            self.assertEqual(len(text.splitlines()), 1, text)


def off(triangles):
    corners = "".join(" ".join(map(repr, map(float, p))) + "\n" for t in triangles for p in t)
    faces = "".join(f"3 {3 * i} {3 * i + 1} {3 * i + 2}\n" for i in range(len(triangles)))
    return f"OFF\n{3 * len(triangles)} {len(triangles)} 0\n{corners}{faces}"


def obj(points):
    return "".join("v " + " ".join(map(repr, map(float, p))) + "\n" for p in points)


def texts(p):
    return [str(Fraction(c)) for c in p]


def both(p):
    return {"exact": texts(p), "estimate": [float(Fraction(c)) for c in p]}


def judgement(triangles, cell, witnesses=(), chains=()):
    """What `clues check --json` would print of triangles that are all listed, with these proofs (triangle, front, ...)."""
    seen = {w[0] for w in witnesses}
    words = ["exact" if i in seen else "first-order" for i in range(len(triangles))]
    side = {True: "front", False: "back"}
    return {
        "format": "clues-judgement/1", "scene": "scene.off", "cell": [list(map(float, p)) for p in cell],
        "verdict": "sound", "triangles": words, "meet_cell": [], "proved_hidden": [], "contradictions": [],
        "counts": {"exact": len(seen), "first_order": len(words) - len(seen), "loose": 0, "missing_visible": 0,
                   "missing_undecided": 0},
        "first_order_fractions": [["1", "1"]] * len(triangles),
        "witnesses": [{"triangle": t, "side": side[f], "v": both(v), "p": both(p)} for t, f, v, p in witnesses],
        "chains": [{"triangle": t, "side": side[f], "links": [{"v": both(v), "x": both(x)} for v, x in links]}
                   for t, f, links in chains]}


BOX = [[x, y, z] for x in (-2, -1) for y in (-1, 1) for z in (-1, 1)]
SQUARE = [[-1, -1, -1], [-1, 1, -1], [-1, 1, 1], [-1, -1, 1]]
SEGMENT, POINT = [[-1, -1, 0], [-1, 1, 0]], [[-1, 0, 0]]
TARGET = [[1, -1, -1], [1, 0, 2], [1, 2, -1]]
V, P = ["-3/2", 0, 0], [1, 0, 0]
