"""The script for Ren'Py: in plain Python with stand-ins for the engine, and in Ren'Py itself if it is installed."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import types
import unittest

import game

sys.path.insert(0, os.path.dirname(os.path.dirname(game.READER)))
from lipz import reader  # noqa: E402

RENPY = next(
    (
        path
        for path in (os.environ.get("RENPY"), shutil.which("renpy"), "/usr/games/renpy")
        if path and os.path.isfile(path)
    ),
    None,
)


def python_of(script):
    """Returns the Python blocks of a script."""
    blocks = re.findall(r"^init -?\d+ python in lipz:\n((?:(?:    .*)?\n)+)", script, re.M)
    return [textwrap.dedent(block) for block in blocks]


def visemes_between(bank, before, after, speaker):
    """Returns the names of the visemes that the mouth of a speaker may show between two positions of voices."""
    found = set()
    for name, position in (before, after):
        is_spoken = position is not None and speaker in name
        clip = bank.clip(name[len("voice/") : -len(".ogg")]) if is_spoken else None
        end = after[1] if name == after[0] and after[1] is not None else position
        while is_spoken and position <= end:
            found.add(clip.viseme_at(position + 0.04).lower().replace("-", "rest"))
            position += 0.01
        if not is_spoken:
            found.add("rest")
    return found


class Engine:
    """The parts of Ren'Py that the script uses."""

    def __init__(self):
        self.playing, self.position, self.files = None, None, {"dialogue.lipzbank": game.BANK}
        self.store = types.SimpleNamespace(_last_say_who=None, _preferences=types.SimpleNamespace(language=None))
        self.music = types.SimpleNamespace(
            get_playing=lambda channel: self.playing, get_pos=lambda channel: self.position
        )

    def loadable(self, name):
        return name in self.files

    def file(self, name):
        return open(self.files[name], "rb")

    def run(self):
        """Returns the store `lipz` after the blocks of the script have run."""
        store = types.ModuleType("store")
        store.DynamicDisplayable = lambda function, **settings: (function, settings)
        sys.modules.update({"store": store, "lipz_reader": reader})
        lipz = {"renpy": self}
        with open(os.path.join(game.PACKAGE, "lipz.rpy"), encoding="utf-8") as file:
            for block in python_of(file.read()):
                exec(block, lipz)
        return types.SimpleNamespace(**lipz), lipz


class WithStandIns(unittest.TestCase):
    def setUp(self):
        self.engine = Engine()
        self.lipz, self.names = self.engine.run()

    def play(self, name, position, who="mara"):
        self.engine.playing, self.engine.position, self.engine.store._last_say_who = name, position, who

    def test_the_mouth_shows_the_viseme_of_the_voice(self):
        clip = self.lipz.bank.clip("act1/mara-good-evening")
        for position in (0.0, 0.5, 1.0, 2.25, 3.0):
            self.play("voice/act1/mara-good-evening.ogg", position)
            code = clip.viseme_at(position + self.lipz.lead)
            self.assertEqual(self.lipz.viseme("mara"), code)
            function, settings = self.lipz.mouth("mara shape", who="mara")
            image, delay = function(0.0, 0.0, **settings)
            self.assertEqual(image, "mara shape " + ("rest" if code == "-" else code.lower()))
            self.assertLess(delay, 0.02)
        self.assertGreater(self.lipz.openness("mara"), 0)

    def test_only_the_speaker_moves(self):
        self.play("voice/act1/mara-good-evening.ogg", 0.5)
        self.assertEqual(self.lipz.viseme("otto"), "-")
        self.assertEqual(self.lipz.viseme(lambda clip: "otto" in clip.key), "-")
        self.assertNotEqual(self.lipz.viseme(), "-")
        self.assertNotEqual(self.lipz.viseme(lambda clip: "mara" in clip.key), "-")

    def test_without_a_voice_the_mouth_rests(self):
        for name, position in ((None, None), ("voice/act1/mara-good-evening.ogg", None), ("voice/none.ogg", 0.5)):
            self.play(name, position)
            self.assertEqual((self.lipz.viseme(), self.lipz.openness()), ("-", 0.0))
        self.play("voice/act1/mara-good-evening.ogg", 99.0)
        self.assertEqual(self.lipz.viseme(), "-")

    def test_names_of_recordings_lead_to_clips(self):
        for name in (
            "voice/act1/mara-good-evening.opus",
            "<from 1>voice/act1/mara-good-evening.ogg",
            "act1/mara-good-evening.mp3",
        ):
            self.play(name, 0.0)
            self.assertEqual(self.lipz.clip().key, "act1/mara-good-evening")

    def test_a_language_has_its_voice(self):
        self.engine.files["dialogue.lipzbank"] = os.path.join(os.path.dirname(game.BANK), "dubbed.lipzbank")
        lipz, names = self.engine.run()
        names["voices"]["german"] = "de-de"
        self.play("voice/aye.ogg", 0.0)
        self.assertEqual(lipz.clip().key, "aye")
        self.engine.store._preferences.language = "german"
        self.assertEqual(lipz.clip().key, "de/aye")

    def test_a_damaged_bank_is_an_error(self):
        with open(game.BANK, "rb") as file:
            data = bytearray(file.read())
        # A byte inside, which only the checksum covers.
        data[-1] ^= 1
        with tempfile.TemporaryDirectory() as folder:
            self.engine.files["dialogue.lipzbank"] = path = os.path.join(folder, "damaged.lipzbank")
            with open(path, "wb") as file:
                file.write(data)
            with self.assertRaises(reader.BankError) as caught:
                self.engine.run()
        self.assertEqual(caught.exception.kind, "Checksum")

    def test_a_missing_bank_is_explained(self):
        self.engine.files.clear()
        with self.assertRaisesRegex(Exception, "lipz pack -o game/dialogue.lipzbank"):
            self.engine.run()


class InRenPy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if RENPY is None or shutil.which("xvfb-run") is None:
            game.skip("Ren'Py and xvfb-run")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        game.write(self.folder)

    def run_renpy(self, *arguments, wrapper=()):
        environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith("PYTHON")},
            "HOME": self.folder,
            "SDL_AUDIODRIVER": "dummy",
            "PYTHONPATH": os.path.join(game.PACKAGE, "test", "python311"),
        }
        command = [*wrapper, RENPY, self.folder, *arguments]
        result = subprocess.run(
            command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=180, check=False
        )
        self.assertEqual(result.returncode, 0, result.stdout.decode("utf-8", "replace")[-3000:])
        return result.stdout.decode("utf-8", "replace")

    def test_the_sample_plays(self):
        self.assertIn("lint report", self.run_renpy("lint", wrapper=["env", "SDL_VIDEODRIVER=dummy"]))
        self.run_renpy(wrapper=["xvfb-run", "-a"])
        with open(os.path.join(self.folder, "seen.jsonl"), encoding="utf-8") as file:
            seen = [json.loads(line) for line in file]
        with open(game.BANK, "rb") as file:
            bank = reader.Bank(file.read())
        shown, keys = set(), set()
        for before, after, image, found in seen:
            expected = visemes_between(bank, before, after, image.split()[0])
            self.assertIn(found, {f"{image} {viseme}" for viseme in expected}, (before, after))
            shown.add(found)
            keys.update(key for key in game.KEYS if before[1] is not None and key in before[0])
        print(f"Ren'Py: {len(seen)} pictures of mouths compared, {len(shown)} different ones")
        self.assertEqual(keys, set(game.KEYS))
        self.assertGreater(len(shown), 6)


if __name__ == "__main__":
    unittest.main()
