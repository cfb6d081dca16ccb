/* Helpers to parse and print cases. */
#ifndef CASES_WORDS_H
#define CASES_WORDS_H

#include <lipz.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(lipz_status status, const char *what) {
    if (status != LIPZ_OK) {
        fprintf(stderr, "cases: %s: status %" PRIu32 "\n", what, status);
        exit(1);
    }
}

static int is(const char *word, const char *other) { return strcmp(word, other) == 0; }

static void print(const char *data, size_t length_bytes) {
    if (length_bytes > 0) {
        fwrite(data, 1, length_bytes, stdout);
    }
}

/* Returns the time at `words`, in its unit. `rest` follows it. */
static lipz_time time_at(char *words[], char ***rest) {
    *rest = words + (is(words[0], "samples") ? 3 : 2);
    if (is(words[0], "us")) {
        return lipz_time_us(strtoll(words[1], NULL, 10));
    }
    if (is(words[0], "samples")) {
        return lipz_time_samples(strtoll(words[1], NULL, 10), (uint32_t)strtoul(words[2], NULL, 10));
    }
    if (is(words[0], "seconds")) {
        return lipz_time_seconds(strtod(words[1], NULL));
    }
    must(is(words[0], "f32") ? LIPZ_OK : LIPZ_NONE, words[0]);
    return lipz_time_seconds_f32(strtof(words[1], NULL));
}

/* Parses `of NAME` or `speaker NAME` at `words`; null if there is neither. */
static const lipz_who *who_at(char *words[], lipz_who *who) {
    if (!is(words[0], "of") && !is(words[0], "speaker")) {
        return NULL;
    }
    who->name.data = words[1];
    who->name.length_bytes = strlen(words[1]);
    who->is_speaker = (uint32_t)is(words[0], "speaker");
    return who;
}

#endif
