// Measures the library in C++17: bench <folder of the banks>. The questions are those of docs/inside/ports.md.
#include <lipz.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <string_view>

namespace {

constexpr int ROUNDS = 40;
constexpr int CALLS = 200'000;
constexpr int FRAMES_PER_SECOND = 60;
/// The rendered frames of a clip, which repeat.
constexpr int CLIP_FRAMES = 4 * FRAMES_PER_SECOND;
constexpr int SPOKEN_FRAMES = 84;

std::size_t allocated = 0;
std::size_t answers = 0;

lipz::Time frame_time(int frame) {
    return lipz::Micros{std::int64_t{frame} * 1'000'000 / FRAMES_PER_SECOND};
}

/// Prints the least time of several rounds, and the most bytes.
template <typename Call> void measure(const char *name, int calls, Call call) {
    double least = std::numeric_limits<double>::max();
    std::size_t most = 0;
    for (int round = 0; round < ROUNDS; round++) {
        const auto before = allocated;
        const auto start = std::chrono::steady_clock::now();
        for (int number = 0; number < calls; number++) {
            call(number);
        }
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
        least = std::min(least, time.count() / calls);
        most = std::max(most, allocated - before);
    }
    std::printf("bench %s_ns %.1f C++\nbench %s_bytes %zu C++\n", name, least, name, most / std::size_t(calls));
}

} // namespace

void *operator new(std::size_t size) {
    allocated += size;
    if (void *block = std::malloc(size)) {
        return block;
    }
    throw std::bad_alloc();
}

void operator delete(void *block) noexcept { std::free(block); }
void operator delete(void *block, std::size_t) noexcept { std::free(block); }

int main(int count, char **arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: bench <folder of drama.lipzbank and phones.lipzbank>\n");
        return 2;
    }
    const std::filesystem::path banks = arguments[1];
    const auto drama = lipz::Dialogue::open({banks / "drama.lipzbank"});
    const auto clip = drama.clip("act1/mara-good-evening").value();
    const auto german = drama.locale("de-de").value();
    measure("viseme", CALLS,
            [&](int number) { answers += std::size_t(clip.viseme_at(frame_time(number % CLIP_FRAMES))); });

    auto cursor = drama.cursor(clip).value();
    cursor.set_speaker(drama.name("mara"));
    measure("tick", CALLS, [&](int number) {
        const auto time = frame_time(number % CLIP_FRAMES);
        if (number % CLIP_FRAMES == 0) {
            cursor.seek(drama, time);
        }
        cursor.advance_to(drama, time);
        for (const auto &event : cursor.events(drama)) {
            answers += event.verb;
        }
        answers += std::size_t(cursor.viseme(drama));
        if (const auto segment = cursor.segment(drama)) {
            const auto text = segment->text(german);
            answers += text ? text->str().size() : 0;
        }
    });

    const auto phones = lipz::Dialogue::open({banks / "phones.lipzbank"});
    const auto spoken = phones.clip("spoken").value();
    const auto rig = phones.rig("arkit").value();
    std::array<std::int32_t, 64> thousandths{};
    measure("weights", CALLS / 10, [&](int number) {
        const auto time = frame_time(number % SPOKEN_FRAMES);
        const auto emotions = spoken.emotions_at(time);
        const auto face = spoken.face_at(time);
        rig.weights(spoken.articulation_at(time).value(), thousandths.data(), thousandths.size(), &emotions, &*face);
        answers += std::size_t(thousandths[0]);
    });
    return answers == 0;
}
