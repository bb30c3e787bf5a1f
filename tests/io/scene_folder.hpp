// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace talus::test
{

/// A folder of its own for the files of one test, removed with all that is in it.
class SceneFolder
{
public:
    SceneFolder();
    ~SceneFolder();
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Writes a file and returns its path.
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;

    /// A sentence without the folder's name in it, so that "scene.toml:1:1: …" can be compared.
    std::string without_folder(std::string sentence) const;

private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);

/// The sentence of the Error that `act` throws, or "no error".
template <typename Error> std::string error_of(auto&& act)
{
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace talus::test
