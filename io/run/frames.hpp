// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/simulation.hpp"
#include "core/supply/removal.hpp"
#include "scenarios/output_choice.hpp"

#include <filesystem>
#include <string>
#include <vector>

class vtkPolyData;

namespace talus
{

/// Writes the VTK frames of a run: frames/particles_000123.vtp and so on, appended raw with LZ4, 32-bit floats (64 bits
/// for places, where 32 would lose 1e-3 d of them), and after each the .pvd that lists them. Every file is replaced
/// atomically, so that a running or killed run opens. io/README.md lists the arrays.
class FrameWriter
{
public:
    /// @param folder the run's output folder, which exists.
    /// @param output what frames of spheres and contacts show
    /// @throws OutputError
    explicit FrameWriter(std::filesystem::path folder, OutputChoice output = {});

    /// The spheres, in the order of their ids, with the arrays that are asked for.
    /// @pre for `force` and `coordination`: no sphere was removed or renumbered since the last step
    /// @throws OutputError
    void write_particles(const Simulation& simulation);

    /// Contacts of the last step as lines, with the arrays that are asked for.
    /// @pre no sphere was removed or renumbered since that step
    /// @throws OutputError
    void write_contacts(const Simulation& simulation);

    /// The walls that stand at this time and do not move, as triangles with the wall's index. Planes are drawn
    /// twice as wide as what the scene holds.
    /// @throws OutputError
    void write_walls(const Model& model, const State& state);

    /// The walls that stand at this time and move. They have a series of their own, or a large wall that stands still
    /// would be written again and again.
    /// @throws OutputError
    void write_moving_walls(const Model& model, const State& state);

    /// Stores or puts back the times of the frames written so far.
    void persist(Archive& archive) { archive(particles_.times, contacts_.times, walls_.times, moving_walls_.times); }

    /// Removes the frames that came after those known here, and lists these anew: for a run that is resumed.
    /// @throws OutputError
    void cut_back() const;

    /// The names of those frames known here that are no longer there, or not to their end.
    std::vector<std::string> damaged() const;

private:
    struct Series {
        std::string name;
        std::vector<double> times; ///< of its frames [s]
    };
    std::filesystem::path folder_;
    OutputChoice output_;
    Series particles_{"particles", {}}, contacts_{"contacts", {}}, walls_{"walls", {}},
        moving_walls_{"moving_walls", {}};

    void add_walls_frame(Series& series, const Model& model, const State& state, bool moving);
    void add_frame(Series& series, double time, vtkPolyData& geometry);
    void write_list(const Series& series) const;
    void cut_back(const Series& series) const;
};

/// What a frame has near its beginning, and files of others have not: the units of its arrays.
inline constexpr std::string_view frame_mark = "Name=\"units\"";

/// Writes the spheres as a frame has them into a file that no list knows. @throws OutputError
void write_particles(const Simulation& simulation, const OutputChoice& output, const std::filesystem::path& file);

/// Writes lost.vtp into a run's folder: the spheres that escaped, each as it was then. Without any the file is removed.
/// @throws OutputError
void write_lost(const std::filesystem::path& folder, const std::vector<EscapedSphere>& escaped);

/// Whether the places in the frames of this scene have 64 bits, as far as it says where things are.
bool has_64_bit_frames(const Model& model);

} // namespace talus
