# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Simulated drives: the files, their bytes, and what is refused."""

import json
import signal
import time
import unittest

from verge_cli import CliTest, run, start


class Simulate(CliTest):
    def simulate(self, name, *arguments, scans=2):
        folder = self.folder / name
        result = run("simulate", folder, "--scans", scans, *arguments)
        self.check_ok(result)
        self.assertEqual(result.stdout, b"")
        return {str(path.relative_to(folder)): path.read_bytes()
                for path in sorted(folder.rglob("*")) if path.is_file()}

    def test_a_drive_is_scans_as_nuscenes_stores_them_and_a_line_of_truth_for_each(self):
        files = self.simulate("drive", scans=3)
        self.assertEqual(list(files), [f"LIDAR_TOP/00000{i}.pcd.bin" for i in range(3)] + ["truth.jsonl"])
        truth = self.records(files["truth.jsonl"])
        self.assertEqual([scene["frame"] for scene in truth], ["000000", "000001", "000002"])
        for scene in truth:
            self.assertEqual([boundary["side"] for boundary in scene["boundaries"]], ["left", "right"])
            for boundary in scene["boundaries"]:
                self.assertEqual((boundary["model"], boundary["kind"]), ("line", "curb"))

    def test_the_scans_are_those_of_a_32_ring_scanner_on_a_roof(self):
        self.simulate("drive", scans=3)
        facts = json.loads(run("info", self.folder / "drive" / "LIDAR_TOP", "--json").stdout)
        self.assertEqual((facts["format"], facts["scans"]["used"]), ("nuscenes", 3))
        self.assertEqual((facts["rings"]["min"], facts["rings"]["max"]), (32, 32))
        self.assertGreater(facts["points"]["min"], 50000)
        self.assertAlmostEqual(facts["mount"]["height_m"]["median"], 1.9, delta=0.03)
        self.assertAlmostEqual(facts["mount"]["pitch_deg"]["median"], 0.573, delta=0.1)

    def test_the_same_seed_gives_the_same_bytes_and_another_seed_others(self):
        first = self.simulate("first", "--seed", 5)
        self.assertEqual(self.simulate("second", "--seed", 5), first)
        other = self.simulate("third", "--seed", 6)
        self.assertEqual(other["truth.jsonl"], first["truth.jsonl"])
        for name in ("LIDAR_TOP/000000.pcd.bin", "LIDAR_TOP/000001.pcd.bin"):
            self.assertNotEqual(other[name], first[name])

    def test_every_road_can_be_driven(self):
        for road, model in (("straight", "line"), ("curve", "polyline"), ("drive", "line")):
            with self.subTest(road=road):
                truth = self.records(self.simulate(road, "--road", road, scans=1)["truth.jsonl"])
                self.assertEqual(truth[0]["boundaries"][0]["model"], model)

    def test_the_drive_is_straight_first_and_curves_then(self):
        truth = self.records(self.simulate("drive", "--speed-kmh", 200, scans=12)["truth.jsonl"])
        models = [scene["boundaries"][0]["model"] for scene in truth]
        self.assertEqual((models[0], models[-1]), ("line", "polyline"))

    def test_standing_still_there_is_no_motion_to_take_out(self):
        still = ("--speed-kmh", 0)
        self.assertEqual(self.simulate("skewed", "--skewed", *still), self.simulate("plain", *still))
        self.assertNotEqual(self.simulate("skewed2", "--skewed"), self.simulate("plain2"))

    def test_a_folder_that_holds_scans_is_left_alone(self):
        before = self.simulate("drive")
        self.check_refused(run("simulate", self.folder / "drive", "--scans", 1), 6, "holds files already")
        after = {name: (self.folder / "drive" / name).read_bytes() for name in before}
        self.assertEqual(after, before)

    def test_a_folder_that_cannot_be_made_is_a_failure_to_write(self):
        self.write("file", "not a folder")
        self.check_refused(run("simulate", self.folder / "file" / "drive"), 6)

    def test_requests_that_make_no_sense(self):
        for arguments in (("--scans", "0"), ("--road", "river"), ("--noise-m", "-1"), ("--speed-kmh", "nan"),
                          ("--seed", "-1"), ("--seed", "x"), ("more",)):
            with self.subTest(arguments=arguments):
                self.check_refused(run("simulate", self.folder / "drive", *arguments), 2)
        self.check_refused(run("simulate"), 2)
        self.assertFalse((self.folder / "drive").exists())

    def test_ctrl_c_keeps_the_scans_that_are_done_and_their_truth(self):
        folder = self.folder / "drive"
        program = start("simulate", folder, "--scans", 5000)
        deadline = time.monotonic() + 60
        while not (folder / "LIDAR_TOP" / "000001.pcd.bin").exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=60)
        self.assertEqual(program.returncode, 130)
        names = [path.name.split(".")[0] for path in sorted((folder / "LIDAR_TOP").iterdir())]
        frames = [scene["frame"] for scene in self.records(folder / "truth.jsonl")]
        self.assertEqual(frames, names)
        self.assertEqual(self.leftovers(folder) + self.leftovers(folder / "LIDAR_TOP"), [])


if __name__ == "__main__":
    unittest.main()
