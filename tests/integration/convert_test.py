# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""verge convert: what both formats hold is kept, and bad requests leave everything as it was."""

import signal
import struct
import time
import unittest

from verge_cli import CliTest, run, start


def pcd(points):
    header = ("VERSION 0.7\nFIELDS x y z intensity ring\nSIZE 4 4 4 4 2\nTYPE F F F F U\nCOUNT 1 1 1 1 1\n"
              f"WIDTH {len(points)}\nHEIGHT 1\nPOINTS {len(points)}\nDATA binary\n")
    return header.encode() + b"".join(struct.pack("<4fH", *point) for point in points)


POINTS = [(10.0, 0.5 * k, -1.0 + ring, 7.0 * k, ring) for ring in (1, 0) for k in range(-5, 6)]


class Convert(CliTest):
    def convert(self, source, out, *arguments):
        return run("convert", self.folder / source, self.folder / out, *arguments)

    def test_there_and_back_gives_the_same_bytes(self):
        self.write("scan.pcd", pcd(POINTS))
        self.check_ok(self.convert("scan.pcd", "once.pcd"))
        once = (self.folder / "once.pcd").read_bytes()
        for name in ("scan.ply", "scan.csv"):
            self.check_ok(self.convert("scan.pcd", name))
            self.check_ok(self.convert(name, "back.pcd"))
            self.assertEqual((self.folder / "back.pcd").read_bytes(), once, name)

    def test_a_folder_gets_a_file_for_each_scan(self):
        for name in ("a.pcd", "b.pcd"):
            self.write(f"in/{name}", pcd(POINTS))
        done = self.convert("in", "out", "--to", "ply")
        self.check_ok(done)
        self.assertIn(b"2 scans with 44 points", done.stderr)
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir()), ["a.ply", "b.ply"])

    def test_two_scans_do_not_fit_one_file_and_the_old_one_stays(self):
        for name in ("a.pcd", "b.pcd"):
            self.write(f"in/{name}", pcd(POINTS))
        old = self.write("out.ply", b"old")
        self.check_refused(self.convert("in", "out.ply"), 2, "out.ply: holds one scan, and there are more (need a folder)")
        self.assertEqual(old.read_bytes(), b"old")

    def test_damage_is_counted_and_the_rest_is_written(self):
        self.write("in/a.pcd", pcd(POINTS))
        self.write("in/b.pcd", pcd(POINTS)[:-7])
        self.check_refused(self.convert("in", "out", "--to", "csv"), 5, "b.pcd")
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["a.csv"])

    def test_nothing_is_written_over_the_input(self):
        scan = self.write("in/scan.pcd", pcd(POINTS))
        before = scan.read_bytes()
        self.check_refused(self.convert("in/scan.pcd", "in/scan.pcd"), 2, "is the input itself")
        self.check_refused(self.convert("in", "in/scan.pcd"), 2, "is a file of the input's folder")
        self.check_refused(self.convert("in", "in", "--to", "pcd"), 6, "holds files already")
        self.assertEqual(scan.read_bytes(), before)

    def test_a_folder_with_other_files_stays_as_it_is(self):
        self.write("scan.pcd", pcd(POINTS))
        self.write("out/notes.txt", b"mine")
        self.check_refused(self.convert("scan.pcd", "out", "--to", "ply"), 6, "holds files already")
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["notes.txt"])

    def test_a_capture_needs_a_model_and_tells_what_no_sensor_saw(self):
        above = [(10.0, 0.5 * k, 6.0, 1.0, 2) for k in range(-5, 6)]  # 31 degrees up: no laser looks there
        self.write("scan.pcd", pcd(POINTS + above))
        self.check_refused(self.convert("scan.pcd", "drive.pcap"), 2, "--model")
        self.assertFalse((self.folder / "drive.pcap").exists())
        done = self.convert("scan.pcd", "drive.pcap", "--model", "hdl32e")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count(b"warning:"), 1, done.stderr)
        self.assertIn(b"11 of 33 points are left out", done.stderr)

    def test_recordings_without_a_scan_leave_the_old_output(self):
        self.write("in/a.pcd", pcd(POINTS)[:-7])
        for name, model in (("old.pcap", "vlp16"), ("old.idc", "lux"), ("old.alasca", "alasca_xt")):
            old = self.write(name, b"old")
            self.check_refused(self.convert("in", name, "--to-model", model), 4, "a.pcd")
            self.assertEqual(old.read_bytes(), b"old")
            self.assertEqual(self.leftovers(), [])

    def test_ctrl_c_leaves_nothing_half(self):
        drive = self.recording(3000)
        process = start("convert", drive, self.folder / "out.mcap", "--progress", "always")
        process.stderr.read(1)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        errors = process.stderr.read()
        self.assertEqual(process.wait(60), 130, errors)
        process.stderr.close()
        process.stdout.close()
        self.assertEqual(self.leftovers(), [])
        done = run("info", self.folder / "out.mcap")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_name_without_a_format_is_a_usage_error(self):
        self.write("scan.pcd", pcd(POINTS))
        for out in ("out", "out.xyz"):
            self.check_refused(self.convert("scan.pcd", out), 2, "--to kitti, nuscenes, pcd, ply, csv, las, ibeo, alasca, pcap, mcap")


if __name__ == "__main__":
    unittest.main()
