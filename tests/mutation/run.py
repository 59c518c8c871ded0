#!/usr/bin/env python3
"""How many mutations of the reference and of the fast path does the conformance suite catch?

usage: run.py SOURCE WORK [--only NAME,...] [--shard I/N] [--out FILE]
       run.py SOURCE --merge FILE... [--out FILE]
       run.py --check SOURCE

SOURCE is a checkout, WORK a folder for a copy of it with its own build (kept, so that a second run is quick). For each mutation of mutations.py:
change the copy, build `clues`, and put the mutated kernel to the suite through its own door (`clues conform --impl 'clues iut --kernel exact'`, or fast for a
source of fastpath/). Caught: an unsound answer, a crash or a time-out. Looser: a larger answer than that of the unchanged kernel, and nothing worse. Survived: every answer
is the same as without the mutation. --shard does every N-th mutation, beginning with the I-th, in a folder of its own in WORK; under mpirun the shard is that of the
rank. --merge puts the files of all shards together. A mutation that does not build, or whose text is not found, is an error: repair mutations.py. --check only
looks for the texts: each has to be there once.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from edits import NotFound, edited, source_of  # noqa: E402
from mutations import MUTATIONS  # noqa: E402


def sh(command, cwd, seconds):
    return subprocess.run(command, cwd=cwd, timeout=seconds, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def build(tree):
    return sh(["cmake", "--build", "build/mutation", "--target", "clues", "-j2"], tree, 3600)


def kernel_of(file):
    return "fast" if file.startswith("fastpath/") else "exact"


def judge(tree, kernel):
    """The grade of every case, or None when the suite could not be run to its end."""
    program, report = tree / "build/mutation/bin/clues", tree / "build/mutation/report.json"
    report.unlink(missing_ok=True)
    sh([program, "conform", "--impl", f"{program} iut --kernel {kernel}", "--suite", "vectors", "--time-limit", "10", "--jobs", "2", "--json", report],
       tree, 1200)
    if not report.exists():
        return None
    cases = json.loads(report.read_text())["cases"]
    return {c["id"]: (c["outcome"], c.get("extra"), c.get("missed")) for c in cases}


def check(source):
    """The mutations whose text is not found."""
    for name, file, text, replacement in MUTATIONS:
        try:
            edited(file, source_of(source, file).read_text(), text, replacement)
        except NotFound as error:
            yield f"{name}: {error}"


def shard_of(text):
    """I - 1 and N; without --shard those of mpirun, or everything."""
    if not text:
        return int(os.environ.get("OMPI_COMM_WORLD_RANK", 0)), int(os.environ.get("OMPI_COMM_WORLD_SIZE", 1))
    index, _, count = text.partition("/")
    if not (index.isdigit() and count.isdigit() and 1 <= int(index) <= int(count)):
        sys.exit(f"--shard {text}: give I/N, I from 1 to N")
    return int(index) - 1, int(count)


def write(rows, out):
    caught, looser = (sum(1 for r in rows if r[1] == verdict) for verdict in ("caught", "looser"))
    summary = f"{caught} of {len(rows)} caught, {looser} more answer more than the unchanged kernel"
    print(summary)
    if out:
        lines = [f"| {n} | {v} | {k} | {c} |" for n, v, k, c in rows]
        out.write_text("| mutation | verdict | cases | first |\n|---|---|---|---|\n" + "\n".join(lines) + f"\n\n{summary}\n")


def merge(files, out):
    rows = {}
    for file in files:
        for line in file.read_text().splitlines()[2:]:
            if line.startswith("| "):
                name, verdict, cases, first = (cell.strip() for cell in line.split("|")[1:-1])
                if name in rows:
                    sys.exit(f"{file}: {name} is in another file, too")
                rows[name] = (name, verdict, cases, first)
    missing = [name for name, *_ in MUTATIONS if name not in rows]
    if missing or len(rows) != len(MUTATIONS):
        sys.exit("not the shards of these mutations; missing: " + ", ".join(missing))
    write([rows[name] for name, *_ in MUTATIONS], out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path, nargs="?")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--shard", default="", metavar="I/N")
    parser.add_argument("--merge", type=pathlib.Path, nargs="+", metavar="FILE")
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    stale = list(check(options.source))
    if stale:
        sys.exit("\n".join(stale))
    if options.check:
        print(f"the texts of {len(MUTATIONS)} mutations are found")
        return
    if options.merge:
        return merge(options.merge, options.out)
    if not options.work:
        parser.error("no folder to work in")
    index, count = shard_of(options.shard)
    if count > 1:
        options.work = options.work / f"shard-{index + 1}"
        options.out = options.out and options.out.with_name(f"{options.out.name}.{index + 1}")
    tree = options.work.resolve() / "tree"
    if not tree.exists():
        shutil.copytree(options.source, tree, ignore=shutil.ignore_patterns("build", ".git"))
        done = sh(["cmake", "-S", ".", "-B", "build/mutation", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCLUES_BUILD_TESTS=OFF", "-DCLUES_UNITY=OFF",
                   "-DCLUES_VIEWER=OFF",
                   "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DNDEBUG"], tree, 300)
        if done.returncode != 0:
            sys.exit(done.stdout)
    if build(tree).returncode != 0:
        sys.exit("the unchanged tree does not build")
    names = [n for n in options.only.split(",") if n] or [name for name, *_ in MUTATIONS]
    names = names[index::count]
    sounds = {}
    for kernel in sorted({kernel_of(file) for name, file, _, _ in MUTATIONS if name in names}):
        sounds[kernel] = judge(tree, kernel)
        if sounds[kernel] is None or any(grade[0] == "unsound" for grade in sounds[kernel].values()):
            sys.exit(f"the unchanged kernel {kernel} does not pass the suite")
    rows = []
    for name, file, text, replacement in MUTATIONS:
        if name not in names:
            continue
        sound = sounds[kernel_of(file)]
        path = source_of(tree, file)
        original = path.read_text()
        path.write_text(edited(file, original, text, replacement))
        try:
            if build(tree).returncode != 0:
                verdict, seen = "does not build", []
            else:
                grades = judge(tree, kernel_of(file))
                seen = [] if grades is None else sorted(c for c in sound if grades.get(c) != sound[c])
                unsound = [] if grades is None else [c for c in seen if grades.get(c, ("",))[0] != "conservative"]
                verdict = "caught" if grades is None or unsound else "looser" if seen else "SURVIVED"
        finally:
            path.write_text(original)
        rows.append((name, verdict, len(seen), seen[0] if seen else ""))
        print(f"{name:45} {verdict:15} {len(seen):4} {seen[0] if seen else ''}", flush=True)
    write(rows, options.out)


if __name__ == "__main__":
    main()
