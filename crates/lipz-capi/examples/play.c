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
                                    "stops staring", "points", "stops pointing", "does"};

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

static void print_segment(const lipz_bank *bank, const lipz_segment *segment, const lipz_locale *locale) {
    lipz_text text;
    lipz_event event;
    uint32_t index;

    printf("\n%" PRIu32 ": ", segment->index);
    if (lipz_segment_text(bank, segment, locale, &text) == LIPZ_OK) {
        print(text.data, text.length_bytes);
        printf("%s", text.is_fallback ? " (fallback)" : "");
    }
    printf("\n");
    for (index = 0; lipz_segment_event(bank, segment, index, &event) == LIPZ_OK; index++) {
        printf("* ");
        print(event.character.name.data, event.character.name.length_bytes);
        printf("%s%s", event.character.id == LIPZ_NO_NAME ? "" : " ", VERBS[event.verb]);
        printf("%s", event.object.id == LIPZ_NO_NAME ? "" : " ");
        print(event.object.name.data, event.object.name.length_bytes);
        printf("\n");
    }
}

/* Prints the segments from `next` on that start up to `frame`, each once, also those that have no frames; returns
 * the first one that has not started. */
static uint32_t print_begun(const lipz_bank *bank, const lipz_clip *clip, const lipz_locale *locale, uint32_t next,
                            uint32_t frame) {
    lipz_segment segment;

    while (lipz_segment_at(bank, clip, next, &segment) == LIPZ_OK && segment.start_frame <= frame) {
        print_segment(bank, &segment, locale);
        next++;
    }
    return next;
}

static int play(const lipz_bank *bank, const char *key, const char *tag) {
    lipz_clip clip;
    lipz_locale locale;
    lipz_viseme viseme;
    uint64_t end_us;
    int64_t time_us;
    uint32_t frame;
    uint32_t next = 0;
    lipz_status status;

    if ((status = lipz_clip_by_key(bank, key, strlen(key), &clip)) != LIPZ_OK) {
        return failed(key, status);
    }
    if ((status = lipz_locale_by_tag(bank, tag, strlen(tag), &locale)) != LIPZ_OK) {
        return failed(tag, status);
    }
    if ((status = lipz_clip_start_of_frame_us(bank, &clip, clip.frame_count, &end_us)) != LIPZ_OK) {
        return failed("frame rate", status);
    }
    printf("%s: %" PRIu32 " frames, %" PRIu32 " segments", key, clip.frame_count, clip.segment_count);
    for (time_us = 0; (uint64_t)time_us < end_us; time_us += PICTURE_US) {
        if (lipz_frame_at_us(bank, &clip, time_us, &frame) == LIPZ_OK) {
            next = print_begun(bank, &clip, &locale, next, frame);
        }
        lipz_viseme_at_us(bank, &clip, time_us, &viseme);
        putchar(viseme);
    }
    /* Segments without frames may stand at the end, where no frame leads to them. */
    print_begun(bank, &clip, &locale, next, UINT32_MAX);
    lipz_viseme_at_us(bank, &clip, time_us, &viseme);
    printf("\nend: %c\n", viseme);
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
