"""Plays the commands of fixtures/playback/cases.txt."""

import struct

import fixtures
from lipz.reader import AHEAD, Bank, LookAt, Micros, Samples, idle_face

# The features that sections need.
HAS = frozenset("articulation babble curves emotions faces hold lead refresh states text-banks voices".split())


def thousandths(value):
    return round(value * 1000)


def time_of(words):
    """Returns the time at the start of words, and the remaining words."""
    unit, value, *rest = words
    if unit == "us":
        return Micros(value), rest
    if unit == "samples":
        return Samples(int(value), int(rest[0])), rest[1:]
    seconds = float(value)
    if unit == "f32":
        # Times in Python have 64 bits.
        (seconds,) = struct.unpack("<f", struct.pack("<f", seconds))
    return seconds, rest


def who_of(words):
    """Returns the character at the start of words, as keywords, and the remaining words."""
    if words[0] == "of":
        return {"character": words[1]}, words[2:]
    if words[0] == "speaker":
        return {"speaker": words[1]}, words[2:]
    return {}, words


class Stage:
    """The bank, the clip and the cursor of a run of the cases."""

    def __init__(self):
        self.files = []
        self.bank = self.clip = self.cursor = self.locale = None
        self.given = {}

    def command(self, verb, words):
        """Returns the lines of the answer to a command."""
        return getattr(self, "do_" + verb)(words) or []

    def do_bank(self, words):
        self.files = [f"{words[0]}.lipzbank"]
        self.open()

    def do_texts(self, words):
        self.files.append(f"{words[0]}.lipztexts")
        self.open()

    def open(self):
        """Opens the files, like a game that keeps its cursor while they are replaced."""
        data, *texts = map(fixtures.bank_bytes, self.files)
        self.bank = Bank(data).verify_checksum()
        if texts:
            self.bank = self.bank.with_texts(*texts)
        self.locale = None
        self.clip = self.clip and self.bank.clip_with_id(self.clip.id)
        self.cursor = self.cursor and self.clip and self.clip.resume(self.cursor)

    def do_locale(self, words):
        self.locale = words[0] if words[0] in self.bank.locales else None
        return [] if self.locale else ["no locale"]

    def do_variant(self, words):
        self.locale = self.bank.variant(self.locale, words[0])
        return [self.locale]

    def do_clip(self, words):
        key, *given = words
        self.clip = self.bank.clip(key)
        for what, value in zip(given[::2], given[1::2]):
            if what == "rate":
                self.clip = self.clip.or_fps(*map(int, value.split("/")))
            else:
                self.clip = self.clip.or_viseme_type(value)
        self.cursor = None
        if self.clip.fps is None:
            return ["no frame rate"]
        self.cursor = self.clip.cursor()

    def do_speaker(self, words):
        self.cursor.speaker = words[0]

    def do_lead(self, words):
        frames = {"one": 1, "two": 2}.get(words[0])
        if frames:
            self.cursor.set_lead_frames(frames)
        else:
            self.cursor.lead_us = int(words[0])

    def do_hold(self, words):
        if words[0] == "readable":
            self.cursor.set_hold()
        elif words[0] == "display":
            self.cursor.set_hold(int(words[1]))
        else:
            self.cursor.hold_frames = int(words[0])

    def do_advance(self, words):
        return self.shown(self.cursor.advance_to(time_of(words)[0]))

    def do_loop(self, words):
        return self.shown(self.cursor.loop_to(time_of(words)[0]))

    def do_seek(self, words):
        self.cursor.seek(time_of(words)[0])
        return self.shown(None)

    def do_finish(self, words):
        return self.shown(self.cursor.finish())

    def shown(self, due):
        cursor = self.cursor
        frame = cursor.frame if cursor.frame is not None else "over" if cursor.is_over else "waiting"
        parts = [f"frame {frame}", f"viseme {cursor.viseme}"]
        if cursor.openness is not None:
            parts.append(f"open {round(cursor.openness * 10_000)}")
        segment = cursor.segment
        if segment is not None:
            text = segment.text(self.locale)
            said = "" if text is None else f": {text}" + (" (fallback)" if text.is_fallback else "")
            parts.append(f"segment {segment.index}{said}")
        lines = [", ".join(parts)]
        if due is not None:
            for segment in due.segments:
                event = "" if segment.event is None else f": {segment.event}".rstrip()
                lines.append(f"due {segment.index}{event}")
            lines.extend(f"event {event}" for event in due.events)
        return lines

    def do_state(self, words):
        name = None if words[0] == "-" else words[0]
        return [state_line(self.cursor.state(name))]

    def do_characters(self, words):
        return [state_line(state) for state in self.cursor.characters()]

    def do_babble(self, words):
        name, *words = words
        babble = self.bank.default_babble if name == "default" else self.bank.babbles.get(name)
        if babble is None:
            return ["no profile"]
        elapsed, (unit, power) = time_of(words)
        # A level is in 65,536ths.
        weights = babble.at(elapsed, float(power) if unit == "power" else int(power) / 65_536)
        return ["ooh {}, aah {}".format(*(round(weight * 10_000) for weight in weights))]

    def do_curves(self, words):
        return [
            " ".join([f"{curve.name}:", *(f"{frame}:{thousandths(value)}" for frame, value in curve.keys)])
            for curve in self.clip.curves
        ]

    def do_curve(self, words):
        name, *words = words
        curve = self.clip.curve(name)
        if curve is None:
            return ["no curve"]
        value = curve.value(int(words[1])) if words[0] == "frame" else curve.value_at(time_of(words)[0])
        return ["no frame rate" if value is None else str(thousandths(value))]

    def do_emotions(self, words):
        who, words = who_of(words)
        emotions = self.clip.emotions_at(time_of(words)[0], **who)
        parts = [f"{name} {thousandths(value)}" for name, value in emotions.values.items() if value]
        parts += [f"strongest {emotions.strongest or 'neutral'}", f"sum {thousandths(emotions.sum)}"]
        return [", ".join(parts)]

    def profile_and_look(self, words):
        name, kind, *words = words
        profile = self.bank.default_face_profile if name == "default" else self.bank.face_profiles.get(name)
        if kind == "ahead":
            return profile, AHEAD, words
        pitch, yaw, *words = words
        return profile, LookAt(int(pitch) / 1000, int(yaw) / 1000, kind == "person"), words

    def do_face(self, words):
        who, words = who_of(words)
        profile, look_at, words = self.profile_and_look(words)
        if profile is None:
            return ["no profile"]
        return [face_line(self.clip.face_at(time_of(words)[0], profile=profile, look_at=look_at, **who))]

    def do_idle(self, words):
        profile, look_at, (seed, *words) = self.profile_and_look(words)
        if profile is None:
            return ["no profile"]
        return [face_line(idle_face(profile, time_of(words)[0], int(seed), look_at))]

    def do_voices(self, words):
        return self.bank.voices

    def do_voice(self, words):
        if words[0] not in self.bank.voices:
            return ["no voice"]
        found = self.clip.in_voice(words[0])
        return [f"{found.spoken.replace('-', ' ')}: {found.clip.key}, spoken in {found.clip.voice}"]

    def profile(self, name):
        return self.bank.default_articulation if name == "default" else self.bank.articulations.get(name)

    def do_articulation(self, words):
        name, *words = words
        profile = self.profile(name)
        if profile is None:
            return ["no profile"]
        values = self.clip.articulation_at(time_of(words)[0], profile).values
        return [", ".join(f"{name} {thousandths(value)}" for name, value in values.items())]

    def do_weights(self, words):
        rig_name, name, *words = words
        rig, profile = self.bank.rigs.get(rig_name), self.profile(name)
        if rig is None or profile is None:
            return ["no rig" if rig is None else "no profile"]
        weights = self.clip.weights_at(time_of(words)[0], rig, profile=profile)
        return [", ".join(f"{name} {thousandths(value)}" for name, value in zip(rig.weight_names, weights))]


def state_line(state):
    feels, stares, points = (word or "-" for word in (state.feels, state.stares_at, state.points_at))
    return f"{state.name or '-'}: feels {feels}, stares {stares}, points {points}"


def face_line(face):
    values = {name: thousandths(value) for name, value in face.values.items()}
    return (
        "blink {blink}, head {head_pitch} {head_yaw} {head_roll}, eyes {eye_pitch} {eye_yaw}, "
        "brows {brows}, shrug {shrug}, breath {breath}".format(**values)
    )
