/* The cases for articulation. Values are in thousandths. */
#ifndef CASES_ARTICULATION_H
#define CASES_ARTICULATION_H

#include "cases_words.h"

/* More than any rig of the cases has. */
#define MOST_WEIGHTS 64

static const char *const ARTICULATORS[] = {"jaw",       "opening",    "closure",    "teeth",      "rounding",
                                           "spreading", "tongue_tip", "tongue_out", "tongue_back"};

/* The articulation of the clip at the time in these words; false without such a profile. */
static int articulation_at(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[], lipz_articulation *mouth) {
    const int is_default = is(words[0], "default");
    lipz_articulation_profile profile = {{NULL, 0}, 0, 0};
    char **behind;

    if (!is_default && lipz_dialogue_articulation_profile(dialogue, words[0], strlen(words[0]), &profile) != LIPZ_OK) {
        printf("  no profile\n");
        return 0;
    }
    /* Null stands for the project's profile. */
    must(lipz_clip_articulation_at(dialogue, clip, time_at(words + 1, &behind), is_default ? NULL : &profile, mouth), "mouth");
    return 1;
}

/* `articulation PROFILE TIME`. */
static void print_articulation(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    lipz_articulation mouth;
    size_t index;

    if (articulation_at(dialogue, clip, words + 1, &mouth)) {
        for (index = 0; index < LIPZ_ARTICULATOR_COUNT; index++) {
            printf("%s%s %u", index == 0 ? "  " : ", ", ARTICULATORS[index], (unsigned)mouth.thousandths[index]);
        }
        printf("\n");
    }
}

/* `weights RIG PROFILE TIME`, with the speaker's emotions and face. */
static void print_weights(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    lipz_rig rig;
    lipz_articulation mouth;
    lipz_emotions emotions;
    lipz_face face;
    lipz_string name;
    int32_t weights[MOST_WEIGHTS];
    uint32_t index;
    char **behind;

    if (lipz_dialogue_rig(dialogue, words[1], strlen(words[1]), &rig) != LIPZ_OK) {
        printf("  no rig\n");
        return;
    }
    if (!articulation_at(dialogue, clip, words + 2, &mouth)) {
        return;
    }
    must(lipz_clip_emotions_at(dialogue, clip, time_at(words + 3, &behind), NULL, &emotions), "emotions");
    must(lipz_clip_face_at(dialogue, clip, time_at(words + 3, &behind), NULL, NULL, NULL, &face), "face");
    must(lipz_rig_weights(dialogue, &rig, &mouth, &emotions, &face, weights, MOST_WEIGHTS), "weights");
    for (index = 0; index < rig.weight_count; index++) {
        must(lipz_rig_weight_name(dialogue, &rig, index, &name), "name");
        printf("%s%.*s %" PRId32, index == 0 ? "  " : ", ", (int)name.length_bytes, name.data, weights[index]);
    }
    printf("\n");
}

#endif
