#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) the clues authors. Permission is granted to use, copy, modify and distribute this file under the MIT
# licence, whose text is in vectors/LICENSE; it comes without any warranty.
"""A second opinion on what clues prints as a proof, from the files alone (docs/second-opinion.md).

  second_opinion.py suite vectors [--case GLOB]             the expectations of the conformance suite
  second_opinion.py check SCENE --cell CELL JUDGEMENT       witnesses and chains: what clues check --json wrote
  second_opinion.py query SCENE --cell CELL ANSWERS         points and segments: what clues query --json wrote
  second_opinion.py umbra SCENE --cell CELL UMBRA           what clues map --umbra wrote
  second_opinion.py finding FOLDER                          a finding of clues fuzz

CELL is box:x0,y0,z0,x1,y1,z1 or a file, whose points have it for their hull. Files are OBJ or OFF.
exit codes: 0 all that can be checked holds; 1 something does not; 2 bad usage or input"""
# D1 to T10 are the numbers of docs/definition.md, the files those of docs/formats.md. Whole numbers decide everything:
# a point (x, y, z) is (xw, yw, zw, w) with w > 0 and no common divisor; w = 0 makes it a direction.
from __future__ import annotations
import argparse, collections, fnmatch, functools, hashlib, itertools, json, math, pathlib, re, sys
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Any as Json

Point = Plane = tuple[int, ...]  # plane (a, b, c, d): a x + b y + c z + d w is positive on its positive side
class BadInput(ValueError): """What cannot be read."""
class Flaw(Exception): """Why a proof is none."""
def need(holds: object, otherwise: str, kind: type[Exception] = Flaw) -> None:
    if not holds: raise kind(otherwise)
def demand(holds: object, otherwise: str) -> None: need(holds, otherwise, BadInput)

# --- points, planes, convex hulls -------------------------------------------------------------------------------------
def reduced(*t: int) -> Point:
    g = math.gcd(*t)
    return tuple(c // g for c in t) if g > 1 else t
def point(coordinates: Iterable[Fraction | float]) -> Point:
    exact = [Fraction(c) for c in coordinates]
    w = math.lcm(*(c.denominator for c in exact))
    return (*(c.numerator * (w // c.denominator) for c in exact), w)
def side(h: Plane, p: Point) -> int: return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3] * p[3]
def back(h: Plane) -> Plane: return (-h[0], -h[1], -h[2], -h[3])
def toward(h: Plane, p: Point) -> Plane:  # the same plane, with p not on its negative side
    return back(h) if side(h, p) < 0 else h
def across(p: Point, d: Point) -> Plane:  # the plane through p that is positive where d goes
    return (d[0] * p[3], d[1] * p[3], d[2] * p[3], -(d[0] * p[0] + d[1] * p[1] + d[2] * p[2]))
def middle(points: Iterable[Point]) -> Point:  # a point in the relative interior of their hull
    return reduced(*map(sum, zip(*points)))
def plane(a: Point, b: Point, c: Point) -> Plane:  # positive where they are seen counter-clockwise (D4); 0 on a line
    xy, xz, xw = b[0] * c[1] - b[1] * c[0], b[0] * c[2] - b[2] * c[0], b[0] * c[3] - b[3] * c[0]
    yz, yw, zw = b[1] * c[2] - b[2] * c[1], b[1] * c[3] - b[3] * c[1], b[2] * c[3] - b[3] * c[2]
    return reduced(a[1] * zw - a[2] * yw + a[3] * yz, a[2] * xw - a[0] * zw - a[3] * xz,
                   a[0] * yw - a[1] * xw + a[3] * xy, a[1] * xz - a[0] * yz - a[2] * xy)
def clip(h: Plane, polygon: Sequence[Point]) -> list[Point]:  # what is not on the negative side, of any dimension
    values, kept = [side(h, q) for q in polygon], []
    for i, q in enumerate(polygon):
        if values[i - 1] * values[i] < 0:
            kept.append(reduced(*(abs(values[i]) * a + abs(values[i - 1]) * b for a, b in zip(polygon[i - 1], q))))
        if values[i] >= 0: kept.append(q)
    return list(dict.fromkeys(kept))
class Hull:
    """D2: a convex hull of any dimension. `flats` vanish on it, `sides` are not negative on it. `faces` are triangles
    around a body; or pieces (triangles, segments, a point) of a thin hull, which is made thick to find them."""
    def __init__(self, points: Iterable[Point]) -> None:
        self.points = list(dict.fromkeys(points))
        demand(self.points, "there are no points")
        frame = self.points[:1]
        for q in self.points[1:]:
            n = len(frame)
            if n == 1 or n == 2 and any(plane(*frame, q)) or n == 3 and side(plane(*frame), q): frame.append(q)
        self.dimension, m = len(frame) - 1, middle(frame)
        normals: list[Point] = [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)]
        if self.dimension == 1:
            first = next((*h[:3], 0) for e in normals if any(h := plane(*frame, e)))
            normals = [first, (*plane(*frame, first)[:3], 0)]
        elif self.dimension > 1:
            normals = [(*plane(*frame)[:3], 0)] if self.dimension == 2 else []
        self.flats = [across(m, n) for n in normals]
        up, down = ([(*(m[i] + s * n[i] for i in range(3)), m[3]) for n in normals] for s in (1, -1))
        frame = frame + up
        faces = [[frame[i] for i in three] for three in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))]
        faces = [f if side(plane(*f), middle(frame)) > 0 else f[::-1] for f in faces]
        for q in self.points + down:  # one by one; each triangle has the others on its positive side
            values = [side(plane(*f), q) for f in faces]
            if min(values) < 0:
                edges = {(f[i - 1], f[i]) for f, s in zip(faces, values) for i in range(3) if s <= 0}
                faces = [f for f, s in zip(faces, values) if s > 0]
                faces += [[a, b, q] for a, b in edges if (b, a) not in edges]
        self.sides = list(dict.fromkeys(plane(*f) for f in faces))
        thin = [[q for q in f if q not in up] + [m] for f in faces if not set(f) & set(down)]
        self.faces = thin if normals else faces
    def contains(self, q: Point, least: int = 0) -> bool:
        return not any(side(h, q) for h in self.flats) and all(side(h, q) >= least for h in self.sides)
    def inside(self, q: Point) -> bool: return self.contains(q, 1)  # relative to its own dimension: int V of D2
    def clip(self, polygon: Sequence[Point]) -> list[Point]:
        for h in (*self.flats, *map(back, self.flats), *self.sides): polygon = clip(h, polygon)
        return list(polygon)
    def meets_inside(self, polygon: Sequence[Point]) -> bool:
        common = self.clip(polygon)
        return bool(common) and self.inside(middle(common))
class Surface:  # a triangle that has an area (D1)
    def __init__(self, number: int, corners: Sequence[Point]) -> None:
        self.number, self.corners, self.plane = number, list(corners), plane(*corners)
    @functools.cached_property
    def hull(self) -> Hull: return Hull(self.corners)
    def holds(self, q: Point) -> bool: return side(self.plane, q) == 0 and self.hull.contains(q)
    def facing(self, front: bool) -> Plane: return self.plane if front else back(self.plane)
class Scene:  # what is looked at, and the cell from which
    def __init__(self, triangles: Sequence[Sequence[Point]], cell: Hull, solid: bool,
                 passed: Iterable[int] = ()) -> None:
        self.triangles = [Surface(i, t) if any(plane(*t)) else None for i, t in enumerate(triangles)]
        self.input, self.passed = triangles, set(passed)  # D22: these do not block
        self.surfaces = [x for x in self.triangles if x and x.number not in self.passed]
        self.cell, self.fronts = cell, (True, False)[:2 - solid]
        edges = collections.Counter((t[i - 1], t[i]) for t in triangles for i in range(3) if t[i - 1] != t[i])
        demand(triangles, "a scene without triangles")
        demand(not solid or all(edges[b, a] == n for (a, b), n in edges.items()),
               "solid mode wants a closed mesh with consistent orientation (D4)")
    def surface(self, number: int) -> Surface:
        x = self.triangles[number] if number in range(len(self.triangles)) else None
        need(x, f"there is no triangle {number}, or it has no area")
        return x
    def alone(self, number: int) -> Scene:  # D22: what blocks, and the one that is asked about
        return Scene(self.input, self.cell, False, self.passed - {number}) if number in self.passed else self
    def touching(self, p: Point) -> list[Surface]: return [x for x in self.surfaces if x.holds(p)]
    def planes_at(self, p: Point) -> int: return len({max(x.plane, back(x.plane)) for x in self.touching(p)})

# --- sight lines and chains (D3, D5, D6, D8, D18) ---------------------------------------------------------------------
def blocks(x: Surface, a: Point, b: Point, with_a: bool) -> bool:
    """Whether x meets the segment from a to b; b does not count, and a where it is asked for."""
    if side(x.plane, a) * side(x.plane, b) > 0: return False
    common = x.hull.clip([a, b])
    return len(common) > 1 or bool(common) and common[0] != b and (with_a or common[0] != a)
def spoils(x: Surface, cell: Hull, v: Point, p: Point) -> bool:
    """D6 asks for an open part of int V. Whether x, which holds v, may stop viewpoints beside v in a thin cell: by what
    it has on the side of p. Beside a viewpoint in a segment, only what is in the plane with p can."""
    if cell.dimension in (0, 3) or not x.holds(v): return False
    if not any(side(h, p) for h in cell.flats): return True
    if cell.dimension == 2: return any(side(toward(cell.flats[0], p), q) > 0 for q in x.corners)
    common = plane(*cell.faces[0], p)
    ahead = toward(plane(*cell.faces[0], (*common[:3], 0)), p)
    return any(side(ahead, q) > 0 for q in clip(common, clip(back(common), x.corners)))
def check_sight(s: Scene, v: Point, p: Point) -> None:
    """D5, D6: p is seen from v and from all that is beside v in int V. By D3 nothing blocks in a solid cell."""
    need(s.cell.inside(v), "v is not in the relative interior of the cell")
    start = v
    if s.cell.dimension == 3:
        if s.cell.contains(p): return
        start = next(q for q in s.cell.clip([v, p]) if q != v)
    for x in s.surfaces:
        need(not blocks(x, start, p, start != v), f"triangle {x.number} blocks")
        need(not spoils(x, s.cell, v, p), f"v lies on triangle {x.number}, which may block beside v")
def check_chain(s: Scene, number: int, front: bool, links: Sequence[tuple[Point, Point]]) -> None:
    """D18: a witness is one link; a chain goes on with continuations (D8), each from a point in free space. The end is
    within the triangle and met from the side named, with all beside it (section 6): no other plane touches it there."""
    need(links, "the chain has no link")
    source = before = None
    for v, x in links:
        need(s.cell.inside(v), "v is not in the relative interior of the cell")
        need(not s.cell.contains(x), "x is in the cell")
        if before is None:
            check_sight(s, v, x)
        else:
            need(Hull([v, x]).inside(before), "the point before is not between v and x")
            for y in s.surfaces: need(not blocks(y, before, x, True), f"triangle {y.number} blocks between two links")
        source, before = before or v, x
    x, p = s.surface(number), before
    need(front in s.fronts, "in solid mode only fronts are seen")
    need(x.hull.inside(p), f"p is not in the relative interior of triangle {number}")
    need(side(x.facing(front), source) > 0, "does not arrive from strictly the side that is said")
    for y in s.touching(p):
        need(not any(side(x.plane, c) for c in y.corners), f"triangle {y.number} touches it at p")
# --- points against the whole cell (D18) ------------------------------------------------------------------------------
def shadow(x: Surface, p: Point, closed: bool) -> list[tuple[Plane, bool]]:
    """Half spaces: what x hides p from, in its plane if p is in it. True: without the border, which is x itself, as
    sight lines are open (D5); unless `closed`."""
    s, c = side(x.plane, p), x.corners
    if s:
        cone = [(toward(plane(p, c[i - 2], c[i - 1]), c[i]), False) for i in range(3)]
        return cone + [(x.plane if s < 0 else back(x.plane), not closed)]
    lines = [plane(p, q, (*x.plane[:3], 0)) for q in c if q != p]
    lines = [h for h in lines + list(map(back, lines)) if all(side(h, r) >= 0 for r in c)]
    return [(h, False) for h in lines] + [(h, True) for h in x.hull.sides if side(h, p) < 0]
def beside(piece: list[Point], x: Surface, p: Point, closed: bool) -> list[list[Point]]:
    """Of an open piece of the cell what sees p past x, but for what has no extent in the cell."""
    if side(x.plane, p) == 0 and any(side(x.plane, q) for q in piece): return [piece]
    rest, parts = piece, []
    for h, strict in shadow(x, p, closed):
        values = [side(h, q) for q in rest]
        if max(values) <= 0 and (strict or min(values) < 0): return [piece]
        if min(values) < 0: parts, rest = [*parts, clip(back(h), rest)], clip(h, rest)
    return parts
def viewpoints(cell: Hull, p: Point, ahead: Plane | None, triangles: Iterable[Surface]) -> list[list[Point]]:
    """Open pieces of int V, on the positive side of `ahead`, from which p is seen past the triangles; of a solid cell,
    pieces of its border by which the sight lines leave it (D3). None: p is occluded (D6)."""
    closed = cell.dimension == 3
    pieces = [f for f in cell.faces if not closed or side(plane(*f), p) < 0]
    if ahead: pieces = [clip(ahead, f) for f in pieces if max(side(ahead, q) for q in f) > 0]
    for x in triangles: pieces = [rest for piece in pieces for rest in beside(piece, x, p, closed)]
    return pieces

# --- files (docs/formats.md) ------------------------------------------------------------------------------------------
def number(text: str) -> float:
    demand(set(text) <= set("0123456789abcdefABCDEFxXpP.+-"), f"{text[:40]!r} is not a number")
    return float.fromhex(text) if "x" in text.lower() else float(text)  # the nearest double; Fraction refuses infinity
def rational(text: Json) -> Fraction:
    good = isinstance(text, str) and re.fullmatch(r"0|-?[1-9]\d*(/[1-9]\d*)?", text, re.ASCII)
    demand(good and str(Fraction(text)) == text, f"{str(text)[:40]!r} is not an exact number in lowest terms")
    return Fraction(text)
def exact(three: Json) -> Point:
    demand(isinstance(three, list) and len(three) == 3, "an exact point has three numbers")
    return point(map(rational, three))
def estimated(both: Json) -> Point:
    pairs = zip(map(rational, both["exact"]), both["estimate"], strict=True)
    near = all(math.isclose(c, e, rel_tol=1e-12, abs_tol=1e-300) for c, e in pairs)
    demand(near, f"{both['estimate']} is not near {both['exact']}")
    return exact(both["exact"])
def one_of(value: Json, *choices: str) -> str:
    demand(value in choices, f"{str(value)[:40]!r} is none of {', '.join(choices)}")
    return value
def is_front(value: Json) -> bool: return one_of(value, "front", "back") == "front"
def is_solid(value: Json) -> bool: return one_of(value, "sheet", "solid") == "solid"
def load(path: pathlib.Path, form: str | None) -> Json:
    def once(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        return dict(pairs) if len(dict(pairs)) == len(pairs) else demand(False, "a key is there twice in an object")
    value = json.loads(path.read_text("utf-8"), object_pairs_hook=once, parse_constant=number)
    demand(isinstance(value, dict) and value.get("format") == form, f"the format is not {form}")
    return value
def pick(items: Sequence[Json], i: Json) -> Json:
    demand(type(i) is int and 0 <= i < len(items), f"there is no number {i} of {len(items)}")
    return items[i]
def read_obj(lines: list[list[str]]) -> tuple[list[list[str]], list[list[int]]]:
    points, faces = [], []
    for word, *rest in lines:
        if word == "v":
            points.append(rest[:3])
        elif word in ("f", "fo"):
            corners = [int(x.partition("/")[0]) for x in rest]
            faces.append([i - 1 if i > 0 else len(points) + i if i < 0 else -1 for i in corners])
        demand(word not in ("surf", "curv", "curv2", "call", "res", "bsp", "bzp", "cdc", "cdp"), f"{word} is not read")
    return points, faces
def read_off(lines: list[list[str]]) -> tuple[list[list[str]], list[list[int]]]:
    keyword, *rest = lines[0]
    if keyword.endswith("OFF"):
        demand(keyword in ("OFF", "COFF", "NOFF", "CNOFF") and "BINARY" not in rest, "of OFF only plain text is read")
        lines = ([rest] if rest else []) + lines[1:]
    n, m = (int(word) for word in sum(lines[:2], [])[:2])
    if len(lines) == 1 + n + m:  # what follows on a line is colours
        lines = [lines[0], *(x[:3] for x in lines[1:n + 1]), *(x[:int(x[0]) + 1] for x in lines[n + 1:])]
    words = itertools.islice(itertools.chain(*lines, ["end"]), 3, None)
    points = [list(itertools.islice(words, 3)) for _ in range(n)]
    faces = [[int(word) for word in itertools.islice(words, int(next(words)))] for _ in range(m)]
    demand(next(words) == "end", "the counts are not those of what follows")
    return points, faces
def read_mesh(path: pathlib.Path) -> tuple[list[Point], list[list[Point]]]:
    read = {".obj": read_obj, ".off": read_off}.get(path.suffix.lower())
    demand(read, "only OBJ and OFF are read here")
    text = path.read_text("latin-1").replace("\\\n", " ")
    coordinates, faces = read([words for line in text.splitlines() if (words := line.partition("#")[0].split())])
    good = all(len(p) == 3 for p in coordinates) and all(i in range(len(coordinates)) for f in faces for i in f)
    demand(good, "a vertex without three coordinates, or an index out of range")
    points = [point(map(number, p)) for p in coordinates]
    return points, [[points[f[0]], points[f[i]], points[f[i + 1]]] for f in faces for i in range(1, len(f) - 1)]
def read_cell(text: str) -> Hull:
    if not text.startswith("box:"): return Hull(read_mesh(pathlib.Path(text))[0])
    b = [number(x) for x in text[4:].split(",")]
    demand(len(b) == 6 and all(b[i] <= b[i + 3] for i in range(3)), "write box:x0,y0,z0,x1,y1,z1, x0 <= x1 and so on")
    return Hull(point(b[i + 3 * (k >> i & 1)] for i in range(3)) for k in range(8))

# --- what is checked --------------------------------------------------------------------------------------------------
class Opinion:  # what is confirmed, what cannot be checked from the files, and what is wrong
    def __init__(self) -> None:
        self.confirmed, self.unchecked, self.flaws = collections.Counter(), collections.Counter(), []
    def examine(self, where: str, kind: str, check: Callable[..., None], *arguments: Json) -> None:
        try:
            check(*arguments)
            self.confirmed[kind] += 1
        except Flaw as e:
            self.flaws.append(f"{where}: {e}")
    def same(self, where: str, said: Json, true: Json) -> None:
        if said != true: self.flaws.append(f"{where}: {said} is said, {true} is true")
def check_contact(s: Scene, number: int, contact: bool = True) -> None:  # D3: what has a point in V counts as visible
    need(bool(s.cell.clip(s.surface(number).corners)) == contact, f"{'does not meet' if contact else 'meets'} the cell")
def check_not_seen(s: Scene, p: Point, ahead: Plane | None) -> None:
    """Where surfaces of two planes touch, a point may be seen and nothing beside it (section 6): no word on these."""
    need(not s.cell.contains(p), "is in the cell")
    if s.planes_at(p) < 2:
        need(not viewpoints(s.cell, p, ahead, s.surfaces), f"is visible: a part of the cell sees {p[:3]} / {p[3]}")
def check_hidden(s: Scene, number: int) -> None:  # no proof: it does not meet the cell, some points are occluded
    check_contact(s, number, False)
    x = s.surface(number)
    for ahead, weights in itertools.product(map(x.facing, s.fronts), itertools.product((1, 9), repeat=3)):
        check_not_seen(s, middle(c for c, n in zip(x.corners, weights) for _ in range(n)), ahead)
def examine_hidden(s: Scene, number: int, where: str, proof: str, o: Opinion) -> None:
    o.examine(where, "hidden triangles of which eight points are occluded", check_hidden, s.alone(number), number)
    o.unchecked[f"hidden triangles as a whole ({proof})"] += 1
def expectations(s: Scene, e: Json, mute: set[int], where: str, o: Opinion) -> None:
    listed = [[x["triangle"] for x in e[key]] for key in ("must_be_visible", "umbra")] + [e["no_surface"]]
    for m in e["must_be_visible"]:
        place, t, touches = f"{where}, triangle {m['triangle']}", m["triangle"], m.get("meets_cell", False)
        o.examine(place, "cell contacts" if touches else "seen triangles off the cell", check_contact, s, t, touches)
        if not touches: o.examine(place, "witnesses", check_chain, s.alone(t), t, m["front"], [(exact(m["v"]), exact(m["p"]))])
    for u in e["umbra"]:
        proof = one_of(u["proof"], "exhaustive", "first_order_map")
        examine_hidden(s, u["triangle"], f"{where}, triangle {u['triangle']}", proof, o)
    counting = [i for i in range(len(s.triangles)) if i not in mute]
    o.same(where + ": no_surface", e["no_surface"], [i for i in counting if s.triangles[i] is None])
    o.same(where + ": what is listed", sorted(sum(listed, [])), counting)
    o.same(where + ": the order", listed, [sorted(ids) for ids in listed])
    more = [u["triangle"] for u in e["umbra"] if u["proof"] == "exhaustive"]
    o.same(where + ": first_order_visible", e["first_order_visible"], sorted(listed[0] + more))
def suite(folder: pathlib.Path, glob: str, o: Opinion) -> None:
    index, topics = load(folder / "index.json", "clues-vectors-index/1"), collections.Counter()
    for file in sorted(set(folder.glob("*.json")) - {folder / "index.json", folder / "schema.json"}):
        data = load(file, "clues-vectors/1")
        for case in data["cases"]:
            where = f"{file.name}, {case['id']}"
            topics[data["topic"]] += 1
            o.same(where, index["cases"].get(case["id"]), {"topic": file.stem, "status": "active"})
            if fnmatch.fnmatchcase(case["id"], glob):
                mesh, cell = data["scenes"][case["scene"]], Hull(point(map(number, p)) for p in case["cell"])
                triangles = [[point(map(number, pick(mesh["vertices"], i))) for i in t] for t in mesh["triangles"]]
                passed, mute = (set(mesh.get(key, [])) for key in ("see_through", "not_counted"))
                demand(not passed & mute and passed | mute <= set(range(len(triangles))), "flags of no triangle, or both")
                demand(not (passed | mute and is_solid(case["mode"])), "in solid mode all triangles block and count")
                s = Scene(triangles, cell, is_solid(case["mode"]), passed)
                expectations(s, case["expect"], mute, where, o)
                o.confirmed["cases"] += 1
    demand(o.confirmed["cases"], "no case has such an id")
    n, said = sum(topics.values()), [index[key] for key in ("active", "withdrawn", "topics")]
    o.same("index.json", said, [n, len(index["cases"]) - n, dict(topics)])
def judgement(s: Scene, j: Json, o: Opinion) -> None:
    words, seen, fractions = j["triangles"], dict.fromkeys(j["meet_cell"]), j["first_order_fractions"]
    demand(len(words) == len(fractions) == len(s.triangles), "this is about another scene")
    for t in j["meet_cell"]:
        o.examine(f"meet_cell, triangle {t}", "cell contacts", check_contact, s, t)
    for w in j["witnesses"]:
        t, line = w["triangle"], (estimated(w["v"]), estimated(w["p"]))
        seen[t] = is_front(w["side"])
        o.examine(f"witness of triangle {t}", "witnesses", check_chain, s, t, seen[t], [line])
    for c in j["chains"]:
        t, links = c["triangle"], [(estimated(link["v"]), estimated(link["x"])) for link in c["links"]]
        o.examine(f"chain of triangle {t}", "chains", check_chain, s, t, is_front(c["side"]), links)
    for t, x in enumerate(s.triangles):
        word = one_of(words[t], "exact", "missing-visible", "first-order", "missing-undecided", "loose", "hidden")
        o.same(f"triangle {t}, {word}: proof that it is visible", t in seen, word in ("exact", "missing-visible"))
        unmapped = seen.get(t) is not None and fractions[t][not seen[t]] == "0"
        o.same(f"triangle {t}, {word}: is seen and not in the map", unmapped, False)
        if word in ("loose", "hidden") and x:
            proof = "proved_hidden" if t in j["proved_hidden"] else "first_order_map"
            o.same(f"triangle {t}, {word}: is in the map", fractions[t] != ["0", "0"], proof == "proved_hidden")
            examine_hidden(s, t, f"triangle {t}, {word}", proof, o)
    count = collections.Counter(word.replace("-", "_") for word in words)
    o.same("counts", j["counts"], {key: count[key] for key in j["counts"]})
    verdict = "unsound" if count["missing_visible"] else "undecided" if count["missing_undecided"] else "sound"
    o.same("verdict, contradictions", [j["verdict"], j["contradictions"]], [verdict, []])
def check_answer(s: Scene, p: Point, a: Json) -> None:
    """D18, a point: seen from v; or covered, by no triangle too many; or on a side that nobody is in front of."""
    ahead = None if a["triangle"] is None else s.surface(a["triangle"]).facing(is_front(a["side"]))
    if a["sight"] == "visible":
        v = exact(a["v"])
        need(ahead is None or side(ahead, v) > 0, "v is not strictly on that side")
        check_sight(s, v, p)
        need(a["first_order"] == "visible" or s.planes_at(p) > 1, "is visible, but not to first order (T1)")
    elif a["faces_away"]:
        need(ahead and all(side(ahead, q) <= 0 for q in s.cell.points), "does not face away from the cell")
    else:
        cover = [s.surface(t) for t in a["covered_by"]]
        need(not viewpoints(s.cell, p, ahead, cover), f"triangles {a['covered_by']} do not cover the cell")
        spare = [x.number for x in cover if not viewpoints(s.cell, p, ahead, (y for y in cover if y is not x))]
        need(not spare, f"without any of {spare} the cell is covered")
def check_part(s: Scene, ends: list[Point], part: Json) -> None:
    (*a, u), (*b, w), first, last = *ends, rational(part["from"]), rational(part["to"])
    def along(t: Fraction) -> Point: return point(Fraction(i, u) * (1 - t) + Fraction(k, w) * t for i, k in zip(a, b))
    if part["sight"] == "visible":
        at = exact(part["at"])
        need(Hull([along(first), along(last)]).contains(at), "the point is not in the part")
        if part["v"]: check_sight(s, exact(part["v"]), at)
        else: need(s.cell.contains(at), "the point is not in the cell")
    elif part["sight"] == "hidden":
        for t in (1, 4, 7): check_not_seen(s, along(first + (last - first) * t / 8), None)
def query(s: Scene, q: Json, o: Opinion) -> None:
    for e in q["points"]:
        p, where = exact(e["point"]), f"line {e['line']}"
        within, here = s.cell.contains(p), s.touching(p)
        o.same(where, e["place"], "cell" if within else "surface" if here else "space")
        sides = [[x.number, "front" if front else "back"] for x in here for front in s.fronts] or [[None, None]]
        o.same(where + ": sides", [[a["triangle"], a["side"]] for a in e["answers"]], [] if within else sides)
        for a in e["answers"]:
            seen = one_of(a["sight"], "visible", "occluded") == "visible"
            kind = "seen points" if seen else "sides that face away" if a["faces_away"] else "occluded points"
            o.examine(f"{where}, {a['triangle']}, {a['side']}", kind, check_answer, s, p, a)
            if not seen: o.unchecked[f"first-order labels of occluded points ({a['first_order']})"] += 1
    for e in q["segments"]:
        cuts = [x for part in e["parts"] for x in (part["from"], part["to"])]
        o.same(f"line {e['line']}: the cuts", cuts[::2] + ["1"], ["0"] + cuts[1::2])
        for part in e["parts"]:
            where, sight, ends = f"line {e['line']}, from {part['from']}", part["sight"], list(map(exact, e["ends"]))
            demand(sight in ("visible", "hidden", "undecided"), f"{where}: no such sight")
            o.examine(where, f"{sight} parts, at points", check_part, s, ends, part)
            o.unchecked[f"{sight} parts, as a whole"] += 1

# --- umbrae (docs/umbra.md) -------------------------------------------------------------------------------------------
def borders(edges: Iterable[tuple[Point, Point]]) -> dict[Point, collections.Counter[Point]]:
    """Per line (in Pluecker coordinates), how many edges begin less how many end at each of its points."""
    lines: dict[Point, collections.Counter[Point]] = collections.defaultdict(collections.Counter)
    for a, b in edges:
        line = reduced(*(a[i] * b[j] - a[j] * b[i] for i in range(4) for j in range(i)))
        lines[max(line, tuple(-c for c in line))].update({a: 1, b: -1})
    return lines
def winding(facets: list[Surface], p: Point, ahead: Plane | None = None) -> int:
    """How often the facets go round p, or round what is next to p before `ahead`; along a ray that meets no edge."""
    for k in itertools.count(1):
        d: Point = (97 + k * k, 61 * k - 300, k ** 3 - 41, 0)
        if ahead and side(ahead, d) < 0: d = back(d)
        total, clear = 0, not ahead or side(ahead, d) != 0
        for f in facets:
            s, t = side(f.plane, p), side(f.plane, d)
            q = tuple(abs(t) * a + abs(s) * b for a, b in zip(p, d))
            clear = clear and (s != 0 or t != 0)
            if s * t < 0 and f.hull.contains(q): total, clear = total + (1 if t > 0 else -1), clear and f.hull.inside(q)
        if clear: return total
def check_facet(s: Scene, f: Surface, triangle: int | None) -> None:
    outer, inner = triangle is None and any(side(f.plane, q) > 0 for q in s.cell.points), s.cell.meets_inside(f.corners)
    need(not outer, "has a point of the cell on its outer side")
    need(triangle is None or all(s.surface(triangle).holds(q) for q in f.corners), f"leaves triangle {triangle}")
    need(not inner, "meets the inside of the cell")
def check_enclosed(s: Scene, facets: list[Surface], number: int) -> None:
    check_contact(s, number, False)
    x = s.surface(number)
    for ahead in (h for h in map(x.facing, s.fronts) if any(side(h, q) > 0 for q in s.cell.points)):
        divided = any(x.hull.meets_inside(f.corners) for f in facets if any(side(ahead, q) > 0 for q in f.corners))
        need(not divided, "is divided by a facet")
        need(winding(facets, middle(x.corners), ahead) > 0, "is not in the umbra")
def umbra(s: Scene, u: Json, o: Opinion, listed: list[int] | None) -> None:
    points = [exact(p) for p in u["vertices_exact"]]
    facets = [Surface(i, [pick(points, k) for k in f["corners"]]) for i, f in enumerate(u["facets"])]
    demand(all(any(f.plane) for f in facets), "a facet has no area")
    demand("scene" not in u or u["scene"]["triangles"] == len(s.triangles), "this is about another scene")
    for f, said in zip(facets, u["facets"]):
        kind, inside = one_of(said["kind"], "surface", "wedge", "bound"), said.get("triangle")
        demand((kind == "surface") == (inside is not None), f"facet {f.number}: a triangle belongs to a surface")
        o.examine(f"facet {f.number}", f"{kind} facets", check_facet, s, f, inside)
    lines = borders((f.corners[i - 1], f.corners[i]) for f in facets for i in range(3)).values()
    o.same("lines along which the boundary has a gap", sum(any(ends.values()) for ends in lines), 0)
    if o.flaws: return
    o.same("how often the boundary goes round the cell", winding(facets, middle(s.cell.points)), 0)
    found = Opinion() if listed is None else o  # what is not claimed need not hold
    for t in range(len(s.triangles)) if listed is None else listed:
        found.examine(f"triangle {t}", "hidden triangles", check_enclosed, s, facets, t)
    if listed is None: o.confirmed += found.confirmed
NO_SIGHT_LINE = ("answer/other-answer", "label/other-label", "hidden/first-order-visible", "visible/first-order-hidden",
                 "hidden/seen-through", "no-answer/answer", "crash/answer", "no-end/answer", "promise/broken")
def finding(folder: pathlib.Path, o: Opinion) -> None:
    about = load(folder / "finding.json", "clues-finding/2")
    said, text = about.pop("checksum"), json.dumps(about, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
    o.same("checksum of finding.json", said, hashlib.sha256(text.encode()).hexdigest())
    for place, sums in ((folder, about["sha256"]), (folder / "original", about["sha256_original"])):
        for name in ("scene.off", "cell.obj", "witness.json"):
            o.same(f"sha256 of {place / name}", sums[name], hashlib.sha256((place / name).read_bytes()).hexdigest())
        s = Scene(read_mesh(place / "scene.off")[1], read_cell(str(place / "cell.obj")), is_solid(about["mode"]))
        w = load(place / "witness.json", None)
        if about["verdict"].endswith("/visible"):
            line = exact(w["v"]), exact(w["p"])
            o.examine(str(place), "witnesses", check_chain, s, w["triangle"], is_front(w["side"]), [line])
        elif about["verdict"] == "hidden/meets-cell":
            o.examine(str(place), "cell contacts", check_contact, s, w["triangle"])
        else: o.unchecked["findings without a sight line: " + one_of(about["verdict"], *NO_SIGHT_LINE)] += 1
def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    forms = {"check": "clues-judgement/1", "query": "clues-query/1", "umbra": "clues-umbra/1"}
    parser.add_argument("command", choices=("suite", "finding", *forms))
    parser.add_argument("path", type=pathlib.Path, help="the scene, or the folder of the suite or finding")
    parser.add_argument("file", type=pathlib.Path, nargs="?", help="the file that is checked")
    parser.add_argument("--cell", help="the view cell")
    parser.add_argument("--solid", action="store_true", help="it was asked for in solid mode: only fronts can be seen")
    parser.add_argument("--list", type=pathlib.Path, help="umbra: a file with the ids that clues verify --list printed")
    parser.add_argument("--case", default="*", metavar="GLOB", help="suite: only cases whose id matches")
    a, o = parser.parse_intermixed_args(arguments), Opinion()
    if a.command in forms and not (a.file and a.cell): parser.error(f"{a.command} wants SCENE, --cell CELL and a file")
    try:
        if a.command == "suite": suite(a.path, a.case, o)
        elif a.command == "finding": finding(a.path, o)
        else:
            data, cell = load(a.file, forms[a.command]), read_cell(a.cell)
            scene, said = Scene(read_mesh(a.path)[1], cell, a.solid), data.get("cell")
            said = said["vertices"] if isinstance(said, dict) else said
            if said: o.same("the cell", sorted(set(map(point, said))), sorted(cell.points))
            rows = a.list.read_text().splitlines() if a.list else []
            listed = a.list and [int(x) for row in rows if re.fullmatch(r"[\d\s]*", row) for x in row.split()]
            if a.command == "umbra": umbra(scene, data, o, listed)
            else: (judgement if a.command == "check" else query)(scene, data, o)
    except Exception as e:  # whatever a file may do to what reads it
        print("second_opinion: error:", *arguments, type(e).__name__, *str(e).split(), file=sys.stderr)
        return 2
    for what, counter in (("confirmed", o.confirmed), ("not checked", o.unchecked)):
        for kind in sorted(counter): print(f"{what}: {counter[kind]} {kind}")
    for flaw in o.flaws: print(f"WRONG: {flaw}")
    print(f"{len(o.flaws)} proofs do not hold" if o.flaws else "all that can be checked holds")
    return 1 if o.flaws else 0
if __name__ == "__main__":
    sys.set_int_max_str_digits(0)
    sys.exit(main(sys.argv[1:]))
