// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

/// The Python scripts of postprocess/, which look at runs.
namespace talus
{

/// How a script ended, and what it said.
struct ScriptEnd {
    int exit_code = 0; ///< 128 and the number of the signal that ended it, where one did
    std::string out;   ///< without the ends of its lines
    std::string err;
};

/// Becomes the script: it has this process, its terminal and its exit code.
/// @param script a name in postprocess/
/// @throws UsageError where there is no such script, or no Python
[[noreturn]] void become_script(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a script to its end; a terminal's Ctrl-C does not reach it.
/// @throws UsageError as above
ScriptEnd run_script(const std::string& script, const std::vector<std::string>& arguments);

/// A script that runs beside this program, and says what it says itself.
class ScriptBeside
{
public:
    /// @throws UsageError as above
    ScriptBeside(const std::string& script, const std::vector<std::string>& arguments);
    ~ScriptBeside(); ///< waits for its end
    ScriptBeside(const ScriptBeside&) = delete;
    ScriptBeside& operator=(const ScriptBeside&) = delete;

private:
    pid_t process_;
};

} // namespace talus
