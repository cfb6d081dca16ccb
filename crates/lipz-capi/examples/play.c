/* Plays a clip of mapped files in C99: play <key> <locale> <file>...
 *
 * The files are a bank, or the index of a set and its banks, then patches and text banks. */
#define _POSIX_C_SOURCE 200809L

#include <lipz.h>

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#define MOST_FILES 16

/* Time between two rendered frames, at 24 per second, rounded up so that each frame of the clip starts one. */
#define RENDERED_FRAME_US 41667

static const char *const VERBS[] = {"",              "feels",  "sees",           "stares",
                                    "stops staring", "points", "stops pointing", "does",
                                    "nods", "shakes", "breathes", "blinks", "looks away"};

/* Strings have a length and no terminator. The pointer of a missing string is null. */
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

/* Maps a whole file. Returns no bytes if that fails, or if the file is empty. */
#ifdef _WIN32
static lipz_bytes mapped(const char *path) {
    lipz_bytes bytes = {NULL, 0};
    LARGE_INTEGER size;
    const HANDLE file = CreateFileA(path, GENERIC_READ, FILE_SHARE_READ, NULL, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
    if (file == INVALID_HANDLE_VALUE) {
        return bytes;
    }
    if (GetFileSizeEx(file, &size) && size.QuadPart > 0) {
        const HANDLE mapping = CreateFileMappingA(file, NULL, PAGE_READONLY, 0, 0, NULL);
        if (mapping != NULL) {
            bytes.data = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
            bytes.length_bytes = bytes.data == NULL ? 0 : (size_t)size.QuadPart;
            /* The view keeps the mapping open. */
            CloseHandle(mapping);
        }
    }
    CloseHandle(file);
    return bytes;
}

static void unmap(lipz_bytes bytes) {
    UnmapViewOfFile(bytes.data);
}
#else
static lipz_bytes mapped(const char *path) {
    lipz_bytes bytes = {NULL, 0};
    struct stat about;
    const int file = open(path, O_RDONLY);
    if (file >= 0 && fstat(file, &about) == 0 && about.st_size > 0) {
        void *data = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_PRIVATE, file, 0);
        if (data != MAP_FAILED) {
            bytes.data = data;
            bytes.length_bytes = (size_t)about.st_size;
        }
    }
    if (file >= 0) {
        close(file);
    }
    return bytes;
}

static void unmap(lipz_bytes bytes) {
    munmap((void *)bytes.data, bytes.length_bytes);
}
#endif

static void print_event(const lipz_event *event) {
    printf("* ");
    print(event->character.name.data, event->character.name.length_bytes);
    printf("%s%s", event->character.bank == LIPZ_NO_NAME ? "" : " ", VERBS[event->verb]);
    printf("%s", event->object.bank == LIPZ_NO_NAME ? "" : " ");
    print(event->object.name.data, event->object.name.length_bytes);
    printf("\n");
}

static void print_subtitle(const lipz_dialogue *dialogue, const lipz_segment *segment, const lipz_locale *locale) {
    lipz_text text;

    printf("\n%" PRIu32 ": ", segment->index);
    if (lipz_segment_text(dialogue, segment, locale, &text) == LIPZ_OK) {
        print(text.data, text.length_bytes);
        printf("%s", text.is_fallback ? " (fallback)" : "");
    }
    printf("\n");
}

static int play(const lipz_dialogue *dialogue, const char *key, const char *tag) {
    lipz_clip clip;
    lipz_locale locale;
    lipz_cursor cursor;
    lipz_segment segment;
    lipz_event event;
    lipz_viseme viseme;
    int64_t time_us;
    uint32_t shown = UINT32_MAX;
    lipz_status status;

    if ((status = lipz_dialogue_clip_by_key(dialogue, key, strlen(key), &clip)) != LIPZ_OK) {
        return failed(key, status);
    }
    if ((status = lipz_dialogue_locale(dialogue, tag, strlen(tag), &locale)) != LIPZ_OK) {
        return failed(tag, status);
    }
    if ((status = lipz_cursor_new(dialogue, &clip, sizeof cursor, &cursor)) != LIPZ_OK) {
        return failed("frame rate", status);
    }
    printf("%s: %" PRIu32 " frames, %" PRIu32 " segments", key, clip.frame_count, clip.segment_count);
    for (time_us = 0; cursor.frame != LIPZ_OVER; time_us += RENDERED_FRAME_US) {
        lipz_cursor_advance(dialogue, &cursor, lipz_time_us(time_us));
        if (cursor.frame == LIPZ_OVER) {
            printf("\n");
        } else if (lipz_cursor_segment(dialogue, &cursor, &segment) == LIPZ_OK && segment.index != shown) {
            print_subtitle(dialogue, &segment, &locale);
            shown = segment.index;
        }
        /* Includes the events of all segments that have begun since the last rendered frame, even of empty segments. */
        while (lipz_cursor_take_event(dialogue, &cursor, &event) == LIPZ_OK) {
            print_event(&event);
        }
        lipz_cursor_viseme(dialogue, &cursor, &viseme);
        printf("%s%c", cursor.frame == LIPZ_OVER ? "end: " : "", viseme);
    }
    printf("\n");
    return 0;
}

int main(int count, char **arguments) {
    lipz_bytes contents[MOST_FILES];
    lipz_file files[MOST_FILES];
    lipz_dialogue dialogue;
    lipz_problem problem;
    lipz_status status;
    const int file_count = count - 3;
    int number;
    int result;

    if (file_count < 1 || file_count > MOST_FILES) {
        fprintf(stderr, "usage: play <key> <locale> <file>...\n");
        return 2;
    }
    for (number = 0; number < file_count; number++) {
        contents[number] = mapped(arguments[3 + number]);
        if (contents[number].data == NULL) {
            fprintf(stderr, "play: %s: it cannot be mapped, or is empty\n", arguments[3 + number]);
            return 1;
        }
    }
    status = lipz_dialogue_open(&dialogue, files, contents, (size_t)file_count, 0, &problem);
    result = status == LIPZ_OK ? play(&dialogue, arguments[1], arguments[2]) : failed(arguments[3 + problem.file], status);
    for (number = 0; number < file_count; number++) {
        unmap(contents[number]);
    }
    return result;
}
