# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Models: made, given to detect, and made again by the command that stands in them."""

import pathlib
import re
import shlex
import shutil
import signal
import tempfile
import time
import tomllib
import unittest

from verge_cli import CliTest, run, start

SMALL = ("train", "lda", "--drives", "1", "--scans", "2", "--set", "lda.forward_max_m=15")
WEIGHTS = ("weight_step", "weight_deviation", "weight_slope", "weight_compression", "weight_bend")


class Model(CliTest):
    """One model, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.home = pathlib.Path(tempfile.mkdtemp(prefix="verge_train_"))
        cls.addClassCleanup(shutil.rmtree, cls.home, ignore_errors=True)
        cls.file = cls.home / "lda.toml"
        cls.result = run(*SMALL, "-o", cls.file)

    def test_it_says_what_trained_it_and_what_its_numbers_are(self):
        self.check_ok(self.result)
        self.assertEqual(self.result.stdout, b"")
        text = self.file.read_text()
        self.assertRegex(text, r"(?m)^# +2 +\d{3,} +\d{3,}  made-up drive 1000001 of suite paper3, every 5th scan$")
        for key in WEIGHTS:
            self.assertRegex(text, rf"(?m)^#   {key} +\S.{{20}}")
        model = tomllib.loads(text)
        self.assertEqual(model["method"], "lda")
        self.assertTrue(all(isinstance(model["lda"][key], float) for key in (*WEIGHTS, "threshold")))
        self.assertEqual(model["lda"]["forward_max_m"], 15.0)
        self.assertEqual(self.leftovers(self.home), [])

    def test_the_command_in_it_makes_the_same_bytes(self):
        command = re.search(r"(?m)^#   (verge train .+)$", self.file.read_text())[1]
        again = run(*shlex.split(command)[1:])
        self.check_ok(again)
        self.assertEqual(again.stdout, self.file.read_bytes())

    def test_detect_takes_it_and_finds_both_sides(self):
        scan = self.write("scan.pcd.bin", self.scan)
        result = run("detect", scan, "--config", self.file)
        self.check_ok(result)
        record, = self.records(result.stdout)
        self.assertEqual(record["method"], "lda")
        self.assertEqual([b["side"] for b in record["boundaries"]], ["left", "right"])
        usual, = self.records(run("detect", scan, "--method", "lda").stdout)
        self.assertNotEqual(record["config_hash"], usual["config_hash"])

    def test_a_damaged_one_is_refused_at_its_place(self):
        scan = self.write("scan.pcd.bin", self.scan)
        text = self.file.read_text()
        line = next(i for i, row in enumerate(text.splitlines(), 1) if row.startswith("threshold = "))
        for bad, place, what in (("threshold = nan", f"{line}:13", "need -1"),
                                 ("threshold = \"high\"", f"{line}:13", "text does not fit"),
                                 ("threshold =", f"{line}:", ""), ("treshold = 1.0", f"{line}:1", "'threshold'?")):
            with self.subTest(bad=bad):
                file = self.write("bad.toml", re.sub(r"(?m)^threshold = .*$", bad, text))
                self.check_refused(run("detect", scan, "--config", file), 2, f"bad.toml:{place}", what)


class Train(CliTest):
    def test_labelled_scans_train_too(self):
        drive = self.folder / "drive"
        self.check_ok(run("simulate", "straight", "--scans", "4", "-o", drive))
        result = run("train", "lda", "--drives", "0", "--data", drive)
        self.check_ok(result)
        text = result.stdout.decode()
        self.assertRegex(text, rf"(?m)^# +4 +\d{{3,}} +\d{{3,}}  {re.escape(str(drive))}$")
        self.assertNotIn("made-up", text)

    def test_what_makes_no_sense_is_refused_before_any_work(self):
        out = self.folder / "out.toml"
        for arguments, code, what in ((("gradient",), 2, "nothing to train of 'gradient' (known: lda)"),
                                      (("lda", "--set", "lda.window=10"), 2, "odd"),
                                      (("lda", "--set", "lda.windw=11"), 2, "did you mean 'window'?"),
                                      (("lda", "--drives", "0"), 4, "too few labelled windows"),
                                      (("lda", "--data", self.folder / "none"), 3, "none"),
                                      (("lda", "--drives", "-1"), 2, "--drives"), ((), 2, "METHOD")):
            with self.subTest(arguments=arguments):
                self.check_refused(run("train", *arguments, "-o", out), code, what)
        self.check_refused(run("train", "lda", "-o", self.folder / "none" / "out.toml"), 6, "out.toml")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_ctrl_c_ends_it_and_leaves_the_old_file(self):
        out = self.write("out.toml", "old")
        process = start("train", "lda", "--drives", "1000", "-o", out, "--progress", "always")
        self.addCleanup(process.kill)
        self.assertIn(b"/10000 scans", process.stderr.read(60))
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=60)
        self.assertEqual((process.returncode, stdout), (130, b""), stderr)
        self.assertLess(time.monotonic() - begin, 10.0)
        self.assertEqual(out.read_text(), "old")
        self.assertEqual(self.leftovers(), [])


if __name__ == "__main__":
    unittest.main()
