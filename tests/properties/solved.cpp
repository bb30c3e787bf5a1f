// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/solved.hpp"

#include <algorithm>
#include <sstream>

namespace talus::test
{

bool is_solved(const World& world, const StepReport& report)
{
    if (report.solve.converged || report.solve.residual <= 1e-12) return true;
    // ε is relative to the impulses: where these are tiny beside what moves, rounding alone is more than the tolerance.
    constexpr double digits = 1e-14;
    double size = 0.0, momentum = 0.0;
    const auto note = [&](const TileContacts& contacts) {
        for (const std::size_t k : contacts.indices())
            size += contacts.contact(k).inverse_mass_sum * contacts.impulse(k).squaredNorm();
    };
    for (const TileContacts& tile : world.network.contacts.spheres) note(tile);
    for (const TileContacts& tile : world.network.contacts.walls) note(tile);
    note(world.network.contacts.pistons);
    for (std::size_t i = 0; i < world.state.count(); ++i)
        momentum = std::max(momentum, world.state.mass(i) * world.state.body(i).velocity.squaredNorm());
    if (size < 1e-280) return true; // the squares of the impulses are too small to be numbers
    return report.solve.residual * report.solve.residual * size <= digits * digits * momentum;
}

std::string told_unsolved(const RandomWorld& own, const StepReport& report)
{
    std::ostringstream text;
    text << "world " << own.seed << " is not solved: residual " << report.solve.residual << " after "
         << report.solve.sweeps << " sweeps, masses 1 : " << own.mass_ratio()
         << (own.is_frictionless() ? "" : ", friction") << '\n'
         << picture(own);
    return text.str();
}

} // namespace talus::test
