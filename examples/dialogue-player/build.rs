//! Packs `voices` while cargo builds the player.

use lipz_compiler::{Build, BuildError, Options};

fn main() -> Result<(), BuildError> {
    let options = Options::new().default_locale("en-us")?;
    Build::new("voices").options(options).run()
}
