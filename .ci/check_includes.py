#!/usr/bin/env python3
"""Includes point down only: app -> fuzz -> validate -> {reference, fastpath} -> exact -> scene.

reference and fastpath never see each other. tests/ and bench/ may include anything and are included by nothing.
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
NEVER_INCLUDED = {"tests", "bench"}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<](?:clues/)?([^">]+)[">]')


def layer_of(included, source, root):
    """The project folder an include names: by its first component, or through a relative path."""
    if included.startswith("."):
        resolved = (source.parent / included).resolve()
        return resolved.relative_to(root).parts[0] if resolved.is_relative_to(root) else None
    first = included.split("/")[0]
    return first if "/" in included and (first in MAY_SEE or first in NEVER_INCLUDED) else None


def violations(root):
    seen = 0
    for layer, allowed in MAY_SEE.items():
        for source in sorted((root / layer).rglob("*")):
            if source.suffix not in {".h", ".hpp", ".c", ".cpp", ".cc"}:
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
