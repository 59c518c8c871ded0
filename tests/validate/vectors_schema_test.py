#!/usr/bin/env python3
"""vectors/schema.json and the reader of `clues` say the same: every file of the suite satisfies both, and every planted
malformed file is rejected by both. Usage: vectors_schema_test.py CLUES VECTORS

The checker below knows just the words that the schema uses, and fails on any other."""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

WORDS = {"$schema", "$defs", "$ref", "title", "description", "type", "properties", "required", "additionalProperties",
         "propertyNames", "minProperties", "items", "minItems", "maxItems", "pattern", "minLength", "minimum", "maximum",
         "enum", "const", "oneOf"}
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None), "integer": int}


def is_type(value, name):
    return isinstance(value, TYPES[name]) and not (name == "integer" and isinstance(value, bool))


def errors(value, schema, root, path="$"):
    """The list of violations."""
    assert set(schema) <= WORDS, set(schema) - WORDS
    if "$ref" in schema:
        return errors(value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root, path)
    found = []
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(is_type(value, t) for t in types):
        return [f"{path}: not {types}"]
    if "const" in schema and (value != schema["const"] or type(value) is not type(schema["const"])):
        found.append(f"{path}: not {schema['const']}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{path}: not one of {schema['enum']}")
    if "oneOf" in schema and sum(not errors(value, s, root, path) for s in schema["oneOf"]) != 1:
        found.append(f"{path}: not exactly one alternative")
    if isinstance(value, str):
        if "pattern" in schema and not re.search(schema["pattern"], value):
            found.append(f"{path}: {value!r} does not match")
        if len(value) < schema.get("minLength", 0):
            found.append(f"{path}: too short")
    if is_type(value, "integer") and not schema.get("minimum", value) <= value <= schema.get("maximum", value):
        found.append(f"{path}: out of range")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{path}: wrong length")
        for i, item in enumerate(value):
            found += errors(item, schema.get("items", {}), root, f"{path}[{i}]")
    if isinstance(value, dict):
        found += [f"{path}: no {key}" for key in schema.get("required", []) if key not in value]
        if len(value) < schema.get("minProperties", 0):
            found.append(f"{path}: too few")
        for key, item in value.items():
            if "propertyNames" in schema:
                found += errors(key, schema["propertyNames"], root, f"{path}.{key}")
            rest = schema.get("additionalProperties", {})
            part = schema.get("properties", {}).get(key, rest)
            if part is False:
                found.append(f"{path}: unknown {key}")
            elif part is not True:
                found += errors(item, part, root, f"{path}.{key}")
    return found


def at(value, path):
    for step in path[:-1]:
        value = value[step]
    return value, path[-1]


def planted(good):
    """(name, malformed copy): one for every rule of the schema that a writer may break."""
    case, expect = ["cases", 0], ["cases", 0, "expect"]
    scene = ["scenes", next(iter(good["scenes"]))]
    note = ["notes", next(iter(good["notes"]))]
    vertex = scene + ["vertices", 0]
    seen = next(i for i, s in enumerate(good["cases"][0]["expect"]["must_be_visible"]) if "v" in s)
    witness = expect + ["must_be_visible", seen]
    replace = [
        (["format"], "clues-vectors/2"), (["topic"], "Two Words"), (["topic"], 5), (["definition"], "D"),
        (["definition"], "see D5"), (["source"], []), (["source", "version"], "2026"), (["source", "seed"], -1),
        (["source", "seed"], 1.5), (["source", "seed"], "1"), (["source", "name"], ""), (["source", "confirmed_by"], None),
        (note + ["bug_type"], "TYPO"), (note + ["description"], ""), (note + ["effect"], 1), (note + ["hazards"], ["X-1"]),
        (note + ["hazards"], "B-1"), (["scenes"], {}), (scene + ["vertices"], []), (scene + ["triangles"], []),
        (vertex, ["0x0p+0", "0x0p+0"]), (vertex, ["0x0p+0"] * 4), (vertex + [0], 1), (vertex + [0], "1.5"),
        (vertex + [0], "0x1.8P+1"), (vertex + [0], "+0x1p+0"), (vertex + [0], "0x1p0"), (vertex + [0], "nan"),
        (scene + ["triangles", 0], [0, 1]), (scene + ["triangles", 0, 0], -1), (scene + ["triangles", 0, 0], "0"),
        (scene + ["triangles", 0, 0], 1.5), (scene + ["see_through"], []), (scene + ["see_through"], ["0"]),
        (scene + ["not_counted"], [-1]), (scene + ["not_counted"], 0), (["cases"], []), (["cases"], {}), (case + ["id"], "Upper-Case"),
        (case + ["id"], "-"), (case + ["id"], ""), (case + ["comment"], ""), (case + ["flags"], []),
        (case + ["flags"], ["lower"]), (case + ["level"], "hard"), (case + ["mode"], "both"), (case + ["scene"], ""),
        (case + ["cell"], []), (case + ["cell", 0], []), (case + ["cell", 0, 0], "0x2p+0"), (expect, None),
        (expect + ["umbra"], {}), (expect + ["umbra"], [3]), (expect + ["no_surface"], [-1]),
        (expect + ["no_surface"], [True]), (expect + ["first_order_visible"], ["0"]),
        (witness + ["v"], ["0", "0"]), (witness + ["v", 0], "1/0"), (witness + ["v", 0], "01"), (witness + ["v", 0], "-0"),
        (witness + ["v", 0], "0/1"), (witness + ["v", 0], "1.5"), (witness + ["v", 0], 0), (witness + ["front"], "front"),
        (witness, {"triangle": 0, "meets_cell": False}), (witness, {"triangle": 0}),
    ]
    for path, value in replace:
        bad = copy.deepcopy(good)
        parent, key = at(bad, path)
        parent[key] = value
        yield f"{path} = {value!r}", bad
    objects = [[], ["source"], note, scene, case, expect, witness]
    for path in objects:
        bad = copy.deepcopy(good)
        parent, key = at({"root": bad}, ["root"] + path)
        parent[key]["unknown"] = 1
        yield f"{path} + unknown", bad
        for key_to_drop in list(at({"root": good}, ["root"] + path)[0][(["root"] + path)[-1]]):
            bad = copy.deepcopy(good)
            parent, key = at({"root": bad}, ["root"] + path)
            del parent[key][key_to_drop]
            yield f"{path} - {key_to_drop}", bad


def reader_accepts(clues, file, index, topic):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, f"{topic}.json").write_text(json.dumps(file))
        pathlib.Path(folder, "index.json").write_text(index)
        ran = subprocess.run([clues, "lint", folder, "--case", "-", "--json"], capture_output=True, text=True, check=False)
        report = json.loads(ran.stdout)
        malformed = [f["message"] for f in report["findings"] if f["kind"] == "malformed"]
        # A case without expectation is a draft: readable, but a finding.
        drafts = [f for f in report["findings"] if f["field"] == "expect"]
        return not malformed and not drafts


def main():
    clues, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    schema = json.loads((folder / "schema.json").read_text())
    failures = []
    files = sorted(p for p in folder.glob("*.json") if p.name not in ("schema.json", "index.json"))
    for path in files:
        failures += [f"{path.name}: {e}" for e in errors(json.loads(path.read_text()), schema, schema)]
    good = json.loads((folder / "closed-forms.json").read_text())
    good["cases"] = good["cases"][:2]
    used = {c["scene"] for c in good["cases"]}
    flags = {f for c in good["cases"] for f in c["flags"]}
    good["scenes"] = {k: v for k, v in good["scenes"].items() if k in used}
    good["notes"] = {k: v for k, v in good["notes"].items() if k in flags}
    index = (folder / "index.json").read_text()
    if errors(good, schema, schema) or not reader_accepts(clues, good, index, "closed-forms"):
        failures.append("the unspoiled file is not accepted by both")
    count = 0
    for name, bad in planted(good):
        count += 1
        if not errors(bad, schema, schema):
            failures.append(f"the schema accepts {name}")
        if reader_accepts(clues, bad, index, "closed-forms"):
            failures.append(f"the reader accepts {name}")
    print(f"{len(files)} files, {count} planted malformed files, {len(failures)} failures")
    for failure in failures:
        print(failure)
    return 1 if failures or count < 80 or not files else 0


if __name__ == "__main__":
    sys.exit(main())
