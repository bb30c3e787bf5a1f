// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/run_files.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

namespace talus
{

namespace
{

namespace fs = std::filesystem;

/// The file that marks a folder as a run of Talus.
constexpr const char* marker = "scene.resolved.toml";

/// With which the files of tables begin.
constexpr const char* profile_prefix = "profile_";

[[noreturn]] void refuse_output(const fs::path& path, const std::string& reason)
{
    throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// Whether a run of Talus writes a file of this name into its folder or its `frames`.
bool is_output_of_a_run(const std::string& name)
{
    if (name.starts_with(profile_prefix) && (name.ends_with(".csv") || name.ends_with(".csv.tmp"))) return true;
    constexpr std::array<std::string_view, 6> files = {
        "metrics.csv", "summary.json", "lost.vtp", "report.html", case_file, marker};
    constexpr std::array<std::string_view, 5> series = {"particles", "contacts", "walls", "moving_walls", "checkpoint"};
    for (const std::string_view file : files)
        if (name == file || name == fmt::format("{}.tmp", file)) return true;
    for (const std::string_view one : series)
        if (name.starts_with(fmt::format("{}.", one)) || name.starts_with(fmt::format("{}_", one))) return true;
    return false;
}

/// Whether nothing is in a folder but, perhaps, what a run that did not live to begin has left, or who begins one now.
bool is_unused(const fs::path& folder)
{
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const fs::path name = entry.path().filename();
        if (name != fmt::format("{}.tmp", marker) && name != lock_name) return false;
    }
    if (error) refuse_output(folder, error.message());
    return true;
}

/// @throws InputError where a run may not write into the folder
void require_usable(const fs::path& folder, bool force)
{
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    if (!fs::is_directory(folder, error))
        throw InputError(fmt::format("{}: is a file, not a folder for a run's output", folder.string()));
    if (is_unused(folder)) return;
    if (!fs::exists(folder / marker, error))
        throw InputError(fmt::format(
            "{}: the folder holds files that are not of a run of Talus; choose another with -o", folder.string()));
    if (!force)
        throw InputError(fmt::format(
            "{}: the folder holds a run already; --force replaces it, -o chooses another", folder.string()));
}

/// @throws InputError where a run in the folder would replace what it is made from
void require_inputs_kept(const fs::path& folder, const std::vector<fs::path>& inputs)
{
    for (const fs::path& input : inputs)
        if ((lies_in(folder, input) || lies_in(folder / "frames", input)) && is_output_of_a_run(input.filename()))
            throw InputError(
                fmt::format("{}: the run is made from this file, and would replace it; choose another folder with -o",
                    input.string()));
}

/// Removes what a run wrote, and nothing else: a user may keep notes and pictures beside it. What says that the run is
/// whole, or can go on, goes first, and the marker is left to be replaced: who is killed meanwhile leaves no run that
/// seems to be one.
void remove_run(const fs::path& folder)
{
    const auto remove = [](const fs::path& path) {
        std::error_code removal;
        fs::remove(path, removal);
        if (removal) refuse_output(path, removal.message());
    };
    for (const char* first : {case_file, "summary.json", "checkpoint.latest", "checkpoint.previous"})
        remove(folder / first);
    std::error_code error;
    for (const fs::path& place : {folder / "frames", folder}) {
        if (!fs::is_directory(place, error)) continue;
        for (const auto& entry : fs::directory_iterator(place, error)) {
            const std::string name = entry.path().filename().string();
            if (!entry.is_directory() && name != marker && is_output_of_a_run(name)) remove(entry.path());
        }
        if (error) refuse_output(place, error.message());
    }
}

/// Writes all bytes; false with errno set where that fails.
bool write_all(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// Writes all parts and brings them to the disk; false with errno set where that fails.
bool write_all(int descriptor, std::initializer_list<std::string_view> parts)
{
    for (const std::string_view part : parts)
        if (!write_all(descriptor, part)) return false;
    return ::fsync(descriptor) == 0;
}

/// A unit as it stands in a column's name: kg/s becomes _kg_per_s.
std::string unit_suffix(std::string unit)
{
    if (unit.empty() || unit == "1") return "";
    std::ranges::replace(unit, ' ', '_');
    const auto slash = unit.find('/');
    if (slash == std::string::npos) return fmt::format("_{}", unit);
    const std::string above = unit.substr(0, slash), below = unit.substr(slash + 1);
    return above == "1" ? fmt::format("_per_{}", below) : fmt::format("_{}_per_{}", above, below);
}

std::string header_line(const std::vector<std::string>& columns)
{
    std::vector<std::string> fields;
    for (const std::string& column : columns) fields.push_back(csv_field(column));
    return fmt::format("{}", fmt::join(fields, ","));
}

} // namespace

FolderLock make_run_folder(
    const fs::path& folder, const std::string& resolved_scene, bool force, const std::vector<fs::path>& inputs)
{
    require_usable(folder, force);
    require_inputs_kept(folder, inputs);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) refuse_output(folder, error.message());
    FolderLock lock(folder);
    require_usable(folder, force); // another may have come and gone since
    remove_run(folder);
    write_atomically(folder / marker, resolved_scene);
    return lock;
}

void copy_files(const std::vector<NamedFile>& files, const fs::path& folder)
{
    for (const NamedFile& file : files) {
        const fs::path copy = folder / file.copy;
        std::error_code error;
        fs::create_directories(copy.parent_path(), error);
        if (error) refuse_output(copy.parent_path(), error.message());
        write_atomically(copy, read_bytes(file.path, "a file"));
    }
}

void require_writable(const fs::path& path, bool force, const std::vector<fs::path>& inputs)
{
    std::error_code none;
    for (const fs::path& input : inputs)
        if (fs::equivalent(path, input, none))
            throw InputError(fmt::format("{}: this file is read, and is not replaced; name another", path.string()));
    const fs::file_status status = fs::status(path, none);
    if (!fs::status_known(status)) refuse_output(path, none.message());
    if (fs::is_directory(status)) refuse_output(path, std::strerror(EISDIR));
    if (fs::is_regular_file(status) && !force)
        throw InputError(fmt::format("{}: the file is there already; --force replaces it", path.string()));
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (::access(folder.c_str(), W_OK | X_OK) != 0) refuse_output(path, std::strerror(errno));
}

bool lies_in(const fs::path& folder, const fs::path& file)
{
    std::error_code error;
    return fs::weakly_canonical(file, error).parent_path() == fs::weakly_canonical(folder, error);
}

bool is_of_others(const fs::path& path, std::string_view mark)
{
    std::error_code error;
    if (!fs::exists(path, error)) return false;
    std::string begin(1000, '\0');
    std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin.find(mark) == std::string::npos;
}

void write_atomically(const fs::path& path, std::string_view text)
{
    write_atomically(path, {text});
}

void write_atomically(const fs::path& path, std::initializer_list<std::string_view> parts)
{
    const fs::path temporary = path.string() + ".tmp";
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse_output(path, std::strerror(errno));
    const int failure = write_all(descriptor, parts) ? 0 : errno;
    const bool closed = ::close(descriptor) == 0;
    if (failure == 0 && closed && ::rename(temporary.c_str(), path.c_str()) == 0) return;
    const std::string reason = std::strerror(failure != 0 ? failure : errno);
    ::unlink(temporary.c_str());
    refuse_output(path, reason);
}

std::string csv_field(const std::string& name)
{
    if (name.find_first_of(",\"\n") == std::string::npos) return name;
    std::string quoted;
    for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return fmt::format("\"{}\"", quoted);
}

std::string column_name(const std::string& name, const std::string& unit)
{
    return name + unit_suffix(unit);
}

void write_table(const fs::path& folder, const std::string& name, const Table& table)
{
    std::vector<std::string> fields;
    for (const auto& [column, unit] : table.columns) fields.push_back(csv_field(column_name(column, unit)));
    std::string text = fmt::format("{}\n", fmt::join(fields, ","));
    for (const auto& row : table.rows) text += fmt::format("{}\n", fmt::join(row, ","));
    write_atomically(folder / fmt::format("{}{}.csv", profile_prefix, name), text);
}

void WrittenFile::add(std::string_view bytes)
{
    size += bytes.size();
    sum =
        static_cast<std::uint32_t>(::crc32_z(sum, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

MetricsFile::MetricsFile(const fs::path& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()), stream_(path)
{
    write_line(header_line(columns));
}

MetricsFile::MetricsFile(const fs::path& path, const std::vector<std::string>& columns, const WrittenFile& written)
    : path_(path), columns_(columns.size())
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw InputError(fmt::format("{}: the run cannot go on without it: {}", path.string(), std::strerror(errno)));
    std::string text(written.size, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file) written_.add(text);
    if (written_ != written || !text.starts_with(header_line(columns) + '\n'))
        throw InputError(fmt::format("{}: the file is not as the run left it", path.string()));
    std::error_code error;
    fs::resize_file(path, written.size, error);
    if (error) refuse_output(path, error.message());
    stream_.open(path, std::ios::app);
    if (!stream_) refuse_output(path, std::strerror(errno));
}

void MetricsFile::add_row(const std::vector<double>& values)
{
    assert(values.size() == columns_);
    write_line(fmt::format("{}", fmt::join(values, ",")));
}

void MetricsFile::sync()
{
    // fsync brings what any descriptor of the file has written
    const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) refuse_output(path_, std::strerror(errno));
    const int failure = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    if (failure != 0) refuse_output(path_, std::strerror(failure));
}

void MetricsFile::write_line(const std::string& line)
{
    stream_ << line << '\n' << std::flush;
    if (!stream_) refuse_output(path_, std::strerror(errno));
    written_.add(line + '\n');
}

} // namespace talus
