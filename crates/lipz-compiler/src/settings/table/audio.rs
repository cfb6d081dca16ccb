//! `[audio]`: the recordings of a project.

use super::Setting;
use crate::settings::audio::refused_pattern;
use crate::settings::file::inside;

pub(super) const AUDIO: &[Setting] = &[
    Setting {
        name: "folder",
        flat_name: "audio",
        about: "The folder of the recordings: WAV, AIFF, FLAC, Ogg Vorbis and MP3 files.",
        default: "none",
        example: "\"recordings\"",
        read: |value, to| {
            to.settings.audio.folder = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "pattern",
        flat_name: "audio-pattern",
        about: "Path of a clip's recording below that folder; `{key}` is the key of the clip. Without an extension, any \
                that is known will do.",
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
        about: "Locale that is spoken in the recordings. If it is one of [voices], its pattern counts.",
        default: "the default locale",
        example: "\"en-us\"",
        read: |value, to| to.settings.audio.locale = value.locale(to.extended(), &mut to.diagnostics),
    },
    Setting {
        name: "tolerance-ms",
        flat_name: "audio-tolerance-ms",
        about: "Milliseconds by which the length of a clip may differ from that of its recording.",
        default: "a frame of the clip",
        example: "50",
        read: |value, to| to.settings.audio.tolerance_ms = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "record",
        flat_name: "audio-record",
        about: "File that records from what each mouth was made. Keep it with the Lipz files: it tells mouths that were \
                changed by hand from others.",
        default: "`lipz-sync.txt` beside the Lipz files",
        example: "\"lipz-sync.txt\"",
        read: |value, to| {
            to.settings.audio.record = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "cache",
        flat_name: "audio-cache",
        about: "File that remembers what was heard in recordings, so that the next check decodes only those that changed. \
                Safe to delete.",
        default: "every check decodes all recordings",
        example: "\"recordings.cache\"",
        read: |value, to| {
            to.settings.audio.cache = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "in-bank",
        flat_name: "audio-in-bank",
        about: "Put the length and the content hash of each recording into the bank, so that a game can tell that a \
                sound is another one.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.audio.in_bank = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
];
