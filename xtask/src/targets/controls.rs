//! The banks for a machine without a system: the golden one, and two that it must reject, to show that it checks them.

use crate::Failure;
use crate::paths::{temporary_folder, workspace_root};
use lipz_bank::{Bank, ClipId};
use lipz_layout::{CHECKED_FROM, checksum};
use std::path::{Path, PathBuf};
use std::process::Output;

/// The clip in which a control changes a frame.
const CLIP: &str = "act1/mara-good-evening";

/// The offset of the checksum in the header.
const CHECKSUM: std::ops::Range<usize> = 8..16;

/// Checks a machine with the banks. `run` starts it with a bank and the expected answers.
pub(super) fn check(run: impl Fn(&Path, &Path) -> std::io::Result<Output>) -> Result<(), Failure> {
    let golden = workspace_root().join("fixtures/banks/v1/drama.lipzbank");
    let answers = golden.with_extension("dump");
    let bytes = std::fs::read(&golden).map_err(|error| format!("`{}`: {error}", golden.display()))?;
    let run = |bank: &Path| {
        let output = run(bank, &answers).map_err(|error| error.to_string())?;
        let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
        Ok::<_, Failure>((output.status.code(), printed))
    };
    let (code, printed) = run(&golden)?;
    print!("{printed}");
    if code != Some(0) {
        return Err(format!("the machine ended with {code:?}"));
    }
    let folder = temporary_folder()?;
    for Control { name, bytes, expected } in controls(&bytes)? {
        let path: PathBuf = folder.path().join(name);
        std::fs::write(&path, bytes).map_err(|error| error.to_string())?;
        let (code, printed) = run(&path)?;
        if code != Some(1) || !printed.contains(&expected) {
            return Err(format!("the {name} bank should end with 1 and `{expected}`, not {code:?} and:\n{printed}"));
        }
        println!("the {name} bank is refused");
    }
    Ok(())
}

/// A bank that a machine must reject.
struct Control {
    name: &'static str,
    bytes: Vec<u8>,
    /// The expected message.
    expected: String,
}

/// Returns banks with one changed frame: one is damaged; the other has a correct checksum, so that only its answers
/// differ.
fn controls(bytes: &[u8]) -> Result<[Control; 2], Failure> {
    let bank = Bank::open(bytes).map_err(|error| error.to_string())?;
    let clip = bank.clip(ClipId::from_key(CLIP)).ok_or("the golden bank has lost a clip")?;
    let place = clip.frames().as_ptr() as usize - bytes.as_ptr() as usize;
    let mut damaged = bytes.to_vec();
    let frame = damaged.get_mut(place).ok_or("the clip has lost its frames")?;
    *frame = if *frame == b'A' { b'E' } else { b'A' };
    let mut forged = damaged.clone();
    let sum = checksum(forged.get(CHECKED_FROM..).unwrap_or_default());
    forged.splice(CHECKSUM, sum.to_le_bytes());
    let frames = format!("  {} frames ", clip.frame_count());
    Ok([
        Control { name: "damaged", bytes: damaged, expected: "refused".into() },
        Control { name: "forged", bytes: forged, expected: format!("expected: {frames}") },
    ])
}
