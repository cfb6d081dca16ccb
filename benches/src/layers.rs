//! Two layers on top of a bank of the generator's clips: a patch of one clip in a hundred, and a mod of one in a
//! thousand.

use crate::clip_key;
use lipz_compiler::diagnostics::Report;
use lipz_compiler::{Compiler, Input, Options, Stack, StackBelow};

/// Returns the patch and the mod for a bank with this number of clips.
///
/// # Errors
/// If `base` is not a bank of the generator.
pub fn over(base: &[u8], clips: usize) -> Result<(Vec<u8>, Vec<u8>), String> {
    let said = |report: Report| report.to_string();
    let layer = |below: &[(&str, &[u8])], every: usize, text: &str| {
        let file = format!(r#"{{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text_en-us": "{text}" }}"#);
        let inputs: Vec<Input> =
            (0..clips).step_by(every).map(|number| Input::from_bytes(clip_key(number), file.clone())).collect();
        let over = StackBelow::new(Stack::open(below.iter().copied()).map_err(said)?).keep_others(true);
        let compiled = Compiler::new(Options::new().strip(true)).compile_over(&inputs, &over);
        compiled.into_bank().map_err(|error| error.to_string())
    };
    let patch = layer(&[("base", base)], 100, "Patched.")?;
    let addition = layer(&[("base", base), ("patch", &patch)], 1000, "Modded.")?;
    Ok((patch, addition))
}
