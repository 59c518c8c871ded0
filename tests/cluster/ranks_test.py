#!/usr/bin/env python3
"""Bakes and campaigns by many ranks and shards leave the bytes that one process leaves, whatever is killed on the way.

Usage: ranks_test.py CLUES same|kills [KILLS]: `same` for 1 to 4 ranks and shards; `kills` ends a rank other than the
first, and the first one, with SIGKILL at KILLS seeded moments each, and goes on with another number of ranks.
Exit code 77: there is no mpirun."""
import filecmp
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SEED = 20261123
# Whoever the tests run as, in whatever container, and with whatever else on the machine.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "LSAN_OPTIONS": "detect_leaks=0",  # what Open MPI keeps to its end
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_hwloc_base_binding_policy": "none"}


def town(streets):
    """Boxes on a floor, as OBJ."""
    points, faces = [(0, 0, 0), (4 * streets, 0, 0), (4 * streets, 4 * streets, 0), (0, 4 * streets, 0)], [(1, 2, 3), (1, 3, 4)]
    chance = random.Random(SEED)
    for x in range(streets):
        for y in range(streets):
            low, height, first = (4 * x + 1, 4 * y + 1), chance.randint(2, 9), len(points) + 1
            points += [(low[0] + 2 * a, low[1] + 2 * b, height * c) for c in (0, 1) for b in (0, 1) for a in (0, 1)]
            for a, b, c, d in ((0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6), (4, 5, 7, 6)):
                faces += [(first + a, first + b, first + c), (first + a, first + c, first + d)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "".join(f"f {a} {b} {c}\n" for a, b, c in faces)


class Work:
    """A command that leaves a file, and what else it needs: `file` in `folder`."""

    def __init__(self, clues, folder, name, words, exit_code):
        self.clues, self.folder, self.name, self.words, self.exit_code = clues, folder, name, words, exit_code

    def command(self, out, more=(), ranks=None):
        ahead = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks else []
        return [*ahead, self.clues, *self.words, *more, "--out" if self.name == "fuzz" else "-o", out]

    def file(self, out):
        return self.folder / out / "findings.sqlite" if self.name == "fuzz" else self.folder / out

    def run(self, out, more=(), ranks=None, exit_code=None):
        ran = subprocess.run(self.command(out, more, ranks), cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True)
        assert ran.returncode == (self.exit_code if exit_code is None else exit_code), (ran.args, ran.returncode, ran.stderr)
        return ran

    def require_same(self, out, what):
        assert filecmp.cmp(self.file("whole"), self.file(out), shallow=False), f"{self.name}: {what}: other bytes"
        if self.name != "fuzz":
            return
        trees = [sorted(p.relative_to(self.folder / o) for p in (self.folder / o).rglob("*")) for o in ("whole", out)]
        assert trees[0] == trees[1], f"{self.name}: {what}: other files"
        for path in trees[0]:
            one, other = self.folder / "whole" / path, self.folder / out / path
            if path.name != "command.txt" and one.is_file():
                assert filecmp.cmp(one, other, shallow=False), f"{self.name}: {what}: {path}"

    def remove(self, out):
        shutil.rmtree(self.folder / out, ignore_errors=True)
        (self.folder / out).unlink(missing_ok=True) if not (self.folder / out).is_dir() else None


def is_rank(process, mpirun, rank):
    try:
        parent = (process / "stat").read_text().rsplit(")", 1)[1].split()[1]
        words = (process / "environ").read_bytes().split(b"\0")
    except OSError:
        return False
    return parent == str(mpirun) and f"OMPI_COMM_WORLD_RANK={rank}".encode() in words


def kill_rank(mpirun, rank):
    """Whether there was one. mpirun starts the ranks of its own machine itself."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        if is_rank(process, mpirun, rank):
            os.kill(int(process.name), signal.SIGKILL)
            return True
    return False


def same_by_ranks(work):
    work.run("whole")
    for ranks in (1, 2, 3, 4):
        work.run("ranks", ranks=ranks)
        work.require_same("ranks", f"{ranks} ranks")
        work.remove("ranks")


def same(work):
    same_by_ranks(work)
    shards = [f"shard{i}" for i in (1, 2, 3)]
    for i, shard in enumerate(shards, 1):
        work.run(shard, ["--shard", f"{i}/3"], ranks=i)
    work.run("merged", ["--merge", *shards])
    work.require_same("merged", "3 shards, each by other ranks")
    print(f"{work.name}: the same bytes by 1, 2, 3, 4 ranks, and by 3 shards of 1, 2, 3 ranks")


def same_order(clues, folder):
    """Of a campaign that chooses its cases by what came of those before."""
    folder.mkdir()
    same_by_ranks(Work(clues, folder, "fuzz", ["fuzz", "--seek-pairs", "--generator", "rim_fans", "--generator", "cell_contacts",
                                               "--oracle", "cell-contact", "--cases", "16"], 0))
    print("fuzz --seek-pairs: the same bytes by 1, 2, 3, 4 ranks")


def kills(work, count):
    work.run("whole")
    begin = time.monotonic()
    work.run("ranks", ranks=3)
    seconds, chance, met = time.monotonic() - begin, random.Random(SEED), 0
    for victim in (1, 0):
        for _ in range(count):
            work.remove("killed")
            running = subprocess.Popen(work.command("killed", ranks=3), cwd=work.folder, env=ENVIRONMENT,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            rank = 0 if victim == 0 else chance.randint(1, 2)
            try:
                running.wait(chance.uniform(0.1, 0.8) * seconds)
            except subprocess.TimeoutExpired:  # and where mpirun has not come so far: as soon as the rank is there
                hit = False
                while not hit and running.poll() is None:
                    hit = kill_rank(running.pid, rank)
                met += hit
            running.wait()
            ranks = chance.randint(1, 4)
            work.run("killed", ranks=ranks)
            work.require_same("killed", f"rank {victim} killed, gone on with {ranks}")
    print(f"{work.name}: {2 * count} runs, {met} of them with a rank killed, gone on with, the same bytes")
    assert met > 0, "nothing was killed"


def wrong_commands(work):
    ran = work.run("none", ["--shard", "3/2"], ranks=2, exit_code=2)
    assert ran.stderr.count("clues: error:") == 1, ran.stderr


def same_reports(clues, folder):
    """Of commands that keep no store."""
    root = pathlib.Path(__file__).resolve().parents[2]
    suite = root / "vectors"
    adapter = (root / "validate/adapters/python/clues_adapter.py").read_text()
    (folder / "adapter.py").write_text(adapter.replace("if t not in not_counted]", "if t % 7 == 0 and t not in not_counted]"))
    words = {"conform": ["conform", "--impl", f"{clues} iut --kernel fast", "--suite", suite, "--case", "i*"],
             # Stops in the middle: what others did meanwhile does not count.
             "stopped": ["conform", "--impl", "python3 adapter.py", "--suite", suite, "--errors", "20"],
             "lint": ["lint", suite, "--case", "iris*"]}
    for name, command in words.items():
        reports = {}
        for ranks in (None, 1, 2, 3):
            ahead = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks else []
            ran = subprocess.run([*ahead, clues, *command, "--jobs", "1", "--json", "report.json"], cwd=folder, env=ENVIRONMENT,
                                 capture_output=True, text=True)
            reports[ranks] = (ran.returncode, (folder / "report.json").read_bytes() if ran.returncode in (0, 1, 3) else ran.stderr.splitlines()[0])
        assert len(set(reports.values())) == 1, (name, reports)
        print(f"{name}: the same report by 1, 2, 3 ranks, exit code {reports[None][0]}")


def main():
    clues, what = os.path.abspath(sys.argv[1]), sys.argv[2]
    if not shutil.which("mpirun"):
        print("no mpirun")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        for kind in ("bake", "fuzz"):
            folder = pathlib.Path(name) / kind
            folder.mkdir()
            (folder / "town.obj").write_text(town(3))
            cells = "grid:4x4x1:box:0,0,0.5,12,12,2"
            # A program that lists nothing: there is something to find, to shrink and to store.
            work = (Work(clues, folder, "bake", ["bake", "town.obj", "--cells", cells, "--threads", "1"], 0)
                    if kind == "bake" else
                    Work(clues, folder, "fuzz", ["fuzz", "--subject", "sh -c ': > {pvs}'", "--generator", "coplanar_walls",
                                                 "--generator", "cell_contacts", "--oracle", "cell-contact", "--oracle",
                                                 "sight-lines", "--cases", "16"], 1))
            if what == "same":
                wrong_commands(work)
                same(work)
                if kind == "bake":
                    same_reports(clues, folder)
                else:
                    same_order(clues, folder / "pairs")
            else:
                kills(work, int(sys.argv[3]))


if __name__ == "__main__":
    main()
