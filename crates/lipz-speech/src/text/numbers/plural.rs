//! Forms of words after a number: *tysiące*, *tysięcy*.

/// Returns the form for an integer, from a list such as `(cardinal,one{…}few{…}other{…}`.
pub(super) fn choose<'r>(code: &str, number: u64, forms: &'r str) -> &'r str {
    form(category(code, number), forms).unwrap_or_else(|| of_decimals(forms))
}

/// Returns the form for a number with decimals: the form for all other numbers.
pub(super) fn of_decimals(forms: &str) -> &str {
    form("other", forms).unwrap_or_default()
}

fn form<'r>(name: &str, forms: &'r str) -> Option<&'r str> {
    let start = forms.find(&format!("{name}{{"))? + name.len() + 1;
    let end = forms.get(start..)?.find('}')?;
    forms.get(start..start + end)
}

/// Returns the CLDR plural category of an integer, for the languages whose rules use it.
/// <https://www.unicode.org/cldr/charts/latest/supplemental/language_plural_rules.html>
fn category(code: &str, number: u64) -> &'static str {
    let (ten, hundred) = (number % 10, number % 100);
    let teen = (11..=19).contains(&hundred);
    match code {
        "ru" | "uk" | "be" | "sr" | "hr" | "bs" => match (ten, hundred) {
            (1, hundred) if hundred != 11 => "one",
            (2..=4, hundred) if !(12..=14).contains(&hundred) => "few",
            _ => "many",
        },
        "pl" => match (ten, hundred) {
            _ if number == 1 => "one",
            (2..=4, hundred) if !(12..=14).contains(&hundred) => "few",
            _ => "many",
        },
        "cs" | "sk" => match number {
            1 => "one",
            2..=4 => "few",
            _ => "other",
        },
        "sl" => match hundred {
            1 => "one",
            2 => "two",
            3 | 4 => "few",
            _ => "other",
        },
        "lt" => match ten {
            1 if !teen => "one",
            2..=9 if !teen => "few",
            _ => "other",
        },
        "lv" => match ten {
            _ if ten == 0 || teen => "zero",
            1 => "one",
            _ => "other",
        },
        "ro" => match number {
            1 => "one",
            _ if number == 0 || (1..=19).contains(&hundred) => "few",
            _ => "other",
        },
        "mk" | "is" if ten == 1 && hundred != 11 => "one",
        "fr" | "pt" if number < 2 => "one",
        _ if number == 1 => "one",
        _ => "other",
    }
}

#[cfg(test)]
mod tests {
    use super::choose;

    #[test]
    fn forms_by_number() {
        let forms = "(cardinal,one{тысяча}few{тысячи}other{тысяч}";
        for (number, form) in
            [(1, "тысяча"), (3, "тысячи"), (5, "тысяч"), (11, "тысяч"), (21, "тысяча"), (112, "тысяч")]
        {
            assert_eq!(choose("ru", number, forms), form, "{number}");
        }
        assert_eq!(choose("pl", 22, "few{tysiące}other{tysięcy}"), "tysiące");
        assert_eq!(choose("xx", 1, "other{a}"), "a");
        assert_eq!(choose("xx", 1, "nothing"), "");
    }
}
