"""The damaged banks of fixtures/banks/damaged.txt. Damage never causes anything but the documented error."""

import os
import tempfile
import unittest

import fixtures
from lipz.reader import Bank, BankError, Micros, clip_id, open_bank
from lipz.reader.checksum import checksum_of

# This reader does not check every reference.
HAS = frozenset(("text-banks", "checksum"))


def sections_of(data):
    """Returns the offsets of the directory entry and of the contents of each section of an undamaged bank."""
    found = {}
    for at in range(64, 64 + 16 * int.from_bytes(data[40:44], "little"), 16):
        found[data[at : at + 4].decode()] = at, int.from_bytes(data[at + 4 : at + 8], "little")
    return found


class Case:
    """An undamaged bank, and the commands that damage it."""

    def __init__(self, name):
        self.name = name
        self.damage = []

    def damaged(self, data):
        result = bytearray(data)
        for verb, *words in self.damage:
            if verb == "cut":
                del result[int(words[0]) :]
            elif verb == "append":
                result += bytes.fromhex(words[0])
            elif verb == "seal":
                result[8:16] = checksum_of(memoryview(result)).to_bytes(8, "little")
            else:
                at = 0
                if verb in ("section", "entry"):
                    entry, contents = sections_of(data)[words.pop(0)]
                    at = contents if verb == "section" else entry
                put(result, at + int(words[0]), bytes.fromhex(words[1]))
        return bytes(result)

    def answer(self, verb, words):
        """Returns the answer of a command that opens, or None for one that damages."""
        data = fixtures.bank_bytes(f"{self.name}.lipzbank")
        if verb == "open":
            return result_of(lambda: exercise(Bank(self.damaged(data))), "opens")
        if verb == "verify":
            return result_of(lambda: Bank(self.damaged(data)).verify_checksum(), "verified")
        if verb == "texts":
            texts = self.damaged(fixtures.bank_bytes(f"{words[0]}.lipztexts"))
            return result_of(lambda: exercise(Bank(data).with_texts(texts)), "opens")
        if verb == "each-byte":
            return each_byte(bytearray(self.damaged(data)))
        return None


def put(data, at, put_bytes):
    if at + len(put_bytes) > len(data):
        raise AssertionError("the damage is outside the bank")
    data[at : at + len(put_bytes)] = put_bytes


def result_of(query, fine):
    try:
        query()
    except BankError as error:
        return f"{error.kind} at {error.offset_bytes}"
    return fine


def each_byte(data):
    """Opens a bank with each of its bytes changed."""
    opened, lines = 0, []
    for at in range(len(data)):
        data[at] ^= 0xFF
        result = result_of(lambda: Bank(bytes(data)), "opens")
        if result == "opens":
            opened += 1
            if at % 61 == 0:
                exercise(Bank(bytes(data)))
        else:
            lines.append(f"{at}: {result}\n")
        data[at] ^= 0xFF
    return f"{opened} open, {len(lines)} refused, fnv {fixtures.fnv(''.join(lines).encode()):016x}"


def exercise(bank):
    """Makes every query, none of which may fail, whatever the bytes are."""
    locales = [*bank.locales, bank.default_locale, "xx"]
    slots = [bank.clip_in_slot(slot) for slot in range(bank.clip_count)]
    for clip in [*slots, *bank.clips[:4], bank.clip("act1/blair"), bank.clip_with_id(clip_id("act2/far"))]:
        if clip is not None:
            exercise_clip(bank, clip.or_fps(24).or_viseme_type("blair"), locales)


def exercise_clip(bank, clip, locales):
    for time in (Micros(-1), 0.1, 1e9):
        clip.viseme_at(time), clip.openness_at(time)
        segment = clip.segment_at(time)
        if segment is not None:
            (segment.start_us, segment.end_us, segment.frames, segment.event, segment.events)
            [segment.text(locale) for locale in locales]
        clip.emotions_at(time, speaker="mara").strongest
        for rig in bank.rigs.values():
            clip.weights_at(time, rig)
        for profile in bank.articulations.values():
            clip.articulation_at(time, profile)
        for profile in [*bank.face_profiles.values(), bank.default_face_profile]:
            clip.face_at(time, profile=profile)
            clip.face_at(time, "mara")
        for babble in bank.babbles.values():
            babble.at(time)
    for curve in clip.curves:
        curve.keys, curve.value(3)
    for segment in clip.segments[:20]:
        segment.events, [segment.text(locale) for locale in locales]
    cursor = clip.cursor(speaker="mara", lead_us=40_000, hold_frames=3)
    for time in (0.0, 0.2, 1e6):
        [str(event) for event in cursor.advance_to(time).events[:20]], cursor.viseme, cursor.segment
    cursor.characters(), cursor.finish()
    str(clip.phones), clip.recording, clip.voice, clip.original
    [clip.in_voice(voice).clip for voice in bank.voices]


def answers(file):
    """Returns the file with the answers of this reader, the number of commands, and the number of skipped ones."""
    lines, played, skipped, case, is_skipping = [], 0, 0, None, False
    for line in file.splitlines():
        is_answer = line.startswith("  ")
        if line.startswith("## "):
            is_skipping = False
        if line.startswith("needs "):
            is_skipping = not HAS.issuperset(line.split()[1:])
        if not is_answer or is_skipping:
            lines.append(line)
        if is_answer or line == "" or line.startswith(("#", "needs ")):
            continue
        verb, *words = line.split(" ")
        if verb == "bank":
            case = Case(words[0])
            continue
        answer = None if is_skipping and verb == "verify" else case.answer(verb, words)
        if answer is None and verb != "verify":
            case.damage.append((verb, *words))
        elif is_skipping:
            # These banks are not refused, but they must not crash the reader either.
            skipped += 1
        else:
            lines.append(f"  {answer}")
            played += 1
    return "\n".join(lines) + "\n", played, skipped


class Damaged(unittest.TestCase):
    def test_the_reader_finds_the_damage(self):
        expected = fixtures.text("banks", "damaged.txt")
        found, played, skipped = answers(expected)
        print(f"damaged.txt: {played} answers compared, {skipped} skipped")
        fixtures.assert_same(self, "damaged.txt", found, expected)
        self.assertGreater(played, 100)

    def test_any_bytes_are_an_error(self):
        for data in (b"", b"{}", bytes(100), b"\x89LPZ\r\n\x1a\n" + bytes(10_000)):
            with self.assertRaises(BankError):
                Bank(data)

    def test_lipz_files_are_not_banks(self):
        folder = os.path.join(fixtures.FIXTURES, "bad")
        names = [name for name in sorted(os.listdir(folder)) if name.endswith(".lipz")]
        self.assertGreater(len(names), 100)
        for name in names:
            with self.subTest(name), self.assertRaises(BankError):
                open_bank(os.path.join(folder, name))

    def test_damage_inside_a_file_is_an_error_of_open_bank(self):
        names = ("split.lipzbank", "split.de-de.lipztexts", "split.en-us.lipztexts")
        for damaged in names:
            with self.subTest(damaged), tempfile.TemporaryDirectory() as folder:
                paths = [os.path.join(folder, name) for name in names]
                for name, path in zip(names, paths):
                    data = bytearray(fixtures.bank_bytes(name))
                    # The last byte is one of the contents, which only the checksum covers.
                    data[-1] ^= 1 if name == damaged else 0
                    with open(path, "wb") as file:
                        file.write(data)
                with self.assertRaises(BankError) as caught:
                    open_bank(*paths)
                self.assertEqual((caught.exception.kind, caught.exception.offset_bytes), ("Checksum", 8))

    def test_errors_have_codes(self):
        with self.assertRaises(BankError) as caught:
            Bank(b"\x89LPZ")
        error = caught.exception
        self.assertEqual((error.code, error.kind, error.offset_bytes), (1, "TooShort", 4))
        self.assertEqual(str(error), "the file is shorter than the header of a bank (bank error 1, at byte 4)")


if __name__ == "__main__":
    unittest.main()
