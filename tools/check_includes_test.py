#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of check_includes.py: each breach is caught, at its line, and right code passes."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import check_includes

ARROWS = """
core   ->
scan   -> core
fit    -> core
model  -> core
detect -> scan model fit
sim    -> scan model
apps   -> *
tests  -> *
fit    never scan
sim    never detect
"""


def room(name, headers="", depends=""):
    return f"verge_room({name}\n  HEADERS {headers}\n  SOURCES a.cpp  # its code\n  DEPENDS {depends})\n"


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        self.write("cmake/arrows.txt", ARROWS)
        self.write("verge/core/CMakeLists.txt", room("core", "vec.hpp"))
        self.write("verge/core/vec.hpp", "#pragma once\n")
        self.write("verge/scan/CMakeLists.txt", room("scan", "scan.hpp", "core"))
        self.write("verge/scan/scan.hpp", '#pragma once\n#include <vector>\n\n#include "verge/core/vec.hpp"\n')

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def breaches(self):
        return check_includes.check(self.root)[0]

    def test_right_code_passes(self):
        self.write("verge/detect/CMakeLists.txt", room("detect", "detector.hpp", "scan"))
        self.write("verge/detect/detector.hpp", '#include "verge/scan/scan.hpp"\n#include "verge/core/vec.hpp"\n')
        self.write("verge/detect/gradient/gradient.cpp", '#include "verge/detect/detector.hpp"\n')
        self.write("apps/verge/main.cpp", '#include <iostream>\n#include "verge/detect/detector.hpp"\n')
        self.assertEqual(check_includes.check(self.root), ([], 5))

    def test_an_include_against_the_arrows_is_caught_at_its_line(self):
        self.write("verge/core/pose.cpp", '\n#include "verge/scan/scan.hpp"\n')
        self.assertIn('verge/core/pose.cpp:2: "verge/scan/scan.hpp": there is no arrow core -> scan', self.breaches())

    def test_never_holds_although_an_arrow_is_drawn(self):
        self.write("cmake/arrows.txt", ARROWS.replace("fit    -> core", "fit    -> scan"))
        self.write("verge/fit/CMakeLists.txt", room("fit", "", "scan"))
        self.write("verge/fit/line.cpp", '#include "verge/scan/scan.hpp"\n')
        self.assertEqual(len(self.breaches()), 2)  # the include and the DEPENDS

    def test_one_method_must_not_use_another(self):
        self.write("verge/detect/CMakeLists.txt", room("detect"))
        self.write("verge/detect/lda/lda.hpp", "\n")
        self.write("verge/detect/gradient/gradient.cpp", '#include "verge/detect/lda/lda.hpp"\n')
        self.assertIn("must not use detect/lda", "".join(self.breaches()))

    def test_a_private_header_is_private(self):
        self.write("verge/core/detail.hpp", "\n")
        self.write("verge/scan/scan.cpp", '#include "verge/core/detail.hpp"\n')
        self.assertEqual(self.breaches(),
                         ['verge/scan/scan.cpp:1: "verge/core/detail.hpp": not among the HEADERS of its room'])

    def test_tests_may_look_behind_and_share_headers_of_their_own(self):
        self.write("verge/core/detail.hpp", "\n")
        self.write("tests/laws/world.hpp", "\n")
        self.write("tests/laws/shuffle.cpp", '#include "tests/laws/world.hpp"\n#include "verge/core/detail.hpp"\n')
        self.assertEqual(self.breaches(), [])
        self.write("verge/core/vec.hpp", '#include "tests/laws/world.hpp"\n')
        self.assertEqual(len(self.breaches()), 1)

    def test_tests_may_use_the_programs_parts_and_the_library_may_not(self):
        self.write("apps/verge/settings.hpp", "\n")
        self.write("tests/fuzz/config_fuzz.cpp", '#include "apps/verge/settings.hpp"\n')
        self.assertEqual(self.breaches(), [])
        self.write("verge/core/pose.cpp", '#include "apps/verge/settings.hpp"\n')
        self.assertEqual(len(self.breaches()), 1)

    def test_relative_and_missing_includes_are_caught(self):
        self.write("verge/core/pose.cpp", '#include "vec.hpp"\n#include "verge/core/gone.hpp"\n')
        self.assertEqual([line.split(": ")[0] for line in self.breaches()],
                         ["verge/core/pose.cpp:1", "verge/core/pose.cpp:2"])

    def test_depends_must_cover_the_includes_and_keep_to_the_arrows(self):
        self.write("verge/scan/CMakeLists.txt", room("scan", "scan.hpp", ""))
        self.write("verge/core/CMakeLists.txt", room("core", "vec.hpp", "scan"))
        self.assertEqual(self.breaches(),
                         ["verge/core/CMakeLists.txt:1: DEPENDS scan: there is no arrow core -> scan",
                          "verge/scan/CMakeLists.txt:1: DEPENDS lacks core, which verge/scan/scan.hpp includes"])

    def test_an_unknown_room_is_caught(self):
        self.write("verge/attic/a.cpp", "\n")
        self.assertEqual(self.breaches(), ["verge/attic/a.cpp:1: no such room in cmake/arrows.txt: attic"])

    def test_a_library_that_prints_or_exits_is_caught(self):
        for line in ("#include <iostream>", "std::cout << 1;", 'printf("x");', 'std::fprintf(stderr, "x");',
                     'fmt::print("x");', "std::exit(1);", "std::abort();", 'fputs("x", f);'):
            self.write("verge/core/a.cpp", f"{line}\n")
            self.assertEqual(len(self.breaches()), 1, line)

    def test_words_like_print_in_comments_strings_and_names_are_no_breach(self):
        self.write("verge/core/a.cpp", "// printf(x)\n/* exit(1)\n abort() */ auto s = \"std::cout\";\n"
                   "auto t = R\"(exit(0))\"; int n = snprintf(b, 1, f); footprint(2); on_exit_called(3);\n")
        self.assertEqual(self.breaches(), [])

    def test_a_heavy_library_in_a_public_header_is_caught(self):
        self.write("verge/core/vec.hpp", "#include <Eigen/Core>\n")
        self.assertEqual(self.breaches(), ["verge/core/vec.hpp:1: <Eigen/Core>: heavy, include it in a .cpp file"])

    def test_cycles_and_unknown_rooms_in_the_table_are_errors(self):
        for table in ("a -> b\nb -> a", "a -> b", "a => b"):
            with self.assertRaises(ValueError):
                check_includes.parse_arrows(table)

    def test_a_tree_without_code_does_not_pass(self):
        with tempfile.TemporaryDirectory() as empty, contextlib.redirect_stdout(io.StringIO()):
            pathlib.Path(empty, "cmake").mkdir()
            pathlib.Path(empty, "cmake/arrows.txt").write_text(ARROWS, encoding="utf-8")
            self.assertEqual(check_includes.main([empty]), 1)


if __name__ == "__main__":
    unittest.main()
