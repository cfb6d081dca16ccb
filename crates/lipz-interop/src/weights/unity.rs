//! Animation clips of Unity, `.anim`: blend shapes of the object that has the animator. Unity's weights are percentages.

use super::keys::{WeightKey, keys, quoted, spell};
use super::{FaceAnimation, WeightFormat};
use lipz_diagnostics::Diagnostic;
use std::fmt::Write;

const PERCENT: f64 = 100.0;
/// The class of `SkinnedMeshRenderer`.
const RENDERER: u32 = 137;
/// Linear tangents on both sides that do not follow each other.
const LINEAR_TANGENTS: u32 = 69;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "unity",
    about: "Unity animation clips of blend shapes, .anim",
    extension: "anim",
    rig: "arkit",
    fixed_rate: None,
    write,
};

fn write(animation: &FaceAnimation, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let name = quoted(&animation.name);
    let mut file = format!(
        "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!74 &7400000\nAnimationClip:\n  m_ObjectHideFlags: 0\n  \
         m_CorrespondingSourceObject: {{fileID: 0}}\n  m_PrefabInstance: {{fileID: 0}}\n  m_PrefabAsset: {{fileID: 0}}\n  \
         m_Name: {name}\n  serializedVersion: 7\n  m_Legacy: 0\n  m_Compressed: 0\n  m_UseHighQualityCurve: 1\n  \
         m_RotationCurves: []\n  m_CompressedRotationCurves: []\n  m_EulerCurves: []\n  m_PositionCurves: []\n  \
         m_ScaleCurves: []\n  m_FloatCurves:\n"
    );
    for weight in &animation.weights {
        curve(&mut file, &weight.name, &keys(animation, weight));
    }
    // Writing to a string cannot fail.
    let _ = write!(
        file,
        "  m_PPtrCurves: []\n  m_SampleRate: {}\n  m_WrapMode: 0\n  m_Bounds:\n    m_Center: {{x: 0, y: 0, z: 0}}\n    \
         m_Extent: {{x: 0, y: 0, z: 0}}\n  m_ClipBindingConstant:\n    genericBindings: []\n    pptrCurveMapping: []\n  \
         m_AnimationClipSettings:\n    serializedVersion: 2\n    m_AdditiveReferencePoseClip: {{fileID: 0}}\n    \
         m_AdditiveReferencePoseTime: 0\n    m_StartTime: 0\n    m_StopTime: {}\n    m_OrientationOffsetY: 0\n    \
         m_Level: 0\n    m_CycleOffset: 0\n    m_HasAdditiveReferencePose: 0\n    m_LoopTime: 0\n    m_LoopBlend: 0\n    \
         m_LoopBlendOrientation: 0\n    m_LoopBlendPositionY: 0\n    m_LoopBlendPositionXZ: 0\n    \
         m_KeepOriginalOrientation: 0\n    m_KeepOriginalPositionY: 1\n    m_KeepOriginalPositionXZ: 0\n    \
         m_HeightFromFeet: 0\n    m_Mirror: 0\n  m_EditorCurves: []\n  m_EulerEditorCurves: []\n  \
         m_HasGenericRootTransform: 0\n  m_HasMotionFloatCurves: 0\n  m_Events: []\n",
        spell(animation.frames_per_second()),
        spell(animation.duration_seconds()),
    );
    file.into_bytes()
}

/// Writes the curve of a blend shape.
fn curve(file: &mut String, name: &str, keys: &[WeightKey]) {
    *file += "  - serializedVersion: 2\n    curve:\n      serializedVersion: 2\n      m_Curve:\n";
    let slope = |from: Option<&WeightKey>, to: Option<&WeightKey>| match (from, to) {
        (Some(from), Some(to)) => (to.value - from.value) * PERCENT / (to.seconds - from.seconds),
        _ => 0.0,
    };
    for (index, key) in keys.iter().enumerate() {
        let before = index.checked_sub(1).and_then(|before| keys.get(before));
        // Writing to a string cannot fail.
        let _ = write!(
            file,
            "      - serializedVersion: 3\n        time: {}\n        value: {}\n        inSlope: {}\n        outSlope: \
             {}\n        tangentMode: {LINEAR_TANGENTS}\n        weightedMode: 0\n        inWeight: 0.33333334\n        \
             outWeight: 0.33333334\n",
            spell(key.seconds),
            spell(key.value * PERCENT),
            spell(slope(before, Some(key))),
            spell(slope(Some(key), keys.get(index + 1))),
        );
    }
    let _ = write!(
        file,
        "      m_PreInfinity: 2\n      m_PostInfinity: 2\n      m_RotationOrder: 4\n    attribute: {}\n    path: \n    \
         classID: {RENDERER}\n    script: {{fileID: 0}}\n    flags: 16\n",
        quoted(&format!("blendShape.{name}"))
    );
}
