//! Arbitrary files as a trained model or a recogniser. Their hashes are corrected, because changes would otherwise be
//! rejected by the hash.

use lipz_speech::{AlignOptions, Aligner, Language, Model, Pronouncer, Recogniser, Sound, TrainedModel};
use std::io::Cursor;
use std::sync::LazyLock;
use twox_hash::XxHash3_64;

/// The length of both files' header: eight bytes of magic number, and the hash of the rest.
const HASHED: usize = 16;
/// The length of an encoded change: three bytes of offset, and the new byte.
const CHANGE: usize = 4;

/// A fifth of a second of tones, as a WAV file with 16,000 samples per second.
static SOUND: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let samples = (0..3_200_u16).map(|at| (at % 160).wrapping_mul(at / 800 * 100 + 100).to_le_bytes());
    let data = samples.flatten().collect::<Vec<u8>>();
    let length = |length: usize| u32::try_from(length).expect("a short sound").to_le_bytes();
    let mut wav = [&b"RIFF"[..], &length(36 + data.len()), b"WAVEfmt ", &[16, 0, 0, 0, 1, 0, 1, 0]].concat();
    wav.extend(16_000_u32.to_le_bytes());
    wav.extend(32_000_u32.to_le_bytes());
    wav.extend([2, 0, 16, 0]);
    [&wav, &b"data"[..], &length(data.len()), &data].concat()
});

/// The file of an untrained model.
static MODEL: LazyLock<Vec<u8>> =
    LazyLock::new(|| TrainedModel::new(Model::english().clone(), Language::ENGLISH, 1, 2, 3).to_bytes());

/// Corrects the hash of a file.
fn rehash(file: &mut [u8]) {
    if let Some((head, content)) = file.split_at_mut_checked(HASHED) {
        head[8..].copy_from_slice(&XxHash3_64::oneshot(content).to_le_bytes());
    }
}

/// Changes the file of a model as encoded in the bytes (two bytes for the length to cut off, then changes) and reads
/// it. A readable model aligns, and is written as a readable file.
pub fn trained_model(bytes: &[u8]) {
    let Some((missing, changes)) = bytes.split_at_checked(2) else { return };
    let mut file = MODEL.clone();
    file.truncate(file.len() - usize::from(u16::from_le_bytes([missing[0], missing[1]])));
    let length = file.len();
    for change in changes.chunks_exact(CHANGE) {
        let at = change[..3].iter().fold(0, |at, &byte| at << 8 | usize::from(byte));
        file[at % length] = change[3];
    }
    rehash(&mut file);
    match TrainedModel::from_bytes(&file) {
        Ok(read) => {
            let sound = Sound::from_bytes(&SOUND, None).expect("a sound");
            let script = Pronouncer::new(read.language).script("aye");
            let alignment = Aligner::new(&read.model, AlignOptions::default()).align(&sound, &script);
            assert_eq!(alignment.phones.last().map(|phone| phone.end_us), Some(sound.duration_us()));
            // Rewritten Gaussians may be too narrow or wide for 16 bits, which is an error, but not a panic.
            let _ = TrainedModel::from_bytes(&read.to_bytes());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Reads any bytes as the file of a recogniser, and as the file from which one is converted. A readable recogniser
/// returns phones.
pub fn recogniser(bytes: &[u8]) {
    let names = ["a", "m", "<wb>", "<blank>"].map(str::to_owned);
    if let Ok(converted) = Recogniser::convert(bytes, &names) {
        assert!(Recogniser::from_bytes(&converted).is_ok(), "what was converted is not read");
    }
    let mut file = bytes.to_vec();
    rehash(&mut file);
    match Recogniser::from_bytes(&file) {
        Ok(recogniser) => {
            let heard = recogniser.hear(Cursor::new(SOUND.as_slice()), Some("wav")).expect("a sound");
            assert_eq!(heard.is_empty(), heard == lipz_speech::RecognisedWords::default());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
