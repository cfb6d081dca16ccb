/* The cases about voices: `voices`, which lists them, and `voice TAG`, the chosen clip in that voice. */
#ifndef CASES_VOICES_H
#define CASES_VOICES_H

#include "cases_words.h"

#include <lipz.h>

#include <stdio.h>
#include <string.h>

static void print_voices(const lipz_bank *bank, const lipz_clip *clip, char *words[]) {
    static const char *const whose[] = {"original", "dub", "other dub"};
    lipz_voiced_clip voiced;
    lipz_string text;
    uint32_t index;

    if (is(words[0], "voices")) {
        for (index = 0; lipz_voice_at(bank, index, &text) == LIPZ_OK; index++) {
            printf("  ");
            print(text.data, text.length_bytes);
            printf("\n");
        }
        return;
    }
    if (lipz_clip_in_voice(bank, clip, words[1], strlen(words[1]), &voiced) != LIPZ_OK) {
        printf("  no voice\n");
        return;
    }
    printf("  %s: ", whose[voiced.spoken]);
    must(lipz_clip_key(bank, &voiced.clip, &text), "key");
    print(text.data, text.length_bytes);
    printf(", spoken in ");
    must(lipz_clip_voice(bank, &voiced.clip, &text), "voice");
    print(text.data, text.length_bytes);
    printf("\n");
}

#endif
