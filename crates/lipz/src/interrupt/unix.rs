//! Requests to end, as Unix sends them: signals.

use libc::c_int;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, mpsc};
use std::{mem, ptr, thread};

/// Ctrl-C, `kill`, and a terminal that was closed.
const REQUESTS: [c_int; 3] = [SIGINT, SIGTERM, SIGHUP];

/// Calls `end` in a thread of its own once the process is asked to end.
///
/// Signals that it ignores stay ignored, each by itself: `nohup` takes SIGHUP away, and shells take SIGINT from what
/// scripts start in the background. Both still end by SIGTERM.
pub(super) fn on_request(end: impl FnOnce() + Send + 'static) {
    // A file that may not grow any more is an error of the write, and the end of that alone.
    let _ = flag::register(SIGXFSZ, Arc::<AtomicBool>::default());
    let (listening, heard) = mpsc::channel();
    let heeded = REQUESTS.into_iter().filter(|signal| !is_ignored(*signal));
    let heeded: Vec<c_int> = heeded.collect();
    let wait = move || {
        // Where the system refuses a handler, or the thread for it, the signal ends the process by itself.
        let Ok(mut signals) = Signals::new(heeded) else { return };
        let _ = listening.send(());
        if signals.forever().next().is_some() {
            end();
        }
    };
    if thread::Builder::new().spawn(wait).is_ok() {
        let _ = heard.recv();
    }
}

/// Whether the process was started so that it ignores a signal.
#[allow(unsafe_code, reason = "no safe function tells what becomes of a signal without changing it")]
fn is_ignored(signal: c_int) -> bool {
    // SAFETY: the struct is plain numbers, for which zeros will do. Without a new action nothing is changed, and the
    // one in force is written into the struct.
    unsafe {
        let mut action: libc::sigaction = mem::zeroed();
        libc::sigaction(signal, ptr::null(), &raw mut action) == 0 && action.sa_sigaction == libc::SIG_IGN
    }
}
