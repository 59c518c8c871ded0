#!/usr/bin/env python3
"""Makes the seed corpus of the coverage-guided targets: small valid files of every kind, a few broken ones, small scenes of vectors/, and what
campaigns found. Deterministic. (Those of bsp/ and gltf/ are what tests/levels/made_level.cpp and made_gltf.cpp write; town* in contours/ is what `clues delta contours` wrote, without the hash in its end.) Files that a fuzzer found are added by hand, under names of their own, and stay."""
import json
import pathlib
import sqlite3
import struct
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SUITE = HERE.parent.parent / "vectors"


def put(target, name, data):
    folder = HERE / target
    folder.mkdir(exist_ok=True)
    (folder / name).write_bytes(data.encode() if isinstance(data, str) else data)


POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def obj():
    v = "".join("v %g %g %g\n" % p for p in POINTS)
    put("obj", "tetrahedron", v + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in FACES))
    put("obj", "relative_quad", "# c\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf -4/1/1 -3//1 -2/1 -1\n")
    put("obj", "words", "o a\ng b\ns off\nusemtl m\nmtllib m.mtl\n" + v + "f 1 2 \\\n 3\r\nl 1 2\n")
    put("obj", "numbers", "v 1e-320 0x1.8p+3 -0.0\nv +.5 5. 1E+308\nv 1 2 3 1\nf 1 2 3\n")
    put("obj", "edges", v + "f 1/ 2/ 3/\nfo 1 2 4\nf 1 2\n\x1a")
    put("obj", "bad_index", v + "f 1 2 9\n")


def off():
    body = "".join("%g %g %g\n" % p for p in POINTS) + "".join("3 %d %d %d\n" % f for f in FACES)
    put("off", "tetrahedron", "OFF\n4 4 6\n" + body)
    put("off", "polygon", "OFF 5 1 0 # c\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4 255 0 0\n")
    put("off", "colours", "COFF\n3 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2\n")
    put("off", "points", "OFF\n2 0 0\n0 0 0\n1 1 1\n")
    put("off", "free", "4 4 6 " + body.replace("\n", " "))
    put("off", "binary", b"OFF BINARY\n" + struct.pack(">3i", 4, 4, 6) + b"".join(struct.pack(">3f", *p) for p in POINTS) +
        b"".join(struct.pack(">5i", 3, *f, 0) for f in FACES))
    put("off", "short", "OFF\n4 4 6\n0 0 0\n")


def ply():
    head = "ply\nformat %s 1.0\ncomment c\nelement vertex 4\nproperty %s x\nproperty %s y\nproperty %s z\n" \
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    text = "".join("%g %g %g\n" % p for p in POINTS) + "".join("3 %d %d %d\n" % f for f in FACES)
    put("ply", "ascii", head % ("ascii", "float", "float", "float") + text)
    for order, mark in (("little", "<"), ("big", ">")):
        for kind, letter in (("float", "f"), ("double", "d")):
            data = b"".join(struct.pack(mark + 3 * letter, *p) for p in POINTS)
            data += b"".join(struct.pack(mark + "Biii", 3, *f) for f in FACES)
            put("ply", order + "_" + kind, (head % ("binary_%s_endian" % order, kind, kind, kind)).encode() + data)
    put("ply", "more_properties",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement face 1\nproperty list uint8 uint32 vertex_index\n"
        "property short s\nend_header\n9 0 0 0\n9 1 0 0\n9 0 1 0\n0 1\n3 0 1 2 7\n")
    put("ply", "strips",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
        "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n8 0 1 2 3 -1 3 2 0\n")
    put("ply", "short", head % ("binary_little_endian", "float", "float", "float"))


def stl():
    facets = "".join("facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n" %
                     "".join("vertex %g %g %g\n" % POINTS[i] for i in f) for f in FACES)
    put("stl", "ascii", "solid s\n" + facets + "endsolid s\n")
    put("stl", "two_solids", 2 * ("solid\n" + facets + "endsolid\n"))
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *POINTS[a], *POINTS[b], *POINTS[c], 0) for a, b, c in FACES)
    put("stl", "binary", b"solid that is none".ljust(80) + struct.pack("<I", 4) + triangles)
    put("stl", "binary_short", b"".ljust(80) + struct.pack("<I", 5) + triangles)


def json_texts():
    put("json", "values", '{"a": [1, -2, 0.5, 1e3, -0.0, true, null, "\\u00e4\\n"], "b": {"a": {}}, "c": [[], [[]]]}\n')
    put("json", "number", "18446744073709551616")
    put("json", "deep", 32 * "[" + 32 * "]")
    put("json", "too_deep", 33 * "[" + 33 * "]")
    put("json", "twice", '{"a": 1,\n"\\u0061": 2}')
    put("json", "nul", b"{}\0")
    put("json", "too_large", "[1e999]")


def cell_and_pvs():
    for i, text in enumerate(["box:0,0,0,1,1,1", "box:-0x1p-3,-0,1e-5,0,0,1e-5", "grid:2x1x3:box:0,0,0,1,1,1", "box:0,0,0,1,1,-1",
                              "box:1,2,3", "grid:0x1x1:box:0,0,0,1,1,1"]):
        put("cell_and_pvs", "cell_%d" % i, text)
    put("cell_and_pvs", "list", bytes([12 * 2]) + b"# a PVS\n0\n3\n\n 11 # last\n3\n")
    put("cell_and_pvs", "list_too_large", bytes([3 * 2]) + b"0\n3\n")
    result = {"format": "clues-result/1", "scene": {"file": "a.off", "triangles": 12}, "visible": [0, 3, 11]}
    put("cell_and_pvs", "result", bytes([12 * 2 + 1]) + json.dumps(result).encode())
    put("cell_and_pvs", "result_of_another", bytes([3 * 2 + 1]) + json.dumps(result).encode())


def suite_files():
    return [json.loads(f.read_text()) for f in sorted(SUITE.glob("*.json")) if f.name not in ("index.json", "schema.json")]


def vectors():
    for file in suite_files():
        smallest = min(file["cases"], key=lambda c: (len(json.dumps([c, file["scenes"][c["scene"]]])), c["id"]))
        file["cases"] = [smallest]
        file["scenes"] = {smallest["scene"]: file["scenes"][smallest["scene"]]}
        file["notes"] = {f: file["notes"][f] for f in smallest["flags"]}
        topic, file["topic"] = file["topic"], "file"  # the target calls it file.json
        text = json.dumps(file, separators=(",", ":"))
        if len(text) < 4000:
            put("vectors", topic, text)
    put("vectors", "index", '{"format":"clues-vectors-index/1","active":1,"withdrawn":1,"topics":{"a":1},"cases":{'
        '"one":{"topic":"a","status":"active"},"two":{"topic":"a","status":"withdrawn","reason":"wrong"}}}')
    put("vectors", "not_json", "{")


def protocol():
    scene = '{"vertices":[[0.0,0.0,2.0],[1.0,0.0,2.0],[-0.0,1e-300,2.0]],"triangles":[[0,1,2]]}'
    put("protocol", "session", '{"cmd":"start","protocol":1}\n'
        '{"cmd":"run","seq":1,"case":{"id":"a","mode":"sheet","cell":[[0.0,0.0,0.0]],"scene":%s}}\n{"cmd":"stop"}\n' % scene)
    put("protocol", "replies", '{"protocol":1,"implementation":{"name":"n","version":"1","language":"C"},'
        '"capabilities":{"modes":["sheet","solid"],"input":"float64"}}\n{"seq":1,"result":{"visible":[0,3,11]}}\n'
        '{"seq":1,"skipped":{"message":"no","issue_url":"https://example.org/1"}}\n{"seq":1,"errored":{"message":"no"}}\n')
    put("protocol", "refused", '{"cmd":"run"}\n{"seq":2,"result":{"visible":[12]}}\n[]\n')


def scene_bytes(points, cell, triangles, tail=b""):
    if not (3 <= len(points) <= 12 and 1 <= len(triangles) <= 4 and 1 <= len(cell) <= 8):
        return None
    data = bytes([len(points) - 3, len(triangles) - 1, len(cell) - 1])
    for p in points + cell:
        for x in p:
            if x * 16 != int(x * 16) or abs(x * 16) > 32767:
                return None
            data += struct.pack("<h", int(x * 16))
    return data + bytes(i for t in triangles for i in t) + tail


def scene_to_verdict():
    points = lambda rows: [tuple(float.fromhex(x) for x in row) for row in rows]
    per_topic = {}
    for file in suite_files():
        for case in file["cases"]:
            scene = file["scenes"][case["scene"]]
            data = scene_bytes(points(scene["vertices"]), points(case["cell"]), scene["triangles"])
            if data and case["mode"] == "sheet":
                per_topic.setdefault(file["topic"], {})[data] = case["id"]
    for found in per_topic.values():
        for data, name in sorted(found.items(), key=lambda item: (len(item[0]), item[1]))[:2]:
            put("scene_to_verdict", name, data)
    box = [(x, y, z) for z in (-2, 1) for y in (-1, 1) for x in (2, 3)]
    corner = [(4, 0, 0), (5, 1, 0), (5, 0, 0), (5, 0, 1)]  # tests/fuzz/found_test.cpp
    put("scene_to_verdict", "found-two-triangles-at-a-corner", scene_bytes(corner, box, [(0, 1, 2), (0, 2, 3)]))
    put("scene_to_verdict", "found-two-triangles-at-a-corner-one-ulp-off",
        scene_bytes(corner, box, [(0, 1, 2), (0, 2, 3)], bytes([4, 1, 13, 255])))


def result():
    good = {"format": "clues-result/1", "scene": {"file": "a.off", "sha256": 64 * "a", "triangles": 12}, "mode": "sheet",
            "cell": {"vertices": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]}, "visible": [0, 3, 11]}
    put("result", "whole", json.dumps(good, indent=2, sort_keys=True) + "\n")
    put("result", "says_nothing", '{"format":"clues-result/1","visible":[]}')
    for name, change in (("other_scene", {"scene": {"sha256": 64 * "b"}}), ("other_cell", {"cell": {"vertices": [[0, 0, 1]]}}),
                         ("other_mode", {"mode": "solid"}), ("cell_is_none", {"cell": [1]})):
        put("result", name, json.dumps({**good, **change}))


FINDING = {"oracle": "sight-lines", "verdict": "hidden/visible", "explanation": "it is seen", "generator": "loose_triangles", "seed": 1, "index": 0}
LINE = {"triangle": 0, "v": ["0", "0", "0"], "p": ["1/4", "1/4", "2"]}


def finding():
    about = {**FINDING, "format": "clues-finding/2", "mode": "sheet", "subject": "reference", "scenes": [], "shrink_steps": 3, "sha256": {}}
    scene, cell = "OFF\n3 1 0\n0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n", "v 0 0 0\n"
    parts = lambda a, w: "\0".join([json.dumps(a), scene, cell, json.dumps(w)])
    put("finding", "folder", parts(about, {**LINE, "side": "back"}))
    put("finding", "without_a_line", parts({**about, "verdict": "no-answer/answer", "oracle": "subject"}, {}))
    put("finding", "empty_witness", parts(about, {}))
    put("finding", "triangle_out_of_range", parts(about, {**LINE, "side": "back", "triangle": 1}))
    put("finding", "stored", json.dumps(stored()))


def stored():
    return {**FINDING, "points": [[0, 0, 2], [1, 0, 2], [0, 1, 2]], "triangles": [[0, 1, 2]], "cell": [[0, 0, 0]], "triangle": 0,
            "witness": {**LINE, "front": False}}


def store():
    tables = ("CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
              "CREATE TABLE counters (name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID",
              "CREATE TABLE contradictions (id INTEGER PRIMARY KEY, text TEXT NOT NULL)",
              "CREATE TABLE findings (id INTEGER PRIMARY KEY, signature TEXT NOT NULL UNIQUE, case_number INTEGER NOT NULL,"
              " occurrences INTEGER NOT NULL, finding TEXT NOT NULL, folder TEXT)")
    good = tables + ("INSERT INTO about VALUES ('plan', 'plan')", "INSERT INTO about VALUES ('cases done', '7')",
                     "INSERT INTO counters VALUES ('triangles hidden', 5)",
                     "INSERT INTO findings VALUES (1, 's', 3, 2, '%s', 'folder')" % json.dumps(stored()))
    for name, statements in (("whole", good), ("begun", tables[:2]), ("of_another_plan", good + ("UPDATE about SET value = 'other'",)),
                             ("trigger", good + ("CREATE TRIGGER t AFTER UPDATE ON about BEGIN DELETE FROM findings; END",)),
                             ("finding_is_none", good + ("UPDATE findings SET finding = '{}'",))):
        put("store", name, database(statements))


def database(statements):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "store"
        base = sqlite3.connect(file)
        base.execute("PRAGMA page_size = 512")
        for statement in statements:
            base.execute(statement)
        base.commit()
        base.close()
        return file.read_bytes()


def bake():
    # A list of 12 triangles as zstd packs what it cannot make shorter: one raw block.
    packed = lambda bits: "x'" + (b"\x28\xb5\x2f\xfd\x20" + bytes([len(bits), 8 * len(bits) + 1, 0, 0]) + bits).hex() + "'"
    points = "x'" + struct.pack("<12d", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1).hex() + "'"
    good = ("CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
            "CREATE TABLE nodes (id INTEGER PRIMARY KEY, node INTEGER NOT NULL, points BLOB NOT NULL,"
            " list BLOB, listed INTEGER, fallbacks INTEGER, mapped INTEGER, passes INTEGER)",
            "CREATE TABLE cells (id INTEGER PRIMARY KEY, name TEXT NOT NULL, node INTEGER NOT NULL, cluster INTEGER,"
            " points BLOB NOT NULL, inner BLOB, list BLOB, listed INTEGER, fallbacks INTEGER, mapped INTEGER, passes INTEGER)",
            "INSERT INTO about VALUES ('format', 'clues-bake/1'), ('scene', 'a.obj'), ('scene_sha256', '00'), ('triangles', '12'),"
            " ('question', '{}'), ('note', ''), ('finished', 'yes')",
            f"INSERT INTO nodes VALUES (1, 0, {points}, {packed(bytes([0xff, 0x0f]))}, 12, 0, 12, 1)",
            f"INSERT INTO cells VALUES (0, 'a', 1, -1, {points}, NULL, {packed(bytes([0x81, 0x08]))}, 3, 0, 12, 1)",
            f"INSERT INTO cells VALUES (1, 'b', 0, 7, {points}, {points}, {packed(bytes(2))}, 0, 2, 12, 1)")
    for name, more in (("whole", ()), ("without_nodes", ("DELETE FROM nodes", "UPDATE cells SET node = 0")), ("begun", ("UPDATE about SET value = 'no' WHERE name = 'finished'",)),
                       ("list_of_another_length", (f"UPDATE cells SET list = {packed(bytes(3))}",)),
                       ("triangle_that_is_none", (f"UPDATE cells SET list = {packed(bytes([1, 0x80]))}",)),
                       ("point_at_infinity", ("UPDATE cells SET points = x'" + struct.pack("<3d", 0, float("inf"), 0).hex() + "'",)),
                       ("view", ("CREATE VIEW v AS SELECT * FROM cells",))):
        put("bake", name, database(good + more))


def report():
    none = {"overestimate_qo": None, "underestimate_qu": {"at_least": 0.0, "at_most": 0.5}}
    end = lambda p: {"exact": p, "estimate": [0.0, 0.0, 0.0]}
    judgement = {"format": "clues-judgement/1", "verdict": "unsound", "scene": "<b>.off", "cell": [[0.0, 0.0, 0.0]],
                 "triangles_measured": none, "area_measured": none, "triangles": ["missing-visible", "exact"],
                 "witnesses": [{"triangle": 0, "side": "front", "v": end(LINE["v"]), "p": end(LINE["p"])}],
                 "chains": [{"triangle": 1, "side": "back", "links": [{"v": end(LINE["v"]), "x": end(LINE["p"])}]}]}
    put("report", "judgement", json.dumps(judgement))
    conformance = {"format": "clues-conformance/1", "implementation": {"name": "<script>", "version": "1"}, "subject": "s", "suite": "vectors",
                   "repeat": "clues conform", "total": {"cases": 1, "outcomes": {"unsound": 1}, "overestimate_qo": 0.5, "underestimate_qu": None},
                   "cases": [{"id": "a", "outcome": "unsound", "extra": [1], "missed": [{"triangle": 0, "side": "front", "v": LINE["v"], "p": LINE["p"]}]}]}
    put("report", "conformance", json.dumps(conformance))
    put("report", "of_others", '{"name": "package"}')
    put("report", "cut_short", json.dumps(judgement)[:200])
    put("report", "of_another_version", '{"format": "clues-judgement/9"}')


def contours():
    def head(version=1, cells=1):
        return b"CLUESCON" + struct.pack("<I", version) + bytes(32) + bytes([13, 5, 0]) + struct.pack("<d", 0) + bytes([cells])

    def cell(within=0, body=bytes([0, 0, 1, 0, 2, 1, 1]), corner=(0, 0, 1)):
        return b"\1c" + bytes([within, 1, 0, 1]) + struct.pack("<3d", *corner) + b"\0" + body

    put("contours", "whole_triangle", head() + cell())
    put("contours", "a_cell_within_another", head(cells=2) + cell() + cell(within=1, body=bytes([0, 0, 0])))
    put("contours", "no_cells", head(cells=0))
    put("contours", "another_version", head(version=2) + cell())
    put("contours", "within_itself", head() + cell(within=1))
    put("contours", "seed_beside_its_triangle", head() + cell(body=bytes([0, 0, 1, 0, 2, 2, 2])))
    put("contours", "two_forms", head() + cell(body=bytes([0, 0, 1, 0x80, 0, 2, 1, 1])))
    put("contours", "corner_at_infinity", head() + cell(corner=(0, 0, float("inf"))))
    # Two lines across each other, and a bridge that is none.
    full = b"".join(b"\4" + b"".join(bytes([len(x)]) + x for x in at)
                    for at in ((b"0", b"0", b"4"), (b"2", b"2", b"4"), (b"2", b"0", b"4"), (b"0", b"2", b"4")))
    put("contours", "crossed_segments",
        head() + cell(body=bytes([0, 1, 4, 8 * 4 + 1 + 4]) + full + bytes([1, 1, 0, 1, 0, 0, 1, 4, 1, 3, 2, 1, 1])))


def stream():
    def packet(kind, form, *numbers, tail=b""):
        body = struct.pack("<B" + form, kind, *numbers) + tail
        return struct.pack("<I", len(body)) + body

    text = lambda t: struct.pack("<I", len(t)) + t
    magic = b"CLUESSTR"
    header = packet(0, "IQQ", 1, 12, 4, tail=text(b"ab" * 32) + text(b"grid:2x2x1:box:0,0,0,1,1,1"))
    plus = packet(1, "I" + 3 * "I3d" + "I5I", 3, 1, 0, 0, 0, 2, 1, 0, 0, 3, 0, 1, 0.5, 1, 7, 1, 1, 2, 3)
    minus = packet(3, "II" + "I2I", 1, 7, 2, 1, 2)
    session = plus + packet(2, "I", 3) + minus
    put("stream", "session", magic + header + session)
    put("stream", "header_alone", magic + header)
    put("stream", "cut_short", (magic + header + session)[:-3])
    put("stream", "another_version", magic + packet(0, "IQQ", 2, 12, 4, tail=text(b"") + text(b"")))
    put("stream", "point_at_infinity", magic + header + packet(1, "II3dI", 1, 1, 0, float("inf"), 0, 0))
    put("stream", "slot_zero", magic + header + packet(1, "II5I", 0, 1, 7, 0, 1, 2, 3))
    put("stream", "count_of_more_than_there_is", magic + header + packet(1, "I", 0xffffffff))
    put("stream", "end_in_a_file", magic + header + packet(4, "Q", 0))
    put("stream", "endless_packet", magic + header + struct.pack("<I", 0xffffffff))
    put("stream", "requests", packet(16, "I", 0) + packet(16, "I", 11) + packet(17, "QI3I", 5, 3, 0, 1, 2))
    put("stream", "cell_that_is_none", packet(16, "I", 12))
    put("stream", "empty_packet", struct.pack("<I", 0))


def motion():
    tetrahedron = [[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1, "direction"]]
    triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    mesh = {"format": "clues-depth-mesh/1", "samples": tetrahedron, "triangles": triangles}
    put("motion", "mesh", json.dumps(mesh) + "\n")
    put("motion", "mesh_with_all_kinds", json.dumps(dict(mesh, samples=[[1, 1, 1, "base-point"], [-1, -1, 1e-320, "base-direction"],
                                                                        [-1, 1, -1, "point"], [1.5e308, -1, -1]])) + "\n")
    put("motion", "mesh_corner_beyond", json.dumps(dict(mesh, triangles=[[0, 1, 4]])) + "\n")
    put("motion", "mesh_direction_zero", json.dumps(dict(mesh, samples=[[0, 0, 0, "direction"]], triangles=[])) + "\n")
    limits = {"kappa": 2000, "sigma": 4e-14, "delaunay": True}
    bounds = {"format": "clues-motion-bounds/1", "viewpoint": [0, 0.5, 0], "thresholds": limits, "bounds": [0, 0.1, None, 5e-324]}
    put("motion", "bounds", json.dumps(bounds) + "\n")
    put("motion", "bounds_negative", json.dumps(dict(bounds, bounds=[-1])) + "\n")
    head = json.dumps({"format": "clues-motion-walk/1"}) + "\n"
    first = {"sizes": [4, 5], "samples": [[i, *s] for i, s in enumerate(tetrahedron)],
             "triangles": [[i, *t] for i, t in enumerate(triangles)], "thresholds": limits, "viewpoint": [0, 0, 0]}
    frames = [first, {"viewpoint": [0.25, 0, 0]}, {"triangles": [[0], [4, 0, 2, 1]], "samples": [[3, 2, -1, -1]], "viewpoint": [0, 0, 0]},
              {"sizes": [3, 0], "viewpoint": [1e300, 0, 0]}]
    put("motion", "walk", head + "".join(json.dumps(f) + "\n" for f in frames))
    put("motion", "walk_without_frames", head)
    put("motion", "walk_sizes_of_a_damaged_file", head + json.dumps(dict(first, sizes=[60000000, 60000000])) + "\n")
    put("motion", "walk_free_places_of_a_damaged_file", head + json.dumps(dict(first, sizes=[4, 60000000])) + "\n")
    put("motion", "walk_names_a_sample_that_is_gone", head + json.dumps(first) + '\n{"sizes": [3, 5], "viewpoint": [0, 0, 0]}\n')
    put("motion", "way", "# there and back\n0 0 0\n1e-3 0 0\r\n0 0 0\n0 0 0\n1e9 -5 .5")
    put("motion", "way_with_nan", "0 0 0\nnan 0 0\n")
    put("motion", "way_of_nothing", "# nothing\n")


def maps():
    files = {c["id"]: c["lines"] for c in json.loads((SUITE / "multires" / "hierarchy-files.json").read_text())["cases"]}
    for name in ("octahedron", "feature-line", "flipped-piece", "neighbours-in-one-level"):
        put("maps", "hierarchy_" + name.replace("-", "_"), "\n".join(files["file-" + name]) + "\n")
    put("maps", "hierarchy_of_many_levels", "clues-maps 1\nvertices 0\ntriangles 0\nfeatures 0\nfixed 0\nlevels 4000000000\n")
    whole = 1 << 60
    corners = "".join("1 %d %d\n" % (v, whole) for v in range(3))
    same = "".join("1 %d %d 1 %d %d\n" % (v, whole, v, whole) for v in range(3))
    head = "clues-remesh 1\nbounds 0 %s\nparameters 4\n" + corners + "2 0 %d 2 %d\n" % (whole // 2, whole // 2)
    rest = "triangles 1\n0 1 2\npoints 3\n" + same + "pieces 1\n0 1 2 0 0\n"
    put("maps", "proof", head % "0.1" + rest)
    put("maps", "proof_without_bound", head % "none" + rest)
    put("maps", "proof_corner_beyond", head % "0" + rest.replace("0 1 2 0 0", "0 1 3 0 0"))
    put("maps", "features", "# an edge, a vertex\n0 1\n7\r\n3 2")
    put("maps", "plain_map", "0 1 0\n3 0.25 0x1p-2 1/2\n1 1/3 1/3\n")
    put("maps", "plain_map_of_one_coordinate", "0 1 0\n3 0.25\n4 -1 2\n")


def lists():
    # Two cells with one corner each, in the small scene of the target (5 triangles): records by level.
    def file(levels, cells=2, version=1, triangles=5, coordinates=(0.0, 2.0)):
        out = b"CLUESLST" + struct.pack("<I", version) + bytes(32) + bytes([triangles, 1]) + b"q"
        out += bytes([len(coordinates)]) + b"".join(struct.pack("<d", x) for x in coordinates)
        out += bytes([cells]) + b"".join(bytes([1, 48 + c, 1, 0, min(1, len(coordinates) - 1), 0, 0]) for c in range(cells))
        out += bytes([len(levels)])
        for i, level in enumerate(levels):
            if i + 1 < len(levels):
                out += bytes([len(level)])
            for record in level:
                out += (bytes([0]) if i > 0 else b"") + bytes(record)
        return out

    node = [(0, 3, 0, 0, 1)]  # triangles 0, 1, 3
    put("lists", "plain", file([[(0, 2, 0, 1), (0, 0)]]))
    put("lists", "all_and_goes", file([node, [(1,), (2, 1, 1)]]))
    put("lists", "contour_and_same", file([node, [(3, 1, 0, 0), (4, 0)]]))
    put("lists", "contour_and_changed", file([node, [(3, 1, 0, 1, 2), (5, 0, 1, 3, 0)]]))
    put("lists", "delta", file([[(0, 1, 4), (6, 0, 1, 0, 1, 4)]]))
    put("lists", "more_than_around", file([node, [(0, 1, 4), (1,)]]))
    put("lists", "edge_that_there_is_not", file([node, [(3, 1, 0, 1, 14), (1,)]]))
    put("lists", "seed_too_many", file([node, [(3, 2, 0, 0, 0), (1,)]]))
    put("lists", "of_itself", file([[(4, 0), (0, 0)]]))
    put("lists", "no_cells", file([[]], cells=0))
    put("lists", "another_version", file([[(0, 0), (0, 0)]], version=2))
    put("lists", "coordinate_not_used", file([[(0, 0), (0, 0)]], coordinates=(0.0, 2.0, 3.0)))


for make in (obj, off, ply, stl, json_texts, cell_and_pvs, vectors, protocol, result, finding, store, bake, motion, maps, contours, lists, stream, report, scene_to_verdict):
    make()
