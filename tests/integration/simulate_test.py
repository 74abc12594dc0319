# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Simulated drives: the files, their bytes, and what is refused."""

import json
import os
import pathlib
import signal
import time
import unittest

from verge_cli import CliTest, run, start


class Simulate(CliTest):
    def simulate(self, name, *arguments, scenario=("street",), scans=2):
        folder = self.folder / name
        result = run("simulate", *scenario, "-o", folder, "--scans", scans, *arguments, timeout=300)
        self.check_ok(result)
        self.assertEqual(result.stdout, b"")
        return {str(path.relative_to(folder)): path.read_bytes()
                for path in sorted(folder.rglob("*")) if path.is_file()}

    def test_a_drive_is_scans_as_nuscenes_stores_them_with_labels_and_a_line_of_truth_for_each(self):
        files = self.simulate("drive", scans=3)
        self.assertEqual(list(files), [f"LIDAR_TOP/00000{i}.pcd.bin" for i in range(3)] +
                         [f"lidarseg/00000{i}_lidarseg.bin" for i in range(3)] +
                         ["poses.csv", "scenario.toml", "truth.jsonl"])
        truth = self.records(files["truth.jsonl"])
        self.assertEqual([scene["frame"] for scene in truth], ["000000", "000001", "000002"])
        for scene in truth:
            self.assertEqual([boundary["side"] for boundary in scene["boundaries"]], ["left", "right"])
            for boundary in scene["boundaries"]:
                self.assertEqual((boundary["model"], boundary["kind"]), ("line", "curb"))
            points = len(files[f"LIDAR_TOP/{scene['frame']}.pcd.bin"]) // 20
            labels = files[f"lidarseg/{scene['frame']}_lidarseg.bin"]
            self.assertEqual(len(labels), points)
            self.assertLessEqual({24, 26, 28}, set(labels))  # driveable, sidewalk, manmade
        poses = files["poses.csv"].decode().splitlines()
        self.assertEqual([line.split(",")[0] for line in poses], ["frame", "000000", "000001", "000002"])

    def test_the_scans_are_those_of_a_32_ring_scanner_on_a_roof(self):
        self.simulate("drive", scans=3)
        facts = json.loads(run("info", self.folder / "drive" / "LIDAR_TOP", "--json").stdout)
        self.assertEqual((facts["format"], facts["scans"]["used"]), ("nuscenes", 3))
        self.assertEqual((facts["rings"]["min"], facts["rings"]["max"]), (32, 32))
        self.assertGreater(facts["points"]["min"], 50000)
        self.assertAlmostEqual(facts["mount"]["height_m"]["median"], 1.9, delta=0.03)
        self.assertAlmostEqual(facts["mount"]["pitch_deg"]["median"], 0.573, delta=0.1)

    def test_every_sensor_has_its_recording_beside_the_labels_of_its_points(self):
        for sensor, format, recording, rings in (
                ("vlp16", "pcap", "recording.pcap", 16), ("vlp32c", "mcap", "recording.mcap", 32),
                ("hdl64e", "kitti", "velodyne", 64), ("lux", None, "recording.idc", 4),
                ("alasca_xt", None, "recording.alasca", 4), ("lux", "csv", "scans", 4)):
            with self.subTest(sensor=sensor, format=format):
                name = f"{sensor}-{format}"
                files = self.simulate(name, "--sensor", sensor, *(("--format", format) if format else ()),
                                      scenario=("paper2",))
                facts = json.loads(run("info", self.folder / name / recording, "--json").stdout)
                self.assertGreaterEqual(facts["scans"]["used"], 2)  # a filled up packet may begin another
                self.assertEqual(facts["rings"]["max"], rings)
                labels = [len(files[f"labels/00000{i}.label"]) // 4 for i in range(2)]
                self.assertEqual(sum(labels), facts["points_total"]["received"])

    def test_weather_and_noise_are_set_and_kept(self):
        dry = self.simulate("dry", scans=1)
        wet = self.simulate("wet", "--set", "weather.rain_mmph=30", "--set", "weather.rain_echoes=0.5",
                            "--set", "noise.beam_rays=2", scans=1)
        self.assertIn(b"rain_mmph = 30", wet["scenario.toml"])
        self.assertEqual(wet["lidarseg/000000_lidarseg.bin"].count(0) > 100, True)  # drops
        self.assertEqual(dry["lidarseg/000000_lidarseg.bin"].count(0), 0)

    def test_the_same_seed_gives_the_same_bytes_and_another_seed_others(self):
        first = self.simulate("first", "--seed", 5)
        self.assertEqual(self.simulate("second", "--seed", 5), first)
        other = self.simulate("third", "--seed", 6)
        self.assertEqual(other["truth.jsonl"], first["truth.jsonl"])
        for name in ("LIDAR_TOP/000000.pcd.bin", "LIDAR_TOP/000001.pcd.bin"):
            self.assertNotEqual(other[name], first[name])

    def test_a_seed_alone_makes_a_world(self):
        first = self.simulate("first", "--seed", 7, scenario=(), scans=1)
        self.assertEqual(self.simulate("second", "--seed", 7, scenario=(), scans=1), first)
        self.assertNotEqual(self.simulate("third", "--seed", 8, scenario=(), scans=1)["scenario.toml"],
                            first["scenario.toml"])

    def test_one_and_many_threads_give_the_same_bytes(self):
        many = self.simulate("many", scenario=("campus",))
        cpu = min(os.sched_getaffinity(0))
        before = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {cpu})
        try:
            one = self.simulate("one", scenario=("campus",))
        finally:
            os.sched_setaffinity(0, before)
        self.assertEqual(one, many)

    def test_the_scenario_that_is_written_makes_the_same_drive(self):
        first = self.simulate("first", scenario=("lowered-kerbs",), scans=1)
        again = self.simulate("again", scenario=(self.folder / "first" / "scenario.toml",), scans=1)
        self.assertEqual(again, first)

    def test_every_ready_scenario_survives_its_file(self):
        names = [line.split()[0] for line in run("simulate", "--list").stdout.decode().splitlines()]
        self.assertGreater(len(names), 40)
        for name in names:
            with self.subTest(name=name):
                dumped = run("simulate", name, "--dump")
                self.check_ok(dumped)
                self.write("again.toml", dumped.stdout)
                self.assertEqual(run("simulate", self.folder / "again.toml", "--dump").stdout, dumped.stdout)

    def test_the_street_is_straight_first_and_curves_then(self):
        truth = self.records(self.simulate("drive", "--speed-kmh", 200, scans=12)["truth.jsonl"])
        models = [scene["boundaries"][0]["model"] for scene in truth]
        self.assertEqual((models[0], models[-1]), ("line", "polyline"))

    def test_standing_still_there_is_no_motion_to_take_out(self):
        still = ("--speed-kmh", 0)
        self.assertEqual(self.simulate("skewed", "--skewed", *still), self.simulate("plain", *still))
        self.assertNotEqual(self.simulate("skewed2", "--skewed"), self.simulate("plain2"))

    def test_a_file_says_a_world(self):
        self.write("mine.toml", """
[vehicle]
at_m = 20
[[road]]
width_m = 6
kerb_m = 0.05
[[road.piece]]
length_m = 60
[[road]]
branch_of = 1
at_m = 35.5
side = "left"
[[road.piece]]
length_m = 30
""")
        scene = self.records(self.simulate("mine", scenario=(self.folder / "mine.toml",), scans=1)["truth.jsonl"])[0]
        self.assertEqual([corner["side"] for corner in scene["corners"]], ["left"])
        self.assertAlmostEqual(scene["corners"][0]["distance_m"], 35.5 - 4.0 - 3.0 - 20.0, delta=0.01)
        self.assertEqual(scene["junctions"][0]["type"], "left")
        right = next(boundary for boundary in scene["boundaries"] if boundary["side"] == "right")
        self.assertEqual(set(right["height_m"]), {0.05})

    def test_faults_of_a_file_are_told_with_their_place(self):
        road = "[[road]]\n[[road.piece]]\nlength_m = 60\n"
        for text, place, words in (
                ("[[road]]\nwidht_m = 6\n", ":2:1", "did you mean 'width_m'?"),
                ("[[road]]\nwidth_m = 99\n", ":2:11", "width_m"),
                ("[[road]]\nwidth_m = \"wide\"\n", ":2:11", "does not fit"),
                ("[[road]]\nside = \"up\"\n", ":2:8", "left or right"),
                ("[[raod]]\n", ":1:", "did you mean 'road'?"),
                ("[[road.piece]]\nlength_m = 3\n", ":1:", "road"),
                ("[grund]\ncrown = 0\n", ":1:", "did you mean 'ground'?"),
                ("speed = 3\n", ":1:1", "unknown section 'speed'"),
                ("road = 3\n", ":1:1", "is a section"),
                (road + "[[road.gap]]\nat = 3\n", ":5:1", "did you mean 'at_m'?"),
                ("[[road]\n", ":1:", ""),
                (road + "[vehicle]\nroad = 2\n", "", "the vehicle's road is not there"),
                (road + "[[road]]\nbranch_of = 1\nat_m = 1\n[[road.piece]]\nlength_m = 30\n", "",
                 "road 2: its kerb returns"),
                ("[[road]]\n", "", "road 1: a line needs a piece"),
                ("", "", "a world needs a road")):
            with self.subTest(text=text):
                self.write("bad.toml", text)
                result = run("simulate", self.folder / "bad.toml", "-o", self.folder / "bad")
                self.check_refused(result, 2, words)
                self.assertIn(f"bad.toml{place}", result.stderr.decode())
                self.assertFalse((self.folder / "bad").exists())

    def test_every_key_is_told_with_its_unit_range_and_meaning(self):
        text = run("simulate", "--keys").stdout.decode()
        for section in ("[ground]", "[vehicle]", "[[vehicle.piece]]", "[mount]", "[weather]", "[[road]]", "[[road.piece]]",
                        "[[road.width]]", "[[road.height]]", "[[road.gap]]", "[[road.bay]]", "[[road.island]]",
                        "[[road.row]]", "[[road.thing]]"):
            self.assertIn(f"\n{section}\n", "\n" + text)
        self.assertRegex(text, r"(?m)^curvature_1pm +0\.0 +1/m +-1 to 1 +1 / radius")

    def test_the_documentation_says_the_keys_that_there_are(self):
        page = pathlib.Path(__file__).resolve().parents[2] / "docs" / "scenarios.md"
        keys = run("simulate", "--keys").stdout.decode()
        self.assertIn(f"```text\n{keys}```\n", page.read_text(encoding="utf-8"))

    def test_a_folder_that_holds_scans_is_left_alone(self):
        before = self.simulate("drive")
        self.check_refused(run("simulate", "street", "-o", self.folder / "drive", "--scans", 1), 6,
                           "holds files already")
        after = {name: (self.folder / "drive" / name).read_bytes() for name in before}
        self.assertEqual(after, before)

    def test_a_folder_that_cannot_be_made_is_a_failure_to_write(self):
        self.write("file", "not a folder")
        self.check_refused(run("simulate", "street", "-o", self.folder / "file" / "drive"), 6)

    def test_requests_that_make_no_sense(self):
        for arguments in (("street", "--scans", "0"), ("river",), ("street", "--noise-m", "-1"),
                          ("street", "--speed-kmh", "nan"), ("street", "--seed", "-1"), ("street", "--seed", "x"),
                          ("street", "more"), ("street", "--sensor", "eye"), ("none.toml",), (),
                          ("street", "--scans", "99999"), ("street", "--format", "tape"),
                          ("street", "--format", "db3"), ("street", "--format", "idc"),
                          ("street", "--sensor", "lux", "--format", "pcap"), ("street", "--rate-hz", "30"),
                          ("street", "--set", "weather.sun=1"), ("street", "--set", "rain=1"),
                          ("street", "--set", "noise.reach=-1")):
            with self.subTest(arguments=arguments):
                self.check_refused(run("simulate", *arguments, "-o", self.folder / "drive"), 2)
        self.check_refused(run("simulate"), 2)
        self.check_refused(run("simulate", "street"), 2, "-o DIR")
        self.assertFalse((self.folder / "drive").exists())

    def test_ctrl_c_keeps_the_scans_that_are_done_and_their_truth(self):
        folder = self.folder / "drive"
        program = start("simulate", "campus", "-o", folder, "--scans", 5000)
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
        self.assertEqual(len(list((folder / "lidarseg").iterdir())), len(names))
        self.assertEqual(self.leftovers(folder) + self.leftovers(folder / "LIDAR_TOP"), [])


if __name__ == "__main__":
    unittest.main()
