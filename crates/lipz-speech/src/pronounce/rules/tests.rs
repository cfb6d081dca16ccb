//! Tests of the tables as a whole, and of words of each language whose pronunciation is known.

use super::*;

fn said(code: &str, word: &str) -> Vec<String> {
    let table = table(code).expect(code);
    table.pronounce(word, Origin::Rules).iter().map(ToString::to_string).collect()
}

#[test]
fn every_line_of_every_table_is_understood() {
    for (code, source) in SOURCES {
        let (table, bad) = RuleTable::parse(source);
        assert!(bad.is_empty(), "{code}: lines {bad:?}");
        assert!(table.rules.len() > 20 && !table.vowels.is_empty(), "{code}");
    }
}

/// Each letter of the alphabet has a sound and a name that can be read.
#[test]
fn every_letter_has_a_name_and_a_sound() {
    for (code, _) in SOURCES {
        let table = table(code).expect(code);
        for (letter, name) in &table.names {
            assert!(table.spelled(&letter.to_string()).is_some(), "{code}: {letter}={name}");
            let silent = matches!((*code, *letter), ("ca" | "de" | "es" | "fr" | "it" | "pt", 'h'));
            let sound = table.apply(&[table.vowels[0], *letter, table.vowels[0]], None, 0).0.len() > 2;
            assert!(silent || sound || table.vowels.contains(letter), "{code}: {letter}");
        }
    }
}

#[test]
fn a_rule_that_can_never_apply_is_a_mistake() {
    for (code, _) in SOURCES {
        for rules in table(code).expect(code).rules.values() {
            for (index, rule) in rules.iter().enumerate() {
                let free = |rule: &Rule| rule.before.is_empty() && rule.after.is_empty();
                let hidden = rules[..index].iter().any(|before| before.letters == rule.letters && free(before));
                assert!(!hidden, "{code}: {:?} has an earlier rule without context", rule.letters);
            }
        }
    }
}

/// Checks the first pronunciation of words, or all of them.
fn check(code: &str, words: &[(&str, &[&str])]) {
    for (word, expected) in words {
        let mut all = said(code, word);
        if expected.len() == 1 {
            all.truncate(1);
        }
        assert_eq!(all, *expected, "{code}: {word}");
    }
}

#[test]
fn romance_languages() {
    check(
        "es",
        &[
            ("Gracias", &["G R AA TH Y AA S", "G R AA S Y AA S"]),
            ("guerra", &["G EH R AA"]),
            ("pingüino", &["P IY N G W IY N AO"]),
            ("jefe", &["HH EH F EH"]),
            ("hueso", &["W EH S AO"]),
            ("niño", &["N IY N Y AO"]),
            ("llave", &["Y AA B EH"]),
            ("muy", &["M UW Y"]),
        ],
    );
    check(
        "it",
        &[
            ("ciao", &["CH AA AO"]),
            ("chiesa", &["K Y EH Z AA"]),
            ("gnocchi", &["N Y AO K IY"]),
            ("famiglia", &["F AA M IY L Y AA"]),
            ("dell'acqua", &["D EH L AA K W AA"]),
            ("giusto", &["JH UW S T AO"]),
            ("scienza", &["SH EH N T S AA", "SH EH N D Z AA"]),
        ],
    );
    check(
        "fr",
        &[
            ("Bonjour", &["B AO ZH UW R"]),
            ("c'est", &["S EH"]),
            ("l'homme", &["L AO M"]),
            ("d'abord", &["D AA B AO R"]),
            ("château", &["SH AA T OW"]),
            ("travail", &["T R AA V AA Y"]),
            ("oiseaux", &["W AA Z OW"]),
            ("nation", &["N AA S Y AO"]),
            ("question", &["K EH S T Y AO"]),
            ("parlent", &["P AA R L AA", "P AA R L"]),
            ("gagner", &["G AA N Y EY"]),
            ("fille", &["F IY Y"]),
        ],
    );
    check(
        "pt",
        &[
            ("cidade", &["S IY D AA JH IY", "S IY D AA D"]),
            ("coração", &["K AO R AA S AW", "K UW R AH S AW"]),
            ("noite", &["N OY CH IY", "N OY T"]),
            ("filho", &["F IY L Y UW"]),
            ("rosa", &["HH AO Z AH", "R AO Z AH"]),
            ("Brasil", &["B R AA Z IY W", "B R AH Z IY L"]),
        ],
    );
    check(
        "ca",
        &[
            ("casa", &["K AA Z AH"]),
            ("això", &["AH SH AO"]),
            ("puig", &["P UW CH"]),
            ("cotxe", &["K AO CH AH"]),
            ("paella", &["P AH EH L Y AH"]),
            ("l'aigua", &["L AY G W AH"]),
            ("col·legi", &["K UH L EH ZH IY"]),
        ],
    );
}

#[test]
fn germanic_languages() {
    check(
        "de",
        &[
            ("Straße", &["SH T R AA S AH"]),
            ("Bücher", &["B UW HH AH"]),
            ("sechs", &["Z EH K S"]),
            ("Häuser", &["HH OY Z AH"]),
            ("gehen", &["G EY AH N"]),
            ("geheim", &["G AH HH AY M"]),
            ("Jungfrau", &["Y UH NG F R AW"]),
            ("König", &["K UH N IH HH"]),
            ("Nation", &["N AA T S Y AO N"]),
            ("Vater", &["F AA T AH"]),
        ],
    );
    check(
        "nl",
        &[
            ("goed", &["HH UW T"]),
            ("schip", &["S HH IH P"]),
            ("water", &["V AA T AH R"]),
            ("huis", &["HH UH S"]),
            ("mooi", &["M OW Y"]),
            ("lekker", &["L EH K AH R"]),
            ("vrouwen", &["V R AW AH N"]),
            ("koning", &["K OW N IH NG"]),
        ],
    );
}

#[test]
fn slavic_languages() {
    check(
        "pl",
        &[
            ("Cześć", &["CH EH SH CH"]),
            ("dziękuję", &["JH EH NG K UW Y EH"]),
            ("szczęście", &["SH CH EH SH CH EH"]),
            ("przepraszam", &["P SH EH P R AA SH AA M"]),
            ("wąż", &["V AO ZH"]),
            ("nie", &["N Y EH"]),
        ],
    );
    check(
        "cs",
        &[
            ("Dobrý", &["D AO B R IY"]),
            ("děkuji", &["D Y EH K UW Y IY"]),
            ("město", &["M N Y EH S T AO"]),
            ("čtyři", &["CH T IY ZH IY"]),
            ("chléb", &["HH L EH B"]),
            ("něco", &["N Y EH T S AO"]),
        ],
    );
    check("uk", &[("Дякую", &["D AA K UW Y UW"]), ("їжак", &["Y IY ZH AA K"]), ("правда", &["P R AA W D AA"])]);
    check("bg", &[("къща", &["K AH SH T AA"]), ("Здравей", &["Z D R AA V EY"])]);
    check(
        "ru",
        &[
            ("дом", &["D AO M"]),
            ("её", &["Y IH Y AO"]),
            ("вода", &["V AH D AA", "V AO D AH"]),
            ("что", &["SH T AO"]),
            ("яблоко", &["Y IH B L AO K AH", "Y AA B L AH K AH", "Y IH B L AH K AO"]),
        ],
    );
}

#[test]
fn other_languages() {
    check(
        "fi",
        &[
            ("hyvää", &["HH UW V AE"]),
            ("päivää", &["P AE IY V AE"]),
            ("kaupunki", &["K AW P UW NG K IY"]),
            ("yö", &["UW UH"]),
            ("tuuli", &["T UW L IY"]),
        ],
    );
    check(
        "tr",
        &[
            ("Işık", &["IH SH IH K"]),
            ("İstanbul", &["IY S T AA N B UW L"]),
            ("değil", &["D EH Y IY L"]),
            ("dağ", &["D AA"]),
            ("çocuk", &["CH AO JH UW K"]),
        ],
    );
    check("und", &[("tjena", &["T Y EH N AA", "T JH EH N AA"]), ("háček", &["HH AA CH EH K"])]);
}

#[test]
fn capitals_may_be_spelled() {
    check("de", &[("LKW", &["EH L K AA V EY", "L K V"])]);
    check("fr", &[("SNCF", &["EH S EH N S EY EH F", "S N K F"])]);
    check("es", &[("ONU", &["AO EH N EH UW", "AO N UW"])]);
}
