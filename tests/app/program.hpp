// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

/// How a call of the program ended.
struct Outcome {
    int exit_code = -1;
    std::string out; ///< what it printed
    std::string err; ///< what it complained about
};

/// A folder of a test's own, removed with it, in which the program is called.
class Workplace
{
public:
    Workplace();
    ~Workplace();
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

    /// Calls `talus` with these arguments, as a shell reads them.
    /// @param limits shell commands that come before, e.g. "ulimit -f 8;"
    Outcome talus(const std::string& arguments, const std::string& limits = "") const;

    /// Runs commands of a shell in the folder, in which $TALUS is the program.
    Outcome shell(const std::string& commands) const;

    /// Calls `talus` and sends it a signal as soon as a file is there.
    /// @param signal as `kill` takes it, e.g. "INT"
    Outcome talus_until(const std::string& file, const std::string& signal, const std::string& arguments) const;

    /// Runs a scene text as scene.toml into the folder out, on one thread.
    Outcome run(const std::string& scene, const std::string& options = "") const;

private:
    std::filesystem::path folder_;
};

/// Eight beads that fall onto the floor of a box: 0.05 s, six frames.
extern const std::string beads_in_a_box;

/// A bead that slides over the edge of a table and falls out of the world, which ends five diameters below.
extern const std::string bead_on_a_table;

/// Beads poured into the box fall through its open floor into an outlet, past a sensor: 0.4 s.
std::string stream_of_beads();

/// A heavy plate falls onto the beads and is pressed on them by a load that rises: 0.4 s.
std::string loaded_beads();

/// The text with one part of it replaced.
/// @pre the part occurs
std::string replaced(std::string text, const std::string& part, const std::string& replacement);

/// The line in which the part occurs, counted from 1.
/// @pre the part occurs
int line_of(const std::string& text, const std::string& part);
