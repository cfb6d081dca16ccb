// Stacks in C++17: layers <folder of the banks>. Prints what is in them; layers.expected is what the reader in Rust says.
#include <lipz.hpp>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace {

std::vector<char> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void print(const char *whose, const std::optional<lipz_face> &face) {
    std::cout << "  " << whose << ":";
    if (face) {
        std::cout << " blink " << face->blink << ", head " << face->head_yaw << ", eyes " << face->eye_pitch << " "
                  << face->eye_yaw << "\n";
    } else {
        std::cout << " none\n";
    }
}

/// The faces of speaker and listener, in each unit of time, with and without a profile, and of somebody outside of the line.
template <std::size_t N> void print_faces(const lipz::Layers<N> &layers, const lipz::LayeredClip &clip) {
    const lipz::Micros us{300'000};
    const lipz::Samples samples{14'400, 48'000};
    const auto profile = layers.default_face_profile();
    std::cout << "  " << (layers.face_profile("default") ? "own" : "usual") << " profile\n";
    print("speaks", layers.face_at(clip, us));
    print("speaks", layers.face_at(clip, samples, &*profile));
    print("speaks", layers.face_at(clip, 0.3));
    print("speaks", layers.face_at(clip, 0.3F, nullptr, lipz::LookAt::point(0, 5'000)));
    print("amy", layers.face_of(clip, "amy", us));
    print("amy", layers.face_of(clip, lipz::Who::speaker("amy"), samples, &*profile));
    print("amy", layers.face_of(clip, "amy", 0.3));
    print("amy", layers.face_of(clip, "amy", 0.3F, nullptr, lipz::LookAt::point(0, 5'000)));
    print("idle", profile->idle_at(*layers.of_faces(), us, 7));
    lipz_face_profile forged = *profile;
    forged.index = 0;
    forged.bank += 1;
    const lipz::FaceProfile other = forged;
    print("of another bank", layers.face_of(clip, "amy", us, &other));
}

/// A line for each clip, one for each text and voice, and its faces.
template <std::size_t N> void print(const lipz::Layers<N> &layers, const std::vector<std::string> &keys) {
    for (const auto &key : keys) {
        const auto clip = layers.clip(key);
        if (!clip) {
            std::cout << key << ": none\n";
            continue;
        }
        const auto own = clip->own();
        std::cout << own.key(layers.bank(*clip)) << ": layer " << clip->layer << ", " << own.frame_count << " frames, "
                  << (layers.cursor(*clip) ? "plays" : "has no frame rate") << "\n";
        for (const auto *tag : {"de-de", "en-us", "fr-fr"}) {
            const auto locale = layers.locale(*clip, tag);
            for (std::uint32_t segment = 0; locale && segment < own.segment_count; ++segment) {
                if (const auto text = layers.text(*clip, segment, *locale)) {
                    std::cout << "  " << tag << " " << segment << (text->is_fallback ? "?" : "") << ": " << text->text << "\n";
                }
            }
        }
        std::uint64_t id = 0;
        lipz_clip_id_of_key(key.data(), key.size(), &id);
        for (const auto &voice : layers.voices()) {
            const auto voiced = layers.in_voice(id, voice);
            std::cout << "  " << voice << ": " << voiced->clip.own().key(layers.bank(voiced->clip)) << "\n";
        }
        print_faces(layers, *clip);
    }
}

} // namespace

int main(int count, char **arguments) {
    if (count != 2) {
        std::cerr << "usage: layers <folder of the banks>\n";
        return 2;
    }
    const std::string folder = arguments[1];
    const auto files = {read(folder + "/small.lipzbank"), read(folder + "/patch.lipzbank"),
                        read(folder + "/dubbed.lipzbank"), read(folder + "/redub.lipzbank")};
    std::vector<lipz::Bank> banks;
    for (const auto &file : files) {
        banks.push_back(lipz::Bank::must_open(file.data(), file.size()));
    }
    print(lipz::must_stack(banks[0], banks[1]), {"act1/blair", "act2/bare", "act2/no-frames", "patch/new"});
    print(lipz::must_stack(banks[2], banks[3]), {"aye", "no", "de/no"});
    try {
        lipz::must_stack(banks[0], banks[3]);
        return 1;
    } catch (const lipz::Error &error) {
        std::cout << "another base: status " << error.status() << "\n";
    }
    return 0;
}
