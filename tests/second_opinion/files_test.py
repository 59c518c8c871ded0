#!/usr/bin/env python3
"""The second opinion (validate/second_opinion). Files as a whole: the suite, judgements, findings; and how files are read.
Usage: files_test.py CLUES SOURCES"""
import copy
import hashlib
import itertools
import json
import shutil
import subprocess
import sys
import time
import unittest
from collections import Counter

from support import BLIND, CELL, SCREENS, SCRIPT, SOURCES, Folder, both, judgement, second_opinion


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
