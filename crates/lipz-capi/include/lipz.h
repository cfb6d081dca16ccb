/*
 * lipz.h - reads lipz dialogue banks in place. https://github.com/lipz/lipz
 *
 * MIT OR Apache-2.0. Generated from the code by `LIPZ_BLESS=1 cargo test -p lipz-capi --test header`.
 * docs/guides/c.md has a first program, and lists the fields of each struct.
 *
 * Arguments come in one order: the dialogue, the queried value, the time, who, the profile, options, and the
 * answer last.
 *
 * Contract: the caller guarantees only the following.
 *
 * - Each pointer is null or leads to a value of its type, or to as many bytes as the length next to it. This
 *   includes the pointers in a lipz_bytes and a lipz_who.
 * - Only the library has written the words of a lipz_dialogue and of its files. The files stay at their
 *   addresses, and their contents stay valid, while the dialogue and strings from it are used.
 * - No thread writes to any of these during a call, and answers do not overlap arguments.
 *
 * Everything else is total: no function crashes, reads out of bounds or loops without end, whatever the bytes of
 * the files and the numbers in the other structs are. Each function returns a status. Unless that is LIPZ_OK, the
 * answer is empty: zeros, null, or the viseme at rest. All functions except lipz_dialogue_supply may be called
 * from several threads at once.
 */

#ifndef LIPZ_H
#define LIPZ_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

// Damage: the file is shorter than the header of a bank.
#define LIPZ_TOO_SHORT 1

// Damage: the file is not a lipz bank.
#define LIPZ_NOT_A_BANK 2

// Damage: the bank was damaged by a copy in text mode (line endings were converted).
#define LIPZ_TEXT_MODE 3

// Damage: the bank has a format version that this reader does not support.
#define LIPZ_UNSUPPORTED_VERSION 4

// Damage: the file does not have the length in its header (cut off, or with bytes appended).
#define LIPZ_WRONG_LENGTH 5

// Damage: the directory reaches past the end of the file.
#define LIPZ_DIRECTORY_OUT_OF_BOUNDS 6

// Damage: a section reaches past the end of the file.
#define LIPZ_SECTION_OUT_OF_BOUNDS 7

// Damage: the entry size or the length of a section is wrong.
#define LIPZ_SECTION_SHAPE 8

// Damage: a section that every bank has is missing.
#define LIPZ_SECTION_MISSING 9

// Damage: the bank needs a newer reader (a required section is unknown or out of order).
#define LIPZ_SECTION_UNKNOWN 10

// Damage: a section appears twice in the directory.
#define LIPZ_SECTION_TWICE 11

// Damage: the checksum does not match: the file was changed or damaged.
#define LIPZ_CHECKSUM 12

// Damage: the clip index does not lead to the key record.
#define LIPZ_CLIP_INDEX 13

// Damage: the key of a clip does not match its id.
#define LIPZ_CLIP_KEY 14

// Damage: the clips are not listed in the order of their keys.
#define LIPZ_CLIP_ORDER 15

// Damage: the frames of a clip have a wrong offset.
#define LIPZ_FRAME_RANGE 16

// Damage: a frame code is not one of the clip's viseme type.
#define LIPZ_FRAME_CODE 17

// Damage: the frame rate of a clip is not valid.
#define LIPZ_FRAME_RATE 18

// Damage: a clip has an unknown viseme type or flag.
#define LIPZ_CLIP_FLAGS 19

// Damage: the segment starts of a clip are not valid.
#define LIPZ_SEGMENT_STARTS 20

// Damage: a text reference is not valid.
#define LIPZ_TEXT_REFERENCE 21

// Damage: a string pool is not valid UTF-8.
#define LIPZ_UTF8 22

// Damage: an event reference is not valid.
#define LIPZ_EVENT_REFERENCE 23

// Damage: the locales are not listed in the order of their tags.
#define LIPZ_LOCALE_ORDER 24

// Damage: a section is not at the first multiple of 64 after the one before it.
#define LIPZ_SECTION_PLACE 25

// Damage: the directory has more than 64 sections.
#define LIPZ_DIRECTORY_TOO_LONG 26

// Damage: the fingerprint does not match the clips.
#define LIPZ_FINGERPRINT 27

// Damage: the texts belong to a bank with other clips.
#define LIPZ_OTHER_CLIPS 28

// Damage: the file contains only texts, for the clips of another bank.
#define LIPZ_TEXTS_ONLY 29

// Damage: a typed event is not valid.
#define LIPZ_TYPED_EVENT 30

// Damage: the names in events are not listed in their order.
#define LIPZ_EVENT_NAME 31

// Damage: a babble profile is not valid.
#define LIPZ_BABBLE 32

// Damage: the bank of the texts was not verified.
#define LIPZ_BANK_NOT_VERIFIED 33

// Damage: the record of a recording is not valid.
#define LIPZ_RECORDING 34

// Damage: a curve is not valid.
#define LIPZ_CURVE 35

// Damage: the description of the banks below a patch is not valid.
#define LIPZ_LAYER 36

// Damage: the patch was packed over different banks from those below it.
#define LIPZ_OTHER_BASE 37

// Damage: the bank is not a patch, because it was not packed over another bank.
#define LIPZ_NOT_A_LAYER 38

// Damage: the number of banks is 0, or more than the program has room for.
#define LIPZ_LAYER_COUNT 39

// Damage: a voice or a dub is not valid.
#define LIPZ_VOICE 40

// Damage: a face profile is not valid.
#define LIPZ_FACE 41

// Damage: the file is not the index of a set of banks.
#define LIPZ_NOT_A_SET 42

// Damage: the description of the banks in the index of a set is not valid.
#define LIPZ_SET 43

// Damage: the banks are not those of the set in its order.
#define LIPZ_OTHER_BANK 44

// Damage: the phones of a clip or an articulation profile are not valid.
#define LIPZ_PHONES 45

// Damage: a rig is not valid.
#define LIPZ_RIG 46



// Version of this header. A change of the first number breaks programs. While it is 0, so does a change of the second.
#define LIPZ_VERSION_MAJOR 0

// Second number of the version.
#define LIPZ_VERSION_MINOR 1

// Third number of the version.
#define LIPZ_VERSION_PATCH 0

// The number of words in a `lipz_dialogue`.
#define LIPZ_DIALOGUE_WORDS 80

// The number of words in a `lipz_file`.
#define LIPZ_FILE_WORDS 80

// Kind of a file: a missing bank of a set.
#define LIPZ_FILE_ABSENT 0

// Kind of a file: a bank with clips.
#define LIPZ_FILE_BANK 1

// Kind of a file: a bank that was packed over others.
#define LIPZ_FILE_PATCH 2

// Kind of a file: the texts of locales.
#define LIPZ_FILE_TEXTS 3

// Kind of a file: the index of a set of banks.
#define LIPZ_FILE_SET 4

// For `lipz_dialogue_open`: verifies nothing. Queries are just as safe, but may return wrong answers for a damaged
// file, and each text is checked to be UTF-8 on each query.
#define LIPZ_UNVERIFIED 1

// The `rate_hz` of a time in seconds.
#define LIPZ_SECONDS 4294967295

// The `rate_hz` of a time in seconds that comes from a clock without `double`.
#define LIPZ_SECONDS_F32 4294967294

// Viseme type: Preston Blair's chart, `-AMOSWEFLU`.
#define LIPZ_BLAIR 1

// Viseme type: Toon Boom's chart, `-ABCDEFG`.
#define LIPZ_TOONBOOM 2

// Viseme type: loudness, `-0123456789`.
#define LIPZ_RMS 3

// The clip is the original: the line is not dubbed, or the original was requested.
#define LIPZ_ORIGINAL 0

// The clip is the dub in the requested voice.
#define LIPZ_DUB 1

// The clip is the dub in a voice that the requested one falls back to.
#define LIPZ_OTHER_DUB 2

// The `index` of a profile that needs no file: the Second Life viewer's own for babble, the default one for faces.
#define LIPZ_BUILT_IN 4294967295

// The `bank` of a missing name.
#define LIPZ_NO_NAME 0

// Verb: `feels emotion`, which lasts until changed.
#define LIPZ_FEELS 1

// Verb: `sees target`, a character or a prop, which is momentary.
#define LIPZ_SEES 2

// Verb: `stares target`, until `stops staring`.
#define LIPZ_STARES 3

// Verb: `stops staring`.
#define LIPZ_STOPS_STARING 4

// Verb: `points target`, until `stops pointing`.
#define LIPZ_POINTS 5

// Verb: `stops pointing`.
#define LIPZ_STOPS_POINTING 6

// Verb: `does action`, an action of the game.
#define LIPZ_DOES 7

// Verb: `nods`, with the strength `strength_thousandths`.
#define LIPZ_NODS 8

// Verb: `shakes`, the head, with a strength as `LIPZ_NODS`.
#define LIPZ_SHAKES 9

// Verb: `breathes`, with a strength as `LIPZ_NODS`.
#define LIPZ_BREATHES 10

// Verb: `blinks`.
#define LIPZ_BLINKS 11

// Verb: `looks away`.
#define LIPZ_LOOKS_AWAY 12

// The `strength_thousandths` of an event without a strength.
#define LIPZ_NO_STRENGTH 4294967295

// Stands for a frame: the audio is past the last one. All events of the clip have been due.
#define LIPZ_OVER 4294967295

// Stands for a frame: the audio has not begun.
#define LIPZ_WAITING 4294967294

// The level for a voice that the program does not measure: three quarters. At this level all digits of the viewer's
// profile show, but not at their widest.
#define LIPZ_UNMEASURED 49152

// Attribute of emotion: `sadness`, as an index of `thousandths`.
#define LIPZ_SADNESS 0

// Attribute of emotion: `anger`.
#define LIPZ_ANGER 1

// Attribute of emotion: `joy`.
#define LIPZ_JOY 2

// Attribute of emotion: `fear`.
#define LIPZ_FEAR 3

// Attribute of emotion: `disgust`.
#define LIPZ_DISGUST 4

// Attribute of emotion: `surprise`.
#define LIPZ_SURPRISE 5

// Attribute of emotion: `shock`.
#define LIPZ_SHOCK 6

// Attribute of emotion: `perplexed`.
#define LIPZ_PERPLEXED 7

// Attribute of emotion: `asleep`.
#define LIPZ_ASLEEP 8

// Attribute of emotion: `pain`.
#define LIPZ_PAIN 9

// Attribute of emotion: `exertion`.
#define LIPZ_EXERTION 10

// Attribute of emotion: `shout`.
#define LIPZ_SHOUT 11

// The number of attributes of emotion.
#define LIPZ_EMOTION_COUNT 12

// The value of `strongest` for a neutral face.
#define LIPZ_NEUTRAL 4294967295

// Articulator: how far the jaw is lowered, as an index of `thousandths`.
#define LIPZ_JAW 0

// Articulator: how far the lips are apart, whatever the jaw does.
#define LIPZ_OPENING 1

// Articulator: how firmly the lips are closed, as in *p*, *b* and *m*.
#define LIPZ_CLOSURE 2

// Articulator: how far the lower lip is under the upper teeth, as in *f* and *v*.
#define LIPZ_TEETH 3

// Articulator: how far the lips are rounded and pushed forward.
#define LIPZ_ROUNDING 4

// Articulator: how far the corners of the lips are pulled apart.
#define LIPZ_SPREADING 5

// Articulator: how far the tip of the tongue is raised.
#define LIPZ_TONGUE_TIP 6

// Articulator: how far the tongue is between the teeth.
#define LIPZ_TONGUE_OUT 7

// Articulator: how far the back of the tongue is raised.
#define LIPZ_TONGUE_BACK 8

// The number of articulators.
#define LIPZ_ARTICULATOR_COUNT 9

// The result of a call: `LIPZ_OK`, one of the other numbers from 256 on, or the kind of damage in a file, from 1 to
// 255. Numbers are never reused.
typedef uint32_t lipz_status;

// A string in UTF-8, without terminator. It is part of the bytes of the bank and lives as long as they do. It may
// contain U+0000.
typedef struct {
  // The first byte; null only if there is no string.
  const char *data;
  // Length in bytes.
  size_t length_bytes;
} lipz_string;

// Files that return answers like one bank: a bank or a set of banks, with patches and text banks. Only the library
// reads and writes its words. It owns nothing, and need not be closed.
typedef struct {
  // Written by the library.
  size_t words[LIPZ_DIALOGUE_WORDS];
} lipz_dialogue;

// A summary of a dialogue.
typedef struct {
  // Number of clips. If there are patches, they are counted, which takes time in proportion.
  uint64_t clip_count;
  // Number of files.
  uint32_t file_count;
  // Number of locales.
  uint32_t locale_count;
  // Number of voices; 0 without dubs.
  uint32_t voice_count;
  // 0.
  uint32_t reserved;
} lipz_dialogue_info_t;

// A file of a dialogue.
typedef struct {
  // The checksum in its header, which differs between files of different contents.
  uint64_t checksum;
  // A hash of its clips, which a bank and its text banks share; 0 for other files.
  uint64_t fingerprint;
  // `LIPZ_FILE_BANK` and so on.
  uint32_t kind;
  // Number of its clips.
  uint32_t clip_count;
} lipz_file_info;

// The contents of a file, at any address: a mapped file, ROM, memory.
typedef struct {
  // The first byte.
  const uint8_t *data;
  // Length of the file in bytes; 0 for a missing bank of a set.
  size_t length_bytes;
} lipz_bytes;

// The entry for a bank in the index of a set.
typedef struct {
  // The name of its file, which is in the folder of the index.
  lipz_string file_name;
  // The checksum of the bank.
  uint64_t checksum;
  // Its length in bytes.
  uint32_t length_bytes;
  // Number of its clips.
  uint32_t clip_count;
} lipz_set_bank;

// An open file of a dialogue, which the library fills in.
typedef struct {
  // Written by the library.
  size_t words[LIPZ_FILE_WORDS];
} lipz_file;

// The damaged or mismatched file, and the position of the problem.
typedef struct {
  // The number of the file, from 0.
  uint32_t file;
  // Bytes from the start of the file.
  uint32_t offset_bytes;
} lipz_problem;

// One spoken line, in the version of the dialogue in which it was found. Read the fields, and set only the frame rate
// and the viseme type where they are 0.
typedef struct {
  // Hash of the key, which identifies the clip in every version.
  uint64_t id;
  // The version of the dialogue. In a different version, queries of the clip return `LIPZ_NONE`.
  uint32_t version;
  // The number of its file.
  uint32_t file;
  // Its number in that file.
  uint32_t slot;
  // Number of frames.
  uint32_t frame_count;
  // Number of segments, at least 1 in a verified bank.
  uint32_t segment_count;
  // Frames per `fps_denominator` seconds, in lowest terms; 0 if unspecified. In that case, you can set both fields,
  // to between 1 and 1000 frames per second.
  uint32_t fps_numerator;
  // Seconds in which `fps_numerator` frames pass; 0 if unspecified.
  uint32_t fps_denominator;
  // `LIPZ_BLAIR`, `LIPZ_TOONBOOM`, `LIPZ_RMS`; 0 if unspecified. In that case, you can set it.
  uint32_t viseme_type;
  // 1 if the Lipz file has visemes. Without them there are no frames, and segments have no times.
  uint32_t has_visemes;
  // 1 if the Lipz file has events.
  uint32_t has_events;
} lipz_clip;

// A time since the audio began. Make it with `lipz_time_us`, `lipz_time_samples`, `lipz_time_seconds` or
// `lipz_time_seconds_f32`.
//
// Each unit leads to the same frame as exact arithmetic. Times before the start, from the end on, infinite or NaN lead
// to no frame, and so to rest.
typedef struct {
  // Microseconds, samples per channel, or the bits of a `double` or a `float`.
  int64_t count;
  // 0 for microseconds, `LIPZ_SECONDS`, `LIPZ_SECONDS_F32`, or samples per second.
  uint32_t rate_hz;
  // 0.
  uint32_t reserved;
} lipz_time;

// A viseme: its Lipz code, an ASCII character in any bank that passes verification. Rest is `-`.
typedef uint8_t lipz_viseme;

// A part of a clip, between two `|` of its Lipz file, in the version of the dialogue in which it was found.
typedef struct {
  // The clip.
  uint64_t clip_id;
  // The version of the dialogue. In a different version, queries of the segment return `LIPZ_NONE`.
  uint32_t version;
  // The number of the clip's file.
  uint32_t file;
  // The number of the clip in that file.
  uint32_t slot;
  // Index of the segment in its clip, from 0.
  uint32_t index;
  // Its first frame.
  uint32_t start_frame;
  // The frame after its last one.
  uint32_t end_frame;
} lipz_segment;

// The recording that a clip was made for. Compare it with the audio that you are about to play.
typedef struct {
  // Length in microseconds, rounded to the nearest.
  uint64_t length_us;
  // XXH3, 64 bits with seed 0, of all bytes of the file: the result of `XXH3_64bits` of xxHash.
  uint64_t content_hash;
} lipz_recording;

// A voice: a language in which lines are recorded. In another version of the dialogue it leads to the clip itself:
// look it up again.
typedef struct {
  // The locale of the voice: `de-de`.
  lipz_string tag;
  // The version of the dialogue.
  uint32_t version;
  // Its position in the dialogue.
  uint32_t place;
  // 1 for the voice of the original recordings, in which no clip is a dub.
  uint32_t is_original;
} lipz_voice;

// A clip as played in a voice.
typedef struct {
  // The clip. Its visemes, times, texts and events belong to the recording in that voice.
  lipz_clip clip;
  // `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
  uint32_t spoken;
  // 0.
  uint32_t reserved;
} lipz_voiced_clip;

// A locale of a dialogue. In another version of the dialogue it leads to `LIPZ_NONE`: look it up again.
typedef struct {
  // Its tag, as in `text_en-us` of a Lipz file: `en-us`.
  lipz_string tag;
  // The version of the dialogue.
  uint32_t version;
  // Its position in the dialogue.
  uint32_t place;
  // 1 for the default locale.
  uint32_t is_default;
} lipz_locale;

// A display text, as players see it: UTF-8 without terminator, in the bytes of a file.
typedef struct {
  // The first byte; null only if there is no text.
  const char *data;
  // Length in bytes.
  size_t length_bytes;
  // 1 if the clip has no text of its own in the locale, so that this is the text of the fallback locale.
  uint32_t is_fallback;
} lipz_text;

// A name in events: a character, an emotion, a target or an action. Equal names have equal strings.
typedef struct {
  // The name as spelled in the Lipz file.
  lipz_string name;
  // Identifies the bank of the name; `LIPZ_NO_NAME` for a missing name.
  uint32_t bank;
  // Its number in that bank.
  uint32_t id;
} lipz_name;

// One event of Character Event Syntax: `[character] verb object`.
typedef struct {
  // The character; no name for the speaker of the clip.
  lipz_name character;
  // The emotion, target or action; without a name if the event has no object.
  lipz_name object;
  // `LIPZ_FEELS` and so on. More verbs may be added; skip unknown ones.
  uint32_t verb;
  // The strength of a gesture, from 0 to 10,000, or `LIPZ_NO_STRENGTH`.
  uint32_t strength_thousandths;
} lipz_event;

// The position in a clip during playback: a plain struct of numbers, which a program keeps next to its dialogue. Once
// per rendered frame, move it to the position of the audio, take the events that are due, and draw its viseme.
//
// It remains valid when a new version of the dialogue replaces the old one: it continues at the same time. For another
// line, start another cursor. docs/guides/playback.md has a table of the results when the time advances, stands still,
// jumps and loops.
typedef struct {
  // The size of this struct in the program that started it. Each function checks it.
  uint32_t size_bytes;
  // The frame at the position of the audio; `LIPZ_WAITING` before it begins, `LIPZ_OVER` from its end on.
  uint32_t frame;
  // The clip.
  uint64_t clip_id;
  // Frames per `fps_denominator` seconds, if the clip has no frame rate.
  uint32_t fps_numerator;
  // Seconds in which `fps_numerator` frames pass, if the clip has no frame rate.
  uint32_t fps_denominator;
  // The viseme type, if the clip has none; 0 if unspecified.
  uint32_t viseme_type;
  // You can set it: how many microseconds the mouth is ahead of the audio. Segments and events stay with the audio.
  uint32_t lead_us;
  // You can set it: the least number of frames for which a consonant shows, at most 255.
  uint32_t hold_frames;
  // You can set it: the speaker, who is the character of events without a name. The `id` of a `lipz_name`.
  uint32_t speaker_id;
  // You can set it: the `bank` of that name. Names of another version are ignored, so set both again after a
  // refresh.
  uint32_t speaker_bank;
  // The frame of the mouth, which is ahead of the audio.
  uint32_t mouth_frame;
  // The first segment whose events have not been due.
  uint32_t next_segment;
  // 1 if those before `next_segment` were due at `frame`; 2 if the clip has looped.
  uint32_t flags;
  // The segment whose events are due next, among those that the last move made due.
  uint32_t due_segment;
  // The first segment that is not due.
  uint32_t due_end;
  // The same for the segments from the start on, after a loop.
  uint32_t due_around_to;
  // The event of `due_segment` that is due next.
  uint32_t due_event;
} lipz_cursor;

// The emotion of a character, and the targets of staring and pointing. A missing name means that no event has set the
// field; keep the state from before the clip.
typedef struct {
  // The name of the character; missing for a speaker without a name in the cursor.
  lipz_name name;
  // The emotion, until changed.
  lipz_name feels;
  // The target, until `stops staring`.
  lipz_name stares_at;
  // The target, until `stops pointing`.
  lipz_name points_at;
} lipz_character;

// A babble profile of a dialogue. Look it up once; queries use `index` and `version`.
typedef struct {
  // Its name: `default` for the project's profile.
  lipz_string name;
  // Its index among the profiles, or `LIPZ_BUILT_IN`.
  uint32_t index;
  // The version of the dialogue.
  uint32_t version;
} lipz_babble;

// The weights of the two mouth movements of babble.
typedef struct {
  // How far the lips are pursed, in ten-thousandths.
  uint32_t ooh;
  // How far the jaw is open, in ten-thousandths.
  uint32_t aah;
} lipz_weights;

// A curve of a clip, in the version of the dialogue in which it was found. The fields are read-only.
typedef struct {
  // Its name: `jawOpen`, `anger`.
  lipz_string name;
  // Number of keys, at least 1 in a verified bank.
  uint32_t key_count;
  // The version of the dialogue. In a different version, queries of the curve return `LIPZ_NONE`.
  uint32_t version;
  // The number of its file.
  uint32_t file;
  // The number of its clip in that file.
  uint32_t slot;
  // Its index among all curves of that file.
  uint32_t place;
  // Frames of its clip per `fps_denominator` seconds.
  uint32_t fps_numerator;
  // Seconds in which `fps_numerator` frames pass.
  uint32_t fps_denominator;
  // 0.
  uint32_t reserved;
} lipz_curve;

// A key of a curve: its value at the start of a frame.
typedef struct {
  // The frame.
  uint32_t frame;
  // The value in thousandths.
  int32_t thousandths;
} lipz_curve_key_t;

// The last key of a curve that was used. Start with zeros: `lipz_curve_cursor cursor = {0}`.
//
// With it, no search for keys is needed while the time advances by a few keys per rendered frame. The values are
// always the same, even after a jump or with a cursor of another curve.
typedef struct {
  // The index of the key.
  uint32_t key;
} lipz_curve_cursor;

// A character of a clip. `mara feels fear` and `mara nods` in its events set curves whose names start with `mara`.
typedef struct {
  // The name as spelled in events: data and length.
  lipz_string name;
  // 1 for the speaker, for whom curves without a name also count. If two curves have the same purpose, the value
  // farther from neutral counts. 0 for other characters.
  uint32_t is_speaker;
} lipz_who;

// The emotions of a character: all zeros for a neutral face.
typedef struct {
  // Values in thousandths, from 0 to 10,000 unless the file exceeds this range: `thousandths[LIPZ_ANGER]`.
  int32_t thousandths[LIPZ_EMOTION_COUNT];
  // The attribute with the highest value, `LIPZ_NEUTRAL` if none is above 0.
  uint32_t strongest;
  // The sum of all values, in thousandths.
  int32_t sum;
} lipz_emotions;

// A face profile of a dialogue. Look it up once; queries use `index` and `version`.
typedef struct {
  // Its name: `default` for the project's profile.
  lipz_string name;
  // Its index among the profiles, or `LIPZ_BUILT_IN`.
  uint32_t index;
  // The version of the dialogue.
  uint32_t version;
} lipz_face_profile;

// The target of a character's eyes: a direction, relative to the head at rest.
typedef struct {
  // How far up it is.
  int32_t pitch;
  // How far to the left of the character it is.
  int32_t yaw;
  // 1 for a person, at whose face, hands and body the eyes look; 0 for a target on which they stay.
  uint32_t is_person;
} lipz_look_at;

// The state of a face at a time, except mouth and emotions. Numbers are in thousandths.
typedef struct {
  // How far the lids are closed, from 0 to 1,000.
  int32_t blink;
  // How far the head is raised.
  int32_t head_pitch;
  // How far the head is turned.
  int32_t head_yaw;
  // How far the head is tilted.
  int32_t head_roll;
  // How far the eyes are raised in the head.
  int32_t eye_pitch;
  // How far the eyes are turned in the head.
  int32_t eye_yaw;
  // How far the brows are raised, from 0 to 1,000. Only curves raise them.
  int32_t brows;
  // A shrug of the face, from 0 to 1,000. Only curves set it.
  int32_t shrug;
  // How hard the character breathes, from 0 to 10,000. Only curves set it.
  int32_t breath;
} lipz_face;

// An articulation profile of a dialogue. Look it up once; queries use `index` and `version`.
typedef struct {
  // Its name: `default` for the project's profile.
  lipz_string name;
  // Its index among the profiles, or `LIPZ_BUILT_IN`.
  uint32_t index;
  // The version of the dialogue.
  uint32_t version;
} lipz_articulation_profile;

// How far jaw, lips and tongue are from rest at a time.
typedef struct {
  // Values in thousandths, from 0 to 1,000: `thousandths[LIPZ_JAW]`.
  uint16_t thousandths[LIPZ_ARTICULATOR_COUNT];
} lipz_articulation;

// A rig of a dialogue: the shapes of a model. Look it up once; queries use `index` and `version`.
typedef struct {
  // Its name: `arkit`.
  lipz_string name;
  // Its index among the rigs.
  uint32_t index;
  // The version of the dialogue.
  uint32_t version;
  // The number of its weights.
  uint32_t weight_count;
  // 0.
  uint32_t reserved;
} lipz_rig;

// The answer was written.
#define LIPZ_OK 0

// The item does not exist: no clip with this id, no text in this locale, no frame at this time. The answer is empty,
// and a viseme is rest.
#define LIPZ_NONE 256

// A required pointer is null.
#define LIPZ_NULL_POINTER 257

// A key, tag or name in the arguments is not UTF-8.
#define LIPZ_NOT_UTF8 258

// The dialogue was not opened.
#define LIPZ_NOT_OPENED 259

// A struct has a different size in this library: the program was compiled with the header of another version, or did
// not start the struct.
#define LIPZ_OTHER_VERSION 260

// The item may be in a missing bank of the set. For a clip, `file` is the number of the bank to supply.
#define LIPZ_ABSENT 261

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the version of the running library, as `major * 1000000 + minor * 1000 + patch`.
uint32_t lipz_version(void);

// Writes an English sentence about the status, without a full stop; `LIPZ_NONE` for unknown numbers.
lipz_status lipz_status_message(lipz_status status, lipz_string *message);

// Writes a summary of the dialogue.
lipz_status lipz_dialogue_info(const lipz_dialogue *dialogue, lipz_dialogue_info_t *info);

// Writes the file with this index. Call it from 0 on until `LIPZ_NONE`.
lipz_status lipz_dialogue_file_by_index(const lipz_dialogue *dialogue, uint32_t index, lipz_file_info *file);

// Writes the entry with this index of a set's index, before the set is opened. Call it from 0 on until `LIPZ_NONE`.
// The first call verifies the index, later ones only open it. In `lipz_dialogue_open`, the contents of all banks
// follow the index, in this order.
lipz_status lipz_set_bank_by_index(const lipz_bytes *contents, uint32_t index, lipz_set_bank *bank);

// Opens the `file_count` files whose contents are at `contents`, from the bottom to the top. The base comes first: a
// bank, or the index of a set followed by all of its banks. Then come patches, each after those below it, and text
// banks, each after the bank of its clips. `files` has room for as many files. Keep `files` at its address, and keep
// the contents, while you use the dialogue. You may copy `dialogue`.
//
// `flags` is 0 or `LIPZ_UNVERIFIED`. `problem` may be null. Unless the status is `LIPZ_OK`, the dialogue is not
// opened.
lipz_status lipz_dialogue_open(lipz_dialogue *dialogue,
                               lipz_file *files,
                               const lipz_bytes *contents,
                               size_t file_count,
                               uint32_t flags,
                               lipz_problem *problem);

// Opens a dialogue of one bank without verifying it: for firmware whose bank was verified when it was packed. The
// library stores the opened bank in `file`. As for `lipz_dialogue_open`, keep `file` and the contents at their
// addresses. Rejects patches, text banks and sets. Unless the status is `LIPZ_OK`, the dialogue is not opened.
lipz_status lipz_dialogue_open_bank(lipz_dialogue *dialogue, lipz_file *file, const lipz_bytes *contents);

// Adds a bank of a set that was missing when the dialogue was opened, by the number of its file. Handles stay valid.
// `files` is the argument of `lipz_dialogue_open`. Do not call other functions at the same time.
//
// `LIPZ_NONE` if the file is already loaded, or is not a bank of the set.
lipz_status lipz_dialogue_supply(lipz_dialogue *dialogue,
                                 lipz_file *files,
                                 uint32_t number,
                                 const lipz_bytes *contents,
                                 uint32_t flags,
                                 lipz_problem *problem);

// Writes the key of a clip: the path of its Lipz file below the source root, without extension.
lipz_status lipz_clip_key(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_string *key);

// Writes the frame codes of a clip, one byte per frame.
lipz_status lipz_clip_frames(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_string *frames);

// Writes the frame at a time.
lipz_status lipz_clip_frame_at(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_time time, uint32_t *frame);

// Writes the viseme of a frame, or rest outside the clip.
lipz_status lipz_clip_viseme(const lipz_dialogue *dialogue, const lipz_clip *clip, uint32_t frame, lipz_viseme *viseme);

// Writes the viseme at a time, or rest while the character does not speak.
lipz_status lipz_clip_viseme_at(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_time time, lipz_viseme *viseme);

// Writes the segment of a clip with this index.
lipz_status lipz_clip_segment(const lipz_dialogue *dialogue, const lipz_clip *clip, uint32_t index, lipz_segment *segment);

// Writes the segment at a time.
lipz_status lipz_clip_segment_at(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_time time, lipz_segment *segment);

// Writes the first microsecond of a frame. For frame `frame_count`, it is the length of the clip; for frame 1, the
// `lead_us` of a cursor that leads by one frame. `LIPZ_NONE` without a frame rate.
lipz_status lipz_clip_start_of_frame_us(const lipz_dialogue *dialogue, const lipz_clip *clip, uint32_t frame, uint64_t *time_us);

// Writes the `hold_frames` of a cursor for a display with rendered frames of this length in microseconds. Every
// consonant with enough room is then in at least one. For 0, writes two frames at 24 fps, the minimum that can be
// read. `LIPZ_NONE` without a frame rate.
lipz_status lipz_clip_hold_frames(const lipz_dialogue *dialogue,
                                  const lipz_clip *clip,
                                  uint32_t rendered_frame_us,
                                  uint32_t *hold_frames);

// Writes the bank's data about the recording of a clip. `LIPZ_NONE` if the bank was packed without recordings, or the
// clip had no recording.
lipz_status lipz_clip_recording(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_recording *recording);

// Writes the clip as played in `voice`: its dub, or the dub in a voice that this one falls back to, or the original.
// The clip may be the original or any of its dubs. With a voice of another version, writes the clip itself.
lipz_status lipz_clip_in_voice(const lipz_dialogue *dialogue,
                               const lipz_clip *clip,
                               const lipz_voice *voice,
                               lipz_voiced_clip *voiced);

// Writes the voice of the recording that a clip was made for. `LIPZ_NONE` without dubs.
lipz_status lipz_clip_voice(const lipz_dialogue *dialogue, const lipz_clip *clip, lipz_voice *voice);

// Writes the id of the clip with this key. It never changes: `lipz ids --lang c` writes the ids of all clips as
// constants.
lipz_status lipz_clip_id_of_key(const char *key, size_t key_length_bytes, uint64_t *id);

// Writes the clip with this id, from the topmost file that has it. `LIPZ_ABSENT` if the clip would be in a missing
// bank of a set: `file` of the clip is then the number of the file to supply.
lipz_status lipz_dialogue_clip(const lipz_dialogue *dialogue, uint64_t id, lipz_clip *clip);

// Writes the clip with this key, which is compared in full; otherwise like `lipz_dialogue_clip`.
lipz_status lipz_dialogue_clip_by_key(const lipz_dialogue *dialogue, const char *key, size_t key_length_bytes, lipz_clip *clip);

// Writes the next clip whose key starts with `prefix`, file by file, ordered by key in each. An empty prefix matches
// all clips. `position` stores the progress, and is 0 at the start. `LIPZ_NONE` after the last clip.
lipz_status lipz_dialogue_next_clip(const lipz_dialogue *dialogue,
                                    const char *prefix,
                                    size_t prefix_length_bytes,
                                    uint64_t *position,
                                    lipz_clip *clip);

// Writes the display text of a segment in a locale, or in its fallback locale. `LIPZ_NONE` if neither has a text for
// this clip, and for a locale of another version. A segment of an existing text may be empty.
lipz_status lipz_segment_text(const lipz_dialogue *dialogue,
                              const lipz_segment *segment,
                              const lipz_locale *locale,
                              lipz_text *text);

// Writes the event string of a segment, trimmed and otherwise as in the Lipz file. Empty if there are no events in
// this segment; `LIPZ_NONE` if the file has no events.
lipz_status lipz_segment_event_string(const lipz_dialogue *dialogue, const lipz_segment *segment, lipz_string *string);

// Writes the typed event of a segment with this index. Call it from 0 on until `LIPZ_NONE`. An event string in a
// different syntax, such as a script, has no typed events.
lipz_status lipz_segment_event(const lipz_dialogue *dialogue, const lipz_segment *segment, uint32_t index, lipz_event *event);

// Writes the locale with this tag, spelled as in the files, or the default locale if `tag` is null. `LIPZ_ABSENT` if
// no bank of a set is loaded.
lipz_status lipz_dialogue_locale(const lipz_dialogue *dialogue, const char *tag, size_t tag_length_bytes, lipz_locale *locale);

// Writes the locale with this index. Call it from 0 on until `LIPZ_NONE`.
lipz_status lipz_dialogue_locale_by_index(const lipz_dialogue *dialogue, uint32_t index, lipz_locale *locale);

// Writes the locale for texts of a variant: for `pl-pl` and the key `few`, the texts of `text_pl-pl-x-few` in Lipz
// files. A key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names
// from the end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip
// has any of these, the answer is the locale itself. Look variants up once per locale.
lipz_status lipz_dialogue_variant(const lipz_dialogue *dialogue,
                                  const lipz_locale *locale,
                                  const char *key,
                                  size_t key_length_bytes,
                                  lipz_locale *variant);

// Writes the voice in this locale, spelled as in the files. `LIPZ_NONE` if there are no dubs, or if the project does
// not define this voice: play the clips unchanged. `LIPZ_ABSENT` if it is not found while a bank of a set is missing,
// because a bank without dubs lists no voices.
lipz_status lipz_dialogue_voice(const lipz_dialogue *dialogue, const char *tag, size_t tag_length_bytes, lipz_voice *voice);

// Writes the voice with this index, that of the originals first. Call it from 0 on until `LIPZ_NONE`.
lipz_status lipz_dialogue_voice_by_index(const lipz_dialogue *dialogue, uint32_t index, lipz_voice *voice);

// Writes the name as spelled in events, for the speaker of a cursor. In a set, only loaded banks are searched.
lipz_status lipz_dialogue_event_name(const lipz_dialogue *dialogue, const char *name, size_t name_length_bytes, lipz_name *found);

// Starts a cursor that waits for the audio of `clip` to begin. `size_bytes` is `sizeof(lipz_cursor)`: if the size
// differs in the running library, the status is `LIPZ_OTHER_VERSION`, and nothing is written.
//
// `LIPZ_NONE` if there is no such clip, or if it has no frame rate: set one in `clip`. The cursor stores the frame
// rate and the viseme type of `clip`, and uses them where the dialogue has none.
lipz_status lipz_cursor_new(const lipz_dialogue *dialogue, const lipz_clip *clip, size_t size_bytes, lipz_cursor *cursor);

// Moves the cursor to the audio position `time`. The events of the segments that have begun since the last call are
// due. A time before that of the last call makes nothing due, and nothing is due again until the audio is past the
// point that it had reached, because clocks jitter.
lipz_status lipz_cursor_advance(const lipz_dialogue *dialogue, lipz_cursor *cursor, lipz_time time);

// Moves the cursor after the audio has jumped from its end to its start, and then reached `time`. The remaining
// segments are due, then those that have begun since. Call it once per loop. Emotions, stares and pointing last beyond
// the end of the clip.
lipz_status lipz_cursor_loop(const lipz_dialogue *dialogue, lipz_cursor *cursor, lipz_time time);

// Jumps to `time`, forward or back. Nothing is due; the next advance starts with the segments that begin in the frame
// of this time. States are as if the clip had been played once from its start to here.
lipz_status lipz_cursor_seek(const lipz_dialogue *dialogue, lipz_cursor *cursor, lipz_time time);

// Ends the clip before the audio ends, as when a player skips it. The remaining segments become due, so that lasting
// states take effect.
lipz_status lipz_cursor_finish(const lipz_dialogue *dialogue, lipz_cursor *cursor);

// Takes the next event that is due: those of the segments that have begun since the last move, in order, each once,
// including empty segments. Events without a character are the speaker's. Call it after each move until `LIPZ_NONE`:
// events that are not taken before the next move are lost.
lipz_status lipz_cursor_take_event(const lipz_dialogue *dialogue, lipz_cursor *cursor, lipz_event *event);

// Takes the next segment that is due, with all its events: for event strings in other syntaxes than that of
// `lipz_cursor_take_event`. `LIPZ_NONE` when all are taken.
lipz_status lipz_cursor_take_segment(const lipz_dialogue *dialogue, lipz_cursor *cursor, lipz_segment *segment);

// Writes the viseme to draw, with lead and hold, or rest before the start and from the end on.
lipz_status lipz_cursor_viseme(const lipz_dialogue *dialogue, const lipz_cursor *cursor, lipz_viseme *viseme);

// Writes how far that mouth is open, in ten-thousandths. `LIPZ_NONE` if the clip has no frames or no viseme type: let
// the mouth babble.
lipz_status lipz_cursor_openness(const lipz_dialogue *dialogue, const lipz_cursor *cursor, uint32_t *ten_thousandths);

// Writes the segment of the subtitle to show. `LIPZ_NONE` before the start and from the end on.
lipz_status lipz_cursor_segment(const lipz_dialogue *dialogue, const lipz_cursor *cursor, lipz_segment *segment);

// Writes the emotion of `name`, and the targets of staring and pointing, after the events that were due or were jumped
// over. The speaker if `name` is null or missing. `LIPZ_NONE` for a name of another version.
//
// Each call evaluates the events again, in a time that grows with their number.
lipz_status lipz_cursor_character(const lipz_dialogue *dialogue,
                                  const lipz_cursor *cursor,
                                  const lipz_name *name,
                                  lipz_character *character);

// Writes the character with this index among those in the events of the clip, including future events, with its state.
// To set the scene after a jump, call it from 0 on until `LIPZ_NONE`. Characters are ordered by name.
lipz_status lipz_cursor_character_by_index(const lipz_dialogue *dialogue,
                                           const lipz_cursor *cursor,
                                           uint32_t index,
                                           lipz_character *character);

// Writes the babble profile with this name. If `name` is null, writes the project's profile (`[babble]` in its
// settings), or the viewer's own if the project has none.
lipz_status lipz_dialogue_babble(const lipz_dialogue *dialogue, const char *name, size_t name_length_bytes, lipz_babble *babble);

// Writes how far lips and jaw have moved at a time since the start of speech, at a `power` of the voice from 0 to 1.
// All zeros before 0. `LIPZ_NONE` for a profile of another version.
lipz_status lipz_babble_at(const lipz_dialogue *dialogue,
                           const lipz_babble *babble,
                           lipz_time time,
                           float power,
                           lipz_weights *weights);

// `lipz_babble_at` without floating point: `level` is the power in 65,536ths, at most 65,535, or `LIPZ_UNMEASURED`.
lipz_status lipz_babble_at_level(const lipz_dialogue *dialogue,
                                 const lipz_babble *babble,
                                 lipz_time time,
                                 uint32_t level,
                                 lipz_weights *weights);

// Writes the curve of a clip with this name. `LIPZ_NONE` if it has none.
lipz_status lipz_clip_curve(const lipz_dialogue *dialogue,
                            const lipz_clip *clip,
                            const char *name,
                            size_t name_length_bytes,
                            lipz_curve *curve);

// Writes the curve of a clip with this index, ordered by name. Call it from 0 on until `LIPZ_NONE`.
lipz_status lipz_clip_curve_by_index(const lipz_dialogue *dialogue, const lipz_clip *clip, uint32_t index, lipz_curve *curve);

// Writes the key of a curve with this index, a number below its `key_count`.
lipz_status lipz_curve_key(const lipz_dialogue *dialogue, const lipz_curve *curve, uint32_t index, lipz_curve_key_t *key);

// Writes the value of a curve at the start of a frame, in thousandths.
lipz_status lipz_curve_value(const lipz_dialogue *dialogue, const lipz_curve *curve, uint32_t frame, int32_t *thousandths);

// Writes the value of a curve at a time, in thousandths. `LIPZ_NONE` without a frame rate. `cursor` may be null; with
// one, a rendered frame needs no search for keys.
lipz_status lipz_curve_value_at(const lipz_dialogue *dialogue,
                                const lipz_curve *curve,
                                lipz_time time,
                                lipz_curve_cursor *cursor,
                                int32_t *thousandths);

// Writes the emotions of a character of a clip at a time, or the speaker's if `who` is null. Neutral without curves,
// and without a frame rate.
lipz_status lipz_clip_emotions_at(const lipz_dialogue *dialogue,
                                  const lipz_clip *clip,
                                  lipz_time time,
                                  const lipz_who *who,
                                  lipz_emotions *emotions);

// Writes the face profile with this name. If `name` is null, writes the project's profile (`[face]` in its settings),
// or the default one if the project has none.
lipz_status lipz_dialogue_face_profile(const lipz_dialogue *dialogue,
                                       const char *name,
                                       size_t name_length_bytes,
                                       lipz_face_profile *profile);

// Writes the face of a character of a clip at a time, generated from `profile`, or the speaker's if `who` is null.
// Curves of the clip override generated values. A null `profile` stands for the project's, and a null `look_at` for a
// person straight ahead. `LIPZ_NONE` for a profile of another version.
lipz_status lipz_clip_face_at(const lipz_dialogue *dialogue,
                              const lipz_clip *clip,
                              lipz_time time,
                              const lipz_who *who,
                              const lipz_face_profile *profile,
                              const lipz_look_at *look_at,
                              lipz_face *face);

// Writes the face of a silent character, who blinks and looks. `time` may start anywhere. Give each character a
// different `seed`, so that they do not blink at the same time. The other arguments are those of `lipz_clip_face_at`.
lipz_status lipz_face_idle_at(const lipz_dialogue *dialogue,
                              lipz_time time,
                              uint64_t seed,
                              const lipz_face_profile *profile,
                              const lipz_look_at *look_at,
                              lipz_face *face);

// Writes the articulation profile with this name. If `name` is null, writes the project's profile (`[articulation]` in
// its settings), or the default one if the project has none.
lipz_status lipz_dialogue_articulation_profile(const lipz_dialogue *dialogue,
                                               const char *name,
                                               size_t name_length_bytes,
                                               lipz_articulation_profile *profile);

// Writes the articulation of a clip at a time, computed from its phones, or from its visemes if it has no phones.
// Curves of the clip override computed values. A null `profile` stands for the project's. `LIPZ_NONE` for a profile of
// another version.
lipz_status lipz_clip_articulation_at(const lipz_dialogue *dialogue,
                                      const lipz_clip *clip,
                                      lipz_time time,
                                      const lipz_articulation_profile *profile,
                                      lipz_articulation *articulation);

// Writes the rig with this name. `LIPZ_NONE` if the project's settings do not name it in `[rig]`.
lipz_status lipz_dialogue_rig(const lipz_dialogue *dialogue, const char *name, size_t name_length_bytes, lipz_rig *rig);

// Writes the name of a weight of a rig. `LIPZ_NONE` for an index from `weight_count` on.
lipz_status lipz_rig_weight_name(const lipz_dialogue *dialogue, const lipz_rig *rig, uint32_t index, lipz_string *name);

// Writes the weights of a rig in thousandths, in the order of their names, to `thousandths`, and zeros from the last one
// to `capacity`. Null `emotions` and a null `face` stand for a neutral face.
lipz_status lipz_rig_weights(const lipz_dialogue *dialogue,
                             const lipz_rig *rig,
                             const lipz_articulation *articulation,
                             const lipz_emotions *emotions,
                             const lipz_face *face,
                             int32_t *thousandths,
                             size_t capacity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus


// Returns a time in microseconds.
static inline lipz_time lipz_time_us(int64_t us) {
  lipz_time time = {us, 0, 0};
  return time;
}

// Returns a time in samples per channel, at a sample rate.
static inline lipz_time lipz_time_samples(int64_t position, uint32_t rate_hz) {
  // Without a valid rate, the time is before the start.
  int is_rate = rate_hz > 0 && rate_hz < LIPZ_SECONDS_F32;
  lipz_time time = {is_rate ? position : -1, is_rate ? rate_hz : 0, 0};
  return time;
}

// Returns a time in seconds.
static inline lipz_time lipz_time_seconds(double seconds) {
  lipz_time time = {0, LIPZ_SECONDS, 0};
  memcpy(&time.count, &seconds, sizeof seconds);
  return time;
}

// Returns a time in seconds, from a clock without `double`.
static inline lipz_time lipz_time_seconds_f32(float seconds) {
  uint32_t bits;
  lipz_time time = {0, LIPZ_SECONDS_F32, 0};
  memcpy(&bits, &seconds, sizeof bits);
  time.count = bits;
  return time;
}

#endif  // LIPZ_H
