// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/io/scene_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace talus::test
{

namespace fs = std::filesystem;

SceneFolder::SceneFolder()
{
    std::string name = (fs::temp_directory_path() / "talus-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
}

SceneFolder::~SceneFolder()
{
    std::error_code error;
    fs::remove_all(path_, error);
}

fs::path SceneFolder::write(const std::string& name, const std::string& bytes) const
{
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
}

std::string SceneFolder::without_folder(std::string sentence) const
{
    const std::string folder = path_.string() + "/";
    for (auto at = sentence.find(folder); at != std::string::npos; at = sentence.find(folder))
        sentence.erase(at, folder.size());
    return sentence;
}

std::string read_file(const fs::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace talus::test
