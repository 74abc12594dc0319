# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""verge evaluate --labels against the scorer that defines its figures, on the real labelled scans.

Needs VERGE_SCORER (the scorer, a Python program), VERGE_DATA (the labelled scans), and Debian's Python with numpy to
run the scorer.
"""

import json
import os
import pathlib
import random
import subprocess
import sys
import unittest

from verge_cli import CliTest, run

PYTHON = "/usr/bin/python3"
SCORER = os.environ.get("VERGE_SCORER")
DATA = os.environ.get("VERGE_DATA")
SETS = {"nuscenes-hdl32/labelled": "nuscenes-hdl32/labelled/LIDAR_TOP",
        "semantickitti": "semantickitti/sequences/00",
        "vlp16-kerb-labels": "vlp16-kerb-labels"}
FIGURES = {"precision": "precision", "recall": "recall", "f1": "f1", "macro": "macro_f1", "kerb-recall": "kerb_recall",
           "rmse": "rmse_m", "judged": "judged_share"}


def reason_to_skip():
    """One line, or None."""
    if not SCORER or not pathlib.Path(SCORER).is_file():
        return "VERGE_SCORER does not name the scorer"
    if not DATA:
        return "VERGE_DATA does not name the labelled scans"
    if subprocess.run([PYTHON, "-c", "import numpy"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        return f"{PYTHON} has no numpy"
    return None


def scorer_rows(folder, predictions, options):
    """What the scorer prints at each tolerance: {"tol": "0.1", ..., "judged": "0.802"}."""
    output = subprocess.run([PYTHON, SCORER, folder, predictions, *options], stdout=subprocess.PIPE, check=True).stdout
    words = [line.split() for line in output.decode().splitlines()]
    return [dict(zip(row[::2], row[1::2])) for row in words]


class AgreesWithTheScorer(CliTest):
    def check_agreement(self, labels, predictions, *options):
        folder = pathlib.Path(DATA) / labels
        ours = run("evaluate", "--predictions", predictions, "--labels", folder, "--json", "-",
                   *(word.replace("--tol", "--tolerance") for word in options))
        self.check_ok(ours)
        figures = json.loads(ours.stdout)
        rows = scorer_rows(folder, predictions, options)
        self.assertEqual(len(rows), len(figures["tolerances"]))
        for row, at in zip(rows, figures["tolerances"]):
            self.assertEqual([int(row[name]) for name in ("scans", "absent", "true", "kerb")],
                             [figures[name] for name in ("scans", "absent", "true_points", "kerb_points")])
            for name, key in FIGURES.items():
                with self.subTest(labels=labels, tolerance=row["tol"], figure=name):
                    if row[name] == "-":
                        self.assertIsNone(at[key])
                    else:
                        self.assertAlmostEqual(float(row[name]), at[key], delta=0.00051)

    def test_on_the_gradient_methods_boundaries(self):
        for labels, scans in SETS.items():
            found = self.folder / "found.jsonl"
            self.check_ok(run("detect", pathlib.Path(DATA) / scans, "-o", found, "--quiet"))
            self.check_agreement(labels, found)
            self.check_agreement(labels, found, "--range", "35", "--tol", "0.05,1", "--gap", "1.2")

    def test_on_made_up_lines_and_bare_points(self):
        chance = random.Random(5)
        frames = [path.name for path in sorted((pathlib.Path(DATA) / SETS["semantickitti"] / "velodyne").iterdir())]
        lines = []
        for frame in frames[::3]:  # the others are absent
            walk = [[chance.uniform(-25, 25), chance.uniform(-25, 25)] for _ in range(12)]
            loose = [[chance.uniform(-12, 12), chance.uniform(-12, 12), 0] for _ in range(300)]
            parts = {"points": loose} if chance.random() < 0.5 else {"boundaries": [{"points": walk}, {"points": []}]}
            lines.append(json.dumps({"frame": f"some/folder/{frame}", **parts}))
        self.check_agreement("semantickitti", self.write("made_up.jsonl", "\n".join(lines)))


if __name__ == "__main__":
    if reason := reason_to_skip():
        print(f"skipped: {reason}")
        sys.exit(77)
    unittest.main()
