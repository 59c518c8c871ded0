#!/usr/bin/env python3
"""A test of the test: what is planted in a header or a source is caught, and a clean folder passes."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_planted  # noqa: E402


class Planted(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            return list(check_planted.violations([root]))

    def test_something_planted(self):
        for path, text in [("a/walk.h", "int x;\nenum class PlantedBug { none };\n"),
                           ("walk.cpp", "int x;\nif (planted_ == 1) return;\n"),
                           ("walk.h", "int x;\n// a planted bug\n")]:
            with self.subTest(text=text):
                found = self.found({path: text, "clean.h": "int y;\n"})
                self.assertEqual(len(found), 1)
                self.assertIn(f"{path}:2:", found[0])

    def test_nothing_planted(self):
        self.assertEqual(self.found({"walk.h": "#pragma once\n", "README.md": "planted\n"}), [])

    def test_nothing_checked_is_no_pass(self):
        self.assertEqual(len(self.found({"README.md": "nothing\n"})), 1)


if __name__ == "__main__":
    unittest.main()
