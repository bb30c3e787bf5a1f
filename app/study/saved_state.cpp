// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/saved_state.hpp"

#include "io/run/checkpoint.hpp"
#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus
{

std::string state_of(Simulation& simulation)
{
    Archive archive;
    simulation.persist_without_sensors(archive);
    return archive.bytes();
}

void put_back(Simulation& simulation, std::string state)
{
    Archive archive(std::move(state));
    simulation.persist_without_sensors(archive);
}

void save_state(Simulation& simulation, const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    write_checkpoint(folder, TALUS_VERSION, state_of(simulation));
}

void load_state(Simulation& simulation, const std::filesystem::path& folder)
{
    Checkpoint checkpoint = read_checkpoint(folder, TALUS_VERSION);
    try {
        put_back(simulation, std::move(checkpoint.state));
    } catch (const ArchiveError& error) {
        throw InputError(fmt::format("{}: cannot be put back: {}", checkpoint.path.string(), error.what()));
    }
    const double h = simulation.model.time_step;
    simulation.state.steps = std::llround(simulation.state.time / h);
    simulation.state.time = static_cast<double>(simulation.state.steps) * h;
}

} // namespace talus
