#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""An independent decoder of ibeo messages, and its comparison with verge's.

    ibeo_decoder.py --program ibeo_columns [--scans 1000] [--messages 300] [--seed 1]

Written only from the tables in docs/formats_ibeo.md. Draws random scans of both kinds of scanner and random messages of
the other types, good and bad, writes them as a recording, decodes it here and there, and counts the scans and messages
that differ in any bit: 0 is right.
"""

import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

LUX_POINT = np.dtype([("layer_echo", "u1"), ("flags", "u1"), ("angle", "<i2"), ("range", "<u2"), ("width", "<u2"),
                      ("reserved", "<u2")])
ALASCA_POINT = np.dtype([("scanner", "u1"), ("layer", "u1"), ("echo", "u1"), ("status", "u1"), ("x", ">i2"),
                         ("y", ">i2"), ("z", ">i2"), ("width", ">u2")])
COLUMNS = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<i8"), ("echo", "u1"), ("flags", "<u4"),
           ("width", "<f4"), ("time", "<f8")]
OBJECT = np.dtype([("id", "<u2"), ("age", "<u2"), ("prediction_age", "<u2"), ("relative_time", "<u2"),
                   ("reference", "<i2", 2), ("reference_sigma", "<u2", 2), ("closest", "<i2", 2),
                   ("bounding_centre", "<i2", 2), ("bounding_width", "<u2"), ("bounding_length", "<u2"),
                   ("centre", "<i2", 2), ("size", "<u2", 2), ("orientation", "<i2"), ("velocity", "<i2", 2),
                   ("velocity_sigma", "<u2", 2), ("relative_velocity", "<i2", 2), ("class", "<u2"),
                   ("class_age", "<u2"), ("certainty", "<u2"), ("contour", "<u2")])
VEHICLE = np.dtype([("ntp", "<u8"), ("scan", "<u2"), ("errors", "<u2"), ("velocity", "<i2"), ("steering", "<i2"),
                    ("front_wheel", "<i2"), ("reserved_1", "<u2"), ("x", "<i4"), ("y", "<i4"), ("course", "<i2"),
                    ("milliseconds", "<u2"), ("driven_x", "<i2"), ("driven_y", "<i2"), ("turned", "<i2"),
                    ("reserved_2", "<u2"), ("yaw_rate", "<i2"), ("reserved_3", "<u4")])
INDEX_ENTRY = np.dtype([("offset", ">u8"), ("milliseconds", ">u8"), ("device", "u1")])
INDEX_TRIGGER = np.dtype([("type", ">u2"), ("device", "u1")])
UNKNOWN_CONTOUR = 0xFFFF
UNIX_EPOCH_IN_NTP = 2208988800
ELEVATION = [degrees * (math.pi / 180.0) for degrees in (-1.2, -0.4, 0.4, 1.2)]


# --- decoding: a scan is (stamp or None, columns by name), or None where the message is damaged ---------------------

def nearest(value):
    """The nearest integer, halves away from 0; value >= 0."""
    whole = math.floor(value)
    return whole + (1 if value - whole >= 0.5 else 0)


def unix_ns(ntp):
    seconds, fraction = ntp >> 32, ntp & 0xFFFFFFFF
    if seconds < UNIX_EPOCH_IN_NTP:
        return None
    return (seconds - UNIX_EPOCH_IN_NTP) * 10**9 + (fraction * 10**9 + 2**31 >> 32)


def lux_scan(body):
    if len(body) < 44:
        return None
    start, end = (int.from_bytes(body[at:at + 8], "little") for at in (6, 14))
    ticks, = np.frombuffer(body, "<u2", 1, 22)
    first, last = (int(np.frombuffer(body, "<i2", 1, at)[0]) for at in (24, 26))
    count = int.from_bytes(body[28:30], "little")
    if len(body) != 44 + 10 * count or ticks == 0 or end < start:
        return None
    points = np.frombuffer(body, LUX_POINT, count, 44)
    layer, echo = points["layer_echo"] & 15, points["layer_echo"] >> 4
    used = (layer < 4) & (echo <= 3) & (points["range"] > 0)
    points, layer, echo = points[used], layer[used], echo[used]

    turn = [2.0 * math.pi * int(angle) / int(ticks) for angle in points["angle"]]
    up = [ELEVATION[k] for k in layer]
    metres = points["range"].astype("f8") * 0.01
    cos_up, sin_up = np.array([math.cos(a) for a in up]), np.array([math.sin(a) for a in up])
    cos_turn, sin_turn = np.array([math.cos(a) for a in turn]), np.array([math.sin(a) for a in turn])
    out = {"x": metres * cos_up * cos_turn, "y": metres * cos_up * sin_turn, "z": metres * sin_up,
           "ring": layer, "echo": echo, "flags": points["flags"], "width": points["width"].astype("f8") * 0.01}

    duration = float(end - start) / 2.0**32
    if first == last:
        time = np.zeros(len(points))
    else:
        share = (first - points["angle"].astype("i8")).astype("f8") / (first - last)
        time = duration * (np.clip(share, 0.0, 1.0) + 0.0)  # never -0
    earliest = float(time.min()) if len(time) else 0.0
    out["time"] = time - earliest
    stamp = unix_ns(start)
    return None if stamp is None else stamp + nearest(earliest * 1e9), out


def metres_of_code(code):
    code = code.astype("f8")
    return np.where(code > 10000, 0.1 * code - 900.0, np.where(code < -10000, 0.1 * code + 900.0, 0.01 * code))


def alasca_scan(body):
    if len(body) < 16:
        return None
    count = int.from_bytes(body[14:16], "big")
    if count > 8648 or len(body) != 16 + 12 * count:
        return None
    points = np.frombuffer(body, ALASCA_POINT, count, 16)
    nowhere = (points["x"] == 0) & (points["y"] == 0) & (points["z"] == 0)
    points = points[(points["layer"] < 4) & (points["echo"] <= 3) & (points["status"] != 1) & ~nowhere]
    out = {axis: metres_of_code(points[axis]) for axis in "xyz"}
    out |= {"ring": points["layer"], "echo": points["echo"], "flags": points["status"], "width": points["width"]}
    return None, out | {"time": np.zeros(0)}


# --- decoding: other messages are lists of their fields, or None where the message is damaged -----------------------

def fields_of(records):
    """The numbers of structured records, one after the other."""
    return [int(number) for record in records for value in record.tolist() for number in np.atleast_1d(value)]


def object_list(body, unknown):
    """With `unknown` points where the number is not known."""
    count, at, fields = int.from_bytes(body[8:10], "little"), 10, []
    for _ in range(count):
        if len(body) - at < OBJECT.itemsize:
            return None
        record, = np.frombuffer(body, OBJECT, 1, at)
        at += OBJECT.itemsize
        points = unknown if record["contour"] == UNKNOWN_CONTOUR else int(record["contour"])
        if len(body) - at < 4 * points:
            return None
        fields += fields_of([record])[:-1] + [points] + np.frombuffer(body, "<i2", 2 * points, at).tolist()
        at += 4 * points
    return [int.from_bytes(body[:8], "little"), count] + fields if at == len(body) else None


def objects(body, at):
    if len(body) < 10:
        return None
    without = object_list(body, 0)
    return without if without is not None else object_list(body, 1)


def health(body, at):
    return np.frombuffer(body, "<u2").tolist() if len(body) == 16 else None


def vehicle_state(body, at):
    return fields_of(np.frombuffer(body, VEHICLE)) if len(body) == VEHICLE.itemsize else None


def frame_index(body, at):
    """at: where the body stands in the file."""
    if len(body) < 128:
        return None
    frames, offset_ms = np.frombuffer(body, ">u8", 2, 19).tolist()
    triggers = int.from_bytes(body[36:38], "big")
    if triggers > 30 or frames > (len(body) - 128) // INDEX_ENTRY.itemsize:
        return None
    entries = np.frombuffer(body, INDEX_ENTRY, frames, 128)
    if np.any(entries["offset"] >= at):
        return None
    name = body[2:19].rstrip(b"\0")
    return ([body[0], body[1], len(name), *name, frames, offset_ms, int(body[35] != 0), triggers]
            + fields_of(np.frombuffer(body, INDEX_TRIGGER, triggers, 38)) + fields_of(entries))


# --- drawing -------------------------------------------------------------------------------------------------------

def draw_lux(random):
    count = int(random.integers(0, 60))
    points = np.zeros(count, LUX_POINT)
    rare = random.random(count) < 0.05
    layer = np.where(rare, random.integers(0, 16, count), random.integers(0, 4, count))
    echo = np.where(random.random(count) < 0.05, random.integers(0, 16, count), random.integers(0, 4, count))
    points["layer_echo"] = layer | echo << 4
    points["flags"] = random.integers(0, 256, count)
    points["angle"] = random.integers(-32768, 32768, count) if random.random() < 0.2 else random.integers(-1920, 1601, count)
    points["range"] = np.where(random.random(count) < 0.1, 0, random.integers(0, 65536, count))
    points["width"] = random.integers(0, 65536, count)
    points["reserved"] = random.integers(0, 65536, count)
    start = int(random.integers(0, 2**64, dtype="u8")) if random.random() < 0.5 else int(random.integers(0, 2**40))
    end = max(0, min(2**64 - 1, start + int(random.integers(-2**20, 2**34))))
    ticks = 11520 if random.random() < 0.7 else int(random.integers(0, 65536))
    first, last = (1600, -1600) if random.random() < 0.7 else (int(a) for a in random.integers(-32768, 32768, 2))
    if random.random() < 0.02:
        last = first
    said = count if random.random() < 0.98 else int(random.integers(0, 65536))
    header = random.bytes(6) + start.to_bytes(8, "little") + end.to_bytes(8, "little")
    header += ticks.to_bytes(2, "little") + first.to_bytes(2, "little", signed=True)
    header += last.to_bytes(2, "little", signed=True) + said.to_bytes(2, "little")
    flags = int(random.integers(0, 65536))
    body = header + random.bytes(12) + flags.to_bytes(2, "little") + points.tobytes()
    head = bytes.fromhex("AFFEC0C2") + bytes(4) + len(body).to_bytes(4, "big") + bytes(2) + bytes.fromhex("2202")
    return head + start.to_bytes(8, "big"), body


def draw_alasca(random):
    count = int(random.integers(0, 60))
    points = np.zeros(count, ALASCA_POINT)
    points["scanner"] = random.integers(0, 256, count)
    points["layer"] = random.integers(0, 5, count)
    points["echo"] = random.integers(0, 5, count)
    points["status"] = random.integers(0, 6, count)
    for axis in "xyz":
        small = random.integers(-2, 3, count)
        points[axis] = np.where(random.random(count) < 0.4, small, random.integers(-32768, 32768, count))
    points["width"] = random.integers(0, 65536, count)
    said = count if random.random() < 0.98 else int(random.integers(0, 65536))
    body = random.bytes(14) + said.to_bytes(2, "big") + points.tobytes()
    return bytes.fromhex("AFFEC0C0") + len(body).to_bytes(4, "big") + (15).to_bytes(4, "big") + random.bytes(4), body


def draw_objects(random):
    fate, body, count = random.random(), b"", int(random.integers(0, 6))
    unknown = int(random.integers(0, 2))  # how this sensor means a number of points that is not known
    for _ in range(count):
        record = np.frombuffer(random.bytes(OBJECT.itemsize), OBJECT).copy()
        points = int(random.integers(0, 5))
        if random.random() < 0.3:
            points, record["contour"] = unknown, UNKNOWN_CONTOUR
        else:
            record["contour"] = points
        body += record.tobytes() + random.bytes(4 * points)
    if fate < 0.05:
        body = body[:int(random.integers(0, len(body) + 1))]
    said = int(random.integers(0, 65536)) if 0.05 <= fate < 0.08 else count
    return random.bytes(8) + said.to_bytes(2, "little") + body


def draw_health(random):
    return random.bytes(16 if random.random() < 0.95 else int(random.integers(0, 40)))


def draw_vehicle_state(random):
    return random.bytes(46 if random.random() < 0.95 else int(random.integers(0, 60)))


def draw_frame_index(random):
    frames, triggers = int(random.integers(0, 8)), int(random.integers(0, 31))
    said_frames = frames if random.random() < 0.97 else int(random.integers(0, 2**64, dtype="u8"))
    said_triggers = triggers if random.random() < 0.97 else int(random.integers(0, 65536))
    entries = np.frombuffer(random.bytes(17 * frames), INDEX_ENTRY).copy()
    entries["offset"] = random.integers(0, 40 if random.random() < 0.97 else 2**62, frames)
    name = random.bytes(int(random.integers(0, 18)))
    return (random.bytes(2) + name.ljust(17, b"\0") + said_frames.to_bytes(8, "big") + random.bytes(8)
            + bytes([int(random.integers(0, 2))]) + said_triggers.to_bytes(2, "big")
            + random.bytes(3 * triggers).ljust(90, b"\0") + entries.tobytes())


MESSAGES = {"objects": (0x2221, draw_objects, objects), "health": (0x2030, draw_health, health),
            "vehicle state": (0x2805, draw_vehicle_state, vehicle_state),
            "frame index": (0x6130, draw_frame_index, frame_index)}


# --- comparing -----------------------------------------------------------------------------------------------------

def decoded_by_program(output):
    """The scans that the program printed, in its own layout."""
    at = 0
    while at < len(output):
        kind, at = output[at:at + 1], at + 1
        if kind == b"E":
            yield None
            continue
        has_stamp, stamp = output[at], int.from_bytes(output[at + 1:at + 9], "little", signed=True)
        points, times = (int(n) for n in np.frombuffer(output, "<u4", 2, at + 9))
        at += 17
        columns = {}
        for name, kind in COLUMNS:
            count = times if name == "time" else points
            columns[name] = np.frombuffer(output, kind, count, at)
            at += count * np.dtype(kind).itemsize
        yield (stamp if has_stamp else None), columns


def differences(ours, theirs):
    """Names of what differs in a scan."""
    if ours is None or theirs is None:
        return [] if ours is theirs else ["damaged"]
    names = [] if ours[0] == theirs[0] else ["stamp"]
    for name, kind in COLUMNS:
        if ours[1][name].astype(kind).tobytes() != theirs[1][name].tobytes():
            names.append(name)
    return names


def compare(program, kind, scans, seed):
    """Number of scans that differ."""
    random = np.random.default_rng(seed)
    draw, decode = (draw_lux, lux_scan) if kind == "lux" else (draw_alasca, alasca_scan)
    drawn = [draw(random) for _ in range(scans)]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "scans.bin"
        path.write_bytes(b"".join(head + body for head, body in drawn))
        output = subprocess.run([program, kind, path], check=True, stdout=subprocess.PIPE).stdout
    theirs = list(decoded_by_program(output))
    wrong, points, damaged = abs(len(theirs) - scans), 0, 0
    for number, ((_, body), their) in enumerate(zip(drawn, theirs)):
        ours = decode(body)
        points += 0 if ours is None else len(ours[1]["x"])
        damaged += ours is None
        names = differences(ours, their)
        if names and wrong < 10:
            print(f"{kind}: scan {number} differs in {', '.join(names)}")
        wrong += bool(names)
    print(f"{kind}: {scans} scans ({damaged} of them damaged), {points} points, {wrong} scans differ")
    return wrong


def fields_by_program(output):
    """The fields of each message that the program printed; None where it was damaged."""
    at = 0
    while at < len(output):
        kind, at = output[at:at + 1], at + 1
        if kind == b"E":
            yield None
            continue
        count, = np.frombuffer(output, "<u4", 1, at)
        yield output[at + 4:at + 4 + 8 * int(count)]
        at += 4 + 8 * int(count)


def compare_messages(program, kind, count, seed):
    """Number of messages that differ."""
    random = np.random.default_rng(seed)
    number, draw, decode = MESSAGES[kind]
    chunks, ours, at = [], [], 0
    for _ in range(count):
        body = draw(random)
        chunks += [bytes.fromhex("AFFEC0C2") + bytes(4) + len(body).to_bytes(4, "big") + bytes(2)
                   + number.to_bytes(2, "big") + random.bytes(8), body]
        ours.append(decode(body, at + 24))
        at += 24 + len(body)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "messages.bin"
        path.write_bytes(b"".join(chunks))
        output = subprocess.run([program, "messages", path], check=True, stdout=subprocess.PIPE).stdout
    theirs = list(fields_by_program(output))
    ours = [None if f is None else b"".join((v % 2**64).to_bytes(8, "little") for v in f) for f in ours]
    wrong = abs(len(theirs) - count) + sum(a != b for a, b in zip(ours, theirs))
    fields = sum(len(f) // 8 for f in ours if f is not None)
    print(f"{kind}: {count} messages ({ours.count(None)} of them damaged), {fields} fields, {wrong} messages differ")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="the built ibeo_columns")
    parser.add_argument("--scans", type=int, default=1000, help="of each kind")
    parser.add_argument("--messages", type=int, default=300, help="of each other type")
    parser.add_argument("--seed", type=int, default=20261122)
    options = parser.parse_args()
    wrong = sum(compare(options.program, kind, options.scans, options.seed) for kind in ("lux", "alasca"))
    wrong += sum(compare_messages(options.program, kind, options.messages, options.seed) for kind in MESSAGES)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
