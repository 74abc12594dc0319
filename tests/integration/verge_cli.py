# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the real program for the tests, and makes scans for it to read.

The program is named by the environment variable VERGE_PROGRAM.
"""

import array
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["VERGE_PROGRAM"]
NOBODY = 65534


def run(*arguments, **options):
    """The ended program with stdout and stderr as bytes; standard input is empty unless given."""
    options.setdefault("stdin", subprocess.DEVNULL)
    options.setdefault("timeout", 120)
    return subprocess.run([PROGRAM, *map(str, arguments)], stdout=options.pop("stdout", subprocess.PIPE),
                          stderr=subprocess.PIPE, check=False, **options)


def start(*arguments, **options):
    """The running program."""
    return subprocess.Popen([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL,
                            stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE, **options)


def road_points(seed=1, noise_m=0.01):
    """(forward, left, up, ring) of the returns of a 32-ring scanner 1.84 m above a straight road, 8 m wide, with
    kerbs of 0.12 m: each ray meets the road, a kerb's face, or the pavement behind it."""
    height, half_width, kerb = 1.84, 4.0, 0.12
    noise = random.Random(seed)
    for ring in range(32):
        elevation = math.radians(-30.67 + ring * 41.34 / 31)
        for step in range(-180, 180):
            azimuth = math.radians(step)
            forward, left, up = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth),
                                 math.sin(elevation))
            distance = height / -up if up < -0.01 else math.inf
            if abs(left) * distance > half_width:
                to_face = half_width / abs(left)
                drop = -up * to_face
                distance = to_face if drop > height - kerb else (height - kerb) / -up if up < -0.01 else math.inf
            if distance < 60.0:
                distance += noise.gauss(0.0, noise_m)
                yield forward * distance, left * distance, up * distance, ring


def nuscenes_bytes(points):
    """As nuScenes stores a scan: float32 x right, y forward, z up, intensity, ring."""
    return array.array("f", [value for forward, left, up, ring in points
                             for value in (-left, forward, up, 10.0, float(ring))]).tobytes()


class CliTest(unittest.TestCase):
    """A folder of its own for each test, and what every run of the program promises."""

    scan = nuscenes_bytes(road_points())

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="verge_cli_"))
        self.folder.chmod(0o755)
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def recording(self, count, name="drive"):
        """A folder of scans, all of the same bytes."""
        first = self.write(f"{name}/000000.pcd.bin", self.scan)
        for number in range(1, count):
            os.link(first, first.with_name(f"{number:06}.pcd.bin"))
        return first.parent

    def leftovers(self, folder=None):
        return sorted(path.name for path in (folder or self.folder).iterdir() if ".tmp." in path.name)

    def error_lines(self, result):
        return [line for line in result.stderr.decode().splitlines() if line.startswith("verge: error: ")]

    def check_refused(self, result, code, *words):
        """Ended with this code, one error line that has these words, and nothing on standard output."""
        self.assertEqual(result.returncode, code, result.stderr.decode())
        lines = self.error_lines(result)
        self.assertEqual(len(lines), 1, result.stderr.decode())
        self.assertLessEqual(len(lines[0].encode()), 300)
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual(result.stdout or b"", b"")

    def check_ok(self, result):
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        self.assertEqual(self.error_lines(result), [])

    def records(self, data):
        """The JSON objects of JSON lines; fails on anything else in between."""
        text = (data.read_bytes() if isinstance(data, pathlib.Path) else data).decode()
        self.assertTrue(text == "" or text.endswith("\n"))
        return [json.loads(line) for line in text.splitlines()]
