"""The package: the first program of the readme, the imports of the reader, and types."""

import ast
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import fixtures

READER = os.path.join(fixtures.PACKAGE, "lipz", "reader")


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def blocks(markdown, language):
    """Returns the blocks of code in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", markdown, re.M | re.S)


def run_in_demo(program, files=(("drama.lipzbank", "dialogue.lipzbank"),)):
    """Runs a program in a folder with these banks. Returns its output."""
    with tempfile.TemporaryDirectory() as folder:
        for source, name in files:
            shutil.copy(os.path.join(fixtures.BANKS, source), os.path.join(folder, name))
        environment = {**os.environ, "PYTHONPATH": fixtures.PACKAGE, "PYTHONIOENCODING": "utf-8"}
        result = subprocess.run(
            [sys.executable, "-c", program], cwd=folder, env=environment, stdout=subprocess.PIPE, check=True
        )
    return re.sub(r" +$", "", result.stdout.decode(), flags=re.M)


class Package(unittest.TestCase):
    def test_the_pages_start_with_the_installation_and_ten_lines_that_run(self):
        guide = os.path.join(os.path.dirname(fixtures.FIXTURES), "docs", "guides", "python.md")
        for path in (os.path.join(fixtures.PACKAGE, "README.md"), guide):
            page = read(path)
            self.assertEqual(blocks(page, "sh")[0], "pip install lipz\n")
            program = blocks(page, "python")[0]
            self.assertLess(page.index("pip install"), page.index(program))
            self.assertLessEqual(len(program.splitlines()), 11)
            self.assertEqual(run_in_demo(program), blocks(page, "text")[0])

    def test_the_sample_plays_two_lines_in_two_languages(self):
        program = "import runpy, sys, time; time.sleep = lambda _: None; sys.argv[1:] = ['dialogue.lipzbank']\n"
        sample = os.path.join(fixtures.PACKAGE, "sample", "play.py")
        printed = run_in_demo(program + f"runpy.run_path({sample!r}, run_name='__main__')").splitlines()
        self.assertIn("    de-de: Guten Abend, Otto.", printed)
        self.assertIn("    en-us: Good evening, Otto.", printed)
        self.assertTrue(any(line.endswith(" sad (otto feels sad)") for line in printed), printed)

    def test_the_reader_imports_nothing_but_struct(self):
        for name in sorted(os.listdir(READER)):
            if not name.endswith(".py"):
                continue
            for node in ast.parse(read(READER, name)).body:
                # Blocks such as `if TYPE_CHECKING` do not run.
                if isinstance(node, ast.Import):
                    self.assertEqual([alias.name for alias in node.names], ["struct"], name)
                if isinstance(node, ast.ImportFrom):
                    self.assertTrue(node.level == 1 or node.module == "__future__", name)

    def test_the_reader_works_in_a_different_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(READER, os.path.join(folder, "game", "lips"))
            program = "import game.lips, sys\nprint(sorted({'typing', 're', 'lipz'}.intersection(sys.modules)))"
            result = subprocess.run(
                [sys.executable, "-S", "-c", program], cwd=folder, stdout=subprocess.PIPE, check=True
            )
        self.assertEqual(result.stdout.decode().strip(), "[]")

    def test_types_are_complete(self):
        if importlib.util.find_spec("mypy") is not None:
            mypy = [sys.executable, "-m", "mypy"]
        else:
            mypy = [shutil.which("mypy") or fixtures.skip("mypy")]
        command = [*mypy, "--strict", "--no-error-summary", "--cache-dir", os.devnull, "-p", "lipz"]
        result = subprocess.run(command, cwd=fixtures.PACKAGE, stdout=subprocess.PIPE, check=False)
        self.assertEqual((result.returncode, result.stdout.decode()), (0, ""))


if __name__ == "__main__":
    unittest.main()
