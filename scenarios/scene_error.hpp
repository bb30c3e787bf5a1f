// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace talus
{

/// A scene that cannot be built. `key` is the path of the offending key ("fill[0].region", "wall[2].material"), by
/// which the reader of the file finds line and column; what() is a sentence without file or line.
struct SceneError : std::runtime_error {
    SceneError(std::string key_path, const std::string& sentence, std::string first_key_path = {})
        : std::runtime_error(sentence), key(std::move(key_path)), first_key(std::move(first_key_path))
    {
    }
    std::string key;
    std::string first_key; ///< where two keys collide, the one that was there first; else empty
};

} // namespace talus
