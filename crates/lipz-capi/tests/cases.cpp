// The cases of fixtures/playback/cases.txt in C++17: cases <folder of the banks> [missing capability]... < cases.txt.
// Prints the file again with the answers of the library, and reports the number of played and skipped commands.
#include <lipz.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
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

/// Returns the time at `words[at]`, in its unit, and moves `at` after it.
lipz::Time time_at(const Words &words, std::size_t &at) {
    const auto unit = words.at(at++);
    const auto value = words.at(at++);
    if (unit == "us") {
        return lipz::Micros{std::stoll(value)};
    }
    if (unit == "samples") {
        return lipz::Samples{std::stoll(value), number(words.at(at++))};
    }
    if (unit == "seconds") {
        return std::strtod(value.c_str(), nullptr);
    }
    if (unit == "f32") {
        return std::strtof(value.c_str(), nullptr);
    }
    throw std::runtime_error("no unit: " + unit);
}

std::string_view or_none(const lipz::Name &name) { return name ? name.str() : "-"; }

constexpr std::array<std::string_view, LIPZ_EMOTION_COUNT> EMOTIONS = {
    "sadness", "anger", "joy", "fear", "disgust", "surprise", "shock", "perplexed", "asleep", "pain", "exertion", "shout"};

class Stage {
  public:
    explicit Stage(std::string folder) : folder_(std::move(folder)) {}

    void command(const Words &words) {
        const auto &verb = words.at(0);
        if (verb == "bank") {
            open_bank(words.at(1));
        } else if (verb == "texts") {
            paths_.push_back(folder_ / (words.at(1) + ".lipztexts"));
            open_dialogue();
        } else if (verb == "locale") {
            locale_ = dialogue_->locale(words.at(1));
            std::cout << (locale_ ? "" : "  no locale\n");
        } else if (verb == "variant") {
            locale_ = dialogue_->variant(locale_.value(), words.at(1));
            std::cout << "  " << lipz::view(locale_.value().tag) << "\n";
        } else if (verb == "clip") {
            start(words);
        } else if (verb == "speaker") {
            cursor_->set_speaker(dialogue_->name(words.at(1)));
        } else if (verb == "lead") {
            const auto &lead = words.at(1);
            cursor_->lead_us = lead == "one"   ? lead_us(1)
                               : lead == "two" ? lead_us(2)
                                               : number(lead);
        } else if (verb == "hold") {
            const auto &hold = words.at(1);
            cursor_->hold_frames = hold == "readable"  ? found(clip_->hold_frames(), "hold")
                                   : hold == "display" ? found(clip_->hold_frames(number(words.at(2))), "hold")
                                                       : number(hold);
        } else if (verb == "state") {
            const auto name = words.at(1) == "-" ? lipz::Name() : dialogue_->name(words.at(1));
            print(found(cursor_->character(*dialogue_, name), "character"), words.at(1));
        } else if (verb == "characters") {
            for (const auto &character : cursor_->characters(*dialogue_)) {
                print(character, or_none(character.name));
            }
        } else if (verb == "babble") {
            babble(words);
        } else if (verb == "curves" || verb == "curve") {
            curves(words);
        } else if (verb == "emotions") {
            const auto who = who_of(words);
            std::size_t at = who ? 3 : 1;
            print(clip_->emotions_at(time_at(words, at), who ? &*who : nullptr));
        } else if (verb == "articulation") {
            articulation(words);
        } else if (verb == "weights") {
            weights(words);
        } else if (verb == "face" || verb == "idle") {
            face(words);
        } else if (verb == "voices") {
            for (const auto &voice : dialogue_->voices()) {
                std::cout << "  " << lipz::view(voice.tag) << '\n';
            }
        } else if (verb == "voice") {
            voice(words.at(1));
        } else {
            go(words);
        }
    }

  private:
    /// Opens the files that `NAME.list` names, or `NAME.lipzbank` alone.
    void open_bank(const std::string &name) {
        paths_.clear();
        std::ifstream list(folder_ / (name + ".list"));
        for (std::string line; std::getline(list, line);) {
            paths_.push_back(folder_ / line);
        }
        if (paths_.empty()) {
            paths_.push_back(folder_ / (name + ".lipzbank"));
        }
        open_dialogue();
    }

    /// The clip is found again in the new dialogue, and the cursor continues.
    void open_dialogue() {
        const auto id = clip_ ? clip_->id : 0;
        clip_.reset();
        locale_.reset();
        dialogue_ = lipz::Dialogue::open(paths_);
        clip_ = dialogue_->clip(id);
    }

    std::uint32_t lead_us(std::uint32_t frame) const {
        return static_cast<std::uint32_t>(found(clip_->start_of_frame_us(frame), "lead"));
    }

    void start(const Words &words) {
        clip_ = found(dialogue_->clip(words.at(1)), words.at(1));
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
        cursor_ = dialogue_->cursor(*clip_);
        std::cout << (cursor_ ? "" : "  no frame rate\n");
    }

    void go(const Words &words) {
        const auto &verb = words.at(0);
        std::size_t at = 1;
        lipz_status status = LIPZ_NONE;
        if (verb == "advance") {
            status = cursor_->advance_to(*dialogue_, time_at(words, at));
        } else if (verb == "loop") {
            status = cursor_->loop_to(*dialogue_, time_at(words, at));
        } else if (verb == "seek") {
            status = cursor_->seek(*dialogue_, time_at(words, at));
        } else if (verb == "finish") {
            status = cursor_->finish(*dialogue_);
        }
        if (status != LIPZ_OK) {
            throw lipz::Error(status, std::filesystem::path(verb));
        }
        print_shown();
        lipz::Cursor segments = *cursor_;
        for (const auto &segment : segments.segments(*dialogue_)) {
            const auto event = segment.event_string();
            std::cout << "  due " << segment.index << (!event ? "" : event->empty() ? ":" : ": ") << event.value_or("")
                      << '\n';
        }
        for (const auto &event : cursor_->events(*dialogue_)) {
            std::cout << "  event " << event.who().str() << (event.who() ? " " : "") << VERBS.at(event.verb)
                      << (event.whom() ? " " : "") << event.whom().str() << '\n';
        }
    }

    void print_shown() const {
        std::cout << "  frame "
                  << (cursor_->is_over()      ? "over"
                      : cursor_->frame == LIPZ_WAITING ? "waiting"
                                              : std::to_string(cursor_->frame))
                  << ", viseme " << cursor_->viseme(*dialogue_);
        if (const auto open = cursor_->openness(*dialogue_)) {
            std::cout << ", open " << *open;
        }
        if (const auto segment = cursor_->segment(*dialogue_)) {
            std::cout << ", segment " << segment->index;
            if (const auto text = locale_ ? segment->text(*locale_) : std::nullopt) {
                std::cout << ": " << text->str() << (text->is_fallback ? " (fallback)" : "");
            }
        }
        std::cout << '\n';
    }

    static void print(const lipz_character &character, std::string_view name) {
        std::cout << "  " << name << ": feels " << or_none(character.feels) << ", stares "
                  << or_none(character.stares_at) << ", points " << or_none(character.points_at) << '\n';
    }

    void curves(const Words &words) {
        if (words.at(0) == "curves") {
            for (const auto &curve : clip_->curves()) {
                std::cout << "  " << lipz::view(curve.name) << ':';
                for (const auto &key : curve.keys()) {
                    std::cout << ' ' << key.frame << ':' << key.thousandths;
                }
                std::cout << '\n';
            }
            return;
        }
        const auto curve = clip_->curve(words.at(1));
        std::optional<std::int32_t> value, with_cursor;
        if (curve && words.at(2) == "frame") {
            value = with_cursor = curve->value(number(words.at(3)));
        } else if (curve) {
            std::size_t at = 2;
            const auto time = time_at(words, at);
            value = curve->value_at(time);
            with_cursor = curve->value_at(time, &curve_cursor_);
        }
        if (value != with_cursor) {
            throw std::runtime_error("a cursor says something else");
        }
        std::cout << "  " << (!curve ? "no curve" : value ? std::to_string(*value) : "no frame rate") << '\n';
    }

    static void print(const lipz_emotions &emotions) {
        std::cout << ' ';
        for (std::size_t place = 0; place < EMOTIONS.size(); ++place) {
            if (emotions.thousandths[place] != 0) {
                std::cout << ' ' << EMOTIONS.at(place) << ' ' << emotions.thousandths[place] << ',';
            }
        }
        std::cout << " strongest " << (emotions.strongest == LIPZ_NEUTRAL ? "neutral" : EMOTIONS.at(emotions.strongest))
                  << ", sum " << emotions.sum << '\n';
    }

    void voice(std::string_view tag) const {
        static const std::array<std::string_view, 3> WHOSE = {"original", "dub", "other dub"};
        const auto voice = dialogue_->voice(tag);
        if (!voice) {
            std::cout << "  no voice\n";
            return;
        }
        const auto voiced = clip_->in_voice(*voice);
        std::cout << "  " << WHOSE.at(voiced.spoken) << ": " << voiced.clip.key() << ", spoken in "
                  << lipz::view(found(voiced.clip.voice(), "voice").tag) << '\n';
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
        std::optional<lipz_face_profile> profile;
        if (name != "default" && !(profile = dialogue_->face_profile(name))) {
            std::cout << "  no profile\n";
            return;
        }
        const auto *with = profile ? &*profile : nullptr;
        lipz::LookAt look;
        const auto &where = words.at(at + 1);
        at += 2;
        if (where != "ahead") {
            const auto pitch = std::stoi(words.at(at)), yaw = std::stoi(words.at(at + 1));
            look = where == "person" ? lipz::LookAt::person(pitch, yaw) : lipz::LookAt::point(pitch, yaw);
            at += 2;
        }
        std::optional<lipz_face> shown;
        if (words.at(0) == "face") {
            shown = clip_->face_at(time_at(words, at), who ? &*who : nullptr, with, look);
        } else {
            const auto seed = std::stoull(words.at(at++));
            shown = dialogue_->idle_at(time_at(words, at), seed, with, look);
        }
        const auto face = found(shown, "face");
        std::cout << "  blink " << face.blink << ", head " << face.head_pitch << ' ' << face.head_yaw << ' '
                  << face.head_roll << ", eyes " << face.eye_pitch << ' ' << face.eye_yaw << ", brows " << face.brows
                  << ", shrug " << face.shrug << ", breath " << face.breath << '\n';
    }

    /// Returns the articulation at the time in the words from `at` on; nothing without the profile in front of it.
    std::optional<lipz_articulation> articulation_at(const Words &words, std::size_t at) const {
        const auto &name = words.at(at);
        std::optional<lipz_articulation_profile> profile;
        if (name != "default" && !(profile = dialogue_->articulation_profile(name))) {
            std::cout << "  no profile\n";
            return std::nullopt;
        }
        return found(clip_->articulation_at(time_at(words, ++at), profile ? &*profile : nullptr), "articulation");
    }

    /// `articulation PROFILE TIME`.
    void articulation(const Words &words) const {
        static const std::array<const char *, LIPZ_ARTICULATOR_COUNT> NAMES = {
            "jaw", "opening", "closure", "teeth", "rounding", "spreading", "tongue_tip", "tongue_out", "tongue_back"};
        if (const auto mouth = articulation_at(words, 1)) {
            for (std::size_t index = 0; index < NAMES.size(); ++index) {
                std::cout << (index == 0 ? "  " : ", ") << NAMES[index] << ' ' << mouth->thousandths[index];
            }
            std::cout << '\n';
        }
    }

    /// `weights RIG PROFILE TIME`, with the speaker's emotions and face.
    void weights(const Words &words) const {
        const auto rig = dialogue_->rig(words.at(1));
        if (!rig) {
            std::cout << "  no rig\n";
            return;
        }
        const auto mouth = articulation_at(words, 2);
        if (!mouth) {
            return;
        }
        std::size_t at = 3;
        const auto time = time_at(words, at);
        const auto emotions = clip_->emotions_at(time);
        const auto face = found(clip_->face_at(time), "face");
        std::array<std::int32_t, 64> weights;
        rig->weights(*mouth, weights.data(), weights.size(), &emotions, &face);
        for (std::uint32_t index = 0; index < rig->weight_count; ++index) {
            std::cout << (index == 0 ? "  " : ", ") << rig->weight_name(index) << ' ' << weights.at(index);
        }
        std::cout << '\n';
    }

    void babble(const Words &words) const {
        const auto profile = words.at(1) == "default" ? dialogue_->babble() : dialogue_->babble(words.at(1));
        if (!profile) {
            std::cout << "  no profile\n";
            return;
        }
        std::size_t at = 2;
        const auto time = time_at(words, at);
        const auto &power = words.back();
        const auto weights = words.at(at) == "level"
                                 ? dialogue_->babble_at_level(*profile, time, number(power))
                                 : dialogue_->babble_at(*profile, time, std::strtof(power.c_str(), nullptr));
        const auto told = found(weights, "weights");
        std::cout << "  ooh " << told.ooh << ", aah " << told.aah << '\n';
    }

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> paths_;
    std::optional<lipz::Dialogue> dialogue_;
    std::optional<lipz_locale> locale_;
    std::optional<lipz::Clip> clip_;
    std::optional<lipz::Cursor> cursor_;
    /// One cursor for all curves, which must never change a value.
    lipz_curve_cursor curve_cursor_ = {0};
};

/// The capabilities of this reader that sections may need, without those in the arguments.
std::set<std::string> capabilities(int count, char **arguments) {
    std::set<std::string> have = {"articulation", "babble", "curves", "emotions", "faces", "hold",
                                  "lead", "refresh", "states", "text-banks", "voices"};
    for (int index = 2; index < count; ++index) {
        have.erase(arguments[index]);
    }
    return have;
}

} // namespace

int main(int count, char **arguments) try {
    if (count < 2) {
        std::cerr << "usage: cases <folder of the banks> [what it lacks]... < cases.txt\n";
        return 2;
    }
    const auto have = capabilities(count, arguments);
    Stage stage(arguments[1]);
    bool is_skipping = false;
    unsigned played = 0, skipped = 0;
    for (std::string line; std::getline(std::cin, line);) {
        const bool is_answer = line.rfind("  ", 0) == 0;
        if (!is_answer || is_skipping) {
            std::cout << line << '\n';
        }
        is_skipping = is_skipping && line.rfind("## ", 0) != 0;
        if (is_answer || line.empty() || line[0] == '#') {
            continue;
        }
        std::istringstream text(line);
        const Words words(std::istream_iterator<std::string>(text), {});
        if (words.at(0) == "needs") {
            is_skipping = !std::all_of(words.begin() + 1, words.end(), [&](const auto &need) { return have.count(need) > 0; });
        } else if (is_skipping) {
            ++skipped;
        } else {
            stage.command(words);
            ++played;
        }
    }
    std::cerr << "cases: " << played << " commands played, " << skipped << " skipped\n";
    return 0;
} catch (const std::exception &error) {
    std::cerr << "cases: " << error.what() << '\n';
    return 1;
}
