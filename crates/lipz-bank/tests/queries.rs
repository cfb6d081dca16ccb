//! Queries on a small bank, with their expected answers.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Bank, Clip, ClipId, Command, EventName, Fps, Locale, Micros, Samples, Seconds, Viseme, VisemeType};
use lipz_testkit::golden::{SMALL, dump, verified};

const KEYS: [&str; 12] = [
    "act1/blair",
    "act1/escapes",
    "act1/rms",
    "act1/toonboom",
    "act2/bare",
    "act2/empty-segments",
    "act2/far",
    "act2/nine",
    "act2/no-frames",
    "act2/silent",
    "act2/unspecified",
    "行",
];

/// Runs `check` on the bank before and after verification.
fn both(check: impl Fn(&Bank<'static>)) {
    check(&Bank::open(SMALL).expect("a golden bank"));
    check(&verified(SMALL));
}

fn clip<'bank>(bank: &'bank Bank<'static>, key: &str) -> Clip<'bank> {
    bank.clip_by_key(key).expect("a clip of the small bank")
}

fn locale(bank: &Bank<'static>, tag: &str) -> Locale {
    bank.locale(tag).expect("a locale of the small bank")
}

#[test]
fn verified_and_not_answer_alike() {
    assert_eq!(dump(&Bank::open(SMALL).expect("a golden bank")), dump(&verified(SMALL)));
}

#[test]
fn find_by_id_key_and_slot() {
    const BLAIR: ClipId = ClipId::from_key("act1/blair");
    both(|bank| {
        assert_eq!(bank.clip(BLAIR).map(|clip| clip.key()), Some("act1/blair"));
        assert_eq!(bank.clip_count(), KEYS.len());
        let mut slots = Vec::new();
        for key in KEYS {
            let found = clip(bank, key);
            assert_eq!((found.key(), found.id()), (key, ClipId::from_key(key)));
            assert_eq!(bank.clip_at(found.slot()).map(|clip| clip.key()), Some(key));
            slots.push(found.slot());
        }
        slots.sort_unstable();
        assert!(slots.into_iter().eq(0..KEYS.len() as u32));
    });
}

#[test]
fn find_misses() {
    both(|bank| {
        for key in ["", "act1", "act1/blai", "act1/blair ", "Act1/blair", "zzz"] {
            assert!(bank.clip_by_key(key).is_none() && bank.clip(ClipId::from_key(key)).is_none(), "{key}");
        }
        for id in 0..10_000 {
            assert!(bank.clip(ClipId::from_u64(id)).is_none());
        }
        assert!(bank.clip_at(KEYS.len() as u32).is_none());
    });
}

/// A key is compared in full, because an id alone does not prove equality.
#[test]
fn find_by_key_compares_the_key() {
    let bytes = lipz_testkit::golden::changed(SMALL, |bank| {
        let name = lipz_testkit::golden::section(SMALL, lipz_layout::Tag::NAMES).start;
        lipz_testkit::golden::put(bank, name, b"act1/blaiR");
    });
    let bank = Bank::open(&bytes).expect("a directory without fault");
    assert_eq!(bank.clip(ClipId::from_key("act1/blair")).map(|clip| clip.key()), Some("act1/blaiR"));
    assert!(bank.clip_by_key("act1/blair").is_none() && bank.clip_by_key("act1/blaiR").is_none());
}

#[test]
fn clips_come_in_the_order_of_their_keys() {
    both(|bank| {
        let under = |prefix| bank.clips_under(prefix).map(|clip| clip.key()).collect::<Vec<_>>();
        assert_eq!(bank.clips().map(|clip| clip.key()).collect::<Vec<_>>(), KEYS);
        assert_eq!(under(""), KEYS);
        assert_eq!(under("act1/"), KEYS[..4]);
        assert_eq!(under("act2/n"), KEYS[7..9]);
        assert_eq!(under("行"), KEYS[11..]);
        assert_eq!(under("act2/silent"), ["act2/silent"]);
        for prefix in ["a/", "act3", "act1/blairs", "zz", "\u{10FFFF}"] {
            assert!(under(prefix).is_empty(), "{prefix}");
        }
    });
}

#[test]
fn locales_and_the_default() {
    both(|bank| {
        assert_eq!(bank.locales().map(|locale| bank.locale_tag(locale)).collect::<Vec<_>>(), ["de-de", "en-us"]);
        assert_eq!(bank.locales().len(), 2);
        assert_eq!(bank.default_locale().map(|locale| bank.locale_tag(locale)), Some("en-us"));
        for tag in ["", "de", "de-DE", "fr-fr"] {
            assert!(bank.locale(tag).is_none(), "{tag}");
        }
    });
}

fn ranges(clip: &Clip<'_>) -> Vec<(u32, u32)> {
    clip.segments().map(|segment| (segment.start_frame(), segment.end_frame())).collect()
}

#[test]
fn segments_of_no_frames() {
    both(|bank| {
        let clip = clip(bank, "act2/empty-segments");
        assert_eq!(ranges(&clip), [(0, 0), (0, 2), (2, 2), (2, 4), (4, 4)]);
        let of_frame = |frame| clip.segment_of_frame(frame).map(|segment| segment.index());
        assert_eq!([0, 1, 2, 3, 4].map(of_frame), [Some(1), Some(1), Some(3), Some(3), None]);
        let parts: Vec<&[u8]> = clip.segments().map(|segment| segment.frames()).collect();
        assert_eq!(parts, [&b""[..], b"AB", b"", b"CD", b""]);
        let events: Vec<_> = clip.segments().map(|segment| segment.event()).collect();
        assert_eq!(events, [Some("start"), Some(""), Some("middle"), Some(""), Some("end")]);
        let middle = clip.segment(2).expect("five segments");
        assert_eq!((middle.start_us(), middle.end_us()), (Some(33_334), Some(33_334)));
    });
}

#[test]
fn many_segments() {
    both(|bank| {
        let far = clip(bank, "act2/far");
        let starts = [0, 1, 2, 2, 4, 5, 6, 7, 8, 9, 10, 12];
        assert_eq!(far.segments().map(|segment| segment.start_frame()).collect::<Vec<_>>(), starts);
        assert_eq!(far.segments().size_hint(), (12, Some(12)));
        for frame in 0..far.frame_count() {
            let expected = starts.iter().rposition(|&start| start <= frame);
            assert_eq!(far.segment_of_frame(frame).map(|segment| segment.index() as usize), expected);
        }
        let nine = clip(bank, "act2/nine");
        assert_eq!(ranges(&nine), (0..9).map(|frame| (frame, frame + 1)).collect::<Vec<_>>());
        for frame in 0..9 {
            assert_eq!(nine.segment_of_frame(frame).map(|segment| segment.index()), Some(frame));
        }
        assert!(nine.segment_of_frame(9).is_none() && nine.segment(9).is_none());
    });
}

#[test]
fn texts_and_where_they_come_from() {
    both(|bank| {
        let (german, english) = (locale(bank, "de-de"), locale(bank, "en-us"));
        let texts = |key, locale| -> Vec<Option<(&str, bool)>> {
            let texts = clip(bank, key).segments().map(|segment| segment.text(locale));
            texts.map(|text| text.map(|text| (text.as_str(), text.is_fallback()))).collect()
        };
        assert_eq!(
            texts("act1/blair", german),
            [Some(("Guten Abend,", false)), Some(("Meister.", false)), Some(("", false))]
        );
        assert_eq!(texts("act2/silent", german), [Some(("seen,", true)), Some(("not heard", true))]);
        assert_eq!(texts("act1/toonboom", german), [Some(("Nur", false)), Some(("deutsch", false))]);
        // A default locale has no fallback.
        assert_eq!(texts("act1/toonboom", english), [None, None]);
        assert_eq!(texts("act1/rms", english), [None, None]);
        let escapes = ["\"Quote\" \\ tab\there", "naïve 😀", "nul\0end"];
        assert_eq!(texts("act1/escapes", english), escapes.map(|text| Some((text, false))));
        assert_eq!(texts("act1/escapes", german)[2], Some(("漢字\u{A0}", false)));
        let first = clip(bank, "act1/escapes").segment(1).expect("three segments");
        assert_eq!(first.text_bytes(german), Some("größer 😀".as_bytes()));
    });
}

#[test]
fn typed_events() {
    both(|bank| {
        let segments: Vec<_> = clip(bank, "act2/far").segments().collect();
        let at = |index: usize| segments[index].events().map(|event| event.to_string()).collect::<Vec<_>>();
        assert_eq!((at(0), segments[0].event()), (vec!["amy feels sad".into()], Some("amy feels sad")));
        assert_eq!((at(2), segments[2].event()), (vec![], Some("")));
        assert_eq!(at(4), ["sees door", "stares door", "stops staring"]);
        assert_eq!(segments[4].event(), Some("sees door, stares door,stops staring"));
        // Other syntaxes return only a string, and a clip without events returns nothing.
        let script = clip(bank, "act1/rms").segment(1).expect("two segments");
        assert_eq!((script.event(), script.events().count()), (Some("say(\"a, b\")"), 0));
        assert!(clip(bank, "act1/toonboom").segments().all(|segment| segment.events().next().is_none()));
    });
}

/// A game compares names with strings, and with names from earlier look-ups.
#[test]
fn names_in_events() {
    both(|bank| {
        for name in ["amy", "door", "sad", "wave"] {
            let found = bank.event_name(name).expect("a name");
            assert!(found == name && found == bank.event_name(name).expect("a name") && found.as_str() == name);
            assert!(["a", "am", "amyx", "z"].iter().all(|other| found != *other));
        }
        assert!(bank.event_name("amy") < bank.event_name("door"));
        assert_eq!(["", "am", "amyd", "Amy", "zz", "sees", "staring"].map(|name| bank.event_name(name)), [None; 7]);
        let first = clip(bank, "act2/far").segment(0).and_then(|segment| segment.events().next()).expect("an event");
        assert_eq!(first.character, bank.event_name("amy"));
        assert!(matches!(first.command, Command::Feels(emotion) if emotion == "sad"));
        assert_eq!(bank.event_name("wave").map(EventName::as_str), Some("wave"));
    });
}

#[test]
fn visemes_by_time() {
    both(|bank| {
        let clip = clip(bank, "act1/blair");
        assert_eq!(clip.frames(), b"-AMOSWEFLUMAEO---");
        // The frame after frame 0 starts at 41,666.67 us.
        for (time_us, code) in [(-1, '-'), (0, '-'), (41_666, '-'), (41_667, 'A'), (83_333, 'A'), (83_334, 'M')] {
            assert_eq!(clip.viseme_at(Micros(time_us)).to_char(), code, "{time_us}");
        }
        assert_eq!(clip.viseme_at(Samples { position: 1_838, rate_hz: 44_100 }).code(), b'A');
        assert_eq!(clip.viseme_at(Seconds(1.0 / 24.0)).code(), b'A');
        let end = clip.duration_us().expect("a frame rate") as i64;
        assert_eq!((clip.frame_at(Micros(end - 1)), clip.frame_at(Micros(end))), (Some(16), None));
        assert_eq!((clip.viseme_at(Micros(end)), clip.viseme(17)), (Viseme::REST, Viseme::REST));
        assert!(clip.segment_at(Micros(end)).is_none() && clip.segment_at(Micros(-1)).is_none());
        assert_eq!(clip.segment_at(Micros(416_667)).map(|segment| segment.index()), Some(1));
    });
}

#[test]
fn what_a_clip_leaves_open_the_caller_fills_in() {
    both(|bank| {
        let open = clip(bank, "act2/unspecified");
        assert_eq!((open.fps(), open.viseme_type(), open.duration_us()), (None, None, None));
        assert_eq!((open.frame_at(Micros(0)), open.viseme_at(Micros(0))), (None, Viseme::REST));
        let filled = open.or_fps(Fps::whole(10)).or_viseme_type(VisemeType::Blair);
        assert_eq!((filled.viseme_at(Micros(150_000)).code(), filled.viseme_type()), (b'A', Some(VisemeType::Blair)));
        assert_eq!(filled.duration_us(), Some(400_000));
        // The file's own values are kept.
        let fixed = clip(bank, "act1/blair").or_fps(Fps::whole(10)).or_viseme_type(VisemeType::Rms);
        assert_eq!((fixed.fps(), fixed.viseme_type()), (Some(Fps::whole(24)), Some(VisemeType::Blair)));
        assert_eq!(clip(bank, "act1/toonboom").fps(), Fps::new(2997, 125));
    });
}

#[test]
fn elements_that_are_missing() {
    both(|bank| {
        let bare = clip(bank, "act2/bare");
        assert!(!bare.has_visemes() && !bare.has_events() && bare.frame_count() == 0);
        assert_eq!((bare.segment_count(), bare.segment(0).and_then(|segment| segment.event())), (1, None));
        let no_frames = clip(bank, "act2/no-frames");
        assert!(no_frames.has_visemes() && no_frames.frames().is_empty());
        assert_eq!((no_frames.duration_us(), no_frames.frame_at(Micros(0))), (Some(0), None));
        let silent = clip(bank, "act2/silent").or_fps(Fps::whole(24));
        assert!(!silent.has_visemes() && silent.has_events() && silent.segment_at(Micros(0)).is_none());
        assert_eq!(silent.segments().map(|segment| segment.event()).collect::<Vec<_>>(), [Some("blink"), Some("")]);
        assert!(clip(bank, "act1/toonboom").segments().all(|segment| segment.event().is_none()));
    });
}
