//! Hands what libFuzzer makes up to `lipz_fuzz::second_life`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lipz_fuzz::second_life(bytes));
