/* The cases about faces: values are thousandths. */
#ifndef CASES_FACES_H
#define CASES_FACES_H

#include "cases_words.h"

static lipz_status face_at(const lipz_bank *bank, const lipz_clip *clip, const lipz_face_profile *profile,
                           const lipz_look_at *look, char *time[], lipz_face *face) {
    const int64_t whole = strtoll(time[1], NULL, 10);

    if (is(time[0], "us")) {
        return lipz_clip_face_at_us(bank, clip, profile, look, whole, face);
    }
    if (is(time[0], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(time[2], NULL, 10);
        return lipz_clip_face_at_samples(bank, clip, profile, look, whole, rate_hz, face);
    }
    if (is(time[0], "seconds")) {
        return lipz_clip_face_at_seconds(bank, clip, profile, look, strtod(time[1], NULL), face);
    }
    return lipz_clip_face_at_seconds_f32(bank, clip, profile, look, strtof(time[1], NULL), face);
}

static lipz_status face_of(const lipz_bank *bank, const lipz_clip *clip, const lipz_who *who,
                           const lipz_face_profile *profile, const lipz_look_at *look, char *time[], lipz_face *face) {
    const int64_t whole = strtoll(time[1], NULL, 10);

    if (is(time[0], "us")) {
        return lipz_clip_face_of_us(bank, clip, who, profile, look, whole, face);
    }
    if (is(time[0], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(time[2], NULL, 10);
        return lipz_clip_face_of_samples(bank, clip, who, profile, look, whole, rate_hz, face);
    }
    if (is(time[0], "seconds")) {
        return lipz_clip_face_of_seconds(bank, clip, who, profile, look, strtod(time[1], NULL), face);
    }
    return lipz_clip_face_of_seconds_f32(bank, clip, who, profile, look, strtof(time[1], NULL), face);
}

static lipz_status idle_at(const lipz_bank *bank, const lipz_face_profile *profile, const lipz_look_at *look,
                           uint64_t seed, char *time[], lipz_face *face) {
    const int64_t whole = strtoll(time[1], NULL, 10);

    if (is(time[0], "us")) {
        return lipz_face_idle_at_us(bank, profile, look, seed, whole, face);
    }
    if (is(time[0], "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(time[2], NULL, 10);
        return lipz_face_idle_at_samples(bank, profile, look, seed, whole, rate_hz, face);
    }
    if (is(time[0], "seconds")) {
        return lipz_face_idle_at_seconds(bank, profile, look, seed, strtod(time[1], NULL), face);
    }
    return lipz_face_idle_at_seconds_f32(bank, profile, look, seed, strtof(time[1], NULL), face);
}

/* `face PROFILE LOOK TIME`, with `of CHARACTER` or `speaker CHARACTER` before the profile; `idle PROFILE LOOK SEED TIME`. */
static void print_face(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    lipz_who named;
    const lipz_who *who = who_at(words + 1, &named);
    char **asked = words + (who == NULL ? 1 : 3);
    const int is_default = is(asked[0], "default");
    const int is_ahead = is(asked[1], "ahead");
    char **rest = asked + (is_ahead ? 2 : 4);
    lipz_face_profile profile = {{NULL, 0}, 0, 0};
    lipz_look_at look = {0, 0, 1};
    lipz_face face;

    if (!is_default &&
        lipz_face_profile_by_name(bank, asked[0], strlen(asked[0]), &profile) != LIPZ_OK) {
        printf("  no profile\n");
        return;
    }
    if (!is_ahead) {
        look.pitch = (int32_t)strtol(asked[2], NULL, 10);
        look.yaw = (int32_t)strtol(asked[3], NULL, 10);
        look.is_person = (uint32_t)is(asked[1], "person");
    }
    if (is(words[0], "face")) {
        /* Null is the project's own profile, and somebody straight ahead. */
        const lipz_face_profile *with = is_default ? NULL : &profile;
        const lipz_look_at *to = is_ahead ? NULL : &look;
        must(who == NULL ? face_at(bank, clip, with, to, rest, &face) : face_of(bank, clip, who, with, to, rest, &face),
             "face");
    } else {
        const uint64_t seed = strtoull(rest[0], NULL, 10);
        if (is_default) {
            must(lipz_face_profile_default(bank, &profile), "profile");
        }
        must(idle_at(bank, &profile, &look, seed, rest + 1, &face), "idle");
    }
    printf("  blink %" PRId32 ", head %" PRId32 " %" PRId32 " %" PRId32 ", eyes %" PRId32 " %" PRId32, face.blink,
           face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw);
    printf(", brows %" PRId32 ", shrug %" PRId32 ", breath %" PRId32 "\n", face.brows, face.shrug, face.breath);
}

#endif
