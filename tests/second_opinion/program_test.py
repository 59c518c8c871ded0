#!/usr/bin/env python3
"""The second opinion (validate/second_opinion). What the program prints of real scenes is confirmed.
Usage: program_test.py CLUES SOURCES"""
import json
import pathlib
import re
import sys
import unittest
from collections import Counter
from fractions import Fraction

from support import FOUND, SOURCES, Folder, off, second_opinion


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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
