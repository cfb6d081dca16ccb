/* Measures the library in C99: bench <folder of the banks>. The questions are those of docs/inside/ports.md.
 *
 * The linker must wrap malloc, calloc and realloc, so that their bytes are counted. */
#define _POSIX_C_SOURCE 200809L

#include <lipz.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ROUNDS 40
#define CALLS 200000
#define FRAMES_PER_SECOND 60
/* The rendered frames of a clip, which repeat. */
#define CLIP_FRAMES (4 * FRAMES_PER_SECOND)
#define SPOKEN_FRAMES 84
#define MOST_WEIGHTS 64
#define MOST_BYTES 262144

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);

static size_t allocated;
static size_t answers;

void *__wrap_malloc(size_t size) {
    allocated += size;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    allocated += count * size;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size) {
    allocated += size;
    return __real_realloc(block, size);
}

/* A bank that is open, with the clip of a question. */
typedef struct {
    lipz_dialogue dialogue;
    lipz_file file;
    lipz_clip clip;
    char bytes[MOST_BYTES];
} opened;

static opened drama;
static opened phones;
static lipz_locale german;
static lipz_cursor cursor;
static lipz_rig rig;

static lipz_time frame_time(int frame) {
    return lipz_time_us((int64_t)frame * 1000000 / FRAMES_PER_SECOND);
}

static void ask_viseme(int number) {
    lipz_viseme viseme;
    lipz_clip_viseme_at(&drama.dialogue, &drama.clip, frame_time(number % CLIP_FRAMES), &viseme);
    answers += viseme;
}

static void tick(int number) {
    lipz_viseme viseme;
    lipz_segment segment;
    lipz_text text;
    lipz_event event;
    const lipz_time time = frame_time(number % CLIP_FRAMES);

    if (number % CLIP_FRAMES == 0) {
        lipz_cursor_seek(&drama.dialogue, &cursor, time);
    }
    lipz_cursor_advance(&drama.dialogue, &cursor, time);
    while (lipz_cursor_take_event(&drama.dialogue, &cursor, &event) == LIPZ_OK) {
        answers += event.verb;
    }
    lipz_cursor_viseme(&drama.dialogue, &cursor, &viseme);
    answers += viseme;
    if (lipz_cursor_segment(&drama.dialogue, &cursor, &segment) == LIPZ_OK &&
        lipz_segment_text(&drama.dialogue, &segment, &german, &text) == LIPZ_OK) {
        answers += text.length_bytes;
    }
}

static void ask_weights(int number) {
    lipz_articulation articulation;
    lipz_emotions emotions;
    lipz_face face;
    int32_t thousandths[MOST_WEIGHTS];
    const lipz_dialogue *dialogue = &phones.dialogue;
    const lipz_time time = frame_time(number % SPOKEN_FRAMES);

    lipz_clip_articulation_at(dialogue, &phones.clip, time, NULL, &articulation);
    lipz_clip_emotions_at(dialogue, &phones.clip, time, NULL, &emotions);
    lipz_clip_face_at(dialogue, &phones.clip, time, NULL, NULL, NULL, &face);
    lipz_rig_weights(dialogue, &rig, &articulation, &emotions, &face, thousandths, MOST_WEIGHTS);
    answers += (size_t)thousandths[0];
}

static double now_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

/* Prints the least time of several rounds, and the most bytes. */
static void measure(const char *name, int calls, void (*call)(int)) {
    double least = 1e18;
    size_t most = 0;
    int round;
    int number;

    for (round = 0; round < ROUNDS; round++) {
        const size_t before = allocated;
        const double start = now_ns();
        for (number = 0; number < calls; number++) {
            call(number);
        }
        const double each = (now_ns() - start) / calls;
        least = each < least ? each : least;
        most = allocated - before > most ? allocated - before : most;
    }
    printf("bench %s_ns %.1f C\nbench %s_bytes %zu C\n", name, least, name, most / (size_t)calls);
}

static int opens(opened *out, const char *folder, const char *name, const char *key) {
    char path[4096];
    lipz_bytes contents;
    lipz_problem problem;
    FILE *file;

    snprintf(path, sizeof path, "%s/%s.lipzbank", folder, name);
    if ((file = fopen(path, "rb")) == NULL) {
        return 0;
    }
    contents.data = (const void *)out->bytes;
    contents.length_bytes = fread(out->bytes, 1, sizeof out->bytes, file);
    fclose(file);
    return lipz_dialogue_open(&out->dialogue, &out->file, &contents, 1, 0, &problem) == LIPZ_OK &&
           lipz_dialogue_clip_by_key(&out->dialogue, key, strlen(key), &out->clip) == LIPZ_OK;
}

int main(int count, char **arguments) {
    lipz_name speaker;

    if (count != 2 || !opens(&drama, arguments[1], "drama", "act1/mara-good-evening") ||
        !opens(&phones, arguments[1], "phones", "spoken") ||
        lipz_dialogue_locale(&drama.dialogue, "de-de", 5, &german) != LIPZ_OK ||
        lipz_cursor_new(&drama.dialogue, &drama.clip, sizeof cursor, &cursor) != LIPZ_OK ||
        lipz_dialogue_event_name(&drama.dialogue, "mara", 4, &speaker) != LIPZ_OK ||
        lipz_dialogue_rig(&phones.dialogue, "arkit", 5, &rig) != LIPZ_OK) {
        fprintf(stderr, "usage: bench <folder of drama.lipzbank and phones.lipzbank>\n");
        return 2;
    }
    cursor.speaker_bank = speaker.bank;
    cursor.speaker_id = speaker.id;
    measure("viseme", CALLS, ask_viseme);
    measure("tick", CALLS, tick);
    measure("weights", CALLS / 10, ask_weights);
    return answers == 0;
}
