//! Frame rates: conversion of the decimal spelling of `fps` to an exact ratio.

/// A frame rate from decimal digits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rate {
    /// Frames in `denominator` seconds.
    pub numerator: u32,
    /// Seconds; the ratio is in lowest terms.
    pub denominator: u32,
    /// Whether the ratio is exactly the number in the digits, and not only the nearest one.
    pub is_exact: bool,
}

/// The decimal places that fit 128 bits, for numbers up to 1000.
const MAX_PLACES: usize = 34;

/// Returns the ratio of a JSON number; `None` outside 1 to 1000 (Lipz specification, `fps`).
///
/// 23.976 is 2997/125, not 24000/1001, because the digits count. If no ratio of 32-bit numbers is exact, returns the
/// nearest one, and `is_exact` is false. 23.976023976023978 is 24000/1001: it has all digits of the 64-bit
/// floating-point number, which other programs write.
///
/// ```
/// use lipz_file::rate::{Rate, parse};
/// assert_eq!(parse("29.97"), Some(Rate { numerator: 2997, denominator: 100, is_exact: true }));
/// assert_eq!(parse("2.4e1"), Some(Rate { numerator: 24, denominator: 1, is_exact: true }));
/// assert_eq!(parse("0.999"), None);
/// ```
pub fn parse(number: &str) -> Option<Rate> {
    // Nearly every rate is a whole number of two digits.
    if let &[tens @ b'1'..=b'9', ones @ b'0'..=b'9'] = number.as_bytes() {
        let numerator = u32::from(tens - b'0') * 10 + u32::from(ones - b'0');
        return Some(Rate { numerator, denominator: 1, is_exact: true });
    }
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    // An exponent beyond i64 is out of range, unless the mantissa is too long for any file.
    let exponent: i64 = exponent.strip_prefix('+').unwrap_or(exponent).parse().ok()?;
    if !whole.bytes().chain(fraction.bytes()).all(|byte| byte.is_ascii_digit()) {
        return None; // a minus sign: negative
    }
    let digits = [whole, fraction].concat();
    let point = i64::try_from(whole.len()).ok()?.checked_add(exponent)?;
    let leading_zeros = digits.len() - digits.trim_start_matches('0').len();
    let point = point.checked_sub(i64::try_from(leading_zeros).ok()?)?;
    let digits = digits.trim_matches('0');
    // The value is 0.digits · 10^point, and the first digit is not 0: 1 … 9999.9… for values in range.
    let point = usize::try_from(point).ok().filter(|point| (1..=4).contains(point) && !digits.is_empty())?;
    let places = digits.len().saturating_sub(point).min(MAX_PLACES);
    let mut value: u128 = 0;
    for index in 0..point + places {
        let digit = digits.as_bytes().get(index).map_or(0, |byte| u128::from(byte - b'0'));
        value = value * 10 + digit;
    }
    let cut_off = digits.len() > point + places;
    let scale = 10_u128.pow(u32::try_from(places).ok()?);
    if value < scale || value > 1000 * scale || (value == 1000 * scale && cut_off) {
        return None;
    }
    let (numerator, denominator, fits) = nearest_ratio(value, scale);
    let is_exact = (fits && !cut_off) || is_ntsc_double(number, numerator, denominator);
    Some(Rate { numerator, denominator, is_exact })
}

/// Whether the digits are a video rate, such as `24000/1001`, in the form in which programs print the nearest 64-bit
/// floating-point number. It cannot be more exact.
fn is_ntsc_double(number: &str, numerator: u32, denominator: u32) -> bool {
    let is_ntsc = 1001 % denominator == 0 && u64::from(numerator) * u64::from(1001 / denominator) % 1000 == 0;
    is_ntsc && number.parse() == Ok(f64::from(numerator) / f64::from(denominator))
}

/// Returns `value / scale` in lowest terms if both fit 32 bits, otherwise the last convergent of its continued fraction
/// that does.
fn nearest_ratio(value: u128, scale: u128) -> (u32, u32, bool) {
    let (mut dividend, mut divisor) = (value, scale);
    let (mut before, mut last) = ((0_u128, 1_u128), (1_u128, 0_u128));
    while divisor != 0 {
        let quotient = dividend / divisor;
        let next = quotient
            .checked_mul(last.0)
            .and_then(|product| product.checked_add(before.0))
            .zip(quotient.checked_mul(last.1).and_then(|product| product.checked_add(before.1)));
        match next {
            Some(next) if next.0 <= u128::from(u32::MAX) && next.1 <= u128::from(u32::MAX) => {
                (before, last) = (last, next);
            }
            _ => break,
        }
        (dividend, divisor) = (divisor, dividend % divisor);
    }
    let fit = |part: u128| u32::try_from(part).unwrap_or(u32::MAX);
    (fit(last.0), fit(last.1), divisor == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(number: &str) -> Option<(u32, u32)> {
        parse(number).filter(|rate| rate.is_exact).map(|rate| (rate.numerator, rate.denominator))
    }

    #[test]
    fn spellings_of_the_same_number() {
        for spelling in ["24", "24.0", "24.000", "2.4e1", "2.4E+1", "240e-1", "0.24e2", "0.024e3", "24000e-3"] {
            assert_eq!(exact(spelling), Some((24, 1)), "{spelling}");
        }
        assert_eq!(exact("23.976"), Some((2997, 125)));
        assert_eq!(exact("12.5"), Some((25, 2)));
        assert_eq!(exact("1"), Some((1, 1)));
        assert_eq!(exact("1000"), Some((1000, 1)));
        assert_eq!(exact("1000.000000000000000000000000000000000000000000000"), Some((1000, 1)));
        assert_eq!(exact("999.999999"), Some((999_999_999, 1_000_000)));
    }

    #[test]
    fn rates_of_video_as_floating_point_numbers_are_exact() {
        for thousands in 2..=1000_u32 {
            let written = (f64::from(thousands * 1000) / 1001.0).to_string();
            let rate = parse(&written).unwrap();
            assert!(rate.is_exact, "{written}");
            let reduced = f64::from(rate.numerator) / f64::from(rate.denominator);
            assert_eq!(reduced.to_string(), written);
        }
    }

    #[test]
    fn outside_the_range() {
        let long = format!("1000.{}1", "0".repeat(60));
        for number in
            ["0", "-0", "-24", "0.9999999", "1000.0000001", "1e4", "1e-1", "1e999999999999999999999", "0e5", &long]
        {
            assert_eq!(parse(number), None, "{number}");
        }
    }

    #[test]
    fn too_many_digits_give_the_nearest_ratio() {
        let ntsc = parse("23.976023976023976023976").unwrap();
        assert_eq!((ntsc.numerator, ntsc.denominator, ntsc.is_exact), (24_000, 1001, true));
        let near = parse("23.9760239760239").unwrap();
        assert!(!near.is_exact, "{near:?}");
        let sixty = parse(&format!("59.{}", "94005994".repeat(20))).unwrap();
        assert!(!sixty.is_exact);
        assert!((f64::from(sixty.numerator) / f64::from(sixty.denominator) - 59.940_059_94).abs() < 1e-8);
    }
}
