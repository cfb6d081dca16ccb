"""The golden dumps of fixtures/banks/v1, which this reader must print from the same banks."""

import unittest

import fixtures
from answers import answers
from lipz.reader import Bank

DUMPS = "drama small wide curves faces specials phones rigs recorded dubbed long variants".split()
# These need a stack of banks, which this reader does not have.
SKIPPED = "patched redubbed".split()


class Dumps(unittest.TestCase):
    def compare(self, dump, bank):
        expected = fixtures.text("banks", "v1", f"{dump}.dump")
        found = answers(bank.verify_checksum())
        fixtures.assert_same(self, f"{dump}.dump", found, expected)
        return len(expected.splitlines())

    def test_banks_answer_as_their_dumps_say(self):
        lines = 0
        for dump in DUMPS:
            with self.subTest(dump):
                lines += self.compare(dump, Bank(fixtures.bank_bytes(f"{dump}.lipzbank")))
        print(f"dumps: {lines} lines of {len(DUMPS)} dumps compared, {len(SKIPPED)} dumps skipped")

    def test_a_bank_without_sources_and_a_split_bank_answer_alike(self):
        self.compare("small", Bank(fixtures.bank_bytes("stripped.lipzbank")))
        texts = (fixtures.bank_bytes(f"split.{tag}.lipztexts") for tag in ("de-de", "en-us"))
        self.compare("small", Bank(fixtures.bank_bytes("split.lipzbank")).with_texts(*texts))

    def test_any_buffer_is_accepted(self):
        data = fixtures.bank_bytes("small.lipzbank")
        for buffer in (bytearray(data), memoryview(data), memoryview(b"xyz" + data)[3:]):
            self.assertEqual(Bank(buffer).clip_count, 12)


if __name__ == "__main__":
    unittest.main()
