//! The cases of fixtures/playback/cases.txt, played by the reader in Rust. `LIPZ_BLESS=1` writes its answers.
//!
//! `cargo xtask capi` and `cargo xtask web` play the same cases in C, C++ and JavaScript.
#![allow(clippy::expect_used, clippy::panic)]

#[macro_use]
mod time;
mod articulation;
mod curves;
mod faces;
mod files;

use lipz_bank::babble::{Babble, VoiceLevel, Weights};
use lipz_bank::curve::CurveCursor;
use lipz_bank::playback::{CharacterState, ConsonantHold, DueSegments, Lead};
use lipz_bank::{Clip, ClipId, Cursor, Dialogue, EventName, Fps, Locale, VisemeType, VoiceSource, VoicedClip};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use time::Time;

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

fn number<T: std::str::FromStr>(word: &str) -> T {
    word.parse().unwrap_or_else(|_| panic!("`{word}` is not a number"))
}

/// The state of a run of the cases.
struct Stage {
    /// The folder of the files.
    folder: PathBuf,
    /// The files of the dialogue.
    files: Vec<PathBuf>,
    dialogue: &'static Dialogue<'static>,
    locale: Option<Locale>,
    clip: Option<ClipId>,
    /// The settings for clips without their own.
    given: (Option<Fps>, Option<VisemeType>),
    cursor: Option<Cursor>,
    curve_cursor: CurveCursor,
    answers: String,
}

impl Stage {
    fn new(folder: PathBuf) -> Stage {
        let dialogue = files::open(&[fixtures().join("banks/v1/small.lipzbank")]);
        let (locale, clip, given, cursor) = (None, None, (None, None), None);
        let (curve_cursor, answers) = (CurveCursor::default(), String::new());
        Stage { folder, files: Vec::new(), dialogue, locale, clip, given, cursor, curve_cursor, answers }
    }

    fn cursor(&mut self, change: impl FnOnce(Cursor) -> Cursor) {
        self.cursor = self.cursor.map(change);
    }

    /// Runs the command in a line.
    fn command(&mut self, line: &str) {
        let words: Vec<&str> = line.split(' ').collect();
        let dialogue = self.dialogue;
        let fps = || self.clip.and_then(|id| dialogue.clip(id)?.fps().or(self.given.0)).expect("a frame rate");
        match words[..] {
            ["bank", name] => {
                self.files = files::of_bank(&self.folder, name);
                self.dialogue = files::open(&self.files);
                self.locale = None;
            }
            ["texts", name] => {
                self.files.push(self.folder.join(format!("{name}.lipztexts")));
                self.dialogue = files::open(&self.files);
                self.locale = None;
            }
            ["locale", tag] => self.locale(tag),
            ["variant", key] => self.variant(key),
            ["clip", key, ref given @ ..] => self.start(key, given),
            ["speaker", name] => {
                self.cursor(|cursor| cursor.with_speaker(dialogue.event_name(name)));
            }
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
                let found = name.map(|name| dialogue.event_name(name).expect("a name"));
                let (clip, cursor) = self.playing();
                let state = cursor.state(&clip, found);
                self.state(name, state);
            }
            ["characters"] => {
                let (clip, cursor) = self.playing();
                let all: Vec<(Option<EventName<'_>>, CharacterState<'_>)> = cursor.characters(&clip).collect();
                for (name, state) in all {
                    self.state(name.map(EventName::as_str), state);
                }
            }
            ["babble", name, ref rest @ ..] => self.babble(name, rest),
            ["curves" | "curve" | "emotions", ..] => self.curve_command(&words),
            ["articulation", ..] => self.articulation(&words),
            ["weights", ..] => self.weights(&words),
            ["face", ..] => self.face(&words),
            ["idle", ..] => self.idle(&words),
            ["voices"] => {
                for voice in dialogue.voices() {
                    let _ = writeln!(self.answers, "  {}", dialogue.voice_tag(voice));
                }
            }
            ["voice", tag] => self.voice(tag),
            _ => panic!("no command: {line}"),
        }
    }

    fn locale(&mut self, tag: &str) {
        self.locale = self.dialogue.locale(tag);
        if self.locale.is_none() {
            self.answers.push_str("  no locale\n");
        }
    }

    /// Selects the variant of the locale with this key.
    fn variant(&mut self, key: &str) {
        let locale = self.dialogue.variant(self.locale.expect("a locale"), key);
        let _ = writeln!(self.answers, "  {}", self.dialogue.locale_tag(locale));
        self.locale = Some(locale);
    }

    /// Starts a clip, with the frame rate and the viseme type of these words.
    fn start(&mut self, key: &str, given: &[&str]) {
        let mut clip = self.dialogue.clip_by_key(key).expect("a clip");
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

    /// Plays the chosen clip in a voice.
    fn voice(&mut self, tag: &str) {
        let clip = self.chosen();
        let Some(voice) = self.dialogue.voice(tag) else {
            self.answers.push_str("  no voice\n");
            return;
        };
        let VoicedClip { clip, spoken, .. } = clip.in_voice(voice);
        let whose = match spoken {
            VoiceSource::Original => "original",
            VoiceSource::Dub => "dub",
            _ => "other dub",
        };
        let tag = clip.voice().map_or("-", |voice| self.dialogue.voice_tag(voice));
        let _ = writeln!(self.answers, "  {whose}: {}, spoken in {tag}", clip.key());
    }

    /// Returns the clip, which a game looks up for each rendered frame, and the cursor.
    fn playing(&self) -> (Clip<'static>, Cursor) {
        let clip = self.clip.and_then(|id| self.dialogue.clip(id)).expect("a clip");
        (clip, self.cursor.expect("a cursor"))
    }

    /// Moves the cursor, and writes its viseme and segment, and the due events.
    fn go(&mut self, words: &[&str]) {
        let (clip, mut cursor) = self.playing();
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

    fn shown(&mut self, clip: &Clip<'_>, cursor: &Cursor) {
        let frame = match cursor.frame() {
            Some(frame) => frame.to_string(),
            None => String::from(if cursor.is_over() { "over" } else { "waiting" }),
        };
        let viseme = cursor.viseme(clip);
        let _ = write!(self.answers, "  frame {frame}, viseme {viseme}");
        // The cursor also stores the type that was set on the clip.
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

    fn due(&mut self, due: DueSegments<'_>) {
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
        let dialogue = self.dialogue;
        let found = if name == "default" { Some(dialogue.default_babble()) } else { dialogue.babble(name) };
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

fn babbled(babble: &Babble<'_>, elapsed: Time, power: impl lipz_bank::babble::Power) -> Weights {
    at!(elapsed, |elapsed| babble.at(elapsed, power))
}

/// Plays the cases with the files of a folder. Returns the answers, and the number of commands.
fn play(folder: PathBuf, cases: &str) -> (String, usize) {
    let (mut stage, mut count) = (Stage::new(folder), 0);
    for line in cases.lines().filter(|line| !line.starts_with("  ")) {
        stage.answers.push_str(line);
        stage.answers.push('\n');
        // This reader has all capabilities that sections need.
        if !line.is_empty() && !line.starts_with('#') && !line.starts_with("needs ") {
            stage.command(line);
            count += 1;
        }
    }
    (stage.answers, count)
}

#[track_caller]
fn assert_same(answers: &str, expected: &str) {
    let different = answers.lines().zip(expected.lines()).position(|(found, expected)| found != expected);
    let at = different.unwrap_or(0);
    let [found, said] = [answers, expected].map(|text| text.lines().nth(at));
    assert!(answers == expected, "cases.txt:{}: {found:?} instead of {said:?}", at + 1);
}

#[test]
fn the_reader_answers_as_the_cases_say() {
    let path = fixtures().join("playback/cases.txt");
    let expected = fs::read_to_string(&path).expect("the cases");
    let (answers, _) = play(fixtures().join("banks/v1"), &expected);
    if std::env::var_os("LIPZ_BLESS").is_some() {
        fs::write(&path, &answers).expect("the cases can be written");
        return;
    }
    assert_same(&answers, &expected);
}

/// A game uses several files like one.
#[test]
#[cfg(feature = "tools")]
fn files_in_every_layout_answer_as_the_cases_say() {
    let folder = tempfile::tempdir().expect("a folder");
    lipz_testkit::layouts::write(folder.path());
    let expected = fs::read_to_string(fixtures().join("playback/cases.txt")).expect("the cases");
    for layout in lipz_testkit::layouts::LAYOUTS {
        let (answers, count) = play(folder.path().join(layout), &expected);
        println!("{layout}: {count} commands");
        assert_same(&answers, &expected);
    }
}
