//! What a project decides about its Lipz files.

use lipz_bank::{Fps, VisemeType};

/// Settings of a pack or check run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Frame rate of files without `fps`. Without it their clips' rate is "unspecified".
    pub default_fps: Option<Fps>,
    /// Viseme type of files without `viseme_type`. Without it their clips' type is "unspecified".
    pub default_viseme_type: Option<VisemeType>,
    /// Locale of `text` elements without one, and the last resort of every locale's fallback. Any
    /// spelling that [`lipz::locale::canonical_tag`] accepts.
    pub default_locale: Option<String>,
    /// Accept any BCP 47 language tag (`es-419`, `zh-hant`), not only `ll-cc`.
    pub extended_locales: bool,
    /// Leave out the source section: smaller, but unpacking gives display forms only.
    pub strip: bool,
    /// Threads that read and check files; `None` for one per core.
    pub threads: Option<usize>,
}
