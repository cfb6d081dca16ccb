//! Times of the cases, in each of the units.

use super::number;
use lipz_bank::{Micros, Samples, Seconds};

/// A time in one of the units.
#[derive(Clone, Copy)]
pub(super) enum Time {
    Us(Micros),
    Samples(Samples),
    Seconds(Seconds<f64>),
    Short(Seconds<f32>),
}

impl Time {
    /// Returns the time of these words, and the words after it.
    pub(super) fn read<'w>(words: &'w [&'w str]) -> (Time, &'w [&'w str]) {
        match words {
            ["us", us, rest @ ..] => (Time::Us(Micros(number(us))), rest),
            ["samples", position, rate_hz, rest @ ..] => {
                (Time::Samples(Samples { position: number(position), rate_hz: number(rate_hz) }), rest)
            }
            ["seconds", seconds, rest @ ..] => (Time::Seconds(Seconds(number(seconds))), rest),
            ["f32", seconds, rest @ ..] => (Time::Short(Seconds(number(seconds))), rest),
            _ => panic!("no time: {words:?}"),
        }
    }
}

/// Calls a method with a time.
macro_rules! at {
    ($time:expr, |$each:ident| $call:expr) => {
        match $time {
            Time::Us($each) => $call,
            Time::Samples($each) => $call,
            Time::Seconds($each) => $call,
            Time::Short($each) => $call,
        }
    };
}
