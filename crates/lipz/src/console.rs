//! Output to standard output and standard error.

use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use lipz_diagnostics::escape;
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::thread;
use std::time::Duration;

/// The number of columns without a terminal.
const DEFAULT_WIDTH: usize = 100;

/// Prints text. A closed pipe (`| head`) is not an error; a full disk is.
pub(crate) fn print(text: &str) -> io::Result<()> {
    printed(anstream::stdout().lock(), text.as_bytes())
}

/// Prints binary data.
pub(crate) fn print_bytes(bytes: &[u8]) -> io::Result<()> {
    printed(io::stdout().lock(), bytes)
}

fn printed(mut out: impl Write, bytes: &[u8]) -> io::Result<()> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Prints diagnostics and remarks.
pub(crate) fn remark(text: &str) {
    let mut out = anstream::stderr().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Prints a remark when the terminal may show a progress bar.
pub(crate) fn remark_below_progress(text: &str) {
    let line_break = if io::stderr().is_terminal() { "\n" } else { "" };
    remark(&format!("{line_break}{text}"));
}

/// Returns the number of columns of the terminal, or a width suitable for files.
pub(crate) fn width() -> usize {
    terminal_size::terminal_size().map_or(DEFAULT_WIDTH, |(width, _)| usize::from(width.0)).clamp(24, 200)
}

/// A bar that counts files or their parts. It is visible only on a terminal.
pub(crate) struct Progress(Option<ProgressBar>);

/// Returns a bar that counts to `length`, visible only on a terminal.
pub(crate) fn progress_bar(length: usize, quiet: bool) -> Progress {
    progress_bar_of_parts(length, 1, quiet)
}

/// Returns a bar that counts the parts of `length` files with `parts` each.
pub(crate) fn progress_bar_of_parts(length: usize, parts: u64, quiet: bool) -> Progress {
    if quiet || !io::stderr().is_terminal() {
        return Progress(None);
    }
    let bar = ProgressBar::new(length as u64 * parts);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {files} files{left}") {
        let files = move |state: &ProgressState, out: &mut dyn fmt::Write| {
            let count = |parts_done: u64| HumanCount(parts_done / parts);
            let _ = write!(out, "{}/{}", count(state.pos()), count(state.len().unwrap_or_default()));
        };
        bar.set_style(style.with_key("files", files).with_key("left", left));
    }
    // The progress bar needs a thread, and panics without one.
    if thread::Builder::new().spawn(|| ()).is_ok() {
        bar.enable_steady_tick(Duration::from_millis(200));
    }
    Progress(Some(bar))
}

/// Writes the remaining time, once it can be estimated.
fn left(state: &ProgressState, out: &mut dyn fmt::Write) {
    if state.pos() > 0 {
        let _ = write!(out, ", {:#} left", HumanDuration(state.eta()));
    }
}

impl Progress {
    /// Counts completed files or parts of files. A hidden bar is skipped, because it would also estimate the remaining
    /// time.
    pub(crate) fn inc(&self, done: u64) {
        if let Some(bar) = &self.0 {
            bar.inc(done);
        }
    }

    /// Ends the counting.
    pub(crate) fn finish_and_clear(&self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

/// Returns a path for printing, without terminal control characters.
pub(crate) fn path(path: &Path) -> String {
    escape::text(&path.to_string_lossy()).into_owned()
}

/// Returns a number with commas: 1,234,567.
pub(crate) fn grouped(number: usize) -> String {
    HumanCount(number as u64).to_string()
}

/// Returns `1 clip` or `2 clips`.
pub(crate) fn counted(number: usize, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {what}{plural}", grouped(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_that_nobody_sees_is_not_worked_out() {
        assert!(progress_bar(10, true).0.is_none());
        // Neither tests nor builds have a terminal to show it on.
        assert_eq!(progress_bar(10, false).0.is_some(), io::stderr().is_terminal());
    }
}
