/* The cases about curves and emotions: values are thousandths. */
#ifndef CASES_CURVES_H
#define CASES_CURVES_H

#include "cases_words.h"

static const char *const EMOTIONS[LIPZ_EMOTION_COUNT] = {"sadness", "anger",     "joy",    "fear", "disgust",  "surprise",
                                                         "shock",   "perplexed", "asleep", "pain", "exertion", "shout"};

static lipz_status curve_value(const lipz_bank *bank, const lipz_clip *clip, const lipz_curve *curve,
                               lipz_curve_cursor *cursor, char *words[], int32_t *value) {
    const int64_t whole = strtoll(words[3], NULL, 10);

    if (is(words[2], "frame")) {
        return lipz_clip_curve_value(bank, clip, curve, cursor, (uint32_t)strtoul(words[3], NULL, 10), value);
    }
    if (is(words[2], "us")) {
        return lipz_clip_curve_value_at_us(bank, clip, curve, cursor, whole, value);
    }
    if (is(words[2], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(words[4], NULL, 10);
        return lipz_clip_curve_value_at_samples(bank, clip, curve, cursor, whole, rate_hz, value);
    }
    if (is(words[2], "seconds")) {
        return lipz_clip_curve_value_at_seconds(bank, clip, curve, cursor, strtod(words[3], NULL), value);
    }
    return lipz_clip_curve_value_at_seconds_f32(bank, clip, curve, cursor, strtof(words[3], NULL), value);
}

/* A cursor that all cases share says what a search says. */
static void print_curve(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    static lipz_curve_cursor cursor = {0};
    lipz_curve curve;
    int32_t value;
    int32_t with_cursor;

    if (lipz_clip_curve(bank, clip, words[1], strlen(words[1]), &curve) != LIPZ_OK) {
        printf("  no curve\n");
    } else if (curve_value(bank, clip, &curve, NULL, words, &value) != LIPZ_OK) {
        printf("  no frame rate\n");
    } else {
        must(curve_value(bank, clip, &curve, &cursor, words, &with_cursor), "cursor");
        if (with_cursor != value) {
            printf("  with a cursor %" PRId32 "\n", with_cursor);
        }
        printf("  %" PRId32 "\n", value);
    }
}

static void print_curves(const lipz_bank *bank, const lipz_clip *clip) {
    lipz_curve curve;
    lipz_curve_key key;
    uint32_t place;
    uint32_t index;

    for (place = 0; lipz_clip_curve_at(bank, clip, place, &curve) == LIPZ_OK; place++) {
        printf("  ");
        print(curve.name.data, curve.name.length_bytes);
        printf(":");
        for (index = 0; lipz_clip_curve_key(bank, clip, &curve, index, &key) == LIPZ_OK; index++) {
            printf(" %" PRIu32 ":%" PRId32, key.frame, key.thousandths);
        }
        printf("\n");
    }
}

static lipz_status emotions_of(const lipz_bank *bank, const lipz_clip *clip, const lipz_who *who, char *time[],
                               lipz_emotions *emotions) {
    const int64_t whole = strtoll(time[1], NULL, 10);

    if (is(time[0], "us")) {
        return lipz_clip_emotions_of_us(bank, clip, who, whole, emotions);
    }
    if (is(time[0], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(time[2], NULL, 10);
        return lipz_clip_emotions_of_samples(bank, clip, who, whole, rate_hz, emotions);
    }
    if (is(time[0], "seconds")) {
        return lipz_clip_emotions_of_seconds(bank, clip, who, strtod(time[1], NULL), emotions);
    }
    return lipz_clip_emotions_of_seconds_f32(bank, clip, who, strtof(time[1], NULL), emotions);
}

static lipz_status emotions_at(const lipz_bank *bank, const lipz_clip *clip, char *time[], lipz_emotions *emotions) {
    const int64_t whole = strtoll(time[1], NULL, 10);

    if (is(time[0], "us")) {
        return lipz_clip_emotions_at_us(bank, clip, whole, emotions);
    }
    if (is(time[0], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(time[2], NULL, 10);
        return lipz_clip_emotions_at_samples(bank, clip, whole, rate_hz, emotions);
    }
    if (is(time[0], "seconds")) {
        return lipz_clip_emotions_at_seconds(bank, clip, strtod(time[1], NULL), emotions);
    }
    return lipz_clip_emotions_at_seconds_f32(bank, clip, strtof(time[1], NULL), emotions);
}

/* `emotions TIME`, `emotions of CHARACTER TIME`, or `emotions speaker CHARACTER TIME`. */
static void print_emotions(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    lipz_emotions emotions;
    lipz_who named;
    const lipz_who *who = who_at(words + 1, &named);
    uint32_t place;

    must(who == NULL ? emotions_at(bank, clip, words + 1, &emotions)
                     : emotions_of(bank, clip, who, words + 3, &emotions),
         "emotions");
    printf(" ");
    for (place = 0; place < LIPZ_EMOTION_COUNT; place++) {
        if (emotions.thousandths[place] != 0) {
            printf(" %s %" PRId32 ",", EMOTIONS[place], emotions.thousandths[place]);
        }
    }
    printf(" strongest %s, sum %" PRId32 "\n",
           emotions.strongest == LIPZ_NEUTRAL ? "neutral" : EMOTIONS[emotions.strongest], emotions.sum);
}

#endif
