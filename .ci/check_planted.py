#!/usr/bin/env python3
"""Nothing of the tests of the tests is in the product: what is wrong on purpose is built by the tests, from changed copies (tests/planted).

The word `planted`, in any case, occurs in no header or source below the folders.
Usage: check_planted.py FOLDER...; prints one line per violation and exits 1 if there is one."""
import pathlib
import sys

SUFFIXES = {".h", ".hpp", ".c", ".cpp", ".cc"}


def violations(folders):
    for folder in folders:
        files = [path for path in sorted(folder.rglob("*")) if path.suffix in SUFFIXES]
        if not files:
            yield f"{folder}: no sources found: nothing was checked"
        for path in files:
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if "planted" in line.lower():
                    yield f"{path}:{number}: something planted; tests/planted builds it from a changed copy"


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: check_planted.py FOLDER...")
    found = list(violations([pathlib.Path(folder) for folder in sys.argv[1:]]))
    print("\n".join(found) if found else "nothing is planted")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
