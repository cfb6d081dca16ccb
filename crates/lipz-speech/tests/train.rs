//! Training of a model on recordings.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_speech::{
    AlignOptions, Aligner, Language, Model, Observations, Pronouncer, Script, Sound, TrainedModel, Training,
};

const BOBBY: &[u8] = include_bytes!("../../../fixtures/speech/bobby.wav");

/// Returns the recording as if spoken by a smaller person a fifth faster, unlike any voice of the model.
fn small_voice() -> Sound {
    let data = BOBBY.windows(4).position(|window| window == b"data").unwrap() + 8;
    let samples: Vec<f32> =
        BOBBY[data..].chunks_exact(2).map(|two| f32::from(i16::from_le_bytes([two[0], two[1]])) / 32_768.0).collect();
    Sound::from_samples(&samples, 58_000).unwrap()
}

fn script(text: &str) -> Script {
    Pronouncer::new(Language::ENGLISH).script(text)
}

/// Returns the fit of the phones of the recording, in nats per frame.
fn fit(model: &Model) -> f64 {
    let alignment =
        Aligner::new(model, AlignOptions::default()).align(&small_voice(), &script("Bobby ripped the ledger."));
    let of_phone = |us: u64, fit: f32| us as f64 * f64::from(fit);
    let phones = alignment.phones.iter().filter(|phone| phone.word.is_some());
    let (sum, all) = phones.fold((0.0, 0.0), |(sum, all), phone| {
        let us = phone.end_us - phone.start_us;
        (sum + of_phone(us, phone.fit), all + us as f64)
    });
    sum / all
}

/// Trains a model in so many rounds, on the recording and on one that does not match its text.
fn learnt(rounds: usize) -> (Training, Observations) {
    let mut training = Training::new(Model::english());
    let mut last = Observations::default();
    for _ in 0..rounds {
        last = Observations::default();
        let mut others = Observations::default();
        for _ in 0..3 {
            training.observe(&small_voice(), &script("Bobby ripped the ledger."), &mut last);
        }
        let wrong = "Seven foxes jumped over my old wooden fence, and then they went home.";
        training.observe(&small_voice(), &script(wrong), &mut others);
        last.extend(&others);
        training.learn(&last);
    }
    (training, last)
}

#[test]
fn a_voice_fits_better_the_better_it_is_known() {
    let (once, observed) = learnt(1);
    assert_eq!((observed.used(), observed.left_out()), (3, 1));
    assert!((1_500_000..3_500_000).contains(&observed.speech_us()), "{}", observed.speech_us());
    let fits = [fit(Model::english()), fit(once.model()), fit(learnt(3).0.model())];
    assert!(fits[0] + 0.2 < fits[1] && fits[1] < fits[2], "{fits:?}");
}

#[test]
fn the_same_recordings_give_the_same_bytes_and_a_file_aligns_as_its_model() {
    let bytes =
        |training: &Training| TrainedModel::new(training.model().clone(), Language::ENGLISH, 1, 2, 3).to_bytes();
    let (one, other) = (bytes(&learnt(2).0), bytes(&learnt(2).0));
    assert!(one == other);
    let model = TrainedModel::from_bytes(&one).unwrap().model;
    assert!((fit(&model) - fit(learnt(2).0.model())).abs() < 0.02);
}
