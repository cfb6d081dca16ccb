"""The cases of fixtures/playback/cases.txt, which this reader must answer like the reader in Rust."""

import unittest

import fixtures
from stage import HAS, Stage


def play(cases):
    """Returns the cases with the answers of this reader, the number of commands, and the number of skipped ones."""
    lines, played, skipped, stage, is_skipping = [], 0, 0, Stage(), False
    for line in cases.splitlines():
        is_answer = line.startswith("  ")
        is_command = not is_answer and line != "" and not line.startswith(("#", "needs "))
        if line.startswith("## "):
            is_skipping = False
        if line.startswith("needs "):
            is_skipping = not HAS.issuperset(line.split()[1:])
        if not is_answer or is_skipping:
            lines.append(line)
        if is_command and is_skipping:
            skipped += 1
        elif is_command:
            verb, *words = line.split(" ")
            lines.extend(f"  {answer}" for answer in stage.command(verb, words))
            played += 1
    return "\n".join(lines) + "\n", played, skipped


class Cases(unittest.TestCase):
    def test_the_reader_answers_as_the_cases_say(self):
        expected = fixtures.text("playback", "cases.txt")
        found, played, skipped = play(expected)
        print(f"cases.txt: {played} commands played, {skipped} skipped")
        fixtures.assert_same(self, "cases.txt", found, expected)
        self.assertGreater(played, 500)


if __name__ == "__main__":
    unittest.main()
