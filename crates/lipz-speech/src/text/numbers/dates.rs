//! Ordinals that are written with a point, or without a mark: `3. Mai`, `May 3`.

/// German months. They are capitalised, like the start of a sentence.
const GERMAN_MONTHS: [&str; 14] = [
    "Januar",
    "Jänner",
    "Februar",
    "März",
    "April",
    "Mai",
    "Juni",
    "Juli",
    "August",
    "September",
    "Oktober",
    "November",
    "Dezember",
    "Jahrhundert",
];
/// English months, as written before a day.
const ENGLISH_MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// Returns `None` if a number before `rest` cannot be an ordinal, otherwise whether it is more likely one than a
/// cardinal.
pub(super) fn ordinal(code: &str, rest: &str, number: Option<u64>) -> Option<bool> {
    let begins = |text: &str, names: &[&str]| {
        let word = text.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        names.contains(&word)
    };
    let is_day = number.is_some_and(|number| (1..=31).contains(&number));
    if code == "en" {
        return (is_day && begins(rest.trim_start(), &ENGLISH_MONTHS)).then_some(true);
    }
    // An ordinal, unless a sentence ends here.
    let next = rest.strip_prefix('.').filter(|_| orders_by_point(code))?.trim_start();
    let is_month = code == "de" && is_day && begins(next, &GERMAN_MONTHS);
    Some(next.chars().next()?.is_lowercase() || is_month)
}

/// Whether a number is a day after the name of its month, with which `before` ends: `May 3`.
pub(super) fn is_behind_month(code: &str, before: &str, number: u64) -> bool {
    let month = before.trim_end().rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
    code == "en" && (1..=31).contains(&number) && ENGLISH_MONTHS.contains(&month)
}

/// Returns the forms of an ordinal, including those that its rules lack: *am dritten Mai*.
pub(super) fn forms(code: &str, ordinal: String) -> Vec<String> {
    let inflected = (code == "de").then(|| format!("{ordinal}n"));
    std::iter::once(ordinal).chain(inflected).collect()
}

/// Whether ordinals are written with a point.
fn orders_by_point(code: &str) -> bool {
    matches!(
        code,
        "de" | "cs"
            | "pl"
            | "fi"
            | "tr"
            | "da"
            | "nb"
            | "no"
            | "nn"
            | "sk"
            | "hr"
            | "sr"
            | "bs"
            | "sl"
            | "hu"
            | "et"
            | "lv"
            | "is"
    )
}
