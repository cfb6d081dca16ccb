//! Conversions of values to and from strings and numbers, as the API guidelines recommend.
// Tests run with the workspace's compiler, not with the oldest one of this crate.
#![allow(clippy::unwrap_used, clippy::incompatible_msrv)]

use lipz_types::{ClipId, Fps, UnknownName, Viseme, VisemeType};

#[test]
fn clip_ids() {
    let id = ClipId::from_key("act1/samson-hello");
    assert_eq!(id.to_string().parse(), Ok(id));
    assert_eq!(format!("0x{id}").parse(), Ok(id));
    assert_eq!("FFFF95A90441EEDA".parse(), Ok(id));
    for wrong in ["", "ffff95a90441eed", "0ffff95a90441eeda", "+fff95a90441eeda", "act1/samson-hello"] {
        let error: UnknownName = wrong.parse::<ClipId>().unwrap_err();
        assert_eq!(error.to_string(), "unknown clip id; expected sixteen hexadecimal digits", "{wrong}");
    }
    assert_eq!((ClipId::from(id.get()), u64::from(id)), (id, 0xffff_95a9_0441_eeda));
    assert_eq!(format!("{id:x} {id:#X}"), "ffff95a90441eeda 0xFFFF95A90441EEDA");
    assert!(ClipId::from_u64(1) < ClipId::from_u64(2));
}

#[test]
fn viseme_types() {
    for viseme_type in VisemeType::ALL {
        assert_eq!(viseme_type.to_string().parse(), Ok(viseme_type));
        assert_eq!(VisemeType::try_from(viseme_type as u8), Ok(viseme_type));
    }
    assert!("Blair".parse::<VisemeType>().is_err());
    let error = VisemeType::try_from(0).unwrap_err();
    assert_eq!((error.kind, error.to_string().as_str()), ("viseme type", "unknown viseme type; expected 1, 2 or 3"));
    assert_eq!((Viseme::REST.to_string(), Viseme::from_code(b'A').to_char()), ("-".to_owned(), 'A'));
}

#[test]
fn rates_are_in_the_order_of_their_speed() {
    let rate = |numerator, denominator| Fps::new(numerator, denominator).unwrap();
    let mut rates = [rate(30, 1), rate(30_000, 1001), rate(25, 2), rate(24, 1), rate(24_000, 1001)];
    rates.sort_unstable();
    let parts = rates.map(|rate| (rate.numerator(), rate.denominator()));
    assert_eq!(parts, [(25, 2), (24_000, 1001), (24, 1), (30_000, 1001), (30, 1)]);
    assert!(rate(48, 2) == rate(24, 1) && rate(24, 1).cmp(&rate(48, 2)).is_eq());
}
