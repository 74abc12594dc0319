# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Suites: their tables, reports and parts, and that a run goes on where another stopped."""

import csv
import html.parser
import json
import pathlib
import shutil
import signal
import tempfile
import time
import unittest

from verge_cli import CliTest, run, start

SMALL = ("evaluate", "--suite", "paper3", "--drives", "1", "--scans", "1", "--method", "gradient")
VOID = {"meta", "img", "br", "circle", "rect", "line", "path"}


class Page(html.parser.HTMLParser):
    """What is open where, and what is asked of other places."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.loads, self.images, self.titles = [], [], [], [], 0
        self.feed(text)
        self.close()
        self.faults += self.open

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag in ("script", "link", "iframe", "object"):
            self.faults.append(tag)
        self.titles += tag == "title"
        for name in ("src", "href", "data", "xlink:href"):
            if name in attributes:
                self.loads.append(attributes[name])
        if tag == "img":
            self.images.append(attributes.get("alt", ""))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)


class Report(CliTest):
    """One run, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.home = pathlib.Path(tempfile.mkdtemp(prefix="verge_suite_"))
        cls.addClassCleanup(shutil.rmtree, cls.home, ignore_errors=True)
        cls.out = cls.home / "out"
        cls.result = run(*SMALL, "--no-times", "-o", cls.out)

    def test_its_table_its_figures_and_its_parts_are_written(self):
        self.check_ok(self.result)
        table = self.result.stdout.decode()
        self.assertRegex(table, r"(?m)^straight +gradient +1 ")
        self.assertRegex(table, r"(?m)^corner +paper 3, printed: LDA +- +0\.738")
        self.assertNotIn("median_ms", table)
        figures = json.loads((self.out / "results.json").read_text())
        self.assertEqual([cell["cell"] for cell in figures["cells"]], ["670 frames", "straight", "corner"])
        cell = figures["cells"][0]["methods"][0]["boundaries"]["tolerance"][0]
        self.assertIn("occluded_recall", cell)
        self.assertEqual(cell["macro_f1"], cell["f1"])  # of one scan
        rows = list(csv.DictReader((self.out / "results.csv").read_text().splitlines()))
        self.assertEqual(rows[0]["scans"], "1")
        self.assertEqual(len(list((self.out / "parts").glob("*.json"))), 3)
        self.assertEqual(self.leftovers(self.out), [])

    def test_the_page_is_whole_and_loads_nothing(self):
        text = (self.out / "report.html").read_text()
        page = Page(text)
        self.assertEqual(page.faults, [])
        self.assertTrue(page.loads)
        for target in page.loads:
            self.assertTrue(target.startswith("data:image/png;base64,"), target[:40])
        self.assertNotRegex(text, r"https?://|url\(|@import")
        self.assertTrue(page.images and all(page.images))
        self.assertGreater(page.titles, 1)  # the page's, and each plot's

    def test_what_is_kept_is_taken_and_what_is_damaged_is_made_again(self):
        out = self.folder / "out"
        shutil.copytree(self.out, out)
        part = sorted((out / "parts").glob("*.json"))[0]
        part.write_bytes(part.read_bytes()[:50])
        result = run(*SMALL, "--no-times", "-o", out, "-j", "2", "--progress", "always")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count(b"is damaged, and is made again"), 1)
        self.assertIn(b"1/1 scans", result.stderr)
        self.assertEqual(result.stdout, self.result.stdout)
        for name in ("results.json", "results.csv", "report.html"):
            self.assertEqual((out / name).read_bytes(), (self.out / name).read_bytes(), name)


class Suite(CliTest):
    def test_any_program_is_judged_on_made_drives_by_the_scans_that_are_written(self):
        frames, found = self.folder / "frames", self.folder / "found.jsonl"
        small = ("evaluate", "--suite", "paper3", "--drives", "1", "--scans", "1")
        self.check_ok(run(*small, "--write-scans", frames))
        self.assertEqual(
            sorted(scan.name for scan in (frames / "scans").iterdir()),
            ["670-frames-1-000000.pcd", "corner-1-000000.pcd", "straight-1-000000.pcd"],
        )
        self.check_ok(run("detect", frames / "scans", "-o", found))
        table = self.folder / "table.csv"
        result = run(*small, "--method", "gradient", "--predictions", found, "--csv", table, "--no-times")
        self.check_ok(result)
        rows = {(row["cell"], row["method"]): row for row in csv.DictReader(table.read_text().splitlines())}
        for cell in ("670 frames", "straight", "corner"):
            program, method = rows[cell, "found.jsonl"], rows[cell, "gradient"]
            self.assertAlmostEqual(float(program["f1"]), float(method["f1"]), delta=0.02)
            self.assertEqual(program["success"], method["success"])

    def test_predictions_of_other_scans_are_refused(self):
        other = self.folder / "other.jsonl"
        other.write_text('{"frame": "000000", "boundaries": []}\n')
        result = run("evaluate", "--suite", "paper3", "--drives", "1", "--scans", "1", "--method", "gradient",
                     "--predictions", other)  # fmt: skip
        self.check_refused(result, 4, "none of its frames is a scan of this suite")

    def test_ctrl_c_keeps_what_is_done(self):
        out = self.folder / "out"
        many = ("evaluate", "--suite", "paper3", "--drives", "200", "--scans", "1", "--method", "gradient")
        process = start(*many, "-j", "1", "-o", out, "--progress", "always")
        deadline = time.monotonic() + 100
        while not list((out / "parts").glob("*-[0-9a-f]*.json")) and time.monotonic() < deadline:
            time.sleep(0.05)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertLess(time.monotonic() - begin, 5.0)
        self.assertEqual(stdout, b"")
        self.assertIn(b"the same command goes on from there", stderr)
        self.assertIn(b"/600 scans", stderr)
        self.assertTrue(list((out / "parts").glob("*.json")))
        self.assertFalse((out / "report.html").exists())
        self.assertEqual(self.leftovers(), [])

    def test_of_labelled_sets_predictions_are_judged_beside_methods(self):
        for folder in ("semantickitti", "nuscenes-hdl32/labelled", "vlp16-kerb-labels"):
            self.write(f"data/{folder}/truth.csv", "frame,side,x,y,z\n" + "".join(
                f"{folder[0]}{i},left,{x},3,0\n" for i in range(2) for x in range(10)))
        lines = [json.dumps({"frame": f"s{i}", "points": [[x, 3.1, 0] for x in range(10)]}) for i in range(2)]
        found = self.write("found.jsonl", "\n".join(lines) + "\n")
        result = run("evaluate", "--suite", "real", "--data", self.folder / "data", "--predictions", found,
                     "--method", "gradient", "--json", "-")
        self.check_ok(result)
        cells = {cell["cell"]: cell for cell in json.loads(result.stdout)["cells"]}
        program = cells["SemanticKITTI 00"]["methods"][1]
        self.assertEqual(program["method"], "found.jsonl")
        self.assertEqual((program["figures"]["recall"], program["figures"]["f1_at_0.1_m"]), (1, 0))
        self.assertEqual(cells["SemanticKITTI 00, odd"]["methods"][1]["figures"]["scans"], 1)
        self.assertEqual(cells["nuScenes HDL-32E"]["methods"][1]["figures"]["absent"], 2)

    def test_what_makes_no_sense_is_refused(self):
        found = self.write("found.jsonl", "")
        for arguments, what in ((("--suite", "paper4"), "unknown suite 'paper4' (known: paper1"),
                                (("--suite", "paper3", "--method", "gradeint"), "did you mean 'gradient'?"),
                                (("--suite", "paper3", "--method", "gradient:reading=old"), "reading"),
                                (("--suite", "paper3", "--truth", found), "--truth"),
                                (("--suite", "real", "--data", self.folder, "--write-scans", self.folder / "f"),
                                 "--write-scans"),
                                (("--drives", "2", found, "--truth", found), "--suite")):
            with self.subTest(arguments=arguments):
                self.check_refused(run("evaluate", *arguments), 2, what)
        self.check_refused(run("evaluate", "--suite", "real", "--data", self.folder / "none"), 3)


if __name__ == "__main__":
    unittest.main()
