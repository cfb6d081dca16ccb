/* The cases for curves and emotions. Values are in thousandths. */
#ifndef CASES_CURVES_H
#define CASES_CURVES_H

#include "cases_words.h"

static const char *const EMOTIONS[LIPZ_EMOTION_COUNT] = {"sadness", "anger",     "joy",    "fear", "disgust",  "surprise",
                                                         "shock",   "perplexed", "asleep", "pain", "exertion", "shout"};

static lipz_status curve_value(const lipz_dialogue *dialogue, const lipz_curve *curve, lipz_curve_cursor *cursor,
                               char *words[], int32_t *value) {
    char **rest;

    if (is(words[2], "frame")) {
        return lipz_curve_value(dialogue, curve, (uint32_t)strtoul(words[3], NULL, 10), value);
    }
    return lipz_curve_value_at(dialogue, curve, time_at(words + 2, &rest), cursor, value);
}

/* One cursor for all curves, which must never change a value. */
static void print_curve(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    static lipz_curve_cursor cursor = {0};
    lipz_curve curve;
    int32_t value;
    int32_t with_cursor;

    if (lipz_clip_curve(dialogue, clip, words[1], strlen(words[1]), &curve) != LIPZ_OK) {
        printf("  no curve\n");
    } else if (curve_value(dialogue, &curve, NULL, words, &value) != LIPZ_OK) {
        printf("  no frame rate\n");
    } else {
        must(curve_value(dialogue, &curve, &cursor, words, &with_cursor), "cursor");
        if (with_cursor != value) {
            printf("  with a cursor %" PRId32 "\n", with_cursor);
        }
        printf("  %" PRId32 "\n", value);
    }
}

static void print_curves(const lipz_dialogue *dialogue, const lipz_clip *clip) {
    lipz_curve curve;
    lipz_curve_key_t key;
    uint32_t place;
    uint32_t index;

    for (place = 0; lipz_clip_curve_by_index(dialogue, clip, place, &curve) == LIPZ_OK; place++) {
        printf("  ");
        print(curve.name.data, curve.name.length_bytes);
        printf(":");
        for (index = 0; lipz_curve_key(dialogue, &curve, index, &key) == LIPZ_OK; index++) {
            printf(" %" PRIu32 ":%" PRId32, key.frame, key.thousandths);
        }
        printf("\n");
    }
}

/* `emotions TIME`, `emotions of CHARACTER TIME`, or `emotions speaker CHARACTER TIME`. */
static void print_emotions(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    lipz_emotions emotions;
    lipz_who named;
    const lipz_who *who = who_at(words + 1, &named);
    uint32_t place;
    char **rest;

    must(lipz_clip_emotions_at(dialogue, clip, time_at(words + (who == NULL ? 1 : 3), &rest), who, &emotions), "emotions");
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
