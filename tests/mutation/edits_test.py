#!/usr/bin/env python3
"""A test of the test: a text that is gone or there twice is noticed, and so is a file that is."""
import pathlib
import tempfile
import unittest

from edits import NotFound, edited, source_of


class Edits(unittest.TestCase):
    def test_a_text_is_replaced_once(self):
        self.assertEqual(edited("reference/a.cpp", "one two", "two", "three"), "one three")

    def test_a_text_that_is_not_there_once(self):
        for text in ["one", "two two"]:
            with self.subTest(text=text), self.assertRaisesRegex(NotFound, "reference/a.cpp: this text is there [02] times"):
                edited("reference/a.cpp", text, "two", "three")

    def test_a_file_is_found_in_any_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path in ["reference/walk.cpp", "reference/a/b/apex.cpp", "fastpath/walk.cpp", "reference/a/twice.cpp", "reference/b/twice.cpp"]:
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).touch()
            self.assertEqual(source_of(root, "reference/apex.cpp"), root / "reference/a/b/apex.cpp")
            self.assertEqual(source_of(root, "reference/walk.cpp"), root / "reference/walk.cpp")
            for name in ["reference/twice.cpp", "reference/none.cpp", "fastpath/apex.cpp"]:
                with self.subTest(name=name), self.assertRaisesRegex(NotFound, name):
                    source_of(root, name)


if __name__ == "__main__":
    unittest.main()
