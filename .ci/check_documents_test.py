#!/usr/bin/env python3
"""A test of the test: every planted long line and dead link is caught, and what only looks like one passes."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_documents  # noqa: E402

LONG = "word " * 30
OTHER = "# Other page\n\n## What it does, and `why`\n\n## Twice\n\n## Twice\n\n    # no heading\n"


class Planted(unittest.TestCase):
    def found(self, text, path="docs/page.md"):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, content in {"docs/other.md": OTHER, "scene/mesh.h": "", path: text}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(content)
            return list(check_documents.violations(root))

    def test_long_lines(self):
        for text in [LONG, f"- {LONG}", f"> {LONG}", f"# {LONG}", f"<p>{LONG}</p>", f"text\n{LONG}", f"1. item\n\n   {LONG}",
                     f"[a link]({'x' * 110}://y) {LONG}", f"    code\n\n{LONG}"]:
            with self.subTest(text=text):
                self.assertEqual(len(self.found(text + "\n")), 1)

    def test_lines_that_may_be_long(self):
        for text in [f"| {LONG} |", f"    {LONG}", f"```\n{LONG}\n```", f"- item\n\n      {LONG}", f"https://{'x' * 110}",
                     f"- <https://{'x' * 110}>", "x" * 110]:
            with self.subTest(text=text):
                self.assertEqual(self.found(text + "\n"), [])

    def test_dead_links(self):
        for text in ["[a](missing.md)", "[a](other.md#missing)", "[a](#missing)", "[a](../../outside.md)", "[a](/docs/other.md)",
                     "[a\nb](missing.md)", "![a](missing.png)", "| [a](missing.md) |", "[a](other.md#no-heading)",
                     "[a](other.md#twice-2)", "[a]: missing.md", "- [`a`](missing.md)", "> [a](missing.md)", "[a](scene/mesh.h)"]:
            with self.subTest(text=text):
                self.assertEqual(len(self.found(text + "\n")), 1)

    def test_links_that_lead_somewhere(self):
        for text in ["[a](other.md)", "[a](other.md#what-it-does-and-why)", "[a](other.md#twice-1)", "# Top\n\n[a](#top)",
                     "[a](../scene/mesh.h)", "[a](../scene/)", "<https://example.org/x#y>", "[a](https://example.org)",
                     "`[a](missing.md)`", "    [a](missing.md)", "```\n[a](missing.md)\n```", "<a id=\"here\"></a>\n\n[a](#here)",
                     "`a`[0](b", "[a]: other.md"]:
            with self.subTest(text=text):
                self.assertEqual(self.found(text + "\n"), [])

    def test_answers_to_questions(self):
        table = "| question | folder | file |\n|---|---|---|\n| what | `scene` | `{}` |\n"
        self.assertEqual(self.found(table.format("mesh.h")), [])
        self.assertEqual(len(self.found(table.format("mesh.cpp"))), 1)
        self.assertEqual(len(self.found(table.format("mesh.h`, and `none.h"))), 1)
        self.assertEqual(self.found(table.format("mesh.cpp").replace("question", "thing")), [])

    def test_where_it_looks(self):
        for path in ["README.md", "CONTRIBUTING.md", "docs/page.md", "fastpath/README.md", "reference/visibility/README.md"]:
            with self.subTest(path=path):
                self.assertEqual(len(self.found("[a](missing.md)\n", path)), 1)
        for path in ["build/dev/README.md", "viewer/node_modules/x/README.md", ".git/README.md", "scene/notes.md"]:
            with self.subTest(path=path):
                self.assertEqual(self.found("[a](missing.md)\n", path), [])

    def test_the_line_is_named(self):
        self.assertTrue(self.found("# Top\n\ntext\n[a](missing.md)\n")[0].startswith("docs/page.md:4: "))

    def test_nothing_checked_is_no_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(check_documents.violations(pathlib.Path(folder)))), 1)


if __name__ == "__main__":
    unittest.main()
