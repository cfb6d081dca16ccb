/* The cases of fixtures/playback/cases.txt in C99: cases <folder of the banks> [missing capability]... < cases.txt. Prints
 * the file again with the answers of the library, and reports the number of played and skipped commands. */
#include "cases_articulation.h"
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

static lipz_dialogue dialogue;
static lipz_clip clip;
static lipz_locale locale;
static lipz_cursor cursor;
static int has_locale;

/* The files of the dialogue. */
static lipz_bytes contents[MOST_FILES];
static lipz_file files[MOST_FILES];
static size_t file_count;

/* Adds a file of the folder; after the index of a set, also its banks. False if there is no such file. */
static int add(const char *folder, const char *name, size_t length_bytes) {
    static uint8_t bytes[MOST_FILES][MOST_BYTES];
    char path[1024];
    FILE *file;
    lipz_set_bank bank;
    lipz_bytes index;
    uint32_t number;

    snprintf(path, sizeof path, "%s/%.*s", folder, (int)length_bytes, name);
    file = fopen(path, "rb");
    if (file == NULL || file_count == MOST_FILES) {
        return 0;
    }
    index.data = bytes[file_count];
    index.length_bytes = fread(bytes[file_count], 1, MOST_BYTES, file);
    fclose(file);
    contents[file_count++] = index;
    for (number = 0; lipz_set_bank_by_index(&index, number, &bank) == LIPZ_OK; number++) {
        must(add(folder, bank.file_name.data, bank.file_name.length_bytes) ? LIPZ_OK : LIPZ_NONE, name);
    }
    return 1;
}

static void open_dialogue(void) {
    lipz_problem problem;
    const lipz_status status = lipz_dialogue_open(&dialogue, files, contents, file_count, 0, &problem);

    if (status != LIPZ_OK) {
        fprintf(stderr, "cases: file %" PRIu32 " at %" PRIu32 ":\n", problem.file, problem.offset_bytes);
        must(status, "open");
    }
    /* Like firmware, which opens a verified bank. cases.cpp does not test this. */
    if (file_count == 1) {
        must(lipz_dialogue_open_bank(&dialogue, files, contents), "open the bank");
    }
    has_locale = 0;
}

/* Opens the files that `NAME.list` names, or `NAME.lipzbank` alone. */
static void open_bank(const char *folder, const char *name) {
    char line[1024];
    FILE *list;

    file_count = 0;
    snprintf(line, sizeof line, "%s/%s.list", folder, name);
    list = fopen(line, "r");
    if (list != NULL) {
        while (fgets(line, sizeof line, list) != NULL) {
            must(add(folder, line, strcspn(line, "\n")) ? LIPZ_OK : LIPZ_NONE, line);
        }
        fclose(list);
    } else {
        snprintf(line, sizeof line, "%s.lipzbank", name);
        must(add(folder, line, strlen(line)) ? LIPZ_OK : LIPZ_NONE, line);
    }
    open_dialogue();
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
    must(lipz_cursor_viseme(&dialogue, &cursor, &viseme), "viseme");
    printf(", viseme %c", viseme);
    if (lipz_cursor_openness(&dialogue, &cursor, &open) == LIPZ_OK) {
        printf(", open %" PRIu32, open);
    }
    if (lipz_cursor_segment(&dialogue, &cursor, &segment) == LIPZ_OK) {
        printf(", segment %" PRIu32, segment.index);
        if (has_locale && lipz_segment_text(&dialogue, &segment, &locale, &text) == LIPZ_OK) {
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

    while (lipz_cursor_take_segment(&dialogue, &segments, &segment) == LIPZ_OK) {
        printf("  due %" PRIu32, segment.index);
        if (lipz_segment_event_string(&dialogue, &segment, &string) == LIPZ_OK) {
            printf(string.length_bytes > 0 ? ": " : ":");
            print(string.data, string.length_bytes);
        }
        printf("\n");
    }
    while (lipz_cursor_take_event(&dialogue, &cursor, &event) == LIPZ_OK) {
        printf("  event ");
        print(event.character.name.data, event.character.name.length_bytes);
        printf("%s%s%s", event.character.bank == LIPZ_NO_NAME ? "" : " ", VERBS[event.verb],
               event.object.bank == LIPZ_NO_NAME ? "" : " ");
        print(event.object.name.data, event.object.name.length_bytes);
        printf("\n");
    }
}

static void print_name(const char *before, const lipz_name *name) {
    printf("%s", before);
    if (name->bank == LIPZ_NO_NAME) {
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

    must(lipz_dialogue_clip_by_key(&dialogue, words[1], strlen(words[1]), &clip), words[1]);
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
    status = lipz_cursor_new(&dialogue, &clip, sizeof cursor, &cursor);
    if (status == LIPZ_NONE) {
        printf("  no frame rate\n");
    } else {
        must(status, words[1]);
    }
}

static lipz_status moved(char *words[]) {
    char **rest;
    const lipz_time time = time_at(words + 1, &rest);

    return is(words[0], "advance") ? lipz_cursor_advance(&dialogue, &cursor, time)
           : is(words[0], "loop")  ? lipz_cursor_loop(&dialogue, &cursor, time)
           : is(words[0], "seek")  ? lipz_cursor_seek(&dialogue, &cursor, time)
                                   : LIPZ_NULL_POINTER;
}

static void babble(char *words[]) {
    lipz_babble profile;
    lipz_weights weights;
    char **power;
    const lipz_time time = time_at(words + 2, &power);
    const char *name = is(words[1], "default") ? NULL : words[1];
    const lipz_status status = lipz_dialogue_babble(&dialogue, name, name == NULL ? 0 : strlen(name), &profile);

    if (status == LIPZ_NONE) {
        printf("  no profile\n");
        return;
    }
    must(status, words[1]);
    must(is(power[0], "level")
             ? lipz_babble_at_level(&dialogue, &profile, time, (uint32_t)strtoul(power[1], NULL, 10), &weights)
             : lipz_babble_at(&dialogue, &profile, time, strtof(power[1], NULL), &weights),
         "babble");
    printf("  ooh %" PRIu32 ", aah %" PRIu32 "\n", weights.ooh, weights.aah);
}

/* The first microsecond of a frame, for the lead of a cursor. */
static uint32_t lead_us(uint32_t frame) {
    uint64_t us = 0;
    must(lipz_clip_start_of_frame_us(&dialogue, &clip, frame, &us), "lead");
    return (uint32_t)us;
}

static void command(char *words[], unsigned count, const char *folder) {
    char line[1024];
    lipz_name name;
    lipz_character character;
    uint32_t index;

    if (is(words[0], "bank")) {
        open_bank(folder, words[1]);
    } else if (is(words[0], "texts")) {
        snprintf(line, sizeof line, "%s.lipztexts", words[1]);
        must(add(folder, line, strlen(line)) ? LIPZ_OK : LIPZ_NONE, line);
        open_dialogue();
    } else if (is(words[0], "locale")) {
        has_locale = lipz_dialogue_locale(&dialogue, words[1], strlen(words[1]), &locale) == LIPZ_OK;
        printf("%s", has_locale ? "" : "  no locale\n");
    } else if (is(words[0], "variant")) {
        lipz_locale variant;
        must(lipz_dialogue_variant(&dialogue, &locale, words[1], strlen(words[1]), &variant), "variant");
        locale = variant;
        printf("  %.*s\n", (int)locale.tag.length_bytes, locale.tag.data);
    } else if (is(words[0], "clip")) {
        start(words, count);
    } else if (is(words[0], "speaker")) {
        (void)lipz_dialogue_event_name(&dialogue, words[1], strlen(words[1]), &name);
        cursor.speaker_id = name.id;
        cursor.speaker_bank = name.bank;
    } else if (is(words[0], "lead")) {
        cursor.lead_us = is(words[1], "one")   ? lead_us(1)
                         : is(words[1], "two") ? lead_us(2)
                                               : (uint32_t)strtoul(words[1], NULL, 10);
    } else if (is(words[0], "hold") && (is(words[1], "readable") || is(words[1], "display"))) {
        const uint32_t rendered_us = words[2] == NULL ? 0 : (uint32_t)strtoul(words[2], NULL, 10);
        must(lipz_clip_hold_frames(&dialogue, &clip, rendered_us, &cursor.hold_frames), "hold");
    } else if (is(words[0], "hold")) {
        cursor.hold_frames = (uint32_t)strtoul(words[1], NULL, 10);
    } else if (is(words[0], "finish")) {
        must(lipz_cursor_finish(&dialogue, &cursor), "finish");
        print_shown();
        print_due();
    } else if (is(words[0], "state")) {
        const int is_speaker = is(words[1], "-");
        if (!is_speaker) {
            must(lipz_dialogue_event_name(&dialogue, words[1], strlen(words[1]), &name), words[1]);
        }
        must(lipz_cursor_character(&dialogue, &cursor, is_speaker ? NULL : &name, &character), words[1]);
        print_character(&character, words[1]);
    } else if (is(words[0], "characters")) {
        for (index = 0; lipz_cursor_character_by_index(&dialogue, &cursor, index, &character) == LIPZ_OK; index++) {
            print_character(&character, NULL);
        }
    } else if (is(words[0], "babble")) {
        babble(words);
    } else if (is(words[0], "curves")) {
        print_curves(&dialogue, &clip);
    } else if (is(words[0], "curve")) {
        print_curve(&dialogue, &clip, words);
    } else if (is(words[0], "emotions")) {
        print_emotions(&dialogue, &clip, words);
    } else if (is(words[0], "voices") || is(words[0], "voice")) {
        print_voices(&dialogue, &clip, words);
    } else if (is(words[0], "articulation")) {
        print_articulation(&dialogue, &clip, words);
    } else if (is(words[0], "weights")) {
        print_weights(&dialogue, &clip, words);
    } else if (is(words[0], "face") || is(words[0], "idle")) {
        print_face(&dialogue, &clip, words);
    } else {
        must(moved(words), words[0]);
        print_shown();
        print_due();
    }
}

/* The capabilities of this reader that sections may need, without those in the arguments. */
static int has(const char *need, int argument_count, char **arguments) {
    static const char *const HAVE[] = {"articulation", "babble", "curves", "emotions", "faces", "hold",
                                       "lead", "refresh", "states", "text-banks", "voices"};
    int is_here = 0;
    int index;

    for (index = 0; index < (int)(sizeof HAVE / sizeof HAVE[0]); index++) {
        is_here |= is(need, HAVE[index]);
    }
    for (index = 2; index < argument_count; index++) {
        is_here &= !is(need, arguments[index]);
    }
    return is_here;
}

int main(int argument_count, char **arguments) {
    char line[1024];
    int is_skipping = 0;
    unsigned played = 0;
    unsigned skipped = 0;

    if (argument_count < 2) {
        fprintf(stderr, "usage: cases <folder of the banks> [what it lacks]... < cases.txt\n");
        return 2;
    }
    while (fgets(line, sizeof line, stdin) != NULL) {
        char *words[MOST_WORDS] = {NULL};
        const int is_answer = strncmp(line, "  ", 2) == 0;
        unsigned count = 0;
        unsigned index;
        char *word;

        if (!is_answer || is_skipping) {
            printf("%s", line);
        }
        is_skipping &= strncmp(line, "## ", 3) != 0;
        if (is_answer || line[0] == '\n' || line[0] == '#') {
            continue;
        }
        line[strcspn(line, "\n")] = '\0';
        for (word = strtok(line, " "); word != NULL && count < MOST_WORDS; word = strtok(NULL, " ")) {
            words[count++] = word;
        }
        if (is(words[0], "needs")) {
            for (index = 1; index < count; index++) {
                is_skipping |= !has(words[index], argument_count, arguments);
            }
        } else if (is_skipping) {
            skipped++;
        } else {
            command(words, count, arguments[1]);
            played++;
        }
    }
    fprintf(stderr, "cases: %u commands played, %u skipped\n", played, skipped);
    return 0;
}
