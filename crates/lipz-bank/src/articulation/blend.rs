//! Coarticulation: sounds that overlap are blended, and then closed lips are closed.
//!
//! Each sound is a trapezoid: it rises before its start, holds until shortly before its end, and falls. The mouth is
//! the average of all sounds, weighted by their trapezoids and strengths, and of rest where they are weak. Rise and
//! fall of 120 ms, 150 ms for rounding, are those of JALI (Edwards et al., SIGGRAPH 2016). The jaw takes 140 ms and
//! sibilants 100 ms, so that the jaw is as fast as measured (`docs/guides/articulation.md`).

use super::Articulation;
use super::profile::ArticulationProfile;
use lipz_layout::PhoneTargetRecord;

/// The rise and the fall of each group in microseconds: jaw, lips, rounding, tongue.
const RISE_US: [u32; 4] = [140_000, 120_000, 150_000, 60_000];
/// The longest rise: a sound that is farther away has no weight, and no constraint holds for it.
const LONGEST_RISE_US: i32 = 150_000;
/// The group of each target.
const GROUPS: [u8; 7] = [0, 1, 2, 1, 3, 3, 3];
/// The strength of all sounds on the tongue, in tenths.
const TONGUE_STRENGTH: u8 = 10;
/// A sound holds its targets until this time before its end, or until three quarters of it if that is later.
const LONGEST_RELEASE_US: i32 = 40_000;

/// A constraint: it holds while its sound lasts, at least for `shortest_us`. It rises before that, and falls after it,
/// within `ramp_us`.
struct ConstraintWindow {
    shortest_us: i32,
    ramp_us: u32,
}

/// The number of constraints.
const CONSTRAINTS: usize = 3;
/// The constraints in the order of their bits in `class`: the closed lips of p, b and m, the lip on the teeth of f and
/// v, the narrow jaw of sibilants.
const WINDOWS: [ConstraintWindow; CONSTRAINTS] = [
    ConstraintWindow { shortest_us: 60_000, ramp_us: 45_000 },
    ConstraintWindow { shortest_us: 50_000, ramp_us: 50_000 },
    ConstraintWindow { shortest_us: 40_000, ramp_us: 100_000 },
];
/// The index of the group whose weight takes the place of a window if a phone is not certain.
const LIPS_US: u32 = 120_000;

/// The widest jaw in a sibilant, in thousandths.
const JAW_CAP: u32 = 80;
/// The widest opening with a lip on the teeth, in thousandths.
const TEETH_CAP: u32 = 150;
/// The number of thousandths in a whole.
pub(super) const WHOLE: u32 = 1000;
/// The weight from which sounds leave no room for rest: a whole one with strength 1, in tenths.
const FULL_WEIGHT: u32 = WHOLE * 10;

/// Sounds, blended so far.
pub(super) struct Blend {
    /// Whether constraints are enforced, whatever the neighbours are. Otherwise, closed lips are blended like other
    /// sounds, because a wrongly recognised *p* would close the mouth visibly.
    are_certain: bool,
    /// Sums of percent × weight, for each target.
    sums: [u32; 7],
    /// Sums of weights, for each group.
    weights: [u32; 4],
    /// How far each constraint holds, in thousandths.
    held: [u32; CONSTRAINTS],
}

impl Blend {
    pub(super) const fn new(are_certain: bool) -> Blend {
        Blend { are_certain, sums: [0; 7], weights: [0; 4], held: [0; CONSTRAINTS] }
    }

    /// Adds a sound, which starts and ends this many microseconds after the time of the query. A query adds at most 48
    /// phones with a strength of at most 25.5, or 802 shapes with one of at most 1.5, so no sum overflows.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(super) fn add(&mut self, start_us: i32, end_us: i32, targets: &PhoneTargetRecord) {
        if start_us > LONGEST_RISE_US || end_us < -LONGEST_RISE_US {
            return;
        }
        let length_us = end_us.wrapping_sub(start_us);
        let hold_end_us = end_us.wrapping_sub((length_us / 4).min(LONGEST_RELEASE_US));
        let [jaw, lips, rounding] = targets.strength_tenths;
        let strengths = [jaw, lips, rounding, TONGUE_STRENGTH];
        let mut added = [0; 4];
        for (((added, rise_us), strength), sum) in added.iter_mut().zip(&RISE_US).zip(&strengths).zip(&mut self.weights)
        {
            *added = share(start_us, hold_end_us, *rise_us).wrapping_mul(u32::from(*strength));
            *sum = sum.wrapping_add(*added);
        }
        for ((sum, percent), group) in self.sums.iter_mut().zip(&targets.percent).zip(&GROUPS) {
            let weight = added.get(usize::from(*group)).copied().unwrap_or(0);
            *sum = sum.wrapping_add(weight.wrapping_mul(u32::from(*percent)));
        }
        for (bit, (held, window)) in self.held.iter_mut().zip(&WINDOWS).enumerate() {
            if targets.class >> bit & 1 == 0 {
                continue;
            }
            let end_us = end_us.max(start_us.wrapping_add(window.shortest_us));
            let lasting = match self.are_certain {
                true => share(start_us, end_us, window.ramp_us),
                false => share(start_us, hold_end_us, LIPS_US) / 2,
            };
            *held = (*held).max(lasting);
        }
    }

    /// Returns the articulation: the average, scaled by the gain, with constraints last.
    pub(super) fn finish(&mut self, profile: &ArticulationProfile<'_>, level_db: Option<i8>) -> Articulation {
        for ((sum, rest), group) in self.sums.iter_mut().zip(&profile.rest().percent).zip(&GROUPS) {
            let weight = self.weights.get(usize::from(*group)).copied().unwrap_or(0);
            let room = FULL_WEIGHT.saturating_sub(weight);
            let total = sum.wrapping_add(room.wrapping_mul(u32::from(*rest)));
            // Percent to thousandths.
            *sum = total.checked_div(weight.max(FULL_WEIGHT) / 10).unwrap_or(0);
        }
        let [jaw, opening, rounding, spreading, tip, out, back] = &mut self.sums;
        let [closed_lips, lip_on_teeth, narrow_jaw] = &self.held;
        let gain = profile.gain_at(level_db);
        *jaw = capped(scaled(profile.jaw(*jaw), gain), JAW_CAP, *narrow_jaw);
        *opening = capped(capped(scaled(*opening, gain), TEETH_CAP, *lip_on_teeth), 0, *closed_lips);
        let value = |value: &u32| *value as u16;
        Articulation([
            value(jaw),
            value(opening),
            value(closed_lips),
            value(lip_on_teeth),
            value(rounding),
            value(spreading),
            value(tip),
            value(out),
            value(back),
        ])
    }
}

/// Returns a value times a gain in thousandths, at most a whole.
fn scaled(value: u32, gain: u32) -> u32 {
    (value.wrapping_mul(gain) / WHOLE).min(WHOLE)
}

/// Returns a value that a constraint moves to `cap` by its share, unless the value is below `cap`.
fn capped(value: u32, cap: u32, share: u32) -> u32 {
    let moved = value.wrapping_mul(WHOLE.saturating_sub(share)).wrapping_add(cap.wrapping_mul(share)) / WHOLE;
    moved.min(value)
}

/// Returns how far a movement has come at the time of the query, in thousandths. It takes `rise_us` before `start_us`
/// and after `end_us`.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
fn share(start_us: i32, end_us: i32, rise_us: u32) -> u32 {
    let rise = rise_us as i32;
    let done = rise.wrapping_sub(start_us).min(end_us.wrapping_add(rise)).min(rise).max(0) as u32;
    done.wrapping_mul(WHOLE).checked_div(rise_us).unwrap_or(WHOLE)
}
