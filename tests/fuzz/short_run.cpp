// SPDX-License-Identifier: GPL-3.0-or-later
/// A fuzz test without libFuzzer, which needs Clang: gives the target the files of a corpus, and then so many mutations
/// of them. No guidance by coverage; the same inputs on every machine.
///
///     fuzz_stl CORPUS COUNT
///
/// An input that ends the process is left in fuzz_stl.input, beside where it was called.
#include "core/base/region.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#ifndef __has_feature // only Clang has it
#define __has_feature(feature) 0
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t longest = 1 << 17;
constexpr unsigned patience = 10;                           ///< for one input [s]
[[maybe_unused]] constexpr rlim_t memory = rlim_t{1} << 30; ///< of the process [B]
constexpr std::array<const char*, 16> odd_numbers = {"0", "-0", "-1", "1e308", "-1e308", "5e-324", "nan", "inf", "-inf",
    "9223372036854775807", "-9223372036854775808", "1e-9", "1e9", "0.5", "2147483648", "1e400"};

talus::Random random_numbers(2026);

std::size_t below(std::size_t limit)
{
    return limit == 0 ? 0 : static_cast<std::size_t>(random_numbers() % limit);
}

/// From a random place on, where `wanted` is first found; the end where there is none.
std::size_t find_from_anywhere(const std::string& text, const char* wanted)
{
    return std::min(text.find_first_of(wanted, below(text.size() + 1)), text.size());
}

void mutate_bytes(std::string& text)
{
    const std::size_t at = below(text.size() + 1), count = 1 + below(below(4) == 0 ? 256 : 4);
    switch (below(4)) {
    case 0:
        for (std::size_t k = at; k < std::min(at + count, text.size()); ++k)
            text[k] = static_cast<char>(random_numbers());
        break;
    case 1:
        text.erase(at, count);
        break;
    case 2:
        text.insert(at, text.substr(below(text.size() + 1), count));
        break;
    default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
    }
}

void mutate_number(std::string& text)
{
    constexpr const char* digits = "0123456789";
    const std::size_t begin = find_from_anywhere(text, digits);
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e", begin), text.size());
    text.replace(begin, end - begin, odd_numbers[below(odd_numbers.size())]);
}

/// Takes out, doubles or moves a line.
void mutate_line(std::string& text)
{
    const std::size_t begin = find_from_anywhere(text, "\n");
    const std::size_t end = std::min(text.find('\n', std::min(begin + 1, text.size())), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t what = below(3);
    if (what != 1) text.erase(begin, end - begin);
    if (what != 0) text.insert(find_from_anywhere(text, "\n"), line);
}

std::string bytes_of(const fs::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> corpus_in(const fs::path& folder)
{
    std::vector<fs::path> paths;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<std::string> corpus;
    for (const fs::path& path : paths) corpus.push_back(bytes_of(path));
    return corpus;
}

void give(const fs::path& trace, const std::string& input)
{
    std::ofstream(trace, std::ios::binary) << input;
    alarm(patience);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    alarm(0);
}

std::string mutated(std::string input)
{
    const std::size_t size = std::min(input.size(), longest);
    input.resize(longest);
    input.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(input.data()), size, longest));
    return input;
}

} // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most)
{
    std::string text(reinterpret_cast<char*>(bytes), size);
    const bool readable = std::ranges::none_of(text, [](char c) { return c == '\0'; });
    for (std::size_t k = 0; k <= below(4); ++k) {
        const std::size_t kind = readable ? below(4) : 0;
        if (kind <= 1)
            mutate_bytes(text);
        else if (kind == 2)
            mutate_number(text);
        else
            mutate_line(text);
    }
    size = std::min(text.size(), most);
    std::copy_n(text.begin(), size, bytes);
    return size;
}

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s CORPUS COUNT\n", argv[0]);
        return 2;
    }
#if !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer) // they reserve far more
    const rlimit limit{memory, memory};
    setrlimit(RLIMIT_AS, &limit);
#endif
    const fs::path trace = fs::path(argv[0]).filename().string() + ".input";
    auto corpus = corpus_in(argv[1]);
    for (const std::string& input : corpus) give(trace, input);
    if (corpus.empty()) corpus.emplace_back();
    const long count = std::atol(argv[2]);
    for (long k = 0; k < count; ++k) give(trace, mutated(corpus[below(corpus.size())]));
    fs::remove(trace);
    std::printf("%zu files and %ld mutations of them\n", corpus.size(), count);
}
