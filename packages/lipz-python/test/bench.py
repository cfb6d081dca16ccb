"""Measures the reader: nanoseconds of each call, and the most bytes that a call uses in addition to its arguments.

The questions are those of docs/inside/ports.md.
"""

import itertools
import sys
import time
import tracemalloc

import fixtures
from lipz.reader import Bank, shapes_of

CALLS = 20_000
ROUNDS = 5
MEASURED_CALLS = 500
NAME = "Python %d.%d" % sys.version_info[:2]


def measure(name, call, calls=CALLS):
    """Prints the shortest of several averages, and the most bytes. The call gets 0, 1, 2 and so on."""
    least = float("inf")
    for _ in range(ROUNDS):
        start = time.perf_counter_ns()
        for index in range(calls):
            call(index)
        least = min(least, (time.perf_counter_ns() - start) / calls)
    print(f"bench {name}_ns {least:.1f} {NAME}")
    print(f"bench {name}_bytes {most_bytes(call)} {NAME}")


def most_bytes(call):
    """Returns the most bytes that a call has in use at a time: Python frees them at its end."""
    tracemalloc.start()
    most = 0
    # In the first round, Python keeps memory for later calls.
    for index in itertools.chain(range(MEASURED_CALLS), range(MEASURED_CALLS)):
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        call(index)
        used = tracemalloc.get_traced_memory()[1] - before
        most = used if index == 0 else max(most, used)
    tracemalloc.stop()
    return most


def main():
    data = fixtures.bank_bytes("drama.lipzbank")
    bank = Bank(data)
    measure("open", lambda _: Bank(data), 500)
    measure("checksum", lambda _: bank.verify_checksum(), 3)
    measure("clip", lambda _: bank.clip("act1/mara-good-evening"))
    clip = bank.clip("act1/mara-good-evening")
    measure("viseme", lambda index: clip.viseme_at(index / 60 % 4))
    cursor = clip.cursor(speaker="mara")

    def tick(index):
        seconds = index / 60 % 4
        if seconds < 1 / 60:
            cursor.seek(seconds)
        due = cursor.advance_to(seconds)
        segment = cursor.segment
        return due.events, cursor.viseme, segment and segment.text("de-de")

    measure("tick", tick)
    phones = Bank(fixtures.bank_bytes("phones.lipzbank"))
    spoken, rig = phones.clip("spoken"), phones.rigs["arkit"]
    shapes = shapes_of(rig.weight_names, rig)
    measure("weights", lambda index: shapes.named(spoken.weights_at(index / 60 % 1.4, rig)), 500)


if __name__ == "__main__":
    main()
