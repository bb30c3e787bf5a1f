// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/command_line.hpp"

/// What scripts of postprocess/ do with many runs. Each becomes its script, and so does not return.
namespace talus
{

/// Expands a sweep into its cases, and runs them where it is asked to.
[[noreturn]] void sweep_scenes(const CommandLine& line);

/// Gathers what the cases of a sweep found into a table and a page.
[[noreturn]] void gather_cases(const CommandLine& line);

/// Runs a scene under many settings from the same state, and tells what each costs and how wrong it is.
[[noreturn]] void study_scene(const CommandLine& line);

/// Prints the keys of a study file.
[[noreturn]] void tell_study_keys();

/// Finds the values of keys that give what was measured.
[[noreturn]] void calibrate_scenes(const CommandLine& line);

} // namespace talus
