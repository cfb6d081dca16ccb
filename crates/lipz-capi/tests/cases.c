/* The cases of fixtures/playback/cases.txt in C99: cases <folder of the banks> < cases.txt. Writes the file anew, with the
 * answers of the library. */
#include "cases_curves.h"
#include "cases_faces.h"
#include "cases_voices.h"
#include "cases_words.h"

#include <lipz.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_WORDS 12
#define MOST_FILES 32
#define MOST_BYTES 262144

static const char *const VERBS[] = {"",              "feels",  "sees",           "stares",
                                    "stops staring", "points", "stops pointing", "does",
                                    "nods", "shakes", "breathes", "blinks", "looks away"};
static const char *const TYPES[] = {"", "blair", "toonboom", "rms"};

static lipz_bank bank;
static lipz_clip clip;
static lipz_locale locale;
static lipz_cursor cursor;
static int has_locale;

/* A file of the banks, which stays. */
static const uint8_t *contents(const char *folder, const char *name, const char *extension, size_t *length_bytes) {
    static uint8_t files[MOST_FILES][MOST_BYTES];
    static unsigned count;
    char path[1024];
    FILE *file;

    snprintf(path, sizeof path, "%s/%s.%s", folder, name, extension);
    file = fopen(path, "rb");
    if (file == NULL || count == MOST_FILES) {
        fprintf(stderr, "cases: %s cannot be read\n", path);
        exit(1);
    }
    *length_bytes = fread(files[count], 1, MOST_BYTES, file);
    fclose(file);
    return files[count++];
}

static void print_shown(void) {
    lipz_viseme viseme;
    uint32_t open;
    lipz_segment segment;
    lipz_text text;

    printf("  frame ");
    if (cursor.frame == LIPZ_OVER || cursor.frame == LIPZ_WAITING) {
        printf("%s", cursor.frame == LIPZ_OVER ? "over" : "waiting");
    } else {
        printf("%" PRIu32, cursor.frame);
    }
    must(lipz_cursor_viseme(&bank, &cursor, &viseme), "viseme");
    printf(", viseme %c", viseme);
    if (lipz_cursor_openness(&bank, &cursor, &open) == LIPZ_OK) {
        printf(", open %" PRIu32, open);
    }
    if (lipz_cursor_segment(&bank, &cursor, &segment) == LIPZ_OK) {
        printf(", segment %" PRIu32, segment.index);
        if (has_locale && lipz_segment_text(&bank, &segment, &locale, &text) == LIPZ_OK) {
            printf(": ");
            print(text.data, text.length_bytes);
            printf("%s", text.is_fallback ? " (fallback)" : "");
        }
    }
    printf("\n");
}

static void print_due(void) {
    lipz_cursor segments = cursor;
    lipz_segment segment;
    lipz_string string;
    lipz_event event;

    while (lipz_cursor_take_segment(&bank, &segments, &segment) == LIPZ_OK) {
        printf("  due %" PRIu32, segment.index);
        if (lipz_segment_event_string(&bank, &segment, &string) == LIPZ_OK) {
            printf(string.length_bytes > 0 ? ": " : ":");
            print(string.data, string.length_bytes);
        }
        printf("\n");
    }
    while (lipz_cursor_take_event(&bank, &cursor, &event) == LIPZ_OK) {
        printf("  event ");
        print(event.character.name.data, event.character.name.length_bytes);
        printf("%s%s%s", event.character.id == LIPZ_NO_NAME ? "" : " ", VERBS[event.verb],
               event.object.id == LIPZ_NO_NAME ? "" : " ");
        print(event.object.name.data, event.object.name.length_bytes);
        printf("\n");
    }
}

static void print_name(const char *before, const lipz_name *name) {
    printf("%s", before);
    if (name->id == LIPZ_NO_NAME) {
        printf("-");
    }
    print(name->name.data, name->name.length_bytes);
}

static void print_character(const lipz_character *character, const char *asked) {
    printf("  ");
    if (asked != NULL) {
        printf("%s", asked);
    } else {
        print_name("", &character->name);
    }
    print_name(": feels ", &character->feels);
    print_name(", stares ", &character->stares_at);
    print_name(", points ", &character->points_at);
    printf("\n");
}

static void start(char *words[], unsigned count) {
    lipz_status status;
    unsigned at;
    uint32_t type;

    must(lipz_clip_by_key(&bank, words[1], strlen(words[1]), &clip), words[1]);
    for (at = 2; at + 1 < count; at += 2) {
        if (is(words[at], "rate") && clip.fps_denominator == 0) {
            clip.fps_numerator = (uint32_t)strtoul(words[at + 1], NULL, 10);
            clip.fps_denominator = (uint32_t)strtoul(strchr(words[at + 1], '/') + 1, NULL, 10);
        }
        for (type = LIPZ_BLAIR; is(words[at], "type") && type <= LIPZ_RMS; type++) {
            if (is(words[at + 1], TYPES[type]) && clip.viseme_type == 0) {
                clip.viseme_type = type;
            }
        }
    }
    status = lipz_cursor_new(&bank, &clip, sizeof cursor, &cursor);
    if (status == LIPZ_NONE) {
        printf("  no frame rate\n");
    } else {
        must(status, words[1]);
    }
}

static lipz_status moved(char *words[]) {
    const int is_advance = is(words[0], "advance");
    const int is_loop = is(words[0], "loop");
    const char *unit = words[1];
    const int64_t whole = strtoll(words[2], NULL, 10);

    if (is(unit, "us")) {
        return is_advance ? lipz_cursor_advance_us(&bank, &cursor, whole)
               : is_loop  ? lipz_cursor_loop_us(&bank, &cursor, whole)
                          : lipz_cursor_seek_us(&bank, &cursor, whole);
    }
    if (is(unit, "samples")) {
        const uint32_t rate_hz = (uint32_t)strtoul(words[3], NULL, 10);
        return is_advance ? lipz_cursor_advance_samples(&bank, &cursor, whole, rate_hz)
               : is_loop  ? lipz_cursor_loop_samples(&bank, &cursor, whole, rate_hz)
                          : lipz_cursor_seek_samples(&bank, &cursor, whole, rate_hz);
    }
    if (is(unit, "seconds")) {
        const double seconds = strtod(words[2], NULL);
        return is_advance ? lipz_cursor_advance_seconds(&bank, &cursor, seconds)
               : is_loop  ? lipz_cursor_loop_seconds(&bank, &cursor, seconds)
                          : lipz_cursor_seek_seconds(&bank, &cursor, seconds);
    }
    if (is(unit, "f32")) {
        const float seconds = strtof(words[2], NULL);
        return is_advance ? lipz_cursor_advance_seconds_f32(&bank, &cursor, seconds)
               : is_loop  ? lipz_cursor_loop_seconds_f32(&bank, &cursor, seconds)
                          : lipz_cursor_seek_seconds_f32(&bank, &cursor, seconds);
    }
    return LIPZ_NULL_POINTER;
}

static void babble(char *words[]) {
    lipz_babble profile;
    lipz_weights weights;
    const char *unit = words[2];
    char **power = words + (is(unit, "samples") ? 5 : 4);
    const float loud = strtof(power[1], NULL);
    const int64_t whole = strtoll(words[3], NULL, 10);
    lipz_status status = is(words[1], "default") ? lipz_babble_default(&bank, &profile)
                                                 : lipz_babble_by_name(&bank, words[1], strlen(words[1]), &profile);

    if (status == LIPZ_NONE) {
        printf("  no profile\n");
        return;
    }
    must(status, words[1]);
    if (is(power[0], "level")) {
        status = lipz_babble_at_us_level(&bank, &profile, whole, (uint32_t)strtoul(power[1], NULL, 10), &weights);
    } else if (is(unit, "us")) {
        status = lipz_babble_at_us(&bank, &profile, whole, loud, &weights);
    } else if (is(unit, "samples")) {
        status = lipz_babble_at_samples(&bank, &profile, whole, (uint32_t)strtoul(words[4], NULL, 10), loud, &weights);
    } else if (is(unit, "seconds")) {
        status = lipz_babble_at_seconds(&bank, &profile, strtod(words[3], NULL), loud, &weights);
    } else {
        status = lipz_babble_at_seconds_f32(&bank, &profile, strtof(words[3], NULL), loud, &weights);
    }
    must(status, "babble");
    printf("  ooh %" PRIu32 ", aah %" PRIu32 "\n", weights.ooh, weights.aah);
}

static void command(char *words[], unsigned count, const char *folder) {
    const uint8_t *data;
    size_t length_bytes;
    lipz_name name;
    lipz_character character;
    uint32_t index;

    if (is(words[0], "bank")) {
        data = contents(folder, words[1], "lipzbank", &length_bytes);
        must(lipz_bank_open(data, length_bytes, &bank, NULL), words[1]);
        must(lipz_bank_verify(&bank, NULL), words[1]);
        has_locale = 0;
    } else if (is(words[0], "texts")) {
        data = contents(folder, words[1], "lipztexts", &length_bytes);
        must(lipz_bank_use_texts(&bank, data, length_bytes, NULL), words[1]);
        must(lipz_bank_verify(&bank, NULL), words[1]);
        has_locale = 0;
    } else if (is(words[0], "locale")) {
        has_locale = lipz_locale_by_tag(&bank, words[1], strlen(words[1]), &locale) == LIPZ_OK;
        printf("%s", has_locale ? "" : "  no locale\n");
    } else if (is(words[0], "clip")) {
        start(words, count);
    } else if (is(words[0], "speaker")) {
        (void)lipz_event_name(&bank, words[1], strlen(words[1]), &name);
        cursor.speaker_id = name.id;
        cursor.speaker_bank = name.bank;
    } else if (is(words[0], "lead")) {
        cursor.lead_us = (uint32_t)strtoul(words[1], NULL, 10);
        if (is(words[1], "one") || is(words[1], "two")) {
            must(is(words[1], "one") ? lipz_lead_one_frame(&clip, &cursor.lead_us)
                                     : lipz_lead_two_frames(&clip, &cursor.lead_us), "lead");
        }
    } else if (is(words[0], "hold") && is(words[1], "readable")) {
        must(lipz_hold_readable(&clip, &cursor.hold_frames), "hold");
    } else if (is(words[0], "hold") && is(words[1], "display")) {
        must(lipz_hold_for_display(&clip, (uint32_t)strtoul(words[2], NULL, 10), &cursor.hold_frames), "hold");
    } else if (is(words[0], "hold")) {
        cursor.hold_frames = (uint32_t)strtoul(words[1], NULL, 10);
    } else if (is(words[0], "finish")) {
        must(lipz_cursor_finish(&bank, &cursor), "finish");
        print_shown();
        print_due();
    } else if (is(words[0], "state")) {
        const int is_speaker = is(words[1], "-");
        if (!is_speaker) {
            must(lipz_event_name(&bank, words[1], strlen(words[1]), &name), words[1]);
        }
        must(lipz_cursor_character(&bank, &cursor, is_speaker ? NULL : &name, &character), words[1]);
        print_character(&character, words[1]);
    } else if (is(words[0], "characters")) {
        for (index = 0; lipz_cursor_character_at(&bank, &cursor, index, &character) == LIPZ_OK; index++) {
            print_character(&character, NULL);
        }
    } else if (is(words[0], "babble")) {
        babble(words);
    } else if (is(words[0], "curves")) {
        print_curves(&bank, &clip);
    } else if (is(words[0], "curve")) {
        print_curve(&bank, &clip, words);
    } else if (is(words[0], "emotions")) {
        print_emotions(&bank, &clip, words);
    } else if (is(words[0], "voices") || is(words[0], "voice")) {
        print_voices(&bank, &clip, words);
    } else if (is(words[0], "face") || is(words[0], "idle")) {
        print_face(&bank, &clip, words);
    } else {
        must(moved(words), words[0]);
        print_shown();
        print_due();
    }
}

int main(int argument_count, char **arguments) {
    char line[1024];

    if (argument_count != 2) {
        fprintf(stderr, "usage: cases <folder of the banks> < cases.txt\n");
        return 2;
    }
    while (fgets(line, sizeof line, stdin) != NULL) {
        char *words[MOST_WORDS] = {NULL};
        unsigned count = 0;
        char *word;

        if (strncmp(line, "  ", 2) == 0) {
            continue;
        }
        printf("%s", line);
        line[strcspn(line, "\n")] = '\0';
        if (line[0] == '\0' || line[0] == '#') {
            continue;
        }
        for (word = strtok(line, " "); word != NULL && count < MOST_WORDS; word = strtok(NULL, " ")) {
            words[count++] = word;
        }
        command(words, count, arguments[1]);
    }
    return 0;
}
