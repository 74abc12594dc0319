# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Corners on a recording of a four-layer scanner, with poses from a file."""

import unittest

from verge_cli import CliTest, run

SCANS = 88  # past the first side road at 60 km/h, 73 m


class Corners(CliTest):
    def setUp(self):
        super().setUp()
        drive = self.folder / "drive"
        self.check_ok(run("simulate", "paper1-r0.5-v60", "--sensor", "alasca_xt", "--scans", SCANS, "-o", drive))
        self.recording, self.truth = drive / "recording.alasca", drive / "truth.jsonl"
        self.poses = (drive / "poses.csv").read_text()
        self.mount = self.write("mount.toml", "height_m = 1.0\npitch_deg = 13.4\nroll_deg = 0.0\nforward_deg = 0.0\n")

    def detect(self, *more):
        return run("detect", self.recording, "--method", "road_width", "--mount", self.mount, *more)

    def test_the_side_road_is_found_where_it_is(self):
        poses = self.write("poses.csv", self.poses)
        result = self.detect("--poses", poses, "-o", self.folder / "found.jsonl", "--plot", self.folder / "pictures")
        self.check_ok(result)
        pictures = sorted(path.name for path in (self.folder / "pictures").iterdir())
        self.assertEqual(len(pictures), SCANS + 1)
        self.assertEqual(pictures[-1], "road_width_000000.png")
        table = run("evaluate", self.folder / "found.jsonl", "--truth", self.truth)
        self.check_ok(table)
        self.assertRegex(table.stdout.decode(), r"corners +M1 1\.000 \(1 of 1\), M2 (-|0\.000) \(0 of")

    def test_poses_go_by_frame_and_any_order_of_columns(self):
        lines = [line.split(",") for line in self.poses.splitlines()]
        turned = "\n".join(",".join(reversed(fields)) for fields in lines)
        straight = self.detect("--poses", self.write("poses.csv", self.poses))
        reversed_ = self.detect("--poses", self.write("turned.csv", turned))
        self.check_ok(straight)
        self.check_ok(reversed_)
        self.assertEqual(straight.stdout, reversed_.stdout)
        self.assertIn(b'"corners"', straight.stdout)

    def test_poses_of_other_frames_are_told(self):
        result = self.detect("--poses", self.write("poses.csv", self.poses.replace("\n000", "\nx000")))
        self.assertEqual(result.returncode, 0)
        self.assertIn(b"--poses: none of the scans' frames stands in the file", result.stderr)

    def test_a_file_that_is_no_pose_file_is_refused_at_its_place(self):
        lines = self.poses.splitlines()
        for text, *words in (
                ("", "bad.csv:1:1: ", "no column 'frame'"), ("frame,x_m\n", "bad.csv:1:1: ", "no column 'y_m'"),
                (lines[0] + "\n000000,1,2\n", "bad.csv:2:1: ", "3 fields", "need 9"),
                (lines[0] + "\n000000,0,1,2,three,1,0,0,0\n", "bad.csv:2:14: ", "z_m is no number (got three)"),
                (lines[0] + "\n000000,0,1,nan,3,1,0,0,0\n", "bad.csv:2:12: ", "y_m is no number"),
                (lines[0] + "\n000000,0,1,2,3,1,1,0,0\n", "bad.csv:2:16: ", "no rotation", "need length 1"),
                ("\n".join(lines[:2] + lines[1:2]), "bad.csv:3:1: ", "a second time")):
            with self.subTest(text=text):
                self.check_refused(self.detect("--poses", self.write("bad.csv", text)), 2, *words)
        self.check_refused(self.detect("--poses", self.folder / "none.csv"), 3, "none.csv: ")
        self.check_refused(self.detect("--poses", self.folder), 3, "folder")


if __name__ == "__main__":
    unittest.main()
