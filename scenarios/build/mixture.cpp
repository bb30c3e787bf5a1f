// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/mixture.hpp"

#include "scenarios/build/checks.hpp"
#include "scenarios/build/materials.hpp"

#include <cmath>

namespace talus
{
namespace
{

void require_range(const scene::DiameterTable& table, const std::string& key)
{
    require_positive(table.min, key + ".min", "the smallest diameter");
    if (!(table.max >= table.min) || !std::isfinite(table.max))
        throw SceneError(key + ".max", "the largest diameter must not be below the smallest");
}

/// A normal or lognormal distribution between min and max, which must not cut all but its tail away: the diameters
/// would have little to do with the mean or median that the scene asks for.
SizeDistribution cut_distribution(const scene::DiameterTable& table, const std::string& key)
{
    constexpr double least_share = 0.01;
    const bool normal = table.distribution == "normal";
    require_range(table, key);
    require_positive(table.deviation, key + ".deviation", "the standard deviation");
    if (normal)
        require_positive(table.mean, key + ".mean", "the mean diameter");
    else
        require_positive(table.median, key + ".median", "the median diameter");
    if (table.max == table.min)
        throw SceneError(key + ".max", "'max' must be above 'min'; for one size use distribution \"constant\"");
    const SizeDistribution sizes{.min = table.min,
        .max = table.max,
        .law = normal ? SizeDistribution::Law::normal : SizeDistribution::Law::lognormal,
        .center = normal ? table.mean : std::log(table.median),
        .spread = table.deviation};
    if (!(sizes.share_inside() >= least_share))
        throw SceneError(key + ".min",
            "less than 1 % of the " + table.distribution + " distribution lies between 'min' and 'max'; widen them");
    return sizes;
}

Species build_species(const std::string& material, const scene::DiameterTable& diameter, const std::string& key,
    const Materials& materials)
{
    return {material_index(materials, material, key + ".material"), build_sizes(diameter, key + ".diameter"), 1.0};
}

template <class Table> Mixture mixture_of(const Table& table, const std::string& key, const Materials& materials)
{
    if (table.species.empty()) {
        if (table.material.empty())
            throw SceneError(key + ".material", "give a 'material' and a 'diameter', or a list of 'species'");
        return {{build_species(table.material, table.diameter, key, materials)}};
    }
    if (!table.material.empty() || table.diameter.given())
        throw SceneError(key + ".species",
            "where there are 'species', each has its own 'material' and 'diameter': leave out the others");
    std::vector<Species> species;
    std::vector<double> mass_shares;
    for (std::size_t k = 0; k < table.species.size(); ++k) {
        const auto path = key + ".species[" + std::to_string(k) + "]";
        const auto& one = table.species[k];
        require_positive(one.share, path + ".share", "the share");
        species.push_back(build_species(one.material, one.diameter, path, materials));
        mass_shares.push_back(one.share);
    }
    return mixture_by_mass(std::move(species), mass_shares, materials);
}

template <class Table> std::vector<std::string> names_of_materials(const Table& table)
{
    std::vector<std::string> names;
    if (table.species.empty()) names.push_back(table.material);
    for (const auto& one : table.species) names.push_back(one.material);
    return names;
}

} // namespace

SizeDistribution build_sizes(const scene::DiameterTable& table, const std::string& key)
{
    if (table.distribution == "constant") {
        require_positive(table.value, key + ".value", "the diameter");
        return {.min = table.value, .max = table.value};
    }
    if (table.distribution == "sieve") {
        if (table.sieve_sizes.size() < 2)
            throw SceneError(key + ".file", "a distribution \"sieve\" needs a file with two sieves at least");
        return sieved_sizes(table.sieve_sizes, table.sieve_passing);
    }
    if (table.distribution != "uniform") return cut_distribution(table, key);
    require_range(table, key);
    return {.min = table.min, .max = table.max};
}

Mixture build_mixture(const scene::FillTable& table, const std::string& key, const Materials& materials)
{
    return mixture_of(table, key, materials);
}

Mixture build_mixture(const scene::PourTable& table, const std::string& key, const Materials& materials)
{
    return mixture_of(table, key, materials);
}

std::vector<std::string> materials_in(const scene::FillTable& table)
{
    return names_of_materials(table);
}

std::vector<std::string> materials_in(const scene::PourTable& table)
{
    return names_of_materials(table);
}

} // namespace talus
