// lipz.hpp - lipz.h for C++17: a dialogue that owns its files, std::string_view, std::optional and ranges.
// https://github.com/lipz/lipz, MIT OR Apache-2.0. docs/guides/c.md shows how to use it.
//
// Header only. Opening allocates, and throws lipz::Error; nothing else does. Strings are views into the files of the
// dialogue. Clips, segments and curves point to their dialogue, which must outlive them. A cursor does not, and
// continues in another version of the dialogue. Each struct of lipz.h is the base of its class, so functions of lipz.h
// also accept the class.
#ifndef LIPZ_HPP
#define LIPZ_HPP

#include "lipz.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace lipz {

inline std::string_view view(const lipz_string &string) noexcept {
    return string.data == nullptr ? std::string_view() : std::string_view(string.data, string.length_bytes);
}

/// Why files do not form a dialogue. The status is LIPZ_NONE for an unreadable file.
class Error : public std::runtime_error {
  public:
    Error(lipz_status status, const std::filesystem::path &file, std::uint32_t offset_bytes = 0)
        : std::runtime_error(utf8(file) + ": " + message(status)), status_(status), offset_bytes_(offset_bytes) {}
    lipz_status status() const noexcept { return status_; }
    /// The position of the damage: bytes from the start of the file.
    std::uint32_t offset_bytes() const noexcept { return offset_bytes_; }

  private:
    static std::string utf8(const std::filesystem::path &path) {
        const auto text = path.u8string(); // a string of char8_t since C++20
        return std::string(text.begin(), text.end());
    }
    static std::string message(lipz_status status) {
        lipz_string text;
        if (status == LIPZ_NONE) {
            return "the file cannot be read";
        }
        lipz_status_message(status, &text);
        return std::string(view(text));
    }
    lipz_status status_;
    std::uint32_t offset_bytes_;
};

/// Returns the output of a function of lipz.h, if there is an answer, optionally as a class of this header.
template <typename T, typename Of = T, typename Ask> std::optional<T> answer(Ask ask) noexcept {
    Of found;
    return ask(&found) == LIPZ_OK ? std::optional<T>(T(found)) : std::nullopt;
}

/// The same for a class that points to the dialogue.
template <typename T, typename Of, typename Ask>
std::optional<T> answer_in(const lipz_dialogue &dialogue, Ask ask) noexcept {
    Of found;
    return ask(&found) == LIPZ_OK ? std::optional<T>(T(dialogue, found)) : std::nullopt;
}

/// Iterates over the results of `next` until there are none, for `for (auto item : range)`.
template <typename T, typename Next> class Range {
  public:
    explicit Range(Next next) : next_(next) {}
    class iterator {
      public:
        using iterator_category = std::input_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using pointer = const T *;
        using reference = const T &;
        explicit iterator(Next *next) : next_(next) { ++*this; }
        iterator() = default;
        reference operator*() const noexcept { return *item_; }
        pointer operator->() const noexcept { return &*item_; }
        iterator &operator++() {
            if (next_ != nullptr && !(item_ = (*next_)())) {
                next_ = nullptr;
            }
            return *this;
        }
        void operator++(int) { ++*this; }
        friend bool operator==(const iterator &a, const iterator &b) noexcept { return a.next_ == b.next_; }
        friend bool operator!=(const iterator &a, const iterator &b) noexcept { return a.next_ != b.next_; }

      private:
        Next *next_ = nullptr;
        std::optional<T> item_;
    };
    iterator begin() { return iterator(&next_); }
    iterator end() noexcept { return iterator(); }

  private:
    Next next_;
};

template <typename T, typename Next> auto range(Next next) { return Range<T, Next>(std::move(next)); }

/// Returns the range of the outputs of `ask(index, out)`, from index 0.
template <typename T, typename Of = T, typename Ask> auto by_index(Ask ask) {
    return range<T>([ask, index = std::uint32_t(0)]() mutable {
        return answer<T, Of>([&](Of *out) { return ask(index++, out); });
    });
}

/// Returns the viseme that `ask(out)` writes, or rest without an answer.
template <typename Ask> char viseme_of(Ask ask) noexcept {
    lipz_viseme viseme;
    ask(&viseme);
    return static_cast<char>(viseme);
}

struct Micros {
    std::int64_t us;
};
/// A position in samples per channel.
struct Samples {
    std::int64_t position;
    std::uint32_t rate_hz;
};

/// A time since the audio began: `Micros`, `Samples`, seconds as `double` or `float`, or a duration of std::chrono.
struct Time : lipz_time {
    Time(const lipz_time &time) noexcept : lipz_time(time) {}
    Time(Micros time) noexcept : lipz_time(lipz_time_us(time.us)) {}
    Time(Samples time) noexcept : lipz_time(lipz_time_samples(time.position, time.rate_hz)) {}
    Time(double seconds) noexcept : lipz_time(lipz_time_seconds(seconds)) {}
    Time(float seconds) noexcept : lipz_time(lipz_time_seconds_f32(seconds)) {}
    template <typename Rep, typename Period>
    Time(std::chrono::duration<Rep, Period> time) noexcept
        : Time(Micros{std::chrono::floor<std::chrono::microseconds>(time).count()}) {}
};

/// A name in events; false if it is missing.
struct Name : lipz_name {
    Name() noexcept : lipz_name{{nullptr, 0}, LIPZ_NO_NAME, 0} {}
    Name(const lipz_name &name) noexcept : lipz_name(name) {}
    explicit operator bool() const noexcept { return bank != LIPZ_NO_NAME; }
    std::string_view str() const noexcept { return view(name); }
    friend bool operator==(const Name &a, const Name &b) noexcept { return bool(a) == bool(b) && a.str() == b.str(); }
    friend bool operator!=(const Name &a, const Name &b) noexcept { return !(a == b); }
};

/// One event: a character, a verb and an object. `verb` is LIPZ_FEELS and so on.
struct Event : lipz_event {
    Event(const lipz_event &event) noexcept : lipz_event(event) {}
    Name who() const noexcept { return character; }
    Name whom() const noexcept { return object; }
};

/// A display text.
struct Text : lipz_text {
    Text(const lipz_text &text) noexcept : lipz_text(text) {}
    std::string_view str() const noexcept { return view({data, length_bytes}); }
};

/// A part of a clip.
struct Segment : lipz_segment {
    Segment(const lipz_dialogue &of, const lipz_segment &segment) noexcept : lipz_segment(segment), dialogue(&of) {}
    /// Returns the text; nothing if the clip has no text in this locale, nor in its fallback.
    std::optional<Text> text(const lipz_locale &locale) const noexcept {
        return answer<Text, lipz_text>([&](lipz_text *out) { return lipz_segment_text(dialogue, this, &locale, out); });
    }
    /// Returns the event string, in any syntax; nothing if the file has no events.
    std::optional<std::string_view> event_string() const noexcept {
        const auto found =
            answer<lipz_string>([&](lipz_string *out) { return lipz_segment_event_string(dialogue, this, out); });
        return found ? std::optional(view(*found)) : std::nullopt;
    }
    auto events() const noexcept {
        return by_index<Event, lipz_event>([segment = *this](std::uint32_t index, lipz_event *out) {
            return lipz_segment_event(segment.dialogue, &segment, index, out);
        });
    }
    const lipz_dialogue *dialogue;
};

/// A number that changes while its clip plays, in thousandths.
struct Curve : lipz_curve {
    Curve(const lipz_dialogue &of, const lipz_curve &curve) noexcept : lipz_curve(curve), dialogue(&of) {}
    auto keys() const noexcept {
        return by_index<lipz_curve_key_t>([curve = *this](std::uint32_t index, lipz_curve_key_t *out) {
            return lipz_curve_key(curve.dialogue, &curve, index, out);
        });
    }
    std::int32_t value(std::uint32_t frame) const noexcept {
        return answer<std::int32_t>([&](auto *out) { return lipz_curve_value(dialogue, this, frame, out); }).value_or(0);
    }
    /// Returns the value; nothing without a frame rate. With a cursor, no search for keys is needed.
    std::optional<std::int32_t> value_at(Time time, lipz_curve_cursor *cursor = nullptr) const noexcept {
        return answer<std::int32_t>([&](auto *out) { return lipz_curve_value_at(dialogue, this, time, cursor, out); });
    }
    const lipz_dialogue *dialogue;
};

/// The shapes of a model, whose weights follow from articulation, emotions and the face.
struct Rig : lipz_rig {
    Rig(const lipz_dialogue &of, const lipz_rig &rig) noexcept : lipz_rig(rig), dialogue(&of) {}
    /// Returns the name of a weight, or an empty string.
    std::string_view weight_name(std::uint32_t index) const noexcept {
        return view(answer<lipz_string>([&](auto *out) { return lipz_rig_weight_name(dialogue, this, index, out); })
                        .value_or(lipz_string{nullptr, 0}));
    }
    /// Writes the weights in thousandths, in the order of their names, and zeros after them. Null stands for a neutral
    /// face. False for a rig of another version.
    bool weights(const lipz_articulation &articulation, std::int32_t *thousandths, std::size_t capacity,
                 const lipz_emotions *emotions = nullptr, const lipz_face *face = nullptr) const noexcept {
        return lipz_rig_weights(dialogue, this, &articulation, emotions, face, thousandths, capacity) == LIPZ_OK;
    }
    const lipz_dialogue *dialogue;
};

/// The character whose face and emotions are queried: `Who("mara")` for a listener, `Who::speaker("mara")` for the
/// speaker. The name must outlive it.
struct Who : lipz_who {
    explicit Who(std::string_view name, bool is_speaker = false) noexcept
        : lipz_who{{name.data(), name.size()}, is_speaker} {}
    static Who speaker(std::string_view name) noexcept { return Who(name, true); }
};

/// The target of a character's eyes: a direction in thousandths of a degree, up and to the left, relative to the head
/// at rest.
struct LookAt : lipz_look_at {
    /// A person straight ahead.
    LookAt() noexcept : LookAt(0, 0, 1) {}
    /// A person, at whose face, hands and body the eyes look.
    static LookAt person(std::int32_t pitch, std::int32_t yaw) noexcept { return LookAt(pitch, yaw, 1); }
    /// A target on which the eyes stay.
    static LookAt point(std::int32_t pitch, std::int32_t yaw) noexcept { return LookAt(pitch, yaw, 0); }

  private:
    LookAt(std::int32_t pitch, std::int32_t yaw, std::uint32_t is_person) noexcept
        : lipz_look_at{pitch, yaw, is_person} {}
};

struct VoicedClip;

/// One spoken line. `who` and `profile` may be null: the speaker, and the profile of the project.
struct Clip : lipz_clip {
    Clip(const lipz_dialogue &of, const lipz_clip &clip) noexcept : lipz_clip(clip), dialogue(&of) {}
    /// Returns the clip with this frame rate, unless its file specifies one.
    Clip or_fps(std::uint32_t numerator, std::uint32_t denominator = 1) const noexcept {
        Clip given = *this;
        if (fps_denominator == 0) {
            given.fps_numerator = numerator;
            given.fps_denominator = denominator;
        }
        return given;
    }
    std::string_view key() const noexcept {
        return view(answer<lipz_string>([&](auto *out) { return lipz_clip_key(dialogue, this, out); }).value_or(lipz_string{}));
    }
    std::string_view frames() const noexcept {
        return view(
            answer<lipz_string>([&](auto *out) { return lipz_clip_frames(dialogue, this, out); }).value_or(lipz_string{}));
    }
    std::optional<std::uint32_t> frame_at(Time time) const noexcept {
        return answer<std::uint32_t>([&](auto *out) { return lipz_clip_frame_at(dialogue, this, time, out); });
    }
    char viseme(std::uint32_t frame) const noexcept {
        return viseme_of([&](auto *out) { lipz_clip_viseme(dialogue, this, frame, out); });
    }
    char viseme_at(Time time) const noexcept {
        return viseme_of([&](auto *out) { lipz_clip_viseme_at(dialogue, this, time, out); });
    }
    std::optional<Segment> segment(std::uint32_t index) const noexcept {
        return answer_in<Segment, lipz_segment>(
            *dialogue, [&](auto *out) { return lipz_clip_segment(dialogue, this, index, out); });
    }
    std::optional<Segment> segment_at(Time time) const noexcept {
        return answer_in<Segment, lipz_segment>(
            *dialogue, [&](auto *out) { return lipz_clip_segment_at(dialogue, this, time, out); });
    }
    /// Returns the first microsecond of a frame; nothing without a frame rate.
    std::optional<std::uint64_t> start_of_frame_us(std::uint32_t frame) const noexcept {
        return answer<std::uint64_t>([&](auto *out) { return lipz_clip_start_of_frame_us(dialogue, this, frame, out); });
    }
    /// Returns the `hold_frames` of a cursor for a display with rendered frames of this length; with 0, the minimum
    /// that can be read.
    std::optional<std::uint32_t> hold_frames(std::uint32_t rendered_frame_us = 0) const noexcept {
        return answer<std::uint32_t>(
            [&](auto *out) { return lipz_clip_hold_frames(dialogue, this, rendered_frame_us, out); });
    }
    std::optional<lipz_recording> recording() const noexcept {
        return answer<lipz_recording>([&](auto *out) { return lipz_clip_recording(dialogue, this, out); });
    }
    /// Returns the clip as played in a voice.
    VoicedClip in_voice(const lipz_voice &voice) const noexcept;
    /// Returns the voice of the recording that the clip was made for; nothing without dubs.
    std::optional<lipz_voice> voice() const noexcept {
        return answer<lipz_voice>([&](auto *out) { return lipz_clip_voice(dialogue, this, out); });
    }
    std::optional<Curve> curve(std::string_view name) const noexcept {
        return answer_in<Curve, lipz_curve>(
            *dialogue, [&](auto *out) { return lipz_clip_curve(dialogue, this, name.data(), name.size(), out); });
    }
    /// Returns all curves, ordered by name.
    auto curves() const noexcept {
        return range<Curve>([clip = *this, index = std::uint32_t(0)]() mutable {
            return answer_in<Curve, lipz_curve>(
                *clip.dialogue, [&](auto *out) { return lipz_clip_curve_by_index(clip.dialogue, &clip, index++, out); });
        });
    }
    lipz_emotions emotions_at(Time time, const lipz_who *who = nullptr) const noexcept {
        lipz_emotions emotions;
        lipz_clip_emotions_at(dialogue, this, time, who, &emotions);
        return emotions;
    }
    /// Returns the face; nothing for a profile of another version.
    std::optional<lipz_face> face_at(Time time, const lipz_who *who = nullptr, const lipz_face_profile *profile = nullptr,
                                     const LookAt &look_at = LookAt()) const noexcept {
        return answer<lipz_face>(
            [&](auto *out) { return lipz_clip_face_at(dialogue, this, time, who, profile, &look_at, out); });
    }
    /// Returns the articulation; nothing for a profile of another version. Null stands for the project's profile.
    std::optional<lipz_articulation> articulation_at(Time time,
                                                     const lipz_articulation_profile *profile = nullptr) const noexcept {
        return answer<lipz_articulation>(
            [&](auto *out) { return lipz_clip_articulation_at(dialogue, this, time, profile, out); });
    }
    const lipz_dialogue *dialogue;
};

/// A clip as played in a voice, and its source: `LIPZ_DUB`, `LIPZ_OTHER_DUB` or `LIPZ_ORIGINAL`.
struct VoicedClip {
    Clip clip;
    std::uint32_t spoken;
};

inline VoicedClip Clip::in_voice(const lipz_voice &voice) const noexcept {
    lipz_voiced_clip found;
    const auto status = lipz_clip_in_voice(dialogue, this, &voice, &found);
    return status == LIPZ_OK ? VoicedClip{Clip(*dialogue, found.clip), found.spoken} : VoicedClip{*this, LIPZ_ORIGINAL};
}

/// The position in a clip during playback: numbers, which remain valid in another version of the dialogue. Keep it next
/// to the dialogue.
struct Cursor : lipz_cursor {
    Cursor(const lipz_cursor &cursor) noexcept : lipz_cursor(cursor) {}
    bool is_over() const noexcept { return frame == LIPZ_OVER; }
    void set_speaker(const lipz_name &name) noexcept {
        speaker_bank = name.bank;
        speaker_id = name.id;
    }
    lipz_status advance_to(const lipz_dialogue &in, Time time) noexcept { return lipz_cursor_advance(&in, this, time); }
    lipz_status loop_to(const lipz_dialogue &in, Time time) noexcept { return lipz_cursor_loop(&in, this, time); }
    lipz_status seek(const lipz_dialogue &in, Time time) noexcept { return lipz_cursor_seek(&in, this, time); }
    lipz_status finish(const lipz_dialogue &in) noexcept { return lipz_cursor_finish(&in, this); }
    /// Takes the events that are due, each once. The cursor and the dialogue must outlive the range.
    auto events(const lipz_dialogue &in) noexcept {
        return by_index<Event, lipz_event>(
            [this, &in](std::uint32_t, lipz_event *out) { return lipz_cursor_take_event(&in, this, out); });
    }
    /// Takes the segments that are due, with all their events.
    auto segments(const lipz_dialogue &in) noexcept {
        return range<Segment>([this, &in] {
            return answer_in<Segment, lipz_segment>(
                in, [&](auto *out) { return lipz_cursor_take_segment(&in, this, out); });
        });
    }
    char viseme(const lipz_dialogue &in) const noexcept {
        return viseme_of([&](auto *out) { lipz_cursor_viseme(&in, this, out); });
    }
    /// Returns how far the mouth is open, in ten-thousandths; nothing if the clip has no visemes: let the mouth babble.
    std::optional<std::uint32_t> openness(const lipz_dialogue &in) const noexcept {
        return answer<std::uint32_t>([&](auto *out) { return lipz_cursor_openness(&in, this, out); });
    }
    std::optional<Segment> segment(const lipz_dialogue &in) const noexcept {
        return answer_in<Segment, lipz_segment>(in, [&](auto *out) { return lipz_cursor_segment(&in, this, out); });
    }
    /// Returns the emotion and targets of a character, or of the speaker without a name.
    std::optional<lipz_character> character(const lipz_dialogue &in, const lipz_name &name = Name()) const noexcept {
        return answer<lipz_character>([&](auto *out) { return lipz_cursor_character(&in, this, &name, out); });
    }
    /// Returns all characters in the events of the clip.
    auto characters(const lipz_dialogue &in) const noexcept {
        return by_index<lipz_character>([this, &in](std::uint32_t index, lipz_character *out) {
            return lipz_cursor_character_by_index(&in, this, index, out);
        });
    }
};

/// Any number of files that return answers like one: a bank or the index of a set, patches on top of it, and text
/// banks. It owns its data, and functions of lipz.h accept it.
class Dialogue {
  public:
    /// Reads and opens files, the base first, and verifies them unless `flags` is `LIPZ_UNVERIFIED`. The banks of a set
    /// are read from the folder of its index, and follow the index. Throws an Error.
    static Dialogue open(const std::vector<std::filesystem::path> &paths, std::uint32_t flags = 0) {
        Dialogue dialogue(flags);
        for (const auto &path : paths) {
            const lipz_bytes index = dialogue.add(path);
            for (const auto &bank : by_index<lipz_set_bank>([&index](std::uint32_t number, lipz_set_bank *out) {
                     return lipz_set_bank_by_index(&index, number, out);
                 })) {
                dialogue.add(path.parent_path() / std::filesystem::u8path(view(bank.file_name)));
            }
        }
        return dialogue.opened();
    }
    /// Opens contents that the program keeps. Pass no bytes for a bank of a set that `supply` adds later. Throws an
    /// Error.
    static Dialogue open_bytes(std::vector<lipz_bytes> contents, std::uint32_t flags = 0) {
        Dialogue dialogue(flags);
        dialogue.state_->contents = std::move(contents);
        for (std::size_t number = 0; number < dialogue.state_->contents.size(); number++) {
            dialogue.state_->paths.emplace_back("file " + std::to_string(number));
        }
        return dialogue.opened();
    }
    operator const lipz_dialogue &() const noexcept { return state_->dialogue; }
    /// Returns the pointer for functions of lipz.h.
    const lipz_dialogue *get() const noexcept { return &state_->dialogue; }

    std::optional<Clip> clip(std::uint64_t id) const noexcept {
        return answer_in<Clip, lipz_clip>(*this, [&](auto *out) { return lipz_dialogue_clip(get(), id, out); });
    }
    std::optional<Clip> clip(std::string_view key) const noexcept {
        return answer_in<Clip, lipz_clip>(
            *this, [&](auto *out) { return lipz_dialogue_clip_by_key(get(), key.data(), key.size(), out); });
    }
    /// Adds a missing bank of a set. The program keeps its bytes. Throws an Error.
    void supply(std::uint32_t number, lipz_bytes contents) {
        lipz_problem problem;
        const auto status = lipz_dialogue_supply(&state_->dialogue, state_->files.data(), number, &contents,
                                                 state_->flags, &problem);
        if (status != LIPZ_OK) {
            throw error(status, number, problem.offset_bytes);
        }
    }
    /// Returns the clips whose keys start with `prefix`, file by file.
    auto clips(std::string prefix = {}) const {
        return range<Clip>([this, prefix = std::move(prefix), position = std::uint64_t(0)]() mutable {
            return answer_in<Clip, lipz_clip>(
                *this, [&](auto *out) { return lipz_dialogue_next_clip(get(), prefix.data(), prefix.size(), &position, out); });
        });
    }
    std::optional<lipz_locale> locale(std::string_view tag) const noexcept {
        return answer<lipz_locale>([&](auto *out) { return lipz_dialogue_locale(get(), tag.data(), tag.size(), out); });
    }
    /// Returns the locale for texts of a variant. For the key `few-fem`, tries `few-fem`, `few` and `fem`; if no clip
    /// has any of these, returns `locale`. Look variants up once per locale.
    std::optional<lipz_locale> variant(const lipz_locale &locale, std::string_view key) const noexcept {
        return answer<lipz_locale>(
            [&](auto *out) { return lipz_dialogue_variant(get(), &locale, key.data(), key.size(), out); });
    }
    std::optional<lipz_voice> voice(std::string_view tag) const noexcept {
        return answer<lipz_voice>([&](auto *out) { return lipz_dialogue_voice(get(), tag.data(), tag.size(), out); });
    }
    /// Returns the voices, that of the originals first; empty without dubs.
    auto voices() const noexcept {
        return by_index<lipz_voice>([this](std::uint32_t index, lipz_voice *out) {
            return lipz_dialogue_voice_by_index(get(), index, out);
        });
    }
    /// Returns the name, which is false if no event contains it.
    Name name(std::string_view name) const noexcept {
        lipz_name found;
        lipz_dialogue_event_name(get(), name.data(), name.size(), &found);
        return found;
    }
    /// Returns the babble profile with this name; without one, the project's.
    std::optional<lipz_babble> babble(std::string_view name = {}) const noexcept {
        return answer<lipz_babble>([&](auto *out) { return lipz_dialogue_babble(get(), name.data(), name.size(), out); });
    }
    std::optional<lipz_weights> babble_at(const lipz_babble &babble, Time time, float power) const noexcept {
        return answer<lipz_weights>([&](auto *out) { return lipz_babble_at(get(), &babble, time, power, out); });
    }
    std::optional<lipz_weights> babble_at_level(const lipz_babble &babble, Time time, std::uint32_t level) const noexcept {
        return answer<lipz_weights>([&](auto *out) { return lipz_babble_at_level(get(), &babble, time, level, out); });
    }
    /// Returns the face profile with this name; without one, the project's.
    std::optional<lipz_face_profile> face_profile(std::string_view name = {}) const noexcept {
        return answer<lipz_face_profile>(
            [&](auto *out) { return lipz_dialogue_face_profile(get(), name.data(), name.size(), out); });
    }
    /// Returns the articulation profile with this name; without one, the project's.
    std::optional<lipz_articulation_profile> articulation_profile(std::string_view name = {}) const noexcept {
        return answer<lipz_articulation_profile>(
            [&](auto *out) { return lipz_dialogue_articulation_profile(get(), name.data(), name.size(), out); });
    }
    /// Returns the rig with this name.
    std::optional<Rig> rig(std::string_view name) const noexcept {
        return answer_in<Rig, lipz_rig>(
            *get(), [&](auto *out) { return lipz_dialogue_rig(get(), name.data(), name.size(), out); });
    }
    /// Returns the face of a silent character. Null stands for the project's profile.
    std::optional<lipz_face> idle_at(Time time, std::uint64_t seed, const lipz_face_profile *profile = nullptr,
                                     const LookAt &look_at = LookAt()) const noexcept {
        return answer<lipz_face>([&](auto *out) { return lipz_face_idle_at(get(), time, seed, profile, &look_at, out); });
    }
    /// Returns a cursor; nothing without a frame rate: set one on the clip.
    std::optional<Cursor> cursor(const lipz_clip &clip) const noexcept {
        return answer<Cursor, lipz_cursor>([&](auto *out) { return lipz_cursor_new(get(), &clip, sizeof *out, out); });
    }

  private:
    /// The data that must not move when the dialogue is moved.
    struct State {
        std::uint32_t flags;
        std::vector<std::filesystem::path> paths;
        std::vector<std::vector<std::uint8_t>> owned;
        std::vector<lipz_bytes> contents;
        std::vector<lipz_file> files;
        lipz_dialogue dialogue;
    };
    explicit Dialogue(std::uint32_t flags) : state_(std::make_unique<State>()) { state_->flags = flags; }
    lipz_bytes add(const std::filesystem::path &path) {
        std::error_code code;
        const auto length = std::filesystem::file_size(path, code);
        std::vector<std::uint8_t> bytes(code ? 0 : static_cast<std::size_t>(length));
        std::ifstream file(path, std::ios::binary);
        if (code || !file.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
            throw Error(LIPZ_NONE, path);
        }
        if (bytes.empty()) {
            throw Error(LIPZ_TOO_SHORT, path);
        }
        state_->paths.push_back(path);
        state_->contents.push_back({bytes.data(), bytes.size()});
        state_->owned.push_back(std::move(bytes));
        return state_->contents.back();
    }
    Error error(lipz_status status, std::uint32_t number, std::uint32_t offset_bytes) const {
        return Error(status, number < state_->paths.size() ? state_->paths[number] : "dialogue", offset_bytes);
    }
    Dialogue opened() {
        lipz_problem problem;
        state_->files.resize(state_->contents.size());
        const auto status = lipz_dialogue_open(&state_->dialogue, state_->files.data(), state_->contents.data(),
                                               state_->contents.size(), state_->flags, &problem);
        if (status != LIPZ_OK) {
            throw error(status, problem.file, problem.offset_bytes);
        }
        return std::move(*this);
    }
    std::unique_ptr<State> state_;
};

} // namespace lipz

#endif // LIPZ_HPP
