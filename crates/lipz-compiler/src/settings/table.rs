//! Every setting, once: its name, default, what it decides, and how its value is read.

use super::audio::refused_pattern;
use super::file::inside;
use super::reading::Reading;
use super::value::Value;

/// A table of `lipz.toml`.
pub struct Table {
    /// Its name; empty for the settings above the first table.
    pub name: &'static str,
    /// What its settings decide, in one sentence.
    pub about: &'static str,
    /// What it contains.
    pub content: Content,
}

/// What a table contains.
pub enum Content {
    /// Settings with names of their own.
    Settings(&'static [Setting]),
    /// Names that the project chooses.
    Map(Map),
}

/// One setting.
pub struct Setting {
    /// Its name in the table.
    pub name: &'static str,
    /// Its name where there are no tables, such as flags of a command: `max-lines`.
    pub flat_name: &'static str,
    /// What it decides, in one or two sentences.
    pub about: &'static str,
    /// What holds without it.
    pub default: &'static str,
    /// A value: the default if that can be written, otherwise an example.
    pub example: &'static str,
    pub(super) read: fn(&Value<'_>, &mut Reading<'_>),
}

/// Settings of one kind, by names that the project chooses.
pub struct Map {
    /// What the names stand for.
    pub name: &'static str,
    /// Names of entries where there are no tables, separated by `, `; empty if there are none.
    pub flat_name: &'static str,
    /// What holds for names that are not mentioned.
    pub default: &'static str,
    /// Some entries.
    pub examples: &'static [&'static str],
    /// Reads the entry with this name.
    pub(super) read: fn(&str, &Value<'_>, &mut Reading<'_>),
}

/// All settings, in the order in which they are read and documented.
pub const TABLES: &[Table] = &[
    Table {
        name: "",
        about: "Where the Lipz files are, where the bank goes, and what applies to all of them.",
        content: Content::Settings(GENERAL),
    },
    Table {
        name: "fallbacks",
        about: "Where missing texts of a locale come from: other locales, in order.",
        content: Content::Map(FALLBACKS),
    },
    Table {
        name: "coverage",
        about: "Percentage of the clips that must have their own text in a locale, or in `all`, before a bank is made.",
        content: Content::Map(COVERAGE),
    },
    Table {
        name: "text",
        about: "How texts are displayed, how much text fits on the screen, and how fast players read.",
        content: Content::Settings(TEXT),
    },
    Table {
        name: "lints",
        about: "Levels of lints: \"allow\" (not reported), \"warn\" or \"deny\" (no bank is written).",
        content: Content::Map(LINTS),
    },
    Table {
        name: "registry",
        about: "Names that events may use; others are reported.",
        content: Content::Settings(REGISTRY),
    },
    Table {
        name: "audio",
        about: "Recordings: with a folder of them, `lipz check` compares clips and recordings, and `lipz sync` makes \
                mouth shapes of them.",
        content: Content::Settings(AUDIO),
    },
    Table {
        name: "sync",
        about: "How `lipz sync` makes mouth shapes of recordings.",
        content: Content::Settings(SYNC),
    },
    Table {
        name: "babble",
        about: "How mouths move when there is no viseme data: the project's own babble profile, and others in [babble.NAME]. \
                Digits say how far lips (ooh) and jaw (aah) move; power transfers scale that by the loudness of the \
                voice; rate is digits per second. A named profile takes what it leaves out from the project's own.",
        content: Content::Map(BABBLE),
    },
];

const GENERAL: &[Setting] = &[
    Setting {
        name: "sources",
        flat_name: "sources",
        about: "Lipz files: folders, files and glob patterns.",
        default: "the folder of lipz.toml",
        example: "[\".\"]",
        read: |value, to| {
            let folder = to.folder;
            let sources =
                value.list(&mut to.diagnostics, |item, diagnostics| Some(inside(folder, item.text(diagnostics)?)));
            match sources {
                Some(sources) if sources.is_empty() => {
                    to.refuse(value, "names no sources", "name folders, files or patterns, or remove the line");
                }
                sources => to.settings.sources = sources.unwrap_or_default(),
            }
        },
    },
    Setting {
        name: "root",
        flat_name: "root",
        about: "Keys of clips are paths below this folder, without `.lipz`.",
        default: "each source folder",
        example: "\".\"",
        read: |value, to| to.settings.root = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "hidden",
        flat_name: "hidden",
        about: "Read hidden files and folders, too: those whose names start with a dot.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.hidden = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "output",
        flat_name: "output",
        about: "The bank that is written.",
        default: "named for each run",
        example: "\"dialogue.lipzbank\"",
        read: |value, to| to.settings.output = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "cache",
        flat_name: "cache",
        about: "File that remembers the Lipz files, so that the next run reads only the changed ones. Safe to delete. \
                Watching remembers them anyway; with this file, also between runs.",
        default: "every run reads all files",
        example: "\"dialogue.cache\"",
        read: |value, to| to.settings.cache = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "default-fps",
        flat_name: "default-fps",
        about: "Frame rate of files without `fps`, from 1 to 1000.",
        default: "unspecified, the game supplies it",
        example: "24",
        read: |value, to| to.settings.options.default_fps = value.fps(&mut to.diagnostics),
    },
    Setting {
        name: "default-viseme-type",
        flat_name: "default-viseme-type",
        about: "Viseme type of files without `viseme_type`: blair, toonboom or rms.",
        default: "unspecified, the game supplies it",
        example: "\"blair\"",
        read: |value, to| to.settings.options.default_viseme_type = value.viseme_type(&mut to.diagnostics),
    },
    Setting {
        name: "viseme-type",
        flat_name: "viseme-type",
        about: "Viseme type that clips of other types are converted to.",
        default: "each clip keeps its own",
        example: "\"toonboom\"",
        read: |value, to| to.settings.options.viseme_type = value.viseme_type(&mut to.diagnostics),
    },
    // Before the settings that contain locales.
    Setting {
        name: "extended-locales",
        flat_name: "extended-locales",
        about: "Accept any BCP 47 language tag (es-419, zh-hant), not only ll-cc.",
        default: "false",
        example: "false",
        read: |value, to| {
            to.settings.options.extended_locales = value.boolean(&mut to.diagnostics).unwrap_or_default();
        },
    },
    Setting {
        name: "default-locale",
        flat_name: "default-locale",
        about: "Locale of `text` without a locale, and the last fallback of all others.",
        default: "none",
        example: "\"en-us\"",
        read: |value, to| to.settings.options.default_locale = value.locale(to.extended(), &mut to.diagnostics),
    },
    Setting {
        name: "locales",
        flat_name: "locales",
        about: "Locales to pack.",
        default: "every locale of the files",
        example: "[\"en-us\", \"de-de\"]",
        read: |value, to| {
            let extended = to.extended();
            let locales = value.list(&mut to.diagnostics, |item, diagnostics| item.locale(extended, diagnostics));
            match locales {
                Some(locales) if locales.is_empty() => {
                    to.refuse(value, "names no locales", "name at least one, or remove the line for all");
                }
                locales => to.settings.options.locales = locales.map(FromIterator::from_iter),
            }
        },
    },
    Setting {
        name: "split-locales",
        flat_name: "split-locales",
        about: "Write the texts of each locale into a text bank beside the bank: `dialogue.de-de.lipztexts`.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.split_locales = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "pseudo",
        flat_name: "pseudo",
        about: "Add a pseudo-locale with the default locale's texts, accented and longer: `en-xa` for `en-us`.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.pseudo = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "strip",
        flat_name: "strip",
        about: "Leave out what only unpacking needs. The bank is smaller, and unpacks to display texts.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.strip = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
];

const FALLBACKS: Map = Map {
    name: "LOCALE",
    flat_name: "fallback",
    default: "locales of the same language and script, then the default locale",
    examples: &["de-at = [\"de-de\", \"en-us\"]", "es-mx = [\"es-es\"]"],
    read: |name, value, to| to.fallback(name, value),
};

const COVERAGE: Map = Map {
    name: "LOCALE",
    flat_name: "min-coverage",
    default: "no minimum",
    examples: &["all = 90", "de-de = 100"],
    read: |name, value, to| to.min_coverage(name, value),
};

const TEXT: &[Setting] = &[
    Setting {
        name: "literal-braces",
        flat_name: "literal-braces",
        about: "Display braces as they are: `{0}` is a placeholder of the game, not meta information.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.literal_braces = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "line-columns",
        flat_name: "max-line-columns",
        about: "Columns of a line; East Asian wide characters count two.",
        default: "no limit",
        example: "42",
        read: |value, to| to.settings.options.text_limits.line_columns = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "lines",
        flat_name: "max-lines",
        about: "Lines of a segment.",
        default: "no limit",
        example: "2",
        read: |value, to| to.settings.options.text_limits.lines = value.count(&mut to.diagnostics),
    },
    Setting {
        name: "characters-per-second",
        flat_name: "max-characters-per-second",
        about: "Characters of a segment per second of its time, which a player has to read.",
        default: "no limit",
        example: "17",
        read: |value, to| to.settings.options.text_limits.characters_per_second = value.positive(&mut to.diagnostics),
    },
];

const LINTS: Map = Map {
    name: "LINT",
    flat_name: "allow, warn, deny",
    default: "each lint's own level",
    examples: &["warnings = \"deny\"", "unknown-emotion = \"allow\"", "segment-count = \"warn\""],
    read: |name, value, to| to.level(name, value),
};

const AUDIO: &[Setting] = &[
    Setting {
        name: "folder",
        flat_name: "audio",
        about: "The folder of the recordings: WAV, FLAC, Ogg Vorbis and MP3 files.",
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
        about: "Locale that is spoken in the recordings.",
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
        about: "File in which `lipz sync` records what each mouth was made from. Keep it with the Lipz files: it tells \
                mouths that were changed by hand from others.",
        default: "`lipz-sync.txt` beside the Lipz files",
        example: "\"lipz-sync.txt\"",
        read: |value, to| {
            to.settings.audio.record = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
        },
    },
    Setting {
        name: "cache",
        flat_name: "audio-cache",
        about: "File in which `lipz check` remembers what it heard in recordings, so that the next run decodes only those \
                that changed. Safe to delete.",
        default: "every run decodes all recordings",
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

const SYNC: &[Setting] = &[
    Setting {
        name: "lexicon",
        flat_name: "lexicon",
        about: "File with the pronunciations of the project's own words, one a line, in the phones of CMUdict or in IPA: \
                `WESNOTH  W EH S N AO TH`.",
        default: "none",
        example: "\"lexicon.txt\"",
        read: |value, to| {
            to.settings.sync.lexicon = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path));
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

const BABBLE: Map = Map {
    name: "SETTING",
    flat_name: "",
    default: "the profile of Second Life's viewer",
    examples: &[
        "ooh = \"1247898743223344444443200000\"",
        "aah = \"257998776531013446642343\"",
        "ooh-power-transfer = \"0012345566778899\"",
        "aah-power-transfer = \"0000123456789\"",
        "rate = 24",
        "robot = { rate = 8, aah = \"0909\", ooh = \"0\" }",
    ],
    read: |name, value, to| to.babble(name, value),
};

const REGISTRY: &[Setting] = &[
    Setting {
        name: "characters",
        flat_name: "characters",
        about: "Characters of the scenes.",
        default: "any",
        example: "[\"samson\", \"amy\"]",
        read: |value, to| to.settings.options.known_names.characters = to.words(value),
    },
    Setting {
        name: "props",
        flat_name: "props",
        about: "Things that characters look or point at, other than characters.",
        default: "any",
        example: "[\"door\", \"lamp\"]",
        read: |value, to| to.settings.options.known_names.props = to.words(value),
    },
    Setting {
        name: "emotions",
        flat_name: "emotions",
        about: "Emotions beyond those of the specification.",
        default: "none",
        example: "[\"nervous\"]",
        read: |value, to| to.settings.options.known_names.emotions = to.words(value).unwrap_or_default(),
    },
    Setting {
        name: "actions",
        flat_name: "actions",
        about: "Actions of `does`.",
        default: "any",
        example: "[\"wave\", \"nod\"]",
        read: |value, to| to.settings.options.known_names.actions = to.words(value),
    },
];
