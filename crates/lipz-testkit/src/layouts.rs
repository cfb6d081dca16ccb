//! The golden banks of the playback cases, each also in several files that return the same answers: a bank and a patch,
//! a set, and a set with a patch.

use crate::dialogues::{assert_same, with};
use lipz_bank::Bank;
use lipz_compiler::settings::Settings;
use lipz_compiler::shard::{Link, Shard, shard_of_key};
use lipz_compiler::{Compiler, Input, Options, Stack, StackBelow, Voices};
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// The folders that [`write`] creates.
pub const LAYOUTS: [&str; 3] = ["stack", "set", "patched-set"];

/// The number of banks of a set.
const SHARDS: NonZero<u16> = NonZero::new(3).expect("not 0");

/// The sources of a golden bank.
struct GoldenProject {
    bank: &'static str,
    sources: &'static str,
    options: fn(Options) -> Options,
}

const PROJECTS: [GoldenProject; 10] = [
    GoldenProject { bank: "drama", sources: "drama", options: before_curves },
    GoldenProject { bank: "small", sources: "banks/sources/small", options: before_curves },
    GoldenProject {
        bank: "stripped",
        sources: "banks/sources/small",
        options: |options| before_curves(options).strip(true),
    },
    GoldenProject { bank: "long", sources: "banks/sources/long", options: before_curves },
    GoldenProject { bank: "curves", sources: "banks/sources/curves", options: english },
    GoldenProject { bank: "faces", sources: "banks/sources/faces", options: english },
    GoldenProject { bank: "specials", sources: "banks/sources/specials", options: |options| options },
    GoldenProject { bank: "phones", sources: "banks/sources/phones", options: |options| options },
    GoldenProject { bank: "dubbed", sources: "banks/sources/dubbed", options: dubbed },
    GoldenProject {
        bank: "variants",
        sources: "banks/sources/variants",
        options: |options| english(options).literal_braces(true),
    },
];

/// Files that are the same in each layout: a split bank and its texts.
const AS_THEY_ARE: [&str; 3] = ["split.lipzbank", "split.de-de.lipztexts", "split.en-us.lipztexts"];

fn english(options: Options) -> Options {
    options.default_locale("en-us").expect("a locale")
}

/// For banks that are older than curves for emotions without values.
fn before_curves(options: Options) -> Options {
    let settings = Settings::parse("[emotions]\ncurves = \"values\"", "lipz.toml", "").expect("settings");
    english(options.emotions(settings.options.get_emotions().clone()))
}

fn dubbed(options: Options) -> Options {
    let voices = Voices::new("en-us").expect("a voice").dub("de-de", "de/{key}").expect("a voice");
    english(options.voices(voices.dub("de-at", "at/{key}").expect("a voice")))
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")
}

/// Writes a folder for each of [`LAYOUTS`]. Its `NAME.list` contains the files of the golden bank `NAME` in their
/// order; the banks of a set are next to its index. Without a list, the file is `NAME.lipzbank`.
pub fn write(folder: &Path) {
    for layout in LAYOUTS {
        fs::create_dir_all(folder.join(layout)).expect("a folder");
        for file in AS_THEY_ARE {
            fs::copy(fixtures().join("banks/v1").join(file), folder.join(layout).join(file)).expect("a copy");
        }
    }
    for project in &PROJECTS {
        project.write(folder);
    }
}

impl GoldenProject {
    fn write(&self, folder: &Path) {
        let sources = fixtures().join(self.sources);
        let settings = sources.join("lipz.toml");
        let is_own = settings.is_file() && self.bank != "drama";
        let settings = if is_own { Settings::read(settings).expect("settings") } else { Settings::default() };
        let compiler = Compiler::new((self.options)(settings.options).threads(1));
        let inputs = lipz_compiler::discover(&[sources], None).expect("sources");
        let older = older(&inputs);
        let golden = fs::read(fixtures().join(format!("banks/v1/{}.lipzbank", self.bank))).expect("a golden bank");
        let golden = Bank::open(&golden).and_then(Bank::verify).expect("a golden bank");
        let name = |extension: &str| format!("{}.{extension}", self.bank);
        let patch_over = |files: &[PathBuf]| {
            let contents: Vec<Vec<u8>> = files.iter().map(|file| fs::read(file).expect("a file")).collect();
            let stack = Stack::open(contents.iter().map(|bytes| ("", bytes.as_slice()))).expect("a stack");
            compiler.compile_over(&inputs, &StackBelow::new(stack)).into_bank().expect("a change")
        };
        let list = |layout: &str, names: &[String]| {
            let folder = folder.join(layout);
            fs::write(folder.join(name("list")), names.join("\n") + "\n").expect("a list");
        };
        // Like a patched game.
        let stack = folder.join("stack");
        fs::write(stack.join(name("base.lipzbank")), compiler.compile(&older).into_bank().expect("a bank"))
            .expect("a file");
        let files = [stack.join(name("base.lipzbank"))];
        fs::write(stack.join(name("patch.lipzbank")), patch_over(&files)).expect("a file");
        list("stack", &[name("base.lipzbank"), name("patch.lipzbank")]);
        assert_answers(&[&files[0], &stack.join(name("patch.lipzbank"))], &golden);
        // Like a large game.
        let set = folder.join("set");
        let files = link(&compiler, &inputs, &set.join(name("lipzset")));
        list("set", &[name("lipzset")]);
        assert_answers(&files.iter().map(PathBuf::as_path).collect::<Vec<_>>(), &golden);
        // Like a large, patched game.
        let patched = folder.join("patched-set");
        let mut files = link(&compiler, &older, &patched.join(name("lipzset")));
        fs::write(patched.join(name("patch.lipzbank")), patch_over(&files)).expect("a file");
        list("patched-set", &[name("lipzset"), name("patch.lipzbank")]);
        files.push(patched.join(name("patch.lipzbank")));
        assert_answers(&files.iter().map(PathBuf::as_path).collect::<Vec<_>>(), &golden);
    }
}

/// Returns an older version of a project: without every third clip, and with every other one replaced by the contents
/// of the clip before it.
fn older(inputs: &[Input]) -> Vec<Input> {
    let pairs = inputs.iter().enumerate().filter(|(number, _)| number % 3 != 2 || inputs.len() < 3);
    let older = pairs.map(|(number, input)| match number % 3 {
        1 => Input { key: input.key.clone(), ..inputs[number - 1].clone() },
        _ => input.clone(),
    });
    older.chain([Input::from_bytes("removed", r#"{ "text_en-us": "Gone." }"#)]).collect()
}

/// Links a set. Returns its index, and its banks in their order.
fn link(compiler: &Compiler<'_>, inputs: &[Input], index: &Path) -> Vec<PathBuf> {
    let folder = index.with_extension("objects");
    fs::create_dir_all(&folder).expect("a folder");
    let objects = (0..SHARDS.get()).map(|shard| {
        let voices = compiler.options().get_voices();
        let own = inputs.iter().filter(|input| shard_of_key(&input.key, voices, SHARDS) == shard);
        let object = compiler.object(&own.cloned().collect::<Vec<_>>(), &Shard::new(shard, SHARDS.get()));
        let path = folder.join(format!("{shard}.lipzobj"));
        fs::write(&path, object.into_bank().expect("an object")).expect("a file");
        path
    });
    let objects: Vec<PathBuf> = objects.collect();
    let linked = compiler.link_to_set(&Link::open(&objects).expect("objects"), index).files.expect("a set");
    fs::remove_dir_all(&folder).expect("its own folder");
    [linked.index.path].into_iter().chain(linked.banks.into_iter().map(|bank| bank.path)).collect()
}

/// Panics unless the files return the same answers as the bank.
fn assert_answers(files: &[&Path], bank: &Bank<'_>) {
    let contents: Vec<Vec<u8>> = files.iter().map(|file| fs::read(file).expect("a file")).collect();
    let contents: Vec<&[u8]> = contents.iter().map(Vec::as_slice).collect();
    with(&contents, |dialogue| assert_same(dialogue, bank));
}
