//! Which known word somebody probably meant.

/// Bytes of the longest word that is compared with others.
const COMPARED: usize = 40;

/// The word of `known` that is nearest to `written`, if one is near: `default_fps` is near
/// `default-fps`.
pub(super) fn nearest<'k>(written: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    if written.len() > COMPARED {
        return None;
    }
    let written = plain(written);
    known
        .into_iter()
        .map(|known| (strsim::damerau_levenshtein(&written, &plain(known)), known))
        .filter(|&(distance, known)| distance * 3 <= known.len())
        .min()
        .map(|(_, known)| known)
}

/// The word without what people are unsure of: case and separators.
fn plain(word: &str) -> String {
    word.to_lowercase().replace(['_', '-', ' '], "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_and_far() {
        let known = ["default-fps", "strip", "root"];
        assert_eq!(nearest("default_fps", known), Some("default-fps"));
        assert_eq!(nearest("defaultFPS", known), Some("default-fps"));
        assert_eq!(nearest("stirp", known), Some("strip"));
        assert_eq!(nearest("fps", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest(&"strip".repeat(10), known), None);
    }
}
