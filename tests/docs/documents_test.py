#!/usr/bin/env python3
"""Everything that the documents and the EXAMPLES of `--help` tell people to type is typed here, in a scratch folder.

Usage: documents_test.py CLUES SOURCE [WHERE...] [-v]; CLUES the program, SOURCE the source folder; with WHERE only the documents that begin so; -v says how
long each command took. Prints one line for each flaw; exits with 1 if there is one."""
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import examples  # noqa: E402

DOCUMENTS = ["README.md", "CONTRIBUTING.md", "docs/*.md", "vectors/README.md", "fastpath/README.md"]


@dataclasses.dataclass
class Entry:
    """What is not simply run. `text`: a regular expression that the block or the command begins with."""
    where: str
    text: str
    why: str
    kind: str = "command"  # or "block": nothing in it is to be typed
    met: bool = False


# The one list of what is not run.
NOT_RUN = [
    Entry("README.md", r"\./run ", "builds all of clues; .ci/run does it"),
    Entry("docs/fuzzing.md", r"\./run ", "builds all of clues; .ci/run does it"),
    Entry("clues demo", r"\./run ", "builds all of clues; .ci/run does it"),
    Entry("README.md", "find_package", "CMake, built by house.installed_package", "block"),
    Entry("CONTRIBUTING.md", "CLUES_LONG=1", "two thousand scenes, an hour"),
    Entry("CONTRIBUTING.md", "clues lint vectors --write --case 'your-id'", "a case that the reader writes"),
    Entry("docs/ci.md", r"clues (replay|shrink) results/", "a finding of a job that ran elsewhere"),
    Entry("docs/second-opinion.md", r"second_opinion\.py ", "all of these are typed by tests/second_opinion", "block"),
    Entry("docs/delta.md", r'\{"cell_count"', "a line of a stream", "block"),
    Entry("docs/delta.md", r"clues serve ", "serves until it is interrupted"),
    Entry("clues serve", r"clues serve ", "serves until it is interrupted"),
    Entry("docs/delta.md", r"clues walk level\.bsp", "a client of that server; StreamFaults.* runs both"),
    Entry("docs/architecture.md", "app -> fuzz", "a picture of the layers", "block"),
    Entry("docs/formats.md", "# baked by", "a file", "block"),
    Entry("docs/fuzzing.md", r"clues fuzz .*--seed 2026112", "what was run: half an hour each"),
    Entry("docs/protocol.md", "-> ", "lines of the protocol", "block"),
    Entry("docs/protocol.md", "<- ", "lines of the protocol", "block"),
    Entry("docs/protocol.md", "int clues_iut_pvs", "C", "block"),
    Entry("docs/protocol.md", r'\{"format"', "a file", "block"),
    Entry("fastpath/README.md", "const clues::", "C++", "block"),
]

# Exit codes other than 0, for commands that begin so.
EXIT_CODES = [
    (r"clues check \S+ --cell \S+ --pvs baked\.txt", 1),  # a visible triangle is missing
    (r"clues check level\.bsp", 1),  # its shipped list lacks what is seen through the glass
    (r"clues fuzz --subject '\./bake", 1),  # and so it is here
    (r"clues replay \S+ --run-subject", 1),  # reproduced
    (r"clues replay \S+ --subject '\./bake", 1),
]

# Campaigns are typed as they stand, but for their length.
SHORTER = [(r"^((?:mpirun -n \d+ )?clues fuzz .*)--cases \d+", r"\1--cases 3"),
           (r"^(clues fuzz (?!.*--cases)[^#]*)", r"\1 --cases 3 ")]

# A wall (0, 1), a screen before it (2), a small triangle behind the screen (3), and one off to the side (4).
TOWN = """\
v -19 -19 6
v 21 -19 6
v 21 21 6
v -19 21 6
v -5 -3 4
v 7 -3 4
v 1 9 4
v 0.5 0.5 4.25
v 1.5 0.5 4.25
v 1 1.5 4.25
v 10 1 4
v 11 1 4
v 10 2 4
f 1 2 3
f 1 3 4
f 5 6 7
f 8 9 10
f 11 13 12
"""
ROOM = """\
v -1 -1 4
v 3 -1 4
v 1 3 4
v -9 -9 6
v 11 -9 6
v 1 11 6
f 1 2 3
f 4 5 6
"""
SCREEN = "OFF\n8 4 0\n-4 -4 1\n4 -4 1\n4 4 1\n-4 4 1\n-1 -1 2\n1 -1 2\n1 1 2\n-1 1 2\n3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n"
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
SUITE = ["cell-contact", "closed-forms", "grazing"]
SUITE_CASES = 5  # of each topic, and those that examples choose
CHOSEN = re.compile(r"edge-|.*-one-ulp-")


class Scratch:
    """A folder with all that the examples of one document take for granted."""

    def __init__(self, folder, clues, source):
        self.folder, self.source = pathlib.Path(folder), source
        self.environment = {**os.environ, "LC_ALL": "C", "PATH": os.pathsep.join(
            [str(self.folder / "bin"), str(clues.parent), os.environ["PATH"]])}
        self.environment.pop("CLUES_MESH_DIR", None)
        # Whoever the tests run as, and on however few processors.
        self.environment.update({"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                 "OMPI_MCA_rmaps_base_oversubscribe": "1",
                                 "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                                 "OMPI_MCA_hwloc_base_binding_policy": "none"})

    def sh(self, text):
        ran = examples.run(text, self.folder, self.environment)
        if ran.returncode not in (0, 1):
            raise RuntimeError(f"preparing the scratch folder: {text}: {ran.stderr}{ran.stdout}")

    def write(self, name, text):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def prepare(self, where):
        for name, text in [("town.obj", TOWN), ("room.obj", ROOM), ("screen.off", SCREEN), ("baked.txt", "0\n1\n2\n3\n"),
                           ("seen.curve", "# speed error\n0 0.0003\n0.5 0.001\n2 0.01\n"),
                           ("points.txt", "0 0 1.5\n0 0 0.75\n0.5 -0.5 2\n")]:
            self.write(name, text)
        self.sh("clues map town.obj --cell box:0,0,1,2,2,2 -o town.clues.json")
        shutil.copytree(pathlib.Path(__file__).parent / "stand-ins", self.folder / "bin")
        for name in ["bake", "my_tool"]:
            shutil.copy(self.folder / "bin" / name, self.folder)
        shutil.copy(self.source / "fuzz/corpus/bsp/two_rooms.bsp", self.folder / "level.bsp")
        for topic in SUITE:
            self.write(f"vectors/{topic}.json", self.part_of(topic))
        self.sh("clues lint vectors --write")
        shutil.copytree(self.source / "validate" / "adapters", self.folder / "validate" / "adapters")
        shutil.copy(self.source / "validate" / "clues_iut.h", self.folder / "validate")
        for name in ["elephant", "cow", "bull"]:
            self.write(f"meshes/{name}.off", TETRAHEDRON)
            self.write(f"build/demo-meshes/{name}.off", TETRAHEDRON)
        for pattern, names in self.BESIDES.items():
            if re.match(pattern, where):
                for name in names:
                    getattr(self, name)()

    def part_of(self, topic):
        vectors = json.loads((self.source / "vectors" / f"{topic}.json").read_text(encoding="utf-8"))
        chosen = [case for case in vectors["cases"] if CHOSEN.match(case["id"])][:2]
        vectors["cases"] = [case for i, case in enumerate(vectors["cases"]) if i < SUITE_CASES or case in chosen]
        used = {case["scene"] for case in vectors["cases"]}
        vectors["scenes"] = {name: scene for name, scene in vectors["scenes"].items() if name in used}
        flags = {flag for case in vectors["cases"] for flag in case["flags"]}
        vectors["notes"] = {name: note for name, note in vectors["notes"].items() if name in flags}
        return json.dumps(vectors)

    # What some documents take for granted besides, and others make themselves.
    BESIDES = {
        r"README\.md|clues|docs/(?!adding)": ["my_adapter", "library", "answers"],
        r"docs/adding": ["sources"],
        r"clues lint|clues motion|docs/motion": ["motion_cases"],
        r"clues lint|docs/maps": ["maps_cases"],
        r"clues motion": ["depth_mesh"],
        r"clues maps|docs/maps": ["surfaces"],
        r"clues lint": ["cases"],
        r"clues report": ["results"],
        r"clues (replay|shrink)": ["findings"],
    }

    def my_adapter(self):
        shutil.copy(self.folder / "validate/adapters/python/clues_adapter.py", self.folder / "my_adapter.py")

    def library(self):
        self.sh("cc -std=c99 -fPIC -shared -I validate validate/adapters/c/clues_adapter.c -o libmine.so")

    def answers(self):
        self.sh("clues conform --export to-answer && ./my_tool to-answer && mkdir answers && mv to-answer/*.pvs answers && rm -r to-answer")

    def sources(self):
        shutil.copy(self.folder / "validate/adapters/cpp/clues_adapter.cpp", self.folder)
        shutil.copy(self.folder / "validate/adapters/c/clues_adapter.c", self.folder / "my_library.c")
        self.write("known.json", json.dumps({"format": "clues-expected-failures/1", "cases": []}))

    def motion_cases(self):
        shutil.copytree(self.source / "vectors" / "motion", self.folder / "vectors" / "motion")

    def maps_cases(self):
        shutil.copytree(self.source / "vectors" / "multires", self.folder / "vectors" / "multires")

    # An octahedron of samples, seen from the middle and from beside it, with bounds that are sound and a walk that is valid.
    def depth_mesh(self):
        samples = [[2, 0, 1.5], [-2, 0, 1.5], [0, 2, 1.5], [0, -2, 1.5], [0, 0, 3.5], [0, 0, -0.5]]
        triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
        thresholds = {"kappa": 10, "sigma": 0.0001}
        self.write("mesh.json", json.dumps({"format": "clues-depth-mesh/1", "samples": samples, "triangles": triangles}))
        self.write("bounds.json", json.dumps({"format": "clues-motion-bounds/1", "viewpoint": [0, 0, 1.5],
                                              "thresholds": thresholds, "bounds": [0.5] * 8}))
        frames = [{"format": "clues-motion-walk/1"},
                  {"viewpoint": [0, 0, 1.5], "thresholds": thresholds, "sizes": [6, 8],
                   "samples": [[i, *at] for i, at in enumerate(samples)],
                   "triangles": [[i, *t] for i, t in enumerate(triangles)]},
                  {"viewpoint": [0.25, 0, 1.5]}]
        self.write("walk.jsonl", "".join(json.dumps(frame) + "\n" for frame in frames))

    # A ball, an octahedron, the map of the octahedron to itself, and a hierarchy of the ball.
    def surfaces(self):
        def ball(n):
            numbers, triangles = {}, []
            for octant in range(8):
                signs = [-1 if octant >> k & 1 else 1 for k in range(3)]
                turned = signs[0] * signs[1] * signs[2] < 0

                def corner(i, j):
                    return numbers.setdefault((signs[0] * i, signs[1] * j, signs[2] * (n - i - j)), len(numbers))

                for i in range(n):
                    for j in range(n - i):
                        cells = [[(i, j), (i + 1, j), (i, j + 1)]] + [[(i + 1, j), (i + 1, j + 1), (i, j + 1)]] * (i + j + 1 < n)
                        triangles += [[corner(*at) for at in (cell[::-1] if turned else cell)] for cell in cells]
            return list(numbers), triangles

        for name, n in [("ball.off", 5), ("octahedron.off", 1)]:
            points, triangles = ball(n)
            self.write(name, "\n".join(["OFF", f"{len(points)} {len(triangles)} 0", *(" ".join(map(str, p)) for p in points),
                                        *("3 " + " ".join(map(str, t)) for t in triangles)]) + "\n")
        at = {v: (t, k) for t, corners in enumerate(triangles) for k, v in enumerate(corners)}
        self.write("plain.txt", "".join(f"{at[v][0]} {' '.join('1' if k == at[v][1] else '0' for k in range(3))}\n"
                                        for v in range(len(points))))
        self.sh("clues maps ball.off --base 20 -o ball.maps --uniform 2 --remesh uniform.ply --proof uniform.proof")

    def cases(self):
        shutil.copytree(self.folder / "vectors", self.folder / "my-cases")

    def results(self):
        (self.folder / "results").mkdir()

    def findings(self):
        self.sh("clues fuzz --subject './bake {scene} {cell} -o {pvs}' --generator axis_boxes --oracle sight-lines --cases 1 --out fuzz-bake")
        shutil.copytree(self.folder / "fuzz-bake/sight-lines-hidden-visible-axis_boxes", self.folder / "received-finding")


def is_listed(where, text, kind):
    for entry in NOT_RUN:
        if entry.kind == kind and where.startswith(entry.where) and re.match(entry.text, text):
            entry.met = True
            return True
    return False


def entries_without_use():
    for entry in NOT_RUN:
        if not entry.met:
            yield f"NOT_RUN: nothing in {entry.where} begins with {entry.text}; take the entry out"


def check_block(block, scratch):
    """Flaws of the block's commands, typed one after the other."""
    if is_listed(block.where, "\n".join(block.lines), "block"):
        return
    for command in block.commands():
        if is_listed(block.where, command.text, "command") or examples.SYNOPSIS.match(command.text):
            continue
        text = command.text
        for pattern, shorter in SHORTER:
            text = re.sub(pattern, shorter, text)
        code = next((code for pattern, code in EXIT_CODES if re.match(pattern, command.text)), 0)
        if "clues view" in command.text and not scratch.has_page:  # built without Node.js: it has to say so
            code = 2
        begin = time.monotonic()
        ran = examples.run(text, scratch.folder, scratch.environment)
        if "-v" in sys.argv:
            print(f"{time.monotonic() - begin:6.1f} s  exit code {ran.returncode}  {block.where}: {text}", flush=True)
        for flaw in examples.flaws(command, code, ran):
            yield f"{block.where}: {command.text}: {flaw}"


def help_texts(clues):
    def asked(*words):
        return subprocess.run([clues, *words, "--help"], capture_output=True, text=True, check=True).stdout
    texts = {"": asked()}

    def subcommands_of(text):
        listed = text.split("Subcommands:")[1].split("EXAMPLES")[0].split("DESCRIPTION")[0] if "Subcommands:" in text else ""
        return re.findall(r"^  ([a-z]+) ", listed, re.MULTILINE)

    for name in subcommands_of(texts[""]):
        texts[name] = asked(name)
        for second in subcommands_of(texts[name]):
            texts[f"{name} {second}"] = asked(name, second)
    return texts


def sources_of(source, texts):
    """Where people are told what to type: name, text, blocks."""
    for pattern in DOCUMENTS:
        for path in sorted(source.glob(pattern)):
            name, text = str(path.relative_to(source)), path.read_text(encoding="utf-8")
            yield name, text, list(examples.blocks_of_document(name, text))
    for command, text in texts.items():
        name = f"clues {command}".strip()
        yield name, text, list(examples.blocks_of_help(name, text))


def check_all(clues, source, only):
    texts = help_texts(clues)
    with tempfile.TemporaryDirectory(prefix="clues-documents-") as folder:
        viewed = subprocess.run([clues, "view", "-o", pathlib.Path(folder) / "page.html"], capture_output=True, text=True, check=False)
    for name, text, blocks in sources_of(source, texts):
        if only and not name.startswith(tuple(only)):
            continue
        for unknown in sorted(set(examples.unknown_names(examples.code_of(text, blocks), texts))):
            yield f"{name}: names `{unknown}`, which there is not"
        if name.startswith("clues") and not blocks:
            yield f"{name} --help: has no EXAMPLES"
        if not blocks:
            continue
        with tempfile.TemporaryDirectory(prefix="clues-documents-") as folder:
            scratch = Scratch(folder, clues, source)
            scratch.has_page = viewed.returncode == 0
            scratch.prepare(name)
            for block in blocks:
                yield from check_block(block, scratch)
    if not only:
        yield from entries_without_use()


def main():
    words = [word for word in sys.argv[1:] if word != "-v"]
    clues, source = (pathlib.Path(word).resolve() for word in words[:2])
    found = 0
    for flaw in check_all(clues, source, words[2:]):
        print(flaw, flush=True)
        found += 1
    print(f"{found} flaws" if found else "the documents can be typed")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
