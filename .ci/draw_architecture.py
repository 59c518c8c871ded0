#!/usr/bin/env python3
"""Draws the folders and their chapters, from the includes, into docs/architecture.md (as Mermaid, between two markers).

Arrows that follow from others are left out. Usage: draw_architecture.py [--check] [ROOT]; --check changes nothing and exits 1
where the picture is another."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from check_includes import CHAPTERS, INCLUDE, MAY_SEE, NO_CHAPTERS, SOURCES  # noqa: E402

BEGIN, END = "<!-- drawn by .ci/draw_architecture.py: begin -->", "<!-- end -->"


def includes(root, layer):
    """Pairs of a source and what it includes of this project, as paths."""
    for source in sorted((root / layer).rglob("*")):
        path = source.relative_to(root)
        if source.suffix not in SOURCES or any(path.is_relative_to(p) for p in NO_CHAPTERS):
            continue
        for line in source.read_text(encoding="utf-8").splitlines():
            match = INCLUDE.match(line)
            if match and match[1].split("/")[0] in MAY_SEE:
                yield path, pathlib.PurePosixPath(match[1])


def reduced(arrows):
    """Without those that others imply; the arrows have no cycle."""
    after = {}
    for a, b in arrows:
        after.setdefault(a, set()).add(b)

    def reaches(a, b):
        return any(n == b or reaches(n, b) for n in after.get(a, ()))

    return sorted((a, b) for a, b in arrows if not any(n != b and reaches(n, b) for n in after[a]))


def graph(names, arrows):
    name_of = {n: f"n{i}" for i, n in enumerate(names)}
    lines = ["```mermaid", "graph TD"]
    lines += [f"  {name_of[n]}[{label}]" for n, label in names.items()]
    lines += [f"  {name_of[a]} --> {name_of[b]}" for a, b in reduced(arrows)]
    return lines + ["```", ""]


def picture(root):
    lines = [BEGIN, "", "Folders:", ""]
    arrows = {(layer, str(b.parts[0])) for layer in MAY_SEE for _, b in includes(root, layer)}
    lines += graph({layer: layer for layer in reversed(MAY_SEE)}, {(a, b) for a, b in arrows if a != b})
    for layer in reversed(CHAPTERS):
        chapters = CHAPTERS[layer]
        arrows = set()
        for a, b in includes(root, layer):
            if b.parts[0] == layer:
                pair = tuple(str(p.parent.relative_to(layer)) for p in (a, b))
                if pair[0] != pair[1]:
                    arrows.add(pair)
        label = {c: layer if c == "." else c.removeprefix("visibility/") for c in chapters}
        if "visibility" in label:
            label["visibility"] = "first_order, the door"
        lines += [f"The chapters of `{layer}/`:", ""] + graph(dict(reversed(label.items())), arrows)
    return "\n".join(lines + [END])


def main():
    check = "--check" in sys.argv[1:]
    rest = [a for a in sys.argv[1:] if a != "--check"]
    root = pathlib.Path(rest[0] if rest else pathlib.Path(__file__).parent.parent).resolve()
    page = root / "docs/architecture.md"
    text = page.read_text(encoding="utf-8")
    drawn, times = re.subn(re.escape(BEGIN) + ".*?" + re.escape(END), lambda _: picture(root), text, flags=re.S)
    if times != 1:
        sys.exit(f"{page}: {times} places for the picture")
    if check:
        if drawn != text:
            sys.exit("docs/architecture.md: the includes have changed; run .ci/draw_architecture.py")
        print("the picture is that of the includes")
    else:
        page.write_text(drawn, encoding="utf-8")


if __name__ == "__main__":
    main()
