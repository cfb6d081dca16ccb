//! The settings before the first table: paths, and settings that apply to all files.

use super::Setting;
use crate::project::settings::reading::inside;

pub(super) const GENERAL: &[Setting] = &[
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
        about: "Folder that keys are relative to. The key of a clip is the path of its file below this folder, without \
            `.lipz`.",
        default: "each source folder",
        example: "\".\"",
        read: |value, to| to.settings.root = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "hidden",
        flat_name: "hidden",
        about: "Also read hidden files and folders, whose names start with a dot.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.hidden = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "output",
        flat_name: "output",
        about: "Path of the bank to write.",
        default: "named on the command line",
        example: "\"dialogue.lipzbank\"",
        read: |value, to| to.settings.output = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "cache",
        flat_name: "cache",
        about: "File that stores the compiled Lipz files, so that the next run reads only changed files. Safe to \
            delete. `lipz watch` keeps compiled files in memory anyway, and uses this file to keep them between runs.",
        default: "every run reads all files",
        example: "\"dialogue.cache\"",
        read: |value, to| to.settings.cache = value.text(&mut to.diagnostics).map(|path| inside(to.folder, path)),
    },
    Setting {
        name: "default-fps",
        flat_name: "default-fps",
        about: "Frame rate of files without `fps`, from 1 to 1000.",
        default: "unspecified; the game supplies it",
        example: "24",
        read: |value, to| to.settings.options.default_fps = value.fps(&mut to.diagnostics),
    },
    Setting {
        name: "default-viseme-type",
        flat_name: "default-viseme-type",
        about: "Viseme type of files without `viseme_type`: blair, toonboom or rms.",
        default: "unspecified; the game supplies it",
        example: "\"blair\"",
        read: |value, to| to.settings.options.default_viseme_type = value.viseme_type(&mut to.diagnostics),
    },
    Setting {
        name: "viseme-type",
        flat_name: "viseme-type",
        about: "Viseme type that clips of other types are converted to.",
        default: "each clip keeps its type",
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
        about: "Locale of elements named `text`, without a locale, and the last fallback of all other locales.",
        default: "none",
        example: "\"en-us\"",
        read: |value, to| to.settings.options.default_locale = value.locale(to.extended(), &mut to.diagnostics),
    },
    Setting {
        name: "locales",
        flat_name: "locales",
        about: "Locales to pack.",
        default: "every locale in the files",
        example: "[\"en-us\", \"de-de\"]",
        read: |value, to| {
            let extended = to.extended();
            let locales = value.list(&mut to.diagnostics, |item, diagnostics| item.locale(extended, diagnostics));
            match locales {
                Some(locales) if locales.is_empty() => {
                    to.refuse(value, "names no locales", "name at least one, or remove the line to pack all");
                }
                locales => to.settings.options.locales = locales.map(FromIterator::from_iter),
            }
        },
    },
    Setting {
        name: "split-locales",
        flat_name: "split-locales",
        about: "Write the texts of each locale into a text bank next to the bank: `dialogue.de-de.lipztexts`.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.split_locales = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "split-voices",
        flat_name: "split-voices",
        about: "Write the dubs of each voice into a patch on top of the bank of the originals: \
            `dialogue.de-de.lipzbank`.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.split_voices = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "pseudo",
        flat_name: "pseudo",
        about: "Add a pseudo-locale, such as `en-xa` for `en-us`, with accented and lengthened copies of the default \
            locale's texts.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.pseudo = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "strip",
        flat_name: "strip",
        about: "Leave out data that only unpacking needs. The bank is smaller, but the texts in unpacked files are \
            only display texts.",
        default: "false",
        example: "false",
        read: |value, to| to.settings.options.strip = value.boolean(&mut to.diagnostics).unwrap_or_default(),
    },
    Setting {
        name: "bake",
        flat_name: "bake",
        about: "Rig whose weights become ordinary curves in the bank, for programs that do not compute weights.",
        default: "no rig; programs compute weights",
        example: "\"arkit\"",
        read: |value, to| to.baked = value.text(&mut to.diagnostics).map(|name| (name.to_owned(), value.span())),
    },
];
