//! The character whose curves count: curves of the speaker have no name in front, those of other characters do.

/// The character whose face and emotions are queried, which decides the curves that count.
///
/// ```
/// # use lipz_bank::{Clip, Micros};
/// # use lipz_bank::face::Who;
/// # fn draw(clip: &Clip<'_>, now: Micros) {
/// // Otto speaks, and his events are `otto feels joy 2, mara feels fear 4`.
/// let speaker = clip.emotions_at(now, Who::SpeakerNamed("otto"));
/// let listener = clip.emotions_at(now, "mara");
/// # }
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Who<'name> {
    /// The speaker: the curves without a name, such as `fear`.
    Speaker,
    /// The speaker, with a name: curves with that name, such as `mara.fear`, count as well, so that `mara feels fear`
    /// in her own line moves her face like `feels fear`. If two curves have the same purpose, the value farther from
    /// neutral counts; for poses, the curve with the name.
    SpeakerNamed(&'name str),
    /// Another character: the curves with this name.
    Other(&'name str),
}

/// Another character.
impl<'name> From<&'name str> for Who<'name> {
    fn from(name: &'name str) -> Self {
        Who::Other(name)
    }
}

impl Who<'_> {
    /// Returns the purpose of the curve with this name, without the character: `fear` for `mara.fear`. `None` if it
    /// belongs to a different character.
    pub(crate) fn purpose(self, curve: &[u8]) -> Option<&[u8]> {
        let behind =
            |character: &str| curve.strip_prefix(character.as_bytes()).and_then(|rest| rest.strip_prefix(b"."));
        match self {
            Who::Speaker => Some(curve),
            Who::SpeakerNamed(character) => Some(behind(character).unwrap_or(curve)),
            Who::Other(character) => behind(character),
        }
    }
}

/// Returns the one of two values that is farther from neutral.
pub(crate) fn farther(one: i32, other: i32, neutral: i32) -> i32 {
    if other.abs_diff(neutral) > one.abs_diff(neutral) { other } else { one }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_whole() {
        let of = |who: Who<'_>| {
            ["fear", "mara.fear", "maria.fear", "mara.", "mara"]
                .map(|curve| who.purpose(curve.as_bytes()).map(<[u8]>::len))
        };
        assert_eq!(of(Who::Speaker), [Some(4), Some(9), Some(10), Some(5), Some(4)]);
        assert_eq!(of(Who::Other("mara")), [None, Some(4), None, Some(0), None]);
        assert_eq!(of(Who::SpeakerNamed("mara")), [Some(4), Some(4), Some(10), Some(0), Some(4)]);
        assert_eq!(of("mar".into()), [None; 5]);
        assert_eq!((farther(-3, 2, 0), farther(2, -3, 0), farther(5000, 2000, 5000)), (-3, -3, 2000));
    }
}
