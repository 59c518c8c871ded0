#!/usr/bin/env python3
"""A test of the test: every planted include against the layers is caught, and a clean tree passes."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_includes  # noqa: E402


class Planted(unittest.TestCase):
    def found(self, path, line):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            source = root / path
            source.parent.mkdir(parents=True)
            source.write_text(f"// opening\n{line}\n")
            return list(check_includes.violations(root))

    def test_against_the_layers(self):
        for path, line in [
            ("scene/mesh/mesh.h", '#include "exact/kernel.h"'),
            ("exact/kernel.h", '#include "reference/visibility/wedges/wedge.h"'),
            ("reference/visibility/labels/walk.cpp", '#include "fastpath/queries/bvh.h"'),
            ("fastpath/queries/bvh.cpp", '#include "reference/visibility/wedges/wedge.h"'),
            ("reference/visibility/first_order.cpp", '#  include "../../validate/verdicts/judge.h"'),
            ("validate/verdicts/judge.cpp", "#include <clues/fuzz/generators/city.h>"),
            ("fuzz/campaign/driver.cpp", '#include "app/main.h"'),
            ("app/main.cpp", '#include "tests/app/helper.h"'),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(len(self.found(path, line)), 1)

    def test_with_the_layers(self):
        for path, line in [
            ("exact/kernel.h", '#include "scene/mesh/mesh.h"'),
            ("exact/kernel.h", "#include <CGAL/Plane_3.h>"),
            ("reference/visibility/labels/walk.cpp", '#include "reference/visibility/wedges/wedge.h"'),
            ("app/main.cpp", '#include "fuzz/generators/city.h"'),
            ("scene/mesh/mesh.cpp", '// #include "exact/kernel.h"'),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(self.found(path, line), [])

    def test_against_the_chapters(self):
        for path, line in [
            ("reference/visibility/wedges/apex.cpp", '#include "reference/visibility/labels/walk.h"'),
            ("reference/visibility/first_order.cpp", '#include "reference/visibility/refinement/bounds.h"'),
            ("exact/kernel.h", '#include "exact/cell/convex_cell.h"'),
            ("fuzz/findings/finding.cpp", "#include <clues/fuzz/shrinking/shrink.h>"),
            ("scene/surprise/mesh.h", "#include <vector>"),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(len(self.found(path, line)), 1)

    def test_with_the_chapters(self):
        for path, line in [
            ("reference/visibility/labels/walk.cpp", '#include "reference/visibility/wedges/apex.h"'),
            ("reference/visibility/labels/walk.cpp", '#include "reference/visibility/labels/grooves.h"'),
            ("validate/adapters/cpp/adapter.cpp", "#include <vector>"),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(self.found(path, line), [])

    def test_a_crowded_chapter_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            (root / "exact/cell").mkdir(parents=True)
            for i in range(check_includes.MOST_FILES + 1):
                (root / f"exact/cell/f{i}.h").write_text("#pragma once\n")
            self.assertEqual(len(list(check_includes.violations(root))), 1)

    def test_nothing_checked_is_no_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(check_includes.violations(pathlib.Path(folder)))), 1)


if __name__ == "__main__":
    unittest.main()
