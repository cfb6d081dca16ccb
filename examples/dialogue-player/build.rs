//! Packs `voices` while cargo builds the player.

use lipz_compiler::{Build, BuildError, Options};

fn main() -> Result<(), BuildError> {
    let options = Options { default_locale: Some("en-us".into()), ..Options::default() };
    Build::new("voices").options(options).run()
}
