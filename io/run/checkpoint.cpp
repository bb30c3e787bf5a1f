// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/checkpoint.hpp"

#include "core/base/archive.hpp"
#include "io/run/run_files.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

namespace talus
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* latest = "checkpoint.latest";
constexpr const char* previous = "checkpoint.previous";

constexpr std::uint32_t format_version = 18;
constexpr std::uint32_t byte_order = 0x01020304; ///< as this machine stores it

/// What stands before the state. The magic and the format version keep their place in every format.
struct Header {
    std::uint32_t format = format_version;
    std::uint32_t order = byte_order;
    std::string version; ///< of Talus
    std::uint64_t size = 0;
    std::uint32_t sum = 0; ///< of the state

    void persist(Archive& archive) { archive(format, order, version, size, sum); }
};

/// Where one file cannot be used: what() says why.
struct Unusable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string bytes_of(const fs::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw Unusable("the file cannot be read");
    return bytes;
}

Header read_header(Archive& archive)
{
    Header header;
    archive(header.format, header.order);
    if (header.format != format_version)
        throw Unusable(fmt::format("it has format {}, this Talus reads {}", header.format, format_version));
    if (header.order != byte_order) throw Unusable("it was written on a machine with another byte order");
    archive(header.version, header.size, header.sum);
    return header;
}

std::string header_bytes(const std::string& version, const std::string& state)
{
    Header header;
    header.version = version;
    header.size = state.size();
    header.sum = checksum(state);
    Archive archive;
    archive(header);
    return archive.bytes();
}

/// @throws Unusable
std::string take_state(std::string bytes, const std::string& version)
{
    if (!bytes.starts_with(checkpoint_mark)) throw Unusable("it is no checkpoint of Talus");
    Header header;
    std::size_t begin = 0;
    try {
        Archive archive(bytes.substr(checkpoint_mark.size(), 4096));
        header = read_header(archive);
        begin = checkpoint_mark.size() + archive.position();
    } catch (const ArchiveError&) {
        throw Unusable("it ends in its header");
    }
    if (header.version != version)
        throw Unusable(fmt::format("it was written by Talus {}, and this is {}", header.version, version));
    if (bytes.size() - begin != header.size)
        throw Unusable(fmt::format("it should hold {} bytes and holds {}", header.size, bytes.size() - begin));
    bytes.erase(0, begin);
    if (checksum(bytes) != header.sum) throw Unusable("its checksum is wrong");
    return bytes;
}

} // namespace

std::string checkpoint_bytes(const std::string& version, const std::string& state)
{
    return std::string(checkpoint_mark) + header_bytes(version, state) + state;
}

std::string state_in(const std::string& bytes, const std::string& version)
{
    try {
        return take_state(bytes, version);
    } catch (const Unusable& reason) {
        throw InputError(std::string("the state cannot be put back: ") + reason.what());
    }
}

void write_checkpoint_file(const fs::path& file, const std::string& version, const std::string& state)
{
    write_atomically(file, {checkpoint_mark, header_bytes(version, state), state});
}

Checkpoint read_checkpoint_file(const fs::path& file, const std::string& version)
{
    try {
        return {take_state(bytes_of(file), version), file, ""};
    } catch (const Unusable& reason) {
        throw InputError(fmt::format("{}: {}", file.string(), reason.what()));
    }
}

void write_checkpoint(const fs::path& folder, const std::string& version, const std::string& state)
{
    const fs::path next = folder / "checkpoint.next";
    write_checkpoint_file(next, version, state);
    // A crash between the two leaves the one before, which is then the newest.
    std::error_code none_before;
    fs::rename(folder / latest, folder / previous, none_before);
    std::error_code error;
    fs::rename(next, folder / latest, error);
    if (error) throw OutputError(fmt::format("{}: cannot be written: {}", (folder / latest).string(), error.message()));
}

Checkpoint read_checkpoint(const fs::path& folder, const std::string& version)
{
    std::string reasons;
    for (const char* name : {latest, previous}) {
        const fs::path path = folder / name;
        std::error_code error;
        if (!fs::exists(path, error)) continue;
        try {
            return {take_state(bytes_of(path), version), path, reasons};
        } catch (const Unusable& reason) {
            reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", path.string(), reason.what());
        }
    }
    if (reasons.empty())
        throw InputError(
            fmt::format("{}: the folder holds no checkpoint to resume from; run the scene anew", folder.string()));
    throw InputError(fmt::format("{}; there is no other checkpoint to resume from", reasons));
}

} // namespace talus
