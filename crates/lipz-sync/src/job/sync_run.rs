//! A run of lip sync, which makes the visemes of a project or of given jobs, and writes them into Lipz files.

use crate::job::outcome::{JobOutcome, NewMouth};
use crate::job::review_list::ReviewLists;
use crate::job::store::ClipStore;
use crate::job::work::{by_letters, work};
use crate::job::write::{WriteGuard, write};
use crate::job::{Job, SyncOptions, SyncResults, jobs_of_clips, jobs_of_recordings_with_reports};
use crate::record::{SyncRecord, record_place};
use crate::recordings::Recordings;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, DiagnosticsError, Report};
use lipz_interop::Script;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{fmt, fs, io};

/// Makes the visemes of a project from its recordings, and writes each Lipz file as soon as its visemes are made.
///
/// In an existing file, only `visemes`, `viseme_type` and `fps` change, and the `|` of its text move with the words.
/// Visemes in the [`SyncRecord`] are only made again if their recording, text or settings change, and hand-edited ones
/// stay (see [`force`](SyncRun::force)). A renamed file keeps its lines in the record. The record is written with each file, so that an interrupted run can continue.
/// The number of threads does not affect the files.
///
/// ```no_run
/// use lipz_compiler::settings::Settings;
/// use lipz_sync::SyncRun;
/// let settings = Settings::read("lipz.toml")?;
/// let synced = SyncRun::new(&settings)?.run();
/// print!("{}", synced.reports.iter().map(ToString::to_string).collect::<String>());
/// println!("{} mouths made, {} kept", synced.made.len(), synced.kept.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use = "nothing is made until `run` is called"]
pub struct SyncRun<'p> {
    jobs: Vec<Job>,
    options: SyncOptions,
    record: SyncRecord,
    warnings: Vec<Report>,
    progress: Box<dyn Fn(u32) + Send + Sync + 'p>,
    around_writes: Box<WriteGuard<'p>>,
}

impl SyncRun<'static> {
    /// Returns a run over the Lipz files of a project that have a recording, and over recordings of dubs without a
    /// file.
    ///
    /// # Errors
    /// All diagnostics, if the project has no folder of recordings, or its Lipz files, recordings, lexicon, models or
    /// record cannot be read. Warnings are in the result of [`run`](SyncRun::run).
    pub fn new(settings: &Settings) -> Result<SyncRun<'static>, DiagnosticsError> {
        if settings.audio.folder.is_none() {
            let help = "set `folder` in [audio]";
            return Err(Report::failure(
                "",
                Code::SettingValue,
                "the project does not set a folder of recordings",
                help,
            )
            .into());
        }
        let inputs = settings.discover()?;
        let recordings = Recordings::discover(settings)?;
        let jobs = jobs_of_clips(&inputs, &recordings);
        let run = SyncRun::of_project(settings, jobs, &record_place(settings))?;
        Ok(run.with_warnings(settings, inputs.warnings().to_vec()))
    }

    /// Returns a run over recordings, which become Lipz files in the folder `output`. The sources of the settings are
    /// files and folders of recordings. The text of a recording is in `script` under the name of the file, or next to
    /// it in `NAME.txt`.
    ///
    /// # Errors
    /// All diagnostics, if a recording, a text, the lexicon, the models or the record cannot be read, or the settings name
    /// no locale for the texts. Warnings are in the result of [`run`](SyncRun::run).
    pub fn of_recordings(
        settings: &Settings,
        output: &Path,
        script: Option<&Script>,
    ) -> Result<SyncRun<'static>, DiagnosticsError> {
        let (jobs, mut reports) = jobs_of_recordings_with_reports(settings, output, script);
        reports.iter_mut().for_each(|report| settings.options.get_levels().apply(&mut report.diagnostics));
        let (jobs, warnings) = DiagnosticsError::check(jobs, reports)?;
        let place = settings.audio.record.clone().unwrap_or_else(|| SyncRecord::place(output));
        let run = SyncRun::of_project(settings, jobs, &place)?;
        let lacks_locale = |job: &Job| job.text.is_some() && run.options.locale_of(job).is_none();
        if run.jobs.iter().any(lacks_locale) {
            let help = "set `default-locale`, or `locale` in [audio], for the names of the elements `text_LOCALE`";
            return Err(Report::failure("", Code::SettingValue, "the locale of the texts is not set", help).into());
        }
        Ok(run.with_warnings(settings, warnings))
    }

    /// Returns a run over these jobs.
    ///
    /// Its result does not contain the [warnings of the options](SyncOptions::warnings) and [of the
    /// record](SyncRecord::warnings), which are available there.
    pub fn of_jobs(jobs: Vec<Job>, options: SyncOptions, record: SyncRecord) -> SyncRun<'static> {
        SyncRun {
            jobs,
            options,
            record,
            warnings: Vec::new(),
            progress: Box::new(|_| ()),
            around_writes: Box::new(|write| write()),
        }
    }

    /// Returns a run over jobs with the options and the record of a project.
    fn of_project(settings: &Settings, jobs: Vec<Job>, record: &Path) -> Result<SyncRun<'static>, Report> {
        let options = SyncOptions::new(settings)?;
        if let Some(path) = &settings.sync.model {
            options.check_model(path, &jobs)?;
        }
        Ok(SyncRun::of_jobs(jobs, options, SyncRecord::read(record)?))
    }
}

impl<'p> SyncRun<'p> {
    /// Adds these warnings to the result, and those of the options and the record, at the project's levels.
    fn with_warnings(mut self, settings: &Settings, warnings: Vec<Report>) -> SyncRun<'p> {
        self.warnings = warnings;
        self.warnings.extend_from_slice(self.options.warnings());
        let of_record = self.record.warnings().iter().cloned().map(|mut report| {
            settings.options.get_levels().apply(&mut report.diagnostics);
            report
        });
        self.warnings.extend(of_record);
        self
    }

    /// Sets whether visemes that were made or edited by hand are replaced as well.
    pub fn force(mut self, force: bool) -> SyncRun<'p> {
        self.options.force = force;
        self
    }

    /// Calls `progress` with the number of parts done since its last call, from several threads. Each job has
    /// [`JOB_PARTS`](crate::JOB_PARTS), and [`jobs`](SyncRun::jobs) returns all jobs.
    pub fn progress(self, progress: impl Fn(u32) + Send + Sync + 'p) -> SyncRun<'p> {
        SyncRun { progress: Box::new(progress), ..self }
    }

    /// Calls `guard` with each write of a Lipz file or the record, which it must execute, from several threads. A
    /// program that may be asked to end can delay its end in `guard`, so that no file is incomplete.
    pub fn around_writes(self, guard: impl Fn(&mut dyn FnMut()) + Send + Sync + 'p) -> SyncRun<'p> {
        SyncRun { around_writes: Box::new(guard), ..self }
    }

    /// Returns the jobs of the run.
    pub fn jobs(&self) -> &[Job] {
        &self.jobs
    }

    /// Makes the visemes with as many threads as the options state, and writes the files and the record.
    ///
    /// A problem of one clip is reported, and the run continues with the others.
    pub fn run(self) -> SyncResults {
        let SyncRun { jobs, options, mut record, warnings, progress, around_writes } = self;
        let whole: &WriteGuard<'_> = &around_writes;
        let renamed = record.follow(jobs.iter().map(|job| job.lipz_file.as_path()), &options.options);
        let known = &record;
        let sources = ClipFiles { record: known, has_no_record: AtomicBool::new(false), whole };
        let done = work(&jobs, &options, known, &sources, &progress);
        let mut synced = SyncResults { reports: warnings, renamed, ..SyncResults::default() };
        let mut listed = ReviewLists::default();
        let (mut lines, mut new_words) = (Vec::new(), Vec::new());
        for (job, step, reports) in done {
            synced.reports.extend(reports);
            match step {
                JobOutcome::Unchanged(words) => {
                    synced.unchanged += 1;
                    listed.unchanged(&job.key, words);
                }
                JobOutcome::Kept(kept, words) => {
                    synced.kept.push((job.key.clone(), kept));
                    new_words.extend(words.map(|words| (&job.lipz_file, words)));
                }
                JobOutcome::Refused => synced.refused += 1,
                JobOutcome::New(new) => {
                    synced.read_by_letters.extend(by_letters(job, &options, &new));
                    synced.made.push(job.key.clone());
                    synced.with_new_text.extend(new.has_new_text.then(|| job.key.clone()));
                    listed.made(&job.key, new.listed);
                    lines.push((&job.lipz_file, new.line, new.outdated));
                }
            }
        }
        lines.into_iter().for_each(|(lipz_file, line, spoken)| record.set(lipz_file, line, spoken));
        new_words.into_iter().for_each(|(lipz_file, words)| record.set_words(lipz_file, words.sound, words.words));
        synced.end(listed, &record, whole)
    }
}

impl fmt::Debug for SyncRun<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SyncRun").field("jobs", &self.jobs).field("options", &self.options).finish_non_exhaustive()
    }
}

/// The Lipz files on disk, which are written as soon as their visemes are made.
struct ClipFiles<'s> {
    record: &'s SyncRecord,
    /// Whether the record cannot be written. Without it, visemes must not be written either, so this error is reported
    /// once and the other clips are skipped.
    has_no_record: AtomicBool,
    whole: &'s WriteGuard<'s>,
}

impl ClipStore for ClipFiles<'_> {
    fn read(&self, lipz_file: &Path) -> io::Result<Vec<u8>> {
        fs::read(lipz_file)
    }

    fn is_closed(&self) -> bool {
        self.has_no_record.load(Ordering::Relaxed)
    }

    fn put(&self, job: &Job, new: &NewMouth) -> Result<(), Option<Report>> {
        let grid = new.grid.as_ref().map(|(place, text)| (place.as_path(), text.as_str()));
        write(
            &job.lipz_file,
            new.before.as_deref(),
            &new.after,
            (&new.line, &new.outdated, grid),
            self.record,
            self.whole,
        )
        .map_err(|fault| {
            let is_first = !fault.is_of_record || !self.has_no_record.swap(true, Ordering::Relaxed);
            is_first.then_some(fault.report)
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::job::JOB_PARTS;
    use std::sync::atomic::AtomicU32;
    use tempfile::TempDir;

    /// Returns a project with two clips, the first of which has a recording. Their visemes are made from loudness.
    fn project() -> (TempDir, Settings) {
        let folder = tempfile::tempdir().unwrap();
        for name in ["voices", "recordings"] {
            fs::create_dir(folder.path().join(name)).unwrap();
        }
        for name in ["aye", "no"] {
            fs::write(folder.path().join(format!("voices/{name}.lipz")), r#"{ "text_en-us": "Aye." }"#).unwrap();
        }
        let spec = hound::WavSpec {
            channels: 1,
            sample_rate: 16_000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut writer = hound::WavWriter::create(folder.path().join("recordings/aye.wav"), spec).unwrap();
        (0..16_000).for_each(|at| writer.write_sample(if at % 80 < 40 { 9000_i16 } else { -9000 }).unwrap());
        writer.finalize().unwrap();
        let settings =
            "sources = [\"voices\"]\nviseme-type = \"rms\"\n[audio]\nfolder = \"recordings\"\nlocale = \"en-us\"\n";
        let settings = Settings::parse(settings, "lipz.toml", folder.path()).unwrap();
        (folder, settings)
    }

    #[test]
    fn a_run_makes_what_changed_and_tells_how_far_it_is() {
        let (folder, settings) = project();
        let (parts, writes) = (AtomicU32::new(0), AtomicU32::new(0));
        let run = SyncRun::new(&settings).unwrap();
        assert_eq!(run.jobs().iter().map(|job| job.key.as_str()).collect::<Vec<_>>(), ["aye"]);
        let run = run.progress(|done| _ = parts.fetch_add(done, Ordering::Relaxed));
        let run = run.around_writes(|write| {
            writes.fetch_add(1, Ordering::Relaxed);
            write();
        });
        assert_eq!(run.run().made, ["aye"]);
        assert_eq!((parts.into_inner(), writes.into_inner()), (JOB_PARTS, 2), "the file, and the record");
        let file = folder.path().join("voices/aye.lipz");
        let made = fs::read_to_string(&file).unwrap();
        assert!(made.contains(r#""viseme_type": "rms""#), "{made}");
        let again = SyncRun::new(&settings).unwrap().run();
        assert_eq!((again.made.len(), again.unchanged), (0, 1));

        let by_hand = made.replacen(r#""visemes": ""#, r#""visemes": "99"#, 1);
        fs::write(&file, &by_hand).unwrap();
        assert_eq!(SyncRun::new(&settings).unwrap().run().kept.len(), 1);
        assert_eq!(fs::read_to_string(&file).unwrap(), by_hand);
        assert_eq!(SyncRun::new(&settings).unwrap().force(true).run().made, ["aye"]);
        assert_eq!(fs::read_to_string(&file).unwrap(), made);
    }

    /// Otherwise, its visemes would count as made by hand, and a new recording would not change them.
    #[test]
    fn a_renamed_clip_keeps_its_lines_in_the_record() {
        let (folder, settings) = project();
        let rename = |old: &str, new: &str| {
            for (old, new) in [
                (format!("voices/{old}.lipz"), format!("voices/{new}.lipz")),
                (format!("recordings/{old}.wav"), format!("recordings/{new}.wav")),
            ] {
                fs::rename(folder.path().join(old), folder.path().join(new)).unwrap();
            }
        };
        assert_eq!(SyncRun::new(&settings).unwrap().run().made, ["aye"]);
        rename("aye", "yes");
        let synced = SyncRun::new(&settings).unwrap().run();
        assert_eq!((synced.unchanged, synced.kept.len()), (1, 0), "{:?}", synced.kept);
        assert_eq!(synced.renamed, [("aye.lipz".to_owned(), "yes.lipz".to_owned())]);
        let again = SyncRun::new(&settings).unwrap().run();
        assert_eq!((again.unchanged, again.renamed.len()), (1, 0));
        // Two copies of a deleted file may both be its successor, so none is.
        rename("yes", "no");
        for place in ["voices/no.lipz", "recordings/no.wav"] {
            fs::copy(folder.path().join(place), folder.path().join(place.replace("no.", "nope."))).unwrap();
        }
        let synced = SyncRun::new(&settings).unwrap().run();
        assert_eq!((synced.unchanged, synced.kept.len(), synced.renamed.len()), (0, 2, 0));
    }

    #[test]
    fn recordings_become_lipz_files() {
        let (folder, mut settings) = project();
        settings.sources = vec![folder.path().join("recordings")];
        let output = folder.path().join("new");
        assert_eq!(SyncRun::of_recordings(&settings, &output, None).unwrap().run().made, ["aye"]);
        assert!(output.join("aye.lipz").is_file());
        fs::write(folder.path().join("recordings/aye.txt"), "Aye.").unwrap();
        settings.audio.locale = None;
        let error = SyncRun::of_recordings(&settings, &output, None).unwrap_err();
        assert!(error.to_string().contains("the locale of the texts is not set"), "{error}");
    }

    #[test]
    fn errors_keep_a_run_from_starting_and_warnings_are_in_its_result() {
        let (folder, mut settings) = project();
        let record = folder.path().join("voices").join(crate::record::RECORD_NAME);
        fs::write(&record, "# lipz sync\nnothing\n").unwrap();
        let synced = SyncRun::new(&settings).unwrap().run();
        let mut found = synced.reports.iter().flat_map(|report| &report.diagnostics);
        assert!(found.any(|diagnostic| diagnostic.code == Code::SyncRecordLine), "{:?}", synced.reports);
        fs::write(&record, "my notes").unwrap();
        assert!(SyncRun::new(&settings).unwrap_err().to_string().contains("is not a record"));
        settings.audio.folder = Some(folder.path().join("nowhere"));
        assert_eq!(SyncRun::new(&settings).unwrap_err().reports()[0].diagnostics[0].code, Code::UnreadableFile);
        settings.audio.folder = None;
        assert!(SyncRun::new(&settings).unwrap_err().to_string().contains("does not set a folder of recordings"));
    }
}
