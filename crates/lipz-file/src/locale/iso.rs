//! The two-letter codes of languages and countries.

/// ISO 639-1, in alphabetical order, two letters each.
const LANGUAGES: &str = "\
    aaabaeafakamanarasavayazbabebgbibmbnbobrbscacechcocrcscucvcydadedvdzeeeleneoeseteufafffifjfofrfygagd\
    glgngugvhahehihohrhthuhyhziaidieigiiikioisitiujajvkakgkikjkkklkmknkokrkskukvkwkylalblglilnloltlulvmg\
    mhmimkmlmnmrmsmtmynanbndnengnlnnnonrnvnyocojomorospapiplpsptqurmrnrorurwsascsdsesgshsiskslsmsnsosqsr\
    ssstsusvswtatetgthtitktltntotrtstttwtyugukuruzvevivowawoxhyiyozazhzu";

/// ISO 3166-1 alpha-2 in lower case, in alphabetical order, two letters each.
const COUNTRIES: &str = "\
    adaeafagaialamaoaqarasatauawaxazbabbbdbebfbgbhbibjblbmbnbobqbrbsbtbvbwbybzcacccdcfcgchcickclcmcncocr\
    cucvcwcxcyczdedjdkdmdodzeceeegeheresetfifjfkfmfofrgagbgdgegfggghgiglgmgngpgqgrgsgtgugwgyhkhmhnhrhthu\
    idieiliminioiqirisitjejmjojpkekgkhkikmknkpkrkwkykzlalblclilklrlsltlulvlymamcmdmemfmgmhmkmlmmmnmompmq\
    mrmsmtmumvmwmxmymznancnenfngninlnonpnrnunzompapepfpgphpkplpmpnprpsptpwpyqarerorsrurwsasbscsdsesgshsi\
    sjskslsmsnsosrssstsvsxsysztctdtftgthtjtktltmtntotrtttvtwtzuaugumusuyuzvavcvevgvivnvuwfwsyeytzazmzw";

/// Whether ISO 639-1 has a language with this code, in lower case.
pub(super) fn is_language(code: &str) -> bool {
    contains(LANGUAGES, code)
}

/// Whether ISO 3166-1 has a country with this code, in lower case.
pub(super) fn is_country(code: &str) -> bool {
    contains(COUNTRIES, code)
}

fn contains(list: &str, code: &str) -> bool {
    list.as_bytes().chunks_exact(2).any(|known| known == code.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lists_are_those_of_iso() {
        let letters = || (b'a'..=b'z').map(char::from);
        let codes: Vec<String> = letters().flat_map(|a| letters().map(move |b| format!("{a}{b}"))).collect();
        let of =
            |is_code: &dyn Fn(&str) -> bool| codes.iter().filter(|code| is_code(code)).cloned().collect::<String>();
        assert_eq!(LANGUAGES, of(&|code| isolang::Language::from_639_1(code).is_some()));
        assert_eq!(COUNTRIES, of(&|code| rust_iso3166::from_alpha2(&code.to_ascii_uppercase()).is_some()));
        assert!(!is_language("e") && !is_country("") && !is_country("usa"));
    }
}
