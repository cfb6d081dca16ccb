//! `[sync]`: how mouth shapes are made of recordings.

use super::Setting;
use crate::settings::file::inside;

pub(super) const SYNC: &[Setting] = &[
    Setting {
        name: "lexicon",
        flat_name: "lexicon",
        about: "File with the pronunciations of the project's own words, one a line, in the phones of CMUdict, in IPA, or in kana: \
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
        about: "File with a model of the project's own voices, which `lipz sync --train` makes of its recordings.",
        default: "the model that is built in",
        example: "\"voices.lipzmodel\"",
        read: |value, to| {
            to.settings.sync.model = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "recogniser",
        flat_name: "recogniser",
        about: "File with a neural network that hears phones, which `lipz recogniser` makes: for recordings without a text, and to compare the others with theirs.",
        default: "none: the model hears them",
        example: "\"phones.lipznet\"",
        read: |value, to| {
            to.settings.sync.recogniser = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "textgrids",
        flat_name: "textgrids",
        about: "Folder of TextGrids, `KEY.TextGrid`, with the times of words and phones. One that is there makes the mouth, so that it can be corrected in Praat; one that is not is written.",
        default: "none",
        example: "\"textgrids\"",
        read: |value, to| {
            to.settings.sync.textgrids = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "lead-ms",
        flat_name: "lead-ms",
        about: "Milliseconds by which a shape is ahead of its sound, as lips are. Use 0 if the game leads the sound itself.",
        default: "40",
        example: "40",
        read: |value, to| to.settings.sync.lead_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "hold-ms",
        flat_name: "hold-ms",
        about: "Milliseconds for which closed lips (p, b, m), and the lip under the teeth (f, v), stay at least, so that \
                they can be seen; rounded to whole frames.",
        default: "83, two frames at 24 a second",
        example: "83",
        read: |value, to| to.settings.sync.hold_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "hold-consonants",
        flat_name: "hold-consonants",
        about: "Whether the shapes of the other consonants (t, s, l, w, …) stay as long as closed lips do, as far as the vowels \
                beside them have time to spare.",
        default: "false",
        example: "false",
        read: |value, to| {
            to.settings.sync.hold_consonants = value.boolean(&mut to.diagnostics).unwrap_or_default();
        },
    },
    Setting {
        name: "shortest-wide-ms",
        flat_name: "shortest-wide-ms",
        about: "Milliseconds below which a vowel does not open the mouth wide.",
        default: "42, a frame at 24 a second",
        example: "42",
        read: |value, to| to.settings.sync.shortest_wide_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "shortest-pause-ms",
        flat_name: "shortest-pause-ms",
        about: "Milliseconds below which a pause between words does not bring the mouth to rest.",
        default: "150",
        example: "150",
        read: |value, to| to.settings.sync.shortest_pause_ms = value.milliseconds(&mut to.diagnostics),
    },
    Setting {
        name: "rms-threshold-db",
        flat_name: "rms-threshold-db",
        about: "Decibels below the loud parts of a recording at which a mouth of the viseme type rms is closed.",
        default: "30",
        example: "30",
        read: |value, to| to.settings.sync.rms_threshold_db = value.positive(&mut to.diagnostics),
    },
    Setting {
        name: "rms-exponent",
        flat_name: "rms-exponent",
        about: "How far a mouth of the viseme type rms opens with the amplitude of the voice: 1 is in proportion, less opens \
                it wider for what is quiet.",
        default: "0.5",
        example: "0.5",
        read: |value, to| to.settings.sync.rms_exponent = value.positive(&mut to.diagnostics),
    },
];
