// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/export_folder.hpp"

#include "io/run/run_files.hpp"
#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace talus
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* marker = "export.txt";
constexpr std::string_view first_words = "Talus export: ";

/// The files that the marker of an export names; nothing where the folder holds no export.
std::vector<std::string> files_of_export(const fs::path& folder)
{
    std::ifstream stream(folder / marker);
    std::string line;
    if (!std::getline(stream, line) || !line.starts_with(first_words)) return {};
    std::vector<std::string> files = {marker};
    while (std::getline(stream, line))
        if (!line.empty() && line.find('/') == std::string::npos) files.push_back(line);
    return files;
}

void remove_file(const fs::path& path)
{
    std::error_code error;
    fs::remove(path, error);
    if (error) throw OutputError(fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
}

/// @throws InputError where the folder is not free for an export, or cannot be made so
void require_free(const fs::path& folder, bool force)
{
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    if (!fs::is_directory(folder, error))
        throw InputError(fmt::format("{}: is a file, not a folder for an export", folder.string()));
    if (fs::is_empty(folder, error)) return;
    const std::vector<std::string> files = files_of_export(folder);
    if (files.empty())
        throw InputError(fmt::format(
            "{}: the folder holds files that are not of an export of Talus; choose another with -o", folder.string()));
    if (!force)
        throw InputError(fmt::format(
            "{}: the folder holds an export already; --force replaces it, -o chooses another", folder.string()));
    // the marker last: what is left when this is broken off is still known to be of an export
    for (auto file = files.rbegin(); file != files.rend(); ++file) remove_file(folder / *file);
}

} // namespace

ExportFolder::ExportFolder(fs::path folder, const std::string& title, std::vector<std::string> files, bool force)
    : folder_(std::move(folder))
{
    require_free(folder_, force);
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw OutputError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
    std::string text = fmt::format("{}{}\n", first_words, title);
    for (const std::string& file : files) text += fmt::format("{}\n", file);
    write(marker, text);
}

void ExportFolder::write(const std::string& file, std::string_view text) const
{
    write_atomically(folder_ / file, text);
}

StreamedFile::StreamedFile(fs::path path)
    : path_(std::move(path)), temporary_(path_.string() + ".tmp"), stream_(temporary_)
{
    if (!stream_) refuse();
}

StreamedFile::~StreamedFile()
{
    std::error_code none_there;
    fs::remove(temporary_, none_there);
}

void StreamedFile::add(std::string_view text)
{
    if (!stream_.write(text.data(), static_cast<std::streamsize>(text.size()))) refuse();
}

void StreamedFile::finish()
{
    stream_.close();
    if (!stream_ || ::rename(temporary_.c_str(), path_.c_str()) != 0) refuse();
}

void StreamedFile::refuse() const
{
    throw OutputError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

} // namespace talus
