//! The cases for faces: `face PROFILE LOOK TIME`, with `of CHARACTER` or `speaker CHARACTER` before the profile; `idle
//! PROFILE LOOK SEED TIME`. A look is `ahead`, `person PITCH YAW` or `point PITCH YAW`. All values are in thousandths.

use super::{Stage, Time, number};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Face, FaceProfile, LookAt, Who};

impl Stage {
    /// Writes the face of the clip at a time.
    pub(super) fn face(&mut self, words: &[&str]) {
        let clip = self.chosen();
        let (who, words) = who(&words[1..]);
        let (look, time) = look(&words[1..]);
        let Some(profile) = self.profile(words[0]) else { return };
        let face = at!(Time::read(time).0, |time| match who {
            None => clip.face_at(time, Who::Speaker, &profile, look),
            Some(who) => clip.face_at(time, who, &profile, look),
        });
        self.answers.push_str(&told(&face));
    }

    /// Writes the face of a silent character.
    pub(super) fn idle(&mut self, words: &[&str]) {
        let (look, rest) = look(&words[2..]);
        let Some(profile) = self.profile(words[1]) else { return };
        let face = at!(Time::read(&rest[1..]).0, |time| profile.idle_at(time, number(rest[0]), look));
        self.answers.push_str(&told(&face));
    }

    fn profile(&mut self, name: &str) -> Option<FaceProfile<'static>> {
        let dialogue = self.dialogue;
        let found = if name == "default" { Some(dialogue.default_face_profile()) } else { dialogue.face_profile(name) };
        if found.is_none() {
            self.answers.push_str("  no profile\n");
        }
        found
    }
}

/// Returns the character, and the words after it.
pub(super) fn who<'w>(words: &'w [&'w str]) -> (Option<Who<'w>>, &'w [&'w str]) {
    match words {
        ["of", character, rest @ ..] => (Some(Who::Other(character)), rest),
        ["speaker", character, rest @ ..] => (Some(Who::SpeakerNamed(character)), rest),
        _ => (None, words),
    }
}

/// Returns the target of the eyes, and the words after it.
fn look<'w>(words: &'w [&'w str]) -> (LookAt, &'w [&'w str]) {
    let angle = |word: &str| CurveValue::from_thousandths(number(word));
    match words {
        ["ahead", rest @ ..] => (LookAt::AHEAD, rest),
        ["person", pitch, yaw, rest @ ..] => (LookAt::person(angle(pitch), angle(yaw)), rest),
        ["point", pitch, yaw, rest @ ..] => (LookAt::point(angle(pitch), angle(yaw)), rest),
        _ => panic!("no look: {words:?}"),
    }
}

fn told(face: &Face) -> String {
    let [blink, pitch, yaw, roll] = [face.blink, face.head_pitch, face.head_yaw, face.head_roll].map(of);
    let [eye_pitch, eye_yaw, brows, shrug, breath] =
        [face.eye_pitch, face.eye_yaw, face.brows, face.shrug, face.breath].map(of);
    let head = format!("  blink {blink}, head {pitch} {yaw} {roll}, eyes {eye_pitch} {eye_yaw}");
    format!("{head}, brows {brows}, shrug {shrug}, breath {breath}\n")
}

fn of(value: CurveValue) -> i32 {
    value.thousandths()
}
