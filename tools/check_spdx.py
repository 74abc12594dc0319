#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that every file of the repository that can hold a comment begins with the two licence lines.

    tools/check_spdx.py [ROOT]

The lines stand first, or right after "#!" in a script. Texts (*.md), JSON, the licence itself and inputs
that fuzzing found are free of them.
"""

import pathlib
import subprocess
import sys

HEADER = ("SPDX-FileCopyrightText: The verge authors", "SPDX-License-Identifier: Apache-2.0")
MARKS = ("//", "#", "<!--")
FREE = {".md", ".json", ".png", ".svg"}
# Inputs that broke a reader once, kept byte by byte.
FREE_FOLDER = pathlib.Path("tests/fuzz/regress")


def has_header(text):
    lines = text.splitlines()
    if lines and lines[0].startswith("#!"):
        lines = lines[1:]
    found = [line.removesuffix("-->").strip() for line in lines[:2]]
    return any(found == [f"{mark} {line}" for line in HEADER] for mark in MARKS)


def tracked(root):
    """The repository's files; without git, all files that are not built."""
    git = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                         capture_output=True, check=False)
    if git.returncode == 0:
        names = git.stdout.decode().split("\0")[:-1]
        return sorted(pathlib.Path(name) for name in names if (root / name).is_file())
    found = (path.relative_to(root) for path in root.rglob("*") if path.is_file())
    return sorted(path for path in found if path.parts[0] not in ("build", "verge-demo"))


def check(root):
    """The files that lack the header, and how many were read."""
    files = [path for path in tracked(root)
             if path.suffix not in FREE and path.name != "LICENSE" and FREE_FOLDER not in path.parents]
    return [path for path in files if not has_header((root / path).read_text(encoding="utf-8"))], len(files)


def main(arguments):
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    bare, files = check(root)
    for path in bare:
        print(f"{path}:1: the two SPDX lines are missing")
    print(f"{files} files, {len(bare)} without licence lines")
    return 1 if bare or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
