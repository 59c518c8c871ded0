#!/usr/bin/env python3
"""A real bake, killed ten times: does the store equal that of one which nobody disturbed?

    bench/kill_bake.py CLUES SCENE CELLS [KILLS [SEED]]

CLUES is the program, SCENE and CELLS as for `clues bake`. The bake runs once as it is; then into another store, where it is
killed (SIGKILL) after times that are drawn from SEED, and started again each time.
Exit codes: 0 the stores have the same bytes; 1 they differ, or a bake failed; 2 bad usage. The small form, at every system
call that changes a file, is `KillsLong` in tests/app/."""
import pathlib
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time


def cells_done(store):
    """Cells that are committed: what a reader beside the bake sees. None while the file is not made yet."""
    try:
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True, timeout=60) as db:
            return db.execute("SELECT count(list), count(*) FROM cells").fetchone()
    except sqlite3.OperationalError:
        return None


def main(words):
    if len(words) not in (3, 4, 5):
        print(__doc__, file=sys.stderr)
        return 2
    kills, seed = (int(w) for w in (words[3:] + ["10", "1"][len(words) - 3:]))
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        def bake(store):
            return [words[0], "bake", words[1], "--cells", words[2], "-o", str(store)]
        whole, broken = pathlib.Path(folder, "whole.bake"), pathlib.Path(folder, "broken.bake")
        begin = time.monotonic()
        if subprocess.run(bake(whole), check=False, stdout=subprocess.DEVNULL).returncode != 0:
            return 1
        cells, seconds = cells_done(whole)[1], time.monotonic() - begin
        print(f"{cells} cells in {seconds:.1f} s, undisturbed")
        killed = 0
        while killed < kills:
            process = subprocess.Popen(bake(broken), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(timeout=draw.uniform(0.02, 1.2 * seconds / kills))
                break  # it was faster than we are
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
            killed += 1
            done = cells_done(broken)
            print(f"kill {killed}: {'no store' if done is None else f'{done[0]} of {done[1]} cells'} there")
        if subprocess.run(bake(broken), check=False, stdout=subprocess.DEVNULL).returncode != 0:
            return 1
        same = whole.read_bytes() == broken.read_bytes()
        print(f"after {killed} kills the store has {'the same' if same else 'OTHER'} bytes")
        return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
