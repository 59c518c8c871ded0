#!/usr/bin/env python3
"""Shards of the mutation run are all of it, and what is merged says so. Usage: run_test.py"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from mutations import MUTATIONS  # noqa: E402
from run import shard_of, write  # noqa: E402

NAMES = [name for name, *_ in MUTATIONS]


class Shards(unittest.TestCase):
    def merged(self, shares):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for i, names in enumerate(shares):
                write([(n, "caught", 1, "a-case") for n in names], folder / f"out.{i}")
            files = [str(folder / f"out.{i}") for i in range(len(shares))]
            ran = subprocess.run([sys.executable, HERE / "run.py", HERE.parents[1], "--merge", *files, "--out", folder / "all"],
                                 capture_output=True, text=True)
            return ran, (folder / "all").read_text() if (folder / "all").exists() else ""

    def test_shares_make_the_whole(self):
        ran, text = self.merged([NAMES[0::3], NAMES[1::3], NAMES[2::3]])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual([line.split("|")[1].strip() for line in text.splitlines()[2:] if line.startswith("|")], NAMES)

    def test_a_missing_or_repeated_share_is_refused(self):
        for shares, what in (([NAMES[0::2]], NAMES[1]), ([NAMES, NAMES[:1]], NAMES[0])):
            ran, text = self.merged(shares)
            self.assertEqual((ran.returncode, text), (1, ""))
            self.assertIn(what, ran.stderr)

    def test_the_shard_is_that_of_the_rank(self):
        self.assertEqual(shard_of("2/5"), (1, 5))
        for wrong in ("0/2", "3/2", "x/2", "1", "-1/2"):
            with self.assertRaises(SystemExit):
                shard_of(wrong)
        os.environ.update(OMPI_COMM_WORLD_RANK="3", OMPI_COMM_WORLD_SIZE="4")
        self.assertEqual(shard_of(""), (3, 4))


if __name__ == "__main__":
    unittest.main()
