//! The cases for curves and emotions: `curves`, `curve NAME frame N`, `curve NAME TIME`, `emotions TIME`, `emotions of
//! CHARACTER TIME`, `emotions speaker CHARACTER TIME`. All values are in thousandths.

use super::{Stage, Time, number};
use lipz_bank::Clip;
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotions, Who};
use std::fmt::Write;

impl Stage {
    pub(super) fn curve_command(&mut self, words: &[&str]) {
        let clip = self.chosen();
        match words {
            ["curves"] => {
                for curve in clip.curves() {
                    let _ = write!(self.answers, "  {}:", curve.name());
                    for key in curve.keys() {
                        let _ = write!(self.answers, " {}:{}", key.frame, key.value.thousandths());
                    }
                    self.answers.push('\n');
                }
            }
            ["curve", name, rest @ ..] => {
                match clip.curve(*name).map(|curve| value(&curve, rest, &mut self.curve_cursor)) {
                    None => self.answers.push_str("  no curve\n"),
                    Some(None) => self.answers.push_str("  no frame rate\n"),
                    Some(Some(value)) => {
                        let _ = writeln!(self.answers, "  {}", value.thousandths());
                    }
                }
            }
            ["emotions", rest @ ..] => {
                let (who, time) = super::faces::who(rest);
                let found = at!(Time::read(time).0, |time| match who {
                    None => clip.emotions_at(time, Who::Speaker),
                    Some(who) => clip.emotions_at(time, who),
                });
                self.answers.push_str(&told(&found));
            }
            _ => panic!("{words:?}"),
        }
    }

    /// Returns the clip with the settings of the case.
    pub(super) fn chosen(&self) -> Clip<'static> {
        let mut clip = self.clip.and_then(|id| self.dialogue.clip(id)).expect("a clip");
        if let Some(fps) = self.given.0 {
            clip = clip.or_fps(fps);
        }
        clip
    }
}

/// Returns the value at a frame or a time. A cursor, which all cases share, must return the same value as a search.
fn value(curve: &lipz_bank::curve::Curve<'_>, words: &[&str], cursor: &mut CurveCursor) -> Option<CurveValue> {
    let (found, with_cursor) = match words {
        ["frame", frame] => (Some(curve.value(number(frame))), Some(cursor.value(curve, number(frame)))),
        _ => at!(Time::read(words).0, |time| (curve.value_at(time), cursor.value_at(curve, time))),
    };
    assert_eq!(found, with_cursor, "{words:?}");
    found
}

fn told(emotions: &Emotions) -> String {
    let mut answer = String::from(" ");
    for (emotion, value) in emotions.iter().filter(|(_, value)| value.thousandths() != 0) {
        let _ = write!(answer, " {} {},", emotion.name(), value.thousandths());
    }
    let strongest = emotions.strongest().map_or("neutral", |(emotion, _)| emotion.name());
    let _ = writeln!(answer, " strongest {strongest}, sum {}", emotions.sum().thousandths());
    answer
}
