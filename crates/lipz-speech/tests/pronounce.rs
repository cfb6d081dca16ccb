//! Conversion of texts to words with pronunciations, for typical and arbitrary texts.

#![allow(clippy::expect_used)]

use lipz_speech::{Language, Lexicon, Origin, ProblemKind, Pronouncer, Script};
use proptest::prelude::*;

fn english(text: &str) -> Script {
    Pronouncer::new(Language::ENGLISH).script(text)
}

fn words(script: &Script) -> Vec<&str> {
    script.words.iter().map(|word| word.text.as_str()).collect()
}

fn lines(script: &Script) -> Vec<String> {
    script.words.iter().map(ToString::to_string).collect()
}

#[test]
fn words_are_what_is_displayed() {
    let text = "“Well-known,” he {turns} said—don’t… |Rock 'n' roll!| It's the élan.";
    let script = english(text);
    let expected = ["Well", "known", "he", "said", "don’t", "Rock", "'n'", "roll", "It's", "the", "élan"];
    let displayed: Vec<_> = script.words.iter().map(|word| &text[word.range.clone()]).collect();
    assert_eq!(displayed, words(&script));
    assert_eq!(words(&script)[..6], expected[..6]);
    assert_eq!(script.breaks, [5, script.words.len() - 3]);
    assert!(script.words.iter().all(|word| word.origin() == Some(Origin::Dictionary)), "{script:?}");
}

#[test]
fn a_meta_inside_of_a_word_does_not_divide_it() {
    let text = "Hel{breath}lo{smile}";
    let script = english(text);
    assert_eq!(lines(&script), ["Hello  HH AH L OW"]);
    assert_eq!(&text[script.words[0].range.clone()], "Hel{breath}lo");
}

#[test]
fn a_writer_tells_how_words_are_said() {
    let cases = [
        ("Xzylar{say: Z AY L AA R} comes", "Xzylar  Z AY L AA R"),
        ("Xzylar {say: zigh-lar} comes", "Xzylar  Z AY L AA R"),
        ("Xzylar{say: /zaɪlɑː/}", "Xzylar  Z AY L AA"),
        ("Xzylar, come! {say Xzylar: zigh LAR}", "Xzylar  Z AY L AA R"),
        ("{SAY new york:  N UW Y AO K } New  York", "New  York  N UW Y AO K"),
        ("{say: um} I think", "um  AH M"),
        ("Xzy{say: zigh lar}lar", "Xzylar  Z AY L AA R"),
        ("(door){say:}", "door "),
    ];
    for (text, expected) in cases {
        let reading = Pronouncer::new(Language::ENGLISH).read(text);
        assert_eq!(reading.problems, [], "{text}");
        assert_eq!(reading.script.words[0].to_string(), expected, "{text}");
        assert!(reading.script.words[0].pronunciations.iter().all(|one| one.origin == Origin::Say));
    }
}

#[test]
fn japanese_particles_are_said_as_particles() {
    let japanese = |text: &str| {
        let language = Language::from_locale("ja-jp").expect("a language");
        let lexicon = Lexicon::parse("東京 とうきょう\n");
        assert_eq!(lexicon.problems(), []);
        lines(&Pronouncer::new(language).with_lexicon(lexicon).script(text))
    };
    for text in ["東京はきれいです", "東京{say: とうきょう}はきれいです", "東京 {say: とうきょう}はきれいです"]
    {
        assert_eq!(japanese(text).concat(), "東京  T AO K Y AOはきれいです  W AA K IY R EH D EH S UW", "{text}");
    }
    assert_eq!(japanese("はい、はな"), ["はい  HH AA IY", "はな  HH AA N AA"]);
    assert_eq!(japanese("ロボットへ"), ["ロボット  R AO B AO T AO", "へ  EH"]);
}

#[test]
fn mandarin_years_are_said_digit_by_digit_too() {
    let mandarin = Pronouncer::new(Language::from_locale("zh-cn").expect("a language"));
    let year = mandarin.script("2024年");
    let digits = mandarin.script("二零二四").words;
    let digit_by_digit: Vec<String> = digits.iter().map(|word| word.pronunciations[0].to_string()).collect();
    let all: Vec<String> = year.words[0].pronunciations.iter().map(ToString::to_string).collect();
    assert!(all.contains(&digit_by_digit.join(" ")), "{digit_by_digit:?} {all:?}");
}

#[test]
fn what_is_said_in_addition_stands_where_it_is_said() {
    let text = "Well, {say: um} I| {say: uh} know{say: no}{say: ehm}";
    let script = english(text);
    assert_eq!(words(&script), ["Well", "um", "I", "uh", "know", "ehm"]);
    assert_eq!(script.breaks, [3]);
    assert_eq!(script.words[4].to_string(), "know  N OW");
}

#[test]
fn mistakes_are_told_and_the_word_is_said_as_usual() {
    let cases = [
        ("Hello{say: HH QQ L OW}", ProblemKind::UnknownPhone, "QQ"),
        ("Hello{say: /hɛlo☺/}", ProblemKind::UnknownPhone, "☺"),
        ("Hello{say: ...}", ProblemKind::UnknownPhone, "..."),
        ("Hello{say Helo: hello}", ProblemKind::NameNotInText, "Helo"),
    ];
    for (text, kind, marked) in cases {
        let reading = Pronouncer::new(Language::ENGLISH).read(text);
        let problems: Vec<_> =
            reading.problems.iter().map(|problem| (problem.kind, &text[problem.range.clone()])).collect();
        assert_eq!(problems, [(kind, marked)], "{text}");
        assert_eq!(lines(&reading.script), ["Hello  HH AH L OW"], "{text}");
    }
}

#[test]
fn the_lexicon_comes_first() {
    let lexicon = Lexicon::parse("hello  Y OW\nHELLO(2)  HH AY\n");
    let script = Pronouncer::new(Language::ENGLISH).with_lexicon(lexicon).script("Hello");
    let all: Vec<String> = script.words[0].pronunciations.iter().map(ToString::to_string).collect();
    assert_eq!(all, ["Y OW", "HH AY"]);
    assert_eq!(script.words[0].origin(), Some(Origin::Lexicon));
}

#[test]
fn the_lexicon_knows_numbers_and_signs() {
    let lexicon = Lexicon::parse("1984  B\n&  D\n");
    let script = Pronouncer::new(Language::ENGLISH).with_lexicon(lexicon).script("1984 & 1985");
    assert_eq!(lines(&script)[..2], ["1984  B", "&  D"]);
}

#[test]
fn the_lexicon_knows_names_of_several_words() {
    let lexicon = Lexicon::parse("Jean-Luc  ZH AA\nNew York  N UW\nNew York City\tS IH\n食べ物  T AA\n");
    assert_eq!(lexicon.problems(), []);
    let pronouncer = Pronouncer::new(Language::ENGLISH).with_lexicon(lexicon);
    let text = "Jean-Luc, new  york{x}! New York City| New | York, 食べ物!";
    let script = pronouncer.script(text);
    let expected =
        ["Jean-Luc  ZH AA", "new  york  N UW", "New York City  S IH", "New  N UW", "York  Y AO R K", "食べ物  T AA"];
    assert_eq!(lines(&script), expected);
    assert_eq!(&text[script.words[1].range.clone()], "new  york");
}

#[test]
fn guessed_words_are_lines_of_a_lexicon() {
    let script = english("Wesnoth and wesnoth, Asheviere and the sea.");
    let guessed: String = script.guessed().map(|word| format!("{word}\n")).collect();
    assert_eq!(guessed, "Wesnoth  W EH Z N AA TH\nAsheviere  AE SH EH V IY EH R\n");
    let lexicon = Lexicon::parse(&guessed);
    assert_eq!((lexicon.len(), lexicon.problems().len()), (2, 0));
}

#[test]
fn long_texts_take_linear_time() {
    for part in [
        "a ",
        "a",
        "{say: a}",
        "{say a: b} a ",
        "'",
        "a'",
        "|",
        "{",
        "}",
        "1",
        "1 ",
        "é",
        "東",
        "か",
        "x-",
        ".",
        "M",
        "{say a b: c}",
    ] {
        let text = part.repeat(20_000 / part.len());
        let script = english(&text);
        assert!(script.words.len() <= text.len());
    }
}

/// Checks the properties that hold for any text.
fn check(text: &str, language: Language) {
    let reading = Pronouncer::new(language).read(text);
    let script = &reading.script;
    assert_eq!(script.breaks.len(), text.matches('|').count());
    assert!(script.breaks.is_sorted() && script.breaks.iter().all(|at| *at <= script.words.len()));
    for word in &script.words {
        assert!(text.get(word.range.clone()).is_some(), "{word:?}");
        assert!(word.pronunciations.iter().all(|one| one.phones.iter().all(|phone| phone.is_speech())));
        assert!(word.pronunciations.iter().all(|one| !one.phones.is_empty()), "{word:?}");
        assert!(word.pronunciations.len() <= 16, "{word:?}");
    }
    for problem in &reading.problems {
        assert!(text.get(problem.range.clone()).is_some(), "{problem:?}");
    }
}

fn any_language() -> impl Strategy<Value = Language> {
    proptest::sample::select(Language::all().chain([Language::OTHER]).collect::<Vec<_>>())
}

proptest! {
    #[test]
    fn any_text_is_read(text in any::<String>(), language in any_language()) {
        check(&text, language);
    }

    #[test]
    fn any_text_with_marks_is_read(
        text in "([a-zA-Z'’ .,|{}:/-]|say|\\{say |: |[0-9]|[\u{e0}-\u{17f}]|[а-я]|[ぁ-ヿ]|[가-힣]|[一-鿿]|[$€%°№]|\\PC){0,40}",
        language in any_language(),
    ) {
        check(&text, language);
    }

    #[test]
    fn any_lexicon_is_read(text in any::<String>()) {
        for problem in Lexicon::parse(&text).problems() {
            prop_assert!(text.get(problem.range.clone()).is_some());
        }
    }
}

fn first_lines(locale: &str, text: &str) -> Vec<String> {
    let language = Language::from_locale(locale).expect("a locale");
    lines(&Pronouncer::new(language).script(text))
}

#[test]
fn japanese_is_divided_where_the_writing_changes() {
    let text = "私は東京{say: とうきょう}へ、食べる{say: たべる}ラーメンを{say 拉麺屋: らーめんや}|拉麺屋で。";
    let expected = [
        "私  W AA T AA SH IY",
        "は  W AA",
        "東京  T AO K Y AO",
        "へ  EH",
        "食べる  T AA B EH R UW",
        "ラーメン  R AA M EH N",
        "を  AO",
        "拉麺屋  R AA M EH N Y AA",
        "で  D EH",
    ];
    assert_eq!(first_lines("ja-jp", text), expected);
    let reading = Pronouncer::new(Language::from_locale("ja").expect("a locale")).read("彼は鬱蒼と");
    let problems: Vec<_> = reading.problems.iter().map(|problem| (problem.kind, problem.range.clone())).collect();
    assert_eq!(problems, [(ProblemKind::NoReading, 6..12)]);
}

#[test]
fn numbers_are_said_in_the_language_of_the_text() {
    assert_eq!(
        first_lines("en", "$5, R2D2, II!"),
        ["$5  F AY V D AA L ER Z", "R2D2  AA R T UW D IY T UW", "II  T UW",]
    );
    assert_eq!(first_lines("de", "21 Jahre"), ["21  AY N UH N D T S V AA N T S IH HH", "Jahre  Y AA R AH"]);
    assert_eq!(first_lines("ja", "3年"), ["3  S AA N", "年  T AO SH IY"]);
    assert_eq!(first_lines("zh", "10"), ["10  SH IH"]);
    assert_eq!(first_lines("zh", "305"), ["305  S AA N B AY L IY NG UW"]);
    assert_eq!(first_lines("ko", "10"), ["10  SH IY P"]);
    assert_eq!(first_lines("en", "2½"), ["2  T UW", "½  AH HH AE F"]);
    assert_eq!(first_lines("no", "¾"), ["¾  T R EH F IY R EH"]);
    assert_eq!(first_lines("sv", "3"), ["3  T R EH"]);
    let text = "In 1984, {x}1,0{y}00";
    let ranges: Vec<_> = english(text).words.iter().map(|word| &text[word.range.clone()]).collect();
    assert_eq!(ranges, ["In", "1984", "1,0{y}00"]);
}

#[test]
fn french_words_link_with_vowels() {
    let all = |text: &str| {
        let script = Pronouncer::new(Language::from_locale("fr-fr").expect("a locale")).script(text);
        script.words[0].pronunciations.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(all("Les amis"), ["L EY Z", "L EY"]);
    assert_eq!(all("les oiseaux")[0], "L EY Z");
    assert_eq!(all("est-elle"), ["EH T", "EH"]);
    for apart in ["les chats", "les, amis", "les | amis", "les oui", "les", "Jean amis"] {
        assert!(!all(apart)[0].ends_with(" Z"), "{apart}");
    }
}

#[test]
fn other_scripts_are_read_by_those_who_can() {
    assert_eq!(first_lines("zh-cn", "你好，OK！"), ["你  N IY", "好  HH AW", "OK  OW K EY"]);
    assert_eq!(first_lines("ko-kr", "안녕, Tom"), ["안녕  AA N N Y AH NG", "Tom  T AA M"]);
    assert_eq!(first_lines("en-us", "Да, はい"), ["Да  D AA", "はい  HH AA IY"]);
    assert_eq!(first_lines("ar-sa", "سلام"), ["سلام  S AH L AH M"]);
    assert_eq!(first_lines("el-gr", "καλημέρα"), ["καλημέρα  K AA L IY M EH R AA"]);
    assert_eq!(first_lines("ru-ru", "Это PC"), ["Это  EH T AH", "PC  P IY S IY"]);
    assert_eq!(first_lines("sv-se", "Hej då"), ["Hej  HH EH Y", "då  D AO"]);
}
