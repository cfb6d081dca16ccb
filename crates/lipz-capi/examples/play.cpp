// Plays a clip of a mapped bank in C++17, by an audio clock of 48,000 samples per second:
// play <bank> <key> <locale>.
#include <lipz.h>

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
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

constexpr std::array<std::string_view, 8> VERBS = {
    "", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does"};

std::string_view view(const lipz_string &string) { return {string.data, string.length_bytes}; }

void must(lipz_status status, const std::string &what) {
    if (status != LIPZ_OK) {
        lipz_string message;
        lipz_status_message(status, &message);
        throw std::runtime_error(what + ": " + std::string(view(message)));
    }
}

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

void print(const lipz_bank &bank, const lipz_segment &segment, const lipz_locale &locale) {
    std::cout << '\n' << segment.index << ": ";
    if (lipz_text text; lipz_segment_text(&bank, &segment, &locale, &text) == LIPZ_OK) {
        std::cout << std::string_view(text.data, text.length_bytes) << (text.is_fallback ? " (fallback)" : "");
    }
    std::cout << '\n';
    lipz_event event;
    for (std::uint32_t index = 0; lipz_segment_event(&bank, &segment, index, &event) == LIPZ_OK; ++index) {
        std::cout << "* " << view(event.character.name) << (event.character.id == LIPZ_NO_NAME ? "" : " ")
                  << VERBS.at(event.verb) << (event.object.id == LIPZ_NO_NAME ? "" : " ")
                  << view(event.object.name) << '\n';
    }
}

/// Prints the segments from `next` on that start up to `frame`, each once, also those that have no frames; returns the
/// first one that has not started.
std::uint32_t print_begun(const lipz_bank &bank, const lipz_clip &clip, const lipz_locale &locale, std::uint32_t next,
                          std::uint32_t frame) {
    lipz_segment segment;
    while (lipz_segment_at(&bank, &clip, next, &segment) == LIPZ_OK && segment.start_frame <= frame) {
        print(bank, segment, locale);
        ++next;
    }
    return next;
}

void play(const lipz_bank &bank, std::string_view key, std::string_view tag) {
    lipz_clip clip;
    lipz_locale locale;
    must(lipz_clip_by_key(&bank, key.data(), key.size(), &clip), std::string(key));
    must(lipz_locale_by_tag(&bank, tag.data(), tag.size(), &locale), std::string(tag));
    std::cout << key << ": " << clip.frame_count << " frames, " << clip.segment_count << " segments";
    lipz_viseme viseme;
    std::uint32_t frame;
    std::uint32_t next = 0;
    std::int64_t position = 0;
    while (lipz_frame_at_samples(&bank, &clip, position, RATE_HZ, &frame) == LIPZ_OK) {
        next = print_begun(bank, clip, locale, next, frame);
        must(lipz_viseme_at_samples(&bank, &clip, position, RATE_HZ, &viseme), "viseme");
        std::cout << static_cast<char>(viseme);
        position += PICTURE_SAMPLES;
    }
    // Segments without frames may stand at the end, where no frame leads to them.
    print_begun(bank, clip, locale, next, UINT32_MAX);
    must(lipz_viseme_at_samples(&bank, &clip, position, RATE_HZ, &viseme), "viseme");
    std::cout << "\nend: " << static_cast<char>(viseme) << '\n';
}

} // namespace

int main(int count, char **arguments) try {
    if (count != 4) {
        std::cerr << "usage: play <bank> <key> <locale>\n";
        return 2;
    }
    const Mapped file(arguments[1]);
    lipz_bank bank;
    must(lipz_bank_open(file.data(), file.length_bytes(), &bank, nullptr), arguments[1]);
    must(lipz_bank_verify(&bank, nullptr), arguments[1]);
    play(bank, arguments[2], arguments[3]);
    return 0;
} catch (const std::exception &error) {
    std::cerr << "play: " << error.what() << '\n';
    return 1;
}
