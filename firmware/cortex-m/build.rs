//! Tells the linker where the memory of the machine is.

fn main() {
    println!("cargo:rerun-if-changed=mps2.ld");
    println!("cargo:rustc-link-arg-bins=-T{}/mps2.ld", env!("CARGO_MANIFEST_DIR"));
}
