# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Boundaries against the truth: the figures, and what is refused."""

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
        return json.loads(self.evaluate(predictions, truth, "--json", *arguments).stdout)

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

    def test_a_line_without_end_is_refused_before_memory_is_full(self):
        good = self.write("good.jsonl", scene("a"))
        self.check_refused(run("evaluate", "/dev/zero", "--truth", good), 8, "line")

    def test_requests_that_make_no_sense(self):
        good = self.write("good.jsonl", scene("a"))
        for arguments in ((), (good,), (good, "--truth", good, "--range", "0"),
                          (good, "--truth", good, "--range", "nan"), (good, "--truth", good, "--tolerance", "-1"),
                          (good, good, "--truth", good)):
            with self.subTest(arguments=arguments):
                self.check_refused(run("evaluate", *arguments), 2)


if __name__ == "__main__":
    unittest.main()
