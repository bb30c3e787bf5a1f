// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"
#include "io/run/folder_lock.hpp"
#include "io/scene/scene_file.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// In the folder of a run that is a case of a sweep: which case it is (sweep_cases.hpp).
inline constexpr const char* case_file = "case.txt";

/// Makes the output folder of a run, takes possession of it, and marks it as Talus's own by writing
/// scene.resolved.toml into it first.
/// @param force replace the files of a run of Talus that the folder holds (others in it stay); a non-empty folder
///   without scene.resolved.toml is never touched
/// @param inputs that the run is made from, none of which is replaced
/// @throws InputError where the folder may not be used, OutputError where it cannot be written
FolderLock make_run_folder(const std::filesystem::path& folder, const std::string& resolved_scene, bool force,
    const std::vector<std::filesystem::path>& inputs = {});

/// Copies the files that a scene names into the folder of a run, which then can go on wherever it is.
/// @throws OutputError
void copy_files(const std::vector<NamedFile>& files, const std::filesystem::path& folder);

/// Asks beforehand whether a file can be written later, so that nothing is computed in vain.
/// @param force replace a file that is there already
/// @param inputs that are read, none of which is replaced
/// @throws InputError where there is one that is not to be replaced; OutputError where the path is a folder, or its
/// folder is not there or may not be written
void require_writable(
    const std::filesystem::path& path, bool force, const std::vector<std::filesystem::path>& inputs = {});

/// Whether a file lies in that very folder, whatever way leads to either.
bool lies_in(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Whether something is there that has no such mark in its first thousand bytes, as all that Talus writes there has.
bool is_of_others(const std::filesystem::path& path, std::string_view mark);

/// Writes a whole file at once: to a temporary name, flushed to the disk, then renamed.
/// @throws OutputError
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// The same for a file in parts, one after the other.
void write_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// A name as a field of a CSV file: in quotes where it must be.
std::string csv_field(const std::string& name);

/// A name with its unit, as columns are called: mass_flow_kg_per_s.
std::string column_name(const std::string& name, const std::string& unit);

/// Writes the table of a sensor into the run's folder as profile_NAME.csv: names with units, then a row a line.
/// @throws OutputError
void write_table(const std::filesystem::path& folder, const std::string& name, const Table& table);

/// What a file has that a run goes on with: its size [B] and the CRC-32 of that.
struct WrittenFile {
    std::uint64_t size = 0;
    std::uint32_t sum = 0;

    void add(std::string_view bytes);
    void persist(Archive& archive) { archive(size, sum); }
    bool operator==(const WrittenFile&) const = default;
};

/// metrics.csv: a header of names with units, then a row a sample, flushed at once.
class MetricsFile
{
public:
    /// @param columns names with units
    /// @throws OutputError
    MetricsFile(const std::filesystem::path& path, const std::vector<std::string>& columns);

    /// Goes on with the file of a run that is resumed.
    /// @param written to which the file is cut back
    /// @throws InputError where the file is not the one that was left, OutputError
    MetricsFile(const std::filesystem::path& path, const std::vector<std::string>& columns, const WrittenFile& written);

    /// @pre one value for each column
    /// @throws OutputError, at full disk too
    void add_row(const std::vector<double>& values);

    /// Brings the rows to the disk, so that a checkpoint may count on them.
    /// @throws OutputError
    void sync();

    const WrittenFile& written() const { return written_; }

private:
    std::filesystem::path path_;
    std::size_t columns_;
    WrittenFile written_;
    std::ofstream stream_;

    void write_line(const std::string& line);
};

} // namespace talus
