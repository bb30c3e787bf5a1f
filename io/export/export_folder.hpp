// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// The folder of an export. `export.txt` in it says what was exported, and names every file, so that a later export
/// replaces those and nothing else.
class ExportFolder
{
public:
    /// Makes the folder. One that is there must be empty, or with `force` an export, whose files are removed.
    /// @param title a line on what is exported and how
    /// @param files that will be written, without folders in their names
    /// @throws InputError where it holds something else, OutputError
    ExportFolder(std::filesystem::path folder, const std::string& title, std::vector<std::string> files, bool force);

    /// Writes one of the files, whole or not at all.
    /// @throws OutputError
    void write(const std::string& file, std::string_view text) const;

    const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// A text file that is written piece by piece, and gets its name when it is whole.
class StreamedFile
{
public:
    explicit StreamedFile(std::filesystem::path path);
    ~StreamedFile(); ///< removes what was not finished

    /// @throws OutputError
    void add(std::string_view text);

    /// @throws OutputError
    void finish();

private:
    std::filesystem::path path_, temporary_;
    std::ofstream stream_;

    [[noreturn]] void refuse() const;
};

} // namespace talus
