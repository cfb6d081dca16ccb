//! Phones, articulation and rigs.

use super::{See, look, see_bytes};
use lipz_bank::articulation::{Articulation, ArticulationProfile, Articulator, Phone, PhoneSpan, Rig};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{FaceProfile, Who};
use lipz_bank::{Bank, Clip, Micros, Samples, Seconds};

/// The number of weights that fit into the output.
const WEIGHTS: usize = 4;

pub(super) fn profiles_asked<'a>(
    profiles: impl Iterator<Item = ArticulationProfile<'a>>,
    see: See,
) -> ArticulationProfile<'a> {
    let mut asked = ArticulationProfile::DEFAULT;
    for profile in profiles {
        see_bytes(see, profile.name().as_bytes());
        see(u64::from(profile.gain_percent()) ^ u64::from(profile.jaw_percent()) ^ u64::from(profile == asked));
        see(profile.lead_ms() as u64 ^ profile.level_db() as u64);
        asked = profile;
    }
    asked
}

/// Makes the queries of a bank about articulation.
pub(super) fn bank_articulation_asked(bank: &Bank<'_>, name: &str, number: u32, see: See) {
    let named = bank.articulations().chain(bank.articulation(name));
    let profile = profiles_asked(named.chain([bank.default_articulation()]), see);
    for clip in bank.clip_at(number).iter().chain(bank.clip_by_key(name).iter()) {
        clip_articulation_asked(clip, &profile, number, see);
        for rig in bank.rigs().chain(bank.rig(name)) {
            rig_asked(&rig, clip, &profile, number, see);
        }
    }
}

pub(super) fn clip_articulation_asked(clip: &Clip<'_>, profile: &ArticulationProfile<'_>, number: u32, see: See) {
    let phones = clip.phones();
    see(u64::from(phones.count()) | u64::from(phones.are_certain()) << 32 | u64::from(phones.is_empty()) << 33);
    see(phones.level_db().unwrap_or(0) as u64 ^ u64::from(phones == clip.phones()));
    phones.iter().chain(phones.get(number)).for_each(|span| phone_asked(&span, see));
    let us = i64::from(number);
    mouth_asked(&clip.articulation_at(Micros(us), profile), see);
    mouth_asked(&clip.articulation_at(Seconds(number as f32), profile), see);
    mouth_asked(&clip.articulation_at(Samples { position: us, rate_hz: number }, profile), see);
}

fn phone_asked(span: &PhoneSpan, see: See) {
    see(u64::from(span.number) ^ u64::from(span.start_ms) ^ u64::from(span.end_ms));
    for phone in span.phone().into_iter().chain(Phone::from_number(span.number)) {
        see(u64::from(phone.number()) ^ u64::from(phone == Phone::SILENCE) ^ Phone::all().count() as u64);
        for name in [phone.name(), phone.ipa(), phone.arpabet().unwrap_or("")] {
            see_bytes(see, name.as_bytes());
            see(u64::from(name.parse() == Ok(phone)));
        }
    }
}

fn mouth_asked(mouth: &Articulation, see: See) {
    mouth.values().iter().for_each(|value| see(u64::from(*value)));
    for articulator in Articulator::ALL {
        see_bytes(see, articulator.name().as_bytes());
        see(u64::from(mouth.thousandths(articulator)) ^ u64::from(mouth.value(articulator).to_f32().to_bits()));
    }
}

pub(super) fn rig_asked(rig: &Rig<'_>, clip: &Clip<'_>, profile: &ArticulationProfile<'_>, number: u32, see: See) {
    see_bytes(see, rig.name().as_bytes());
    see(rig.weight_count() as u64 ^ u64::from(rig == rig));
    rig.weight_names().chain([rig.weight_name(number as usize)]).for_each(|name| see_bytes(see, name.as_bytes()));
    let time = Micros(i64::from(number));
    let face = clip.face_at(time, Who::Speaker, &FaceProfile::DEFAULT, look(number));
    let mut weights = [CurveValue::default(); WEIGHTS];
    let emotions = clip.emotions_at(time, Who::Speaker);
    rig.weights(&clip.articulation_at(time, profile), &emotions, &face, &mut weights);
    weights.iter().for_each(|weight| see(weight.thousandths() as u64));
}
