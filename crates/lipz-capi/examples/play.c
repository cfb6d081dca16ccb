/* Plays a clip of a mapped bank in C99: play <bank> <key> <locale>. */
#define _POSIX_C_SOURCE 200809L

#include <lipz.h>

#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/* Time between two pictures: 24 a second, rounded up, so that each frame starts a picture. */
#define PICTURE_US 41667

static const char *const VERBS[] = {"",              "feels",  "sees",           "stares",
                                    "stops staring", "points", "stops pointing", "does",
                                    "nods", "shakes", "breathes", "blinks", "looks away"};

/* Strings have a length and no terminator; where there is none, the pointer is null. */
static void print(const char *data, size_t length_bytes) {
    if (length_bytes > 0) {
        fwrite(data, 1, length_bytes, stdout);
    }
}

static int failed(const char *what, lipz_status status) {
    lipz_string message;
    lipz_status_message(status, &message);
    fprintf(stderr, "play: %s: %.*s (%" PRIu32 ")\n", what, (int)message.length_bytes, message.data, status);
    return 1;
}

/* Maps a whole file; NULL if that fails or the file is empty. */
static const uint8_t *mapped(const char *path, size_t *length_bytes) {
    struct stat about;
    void *data = MAP_FAILED;
    const int file = open(path, O_RDONLY);
    if (file < 0) {
        return NULL;
    }
    if (fstat(file, &about) == 0 && about.st_size > 0) {
        *length_bytes = (size_t)about.st_size;
        data = mmap(NULL, *length_bytes, PROT_READ, MAP_PRIVATE, file, 0);
    }
    close(file);
    return data == MAP_FAILED ? NULL : data;
}

static void print_event(const lipz_event *event) {
    printf("* ");
    print(event->character.name.data, event->character.name.length_bytes);
    printf("%s%s", event->character.id == LIPZ_NO_NAME ? "" : " ", VERBS[event->verb]);
    printf("%s", event->object.id == LIPZ_NO_NAME ? "" : " ");
    print(event->object.name.data, event->object.name.length_bytes);
    printf("\n");
}

static void print_subtitle(const lipz_bank *bank, const lipz_segment *segment, const lipz_locale *locale) {
    lipz_text text;

    printf("\n%" PRIu32 ": ", segment->index);
    if (lipz_segment_text(bank, segment, locale, &text) == LIPZ_OK) {
        print(text.data, text.length_bytes);
        printf("%s", text.is_fallback ? " (fallback)" : "");
    }
    printf("\n");
}

static int play(const lipz_bank *bank, const char *key, const char *tag) {
    lipz_clip clip;
    lipz_locale locale;
    lipz_cursor cursor;
    lipz_segment segment;
    lipz_event event;
    lipz_viseme viseme;
    int64_t time_us;
    uint32_t shown = UINT32_MAX;
    lipz_status status;

    if ((status = lipz_clip_by_key(bank, key, strlen(key), &clip)) != LIPZ_OK) {
        return failed(key, status);
    }
    if ((status = lipz_locale_by_tag(bank, tag, strlen(tag), &locale)) != LIPZ_OK) {
        return failed(tag, status);
    }
    if ((status = lipz_cursor_new(bank, &clip, sizeof cursor, &cursor)) != LIPZ_OK) {
        return failed("frame rate", status);
    }
    printf("%s: %" PRIu32 " frames, %" PRIu32 " segments", key, clip.frame_count, clip.segment_count);
    for (time_us = 0; cursor.frame != LIPZ_OVER; time_us += PICTURE_US) {
        lipz_cursor_advance_us(bank, &cursor, time_us);
        if (cursor.frame == LIPZ_OVER) {
            printf("\n");
        } else if (lipz_cursor_segment(bank, &cursor, &segment) == LIPZ_OK && segment.index != shown) {
            print_subtitle(bank, &segment, &locale);
            shown = segment.index;
        }
        /* Of all segments that have begun since the last picture, also of those without frames. */
        while (lipz_cursor_take_event(bank, &cursor, &event) == LIPZ_OK) {
            print_event(&event);
        }
        lipz_cursor_viseme(bank, &cursor, &viseme);
        printf("%s%c", cursor.frame == LIPZ_OVER ? "end: " : "", viseme);
    }
    printf("\n");
    return 0;
}

int main(int count, char **arguments) {
    lipz_bank bank;
    lipz_status status;
    size_t length_bytes = 0;
    const uint8_t *data;
    int result;

    if (count != 4) {
        fprintf(stderr, "usage: play <bank> <key> <locale>\n");
        return 2;
    }
    if ((data = mapped(arguments[1], &length_bytes)) == NULL) {
        perror(arguments[1]);
        return 1;
    }
    if ((status = lipz_bank_open(data, length_bytes, &bank, NULL)) != LIPZ_OK ||
        (status = lipz_bank_verify(&bank, NULL)) != LIPZ_OK) {
        result = failed(arguments[1], status);
    } else {
        result = play(&bank, arguments[2], arguments[3]);
    }
    munmap((void *)data, length_bytes);
    return result;
}
