//! The files of the page, embedded in the binary: `page/` is the page, and `web/` its files from the npm package. Its
//! JavaScript files are links, which `cargo package` replaces with files. `cargo xtask web` builds and compares its
//! module.

/// A file of the page.
pub(super) struct Asset {
    /// Its path below the address of the page.
    pub(super) path: &'static str,
    pub(super) bytes: &'static [u8],
}

macro_rules! assets {
    ($($path:literal)+) => {
        /// All files of the page.
        pub(super) const ALL: &[Asset] = &[$(Asset { path: $path, bytes: include_bytes!($path) },)+];
    };
}

assets! {
    "page/clip.css"
    "page/difference.js"
    "page/division.js"
    "page/editor.js"
    "page/edits.js"
    "page/exported.js"
    "page/index.html"
    "page/keys.js"
    "page/list.js"
    "page/main.js"
    "page/mouth.js"
    "page/player.js"
    "page/problems.js"
    "page/shapes.js"
    "page/sound.js"
    "page/source.js"
    "page/split.js"
    "page/style.css"
    "page/texts.js"
    "page/tracks.js"
    "web/articulation.js"
    "web/babble.js"
    "web/clip.js"
    "web/cursor.js"
    "web/curve.js"
    "web/demo/colours.css"
    "web/demo/curves.css"
    "web/demo/articulators.js"
    "web/demo/curves.js"
    "web/demo/drag.js"
    "web/demo/levels.js"
    "web/demo/plots.js"
    "web/demo/pose.js"
    "web/demo/timeline.css"
    "web/demo/sprites.js"
    "web/demo/timeline.js"
    "web/dialogue.js"
    "web/error.js"
    "web/exports.js"
    "web/face-profile.js"
    "web/face.js"
    "web/face/colour.js"
    "web/face/emotion.js"
    "web/face/eyes.js"
    "web/face/geometry.js"
    "web/face/head.js"
    "web/face/lips.js"
    "web/face/mouth.js"
    "web/face/parts.js"
    "web/face/path.js"
    "web/face/presets.js"
    "web/face/skin.js"
    "web/frame-time.js"
    "web/handle.js"
    "web/lipz.js"
    "web/lipz.wasm"
    "web/memory.js"
    "web/nearest.js"
    "web/open.js"
    "web/read-web.js"
    "web/segment.js"
    "web/shape-names.js"
    "web/shapes.js"
    "web/structs.js"
    "web/words.js"
}

/// Returns the file at a path below the address of the page, or the page itself for an empty path.
pub(super) fn named(path: &str) -> Option<&'static Asset> {
    let path = if path.is_empty() { "page/index.html" } else { path };
    ALL.iter().find(|asset| asset.path == path)
}

impl Asset {
    /// Returns the media type, without which browsers refuse modules.
    pub(super) fn media_type(&self) -> &'static str {
        match self.path.rsplit_once('.') {
            Some((_, "html")) => "text/html; charset=utf-8",
            Some((_, "css")) => "text/css; charset=utf-8",
            Some((_, "js")) => "text/javascript; charset=utf-8",
            Some((_, "wasm")) => "application/wasm",
            _ => "application/octet-stream",
        }
    }
}
