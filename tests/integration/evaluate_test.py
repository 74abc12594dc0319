# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Boundaries against the truth: the figures, and what is refused."""

import csv
import json
import math
import unittest

from verge_cli import CliTest, run


def scene(frame, left=4.0, right=-4.0, reach=30.0):
    """A straight road along x as one JSON line."""
    return json.dumps({"frame": frame, "boundaries": [
        {"side": "left", "points": [[-reach, left, 0], [reach, left, 0]]},
        {"side": "right", "points": [[-reach, right, 0], [reach, right, 0]]}]}) + "\n"


def curve(frame):
    """The left kerb of a curve of 30 m radius."""
    angles = [i / 100 for i in range(-50, 51)]
    points = [[30 * math.sin(a), 34 - 30 * math.cos(a)] for a in angles]
    return json.dumps({"frame": frame, "boundaries": [{"side": "left", "points": points}]}) + "\n"


class Evaluate(CliTest):
    def evaluate(self, predictions, truth, *arguments):
        result = run("evaluate", self.write("found.jsonl", predictions), "--truth",
                     self.write("truth.jsonl", truth), *arguments)
        self.check_ok(result)
        return result

    def figures(self, predictions, truth, *arguments):
        return json.loads(self.evaluate(predictions, truth, "--json", "-", *arguments).stdout)

    def test_the_truth_is_right_and_covers_itself(self):
        truth = scene("a") + scene("b", 3.0)
        figures = self.figures(truth, truth)["groups"]["all"]
        self.assertEqual((figures["scans"], figures["scans_without_prediction"]), (2, 0))
        self.assertEqual((figures["median_m"], figures["percentile_95_m"], figures["greatest_m"]), (0, 0, 0))
        self.assertEqual((figures["share_right"], figures["share_covered"]), (1, 1))

    def test_a_shift_is_the_error(self):
        figures = self.figures(scene("a", 4.1, -3.9), scene("a"))["groups"]["all"]
        self.assertAlmostEqual(figures["median_m"], 0.1)
        self.assertAlmostEqual(figures["percentile_95_m"], 0.1)

    def test_tolerance_and_range_are_what_is_asked_for(self):
        near = self.figures(scene("a", 4.3), scene("a"), "--tolerance", "0.25", "--range", "10")
        far = self.figures(scene("a", 4.3), scene("a"), "--tolerance", "0.35", "--range", "20")
        self.assertLess(near["groups"]["all"]["share_right"], 0.51)
        self.assertEqual(far["groups"]["all"]["share_right"], 1)
        self.assertGreater(far["groups"]["all"]["truth_samples"], near["groups"]["all"]["truth_samples"])

    def test_with_any_side_the_place_counts(self):
        swapped = scene("a", -4.0, 4.0)
        self.assertEqual(self.figures(swapped, scene("a"))["groups"]["all"]["share_right"], 0)
        self.assertEqual(self.figures(swapped, scene("a"), "--any-side")["groups"]["all"]["share_right"], 1)

    def test_straight_and_curve_are_told_apart_by_the_truth(self):
        truth = scene("a") + curve("b") + curve("c")
        figures = self.figures(truth, truth)
        self.assertEqual({name: group["scans"] for name, group in figures["groups"].items()},
                         {"straight": 1, "curve": 2, "all": 3})
        self.assertEqual([one["shape"] for one in figures["scans"]], ["straight", "curve", "curve"])

    def test_the_table_has_a_row_for_each_shape_and_one_for_all(self):
        table = self.evaluate(scene("a", 4.1), scene("a") + curve("b")).stdout.decode()
        rows = {line.split()[0]: line.split()[1:] for line in table.splitlines() if line}
        self.assertEqual(rows["straight"][:2], ["1", "0"])
        self.assertEqual(rows["curve"][:2], ["1", "1"])
        self.assertEqual(rows["all"][:2], ["2", "1"])
        self.assertEqual(rows["straight"][4], "0.100")
        self.assertEqual(rows["curve"][4], "-")

    def test_a_side_that_the_truth_does_not_have_is_infinitely_wrong_and_null_in_json(self):
        found = json.dumps({"frame": "b", "boundaries": [{"side": "right", "points": [[0, -4], [9, -4]]}]}) + "\n"
        figures = self.figures(found, curve("b"))["groups"]["all"]
        self.assertIsNone(figures["percentile_95_m"])
        self.assertEqual(figures["share_right"], 0)

    def test_predicted_frames_without_truth_are_named_in_a_warning(self):
        result = self.evaluate(scene("a") + scene("stray"), scene("a"))
        self.assertIn("stray", result.stderr.decode())

    def test_predictions_may_come_from_standard_input(self):
        truth = self.write("truth.jsonl", scene("a"))
        found = self.write("found.jsonl", scene("a"))
        with found.open("rb") as source:
            self.check_ok(run("evaluate", "-", "--truth", truth, stdin=source))

    def test_files_that_cannot_be_used(self):
        good = self.write("good.jsonl", scene("a"))
        bad = self.write("bad.jsonl", scene("a") + "{\n")
        twice = self.write("twice.jsonl", scene("a") + scene("a"))
        empty = self.write("empty.jsonl", "\n")
        self.check_refused(run("evaluate", self.folder / "none", "--truth", good), 3, "none")
        self.check_refused(run("evaluate", self.folder, "--truth", good), 3, "folder")
        self.check_refused(run("evaluate", bad, "--truth", good), 4, "bad.jsonl:2:")
        self.check_refused(run("evaluate", good, "--truth", bad), 4, "bad.jsonl:2:")
        self.check_refused(run("evaluate", twice, "--truth", good), 4, "twice")
        self.check_refused(run("evaluate", good, "--truth", empty), 4, "empty.jsonl")

    def test_a_frame_that_stands_twice_has_its_line(self):
        good = self.write("good.jsonl", scene("a"))
        twice = self.write("same.jsonl", scene("a") + scene("b") + scene("folder/a.bin"))
        self.check_refused(run("evaluate", twice, "--truth", good), 4, "same.jsonl:3:", "twice")

    def test_where_no_frame_matches_both_are_named(self):
        found = self.write("found.jsonl", scene("x"))
        truth = self.write("truth.jsonl", scene("a"))
        self.check_refused(run("evaluate", found, "--truth", truth), 4, "no frame matches", "got x", "need a")

    def test_a_line_without_end_is_refused_before_memory_is_full(self):
        good = self.write("good.jsonl", scene("a"))
        self.check_refused(run("evaluate", "/dev/zero", "--truth", good), 8, "line")

    def test_requests_that_make_no_sense(self):
        good = self.write("good.jsonl", scene("a"))
        for arguments in ((), (good,), (good, "--truth", good, "--range", "0"),
                          (good, "--truth", good, "--range", "nan"), (good, "--truth", good, "--tolerance", "-1"),
                          (good, "--truth", good, "--tolerance", "0.1,x"), (good, "--truth", good, "--labels", good),
                          ("--truth", good), (good, "--truth", good, "--json", "-", "--csv", "-"),
                          (good, good, "--truth", good)):
            with self.subTest(arguments=arguments):
                self.check_refused(run("evaluate", *arguments), 2)

    def test_every_metric_stands_in_the_json(self):
        truth = (f'{{"frame":"a","points":[],"corners":[{{"id":1,"side":"left","position":[9,4]}}],'
                 f'"junctions":[{{"type":"T","center":[12,0]}}],"objects":[{{"center":[9,2],"size":[4,2,2]}}]}}\n'
                 f'{scene("b")}')
        metrics = self.figures(truth, truth)["metrics"]
        self.assertEqual(metrics["corners"]["m1"], 1)
        self.assertEqual(metrics["junctions"]["type_accuracy"], 1)
        self.assertEqual(metrics["objects"]["recall"], 1)
        self.assertEqual(metrics["success"]["straight"]["minimum"], 1)
        self.assertEqual(metrics["detection_range_m"], 35)
        self.assertEqual(metrics["stations"]["all"]["precision"], 1)
        self.assertEqual([(cell["range_m"], cell["tolerance_m"]) for cell in metrics["tolerance"]][:2],
                         [(10, 0.05), (10, 0.1)])
        self.assertEqual({cell["f1"] for cell in metrics["tolerance"]}, {1})

    def test_figures_go_to_files_and_rows_to_the_table(self):
        result = self.evaluate(scene("a", 4.1), scene("a"), "--per-frame", "--tolerance", "0.05,0.2",
                               "--json", self.folder / "f.json", "--csv", self.folder / "f.csv")
        self.assertIn("F1@0.05", result.stdout.decode())
        self.assertEqual(json.loads((self.folder / "f.json").read_text())["tolerance_m"], 0.2)
        with (self.folder / "f.csv").open(newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual({row["scope"] for row in rows}, {"all", "scan"})
        cell = next(row for row in rows if (row["range_m"], row["tolerance_m"]) == ("20", "0.05"))
        self.assertEqual((cell["precision"], cell["recall"]), ("0.500000", "0.500000"))
        self.check_refused(run("evaluate", self.folder / "found.jsonl", "--truth", self.folder / "truth.jsonl", "--json",
                               self.folder / "none" / "f.json"), 6, "none")


class EvaluateLabels(CliTest):
    """Against hand-picked kerb points."""

    TRUTH = "frame,side,x,y,z\n" + "".join(f"a,left,{x},4,0\n" for x in range(10)) + "b,left,1,4,0\n"

    def evaluate(self, predictions, *arguments):
        return run("evaluate", "--predictions", self.write("found.jsonl", predictions), "--labels",
                   self.write("set/truth.csv", self.TRUTH).parent, *arguments)

    def test_points_and_boundaries_of_any_program_are_scored(self):
        found = (scene("a", 4.2) + json.dumps({"frame": "x/b.pcd", "points": [[1, 4.0, 0, 99]]}) + "\n")
        result = self.evaluate(found, "--json", "-")
        self.check_ok(result)
        figures = json.loads(result.stdout)
        self.assertEqual((figures["scans"], figures["absent"], figures["true_points"]), (2, 0, 11))
        self.assertEqual([at["found"] for at in figures["tolerances"]], [1, 1, 11, 11])
        self.assertEqual([frame["predicted"] for frame in figures["frames"]], [True, True])

    def test_the_table_says_what_the_scans_came_to(self):
        result = self.evaluate(scene("a"), "--per-frame", "--tolerance", "0.3", "--range", "30")
        self.check_ok(result)
        table = result.stdout.decode()
        self.assertIn("2 scans (1 without a prediction), 11 true points", table)
        self.assertEqual([line.split() for line in table.splitlines() if line.startswith("b ")],
                         [["b", "1", "0", "0.000"]])

    def test_frames_are_numbers_in_some_programs(self):
        self.TRUTH = "frame,side,x,y,z\n7,left,1,4,0\n"
        self.check_ok(self.evaluate('{"frame":7,"points":[[1,4]]}\n'))

    def test_predictions_without_labels_are_counted_in_a_warning(self):
        result = self.evaluate(scene("a") + scene("stray"))
        self.check_ok(result)
        self.assertIn("1 of 2", result.stderr.decode())

    def test_what_cannot_be_used(self):
        self.check_refused(self.evaluate("{"), 4, "found.jsonl:1:")
        self.check_refused(self.evaluate(scene("a") + scene("a")), 4, "found.jsonl:2:", "twice")
        self.check_refused(self.evaluate(scene("x")), 4, "no frame matches", "got x", "need a, b")
        self.check_refused(self.evaluate(""), 4, "no frame matches")
        found = self.folder / "found.jsonl"
        self.check_refused(run("evaluate", found, "--labels", self.folder / "none"), 3, "none")
        self.check_refused(run("evaluate", found, "--labels", self.write("empty/a.txt", "").parent), 4, "no labelled")
        bad = self.write("bad/truth.csv", "frame,side,x,y,z\na,left,1\n").parent
        self.check_refused(run("evaluate", self.write("good.jsonl", scene("a")), "--labels", bad), 4, "truth.csv:2:")


class EvaluateGround(CliTest):
    """Which points are ground, against labels of nuScenes lidarseg."""

    def setUp(self):
        super().setUp()
        self.points = len(self.scan) // 20
        self.recording(2, "set/LIDAR_TOP")
        self.truth = bytes([24] * (self.points - 300) + [17] * 200 + [0] * 100)  # road, cars, noise
        for name in ("000000", "000001"):
            self.write(f"set/lidarseg/{name}_lidarseg.bin", self.truth)

    def evaluate(self, *arguments):
        return run("evaluate", "--ground", "--labels", self.folder / "set", *arguments)

    def figures(self, *arguments):
        result = self.evaluate("--json", "-", *arguments)
        self.check_ok(result)
        return json.loads(result.stdout)

    def test_the_labels_of_any_program_are_scored(self):
        self.write("other/000000_lidarseg.bin", bytes([24] * 100) + self.truth[100:-150] + bytes([26] * 150))
        self.write("other/stray_lidarseg.bin", b"")
        result = self.evaluate(self.folder / "other", "--json", self.folder / "g.json", "--csv", self.folder / "g.csv",
                               "--per-frame")
        self.check_ok(result)
        self.assertIn("1 of 2 predicted label files", result.stderr.decode())
        self.assertIn("2 scans (1 without a prediction)", result.stdout.decode())
        figures = json.loads((self.folder / "g.json").read_text())
        ground = self.points - 300
        for name in ("patchwork", "patchwork++"):
            counts = figures["protocols"][name]
            self.assertEqual([counts[key] for key in ("true_ground", "false_ground", "missed_ground", "true_other")],
                             [ground, 50, ground, 350])
            self.assertAlmostEqual(counts["macro_precision"], ground / (ground + 50), delta=1e-6)
            self.assertEqual((counts["recall"], counts["macro_recall"]), (0.5, 0.5))
        self.assertIsNone(figures["height"]["rmse_m"])
        self.assertEqual([frame["predicted"] for frame in figures["frames"]], [True, False])
        with (self.folder / "g.csv").open(newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([(row["scope"], row["protocol"]) for row in rows[:2]],
                         [("all", "patchwork++"), ("all", "patchwork")])
        self.assertEqual((len(rows), rows[0]["recall"], rows[-1]["precision"]), (6, "0.500000", ""))

    def test_without_predictions_the_plane_of_the_road_is_scored(self):
        figures = self.figures()
        self.assertEqual((figures["plane_tolerance_m"], figures["range_m"]), (0.3, None))
        self.assertGreater(figures["protocols"]["patchwork++"]["recall"], 0.99)
        self.assertLess(figures["height"]["rmse_m"], 0.12)
        near = self.figures("--plane-tolerance", "0.06", "--range", "15")
        self.assertLess(near["protocols"]["patchwork++"]["recall"], 0.9)
        self.assertLess(near["height"]["points"], figures["height"]["points"])

    def test_the_labels_of_a_simulated_drive_are_the_truth(self):
        for format in ("nuscenes", "kitti"):
            with self.subTest(format=format):
                drive = self.folder / format
                self.check_ok(run("simulate", "street", "-o", drive, "--scans", "1", "--noise-m", "0", "--format",
                                  format))
                result = run("evaluate", "--ground", "--labels", drive, "--json", "-")
                self.check_ok(result)
                figures = json.loads(result.stdout)
                self.assertGreater(figures["protocols"]["patchwork++"]["f1"], 0.95)
                self.assertLess(figures["height"]["rmse_m"], 0.15)

    def test_what_cannot_be_used(self):
        self.check_refused(self.evaluate(self.folder / "none"), 3, "none")
        self.check_refused(self.evaluate(self.write("a.label", "")), 3, "a.label")
        self.check_refused(self.evaluate(self.write("empty/a.txt", "").parent), 4, "has no labels")
        self.check_refused(self.evaluate(self.write("else/a.label", "").parent), 4, "no labels of these scans",
                           "000000_lidarseg.bin")
        cut = self.write("cut/000000_lidarseg.bin", self.truth[:-1]).parent
        self.check_refused(self.evaluate(cut), 4, f"000000_lidarseg.bin:{self.points - 1}:", f"need {self.points} B")
        self.write("twice/a/000000_lidarseg.bin", self.truth)
        self.write("twice/b/000000_lidarseg.bin", self.truth)
        self.check_refused(self.evaluate(self.folder / "twice"), 2, "more than one folder")
        self.check_refused(run("evaluate", "--ground", "--labels", self.write("t/truth.csv",
                               "frame,side,x,y,z\na,left,1,2,0\n").parent), 4, "do not say what is ground")

    def test_requests_that_make_no_sense(self):
        folder = self.folder / "set"
        for arguments in (("--ground",), ("--ground", "--truth", folder), ("--labels", folder, "--plane-tolerance", "1"),
                          ("--ground", "--labels", folder, "--plane-tolerance", "0"),
                          ("--ground", "--labels", folder, "--tolerance", "0.3"),
                          ("--ground", "--labels", folder, "--suite", "real")):
            with self.subTest(arguments=arguments):
                self.check_refused(run("evaluate", *arguments), 2)


if __name__ == "__main__":
    unittest.main()
