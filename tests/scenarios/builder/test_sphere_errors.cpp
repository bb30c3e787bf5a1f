// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scenarios/builder/mistakes.hpp"

using namespace talus;
using namespace talus::test;

namespace
{

const std::vector<Mistake> of_spheres = {
    {[](S& s) { s.fill[0].count = 0; }, "fill",
        "the scene has no spheres: give a [[fill]] or a [[pour]] with a count above 0"},
    {[](S& s) { s.fill[0].diameter.value = 0.0; }, "fill[0].diameter.value",
        "the diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter.distribution = "uniform"; }, "fill[0].diameter.min",
        "the smallest diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = {.distribution = "uniform", .min = 0.02, .max = 0.01}; }, "fill[0].diameter.max",
        "the largest diameter must not be below the smallest"},
    {[](S& s) { s.fill[0].region.max.x() = 0.0; }, "fill[0].region.max",
        "the box is empty: every coordinate of 'min' must be below that of 'max'"},
    {[](S& s) { s.fill[0].region.shape = "cylinder"; }, "fill[0].region.radius",
        "the radius of a cylinder must be given, and greater than 0"},
    {[](S& s) { s.fill[0].region.max.x() = 0.009; }, "fill[0].region", "the region is smaller than one sphere"},
    {[](S& s) {
         // Lattice points 20 mm apart: one layer of two by two between the walls, at most five of them high.
         s.fill[0].spacing = 2.0;
         s.fill[0].region.max = Vec3(0.019, 0.019, 0.019);
     },
        "fill[0].region",
        "the region holds 1 spheres of this size clear of walls and earlier fills, not 20; make it larger, lower "
        "their number or 'spacing', or use arrangement \"dense\""},
    {[](S& s) {
         s.fill[0].arrangement = "random";
         s.fill[0].region.max = Vec3(0.0101, 0.0101, 0.0101);
     },
        "fill[0].region",
        "the region holds 1 spheres of this size clear of walls and earlier fills, not 20; make it larger, lower "
        "their number, or use arrangement \"dense\""},
    {[](S& s) {
         s.fill[0].count = 1;
         s.fill[0].spacing = 1.0;
         s.fill[0].region.max = Vec3(0.0101, 0.0101, 0.0101);
         s.fill.push_back(s.fill[0]);
     },
        "fill[1].region",
        "the region holds 0 spheres of this size clear of walls and earlier fills, not 1; make it larger, lower "
        "their number or 'spacing', or use arrangement \"dense\""},
    {[](S& s) { s.fill[0].region.max.x() = 1100.0; }, "fill[0].region",
        "the region is more than 100 000 spheres across"},
    {[](S& s) { s.world.max.x() = 0.04; }, "fill[0].region",
        "the region reaches out of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.world.min.z() = -0.1;
         s.world.max.z() = 0.17;
     },
        "pour[0].region", "the region reaches out of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].region.max.z() = 0.155;
     },
        "pour[0].region", "the region is smaller than one sphere"},
    {[](S& s) {
         s.pour = {small_pour(), small_pour()};
         s.pour[0].name = s.pour[1].name = "rain";
     },
        "pour[1].name", "two pours are called 'rain'"},
};

/// A species of 10 mm beads.
scene::SpeciesTable species(const std::string& material, double share)
{
    scene::SpeciesTable table;
    table.material = material;
    table.diameter.value = 0.01;
    table.share = share;
    return table;
}

/// Makes fill[0] that of a file with two spheres clear of all.
void list_spheres(S& s)
{
    s.fill[0].arrangement = "file";
    s.fill[0].count = 0;
    s.fill[0].diameter = {};
    s.fill[0].spheres.positions = {Vec3(0.01, 0.01, 0.01), Vec3(0.03, 0.01, 0.01)};
    s.fill[0].spheres.radii = {0.005, 0.005};
}

scene::DiameterTable cut(const std::string& distribution, double middle, double deviation, double min, double max)
{
    scene::DiameterTable table;
    table.distribution = distribution;
    table.mean = table.median = middle;
    table.deviation = deviation;
    table.min = min;
    table.max = max;
    return table;
}

const std::vector<Mistake> of_insertion = {
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.0, 0.02); }, "fill[0].diameter.min",
        "the smallest diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.02, 0.01); }, "fill[0].diameter.max",
        "the largest diameter must not be below the smallest"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.01, 0.1, 0.01, 0.01); }, "fill[0].diameter.max",
        "'max' must be above 'min'; for one size use distribution \"constant\""},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.0, 0.005, 0.02); }, "fill[0].diameter.deviation",
        "the standard deviation must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.0, 0.001, 0.005, 0.02); }, "fill[0].diameter.mean",
        "the mean diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.0, 0.1, 0.005, 0.02); }, "fill[0].diameter.median",
        "the median diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.013, 0.02); }, "fill[0].diameter.min",
        "less than 1 % of the normal distribution lies between 'min' and 'max'; widen them"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.01, 0.1, 0.002, 0.005); }, "fill[0].diameter.min",
        "less than 1 % of the lognormal distribution lies between 'min' and 'max'; widen them"},
    {[](S& s) { s.fill[0].diameter.distribution = "sieve"; }, "fill[0].diameter.file",
        "a distribution \"sieve\" needs a file with two sieves at least"},
    {[](S& s) { s.fill[0].material.clear(); }, "fill[0].material",
        "give a 'material' and a 'diameter', or a list of 'species'"},
    {[](S& s) { s.fill[0].species = {species("glass", 1.0)}; }, "fill[0].species",
        "where there are 'species', each has its own 'material' and 'diameter': leave out the others"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].material.clear();
         s.pour[0].species = {species("glass", 1.0)};
     },
        "pour[0].species",
        "where there are 'species', each has its own 'material' and 'diameter': leave out the others"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("wood", 1.0)};
     },
        "fill[0].species[1].material", "unknown material 'wood'; the scene has glass"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("glass", 1.0)};
         s.fill[0].species[1].diameter.value = 0.0;
     },
        "fill[0].species[1].diameter.value", "the diameter must be given, and greater than 0"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 0.0)};
     },
        "fill[0].species[0].share", "the share must be given, and greater than 0"},
    {[](S& s) {
         s.materials.push_back({"steel", 7800.0});
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("steel", 1.0)};
     },
        "contact", "no [[contact]] between glass and steel, which can touch"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].spheres = {};
     },
        "fill[0].file", "the fill needs a file with spheres"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].count = 3;
     },
        "fill[0].count", "the file has 2 spheres, not 3; leave 'count' out to take them all"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].diameter.value = 0.01;
     },
        "fill[0].diameter", "the file has the radii of its spheres: leave 'diameter' out"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].spheres.radii.clear();
     },
        "fill[0].diameter", "the file has no radius or diameter: give 'diameter' as a number"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].material = "wood";
     },
        "fill[0].material", "unknown material 'wood'; the scene has glass"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].material.clear();
     },
        "fill[0].material", "the file has no materials: give the 'material' of its spheres"},
    {[](S& s) {
         list_spheres(s);
         s.world.max.x() = 0.02;
     },
        "fill[0].file", "sphere 1 of the fill lies outside of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].count = 0;
     },
        "pour[0].count", "a pour needs 'count' or 'mass', greater than 0"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].mass = 1.0;
     },
        "pour[0].count", "give 'count' or 'mass', not both of them"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].rate = 0.0;
     },
        "pour[0].rate", "a pour needs 'rate' or 'mass_rate', greater than 0"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].mass_rate = 1.0;
     },
        "pour[0].rate", "give 'rate' or 'mass_rate', not both of them"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].count = 0;
         s.pour[0].mass = 1e6;
     },
        "pour[0].mass", "this mass is that of more than 100 million spheres"},
};

} // namespace

TEST_CASE("a mistake in what spheres there are is reported, with its key and the reason", "[scenes][errors]")
{
    SECTION("spheres")
    {
        check_all(of_spheres);
    }
    SECTION("sizes, species, files and pours")
    {
        check_all(of_insertion);
    }
}
