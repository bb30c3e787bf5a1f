// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/spheres.hpp"

#include "scenarios/builder/checks.hpp"
#include "scenarios/builder/materials.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

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

Species build_species(const std::string& material, const scene::DiameterTable& diameter, const std::string& key,
    const Materials& materials)
{
    return {material_index(materials, material, key + ".material"), build_sizes(diameter, key + ".diameter"), 1.0};
}

/// What a fill or a pour is made of: its species, or its one material and diameter, but not both.
template <class Table> Mixture build_mixture(const Table& table, const std::string& key, const Materials& materials)
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
        const auto path = key + "." + table_path("species", k);
        const auto& one = table.species[k];
        require_positive(one.share, path + ".share", "the share");
        species.push_back(build_species(one.material, one.diameter, path, materials));
        mass_shares.push_back(one.share);
    }
    return mixture_by_mass(std::move(species), mass_shares, materials);
}

/// The radius of each sphere of a file [m]: the file's own, or else that of the fill's diameter.
std::vector<double> listed_radii(const scene::FillTable& table, const std::string& key)
{
    const auto& listed = table.spheres;
    if (!listed.radii.empty()) {
        if (table.diameter.given())
            throw SceneError(key + ".diameter", "the file has the radii of its spheres: leave 'diameter' out");
        return listed.radii;
    }
    if (table.diameter.distribution != "constant" || !(table.diameter.value > 0.0))
        throw SceneError(key + ".diameter", "the file has no radius or diameter: give 'diameter' as a number");
    return std::vector<double>(listed.positions.size(), 0.5 * table.diameter.value);
}

std::vector<PackedSphere> listed_spheres(
    const scene::FillTable& table, const std::string& key, const Materials& materials)
{
    const auto& positions = table.spheres.positions;
    if (positions.empty()) throw SceneError(key + ".file", "the fill needs a file with spheres");
    if (table.count != 0 && table.count != static_cast<std::int64_t>(positions.size()))
        throw SceneError(key + ".count", "the file has " + std::to_string(positions.size()) + " spheres, not " +
                                             std::to_string(table.count) + "; leave 'count' out to take them all");
    const auto& own = table.spheres.materials;
    if (table.material.empty() && own.empty())
        throw SceneError(key + ".material", "the file has no materials: give the 'material' of its spheres");
    const int of_all = own.empty() ? material_index(materials, table.material, key + ".material") : 0;
    const auto radii = listed_radii(table, key);
    std::vector<PackedSphere> spheres;
    for (std::size_t i = 0; i < positions.size(); ++i)
        spheres.push_back(
            {positions[i], radii[i], own.empty() ? of_all : material_index(materials, own[i], key + ".file")});
    return spheres;
}

PackedSphere single_sphere(const scene::FillTable& table, const std::string& key, const Materials& materials)
{
    if (table.diameter.distribution != "constant" || !(table.diameter.value > 0.0))
        throw SceneError(key + ".diameter", "a single sphere has a 'diameter', a number");
    return {table.position, 0.5 * table.diameter.value, material_index(materials, table.material, key + ".material")};
}

/// About how many spheres a packing has, by number, mass or the share of its region that they fill.
std::int64_t count_of(const Fill& fill, const Materials& materials)
{
    const scene::FillTable& table = fill.table;
    if ((table.count > 0) + (table.mass > 0.0) + (table.filling > 0.0) > 1)
        throw SceneError(fill.key + ".count", "give 'count', 'mass' or 'filling', only one of them");
    double count = static_cast<double>(table.count);
    const double one = table.mass > 0.0 ? fill.mixture.mean_mass(materials) : fill.mixture.mean_volume();
    if (table.mass > 0.0) count = table.mass / one;
    if (table.filling > 0.0) count = table.filling * fill.region.volume() / one;
    if (count < 0.5 && table.count == 0 && (table.mass > 0.0 || table.filling > 0.0)) {
        char text[150];
        std::snprintf(text, sizeof text,
            "this is less than one sphere, which has %.3g %s on average: check sizes, density and units", one,
            table.mass > 0.0 ? "kg" : "m3");
        throw SceneError(fill.key + (table.mass > 0.0 ? ".mass" : ".filling"), text);
    }
    constexpr double most = 1e8; // as for a count
    if (!(count <= most)) throw SceneError(fill.key + ".mass", "these are more than 100 million spheres");
    return std::llround(count);
}

/// Of a count or rate and the mass that may stand for it, a pour has one.
void require_one(double value, double other, const std::string& key, const std::string& both)
{
    if (value > 0.0 && other > 0.0) throw SceneError(key, "give " + both + ", not both of them");
    if (!(value > 0.0) && !(other > 0.0)) throw SceneError(key, "a pour needs " + both + ", greater than 0");
}

Pour build_pour(const scene::PourTable& table, std::size_t index, const Materials& materials)
{
    const auto key = table_path("pour", index);
    require_one(static_cast<double>(table.count), table.mass, key + ".count", "'count' or 'mass'");
    require_one(table.rate, table.mass_rate, key + ".rate", "'rate' or 'mass_rate'");
    Pour pour;
    pour.name = table.name.empty() ? "pour " + std::to_string(index) : table.name;
    pour.mixture = build_mixture(table, key, materials);
    if (table.count > 0) pour.count = table.count;
    if (table.mass > 0.0) pour.mass = table.mass;
    if (table.rate > 0.0) pour.rate = table.rate;
    if (table.mass_rate > 0.0) pour.mass_rate = table.mass_rate;
    constexpr double most = 1e8; // as for a count
    if (!(expected_count(pour, materials) <= most))
        throw SceneError(key + ".mass", "this mass is that of more than 100 million spheres");
    pour.region = require_region(table.region, pour.mixture.mean_diameter(), key + ".region");
    pour.velocity = table.velocity;
    pour.start = table.start;
    return pour;
}

/// @param diameter of the largest sphere to come into the region [m]
void require_inside(const Box& world, const Region& region, double diameter, const std::string& key)
{
    constexpr double widest = 1e5; // diameters; a wider region is a slip of units, and would take for ever to fill
    if (!region.fits(0.5 * diameter)) throw SceneError(key, "the region is smaller than one sphere");
    if (region.bounds().extent().maxCoeff() > widest * diameter)
        throw SceneError(key, "the region is more than 100 000 spheres across");
    if (!world.contains(region.bounds()))
        throw SceneError(key, "the region reaches out of the world; see [world] min and max");
}

/// No packing of spheres fills more at random (0.64), and not every one comes so far.
void require_loose_enough(const Fill& fill)
{
    constexpr double densest = 0.62;
    const double share = static_cast<double>(fill.count) * fill.mixture.mean_volume() / fill.region.volume();
    if (!(share > densest)) return;
    char text[100];
    std::snprintf(
        text, sizeof text, "these spheres would fill %.2f of its region; a dense fill takes up to 0.6 of it", share);
    throw SceneError(fill.key + ".region", text);
}

/// How much a packing is to hold.
GrainSource::Amount amount_of(const Fill& fill)
{
    GrainSource::Amount amount;
    if (fill.table.mass > 0.0)
        amount.mass = fill.table.mass;
    else if (fill.table.filling > 0.0)
        amount.volume = fill.table.filling * fill.region.volume();
    else
        amount.count = fill.count;
    return amount;
}

/// The spheres of a packing. @param placed those of earlier fills
std::vector<PackedSphere> packed_spheres(
    const Fill& fill, const Model& model, const std::vector<PackedSphere>& placed, Random& random)
{
    const std::string& arrangement = fill.table.arrangement;
    if (arrangement == "dense") require_loose_enough(fill);
    const PackingRoom room(fill.region, fill.except, model);
    GrainSource grains(fill.mixture, model.materials, amount_of(fill));
    const auto spheres = arrangement == "lattice"  ? lattice_packing(room, grains, fill.table.spacing, placed, random)
                         : arrangement == "random" ? random_packing(room, grains, placed, random)
                                                   : dense_packing(room, grains, placed, random);
    const auto found = static_cast<std::int64_t>(spheres.size());
    if (!grains.is_open() && found == grains.taken()) return spheres;
    const std::string wanted = std::to_string(std::max(fill.count, found + 1));
    const std::string clear = " spheres of this size clear of walls and earlier fills";
    if (arrangement == "dense")
        throw SceneError(fill.key + ".region",
            "no room was found in the region for " + wanted + clear + "; make it larger, or lower their number");
    throw SceneError(fill.key + ".region", "the region holds " + std::to_string(found) + clear + ", not " + wanted +
                                               "; make it larger, lower their number" +
                                               (arrangement == "lattice" ? " or 'spacing'" : "") +
                                               ", or use arrangement \"dense\"");
}

/// A vector of independent normal numbers with deviation 1 (Box and Muller 1958).
Vec3 normal_vector(Random& random)
{
    Vec3 x;
    for (int d = 0; d < 3; ++d) {
        const double size = std::sqrt(-2.0 * std::log(1.0 - uniform(random)));
        x[d] = size * std::cos(2.0 * std::numbers::pi * uniform(random));
    }
    return x;
}

/// Element i of a list of the file's that may be missing.
Vec3 listed(const std::vector<Vec3>& list, std::size_t i)
{
    return list.empty() ? Vec3::Zero() : list[i];
}

} // namespace

std::vector<Fill> build_fills(const scene::Scene& scene, const Materials& materials)
{
    std::vector<Fill> fills;
    for (std::size_t k = 0; k < scene.fill.size(); ++k) {
        Fill fill{.key = table_path("fill", k), .table = scene.fill[k], .mixture = {}, .region = {}, .listed = {}};
        if (fill.table.arrangement == "file") {
            fill.listed = listed_spheres(fill.table, fill.key, materials);
        } else if (fill.table.arrangement == "single") {
            fill.listed = {single_sphere(fill.table, fill.key, materials)};
        } else {
            fill.mixture = build_mixture(fill.table, fill.key, materials);
            const double d = fill.mixture.mean_diameter();
            fill.region = require_region(fill.table.region, d, fill.key + ".region");
            for (std::size_t i = 0; i < fill.table.except.size(); ++i)
                fill.except.push_back(require_region(fill.table.except[i], d, table_path(fill.key + ".except", i)));
            fill.count = count_of(fill, materials);
        }
        fills.push_back(std::move(fill));
    }
    return fills;
}

std::vector<Pour> build_pours(const scene::Scene& scene, const Materials& materials)
{
    std::vector<Pour> pours;
    for (std::size_t k = 0; k < scene.pour.size(); ++k) pours.push_back(build_pour(scene.pour[k], k, materials));
    return pours;
}

void require_inside_world(const std::vector<Fill>& fills, const std::vector<Pour>& pours, const Box& world)
{
    for (const Fill& fill : fills) {
        if (!fill.is_list()) require_inside(world, fill.region, fill.mixture.max_diameter(), fill.key + ".region");
        for (std::size_t i = 0; i < fill.listed.size(); ++i)
            if (!world.contains(fill.listed[i].center))
                throw SceneError(fill.key + (fill.table.arrangement == "file" ? ".file" : ".position"),
                    "sphere " + std::to_string(i) + " of the fill lies outside of the world; see [world] min and max");
    }
    for (std::size_t k = 0; k < pours.size(); ++k)
        require_inside(world, pours[k].region, pours[k].mixture.max_diameter(), key_path("pour", k, "region"));
}

void place_spheres(State& state, const std::vector<Fill>& fills, const Model& model, Random& random)
{
    std::vector<PackedSphere> placed;
    for (const Fill& fill : fills) {
        const auto spheres = fill.is_list() ? fill.listed : packed_spheres(fill, model, placed, random);
        const scene::SphereList& file = fill.table.spheres;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const auto& s = spheres[i];
            Vec3 velocity = fill.table.velocity + listed(file.velocities, i);
            if (fill.table.temperature > 0.0) velocity += std::sqrt(fill.table.temperature) * normal_vector(random);
            add_sphere(state, s.center, s.radius, model.materials.list[static_cast<std::size_t>(s.material)].density,
                s.material, velocity, fill.table.angular_velocity + listed(file.angular_velocities, i));
        }
        placed.insert(placed.end(), spheres.begin(), spheres.end());
    }
}

} // namespace talus
