#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the rooms keep to the arrows of cmake/arrows.txt.

    tools/check_includes.py [ROOT]

For each C++ file: every #include "..." starts at the root, goes along an arrow, to a file that exists, and from outside a
room only to the headers that the room makes public (HEADERS in its CMakeLists.txt); tests and bench may look behind. For each file of the library: it neither prints
nor ends the program, and public headers show no heavy outside library. For each room's CMakeLists.txt: DEPENDS goes
along arrows and covers every room that the room's files include.
Prints one line per breach, as FILE:LINE: WHAT; exit code 1 if there is one.
"""

import pathlib
import re
import sys
from dataclasses import dataclass, field

LIBRARY = "verge"
OUTSIDE = ("apps", "tests", "bench", "examples")
LOOK_BEHIND = ("tests", "bench")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
HEAVY = re.compile(r"^(CLI/|toml\+\+/|nlohmann/json\.hpp|Eigen/|unsupported/Eigen/|cairo|embree|opencv2/|tbb/|oneapi/)")
PRINTING_HEADER = re.compile(r"^(iostream|print|syncstream)$")
PRINTING = re.compile(
    r"\b(?:(?:std::)?(?:cout|cerr|clog)\b"
    r"|(?:std::|fmt::)?v?f?print(?:f|ln)?\s*\((?!\s*const\b)"
    r"|(?:std::)?(?:puts|fputs|putchar|perror)\s*\()")
EXITING = re.compile(r"\b(?:std::)?(?:_?exit|quick_exit|_Exit|abort|terminate)\s*\(")
COMMENTS_AND_STRINGS = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)
ROOM_CALL = re.compile(r"verge_room\(\s*(\w+)(.*?)\)", re.DOTALL)
KEYWORDS = ("SOURCES", "HEADERS", "DEPENDS", "PUBLIC", "PRIVATE", "TESTS")


@dataclass
class Arrows:
    """What each room may include: `allowed` is transitively closed and without the room itself; None means all."""

    allowed: dict = field(default_factory=dict)
    never: dict = field(default_factory=dict)

    def permits(self, room, target):
        if room == target:
            return True
        rooms = self.allowed[room]
        return (rooms is None or target in rooms) and target not in self.never.get(room, ())


def parse_arrows(text):
    """The table as written in cmake/arrows.txt, closed over its arrows. ValueError names a bad line."""
    direct, arrows = {}, Arrows()
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        match = re.fullmatch(r"(\w+)\s+(->|never)\s*([\w* ]*)", line)
        if not match:
            raise ValueError(f"line {number}: not an arrow: {line}")
        room, verb, targets = match[1], match[2], match[3].split()
        if verb == "never":
            arrows.never.setdefault(room, set()).update(targets)
        else:
            direct[room] = targets
    for room in direct:
        arrows.allowed[room] = None if direct[room] == ["*"] else closure(direct, room)
    return arrows


def closure(direct, room):
    """All rooms behind the room's arrows. ValueError where the arrows form a cycle or name an unknown room."""
    found, waiting = set(), list(direct[room])
    while waiting:
        target = waiting.pop()
        if target == room:
            raise ValueError(f"the arrows of {room} lead back to it")
        if target not in direct:
            raise ValueError(f"{room} -> {target}: no such room")
        if target not in found:
            found.add(target)
            waiting.extend(direct[target])
    return found


def room_of(path):
    """(room, folder inside it or None) of a path relative to the root."""
    parts = path.parts
    if parts[0] != LIBRARY:
        return parts[0], None
    return parts[1], (parts[2] if len(parts) > 3 else None)


def includes_of(text):
    """(line number, quote character, path) of every include directive."""
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1], match[2]


def code_only(text):
    """The text with comments and literals blanked out, its lines kept."""
    return COMMENTS_AND_STRINGS.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def check_arrow(arrows, path, target):
    """What is wrong with `path` including "target", or None."""
    own = path.parts[0]
    known = (LIBRARY, own, "apps") if own in LOOK_BEHIND else (LIBRARY, own)
    if not target.startswith(tuple(f"{folder}/" for folder in known)):
        return f'include from the root of the repository: "verge/...", not "{target}"'
    room, folder = room_of(path)
    target_room, target_folder = room_of(pathlib.PurePath(target))
    if target_room not in arrows.allowed:
        return f'"{target}": no such room in cmake/arrows.txt'
    if not arrows.permits(room, target_room):
        return f'"{target}": there is no arrow {room} -> {target_room}'
    if folder and target_room == room and target_folder not in (None, folder):
        return f'"{target}": {room}/{folder} must not use {room}/{target_folder}; move what both need down a room'
    return None


def check_library_code(path, text, is_public):
    """Breaches of: the library never prints and never exits; public headers show no heavy library."""
    is_test = path.stem.endswith("_test")
    for number, quote, target in includes_of(text):
        if quote == "<" and PRINTING_HEADER.match(target) and not is_test:
            yield number, f"<{target}>: the library never prints"
        if quote == "<" and is_public and HEAVY.match(target):
            yield number, f"<{target}>: heavy, include it in a .cpp file"
    if is_test:
        return
    for number, line in enumerate(code_only(text).splitlines(), 1):
        if match := PRINTING.search(line):
            yield number, f"'{match[0].strip()}': the library never prints"
        if match := EXITING.search(line):
            yield number, f"'{match[0].strip()}': the library never ends the program"


def check_file(root, arrows, public, path):
    """(line, what) of each breach in one C++ file; `path` is relative to `root`, `public` names the public headers."""
    text = (root / path).read_text(encoding="utf-8")
    room, _ = room_of(path)
    if room not in arrows.allowed:
        yield 1, f"no such room in cmake/arrows.txt: {room}"
        return
    for number, quote, target in includes_of(text):
        if quote != '"':
            continue
        if problem := check_arrow(arrows, path, target):
            yield number, problem
        elif not (root / target).is_file():
            yield number, f'"{target}": no such file'
        elif room not in (*LOOK_BEHIND, room_of(pathlib.PurePath(target))[0]) and target not in public:
            yield number, f'"{target}": not among the HEADERS of its room'
    if path.parts[0] == LIBRARY:
        yield from check_library_code(path, text, str(path) in public)


def parse_rooms(text):
    """{room: {keyword: words}} of each verge_room() call."""
    rooms = {}
    for name, body in ROOM_CALL.findall(re.sub(r"#[^\n]*", "", text)):
        keyword, words = None, {keyword: [] for keyword in KEYWORDS}
        for word in body.split():
            if word in KEYWORDS:
                keyword = word
            elif keyword:
                words[keyword].append(word)
        rooms[name] = words
    return rooms


def declared_rooms(root):
    """{room: {keyword: words}} of every room under verge/."""
    rooms = {}
    for file in sorted((root / LIBRARY).glob("*/CMakeLists.txt")):
        rooms.update(parse_rooms(file.read_text(encoding="utf-8")))
    return rooms


def public_headers(rooms):
    """The paths of all headers that rooms make public, relative to the root."""
    return {f"{LIBRARY}/{room}/{header}" for room, words in rooms.items() for header in words["HEADERS"]}


def included_rooms(root, room):
    """{other room: first file that includes it} over the room's files."""
    found = {}
    for path in cpp_files(root, f"{LIBRARY}/{room}"):
        for _, quote, target in includes_of((root / path).read_text(encoding="utf-8")):
            if quote == '"' and target.startswith(f"{LIBRARY}/"):
                found.setdefault(room_of(pathlib.PurePath(target))[0], path)
    found.pop(room, None)
    return found


def check_cmake(root, arrows, rooms):
    """(file, what) of each room whose DEPENDS and includes disagree, or whose DEPENDS breaks an arrow."""
    depends = {room: words["DEPENDS"] for room, words in rooms.items()}
    for room, targets in depends.items():
        path = pathlib.PurePath(LIBRARY, room, "CMakeLists.txt")
        for target in targets:
            if room in arrows.allowed and not arrows.permits(room, target):
                yield path, f"DEPENDS {target}: there is no arrow {room} -> {target}"
        reachable = behind(depends, targets)
        for target, user in included_rooms(root, room).items():
            if target not in reachable:
                yield path, f"DEPENDS lacks {target}, which {user} includes"


def behind(depends, rooms):
    """The rooms and all that they depend on."""
    found, waiting = set(), list(rooms)
    while waiting:
        room = waiting.pop()
        if room not in found:
            found.add(room)
            waiting.extend(depends.get(room, ()))
    return found


def cpp_files(root, *folders):
    paths = (path for folder in folders for path in (root / folder).rglob("*.?pp"))
    return sorted(path.relative_to(root) for path in paths if path.suffix in (".hpp", ".cpp"))


def check(root):
    """All breaches below `root`, as printable lines, and the number of files that were read."""
    arrows = parse_arrows((root / "cmake/arrows.txt").read_text(encoding="utf-8"))
    rooms = declared_rooms(root)
    public = public_headers(rooms)
    files = cpp_files(root, LIBRARY, *OUTSIDE)
    breaches = [f"{path}:{line}: {what}" for path in files for line, what in check_file(root, arrows, public, path)]
    breaches += [f"{path}:1: {what}" for path, what in check_cmake(root, arrows, rooms)]
    return breaches, len(files)


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    breaches, files = check(root)
    for line in breaches:
        print(line)
    print(f"{files} files, {len(breaches)} breaches")
    return 1 if breaches or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
