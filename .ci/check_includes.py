#!/usr/bin/env python3
"""Includes point down only: app -> fuzz -> validate -> {reference, fastpath} -> exact -> scene.

reference and fastpath never see each other. tests/ and bench/ may include anything and are included by nothing.
Within a folder the chapters (its subfolders) have an order, and a file includes its own chapter and earlier ones only.
A chapter that is not named here, or has more files than one looks through, is a violation too.
Usage: check_includes.py [ROOT]; prints one line per violation and exits 1 if there is one."""
import pathlib
import re
import sys

MAY_SEE = {
    "scene": set(),
    "exact": {"scene"},
    "reference": {"exact", "scene"},
    "fastpath": {"exact", "scene"},
    "validate": {"reference", "fastpath", "exact", "scene"},
    "fuzz": {"validate", "reference", "fastpath", "exact", "scene"},
    "app": {"fuzz", "validate", "reference", "fastpath", "exact", "scene"},
}
# Of each folder, in the order in which a reader meets them; "." is the folder itself.
CHAPTERS = {
    "scene": ["messages", "mesh", "formats", "files", ".", "gltf", "levels", "scenes", "stores", "bakes", "motion",
              "multires", "stream"],
    "exact": [".", "cell", "complex", "sight", "motion", "multires"],
    "reference": [".", "visibility/planar", "visibility/wedges", "visibility/labels", "visibility/search",
                  "visibility/map", "visibility/traversal", "visibility/hidden", "visibility",
                  "visibility/refinement", "delta", "contours", "streams", "link", "motion", "multires/stars", "multires"],
    "fastpath": ["predicates", "queries", "solids", "visibility/points", "visibility/scene", "visibility/wedges",
                 "visibility/labels", "visibility/search", "visibility/map", "visibility/closure", "visibility",
                 "visibility/refinement", "contours", "motion/bounds", "motion", "multires", "bakes"],
    "validate": [".", "processes", "windows", "certificates", "verdicts", "visible_set", "see_through", "cells", "vectors", "conform",
                 "motion", "multires", "stream"],
    "fuzz": ["generators", "levels", "motion", "multires", "findings", "trials", "subjects", "oracles", "shrinking", "campaign", "report",
             "targets"],
    "app": [".", "cluster", "cluster/mpi", "map", "view", "engine", "bake", "demo", "maps", "motion", "stream", "commands"],
}
NO_CHAPTERS = {"validate/adapters"}  # to be copied; they include nothing of ours
MOST_FILES = 22
SOURCES = {".h", ".hpp", ".c", ".cpp", ".cc"}
NEVER_INCLUDED = {"tests", "bench"}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<](?:clues/)?([^">]+)[">]')


def layer_of(included, source, root):
    """The project folder an include names: by its first component, or through a relative path."""
    if included.startswith("."):
        resolved = (source.parent / included).resolve()
        return resolved.relative_to(root).parts[0] if resolved.is_relative_to(root) else None
    first = included.split("/")[0]
    return first if "/" in included and (first in MAY_SEE or first in NEVER_INCLUDED) else None


def chapter_violations(root):
    for layer, order in CHAPTERS.items():
        place = {chapter: i for i, chapter in enumerate(order)}
        files = {}
        for source in sorted((root / layer).rglob("*")):
            path = source.relative_to(root)
            if source.suffix not in SOURCES or any(path.is_relative_to(p) for p in NO_CHAPTERS):
                continue
            chapter = str(path.parent.relative_to(layer))
            files.setdefault(chapter, []).append(path)
            if chapter not in place:
                yield f"{path}: {layer}/{chapter} is no chapter of check_includes.py"
                continue
            for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match or not match[1].startswith(layer + "/"):
                    continue
                target = str(pathlib.PurePosixPath(match[1]).parent.relative_to(layer))
                if place.get(target, -1) > place[chapter]:
                    yield f"{path}:{number}: chapter {chapter} must not include the later {target}: {line.strip()}"
        for chapter, paths in files.items():
            if len(paths) > MOST_FILES:
                yield f"{layer}/{chapter}: {len(paths)} files; more than {MOST_FILES} are no chapter"


def violations(root):
    yield from chapter_violations(root)
    seen = 0
    for layer, allowed in MAY_SEE.items():
        for source in sorted((root / layer).rglob("*")):
            if source.suffix not in SOURCES:
                continue
            seen += 1
            for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                target = layer_of(match[1], source, root) if match else None
                if target and target != layer and target not in allowed:
                    yield f"{source.relative_to(root)}:{number}: {layer} must not include {target}: {line.strip()}"
    if seen == 0:
        yield f"{root}: no source files found: nothing was checked"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    found = list(violations(root))
    print("\n".join(found) if found else "includes point down only")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
