# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Help, version and the command lines that make no sense."""

import re
import unittest

from verge_cli import CliTest, run

VERBS = ("convert", "detect", "evaluate", "info", "methods", "simulate", "train")


class Help(CliTest):
    def test_help_at_each_level_has_an_example_of_the_verb_and_the_exit_codes(self):
        for verb in ((), *((verb,) for verb in VERBS)):
            with self.subTest(verb=verb):
                result = run(*verb, "--help")
                self.check_ok(result)
                self.assertEqual(result.stderr, b"")
                text = result.stdout.decode()
                examples = text[text.index("\nExamples:\n"):text.index("\nExit codes:\n")]
                for name in verb or VERBS:
                    self.assertRegex(examples, rf"(?m)^  verge {name}( |$)")
                for line in ("  0  all input used", "  6  an output cannot be written", "  130, 143  stopped"):
                    self.assertIn(line, text)

    def test_every_option_of_an_example_exists(self):
        for verb in VERBS:
            text = run(verb, "--help").stdout.decode()
            listed, rest = text.split("\nExamples:\n")
            examples = rest.split("\nExit codes:\n")[0]
            for option in set(re.findall(r"(?<=\s)--?[a-z-]+", examples)):
                self.assertRegex(listed, rf"[ ,]{option}[\s,]", verb)

    def test_version(self):
        result = run("--version")
        self.check_ok(result)
        self.assertRegex(result.stdout.decode(), r"^verge \d+\.\d+\.\d+\n$")

    def test_command_lines_that_make_no_sense(self):
        scan = self.write("scan.pcd.bin", self.scan)
        for arguments in ((), ("detct", scan), ("detect",), ("detect", scan, "--no-such-option"),
                          ("detect", scan, "-j", "-1"),
                          ("detect", scan, "-j", "many"), ("detect", scan, "--format", "laz"),
                          ("detect", scan, "--frames", "3"), ("detect", scan, "--frames", "b:a"),
                          ("detect", scan, "--frames", "5:5"), ("detect", scan, "--frames", "1:"),
                          ("detect", scan, "--method", "gradeint"), ("detect", scan, "--progress", "sometimes"),
                          ("detect", scan, "--strict", "--allow-damaged"), ("detect", scan, "--max-mem", "0"),
                          ("detect", scan, "--origin", "91,0,0", "--geojson", self.folder / "a"),
                          ("detect", scan, "--origin", "here"), ("info",), ("methods", "nothing"),
                          ("methods", "gradient", "more")):
            with self.subTest(arguments=arguments):
                self.check_refused(run(*arguments), 2)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["scan.pcd.bin"])

    def test_a_misspelled_verb_or_method_is_told_its_likely_name(self):
        self.check_refused(run("detct"), 2, "did you mean 'detect'?")
        self.check_refused(run("paint"), 2, "known: convert, detect")
        self.check_refused(run("methods", "gradeint"), 2, "did you mean 'gradient'?")


class Methods(CliTest):
    def test_list_names_each_method_with_its_paper(self):
        result = run("methods")
        self.check_ok(result)
        self.assertRegex(result.stdout.decode(), r"(?m)^gradient +\S.*\n +Zhong et al\.")

    def test_table_has_a_line_for_each_key_that_dump_config_has(self):
        table = run("methods", "gradient").stdout.decode()
        dump = run("detect", "--dump-config").stdout.decode()
        section = dump[dump.index("[gradient]"):].split("\n[")[0]
        keys = [line.split(" = ")[0] for line in section.splitlines() if " = " in line and not line.startswith("#")]
        self.assertIn("height_max_m", keys)
        for key in keys:
            self.assertRegex(table, rf"(?m)^{key} ")


if __name__ == "__main__":
    unittest.main()
