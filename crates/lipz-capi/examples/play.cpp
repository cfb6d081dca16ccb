// Plays a clip in C++17, with an audio clock of 48,000 samples per second: play <key> <locale> <file>...
//
// The files are a bank or the index of a set, then patches and text banks.
#include <lipz.hpp>

#include <array>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

constexpr std::uint32_t RATE_HZ = 48'000;
/// The time between two rendered frames, at 24 per second.
constexpr std::int64_t RENDERED_FRAME_SAMPLES = RATE_HZ / 24;

constexpr std::array<std::string_view, 13> VERBS = {
    "", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
    "nods", "shakes", "breathes", "blinks", "looks away"};

void print(const lipz::Event &event) {
    std::cout << "* " << event.who().str() << (event.who() ? " " : "") << VERBS.at(event.verb)
              << (event.whom() ? " " : "") << event.whom().str() << '\n';
}

/// Returns the answer, or fails if there is none.
template <typename T> T found(const std::optional<T> &answer, std::string_view what) {
    if (!answer) {
        throw std::runtime_error(std::string(what) + ": there is no such thing");
    }
    return *answer;
}

void play(const lipz::Dialogue &dialogue, std::string_view key, std::string_view tag) {
    const auto clip = found(dialogue.clip(key), key);
    const auto locale = found(dialogue.locale(tag), tag);
    auto cursor = found(dialogue.cursor(clip), "frame rate");
    std::cout << key << ": " << clip.frame_count << " frames, " << clip.segment_count << " segments";
    std::optional<std::uint32_t> shown;
    for (std::int64_t position = 0; !cursor.is_over(); position += RENDERED_FRAME_SAMPLES) {
        cursor.advance_to(dialogue, lipz::Samples{position, RATE_HZ});
        const auto segment = cursor.segment(dialogue);
        if (cursor.is_over()) {
            std::cout << '\n';
        } else if (segment && segment->index != shown) {
            const auto text = segment->text(locale);
            std::cout << '\n' << segment->index << ": " << (text ? text->str() : "")
                      << (text && text->is_fallback ? " (fallback)" : "") << '\n';
            shown = segment->index;
        }
        // Includes the events of all segments that have begun since the last rendered frame, even of empty segments.
        for (const auto &event : cursor.events(dialogue)) {
            print(event);
        }
        std::cout << (cursor.is_over() ? "end: " : "") << cursor.viseme(dialogue);
    }
    std::cout << '\n';
}

} // namespace

int main(int count, char **arguments) try {
    if (count < 4) {
        std::cerr << "usage: play <key> <locale> <file>...\n";
        return 2;
    }
    play(lipz::Dialogue::open({arguments + 3, arguments + count}), arguments[1], arguments[2]);
    return 0;
} catch (const std::exception &error) {
    std::cerr << "play: " << error.what() << '\n';
    return 1;
}
