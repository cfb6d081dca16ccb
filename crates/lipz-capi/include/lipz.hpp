// lipz.hpp - the reader of lipz dialogue banks for C++17: ranges, std::string_view and std::optional over lipz.h.
// https://github.com/lipz/lipz, MIT OR Apache-2.0. docs/C.md shows how to use it.
//
// Header only. Nothing here allocates or throws, but what has `must` in its name: it throws lipz::Error. Strings are views
// into the bytes of the bank, which the program keeps. Every struct of lipz.h is there as the base of a class, so that
// each function of lipz.h takes it, too.
#ifndef LIPZ_HPP
#define LIPZ_HPP

#include "lipz.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lipz {

inline std::string_view view(const lipz_string &string) noexcept {
    return string.data == nullptr ? std::string_view() : std::string_view(string.data, string.length_bytes);
}

/// A status that is not `LIPZ_OK`, as an exception.
class Error : public std::runtime_error {
  public:
    explicit Error(lipz_status status, std::uint32_t offset_bytes = 0)
        : std::runtime_error(message(status)), status_(status), offset_bytes_(offset_bytes) {}
    lipz_status status() const noexcept { return status_; }
    /// Where the damage is: bytes from the start of the file.
    std::uint32_t offset_bytes() const noexcept { return offset_bytes_; }

  private:
    static std::string message(lipz_status status) {
        lipz_string text;
        lipz_status_message(status, &text);
        return std::string(view(text));
    }
    lipz_status status_;
    std::uint32_t offset_bytes_;
};

/// Throws an Error unless a call has succeeded.
inline void must(lipz_status status, std::uint32_t place) {
    if (status != LIPZ_OK) {
        throw Error(status, place);
    }
}

/// What a function of lipz.h writes to its last pointer, if there is an answer: as it is, or as a class of this header.
template <typename T, typename Of = T, typename Ask> std::optional<T> answer(Ask ask) noexcept {
    Of found;
    return ask(&found) == LIPZ_OK ? std::optional<T>(T(found)) : std::nullopt;
}

/// A time since the sound began. Numbers with a point are seconds.
struct Micros {
    std::int64_t us;
};
/// A position in samples of one channel.
struct Samples {
    std::int64_t position;
    std::uint32_t rate_hz;
};

/// A name that events mention; false if there is none.
struct Name : lipz_name {
    Name() noexcept : lipz_name{{nullptr, 0}, LIPZ_NO_NAME, 0} {}
    Name(const lipz_name &name) noexcept : lipz_name(name) {}
    explicit operator bool() const noexcept { return id != LIPZ_NO_NAME; }
    std::string_view str() const noexcept { return view(name); }
    friend bool operator==(const Name &a, const Name &b) noexcept { return a.id == b.id && a.bank == b.bank; }
    friend bool operator!=(const Name &a, const Name &b) noexcept { return !(a == b); }
};

enum class Verb : std::uint32_t {
    feels = LIPZ_FEELS,
    sees = LIPZ_SEES,
    stares = LIPZ_STARES,
    stops_staring = LIPZ_STOPS_STARING,
    points = LIPZ_POINTS,
    stops_pointing = LIPZ_STOPS_POINTING,
    does = LIPZ_DOES,
    nods = LIPZ_NODS,
    shakes = LIPZ_SHAKES,
    breathes = LIPZ_BREATHES,
    blinks = LIPZ_BLINKS,
    looks_away = LIPZ_LOOKS_AWAY,
};

/// One event: who does what, and to whom.
struct Event {
    Name character;
    Verb verb;
    Name object;
};

/// What a character feels, stares and points at.
struct Character {
    Name name, feels, stares_at, points_at;
    explicit Character(const lipz_character &of) noexcept
        : name(of.name), feels(of.feels), stares_at(of.stares_at), points_at(of.points_at) {}
};

struct Text {
    std::string_view text;
    /// Whether this is the text of another locale.
    bool is_fallback;
};

/// What `next` gives until it gives nothing, for `for (auto item : range)`.
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

/// A range of what a function gives.
template <typename T, typename Next> Range<T, Next> range(Next next) { return Range<T, Next>(next); }

/// A stretch of a clip.
struct Segment : lipz_segment {
    Segment(const lipz_segment &segment) noexcept : lipz_segment(segment) {}
    std::optional<Text> text(const lipz_bank &bank, const lipz_locale &locale) const noexcept {
        lipz_text text;
        if (lipz_segment_text(&bank, this, &locale, &text) != LIPZ_OK) {
            return std::nullopt;
        }
        return Text{{text.data, text.length_bytes}, text.is_fallback != 0};
    }
    /// The event string, in whatever syntax; nothing if the file has no events.
    std::optional<std::string_view> event(const lipz_bank &bank) const noexcept {
        const auto string =
            answer<lipz_string>([&](lipz_string *out) { return lipz_segment_event_string(&bank, this, out); });
        return string ? std::optional(view(*string)) : std::nullopt;
    }
};

/// The attributes of emotion, in the order of lipz.h.
enum class Emotion : std::uint32_t {
    sadness = LIPZ_SADNESS,
    anger = LIPZ_ANGER,
    joy = LIPZ_JOY,
    fear = LIPZ_FEAR,
    disgust = LIPZ_DISGUST,
    surprise = LIPZ_SURPRISE,
    shock = LIPZ_SHOCK,
    perplexed = LIPZ_PERPLEXED,
    asleep = LIPZ_ASLEEP,
    pain = LIPZ_PAIN,
    exertion = LIPZ_EXERTION,
    shout = LIPZ_SHOUT,
};

/// The name of an attribute, which is that of its curve.
inline std::string_view name_of(Emotion emotion) noexcept {
    constexpr std::array<std::string_view, LIPZ_EMOTION_COUNT> NAMES = {
        "sadness", "anger", "joy", "fear", "disgust", "surprise", "shock", "perplexed", "asleep", "pain", "exertion", "shout"};
    const auto place = static_cast<std::size_t>(emotion);
    return place < NAMES.size() ? NAMES[place] : std::string_view();
}

/// What somebody feels: values and `sum` in thousandths, all 0 for a neutral face.
struct Emotions : lipz_emotions {
    Emotions(const lipz_emotions &emotions) noexcept : lipz_emotions(emotions) {}
    std::int32_t operator[](Emotion emotion) const noexcept { return thousandths[static_cast<std::size_t>(emotion)]; }
    /// The attribute with the highest value; nothing for a neutral face.
    std::optional<Emotion> strongest_emotion() const noexcept {
        return strongest == LIPZ_NEUTRAL ? std::nullopt : std::optional(static_cast<Emotion>(strongest));
    }
};

/// Which key of a curve was needed last: passed with each picture, no key is searched for. A new one is as good.
struct CurveCursor : lipz_curve_cursor {
    CurveCursor() noexcept : lipz_curve_cursor{0} {}
};

/// A number that changes while its clip plays. Values are thousandths.
struct Curve : lipz_curve {
    Curve(const lipz_clip &clip, const lipz_curve &curve) noexcept : lipz_curve(curve), clip_(clip) {}
    std::string_view name_view() const noexcept { return view(name); }
    /// The keys, in the order of their frames. The bank and the curve outlive the range.
    auto keys(const lipz_bank &bank) const noexcept {
        return range<lipz_curve_key>([this, &bank, index = std::uint32_t(0)]() mutable {
            return answer<lipz_curve_key>(
                [&](lipz_curve_key *out) { return lipz_clip_curve_key(&bank, &clip_, this, index++, out); });
        });
    }
    /// The value at the start of a frame.
    std::int32_t value(const lipz_bank &bank, std::uint32_t frame, CurveCursor *cursor = nullptr) const noexcept {
        return ask([&](auto *out) { return lipz_clip_curve_value(&bank, &clip_, this, cursor, frame, out); }).value_or(0);
    }
    /// The value at a time; nothing without a frame rate.
    std::optional<std::int32_t> value_at(const lipz_bank &bank, Micros time, CurveCursor *cursor = nullptr) const noexcept {
        return ask([&](auto *out) { return lipz_clip_curve_value_at_us(&bank, &clip_, this, cursor, time.us, out); });
    }
    std::optional<std::int32_t> value_at(const lipz_bank &bank, Samples time, CurveCursor *cursor = nullptr) const noexcept {
        return ask([&](auto *out) {
            return lipz_clip_curve_value_at_samples(&bank, &clip_, this, cursor, time.position, time.rate_hz, out);
        });
    }
    std::optional<std::int32_t> value_at(const lipz_bank &bank, double seconds, CurveCursor *cursor = nullptr) const noexcept {
        return ask([&](auto *out) { return lipz_clip_curve_value_at_seconds(&bank, &clip_, this, cursor, seconds, out); });
    }
    std::optional<std::int32_t> value_at(const lipz_bank &bank, float seconds, CurveCursor *cursor = nullptr) const noexcept {
        return ask(
            [&](auto *out) { return lipz_clip_curve_value_at_seconds_f32(&bank, &clip_, this, cursor, seconds, out); });
    }

  private:
    template <typename Ask> static std::optional<std::int32_t> ask(Ask ask) noexcept {
        return answer<std::int32_t>(ask);
    }
    lipz_clip clip_;
};

/// Whose face and emotions: `"mara"` for a character who listens, `Who::speaker("mara")` for the one who speaks. The name outlives it.
struct Who : lipz_who {
    Who(std::string_view name) noexcept : Who(name, 0) {}
    Who(const char *name) noexcept : Who(std::string_view(name), 0) {}
    Who(const std::string &name) noexcept : Who(std::string_view(name), 0) {}
    static Who speaker(std::string_view name) noexcept { return Who(name, 1); }

  private:
    Who(std::string_view name, std::uint32_t is_speaker) noexcept : lipz_who{{name.data(), name.size()}, is_speaker} {}
};

/// What somebody looks at: a direction in thousandths of degrees, up and to the left, as seen from the head at rest.
struct LookAt : lipz_look_at {
    /// Somebody straight ahead.
    LookAt() noexcept : lipz_look_at{0, 0, 1} {}
    /// Somebody, over whose face, hands and body the eyes go.
    static LookAt person(std::int32_t pitch, std::int32_t yaw) noexcept { return LookAt(pitch, yaw, 1); }
    /// Something that they stay on.
    static LookAt point(std::int32_t pitch, std::int32_t yaw) noexcept { return LookAt(pitch, yaw, 0); }

  private:
    LookAt(std::int32_t pitch, std::int32_t yaw, std::uint32_t is_person) noexcept
        : lipz_look_at{pitch, yaw, is_person} {}
};

/// How a face moves by itself. Of another bank, it makes no faces.
struct FaceProfile : lipz_face_profile {
    FaceProfile(const lipz_face_profile &profile) noexcept : lipz_face_profile(profile) {}
    std::string_view name_view() const noexcept { return view(name); }
    /// The face of somebody who says nothing: they blink and look. The seed tells them apart from others.
    std::optional<lipz_face> idle_at(const lipz_bank &bank, Micros time, std::uint64_t seed,
                                     const LookAt &look = {}) const noexcept {
        return ask([&](auto *out) { return lipz_face_idle_at_us(&bank, this, &look, seed, time.us, out); });
    }
    std::optional<lipz_face> idle_at(const lipz_bank &bank, Samples time, std::uint64_t seed,
                                     const LookAt &look = {}) const noexcept {
        return ask([&](auto *out) {
            return lipz_face_idle_at_samples(&bank, this, &look, seed, time.position, time.rate_hz, out);
        });
    }
    std::optional<lipz_face> idle_at(const lipz_bank &bank, double seconds, std::uint64_t seed,
                                     const LookAt &look = {}) const noexcept {
        return ask([&](auto *out) { return lipz_face_idle_at_seconds(&bank, this, &look, seed, seconds, out); });
    }
    std::optional<lipz_face> idle_at(const lipz_bank &bank, float seconds, std::uint64_t seed,
                                     const LookAt &look = {}) const noexcept {
        return ask([&](auto *out) { return lipz_face_idle_at_seconds_f32(&bank, this, &look, seed, seconds, out); });
    }

  private:
    template <typename Ask> static std::optional<lipz_face> ask(Ask ask) noexcept { return answer<lipz_face>(ask); }
};

/// One spoken line.
struct Clip : lipz_clip {
    Clip(const lipz_clip &clip) noexcept : lipz_clip(clip) {}
    /// The clip with this frame rate, where its file has none.
    Clip or_fps(std::uint32_t numerator, std::uint32_t denominator = 1) const noexcept {
        Clip given = *this;
        if (fps_denominator == 0) {
            given.fps_numerator = numerator;
            given.fps_denominator = denominator;
        }
        return given;
    }
    std::string_view key(const lipz_bank &bank) const noexcept {
        const auto key = answer<lipz_string>([&](lipz_string *out) { return lipz_clip_key(&bank, this, out); });
        return key ? view(*key) : std::string_view();
    }
    /// The locale of the voice that the clip is spoken in; nothing in a bank without dubs.
    std::optional<std::string_view> voice(const lipz_bank &bank) const noexcept {
        const auto tag = answer<lipz_string>([&](lipz_string *out) { return lipz_clip_voice(&bank, this, out); });
        return tag ? std::optional<std::string_view>(view(*tag)) : std::nullopt;
    }
    /// The clip as it is played in a voice, and whose it is: `LIPZ_DUB`, `LIPZ_OTHER_DUB` or `LIPZ_ORIGINAL`. Nothing if the bank
    /// has no such voice: play the clip as it is.
    std::optional<lipz_voiced_clip> in_voice(const lipz_bank &bank, std::string_view tag) const noexcept {
        return answer<lipz_voiced_clip>(
            [&](lipz_voiced_clip *out) { return lipz_clip_in_voice(&bank, this, tag.data(), tag.size(), out); });
    }
    /// The curve with this name; nothing if the clip has none.
    std::optional<Curve> curve(const lipz_bank &bank, std::string_view name) const noexcept {
        return curve_of([&](lipz_curve *out) { return lipz_clip_curve(&bank, this, name.data(), name.size(), out); });
    }
    /// All curves, in the order of their names. The bank and the clip outlive the range.
    auto curves(const lipz_bank &bank) const noexcept {
        return range<Curve>([this, &bank, index = std::uint32_t(0)]() mutable {
            return curve_of([&](lipz_curve *out) { return lipz_clip_curve_at(&bank, this, index++, out); });
        });
    }
    /// What the speaker feels at a time: neutral without curves of emotion, and without a frame rate.
    Emotions emotions_at(const lipz_bank &bank, Micros time) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_at_us(&bank, this, time.us, out); });
    }
    Emotions emotions_at(const lipz_bank &bank, Samples time) const noexcept {
        return emotions([&](auto *out) {
            return lipz_clip_emotions_at_samples(&bank, this, time.position, time.rate_hz, out);
        });
    }
    Emotions emotions_at(const lipz_bank &bank, double seconds) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_at_seconds(&bank, this, seconds, out); });
    }
    Emotions emotions_at(const lipz_bank &bank, float seconds) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_at_seconds_f32(&bank, this, seconds, out); });
    }
    /// What a character of the clip feels at a time: `mara feels fear 4` in its events is in the curve `mara.fear`.
    Emotions emotions_of(const lipz_bank &bank, const Who &who, Micros time) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_of_us(&bank, this, &who, time.us, out); });
    }
    Emotions emotions_of(const lipz_bank &bank, const Who &who, Samples time) const noexcept {
        return emotions([&](auto *out) {
            return lipz_clip_emotions_of_samples(&bank, this, &who, time.position, time.rate_hz, out);
        });
    }
    Emotions emotions_of(const lipz_bank &bank, const Who &who, double seconds) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_of_seconds(&bank, this, &who, seconds, out); });
    }
    Emotions emotions_of(const lipz_bank &bank, const Who &who, float seconds) const noexcept {
        return emotions([&](auto *out) { return lipz_clip_emotions_of_seconds_f32(&bank, this, &who, seconds, out); });
    }
    /// The speaker's face at a time, besides mouth and emotions; nothing for a profile of another bank.
    std::optional<lipz_face> face_at(const lipz_bank &bank, Micros time, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) { return lipz_clip_face_at_us(&bank, this, &profile, &look, time.us, out); });
    }
    std::optional<lipz_face> face_at(const lipz_bank &bank, Samples time, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_clip_face_at_samples(&bank, this, &profile, &look, time.position, time.rate_hz, out);
        });
    }
    std::optional<lipz_face> face_at(const lipz_bank &bank, double seconds, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) { return lipz_clip_face_at_seconds(&bank, this, &profile, &look, seconds, out); });
    }
    std::optional<lipz_face> face_at(const lipz_bank &bank, float seconds, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face(
            [&](auto *out) { return lipz_clip_face_at_seconds_f32(&bank, this, &profile, &look, seconds, out); });
    }
    /// The face of a character of the clip: with their own curves and emotions, and without the motion of a head that speaks.
    std::optional<lipz_face> face_of(const lipz_bank &bank, const Who &who, Micros time, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) { return lipz_clip_face_of_us(&bank, this, &who, &profile, &look, time.us, out); });
    }
    std::optional<lipz_face> face_of(const lipz_bank &bank, const Who &who, Samples time, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_clip_face_of_samples(&bank, this, &who, &profile, &look, time.position, time.rate_hz, out);
        });
    }
    std::optional<lipz_face> face_of(const lipz_bank &bank, const Who &who, double seconds, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) { return lipz_clip_face_of_seconds(&bank, this, &who, &profile, &look, seconds, out); });
    }
    std::optional<lipz_face> face_of(const lipz_bank &bank, const Who &who, float seconds, const FaceProfile &profile,
                                     const LookAt &look = {}) const noexcept {
        return face(
            [&](auto *out) { return lipz_clip_face_of_seconds_f32(&bank, this, &who, &profile, &look, seconds, out); });
    }
    std::uint32_t lead_one_frame() const noexcept { return of(lipz_lead_one_frame); }
    std::uint32_t lead_two_frames() const noexcept { return of(lipz_lead_two_frames); }
    std::uint32_t hold_readable() const noexcept { return of(lipz_hold_readable); }
    std::uint32_t hold_for_display(std::uint32_t picture_us) const noexcept {
        return answer<std::uint32_t>([&](std::uint32_t *out) { return lipz_hold_for_display(this, picture_us, out); })
            .value_or(0);
    }

  private:
    template <typename Ask> std::optional<Curve> curve_of(Ask ask) const noexcept {
        const auto found = answer<lipz_curve>(ask);
        return found ? std::optional(Curve(*this, *found)) : std::nullopt;
    }
    template <typename Ask> static std::optional<lipz_face> face(Ask ask) noexcept { return answer<lipz_face>(ask); }
    /// The function writes a neutral face where there is no other answer.
    template <typename Ask> static Emotions emotions(Ask ask) noexcept {
        lipz_emotions found;
        ask(&found);
        return found;
    }
    std::uint32_t of(lipz_status (*ask)(const lipz_clip *, std::uint32_t *)) const noexcept {
        return answer<std::uint32_t>([&](std::uint32_t *out) { return ask(this, out); }).value_or(0);
    }
};

/// A babble profile.
struct Babble : lipz_babble {
    Babble(const lipz_babble &babble) noexcept : lipz_babble(babble) {}
    std::string_view name_view() const noexcept { return view(name); }
    std::optional<lipz_weights> at(const lipz_bank &bank, Micros time, float power) const noexcept {
        return ask([&](auto *out) { return lipz_babble_at_us(&bank, this, time.us, power, out); });
    }
    std::optional<lipz_weights> at(const lipz_bank &bank, Samples time, float power) const noexcept {
        return ask([&](auto *out) {
            return lipz_babble_at_samples(&bank, this, time.position, time.rate_hz, power, out);
        });
    }
    std::optional<lipz_weights> at(const lipz_bank &bank, double seconds, float power) const noexcept {
        return ask([&](auto *out) { return lipz_babble_at_seconds(&bank, this, seconds, power, out); });
    }
    std::optional<lipz_weights> at(const lipz_bank &bank, float seconds, float power) const noexcept {
        return ask([&](auto *out) { return lipz_babble_at_seconds_f32(&bank, this, seconds, power, out); });
    }
    /// At a level of the voice in 65,536ths, such as LIPZ_UNMEASURED.
    std::optional<lipz_weights> at_level(const lipz_bank &bank, Micros time, std::uint32_t level) const noexcept {
        return ask([&](auto *out) { return lipz_babble_at_us_level(&bank, this, time.us, level, out); });
    }

  private:
    template <typename Ask> static std::optional<lipz_weights> ask(Ask ask) noexcept {
        return answer<lipz_weights>(ask);
    }
};

/// Where a clip is while it is played.
class Cursor : public lipz_cursor {
  public:
    Cursor(const lipz_cursor &cursor) noexcept : lipz_cursor(cursor) {}
    bool is_over() const noexcept { return frame == LIPZ_OVER; }
    bool is_waiting() const noexcept { return frame == LIPZ_WAITING; }
    void set_speaker(const Name &name) noexcept {
        speaker_id = name.id;
        speaker_bank = name.bank;
    }

    /// The sound has reached this time. Then go through `events` or `segments`.
    Cursor &advance_to(const lipz_bank &bank, Micros time) noexcept {
        return done(lipz_cursor_advance_us(&bank, this, time.us));
    }
    Cursor &advance_to(const lipz_bank &bank, Samples time) noexcept {
        return done(lipz_cursor_advance_samples(&bank, this, time.position, time.rate_hz));
    }
    Cursor &advance_to(const lipz_bank &bank, double seconds) noexcept {
        return done(lipz_cursor_advance_seconds(&bank, this, seconds));
    }
    Cursor &advance_to(const lipz_bank &bank, float seconds) noexcept {
        return done(lipz_cursor_advance_seconds_f32(&bank, this, seconds));
    }
    /// The sound has jumped from its end to its start, and has reached this time since.
    Cursor &loop_to(const lipz_bank &bank, Micros time) noexcept {
        return done(lipz_cursor_loop_us(&bank, this, time.us));
    }
    Cursor &loop_to(const lipz_bank &bank, Samples time) noexcept {
        return done(lipz_cursor_loop_samples(&bank, this, time.position, time.rate_hz));
    }
    Cursor &loop_to(const lipz_bank &bank, double seconds) noexcept {
        return done(lipz_cursor_loop_seconds(&bank, this, seconds));
    }
    Cursor &loop_to(const lipz_bank &bank, float seconds) noexcept {
        return done(lipz_cursor_loop_seconds_f32(&bank, this, seconds));
    }
    /// Jumps: nothing is due.
    Cursor &seek(const lipz_bank &bank, Micros time) noexcept { return done(lipz_cursor_seek_us(&bank, this, time.us)); }
    Cursor &seek(const lipz_bank &bank, Samples time) noexcept {
        return done(lipz_cursor_seek_samples(&bank, this, time.position, time.rate_hz));
    }
    Cursor &seek(const lipz_bank &bank, double seconds) noexcept {
        return done(lipz_cursor_seek_seconds(&bank, this, seconds));
    }
    Cursor &seek(const lipz_bank &bank, float seconds) noexcept {
        return done(lipz_cursor_seek_seconds_f32(&bank, this, seconds));
    }
    /// Ends the clip before the sound does.
    Cursor &finish(const lipz_bank &bank) noexcept { return done(lipz_cursor_finish(&bank, this)); }
    /// What became of the last move: not LIPZ_OK if the bank has no such clip any more.
    lipz_status status() const noexcept { return status_; }

    /// The events that are due, each once: going through them takes them. The bank and the cursor outlive the range.
    auto events(const lipz_bank &bank) noexcept {
        return range<Event>([this, &bank]() -> std::optional<Event> {
            lipz_event event;
            if (lipz_cursor_take_event(&bank, this, &event) != LIPZ_OK) {
                return std::nullopt;
            }
            return Event{event.character, static_cast<Verb>(event.verb), event.object};
        });
    }
    /// The segments that are due, for event strings of another syntax. Going through them takes them.
    auto segments(const lipz_bank &bank) noexcept {
        return range<Segment>([this, &bank]() -> std::optional<Segment> {
            return answer<Segment, lipz_segment>(
                [&](lipz_segment *out) { return lipz_cursor_take_segment(&bank, this, out); });
        });
    }
    /// Every character of the clip with its state: what to set after a jump.
    auto characters(const lipz_bank &bank) const noexcept {
        return range<Character>([this, &bank, index = std::uint32_t(0)]() mutable -> std::optional<Character> {
            return answer<Character, lipz_character>(
                [&](lipz_character *out) { return lipz_cursor_character_at(&bank, this, index++, out); });
        });
    }

    char viseme(const lipz_bank &bank) const noexcept {
        lipz_viseme viseme;
        lipz_cursor_viseme(&bank, this, &viseme);
        return static_cast<char>(viseme);
    }
    /// In ten-thousandths; nothing if the clip has no mouth shapes: let the mouth babble.
    std::optional<std::uint32_t> openness(const lipz_bank &bank) const noexcept {
        return answer<std::uint32_t>([&](std::uint32_t *out) { return lipz_cursor_openness(&bank, this, out); });
    }
    std::optional<Segment> segment(const lipz_bank &bank) const noexcept {
        return answer<Segment, lipz_segment>([&](lipz_segment *out) { return lipz_cursor_segment(&bank, this, out); });
    }
    /// The speaker's state without a name.
    std::optional<Character> character(const lipz_bank &bank, const Name &name = Name()) const noexcept {
        return answer<Character, lipz_character>(
            [&](lipz_character *out) { return lipz_cursor_character(&bank, this, &name, out); });
    }

  private:
    Cursor &done(lipz_status status) noexcept {
        status_ = status;
        return *this;
    }
    lipz_status status_ = LIPZ_OK;
};

/// An opened bank over bytes that the program keeps: nothing to close.
class Bank : public lipz_bank {
  public:
    /// Opens the bytes and checks every one of them. Throws an Error.
    static Bank must_open(const void *data, std::size_t length_bytes) {
        Bank bank;
        std::uint32_t place = 0;
        must(lipz_bank_open(static_cast<const std::uint8_t *>(data), length_bytes, &bank, &place), place);
        must(lipz_bank_verify(&bank, &place), place);
        return bank;
    }
    /// Uses the locales of a text bank from now on, checked. Throws an Error.
    void must_use_texts(const void *data, std::size_t length_bytes) {
        std::uint32_t place = 0;
        lipz_bank with = *this;
        must(lipz_bank_use_texts(&with, static_cast<const std::uint8_t *>(data), length_bytes, &place), place);
        must(lipz_bank_verify(&with, &place), place);
        static_cast<lipz_bank &>(*this) = with;
    }
    std::optional<Clip> clip(std::uint64_t id) const noexcept {
        return answer<Clip, lipz_clip>([&](lipz_clip *out) { return lipz_clip_by_id(this, id, out); });
    }
    std::optional<Clip> clip(std::string_view key) const noexcept {
        return answer<Clip, lipz_clip>([&](lipz_clip *out) { return lipz_clip_by_key(this, key.data(), key.size(), out); });
    }
    std::optional<lipz_locale> locale(std::string_view tag) const noexcept {
        return answer<lipz_locale>(
            [&](lipz_locale *out) { return lipz_locale_by_tag(this, tag.data(), tag.size(), out); });
    }
    /// The locales of the voices: that of the originals first. None in a bank without dubs.
    auto voices() const noexcept {
        return range<std::string_view>([this, index = std::uint32_t(0)]() mutable -> std::optional<std::string_view> {
            const auto tag = answer<lipz_string>([&](lipz_string *out) { return lipz_voice_at(this, index++, out); });
            return tag ? std::optional<std::string_view>(view(*tag)) : std::nullopt;
        });
    }
    /// No name if no event mentions it.
    Name name(std::string_view name) const noexcept {
        lipz_name found;
        lipz_event_name(this, name.data(), name.size(), &found);
        return found;
    }
    /// Nothing without a frame rate: give the clip one.
    std::optional<Cursor> cursor(const lipz_clip &clip) const noexcept {
        return answer<Cursor, lipz_cursor>(
            [&](lipz_cursor *out) { return lipz_cursor_new(this, &clip, sizeof *out, out); });
    }
    std::optional<Babble> babble(std::string_view name) const noexcept {
        return answer<Babble, lipz_babble>(
            [&](lipz_babble *out) { return lipz_babble_by_name(this, name.data(), name.size(), out); });
    }
    std::optional<Babble> default_babble() const noexcept {
        return answer<Babble, lipz_babble>([&](lipz_babble *out) { return lipz_babble_default(this, out); });
    }
    std::optional<FaceProfile> face_profile(std::string_view name) const noexcept {
        return answer<FaceProfile, lipz_face_profile>([&](lipz_face_profile *out) {
            return lipz_face_profile_by_name(this, name.data(), name.size(), out);
        });
    }
    /// `[face]` of the project's settings; the usual one if it has none.
    std::optional<FaceProfile> default_face_profile() const noexcept {
        return answer<FaceProfile, lipz_face_profile>(
            [&](lipz_face_profile *out) { return lipz_face_profile_default(this, out); });
    }

  private:
    Bank() noexcept : lipz_bank() {}
};

/// A clip of a stack: `bank(clip)` of its Layers is the bank to ask about its mouth, segments, events and curves.
struct LayeredClip : lipz_layered_clip {
    LayeredClip(const lipz_layered_clip &found) noexcept : lipz_layered_clip(found) {}
    /// The clip in its own bank.
    Clip own() const noexcept { return clip; }
    bool has_texts() const noexcept { return texts_layer != LIPZ_NO_LAYER; }
};

/// A clip of a stack as it is played in a voice, and whose it is: `LIPZ_DUB`, `LIPZ_OTHER_DUB` or `LIPZ_ORIGINAL`.
struct LayeredVoicedClip {
    LayeredVoicedClip(const lipz_layered_voiced_clip &found) noexcept : clip(found.clip), spoken(found.spoken) {}
    LayeredClip clip;
    std::uint32_t spoken;
};

/// A bank and the layers over it, the topmost of which answers. It keeps the `N` banks, not their bytes.
template <std::size_t N> class Layers {
  public:
    /// Checks that these banks make a stack, the base first. Throws an Error.
    template <typename... Banks> static Layers must_stack(const Banks &...banks) {
        const Layers layers(std::array<lipz_bank, N>{static_cast<const lipz_bank &>(banks)...});
        must(lipz_layers_check(layers.banks_.data(), count(), nullptr), 0);
        return layers;
    }
    static constexpr std::uint32_t count() noexcept { return static_cast<std::uint32_t>(N); }
    /// The banks, the base first.
    const std::array<lipz_bank, N> &banks() const noexcept { return banks_; }
    /// The bank that a clip is in.
    const lipz_bank &bank(const LayeredClip &clip) const noexcept { return banks_[clip.layer < N ? clip.layer : 0]; }
    std::optional<LayeredClip> clip(std::uint64_t id) const noexcept {
        return answer<LayeredClip, lipz_layered_clip>(
            [&](lipz_layered_clip *out) { return lipz_layers_clip_by_id(banks_.data(), count(), id, out); });
    }
    std::optional<LayeredClip> clip(std::string_view key) const noexcept {
        return answer<LayeredClip, lipz_layered_clip>([&](lipz_layered_clip *out) {
            return lipz_layers_clip_by_key(banks_.data(), count(), key.data(), key.size(), out);
        });
    }
    /// The locale with this tag where the clip has its texts, or what stands in for it there. Look it up once for each `texts_layer`.
    std::optional<lipz_layered_locale> locale(const LayeredClip &clip, std::string_view tag) const noexcept {
        return answer<lipz_layered_locale>([&](lipz_layered_locale *out) {
            return lipz_layers_locale(banks_.data(), count(), clip.texts_layer, tag.data(), tag.size(), out);
        });
    }
    /// The text of the segment with this index; nothing if the clip has none, also by fallback.
    std::optional<Text> text(const LayeredClip &clip, std::uint32_t segment,
                             const lipz_layered_locale &locale) const noexcept {
        lipz_text text;
        if (lipz_layers_text(banks_.data(), count(), &clip, segment, &locale, &text) != LIPZ_OK) {
            return std::nullopt;
        }
        return Text{{text.data, text.length_bytes}, text.is_fallback != 0};
    }
    /// Nothing without a frame rate: give the clip one.
    std::optional<Cursor> cursor(const LayeredClip &clip) const noexcept {
        return answer<Cursor, lipz_cursor>(
            [&](lipz_cursor *out) { return lipz_cursor_new(&bank(clip), &clip.clip, sizeof *out, out); });
    }
    /// Which banks say what is said once: babble profiles, face profiles, the default locale.
    lipz_layers_info_t info() const noexcept {
        lipz_layers_info_t found;
        lipz_layers_info(banks_.data(), count(), &found);
        return found;
    }
    /// The locales of the voices: that of the originals first. None in a stack without dubs.
    auto voices() const noexcept {
        return range<std::string_view>([this, index = std::uint32_t(0)]() mutable -> std::optional<std::string_view> {
            const auto tag = answer<lipz_string>(
                [&](lipz_string *out) { return lipz_layers_voice_at(banks_.data(), count(), index++, out); });
            return tag ? std::optional<std::string_view>(view(*tag)) : std::nullopt;
        });
    }
    /// The clip with this id as it is played in a voice; nothing if the stack has no such voice: play the clip as it is.
    std::optional<LayeredVoicedClip> in_voice(std::uint64_t id, std::string_view tag) const noexcept {
        return answer<LayeredVoicedClip, lipz_layered_voiced_clip>([&](lipz_layered_voiced_clip *out) {
            return lipz_layers_clip_in_voice(banks_.data(), count(), id, tag.data(), tag.size(), out);
        });
    }
    /// The face profile with this name, of the topmost bank that says something about profiles.
    std::optional<FaceProfile> face_profile(std::string_view name) const noexcept {
        return answer<FaceProfile, lipz_face_profile>([&](lipz_face_profile *out) {
            return lipz_face_profile_by_name(of_faces(), name.data(), name.size(), out);
        });
    }
    /// The face profile of the project; the usual one if it has none.
    std::optional<FaceProfile> default_face_profile() const noexcept {
        return answer<FaceProfile, lipz_face_profile>(
            [&](lipz_face_profile *out) { return lipz_face_profile_default(of_faces(), out); });
    }
    /// The bank whose profiles these are, for `idle_at`.
    const lipz_bank *of_faces() const noexcept { return &banks_[info().faces_layer % N]; }
    /// The speaker's face at a time, besides mouth and emotions, with a profile of the stack, or that of the project.
    std::optional<lipz_face> face_at(const LayeredClip &clip, Micros time, const FaceProfile *profile = nullptr,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_at_us(banks_.data(), count(), &clip, profile, &look, time.us, out);
        });
    }
    std::optional<lipz_face> face_at(const LayeredClip &clip, Samples time, const FaceProfile *profile = nullptr,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_at_samples(banks_.data(), count(), &clip, profile, &look, time.position,
                                               time.rate_hz, out);
        });
    }
    std::optional<lipz_face> face_at(const LayeredClip &clip, double seconds, const FaceProfile *profile = nullptr,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_at_seconds(banks_.data(), count(), &clip, profile, &look, seconds, out);
        });
    }
    std::optional<lipz_face> face_at(const LayeredClip &clip, float seconds, const FaceProfile *profile = nullptr,
                                     const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_at_seconds_f32(banks_.data(), count(), &clip, profile, &look, seconds, out);
        });
    }
    /// The face of a character of the clip: with their own curves and emotions, and without the motion of a head that speaks.
    std::optional<lipz_face> face_of(const LayeredClip &clip, const Who &who, Micros time,
                                     const FaceProfile *profile = nullptr, const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_of_us(banks_.data(), count(), &clip, &who, profile, &look, time.us, out);
        });
    }
    std::optional<lipz_face> face_of(const LayeredClip &clip, const Who &who, Samples time,
                                     const FaceProfile *profile = nullptr, const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_of_samples(banks_.data(), count(), &clip, &who, profile, &look, time.position,
                                               time.rate_hz, out);
        });
    }
    std::optional<lipz_face> face_of(const LayeredClip &clip, const Who &who, double seconds,
                                     const FaceProfile *profile = nullptr, const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_of_seconds(banks_.data(), count(), &clip, &who, profile, &look, seconds, out);
        });
    }
    std::optional<lipz_face> face_of(const LayeredClip &clip, const Who &who, float seconds,
                                     const FaceProfile *profile = nullptr, const LookAt &look = {}) const noexcept {
        return face([&](auto *out) {
            return lipz_layers_face_of_seconds_f32(banks_.data(), count(), &clip, &who, profile, &look, seconds, out);
        });
    }

  private:
    explicit Layers(const std::array<lipz_bank, N> &banks) noexcept : banks_(banks) {}
    template <typename Ask> static std::optional<lipz_face> face(Ask ask) noexcept { return answer<lipz_face>(ask); }
    std::array<lipz_bank, N> banks_;
};

/// The stack of these banks, the base first: `lipz::must_stack(base, patch)`. Throws an Error.
template <typename... Banks> Layers<sizeof...(Banks)> must_stack(const Banks &...banks) {
    return Layers<sizeof...(Banks)>::must_stack(banks...);
}

/// The index of a set of banks: which of them has a clip. The program keeps the bytes and the banks.
class Set : public lipz_set {
  public:
    /// Opens the bytes of the index and checks every one of them. Throws an Error.
    static Set must_open(const void *data, std::size_t length_bytes) {
        Set set;
        std::uint32_t place = 0;
        must(lipz_set_open(static_cast<const std::uint8_t *>(data), length_bytes, &set, &place), place);
        return set;
    }
    /// What the index says about each bank, in order: `view(bank.file_name)` is the file beside it.
    auto banks() const noexcept {
        return range<lipz_set_bank>([this, number = std::uint32_t(0)]() mutable {
            return answer<lipz_set_bank>([&](lipz_set_bank *out) { return lipz_set_bank_at(this, number++, out); });
        });
    }
    /// The number of the bank that has the clip with this id, if any bank has it.
    std::uint32_t bank_of(std::uint64_t id) const noexcept {
        std::uint32_t number = 0;
        lipz_set_bank_of(this, id, &number);
        return number;
    }
    std::uint32_t bank_of(std::string_view key) const noexcept {
        std::uint64_t id = 0;
        lipz_clip_id_of_key(key.data(), key.size(), &id);
        return bank_of(id);
    }
    /// Checks that a bank is the one with this number. Throws an Error.
    void must_have(std::uint32_t number, const lipz_bank &bank) const { must(lipz_set_check_bank(this, number, &bank), 0); }
};

} // namespace lipz

#endif // LIPZ_HPP
