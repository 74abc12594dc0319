# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C and SIGTERM: what is done is kept, the end comes soon, nothing is left behind."""

import json
import os
import signal
import time
import unittest

from verge_cli import CliTest, start


class Signals(CliTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out.jsonl"

    def wait_for_first_scan(self, process):
        line = process.stderr.readline()
        while line and not line.startswith(b"verge: mount: "):
            line = process.stderr.readline()
        self.assertTrue(line, "ended before its first scan")

    def end_of(self, process, since):
        """(exit code, seconds since the signal, the rest of standard error)"""
        errors = process.stderr.read()
        code = process.wait(60)
        process.stderr.close()
        process.stdout.close()
        return code, time.monotonic() - since, errors

    def check_interrupted(self, number, code):
        drive = self.recording(3000)
        process = start("detect", drive, "-o", self.out)
        self.wait_for_first_scan(process)
        time.sleep(0.2)
        begin = time.monotonic()
        process.send_signal(number)
        ended, seconds, errors = self.end_of(process, begin)
        self.assertEqual(ended, code, errors)
        self.assertLess(seconds, 2.0)
        records = self.records(self.out)
        self.assertEqual([record["frame"] for record in records], [f"{i:06}" for i in range(len(records))])
        self.assertGreater(len(records), 0)
        self.assertLess(len(records), 3000)
        summary = json.loads((self.folder / "out.jsonl.summary.json").read_text())
        self.assertTrue(summary["interrupted"])
        self.assertEqual(summary["scans"]["used"], len(records))
        self.assertEqual(self.leftovers(), [])

    def test_ctrl_c_keeps_what_is_done_and_ends_with_130(self):
        self.check_interrupted(signal.SIGINT, 130)

    def test_sigterm_keeps_what_is_done_and_ends_with_143(self):
        self.check_interrupted(signal.SIGTERM, 143)

    def stuck(self):
        """A run that waits for the second of its two inputs, a FIFO whose writer says nothing."""
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)
        scan = self.write("scan.pcd.bin", self.scan)
        process = start("detect", scan, fifo, "-o", self.out)
        self.wait_for_first_scan(process)
        writer = os.open(fifo, os.O_WRONLY)
        self.addCleanup(os.close, writer)
        time.sleep(0.2)
        return process

    def test_input_that_says_nothing_does_not_hold_up_the_end(self):
        process = self.stuck()
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        code, seconds, errors = self.end_of(process, begin)
        self.assertEqual(code, 130, errors)
        self.assertLess(seconds, 2.0)
        self.assertEqual(len(self.records(self.out)), 1)
        self.assertTrue(json.loads((self.folder / "out.jsonl.summary.json").read_text())["interrupted"])
        self.assertEqual(self.leftovers(), [])

    def test_second_signal_ends_at_once_and_leaves_the_old_file(self):
        self.out.write_text("old")
        process = self.stuck()
        process.send_signal(signal.SIGINT)
        time.sleep(0.3)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        code, seconds, errors = self.end_of(process, begin)
        self.assertEqual(code, 130, errors)
        self.assertLess(seconds, 0.5)
        self.assertEqual(self.out.read_text(), "old")

    def test_signal_that_was_ignored_at_the_start_stays_ignored(self):
        drive = self.recording(200)
        process = start("detect", drive, "-o", self.out,
                        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        self.wait_for_first_scan(process)
        process.send_signal(signal.SIGINT)
        code, _, errors = self.end_of(process, time.monotonic())
        self.assertEqual(code, 0, errors)
        self.assertEqual(len(self.records(self.out)), 200)


if __name__ == "__main__":
    unittest.main()
