# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""The same bytes in give the same bytes out: twice, with any number of threads, on generated and on real scans."""

import hashlib
import os
import pathlib
import unittest

from verge_cli import CliTest, nuscenes_bytes, road_points, run

THREADS = (1, 2, 3, 4, 7)
REAL = ("semantickitti/sequences/00/velodyne", "nuscenes-hdl32/labelled/LIDAR_TOP", "vlp16-kerb-labels")


class Determinism(CliTest):
    def hashes(self, recording, threads, frames=":"):
        """Of every file that a run makes, by name."""
        folder = self.folder / "out"
        folder.mkdir(exist_ok=True)
        result = run("detect", recording, "-j", threads, "--frames", frames, "-o", folder / "a.jsonl", "--geojson",
                     folder / "a.geojson", "--plot", folder / "pictures", "--set", "plot.size_px=300", timeout=500)
        self.check_ok(result)
        return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
                for path in sorted(folder.rglob("*")) if path.is_file()}

    def check_same(self, recording, frames=":"):
        first = self.hashes(recording, THREADS[0], frames)
        self.assertGreater(len(first), 3)  # records, summary, collection and pictures
        for threads in THREADS:
            with self.subTest(threads=threads):
                self.assertEqual(self.hashes(recording, threads, frames), first)

    def test_on_generated_scans(self):
        for number in range(12):
            points = nuscenes_bytes(road_points(seed=number))
            self.write(f"drive/{number:06}.pcd.bin", points[:len(points) - 20 * 700 * number])
        self.check_same(self.folder / "drive")

    @unittest.skipUnless(os.environ.get("VERGE_DATA"), "VERGE_DATA is not set")
    def test_on_real_scans(self):
        for recording in REAL:
            with self.subTest(recording=recording):
                self.check_same(pathlib.Path(os.environ["VERGE_DATA"]) / recording, ":4")


if __name__ == "__main__":
    unittest.main()
