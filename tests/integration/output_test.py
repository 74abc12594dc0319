# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""What comes out, where, and that it appears whole or not at all."""

import json
import os
import pty
import resource
import subprocess
import unittest

from verge_cli import NOBODY, PROGRAM, CliTest, run, start


def limit_file_size(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class Records(CliTest):
    def test_standard_output_has_json_lines_and_nothing_else(self):
        result = run("detect", self.recording(3))
        self.check_ok(result)
        records = self.records(result.stdout)
        self.assertEqual([record["frame"] for record in records], ["000000", "000001", "000002"])
        for record in records:
            self.assertEqual((record["schema"], record["method"]), (1, "gradient"))
            self.assertRegex(record["version"], r"^\d+\.\d+\.\d+$")
            self.assertIn("boundaries", record)

    def test_json_is_utf8_whatever_a_file_is_called(self):
        scan = self.write("a\udcff\udcc3.pcd.bin", self.scan)  # two bytes that are no UTF-8
        (record,) = self.records(run("detect", scan, "--trace").stdout)
        self.assertEqual(record["frame"], "a\ufffd\ufffd")
        info = json.loads(run("info", "--json", scan).stdout.decode("utf-8"))
        self.assertEqual(info["frames"], ["a\ufffd\ufffd"])

    def test_both_kerbs_of_a_straight_road_are_found(self):
        (record,) = self.records(run("detect", self.write("scan.pcd.bin", self.scan)).stdout)
        for side, offset in (("left", 4.0), ("right", -4.0)):
            near = [point for boundary in record["boundaries"] if boundary["side"] == side
                    for point in boundary["points"] if abs(point[0]) < 10]
            self.assertGreater(len(near), 1, side)
            for point in near:
                self.assertAlmostEqual(point[1], offset, delta=0.3)

    def test_o_writes_the_same_bytes_to_a_file_with_its_summary_beside_it(self):
        drive = self.recording(3)
        out = self.folder / "out.jsonl"
        result = run("detect", drive, "-o", out)
        self.check_ok(result)
        self.assertEqual(result.stdout, b"")
        self.assertEqual(out.read_bytes(), run("detect", drive).stdout)
        summary = json.loads((self.folder / "out.jsonl.summary.json").read_text())
        self.assertEqual(summary["scans"], {"received": 3, "used": 3, "damaged": 0})
        self.assertFalse(summary["interrupted"])
        self.assertEqual(summary["boundaries"], sum(len(record["boundaries"]) for record in self.records(out)))
        points = summary["points"]
        self.assertEqual(points["received"], 3 * len(self.scan) // 20)
        self.assertEqual(points["received"], points["used"] + points["not_finite"] + points["no_return"])
        self.assertEqual(self.leftovers(), [])

    def test_names_of_standard_output(self):
        scan = self.write("scan.pcd.bin", self.scan)
        plain = run("detect", scan).stdout
        for name in ("-", "/dev/stdout"):
            self.assertEqual(run("detect", scan, "-o", name).stdout, plain)
        out = self.folder / "redirected"
        with out.open("ab") as file:
            for _ in range(2):
                self.check_ok(run("detect", scan, "-o", "/dev/stdout", stdout=file))
        self.assertEqual(out.read_bytes(), 2 * plain)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["redirected", "scan.pcd.bin"])

    def test_standard_input(self):
        result = run("detect", "-", "--format", "nuscenes", stdin=None, input=self.scan)
        self.check_ok(result)
        self.assertEqual(len(self.records(result.stdout)), 1)

    def test_frames_are_counted_over_all_inputs(self):
        drive, other = self.recording(4), self.recording(3, "other")
        inputs = (drive, self.write("single.pcd.bin", self.scan), other)
        names = ["000000", "000001", "000002", "000003", "single", "000000", "000001", "000002"]
        for begin, end in ((0, 8), (1, 3), (3, 6), (4, 5), (6, 100), (7, 8)):
            with self.subTest(begin=begin, end=end):
                result = run("detect", *inputs, "--frames", f"{begin}:{end}")
                self.check_ok(result)
                self.assertEqual([record["frame"] for record in self.records(result.stdout)], names[begin:end])
        self.assertEqual(len(self.records(run("detect", *inputs, "--frames", "5:").stdout)), 3)
        self.assertEqual(len(self.records(run("detect", *inputs, "--frames", ":2").stdout)), 2)
        self.check_refused(run("detect", *inputs, "--frames", "8:"), 2, "8 scans")

    def test_trace_adds_the_intermediates_and_changes_nothing_else(self):
        scan = self.write("scan.pcd.bin", self.scan)
        (plain,) = self.records(run("detect", scan).stdout)
        (traced,) = self.records(run("detect", scan, "--trace").stdout)
        trace = traced.pop("trace")
        self.assertEqual(traced, plain)
        self.assertGreater(sum(len(layer["points"]) for layer in trace["points"]), 0)
        self.assertEqual(trace["rasters"], [])  # this method makes none

    def test_geojson_is_one_collection_in_local_metres_or_wgs84(self):
        scan = self.write("scan.pcd.bin", self.scan)
        for origin in ((), ("--origin", "48.137,11.575,90")):
            out = self.folder / "out.geojson"
            self.check_ok(run("detect", scan, "--geojson", out, *origin))
            collection = json.loads(out.read_text())
            self.assertEqual(collection["type"], "FeatureCollection")
            self.assertGreater(len(collection["features"]), 0)
            for feature in collection["features"]:
                for x, y in feature["geometry"]["coordinates"]:
                    self.assertEqual(abs(x - 11.575) < 0.01 and abs(y - 48.137) < 0.01, bool(origin))

    def test_plot_makes_a_picture_a_scan(self):
        folder = self.folder / "new" / "pictures"
        self.check_ok(run("detect", self.recording(2), "--plot", folder, "--set", "plot.size_px=300"))
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["000000.png", "000001.png"])
        for path in folder.iterdir():
            self.assertTrue(path.read_bytes().startswith(b"\x89PNG\r\n\x1a\n"))

    def test_pictures_of_scans_of_the_same_name_do_not_replace_each_other(self):
        folder = self.folder / "pictures"
        self.check_ok(run("detect", self.recording(1), self.recording(1, "other"), "--plot", folder, "--set",
                          "plot.size_px=300"))
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["000000_000000.png", "000001_000000.png"])


class Terminal(CliTest):
    def test_no_progress_and_no_colour_in_a_pipe(self):
        result = run("detect", self.recording(2))
        self.assertNotIn(b"\x1b", result.stderr)
        self.assertNotIn(b"\r", result.stderr)
        self.assertNotIn(b"ETA", result.stderr)

    def test_closing_table_names_every_stage(self):
        text = run("detect", self.recording(2)).stderr.decode()
        for pattern in (r"(?m)^scans +2 ", r"(?m)^boundaries +\d+$", r"(?m)^stage +p50 ms +p99 ms$",
                        r"(?m)^read +\d", r"(?m)^mount +\d", r"(?m)^detect +\d", r"(?m)^write +\d"):
            self.assertRegex(text, pattern)

    def test_quiet_is_silent(self):
        result = run("detect", self.recording(2), "--quiet", "--progress", "always")
        self.check_ok(result)
        self.assertEqual(result.stderr, b"")

    def on_terminal(self, *arguments, **environment):
        """What the program writes to a standard error that is a terminal."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        with subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=slave, env={**os.environ, **environment}) as process:
            os.close(slave)
            seen = b""
            while True:
                try:
                    chunk = os.read(master, 65536)
                except OSError:  # the terminal's other end is closed
                    break
                if not chunk:
                    break
                seen += chunk
        return process.returncode, seen

    def test_progress_shows_on_a_terminal_and_is_taken_away(self):
        code, seen = self.on_terminal("detect", self.recording(60), "-j", "1", "--plot", self.folder / "pictures")
        self.assertEqual(code, 0)
        self.assertRegex(seen, rb"\[[=> ]+\] \d+/60 scans  \d+\.\d scans/s  ETA \d+:\d\d")
        self.assertGreater(seen.rindex(b"\x1b[K"), seen.rindex(b"ETA"))
        self.assertNotIn(b"ETA", self.on_terminal("detect", self.recording(3, "b"), "--progress", "never")[1])

    def test_errors_are_coloured_on_a_terminal_unless_no_color_is_set(self):
        missing = self.folder / "missing"
        self.assertIn(b"\x1b[31merror: ", self.on_terminal("detect", missing, NO_COLOR="")[1])
        self.assertTrue(self.on_terminal("detect", missing, NO_COLOR="1")[1].startswith(b"verge: error: "))


class Damage(CliTest):
    def setUp(self):
        super().setUp()
        self.drive = self.recording(3)
        self.write("drive/000001x.pcd.bin", self.scan[:-7])
        self.out = self.folder / "out.jsonl"

    def test_unusable_file_in_a_folder_is_damage_and_the_rest_is_written(self):
        result = run("detect", self.drive, "-o", self.out)
        self.assertEqual(result.returncode, 5)
        self.assertEqual(len(self.error_lines(result)), 1)
        self.assertIn("000001x.pcd.bin", self.error_lines(result)[0])
        self.assertIn("verge: warning: 1 of 4 scans could not be used\n", result.stderr.decode())
        self.assertEqual([record["frame"] for record in self.records(self.out)], ["000000", "000001", "000002"])
        summary = json.loads((self.folder / "out.jsonl.summary.json").read_text())
        self.assertEqual(summary["scans"], {"received": 4, "used": 3, "damaged": 1})

    def test_allow_damaged_makes_it_0(self):
        result = run("detect", self.drive, "-o", self.out, "--allow-damaged")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(self.records(self.out)), 3)

    def test_strict_makes_it_4_and_leaves_the_old_file(self):
        self.out.write_text("old")
        self.assertEqual(run("detect", self.drive, "-o", self.out, "--strict").returncode, 4)
        self.assertEqual(self.out.read_text(), "old")
        self.assertFalse((self.folder / "out.jsonl.summary.json").exists())
        self.assertEqual(self.leftovers(), [])

    def test_nothing_usable_is_4_and_writes_nothing(self):
        for path in self.drive.iterdir():
            path.unlink()
        self.write("drive/a.pcd.bin", self.scan[:-7])
        for target in (self.drive, self.drive / "a.pcd.bin"):
            self.check_refused(run("detect", target, "-o", self.out), 4, "a.pcd.bin")
        self.assertFalse(self.out.exists())

    def test_missing_input_among_good_ones_ends_the_run_before_any_work(self):
        self.check_refused(run("detect", self.drive, self.folder / "missing", "-o", self.out), 3, "missing")
        self.assertFalse(self.out.exists())

    def test_error_line_escapes_control_bytes_of_a_path(self):
        name = self.folder / "a\n\x1b[31mb.pcd.bin"
        name.write_bytes(b"x")
        self.check_refused(run("detect", name), 4, r"a\x0A\x1B[31mb.pcd.bin")

    def test_info_follows_the_same_contract(self):
        result = run("info", self.drive)
        self.assertEqual(result.returncode, 5)
        self.assertIn("3 (000000 to 000002), 1 damaged", result.stdout.decode())
        self.check_refused(run("info", self.folder / "missing"), 3, "missing")
        self.assertEqual(run("info", self.drive, "--strict").returncode, 4)


class CannotWrite(CliTest):
    def setUp(self):
        super().setUp()
        self.drive = self.recording(3)
        self.out = self.folder / "out.jsonl"

    def test_full_device_is_6(self):
        for target in ("-o", "--geojson"):
            other = () if target == "-o" else ("-o", self.out)
            self.check_refused(run("detect", self.drive, target, "/dev/full", *other), 6, "/dev/full", "No space left")
        with open("/dev/full", "wb") as full:
            for arguments in (("detect", self.drive), ("detect", "--dump-config"), ("--help",), ("methods",),
                              ("info", self.drive)):
                with self.subTest(arguments=arguments):
                    self.check_refused(run(*arguments, stdout=full), 6, "No space left")

    def test_size_limit_leaves_the_old_file_and_nothing_temporary(self):
        self.check_ok(run("detect", self.drive, "-o", self.out))
        whole = self.out.read_bytes()
        summary = self.folder / "out.jsonl.summary.json"
        old_summary = summary.read_bytes()
        for size in (0, 1, 100, 255, 256, len(whole) - 1):
            with self.subTest(size=size):
                self.out.write_bytes(b"old")
                result = run("detect", self.drive, "-o", self.out, "--frames", ":3", preexec_fn=limit_file_size(size))
                self.check_refused(result, 6, "File too large")
                self.assertEqual(self.out.read_bytes(), b"old")
                self.assertEqual(summary.read_bytes(), old_summary)
                self.assertEqual(self.leftovers(), [])

    def test_size_limit_on_a_picture(self):
        pictures = self.folder / "pictures"
        result = run("detect", self.drive, "-o", self.out, "--plot", pictures, preexec_fn=limit_file_size(4096))
        self.check_refused(result, 6, "000000.png", "File too large")
        self.assertEqual((list(pictures.iterdir()), self.out.exists(), self.leftovers()), ([], False, []))

    def test_targets_that_cannot_be(self):
        self.write("file", "x")
        for target in (self.folder, self.folder / "missing" / "out", self.folder / "file" / "out",
                       self.folder / ("n" * 256)):
            for option in ("-o", "--geojson"):
                with self.subTest(target=target, option=option):
                    other = () if option == "-o" else ("-o", self.out)
                    self.check_refused(run("detect", self.drive, option, target, *other), 6)
        self.check_refused(run("detect", self.drive, "--plot", self.folder / "file"), 6, "file")
        self.assertFalse(self.out.exists())
        self.assertEqual(self.leftovers(), [])

    def as_nobody(self, *arguments):
        if os.geteuid() != 0:
            return run(*arguments)
        return run(*arguments, user=NOBODY, group=NOBODY, extra_groups=[])

    def test_folder_that_may_not_be_written(self):
        locked = self.folder / "locked"
        locked.mkdir()
        (locked / "out.jsonl").write_text("old")
        locked.chmod(0o555)
        self.addCleanup(locked.chmod, 0o755)
        for target in ("out.jsonl", "new.jsonl"):
            self.check_refused(self.as_nobody("detect", self.drive, "-o", locked / target), 6, "Permission denied")
        self.check_refused(self.as_nobody("detect", self.drive, "--plot", locked / "pictures"), 6, "ermission denied")
        self.assertEqual((locked / "out.jsonl").read_text(), "old")
        self.assertEqual([path.name for path in locked.iterdir()], ["out.jsonl"])

    def test_file_marked_read_only_is_kept(self):
        open_folder = self.folder / "open"
        open_folder.mkdir()
        open_folder.chmod(0o777)
        kept = open_folder / "out.jsonl"
        kept.write_text("old")
        kept.chmod(0o444)
        self.check_refused(self.as_nobody("detect", self.drive, "-o", kept), 6, "Permission denied")
        self.assertEqual(kept.read_text(), "old")

    def test_link_stays_and_its_target_is_replaced(self):
        real = self.write("real.jsonl", "old")
        link = self.folder / "link.jsonl"
        link.symlink_to("real.jsonl")
        self.check_ok(run("detect", self.drive, "-o", link))
        self.assertTrue(link.is_symlink())
        self.assertEqual(len(self.records(real)), 3)

    def test_reader_that_goes_away_is_no_error(self):
        drive = self.recording(40, "long")
        for arguments in (("detect", drive), ("detect", drive, "--progress", "always"), ("methods", "gradient")):
            with self.subTest(arguments=arguments):
                process = start(*arguments)
                process.stdout.readline()
                process.stdout.close()
                errors = process.stderr.read()
                process.stderr.close()
                self.assertEqual(process.wait(60), 0)
                self.assertNotIn(b"error", errors)

    def test_other_outputs_are_finished_although_the_reader_of_records_is_gone(self):
        read_end, write_end = os.pipe()
        os.close(read_end)
        collection = self.folder / "out.geojson"
        result = run("detect", self.drive, "--geojson", collection, stdout=write_end)
        os.close(write_end)
        self.check_ok(result)
        frames = {feature["properties"]["frame"] for feature in json.loads(collection.read_text())["features"]}
        self.assertEqual(frames, {"000000", "000001", "000002"})


class Info(CliTest):
    def test_what_is_in_a_scan(self):
        scan = self.write("scan.pcd.bin", self.scan)
        result = run("info", scan)
        self.check_ok(result)
        text = result.stdout.decode()
        for pattern in (r"format +nuscenes", r"scans +1 \(scan\)", rf"points +{len(self.scan) // 20} a scan",
                        r"rings +\d+",
                        r"range +\d+\.\d\d to \d+\.\d\d m, median .*", r"fields +x, y, z, intensity", r"time +unknown",
                        r"mount +height 1\.8\d m, .*", r"note +.* rings from the ring field.*"):
            self.assertRegex(text, rf"(?m)^{pattern}$")

    def test_json_says_the_same_for_programs(self):
        result = run("info", self.recording(3), "--json")
        self.check_ok(result)
        facts = json.loads(result.stdout)
        self.assertEqual(facts["format"], "nuscenes")
        self.assertEqual(facts["scans"], {"received": 3, "used": 3, "damaged": 0})
        self.assertEqual(facts["points_total"]["received"], 3 * len(self.scan) // 20)
        self.assertEqual(facts["frames"], ["000000", "000002"])
        self.assertAlmostEqual(facts["mount"]["height_m"]["median"], 1.84, delta=0.03)
        self.assertIsNone(facts["first_ns"])

    def test_frames_and_format_hold_for_info_too(self):
        drive = self.recording(3)
        self.assertEqual(json.loads(run("info", drive, "--json", "--frames", "1:2").stdout)["frames"], ["000001"])
        self.assertNotEqual(run("info", drive, "--format", "pcd").returncode, 0)


if __name__ == "__main__":
    unittest.main()
