#!/usr/bin/env python3
# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that README.md tells the truth.

    tools/check_readme.py --program PATH_OF_VERGE

Its commands run: the lines of all blocks that begin with ```sh run, in order, in one empty folder. Its library example
is, line for line, the program that tests/consumer builds and runs. Its exit codes are those of `verge detect --help`.
Its links lead to files that exist.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def blocks(text, mark):
    """The contents of the fenced blocks whose first line is ```mark."""
    return re.findall(rf"^```{re.escape(mark)}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def check_commands(text, program):
    script = "".join(blocks(text, "sh run"))
    if not script.strip():
        yield "no command to run"
        return
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(["bash", "-euxo", "pipefail", "-c", script], cwd=folder, env=environment,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if run.returncode != 0:
        yield f"a command failed with {run.returncode}:\n{run.stdout}"


def check_example(text, root=ROOT):
    source = (root / "tests/consumer/main.cpp").read_text(encoding="utf-8")
    without_licence = "".join(source.splitlines(keepends=True)[2:])
    if blocks(text, "cpp") != [without_licence]:
        yield "the C++ block is not tests/consumer/main.cpp without its licence lines"


def check_exit_codes(text, program):
    told = set(re.findall(r"^\| (\d+) \|", text, re.MULTILINE))
    help_text = subprocess.run([program, "detect", "--help"], capture_output=True, text=True, check=True).stdout
    section = help_text[help_text.index("Exit codes"):]
    real = set(re.findall(r"\b\d+\b", " ".join(re.findall(r"^ *(\d+(?:, \d+)*) ", section, re.MULTILINE))))
    if told != real:
        yield f"the exit codes are {sorted(told)}, those of the program {sorted(real)}"


def check_links(text, root=ROOT):
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
        if not (root / target).exists():
            yield f"the link to {target} leads nowhere"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=lambda path: pathlib.Path(path).resolve(), required=True)
    program = parser.parse_args(arguments).program
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    problems = [*check_commands(text, program), *check_example(text), *check_exit_codes(text, program),
                *check_links(text)]
    for problem in problems:
        print(f"README.md: {problem}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
