"""Measures the reader: nanoseconds per query and per tick, and the bytes that a tick allocates."""

import gc
import time
import tracemalloc

import fixtures
from lipz.reader import Bank, Micros, shapes_of

ROUNDS = 20_000


def nanoseconds(query, rounds=ROUNDS):
    """Returns the shortest of five averages."""
    best = float("inf")
    for _ in range(5):
        start = time.perf_counter_ns()
        for _ in range(rounds):
            query()
        best = min(best, (time.perf_counter_ns() - start) / rounds)
    return best


def main():
    data = fixtures.bank_bytes("drama.lipzbank")
    bank = Bank(data)
    clip = bank.clip("act1/mara-good-evening")
    spoken = Bank(fixtures.bank_bytes("phones.lipzbank"))
    line, rig = spoken.clip("spoken"), spoken.rigs["arkit"]
    shapes = shapes_of(rig.weight_names, rig)
    cursor = clip.cursor()
    cursor.advance_to(0.5)
    now = [0.0]

    def tick():
        now[0] = (now[0] + 1 / 60) % 3.5
        cursor.advance_to(now[0])
        return cursor.viseme

    def face_tick():
        now[0] = (now[0] + 1 / 60) % 1.2
        return shapes.named(line.weights_at(now[0], rig))

    for name, query, rounds in [
        ("Bank", lambda: Bank(data), 500),
        ("verify_checksum", bank.verify_checksum, 3),
        ("clip", lambda: bank.clip("act1/mara-good-evening"), ROUNDS),
        ("viseme_at, seconds", lambda: clip.viseme_at(1.51), ROUNDS),
        ("viseme_at, Micros", lambda: clip.viseme_at(Micros(1_510_000)), ROUNDS),
        ("text", lambda: clip.segment_at(1.51).text("de-de"), ROUNDS),
        ("tick: advance_to, viseme", tick, ROUNDS),
        ("tick: weights of 35 shapes", face_tick, 500),
    ]:
        print(f"{name}: {nanoseconds(query, rounds):.0f} ns")
    tick()
    gc.disable()
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(ROUNDS):
        tick()
    after, peak = tracemalloc.get_traced_memory()
    print(f"memory after {ROUNDS} ticks: {after - before} bytes more, at most {peak - before} at a time")


if __name__ == "__main__":
    main()
