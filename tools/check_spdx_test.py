#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of check_spdx.py."""

import pathlib
import tempfile
import unittest

import check_spdx

FIRST, SECOND = check_spdx.HEADER


class CheckSpdx(unittest.TestCase):
    def test_the_header_stands_first_or_after_the_interpreter_line(self):
        self.assertTrue(check_spdx.has_header(f"// {FIRST}\n// {SECOND}\n#pragma once\n"))
        self.assertTrue(check_spdx.has_header(f"#!/bin/sh\n# {FIRST}\n# {SECOND}\n"))
        self.assertTrue(check_spdx.has_header(f"<!-- {FIRST} -->\n<!-- {SECOND} -->\n<html>\n"))

    def test_half_a_header_a_late_one_and_another_licence_are_none(self):
        for text in ("", f"// {FIRST}\n", f"\n// {FIRST}\n// {SECOND}\n", f"// {SECOND}\n// {FIRST}\n",
                     f"// {FIRST}\n// SPDX-License-Identifier: MIT\n", f"{FIRST}\n{SECOND}\n"):
            self.assertFalse(check_spdx.has_header(text), text)

    def test_a_bare_file_is_found_and_texts_are_free(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name in ("bare.cpp", "README.md", "data.json", "LICENSE"):
                (root / name).write_text("text\n", encoding="utf-8")
            (root / "good.py").write_text(f"# {FIRST}\n# {SECOND}\n", encoding="utf-8")
            self.assertEqual(check_spdx.check(root), ([pathlib.Path("bare.cpp")], 2))


if __name__ == "__main__":
    unittest.main()
