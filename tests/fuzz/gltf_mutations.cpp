// With any compiler: every seed, then a fixed number of mutations of them from a fixed seed.
// Usage: gltf_mutations RUNS SEED DICTIONARY, or gltf_mutations --write FOLDER [EMPTY_FOLDER...] for the seeds as files,
// and folders for what a fuzzer finds.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/gltf_target.h"
#include "tests/fuzz/seeds.h"

namespace {

using namespace halfframe::tests;

int write_seeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const Seed& seed : gltf_seeds()) std::ofstream(folder / seed.name, std::ios::binary) << seed.bytes;
    return 0;
}

/// The strings of a libFuzzer dictionary, unescaped.
std::vector<std::string> words_of(const char* file) {
    std::vector<std::string> words;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.size() < 2 || line.front() != '"') continue;
        std::string word;
        for (std::size_t i = 1; i + 1 < line.size(); ++i) {
            if (line[i] != '\\') {
                word += line[i];
            } else if (line[i + 1] == 'x') {
                word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
                i += 3;
            } else {
                word += line[++i];
            }
        }
        words.push_back(word);
    }
    return words;
}

class Mutator {
public:
    Mutator(unsigned seed, std::vector<std::string> words) : random_(seed), words_(std::move(words)) {}

    std::string mutated(std::string bytes, const std::vector<Seed>& seeds) {
        const std::size_t changes = 1 + below(3);
        for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) change(bytes, seeds);
        return bytes;
    }

private:
    // Not a distribution of the library: those differ between its versions.
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_()) % limit; }

    void change(std::string& bytes, const std::vector<Seed>& seeds) {
        const std::size_t at = below(bytes.size());
        switch (below(9)) {
            case 0: bytes[at] = static_cast<char>(below(256)); break;
            case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1u << below(8))); break;
            case 2: bytes.erase(at, 1 + below(8)); break;
            case 3: bytes.insert(at, words_[below(words_.size())]); break;
            case 4:
            case 7:
            case 8: replace_number(bytes, at); break;
            case 5: replace_member(bytes, at); break;
            default: {
                const std::string& other = seeds[below(seeds.size())].bytes;
                const std::size_t from = below(other.size());
                bytes.insert(at, other, from, 1 + below(64));
            }
        }
    }

    /// The next number in the text becomes another one: what keeps the JSON whole reaches deepest.
    void replace_number(std::string& bytes, std::size_t at) {
        static const char* const kNumbers[] = {"0",        "1",     "2",          "-1",         "3",    "255",
                                               "5121",     "5126",  "4294967295", "2147483648", "1e39", "0.5",
                                               "16777216", "65536", "1e-40",      "null",       "44",   "36"};
        const std::size_t start = bytes.find_first_of("0123456789", at);
        if (start == std::string::npos) return;
        const std::size_t end = bytes.find_first_not_of("0123456789.eE+-", start);
        bytes.replace(start, end == std::string::npos ? end : end - start, kNumbers[below(std::size(kNumbers))]);
    }

    /// A word of the dictionary in the place of the member that begins next.
    void replace_member(std::string& bytes, std::size_t at) {
        const std::size_t start = bytes.find('"', at);
        if (start == std::string::npos) return;
        const std::size_t end = bytes.find_first_of(",}", start);
        bytes.replace(start, end == std::string::npos ? end : end - start, words_[below(words_.size())]);
    }

    std::mt19937 random_;
    std::vector<std::string> words_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc >= 3 && std::string(argv[1]) == "--write") {
        for (int i = 3; i < argc; ++i) std::filesystem::create_directories(argv[i]);
        return write_seeds(argv[2]);
    }
    if (argc != 4) return 2;
    const std::vector<Seed> seeds = gltf_seeds();
    const std::vector<std::string> words = words_of(argv[3]);
    if (words.size() < 10) {
        std::fprintf(stderr, "%s has no words\n", argv[3]);
        return 1;
    }
    for (const Seed& seed : seeds) {
        if (!load_bytes(seed.bytes)) {
            std::fprintf(stderr, "the seed %s does not load\n", seed.name.c_str());
            return 1;
        }
    }
    const long runs = std::atol(argv[1]);
    Mutator mutator(static_cast<unsigned>(std::atol(argv[2])), words);
    long loaded = 0;
    for (long i = 0; i < runs; ++i) {
        const Seed& seed = seeds[static_cast<std::size_t>(i) % seeds.size()];
        const std::string bytes = mutator.mutated(seed.bytes, seeds);
        loaded += load_bytes(bytes) ? 1 : 0;
    }
    std::printf("%ld mutations of %zu seeds: %ld loaded, %ld refused\n", runs, seeds.size(), loaded, runs - loaded);
    const bool both = loaded > runs / 100 && runs - loaded > runs / 100;
    if (!both) std::fprintf(stderr, "a mutator whose files all end alike tests nothing\n");
    return both ? 0 : 1;
}
