// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/grain_source.hpp"

#include "scenarios/builder/bed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus
{
namespace
{

/// The classes of a sieve analysis as distributions of their own, each with its share by number; else the whole.
std::vector<std::pair<SizeDistribution, double>> classes_of(const SizeDistribution& sizes)
{
    if (sizes.law != SizeDistribution::Law::sieve) return {{sizes, 1.0}};
    std::vector<std::pair<SizeDistribution, double>> classes;
    for (const auto& [min, max, number] : sizes.classes) {
        SizeDistribution one = sizes;
        one.min = min;
        one.max = max;
        one.classes = {{min, max, 1.0}};
        if (number > 0.0) classes.emplace_back(std::move(one), number);
    }
    return classes;
}

} // namespace

GrainSource::GrainSource(const Mixture& mixture, const Materials& materials, const Amount& amount)
    : materials_(materials), amount_(amount), max_diameter_(mixture.max_diameter()),
      mean_mass_(mixture.mean_mass(materials))
{
    for (const Species& species : mixture.species) {
        const double density = materials.list[static_cast<std::size_t>(species.material)].density;
        for (const auto& [sizes, number] : classes_of(species.diameter))
            parts_.push_back(
                {species.material, sizes, species.number * number * density * sizes.mean_volume() / mean_mass_});
    }
}

Grain GrainSource::draw(Random& random)
{
    const auto lacks = [&](const Part& part) { return part.share * (mass_ + mean_mass_) - part.mass; };
    const auto neediest = std::ranges::max_element(parts_, {}, lacks);
    drawn_ = static_cast<std::size_t>(neediest - parts_.begin());
    return {neediest->diameter.draw(random), neediest->material};
}

bool GrainSource::wants(const Grain& grain)
{
    const auto comes_nearer = [](double whole, double taken, double more) {
        return whole == infinity || std::abs(whole - taken - more) < std::abs(whole - taken);
    };
    complete_ = count_ >= amount_.count ||
                (count_ > 0 && !(comes_nearer(amount_.mass, mass_, mass_of(grain)) &&
                                   comes_nearer(amount_.volume, volume_, volume_of_sphere(grain.diameter))));
    return !complete_;
}

void GrainSource::take(const Grain& grain)
{
    parts_[drawn_].mass += mass_of(grain);
    mass_ += mass_of(grain);
    volume_ += volume_of_sphere(grain.diameter);
    ++count_;
}

double GrainSource::mass_of(const Grain& grain) const
{
    return materials_.list[static_cast<std::size_t>(grain.material)].density * volume_of_sphere(grain.diameter);
}

} // namespace talus
