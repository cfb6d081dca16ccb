"""Compares computed mouths with coils on jaw and lips, and prints a table.

usage: python3 score.py LIPZ FIXTURES WORK

LIPZ is the program. FIXTURES has a Lipz file with hand-labelled phones, a recording and the positions of the coils for
each utterance. WORK is an empty folder. Needs numpy and openfacefx.
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np

CHANNELS = ["jaw", "opening", "rounding"]
RATE = 100
# A rig whose weights are the articulators.
RIG = "[rig.mouth]\n" + "".join(f'{name} = "{name}"\n' for name in CHANNELS)
# Closed lips are below a tenth of the range, around the phone by 30 ms.
CLOSED, AROUND = 0.1, 0.03
CLOSING = {"P", "B", "M"}
# Silence around the speech that still counts.
EDGE = 0.1
SMOOTHING = 0.05
# Phones of other languages as the nearest ones of OpenFaceFX, which has those of English.
ENGLISH = {"a": "AA", "ɐ": "AH", "e": "EY", "o": "OW", "AX": "AH", "Q": "HH", "x": "HH", "ʁ": "HH", "ç": "HH", "ts": "S",
           "pf": "F", "y": "UW", "ʏ": "UH", "ø": "AO", "œ": "AO", "AXR": "ER", "h": "HH"}


def lipz(program, *arguments):
    # Warnings about clips that only have phones are expected.
    run = subprocess.run([program, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def exported(program, project):
    """Returns the articulation of each clip of a project at 100 Hz."""
    out = project / "out"
    lipz(program, "export", "weights", "audio2face", project / "voices", "-o", out, "--rig", "mouth", "--fps", RATE,
         "--config", project / "lipz.toml")
    return {file.stem: weights(file) for file in out.glob("*.json")}


def weights(file):
    data = json.loads(file.read_text())
    columns = [data["facsNames"].index(name) for name in CHANNELS]
    return np.array(data["weightMat"])[:, columns]


def project(folder, settings=""):
    (folder / "voices").mkdir(parents=True)
    (folder / "lipz.toml").write_text(f'default-locale = "de-de"\nsources = ["voices"]\n{settings}{RIG}')
    return folder


def phones_of(document, end):
    """Returns phones with starts and ends in seconds."""
    words = [word.split("@") for word in document["phones"].split() if "@" in word]
    starts = [int(start) / 1000 for _, start in words]
    return [(name, start, stop) for (name, _), start, stop in zip(words, starts, starts[1:] + [end])]


def shape_table(program, work):
    """Returns the targets of each viseme: the middle of a second in which it is held."""
    held = project(work / "held")
    codes = "-AMOSWEFLU"
    for index, code in enumerate(codes):
        clip = {"visemes": code * 48, "viseme_type": "blair", "fps": 24, "text_de-de": "x"}
        (held / "voices" / f"{index}.lipz").write_text(json.dumps(clip))
    found = exported(program, held)
    return {code: found[str(index)][RATE] for index, code in enumerate(codes)}


def phone_table(program, work):
    """Returns the targets of each English phone: the middle of a fifth of a second between silences."""
    from openfacefx.visemes import PHONEME_TO_VISEME
    names = [name for name in PHONEME_TO_VISEME if name.isupper() and name.isalpha() and name != "SIL"]
    single = project(work / "single")
    for name in names:
        clip = {"visemes": "-" * 24, "viseme_type": "blair", "fps": 24, "phones": f"sil@0 {name}@400 sil@600"}
        (single / "voices" / f"{name}.lipz").write_text(json.dumps(clip))
    found = exported(program, single)
    return {name: found[name][RATE // 2] for name in names}


def open_face_fx(phones, targets, rest, times, jali):
    from openfacefx.alignment import PhonemeSegment
    from openfacefx.coarticulation import CoartParams, build_viseme_curves
    from openfacefx.phonemes import SILENCE
    from openfacefx.visemes import PHONEME_TO_VISEME, VISEMES
    segments = [PhonemeSegment(SILENCE if name == "sil" else ENGLISH.get(name, name), start, end) for name, start, end in phones]
    at, found = build_viseme_curves(segments, fps=float(RATE), params=CoartParams(jali=jali, preroll=0.0))
    curves = np.array([np.interp(times, at, found[:, index]) for index in range(found.shape[1])]).T
    of_viseme = lambda viseme: [target for name, target in targets.items() if PHONEME_TO_VISEME[name] == viseme]
    table = np.array([rest if viseme == "sil" else np.mean(of_viseme(viseme), axis=0) for viseme in VISEMES])
    return curves @ table


def smoothed(values):
    reach = int(4 * SMOOTHING * RATE) + 1
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (SMOOTHING * RATE)) ** 2)
    pad = lambda column: np.convolve(np.pad(column, reach, mode="edge"), kernel / kernel.sum(), "valid")
    return np.stack([pad(values[:, channel]) for channel in range(values.shape[1])], 1)


def ranged(values, spoken):
    least, most = np.percentile(values[spoken], [2, 98])
    return (values - least) / (most - least)


def speed(values):
    return np.percentile(np.abs(np.gradient(values, 1 / RATE)), 99)


def score(curves, utterances):
    """Returns r and the ratio of peak speeds for each channel and utterance, and closed lips."""
    r, speeds, closed, phones = [], [], 0, 0
    for name, (truth, spoken, labels, times) in utterances.items():
        curve = curves[name]
        pairs = [(ranged(curve[:, channel], spoken), ranged(truth[:, channel], spoken)) for channel in range(3)]
        r.append([np.corrcoef(ours[spoken], real[spoken])[0, 1] for ours, real in pairs])
        speeds.append([speed(ours[spoken]) / speed(real[spoken]) for ours, real in pairs])
        for phone, start, end in labels:
            if phone in CLOSING:
                near = (times >= start - AROUND) & (times <= end + AROUND)
                closed += bool(pairs[1][0][near].min() < CLOSED)
                phones += 1
    return np.array(r), np.array(speeds).mean(0), f"{closed} of {phones}"


def main(program, fixtures, work):
    documents = {file.stem: json.loads(file.read_text()) for file in sorted(fixtures.glob("*.lipz"))}
    with_phones = "[sync]\nphones = true\n"
    hand, own, plain = project(work / "hand"), project(work / "own", with_phones), project(work / "plain")
    heard = project(work / "heard", with_phones)
    for name, document in documents.items():
        (hand / "voices" / f"{name}.lipz").write_text(json.dumps(document))
        text = {key: value for key, value in document.items() if key.startswith("text")}
        (own / "voices" / f"{name}.lipz").write_text(json.dumps(text))
        (heard / "voices" / f"{name}.lipz").write_text("{}")
    for synced in (own, heard):
        lipz(program, "sync", synced / "voices", "--audio", fixtures, "--config", synced / "lipz.toml")
    synced = {name: json.loads((own / "voices" / f"{name}.lipz").read_text()) for name in documents}
    for name, document in synced.items():
        without = {key: value for key, value in document.items() if key != "phones"}
        (plain / "voices" / f"{name}.lipz").write_text(json.dumps(without))

    utterances = {}
    for name, document in documents.items():
        truth = np.loadtxt(fixtures / f"{name}.csv", delimiter=",", skiprows=1)
        times = np.arange(len(truth)) / RATE
        labels = phones_of(document, times[-1])
        speech = [(start, end) for phone, start, end in labels if phone != "sil"]
        spoken = (times >= speech[0][0] - EDGE) & (times <= speech[-1][1] + EDGE)
        utterances[name] = (truth, spoken, labels, times)

    def cut(curves):
        long = lambda curve, count: np.vstack([curve, np.repeat(curve[-1:], max(0, count - len(curve)), 0)])[:count]
        return {name: long(curve, len(utterances[name][0])) for name, curve in curves.items()}

    table = shape_table(program, work)
    def steps(name):
        codes = synced[name]["visemes"].replace("|", "")
        frames = np.minimum((utterances[name][3] * synced[name]["fps"]).astype(int), len(codes) - 1)
        return np.array([table[codes[frame]] for frame in frames])
    shapes = {name: steps(name) for name in documents}
    targets, rest = phone_table(program, work), table["-"]
    def rival(phones, jali):
        times = {name: utterances[name][3] for name in documents}
        return {name: open_face_fx(phones_of(phones[name], times[name][-1]), targets, rest, times[name], jali) for name in documents}
    rows = {
        "visemes at 24 fps": shapes,
        "the same, smoothed by 50 ms": {name: smoothed(curve) for name, curve in shapes.items()},
        "OpenFaceFX, phones of lipz sync": rival(synced, False),
        "OpenFaceFX with JALI, phones of lipz sync": rival(synced, True),
        "OpenFaceFX, hand-labelled phones": rival(documents, False),
        "articulation from these visemes": cut(exported(program, plain)),
        "articulation from hand-labelled phones": cut(exported(program, hand)),
        "articulation from phones recognised without the text": cut(exported(program, heard)),
        "articulation from the phones of lipz sync": cut(exported(program, own)),
    }
    print("| source | jaw | opening | protrusion | peak speed | closed *p*, *b*, *m* |\n| --- | --: | --: | --: | --- | --: |")
    scores = {name: score(curves, utterances) for name, curves in rows.items()}
    for name, (r, speeds, closed) in scores.items():
        mean, ratios = r.mean(0), ", ".join(f"{ratio:.1f}" for ratio in speeds)
        print(f"| {name} | " + " | ".join(f"{value:.2f}" for value in mean) + f" | {ratios} | {closed} |")
    (ours, speeds, closed), theirs = scores["articulation from the phones of lipz sync"], scores["OpenFaceFX, phones of lipz sync"][0]
    print("\nr of each utterance (jaw, opening, protrusion), lipz and OpenFaceFX:")
    for name, own, other in zip(documents, ours, theirs):
        print(f"  {name:<10}", " ".join(f"{value:5.2f}" for value in own), "  ", " ".join(f"{value:5.2f}" for value in other))
    limits = zip(ours.mean(0), [0.62, 0.75, 0.45])
    assert all(value >= limit for value, limit in limits), "less than the goal"
    assert closed.split(" of ")[0] == closed.split(" of ")[1], "lips stay open"


main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
