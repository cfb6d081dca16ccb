//! The table of all settings: name, default, description, and a function to read the value.

mod audio;
mod general;
mod registry;
mod setting;
mod sync;
mod text;

pub use setting::{Content, Map, Setting, Table};

/// Returns the setting with this name outside its table, such as `max-lines`: the table, and the name in it. In a table
/// with any names, the name is their placeholder, such as `LOCALE`.
pub fn find_flat(name: &str) -> Option<(&'static Table, &'static str)> {
    let is_meant = |names: &str| names.split(", ").any(|flat| flat == name);
    TABLES.iter().find_map(|table| {
        let own = match &table.content {
            Content::Settings(settings) => settings.iter().find(|setting| is_meant(setting.flat_name))?.name,
            Content::Map(map) => is_meant(map.flat_name).then_some(map.name)?,
        };
        Some((table, own))
    })
}

/// All settings, in the order in which they are read and documented.
pub const TABLES: &[Table] = &[
    Table {
        name: "",
        about: "Paths of the Lipz files and the bank, and defaults for all files.",
        content: Content::Settings(general::GENERAL),
    },
    Table {
        name: "fallbacks",
        about: "Fallbacks of each locale: locales whose texts replace missing texts, in order of preference.",
        content: Content::Map(FALLBACKS),
    },
    Table {
        name: "coverage",
        about: "Minimum percentage of clips that must have their own text in a locale, or in each locale (`all`), for \
            lipz to write a bank.",
        content: Content::Map(COVERAGE),
    },
    Table {
        name: "text",
        about: "Display of texts, and limits on their size on screen and on their reading speed.",
        content: Content::Settings(text::TEXT),
    },
    Table {
        name: "lints",
        about: "Levels of lints: \"allow\" (not reported), \"warn\" or \"deny\" (no bank is written). To set levels \
            for only some files, add a table named after a pattern of their paths, relative to the folder of \
            lipz.toml: [lints.\"voices/old/**\"]. If several patterns match, the last one applies.",
        content: Content::Map(LINTS),
    },
    Table {
        name: "registry",
        about: "Names that events and curves may use. All other names are reported.",
        content: Content::Settings(registry::REGISTRY),
    },
    Table {
        name: "emotions",
        about: "Curves made from the emotions in texts and events. `curves` selects the clips that get these curves: \
            \"all\", \"values\" (only clips in which an emotion has a value, unlike `feels sad`) or \"off\" (none). \
            `value` is the value of emotions that are written without a value. `over` is the number of seconds that a \
            face takes to change; with 0, it changes immediately. Every other name defines an emotion of the project \
            as a blend.",
        content: Content::Map(EMOTIONS),
    },
    Table {
        name: "audio",
        about: "Recordings. If you name their folder, lipz compares clips with their recordings and can make visemes \
            from them.",
        content: Content::Settings(audio::AUDIO),
    },
    Table {
        name: "voices",
        about: "Languages in which the lines are recorded. The original language is the `locale` of [audio] or, if \
            that is not set, the default locale. All other languages are dubs. A pattern is the path of a language's \
            recordings below the folder of [audio]. Without its extension, it is also the pattern of the keys of the \
            language's clips: `de-de/act1/mayor` is spoken in German, and is the dub of `en-us/act1/mayor`, or of \
            `act1/mayor`.",
        content: Content::Map(VOICES),
    },
    Table {
        name: "dubs",
        about: "Sync status of lines: how far the length of a dub's recording may differ from that of its original. \
            The names are patterns of the keys of originals. `lip-sync` allows 5 percent, `time-constrained` 10 \
            percent, and `voice-over` any length; a number sets the percentage. If several patterns match, the last \
            one applies.",
        content: Content::Map(DUBS),
    },
    Table { name: "sync", about: "Rules for making visemes from recordings.", content: Content::Settings(sync::SYNC) },
    Table {
        name: "babble",
        about: "Movement of mouths without viseme data. The settings in this table are the project's own babble \
            profile; [babble.NAME] adds a named profile. Each digit sets how far the lips (`ooh`) or the jaw (`aah`) \
            move. The power transfers scale this movement by the loudness of the voice. `rate` is the number of digits \
            per second. A named profile takes settings that it does not contain from the project's own profile.",
        content: Content::Map(BABBLE),
    },
    Table {
        name: "face",
        about: "Generated movement of faces (docs/guides/faces.md). The settings in this table are the project's own \
            profile; [face.NAME] adds a named profile. `blink` is the time between blinks on a calm face in seconds, \
            and `blink-anger` and so on are the times while that emotion dominates (by default in proportion to \
            `blink`); 0 means that the face never blinks. `blink-length` is the duration of a blink in seconds. \
            `double-blinks` is the percentage of blinks that are double, and `glances` the percentage of time that the \
            eyes spend on glances. `head` is the number of degrees by which the head moves during speech, and `pose` \
            the number of seconds between its poses. `head-follows` is the number of degrees by which the eyes turn \
            before the head turns too. `fixation` is the number of seconds for which the eyes rest on one point. A \
            named profile takes settings that it does not contain from the project's own profile. `keys = \"words\"` \
            makes curves from the texts: nods and shakes of the head with the strength `nods` (up to 10), breaths at \
            the ends of sentences with the depth `breath` (up to 10), raised brows, shrugs, and a pose of the head for \
            each word.",
        content: Content::Map(FACE),
    },
    Table {
        name: "articulation",
        about: "How far mouths move that are computed from phones (docs/guides/articulation.md): the project's own \
            profile, and others in [articulation.NAME]. `gain` is the opening in percent of the default, and `jaw` \
            that of the jaw alone. `lead` is how many milliseconds the mouth is ahead of the audio. `level` is the \
            level of the speech, in decibels relative to full scale, at which the mouth opens as usual; louder lines \
            open it wider. The table `phones` of a profile changes the targets of phones, in percent. Settings missing \
            from a named profile come from the project's own.",
        content: Content::Map(ARTICULATION),
    },
    Table {
        name: "rig",
        about: "The shapes of your models (docs/guides/articulation.md). `true` adds a built-in rig to the bank. A \
            table [rig.NAME] describes a rig: the name of each shape, and a sum of terms. A term is a factor and an \
            input, or the product of two inputs.",
        content: Content::Map(RIG),
    },
    Table {
        name: "sprites",
        about: "Images of characters' mouths, which `lipz preview` shows instead of the drawn face. Each is a path with \
            `{code}`, which stands for a viseme code or for `rest`, or a sheet with images of the same width and, after \
            `#`, their codes from left to right. `default` is for all characters that are not listed.",
        content: Content::Map(SPRITES),
    },
];

const EMOTIONS: Map = Map {
    name: "NAME",
    flat_name: "",
    default: "the presets in docs/guides/faces.md",
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

const DUBS: Map = Map {
    name: "KEYS",
    flat_name: "",
    default: "`voice-over`",
    examples: &["\"cutscenes/**\" = \"lip-sync\"", "\"barks/**\" = \"time-constrained\"", "\"intro\" = 3"],
    read: |name, value, to| to.sync_status(name, value),
};

const LINTS: Map = Map {
    name: "LINT",
    flat_name: "allow, warn, deny",
    default: "each lint's default level",
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
    default: "the profile in docs/guides/faces.md",
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

const ARTICULATION: Map = Map {
    name: "SETTING",
    flat_name: "",
    default: "the profile of docs/guides/articulation.md",
    examples: &[
        "gain = 100",
        "jaw = 100",
        "lead = 10",
        "level = -20",
        "mumbler = { gain = 60, jaw = 40, phones = { AA = \"opening 60\" } }",
    ],
    read: |name, value, to| to.articulation(name, value),
};

const SPRITES: Map = Map {
    name: "CHARACTER",
    flat_name: "",
    default: "a drawn face",
    examples: &["default = \"mouths/{code}.svg\"", "mara = \"art/mara.png#-MAOESUFLW\""],
    read: |name, value, to| to.sprites(name, value),
};

const RIG: Map = Map {
    name: "NAME",
    flat_name: "",
    default: "no rigs",
    examples: &["arkit = true", "otto = { jawOpen = \"0.8 jaw\", mouthClose = \"0.8 jaw*closure\" }"],
    read: |name, value, to| to.rig(name, value),
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
