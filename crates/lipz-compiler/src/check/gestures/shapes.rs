//! The curves of each gesture, and their timing. docs/guides/faces.md lists these numbers with their sources.

use lipz_bank::face::FaceCurve;

/// A kind of gesture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum GestureKind {
    Nod,
    Shake,
    Shrug,
    Breath,
    /// The brows rise.
    Brows,
    /// The head lowers a little, as for a stressed word.
    Stress,
    Blink,
    /// The eyes turn to the left for a moment.
    LookAway,
}

/// The path of a curve through a gesture: milliseconds from its start, and thousandths of its strength at that time.
pub(super) type Path = &'static [(u32, i32)];

/// Down, up, and down again, with decreasing amplitude: "a set of decreasing values" (Moore).
const SWINGS_DOWN: Path = &[(150, -1000), (300, 500), (450, -250), (600, 0)];
/// The first swing goes to the left.
const SWINGS_LEFT: Path = &[(150, 1000), (300, -500), (450, 250), (600, 0)];
const DIP: Path = &[(120, -1000), (400, 0)];
const BREATH: Path = &[(300, 1000), (1000, 0)];
const RAISED: Path = &[(120, 1000), (350, 1000), (650, 0)];
/// A blink like those of the reader: the eyelids stay closed for a quarter of it.
const CLOSED: Path = &[(60, 1000), (120, 1000), (240, 0)];
const AWAY: Path = &[(150, 1000), (1150, 1000), (1300, 0)];
/// Down, by less than to the side.
const AWAY_DOWN: Path = &[(150, -320), (1150, -320), (1300, 0)];
const SHRUGGED: Path = &[(200, 1000), (600, 1000), (900, 0)];

impl GestureKind {
    /// Returns the gesture with this name in the lists of words.
    pub(super) fn of_list(name: &str) -> Option<GestureKind> {
        match name {
            "nod" => Some(GestureKind::Nod),
            "shake" => Some(GestureKind::Shake),
            "shrug" => Some(GestureKind::Shrug),
            _ => None,
        }
    }

    /// Returns the curves of the gesture with their paths.
    pub(super) fn paths(self) -> &'static [(FaceCurve, Path)] {
        match self {
            GestureKind::Nod => &[(FaceCurve::Nod, SWINGS_DOWN)],
            GestureKind::Stress => &[(FaceCurve::Nod, DIP)],
            GestureKind::Shake => &[(FaceCurve::Shake, SWINGS_LEFT)],
            GestureKind::Shrug => &[(FaceCurve::Shrug, SHRUGGED)],
            GestureKind::Breath => &[(FaceCurve::Breath, BREATH)],
            GestureKind::Brows => &[(FaceCurve::Brows, RAISED)],
            GestureKind::Blink => &[(FaceCurve::Lids, CLOSED)],
            GestureKind::LookAway => &[(FaceCurve::LookYaw, AWAY), (FaceCurve::LookPitch, AWAY_DOWN)],
        }
    }

    /// Returns the maximum difference from the neutral value of the curve for a strength, in thousandths. Swings of
    /// strength 10 move from one end of their curve to the other.
    pub(super) fn amplitude(self, strength: i32) -> i32 {
        match self {
            GestureKind::Nod | GestureKind::Stress | GestureKind::Shake => strength / 2,
            GestureKind::Shrug
            | GestureKind::Breath
            | GestureKind::Brows
            | GestureKind::Blink
            | GestureKind::LookAway => strength,
        }
    }
}

/// Returns the value of a curve without movement, in thousandths.
pub(super) fn neutral(curve: FaceCurve) -> i32 {
    match curve {
        FaceCurve::Nod | FaceCurve::Shake => 5000,
        _ => 0,
    }
}
