/* The cases for voices: `voices`, which lists them, and `voice TAG`, which plays the chosen clip in that voice. */
#ifndef CASES_VOICES_H
#define CASES_VOICES_H

#include "cases_words.h"

#include <lipz.h>

#include <stdio.h>
#include <string.h>

static void print_voices(const lipz_dialogue *dialogue, const lipz_clip *clip, char *words[]) {
    static const char *const whose[] = {"original", "dub", "other dub"};
    lipz_voice voice;
    lipz_voiced_clip voiced;
    lipz_string key;
    uint32_t index;

    if (is(words[0], "voices")) {
        for (index = 0; lipz_dialogue_voice_by_index(dialogue, index, &voice) == LIPZ_OK; index++) {
            printf("  ");
            print(voice.tag.data, voice.tag.length_bytes);
            printf("\n");
        }
        return;
    }
    if (lipz_dialogue_voice(dialogue, words[1], strlen(words[1]), &voice) != LIPZ_OK) {
        printf("  no voice\n");
        return;
    }
    must(lipz_clip_in_voice(dialogue, clip, &voice, &voiced), "voice");
    printf("  %s: ", whose[voiced.spoken]);
    must(lipz_clip_key(dialogue, &voiced.clip, &key), "key");
    print(key.data, key.length_bytes);
    printf(", spoken in ");
    must(lipz_clip_voice(dialogue, &voiced.clip, &voice), "voice");
    print(voice.tag.data, voice.tag.length_bytes);
    printf("\n");
}

#endif
