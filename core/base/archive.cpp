// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/archive.hpp"

#include <cstring>

namespace talus
{

void Archive::raw(void* data, std::size_t size)
{
    if (size == 0) return;
    if (!reading_) {
        bytes_.append(static_cast<const char*>(data), size);
        return;
    }
    require(size);
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
}

void Archive::require(std::size_t count, std::size_t size_of_one) const
{
    if (count > (bytes_.size() - at_) / size_of_one) throw ArchiveError("the saved state ends too early");
}

} // namespace talus
