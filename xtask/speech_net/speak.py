"""Speaks random texts with synthesisers, and stores the sound with the times of all phones.

usage: speak.py {flite|kokoro} MODEL_FOLDER OUT_FOLDER SEED SHARDS

A shard has 100 utterances: samples at 16,000 per second, the start of each utterance in them, and for each phone its
utterance, number (an index in NAMES) and end in milliseconds. Flite states the times of its phones; for Kokoro, an
output with the lengths of all signs is added to the graph.
"""

import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import soundfile
import soxr

from texts import PHONES, Texts

ROOT = Path(__file__).parents[2]
NAMES = ["SIL", *PHONES]
RATE_HZ = 16_000
UTTERANCES = 100
# Shorter pauses between words belong to the phone before.
SHORTEST_PAUSE_MS = 60


class Flite:
    """Four voices of Flite, with random pitch and speed."""

    can_invent = False
    MEANS_HZ = {"slt": 170, "rms": 95, "awb": 130, "kal16": 105}
    OTHER_NAMES = {"pau": "SIL", "ax": "AH", "axr": "ER", "h#": "SIL", "brth": "SIL"}

    def __init__(self, folder, seed):
        self.random = random.Random(seed)

    def speak(self, words):
        voice = self.random.choice(list(self.MEANS_HZ))
        text = " ".join(word.spelling + word.mark for word in words)
        features = {
            "duration_stretch": self.random.uniform(0.75, 1.35),
            "int_f0_target_mean": self.MEANS_HZ[voice] * self.random.uniform(0.75, 1.5),
            "int_f0_target_stddev": self.random.uniform(5, 35),
        }
        with tempfile.NamedTemporaryFile(suffix=".wav") as file:
            options = [option for name, value in features.items() for option in ("--setf", f"{name}={value}")]
            command = ["flite", "-voice", voice, *options, "-psdur", "-t", text, "-o", file.name]
            printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
            samples, rate_hz = soundfile.read(file.name, dtype="float32")
        phones = []
        for entry in printed.split():
            name, end_s = entry.rsplit(":", 1)
            phones.append((self.OTHER_NAMES.get(name, name.upper()), 1000 * float(end_s)))
        return resampled(samples, rate_hz), phones


class Kokoro:
    """The voices of Kokoro-82M and mixtures of two of them, with random speed."""

    can_invent = True
    LENGTHS = "/encoder/Clip_output_0"
    UNIT_MS = 25
    RATE_HZ = 24_000
    SIGNS = dict(zip(
        "AA AE AO AW AY B CH D DH EH EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y Z ZH".split(),
        "ɑ æ ɔ W I b ʧ d ð ɛ A f ɡ h ɪ i ʤ k l m n ŋ O Y p ɹ s ʃ t θ ʊ u v w j z ʒ".split()))

    def __init__(self, folder, seed):
        import onnx
        import onnxruntime
        self.random = random.Random(seed)
        self.vocabulary = json.loads((folder / "vocab.json").read_text("utf-8"))["vocab"]
        graph = onnx.load(folder / "kokoro.onnx")
        graph.graph.output.append(onnx.helper.make_tensor_value_info(self.LENGTHS, onnx.TensorProto.FLOAT, None))
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = 1
        self.session = onnxruntime.InferenceSession(
            graph.SerializeToString(), options, providers=["CPUExecutionProvider"])
        files = sorted((folder / "voices").glob("*.bin"))
        self.styles = [np.fromfile(file, dtype="<f4").reshape(-1, 1, 256) for file in files]

    def signs(self, phone):
        """Returns the signs of a phone with stress."""
        name, stress = phone.rstrip("012"), phone[-1]
        mark = {"1": "ˈ", "2": "ˌ"}.get(stress, "")
        if name == "AH":
            return mark + ("ə" if stress == "0" else "ʌ")
        if name == "ER":
            return mark + ("ə" if stress == "0" else "ɜ") + "ɹ"
        return mark + self.SIGNS[name]

    def speak(self, words):
        signs, owners = [], []
        for word in words:
            for phone in word.phones:
                for sign in self.signs(phone):
                    signs.append(sign)
                    owners.append(phone.rstrip("012"))
            for sign in word.mark + " ":
                signs.append(sign)
                owners.append("SIL")
        signs, owners = signs[:-1], owners[:-1]
        style = self.style(len(signs) - 1)
        tokens = np.array([[0, *(self.vocabulary[sign] for sign in signs), 0]], dtype=np.int64)
        speed = np.array([self.random.uniform(0.75, 1.3)], dtype=np.float32)
        samples, lengths = self.session.run(None, {"tokens": tokens, "style": style, "speed": speed})
        phones, end_ms, last = [], 0, None
        starts = [at == 0 or not joined(owners, signs, at) for at in range(len(owners))]
        for owner, start, length in zip(["SIL", *owners, "SIL"], [True, *starts, True], np.asarray(lengths).ravel()):
            length_ms = float(length) * self.UNIT_MS
            end_ms += length_ms
            is_short = owner == "SIL" and length_ms < SHORTEST_PAUSE_MS and phones
            if phones and (is_short or not start or (owner == "SIL" and last == "SIL")):
                phones[-1] = (phones[-1][0], end_ms)
            else:
                phones.append((owner, end_ms))
                last = owner
        return resampled(np.asarray(samples, dtype=np.float32).ravel(), self.RATE_HZ), phones

    def style(self, at):
        first, second = self.random.choice(self.styles), self.random.choice(self.styles)
        share = np.float32(self.random.choice([1, 1, self.random.random()]))
        return share * first[at] + (1 - share) * second[at]


def joined(owners, signs, at):
    """Whether a sign belongs to the same phone as the sign before it."""
    return owners[at] == owners[at - 1] and owners[at] != "SIL" and (
        signs[at - 1] in "ˈˌ" or (owners[at] == "ER" and signs[at] == "ɹ"))


def resampled(samples, rate_hz):
    return samples if rate_hz == RATE_HZ else soxr.resample(samples, rate_hz, RATE_HZ)


def main():
    kind, folder, out, seed, shards = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), int(sys.argv[4]), int(sys.argv[5])
    out.mkdir(parents=True, exist_ok=True)
    voice = {"flite": Flite, "kokoro": Kokoro}[kind](folder, seed)
    texts = Texts(ROOT, seed)
    for shard in range(shards):
        sound, starts, phones = [], [0], []
        for utterance in range(UTTERANCES):
            samples, spoken = voice.speak(texts.next(voice.can_invent))
            sound.append((np.clip(samples, -1, 1) * 32767).astype(np.int16))
            starts.append(starts[-1] + len(samples))
            phones += [(utterance, NAMES.index(name), round(end_ms)) for name, end_ms in spoken]
        path = out / f"{kind}-{seed}-{shard:03}.npz"
        partial = path.with_suffix(".part.npz")
        np.savez(partial, sound=np.concatenate(sound), starts=np.array(starts), phones=np.array(phones, dtype=np.int32))
        partial.rename(path)
        print(path.name, round(starts[-1] / RATE_HZ / 60, 1), "minutes", flush=True)


main()
