// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/checksum.hpp"

#include <zlib.h>

namespace talus
{

std::uint32_t checksum(std::string_view bytes)
{
    const auto begin = ::crc32(0, nullptr, 0);
    return static_cast<std::uint32_t>(
        ::crc32_z(begin, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

} // namespace talus
