// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzzed_file.hpp"

#include <fstream>
#include <stdexcept>

#include <stdlib.h>

namespace talus::fuzz
{
namespace
{

namespace fs = std::filesystem;

struct Folder {
    fs::path path;

    Folder()
    {
        // In memory where there is such a place: thousands of files a second.
        const fs::path parent = fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
        std::string name = (parent / "talus-fuzz-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw std::runtime_error("no folder for the files of fuzz tests in " + parent.string());
        path = name;
    }
    ~Folder()
    {
        std::error_code error;
        fs::remove_all(path, error);
    }
};

} // namespace

fs::path fuzzed_file(const std::string& name, const std::uint8_t* bytes, std::size_t size)
{
    static const Folder folder;
    const fs::path path = folder.path / name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    return path;
}

} // namespace talus::fuzz
