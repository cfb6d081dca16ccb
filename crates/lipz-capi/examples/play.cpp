// Plays a clip of a mapped bank in C++17, by an audio clock of 48,000 samples per second:
// play <bank> <key> <locale>.
#include <lipz.hpp>

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

constexpr std::uint32_t RATE_HZ = 48'000;
/// Time between two pictures: 24 a second.
constexpr std::int64_t PICTURE_SAMPLES = RATE_HZ / 24;

constexpr std::array<std::string_view, 13> VERBS = {
    "", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
    "nods", "shakes", "breathes", "blinks", "looks away"};

/// A file, mapped as a whole.
class Mapped {
  public:
    explicit Mapped(const char *path) {
        const int file = ::open(path, O_RDONLY);
        struct stat about {};
        if (file >= 0 && ::fstat(file, &about) == 0 && about.st_size > 0) {
            length_bytes_ = static_cast<std::size_t>(about.st_size);
            data_ = ::mmap(nullptr, length_bytes_, PROT_READ, MAP_PRIVATE, file, 0);
        }
        if (file >= 0) {
            ::close(file);
        }
        if (data_ == MAP_FAILED) {
            throw std::runtime_error(std::string(path) + " cannot be mapped");
        }
    }
    Mapped(const Mapped &) = delete;
    Mapped &operator=(const Mapped &) = delete;
    ~Mapped() { ::munmap(data_, length_bytes_); }

    const std::uint8_t *data() const { return static_cast<const std::uint8_t *>(data_); }
    std::size_t length_bytes() const { return length_bytes_; }

  private:
    void *data_ = MAP_FAILED;
    std::size_t length_bytes_ = 0;
};

void print(const lipz::Event &event) {
    std::cout << "* " << event.character.str() << (event.character ? " " : "")
              << VERBS.at(static_cast<std::size_t>(event.verb)) << (event.object ? " " : "") << event.object.str()
              << '\n';
}

/// What must be there.
template <typename T> T found(const std::optional<T> &answer, std::string_view what) {
    if (!answer) {
        throw std::runtime_error(std::string(what) + ": there is no such thing");
    }
    return *answer;
}

void play(const lipz::Bank &bank, std::string_view key, std::string_view tag) {
    const auto clip = found(bank.clip(key), key);
    const auto locale = found(bank.locale(tag), tag);
    auto cursor = found(bank.cursor(clip), "frame rate");
    std::cout << key << ": " << clip.frame_count << " frames, " << clip.segment_count << " segments";
    std::optional<std::uint32_t> shown;
    for (std::int64_t position = 0; !cursor.is_over(); position += PICTURE_SAMPLES) {
        cursor.advance_to(bank, lipz::Samples{position, RATE_HZ});
        const auto segment = cursor.segment(bank);
        if (cursor.is_over()) {
            std::cout << '\n';
        } else if (segment && segment->index != shown) {
            const auto text = segment->text(bank, locale);
            std::cout << '\n' << segment->index << ": " << (text ? text->text : "")
                      << (text && text->is_fallback ? " (fallback)" : "") << '\n';
            shown = segment->index;
        }
        // Of all segments that have begun since the last picture, also of those without frames.
        for (const auto &event : cursor.events(bank)) {
            print(event);
        }
        std::cout << (cursor.is_over() ? "end: " : "") << cursor.viseme(bank);
    }
    std::cout << '\n';
}

} // namespace

int main(int count, char **arguments) try {
    if (count != 4) {
        std::cerr << "usage: play <bank> <key> <locale>\n";
        return 2;
    }
    const Mapped file(arguments[1]);
    play(lipz::Bank::must_open(file.data(), file.length_bytes()), arguments[2], arguments[3]);
    return 0;
} catch (const std::exception &error) {
    std::cerr << "play: " << error.what() << '\n';
    return 1;
}
