#!/usr/bin/env python3
"""vectors/multires/schema.json and the reader of `clues` say the same: every file satisfies both, and every planted malformed
file is rejected by both. Usage: multires_schema_test.py CLUES VECTORS_MULTIRES"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "motion"))
sys.dont_write_bytecode = True
import motion_schema_test as suites  # noqa: E402

# Each takes the text of a topic and makes it one that nobody may accept.
PLANTED = {
    "another format": lambda t: t.update(format="clues-multires-vectors/2"),
    "a field too many": lambda t: t.update(more=1),
    "no cases": lambda t: t.update(cases=[]),
    "a case without an id": lambda t: t["cases"][0].pop("id"),
    "an id with capitals": lambda t: t["cases"][0].update(id="Fan"),
    "a comment that says nothing": lambda t: t["cases"][0].update(comment="short"),
    "a case of no kind": lambda t: t["cases"][0].update(kind="solid"),
    "a case of another kind": lambda t: t["cases"][0].update(kind="plain"),
    "a field of another kind": lambda t: t["cases"][0].update(lines=["clues-maps 1"]),
    "no triangles": lambda t: t["cases"][0].update(triangles=[]),
    "a triangle with two corners": lambda t: t["cases"][0]["triangles"].append([0, 1]),
    "a vertex with two coordinates": lambda t: t["cases"][0]["vertices"].append([0, 1]),
    "a vertex as text": lambda t: t["cases"][0]["vertices"].append("0 0 0"),
    "a feature of one vertex": lambda t: t["cases"][0].update(features=[[0]]),
    "a word that is none": lambda t: t["cases"][0]["expect"]["vertices"].__setitem__(0, "gone"),
    "no genus": lambda t: t["cases"][0]["expect"].pop("genus"),
    "refused, and a genus": lambda t: t["cases"][0]["expect"].update(refused={"vertex": 0}),
    "refused nowhere": lambda t: t["cases"][0].update(expect={"refused": {}}),
    "refused in two places": lambda t: t["cases"][0].update(expect={"refused": {"vertex": 0, "triangle": 0}}),
}

suites.agree(sys.argv[1], pathlib.Path(sys.argv[2]), PLANTED)
