#!/usr/bin/env python3
"""vectors/motion/schema.json and the reader of `clues` say the same: every file satisfies both, and every planted malformed
file is rejected by both. Usage: motion_schema_test.py CLUES VECTORS_MOTION"""
import copy
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "validate"))
sys.dont_write_bytecode = True
import vectors_schema_test as checker  # noqa: E402

checker.TYPES["number"] = (int, float)

# Each takes the text of a topic and makes it one that nobody may accept.
PLANTED = {
    "another format": lambda t: t.update(format="clues-motion-vectors/2"),
    "a field too many": lambda t: t.update(more=1),
    "no cases": lambda t: t.update(cases=[]),
    "a case without an id": lambda t: t["cases"][0].pop("id"),
    "an id with capitals": lambda t: t["cases"][0].update(id="Edge"),
    "a comment that says nothing": lambda t: t["cases"][0].update(comment="short"),
    "a field too many in a case": lambda t: t["cases"][0].update(hidden=[1]),
    "sigma beyond 1": lambda t: t["cases"][0]["thresholds"].update(sigma=2),
    "an angle as threshold": lambda t: t["cases"][0]["thresholds"].update(phi=0.1),
    "a sample with two numbers": lambda t: t["cases"][0]["samples"].append([0, 1]),
    "a sample of no kind": lambda t: t["cases"][0]["samples"].append([0, 1, 2, "sky"]),
    "a triangle with two corners": lambda t: t["cases"][0]["triangles"].append([0, 1]),
    "a bound below 0": lambda t: t["cases"][0]["expect"]["sound"].__setitem__(0, -1),
    "a bound as text": lambda t: t["cases"][0]["expect"]["sound"].__setitem__(0, "1"),
    "no violations": lambda t: t["cases"][0]["expect"].pop("violated"),
    "an exact bound without its square": lambda t: t["cases"][0]["expect"].update(exact=[["facing", 0, 0]]),
}


def lint(clues, folder):
    return subprocess.run([clues, "lint", str(folder), "--case", "no-such-case"], capture_output=True, text=True,
                          check=False)


def agree(clues, vectors, planted):
    """Of any suite beside the one about visibility."""
    schema = json.loads((vectors / "schema.json").read_text())
    files = [f for f in sorted(vectors.glob("*.json")) if f.name != "schema.json"]
    assert files, "no topics"
    for file in files:
        found = checker.errors(json.loads(file.read_text()), schema, schema)
        assert not found, (file, found)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        shutil.copy(vectors / "schema.json", folder)
        good = json.loads(files[0].read_text())
        target = folder / files[0].name
        for what, plant in planted.items():
            bad = copy.deepcopy(good)
            plant(bad)
            target.write_text(json.dumps(bad))
            assert checker.errors(bad, schema, schema), f"the schema takes {what}"
            run = lint(clues, folder)
            assert run.returncode == 2 and target.name in run.stdout + run.stderr, f"the reader takes {what}: {run}"
    print(f"{len(files)} topics, {len(planted)} planted files: schema and reader agree")


if __name__ == "__main__":
    agree(sys.argv[1], pathlib.Path(sys.argv[2]), PLANTED)
