//! Requests to end on Unix: signals.

use libc::c_int;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, mpsc};
use std::{mem, ptr, thread};

/// Ctrl-C, `kill`, and a closed terminal.
const REQUESTS: [c_int; 3] = [SIGINT, SIGTERM, SIGHUP];

/// Calls `end` in a separate thread when the process is asked to end.
///
/// Each signal that the process ignores stays ignored: `nohup` ignores SIGHUP, and shells ignore SIGINT in background
/// processes of scripts. Both still end with SIGTERM.
pub(super) fn on_request(end: impl FnOnce() + Send + 'static) {
    // A file that reaches its size limit becomes a write error instead of ending the process.
    let _ = flag::register(SIGXFSZ, Arc::<AtomicBool>::default());
    let (listening, heard) = mpsc::channel();
    let heeded = REQUESTS.into_iter().filter(|signal| !is_ignored(*signal));
    let heeded: Vec<c_int> = heeded.collect();
    let wait = move || {
        // If the system refuses a handler or its thread, the signal ends the process directly.
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

/// Whether the process was started with a signal ignored.
#[allow(unsafe_code, reason = "no safe function returns the handler of a signal without changing it")]
fn is_ignored(signal: c_int) -> bool {
    // SAFETY: the struct consists of numbers, for which zeros are valid. Without a new action, the call changes nothing
    // and writes the current one into the struct.
    unsafe {
        let mut action: libc::sigaction = mem::zeroed();
        libc::sigaction(signal, ptr::null(), &raw mut action) == 0 && action.sa_sigaction == libc::SIG_IGN
    }
}
