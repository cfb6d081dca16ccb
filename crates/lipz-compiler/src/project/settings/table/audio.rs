//! `[audio]`: the recordings of a project.

use super::Setting;
use crate::project::settings::audio::refused_pattern;
use crate::project::settings::reading::inside;

pub(super) const AUDIO: &[Setting] = &[
    Setting {
        name: "folder",
        flat_name: "audio",
        about: "Folder that contains the recordings: WAV, AIFF, FLAC, Ogg Vorbis or MP3 files.",
        default: "none",
        example: "\"recordings\"",
        read: |value, to| {
            to.settings.audio.folder = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "pattern",
        flat_name: "audio-pattern",
        about: "Path of a clip's recording below `folder`. `{key}` stands for the key of the clip. If the pattern has \
            no extension, any supported extension matches.",
        default: "`{key}`",
        example: "\"en-us/{key}\"",
        read: |value, to| {
            let Some(pattern) = value.text(&mut to.diagnostics) else { return };
            match refused_pattern(pattern) {
                Some((what, help)) => to.refuse(value, what, help),
                None => to.settings.audio.pattern = Some(pattern.to_owned()),
            }
        },
    },
    Setting {
        name: "locale",
        flat_name: "audio-locale",
        about: "Locale spoken in the recordings. If [voices] has a pattern for this locale, `pattern` is ignored.",
        default: "the default locale",
        example: "\"en-us\"",
        read: |value, to| to.settings.audio.locale = value.locale(to.extended(), &mut to.diagnostics),
    },
    Setting {
        name: "tolerance-ms",
        flat_name: "audio-tolerance-ms",
        about: "Milliseconds by which the length of a clip may differ from the length of its recording.",
        default: "one frame of the clip",
        example: "50",
        read: |value, to| to.settings.audio.tolerance_ms = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "record",
        flat_name: "audio-record",
        about: "File that records how all visemes were made. Keep it with the Lipz files; lipz uses it to recognise \
            hand-edited visemes.",
        default: "`lipz-sync.txt` next to the Lipz files",
        example: "\"lipz-sync.txt\"",
        read: |value, to| {
            to.settings.audio.record = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "cache",
        flat_name: "audio-cache",
        about: "File that stores measurements of the recordings, so that the next check decodes only changed \
            recordings. Safe to delete.",
        default: "every check decodes all recordings",
        example: "\"recordings.cache\"",
        read: |value, to| {
            to.settings.audio.cache = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "in-bank",
        flat_name: "audio-in-bank",
        about: "Put the length and the content hash of each recording into the bank, so that a game can detect a \
            changed recording.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.audio.in_bank = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
];
