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
            ("scene/mesh.h", '#include "exact/kernel.h"'),
            ("exact/kernel.h", '#include "reference/visibility/wedge.h"'),
            ("reference/visibility/walk.cpp", '#include "fastpath/bvh.h"'),
            ("fastpath/bvh.cpp", '#include "reference/visibility/wedge.h"'),
            ("reference/a/b.cpp", '#  include "../../validate/judge.h"'),
            ("validate/judge.cpp", "#include <clues/fuzz/generators/city.h>"),
            ("fuzz/driver.cpp", '#include "app/main.h"'),
            ("app/main.cpp", '#include "tests/app/helper.h"'),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(len(self.found(path, line)), 1)

    def test_with_the_layers(self):
        for path, line in [
            ("exact/kernel.h", '#include "scene/mesh.h"'),
            ("exact/kernel.h", "#include <CGAL/Plane_3.h>"),
            ("reference/visibility/walk.cpp", '#include "reference/visibility/wedge.h"'),
            ("app/main.cpp", '#include "fuzz/generators/city.h"'),
            ("scene/mesh.cpp", '// #include "exact/kernel.h"'),
        ]:
            with self.subTest(path=path, line=line):
                self.assertEqual(self.found(path, line), [])

    def test_nothing_checked_is_no_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(check_includes.violations(pathlib.Path(folder)))), 1)


if __name__ == "__main__":
    unittest.main()
