//! Packing with a cache or a memory makes the same bank and the same diagnostics as without one, regardless of changes
//! to the files, the bank and the cache in between.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_compiler::{
    Compiled, Compiler, Input, LintResult, Memory, MinCoverage, Options, OutputFile, Outputs, discover_with_reports,
};
use lipz_diagnostics::{Code, Levels, Report};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::cell::RefCell;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, SystemTime};

/// The time that a file must stay unchanged before its metadata proves that it is unchanged.
const SETTLING: Duration = Duration::from_millis(2100);

/// A project in its own folder.
struct Scene {
    folder: tempfile::TempDir,
    options: Options,
    has_other_root: bool,
    memory: RefCell<Memory>,
    told: RefCell<Told>,
}

/// A memory that receives the changed files, with the state of the files at its last run.
#[derive(Default)]
struct Told {
    memory: Memory,
    files: Vec<(String, String, Vec<u8>)>,
}

impl Scene {
    fn new() -> Scene {
        let scene = Scene {
            folder: tempfile::tempdir().unwrap(),
            options: Options::default(),
            has_other_root: false,
            memory: RefCell::default(),
            told: RefCell::default(),
        };
        fs::create_dir_all(scene.path("voices/act1")).unwrap();
        scene
    }

    /// Creates a project of the invented scene, whose files have settled.
    fn drama() -> Scene {
        let scene = Scene { options: options(4), ..Scene::new() };
        for (key, bytes) in support::files("drama") {
            let path = scene.path(&format!("voices/{key}.lipz"));
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        std::thread::sleep(SETTLING);
        scene
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn bank(&self) -> PathBuf {
        self.path("out/dialogue.lipzbank")
    }

    fn cache(&self) -> PathBuf {
        self.path("lipz.cache")
    }

    fn inputs(&self) -> Vec<Input> {
        let root = self.has_other_root.then(|| self.folder.path());
        discover_with_reports(&[self.path("voices")], root).0
    }

    fn pack_unchecked(&self) -> Compiled {
        Compiler::new(self.options.clone())
            .pack_cached(&self.inputs(), &self.bank(), &self.cache())
            .map(|file| of_file(&file))
    }

    fn remember(&self) -> Compiled {
        Compiler::new(self.options.clone()).compile_again(&self.inputs(), &mut self.memory.borrow_mut())
    }

    fn told_bank(&self) -> PathBuf {
        self.path("out/told.lipzbank")
    }

    /// Packs with a memory that receives exactly the changed files, unless the inputs have changed.
    fn pack_told(&self) -> Compiled {
        let (inputs, mut told) = (self.inputs(), self.told.borrow_mut());
        let file = |input: &Input| (input.key.clone(), input.name(), fs::read(input.name()).unwrap());
        let files: Vec<_> = inputs.iter().map(file).collect();
        let names = |files: &[(String, String, Vec<u8>)]| -> Vec<_> {
            files.iter().map(|(key, name, _)| (key.clone(), name.clone())).collect()
        };
        let changed: Option<Vec<usize>> = (names(&files) == names(&told.files))
            .then(|| (0..files.len()).filter(|at| files[*at].2 != told.files[*at].2).collect());
        let (outputs, compiler) = (Outputs::new(self.told_bank()), Compiler::new(self.options.clone()));
        let packed = outputs.pack_again(&compiler, &inputs, changed.as_deref(), &mut told.memory);
        if let Some(delivered) = &packed.bank {
            assert_eq!(delivered.files[0].path, self.told_bank());
            told.files = files;
        }
        packed.map(|delivered| of_file(&delivered.files[0]))
    }

    /// Packs with the cache and with memories, and compares the results with those of a run without them.
    fn pack(&self) -> Compiled {
        let with_cache = self.pack_unchecked();
        let with_memory = self.remember();
        let told = self.pack_told();
        let without = Compiler::new(self.options.clone()).compile(&self.inputs());
        assert_eq!(with_memory.reports, without.reports);
        assert!(with_memory.bank == without.bank, "the bank of the memory differs");
        assert_eq!(told.reports, without.reports);
        assert!(told.bank == without.bank, "the bank differs if the memory receives the changed files");
        assert_eq!(with_cache.reports, without.reports);
        assert!(with_cache.bank == without.bank, "the banks differ");
        with_cache
    }
}

/// Returns the bank in a file.
fn of_file(file: &OutputFile) -> Vec<u8> {
    let bank = fs::read(&file.path).unwrap();
    assert_eq!(bank.len(), file.length_bytes);
    bank
}

/// Changes one letter, if there is one, but neither length nor modification time.
fn tamper(path: &Path) {
    let modified = path.metadata().unwrap().modified().unwrap();
    let text = fs::read_to_string(path).unwrap();
    let Some(at) = text.rfind(|letter: char| letter.is_ascii_lowercase()) else { return };
    let other = if text[at..].starts_with('e') { "o" } else { "e" };
    fs::write(path, [&text[..at], other, &text[at + 1..]].concat()).unwrap();
    set_modified(path, modified);
}

fn set_modified(path: &Path, time: SystemTime) {
    File::options().append(true).open(path).unwrap().set_modified(time).unwrap();
}

fn flip(path: &Path, at: usize) {
    let mut bytes = fs::read(path).unwrap();
    let at = at % bytes.len();
    bytes[at] ^= 0x10;
    fs::write(path, bytes).unwrap();
}

#[test]
fn only_what_changed_is_made_anew() {
    let mut scene = Scene::drama();
    let count = scene.inputs().len();
    let first = scene.pack();
    assert_eq!((first.recalled, first.is_unchanged), (0, false));

    let old = SystemTime::now() - Duration::from_secs(1000);
    set_modified(&scene.bank(), old);
    let again = scene.pack();
    assert_eq!((again.recalled, again.is_unchanged), (count, true));
    assert!(scene.bank().metadata().unwrap().modified().unwrap() > old, "build tools see that it is up to date");

    let inputs = scene.inputs();
    let lipz_compiler::Content::File(changed) = &inputs[7].content else { panic!() };
    tamper(changed);
    let one = scene.pack();
    assert_eq!((one.recalled, one.is_unchanged), (count - 1, false));

    fs::write(scene.path("voices/new.lipz"), r#"{"visemes":"A-","viseme_type":"blair","fps":24}"#).unwrap();
    assert_eq!(scene.pack().recalled, count);
    fs::remove_file(changed).unwrap();
    let removed = scene.pack();
    assert_eq!((removed.recalled, removed.is_unchanged), (count, false));

    set_modified(&scene.path("voices/new.lipz"), old);
    assert!(scene.pack().is_unchanged, "only the time changed");

    scene.options = scene.options.strip(true);
    assert_eq!(scene.pack().recalled, 0, "a bank without sources is a different bank");
    assert_eq!(scene.pack().recalled, count);
    scene.has_other_root = true;
    assert_eq!(scene.pack().recalled, 0, "the keys have changed");
    scene.options = scene.options.threads(1);
    assert!(scene.pack().is_unchanged);
}

/// Curves of a file, from emotions and from elements, and the face profiles of a project.
#[test]
fn curves_are_recalled_as_they_were() {
    let mut scene = Scene::new();
    let options = Options::new().default_locale("en-us").unwrap();
    let mut faces = lipz_compiler::face::FaceProfileSettings::default();
    faces.base[0] = Some(5000);
    scene.options = options.clone().faces(faces);
    let files = [
        ("own", r#""curves": { "ears": "0:0 2:-40.25", "nod": "0:5" }"#),
        ("felt", r#""text_en-us": "{anger 2.2} I told {joy 4} you.", "events": "mara feels fear 4""#),
        ("both", r#""text_en-us": "{anger 2.2} No.", "curves": { "anger": "0:1 2:9" }"#),
        ("none", r#""text_en-us": "No.""#),
    ];
    for (key, rest) in files {
        let file = format!(r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "MA-", {rest} }}"#);
        fs::write(scene.path(&format!("voices/{key}.lipz")), file).unwrap();
    }
    std::thread::sleep(SETTLING);
    assert_eq!(scene.pack().recalled, 0);
    let bytes = fs::read(scene.bank()).unwrap();
    let curves = lipz_bank::Bank::open(&bytes).unwrap().clips().map(|clip| clip.curves().count()).collect::<Vec<_>>();
    assert_eq!(curves, [1, 3, 0, 2], "both, felt, none, own");
    assert_eq!(scene.pack().recalled, files.len());
    fs::write(scene.path("voices/new.lipz"), r#"{"visemes":"A-","viseme_type":"blair","fps":24}"#).unwrap();
    assert_eq!(scene.pack().recalled, files.len());
    scene.options = options;
    assert_eq!(scene.pack().recalled, 0, "different profiles make a different bank");
}

#[test]
fn diagnostics_are_reported_in_every_run() {
    let scene = Scene::new();
    let (good, doubtful) = (scene.path("voices/good.lipz"), scene.path("voices/doubtful.lipz"));
    fs::write(&good, r#"{"visemes":"A-","viseme_type":"blair","fps":24}"#).unwrap();
    fs::write(&doubtful, "{}").unwrap();
    for recalled in [0, 1, 1] {
        let compiled = scene.pack();
        assert_eq!((compiled.recalled, compiled.reports.len(), compiled.is_unchanged), (recalled, 1, false));
    }
    let before = fs::read(scene.bank()).unwrap();
    fs::write(&good, "{").unwrap();
    assert!(scene.pack().bank.is_none());
    assert_eq!(fs::read(scene.bank()).unwrap(), before, "errors leave the bank");
}

#[test]
fn errors_leave_the_memory() {
    let scene = Scene::new();
    let (good, other) = (scene.path("voices/good.lipz"), scene.path("voices/other.lipz"));
    let clip = r#"{"visemes":"A-","viseme_type":"blair","fps":24}"#;
    fs::write(&good, clip).unwrap();
    fs::write(&other, clip).unwrap();
    assert!(scene.memory.borrow().is_empty());
    assert_eq!(scene.remember().recalled, 0);
    fs::write(&other, "{").unwrap();
    assert!(scene.remember().bank.is_none());
    fs::write(&other, clip).unwrap();
    let mended = scene.remember();
    assert_eq!((mended.recalled, mended.is_unchanged), (2, true));
}

#[test]
fn what_is_told_is_looked_at_and_nothing_else() {
    let scene = Scene::new();
    let write = |name: &str, text: &str| {
        let clip = format!(r#"{{"visemes":"A-","viseme_type":"blair","fps":24,"text_en-us":"{text}"}}"#);
        fs::write(scene.path(&format!("voices/{name}.lipz")), clip).unwrap();
    };
    ["a", "b", "c"].iter().for_each(|name| write(name, &format!("This is {name}.")));
    fs::write(scene.path("voices/doubtful.lipz"), "{}").unwrap();
    let (inputs, outputs) = (scene.inputs(), Outputs::new(scene.bank()));
    let (mut memory, compiler) = (Memory::default(), Compiler::default());
    let mut pack = |changed: Option<&[usize]>| {
        let packed = outputs.pack_again(&compiler, &inputs, changed, &mut memory);
        let packed = packed.map(|delivered| of_file(&delivered.files[0]));
        let text = |key: &str| {
            let bank = packed.bank.as_ref()?;
            let bank = lipz_bank::Bank::open(bank).unwrap();
            let segment = bank.clip_by_key(key)?.segment(0)?;
            Some(segment.text(bank.locale("en-us")?)?.to_string())
        };
        ((text("a"), text("b")), packed.recalled, packed.reports.len(), packed.is_unchanged)
    };
    let is = |text: &str| Some(text.to_owned());
    let first = (is("This is a."), is("This is b."));
    assert_eq!(pack(Some(&[0])), (first.clone(), 0, 1, false), "nothing is remembered yet: all are read");
    write("a", "This is another.");
    write("b", "So is this.");
    assert_eq!(pack(Some(&[])), (first, 3, 1, true));
    let second = (is("This is another."), is("This is b."));
    assert_eq!(pack(Some(&[0])), (second, 2, 1, false), "the change of b was not reported");
    let third = (is("This is another."), is("So is this."));
    assert_eq!(pack(Some(&[1, 2])), (third.clone(), 2, 1, false));
    write("a", "Is it?");
    assert_eq!(pack(None).0, (is("Is it?"), is("So is this.")));
    fs::write(scene.path("voices/a.lipz"), "{").unwrap();
    assert_eq!(pack(Some(&[0])).0, (None, None));
    write("a", "This is another.");
    assert_eq!(pack(Some(&[0])).0, third);
}

#[test]
fn memory_and_cache_go_over_into_each_other() {
    let scene = Scene::drama();
    let count = scene.inputs().len();
    let bank = scene.remember().bank.unwrap();
    fs::create_dir_all(scene.path("out")).unwrap();
    fs::write(scene.bank(), &bank).unwrap();
    scene.memory.borrow().write(&scene.cache()).unwrap();
    let with_cache = scene.pack_unchecked();
    assert_eq!((with_cache.recalled, with_cache.is_unchanged), (count, true));
    scene.memory.replace(Memory::read(&scene.cache(), &scene.bank()).unwrap());
    let with_memory = scene.remember();
    assert_eq!((with_memory.recalled, with_memory.is_unchanged), (count, true));
    assert_eq!(with_memory.bank, Some(bank));
    for path in [scene.path("voices"), scene.bank()] {
        assert!(Memory::read(&path, &scene.bank()).is_err() && scene.memory.borrow().write(&path).is_err(), "{path:?}");
    }
}

#[test]
fn what_was_checked_is_not_read_again() {
    let scene = Scene::drama();
    let (doubtful, cache) = (scene.path("voices/doubtful.lipz"), scene.path("check.cache"));
    fs::write(&doubtful, "{}").unwrap();
    let count = scene.inputs().len();
    let check = |options: &Options, beside: &[u8]| {
        let read = AtomicUsize::new(0);
        // Reports one file, and counts those with a text in English.
        let lint = |input: &Input, bytes: &[u8]| {
            read.fetch_add(1, Ordering::Relaxed);
            let is_wrong = input.key == "wrong";
            let report = is_wrong.then(|| Report::failure(input.name(), Code::KeyClash, "wrong", "mend it"));
            LintResult::new(report, bytes.windows(10).any(|part| part == b"text_en-us"))
        };
        let (inputs, compiler) = (scene.inputs(), Compiler::new(options.clone()));
        let checked = compiler.check_cached(&inputs, &lint, &cache, beside);
        let read = read.swap(0, Ordering::Relaxed);
        let without = compiler.check_with(&inputs, &lint);
        assert_eq!(checked.compiled.reports, without.compiled.reports);
        assert_eq!((checked.linted, checked.marked), (without.linted, without.marked));
        assert!(checked.compiled.bank.is_none() && checked.marked > 0);
        read
    };
    let plain = Options::default();
    assert_eq!([check(&plain, b""), check(&plain, b"")].map(|read| read >= count), [true, false]);
    let doubtful_count = check(&plain, b"");
    assert!((1..count / 2).contains(&doubtful_count), "only files with diagnostics are read: {doubtful_count}");
    assert_eq!(check(&plain, b"another record"), count);
    assert_eq!(check(&plain, b"another record"), doubtful_count);
    fs::write(scene.path("voices/wrong.lipz"), r#"{"visemes":"A-","viseme_type":"blair","fps":24}"#).unwrap();
    assert_eq!(check(&plain, b"another record"), doubtful_count + 1);
    assert_eq!(check(&plain, b"another record"), doubtful_count + 1, "it has a diagnostic each time");
    assert_eq!(check(&options(4), b"another record"), count + 1, "at other levels");
    fs::remove_file(&doubtful).unwrap();
    let bytes = fs::read(&cache).unwrap();
    for at in (0..bytes.len()).step_by(7) {
        flip(&cache, at);
        let compiled =
            Compiler::new(options(4)).check_cached(&scene.inputs(), &|_, _| LintResult::default(), &cache, b"");
        match at {
            0..16 => assert_eq!(compiled.compiled.reports[0].diagnostics[0].code, Code::OutputFailed),
            _ => assert_eq!(compiled.compiled.reports, []),
        }
        fs::write(&cache, &bytes).unwrap();
    }
    scene.pack();
    let other = Compiler::default().check_cached(&scene.inputs(), &|_, _| LintResult::default(), &scene.cache(), b"");
    assert!(other.compiled.reports[0].to_string().contains("is the cache of a bank"), "{:?}", other.compiled.reports);
}

#[test]
fn a_damaged_bank_or_cache_is_not_believed() {
    let scene = Scene::new();
    fs::write(scene.path("voices/a.lipz"), r#"{"visemes":"A|-","viseme_type":"blair","text_en-us":"a|b"}"#).unwrap();
    fs::write(scene.path("voices/b.lipz"), r#"{"events":"otto feels sad","text_de-de":"b"}"#).unwrap();
    scene.pack();
    let (bank, cache) = (fs::read(scene.bank()).unwrap(), fs::read(scene.cache()).unwrap());
    // Every byte of the header, but only a few of the rest, which the checksum covers as a whole.
    for at in (0..64).chain((64..bank.len()).step_by(31)) {
        flip(&scene.bank(), at);
        assert_eq!(scene.pack().recalled, 0, "byte {at} of the bank");
    }
    for at in 0..cache.len() {
        flip(&scene.cache(), at);
        let compiled = scene.pack_unchecked();
        assert!(fs::read(scene.bank()).unwrap() == bank, "byte {at} of the cache");
        if let Some(report) = compiled.reports.first() {
            // It does not look like a cache, and could be any file.
            assert_eq!(report.diagnostics[0].code, Code::OutputFailed);
            fs::write(scene.cache(), &cache).unwrap();
        } else {
            assert_eq!(compiled.recalled, 0, "byte {at} of the cache");
        }
    }
    for length in 0..cache.len() {
        fs::write(scene.cache(), &cache[..length]).unwrap();
        assert_eq!(scene.pack_unchecked().recalled, 0);
        fs::write(scene.cache(), &cache).unwrap();
    }
    fs::remove_file(scene.bank()).unwrap();
    assert_eq!(scene.pack().recalled, 0);
    assert_eq!(scene.pack().recalled, 2);
}

#[test]
fn a_bank_that_somebody_writes_to_meanwhile_does_not_stay() {
    // So small that the whole bank is in memory from the start.
    let scene = Scene::new();
    fs::write(scene.path("voices/a.lipz"), r#"{"text_en-us":"Aye."}"#).unwrap();
    std::thread::sleep(SETTLING);
    let bank = scene.pack_unchecked().bank.unwrap();
    scene.pack_told();
    let is_told = |told: bool| {
        let path = if told { scene.told_bank() } else { scene.bank() };
        let is_first = AtomicBool::new(true);
        let meanwhile = |_| {
            if is_first.swap(false, Ordering::SeqCst) {
                // Longer than a tick of the file system's clock.
                std::thread::sleep(Duration::from_millis(20));
                fs::write(&path, vec![7; bank.len()]).unwrap();
            }
        };
        let compiler = Compiler::new(scene.options.clone()).progress(meanwhile);
        let packed = match told {
            false => compiler.pack_cached(&scene.inputs(), &path, &scene.cache()),
            true => {
                let outputs = Outputs::new(&path);
                let packed = outputs.pack_again(&compiler, &scene.inputs(), None, &mut scene.told.borrow_mut().memory);
                packed.map(|delivered| delivered.files[0].clone())
            }
        };
        assert!(!is_first.load(Ordering::SeqCst) && !packed.is_unchanged);
        assert!(of_file(&packed.bank.unwrap()) == bank, "{told}");
    };
    [false, true].into_iter().for_each(is_told);
}

#[test]
fn a_bank_that_is_made_anew_and_is_there_already_is_judged() {
    let scene = Scene::new();
    let file = r#"{"text_en-us":"Aye."}"#;
    fs::write(scene.path("voices/a.lipz"), file).unwrap();
    fs::write(scene.path("voices/b.lipz"), file.replace("en-us", "de-de")).unwrap();
    let outputs = Outputs::new(scene.bank());
    let pack = |options: Options| {
        let packed = outputs.pack_again(&Compiler::new(options), &scene.inputs(), None, &mut Memory::default());
        (packed.bank.is_some(), packed.is_unchanged, packed.reports.len())
    };
    let options = Options::new().default_locale("en-us").unwrap();
    assert_eq!(pack(options.clone()), (true, false, 0));
    assert_eq!(pack(options.clone()), (true, true, 0));
    assert_eq!(pack(options.min_coverage(MinCoverage::new().all(100.0))), (false, false, 1));
}

#[test]
fn what_is_said_of_scripts_is_the_same_of_a_bank_that_stays() {
    let scene = Scene { options: Options::new().default_locale("en-us").unwrap(), ..Scene::new() };
    // Only the ends of the texts are in memory for such a bank. Wherever they start, no text may be missing.
    for padding in 0..4 {
        for number in 0..200 {
            let text = format!("{}{number}{}", "x".repeat(padding), "說".repeat(300));
            let file = format!(r#"{{"text_en-us":"Aye {number}","text_zh-cn":"是 {number}","text_zh-tw":"{text}"}}"#);
            fs::write(scene.path(&format!("voices/{number}.lipz")), file).unwrap();
        }
        let first = scene.pack_unchecked();
        assert_eq!((first.reports.as_slice(), first.bank.is_some()), (&[][..], true));
        std::thread::sleep(SETTLING);
        let again = scene.pack_unchecked();
        assert_eq!((again.reports.as_slice(), again.is_unchanged), (&[][..], true));
    }
}

#[test]
fn files_that_are_no_caches_are_left_alone() {
    let scene = Scene::new();
    let source = scene.path("voices/a.lipz");
    fs::write(&source, r#"{"visemes":"A-","viseme_type":"blair"}"#).unwrap();
    let inputs = scene.inputs();
    for (cache, bank_is_written) in [(&source, false), (&scene.path("voices"), false), (&scene.bank(), true)] {
        let compiled = Compiler::new(scene.options.clone()).pack_cached(&inputs, &scene.bank(), cache);
        assert!(compiled.bank.is_none());
        assert_eq!(compiled.reports.len(), 1);
        assert_eq!(compiled.reports[0].diagnostics[0].code, Code::OutputFailed);
        assert_eq!(scene.bank().exists(), bank_is_written);
    }
    assert_eq!(scene.pack().reports, [], "source and bank are complete");
}

/// A change to a project between two runs. Files are identified by numbers, modulo their count.
#[derive(Clone, Debug)]
enum Edit {
    Write(usize, String),
    Delete(usize),
    Touch(usize),
    Tamper(usize),
    Swap(usize, usize),
    DamageBank(usize),
    DamageCache(usize),
    Options(usize),
    Root,
}

fn edit() -> impl Strategy<Value = Edit> {
    let any = || any::<usize>();
    let text = lipz_testkit::documents::document().prop_map(|document| lipz_file::write(&document));
    prop_oneof![
        6 => (any(), text).prop_map(|(file, text)| Edit::Write(file, text)),
        2 => any().prop_map(Edit::Delete),
        2 => any().prop_map(Edit::Touch),
        3 => any().prop_map(Edit::Tamper),
        2 => (any(), any()).prop_map(|(a, b)| Edit::Swap(a, b)),
        1 => any().prop_map(Edit::DamageBank),
        1 => any().prop_map(Edit::DamageCache),
        1 => any().prop_map(Edit::Options),
        1 => Just(Edit::Root),
    ]
}

/// Options that allow the diagnostics of the generated documents, so that these are stamped.
fn options(number: usize) -> Options {
    let plain = Options::new()
        .default_locale("en-us")
        .unwrap()
        .levels(Code::ALL.iter().map(|code| (*code, None)).collect::<Levels>());
    match number % 5 {
        0 => plain.strip(true),
        1 => plain.pseudo(true),
        2 => plain.locales(["de-at", "en-us", "fr-ca"]).unwrap(),
        3 => plain.default_locale("de-de").unwrap().literal_braces(true),
        _ => plain,
    }
}

impl Scene {
    fn apply(&mut self, edit: &Edit) {
        let file = |number: usize| self.path(&format!("voices/{}{}.lipz", ["", "act1/"][number % 2], number % 24));
        match edit {
            Edit::Write(number, text) => fs::write(file(*number), text).unwrap(),
            Edit::Delete(number) => drop(fs::remove_file(file(*number))),
            Edit::Touch(number) if file(*number).exists() => set_modified(&file(*number), SystemTime::now()),
            Edit::Tamper(number) if file(*number).exists() => tamper(&file(*number)),
            Edit::Swap(a, b) if file(*a).exists() && file(*b).exists() => {
                fs::rename(file(*a), self.path("aside")).unwrap();
                let _ = fs::rename(file(*b), file(*a));
                fs::rename(self.path("aside"), file(*b)).unwrap();
            }
            Edit::DamageBank(at) => [self.bank(), self.told_bank()].iter().for_each(|bank| flip(bank, *at)),
            // Not in the magic that identifies it as a cache.
            Edit::DamageCache(at) => flip(&self.cache(), 16 + at % (fs::read(self.cache()).unwrap().len() - 16)),
            Edit::Options(number) => self.options = options(*number),
            Edit::Root => self.has_other_root = !self.has_other_root,
            _ => {}
        }
    }
}

#[test]
fn any_edits() {
    let mut runner = TestRunner::deterministic();
    let mut next = |strategy: &BoxedStrategy<Vec<Edit>>| strategy.new_tree(&mut runner).unwrap().current();
    let edits = proptest::collection::vec(edit(), 0..4).boxed();
    let mut scene = Scene { options: options(4), ..Scene::new() };
    next(&proptest::collection::vec(edit(), 200).boxed())
        .iter()
        .filter(|edit| matches!(edit, Edit::Write(..)))
        .for_each(|edit| scene.apply(edit));
    std::thread::sleep(SETTLING);
    scene.pack();
    let (mut recalled, mut unchanged) = (0, 0);
    for round in 0..200 {
        let edits = next(&edits);
        println!("round {round}: {edits:?}"); // shown if the test fails
        edits.iter().for_each(|edit| scene.apply(edit));
        let mut compiled = scene.pack();
        if compiled.bank.is_none() {
            compiled.reports.iter().for_each(|report| fs::remove_file(&report.source.path).unwrap());
            compiled = scene.pack();
        }
        recalled += compiled.recalled;
        unchanged += usize::from(compiled.is_unchanged);
    }
    assert!(recalled > 1500 && unchanged > 40, "{recalled} clips were recalled, {unchanged} banks were unchanged");
}
