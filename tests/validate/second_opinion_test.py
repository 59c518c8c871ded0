#!/usr/bin/env python3
"""The second opinion (validate/second_opinion): it confirms the suite and what the program prints, and rejects forgeries.
Usage: second_opinion_test.py CLUES SOURCES"""
import contextlib
import copy
import hashlib
import importlib.util
import io
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from collections import Counter
from fractions import Fraction
from random import Random

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


class Suite(Folder):
    def test_the_published_suite_is_confirmed(self):
        expected = Counter()
        for path in (SOURCES / "vectors").glob("*.json"):
            for case in json.loads(path.read_text()).get("cases", []):
                if isinstance(case, dict):
                    expected["cases"] += 1
                    expected["hidden triangles of which eight points are occluded"] += len(case["expect"]["umbra"])
                    for m in case["expect"]["must_be_visible"]:
                        expected["cell contacts" if "meets_cell" in m else "witnesses"] += 1
                        expected["seen triangles off the cell"] += "meets_cell" not in m
        begun = time.monotonic()
        counts = self.accept("suite", SOURCES / "vectors")
        print(f"suite: {dict(counts)}, {time.monotonic() - begun:.1f} s", file=sys.stderr)
        self.assertEqual(counts, expected)
        self.assertGreater(expected["witnesses"], 2000)

    def screens(self):
        triangles = [[0, 2, 1], [0, 3, 2], [4, 6, 5], [7, 9, 8], [10, 12, 11], [13, 14, 15], [0, 0, 1]]
        points = [[float(c) for c in line.split()] for line in SCREENS.splitlines()[2:15]]
        points += [[-2, 0, -.125], [0, 0, -.125], [-2, 1, -.125]]
        box = [[x, y, z] for z in (-.25, 0) for y in (-.25, .25) for x in (-.25, .25)]
        hexes = lambda p: [float(c).hex() for c in p]
        seen = lambda t, *p: {"triangle": t, "front": True, "v": ["0", "0", "-1/8"], "p": list(p)}
        expect = {"must_be_visible": [seen(0, "10", "-15", "4"), seen(1, "-15", "10", "4"), seen(2, "0", "0", "2"),
                                      seen(4, "37/4", "1/4", "2"), {"triangle": 5, "meets_cell": True}],
                  "umbra": [{"triangle": 3, "proof": "first_order_map"}], "no_surface": [6],
                  "first_order_visible": [0, 1, 2, 4, 5]}
        case = {"id": "screen", "comment": "A screen before a wall.", "flags": ["Screen"], "level": "core",
                "scene": "screen", "mode": "sheet", "cell": list(map(hexes, box)), "expect": expect}
        file = {"format": "clues-vectors/1", "topic": "screens", "definition": "D5",
                "scenes": {"screen": {"vertices": list(map(hexes, points)), "triangles": triangles}}, "cases": [case]}
        index = {"format": "clues-vectors-index/1", "active": 1, "withdrawn": 0, "topics": {"screens": 1},
                 "cases": {"screen": {"topic": "screens", "status": "active"}}}
        return file, index

    def suite(self, change=lambda file, index: None):
        file, index = self.screens()
        change(file, index)
        self.write("screens.json", file)
        self.write("index.json", index)

    def test_forged_expectations_are_rejected(self):
        self.suite()
        self.assertEqual(self.accept("suite", ".")["witnesses"], 4)

        def visible(e, i, **fields):
            e["must_be_visible"][i].update(fields)

        def call_visible_umbra(e):
            e["must_be_visible"].pop(3)
            e["umbra"].append({"triangle": 4, "proof": "first_order_map"})
            e["first_order_visible"].remove(4)

        def call_hidden_visible(e):
            e["umbra"].clear()
            seen = {"triangle": 3, "front": True, "v": ["0", "0", "-1/8"], "p": ["0", "0", "9/4"]}
            e["must_be_visible"].insert(3, seen)

        def replace(e, i, proof):
            e["must_be_visible"][i] = proof

        no_contact = {"triangle": 5, "front": True, "v": ["0", "0", "-1/16"], "p": ["-1", "1/4", "-1/8"]}
        for says, change in (
                ("triangle 2 blocks", lambda e: visible(e, 0, p=["0", "-1", "4"])),  # behind the screen
                ("triangle 0 blocks", lambda e: visible(e, 0, p=["10", "-15", "5"])),  # behind its plane
                ("relative interior of triangle 0", lambda e: visible(e, 0, p=["10", "-15", "3"])),
                ("relative interior of the cell", lambda e: visible(e, 0, v=["0", "0", "0"])),  # on the rim
                ("strictly the side", lambda e: visible(e, 0, front=False)),
                ("relative interior of triangle 0", lambda e: visible(e, 0, p=e["must_be_visible"][1]["p"])),
                ("triangle 4: is visible", call_visible_umbra),
                ("first_order_visible", lambda e: e["umbra"][0].update(proof="exhaustive")),
                ("triangle 2 blocks", call_hidden_visible),
                ("triangle 0: does not meet the cell", lambda e: replace(e, 0, {"triangle": 0, "meets_cell": True})),
                ("triangle 5: meets the cell", lambda e: replace(e, 4, no_contact)),
                ("no_surface", lambda e: (e["no_surface"].clear(),
                                          e["umbra"].append({"triangle": 6, "proof": "first_order_map"}))),
                ("triangle 6, or it has no area", lambda e: (e["no_surface"].clear(), e["must_be_visible"].append(
                    {"triangle": 6, "meets_cell": True}))),
                ("first_order_visible", lambda e: e["first_order_visible"].append(6)),
                ("first_order_visible", lambda e: e["first_order_visible"].reverse()),
                ("what is listed", lambda e: e["umbra"].clear()),
                ("what is listed", lambda e: e["no_surface"].append(5)),
                ("no triangle 7", lambda e: e["umbra"][0].update(triangle=7)),
                ("the order", lambda e: e["must_be_visible"].reverse())):
            with self.subTest(says):
                self.suite(lambda file, index: change(file["cases"][0]["expect"]))
                self.reject(says, "suite", ".")

    def test_malformed_suites_are_bad_input(self):
        def expect(path, value):
            def change(file, index):
                at = file["cases"][0]["expect"]
                for step in path[:-1]:
                    at = at[step]
                at[path[-1]] = value
            return change

        vertex = lambda value: lambda f, i: f["scenes"]["screen"]["vertices"][2].__setitem__(1, value)
        for says, change in (
                ("lowest terms", expect(["must_be_visible", 0, "v", 2], "-2/16")),
                ("lowest terms", expect(["must_be_visible", 0, "p", 0], "1.5")),
                ("lowest terms", expect(["must_be_visible", 0, "p", 0], "1/0")),
                ("lowest terms", expect(["must_be_visible", 0, "p", 0], "-0")),
                ("sampling", expect(["umbra", 0, "proof"], "sampling")),
                ("number", expect(["must_be_visible", 0, "p"], ["0", "0"])),
                ("error", vertex("nan")), ("error", vertex("0x1p+5000")), ("error", vertex(1.5)),
                ("number -1 of", lambda f, i: f["scenes"]["screen"]["triangles"][1].__setitem__(2, -1)),
                ("number 16 of", lambda f, i: f["scenes"]["screen"]["triangles"][1].__setitem__(2, 16)),
                ("both", lambda f, i: f["cases"][0].update(mode="both")),
                ("none", lambda f, i: f["cases"][0].update(scene="none")),
                ("no points", lambda f, i: f["cases"][0].update(cell=[])),
                ("closed mesh", lambda f, i: f["cases"][0].update(mode="solid")),
                ("clues-vectors/1", lambda f, i: f.update(format="clues-vectors/2"))):
            with self.subTest(says):
                self.suite(change)
                self.reject(says, "suite", ".", code=2)
        self.suite()
        self.write("screens.json", (self.folder / "screens.json").read_text().replace('"topic"', '"topic": 1, "topic"', 1))
        self.reject("twice", "suite", ".", code=2)
        self.suite()
        self.reject("no case", "suite", ".", "--case", "window-*", code=2)

    def test_an_index_that_does_not_agree_is_rejected(self):
        for says, change in (
                ("screen: None", lambda f, i: i["cases"].clear()),
                ("withdrawn", lambda f, i: i["cases"]["screen"].update(status="withdrawn", reason="wrong")),
                ("index.json", lambda f, i: i["cases"].update(gone=i["cases"]["screen"])),
                ("index.json", lambda f, i: i.update(active=7)),
                ("index.json", lambda f, i: i.update(withdrawn=7)),
                ("other", lambda f, i: i["cases"]["screen"].update(topic="other"))):
            with self.subTest(says):
                self.suite(change)
                self.reject(says, "suite", ".")


BOX = [[x, y, z] for x in (-2, -1) for y in (-1, 1) for z in (-1, 1)]
SQUARE = [[-1, -1, -1], [-1, 1, -1], [-1, 1, 1], [-1, -1, 1]]
SEGMENT, POINT = [[-1, -1, 0], [-1, 1, 0]], [[-1, 0, 0]]
TARGET = [[1, -1, -1], [1, 0, 2], [1, 2, -1]]
V, P = ["-3/2", 0, 0], [1, 0, 0]


class Witnesses(Folder):
    """The cases of tests/exact/witness_test.cpp, as files."""

    def judged(self, more, v, p, cell=None, front=True, number=0, target=None):
        triangles, cell = [target or TARGET, *more], cell or BOX
        self.write("scene.off", off(triangles))
        self.write("cell.obj", obj(cell))
        self.write("judged.json", judgement(triangles, cell, [(number, front, v, p)]))
        return "check", "scene.off", "--cell", "cell.obj", "judged.json"

    def test_free_lines_are_accepted(self):
        for more, v, p, cell in (
                ([], V, P, BOX), ([[[0, 5, 5], [0, 6, 5], [0, 5, 6]]], V, P, BOX),
                ([[[0, 0, 0], [0, 1, 0], [0, 0, 1]]], V, [1, "-1/1000000000", 0], BOX),  # just past a corner
                ([[[-.5, 0, .25], [.5, 0, .25], [0, 0, 1]]], V, P, BOX),  # in a plane with the line, apart
                ([[[0, 0, 0], [.5, 0, 0], [.25, 0, 0]]], V, P, BOX),  # no area
                ([[[1.5, -1, -1], [1.5, 1, -1], [1.5, 0, 1]], [[-3, -1, -1], [-3, 1, -1], [-3, 0, 1]],
                  [[-1.25, -1, -1], [-1.25, 1, -1], [-1.25, 0, 1]], [[-1.5, 0, 0], [-1.125, 0, 0], [-1.25, 0, .5]]], V, P, BOX),
                ([[[1, -1, 0], [1, 1, 0], [1, 0, 1]]], V, P, BOX),  # in the plane of the target
                *(([], [-1, 0, 0], P, cell) for cell in (SQUARE, SEGMENT, POINT)),
                *(([[[-1, -1, -1], [-1, 1, -1], [-1, 0, 1]]], [-1, 0, 0], P, cell) for cell in (SQUARE, SEGMENT, POINT)),
                ([[[-1, 0, 0], [-.5, -2, 0], [-1, -2, 0]]], [-1, 0, 0], P, POINT),
                ([[[-1, -2, 0], [-1, 2, 0], [-3, 0, 0]]], [-1, 0, 0], P, SEGMENT),  # along it, behind it
                ([[[-2.5, -1, 0], [-2.5, 1, 0], [-2, 0, 0]]], [-2, 0, 0], [1, 0, "1/2"],
                 [[-3, -1, 0], [-1, -1, 0], [-1, 1, 0], [-3, 1, 0]])):
            with self.subTest(more=more, v=v, p=p, cell=cell):
                self.assertEqual(self.accept(*self.judged(more, v, p, cell))["witnesses"], 1)

    def test_every_condition_is_checked(self):
        flat = [[-3, -1, 0], [-1, -1, 0], [-1, 1, 0], [-3, 1, 0]]
        on_v = [[-1, 0, 0], [-.5, -2, 0], [-1, -2, 0]]
        for says, *arguments in (
                ("strictly the side", [], V, P, BOX, False),
                ("relative interior of triangle", [], V, [1, 0, -1]),  # on its edge
                ("triangle 0 blocks", [], V, ["1000000008/1000000007", 0, 0]),  # off its plane
                ("relative interior of triangle", [], V, ["1000000006/1000000007", 0, 0]),
                ("relative interior of triangle", [], V, [1, 3, 0]),
                ("relative interior of the cell", [], [-1, 0, 0], P), ("relative interior of the cell", [], [0, 0, 0], P),
                ("no triangle 7", [], V, P, BOX, True, 7),
                ("triangle 1 blocks", [[[0, -1, -1], [0, 1, -1], [0, 0, 1]]], V, P),
                ("triangle 1 blocks", [[[0, 0, 0], [0, 1, 0], [0, 0, 1]]], V, P),  # touched at a corner
                ("triangle 1 blocks", [[[0, -1, 0], [0, 1, 0], [0, 0, 1]]], V, P),  # at an edge
                ("triangle 1 blocks", [[[-.5, 0, 0], [.5, 0, 0], [0, 0, 1]]], V, P),  # along an edge
                ("triangle 1 blocks", [[[-1, -1, -1], [-1, 1, -1], [-1, 0, 1]]], V, P),  # on the border of the cell
                ("triangle 1 touches it at p", [[[1, 0, 0], [1, 0, 1], [3, 0, 0]]], V, P),
                ("triangle 1", [[[1, 0, 0], [.5, 0, 0], [1, 0, 1]]], V, P),
                *(("relative interior of the cell", [], [-1, 1, 0], P, cell) for cell in (SQUARE, SEGMENT, POINT)),
                *(("relative interior of the cell", [], ["-1/2", 0, 0], P, cell) for cell in (SQUARE, SEGMENT, POINT)),
                ("triangle 1 blocks", [[[-1, -1, -1], [-1, 1, -1], [-1, 0, 1]]], V, P, [[-1, 0, 0], [-2, 0, 0]]),
                *(("v lies on triangle 1", [on_v], [-1, 0, 0], P, cell) for cell in (SQUARE, SEGMENT)),
                ("v lies on triangle 1", [[[-1, 0, 0], [-.5, 2, 0], [-1, 2, 0]]], [-1, 0, 0], P, SEGMENT),
                ("v lies on triangle 1", [[[-2.5, -1, 0], [-2.5, 1, 0], [-2, 0, 0]]], [-2, 0, 0], P, flat),
                ("triangle 1 blocks", [[[-1.5, -1, -1], [-1.5, 1, -1], [-1.5, 0, 1]]], [-2, 0, 0], P, flat)):
            with self.subTest(says=says, arguments=arguments):
                self.reject(says, *self.judged(*arguments))
        self.reject("no area", *self.judged([], V, P, target=[[1, -1, -1], [1, 0, 2], [1, 0, 2]]))
        closed = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 1, 0]],
                  [[0, 0, 0], [1, 0, 0], [0, 0, 1]]]
        turned = [t[::-1] for t in closed]
        for triangles, reject in ((closed, False), (turned, True)):
            line = (0, not reject, [2, 2, 2], ["1/3", "1/3", "1/3"])
            self.write("scene.off", off(triangles))
            self.write("judged.json", judgement(triangles, [[2, 2, 2]], [line]))
            command = "check", "scene.off", "--cell", "box:2,2,2,2,2,2", "judged.json"
            self.accept(*command)
            if reject:
                self.reject("only fronts", *command, "--solid")
        self.write("scene.off", off(closed[:3]))
        self.reject("closed mesh", *command, "--solid", code=2)


class Chains(Folder):
    """The cases of tests/validate/chain_test.cpp: past the edge of one wall, and then past the edge of a second."""
    WALLS = [[[2, -8, -8], [2, -8, 8], [2, .75, 0]], [[6, 4, -8], [6, 4, 8], [6, 9, 0]], [[9, 3, 0], [9, 5, 1], [9, 5, -1]]]
    CUBE = [list(p) for p in itertools.product((-1, 1), repeat=3)]
    SECOND = ["-1/2", "1/8", 0]
    END = [9, Fraction(1, 8) + Fraction(19, 9) * Fraction(15, 8), 0]

    def judged(self, links, more=(), triangle=2, front=True):
        triangles = [*self.WALLS, *more]
        self.write("scene.off", off(triangles))
        self.write("judged.json", judgement(triangles, self.CUBE, [], [(triangle, front, links)]))
        return "check", "scene.off", "--cell", "box:-1,-1,-1,1,1,1", "judged.json"

    def test_chains(self):
        first, good = ([0, 0, 0], [4, 2, 0]), [([0, 0, 0], [4, 2, 0]), (self.SECOND, self.END)]
        self.assertEqual(self.accept(*self.judged(good))["chains"], 1)
        self.accept(*self.judged([([0, 0, 0], [2, -2, 0])], triangle=0))
        self.reject("strictly the side", *self.judged([([0, 0, 0], [2, -2, 0])], triangle=0, front=False))
        behind = [4 - Fraction(9, 16), 2 - Fraction(15, 64), 0]
        for says, links, *more in (
                ("no link", []), ("no triangle 3", good, [], 3), ("strictly the side", good, [], 2, False),
                ("relative interior of the cell", [([1, 0, 0], [4, 2, 0]), good[1]]),
                ("relative interior of the cell", [first, ([-2, 0, 0], self.END)]),
                ("triangle 0 blocks", [([0, 0, 0], [4, 1, 0]), good[1]]),
                ("x is in the cell", [([0, 0, 0], ["1/2", 0, 0]), good[1]]),
                ("between v and x", [first, ([0, 0, 0], self.END)]),
                ("between v and x", [first, (self.SECOND, [9, 8, 0])]),
                ("between v and x", [([0, 0, 0], self.END), (self.SECOND, [4, 2, 0])]),
                ("triangle 3 blocks", good, [[[4, 2, 0], [4, 9, 1], [4, 9, -1]]]),  # touched in the point before
                ("triangle 3 blocks", good, [[[5, 0, -9], [5, 0, 9], [5, 9, 0]]]),
                ("relative interior of triangle 2", [first]),
                ("between v and x", [first, (self.SECOND, behind)])):
            with self.subTest(says=says, links=links):
                self.reject(says, *self.judged(links, *more))

    def test_the_first_viewpoint_on_a_flat_cell_is_on_no_triangle(self):
        for more, says in (([], None), ([[[0, 0, 0], [-1, 1, 0], [-1, -1, 0]]], None),
                           ([[[0, 0, 0], [1, 1, 0], [1, -1, .5]]], "v lies on triangle 3")):
            triangles = [*self.WALLS, *more]
            cell = [[0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]]
            self.write("scene.off", off(triangles))
            self.write("judged.json", judgement(triangles, cell, [], [(0, True, [([0, 0, 0], [2, -2, 0])])]))
            command = "check", "scene.off", "--cell", "box:0,-1,-1,0,1,1", "judged.json"
            self.reject(says, *command) if says else self.accept(*command)


class Judgements(Folder):
    def test_forged_judgements_are_rejected(self):
        self.write("scene.off", SCREENS)
        self.write("some.pvs", "1\n2\n3\n")
        self.clues("check", "scene.off", "--cell", CELL, "--pvs", "some.pvs", "--json", out="good.json", codes=(1,))
        good = json.loads((self.folder / "good.json").read_text())
        self.assertEqual(self.accept("check", "scene.off", "--cell", CELL, "good.json")["witnesses"], 4)
        self.reject("the cell", "check", "scene.off", "--cell", "box:-0.25,-0.25,-0.25,0.25,0.25,0.5", "good.json")
        for says, change in (
                ("verdict", lambda j: j.update(verdict="sound")),
                ("counts", lambda j: j["counts"].update(exact=3)),
                ("proof that it is visible", lambda j: j["witnesses"].pop()),
                ("proof that it is visible", lambda j: j["triangles"].__setitem__(4, "hidden")),
                ("proof that it is visible", lambda j: j["triangles"].__setitem__(3, "exact")),
                ("triangle 4, hidden: is visible", lambda j: (j["triangles"].__setitem__(4, "hidden"), j["witnesses"].pop())),
                ("is in the map", lambda j: j["first_order_fractions"].__setitem__(3, ["1/2", "0"])),
                ("seen and not in the map", lambda j: j["first_order_fractions"].__setitem__(4, ["0", "0"])),
                ("does not meet", lambda j: j["meet_cell"].append(3)),
                ("relative interior", lambda j: j["witnesses"][0].update(triangle=1)),
                ("strictly the side", lambda j: j["witnesses"][0].update(side="back")),
                ("triangle 2 blocks", lambda j: j["witnesses"][0].update(p=both([1, -1, 4]))),
                ("contradictions", lambda j: j["contradictions"].append({}))):
            with self.subTest(says):
                forged = copy.deepcopy(good)
                change(forged)
                self.write("forged.json", forged)
                self.reject(says, "check", "scene.off", "--cell", CELL, "forged.json")
        for says, change in (("is not near", lambda j: j["witnesses"][0]["p"]["estimate"].__setitem__(0, 1e9)),
                             ("another scene", lambda j: j["triangles"].pop()),
                             ("up", lambda j: j["witnesses"][0].update(side="up")),
                             ("clues-judgement/1", lambda j: j.update(format="clues-judgement/2"))):
            forged = copy.deepcopy(good)
            change(forged)
            self.write("forged.json", forged)
            self.reject(says, "check", "scene.off", "--cell", CELL, "forged.json", code=2)


class Points(Folder):
    """The scene of tests/validate/point_query_test.cpp: a square before a wall, of two triangles each."""
    PLATES = [[[-2, -2, 1], [2, -2, 1], [2, 2, 1]], [[-2, -2, 1], [2, 2, 1], [-2, 2, 1]],
              [[-10, -10, 2], [10, -10, 2], [10, 10, 2]], [[-10, -10, 2], [10, 10, 2], [-10, 10, 2]]]
    COMMAND = "query", "scene.off", "--cell", "box:-1,-1,-0.5,1,1,0"

    def asked(self, points):
        self.write("scene.off", off(self.PLATES))
        self.write("points.txt", points)
        self.clues(*self.COMMAND, "--points", "points.txt", "--json", out="good.json")
        return json.loads((self.folder / "good.json").read_text())

    def test_forged_answers_are_rejected(self):
        good = self.asked("1/2 -1/4 3/2\n8 8 3/2\n1/2 1/4 2\n1 1 1\n0 0 -1/4\n7/3 0 3/2\n-8 0 3/2 8 0 3/2\n1/3 0 0 1/3 0 3/2\n")
        counts = self.accept(*self.COMMAND, "good.json")
        self.assertGreaterEqual(counts["occluded points"], 3)
        self.assertGreaterEqual(counts["seen points"], 3)
        self.reject("do not cover", *self.COMMAND[:3], "box:-1,-1,-0.5,3,1,0", "good.json")
        answer = lambda q, i, k=0: q["points"][i]["answers"][k]
        occluded = {"sight": "occluded", "faces_away": False, "covered_by": [0, 1]}
        part = lambda q, k, i=0: q["segments"][i]["parts"][k]
        wall = next(k for k, a in enumerate(good["points"][2]["answers"]) if a["triangle"] == 2 and not a["faces_away"])
        for says, change in (
                ("do not cover", lambda q: answer(q, 0)["covered_by"].pop()),
                ("do not cover", lambda q: answer(q, 0)["covered_by"].clear()),
                ("do not cover", lambda q: answer(q, 0).update(covered_by=[2, 3])),
                ("is covered", lambda q: answer(q, 0)["covered_by"].append(2)),
                ("no triangle 9", lambda q: answer(q, 0)["covered_by"].append(9)),
                ("do not cover", lambda q: answer(q, 1).update(occluded)),
                ("blocks", lambda q: answer(q, 0).update(sight="visible", v=["0", "0", "-1/4"])),
                ("relative interior of the cell", lambda q: answer(q, 1).update(v=["1", "1", "0"])),
                ("relative interior of the cell", lambda q: answer(q, 1).update(v=["9", "9", "1"])),
                ("not to first order", lambda q: answer(q, 1).update(first_order="hidden")),
                ("does not face away", lambda q: answer(q, 2, wall).update(faces_away=True)),
                ("do not cover", lambda q: answer(q, 2, wall).update(covered_by=[])),
                ("strictly on that side", lambda q: answer(q, 2, 1 - wall).update(sight="visible", v=["0", "0", "-1/4"])),
                ("sides", lambda q: q["points"][3]["answers"].pop()),
                ("sides", lambda q: answer(q, 2).update(side="back")),
                ("line 2", lambda q: q["points"][1].update(place="surface")),
                ("line 5", lambda q: q["points"][4].update(place="space")),
                ("blocks", lambda q: q["points"][1].update(point=["0", "0", "3/2"])),
                ("do not cover", lambda q: q["points"][0].update(point=["5", "0", "3/2"])),
                ("do not cover", lambda q: q["points"][5].update(point=["4667/2000", "0", "3/2"])),  # just beyond the umbra
                ("not in the part", lambda q: part(q, 0).update(to="1/100")),
                ("cuts", lambda q: q["segments"][0]["parts"].pop()),
                ("cuts", lambda q: part(q, 1).update({"from": "1/3"})),
                ("is visible", lambda q: q["segments"][0].update(parts=[{"from": "0", "to": "1", "sight": "hidden"}])),
                ("not in the cell", lambda q: part(q, 0).update(v=None)),
                ("is in the cell", lambda q: q["segments"][1].update(
                    ends=[["0", "0", "0"], ["0", "0", "-1/4"]], parts=[{"from": "0", "to": "1", "sight": "hidden"}])),
                ("blocks", lambda q: (part(q, 1).update(sight="visible", at=["0", "0", "3/2"], v=["0", "0", "-1/4"])))):
            with self.subTest(says):
                forged = copy.deepcopy(good)
                change(forged)
                self.write("forged.json", forged)
                self.reject(says, *self.COMMAND, "forged.json")

    def test_a_wall_on_the_border_of_the_cell(self):
        """D3: it blocks; what is within the cell does not."""
        for height, sight in ((0, "occluded"), (-.25, "visible")):
            self.write("scene.off", off([[[-9, -9, height], [9, -9, height], [0, 9, height]]]))
            self.write("points.txt", "1/8 1/8 1\n")
            self.clues(*self.COMMAND, "--points", "points.txt", "--json", out="good.json")
            good = json.loads((self.folder / "good.json").read_text())
            self.assertEqual(good["points"][0]["answers"][0]["sight"], sight)
            self.accept(*self.COMMAND, "good.json")
            lie = {"occluded": {"sight": "visible", "v": ["0", "0", "-1/8"], "first_order": "visible"},
                   "visible": {"sight": "occluded", "faces_away": False, "covered_by": [0]}}[sight]
            good["points"][0]["answers"][0].update(lie)
            self.write("forged.json", good)
            self.reject({"occluded": "blocks", "visible": "do not cover"}[sight], *self.COMMAND, "forged.json")

    def test_cells_without_an_interior(self):
        """Where checkers of points were wrong once (tests/app/query_test.cpp, tests/validate/thin_occlusion_test.cpp): they
        forgot that a triangle crosses a segment, or that what holds a point of int V blocks, or took one point for enough."""
        crossing = [[[-.5, -1, .5], [-.5, 1, .5], [3.25, 0, -1]]]
        groove = [[[-1, 0, 0], [3, 0, 0], [1, -40, .5]], [[-1, 0, 0], [3, 0, 0], [1, 40, .5]], [[.4, -.1, 1], [.6, -.1, 1], [.5, .2, 1]]]
        cross = [[[.125, -1, .5], [.125, 1, .5], [1.25, 0, -1]], [[.875, -1, .5], [.875, 1, .5], [-.25, 0, -1]],
                 [[.4375, -.0625, 1], [.5625, -.0625, 1], [.5, .0625, 1]]]
        for triangles, cell, p, seen in ((crossing, "box:0,0,0,1,0,0", "1/2 0 1", True), (groove, "box:0,-1,0,1,1,0", "1/2 1/100 1", False),
                                         (cross, "box:0,0,0,1,0,0", "1/2 1/100 1", False)):
            command = "query", "scene.off", "--cell", cell
            self.write("scene.off", off(triangles))
            self.write("points.txt", p)
            self.clues(*command, "--points", "points.txt", "--json", out="good.json")
            self.accept(*command, "good.json")
            forged = json.loads((self.folder / "good.json").read_text())
            for a in forged["points"][0]["answers"]:
                if seen:
                    a.update(sight="occluded", faces_away=False, covered_by=[0])
                else:  # the line, or point, between the triangles that stand on the cell
                    a.update(sight="visible", first_order="visible", v=["1/2", "0", "0"])
            self.write("forged.json", forged)
            self.reject("do not cover" if seen else "v lies on triangle", *command, "forged.json")


class Umbrae(Folder):
    """The cases of tests/reference/umbra_test.cpp: the umbra of a plate, and what is none."""
    PLATE = [[[-2, -2, 1], [2, -2, 1], [2, 2, 1]], [[-2, -2, 1], [2, 2, 1], [-2, 2, 1]]]
    MORE = [[[0, 0, 1.5], [1, 0, 1.75], [0, 1, 1.5]], [[0, 0, 1.5], [4, 0, 1.75], [0, 1, 1.5]]]
    CELL = "box:-1,-1,0,1,1,0"

    def made(self, triangles):
        self.write("scene.off", off(triangles))
        self.clues("map", "scene.off", "--cell", self.CELL, "--bounds", "box:-9,-9,-1,9,9,2", "--umbra", "good.json")
        return json.loads((self.folder / "good.json").read_text())

    def verdict(self, umbra, cell=None):
        self.write("forged.json", {k: v for k, v in umbra.items() if k != "cell"})
        return "umbra", "scene.off", "--cell", cell or self.CELL, "forged.json"

    def test_forged_umbrae_are_rejected(self):
        good = self.made(self.PLATE)
        self.accept("umbra", "scene.off", "--cell", self.CELL, "good.json")
        self.reject("the cell", "umbra", "scene.off", "--cell", "box:-1,-1,0,1,2,0", "good.json")

        def spoilt(change):
            umbra = copy.deepcopy(good)
            change(umbra)
            return umbra

        def turn(f):
            f["corners"][0], f["corners"][1] = f["corners"][1], f["corners"][0]

        def move(umbra, i):
            corner = list(umbra["vertices_exact"][umbra["facets"][i]["corners"][0]])
            corner[0] = str(Fraction(corner[0]) + Fraction(1, 1000000))
            umbra["facets"][i]["corners"][0] = len(umbra["vertices_exact"])
            umbra["vertices_exact"].append(corner)

        first = {f["kind"]: i for i, f in reversed(list(enumerate(good["facets"])))}
        for i in range(len(good["facets"])):
            self.reject("has a gap", *self.verdict(spoilt(lambda u: u["facets"].pop(i))))
            self.reject("WRONG", *self.verdict(spoilt(lambda u: move(u, i))))
        self.reject("has a gap", *self.verdict(spoilt(lambda u: turn(u["facets"][first["surface"]]))))
        for kind in ("wedge", "bound"):
            self.reject("outer side", *self.verdict(spoilt(lambda u: turn(u["facets"][first[kind]]))))
        for triangle, says in ((0, "leaves triangle 0"), (77, "no triangle 77")):
            change = lambda u: u["facets"][first["wedge"]].update(kind="surface", triangle=triangle)
            self.reject(says, *self.verdict(spoilt(change)))
        self.reject("outer side", *self.verdict(good, "box:-1,-1,0,1,1.5,0"))
        self.reject("meets the inside of the cell", *self.verdict(
            spoilt(lambda u: u.update(facets=[f for f in u["facets"] if f["kind"] == "surface"])), "box:-1,-1,0,1,1,2"))
        corners = [["-9", "-9", "-9"], ["30", "-9", "-9"], ["-9", "30", "-9"], ["-9", "-9", "30"]]
        around = [{"kind": "wedge", "corners": c} for c in ([0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3])]
        self.reject("goes round the cell", *self.verdict(spoilt(lambda u: u.update(vertices_exact=corners, facets=around))))
        for says, change in (("number 100000 of", lambda u: u["facets"][2]["corners"].__setitem__(1, 100000)),
                             ("number -1 of", lambda u: u["facets"][2]["corners"].__setitem__(1, -1)),
                             ("lowest terms", lambda u: u["vertices_exact"][1].__setitem__(2, "1/0")),
                             ("wall", lambda u: u["facets"][0].update(kind="wall")),
                             ("belongs to a surface", lambda u: u["facets"][first["wedge"]].update(triangle=0)),
                             ("another scene", lambda u: u["scene"].update(triangles=6)),
                             ("clues-umbra/1", lambda u: u.update(format="clues-result/1"))):
            self.reject(says, *self.verdict(spoilt(change)), code=2)
        self.write("cut.json", '{"format": ')
        self.reject("error", "umbra", "scene.off", "--cell", self.CELL, "cut.json", code=2)

    def test_what_it_proves_hidden(self):
        umbra = self.made(self.PLATE + self.MORE)
        self.clues("verify", "scene.off", "--cell", self.CELL, "--umbra", "good.json", "--list", out="list.txt")
        self.assertEqual((self.folder / "list.txt").read_text().splitlines()[-1], "2")
        command = "umbra", "scene.off", "--cell", self.CELL, "good.json"
        self.assertEqual(self.accept(*command)["hidden triangles"], 1)
        self.assertEqual(self.accept(*command, "--list", "list.txt")["hidden triangles"], 1)
        for ids, says in (("0\n", "not in the umbra"), ("2 3\n", "triangle 3: is divided"), ("4\n", "no triangle 4")):
            self.write("forged.txt", ids)
            self.reject(says, *command, "--list", "forged.txt")
        empty = {"format": "clues-umbra/1", "vertices_exact": [], "facets": []}
        self.write("scene.off", off([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]]))
        self.write("forged.txt", "0\n")
        self.reject("meets the cell", *self.verdict(empty, "box:.25,.25,0,.5,.5,0"), "--list", "forged.txt")
        self.reject("closed mesh", *self.verdict(empty, "box:0,0,1,1,1,2"), "--solid", code=2)
        self.assertEqual(len(umbra["facets"][0]["corners"]), 3)


class Findings(Folder):
    def test_findings(self):
        self.clues("fuzz", "--subject", BLIND, "--cases", 1, "--errors", 1, "--oracle", "sight-lines", "--out", "c", codes=(1,))
        finding = next((self.folder / "c").glob("sight-lines-*"))
        self.assertEqual(self.accept("finding", finding)["witnesses"], 2)
        forged = self.folder / "forged"

        def forge(change, honest=False):
            shutil.rmtree(forged, ignore_errors=True)
            shutil.copytree(finding, forged)
            about, line = (json.loads((forged / name).read_text()) for name in ("finding.json", "witness.json"))
            change(about, line)
            (forged / "witness.json").write_text(json.dumps(line, indent=2) + "\n")
            if not honest:  # as somebody would who knows how
                for key, place in (("sha256", forged), ("sha256_original", forged / "original")):
                    about[key] = {name: hashlib.sha256((place / name).read_bytes()).hexdigest() for name in about[key]}
                about.pop("checksum")
                text = json.dumps(about, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
                about["checksum"] = hashlib.sha256(text.encode()).hexdigest()
            (forged / "finding.json").write_text(json.dumps(about, indent=2, sort_keys=True, ensure_ascii=False) + "\n")

        forge(lambda about, line: None)
        self.accept("finding", forged)
        n = json.loads((finding / "finding.json").read_text())["triangles"]
        for says, code, change in (
                ("checksum", 1, lambda about, line: about.update(explanation="all is well")),
                ("sha256", 1, lambda about, line: line["v"].__setitem__(0, "7"))):
            forge(change, honest=True)
            self.reject(says, "finding", forged, code=code)
        for says, code, change in (
                ("relative interior", 1, lambda about, line: line.update(v=line["p"], p=line["v"])),
                ("no triangle", 1, lambda about, line: line.update(triangle=n)),
                ("no triangle", 1, lambda about, line: line.update(triangle=-4294967292)),
                ("no triangle", 1, lambda about, line: line.update(triangle=2**32)),
                ("no triangle", 1, lambda about, line: line.update(triangle=4.5)),
                ("strictly", 1, lambda about, line: line.update(side={"front": "back", "back": "front"}[line["side"]])),
                ("error", 2, lambda about, line: line.clear()), ("error", 2, lambda about, line: line.pop("v")),
                ("up", 2, lambda about, line: line.update(side="up")),
                ("three numbers", 2, lambda about, line: line.update(v=line["v"][:2])),
                ("lowest terms", 2, lambda about, line: line["p"].__setitem__(2, "two")),
                ("fluid", 2, lambda about, line: about.update(mode="fluid")),
                ("hidden/whatever", 2, lambda about, line: about.update(verdict="hidden/whatever")),
                ("does not meet", 1, lambda about, line: about.update(verdict="hidden/meets-cell")),
                ("clues-finding/2", 2, lambda about, line: about.update(format="clues-finding/99"))):
            with self.subTest(says):
                forge(change)
                self.reject(says, "finding", forged, code=code)


class WhatTheProgramPrints(Folder):
    def points_of(self, scene):
        """Corners, edges, insides of triangles, and points in the air; and segments."""
        triangles = second_opinion.read_mesh(pathlib.Path(scene))[1]
        number = lambda p: [Fraction(c, p[3]) for c in p[:3]]
        lines = []
        for i, t in enumerate(triangles[:6]):
            a, b, c = map(number, t)
            for u, v, w in ((1, 0, 0), (1, 1, 0), (1, 1, 1), (2, -1, 3))[i % 2:]:
                lines.append([(u * x + v * y + w * z) / (u + v + w) for x, y, z in zip(a, b, c)])
            lines.append([x + Fraction(k, 3) for k, x in enumerate(b)])
        lines.append([x for x in lines[1]] + [x + 1 for x in lines[-1]])
        lines.append([x for x in lines[0]] + [x - 5 for x in lines[0]])
        return "".join(" ".join(f"{x.numerator}/{x.denominator}" for x in p) + "\n" for p in lines)

    def all_of(self, scene, cell, counts, solid=False):
        mode, extra = (["--mode", "solid"], ["--solid"]) if solid else ([], [])
        options = scene, "--cell", cell
        triangles = len(second_opinion.read_mesh(pathlib.Path(scene))[1])
        self.write("some.pvs", "".join(f"{t}\n" for t in range(triangles) if t != 1))
        self.write("points.txt", self.points_of(scene))
        self.clues("check", *options, "--pvs", "some.pvs", "--json", *mode, out="check.json", codes=(0, 1, 3))
        self.clues("query", *options, "--points", "points.txt", "--json", *mode, out="query.json")
        counts += self.accept("check", *options, "check.json", *extra)
        counts += self.accept("query", *options, "query.json", *extra)
        if self.clues("map", *options, "--umbra", "umbra.json", *mode, codes=(0, 3)) == 0:
            self.clues("verify", *options, "--umbra", "umbra.json", "--list", *extra, out="list.txt")
            counts += self.accept("umbra", *options, "umbra.json", "--list", "list.txt", *extra)
            counts["umbrae"] += 1
        counts["scenes"] += 1

    def test_scenes_that_were_found(self):
        """Nearly all of these have cells without an interior, and surfaces that touch them."""
        text, counts = (SOURCES / "tests" / "differential" / "found_test.cpp").read_text(), Counter()
        for scene, cell in re.findall(r'"([\w-]+\.o(?:bj|ff))",\s*"([^"]+)"', text):
            with self.subTest(scene):
                self.all_of(FOUND / scene, cell if cell.startswith("box:") else FOUND / cell, counts)
        print(f"found: {dict(counts)}", file=sys.stderr)
        self.assertGreater(counts["scenes"], 20)
        self.assertGreater(counts["occluded points"], 50)

    def test_cases_of_the_suite(self):
        self.clues("conform", "--export", "cases", "--suite", SOURCES / "vectors")
        counts, cases = Counter(), json.loads((self.folder / "cases" / "cases.json").read_text())["cases"]
        chosen = ["five-half-planes-let-one-line-pass", "zigzag-that-its-first-three-walls-close"]  # these have chains
        chosen += [c["id"] for c in cases if c["mode"] == "solid" and c["triangles"] <= 24][:3]
        chosen += [c["id"] for c in cases if c["mode"] == "sheet" and c["triangles"] <= 12][::24]
        for case in (c for c in cases if c["id"] in chosen):
            with self.subTest(case["id"]):
                scene, cell = (self.folder / "cases" / case[key] for key in ("scene", "cell"))
                self.all_of(scene, cell, counts, case["mode"] == "solid")
        print(f"cases: {dict(counts)}", file=sys.stderr)
        self.assertGreater(counts["chains"], 1)
        self.assertGreater(counts["hidden triangles"], 5)

    def test_the_demo(self):
        (self.folder / "meshes").mkdir()
        for animal in ("elephant", "cow", "bull"):  # a tetrahedron each
            self.write(f"meshes/{animal}.off", off([[[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
                                                    [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 0], [0, 0, 0], [0, 0, 1]]]))
        self.clues("demo", "--quick", "--mesh-dir", "meshes", "--out", "demo", out="told.txt")
        tries = re.findall(r"clues check (\S+) --cell (\S+) --pvs (\S+)", (self.folder / "told.txt").read_text())
        self.assertEqual(len(tries), 2)
        counts = Counter()
        for scene, cell, pvs in tries:
            self.clues("check", scene, "--cell", cell, "--pvs", pvs, "--json", out="check.json", codes=(0, 3))
            counts += self.accept("check", scene, "--cell", cell, "check.json")
        print(f"demo: {dict(counts)}", file=sys.stderr)
        self.assertGreater(counts["witnesses"], 40)


class TwoWays(unittest.TestCase):
    """Points against whole cells, and sight lines, are decided by parts of the program that have little in common: on
    random scenes of small numbers, full of coincidences, in which one finds a viewpoint the other must confirm it."""

    def test_viewpoints_and_sight_lines_agree(self):
        random, so, counts = Random(17), second_opinion, Counter()
        number = lambda: random.randint(-3, 3)
        for i in range(600):
            dimension = i % 4
            corners = [[number(), number(), number()] for _ in range(dimension + 1 + random.randint(0, 2))]
            if dimension == 2 and random.random() < .7:
                corners = [[x, y, 0] for x, y, _ in corners]
            cell = so.Hull(map(so.point, corners))
            if cell.dimension != dimension:
                continue
            size = random.choice([1, 1, 4])  # large ones hide more
            triangles = [[so.point([size * number() for _ in range(3)]) for _ in range(3)] for _ in range(random.randint(1, 6))]
            scene = so.Scene(triangles, cell, False)
            for _ in range(4):
                p = so.point([number(), number(), Fraction(number(), random.choice([1, 2]))])
                if cell.contains(p):
                    continue
                pieces = so.viewpoints(cell, p, None, scene.surfaces)
                counts[dimension, bool(pieces)] += 1
                for piece in pieces:
                    v = so.middle(q for q in piece for _ in range(random.randint(500, 999)))  # none of a few special ones
                    if dimension == 3:  # from the border into the cell
                        v = so.middle(cell.clip([v, so.point(self.beyond(p, v))]))
                    so.check_sight(scene, v, p)  # raises Flaw where it is none
                for _ in range(6):
                    v = so.middle(random.choices(cell.points, k=5))
                    with contextlib.suppress(so.Flaw):
                        so.check_sight(scene, v, p)
                        counts["lines"] += 1
                        self.assertTrue(pieces, f"{cell.points} {triangles} {p} {v}")
        print(f"two ways: {dict(counts)}", file=sys.stderr)
        self.assertGreater(min(counts[d, seen] for d in range(4) for seen in (True, False)), 5)
        self.assertGreater(counts["lines"], 500)

    def beyond(self, p, v):
        """On the ray from p through v, farther than any cell here reaches."""
        a, b = ([Fraction(c, q[3]) for c in q[:3]] for q in (p, v))
        return [y + 1000 * (y - x) for x, y in zip(a, b)]


class Reading(Folder):
    def test_what_is_read_and_how(self):
        read = lambda name, text: second_opinion.read_mesh(self.write(name, text))
        self.assertEqual(read("a.obj", "v 0.1 0x1p-3 1e3\nv -.5 2. +1 9\nv 0 0 0\nf 1/2 2// \\\n-1 # x\nfo 1 2 3 1\n"),
                         ([second_opinion.point([0.1, 0.125, 1000.]), second_opinion.point([-.5, 2., 1.]), (0, 0, 0, 1)],
                          [[second_opinion.point([0.1, 0.125, 1000.]), second_opinion.point([-.5, 2., 1.]), (0, 0, 0, 1)]] * 2
                          + [[second_opinion.point([0.1, 0.125, 1000.]), (0, 0, 0, 1), second_opinion.point([0.1, 0.125, 1000.])]]))
        corners = [(0, 0, 0, 1), (1, 0, 0, 1), (0, 1, 0, 1)]
        for text in ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", "OFF 3 1 0\n0 0 0 1 0 0\n0 1 0 3 0 1 2",
                     "COFF\n# x\n3 1 0\n0 0 0 9 9 9 1\n1 0 0 9 9 9 1\n0 1 0 9 9 9 1\n3 0 1 2 255 0 0\n"):
            self.assertEqual(read("a.off", text), (corners, [corners]))
        for name, text in (("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n"),
                           ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1_0\n3 0 1 2\n"), ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1e999\n3 0 1 2\n"),
                           ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), ("a.off", "OFF BINARY\n"), ("a.obj", "v 0 0 0\nf 1 2 0\n"),
                           ("a.obj", "v 0 0\n"), ("a.stl", "solid\n"), ("a.obj", "v 0 0 0\n")):
            self.write(name, text)
            self.write("j.json", judgement([], []))
            self.reject("second_opinion: error: ", "check", name, "--cell", "box:0,0,0,1,1,1", "j.json", code=2)

    def test_cells_of_every_dimension(self):
        hull = lambda *points: second_opinion.Hull(map(second_opinion.point, points))
        at = second_opinion.point
        cube = hull(*itertools.product((0, 1, 2), repeat=3))  # with points inside and in the faces
        square, segment, dot = hull(*itertools.product((0, 1, 2), (0, 1, 2), (5,))), hull((0, 0, 0), (2, 2, 2), (1, 1, 1)), hull((1, 2, 3), (1, 2, 3))
        self.assertEqual([h.dimension for h in (cube, square, segment, dot)], [3, 2, 1, 0])
        self.assertEqual([len(h.sides) for h in (cube,)], [6])
        for h, inside, border, outside in ((cube, (1, 1, 1), (1, 1, 2), (1, 1, 2.5)), (square, (1, 1, 5), (1, 2, 5), (1, 1, 4)),
                                           (segment, (1, 1, 1), (2, 2, 2), (1, 1, 0))):
            self.assertTrue(h.inside(at(inside)) and h.contains(at(border)) and not h.inside(at(border)))
            self.assertFalse(h.contains(at(outside)))
        self.assertTrue(dot.inside(at((1, 2, 3))) and not dot.contains(at((1, 2, 3.5))))

    def test_the_command_line(self):
        ran = subprocess.run([sys.executable, SCRIPT, "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertIn("exit codes", ran.stdout)
        self.assertLessEqual(len(SCRIPT.read_text().splitlines()), 500)
        self.assertIn("MIT", SCRIPT.read_text()[:400])
        for arguments in ((), ("judge",), ("check", "a.off"), ("check", "a.off", "b.json")):
            ran = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(ran.returncode, 2, ran.stderr)
        self.reject("not-there", "suite", "not-there", code=2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
