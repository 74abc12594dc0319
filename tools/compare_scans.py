#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Says how much simulated scans are like real ones: a table of what rings look like in both.

Reads scans as nuScenes stores them (.pcd.bin); a folder means all scans in it. Needs nothing but Python.

    compare_scans.py REAL SIMULATED
"""

import argparse
import math
import pathlib
import statistics
import struct
import sys

NEAREST_M = 2.3  # what is nearer is the vehicle, or how the set writes a shot without a return
ROAD_M = 0.25    # how far from the level of the ground under the sensor road points lie


class Ring:
    """The points of one ring of one scan, in order of azimuth: (azimuth, range, horizontal range, height)."""

    def __init__(self, points):
        self.points = sorted(points)

    def returns(self):
        return [p for p in self.points if p[1] >= NEAREST_M]

    def road(self, ground_m):
        return [p for p in self.returns() if abs(p[3] - ground_m) < ROAD_M]


def read(path):
    """Rings of a scan by number."""
    rings = {}
    for x, y, z, _, ring in struct.iter_unpack("<5f", path.read_bytes()):
        rings.setdefault(int(ring), []).append((math.atan2(y, x), math.sqrt(x * x + y * y + z * z), math.hypot(x, y), z))
    return {number: Ring(points) for number, points in rings.items()}


def scans_in(path):
    files = [path] if path.is_file() else sorted(path.rglob("*.pcd.bin"))
    if not files:
        sys.exit(f"{path}: no .pcd.bin")
    return [read(file) for file in files]


def ground_of(scans):
    """Height of the ground under the sensor: where most points of the rings between 4 and 8 m are."""
    return statistics.median(p[3] for scan in scans for ring in scan.values() for p in ring.points if 4.0 < p[2] < 8.0)


def deviation(values):
    """Of the normal distribution that has the same median of absolute deviations."""
    middle = statistics.median(values)
    return 1.4826 * statistics.median(abs(v - middle) for v in values)


def noise(ring, ground_m, step_rad):
    """Deviation of single ranges, from second differences of neighbours on the road (which a smooth road has not)."""
    road = ring.road(ground_m)
    seconds = [(a[1] - 2.0 * b[1] + c[1]) / math.sqrt(6.0) for a, b, c in zip(road, road[1:], road[2:])
               if c[0] - a[0] < 2.5 * step_rad]
    return deviation(seconds) if len(seconds) > 50 else None


def step_of(ring):
    azimuths = [p[0] for p in ring.returns()]
    return statistics.median(b - a for a, b in zip(azimuths, azimuths[1:])) if len(azimuths) > 100 else None


def over(scans, numbers, measure):
    values = [measure(scan[n]) for scan in scans for n in numbers if n in scan]
    values = [v for v in values if v is not None]
    return statistics.median(values) if values else None


def share_of_returns(scans, numbers, shots):
    returned = sum(len(scan[n].returns()) for scan in scans for n in numbers if n in scan)
    return returned / (shots * len(scans) * len(numbers))


def rows(scans, shots):
    """The table's figures of one side: name and value."""
    ground_m = ground_of(scans)
    step_rad = over(scans, range(10, 20), step_of)
    out = [("height over the ground, m", -ground_m)]
    for number in range(8, 19, 2):
        radius = over(scans, [number], lambda ring: statistics.median(-p[2] / p[3] for p in ring.road(ground_m))
                      if len(ring.road(ground_m)) > 200 else None)
        out.append((f"radius of ring {number} on the road, for a metre of height", radius))
    out.append(("shots a ring and turn", 2.0 * math.pi / step_rad))
    out.append(("azimuth from point to point, deg", math.degrees(step_rad)))
    spacing = over(scans, [12], lambda ring: statistics.median(
        math.dist((a[2] * math.cos(a[0]), a[2] * math.sin(a[0])), (b[2] * math.cos(b[0]), b[2] * math.sin(b[0])))
        for a, b in zip(ring.road(ground_m), ring.road(ground_m)[1:])))
    out.append(("spacing of points in ring 12, m", spacing))
    out.append(("share of returns, rings 9 to 17 (the road near by)", share_of_returns(scans, range(9, 18), shots)))
    out.append(("share of returns, rings 18 to 22 (the road far off)", share_of_returns(scans, range(18, 23), shots)))
    out.append(("share of returns, rings 23 to 31 (over the horizon)", share_of_returns(scans, range(23, 32), shots)))
    out.append(("noise of single ranges on the road, rings 9 to 14, m",
                over(scans, range(9, 15), lambda ring: noise(ring, ground_m, step_rad))))
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("real", type=pathlib.Path)
    parser.add_argument("simulated", type=pathlib.Path)
    parser.add_argument("--shots", type=int, default=1085, help="a ring and turn (HDL-32E at 20 Hz)")
    arguments = parser.parse_args()
    real = rows(scans_in(arguments.real), arguments.shots)
    simulated = rows(scans_in(arguments.simulated), arguments.shots)
    print("| what | real | simulated | difference |\n|---|---|---|---|")
    for (name, a), (_, b) in zip(real, simulated):
        if a is None or b is None:
            print(f"| {name} | {a} | {b} | - |")
        else:
            print(f"| {name} | {a:.4g} | {b:.4g} | {100.0 * (b / a - 1.0):+.0f} % |")


if __name__ == "__main__":
    main()
