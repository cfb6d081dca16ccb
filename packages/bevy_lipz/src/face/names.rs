//! The names of morph targets, compared as in the other packages of lipz (`packages/lipz-web/shape-names.js`).

use std::collections::HashMap;

/// Further names of weights: those of VRM 0, VRoid and Oculus Lipsync.
const ALIASES: [(&str, &str, &[&str]); 13] = [
    ("ovr", "ih", &["I"]),
    ("ovr", "oh", &["O"]),
    ("ovr", "ou", &["U"]),
    ("vrm", "aa", &["A"]),
    ("vrm", "ih", &["I"]),
    ("vrm", "ou", &["U"]),
    ("vrm", "ee", &["E"]),
    ("vrm", "oh", &["O"]),
    ("vrm", "happy", &["Fcl_ALL_Joy", "Joy"]),
    ("vrm", "angry", &["Fcl_ALL_Angry"]),
    ("vrm", "sad", &["Fcl_ALL_Sorrow", "Sorrow"]),
    ("vrm", "surprised", &["Fcl_ALL_Surprised"]),
    ("vrm", "blink", &["Fcl_EYE_Close"]),
];

/// The kind of a shape before its name: `viseme_aa`, `v_aa`, `Fcl_MTH_A`, `Mouth_A`.
const PREFIXES: [&str; 8] = ["arkit", "fcl_mth", "lipsync", "mouth", "mth", "phoneme", "viseme", "v"];

/// The number of forms of a name, in the order of their similarity to it.
const DEGREES: usize = 5;
/// The bare name among the forms: without path and prefix.
const BARE: usize = 2;

/// The names of a model, by their forms in each degree of similarity.
pub(super) struct ModelNames {
    degrees: [HashMap<String, usize>; DEGREES],
}

impl ModelNames {
    /// Collects the names. The first of equal names counts.
    pub(super) fn new(names: &[String]) -> ModelNames {
        let mut degrees: [HashMap<String, usize>; DEGREES] = Default::default();
        for (index, name) in names.iter().enumerate() {
            for (degree, form) in degrees.iter_mut().zip(forms(name)) {
                if !form.is_empty() {
                    degree.entry(form).or_insert(index);
                }
            }
        }
        ModelNames { degrees }
    }

    /// Returns the index of the most similar name for a weight of a rig.
    pub(super) fn find(&self, rig: &str, weight: &str) -> Option<usize> {
        let aliases = ALIASES.iter().filter(|(kind, name, _)| *kind == rig && *name == weight);
        let aliases = aliases.flat_map(|(_, _, names)| names.iter());
        let mut known: Vec<String> = std::iter::once(&weight).chain(aliases).map(|name| letters(name)).collect();
        // A rig may have a prefix that the model lacks, so the bare weight comes last.
        known.extend(forms(weight).into_iter().nth(BARE));
        self.degrees.iter().find_map(|degree| known.iter().find_map(|form| degree.get(form).copied()))
    }
}

/// Returns the forms in which a name is compared.
fn forms(name: &str) -> [String; DEGREES] {
    let sided = with_side(name);
    let (plain, whole) = (without_path(name), without_path(&sided));
    [name, plain, without_prefix(plain), whole, without_prefix(whole)].map(letters)
}

/// Returns the letters and digits of a name in lower case, which alone are compared.
fn letters(name: &str) -> String {
    // A hyphen is the code of rest.
    if name == "-" {
        return name.to_owned();
    }
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Returns the name without those of meshes and deformers: `blendShape1.jawOpen`, `M_F00_000_00_Fcl_MTH_A`.
fn without_path(name: &str) -> &str {
    let is_separator = |(at, c): &(usize, char)| ".:|/".contains(*c) && at + 1 < name.len();
    let behind = name.char_indices().rfind(is_separator).map_or(0, |(at, _)| at + 1);
    let start = behind.max(name.rfind("Fcl_").unwrap_or(0));
    name.get(start..).unwrap_or(name)
}

/// Returns the name without the kind of its shape.
fn without_prefix(name: &str) -> &str {
    let behind = |prefix: &&str| {
        let start = name.get(..prefix.len())?;
        let rest = name.get(prefix.len()..)?;
        start.eq_ignore_ascii_case(prefix).then(|| rest.strip_prefix(['_', ' ', '-']))?
    };
    PREFIXES.iter().find_map(behind).unwrap_or(name)
}

/// Returns the name with the short form of a side at its end in full: `mouthSmile_L`, `eyeBlink.R`, `jawL`.
fn with_side(name: &str) -> String {
    let mut chars = name.chars();
    let side = match chars.next_back() {
        Some('l' | 'L') => "Left",
        Some('r' | 'R') => "Right",
        _ => return name.to_owned(),
    };
    let rest = chars.as_str();
    match (rest.strip_suffix(['_', '.', ' ', '-']), rest.chars().next_back()) {
        (Some(before), _) => format!("{before}{side}"),
        (None, Some('a'..='z')) if name.ends_with(['L', 'R']) => format!("{rest}{side}"),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_models_are_recognised() {
        for (rig, weight, name) in [
            ("arkit", "jawOpen", "blendShape1.jawOpen"),
            ("arkit", "jawOpen", "JawOpen"),
            ("arkit", "jawOpen", "jaw_open"),
            ("arkit", "mouthSmileLeft", "mouthSmile_L"),
            ("arkit", "eyeBlinkRight", "eyeBlink.R"),
            ("arkit", "mouthSmileLeft", "mouthSmileL"),
            ("ovr", "viseme_aa", "aa"),
            ("ovr", "ih", "viseme_I"),
            ("vrm", "aa", "M_F00_000_00_Fcl_MTH_A"),
            ("vrm", "happy", "Joy"),
            ("mmd", "あ", "あ"),
            ("blair", "A", "Mouth_A"),
            ("blair", "-", "-"),
        ] {
            let names = ModelNames::new(&["other".to_owned(), name.to_owned()]);
            assert_eq!(names.find(rig, weight), Some(1), "{name} for {weight} of {rig}");
        }
    }

    #[test]
    fn different_names_are_not() {
        for (weight, name) in [("jawOpen", "jawOpenLeft"), ("aa", "aah"), ("A", "Mouth_E"), ("jawLeft", "jawl")] {
            assert_eq!(ModelNames::new(&[name.to_owned()]).find("arkit", weight), None, "{name} for {weight}");
        }
    }
}
