#!/usr/bin/env python3
"""The second opinion (validate/second_opinion). Each kind of proof: what is right is accepted, and every forgery rejected.
Usage: proofs_test.py CLUES SOURCES"""
import contextlib
import copy
import itertools
import json
import sys
import unittest
from collections import Counter
from fractions import Fraction
from random import Random

from support import (
    BOX, CELL, P, POINT, SEGMENT, SQUARE, TARGET, V, Folder, judgement, obj, off, second_opinion)


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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
