/* The cases for faces. Values are in thousandths. */
#ifndef CASES_FACES_H
#define CASES_FACES_H

#include "cases_words.h"

/* `face PROFILE LOOK TIME`, with `of CHARACTER` or `speaker CHARACTER` before the profile; `idle PROFILE LOOK SEED TIME`. */
static void print_face(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    lipz_who named;
    const lipz_who *who = who_at(words + 1, &named);
    char **asked = words + (who == NULL ? 1 : 3);
    const int is_default = is(asked[0], "default");
    const int is_ahead = is(asked[1], "ahead");
    char **rest = asked + (is_ahead ? 2 : 4);
    lipz_face_profile profile = {{NULL, 0}, 0, 0};
    lipz_look_at look = {0, 0, 1};
    lipz_face face;
    const lipz_face_profile *with;
    const lipz_look_at *to;
    char **behind;

    if (!is_default && lipz_dialogue_face_profile(dialogue, asked[0], strlen(asked[0]), &profile) != LIPZ_OK) {
        printf("  no profile\n");
        return;
    }
    if (!is_ahead) {
        look.pitch = (int32_t)strtol(asked[2], NULL, 10);
        look.yaw = (int32_t)strtol(asked[3], NULL, 10);
        look.is_person = (uint32_t)is(asked[1], "person");
    }
    /* Null stands for the project's profile, and for a person straight ahead. */
    with = is_default ? NULL : &profile;
    to = is_ahead ? NULL : &look;
    if (is(words[0], "face")) {
        must(lipz_clip_face_at(dialogue, clip, time_at(rest, &rest), who, with, to, &face), "face");
    } else {
        must(lipz_face_idle_at(dialogue, time_at(rest + 1, &behind), strtoull(rest[0], NULL, 10), with, to, &face), "idle");
    }
    printf("  blink %" PRId32 ", head %" PRId32 " %" PRId32 " %" PRId32 ", eyes %" PRId32 " %" PRId32, face.blink,
           face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw);
    printf(", brows %" PRId32 ", shrug %" PRId32 ", breath %" PRId32 "\n", face.brows, face.shrug, face.breath);
}

#endif
