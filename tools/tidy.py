#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over the sources that changed, several at once.

    tools/tidy.py --build DIR [--jobs N] [--all | --since REVISION]

DIR holds compile_commands.json. Tests and benchmarks are not looked at (.clang-tidy says why). "Changed" is
against REVISION: by default where this branch left main, on main itself the last commit. A changed header is looked at
through the source beside it, or else through the first that includes it. A source that passed is not looked at again
until it, a header of ours that it includes, its compile command or .clang-tidy changes; DIR/passed remembers that.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIDY = "clang-tidy-16"
OWN_INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def git(*arguments):
    """What git prints, or None where it fails (no repository, no such revision)."""
    run = subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)
    return run.stdout.strip() if run.returncode == 0 else None


def base_revision():
    """Where this branch left main; the parent commit on main itself; None where neither exists."""
    head = git("rev-parse", "HEAD")
    for main in ("origin/main", "main"):
        base = git("merge-base", "HEAD", main)
        if base and base != head:
            return base
    return git("rev-parse", "--verify", "HEAD~1")


def changed_files(base):
    """Paths that differ from `base`, committed or not; None where there is nothing to compare with."""
    if not base:
        return None
    listed = (git("diff", "--name-only", base), git("ls-files", "--others", "--exclude-standard"))
    return None if None in listed else set("\n".join(listed).splitlines())


def own_files(source, seen=None):
    """The source and all headers of ours behind it, as paths relative to the root."""
    seen = set() if seen is None else seen
    if source not in seen and (ROOT / source).is_file():
        seen.add(source)
        for header in OWN_INCLUDE.findall((ROOT / source).read_text(encoding="utf-8")):
            own_files(header, seen)
    return seen


def is_test(source):
    """Tests, and what only tests use."""
    name = pathlib.PurePath(source).name
    return name.endswith("_test.cpp") or name.startswith("test_")


def compile_commands(build):
    """{source relative to the root: its command} for the sources of the library and the program."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    commands = {os.path.relpath(entry["file"], ROOT): entry["command"] for entry in entries}
    return {source: command for source, command in sorted(commands.items())
            if source.startswith(("verge/", "apps/")) and not is_test(source)}


def fingerprint(source, command):
    """Names everything of ours that clang-tidy's answer depends on."""
    digest = hashlib.sha256(f"{TIDY}\0{command}\0".encode())
    for path in [".clang-tidy", *sorted(own_files(source))]:
        digest.update(path.encode() + b"\0" + (ROOT / path).read_bytes() + b"\0")
    return digest.hexdigest()


def tidy(build, source):
    """clang-tidy's findings on one source; empty if it passes."""
    run = subprocess.run([TIDY, "-p", build, "--quiet", ROOT / source], capture_output=True, text=True, check=False)
    return "" if run.returncode == 0 else run.stdout + run.stderr


def source_of(path, sources):
    """The source through which clang-tidy sees a changed file, or None."""
    beside = str(pathlib.PurePath(path).with_suffix(".cpp"))
    if beside in sources or not path.endswith(".hpp"):
        return beside if beside in sources else None
    return next((source for source in sources if path in own_files(source)), None)


def chosen_sources(commands, options):
    """The sources to look at, and the words that say which these are."""
    base = options.since or base_revision()
    changed = None if options.all else changed_files(base)
    if changed is None:
        return list(commands), "all sources"
    sources = {source_of(path, commands) for path in changed} - {None}
    return sorted(sources), f"sources that changed since {base[:10]}"


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--since")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    commands = compile_commands(options.build)
    sources, words = chosen_sources(commands, options)
    memory = options.build / "passed"
    memory.mkdir(exist_ok=True)
    marks = {source: memory / fingerprint(source, commands[source]) for source in sources}
    waiting = [source for source in sources if not marks[source].exists()]
    print(f"{words}: {len(sources)}, of which {len(sources) - len(waiting)} passed before")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for source, findings in zip(waiting, pool.map(lambda source: tidy(options.build, source), waiting)):
            if findings:
                failed += 1
                print(f"{source}:\n{findings}")
            else:
                marks[source].touch()
    print(f"{len(waiting)} looked at, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
