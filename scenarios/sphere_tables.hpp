// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/allowed.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

/// Materials, contacts, and the spheres there are: [materials.NAME], [[contact]], [[fill]], [[pour]] and [[outlet]].
namespace talus::scene
{

struct MaterialTable {
    std::string name; ///< the table's own name: [materials.NAME]
    double density = 2500.0;
    double young_modulus = infinity;
    double poisson = 0.3;

    static void describe(auto& self, auto&& key)
    {
        key("density", self.density, above(0.0), "kg/m3", "of the solid");
        key("young_modulus", self.young_modulus, or_infinite(above(0.0)), "Pa",
            "spheres are pressed flat as Hertz says, where that is softer than what sweeps carry; inf: rigid; only "
            "with matched");
        key("poisson", self.poisson, talus::scene::between(0.0, 0.5), "", "Poisson's ratio, beside young_modulus");
    }
};

/// What draws two materials together from when they touch.
struct CohesionTable {
    std::string law = "none";
    double force = 0.0;
    double work_of_adhesion = 0.0;
    double bond_number = 0.0;
    double surface_tension = 0.0;
    double contact_angle = 0.0;
    double volume = 0.0;
    double range = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("law", self.law, deciding(one_of({"none", "constant", "dmt", "jkr", "liquid", "bond_number"})), "",
            "of the force with which two draw each other, from when they touch until they are out of range");
        key("force", self.force, required(only_for({"constant"}, at_least(0.0))), "N",
            "the force; here and below 0 leaves it out");
        key("work_of_adhesion", self.work_of_adhesion, required(only_for({"dmt", "jkr"}, at_least(0.0))), "J/m2",
            "w: the force is 2 pi w R* (dmt) or 3/2 pi w R* (jkr, the pull-off force alone); w is twice the surface "
            "energy of two equal surfaces");
        key("bond_number", self.bond_number, required(only_for({"bond_number"}, at_least(0.0))), "",
            "the force / the weight of the lighter sphere");
        key("surface_tension", self.surface_tension, required(only_for({"liquid"}, at_least(0.0))), "N/m",
            "of the liquid: the force is 4 pi R* surface_tension cos(contact_angle), and falls with the gap");
        key("contact_angle", self.contact_angle, only_for({"liquid"}, talus::scene::between(0.0, 1.5)), "rad",
            "of the liquid on the surfaces");
        key("volume", self.volume, required(only_for({"liquid"}, above(0.0))), "m3",
            "of one bridge, which breaks at a gap of (1 + contact_angle / 2) volume^(1/3)");
        key("range", self.range, only_for({"constant", "dmt", "jkr", "bond_number"}, at_least(0.0)), "m",
            "up to which gap the force holds; 0: a hundredth of the mean diameter");
    }
};

struct ContactTable {
    std::vector<std::string> between; ///< two materials
    double friction = 0.5;
    double restitution = 0.0;
    double rolling_friction = 0.0;
    double stiffness = infinity;
    double twisting_friction = 0.0;
    CohesionTable cohesion = {};

    static void describe(auto& self, auto&& key)
    {
        key("between", self.between, required(any()), "", "the two materials");
        key("friction", self.friction, at_least(0.0), "", "Coulomb's coefficient");
        key("restitution", self.restitution, talus::scene::between(0.0, 1.0), "",
            "Newton's coefficient: rebound speed / impact speed");
        key("rolling_friction", self.rolling_friction, at_least(0.0), "",
            "largest rolling torque / (normal force x R*), R* = r1 r2 / (r1 + r2), at a wall the radius");
        key("twisting_friction", self.twisting_friction, at_least(0.0), "",
            "largest torque about the normal / (normal force x R*)");
        key("stiffness", self.stiffness, or_infinite(above(0.0)), "N/m",
            "of the normal contact, in place of what young_modulus says; inf: none; only with matched");
        key("cohesion", self.cohesion, any(), "", "what draws the two together");
    }
};

struct RegionTable {
    std::string shape = "box";
    Vec3 min = Vec3::Zero();
    Vec3 max = Vec3::Zero();
    Vec3 base = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
    Vec3 center = Vec3::Zero();
    double radius = 0.0;
    double base_radius = 0.0;
    double top_radius = 0.0;
    double height = 0.0;
    std::string mesh = {};
    double scale = 1.0;
    Vec3 translate = Vec3::Zero();

    std::vector<Vec3> vertices = {};                         ///< of the mesh, filled in by io, scaled and translated
    std::vector<std::array<std::int32_t, 3>> triangles = {}; ///< of the mesh, filled in by io

    static void describe(auto& self, auto&& key) { describe(self, key, {"box", "cylinder", "cone", "sphere", "mesh"}); }

    /// @param shapes that the region may have, among them box and cylinder
    static void describe(auto& self, auto&& key, const std::vector<std::string_view>& shapes)
    {
        // The keys of the other shapes only where these may stand.
        const auto with = [&](const char* other, std::vector<std::string_view> kinds) {
            if (std::ranges::find(shapes, other) != shapes.end()) kinds.emplace_back(other);
            return kinds;
        };
        const bool all = with("mesh", {}).size() == 1;
        key("shape", self.shape, deciding(one_of(shapes)), "", all ? "mesh: the inside of a closed one" : "");
        key("min", self.min, only_for({"box"}, any()), "m", "lower corner");
        key("max", self.max, required(only_for({"box"}, any())), "m", "upper corner");
        key("base", self.base, only_for(with("cone", {"cylinder"}), any()), "m", "centre of the first end");
        key("axis", self.axis, only_for(with("cone", {"cylinder"}), any()), "",
            "direction from the first end to the second");
        key("radius", self.radius, required(only_for(with("sphere", {"cylinder"}), at_least(0.0))), "m",
            all ? "of the cylinder or sphere" : "of the cylinder");
        key("height", self.height, required(only_for(with("cone", {"cylinder"}), at_least(0.0))), "m",
            "distance of the ends");
        if (!all) return;
        key("center", self.center, only_for({"sphere"}, any()), "m", "of the sphere");
        key("base_radius", self.base_radius, only_for({"cone"}, at_least(0.0)), "m", "of the first end");
        key("top_radius", self.top_radius, only_for({"cone"}, at_least(0.0)), "m", "of the second end");
        key("mesh", self.mesh, required(only_for({"mesh"}, any())), "", "an STL file, beside the scene file");
        key("scale", self.scale, only_for({"mesh"}, above(0.0)), "", "the file's numbers times this are metres");
        key("translate", self.translate, only_for({"mesh"}, any()), "m", "moved by this after scaling");
    }
};

struct DiameterTable {
    std::string distribution = "constant";
    double value = 0.0;
    double mean = 0.0;
    double median = 0.0;
    double deviation = 0.0;
    double min = 0.0;
    double max = 0.0;
    std::string file = {};

    std::vector<double> sieve_sizes = {};   ///< [m], of the file, filled in by io, rising
    std::vector<double> sieve_passing = {}; ///< share of the mass that passes each, from 0 to 1

    static void describe(auto& self, auto&& key)
    {
        key("distribution", self.distribution,
            deciding(one_of({"constant", "uniform", "normal", "lognormal", "sieve"})), "",
            "of diameters: by number, but for a sieve analysis, which is by mass");
        key("value", self.value, required(only_for({"constant"}, at_least(0.0))), "m", "the diameter");
        key("mean", self.mean, required(only_for({"normal"}, above(0.0))), "m", "before min and max cut it");
        key("median", self.median, required(only_for({"lognormal"}, above(0.0))), "m", "before min and max cut it");
        key("deviation", self.deviation, required(only_for({"normal", "lognormal"}, above(0.0))),
            self.distribution == "normal" ? "m" : "",
            "standard deviation; normal: of the diameter [m], lognormal: of its natural logarithm");
        key("min", self.min, required(only_for({"uniform", "normal", "lognormal"}, at_least(0.0))), "m",
            "the smallest");
        key("max", self.max, required(only_for({"uniform", "normal", "lognormal"}, at_least(0.0))), "m", "the largest");
        key("file", self.file, required(only_for({"sieve"}, any())), "",
            "a CSV file, beside the scene file: size_mm or size_m, and passing_percent of the mass");
    }

    /// Whether the scene gives a diameter here, where it may be left out.
    bool given() const { return distribution != "constant" || value != 0.0; }
};

/// One kind of sphere among several in a fill or a pour.
struct SpeciesTable {
    std::string material;
    DiameterTable diameter;
    double share = 1.0;

    static void describe(auto& self, auto&& key)
    {
        key("material", self.material, required(any()), "", "of the spheres");
        key("diameter", self.diameter, required(any()), "m", "a number, or a table with a distribution");
        key("share", self.share, required(above(0.0)), "",
            "of the mass, in proportion to the sum of the shares of all species");
    }
};

/// Spheres as a file lists them [m, m/s, rad/s]. A list other than that of positions is empty where the file has none.
struct SphereList {
    std::vector<Vec3> positions;
    std::vector<double> radii;
    std::vector<Vec3> velocities;
    std::vector<Vec3> angular_velocities;
    std::vector<std::string> materials; ///< their names
    std::string columns;                ///< which columns or arrays were taken, and which passed over
};

struct FillTable {
    std::string arrangement = "lattice";
    std::string material;
    DiameterTable diameter;
    std::vector<SpeciesTable> species;
    std::int64_t count = 0;
    double mass = 0.0;
    double filling = 0.0;
    Vec3 position = Vec3::Zero();
    RegionTable region;
    std::vector<RegionTable> except;
    double spacing = 1.1;
    std::string file;
    double scale = 1.0;
    Vec3 translate = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();
    double temperature = 0.0;

    SphereList spheres; ///< of the file, filled in by io, scaled and translated

    static void describe(auto& self, auto&& key)
    {
        key("arrangement", self.arrangement, deciding(one_of({"lattice", "random", "dense", "single", "file"})), "",
            "lattice: a jittered lattice, filled from below; random: anywhere without overlap (loose fills only); "
            "dense: at random and then pushed apart, up to 0.6 of the region; single: one sphere; file: as a file "
            "lists them");
        key("material", self.material, any(), "",
            "of the spheres; left out where there are species, and not used where the file has materials");
        key("diameter", self.diameter, any(), "m",
            "a number, or a table with a distribution; left out where there are species, or where the file has radii");
        key("species", self.species, only_for({"lattice", "random", "dense"}, any()), "",
            "several kinds of spheres, mixed at random");
        key("count", self.count, only_for({"lattice", "random", "dense", "file"}, between(0, 100000000)), "",
            "how many spheres are there at the start; 0: by 'mass' or 'filling'; file: 0, or as many as it has");
        key("mass", self.mass, only_for({"lattice", "random", "dense"}, at_least(0.0)), "kg",
            "of all spheres, to the nearest that whole spheres of mean mass come to");
        key("filling", self.filling, only_for({"lattice", "random", "dense"}, between(0.0, 0.74)), "",
            "the volume of all spheres, as a share of the region's");
        key("position", self.position, required(only_for({"single"}, any())), "m", "of the sphere's centre");
        key("region", self.region, required(only_for({"lattice", "random", "dense"}, any())), "",
            "where; spheres lie wholly inside, and on the side of closed walls where more of it lies");
        key("except", self.except, only_for({"lattice", "random", "dense"}, any()), "", "regions that are kept free");
        key("spacing", self.spacing, only_for({"lattice"}, between(1.0, 100.0)), "",
            "distance of the lattice's points / largest diameter");
        key("file", self.file, required(only_for({"file"}, any())), "",
            "a .vtp, .vtu or .csv file of spheres, beside the scene file");
        key("scale", self.scale, only_for({"file"}, above(0.0)), "",
            "the file's positions, radii and velocities times this are in m and m/s");
        key("translate", self.translate, only_for({"file"}, any()), "m", "moved by this after scaling");
        key("velocity", self.velocity, any(), "m/s", "of the spheres at the start, added to that of a file");
        key("angular_velocity", self.angular_velocity, any(), "rad/s",
            "of the spheres at the start, added to that of a file");
        key("temperature", self.temperature, at_least(0.0), "m2/s2",
            "granular: random velocities are added, normal along each axis, whose mean squares are this");
    }
};

struct PourTable {
    std::string name;
    std::string material;
    DiameterTable diameter;
    std::vector<SpeciesTable> species;
    std::int64_t count = 0;
    double mass = 0.0;
    double rate = 0.0;
    double mass_rate = 0.0;
    RegionTable region;
    Vec3 velocity = Vec3::Zero();
    double start = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, any(), "", "for --set and the report");
        key("material", self.material, any(), "", "of the spheres; left out where there are species");
        key("diameter", self.diameter, any(), "m",
            "a number, or a table with a distribution; left out where there are species");
        key("species", self.species, any(), "", "several kinds of spheres, mixed at random");
        key("count", self.count, between(0, 100000000), "", "how many spheres in all; 0: by 'mass'");
        key("mass", self.mass, at_least(0.0), "kg", "of all spheres, reached by the last of them; 0: by 'count'");
        key("rate", self.rate, at_least(0.0), "1/s", "spheres per second; 0: by 'mass_rate'");
        key("mass_rate", self.mass_rate, at_least(0.0), "kg/s", "mass per second; 0: by 'rate'");
        key("region", self.region, required(any()), "", "where they appear; never overlapping anything");
        key("velocity", self.velocity, any(), "m/s", "with which they appear");
        key("start", self.start, at_least(0.0), "s", "when the pour begins");
    }
};

/// The names of all materials in a fill or a pour.
std::vector<std::string> materials_in(const auto& table)
{
    if (table.species.empty()) return {table.material};
    std::vector<std::string> names;
    for (const SpeciesTable& species : table.species) names.push_back(species.material);
    return names;
}

struct OutletTable {
    std::string name;
    RegionTable region;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, any(), "", "for --set and the report");
        key("region", self.region, required(any()), "", "a sphere whose centre enters it leaves the world");
    }
};

} // namespace talus::scene
