"""Compares visemes with labels: score.py SOUNDS NAME=PREDICTIONS..."""

import itertools
import json
import pathlib
import sys

from looks import looks

FPS = 24
LEAD_S = 0.04
# A shorter pause belongs to the phone before it.
SHORTEST_PAUSE_S = 0.15
LOOK_OF_CODE = {'-': 'R', 'M': 'M', 'F': 'F', 'O': 'O', 'U': 'O', 'W': 'O', 'A': 'A', 'E': 'A', 'S': 'S', 'L': 'S'}


def truth(facts):
    """Returns the looks that fit each frame."""
    joined = []
    for name, start, end in facts['phones']:
        fits = looks(name, facts['lang'])
        is_short = end - start < SHORTEST_PAUSE_S and end < facts['phones'][-1][2]
        if fits == 'R' and joined and (joined[-1][0] == 'R' or is_short):
            joined[-1][2] = end
        else:
            joined.append([fits, start, end])
    return [look_at(joined, (frame + 0.5) / FPS) for frame in range(int(joined[-1][2] * FPS))]


def look_at(parts, time):
    return next((look for look, start, end in parts if start <= time < end), 'R')


def predicted(prediction, count):
    """Returns the look of each frame, from visemes without their lead, or from phones."""
    if 'visemes' in prediction:
        codes = prediction['visemes'].replace('|', '')
        at = [int(frame + 0.5 - LEAD_S * FPS) for frame in range(count)]
        return [LOOK_OF_CODE[codes[frame]] if frame < len(codes) else 'R' for frame in at]
    parts = [[looks(name.lower().rstrip('012'), 'en')[0], start, end] for name, start, end in prediction['phones']]
    return [look_at(parts, (frame + 0.5) / FPS) for frame in range(count)]


def closed_lips(facts, prediction):
    """Counts closed shapes in visemes, and those that last two frames; spoken p, b, m, and those that are visible."""
    codes = prediction['visemes'].replace('|', '')
    runs = [(code, len(list(run))) for code, run in itertools.groupby(codes)]
    held = [length for code, length in runs if code in 'MF']
    seen = predicted(prediction, len(codes))
    said = [(start, end) for name, start, end in facts['phones'] if looks(name, facts['lang']) == 'M']
    shown = ['M' in seen[max(0, int(start * FPS - 1)):int(end * FPS + 2)] for start, end in said]
    return len(held), sum(length >= 2 for length in held), len(said), sum(shown)


def main():
    sounds = pathlib.Path(sys.argv[1])
    facts = {path.stem: json.loads(path.read_text()) for path in sorted(sounds.glob('*.json'))}
    sets = sorted({fact['set'] for fact in facts.values()}, key=lambda name: ('English' not in name, len(name)))
    print('| sentences | by | how many | frames right / right or beside it |\n| --- | --- | --: | --: |')
    for of_set in sets:
        for name, folder in (peer.split('=', 1) for peer in sys.argv[2:]):
            of_peer = {sentence: pathlib.Path(folder) / f'{sentence}.json' for sentence in facts}
            own = [name for name, path in of_peer.items() if path.exists() and facts[name]['set'] == of_set]
            frames = right = near = 0
            for sentence in own:
                true = truth(facts[sentence])
                for at, look in enumerate(predicted(json.loads(of_peer[sentence].read_text()), len(true))):
                    if true[at] != 'R':
                        frames += 1
                        right += look in true[at]
                        near += any(look in fits for fits in true[max(0, at - 1):at + 2])
            if own:
                print(f'| {of_set} | {name} | {len(own)} | {100 * right / frames:.1f} / {100 * near / frames:.1f} % |')
    mouths = [(name, pathlib.Path(sys.argv[2].split('=', 1)[1]) / f'{name}.json') for name in facts]
    counts = [closed_lips(facts[name], json.loads(path.read_text())) for name, path in mouths if path.exists()]
    held, two, said, shown = map(sum, zip(*counts))
    print(f'\nclosed lips, and the lip under the teeth: {two} of {held} last two frames and more; {shown} of {said} p, b, m are seen')


main()
