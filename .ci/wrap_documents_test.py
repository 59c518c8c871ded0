#!/usr/bin/env python3
"""wrap_documents.py changes white space in paragraphs and nothing else, and what it has wrapped it leaves alone."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import wrap_documents  # noqa: E402
from wrap_documents import BLANK, TEXT, classified, wrapped  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent


def untouchable(text):
    """The lines of headings, tables, code and HTML, in order."""
    return [line.text for line in classified(text.split("\n")) if line.kind not in (TEXT, BLANK)]


class Wrapping(unittest.TestCase):
    def becomes(self, before, after, width=20):
        self.assertEqual(wrapped(before, width), after)
        self.assertEqual(wrapped(after, width), after)

    def test_paragraphs(self):
        self.becomes("one two three four five six\nseven", "one two three four\nfive six seven")
        self.becomes("one\ntwo\n\n\nthree", "one two\n\n\nthree")
        self.becomes("   one  two\n three", "   one two three")
        self.becomes("a " + "x" * 30 + " b", "a\n" + "x" * 30 + "\nb")

    def test_items(self):
        self.becomes("- one two three four five\n- six", "- one two three four\n  five\n- six")
        self.becomes("10. one two three four\nfive", "10. one two three\n    four five")
        self.becomes("- one two three\n  - four five six seven\n\n  eight nine ten eleven",
                     "- one two three\n  - four five six\n    seven\n\n  eight nine ten\n  eleven")
        self.becomes("> one two three four five", "> one two three four\n> five")

    def test_what_stays(self):
        for text in ["# one two three four five six seven", "| one two three four | five six seven |\n|---|---|",
                     "    one two three four five six seven", "```\none two three four five six seven\n```",
                     "- item\n\n      one two three four five six", "- item\n  ```\n  one two three four five six\n  ```",
                     "<p align=\"center\">\none two three four five six seven\n</p>", "<!-- one two three four\n\nfive six seven eight -->",
                     "[name]: https://example.org/one-two-three-four", "one\n===", "one\n\n---\n\ntwo"]:
            with self.subTest(text=text):
                self.becomes(text, text)

    def test_what_belongs_together(self):
        self.becomes("one two three `four  five` six", "one two three\n`four  five` six")
        self.becomes("one two three `a\nb`", "one two three `a b`")
        self.becomes("one two three (FIG. 20A) four", "one two three\n(FIG. 20A) four")
        self.becomes("one two  \nthree", "one two  \nthree")
        self.becomes("one two\\\nthree", "one two\\\nthree")

    def test_no_line_begins_a_block_by_accident(self):
        for word in ["-", "+", "*", "1.", "12)", "#", ">", "|", "---", "===", "<div>", "1984."]:
            with self.subTest(word=word):
                text = f"one two three four {word} five"
                result = wrapped(text, 20)
                self.assertTrue(all(not line.startswith(word) for line in result.split("\n")), result)
                self.becomes(text, result)

    def test_the_documents(self):
        found = list(wrap_documents.documents(ROOT))
        self.assertGreater(len(found), 20)
        for document in found:
            before = (ROOT / document).read_text(encoding="utf-8")
            for width in (20, 60, wrap_documents.WIDTH):
                with self.subTest(document=str(document), width=width):
                    after = wrapped(before, width)
                    self.assertEqual(wrap_documents.words(before), wrap_documents.words(after))
                    self.assertEqual(untouchable(before), untouchable(after))
                    self.assertEqual(wrapped(after, width), after)


if __name__ == "__main__":
    unittest.main()
