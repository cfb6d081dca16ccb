//! Subtitles: other programs can read the written files, and round trips preserve them.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_file::Document;
use lipz_file::rate::{Rate, parse};
use lipz_interop::subtitles::{Cue, SubtitleFormat, SubtitleOptions, clip, cues, join};
use proptest::prelude::*;
use subtp::srt::{SrtTimestamp, SubRip};
use subtp::vtt::{VttBlock, VttTimestamp, WebVtt};

fn document(json: &str) -> Document<'static> {
    lipz_file::parse(json.to_owned().leak().as_bytes()).document.unwrap()
}

fn cues_of(document: &Document<'_>) -> Vec<Cue> {
    cues(document, "en-us", &SubtitleOptions::default(), &mut Vec::new()).unwrap()
}

/// Returns the usual frame rates of clips.
fn rates() -> impl Strategy<Value = Rate> {
    prop::sample::select(vec!["1", "12.5", "23.976", "24", "25", "29.97", "30", "60", "1000"])
        .prop_map(|rate| parse(rate).unwrap())
}

/// Returns segments, each with a number of frames and a text. No two segments without a text are adjacent, because
/// subtitles cannot distinguish them.
fn segments() -> impl Strategy<Value = Vec<(usize, String)>> {
    let text = "[A-Za-zäé灯台ع<>&!-][A-Za-zäé灯台ع<>&! -]{0,12}[A-Za-zäé灯台ع<>&!]";
    let text = prop_oneof![3 => text, 1 => Just(String::new())];
    prop::collection::vec((1_usize..40, text), 1..8).prop_map(|mut all| {
        all.dedup_by(|a, b| a.1.is_empty() && b.1.is_empty());
        all
    })
}

fn clip_of(segments: &[(usize, String)], rate: Rate) -> Document<'static> {
    let visemes: Vec<String> = segments.iter().map(|(frames, _)| "-".repeat(*frames)).collect();
    let texts: Vec<&str> = segments.iter().map(|(_, text)| text.as_str()).collect();
    let fps = f64::from(rate.numerator) / f64::from(rate.denominator);
    let (visemes, text) = (visemes.join("|"), lipz_file::literal(&texts.join("|")));
    document(&format!("{{\"visemes\": \"{visemes}\", \"text_en-us\": {text}, \"fps\": {fps}}}"))
}

/// The result of another program: times in milliseconds and lines.
type Read = Vec<(u64, u64, String)>;

fn ms(hours: u8, minutes: u8, seconds: u8, milliseconds: u16) -> u64 {
    u64::from(milliseconds) + 1000 * (u64::from(seconds) + 60 * (u64::from(minutes) + 60 * u64::from(hours)))
}

fn read_srt(file: &str) -> Read {
    let ms = |time: SrtTimestamp| ms(time.hours, time.minutes, time.seconds, time.milliseconds);
    let all = SubRip::parse(file).unwrap().subtitles.into_iter();
    all.map(|subtitle| (ms(subtitle.start), ms(subtitle.end), subtitle.text.join("\n"))).collect()
}

fn read_vtt(file: &str) -> Read {
    let ms = |time: VttTimestamp| ms(time.hours, time.minutes, time.seconds, time.milliseconds);
    let all = WebVtt::parse(file).unwrap().blocks.into_iter();
    all.filter_map(|block| match block {
        VttBlock::Que(cue) => Some((ms(cue.timings.start), ms(cue.timings.end), cue.payload.join("\n"))),
        _ => None,
    })
    .collect()
}

proptest! {
    /// A round trip from clip to subtitles preserves the frames and texts of segments.
    #[test]
    fn clips_return(segments in segments(), rate in rates()) {
        let before = clip_of(&segments, rate);
        let cues = cues_of(&before);
        for format in SubtitleFormat::ALL {
            let mut diagnostics = Vec::new();
            let file = format.write(&cues, &mut diagnostics);
            prop_assume!(diagnostics.is_empty()); // an arrow, which SubRip cannot hold
            let read = format.read(file.as_bytes(), &mut diagnostics);
            // Rest after the last text is in no subtitle. The clip to which they are joined contains it.
            let frames: usize = segments.iter().map(|(frames, _)| frames).sum();
            let undivided = document(&format!("{{\"visemes\": \"{}\"}}", "-".repeat(frames)));
            let options = SubtitleOptions { default_rate: Some(rate), ..SubtitleOptions::default() };
            let after = join(undivided, &read, "en-us", &options, &mut diagnostics);
            prop_assert_eq!(&diagnostics, &[], "{}", file);
            prop_assert_eq!(after.string("visemes"), before.string("visemes"), "{}", file);
            prop_assert_eq!(after.string("text_en-us"), before.string("text_en-us"), "{}", file);
        }
    }

    /// Programs other than lipz read the same times and texts.
    #[test]
    fn others_read_what_is_written(segments in segments(), rate in rates()) {
        let cues = cues_of(&clip_of(&segments, rate));
        prop_assume!(!cues.is_empty() && cues.iter().all(|cue| !cue.text.contains("-->")));
        let written = |spell: &dyn Fn(&str) -> String| -> Read {
            cues.iter().map(|cue| (cue.start_ms, cue.end_ms, spell(&cue.text))).collect()
        };
        let srt = SubtitleFormat::Srt.write(&cues, &mut Vec::new());
        prop_assert_eq!(read_srt(&srt), written(&str::to_owned));
        let vtt = SubtitleFormat::Vtt.write(&cues, &mut Vec::new());
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        prop_assert_eq!(read_vtt(&vtt), written(&escaped));
    }

    /// No content of a file stops the reader, and every diagnostic has a position in the file.
    #[test]
    fn any_file_is_read(bytes in prop::collection::vec(any::<u8>(), 0..200), cut in 0_usize..100, change in any::<u8>()) {
        let vtt = b"WEBVTT\n\n00:01.500 --> 00:02.000 line:0\n<v Mara>Good &amp; <i>late</i>\n\n1\n00:02,0 --> 3";
        let mut changed = vtt[..cut.min(vtt.len())].to_vec();
        if let Some(last) = changed.last_mut() {
            *last = change;
        }
        for file in [bytes, changed, vtt[6..].to_vec()] {
            for format in SubtitleFormat::ALL {
                let mut diagnostics = Vec::new();
                format.read(&file, &mut diagnostics);
                // The position of a byte that is not UTF-8 refers to the text in which it is replaced.
                diagnostics.retain(|diagnostic| diagnostic.code != lipz_diagnostics::Code::NotUtf8);
                let places = diagnostics.iter().flat_map(|diagnostic| diagnostic.primary.iter().chain(&diagnostic.labels));
                prop_assert!(places.clone().all(|label| label.span.end as usize <= file.len()), "{:?}", diagnostics);
            }
        }
    }
}

#[test]
fn files_of_other_tools_are_read() {
    let srt = "\u{feff}1\r\n00:00:00,500 --> 00:00:01,000 X1:1 X2:2\r\n<i>Good</i>\r\nevening.\r\n\r\n\
               00:00:01.250 --> 00:00:02.000\r\n{\\an8}Who?\r\n";
    let mut diagnostics = Vec::new();
    let cues = SubtitleFormat::Srt.read(srt.as_bytes(), &mut diagnostics);
    let texts: Vec<_> = cues.iter().map(|cue| (cue.start_ms, cue.end_ms, cue.text.as_str())).collect();
    assert_eq!(texts, [(500, 1000, "Good\nevening."), (1250, 2000, "{\\an8}Who?")]);
    assert_eq!(diagnostics.len(), 1, "the tags: {diagnostics:?}");
    let vtt = "WEBVTT - made by hand\nKind: captions\n\nNOTE\nnot a text\n\nSTYLE\n::cue { }\n\nintro\n\
               00:00.500 --> 00:01.000 align:start\n<v Mara>Good evening.\n";
    let cues = SubtitleFormat::Vtt.read(vtt.as_bytes(), &mut Vec::new());
    assert_eq!(cues.len(), 1);
    assert_eq!(cues[0].text, "{speaker: Mara} Good evening.");
}

#[test]
fn clips_with_segments_keep_them() {
    let before = r#"{"fps":24,"visemes":"MAAA--|EEOO--","text_en-us":" {sly} Good evening. |Who?"}"#;
    let cue = |start_ms, end_ms, text: &str| Cue { start_ms, end_ms, text: text.into(), ..Cue::default() };
    let joined = |cues: &[Cue], locale: &str| {
        let mut diagnostics = Vec::new();
        let after = join(document(before), cues, locale, &SubtitleOptions::default(), &mut diagnostics);
        assert_eq!(after.string("visemes"), Some("MAAA--|EEOO--"));
        (after.string(&format!("text_{locale}")).unwrap().to_owned(), diagnostics.len())
    };
    let german = [cue(0, 240, "Guten Abend."), cue(260, 500, "Wer?")];
    assert_eq!(joined(&german, "de-de"), ("Guten Abend.|Wer?".to_owned(), 0));
    let one = [cue(0, 500, "Guten Abend. Wer?")];
    assert_eq!(joined(&one, "de-de"), ("Guten Abend. Wer?|".to_owned(), 1));
    let short = [cue(0, 240, "Guten Abend."), cue(260, 262, "Wer?")];
    assert_eq!(joined(&short, "de-de"), ("Guten Abend.|Wer?".to_owned(), 1));
    let english = [cue(0, 240, "Good evening."), cue(260, 400, "Who"), cue(400, 500, "is it?")];
    assert_eq!(joined(&english, "en-us"), (" {sly} Good evening. |Who\nis it?".to_owned(), 0), "meta stays");
}

#[test]
fn cues_outside_their_clip_are_not_imported() {
    let divided = r#"{"fps":24,"visemes":"MAAA--|EEOO--","text_en-us":"Good. |Who?","text_de-de":"Gut. |Wer?"}"#;
    let undivided = r#"{"fps":24,"visemes":"MAAA--EEOO--"}"#;
    let of = |times: &[(u64, u64)]| -> Vec<Cue> {
        let cue = |&(start_ms, end_ms)| Cue { start_ms, end_ms, text: format!("{start_ms}"), ..Cue::default() };
        times.iter().map(cue).collect()
    };
    let joined = |clip: &str, cues: &[Cue]| {
        let mut diagnostics = Vec::new();
        let after = join(document(clip), cues, "de-de", &SubtitleOptions::default(), &mut diagnostics);
        (
            after,
            diagnostics
                .into_iter()
                .map(|diagnostic| (diagnostic.code.to_string(), diagnostic.message))
                .collect::<Vec<_>>(),
        )
    };
    let hour = 3_600_000;
    let outside =
        |start: &str| ("LZ1306".to_owned(), format!("the subtitle starts at {start} s, but the clip ends at 0.500 s"));
    let from = |hour: &str| {
        ("LZ1302".to_owned(), format!("the times count from {hour}:00:00.000, not from the start of the clip"))
    };
    for clip in [divided, undivided] {
        for (cues, expected) in [
            (of(&[(0, 240), (260, 500), (500, 600)]), vec![outside("0.500")]),
            (of(&[(5000, 5240), (5260, 5500)]), vec![outside("5.000")]),
            (of(&[(hour - 1000, hour), (hour, hour + 200)]), vec![outside("3599.000")]),
            (of(&[(hour, hour + 240), (hour + 600, hour + 700)]), vec![from("01"), outside("0.600")]),
        ] {
            assert_eq!(joined(clip, &cues), (document(clip), expected));
        }
        let (after, told) = joined(clip, &of(&[(10 * hour, 10 * hour + 240), (10 * hour + 250, 10 * hour + 500)]));
        assert_eq!((after.string("text_de-de"), told), (Some("36000000|36000250"), vec![from("10")]));
    }
    let mut diagnostics = Vec::new();
    let made = clip(&of(&[(10 * hour + 500, 10 * hour + 1000)]), "de-de", parse("10").unwrap(), &mut diagnostics);
    assert_eq!((made.string("visemes"), diagnostics.len()), (Some("-----|-----"), 1));
}

#[test]
fn clips_of_subtitles_alone_rest() {
    let cues = [Cue { start_ms: 500, end_ms: 1000, text: "Good evening.".into(), ..Cue::default() }];
    let made = clip(&cues, "en-us", parse("10").unwrap(), &mut Vec::new());
    assert_eq!((made.string("visemes"), made.string("text_en-us")), (Some("-----|-----"), Some("|Good evening.")));
    let nothing = clip(&[], "en-us", parse("10").unwrap(), &mut Vec::new());
    assert_eq!((nothing.string("visemes"), nothing.string("text_en-us")), (Some(""), Some("")));
}

/// Comparing all segments with each cue would take hours.
#[test]
fn many_cues_find_their_segments() {
    let count = 200_000;
    let file = format!("{{ \"fps\": 24, \"visemes\": \"{}MA\", \"text_de-de\": \"x\" }}", "MA|".repeat(count - 1));
    let clip = document(&file);
    let srt = |segment: usize| {
        let at = |segment: usize| {
            let ms = segment * 2 * 1000 / 24;
            format!("{:02}:{:02}:{:02},{:03}", ms / 3_600_000, ms / 60_000 % 60, ms / 1000 % 60, ms % 1000)
        };
        format!("{} --> {}\nx{segment}\n\n", at(segment), at(segment + 1))
    };
    let file: String = (0..count).map(srt).collect();
    let cues = SubtitleFormat::Srt.read(file.as_bytes(), &mut Vec::new());
    let mut diagnostics = Vec::new();
    let joined = join(clip, &cues, "en-us", &SubtitleOptions::default(), &mut diagnostics);
    let text: Vec<&str> = joined.string("text_en-us").unwrap().split('|').collect();
    assert_eq!((text.len(), text[0], text[count - 1]), (count, "x0", "x199999"));
    assert_eq!(diagnostics, []);
}
