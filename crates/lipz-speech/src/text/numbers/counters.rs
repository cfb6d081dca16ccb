//! Korean numbers before counters: `3시` is *se si*, not *sam si*.

/// Native numbers in the form used before a counter: tens, then ones.
const TENS: [&str; 10] = ["", "열", "스물", "서른", "마흔", "쉰", "예순", "일흔", "여든", "아흔"];
const ONES: [&str; 10] = ["", "한", "두", "세", "네", "다섯", "여섯", "일곱", "여덟", "아홉"];

/// The counters of native numbers: hours, things, people, years of age, animals, times, bottles, cups, books, machines,
/// months, sheets, sets, pairs, flowers, trees, houses, ships, kinds, places, laps, boards.
const COUNTERS: [&str; 24] = [
    "시", "개", "명", "사람", "살", "마리", "번", "병", "잔", "권", "대", "달", "장", "벌", "켤레", "송이", "그루",
    "채", "척", "가지", "군데", "바퀴", "판", "곳",
];
/// Words that begin like a counter, but do not use native numbers: months, years, countries.
const OTHERS: [&str; 3] = ["개월", "개년", "개국"];
/// Hours of a clock use native numbers. Later hours are those of timetables.
const HOURS_OF_A_CLOCK: u64 = 12;
/// From here on, `20대` are people of that age and `31번` is a number, so the native number is not the first choice.
const LARGE: u64 = 20;

/// Returns the native number, if one may be used before this text, and whether it is more likely than the other.
pub(super) fn native(number: u64, text: &str) -> Option<(String, bool)> {
    let counted = text.strip_prefix([' ', '\u{a0}']).unwrap_or(text);
    let is_counted = COUNTERS.iter().any(|counter| counted.starts_with(counter));
    let is_other = OTHERS.iter().any(|other| counted.starts_with(other));
    if !is_counted || is_other || number == 0 {
        return None;
    }
    let is_hour = counted.starts_with('시') && !counted.starts_with("시간");
    let is_likely = match () {
        () if is_hour => number <= HOURS_OF_A_CLOCK,
        () if counted.starts_with(['번', '대']) => number < LARGE,
        () => true,
    };
    words(number).map(|words| (words, is_likely))
}

/// Returns a number below 100 in words.
pub(super) fn words(number: u64) -> Option<String> {
    let number = usize::try_from(number).ok()?;
    let (tens, ones) = (TENS.get(number / 10)?, ONES.get(number % 10)?);
    Some(if number == 20 { "스무".to_owned() } else { format!("{tens}{ones}") })
}
