//! Packs `voices` while cargo builds the player.

use lipz_compiler::{Build, BuildFailed, Options};

fn main() -> Result<(), BuildFailed> {
    let options = Options { default_locale: Some("en-us".into()), ..Options::default() };
    Build::new("voices").options(options).run()
}
