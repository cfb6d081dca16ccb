/* The cases about curves and emotions: values are thousandths. */
#ifndef CASES_CURVES_H
#define CASES_CURVES_H

#include "cases_words.h"

static const char *const EMOTIONS[LIPZ_EMOTION_COUNT] = {"sadness", "anger",     "joy",    "fear", "disgust",  "surprise",
                                                         "shock",   "perplexed", "asleep", "pain", "exertion", "shout"};

static lipz_status curve_value(const lipz_bank *bank, const lipz_clip *clip, const lipz_curve *curve, char *words[],
                               int32_t *value) {
    const int64_t whole = strtoll(words[3], NULL, 10);

    if (is(words[2], "frame")) {
        return lipz_clip_curve_value(bank, clip, curve, (uint32_t)strtoul(words[3], NULL, 10), value);
    }
    if (is(words[2], "us")) {
        return lipz_clip_curve_value_at_us(bank, clip, curve, whole, value);
    }
    if (is(words[2], "samples")) {
        return lipz_clip_curve_value_at_samples(bank, clip, curve, whole, (uint32_t)strtoul(words[4], NULL, 10), value);
    }
    if (is(words[2], "seconds")) {
        return lipz_clip_curve_value_at_seconds(bank, clip, curve, strtod(words[3], NULL), value);
    }
    return lipz_clip_curve_value_at_seconds_f32(bank, clip, curve, strtof(words[3], NULL), value);
}

static void print_curve(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    lipz_curve curve;
    int32_t value;

    if (lipz_clip_curve(bank, clip, words[1], strlen(words[1]), &curve) != LIPZ_OK) {
        printf("  no curve\n");
    } else if (curve_value(bank, clip, &curve, words, &value) != LIPZ_OK) {
        printf("  no frame rate\n");
    } else {
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

/* `emotions TIME`, or `emotions of CHARACTER TIME`. */
static void print_emotions(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    lipz_emotions emotions;
    const char *of = is(words[1], "of") ? words[2] : NULL;
    char **time = of == NULL ? words + 1 : words + 3;
    const size_t length = of == NULL ? 0 : strlen(of);
    const int64_t whole = strtoll(time[1], NULL, 10);
    const uint32_t rate_hz = is(time[0], "samples") ? (uint32_t)strtoul(time[2], NULL, 10) : 0;
    uint32_t place;

    if (is(time[0], "us")) {
        must(of == NULL ? lipz_clip_emotions_at_us(bank, clip, whole, &emotions)
                        : lipz_clip_emotions_of_us(bank, clip, of, length, whole, &emotions),
             "emotions");
    } else if (is(time[0], "samples")) {
        must(of == NULL ? lipz_clip_emotions_at_samples(bank, clip, whole, rate_hz, &emotions)
                        : lipz_clip_emotions_of_samples(bank, clip, of, length, whole, rate_hz, &emotions),
             "emotions");
    } else if (is(time[0], "seconds")) {
        const double seconds = strtod(time[1], NULL);
        must(of == NULL ? lipz_clip_emotions_at_seconds(bank, clip, seconds, &emotions)
                        : lipz_clip_emotions_of_seconds(bank, clip, of, length, seconds, &emotions),
             "emotions");
    } else {
        const float seconds = strtof(time[1], NULL);
        must(of == NULL ? lipz_clip_emotions_at_seconds_f32(bank, clip, seconds, &emotions)
                        : lipz_clip_emotions_of_seconds_f32(bank, clip, of, length, seconds, &emotions),
             "emotions");
    }
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
