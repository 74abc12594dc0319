# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Settings: files, --set, --mount, --dump-config."""

import json
import unittest

from verge_cli import CliTest, run


class Settings(CliTest):
    def setUp(self):
        super().setUp()
        self.scan_file = self.write("scan.pcd.bin", self.scan)

    def hash_of(self, *arguments):
        result = run("detect", self.scan_file, *arguments)
        self.check_ok(result)
        return json.loads(result.stdout)["config_hash"]

    def check_config_refused(self, text, place, *words):
        file = self.write("bad.toml", text)
        self.check_refused(run("detect", self.scan_file, "--config", file), 2, f"bad.toml:{place}: ", *words)

    def test_unknown_key_is_refused_at_its_line_and_column(self):
        self.check_config_refused("[gradient]\nheight_max_m = 0.4\n  heigth_max_m = 0.4\n", "3:3",
                                  "did you mean 'height_max_m'?")
        self.check_config_refused("[gradeint]\nheight_max_m = 0.4\n", "1:2", "did you mean 'gradient'?")
        self.check_config_refused("\ncolour = 1\n", "2:1", "unknown key 'colour'")
        self.check_config_refused("[gradeint]\n", "1:2", "unknown section")

    def test_the_first_wrong_key_of_the_file_is_named(self):
        self.check_config_refused("[gradient]\nzz = 1\naa = 1\n", "2:1", "'zz'")

    def test_value_that_does_not_fit_is_refused_at_its_place_with_the_range(self):
        self.check_config_refused("[gradient]\nheight_max_m = 99.0\n", "2:16", "height_max_m", "need 0.05 to ")
        self.check_config_refused("[gradient]\nheight_max_m = nan\n", "2:16", "need 0.05 to ")
        self.check_config_refused('[gradient]\nheight_max_m = "0.4"\n', "2:16", "text does not fit")
        self.check_config_refused("[gradient]\nheight_max_m = [0.4]\n", "2:16", "does not fit")
        self.check_config_refused('[gradient]\nreading = "latin"\n', "2:11", "fixed or paper")

    def test_a_file_that_is_no_toml_is_refused_at_its_place(self):
        self.check_config_refused("[gradient]\nheight_max_m = = 1\n", "2:16")
        self.check_config_refused("[gradient\n", "1:10")
        self.check_config_refused("[gradient]\n[gradient]\n", "2:1")
        self.check_config_refused("a = " + "[" * 1000 + "\n", "1:261")

    def test_a_file_that_cannot_be_a_configuration(self):
        self.check_refused(run("detect", self.scan_file, "--config", self.folder / "none.toml"), 2, "none.toml: ")
        self.check_refused(run("detect", self.scan_file, "--config", self.folder), 2, "folder")
        long = self.write("long.toml", "#" * (1 << 20) + "\n")
        self.check_refused(run("detect", self.scan_file, "--config", long), 2, "need <= 1048576 B")
        self.write("limit.toml", "#" * ((1 << 20) - 1) + "\n")
        self.check_ok(run("detect", self.scan_file, "--config", self.folder / "limit.toml"))

    def test_set_refuses_what_it_does_not_know(self):
        for assignment, word in (("gradient.heigth_max_m=0.4", "did you mean 'height_max_m'?"),
                                 ("gradient.height_max_m=50", "need 0.05 to "),
                                 ("gradient.height_max_m", "SECTION.KEY=VALUE"),
                                 ("height_max_m=0.4", "SECTION.KEY=VALUE"), ("gradeint.height_max_m=0.4", "gradient"),
                                 ("gradient.height_max_m=", "need 0.05 to "), ("=", "SECTION.KEY=VALUE")):
            with self.subTest(assignment=assignment):
                self.check_refused(run("detect", self.scan_file, "--set", assignment), 2, word)

    def test_dump_config_is_taken_back_and_gives_the_same(self):
        settings = ("--set", "gradient.height_max_m=0.3", "--set", "mount_estimate.reach_m=12.5", "--set",
                    "plot.ahead_m=40")
        dump = run("detect", "--dump-config", *settings)
        self.check_ok(dump)
        file = self.write("effective.toml", dump.stdout)
        again = run("detect", "--dump-config", "--config", file)
        self.check_ok(again)
        self.assertEqual(again.stdout, dump.stdout)
        self.assertNotEqual(dump.stdout, run("detect", "--dump-config").stdout)
        self.assertEqual(self.hash_of("--config", file), self.hash_of(*settings))

    def test_dump_config_says_unit_range_meaning_and_source_of_each_key(self):
        lines = run("detect", "--dump-config").stdout.decode().splitlines()
        keys = [i for i, line in enumerate(lines) if " = " in line and not line.startswith(("#", "method"))]
        self.assertGreater(len(keys), 5)
        for i in keys:
            block = lines[:i][-4:]
            self.assertTrue(any(line.startswith("#") and "range " in line for line in block), lines[i])
            self.assertTrue(any("source: " in line for line in block), lines[i])

    def test_set_goes_over_the_file_and_the_file_over_the_defaults(self):
        file = self.write("a.toml", "[gradient]\nheight_max_m = 0.3\n")
        self.assertEqual(self.hash_of("--config", file), self.hash_of("--set", "gradient.height_max_m=0.3"))
        self.assertEqual(self.hash_of("--config", file, "--set", "gradient.height_max_m=0.5"),
                         self.hash_of("--set", "gradient.height_max_m=0.5"))
        self.assertNotEqual(self.hash_of("--config", file), self.hash_of("--set", "gradient.height_max_m=0.5"))

    def test_config_hash_changes_with_what_changes_results_and_with_nothing_else(self):
        plain = self.hash_of()
        self.assertRegex(plain, r"^[0-9a-f]{16}$")
        self.assertEqual(self.hash_of("-j", "2", "--set", "plot.ahead_m=40"), plain)
        self.assertNotEqual(self.hash_of("--set", "mount_estimate.reach_m=12"), plain)
        self.assertNotEqual(self.hash_of("--mount", self.write("m.toml", "height_m = 1.8\n")), plain)

    def test_mount_is_estimated_and_said_once(self):
        drive = self.recording(3)
        result = run("detect", drive)
        self.check_ok(result)
        lines = [line for line in result.stderr.decode().splitlines() if line.startswith("verge: mount: ")]
        self.assertEqual(len(lines), 1)
        self.assertRegex(lines[0], r"height 1\.8[2-6] m, pitch -?0\.\d deg, roll -?0\.\d deg, forward -?\d+\.\d deg "
                         r"\(estimated from the scan")

    def test_mount_file_may_say_a_part(self):
        file = self.write("roof.toml", "height_m = 1.9\npitch_deg = 2\n")
        result = run("detect", self.scan_file, "--mount", file, "-o", self.folder / "out")
        self.check_ok(result)
        self.assertRegex(result.stderr.decode(), r"height 1\.90 m, pitch 2\.0 deg.*\(height, pitch given, the rest")
        summary = json.loads((self.folder / "out.summary.json").read_text())
        self.assertEqual(summary["mount"]["height_m"]["median"], 1.9)
        self.assertAlmostEqual(summary["mount"]["pitch_deg"]["median"], 2.0, places=3)

    def test_mount_file_that_says_all_is_taken_as_it_is(self):
        file = self.write("roof.toml", "height_m = 1.9\npitch_deg = 2\nroll_deg = -1.5\nforward_deg = 3\n")
        result = run("detect", self.scan_file, "--mount", file)
        self.check_ok(result)
        self.assertIn("mount: height 1.90 m, pitch 2.0 deg, roll -1.5 deg, forward 3.0 deg (given)",
                      result.stderr.decode())

    def test_mount_file_refuses_what_it_does_not_know(self):
        for text, place, word in (("height_m = 1.8\nheigth = 2\n", "2:1", "unknown key 'heigth'"),
                                  ("height_m = 0\n", "1:12", "0.05 to 50"),
                                  ('height_m = "tall"\n', "1:12", "height_m"),
                                  ("[mount]\nheight_m = 1\n", "1:2", "unknown key 'mount'"),
                                  ("pitch_deg = 90\n", "1:13", "-85 to 85"),
                                  ("pitch_deg = nan\n", "1:13", "-85 to 85")):
            with self.subTest(text=text):
                file = self.write("bad_mount.toml", text)
                self.check_refused(run("detect", self.scan_file, "--mount", file), 2, f"bad_mount.toml:{place}", word)


if __name__ == "__main__":
    unittest.main()
