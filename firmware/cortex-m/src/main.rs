//! Firmware for a Cortex-M with a bank in memory outside of the image. Opens, verifies and plays the bank, and makes
//! every query. The emulator's exit code states whether all answers are correct.

#![no_std]
#![no_main]

mod machine;
mod stack;

use core::hint::black_box;
use core::panic::PanicInfo;
use firmware_check::{Failure, answers_as, verified};
use lipz_bank::{Bank, Micros};
use machine::{exit, say};

/// The time between two queries of a clip at 60 Hz.
const TICK_US: usize = 16_667;

fn main() -> Result<(), Failure<'static>> {
    let bytes = machine::bank();
    let bank = Bank::open(bytes).map_err(Failure::Refused)?;
    report_stack("open", || open(bytes));
    report_stack("verify", || verify(&bank));
    let bank = verified(bytes)?;
    report_stack("queries", || play(&bank));
    answers_as(&bank, machine::expected_answers())?;
    say(format_args!("{} clips give the expected answers\n", bank.clip_count()));
    Ok(())
}

/// Measures the stack of a step. Each step is a function that is not inlined, so that it is measured separately.
fn report_stack(name: &str, step: impl FnOnce()) {
    let depth_bytes = stack::depth_bytes(step);
    say(format_args!("stack of {name}: {depth_bytes} bytes\n"));
}

#[inline(never)]
fn open(bytes: &[u8]) {
    black_box(Bank::open(bytes).is_ok());
}

#[inline(never)]
fn verify(bank: &Bank<'_>) {
    black_box(bank.verify().is_ok());
}

/// Plays every clip in every locale at 60 Hz, like a game.
#[inline(never)]
fn play(bank: &Bank<'_>) {
    for clip in bank.clips() {
        let duration_us = clip.duration_us().unwrap_or(0) as i64;
        for time_us in (0..duration_us).step_by(TICK_US) {
            black_box(clip.viseme_at(Micros(time_us)));
            if let Some(segment) = clip.segment_at(Micros(time_us)) {
                black_box((segment.start_us(), segment.end_us(), segment.event()));
                black_box(segment.events().count());
                for locale in bank.locales() {
                    black_box(segment.text(locale).is_some());
                }
            }
        }
    }
}

/// The entry point of the processor.
#[no_mangle]
extern "C" fn reset() -> ! {
    match main() {
        Ok(()) => exit(true),
        Err(failure) => {
            say(format_args!("{failure}\n"));
            exit(false)
        }
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    say(format_args!("{info}\n"));
    exit(false)
}
