// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace talus
{

/// Bad input: what() is one clear sentence that begins with file:line:column and says what is wrong and what is
/// allowed.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file or folder that cannot be written; what() names it and the reason.
struct OutputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace talus
