"""The answers of a bank to every query, as in the golden dumps."""

import fixtures
from lipz.reader import Micros
from lipz.reader.events import number_text

TYPE_NAMES = {"blair": "Blair", "toonboom": "ToonBoom", "rms": "Rms", None: "unspecified"}
ESCAPED = '"\\\u00a0\u200b\u202f'


def quoted(text):
    data = text.encode()
    if len(data) <= 400:
        return f'"{escaped(text)}"'
    return f'"{escaped(text[:40])}"... {len(data)} bytes, fnv {fixtures.fnv(data):016x}'


def escaped(text):
    def is_control(char):
        return ord(char) < 0x20 or 0x7F <= ord(char) < 0xA0

    return "".join(f"\\u{{{ord(c):x}}}" if is_control(c) or c in ESCAPED else c for c in text)


def optional(value):
    return "None" if value is None else f"Some({value})"


def flag(value):
    return "true" if value else "false"


def answers(bank):
    """Returns all answers of a bank, one fact per line."""
    lines = [f"format {bank.format_version[0]}, {bank.clip_count} clips"]
    lines += [f"locale {tag}{' default' if tag == bank.default_locale else ''}" for tag in bank.locales]
    lines += [f"voice {tag}{'' if index else ' original'}" for index, tag in enumerate(bank.voices)]
    lines += [profile_line(profile) for _, profile in sorted(bank.face_profiles.items())]
    for clip in bank.clips:
        lines += clip_lines(bank, clip)
    return "\n".join(lines) + "\n"


def profile_line(profile):
    intervals = " ".join(map(str, profile.blink_interval_ms))
    return (
        f"face {quoted(profile.name)}, blinks {intervals} ms, each {profile.blink_length_ms}, "
        f"{profile.double_blink_percent} % double, head {profile.head_motion} {profile.head_follows}, "
        f"pose {profile.pose_ms} ms, glances {profile.glance_percent} %, fixation {profile.fixation_ms} ms"
    )


def clip_lines(bank, clip):
    fps = "unspecified" if clip.fps is None else f"Fps({clip.fps.numerator}/{clip.fps.denominator})"
    yield ""
    yield f"clip {clip.key} {clip.id:016x}"
    yield f"  rate {fps}, type {TYPE_NAMES[clip.viseme_type]}"
    yield f"  visemes {flag(clip.has_visemes)}, events {flag(clip.has_events)}"
    codes = "".join(map(clip.viseme, range(clip.frame_count)))
    yield f"  {clip.frame_count} frames {codes}, {optional(clip.duration_us)} us"
    yield f"  at 24 fps, each 50 ms: {sampled(clip.or_fps(24))}"
    if clip.original is not None:
        yield f"  dub of {clip.original.key} in {clip.voice}"
    else:
        for tag in bank.voices:
            voiced = clip.in_voice(tag)
            if voiced.spoken != "original":
                source = {"dub": "Dub", "other-dub": "OtherDub"}[voiced.spoken]
                yield f"  in {tag} {voiced.clip.key} ({source})"
    if clip.recording is not None:
        yield f"  recording {clip.recording.length_us} us, content {clip.recording.content_hash:016x}"
    for curve in clip.curves:
        keys = " ".join(f"{frame}:{number_text(value)}" for frame, value in curve.keys)
        timed = clip.or_fps(24).curve(curve.name)
        values = " ".join(number_text(timed.value_at(Micros(step * 50_000))) for step in range(20))
        yield f"  curve {quoted(curve.name)} {keys}, each 50 ms: {values}"
    for _, profile in sorted(bank.face_profiles.items()):
        yield face_line(clip, profile)
    for _, profile in sorted(bank.articulations.items()):
        yield from articulation_lines(bank, clip, profile)
    for segment in clip.segments:
        yield from segment_lines(bank, segment)


def sampled(clip):
    """Returns the viseme and the segment every 50 ms."""
    found, before = "", None
    for step in range(200):
        segment = clip.segment_at(Micros(step * 50_000))
        index = None if segment is None else segment.index
        if index != before:
            found += "[end]" if index is None else f"[{index}]"
            before = index
        if index is None:
            break
        found += clip.viseme_at(Micros(step * 50_000))
    return found


def face_line(clip, profile):
    faces = []
    for step in range(67):
        values = clip.face_at(Micros(step * 150_000), profile=profile).values
        faces.append(": " + " ".join(number_text(value) for value in values.values()))
    return f"  face {quoted(profile.name)}, each 150 ms" + "".join(faces)


def articulation_lines(bank, clip, profile):
    phones = clip.phones
    yield f"  phones {phones}, certain {flag(phones.are_certain)}, {optional(phones.level_db)} dB"
    mouths = []
    for step in range(20):
        values = clip.articulation_at(Micros(step * 50_000), profile).values
        mouths.append(": " + " ".join(str(round(value * 1000)) for value in values.values()))
    yield f"  articulation {quoted(profile.name)}, each 50 ms" + "".join(mouths)
    for _, rig in sorted(bank.rigs.items(), key=lambda item: item[0].encode()):
        weights = clip.weights_at(Micros(500_000), rig, profile=profile)
        pairs = (f" {name} {number_text(weight)}" for name, weight in zip(rig.weight_names, weights))
        yield f"  rig {quoted(rig.name)}" + "".join(pairs)


def segment_lines(bank, segment):
    frames = f"{segment.start_frame}..{segment.end_frame}"
    times = f"{optional(segment.start_us)}..{optional(segment.end_us)}"
    yield f"  segment {segment.index} frames {frames} us {times}"
    if segment.event is not None:
        yield f"    event {quoted(segment.event)}"
    for event in segment.events:
        yield f'    typed "{escaped(str(event))}"'
    for tag in bank.locales:
        text = segment.text(tag)
        if text is not None:
            yield f"    {tag} {quoted(text)}{' (fallback)' if text.is_fallback else ''}"
