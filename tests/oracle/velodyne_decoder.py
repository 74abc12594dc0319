# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""A second decoder of HDL-32E data packets, written from docs/formats_velodyne.md alone, against ours.

Draws random packets (with faults in them), decodes them by numpy, lets PROGRAM decode the same bytes, and
compares every measurement: ring, azimuth, distance and intensity to the last bit, time to 0.001 us.

    velodyne_decoder.py PROGRAM [PACKETS [SEED]]
"""

import subprocess
import sys

import numpy as np

BLOCKS, SLOTS, TURN = 12, 32, 36000
STEP_NS, SLOT_NS = 46080, 1152
SLOWEST, FASTEST = 1.0 * TURN * 1e-9, 40.0 * TURN * 1e-9  # hundredths of a degree a nanosecond

BLOCK = np.dtype([("flag", "<u2"), ("azimuth", "<u2"), ("shots", [("distance", "<u2"), ("intensity", "u1")], SLOTS)])
PACKET = np.dtype([("blocks", BLOCK, BLOCKS), ("stamp_us", "<u4"), ("mode", "u1"), ("product", "u1")])
SHOT = np.dtype([("packet", "<u4"), ("ring", "<u4"), ("distance", "<u4"), ("intensity", "<u4"), ("azimuth", "<f8"),
                 ("time_us", "<f8")])
assert PACKET.itemsize == 1206 and SHOT.itemsize == 32


def draw(count, rng):
    """Packets of a motor at 1 to 40 Hz that starts anywhere, and one packet in eight with something wrong."""
    packets = np.zeros(count, PACKET)
    steps = rng.uniform(1.0, 40.0, count) * TURN * 1e-9 * STEP_NS
    dual = rng.random(count) < 0.25
    number = np.where(dual[:, None], np.arange(BLOCKS) // 2, np.arange(BLOCKS))
    azimuth = np.rint(rng.integers(0, TURN, count)[:, None] + number * steps[:, None]).astype(int) % TURN
    flag = np.full((count, BLOCKS), 0xEEFF)
    wrong = rng.random((count, BLOCKS)) < 0.01
    flag = np.where(wrong, rng.choice([0xFFEE, 0xDDFF, 0, 0xEEFE], (count, BLOCKS)), flag)
    beyond = rng.random((count, BLOCKS)) < 0.01
    azimuth = np.where(beyond, rng.integers(TURN, 65536, (count, BLOCKS)), azimuth)
    standing = rng.random(count) < 0.01
    azimuth = np.where(standing[:, None], azimuth[:, :1] % TURN, azimuth)
    # Anywhere at all, but for the packets whose azimuths could leap and go on.
    packets["blocks"]["flag"] = flag
    packets["blocks"]["azimuth"] = azimuth
    distance = rng.integers(0, 65536, (count, BLOCKS, SLOTS))
    packets["blocks"]["shots"]["distance"] = np.where(rng.random(distance.shape) < 0.2, 0, distance)
    packets["blocks"]["shots"]["intensity"] = rng.integers(0, 256, distance.shape)
    packets["stamp_us"] = rng.integers(0, 3_600_000_000, count)
    packets["mode"] = np.where(dual, 0x39, rng.choice([0x37, 0x38], count))
    packets["product"] = 0x21
    old = ~dual & (rng.random(count) < 0.1)  # firmware that does not set the last two bytes
    packets["mode"][old] = packets["product"][old] = 0
    return packets


def turn_rates(azimuth, usable, step):
    """For each block the turn to the next usable step; else that of the block before; 0 at first."""
    count = len(azimuth)
    rate = np.zeros((count, BLOCKS))
    known = np.zeros((count, BLOCKS), bool)
    for block in range(BLOCKS):
        found = np.zeros(count, bool)
        for after in range(block + 1, BLOCKS):
            takes = usable[:, block] & usable[:, after] & (step[:, after] != step[:, block]) & ~found
            turned = (TURN + azimuth[:, after] - azimuth[:, block]) % TURN
            lasted = np.where(takes, (step[:, after] - step[:, block]) * STEP_NS, 1)
            value = turned / lasted
            good = takes & (value >= SLOWEST) & (value <= FASTEST)
            rate[good, block] = value[good]
            known[good, block] = True
            found |= takes
    carried = np.zeros(count)
    for block in range(BLOCKS):
        carried = np.where(known[:, block], rate[:, block], carried)
        rate[:, block] = carried
    return rate


def decode(packets):
    blocks = packets["blocks"]
    azimuth = blocks["azimuth"].astype(np.int64)
    usable = (blocks["flag"] == 0xEEFF) & (azimuth < TURN)
    dual = packets["mode"] == 0x39
    step = np.where(dual[:, None], np.arange(BLOCKS) // 2, np.arange(BLOCKS))
    rate = turn_rates(azimuth, usable, step)
    distance = blocks["shots"]["distance"]
    packet, block, slot = np.nonzero(usable[:, :, None] & (distance > 0))
    out = np.zeros(len(packet), SHOT)
    out["packet"] = packet
    out["ring"] = np.where(slot % 2 == 0, slot // 2, 16 + slot // 2)
    out["distance"] = distance[packet, block, slot]
    out["intensity"] = blocks["shots"]["intensity"][packet, block, slot]
    out["azimuth"] = azimuth[packet, block] + rate[packet, block] * (SLOT_NS * slot)
    out["time_us"] = packets["stamp_us"][packet] + (step[packet, block] * STEP_NS + SLOT_NS * slot) / 1000.0
    return out


def differences(ours, theirs):
    if len(ours) != len(theirs):
        return f"{len(theirs)} measurements, {len(ours)} are right"
    for column in ("packet", "ring", "distance", "intensity", "azimuth"):
        wrong = int(np.count_nonzero(ours[column] != theirs[column]))
        if wrong:
            return f"{wrong} of {len(ours)} differ in {column}"
    late = float(np.max(np.abs(ours["time_us"] - theirs["time_us"]))) if len(ours) else 0.0
    return f"times differ by up to {late} us" if late > 0.001 else None


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20_000
    rng = np.random.default_rng(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    measurements = 0
    for begin in range(0, count, 5000):
        packets = draw(min(5000, count - begin), rng)
        answer = subprocess.run([program], input=packets.tobytes(), stdout=subprocess.PIPE, check=True).stdout
        right = decode(packets)
        wrong = differences(right, np.frombuffer(answer, SHOT))
        if wrong:
            print(f"packets {begin}..: {wrong}")
            return 1
        measurements += len(right)
    print(f"{count} packets, {measurements} measurements: no difference")
    return 0


if __name__ == "__main__":
    sys.exit(main())
