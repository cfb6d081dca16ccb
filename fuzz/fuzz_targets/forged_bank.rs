//! Hands what libFuzzer makes up to `lipz_fuzz::forged_bank`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lipz_fuzz::forged_bank(bytes));
