"""Plays two lines in a terminal: mouths, subtitles in two languages, events, emotions, and the jaw of a face.

Usage: python3 play.py BANK. To pack a bank with a rig: lipz pack voices -o dialogue.lipzbank --config rig.arkit=true
"""

import sys
import time

import lipz

LINES = (("mara", "act1/mara-good-evening"), ("otto", "act1/otto-twenty-years"))
LOCALES = ("en-us", "de-de")
TICK_SECONDS = 1 / 8


def play(bank, speaker, key, sleep):
    """Plays one line. `sleep` waits until the next rendered frame."""
    clip = bank.clip(key)
    rig = bank.rigs.get("arkit")
    cursor = clip.cursor(speaker=speaker)
    cursor.set_hold()
    print(f"{speaker}: {clip.key}")
    seconds, shown = 0.0, None
    while not cursor.is_over:
        due = cursor.advance_to(seconds)
        if cursor.segment and cursor.segment.index != shown:
            shown = cursor.segment.index
            print("\n".join(f"    {locale}: {cursor.segment.text(locale)}" for locale in LOCALES))
        jaw = f" jaw {dict(zip(rig.weight_names, clip.weights_at(seconds, rig)))['jawOpen']:.2f}" if rig else ""
        feels = cursor.state(speaker).feels or "neutral"
        events = "".join(f" ({event})" for event in due.events)
        print(f"  {seconds:5.2f} {cursor.viseme}{jaw} {feels}{events}")
        sleep(TICK_SECONDS)
        seconds += TICK_SECONDS


def main(path, sleep=time.sleep):
    bank = lipz.open_bank(path)
    for speaker, key in LINES:
        play(bank, speaker, key, sleep)


if __name__ == "__main__":
    main(sys.argv[1])
