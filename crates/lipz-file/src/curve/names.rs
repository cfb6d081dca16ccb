//! Names of curves that many rigs share.

/// The blend shapes of Apple's ARKit (`ARFaceAnchor.BlendShapeLocation`), which most face trackers and rigs use.
pub const ARKIT: [&str; 52] = [
    "eyeBlinkLeft",
    "eyeLookDownLeft",
    "eyeLookInLeft",
    "eyeLookOutLeft",
    "eyeLookUpLeft",
    "eyeSquintLeft",
    "eyeWideLeft",
    "eyeBlinkRight",
    "eyeLookDownRight",
    "eyeLookInRight",
    "eyeLookOutRight",
    "eyeLookUpRight",
    "eyeSquintRight",
    "eyeWideRight",
    "jawForward",
    "jawLeft",
    "jawRight",
    "jawOpen",
    "mouthClose",
    "mouthFunnel",
    "mouthPucker",
    "mouthLeft",
    "mouthRight",
    "mouthSmileLeft",
    "mouthSmileRight",
    "mouthFrownLeft",
    "mouthFrownRight",
    "mouthDimpleLeft",
    "mouthDimpleRight",
    "mouthStretchLeft",
    "mouthStretchRight",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthShrugUpper",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthLowerDownLeft",
    "mouthLowerDownRight",
    "mouthUpperUpLeft",
    "mouthUpperUpRight",
    "browDownLeft",
    "browDownRight",
    "browInnerUp",
    "browOuterUpLeft",
    "browOuterUpRight",
    "cheekPuff",
    "cheekSquintLeft",
    "cheekSquintRight",
    "noseSneerLeft",
    "noseSneerRight",
    "tongueOut",
];

/// The angles of head and eyes that Live Link Face records in addition to the shapes of ARKit.
pub const LIVE_LINK_ANGLES: [&str; 9] = [
    "HeadYaw",
    "HeadPitch",
    "HeadRoll",
    "LeftEyeYaw",
    "LeftEyePitch",
    "LeftEyeRoll",
    "RightEyeYaw",
    "RightEyePitch",
    "RightEyeRoll",
];

/// Whether a name is one of [`ARKIT`], possibly capitalised as in Unreal's Live Link (`JawOpen`).
pub fn is_arkit(name: &str) -> bool {
    let mut rest = name.chars();
    let Some(first) = rest.next() else { return false };
    ARKIT.iter().any(|known| known.strip_prefix(first.to_ascii_lowercase()).is_some_and(|known| known == rest.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_spellings_are_known() {
        assert!(ARKIT.iter().all(|name| is_arkit(name)));
        assert!(is_arkit("JawOpen") && !is_arkit("jawopen") && !is_arkit("") && !is_arkit("awOpen"));
        let mut sorted = ARKIT;
        sorted.sort_unstable();
        assert!(sorted.array_windows().all(|[one, next]| one < next), "no name twice");
    }
}
