//! Passes the machine's memory map to the linker.

fn main() {
    println!("cargo:rerun-if-changed=mps2.ld");
    println!("cargo:rustc-link-arg-bins=-T{}/mps2.ld", env!("CARGO_MANIFEST_DIR"));
}
