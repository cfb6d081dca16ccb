//! Every setting, once: its name, default, what it decides, and how its value is read.

mod audio;
mod general;
mod registry;
mod sync;
mod text;

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
        content: Content::Settings(general::GENERAL),
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
        content: Content::Settings(text::TEXT),
    },
    Table {
        name: "lints",
        about: "Levels of lints: \"allow\" (not reported), \"warn\" or \"deny\" (no bank is written). A pattern of files, from the folder of \
                lipz.toml, has a table of its own, [lints.\"voices/old/**\"], whose levels count there; of several that match, the last one.",
        content: Content::Map(LINTS),
    },
    Table {
        name: "registry",
        about: "Names that events and curves may use; others are reported.",
        content: Content::Settings(registry::REGISTRY),
    },
    Table {
        name: "emotions",
        about: "Emotions in texts and events, as curves: `curves` says of which clips, \"all\", \"values\" (only those in which an \
                emotion has a value, not `feels sad`) or \"off\"; `value` is that of emotions without one, `over` the seconds in \
                which a face changes, 0 for at once. Every other name is a word of the project for a blend of emotions.",
        content: Content::Map(EMOTIONS),
    },
    Table {
        name: "audio",
        about: "Recordings: with a folder of them, clips are compared with their recordings, and mouth shapes can be made \
                of them.",
        content: Content::Settings(audio::AUDIO),
    },
    Table {
        name: "voices",
        about: "Languages in which the lines are recorded. The original is that of `locale` in [audio], or else the \
                default locale; the others are dubs. A pattern says where the recordings of a language are below the \
                folder of [audio], and which keys its clips have, without an extension: `de-de/act1/mayor` is spoken in \
                German, and is the dub of `en-us/act1/mayor`, or of `act1/mayor`.",
        content: Content::Map(VOICES),
    },
    Table { name: "sync", about: "How mouth shapes are made of recordings.", content: Content::Settings(sync::SYNC) },
    Table {
        name: "babble",
        about: "How mouths move when there is no viseme data: the project's own babble profile, and others in [babble.NAME]. \
                Digits say how far lips (ooh) and jaw (aah) move; power transfers scale that by the loudness of the \
                voice; rate is digits per second. A named profile takes what it leaves out from the project's own.",
        content: Content::Map(BABBLE),
    },
    Table {
        name: "face",
        about: "How faces move by themselves (docs/guides/faces.md): the project's own profile, and others in [face.NAME]. `blink` is \
                the seconds from blink to blink on a calm face, `blink-anger` and so on while that emotion leads (in \
                proportion to `blink`, if you leave it out), 0 for never; `blink-length` the seconds that one takes. `double-blinks` is a percentage of the blinks, `glances` \
                one of the time. `head` is the degrees that it moves while the mouth does, with one `pose` in so many \
                seconds; `head-follows` the degrees that eyes turn before it turns, too; `fixation` the seconds that eyes stay \
                on one place. A named profile takes what it leaves out from the project's own. `keys = \"words\"` makes curves of what is \
                said: nods and shakes of the head, `nods` of 10 high, breath at the ends of sentences, `breath` of 10 deep, \
                brows and shrugs, and a pose of the head for each word.",
        content: Content::Map(FACE),
    },
];

const EMOTIONS: Map = Map {
    name: "NAME",
    flat_name: "",
    default: "the presets of docs/guides/faces.md",
    examples: &["curves = \"values\"", "value = 5", "over = 0.4", "smug = \"joy 2 + disgust 1\""],
    read: |name, value, to| to.emotions(name, value),
};

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

const VOICES: Map = Map {
    name: "LOCALE",
    flat_name: "voice",
    default: "one language, in `pattern` of [audio]",
    examples: &["en-us = \"en-us/{key}\"", "de-de = \"german/{key}.ogg\""],
    read: |name, value, to| to.voice(name, value),
};

const LINTS: Map = Map {
    name: "LINT",
    flat_name: "allow, warn, deny",
    default: "each lint's own level",
    examples: &[
        "warnings = \"deny\"",
        "unknown-emotion = \"allow\"",
        "segment-count = \"warn\"",
        "\"voices/old/**\" = { unknown-emotion = \"allow\" }",
    ],
    read: |name, value, to| to.level(name, value),
};

const FACE: Map = Map {
    name: "SETTING",
    flat_name: "",
    default: "the profile of docs/guides/faces.md",
    examples: &[
        "keys = \"words\"",
        "nods = 4",
        "breath = 1",
        "blink = 4",
        "blink-anger = 6",
        "blink-fear = 2",
        "blink-perplexed = 2",
        "blink-length = 0.24",
        "double-blinks = 10",
        "glances = 20",
        "head = 3",
        "head-follows = 20",
        "pose = 0.4",
        "fixation = 1",
        "robot = { blink = 0, glances = 0, head = 0 }",
    ],
    read: |name, value, to| to.face(name, value),
};

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
