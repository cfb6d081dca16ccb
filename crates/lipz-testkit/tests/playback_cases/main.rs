//! The cases of fixtures/playback/cases.txt, played by the reader in Rust: `LIPZ_BLESS=1` writes its answers.
//!
//! `cargo xtask capi` and `cargo xtask web` play the same cases in C, C++ and JavaScript.
#![allow(clippy::expect_used, clippy::panic)]

#[macro_use]
mod time;
mod curves;
mod faces;

use lipz_bank::{
    Babble, Bank, CharacterState, Clip, ClipId, ConsonantHold, Cursor, CurveCursor, DueSegments, EventName, Fps, Lead,
    Locale, Spoken, TextBank, VisemeType, VoiceLevel, VoicedClip, Weights,
};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use time::Time;

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

/// A file of the golden banks, for as long as the test runs.
fn golden(file: &str) -> &'static [u8] {
    Vec::leak(fs::read(fixtures().join("banks/v1").join(file)).expect("a golden bank"))
}

fn number<T: std::str::FromStr>(word: &str) -> T {
    word.parse().unwrap_or_else(|_| panic!("`{word}` is not a number"))
}

/// What the cases are played with.
#[derive(Default)]
struct Stage {
    bank: Option<Bank<'static>>,
    texts: Option<TextBank<'static>>,
    locale: Option<Locale<'static>>,
    clip: Option<ClipId>,
    /// What the clip was given where it has none.
    given: (Option<Fps>, Option<VisemeType>),
    cursor: Option<Cursor>,
    curve_cursor: CurveCursor,
    answers: String,
}

impl Stage {
    fn bank(&self) -> Bank<'static> {
        self.bank.expect("a bank")
    }

    fn cursor(&mut self, change: impl FnOnce(Cursor) -> Cursor) {
        self.cursor = self.cursor.map(change);
    }

    /// Does what a line says.
    fn command(&mut self, line: &str) {
        let words: Vec<&str> = line.split(' ').collect();
        let bank = self.bank;
        let fps = || self.clip.and_then(|id| bank?.clip(id)?.fps().or(self.given.0)).expect("a frame rate");
        match words[..] {
            ["bank", name] => {
                let bytes = golden(&format!("{name}.lipzbank"));
                self.bank = Some(Bank::open(bytes).and_then(Bank::verify).expect("a bank"));
                (self.texts, self.locale) = (None, None);
            }
            ["texts", name] => {
                let bytes = golden(&format!("{name}.lipztexts"));
                let opened = self.bank().open_texts(bytes).and_then(|texts| texts.verify(&self.bank()));
                (self.texts, self.locale) = (Some(opened.expect("a text bank")), None);
            }
            ["locale", tag] => {
                self.locale = self.texts.map_or_else(|| self.bank().locale(tag), |texts| texts.locale(tag));
                if self.locale.is_none() {
                    self.answers.push_str("  no locale\n");
                }
            }
            ["clip", key, ref given @ ..] => self.start(key, given),
            ["speaker", name] => self.cursor(|cursor| cursor.with_speaker(bank.and_then(|bank| bank.event_name(name)))),
            ["lead", lead] => {
                let lead = match lead {
                    "one" => Lead::one_frame(fps()),
                    "two" => Lead::two_frames(fps()),
                    us => Lead::micros(number(us)),
                };
                self.cursor(|cursor| cursor.with_lead(lead));
            }
            ["hold", ref hold @ ..] => {
                let hold = match hold {
                    ["readable"] => ConsonantHold::readable(fps()),
                    ["display", us] => ConsonantHold::for_display(number(us), fps()),
                    [count] => ConsonantHold::frames(number(count)),
                    _ => panic!("{line}"),
                };
                self.cursor(|cursor| cursor.with_hold(hold));
            }
            ["advance" | "loop" | "seek" | "finish", ..] => self.go(&words),
            ["state", name] => {
                let name = Some(name).filter(|name| *name != "-");
                let found = name.map(|name| self.bank().event_name(name).expect("a name"));
                let (clip, cursor) = self.playing(&bank);
                let state = cursor.state(&clip, found);
                self.state(name, state);
            }
            ["characters"] => {
                let (clip, cursor) = self.playing(&bank);
                let all: Vec<(Option<EventName<'_>>, CharacterState<'_>)> = cursor.characters(&clip).collect();
                for (name, state) in all {
                    self.state(name.map(EventName::as_str), state);
                }
            }
            ["babble", name, ref rest @ ..] => self.babble(name, rest),
            ["curves" | "curve" | "emotions", ..] => self.curve_command(&words),
            ["face", ..] => self.face(&words),
            ["idle", ..] => self.idle(&words),
            ["voices"] => {
                for voice in self.bank().voices() {
                    let _ = writeln!(self.answers, "  {}", voice.tag());
                }
            }
            ["voice", tag] => self.voice(tag),
            _ => panic!("no command: {line}"),
        }
    }

    /// Starts a clip, with the frame rate and the viseme type of these words.
    fn start(&mut self, key: &str, given: &[&str]) {
        let bank = self.bank();
        let mut clip = bank.clip_by_key(key).expect("a clip");
        self.given = (None, None);
        for pair in given.chunks(2) {
            match pair {
                ["rate", rate] => {
                    let (numerator, denominator) = rate.split_once('/').expect("a ratio");
                    let fps = Fps::new(number(numerator), number(denominator)).expect("a frame rate");
                    self.given.0 = Some(fps);
                    clip = clip.or_fps(fps);
                }
                ["type", name] => {
                    let kind: VisemeType = name.parse().expect("a viseme type");
                    self.given.1 = Some(kind);
                    clip = clip.or_viseme_type(kind);
                }
                _ => panic!("{given:?}"),
            }
        }
        (self.clip, self.cursor) = (Some(clip.id()), Cursor::new(&clip));
        if self.cursor.is_none() {
            self.answers.push_str("  no frame rate\n");
        }
    }

    /// The chosen clip in a voice.
    fn voice(&mut self, tag: &str) {
        let bank = self.bank;
        let clip = self.chosen(&bank);
        let Some(voice) = self.bank().voice(tag) else {
            self.answers.push_str("  no voice\n");
            return;
        };
        let VoicedClip { clip, spoken, .. } = clip.in_voice(voice);
        let whose = match spoken {
            Spoken::Original => "original",
            Spoken::Dub => "dub",
            _ => "other dub",
        };
        let tag = clip.voice().map_or("-", |voice| voice.tag());
        let _ = writeln!(self.answers, "  {whose}: {}, spoken in {tag}", clip.key());
    }

    /// The clip as a game looks it up for each picture, and the cursor.
    fn playing<'bank>(&self, bank: &'bank Option<Bank<'static>>) -> (Clip<'static, 'bank>, Cursor) {
        let id = self.clip.expect("a clip");
        let clip = bank.as_ref().and_then(|bank| bank.clip(id)).expect("a clip");
        (clip, self.cursor.expect("a cursor"))
    }

    /// Moves the cursor, and writes what is shown and what is due.
    fn go(&mut self, words: &[&str]) {
        let bank = self.bank;
        let (clip, mut cursor) = self.playing(&bank);
        let due = match words {
            ["advance", time @ ..] => Some(at!(Time::read(time).0, |time| cursor.advance_to(&clip, time))),
            ["loop", time @ ..] => Some(at!(Time::read(time).0, |time| cursor.loop_to(&clip, time))),
            ["seek", time @ ..] => {
                at!(Time::read(time).0, |time| cursor.seek(&clip, time));
                None
            }
            _ => Some(cursor.finish(&clip)),
        };
        self.cursor = Some(cursor);
        self.shown(&clip, &cursor);
        if let Some(due) = due {
            self.due(due);
        }
    }

    fn shown(&mut self, clip: &Clip<'static, '_>, cursor: &Cursor) {
        let frame = match cursor.frame() {
            Some(frame) => frame.to_string(),
            None => String::from(if cursor.is_over() { "over" } else { "waiting" }),
        };
        let viseme = cursor.viseme(clip);
        let _ = write!(self.answers, "  frame {frame}, viseme {viseme}");
        // The type that the clip was given, the cursor keeps for itself.
        let kind = clip.viseme_type().or(self.given.1);
        if let Some(kind) = kind.filter(|_| clip.frame_count() > 0) {
            let _ = write!(self.answers, ", open {}", viseme.openness(kind).ten_thousandths());
        }
        if let Some(segment) = cursor.segment(clip) {
            let _ = write!(self.answers, ", segment {}", segment.index());
            if let Some(text) = self.locale.and_then(|locale| segment.text(locale)) {
                let _ = write!(self.answers, ": {}", text.as_str());
                self.answers.push_str(if text.is_fallback() { " (fallback)" } else { "" });
            }
        }
        self.answers.push('\n');
    }

    fn due(&mut self, due: DueSegments<'_, '_>) {
        for segment in due.clone() {
            let _ = write!(self.answers, "  due {}", segment.index());
            if let Some(event) = segment.event() {
                self.answers.push_str(if event.is_empty() { ":" } else { ": " });
                self.answers.push_str(event);
            }
            self.answers.push('\n');
        }
        for event in due.events() {
            let _ = writeln!(self.answers, "  event {event}");
        }
    }

    fn state(&mut self, name: Option<&str>, state: CharacterState<'_>) {
        let word = |name: Option<EventName<'_>>| name.map_or(String::from("-"), |name| name.to_string());
        let [feels, stares, points] = [state.emotion, state.stares_at, state.points_at].map(word);
        let name = name.unwrap_or("-");
        let _ = writeln!(self.answers, "  {name}: feels {feels}, stares {stares}, points {points}");
    }

    fn babble(&mut self, name: &str, words: &[&str]) {
        let bank = self.bank();
        let found = if name == "default" { Some(bank.default_babble()) } else { bank.babble(name) };
        let Some(babble) = found else {
            self.answers.push_str("  no profile\n");
            return;
        };
        let (elapsed, rest) = Time::read(words);
        let weights = match rest {
            ["power", power] => babbled(&babble, elapsed, number::<f32>(power)),
            ["level", level] => babbled(&babble, elapsed, VoiceLevel(number(level))),
            _ => panic!("{words:?}"),
        };
        let _ =
            writeln!(self.answers, "  ooh {}, aah {}", weights.ooh.ten_thousandths(), weights.aah.ten_thousandths());
    }
}

fn babbled(babble: &Babble<'_>, elapsed: Time, power: impl lipz_bank::Power) -> Weights {
    at!(elapsed, |elapsed| babble.at(elapsed, power))
}

#[test]
fn the_reader_answers_as_the_cases_say() {
    let path = fixtures().join("playback/cases.txt");
    let expected = fs::read_to_string(&path).expect("the cases");
    let mut stage = Stage::default();
    for line in expected.lines().filter(|line| !line.starts_with("  ")) {
        stage.answers.push_str(line);
        stage.answers.push('\n');
        if !line.is_empty() && !line.starts_with('#') {
            stage.command(line);
        }
    }
    if std::env::var_os("LIPZ_BLESS").is_some() {
        fs::write(&path, &stage.answers).expect("the cases can be written");
        return;
    }
    let different = stage.answers.lines().zip(expected.lines()).position(|(found, expected)| found != expected);
    let at = different.unwrap_or(0);
    assert!(
        stage.answers == expected,
        "cases.txt:{}: {:?} instead of {:?}",
        at + 1,
        stage.answers.lines().nth(at),
        expected.lines().nth(at),
    );
}
