#!/usr/bin/env python3
"""A test of the test: every planted flaw of a document is caught, and what is right passes."""
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import documents_test  # noqa: E402
import examples  # noqa: E402

HELP = {"map": "  --cell SPEC  --json [FILE]\n", "conform": "  --impl CMD  --case GLOB\n", "iut": "  --kernel NAME\n"}


def commands(text):
    return [command for block in examples.blocks_of_document("d", text) for command in block.commands()]


def ran(code, out="", err=""):
    return subprocess.CompletedProcess([], code, out, err)


class Found(unittest.TestCase):
    def test_blocks_of_every_kind(self):
        text = "Text\n\n    one  # why\n    two\n\n1. item\n\n       three \\\n         more\n\n```sh\nfour\n```\n"
        self.assertEqual([c.text for c in commands(text)], ["one  # why", "two", "three \\\n  more", "four"])

    def test_no_blocks(self):
        self.assertEqual(commands("- item\n    goes on\n\ntext `code`\n\n```yaml\na: b\n```\n"), [])

    def test_a_loop_is_one_command(self):
        self.assertEqual(len(commands("\n    for i in 1 2; do\n      echo $i\n    done\n    echo 3\n")), 2)

    def test_output_is_shown_after_a_prompt(self):
        found = commands("\n    $ one\n    first\n      second\n    $ two\n")
        self.assertEqual([(c.text, c.output) for c in found], [("one", ["first", "  second"]), ("two", [])])

    def test_examples_of_help(self):
        blocks = list(examples.blocks_of_help("clues x", "EXAMPLES\n  clues x a\n  clues x b\n\nEXIT CODES\n  0 fine\n"))
        self.assertEqual([c.text for b in blocks for c in b.commands()], ["clues x a", "clues x b"])
        self.assertEqual(list(examples.blocks_of_help("clues x", "EXIT CODES\n  0 fine\n")), [])


class Judged(unittest.TestCase):
    def flaws(self, code, result, *output):
        return list(examples.flaws(examples.Command("c", list(output)), code, result))

    def test_exit_codes(self):
        self.assertEqual(self.flaws(0, ran(0)), [])
        self.assertEqual(self.flaws(1, ran(1)), [])
        self.assertIn("exit code 2 in place of 0: bad", self.flaws(0, ran(2, "", "bad\n"))[0])
        self.assertEqual(len(self.flaws(1, ran(0))), 1)

    def test_words_must_be_those_shown(self):
        shown = ["verdict: unsound", "  from (0, -1/8, 2.5e-7)  at 4"]
        self.assertEqual(self.flaws(0, ran(0, "verdict: unsound\n from (3/4, 1, -2)   at 17\n"), *shown), [])
        for other in ["verdict: sound\n from (0, 0, 0) at 4\n", "verdict: unsound\n", "verdict: unsound\n from (0, 0) at 4\n",
                      "verdict: unsound\n from (0, 0, 0) at 4\nmore\n"]:
            self.assertEqual(len(self.flaws(0, ran(0, other), *shown)), 1, other)

    def test_names_that_there_are_not(self):
        for piece, unknown in [("clues map --cell X --json", []), ("clues map --cells X", ["clues map --cells"]),
                               ("clues mop", ["clues mop"]), ("other --cells", []),
                               ("clues conform --impl 'clues iut --kernel exact' --case 'x'", []),
                               ("clues conform --impl 'clues iut --kernels exact'", ["clues iut --kernels"]),
                               ("clues map --cell X  # not --cells", [])]:
            self.assertEqual(list(examples.unknown_names([piece], HELP)), unknown, piece)


class Listed(unittest.TestCase):
    def test_what_is_neither_run_nor_listed_is_typed(self):
        with documents_test.tempfile.TemporaryDirectory() as folder:
            scratch = documents_test.Scratch(folder, pathlib.Path("/bin/true"), pathlib.Path("."))
            block = examples.Block("README.md:1", ["exit 3", "./run demo", "clues map SCENE --cell SPEC"])
            found = list(documents_test.check_block(block, scratch))
        self.assertEqual(len(list(documents_test.entries_without_use())), len(documents_test.NOT_RUN) - 1)
        self.assertEqual(len(found), 1)
        self.assertIn("README.md:1: exit 3: exit code 3 in place of 0", found[0])


if __name__ == "__main__":
    unittest.main()
