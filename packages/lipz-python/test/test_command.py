"""Commands: with the program itself if it is built, and with a stand-in for progress and cancellation."""

import os
import shutil
import sys
import tempfile
import textwrap
import threading
import unittest

import fixtures

import lipz

ROOT = os.path.dirname(fixtures.FIXTURES)
PROGRAMS = [
    os.environ.get("LIPZ_PROGRAM", ""),
    *(os.path.join(ROOT, "target", kind, "lipz") for kind in ("release", "debug")),
]
PROGRAM = next((program for program in PROGRAMS if os.path.isfile(program)), None)

# Shows a bar like the program's, and waits.
STAND_IN = """\
    import sys, time
    for done in range(3):
        sys.stderr.write(f"== {done},000/2,000 files\\r\\x1b[2K" if sys.stderr.isatty() else "")
        sys.stderr.flush()
        time.sleep(0.2)
    if "wait" in sys.argv:
        time.sleep(60)
    if "fail" in sys.argv:
        sys.exit("no report")
    print('{"errors": 0, "warnings": 0, "diagnostics": []}', file=sys.stderr if "weights" in sys.argv else sys.stdout)
    if "weights" in sys.argv:
        print("the result")
"""


class WithTheProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if PROGRAM is None:
            fixtures.skip("the program, built in `target` or named by LIPZ_PROGRAM")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        shutil.copytree(os.path.join(fixtures.FIXTURES, "drama"), os.path.join(self.folder, "voices"))

    def test_findings_are_objects(self):
        with open(os.path.join(self.folder, "voices", "bad.lipz"), "w", encoding="utf-8") as file:
            file.write('{\n  "fps": 0\n}\n')
        report = lipz.check("voices", cwd=self.folder, program=PROGRAM)
        self.assertFalse(report.is_ok)
        (error,) = report.errors
        self.assertEqual((os.path.basename(error.path), error.line, error.severity), ("bad.lipz", 2, "error"))
        self.assertIn(f"error[{error.code}]: ", str(error))
        self.assertIn("warning", {finding.severity for finding in report.findings})

    def test_a_packed_bank_is_read(self):
        done = []
        report = lipz.pack(
            *("voices", "-o", "dialogue.lipzbank"),
            cwd=self.folder,
            program=PROGRAM,
            progress=lambda completed, count: done.append((completed, count)),
        )
        self.assertTrue(report.is_ok, report.errors)
        self.assertEqual(lipz.open_bank(os.path.join(self.folder, "dialogue.lipzbank")).clip_count, 48)
        self.assertLessEqual({count for _, count in done}, {48})

    def test_texts_are_exported_and_imported(self):
        report = lipz.export("texts", "csv", "voices", "-o", "texts.csv", cwd=self.folder, program=PROGRAM)
        self.assertTrue(report.is_ok, list(map(str, report.findings)))
        report = lipz.import_("texts", "texts.csv", "-o", "voices", cwd=self.folder, program=PROGRAM)
        self.assertTrue(report.is_ok, list(map(str, report.findings)))

    def test_wrong_usage_is_a_finding(self):
        report = lipz.sync("--no-such-option", program=PROGRAM)
        self.assertEqual((report.exit_code, report.errors[0].name), (2, "usage"))


@unittest.skipIf(os.name == "nt", "needs a script that runs like a program")
class WithAStandIn(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = os.path.join(folder.name, "lipz")
        with open(self.program, "w", encoding="utf-8") as file:
            file.write(f"#!{sys.executable}\n{textwrap.dedent(STAND_IN)}")
        os.chmod(self.program, 0o755)

    def test_progress_is_reported(self):
        done = []
        report = lipz.check(program=self.program, progress=lambda *numbers: done.append(numbers))
        self.assertEqual(done, [(0, 2000), (1000, 2000), (2000, 2000)])
        self.assertEqual((report.is_ok, report.output), (True, ""))

    def test_results_on_standard_output_are_kept(self):
        for progress in (None, lambda *_: None):
            report = lipz.export("weights", program=self.program, progress=progress)
            self.assertEqual((report.is_ok, report.output), (True, "the result\n"))

    def test_a_command_can_be_cancelled(self):
        cancel = threading.Event()
        threading.Timer(0.3, cancel.set).start()
        report = lipz.pack("wait", program=self.program, cancel=cancel)
        self.assertEqual((report.is_ok, report.is_cancelled), (False, True))

    def test_a_program_without_a_report_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "no report"):
            lipz.check("fail", program=self.program)

    def test_an_exception_of_the_caller_ends_the_program(self):
        def progress(*_):
            raise KeyError("stop")

        with self.assertRaises(KeyError):
            lipz.check("wait", program=self.program, progress=progress)


if __name__ == "__main__":
    unittest.main()
