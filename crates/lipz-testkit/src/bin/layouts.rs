//! `layouts FOLDER` writes the files with which programs in other languages play the playback cases.

fn main() -> Result<(), &'static str> {
    let folder = std::env::args_os().nth(1).ok_or("usage: layouts <folder>")?;
    lipz_testkit::layouts::write(folder.as_ref());
    Ok(())
}
