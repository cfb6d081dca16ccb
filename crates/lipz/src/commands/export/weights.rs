//! `lipz export weights`: the weights of a rig, as animations for other tools.

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::formats;
use crate::shared::inputs::with_inputs;
use crate::shared::output_file::{OVERWRITE, in_the_way, may_write, write_all};
use crate::shared::rig;
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::values::parse_fps;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::FaceCurve;
use lipz_bank::{Bank, Clip, Fps, Micros};
use lipz_compiler::ClipWeights;
use lipz_compiler::rigs::inputs as rig_inputs;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::rate::Rate;
use lipz_interop::Time;
use lipz_interop::weights::{ALL, FaceAnimation, SampledWeight, WeightFormat, find};
use std::path::PathBuf;

/// Export the weights of a rig as animations of faces in three dimensions.
///
/// The weights are those that the reader computes from phones or visemes, emotions and blinks. A curve with the name of a
/// weight replaces it, and other curves are exported as well. In formats with keys, the values between two keys differ
/// from the computed ones by at most 0.002.
#[derive(Args, Debug)]
#[command(after_help = names())]
#[command(after_long_help = examples())]
pub(crate) struct ExportWeights {
    /// Format to write
    #[arg(value_name = "FORMAT", value_parser = parser(), hide_possible_values = true)]
    weight_format: &'static WeightFormat,

    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Folder to write into
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    /// Rig: one of the project, or a built-in one [default: that of the format]
    #[arg(long, value_name = "RIG")]
    rig: Option<String>,

    /// Frame rate of the animations [default: that of each clip]
    #[arg(long, value_name = "FPS", value_parser = parse_fps)]
    fps: Option<Fps>,

    /// Replace existing files
    #[arg(long)]
    overwrite: bool,
}

fn parser() -> impl TypedValueParser<Value = &'static WeightFormat> {
    PossibleValuesParser::new(ALL.iter().map(|format| format.name))
        .try_map(|name| find(&name).ok_or("the format does not exist"))
}

/// Returns the names of the formats with an example, for the short help.
fn names() -> String {
    let names: Vec<&str> = ALL.iter().map(|format| format.name).collect();
    format!("Formats:\n  {}\n\nExample:\n  lipz export weights gltf voices -o animations", names.join(", "))
}

/// Returns the formats with their rigs, for the long help.
fn examples() -> String {
    let mut text = String::from("Formats:\n");
    for format in ALL {
        text += &format!("\n  {}: {}; rig {}", format.name, format.about, format.rig);
    }
    text + "\n\nExamples:\n  lipz export weights live-link voices -o takes --fps 60\n  \
            lipz export weights gltf voices -o animations --rig ovr\n"
}

impl Run for ExportWeights {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.stdin.apply(self.sources.paths(), reporter)?;
        let mut project = self.sources.project(reporter)?;
        let format = self.weight_format;
        let rate = match (self.fps.map(formats::rate), format.fixed_rate) {
            (Some(rate), Some(fixed)) if (rate.numerator, rate.denominator) != (fixed.numerator, fixed.denominator) => {
                let message = format!("`{}` always has {} frames per second", format.name, fixed.numerator);
                return Err(reporter.usage(message, "remove `--fps`"));
            }
            (rate, fixed) => rate.or(fixed),
        };
        let name = self.rig.as_deref().unwrap_or(format.rig);
        let rig = rig::named(name, &project.settings.options, reporter)?;
        let options = std::mem::take(&mut project.settings.options);
        project.settings.options = options.strip(true).baked_rig(None).rigs([rig].into());
        let quiet = self.sources.is_quiet();
        #[expect(clippy::redundant_closure_for_method_calls, reason = "the method has only one lifetime")]
        let mut worked = with_inputs(&project.settings, None, quiet, |compiler, inputs| compiler.compile(inputs));
        let outcome = worked.outcome();
        let mut reports = std::mem::take(&mut worked.reports);
        let bytes = match worked.compiled.bank.take() {
            Some(bytes) if outcome == Outcome::Clean => bytes,
            _ => return Err(reporter.abort(reports, outcome)),
        };
        let Ok(bank) = Bank::open(&bytes) else {
            // The compiler has verified this bank.
            return Err(reporter.usage("the packed bank is invalid", "report this bug"));
        };
        let mut files = Vec::new();
        let levels = project.settings.options.get_levels();
        for input in worked.inputs.iter() {
            let path = formats::path(&self.output, &input.key, format.extension);
            let mut diagnostics = Vec::new();
            let clip = bank.clip_by_key(&input.key);
            if let Some(animation) = clip.and_then(|clip| animation(&bank, clip, name, rate, &mut diagnostics)) {
                files.push((path, (format.write)(&animation, &mut diagnostics)));
            }
            levels.apply(&mut diagnostics);
            if !diagnostics.is_empty() {
                reports.push(Report::all_about(input.name(), diagnostics));
            }
        }
        if !self.overwrite {
            reports.extend(files.iter().filter_map(|(path, _)| in_the_way(path, OVERWRITE)));
        }
        let is_free = may_write(&reports);
        let free = files.iter().filter(|_| is_free).map(|(path, file)| (path.clone(), file.as_slice()));
        let written = write_all(free, &mut reports);
        let summary = format!(
            "{} exported to {} in {}, with the rig {name}\n",
            console::counted(written, "file"),
            format.name,
            console::path(&self.output)
        );
        reporter.end(reports, (!quiet && written > 0).then_some(summary))
    }
}

/// Returns the animation of a clip; `None` with a diagnostic if its frames have no times.
fn animation(
    bank: &Bank<'_>,
    clip: Clip<'_>,
    rig: &str,
    rate: Option<Rate>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<FaceAnimation> {
    let (Some(fps), 1..) = (clip.fps(), clip.frame_count()) else {
        let what = if clip.fps().is_none() { "no frame rate" } else { "no frames" };
        let help = match clip.fps() {
            None => "add \"fps\" to the file, or set `default-fps` in lipz.toml",
            Some(_) => "export clips with \"visemes\"",
        };
        diagnostics.push(Diagnostic::new(Code::NotExportable, format!("the clip has {what}")).help(help));
        return None;
    };
    let rate = rate.unwrap_or(formats::rate(fps));
    let end = Time::of_frame(clip.frame_count().into(), formats::rate(fps));
    let frame_count = usize::try_from(end.frames_begun(rate)).unwrap_or(usize::MAX).max(1);
    let time = |frame: usize| {
        let us = Time::of_frame(frame as u64, rate).in_units(1_000_000);
        Micros(i64::try_from(us).unwrap_or(i64::MAX))
    };
    let weights = ClipWeights::new(bank, clip, bank.rig(rig)?);
    let mut sampled: Vec<SampledWeight> =
        weights.names().map(|name| SampledWeight { name: name.to_owned(), values: Vec::new() }).collect();
    for frame in 0..frame_count {
        sampled.iter_mut().zip(weights.at(time(frame))).for_each(|(weight, value)| weight.values.push(value));
    }
    let is_input =
        |name: &str| rig_inputs().any(|input| input == name) || FaceCurve::ALL.iter().any(|curve| curve.name() == name);
    for curve in clip.curves() {
        let name = curve.name().as_str();
        // Curves of other characters have a dot in their names.
        if is_input(name) || name.contains('.') || weights.names().any(|weight| weight == name) {
            continue;
        }
        let values: Vec<CurveValue> =
            (0..frame_count).map(|frame| curve.value_at(time(frame)).unwrap_or_default()).collect();
        sampled.push(SampledWeight { name: name.to_owned(), values });
    }
    let name = clip.key().rsplit('/').next().unwrap_or_default();
    Some(FaceAnimation::new(name, rate, frame_count, sampled))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_states_the_tolerance_of_keys_and_rigs_that_exist() {
        assert_eq!(lipz_interop::weights::KEY_TOLERANCE, 2);
        assert!(ALL.iter().all(|format| lipz_compiler::rigs::built_in(format.rig).is_some()));
    }
}
