//! Articulation: how far jaw, lips and tongue are from rest, for faces whose shapes blend.
//!
//! A clip with phones answers from their times, any other clip from its visemes. The rules and their sources are in
//! `docs/guides/articulation.md`.

mod blend;
mod check;

mod phones;
mod profile;
mod query_time;
mod rig;
mod shapes;

pub(crate) use check::check;
pub use phones::{PhoneSpan, Phones};
pub use profile::ArticulationProfile;
pub use rig::Rig;

use crate::{Clip, Time};
use blend::Blend;
use lipz_types::CurveValue;
pub use lipz_types::Phone;
use query_time::QueryTime;

/// A movement of the mouth. Its value is between 0 and 1000, its number the index in [`Articulator::ALL`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
#[non_exhaustive]
pub enum Articulator {
    /// How far the jaw is lowered.
    Jaw,
    /// How far the lips are apart, whatever the jaw does.
    Opening,
    /// How firmly the lips are closed, as in *p*, *b* and *m*.
    Closure,
    /// How far the lower lip is under the upper teeth, as in *f* and *v*.
    Teeth,
    /// How far the lips are rounded and pushed forward, as in *too*.
    Rounding,
    /// How far the corners of the lips are pulled apart, as in *see*.
    Spreading,
    /// How far the tip of the tongue is raised, as in *t* and *l*.
    TongueTip,
    /// How far the tongue is between the teeth, as in *thin*.
    TongueOut,
    /// How far the back of the tongue is raised, as in *key*.
    TongueBack,
}

impl Articulator {
    /// All of them, in the order of their numbers.
    pub const ALL: [Articulator; 9] = [
        Articulator::Jaw,
        Articulator::Opening,
        Articulator::Closure,
        Articulator::Teeth,
        Articulator::Rounding,
        Articulator::Spreading,
        Articulator::TongueTip,
        Articulator::TongueOut,
        Articulator::TongueBack,
    ];

    /// Returns the name: in settings, and of a curve that replaces the computed values.
    pub const fn name(self) -> &'static str {
        match self {
            Articulator::Jaw => "jaw",
            Articulator::Opening => "opening",
            Articulator::Closure => "closure",
            Articulator::Teeth => "teeth",
            Articulator::Rounding => "rounding",
            Articulator::Spreading => "spreading",
            Articulator::TongueTip => "tongue_tip",
            Articulator::TongueOut => "tongue_out",
            Articulator::TongueBack => "tongue_back",
        }
    }
}

/// The values of all articulators at one time, each from 0 to 1000.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Articulation(pub(crate) [u16; Articulator::ALL.len()]);

impl Articulation {
    /// Returns these values, each at most 1000, in the order of [`Articulator::ALL`].
    pub fn from_thousandths(values: [u16; Articulator::ALL.len()]) -> Articulation {
        Articulation(values.map(|value| value.min(1000)))
    }

    /// Returns the value of an articulator, from 0 to 1000.
    pub fn thousandths(&self, articulator: Articulator) -> u16 {
        self.0.get(articulator as usize).copied().unwrap_or(0)
    }

    /// Returns the value of an articulator, from 0 to 1.
    pub fn value(&self, articulator: Articulator) -> CurveValue {
        CurveValue::from_thousandths(self.thousandths(articulator).into())
    }

    /// Returns all values, in the order of [`Articulator::ALL`].
    pub const fn values(&self) -> &[u16; Articulator::ALL.len()] {
        &self.0
    }
}

impl Clip<'_> {
    /// Returns the articulation at `time`, computed from the clip's phones, or from its visemes if it has no phones.
    ///
    /// The result depends on nothing but clip, time and profile, so a program can ask for any time in any order. Curves
    /// of the clip that are named like an articulator replace its values. Before the start and after the end, the mouth
    /// is at rest.
    ///
    /// ```
    /// use lipz_bank::articulation::{ArticulationProfile, Articulator};
    /// use lipz_bank::{Bank, Micros};
    /// # let bytes: &[u8] = include_bytes!("../../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let clip = bank.clip_by_key("act1/mara-good-evening").ok_or("no clip")?;
    /// let profile = bank.default_articulation();
    /// let mouth = clip.articulation_at(Micros(250_000), &profile);
    /// println!("jaw {}", mouth.thousandths(Articulator::Jaw));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn articulation_at<T: Time>(&self, time: T, profile: &ArticulationProfile<'_>) -> Articulation {
        let mut articulation = self.computed_articulation(time, profile);
        for curve in self.curves() {
            let name = curve.name();
            let replaced = Articulator::ALL.iter().position(|articulator| name == *articulator.name());
            if let (Some(index), Some(position)) = (replaced, self.position(time)) {
                if let Some(value) = articulation.0.get_mut(index) {
                    *value = curve.value_in(position).thousandths().clamp(0, 1000) as u16;
                }
            }
        }
        articulation
    }

    /// Returns the articulation without the curves of the clip.
    fn computed_articulation<T: Time>(&self, time: T, profile: &ArticulationProfile<'_>) -> Articulation {
        let phones = self.phones();
        let mut blend = Blend::new(phones.are_certain());
        if phones.is_empty() {
            shapes::add_near(self, time, &mut blend);
        } else {
            phones.add_near(QueryTime::of(time, profile.lead_ms()), profile, &mut blend);
        }
        blend.finish(profile, phones.level_db())
    }
}
