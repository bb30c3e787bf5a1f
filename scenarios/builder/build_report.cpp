// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_report.hpp"

#include "core/law/hertz.hpp"
#include "scenarios/builder/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace talus
{
namespace
{

template <class... Numbers> std::string text(const char* format, Numbers... numbers)
{
    char buffer[300];
    std::snprintf(buffer, sizeof buffer, format, numbers...);
    return buffer;
}

/// Whether a bed is as soft as its materials. @param carried K [N/m]; @param load the mean force of its contacts [N]
std::string forecast_hertz(double modulus, double d, double carried, double depth, double load)
{
    const HertzLaw<double> law(modulus, 0.25 * d, carried);
    const double here = law.compression_under(load / carried);
    const double of_hertz = load > 0.0 ? load / secant_stiffness(modulus, 0.25 * d, load) : 0.0;
    return text("contacts of two spheres are Hertz's with E* = %.3g Pa, but no stiffer than %.3g N/m: ", modulus,
               carried) +
           text("the %.3g d whose weight this bed may bear press them by %.2g %% d on average, where Hertz has %.2g "
                "(%s)",
               depth, 100.0 * here / d, 100.0 * of_hertz / d,
               here <= law.knee ? "as soft as the materials" : "softer than the materials: sweeps carry no more");
}

} // namespace

std::string explain_step(const StepChoice& choice, double d)
{
    const double automatic = choice.automatic();
    if (choice.given)
        return text("step %.4g ms: given by the scene (auto would be %.4g ms)", 1e3 * choice.step, 1e3 * automatic);
    const std::pair<double, std::string> targets[] = {
        {choice.by_approach, text("the approach of what closes at %.3g m/s", choice.meeting_speed())},
        {choice.by_attraction, "the way that attraction brings spheres nearer in a step"},
        {choice.by_overlap, "the mean overlap of the bed"}, {choice.by_creep, "the creep of a bed at rest"},
        {choice.by_heavy, "the overlap below its heaviest sphere"},
        {choice.by_samples == automatic ? automatic : infinity, "the time between samples"}};
    std::string decides, others;
    for (const auto& [step, target] : targets)
        if (step == automatic && decides.empty())
            decides = target;
        else if (std::isfinite(step))
            others += (others.empty() ? "" : ", ") + target + text(" %.4g ms", 1e3 * step);
    return text("step %.4g ms with %d sweeps at least, for %s (smallest d = %.4g mm)%s", 1e3 * automatic,
               choice.min_sweeps, decides.c_str(), 1e3 * d, others.empty() ? "" : "; would allow: ") +
           others;
}

std::string explain_model(const Model& model)
{
    const auto& p = model.physics;
    const bool meshes = std::any_of(
        model.walls.begin(), model.walls.end(), [](const Wall& w) { return std::holds_alternative<Mesh>(w.shape); });
    std::string models = "models contact", leaves_out;
    const auto say = [&](bool needed, const char* what) {
        auto& list = needed ? models : leaves_out;
        list += (list.empty() ? "" : ", ") + std::string(what);
    };
    say(p.friction, "friction");
    say(p.spin, "rotation");
    say(std::ranges::any_of(model.materials.laws, [](const ContactLaw& law) { return law.rolling_friction > 0.0; }),
        "rolling resistance");
    say(p.twisting, "twisting resistance");
    say(p.restitution, "restitution");
    say(p.attraction, "cohesion");
    say(p.elasticity, "moduli of materials");
    say(meshes, "mesh walls");
    say(p.moving_walls, "moving walls");
    say(p.pistons, "walls of finite mass");
    say(model.periodicity.any(), "periodic axes");
    say(!model.outlets.empty(), "outlets");
    if (model.solver.stabilisation == Stabilisation::projected)
        say(model.solver.pressure_scaling, "scaling of pressures");
    return models + (leaves_out.empty() ? "" : "; leaves out " + leaves_out);
}

std::string explain_world(const Box& world)
{
    std::string bounds;
    for (int d = 0; d < 3; ++d) {
        const double low = world.min[d], high = world.max[d];
        const bool begins = std::isfinite(low), ends = std::isfinite(high);
        bounds += std::string(d > 0 ? ", " : "") + "xyz"[d];
        bounds += begins && ends ? text(" from %.4g to %.4g", low, high)
                  : begins       ? text(" from %.4g up", low)
                  : ends         ? text(" up to %.4g", high)
                                 : " without end";
    }
    return bounds + ", in m";
}

std::string forecast_overlap(const Simulation& simulation, const Bed& bed)
{
    const auto& model = simulation.model;
    if (model.solver.stabilisation == Stabilisation::projected)
        return "contacts are rigid; spheres that overlap are moved apart after each step";
    const double h = model.time_step, d = model.mean_diameter;
    const auto n = model.solver.min_sweeps;
    double density = 0.0, stiffness = infinity, modulus = infinity;
    for (const int a : sphere_materials(simulation)) {
        density = std::max(density, model.materials.list[static_cast<std::size_t>(a)].density);
        for (const int b : sphere_materials(simulation)) {
            stiffness = std::min(stiffness, model.materials.between(a, b).stiffness);
            modulus = std::min(modulus, model.materials.between(a, b).modulus);
        }
    }
    const double inverse_mass_sum = 2.0 / (density * std::numbers::pi / 6.0 * d * d * d);
    const double carried = carried_stiffness<double>(inverse_mass_sum, law_of_step(model, StepLength{h}));
    stiffness = std::min(stiffness, carried);
    const double of_layer = 0.45 * model.gravity.norm() * h * h / (n * d), depth = bed.borne_depth();
    if (std::isfinite(modulus)) return forecast_hertz(modulus, d, carried, depth, carried * of_layer * depth * d);
    return text("contacts of two spheres are at most %.3g N/m stiff: a bed of a depth Z overlaps by %.2g Z on average, "
                "twice that at its bottom; with the %.3g d whose weight this one may bear by %.2g %% d",
        stiffness, of_layer, depth, 100.0 * of_layer * depth);
}

std::string explain_files(const scene::Scene& scene)
{
    std::string found;
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        if (!scene.fill[k].spheres.columns.empty())
            found +=
                text("%sfill[%d] ", found.empty() ? "" : "; ", static_cast<int>(k)) + scene.fill[k].spheres.columns;
    return found;
}

std::vector<std::string> warnings_of(const scene::Scene& scene, const StepChoice& choice, const Model& model)
{
    constexpr double far_above = 10.0;
    constexpr double wide = 1000.0;
    constexpr double tight = 1.5; // at 1.4 stacks of a lattice stood, at 1.8 they fell
    std::vector<std::string> warnings;
    if (choice.given && choice.step > far_above * choice.automatic())
        warnings.push_back(text("the step of %.4g ms is %.3g times the automatic one: overlaps grow with its square",
            1e3 * choice.step, choice.step / choice.automatic()));
    const bool stands = !scene.world.rotation && model.physics.friction && !model.gravity.isZero();
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        if (stands && scene.fill[k].arrangement == "lattice" && scene.fill[k].spacing < tight)
            warnings.push_back(
                text("fill[%d]: without rotation the stacks of so tight a lattice stay upright; give it a "
                     "'spacing' of 1.8, or arrange it at random",
                    static_cast<int>(k)));
    for (std::size_t k = 0; k < scene.fill.size(); ++k) {
        const auto& fill = scene.fill[k];
        const bool is_packing = fill.arrangement == "lattice" || fill.arrangement == "random";
        if (is_packing && fill.count == 0 && fill.mass == 0.0 && fill.filling == 0.0)
            warnings.push_back(
                text("fill[%d] has no spheres: it has no 'count', 'mass' or 'filling'", static_cast<int>(k)));
    }
    for (const Wall& wall : model.walls) {
        const Box box = bounds(wall.shape);
        const double size = box.empty() ? 0.0 : box.extent().maxCoeff();
        if (size > wide * model.mean_diameter)
            warnings.push_back(
                "wall '" + wall.name + "' " +
                text("is %.4g m long, %.2g diameters of a sphere", size, size / model.mean_diameter) +
                (std::holds_alternative<Mesh>(wall.shape) ? "; an STL file in millimetres needs scale = 0.001" : ""));
    }
    for (const auto& table : scene.wall)
        if (std::string left_out = left_out_of_mesh(table); !left_out.empty()) warnings.push_back(std::move(left_out));
    return warnings;
}

} // namespace talus
