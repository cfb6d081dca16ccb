//! Sentences in twelve languages and ten scripts, made of small lists of words.
//!
//! They have no meaning. They have realistic lengths in bytes and characters, a mix of scripts, and few equal texts.

use crate::random::Random;

/// A locale with the parts of its sentences.
pub(crate) struct Locale {
    pub(crate) tag: &'static str,
    /// Words, separated by spaces.
    words: &'static str,
    /// The separator of words.
    gap: &'static str,
    /// The ends of sentences.
    ends: &'static [&'static str],
    /// Written characters in ten seconds of a clip, including pauses.
    characters_per_10_s: usize,
}

const ENDS: &[&str] = &[".", ".", ".", "!", "?", "…"];
const WIDE_ENDS: &[&str] = &["。", "。", "。", "！", "？", "……"];

/// The locales in the order of use: the usual first languages of a game, then one for each further script.
pub(crate) const LOCALES: &[Locale] = &[
    Locale {
        tag: "en-us",
        words: "the a I you never lighthouse keeper said that harbor was closed and nobody came back from there \
            tonight we should leave before morning if it isn't too late listen somebody has been here my \
            friend what about letter",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 82,
    },
    Locale {
        tag: "de-de",
        words: "der die das ich du niemals Leuchtturm Wärter sagte dass Hafen war geschlossen und niemand kam \
            zurück von dort heute Nacht wir sollten gehen bevor es hell wird wenn nicht schon zu spät ist \
            hör zu jemand Brief über",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 87,
    },
    Locale {
        tag: "fr-fr",
        words: "le la un je tu jamais phare gardien disait que port était fermé et personne n'est revenu de \
            là-bas cette nuit nous devrions partir avant l'aube si ce n'est pas trop tard écoute quelqu'un \
            mon ami lettre",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 87,
    },
    Locale {
        tag: "ru-ru",
        words: "я ты никогда маяк смотритель сказал что гавань была закрыта и никто не вернулся оттуда сегодня \
            ночью нам надо уйти до утра если ещё не поздно слушай кто-то здесь был мой друг письмо где \
            почему",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 75,
    },
    Locale {
        tag: "ja-jp",
        words: "灯台の 番人は 言った 港は 閉まって いる 誰も 戻って こない 今夜 私たちは 朝までに 出よう もし \
            遅すぎ なければ 聞いて くれ 誰かが ここに いた 友よ 手紙を どうして あなたは ください それは \
            ちがう",
        gap: "",
        ends: WIDE_ENDS,
        characters_per_10_s: 37,
    },
    Locale {
        tag: "zh-cn",
        words: "灯塔 看守 说过 港口 已经 关闭 没有人 回来 今晚 我们 应该 离开 天亮 以前 如果 还不 太晚 听着 有人 \
            来过 这里 我的 朋友 那封信 为什么 你 不要 忘记",
        gap: "",
        ends: WIDE_ENDS,
        characters_per_10_s: 26,
    },
    Locale {
        tag: "ko-kr",
        words: "등대 지기가 말했다 항구는 닫혔고 아무도 돌아오지 않았어 오늘 밤 우리는 아침이 되기 전에 떠나야 \
            해 너무 늦지 않았다면 들어봐 누군가 여기 있었어 친구야 편지를 왜 그것은",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 40,
    },
    Locale {
        tag: "ar-sa",
        words: "أنا أنت أبدا المنارة الحارس قال إن الميناء كان مغلقا ولم يعد أحد من هناك الليلة علينا أن نرحل \
            قبل الصباح إذا لم يفت الأوان اسمع شخص ما هنا صديقي الرسالة لماذا",
        gap: " ",
        ends: &[".", ".", "!", "؟", "…"],
        characters_per_10_s: 70,
    },
    Locale {
        tag: "el-gr",
        words: "εγώ εσύ ποτέ φάρος φύλακας είπε ότι το λιμάνι ήταν κλειστό και κανείς δεν γύρισε από εκεί απόψε \
            πρέπει να φύγουμε πριν ξημερώσει αν είναι αργά άκου κάποιος εδώ φίλε μου γράμμα γιατί",
        gap: " ",
        ends: &[".", ".", "!", ";", "…"],
        characters_per_10_s: 85,
    },
    Locale {
        tag: "he-il",
        words: "אני אתה אף פעם המגדלור השומר אמר שהנמל היה סגור ואיש לא חזר משם הלילה אנחנו צריכים לעזוב לפני \
            הבוקר אם מאוחר מדי תקשיב מישהו כאן חבר שלי המכתב למה",
        gap: " ",
        ends: ENDS,
        characters_per_10_s: 64,
    },
    Locale {
        tag: "hi-in",
        words: "मैं तुम कभी नहीं प्रकाशस्तंभ रखवाले ने कहा कि बंदरगाह बंद था और कोई वापस वहाँ से आज रात हमें \
            सुबह पहले निकल जाना चाहिए अगर बहुत देर सुनो यहाँ मेरे दोस्त चिट्ठी क्यों",
        gap: " ",
        ends: &["।", "।", "!", "?", "…"],
        characters_per_10_s: 75,
    },
    Locale {
        tag: "th-th",
        words: "ฉัน คุณ ไม่เคย ประภาคาร คนเฝ้า บอกว่า ท่าเรือ ปิดแล้ว และ ไม่มีใคร กลับมา จากที่นั่น คืนนี้ \
            พวกเรา ควรจะ ออกไป ก่อน รุ่งเช้า ถ้า ยังไม่ สายเกินไป ฟังนะ มีคน ที่นี่ เพื่อน จดหมาย ทำไม",
        gap: "",
        ends: &[" ", " ", "! ", "? "],
        characters_per_10_s: 73,
    },
];

/// Appends the speech for `duration_ms`, at least one word.
pub(crate) fn sentences(random: &mut Random, out: &mut String, locale: &Locale, duration_ms: usize) {
    let choice: Vec<&str> = locale.words.split(' ').collect();
    // Some characters speak faster than others, and translations differ in length.
    let percent = random.between(75, 125);
    let mut budget = locale.characters_per_10_s * duration_ms * percent / 1_000_000;
    loop {
        let words = random.between(3, 9);
        for index in 0..words {
            let word = random.one_of(&choice);
            if index == 0 {
                let mut characters = word.chars();
                out.extend(characters.next().into_iter().flat_map(char::to_uppercase));
                out.push_str(characters.as_str());
            } else {
                out.push_str(locale.gap);
                out.push_str(word);
            }
            budget = budget.saturating_sub(word.chars().count() + locale.gap.len());
            if budget == 0 {
                break;
            }
        }
        let end = random.one_of(locale.ends);
        if budget == 0 {
            // No space after the last sentence, because a display text does not end in one.
            out.push_str(end.trim_end());
            return;
        }
        out.push_str(end);
        out.push_str(locale.gap);
    }
}
