# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""A second decoder of Velodyne's packets, written from docs/formats_velodyne.md alone, against ours.

Draws random packets (with faults in them), decodes them by numpy, lets PROGRAM decode the same bytes, and
compares every point: ring, azimuth, distance, intensity and echo to the last bit, time to 0.001 us, place to
0.1 mm; of position packets every field.

    velodyne_decoder.py PROGRAM [PACKETS [SEED [WHAT...]]]

WHAT: hdl32e, vlp16, vlp32c, hdl64e-s1, hdl64e-s2, hdl64e-s3 (with a random calibration), position; else all.
"""

import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

BLOCKS, SLOTS, TURN = 12, 32, 36000
SLOWEST, FASTEST = 1.0 * TURN * 1e-9, 40.0 * TURN * 1e-9  # hundredths of a degree a nanosecond
UPPER, LOWER = 0xEEFF, 0xDDFF

BLOCK = np.dtype([("flag", "<u2"), ("azimuth", "<u2"), ("shots", [("distance", "<u2"), ("intensity", "u1")], SLOTS)])
PACKET = np.dtype([("blocks", BLOCK, BLOCKS), ("stamp_us", "<u4"), ("mode", "u1"), ("product", "u1")])
SHOT = np.dtype([("packet", "<u4"), ("ring", "<u4"), ("distance", "<u4"), ("intensity", "<u4"), ("echo", "<u4"),
                 ("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("azimuth", "<f8"), ("time_us", "<f8")])
FIX = np.dtype([("gyro", "<f8", 3), ("temperature", "<f8", 3), ("ax", "<f8", 3), ("ay", "<f8", 3), ("utc_ns", "<i8"),
                ("stamp_us", "<u4"), ("pps", "<u4"), ("fault", "<u4"), ("locked", "<u4")])
assert PACKET.itemsize == 1206 and SHOT.itemsize == 48 and FIX.itemsize == 120

S = np.arange(SLOTS)
HDL32E_RAD = np.array([
    -0.5352925, -0.1628392, -0.5119051, -0.1396263, -0.4886922, -0.1164135, -0.4654793, -0.0930260,
    -0.4420919, -0.0698132, -0.4188790, -0.0466003, -0.3956661, -0.0232129, -0.3722787, 0,
    -0.3490659, 0.0232129, -0.3258530, 0.0466003, -0.3024656, 0.0698132, -0.2792527, 0.0930260,
    -0.2560398, 0.1164135, -0.2326524, 0.1396263, -0.2094395, 0.1628392, -0.1862266, 0.1862266])
VLP32C_DEG = np.array([
    [-25, 1.4], [-1, -4.2], [-1.667, 1.4], [-15.639, -1.4], [-11.31, 1.4], [0, -1.4], [-0.667, 4.2], [-8.843, -1.4],
    [-7.254, 1.4], [0.333, -4.2], [-0.333, 1.4], [-6.148, -1.4], [-5.333, 4.2], [1.333, -1.4], [0.667, 4.2],
    [-4, -1.4], [-4.667, 1.4], [1.667, -4.2], [1, 1.4], [-3.667, -4.2], [-3.333, 4.2], [3.333, -1.4], [2.333, 1.4],
    [-2.667, -1.4], [-3, 1.4], [7, -1.4], [4.667, 1.4], [-2.333, -4.2], [-2, 4.2], [15, -1.4], [10.333, 1.4],
    [-1.333, -1.4]])


@dataclass
class Lasers:
    """One entry a laser: radians and metres; `aside` and `ahead` are the two points' corrections, NaN without."""
    elevation: np.ndarray
    azimuth: np.ndarray
    distance: np.ndarray
    up: np.ndarray
    left: np.ndarray
    aside: np.ndarray
    ahead: np.ndarray

    @staticmethod
    def plain(elevation, azimuth):
        none = np.zeros(len(elevation))
        return Lasers(elevation, azimuth, none, none, none, none + np.nan, none + np.nan)

    def rings(self):
        return np.argsort(np.argsort(self.elevation, kind="stable"), kind="stable")


@dataclass
class Model:
    name: str
    product: int
    step_ns: int
    slot_ns: np.ndarray
    metres: float = 0.002
    firing: int = SLOTS  # lasers of one firing
    banks: int = 1
    together: bool = False  # the two banks are one step
    lasers: Lasers | None = None  # None: of a calibration file


MODELS = {model.name: model for model in (
    Model("hdl32e", 0x21, 46080, 1152 * S, lasers=Lasers.plain(HDL32E_RAD, np.zeros(32))),
    Model("vlp16", 0x22, 110592, 55296 * (S // 16) + 2304 * (S % 16), firing=16,
          lasers=Lasers.plain(np.radians([j - 15.0 if j % 2 == 0 else float(j) for j in range(16)]), np.zeros(16))),
    Model("vlp32c", 0x28, 55296, 2304 * (S // 2), metres=0.004,
          lasers=Lasers.plain(np.radians(VLP32C_DEG[:, 0]), np.radians(VLP32C_DEG[:, 1]))),
    Model("hdl64e-s1", 0x21, 32051, 0 * S, banks=2),
    Model("hdl64e-s2", 0x21, 48000, 6000 * (S // 4) + np.array([0, 1260, 2460, 3660])[S % 4], banks=2, together=True),
    Model("hdl64e-s3", 0x21, 57600, 7200 * (S // 4) + np.array([0, 1300, 2500, 3700])[S % 4], banks=2,
          together=True))}


def steps_of(model, dual):
    """The step of each block, packet by packet."""
    shared = (2 if model.together else 1) * np.where(dual, 2, 1)
    return np.arange(BLOCKS)[None, :] // shared[:, None]


def draw_flags(model, count, rng):
    flag = np.full((count, BLOCKS), UPPER)
    if model.together:
        flag[:, 1::2] = LOWER
    elif model.banks == 2:
        flag[:, ::4] = LOWER
    wrong = rng.random((count, BLOCKS)) < 0.01
    return np.where(wrong, rng.choice([0xFFEE, LOWER, 0, 0xEEFE], (count, BLOCKS)), flag)


def draw(model, count, rng):
    """Packets of a motor at 1 to 40 Hz that starts anywhere, with something wrong in some of them."""
    packets = np.zeros(count, PACKET)
    steps = rng.uniform(1.0, 40.0, count) * TURN * 1e-9 * model.step_ns
    dual = (rng.random(count) < 0.25) & (model.banks == 1 or model.together)
    azimuth = rng.integers(0, TURN, count)[:, None] + steps_of(model, dual) * steps[:, None]
    azimuth = np.rint(azimuth).astype(int) % TURN
    beyond = rng.random((count, BLOCKS)) < 0.01
    azimuth = np.where(beyond, rng.integers(TURN, 65536, (count, BLOCKS)), azimuth)
    standing = rng.random(count) < 0.01
    azimuth = np.where(standing[:, None], azimuth[:, :1] % TURN, azimuth)
    packets["blocks"]["flag"] = draw_flags(model, count, rng)
    packets["blocks"]["azimuth"] = azimuth
    distance = np.where(rng.random((count, BLOCKS, SLOTS)) < 0.2, 0, rng.integers(0, 65536, (count, BLOCKS, SLOTS)))
    apart = 2 if model.together else 1  # from a block to the one with its other echo
    second = (np.arange(BLOCKS) // apart) % 2 == 1
    again = rng.random(distance.shape) < 0.3
    first_echo = np.roll(distance, apart, axis=1)
    packets["blocks"]["shots"]["distance"] = np.where(again & second[None, :, None], first_echo, distance)
    packets["blocks"]["shots"]["intensity"] = rng.integers(0, 256, distance.shape)
    packets["stamp_us"] = rng.integers(0, 3_600_000_000, count)
    packets["mode"] = np.where(dual, 0x39, rng.choice([0x37, 0x38], count))
    packets["product"] = model.product
    if model.name == "hdl32e":
        old = ~dual & (rng.random(count) < 0.1)  # firmware that does not set the last two bytes
        packets["mode"][old] = packets["product"][old] = 0
    if model.banks == 2:  # bytes of a status
        packets["mode"] = rng.integers(0, 256, count)
        packets["product"] = rng.integers(0, 256, count)
    return packets


def draw_calibration(lasers, rng):
    def some(spread, middle=0.0):
        return np.round(middle + rng.uniform(-spread, spread, lasers), 6)
    two_points = rng.random(lasers) < 0.5
    elevation = np.round(rng.permutation(np.linspace(-0.43, 0.04, lasers)) + rng.uniform(-1e-3, 1e-3, lasers), 7)
    return Lasers(elevation, some(0.15), some(0.3, 1.2), some(0.1, 0.2), some(0.03),
                  np.where(two_points, some(0.3, 1.2), np.nan), np.where(two_points, some(0.3, 1.2), np.nan))


def calibration_text(lasers, rng):
    """In the form of the public ROS driver; the lasers in any order."""
    text = "lasers:\n"
    for j in rng.permutation(len(lasers.elevation)):
        two_points = not np.isnan(lasers.aside[j])
        near = (f", dist_correction_x: {lasers.aside[j]:.6f}, dist_correction_y: {lasers.ahead[j]:.6f}, "
                "two_pt_correction_available: true") if two_points else ""
        text += (f"- {{laser_id: {j}, vert_correction: {lasers.elevation[j]:.7f}, rot_correction: {-lasers.azimuth[j]:.6f}, "
                 f"dist_correction: {lasers.distance[j]:.6f}, vert_offset_correction: {lasers.up[j]:.6f}, "
                 f"horiz_offset_correction: {lasers.left[j]:.6f}{near}}}\n")
    return text + f"num_lasers: {len(lasers.elevation)}\n"


def turn_rates(azimuth, usable, step, step_ns):
    """For each block the turn to the next usable step; else that of the block before; 0 at first."""
    count = len(azimuth)
    rate = np.zeros((count, BLOCKS))
    known = np.zeros((count, BLOCKS), bool)
    for block in range(BLOCKS):
        found = np.zeros(count, bool)
        for after in range(block + 1, BLOCKS):
            takes = usable[:, block] & usable[:, after] & (step[:, after] != step[:, block]) & ~found
            turned = (TURN + azimuth[:, after] - azimuth[:, block]) % TURN
            lasted = np.where(takes, (step[:, after] - step[:, block]) * step_ns, 1)
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


def coordinates(lasers, laser, measured, azimuth):
    """x ahead, y left, z up of beams at `azimuth` (hundredths of a degree)."""
    angle = np.radians(azimuth / 100.0) + lasers.azimuth[laser]
    level, rise = np.cos(lasers.elevation[laser]), np.sin(lasers.elevation[laser])
    far = lasers.distance[laser]
    ahead = aside = measured + far
    near = ~np.isnan(lasers.aside[laser]) & (measured < 25.04)

    def corrected(at_near, least, along):
        share = (np.abs((measured + far) * level * along) - least) / (25.04 - least)
        return np.where(near, measured + at_near + share * (far - at_near), measured + far)
    ahead = corrected(lasers.ahead[laser], 1.93, np.cos(angle))
    aside = corrected(lasers.aside[laser], 2.40, np.sin(angle))
    left, up = lasers.left[laser], lasers.up[laser]
    return (ahead * level * np.cos(angle) + left * np.sin(angle),
            -aside * level * np.sin(angle) + left * np.cos(angle), (ahead + aside) / 2 * rise + up)


def decode(model, lasers, packets):
    blocks = packets["blocks"]
    azimuth = blocks["azimuth"].astype(np.int64)
    bank = (blocks["flag"] == LOWER).astype(int)
    usable = ((blocks["flag"] == UPPER) | ((bank == 1) & (model.banks == 2))) & (azimuth < TURN)
    dual = packets["mode"] == 0x39
    if model.banks == 2:
        repeats = np.all(azimuth[:, ::4] == azimuth[:, 2::4], axis=1)
        dual = repeats & model.together
    step = steps_of(model, dual)
    rate = turn_rates(azimuth, usable, step, model.step_ns)
    distance = blocks["shots"]["distance"].astype(np.int64)
    apart = 2 if model.together else 1
    second = (np.arange(BLOCKS) // apart) % 2 == 1
    other = np.arange(BLOCKS) + np.where(second, -apart, apart)
    paired = dual[:, None] & usable[:, other]
    theirs = distance[:, other, :]
    again = paired[:, :, None] & second[None, :, None] & (theirs == distance)
    farther = paired[:, :, None] & (theirs != 0) & (distance > theirs)
    packet, block, slot = np.nonzero(usable[:, :, None] & (distance > 0) & ~again)
    laser = bank[packet, block] * SLOTS + slot % model.firing
    out = np.zeros(len(packet), SHOT)
    out["packet"] = packet
    out["ring"] = lasers.rings()[laser]
    out["distance"] = distance[packet, block, slot]
    out["intensity"] = blocks["shots"]["intensity"][packet, block, slot]
    out["echo"] = farther[packet, block, slot]
    out["azimuth"] = azimuth[packet, block] + rate[packet, block] * model.slot_ns[slot]
    out["time_us"] = packets["stamp_us"][packet] + (step[packet, block] * model.step_ns + model.slot_ns[slot]) / 1000.0
    out["x"], out["y"], out["z"] = coordinates(lasers, laser, out["distance"] * model.metres, out["azimuth"])
    return out


def differences(ours, theirs):
    if len(ours) != len(theirs):
        return f"{len(theirs)} points, {len(ours)} are right"
    for column in ("packet", "ring", "distance", "intensity", "echo", "azimuth"):
        wrong = int(np.count_nonzero(ours[column] != theirs[column]))
        if wrong:
            return f"{wrong} of {len(ours)} differ in {column}"
    for column, most, unit in (("time_us", 0.001, "us"), ("x", 1e-4, "m"), ("y", 1e-4, "m"), ("z", 1e-4, "m")):
        off = float(np.max(np.abs(ours[column].astype(float) - theirs[column]))) if len(ours) else 0.0
        if not off <= most:
            return f"{column} differs by up to {off} {unit}"
    return None


def compare_data(program, model, count, rng):
    compared = 0
    for begin in range(0, count, 5000):
        packets = draw(model, min(5000, count - begin), rng)
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            lasers, command = model.lasers, [program, model.name]
            if lasers is None:
                lasers = draw_calibration(64, rng)
                file.write(calibration_text(lasers, rng))
                file.flush()
                command.append(file.name)
            answer = subprocess.run(command, input=packets.tobytes(), stdout=subprocess.PIPE, check=True).stdout
        right = decode(model, lasers, packets)
        wrong = differences(right, np.frombuffer(answer, SHOT))
        if wrong:
            return f"packets {begin}..: {wrong}", compared
        compared += len(right)
    return None, compared


def checksum(body):
    total = 0
    for byte in body:
        total ^= byte
    return total


def draw_sentence(rng):
    """A sentence that is right, or wrong in one of several ways."""
    def number(low, high, digits):
        return b"%0*d" % (digits, rng.integers(low, high))
    name = rng.choice([b"GPRMC", b"GNRMC", b"GPGGA", b"gprmc"], p=[0.6, 0.2, 0.1, 0.1])
    time = number(0, 26, 2) + number(0, 62, 2) + number(0, 63, 2) + rng.choice([b"", b".5", b".123456789"])
    date = number(0, 34, 2) + number(0, 14, 2) + number(0, 100, 2)
    fields = [name, time, rng.choice([b"A", b"V"]), b"3707.8", b"N", b"12139.2", b"W", b"010.3", b"188.2", date, b"013.8"]
    if rng.random() < 0.1:
        fields[rng.integers(1, len(fields))] = b""
    if rng.random() < 0.05:
        fields = fields[:rng.integers(1, len(fields))]
    body = b",".join(fields)
    tail = b"*%02X" % checksum(body)
    if rng.random() < 0.1:
        tail = rng.choice([b"*00", b"", b"*", b"*5", b"*zz"])
    return b"$" + body + tail + rng.choice([b"\r\n", b"\n", b""])


def draw_positions(count, rng):
    packets = rng.integers(0, 256, (count, 512), np.uint8)
    for packet in packets:
        text = b"".join(draw_sentence(rng) for _ in range(rng.integers(0, 4)))
        field = np.frombuffer((text + b"\0")[:306], np.uint8)
        packet[206:206 + len(field)] = field
    packets[:, 202] = np.where(rng.random(count) < 0.8, packets[:, 202] % 4, packets[:, 202])
    return packets


def days_from_1970(year, month, day):
    """Of the Gregorian calendar; None where there is no such date."""
    leap = year % 4 == 0 and (year % 100 != 0 or year % 400 == 0)
    lengths = [31, 29 if leap else 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]
    if not 1 <= month <= 12 or not 1 <= day <= lengths[month - 1]:
        return None
    before = sum(366 if y % 4 == 0 and (y % 100 != 0 or y % 400 == 0) else 365 for y in range(1970, year))
    return before + sum(lengths[:month - 1]) + day - 1


def read_time(fields):
    """ns since 1970, or None."""
    if len(fields) < 10 or not fields[1][:6].isdigit() or len(fields[1]) < 6:
        return None
    hour, minute, second = (int(fields[1][i:i + 2]) for i in (0, 2, 4))
    if hour > 23 or minute > 59 or second > 60:
        return None
    fraction = fields[1][7:] if fields[1][6:] else b""
    if len(fields[9]) != 6 or not fields[9].isdigit():
        return None
    day, month, year = (int(fields[9][i:i + 2]) for i in (0, 2, 4))
    days = days_from_1970(year + (1900 if year >= 80 else 2000), month, day)
    if days is None:
        return None
    return (days * 86400 + (hour * 60 + minute) * 60 + second) * 10**9 + int(fraction.ljust(9, b"0") or b"0")


def read_nmea(text):
    """(fault, utc_ns, locked); faults: 0 none, 1 no sentence, 2 no checksum, 3 a wrong one, 4 no time."""
    result = (1, 0, 0)
    for line in text.split(b"$")[1:]:
        if not line.startswith((b"GPRMC,", b"GNRMC,")):
            continue
        line = line.split(b"\r")[0].split(b"\n")[0]
        body, star, tail = line.partition(b"*")
        told = tail[:2]
        if not star or len(told) < 2 or any(c not in b"0123456789abcdefABCDEF" for c in told):
            result = (2, 0, 0)
            continue
        if int(told, 16) != checksum(body):
            result = (3, 0, 0)
            continue
        fields = body.split(b",")
        utc_ns = read_time(fields)
        result = (4, 0, 0) if utc_ns is None else (0, utc_ns, int(fields[2] == b"A"))
    return result


def decode_positions(packets):
    def twelve_bits(at):
        value = (packets[:, at].astype(int) + 256 * packets[:, at + 1]) & 0xFFF
        return np.where(value >= 0x800, value - 0x1000, value)
    out = np.zeros(len(packets), FIX)
    for unit in range(3):
        at = 14 + 8 * unit
        out["gyro"][:, unit] = np.radians(0.09766 * twelve_bits(at))
        out["temperature"][:, unit] = 0.1453 * twelve_bits(at + 2) + 25.0
        out["ax"][:, unit] = 0.001221 * 9.80665 * twelve_bits(at + 4)
        out["ay"][:, unit] = 0.001221 * 9.80665 * twelve_bits(at + 6)
    out["stamp_us"] = packets[:, 198:202].copy().view("<u4")[:, 0]
    out["pps"] = np.where(packets[:, 202] <= 3, packets[:, 202], 0)
    for i, packet in enumerate(packets):
        out["fault"][i], out["utc_ns"][i], out["locked"][i] = read_nmea(packet[206:].tobytes().split(b"\0")[0])
    return out


def compare_positions(program, count, rng):
    for begin in range(0, count, 5000):
        packets = draw_positions(min(5000, count - begin), rng)
        answer = subprocess.run([program, "position"], input=packets.tobytes(), stdout=subprocess.PIPE, check=True).stdout
        right, ours = decode_positions(packets), np.frombuffer(answer, FIX)
        if len(right) != len(ours):
            return f"packets {begin}..: {len(ours)} fixes", begin
        for column in FIX.names:
            wrong = ~np.isclose(right[column], ours[column], rtol=1e-12, atol=0) if right[column].dtype.kind == "f" \
                else right[column] != ours[column]
            if np.any(wrong):
                return f"packets {begin}..: {np.count_nonzero(wrong)} differ in {column}", begin
    return None, count


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 2_000
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    failed = False
    for what in sys.argv[4:] or [*MODELS, "position"]:
        rng = np.random.default_rng(seed)
        if what == "position":
            wrong, compared = compare_positions(program, count, rng)
        else:
            wrong, compared = compare_data(program, MODELS[what], count, rng)
        print(f"{what}: {count} packets, {compared} compared: {wrong or 'no difference'}", flush=True)
        failed |= wrong is not None
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
