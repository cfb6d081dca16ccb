//! The cases for articulation: `articulation PROFILE TIME`; `weights RIG PROFILE TIME`, with the speaker's emotions and
//! face. Values are in thousandths.

use super::{Stage, Time};
use lipz_bank::articulation::{ArticulationProfile, Articulator};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{LookAt, Who};

/// More than any rig of the cases has.
const MOST_WEIGHTS: usize = 64;

impl Stage {
    /// Writes the articulation of the clip at a time.
    pub(super) fn articulation(&mut self, words: &[&str]) {
        let clip = self.chosen();
        let Some(profile) = self.articulation_profile(words[1]) else { return };
        let mouth = at!(Time::read(&words[2..]).0, |time| clip.articulation_at(time, &profile));
        let values = Articulator::ALL.map(|articulator| (articulator.name(), mouth.thousandths(articulator).into()));
        self.values(&values);
    }

    /// Writes the weights of a rig at a time.
    pub(super) fn weights(&mut self, words: &[&str]) {
        let (clip, dialogue) = (self.chosen(), self.dialogue);
        let Some(rig) = dialogue.rig(words[1]) else {
            return self.answers.push_str("  no rig\n");
        };
        let Some(profile) = self.articulation_profile(words[2]) else { return };
        let mut weights = [CurveValue::default(); MOST_WEIGHTS];
        at!(Time::read(&words[3..]).0, |time| {
            let emotions = clip.emotions_at(time, Who::Speaker);
            let face = clip.face_at(time, Who::Speaker, &dialogue.default_face_profile(), LookAt::AHEAD);
            rig.weights(&clip.articulation_at(time, &profile), &emotions, &face, &mut weights);
        });
        let values: Vec<_> = rig.weight_names().zip(weights.map(CurveValue::thousandths)).collect();
        self.values(&values);
    }

    fn articulation_profile(&mut self, name: &str) -> Option<ArticulationProfile<'static>> {
        let dialogue = self.dialogue;
        let found = if name == "default" { Some(dialogue.default_articulation()) } else { dialogue.articulation(name) };
        if found.is_none() {
            self.answers.push_str("  no profile\n");
        }
        found
    }

    fn values(&mut self, values: &[(&str, i32)]) {
        let values: Vec<String> = values.iter().map(|(name, value)| format!("{name} {value}")).collect();
        self.answers.push_str(&format!("  {}\n", values.join(", ")));
    }
}
