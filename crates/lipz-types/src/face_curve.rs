//! Names of the curves that move a face, except those for mouth and emotions (`docs/guides/faces.md`, "Generated
//! motion").

/// A curve with a predefined name: it moves eyes, head or brows, or sets the depth of breathing.
///
/// ```
/// use lipz_types::FaceCurve;
/// assert_eq!(FaceCurve::HeadYaw.name(), "headYaw");
/// assert_eq!(FaceCurve::from_name("nod"), Some(FaceCurve::Nod));
/// assert_eq!(FaceCurve::from_name("anger"), None); // an emotion
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
pub enum FaceCurve {
    /// `blink`, replaces the generated blinks: 0 for open eyes, 1 for closed ones.
    Blink,
    /// `headPitch`, replaces the generated motion, in degrees: up is positive.
    HeadPitch,
    /// `headYaw`, in degrees: to the left of the character is positive.
    HeadYaw,
    /// `headRoll`, in degrees: towards the left shoulder is positive.
    HeadRoll,
    /// `eyePitch`, replaces the generated direction of the eyes, in degrees: up is positive.
    EyePitch,
    /// `eyeYaw`, in degrees: to the left of the character is positive.
    EyeYaw,
    /// `lids`, added to the blinks: 0 for open eyes, 1 for closed ones.
    Lids,
    /// `nod`, added to the motion of the head: from 0, down, to 10, up; 5 is neutral.
    Nod,
    /// `shake`, added to the motion of the head: from 0, right, to 10, left; 5 is neutral.
    Shake,
    /// `lookPitch`, added to the direction of the eyes, in degrees.
    LookPitch,
    /// `lookYaw`, added to the direction of the eyes, in degrees.
    LookYaw,
    /// `brows`: how far they are raised, from 0 to 1.
    Brows,
    /// `shrug` of the face: from 0 to 1.
    Shrug,
    /// `breath`: from 0 to 10, gasping.
    Breath,
    /// `pose`, replaces the times at which the head turns to a new pose while the mouth moves. The head turns at each
    /// key, by the share in the key's value, from 0 to 1.
    Pose,
}

impl FaceCurve {
    /// All of them, in the order of their numbers.
    pub const ALL: [FaceCurve; 15] = [
        FaceCurve::Blink,
        FaceCurve::HeadPitch,
        FaceCurve::HeadYaw,
        FaceCurve::HeadRoll,
        FaceCurve::EyePitch,
        FaceCurve::EyeYaw,
        FaceCurve::Lids,
        FaceCurve::Nod,
        FaceCurve::Shake,
        FaceCurve::LookPitch,
        FaceCurve::LookYaw,
        FaceCurve::Brows,
        FaceCurve::Shrug,
        FaceCurve::Breath,
        FaceCurve::Pose,
    ];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            FaceCurve::Blink => "blink",
            FaceCurve::HeadPitch => "headPitch",
            FaceCurve::HeadYaw => "headYaw",
            FaceCurve::HeadRoll => "headRoll",
            FaceCurve::EyePitch => "eyePitch",
            FaceCurve::EyeYaw => "eyeYaw",
            FaceCurve::Lids => "lids",
            FaceCurve::Nod => "nod",
            FaceCurve::Shake => "shake",
            FaceCurve::LookPitch => "lookPitch",
            FaceCurve::LookYaw => "lookYaw",
            FaceCurve::Brows => "brows",
            FaceCurve::Shrug => "shrug",
            FaceCurve::Breath => "breath",
            FaceCurve::Pose => "pose",
        }
    }

    /// Returns the curve with this name.
    pub fn from_name(name: &str) -> Option<FaceCurve> {
        FaceCurve::ALL.iter().copied().find(|curve| curve.name() == name)
    }
}
