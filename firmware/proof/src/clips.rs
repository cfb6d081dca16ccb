//! Clips and everything that belongs to them.

use super::{Asked, See, look, see_bytes, see_face};
use core::hash::{Hash, Hasher};
use lipz_bank::babble::{Babble, VoiceLevel, Weight};
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotion, Who};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{
    Clip, Command, Cursor, Event, EventName, Fps, Locale, Micros, Samples, Seconds, Segment, Time, Viseme, VisemeType,
    VoiceSource,
};

pub(super) fn fps_asked(fps: Fps, number: u32, see: See) {
    see(u64::from(fps.numerator()) << 32 | u64::from(fps.denominator()));
    see(fps.frames_per_micro_q64() ^ fps.to_f64().to_bits() ^ fps.start_of_frame_us(number));
    see(u64::from(fps.frame_at(Micros(i64::from(number))).unwrap_or(0)));
    for lead in [Lead::one_frame(fps), Lead::two_frames(fps), Lead::micros(number)] {
        see(u64::from(lead.us()));
    }
    let holds =
        [ConsonantHold::readable(fps), ConsonantHold::for_display(number, fps), ConsonantHold::frames(number as u8)];
    see(u64::from(holds[0] == holds[1]) | u64::from(holds[1] < holds[2]) | u64::from(holds[0].frame_count()) << 8);
}

pub(super) fn clip_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let number = asked.number;
    see_bytes(see, clip.key().as_bytes());
    see_bytes(see, clip.frames());
    see(clip.id().get() ^ u64::from(clip.slot()) ^ clip.duration_us().unwrap_or(0));
    see(u64::from(clip.has_visemes()) | u64::from(clip.has_events()) << 1 | u64::from(clip.file()) << 32);
    if let Some(kind) = clip.viseme_type() {
        see(u64::from(kind.contains_all(clip.frames())) | u64::from(kind.contains(number as u8)) << 1);
        see_bytes(see, kind.name().as_bytes());
        see_bytes(see, kind.codes().as_bytes());
    }
    curves_asked(clip, asked, see);
    faces_asked(clip, asked, see);
    if let Some(original) = clip.original() {
        see(u64::from(original.slot()) << 1 | u64::from(original == *clip));
    }
    for voice in [Some(asked.voice), clip.voice()].iter().flatten() {
        let voiced = clip.in_voice(*voice);
        see(u64::from(voiced.clip.slot()) << 1 | u64::from(voiced.spoken == VoiceSource::Dub));
    }
    see(clip.recording().map_or(0, |recording| recording.length_us() ^ recording.content_hash()));
    see(VisemeType::from_number(number as u8).map_or(0, |kind| kind as u64));
    if let Some(fps) = clip.fps() {
        fps_asked(fps, number, see);
    }
    for frame in [0, clip.frame_count(), number] {
        viseme_asked(clip, clip.viseme(frame), see);
        see(clip.segment_of_frame(frame).map_or(0, |segment| u64::from(segment.index())));
    }
    let seconds = number as f32;
    time_asked(clip, Micros(i64::from(number)), see);
    time_asked(clip, Samples { position: i64::from(number), rate_hz: number }, see);
    time_asked(clip, core::time::Duration::from_micros(u64::from(number)), see);
    time_asked(clip, Seconds(seconds), see);
    time_asked(clip, Seconds(f64::from(seconds)), see);
    for segment in clip.segments().chain(clip.segment(clip.segment_count().wrapping_sub(1))) {
        segment_asked(&segment, asked, see);
    }
    play(clip, asked.named, number, see);
    // A rate made by the program.
    if let Some(fps) = Fps::new(number, number >> 5) {
        play(&clip.or_fps(fps).or_viseme_type(VisemeType::Blair), asked.named, number, see);
    }
}

fn faces_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let Asked { name, number, .. } = *asked;
    for profile in [asked.profile, asked.profile.without_curves()] {
        for who in [Who::Speaker, Who::SpeakerNamed(name), Who::from(name)] {
            see_face(see, clip.face_at(Micros(i64::from(number)), who, &profile, look(number)));
            see_face(see, clip.face_at(Seconds(number as f32), who, &profile, look(number)));
        }
    }
}

fn curves_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let Asked { name, number, named, .. } = *asked;
    let mut cursor = CurveCursor::new();
    let emotions = clip.emotions_at(Micros(i64::from(number)), Who::Speaker);
    let strongest = emotions.strongest().map(|(emotion, _)| emotion);
    for emotion in strongest.into_iter().chain(Emotion::from_name(name)) {
        see_bytes(see, emotion.name().as_bytes());
        see(emotions.get(emotion).thousandths() as u64);
    }
    see(emotions.sum().thousandths() as u64 ^ emotions.iter().count() as u64);
    for who in [Who::from(name), Who::SpeakerNamed(name)] {
        see(clip.emotions_at(Micros(i64::from(number)), who).sum().thousandths() as u64);
    }
    let named = named.and_then(|name| clip.curve(name));
    for curve in clip.curves().chain(clip.curve(name)).chain(named) {
        see_bytes(see, curve.name().as_str().as_bytes());
        cursor = CurveCursor::from_word(cursor.to_word() ^ number);
        see(clip
            .curve_in_place(curve.place())
            .map_or(0, |same| u64::from(same.key_count()) << 1 | u64::from(same == curve)));
        see(u64::from(curve.key_count()) | curve.key(number).map_or(0, |key| u64::from(key.frame)));
        let value_see = |value: CurveValue| see(value.thousandths() as u64 ^ u64::from(value.to_f32().to_bits()));
        curve.keys().for_each(|key| value_see(key.value));
        value_see(curve.value(number).towards(CurveValue::from_thousandths(number as i32), u64::from(number), 1 << 33));
        value_see(cursor.value(&curve, number));
        let seconds = Seconds(number as f32);
        let times =
            [curve.value_at(Micros(i64::from(number))), curve.value_at(seconds), cursor.value_at(&curve, seconds)];
        times.iter().flatten().for_each(|value| value_see(*value));
        let samples = Samples { position: i64::from(number), rate_hz: number };
        curve.value_at(samples).into_iter().for_each(value_see);
        curve.value_at(core::time::Duration::from_micros(u64::from(number))).into_iter().for_each(value_see);
    }
}

fn viseme_asked(clip: &Clip<'_>, viseme: Viseme, see: See) {
    let weight = clip.viseme_type().map(|kind| Viseme::from_code(viseme.code()).openness(kind));
    see(u64::from(viseme.to_char()) | u64::from(viseme.is_rest()) << 32);
    let weights =
        [weight.unwrap_or_default(), Weight::from_digit(viseme.code()), Weight::from_digits(b'9', viseme.code())];
    weights.iter().for_each(|weight| see(u64::from(weight.ten_thousandths())));
}

fn time_asked(clip: &Clip<'_>, time: impl Time, see: See) {
    viseme_asked(clip, clip.viseme_at(time), see);
    see(u64::from(clip.frame_at(time).unwrap_or(0)));
    see(clip.segment_at(time).map_or(0, |segment| u64::from(segment.clip().slot())));
    let open = clip.openness_at(time).map_or(0, |weight| weight.ten_thousandths());
    let babbled = clip.openness_or_babble(time, &Babble::DEFAULT, VoiceLevel::UNMEASURED);
    see(u64::from(open ^ babbled.ten_thousandths()));
}

fn segment_asked(segment: &Segment<'_>, asked: &Asked<'_>, see: See) {
    see(u64::from(segment.start_frame()) << 32 | u64::from(segment.end_frame()));
    see(segment.start_us().unwrap_or(0) ^ segment.end_us().unwrap_or(0));
    see(u64::from(segment.clip().segment(asked.number).map_or(false, |other| other == *segment)));
    see_bytes(see, segment.frames());
    see_bytes(see, segment.event().unwrap_or("").as_bytes());
    segment.events().for_each(|event| event_asked(event, asked, see));
    for locale in [asked.locale, Locale::from_words([asked.number; 2])] {
        see_bytes(see, segment.text_bytes(locale).unwrap_or(&[]));
        see(segment.has_own_text(locale).into());
        if let Some(text) = segment.text(locale) {
            see_bytes(see, text.as_str().as_bytes());
            see(u64::from(text.is_fallback()));
        }
    }
}

fn event_asked(event: Event<'_>, asked: &Asked<'_>, see: See) {
    let command: Command<EventName<'_>, _> = event.command;
    see_bytes(see, command.verb().as_bytes());
    see(command.amount().map_or(0, |strength| strength.thousandths() as u64));
    for name in [event.character, command.object()].iter().flatten() {
        let [origin, id] = name.to_words();
        see(u64::from(origin) << 32 | u64::from(id));
        see_bytes(see, name.as_str().as_bytes());
        see(u64::from(*name == asked.name) | u64::from(*name == *asked.name) << 1);
        if let Some(named) = asked.named {
            see(u64::from(*name == named) | u64::from(*name < named) << 1);
        }
        name.hash(&mut Sum(see));
    }
}

/// Passes hashes to the observer.
struct Sum(See);

impl Hasher for Sum {
    fn finish(&self) -> u64 {
        0
    }

    fn write(&mut self, bytes: &[u8]) {
        see_bytes(self.0, bytes);
    }
}

fn play(clip: &Clip<'_>, speaker: Option<EventName<'_>>, number: u32, see: See) {
    let (cursor, fps) = match (Cursor::new(clip), clip.fps()) {
        (Some(cursor), Some(fps)) => (cursor, fps),
        _ => return,
    };
    let mut cursor = cursor.with_speaker(speaker).with_lead(Lead::two_frames(fps)).with_words([number; 4]);
    cursor = cursor.with_hold(ConsonantHold::readable(fps));
    let time = Micros(i64::from(number));
    for step in 0..4 {
        let due = match step {
            0 => cursor.advance_to(clip, time),
            1 => cursor.loop_to(clip, time),
            2 => cursor.finish(clip),
            _ => {
                cursor.seek(clip, time);
                cursor.advance_to(clip, time)
            }
        };
        let mut characters = 0;
        for event in due.events() {
            let mut state = cursor.state(clip, event.character);
            state.apply(event.command);
            characters ^= state.emotion.map_or(0, |name| name.to_words()[1]);
        }
        for (_, state) in cursor.characters(clip) {
            characters ^= state.stares_at.map_or(0, |name| name.to_words()[1]);
        }
        viseme_asked(clip, cursor.viseme(clip), see);
        see(u64::from(cursor.openness(clip).map_or(0, |weight| weight.ten_thousandths())));
        cursor.to_words().iter().for_each(|word| see(u64::from(*word)));
        see(u64::from(characters) | u64::from(cursor.is_over()) << 32);
        see(u64::from(cursor.frame().unwrap_or(0)) ^ cursor.segment(clip).map_or(0, |segment| segment.index().into()));
    }
}
