// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/region.hpp"

#include "scenarios/build/checks.hpp"

namespace talus
{

Region build_region(const scene::RegionTable& table, const std::string& key)
{
    Region region;
    if (table.shape == "box") {
        region.box = require_box(table.min, table.max, key + ".max");
        return region;
    }
    require_positive(table.radius, key + ".radius", "the radius of a cylinder");
    require_positive(table.height, key + ".height", "the height of a cylinder");
    region.shape = Region::Shape::cylinder;
    region.base = table.base;
    region.axis = unit_vector(table.axis, key + ".axis");
    region.radius = table.radius;
    region.height = table.height;
    return region;
}

} // namespace talus
