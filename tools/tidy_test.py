#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of tidy.py: which sources are looked at, and when one is looked at again."""

import pathlib
import tempfile
import unittest
from unittest import mock

import tidy


class Tidy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        root = mock.patch.object(tidy, "ROOT", self.root)
        root.start()
        self.addCleanup(root.stop)
        self.write(".clang-tidy", "Checks: '*'\n")
        self.write("verge/a.hpp", "#include <vector>\n")
        self.write("verge/b.hpp", '#include "verge/a.hpp"\n')
        self.write("verge/b.cpp", '#include "verge/b.hpp"\n')
        self.write("verge/c.cpp", "\n")
        self.sources = ["verge/b.cpp", "verge/c.cpp"]

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text, encoding="utf-8")

    def test_a_source_stands_for_itself_and_for_the_header_beside_it(self):
        self.assertEqual(tidy.source_of("verge/c.cpp", self.sources), "verge/c.cpp")
        self.assertEqual(tidy.source_of("verge/b.hpp", self.sources), "verge/b.cpp")

    def test_a_header_without_a_source_is_seen_through_one_that_includes_it(self):
        self.assertEqual(tidy.source_of("verge/a.hpp", self.sources), "verge/b.cpp")

    def test_other_files_and_tests_are_not_looked_at(self):
        for path in ("README.md", "verge/b_test.cpp", "verge/lost.hpp"):
            self.assertIsNone(tidy.source_of(path, self.sources), path)

    def test_a_source_is_looked_at_again_when_a_header_behind_it_changes(self):
        before = {source: tidy.fingerprint(source, "g++") for source in self.sources}
        self.write("verge/a.hpp", "#include <array>\n")
        self.assertNotEqual(tidy.fingerprint("verge/b.cpp", "g++"), before["verge/b.cpp"])
        self.assertEqual(tidy.fingerprint("verge/c.cpp", "g++"), before["verge/c.cpp"])

    def test_a_source_is_looked_at_again_when_its_command_or_the_checks_change(self):
        before = tidy.fingerprint("verge/c.cpp", "g++")
        self.assertNotEqual(tidy.fingerprint("verge/c.cpp", "g++ -O2"), before)
        self.write(".clang-tidy", "Checks: '-*'\n")
        self.assertNotEqual(tidy.fingerprint("verge/c.cpp", "g++"), before)

    def test_headers_that_include_each_other_end(self):
        self.write("verge/a.hpp", '#include "verge/b.hpp"\n')
        self.assertEqual(tidy.own_files("verge/a.hpp"), {"verge/a.hpp", "verge/b.hpp"})


if __name__ == "__main__":
    unittest.main()
