// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scenarios/measured_settings.hpp"

#include "io/scene/accuracy_file.hpp"

namespace talus::test
{

const std::vector<scene::MeasuredSetting>& measured_settings()
{
    static const auto settings = read_measured_settings(TALUS_SOURCE_DIR "/scenarios/accuracy/settings.toml");
    return settings;
}

} // namespace talus::test
