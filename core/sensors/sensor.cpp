// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/sensor.hpp"

namespace talus
{

Measurement measurement(const std::string& name, const BlockMean& mean, const std::string& unit)
{
    const ErrorOfMean error = mean.error();
    return {name, mean.mean(), error.error, unit, error.independent, error.too_few};
}

} // namespace talus
