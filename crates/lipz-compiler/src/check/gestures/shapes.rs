//! What a gesture does to which curve, and when. docs/guides/faces.md has these numbers with their sources.

use lipz_bank::face::FaceCurve;

/// A gesture.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Kind {
    Nod,
    Shake,
    Shrug,
    Breath,
    /// The brows go up.
    Brows,
    /// The head goes down a little, as at a word that is stressed.
    Stress,
    Blink,
    /// The eyes go to the left for a moment.
    LookAway,
}

/// A curve's way through a gesture: milliseconds from its start, and thousandths of its strength there.
pub(super) type Path = &'static [(u32, i32)];

/// Down, up, and down again, ever less: "a set of decreasing values" (Moore).
const SWINGS_DOWN: Path = &[(150, -1000), (300, 500), (450, -250), (600, 0)];
/// To the left first.
const SWINGS_LEFT: Path = &[(150, 1000), (300, -500), (450, 250), (600, 0)];
const DIP: Path = &[(120, -1000), (400, 0)];
const BREATH: Path = &[(300, 1000), (1000, 0)];
const RAISED: Path = &[(120, 1000), (350, 1000), (650, 0)];
/// A blink as the reader makes them: lids stay closed for a quarter of it.
const CLOSED: Path = &[(60, 1000), (120, 1000), (240, 0)];
const AWAY: Path = &[(150, 1000), (1150, 1000), (1300, 0)];
/// Down, by less than to the side.
const AWAY_DOWN: Path = &[(150, -320), (1150, -320), (1300, 0)];
const SHRUGGED: Path = &[(200, 1000), (600, 1000), (900, 0)];

impl Kind {
    /// The gesture of a list of words.
    pub(super) fn of_list(name: &str) -> Option<Kind> {
        match name {
            "nod" => Some(Kind::Nod),
            "shake" => Some(Kind::Shake),
            "shrug" => Some(Kind::Shrug),
            _ => None,
        }
    }

    /// The curves that it moves, and how.
    pub(super) fn paths(self) -> &'static [(FaceCurve, Path)] {
        match self {
            Kind::Nod => &[(FaceCurve::Nod, SWINGS_DOWN)],
            Kind::Stress => &[(FaceCurve::Nod, DIP)],
            Kind::Shake => &[(FaceCurve::Shake, SWINGS_LEFT)],
            Kind::Shrug => &[(FaceCurve::Shrug, SHRUGGED)],
            Kind::Breath => &[(FaceCurve::Breath, BREATH)],
            Kind::Brows => &[(FaceCurve::Brows, RAISED)],
            Kind::Blink => &[(FaceCurve::Lids, CLOSED)],
            Kind::LookAway => &[(FaceCurve::LookYaw, AWAY), (FaceCurve::LookPitch, AWAY_DOWN)],
        }
    }

    /// What a strength, in thousandths, adds to the neutral value of the curve at most. Swings of 10 go from one end of their
    /// curve to the other.
    pub(super) fn amplitude(self, strength: i32) -> i32 {
        match self {
            Kind::Nod | Kind::Stress | Kind::Shake => strength / 2,
            Kind::Shrug | Kind::Breath | Kind::Brows | Kind::Blink | Kind::LookAway => strength,
        }
    }
}

/// The value of a curve that nothing moves, in thousandths.
pub(super) fn neutral(curve: FaceCurve) -> i32 {
    match curve {
        FaceCurve::Nod | FaceCurve::Shake => 5000,
        _ => 0,
    }
}
