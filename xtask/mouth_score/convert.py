"""Makes the files of fixtures/mouth from recordings of the EMU speech database system.

usage: python3 convert.py FOLDER_OF_EMU_WEBAPP OUTPUT

FOLDER_OF_EMU_WEBAPP is a checkout of IPS-LMU/EMU-webApp (MIT licence), which has the recordings in src/demoDBs/ema and
src/testData/newFormat/tinyDfg91. Needs numpy and scipy.
"""

import base64
import json
import sys
import wave
from pathlib import Path

import numpy as np
from scipy.signal import butter, filtfilt

# The rate of the written positions, the cut-off of the low-pass filter in hertz, and the rate of the audio.
RATE = 100
CUT_OFF = 20
AUDIO_RATE = 16_000

# Labels in SAMPA that are spelled differently in Lipz files. "db" and "kh" are parts of a stop.
PHONES = {
    "&p:": "sil", "<p:>": "sil", "H#": "sil", "a": "a", "a:": "a", "6": "ɐ", "aI": "AY", "aU": "AW", "@": "AX", "I": "IH",
    "i:": "IY", "i": "IY", "E": "EH", "e:": "e", "e": "e", "O": "AO", "o": "o", "U": "UH", "u:": "UW", "z": "Z", "s": "S",
    "S": "SH", "b": "B", "t": "T", "d": "D", "k": "K", "kh": "HH", "g": "G", "p": "P", "m": "M", "n": "N", "N": "NG",
    "l": "L", "r": "ʁ", "v": "V", "x": "x", "?": "Q",
}
TEXTS = {
    "kellnerin": "Sie arbeitet in einer Kneipe als Kellnerin.",
    "klausur": "Morgen muss sie weder Klausur noch Examen schreiben.",
    # The speaker says a made-up word.
    "lied": "Melanies Omi kallimit ihr ein Lied.",
}


def ssff(data):
    """Returns the rate and the columns of an SSFF file."""
    end = data.index(b"-----------------\n") + 18
    header = data[:end].decode("latin1").split("\n")
    rate = next(float(line.split()[1]) for line in header if line.startswith("Record_Freq"))
    columns = [line.split()[1:4] for line in header if line.startswith("Column")]
    kind = {"DOUBLE": "<f8", "FLOAT": "<f4", "SHORT": "<i2"}[columns[0][1]]
    width = sum(int(count) for _, _, count in columns)
    values = np.frombuffer(data[end:], kind)
    values = values[: len(values) // width * width].reshape(-1, width).astype(float)
    return rate, {name.split("_")[-1]: values[:, index] for index, (name, _, _) in enumerate(columns)}


def smooth(values, rate):
    b, a = butter(3, CUT_OFF / (rate / 2))
    return filtfilt(b, a, values)


def write(folder, name, audio, audio_rate, labels, tracks):
    rate, jaw = tracks["jaw"]
    frames = int(min(len(jaw["posz"]) / rate, len(audio) / audio_rate) * RATE)
    times = np.arange(frames) / RATE
    at = lambda track, axis: np.interp(times, np.arange(len(track[axis])) / rate, smooth(track[axis], rate))
    (_, upper), (_, lower) = tracks["upper_lip"], tracks["lower_lip"]
    opening = at(upper, "posz") - at(lower, "posz")
    protrusion = -(at(upper, "posy") + at(lower, "posy")) / 2
    rows = np.stack([-at(jaw, "posz"), opening, protrusion], 1)
    lines = ["jaw,opening,protrusion"] + [",".join(f"{value:.2f}" for value in row) for row in rows]
    (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
    count = int(len(audio) / audio_rate * AUDIO_RATE)
    b, a = butter(6, 0.95 * AUDIO_RATE / max(audio_rate, AUDIO_RATE + 1))
    even = filtfilt(b, a, audio) if audio_rate > AUDIO_RATE else audio
    even = np.interp(np.arange(count) / AUDIO_RATE, np.arange(len(even)) / audio_rate, even)
    with wave.open(str(folder / f"{name}.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(AUDIO_RATE)
        file.writeframes(np.clip(even, -32768, 32767).astype("<i2").tobytes())
    phones = []
    for label, start in labels:
        phone = PHONES[label]
        if not phones or phones[-1][0] != phone or phone != "sil":
            phones.append((phone, round(start * 1000)))
    spelled = " ".join(f"{phone}@{start}" for phone, start in phones)
    visemes = "-" * round(count / AUDIO_RATE * 24)
    lipz = {"visemes": visemes, "text_de-de": TEXTS[name], "viseme_type": "blair", "fps": 24, "phones": spelled}
    (folder / f"{name}.lipz").write_text(json.dumps(lipz, ensure_ascii=False, indent=2) + "\n")


def bundle(path):
    """Reads a bundle of EMU: audio, labels with their starts, and coils."""
    data = json.loads(path.read_text())
    annotation = data["annotation"]
    rate = annotation["sampleRate"]
    tracks = {file["fileExtension"]: ssff(base64.b64decode(file["data"])) for file in data["ssffFiles"]}
    audio = np.frombuffer(base64.b64decode(data["mediaFile"]["data"])[44:], "<i2").astype(float)
    segments = next(level["items"] for level in annotation["levels"] if level["name"] == "Segment")
    labels = [(item["labels"][0]["value"], item["sampleStart"] / rate) for item in segments]
    # The last label of speech runs into silence, for more than a second.
    (last, start), end = labels[-2], labels[-1]
    labels[-2:] = [(last, start), ("&p:", start + 0.1), end]
    return audio, rate, labels, tracks


def tiny(folder, stem):
    """Reads a recording with one file per track."""
    with wave.open(str(folder / f"{stem}.wav")) as file:
        rate, audio = file.getframerate(), np.frombuffer(file.readframes(file.getnframes()), "<i2").astype(float)
    tracks = {name: ssff((folder / f"{stem}.{name}").read_bytes()) for name in ("jaw", "upper_lip", "lower_lip")}
    # Each label has its end.
    ends = [line.split() for line in (folder / f"{stem}.MAU").read_text().split("\n#\n")[1].strip().split("\n")]
    starts = [0.0] + [float(end) for end, _, _ in ends[:-1]]
    return audio, rate, [(label, start) for (_, _, label), start in zip(ends, starts)], tracks


def main(source, output):
    output.mkdir(parents=True, exist_ok=True)
    found = lambda pattern: next(source.rglob(pattern))
    write(output, "kellnerin", *bundle(found("dfgspp_mo1_prosody_0020_bndl.json")))
    write(output, "klausur", *bundle(found("dfgspp_mo1_prosody_0024_bndl.json")))
    labels = found("*.MAU")
    write(output, "lied", *tiny(labels.parent, labels.stem))


main(Path(sys.argv[1]), Path(sys.argv[2]))
