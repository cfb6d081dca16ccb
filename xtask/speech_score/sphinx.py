"""Aligns the English recordings of a folder with PocketSphinx: sphinx.py SOUNDS OUT."""

import json
import pathlib
import re
import subprocess
import sys

from pocketsphinx import Decoder


def phones_of(sound, text):
    """Returns phones with start and end in seconds. All voices have the required 16,000 samples per second."""
    decoder = Decoder(samprate=16000, lm=None, loglevel='FATAL')
    decoder.set_align_text(' '.join(re.findall(r"[a-z']+", text.lower())))
    for is_second in (False, True):
        if is_second:
            decoder.set_alignment()  # phones this time
        decoder.start_utt()
        decoder.process_raw(sound, full_utt=True)
        decoder.end_utt()
    times = lambda phone: [phone.name, phone.start / 100, (phone.start + phone.duration) / 100]
    return [times(phone) for word in decoder.get_alignment() for phone in word]


def main():
    sounds, out = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    for wav in sorted(sounds.glob('en-*.wav')):
        facts = json.loads(wav.with_suffix('.json').read_text())
        try:
            phones = phones_of(wav.read_bytes()[44:], facts['text'])
        except RuntimeError as error:
            print(f'PocketSphinx, {wav.name}: {error}')
            continue
        (out / f'{wav.stem}.json').write_text(json.dumps({'phones': phones}))


main()
