//! Hands what libFuzzer makes up to `lipz_testkit::fuzz::set`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lipz_testkit::fuzz::set(bytes));
