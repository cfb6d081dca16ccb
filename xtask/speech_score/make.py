"""Makes recordings with labels: make.py FOLDER LESSONS. Writes NAME.wav, NAME.txt, and NAME.json with phones and times for each sentence;
in LESSONS, for each language the sentences for training a model of its voice."""

import array
import json
import pathlib
import random
import subprocess
import sys
import wave

HERE = pathlib.Path(__file__).parent
# Voice, relative length of its phones, and pitch in hertz (0: its own).
FLITE = [('slt', 1.0, 0), ('rms', 1.0, 0), ('awb', 1.0, 0), ('kal16', 1.0, 0), ('slt', 1.15, 210), ('rms', 0.9, 110)]
FESTIVAL = {
    'it': ('voice_lp_diphone', 'latin-1'),
    'cs': ('voice_czech_dita', 'iso-8859-2'),
    'fi': ('voice_suo_fi_lj_diphone', 'latin-1'),
    'ca': ('voice_upc_ca_ona_hts', 'latin-1'),
}
SCHEME = """({voice})
(set! said (utt.synth (Utterance Text "{text}")))
(utt.save.wave said "{wav}" 'riff)
(set! file (fopen "{labels}" "w"))
(mapcar (lambda (phone) (format file "%s:%f\\n" (item.name phone) (item.feat phone 'end))) (utt.relation.items said 'Segment))
(fclose file)
"""


def flite(number, text, wav):
    voice, stretch, pitch = FLITE[number % len(FLITE)]
    pitch = ['--setf', f'int_f0_target_mean={pitch}'] if pitch else []
    command = ['flite', '-voice', voice, '--setf', f'duration_stretch={stretch}', *pitch, '-psdur', '-t', text, '-o', wav]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()


def festival(language, text, wav):
    voice, encoding = FESTIVAL[language]
    script, labels = wav.with_suffix('.scm'), wav.with_suffix('.labels')
    script.write_bytes(SCHEME.format(voice=voice, text=text, wav=wav, labels=labels).encode(encoding))
    subprocess.run(['festival', '-b', script], check=True, stderr=subprocess.DEVNULL)
    said = labels.read_text(encoding).split()
    script.unlink(), labels.unlink()
    return said


def read(wav):
    with wave.open(str(wav)) as file:
        return file.getframerate(), array.array('h', file.readframes(file.getnframes()))


def write(folder, name, rate, samples, facts):
    with wave.open(str(folder / f'{name}.wav'), 'wb') as file:
        file.setnchannels(1), file.setsampwidth(2), file.setframerate(rate)
        file.writeframes(array.array('h', (max(-32768, min(32767, round(x))) for x in samples)).tobytes())
    (folder / f'{name}.txt').write_text(facts['text'] + '\n')
    (folder / f'{name}.json').write_text(json.dumps(facts, ensure_ascii=False))


def phones_of(labels, end):
    """Returns phones with start and end, from labels with ends only."""
    phones, start = [], 0.0
    for label in labels:
        name, time = label.rsplit(':', 1)
        phones.append([name, start, min(float(time), end)])
        start = float(time)
    return [phone for phone in phones if phone[2] > phone[1]]


def with_noise(samples, chance):
    """Returns pink noise 20 dB below the samples: white noise through three poles (P. Kellet)."""
    poles, noise = [0.0, 0.0, 0.0], []
    for _ in samples:
        white = chance.uniform(-1, 1)
        for at, (keep, gain) in enumerate([(0.99765, 0.099046), (0.963, 0.2965164), (0.57, 1.0526913)]):
            poles[at] = keep * poles[at] + gain * white
        noise.append(sum(poles) + 0.1848 * white)
    power = sum(x * x for x in samples) / sum(x * x for x in noise)
    return [0.7 * (x + 0.1 * power**0.5 * y) for x, y in zip(samples, noise)]


def with_pauses(rate, samples, phones, chance):
    """Extends every pause, including the first and the last, by half a second to a second, with faint room noise."""
    room = lambda count: [chance.uniform(-30, 30) for _ in range(count)]
    longer, moved, at, later = [], [], 0, 0.0
    for name, start, end in phones:
        is_pause = name in ('pau', 'sil', '#', '_')
        more = chance.uniform(0.5, 1.0) if is_pause else 0.0
        longer += samples[at:int(end * rate)] + array.array('h', map(round, room(int(more * rate))))
        at = int(end * rate)
        moved.append([name, start + later, end + later + more])
        later += more
    return longer, moved


def lines(name):
    """Returns the sentences of a file, each with its language."""
    return [line.split(' ', 1) for line in (HERE / name).read_text().splitlines() if not line.startswith('#')]


def said(folder, number, language, text):
    """Speaks a sentence in the voice of its language. Returns the rate and the samples of the audio, and the phones."""
    wav = folder / 'sound.tmp.wav'
    labels = flite(number, text, wav) if language == 'en' else festival(language, text, wav)
    rate, samples = read(wav)
    wav.unlink()
    return rate, samples, phones_of(labels, len(samples) / rate)


def main():
    folder, lessons = map(pathlib.Path, sys.argv[1:])
    for number, (language, text) in enumerate(lines('lessons.txt')):
        (lessons / language).mkdir(parents=True, exist_ok=True)
        rate, samples, phones = said(lessons / language, number, language, text)
        write(lessons / language, f'{number:02}', rate, samples, {'lang': language, 'text': text, 'phones': phones})
    folder.mkdir(parents=True, exist_ok=True)
    for number, (language, text) in enumerate(lines('texts.txt')):
        name, chance = f'{language}-{number:02}', random.Random(number)
        rate, samples, phones = said(folder, number, language, text)
        facts = {'lang': language, 'set': 'English' if language == 'en' else language, 'text': text, 'phones': phones}
        write(folder, name, rate, samples, facts)
        if language == 'en':
            write(folder, name + '-noise', rate, with_noise(samples, chance), facts | {'set': 'English in noise'})
            samples, phones = with_pauses(rate, samples, phones, chance)
            write(folder, name + '-pauses', rate, samples, facts | {'set': 'English with long pauses', 'phones': phones})


if __name__ == '__main__':
    main()
