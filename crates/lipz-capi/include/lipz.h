/*
 * lipz.h - reads lipz dialogue banks in place. https://github.com/lipz/lipz
 *
 * MIT OR Apache-2.0. Written by `LIPZ_BLESS=1 cargo test -p lipz-capi --test header` from the code.
 * docs/C.md shows how to use it.
 *
 * Contract: a pointer is null or leads to a value of its type, or to as many bytes as the length
 * beside it says; that holds for the pointers in a lipz_bank and a lipz_who, too, for as long as the bank and
 * strings from it are used. Nobody writes to those bytes meanwhile, and answers do not overlap arguments.
 *
 * Everything else is total: no function crashes, reads out of bounds or loops without end, whatever the
 * bytes of the bank and the numbers in the structs are. Each returns a status, and writes an
 * empty answer (zeros, null, the viseme at rest) unless that is LIPZ_OK. All may be called from several
 * threads at once.
 */

#ifndef LIPZ_H
#define LIPZ_H

#include <stddef.h>
#include <stdint.h>

// Damage: the file is shorter than the header of a bank.
#define LIPZ_TOO_SHORT 1

// Damage: the file is not a lipz bank.
#define LIPZ_NOT_A_BANK 2

// Damage: the bank was damaged by a copy in text mode (line endings were converted).
#define LIPZ_TEXT_MODE 3

// Damage: the bank has a format version that this reader does not know.
#define LIPZ_UNSUPPORTED_VERSION 4

// Damage: the file is not as long as its header says (cut off, or something was appended).
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

// Damage: the frames of a clip are not where they belong.
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

// Damage: the file has texts only, for the clips of another bank.
#define LIPZ_TEXTS_ONLY 29

// Damage: a typed event is not valid.
#define LIPZ_TYPED_EVENT 30

// Damage: the names in events are not listed in their order.
#define LIPZ_EVENT_NAME 31

// Damage: a babble profile is not valid.
#define LIPZ_BABBLE 32

// Damage: the bank of the texts was not verified.
#define LIPZ_BANK_NOT_VERIFIED 33

// Damage: what the bank says about a recording is not valid.
#define LIPZ_RECORDING 34

// Damage: a curve is not valid.
#define LIPZ_CURVE 35

// Damage: what the layer says about the banks below it is not valid.
#define LIPZ_LAYER 36

// Damage: the layer was made over other banks than those below it.
#define LIPZ_OTHER_BASE 37

// Damage: the bank is not a layer: it was not packed over another bank.
#define LIPZ_NOT_A_LAYER 38

// Damage: there is no bank, or there are more than the program has room for.
#define LIPZ_LAYER_COUNT 39

// Damage: a voice or a dub is not valid.
#define LIPZ_VOICE 40

// Damage: a face profile is not valid.
#define LIPZ_FACE 41

// Damage: the file is not the index of a set of banks.
#define LIPZ_NOT_A_SET 42

// Damage: what the index of a set says about its banks is not valid.
#define LIPZ_SET 43

// Damage: the banks are not those of the set, in their order.
#define LIPZ_OTHER_BANK 44



// Version of this header: changes of the first number break programs; so do, while it is 0, those
// of the second.
#define LIPZ_VERSION_MAJOR 0

// Second number of the version.
#define LIPZ_VERSION_MINOR 1

// Third number of the version.
#define LIPZ_VERSION_PATCH 0

// How many words the places of the sections take.
#define LIPZ_PLACE_WORDS 34

// Viseme type: Preston Blair's chart, `-AMOSWEFLU`.
#define LIPZ_BLAIR 1

// Viseme type: Toon Boom's chart, `-ABCDEFG`.
#define LIPZ_TOONBOOM 2

// Viseme type: loudness, `-0123456789`.
#define LIPZ_RMS 3

// Verb: `feels emotion`, lasts until changed.
#define LIPZ_FEELS 1

// Verb: `sees target`, a character or a prop, for a moment.
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

// Verb: `nods`, as far as the number says that is the object, 0 to 10; no name if there is none.
#define LIPZ_NODS 8

// Verb: `shakes`, the head, with a number as `LIPZ_NODS`.
#define LIPZ_SHAKES 9

// Verb: `breathes`, with a number as `LIPZ_NODS`.
#define LIPZ_BREATHES 10

// Verb: `blinks`.
#define LIPZ_BLINKS 11

// Verb: `looks away`.
#define LIPZ_LOOKS_AWAY 12

// The `id` where there is no name.
#define LIPZ_NO_NAME 4294967295

// In place of a frame: the sound is past the last one. All events of the clip have been due.
#define LIPZ_OVER 4294967295

// In place of a frame: the sound has not begun.
#define LIPZ_WAITING 4294967294

// The `index` of the Second Life viewer's own profile, which needs no bank.
#define LIPZ_BUILT_IN 4294967295

// The level of a voice that nobody measures: three quarters, where all digits of the viewer's profile show, but not at
// their widest.
#define LIPZ_UNMEASURED 49152

// Attribute of emotion: `sadness`, place in `thousandths`.
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

// How many attributes of emotion there are.
#define LIPZ_EMOTION_COUNT 12

// `strongest` of a neutral face.
#define LIPZ_NEUTRAL 4294967295

// What is played is the original: the line is not dubbed, or the original was asked for.
#define LIPZ_ORIGINAL 0

// What is played is the dub in the voice that was asked for.
#define LIPZ_DUB 1

// What is played is the dub in another voice, which the one that was asked for falls back to.
#define LIPZ_OTHER_DUB 2

// In place of a layer: there is none.
#define LIPZ_NO_LAYER UINT32_MAX

// What became of a call: `LIPZ_OK`, one of the other numbers from 256 on, or the kind of damage
// that was found in a bank, from 1 to 255. Numbers are never given a new meaning.
typedef uint32_t lipz_status;

// A string in UTF-8, without terminator: it stands in the bytes of the bank and lives as long as
// they do. It may contain U+0000.
typedef struct lipz_string {
  // The first byte; null only if there is no string.
  const char *data;
  // Length in bytes.
  size_t length_bytes;
} lipz_string;

// An opened bank: the caller's bytes, and beside them those of a text bank, if one is used. It owns
// nothing: copy it, keep it, forget it.
typedef struct lipz_bank {
  // The bytes of the bank, at any address: a mapped file, ROM, memory.
  const uint8_t *data;
  // Length of the bank.
  size_t length_bytes;
  // The bytes of the text bank that has the locales; null if they are those of the bank itself.
  const uint8_t *texts;
  // Length of the text bank.
  size_t texts_length_bytes;
  // Where `lipz_bank_open` has found the sections, and the checksum of the bank. Each query looks whether the bytes
  // still have this checksum, and whether the places lie in them.
  uint32_t places[LIPZ_PLACE_WORDS];
} lipz_bank;

// What a bank has.
typedef struct lipz_bank_info_t {
  // Hash of what the clips are: a bank and its text banks share it.
  uint64_t fingerprint;
  // Number of clips: their slots are the numbers below it.
  uint32_t clip_count;
  // Number of locales: those of the text bank, if one is used.
  uint32_t locale_count;
  // Major format version.
  uint32_t format_major;
  // Minor format version.
  uint32_t format_minor;
} lipz_bank_info_t;

// One spoken line.
//
// Queries go by `id`, and take the frame rate from here only where the bank has none. The other
// fields are there to be read.
typedef struct lipz_clip {
  // Hash of the key: names the clip within its bank.
  uint64_t id;
  // Place of the clip in the bank, for `lipz_clip_at`.
  uint32_t slot;
  // Number of frames.
  uint32_t frame_count;
  // Number of segments, at least 1 in a verified bank.
  uint32_t segment_count;
  // Frames in `fps_denominator` seconds, in lowest terms; 0 if unspecified. Set both to supply it:
  // from 1 to 1000 frames per second.
  uint32_t fps_numerator;
  // Seconds in which `fps_numerator` frames pass; 0 if unspecified.
  uint32_t fps_denominator;
  // `LIPZ_BLAIR`, `LIPZ_TOONBOOM`, `LIPZ_RMS`; 0 if unspecified.
  uint32_t viseme_type;
  // 1 if the Lipz file has visemes. Without them there are no frames, and segments have no times.
  uint32_t has_visemes;
  // 1 if the Lipz file has events.
  uint32_t has_events;
} lipz_clip;

// A mouth shape: its Lipz code, an ASCII character in any bank that passes verification. Rest is `-`.
typedef uint8_t lipz_viseme;

// The recording that a clip was made for: how long it is, and what is in its file. Compare it with the sound
// that is about to be played.
typedef struct lipz_recording {
  // Length in microseconds, rounded to the nearest.
  uint64_t length_us;
  // XXH3, 64 bits with seed 0, of all bytes of the file: what `XXH3_64bits` of xxHash gives.
  uint64_t content_hash;
} lipz_recording;

// A stretch of a clip, between two `|` of its Lipz file. Queries go by `clip_id` and `index`.
typedef struct lipz_segment {
  // The clip that this is a segment of.
  uint64_t clip_id;
  // Place of the segment in its clip, from 0.
  uint32_t index;
  // Its first frame.
  uint32_t start_frame;
  // The frame behind its last one.
  uint32_t end_frame;
  // Zero; keeps the size the same on all machines.
  uint32_t reserved;
} lipz_segment;

// A locale of a bank. Look it up once; queries go by `index` and `bank`. With another bank, another text bank or
// another version of one, it leads to `LIPZ_NONE`: look it up again.
typedef struct lipz_locale {
  // Its tag, as in `text_en-us` of a Lipz file: `en-us`.
  struct lipz_string tag;
  // Its place among the locales, which are in the order of their tags.
  uint32_t index;
  // 1 for the default locale that was set when the bank was packed.
  uint32_t is_default;
  // Tells the bank and the text bank that the locale is of apart from others.
  uint32_t bank;
} lipz_locale;

// A display text, as a player sees it: UTF-8 without terminator, in the bytes of the bank.
typedef struct lipz_text {
  // The first byte; null only if there is no text.
  const char *data;
  // Length in bytes.
  size_t length_bytes;
  // 1 if the clip has no text of its own in the locale, and this is that of another one.
  uint32_t is_fallback;
} lipz_text;

// A name that events mention: a character, an emotion, a target or an action.
typedef struct lipz_name {
  // The name as it is spelled in the Lipz file.
  struct lipz_string name;
  // Its number in this bank: equal names have equal numbers. `LIPZ_NO_NAME` if there is none. In another bank,
  // and in another version of this one, the number is another name's.
  uint32_t id;
  // Tells the bank that the name is of apart from others; 0 if there is no name.
  uint32_t bank;
} lipz_name;

// One event of Character Event Syntax: `[character] verb object`.
typedef struct lipz_event {
  // Who; no name for the speaker of the clip.
  struct lipz_name character;
  // The emotion, target or action, or the number of a gesture, as it is written; no name where there is none.
  struct lipz_name object;
  // `LIPZ_FEELS` and so on.
  uint32_t verb;
} lipz_event;

// Where a clip is while it is played: a plain struct of numbers, which a program keeps beside its bank. Once per
// picture, move it to the position of the sound, take the events that are due, and draw what it shows.
//
// It remains right when a newer bank replaces the old one: it goes on at the same time. For another line, start
// another cursor. docs/PLAYBACK.md has a table of what happens when time goes on, stands still, jumps and loops.
typedef struct lipz_cursor {
  // Size of this struct where it was started; each function looks at it.
  uint32_t size_bytes;
  // The frame at the position of the sound; `LIPZ_WAITING` before it begins, `LIPZ_OVER` from its end on.
  uint32_t frame;
  // The clip.
  uint64_t clip_id;
  // Frames in `fps_denominator` seconds, if the bank does not say.
  uint32_t fps_numerator;
  // Seconds in which `fps_numerator` frames pass, if the bank does not say.
  uint32_t fps_denominator;
  // The viseme type, if the bank does not say; 0 for none.
  uint32_t viseme_type;
  // Set it: how many microseconds mouth shapes are ahead of the sound. Segments and events stay with the sound.
  uint32_t lead_us;
  // Set it: how many frames a consonant shows at least; at most 255.
  uint32_t hold_frames;
  // Set it: who speaks, so whose events name no character: the `id` of a `lipz_name`.
  uint32_t speaker_id;
  // Set it: the `bank` of that name. The names of another bank are nobody's: set both again when it is replaced.
  uint32_t speaker_bank;
  // The frame that the mouth shows, which is ahead of the sound.
  uint32_t mouth_frame;
  // The first segment whose events have not been due.
  uint32_t next_segment;
  // 1 if those before `next_segment` were due at `frame`; 2 if the clip has looped.
  uint32_t flags;
  // The segment whose events are due next, of those that the last move has made due.
  uint32_t due_segment;
  // The first segment that is not due.
  uint32_t due_end;
  // The same, from the start on after a loop.
  uint32_t due_around_to;
  // The event of `due_segment` that is due next.
  uint32_t due_event;
} lipz_cursor;

// What a character feels, stares and points at. No name where no event has said anything: it is as it was before the
// clip.
typedef struct lipz_character {
  // Who; no name for a speaker that the cursor does not know.
  struct lipz_name name;
  // The emotion, until changed.
  struct lipz_name feels;
  // The target, until `stops staring`.
  struct lipz_name stares_at;
  // The target, until `stops pointing`.
  struct lipz_name points_at;
} lipz_character;

// A babble profile of a bank. Look it up once; queries go by `index` and `bank`.
typedef struct lipz_babble {
  // Its name: `default` for that of the project.
  struct lipz_string name;
  // Its place among the profiles, or `LIPZ_BUILT_IN`.
  uint32_t index;
  // Tells the bank that the profile is of apart from others.
  uint32_t bank;
} lipz_babble;

// What moves the mouth while somebody babbles.
typedef struct lipz_weights {
  // How far the lips are pursed, in ten-thousandths.
  uint32_t ooh;
  // How far the jaw is open, in ten-thousandths.
  uint32_t aah;
} lipz_weights;

// A curve of a clip. Queries go by `place` and `bank`; the other fields are there to be read.
typedef struct lipz_curve {
  // Its name: `jawOpen`, `anger`.
  struct lipz_string name;
  // Its place among all curves of the bank.
  uint32_t place;
  // Number of keys, at least 1 in a verified bank.
  uint32_t key_count;
  // Tells the bank that the curve is of apart from others: asked of another one, also of a newer version, a curve gives
  // `LIPZ_NONE`.
  uint32_t bank;
} lipz_curve;

// A key of a curve: its value at the start of a frame.
typedef struct lipz_curve_key {
  // The frame.
  uint32_t frame;
  // The value in thousandths.
  int32_t thousandths;
} lipz_curve_key;

// Which key of a curve was needed last. Start with zeros: `lipz_curve_cursor cursor = {0}`.
//
// With it, no key is searched for as long as time moves on by a few keys per picture. The answers are the same, also
// after a jump, and with a cursor of another curve.
typedef struct lipz_curve_cursor {
  // The key, by its index.
  uint32_t key;
} lipz_curve_cursor;

// What a character feels: all zeros for a neutral face.
typedef struct lipz_emotions {
  // Values in thousandths, 0 to 10,000 where the file says nothing else: `thousandths[LIPZ_ANGER]`.
  int32_t thousandths[LIPZ_EMOTION_COUNT];
  // The attribute with the highest value, `LIPZ_NEUTRAL` if none is above 0.
  uint32_t strongest;
  // The sum of all values, in thousandths.
  int32_t sum;
} lipz_emotions;

// A character of a clip: `mara feels fear` and `mara nods` in its events are about mara, and in curves with this name in front.
typedef struct lipz_who {
  // The name as events have it: data and length.
  struct lipz_string name;
  // 1 for the speaker: then curves without a name are about them, too. Of two for the same, that one counts which is farther
  // from neutral. 0 for somebody else.
  uint32_t is_speaker;
} lipz_who;

// A face profile of a bank. Look it up once; queries go by `index` and `bank`.
typedef struct lipz_face_profile {
  // Its name: `default` for that of the project.
  struct lipz_string name;
  // Its place among the profiles, or `LIPZ_BUILT_IN`.
  uint32_t index;
  // Tells the bank that the profile is of apart from others.
  uint32_t bank;
} lipz_face_profile;

// What somebody looks at: a direction, as seen from the head at rest.
typedef struct lipz_look_at {
  // How far up it is.
  int32_t pitch;
  // How far to the left of the character it is.
  int32_t yaw;
  // 1 for a person, over whose face, hands and body the eyes go; 0 for something that they stay on.
  uint32_t is_person;
} lipz_look_at;

// What a face does at a time, besides its mouth and its emotions. Numbers are in thousandths.
typedef struct lipz_face {
  // How far the lids are closed: 0 to 1,000.
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
  // How far the brows are raised: 0 to 1,000. Only curves raise them.
  int32_t brows;
  // A shrug of the face, 0 to 1,000. Only curves make one.
  int32_t shrug;
  // How hard somebody breathes: 0 to 10,000. Only curves say so.
  int32_t breath;
} lipz_face;

// A clip as it is played in a voice.
typedef struct lipz_voiced_clip {
  // The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
  struct lipz_clip clip;
  // `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
  uint32_t spoken;
  // 0.
  uint32_t reserved;
} lipz_voiced_clip;

// A clip of a stack. Ask the bank `banks[layer]` about `clip`: mouths, segments, events, curves, a cursor. Texts are those of
// `lipz_layers_text`.
typedef struct lipz_layered_clip {
  // The clip in its own bank.
  struct lipz_clip clip;
  // Index of that bank.
  uint32_t layer;
  // Index of the bank that has the texts; `LIPZ_NO_LAYER` if none has any.
  uint32_t texts_layer;
  // The id that the clip with the texts has there: that of this clip, or of its original, if it is a dub.
  uint64_t texts_id;
} lipz_layered_clip;

// A locale of a stack in one of its banks.
typedef struct lipz_layered_locale {
  // The locale of that bank whose texts show.
  struct lipz_locale locale;
  // 1 if it is another locale, which stands in for the one that was asked for.
  uint32_t is_stand_in;
} lipz_layered_locale;

// Which banks of a stack say what is said once.
typedef struct lipz_layers_info_t {
  // Index of the bank whose babble profiles count.
  uint32_t babble_layer;
  // Index of the bank whose default locale counts.
  uint32_t default_locale_layer;
  // Index of the bank whose face profiles count.
  uint32_t faces_layer;
} lipz_layers_info_t;

// A clip of a stack as it is played in a voice.
typedef struct lipz_layered_voiced_clip {
  // The clip: its mouth, its times, its texts and its events are those of the recording in that voice.
  struct lipz_layered_clip clip;
  // `LIPZ_ORIGINAL`, `LIPZ_DUB` or `LIPZ_OTHER_DUB`.
  uint32_t spoken;
  // 0.
  uint32_t reserved;
} lipz_layered_voiced_clip;

// The index of a set: the caller's bytes. It owns nothing: copy it, keep it, forget it.
typedef struct lipz_set {
  // The bytes of the index, at any address.
  const uint8_t *data;
  // Length of the index.
  size_t length_bytes;
} lipz_set;

// What a set has.
typedef struct lipz_set_info_t {
  // Hash of what the clips of all banks are.
  uint64_t fingerprint;
  // Number of clips in all banks.
  uint64_t clip_count;
  // Number of banks.
  uint32_t bank_count;
  // Number of clips that are not in the bank of their id, but in that of their line: dubs.
  uint32_t moved_count;
} lipz_set_info_t;

// What the index says about a bank.
typedef struct lipz_set_bank {
  // The name of its file, which is beside the index.
  struct lipz_string file_name;
  // The checksum of the bank.
  uint64_t checksum;
  // Its fingerprint.
  uint64_t fingerprint;
  // Its length.
  uint32_t length_bytes;
  // Number of its clips.
  uint32_t clip_count;
} lipz_set_bank;

// The answer was written.
#define LIPZ_OK 0

// There is no such thing: no clip with this id, no text in this locale, no frame at this time. The
// answer is empty, a viseme rest.
#define LIPZ_NONE 256

// A pointer is null that must not be.
#define LIPZ_NULL_POINTER 257

// A key, tag or name that was asked for is not UTF-8.
#define LIPZ_NOT_UTF8 258

// The bytes of a bank are not those that it was opened with: another length, or another checksum in their header. Open
// it again.
#define LIPZ_NOT_OPENED 259

// A struct has another size than in this library: the program was compiled with the header of another version, or
// never started the struct.
#define LIPZ_OTHER_VERSION 260

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library that runs, as `major * 1000000 + minor * 1000 + patch`.
uint32_t lipz_version(void);

// A status in one English sentence, without full stop; `LIPZ_NONE` for numbers that are no status.
lipz_status lipz_status_message(lipz_status status, struct lipz_string *message);

// Opens the bank that fills `length_bytes` bytes at `data`: checks header and directory, in a time
// that does not depend on the number of clips. Keep `bank`, and open it again when other bytes are at `data`.
//
// `damage_offset_bytes` may be null; otherwise it gets the place of what is wrong, and 0 if nothing is.
lipz_status lipz_bank_open(const uint8_t *data,
                           size_t length_bytes,
                           struct lipz_bank *bank,
                           uint32_t *damage_offset_bytes);

// Makes `bank` use the locales of a text bank: opens it, and checks that it belongs to the clips.
// Unless that succeeds, `bank` stays as it was.
//
// `damage_offset_bytes` as for `lipz_bank_open`; the place is one in the text bank.
lipz_status lipz_bank_use_texts(struct lipz_bank *bank,
                                const uint8_t *texts,
                                size_t texts_length_bytes,
                                uint32_t *damage_offset_bytes);

// Checks every byte and reference of a bank, and of its text bank. After it no query fails for
// which the bank has data.
//
// `damage_offset_bytes` as for `lipz_bank_open`; the place is one in the text bank if the bank is
// whole.
lipz_status lipz_bank_verify(const struct lipz_bank *bank, uint32_t *damage_offset_bytes);

// What a bank has.
lipz_status lipz_bank_info(const struct lipz_bank *bank, struct lipz_bank_info_t *info);

// The id of the clip with this key. It never changes: `lipz ids --lang c` writes the ids of all
// clips as constants.
lipz_status lipz_clip_id_of_key(const char *key, size_t key_length_bytes, uint64_t *id);

// The clip with this id.
lipz_status lipz_clip_by_id(const struct lipz_bank *bank, uint64_t id, struct lipz_clip *clip);

// The clip with this key, compared whole.
lipz_status lipz_clip_by_key(const struct lipz_bank *bank,
                             const char *key,
                             size_t key_length_bytes,
                             struct lipz_clip *clip);

// The clip in this slot, a number below `clip_count` of the bank. Slots are in no order that means
// anything.
lipz_status lipz_clip_at(const struct lipz_bank *bank, uint32_t slot, struct lipz_clip *clip);

// The key of a clip: the path of its Lipz file below the source root, without extension.
lipz_status lipz_clip_key(const struct lipz_bank *bank,
                          const struct lipz_clip *clip,
                          struct lipz_string *key);

// The frame codes of a clip, one byte per frame.
lipz_status lipz_clip_frames(const struct lipz_bank *bank,
                             const struct lipz_clip *clip,
                             struct lipz_string *frames);

// The viseme of a frame; rest outside the clip.
lipz_status lipz_clip_viseme(const struct lipz_bank *bank,
                             const struct lipz_clip *clip,
                             uint32_t frame,
                             lipz_viseme *viseme);

// The first microsecond at which a frame shows; that of frame `frame_count` is the length of the
// clip. `LIPZ_NONE` without a frame rate.
lipz_status lipz_clip_start_of_frame_us(const struct lipz_bank *bank,
                                        const struct lipz_clip *clip,
                                        uint32_t frame,
                                        uint64_t *time_us);

// What the bank says about the recording of a clip. `LIPZ_NONE` if the bank was packed without
// recordings, or the clip had none.
lipz_status lipz_clip_recording(const struct lipz_bank *bank,
                                const struct lipz_clip *clip,
                                struct lipz_recording *recording);

// The frame that shows `time_us` microseconds after the audio began: the fastest unit.
lipz_status lipz_frame_at_us(const struct lipz_bank *bank,
                             const struct lipz_clip *clip,
                             int64_t time_us,
                             uint32_t *frame);

// The frame that shows after `position` samples (per channel) at `rate_hz` samples per second.
lipz_status lipz_frame_at_samples(const struct lipz_bank *bank,
                                  const struct lipz_clip *clip,
                                  int64_t position,
                                  uint32_t rate_hz,
                                  uint32_t *frame);

// The frame that shows after `seconds`, taken two units in the last place later, so that `n / fps`
// leads to frame `n`. Where your engine offers an integer clock, use the other units.
lipz_status lipz_frame_at_seconds(const struct lipz_bank *bank,
                                  const struct lipz_clip *clip,
                                  double seconds,
                                  uint32_t *frame);

// `lipz_frame_at_seconds` for clocks that have no `double`. The last place of a `float` is coarse: `n / fps`
// leads to frame `n` up to 2^21 only, a day at 24 fps.
lipz_status lipz_frame_at_seconds_f32(const struct lipz_bank *bank,
                                      const struct lipz_clip *clip,
                                      float seconds,
                                      uint32_t *frame);

// The viseme that shows `time_us` microseconds after the audio began; rest when nobody speaks.
lipz_status lipz_viseme_at_us(const struct lipz_bank *bank,
                              const struct lipz_clip *clip,
                              int64_t time_us,
                              lipz_viseme *viseme);

// The viseme that shows after `position` samples at `rate_hz`; rest when nobody speaks.
lipz_status lipz_viseme_at_samples(const struct lipz_bank *bank,
                                   const struct lipz_clip *clip,
                                   int64_t position,
                                   uint32_t rate_hz,
                                   lipz_viseme *viseme);

// The viseme that shows after `seconds`, with the rule of `lipz_frame_at_seconds`; rest when nobody
// speaks.
lipz_status lipz_viseme_at_seconds(const struct lipz_bank *bank,
                                   const struct lipz_clip *clip,
                                   double seconds,
                                   lipz_viseme *viseme);

// `lipz_viseme_at_seconds` for clocks that have no `double`.
lipz_status lipz_viseme_at_seconds_f32(const struct lipz_bank *bank,
                                       const struct lipz_clip *clip,
                                       float seconds,
                                       lipz_viseme *viseme);

// The segment `time_us` microseconds after the audio began.
lipz_status lipz_segment_at_us(const struct lipz_bank *bank,
                               const struct lipz_clip *clip,
                               int64_t time_us,
                               struct lipz_segment *segment);

// The segment after `position` samples at `rate_hz`.
lipz_status lipz_segment_at_samples(const struct lipz_bank *bank,
                                    const struct lipz_clip *clip,
                                    int64_t position,
                                    uint32_t rate_hz,
                                    struct lipz_segment *segment);

// The segment after `seconds`, with the rule of `lipz_frame_at_seconds`.
lipz_status lipz_segment_at_seconds(const struct lipz_bank *bank,
                                    const struct lipz_clip *clip,
                                    double seconds,
                                    struct lipz_segment *segment);

// `lipz_segment_at_seconds` for clocks that have no `double`.
lipz_status lipz_segment_at_seconds_f32(const struct lipz_bank *bank,
                                        const struct lipz_clip *clip,
                                        float seconds,
                                        struct lipz_segment *segment);

// The segment of a clip with this index, a number below its `segment_count`.
lipz_status lipz_segment_at(const struct lipz_bank *bank,
                            const struct lipz_clip *clip,
                            uint32_t index,
                            struct lipz_segment *segment);

// The segment that a frame belongs to. Segments of no frames are never found by frame.
lipz_status lipz_segment_of_frame(const struct lipz_bank *bank,
                                  const struct lipz_clip *clip,
                                  uint32_t frame,
                                  struct lipz_segment *segment);

// The text of a segment in a locale of the same bank. `LIPZ_NONE` if the clip has none, also by
// fallback, and if the locale is one of another bank.
lipz_status lipz_segment_text(const struct lipz_bank *bank,
                              const struct lipz_segment *segment,
                              const struct lipz_locale *locale,
                              struct lipz_text *text);

// The locale with this tag, spelled as in the bank.
lipz_status lipz_locale_by_tag(const struct lipz_bank *bank,
                               const char *tag,
                               size_t tag_length_bytes,
                               struct lipz_locale *locale);

// The locale with this index, a number below `locale_count` of the bank.
lipz_status lipz_locale_at(const struct lipz_bank *bank,
                           uint32_t index,
                           struct lipz_locale *locale);

// The default locale; `LIPZ_NONE` if none was set when the bank was packed.
lipz_status lipz_locale_default(const struct lipz_bank *bank, struct lipz_locale *locale);

// The event string of a segment, trimmed and otherwise as in the Lipz file. Empty if nothing happens;
// `LIPZ_NONE` if the file has no events.
lipz_status lipz_segment_event_string(const struct lipz_bank *bank,
                                      const struct lipz_segment *segment,
                                      struct lipz_string *string);

// The typed event of a segment with this index: ask from 0 on until `LIPZ_NONE`. There are none where the
// event string is some other syntax, such as a script.
lipz_status lipz_segment_event(const struct lipz_bank *bank,
                               const struct lipz_segment *segment,
                               uint32_t index,
                               struct lipz_event *event);

// The name that events mention, spelled as there. Look names up once and compare numbers per event.
lipz_status lipz_event_name(const struct lipz_bank *bank,
                            const char *name,
                            size_t name_length_bytes,
                            struct lipz_name *found);

// Starts a cursor that waits for the sound of `clip` to begin. `size_bytes` is `sizeof(lipz_cursor)`: unless that is the
// size in the library that runs, the status is `LIPZ_OTHER_VERSION`, and nothing is written.
//
// `LIPZ_NONE` if there is no such clip, and if it has no frame rate: give it one in `clip`. The cursor remembers frame
// rate and viseme type of `clip`, and takes them where the bank has none.
lipz_status lipz_cursor_new(const struct lipz_bank *bank,
                            const struct lipz_clip *clip,
                            size_t size_bytes,
                            struct lipz_cursor *cursor);

// Ends the clip before the sound does, as when a player skips it: what is left becomes due, so that lasting states take
// effect.
lipz_status lipz_cursor_finish(const struct lipz_bank *bank,
                               struct lipz_cursor *cursor);

// Takes the next event that is due: of the segments that have begun since the move before the last one, in order, each
// once, also of segments without frames. Events that name no character are the speaker's. Call it after each move until
// `LIPZ_NONE`: what is not taken before the next move does not come again.
lipz_status lipz_cursor_take_event(const struct lipz_bank *bank,
                                   struct lipz_cursor *cursor,
                                   struct lipz_event *event);

// Takes the next segment that is due, with all its events: for event strings in another syntax than that of
// `lipz_cursor_take_event`. `LIPZ_NONE` when all are taken.
lipz_status lipz_cursor_take_segment(const struct lipz_bank *bank,
                                     struct lipz_cursor *cursor,
                                     struct lipz_segment *segment);

// The mouth shape to draw, with lead and hold; rest before the start and from the end on.
lipz_status lipz_cursor_viseme(const struct lipz_bank *bank,
                               const struct lipz_cursor *cursor,
                               lipz_viseme *viseme);

// How far that mouth is open, in ten-thousandths; `LIPZ_NONE` if the clip has no frames or no viseme type: let the mouth
// babble.
lipz_status lipz_cursor_openness(const struct lipz_bank *bank,
                                 const struct lipz_cursor *cursor,
                                 uint32_t *ten_thousandths);

// The segment whose subtitle to show; `LIPZ_NONE` before the start and from the end on.
lipz_status lipz_cursor_segment(const struct lipz_bank *bank,
                                const struct lipz_cursor *cursor,
                                struct lipz_segment *segment);

// The sound has reached `time_us` microseconds: the events of the segments that have begun since are due. A time before
// that of the last call makes nothing due, and nothing comes again until the sound is past the point that it had
// reached: clocks jitter.
lipz_status lipz_cursor_advance_us(const struct lipz_bank *bank,
                                   struct lipz_cursor *cursor,
                                   int64_t time_us);

// The sound has reached `position` samples (per channel) at `rate_hz` samples per second.
lipz_status lipz_cursor_advance_samples(const struct lipz_bank *bank,
                                        struct lipz_cursor *cursor,
                                        int64_t position,
                                        uint32_t rate_hz);

// The sound has reached `seconds`, with the rule of `lipz_frame_at_seconds`.
lipz_status lipz_cursor_advance_seconds(const struct lipz_bank *bank,
                                        struct lipz_cursor *cursor,
                                        double seconds);

// `lipz_cursor_advance_seconds` for clocks that have no `double`.
lipz_status lipz_cursor_advance_seconds_f32(const struct lipz_bank *bank,
                                            struct lipz_cursor *cursor,
                                            float seconds);

// The sound has jumped from its end to its start, and has reached `time_us` microseconds since: what was left is due, then
// what has begun since. What characters feel, stare and point at outlasts the end of a round.
lipz_status lipz_cursor_loop_us(const struct lipz_bank *bank,
                                struct lipz_cursor *cursor,
                                int64_t time_us);

// The sound has jumped from its end to its start, and has reached `position` samples since.
lipz_status lipz_cursor_loop_samples(const struct lipz_bank *bank,
                                     struct lipz_cursor *cursor,
                                     int64_t position,
                                     uint32_t rate_hz);

// The sound has jumped from its end to its start, and has reached `seconds` since.
lipz_status lipz_cursor_loop_seconds(const struct lipz_bank *bank,
                                     struct lipz_cursor *cursor,
                                     double seconds);

// `lipz_cursor_loop_seconds` for clocks that have no `double`.
lipz_status lipz_cursor_loop_seconds_f32(const struct lipz_bank *bank,
                                         struct lipz_cursor *cursor,
                                         float seconds);

// Jumps to `time_us` microseconds, forward or back. Nothing is due; the next advance starts with the segments that begin
// in the frame of this time. States are as if the clip had been played once from its start to here.
lipz_status lipz_cursor_seek_us(const struct lipz_bank *bank,
                                struct lipz_cursor *cursor,
                                int64_t time_us);

// Jumps to `position` samples at `rate_hz`.
lipz_status lipz_cursor_seek_samples(const struct lipz_bank *bank,
                                     struct lipz_cursor *cursor,
                                     int64_t position,
                                     uint32_t rate_hz);

// Jumps to `seconds`, with the rule of `lipz_frame_at_seconds`.
lipz_status lipz_cursor_seek_seconds(const struct lipz_bank *bank,
                                     struct lipz_cursor *cursor,
                                     double seconds);

// `lipz_cursor_seek_seconds` for clocks that have no `double`.
lipz_status lipz_cursor_seek_seconds_f32(const struct lipz_bank *bank,
                                         struct lipz_cursor *cursor,
                                         float seconds);

// What `name` feels, stares and points at after the events that were due or were jumped over; the speaker if it is null
// or no name. `LIPZ_NONE` for a name of another bank.
//
// Read from the events anew with each call, in a time that grows with their number.
lipz_status lipz_cursor_character(const struct lipz_bank *bank,
                                  const struct lipz_cursor *cursor,
                                  const struct lipz_name *name,
                                  struct lipz_character *character);

// A character that an event of the clip is about, also one to come, with its state: ask from 0 on until `LIPZ_NONE`
// after a jump, to set the scene. They are in the order of their names.
lipz_status lipz_cursor_character_at(const struct lipz_bank *bank,
                                     const struct lipz_cursor *cursor,
                                     uint32_t index,
                                     struct lipz_character *character);

// The babble profile with this name.
lipz_status lipz_babble_by_name(const struct lipz_bank *bank,
                                const char *name,
                                size_t name_length_bytes,
                                struct lipz_babble *babble);

// The profile of the project, `[babble]` in its settings; the viewer's own if it has none.
lipz_status lipz_babble_default(const struct lipz_bank *bank, struct lipz_babble *babble);

// How lips and jaw are moved `elapsed_us` microseconds after somebody has begun to speak, at a `power` of the voice from
// 0 to 1. Nobody speaks before 0. `LIPZ_NONE` for a profile of another bank.
lipz_status lipz_babble_at_us(const struct lipz_bank *bank,
                              const struct lipz_babble *babble,
                              int64_t elapsed_us,
                              float power,
                              struct lipz_weights *weights);

// `lipz_babble_at_us` without floating point: `level` is the power in 65,536ths, at most 65,535, or `LIPZ_UNMEASURED`.
lipz_status lipz_babble_at_us_level(const struct lipz_bank *bank,
                                    const struct lipz_babble *babble,
                                    int64_t elapsed_us,
                                    uint32_t level,
                                    struct lipz_weights *weights);

// How lips and jaw are moved after `position` samples at `rate_hz`.
lipz_status lipz_babble_at_samples(const struct lipz_bank *bank,
                                   const struct lipz_babble *babble,
                                   int64_t position,
                                   uint32_t rate_hz,
                                   float power,
                                   struct lipz_weights *weights);

// How lips and jaw are moved after `seconds`, with the rule of `lipz_frame_at_seconds`.
lipz_status lipz_babble_at_seconds(const struct lipz_bank *bank,
                                   const struct lipz_babble *babble,
                                   double seconds,
                                   float power,
                                   struct lipz_weights *weights);

// `lipz_babble_at_seconds` for clocks that have no `double`.
lipz_status lipz_babble_at_seconds_f32(const struct lipz_bank *bank,
                                       const struct lipz_babble *babble,
                                       float seconds,
                                       float power,
                                       struct lipz_weights *weights);

// How far the mouth of a shape is open, in ten-thousandths; `LIPZ_NONE` if `viseme_type` is not one of the three.
lipz_status lipz_viseme_openness(lipz_viseme viseme,
                                 uint32_t viseme_type,
                                 uint32_t *ten_thousandths);

// One frame of the clip as `lead_us` of a cursor. `LIPZ_NONE` without a frame rate, here and below.
lipz_status lipz_lead_one_frame(const struct lipz_clip *clip, uint32_t *lead_us);

// Two frames of the clip as `lead_us` of a cursor.
lipz_status lipz_lead_two_frames(const struct lipz_clip *clip, uint32_t *lead_us);

// `hold_frames` of a cursor that lets consonants be read: two frames at 24 fps.
lipz_status lipz_hold_readable(const struct lipz_clip *clip, uint32_t *hold_frames);

// `hold_frames` of a cursor as long as a display shows one picture: every consonant that has the room is on at least one.
lipz_status lipz_hold_for_display(const struct lipz_clip *clip,
                                  uint32_t picture_us,
                                  uint32_t *hold_frames);

// The curve of a clip with this name. `LIPZ_NONE` if it has none.
lipz_status lipz_clip_curve(const struct lipz_bank *bank,
                            const struct lipz_clip *clip,
                            const char *name,
                            size_t name_length_bytes,
                            struct lipz_curve *curve);

// The curve of a clip with this index, in the order of their names: ask from 0 on until `LIPZ_NONE`.
lipz_status lipz_clip_curve_at(const struct lipz_bank *bank,
                               const struct lipz_clip *clip,
                               uint32_t index,
                               struct lipz_curve *curve);

// The key of a curve with this index, a number below its `key_count`.
lipz_status lipz_clip_curve_key(const struct lipz_bank *bank,
                                const struct lipz_clip *clip,
                                const struct lipz_curve *curve,
                                uint32_t index,
                                struct lipz_curve_key *key);

// The value of a curve at the start of a frame, in thousandths. `cursor` may be null.
lipz_status lipz_clip_curve_value(const struct lipz_bank *bank,
                                  const struct lipz_clip *clip,
                                  const struct lipz_curve *curve,
                                  struct lipz_curve_cursor *cursor,
                                  uint32_t frame,
                                  int32_t *thousandths);

// The value of a curve `time_us` microseconds after the audio began, in thousandths. `LIPZ_NONE` without a frame rate.
// `cursor` may be null; with one, a picture needs no search among the keys.
lipz_status lipz_clip_curve_value_at_us(const struct lipz_bank *bank,
                                        const struct lipz_clip *clip,
                                        const struct lipz_curve *curve,
                                        struct lipz_curve_cursor *cursor,
                                        int64_t time_us,
                                        int32_t *thousandths);

// The value of a curve after `position` samples at `rate_hz`, in thousandths. `LIPZ_NONE` without a frame rate.
lipz_status lipz_clip_curve_value_at_samples(const struct lipz_bank *bank,
                                             const struct lipz_clip *clip,
                                             const struct lipz_curve *curve,
                                             struct lipz_curve_cursor *cursor,
                                             int64_t position,
                                             uint32_t rate_hz,
                                             int32_t *thousandths);

// The value of a curve after `seconds`, in thousandths. `LIPZ_NONE` without a frame rate.
lipz_status lipz_clip_curve_value_at_seconds(const struct lipz_bank *bank,
                                             const struct lipz_clip *clip,
                                             const struct lipz_curve *curve,
                                             struct lipz_curve_cursor *cursor,
                                             double seconds,
                                             int32_t *thousandths);

// `lipz_clip_curve_value_at_seconds` for clocks that have no `double`.
lipz_status lipz_clip_curve_value_at_seconds_f32(const struct lipz_bank *bank,
                                                 const struct lipz_clip *clip,
                                                 const struct lipz_curve *curve,
                                                 struct lipz_curve_cursor *cursor,
                                                 float seconds,
                                                 int32_t *thousandths);

// What the speaker feels `time_us` microseconds after the audio began. A neutral face without a frame rate.
lipz_status lipz_clip_emotions_at_us(const struct lipz_bank *bank,
                                     const struct lipz_clip *clip,
                                     int64_t time_us,
                                     struct lipz_emotions *emotions);

// What the speaker feels after `position` samples at `rate_hz`.
lipz_status lipz_clip_emotions_at_samples(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          int64_t position,
                                          uint32_t rate_hz,
                                          struct lipz_emotions *emotions);

// What the speaker feels after `seconds`.
lipz_status lipz_clip_emotions_at_seconds(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          double seconds,
                                          struct lipz_emotions *emotions);

// `lipz_clip_emotions_at_seconds` for clocks that have no `double`.
lipz_status lipz_clip_emotions_at_seconds_f32(const struct lipz_bank *bank,
                                              const struct lipz_clip *clip,
                                              float seconds,
                                              struct lipz_emotions *emotions);

// What a character of the clip feels `time_us` microseconds after the audio began: `mara feels fear 4` in its events is
// in the curve `mara.fear`. A neutral face without such curves. `who` may be null for the speaker.
lipz_status lipz_clip_emotions_of_us(const struct lipz_bank *bank,
                                     const struct lipz_clip *clip,
                                     const struct lipz_who *who,
                                     int64_t time_us,
                                     struct lipz_emotions *emotions);

// What a character of the clip feels after `position` samples at `rate_hz`.
lipz_status lipz_clip_emotions_of_samples(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          const struct lipz_who *who,
                                          int64_t position,
                                          uint32_t rate_hz,
                                          struct lipz_emotions *emotions);

// What a character of the clip feels after `seconds`.
lipz_status lipz_clip_emotions_of_seconds(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          const struct lipz_who *who,
                                          double seconds,
                                          struct lipz_emotions *emotions);

// `lipz_clip_emotions_of_seconds` for clocks that have no `double`.
lipz_status lipz_clip_emotions_of_seconds_f32(const struct lipz_bank *bank,
                                              const struct lipz_clip *clip,
                                              const struct lipz_who *who,
                                              float seconds,
                                              struct lipz_emotions *emotions);

// The face profile with this name.
lipz_status lipz_face_profile_by_name(const struct lipz_bank *bank,
                                      const char *name,
                                      size_t name_length_bytes,
                                      struct lipz_face_profile *profile);

// The profile of the project, `[face]` in its settings; the usual one if it has none.
lipz_status lipz_face_profile_default(const struct lipz_bank *bank,
                                      struct lipz_face_profile *profile);

// The speaker's face `time_us` microseconds after the audio began, generated as `profile` says. Curves of the clip win over
// what is generated. `profile` may be null for that of the project, `look_at` for somebody straight ahead. `LIPZ_NONE` for a
// profile of another bank.
lipz_status lipz_clip_face_at_us(const struct lipz_bank *bank,
                                 const struct lipz_clip *clip,
                                 const struct lipz_face_profile *profile,
                                 const struct lipz_look_at *look_at,
                                 int64_t time_us,
                                 struct lipz_face *face);

// The speaker's face after `position` samples at `rate_hz`.
lipz_status lipz_clip_face_at_samples(const struct lipz_bank *bank,
                                      const struct lipz_clip *clip,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      int64_t position,
                                      uint32_t rate_hz,
                                      struct lipz_face *face);

// The speaker's face after `seconds`.
lipz_status lipz_clip_face_at_seconds(const struct lipz_bank *bank,
                                      const struct lipz_clip *clip,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      double seconds,
                                      struct lipz_face *face);

// `lipz_clip_face_at_seconds` for clocks that have no `double`.
lipz_status lipz_clip_face_at_seconds_f32(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          const struct lipz_face_profile *profile,
                                          const struct lipz_look_at *look_at,
                                          float seconds,
                                          struct lipz_face *face);

// The face of a character of the clip `time_us` microseconds after the audio began: with the curves that have the name in
// front, and blinks by their own emotions. The head of somebody who listens moves for these curves and for what is looked at only. `who`
// may be null for the speaker, the others as for `lipz_clip_face_at_us`.
lipz_status lipz_clip_face_of_us(const struct lipz_bank *bank,
                                 const struct lipz_clip *clip,
                                 const struct lipz_who *who,
                                 const struct lipz_face_profile *profile,
                                 const struct lipz_look_at *look_at,
                                 int64_t time_us,
                                 struct lipz_face *face);

// The face of a character of the clip after `position` samples at `rate_hz`.
lipz_status lipz_clip_face_of_samples(const struct lipz_bank *bank,
                                      const struct lipz_clip *clip,
                                      const struct lipz_who *who,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      int64_t position,
                                      uint32_t rate_hz,
                                      struct lipz_face *face);

// The face of a character of the clip after `seconds`.
lipz_status lipz_clip_face_of_seconds(const struct lipz_bank *bank,
                                      const struct lipz_clip *clip,
                                      const struct lipz_who *who,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      double seconds,
                                      struct lipz_face *face);

// `lipz_clip_face_of_seconds` for clocks that have no `double`.
lipz_status lipz_clip_face_of_seconds_f32(const struct lipz_bank *bank,
                                          const struct lipz_clip *clip,
                                          const struct lipz_who *who,
                                          const struct lipz_face_profile *profile,
                                          const struct lipz_look_at *look_at,
                                          float seconds,
                                          struct lipz_face *face);

// The face of somebody who says nothing, `time_us` microseconds from anywhere: they blink and look. `seed` tells them apart
// from others, so that not everybody blinks at once.
lipz_status lipz_face_idle_at_us(const struct lipz_bank *bank,
                                 const struct lipz_face_profile *profile,
                                 const struct lipz_look_at *look_at,
                                 uint64_t seed,
                                 int64_t time_us,
                                 struct lipz_face *face);

// The face of somebody who says nothing, after `position` samples at `rate_hz`.
lipz_status lipz_face_idle_at_samples(const struct lipz_bank *bank,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      uint64_t seed,
                                      int64_t position,
                                      uint32_t rate_hz,
                                      struct lipz_face *face);

// The face of somebody who says nothing, after `seconds`.
lipz_status lipz_face_idle_at_seconds(const struct lipz_bank *bank,
                                      const struct lipz_face_profile *profile,
                                      const struct lipz_look_at *look_at,
                                      uint64_t seed,
                                      double seconds,
                                      struct lipz_face *face);

// `lipz_face_idle_at_seconds` for clocks that have no `double`.
lipz_status lipz_face_idle_at_seconds_f32(const struct lipz_bank *bank,
                                          const struct lipz_face_profile *profile,
                                          const struct lipz_look_at *look_at,
                                          uint64_t seed,
                                          float seconds,
                                          struct lipz_face *face);

// The clip as it is played in the voice with this tag (`de-de`), spelled as in the bank. `clip` may be the original or any
// of its dubs. `LIPZ_NONE` if the bank has no such voice: play the clip as it is.
lipz_status lipz_clip_in_voice(const struct lipz_bank *bank,
                               const struct lipz_clip *clip,
                               const char *tag,
                               size_t tag_length_bytes,
                               struct lipz_voiced_clip *voiced);

// The tag of the voice whose recording the mouth of a clip belongs to. `LIPZ_NONE` in a bank without dubs.
lipz_status lipz_clip_voice(const struct lipz_bank *bank,
                            const struct lipz_clip *clip,
                            struct lipz_string *tag);

// The tag of the voice with this index: that of the originals is 0, those of the dubs follow in the order of their tags.
// `LIPZ_NONE` behind the last; a bank without dubs has none.
lipz_status lipz_voice_at(const struct lipz_bank *bank,
                          uint32_t index,
                          struct lipz_string *tag);

// Checks that `count` opened banks make a stack, the base first: that each layer was made over banks below it. Call it once,
// after opening them, and verify each bank by itself.
//
// The status is that of a bank: error 37 for a layer of other banks. `misfit` may be null; otherwise it gets the index of the bank
// that does not fit, and 0 if all do.
lipz_status lipz_layers_check(const struct lipz_bank *banks,
                              uint32_t count,
                              uint32_t *misfit);

// The clip with this id, of the topmost bank that has it; `LIPZ_NONE` if none does, or one above removes it.
lipz_status lipz_layers_clip_by_id(const struct lipz_bank *banks,
                                   uint32_t count,
                                   uint64_t id,
                                   struct lipz_layered_clip *clip);

// The clip with this key, compared whole.
lipz_status lipz_layers_clip_by_key(const struct lipz_bank *banks,
                                    uint32_t count,
                                    const char *key,
                                    size_t key_length_bytes,
                                    struct lipz_layered_clip *clip);

// The locale with this tag as the bank with the index `layer` has it, or what stands in for it there. Look it up once for each
// bank. `LIPZ_NONE` if clips of this bank have no texts in it.
lipz_status lipz_layers_locale(const struct lipz_bank *banks,
                               uint32_t count,
                               uint32_t layer,
                               const char *tag,
                               size_t tag_length_bytes,
                               struct lipz_layered_locale *locale);

// The text of the segment with this index of a clip, in a locale that was looked up for its `texts_layer`. `LIPZ_NONE` if the
// clip has none, also by fallback.
lipz_status lipz_layers_text(const struct lipz_bank *banks,
                             uint32_t count,
                             const struct lipz_layered_clip *clip,
                             uint32_t segment,
                             const struct lipz_layered_locale *locale,
                             struct lipz_text *text);

// Which banks say what is said once for the whole stack.
lipz_status lipz_layers_info(const struct lipz_bank *banks,
                             uint32_t count,
                             struct lipz_layers_info_t *info);

// The face of a clip of a stack `time_us` microseconds after the audio began, as `lipz_clip_face_at_us`. `profile` is of
// `banks[faces_layer]` of `lipz_layers_info`, or null for that of the project. `LIPZ_NONE` for a profile of another bank.
lipz_status lipz_layers_face_at_us(const struct lipz_bank *banks,
                                   uint32_t count,
                                   const struct lipz_layered_clip *clip,
                                   const struct lipz_face_profile *profile,
                                   const struct lipz_look_at *look_at,
                                   int64_t time_us,
                                   struct lipz_face *face);

// The face of a clip of a stack after `position` samples at `rate_hz`.
lipz_status lipz_layers_face_at_samples(const struct lipz_bank *banks,
                                        uint32_t count,
                                        const struct lipz_layered_clip *clip,
                                        const struct lipz_face_profile *profile,
                                        const struct lipz_look_at *look_at,
                                        int64_t position,
                                        uint32_t rate_hz,
                                        struct lipz_face *face);

// The face of a clip of a stack after `seconds`.
lipz_status lipz_layers_face_at_seconds(const struct lipz_bank *banks,
                                        uint32_t count,
                                        const struct lipz_layered_clip *clip,
                                        const struct lipz_face_profile *profile,
                                        const struct lipz_look_at *look_at,
                                        double seconds,
                                        struct lipz_face *face);

// `lipz_layers_face_at_seconds` for clocks that have no `double`.
lipz_status lipz_layers_face_at_seconds_f32(const struct lipz_bank *banks,
                                            uint32_t count,
                                            const struct lipz_layered_clip *clip,
                                            const struct lipz_face_profile *profile,
                                            const struct lipz_look_at *look_at,
                                            float seconds,
                                            struct lipz_face *face);

// The face of a character of a clip of a stack `time_us` microseconds after the audio began, as `lipz_clip_face_of_us`, with a
// profile as for `lipz_layers_face_at_us`.
lipz_status lipz_layers_face_of_us(const struct lipz_bank *banks,
                                   uint32_t count,
                                   const struct lipz_layered_clip *clip,
                                   const struct lipz_who *who,
                                   const struct lipz_face_profile *profile,
                                   const struct lipz_look_at *look_at,
                                   int64_t time_us,
                                   struct lipz_face *face);

// The face of a character of a clip of a stack after `position` samples at `rate_hz`.
lipz_status lipz_layers_face_of_samples(const struct lipz_bank *banks,
                                        uint32_t count,
                                        const struct lipz_layered_clip *clip,
                                        const struct lipz_who *who,
                                        const struct lipz_face_profile *profile,
                                        const struct lipz_look_at *look_at,
                                        int64_t position,
                                        uint32_t rate_hz,
                                        struct lipz_face *face);

// The face of a character of a clip of a stack after `seconds`.
lipz_status lipz_layers_face_of_seconds(const struct lipz_bank *banks,
                                        uint32_t count,
                                        const struct lipz_layered_clip *clip,
                                        const struct lipz_who *who,
                                        const struct lipz_face_profile *profile,
                                        const struct lipz_look_at *look_at,
                                        double seconds,
                                        struct lipz_face *face);

// `lipz_layers_face_of_seconds` for clocks that have no `double`.
lipz_status lipz_layers_face_of_seconds_f32(const struct lipz_bank *banks,
                                            uint32_t count,
                                            const struct lipz_layered_clip *clip,
                                            const struct lipz_who *who,
                                            const struct lipz_face_profile *profile,
                                            const struct lipz_look_at *look_at,
                                            float seconds,
                                            struct lipz_face *face);

// The clip with this id as it is played in the voice with this tag (`de-de`), spelled as in the banks. The id may be that of
// the original or of any of its dubs. `LIPZ_NONE` if the stack has no such clip, or no such voice: play the clip as it is.
lipz_status lipz_layers_clip_in_voice(const struct lipz_bank *banks,
                                      uint32_t count,
                                      uint64_t id,
                                      const char *tag,
                                      size_t tag_length_bytes,
                                      struct lipz_layered_voiced_clip *voiced);

// The tag of the voice whose recording the mouth of the clip with this id belongs to. `LIPZ_NONE` in a stack without dubs.
lipz_status lipz_layers_clip_voice(const struct lipz_bank *banks,
                                   uint32_t count,
                                   uint64_t id,
                                   struct lipz_string *tag);

// The tag of the voice of a stack with this index: that of the originals is 0, those of the dubs follow in the order of their
// tags. `LIPZ_NONE` behind the last; a stack without dubs has none.
lipz_status lipz_layers_voice_at(const struct lipz_bank *banks,
                                 uint32_t count,
                                 uint32_t index,
                                 struct lipz_string *tag);

// Opens the index of a set (`.lipzset`) and checks every byte of it: it is short. The banks that it names are opened and verified
// on their own.
//
// `damage_offset_bytes` may be null; otherwise it gets the place of what is wrong, and 0 if nothing is.
lipz_status lipz_set_open(const uint8_t *data,
                          size_t length_bytes,
                          struct lipz_set *set,
                          uint32_t *damage_offset_bytes);

// What the set has.
lipz_status lipz_set_info(const struct lipz_set *set, struct lipz_set_info_t *info);

// What the set says about the bank with this number, from 0. `LIPZ_NONE` behind the last.
lipz_status lipz_set_bank_at(const struct lipz_set *set,
                             uint32_t number,
                             struct lipz_set_bank *bank);

// The number of the bank that has the clip with this id, if any bank has it: ask that one. `lipz_clip_id_of_key` gives the id of a
// key.
lipz_status lipz_set_bank_of(const struct lipz_set *set,
                             uint64_t id,
                             uint32_t *number);

// Checks that an opened bank is the one with this number in the set; otherwise the status is bank error 44. Call it once for
// each bank, after opening it.
lipz_status lipz_set_check_bank(const struct lipz_set *set,
                                uint32_t number,
                                const struct lipz_bank *bank);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* LIPZ_H */
