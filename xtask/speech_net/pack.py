"""Writes the trained network in the format of `crates/lipz-speech/src/neural/file.rs`.

usage: pack.py NETWORK OUT_FILE
"""

import struct
import sys
from pathlib import Path

import numpy as np
import torch
import xxhash

from texts import PHONES
from train import BLOCKS, CENTRE, HEADS, INNER, KERNEL, MELS, SPREAD, WIDTH

# The factor of blanks, in thousandths of a nat. With -1000, fewer phones are found: 82.5 instead of 88.1 % of the frames
# of three human sentences are right or beside it.
BLANK = -2000
# The values of a block, which are multiples of a 16-bit float.
BLOCK = 64
# A symbol of the IPA for each phone.
SYMBOLS = dict(zip(
    "AA AE AH AO AW AY EH ER EY IH IY OW OY UH UW B CH D DH F G HH JH K L M N NG P R S SH T TH V W Y Z ZH".split(),
    "ɑ æ ʌ ɔ aʊ aɪ ɛ ɝ eɪ ɪ i oʊ ɔɪ ʊ u b tʃ d ð f ɡ h dʒ k l m n ŋ p ɹ s ʃ t θ v w j z ʒ".split()))


def matrices(state, bands):
    """Yields all values in the order of the file: matrices by input and output."""
    yield bands
    # The features are not scaled in the file, so the first layer does it.
    stem = state["stem.weight"]
    yield (stem / SPREAD).permute(2, 1, 0)
    yield state["stem.bias"] - stem.sum((1, 2)) * CENTRE / SPREAD
    for block in range(BLOCKS):
        part = lambda name: state[f"blocks.{block}.{name}"]
        linear = lambda name: (part(f"{name}.weight").T, part(f"{name}.bias"))
        feed = lambda name: (part(f"{name}.0.weight"), part(f"{name}.0.bias"), *linear(f"{name}.1"), *linear(f"{name}.3"))
        yield from feed("first")
        yield from (part("attention_norm.weight"), part("attention_norm.bias"))
        yield from (*linear("attention_in"), *linear("attention_out"))
        yield from (part("convolution_norm.weight"), part("convolution_norm.bias"))
        yield from linear("convolution_in")
        yield part("neighbours.weight")[:, 0].T
        yield part("neighbours.bias")
        yield from linear("convolution_out")
        yield from feed("second")
        yield from (part("norm.weight"), part("norm.bias"))
    yield state["names.weight"].T
    yield state["names.bias"]


def main():
    network = torch.load(sys.argv[1])
    names = [SYMBOLS[phone] for phone in PHONES] + ["<wb>", "<blank>"]
    content = struct.pack("<7Hh", MELS, WIDTH, INNER, KERNEL, BLOCKS, HEADS, len(names), BLANK)
    for name in names:
        content += bytes([len(name.encode())]) + name.encode()
    values = np.concatenate([part.contiguous().numpy().ravel() for part in matrices(network["state"], network["bands"])])
    for start in range(0, len(values), BLOCK):
        block = values[start:start + BLOCK]
        unit = np.float16(np.abs(block).max() / 127)
        steps = np.clip(np.rint(block / max(float(unit), 1e-12)), -127, 127)
        content += unit.astype("<f2").tobytes() + steps.astype(np.int8).tobytes()
    Path(sys.argv[2]).write_bytes(b"LIPZ-NR2" + struct.pack("<Q", xxhash.xxh3_64_intdigest(content)) + content)


main()
