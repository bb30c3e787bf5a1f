// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/curve_order.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <numeric>

namespace talus
{

std::vector<std::int32_t> curve_order(const std::vector<Vec3>& points)
{
    using Cartesian = CGAL::Simple_cartesian<double>;
    std::vector<Cartesian::Point_3> copies;
    copies.reserve(points.size());
    for (const auto& x : points) copies.emplace_back(x[0], x[1], x[2]);

    std::vector<std::size_t> along(points.size());
    std::iota(along.begin(), along.end(), std::size_t{0});
    using Traits = CGAL::Spatial_sort_traits_adapter_3<Cartesian, CGAL::Pointer_property_map<Cartesian::Point_3>::type>;
    CGAL::hilbert_sort(along.begin(), along.end(), Traits(CGAL::make_property_map(copies)));

    std::vector<std::int32_t> order(points.size());
    for (std::size_t k = 0; k < along.size(); ++k) order[along[k]] = static_cast<std::int32_t>(k);
    return order;
}

} // namespace talus
