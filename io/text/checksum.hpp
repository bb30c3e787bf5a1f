// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace talus
{

/// CRC-32 (that of zlib and PNG) of some bytes.
std::uint32_t checksum(std::string_view bytes);

} // namespace talus
