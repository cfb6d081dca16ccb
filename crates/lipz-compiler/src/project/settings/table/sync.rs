//! `[sync]`: rules for making visemes from recordings.

use super::Setting;
use crate::project::settings::reading::inside;

pub(super) const SYNC: &[Setting] = &[
    Setting {
        name: "lexicon",
        flat_name: "lexicon",
        about: "File with the pronunciations of the project's own words, one per line, in CMUdict phones, IPA or kana: \
                `WESNOTH  W EH S N AO TH`.",
        default: "none",
        example: "\"lexicon.txt\"",
        read: |value, to| {
            to.settings.sync.lexicon = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "model",
        flat_name: "model",
        about: "File with a model of the project's voices, which `lipz sync --train` makes from the project's \
            recordings.",
        default: "the built-in model",
        example: "\"voices.lipzmodel\"",
        read: |value, to| {
            to.settings.sync.model = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "recogniser",
        flat_name: "recogniser",
        about: "File with a neural network that recognises phones, which `lipz import recogniser` makes. lipz uses it \
            for recordings without a text, and to compare other recordings with their texts.",
        default: "the built-in network",
        example: "\"phones.lipznet\"",
        read: |value, to| {
            to.settings.sync.recogniser = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "textgrids",
        flat_name: "textgrids",
        about: "Folder of TextGrids, `KEY.TextGrid`, with the times of words and phones. An existing TextGrid \
            determines the visemes, so that you can correct it in Praat. lipz writes missing TextGrids.",
        default: "none",
        example: "\"textgrids\"",
        read: |value, to| {
            to.settings.sync.textgrids = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "lead-ms",
        flat_name: "lead-ms",
        about: "Milliseconds by which a mouth shape precedes its phone, because lips move before the sound. Use 0 if \
            the game applies a lead itself.",
        default: "40",
        example: "40",
        read: |value, to| to.settings.sync.lead_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "hold-ms",
        flat_name: "hold-ms",
        about: "Minimum duration in milliseconds of closed lips (p, b, m) and of the lip under the teeth (f, v), so \
            that viewers can see them. It is rounded to whole frames.",
        default: "83, two frames at 24 per second",
        example: "83",
        read: |value, to| to.settings.sync.hold_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "hold-consonants",
        flat_name: "hold-consonants",
        about: "Hold the shapes of the other consonants (t, s, l, w, …) for as long as closed lips, if the vowels next \
            to them leave enough time.",
        default: "false",
        example: "false",
        read: |value, to| {
            to.settings.sync.hold_consonants = value.boolean(&mut to.diagnostics).unwrap_or_default();
        },
    },
    Setting {
        name: "phones",
        flat_name: "phones",
        about: "Write the phones of the recording and their times into the Lipz files (`phones`), from which faces in \
            three dimensions compute their mouths.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.sync.phones = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "shortest-wide-ms",
        flat_name: "shortest-wide-ms",
        about: "Vowels shorter than this many milliseconds do not open the mouth wide.",
        default: "42, one frame at 24 per second",
        example: "42",
        read: |value, to| to.settings.sync.shortest_wide_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "shortest-pause-ms",
        flat_name: "shortest-pause-ms",
        about: "Pauses between words shorter than this many milliseconds do not bring the mouth to rest.",
        default: "150",
        example: "150",
        read: |value, to| to.settings.sync.shortest_pause_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "rms-threshold-db",
        flat_name: "rms-threshold-db",
        about: "Level at which an rms mouth closes, in decibels below the loud parts of a recording.",
        default: "30",
        example: "30",
        read: |value, to| to.settings.sync.rms_threshold_db = value.positive(&mut to.diagnostics),
    },
    Setting {
        name: "rms-exponent",
        flat_name: "rms-exponent",
        about: "Relation of the opening of an rms mouth to the amplitude of the voice. With 1, the mouth opens in \
            proportion; with smaller values, it opens wider for quiet speech.",
        default: "0.5",
        example: "0.5",
        read: |value, to| to.settings.sync.rms_exponent = value.positive(&mut to.diagnostics),
    },
];
