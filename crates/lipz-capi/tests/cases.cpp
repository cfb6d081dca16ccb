// The cases of fixtures/playback/cases.txt in C++17: cases <folder of the banks> < cases.txt. Writes the file anew, with
// the answers of the library.
#include <lipz.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Words = std::vector<std::string>;

constexpr std::array<std::string_view, 13> VERBS = {
    "", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
    "nods", "shakes", "breathes", "blinks", "looks away"};
constexpr std::array<std::string_view, 4> TYPES = {"", "blair", "toonboom", "rms"};

std::uint32_t number(const std::string &word) { return static_cast<std::uint32_t>(std::stoul(word)); }

template <typename T> T found(const std::optional<T> &answer, const std::string &what) {
    if (!answer) {
        throw std::runtime_error("no " + what);
    }
    return *answer;
}

/// Calls `use` with the time at `words[at]` in its unit, and gives the place behind it.
template <typename Use> std::size_t with_time(const Words &words, std::size_t at, Use use) {
    const auto &unit = words.at(at);
    if (unit == "us") {
        use(lipz::Micros{std::stoll(words.at(at + 1))});
    } else if (unit == "samples") {
        use(lipz::Samples{std::stoll(words.at(at + 1)), number(words.at(at + 2))});
        return at + 3;
    } else if (unit == "seconds") {
        use(std::strtod(words.at(at + 1).c_str(), nullptr));
    } else if (unit == "f32") {
        use(std::strtof(words.at(at + 1).c_str(), nullptr));
    } else {
        throw std::runtime_error("no unit: " + unit);
    }
    return at + 2;
}

std::string_view or_none(const lipz::Name &name) { return name ? name.str() : "-"; }

class Stage {
  public:
    explicit Stage(std::string folder) : folder_(std::move(folder)) {}

    void command(const Words &words) {
        const auto &verb = words.at(0);
        if (verb == "bank") {
            const auto &bytes = contents(words.at(1) + ".lipzbank");
            bank_ = lipz::Bank::must_open(bytes.data(), bytes.size());
            locale_.reset();
        } else if (verb == "texts") {
            const auto &bytes = contents(words.at(1) + ".lipztexts");
            bank_->must_use_texts(bytes.data(), bytes.size());
            locale_.reset();
        } else if (verb == "locale") {
            locale_ = bank_->locale(words.at(1));
            std::cout << (locale_ ? "" : "  no locale\n");
        } else if (verb == "clip") {
            start(words);
        } else if (verb == "speaker") {
            cursor_->set_speaker(bank_->name(words.at(1)));
        } else if (verb == "lead") {
            const auto &lead = words.at(1);
            cursor_->lead_us = lead == "one"   ? clip_->lead_one_frame()
                               : lead == "two" ? clip_->lead_two_frames()
                                               : number(lead);
        } else if (verb == "hold") {
            const auto &hold = words.at(1);
            cursor_->hold_frames = hold == "readable"  ? clip_->hold_readable()
                                   : hold == "display" ? clip_->hold_for_display(number(words.at(2)))
                                                       : number(hold);
        } else if (verb == "state") {
            const auto name = words.at(1) == "-" ? lipz::Name() : bank_->name(words.at(1));
            print(found(cursor_->character(*bank_, name), "character"), words.at(1));
        } else if (verb == "characters") {
            for (const auto &character : cursor_->characters(*bank_)) {
                print(character, or_none(character.name));
            }
        } else if (verb == "babble") {
            babble(words);
        } else if (verb == "curves" || verb == "curve") {
            curves(words);
        } else if (const auto who = who_of(words); verb == "emotions" && who) {
            with_time(words, 3, [&](auto time) { print(clip_->emotions_of(*bank_, *who, time)); });
        } else if (verb == "emotions") {
            with_time(words, 1, [&](auto time) { print(clip_->emotions_at(*bank_, time)); });
        } else if (verb == "face" || verb == "idle") {
            face(words);
        } else if (verb == "voices") {
            for (const auto &tag : bank_->voices()) {
                std::cout << "  " << tag << '\n';
            }
        } else if (verb == "voice") {
            voice(words.at(1));
        } else {
            go(words);
        }
    }

  private:
    /// A file of the banks, which stays.
    const std::vector<char> &contents(const std::string &name) {
        std::ifstream file(folder_ + "/" + name, std::ios::binary);
        files_.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
        return files_.back();
    }

    void start(const Words &words) {
        clip_ = found(bank_->clip(words.at(1)), words.at(1));
        for (std::size_t at = 2; at + 1 < words.size(); at += 2) {
            const auto &given = words.at(at + 1);
            if (words.at(at) == "rate") {
                clip_ = clip_->or_fps(number(given), number(given.substr(given.find('/') + 1)));
            }
            for (std::uint32_t type = LIPZ_BLAIR; words.at(at) == "type" && type <= LIPZ_RMS; ++type) {
                if (given == TYPES.at(type) && clip_->viseme_type == 0) {
                    clip_->viseme_type = type;
                }
            }
        }
        cursor_ = bank_->cursor(*clip_);
        std::cout << (cursor_ ? "" : "  no frame rate\n");
    }

    void go(const Words &words) {
        const auto &verb = words.at(0);
        if (verb == "advance") {
            with_time(words, 1, [&](auto time) { cursor_->advance_to(*bank_, time); });
        } else if (verb == "loop") {
            with_time(words, 1, [&](auto time) { cursor_->loop_to(*bank_, time); });
        } else if (verb == "seek") {
            with_time(words, 1, [&](auto time) { cursor_->seek(*bank_, time); });
        } else if (verb == "finish") {
            cursor_->finish(*bank_);
        } else {
            throw std::runtime_error("no command: " + verb);
        }
        if (cursor_->status() != LIPZ_OK) {
            throw lipz::Error(cursor_->status());
        }
        print_shown();
        lipz::Cursor segments = *cursor_;
        for (const auto &segment : segments.segments(*bank_)) {
            const auto event = segment.event(*bank_);
            std::cout << "  due " << segment.index << (!event ? "" : event->empty() ? ":" : ": ") << event.value_or("")
                      << '\n';
        }
        for (const auto &event : cursor_->events(*bank_)) {
            std::cout << "  event " << event.character.str() << (event.character ? " " : "")
                      << VERBS.at(static_cast<std::size_t>(event.verb)) << (event.object ? " " : "")
                      << event.object.str() << '\n';
        }
    }

    void print_shown() const {
        std::cout << "  frame "
                  << (cursor_->is_over()      ? "over"
                      : cursor_->is_waiting() ? "waiting"
                                              : std::to_string(cursor_->frame))
                  << ", viseme " << cursor_->viseme(*bank_);
        if (const auto open = cursor_->openness(*bank_)) {
            std::cout << ", open " << *open;
        }
        if (const auto segment = cursor_->segment(*bank_)) {
            std::cout << ", segment " << segment->index;
            if (const auto text = locale_ ? segment->text(*bank_, *locale_) : std::nullopt) {
                std::cout << ": " << text->text << (text->is_fallback ? " (fallback)" : "");
            }
        }
        std::cout << '\n';
    }

    static void print(const lipz::Character &character, std::string_view name) {
        std::cout << "  " << name << ": feels " << or_none(character.feels) << ", stares "
                  << or_none(character.stares_at) << ", points " << or_none(character.points_at) << '\n';
    }

    void curves(const Words &words) {
        if (words.at(0) == "curves") {
            for (const auto &curve : clip_->curves(*bank_)) {
                std::cout << "  " << curve.name_view() << ':';
                for (const auto &key : curve.keys(*bank_)) {
                    std::cout << ' ' << key.frame << ':' << key.thousandths;
                }
                std::cout << '\n';
            }
            return;
        }
        const auto curve = clip_->curve(*bank_, words.at(1));
        std::optional<std::int32_t> value, with_cursor;
        if (curve && words.at(2) == "frame") {
            value = curve->value(*bank_, number(words.at(3)));
            with_cursor = curve->value(*bank_, number(words.at(3)), &curve_cursor_);
        } else if (curve) {
            with_time(words, 2, [&](auto time) {
                value = curve->value_at(*bank_, time);
                with_cursor = curve->value_at(*bank_, time, &curve_cursor_);
            });
        }
        if (value != with_cursor) {
            throw std::runtime_error("a cursor says something else");
        }
        std::cout << "  " << (!curve ? "no curve" : value ? std::to_string(*value) : "no frame rate") << '\n';
    }

    static void print(const lipz::Emotions &emotions) {
        std::cout << ' ';
        for (std::uint32_t place = LIPZ_SADNESS; place <= LIPZ_SHOUT; ++place) {
            const auto emotion = static_cast<lipz::Emotion>(place);
            if (emotions[emotion] != 0) {
                std::cout << ' ' << lipz::name_of(emotion) << ' ' << emotions[emotion] << ',';
            }
        }
        const auto strongest = emotions.strongest_emotion();
        std::cout << " strongest " << (strongest ? lipz::name_of(*strongest) : "neutral") << ", sum " << emotions.sum
                  << '\n';
    }

    void voice(std::string_view tag) const {
        static const std::array<std::string_view, 3> WHOSE = {"original", "dub", "other dub"};
        const auto voiced = clip_->in_voice(*bank_, tag);
        if (!voiced) {
            std::cout << "  no voice\n";
            return;
        }
        const lipz::Clip clip = voiced->clip;
        std::cout << "  " << WHOSE.at(voiced->spoken) << ": " << clip.key(*bank_) << ", spoken in "
                  << clip.voice(*bank_).value_or("-") << '\n';
    }

    /// `of NAME` or `speaker NAME`.
    static std::optional<lipz::Who> who_of(const Words &words) {
        if (words.size() < 3 || (words[1] != "of" && words[1] != "speaker")) {
            return std::nullopt;
        }
        return words[1] == "of" ? lipz::Who(words[2]) : lipz::Who::speaker(words[2]);
    }

    void face(const Words &words) const {
        const auto who = who_of(words);
        std::size_t at = who ? 3 : 1;
        const auto &name = words.at(at);
        const auto profile = name == "default" ? bank_->default_face_profile() : bank_->face_profile(name);
        if (!profile) {
            std::cout << "  no profile\n";
            return;
        }
        lipz::LookAt look;
        const auto &where = words.at(at + 1);
        at += 2;
        if (where != "ahead") {
            const auto pitch = std::stoi(words.at(at)), yaw = std::stoi(words.at(at + 1));
            look = where == "person" ? lipz::LookAt::person(pitch, yaw) : lipz::LookAt::point(pitch, yaw);
            at += 2;
        }
        std::optional<lipz_face> shown;
        if (who) {
            with_time(words, at, [&](auto time) { shown = clip_->face_of(*bank_, *who, time, *profile, look); });
        } else if (words.at(0) == "face") {
            with_time(words, at, [&](auto time) { shown = clip_->face_at(*bank_, time, *profile, look); });
        } else {
            const auto seed = std::stoull(words.at(at));
            with_time(words, at + 1, [&](auto time) { shown = profile->idle_at(*bank_, time, seed, look); });
        }
        const auto face = found(shown, "face");
        std::cout << "  blink " << face.blink << ", head " << face.head_pitch << ' ' << face.head_yaw << ' '
                  << face.head_roll << ", eyes " << face.eye_pitch << ' ' << face.eye_yaw << ", brows " << face.brows
                  << ", shrug " << face.shrug << ", breath " << face.breath << '\n';
    }

    void babble(const Words &words) const {
        const auto profile = words.at(1) == "default" ? bank_->default_babble() : bank_->babble(words.at(1));
        if (!profile) {
            std::cout << "  no profile\n";
            return;
        }
        std::optional<lipz_weights> weights;
        const auto &power = words.back();
        if (words.at(words.size() - 2) == "level") {
            weights = profile->at_level(*bank_, lipz::Micros{std::stoll(words.at(3))}, number(power));
        } else {
            with_time(words, 2,
                      [&](auto time) { weights = profile->at(*bank_, time, std::strtof(power.c_str(), nullptr)); });
        }
        const auto told = found(weights, "weights");
        std::cout << "  ooh " << told.ooh << ", aah " << told.aah << '\n';
    }

    std::string folder_;
    std::deque<std::vector<char>> files_;
    std::optional<lipz::Bank> bank_;
    std::optional<lipz_locale> locale_;
    std::optional<lipz::Clip> clip_;
    std::optional<lipz::Cursor> cursor_;
    /// One for all curves: it says what a search says, wherever it was used before.
    lipz::CurveCursor curve_cursor_;
};

} // namespace

int main(int count, char **arguments) try {
    if (count != 2) {
        std::cerr << "usage: cases <folder of the banks> < cases.txt\n";
        return 2;
    }
    Stage stage(arguments[1]);
    for (std::string line; std::getline(std::cin, line);) {
        if (line.rfind("  ", 0) == 0) {
            continue;
        }
        std::cout << line << '\n';
        if (!line.empty() && line[0] != '#') {
            std::istringstream words(line);
            stage.command(Words(std::istream_iterator<std::string>(words), {}));
        }
    }
    return 0;
} catch (const std::exception &error) {
    std::cerr << "cases: " << error.what() << '\n';
    return 1;
}
