#!/usr/bin/env python3
"""A test of the test: every planted second definition is caught, and what only looks like one passes."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_definitions  # noqa: E402

BOX = "namespace clues::fastpath {\nstruct Box {\n  float low[3];\n};\n}\n"


class Planted(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            return list(check_definitions.violations(root))

    def test_two_of_one_name(self):
        for path, text in [
            ("fastpath/visibility/points/box.h", "namespace clues::fastpath {\nstruct Box {\n  Point low{}, high{};\n};\n}\n"),
            ("fastpath/box.cpp", BOX),
            ("tests/fastpath/box.h", BOX),
            ("exact/a.h", "namespace clues {\nnamespace fastpath {\nclass Box final : public Base<int> {};\n} }\n"),
            ("exact/a.h", "namespace clues::fastpath { enum class Box : std::uint8_t { none }; }\n"),
            ("exact/a.h", "namespace clues::fastpath { template <class T, std::enable_if_t<(sizeof(T) > 1)>* = nullptr>\n"
                          "struct alignas(64) Box { T low; }; }\n"),
            ("exact/a.h", "int f() { return 1'000'000; }\nnamespace clues::fastpath { union Box { int x; }; }\n"),
            ("exact/a.h", 'namespace clues::fastpath { const char* s = "}"; struct [[nodiscard]] Box { int x; }; }\n'),
        ]:
            with self.subTest(path=path, text=text):
                found = self.found({"fastpath/queries/bvh_build.h": BOX, path: text})
                self.assertEqual(len(found), 1)
                self.assertIn("clues::fastpath::Box", found[0])
                self.assertIn("fastpath/queries/bvh_build.h:2", found[0])

    def test_in_a_class(self):
        self.assertEqual(len(self.found({
            "fastpath/a.h": "namespace n { class A { public: struct In { int x; }; }; }",
            "fastpath/b.h": "namespace n { struct A::In { int y; }; }"})), 1)

    def test_no_second_thing(self):
        for text in [
            "namespace clues::fastpath { struct Box; class Box* f(struct Box x); }\n",
            "namespace clues::reference { struct Box { int x; }; }\n",
            "namespace clues::fastpath { namespace { struct Box { int x; }; } }\n",
            "namespace clues::fastpath { inline int f() { struct Box { int x; }; return 1; } }\n",
            "namespace clues::fastpath { inline auto f = [] { struct Box { int x; }; return 1; }; }\n",
            "namespace clues::fastpath { template <> struct Box<int> { int x; }; }\n",
            "namespace clues::fastpath { struct Holder { struct Box { int x; }; }; }\n",
            "// namespace clues::fastpath { struct Box { int x; }; }\n",
            "namespace clues::fastpath { struct Box make() { return {}; } }\n",
        ]:
            with self.subTest(text=text):
                self.assertEqual(self.found({"fastpath/queries/bvh_build.h": BOX, "fastpath/other.h": text}), [])

    def test_nothing_checked_is_no_pass(self):
        self.assertEqual(len(self.found({"scene/empty.h": "#pragma once\n"})), 1)


if __name__ == "__main__":
    unittest.main()
