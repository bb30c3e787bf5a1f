// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/study/settings.hpp"
#include "io/run/study_rows.hpp"
#include "scenarios/study.hpp"

#include <filesystem>
#include <string>

namespace talus
{

/// What all runs of a study have in common.
struct StudyFrame {
    std::filesystem::path scene;
    std::filesystem::path folder; ///< of the study: holds the states that runs start from
    scene::Study study;
    double start = 0.0, end = 0.0; ///< [s]; measured is from `settle` after the start on

    double measured_from() const { return start + study.settle; }
};

/// Runs the scene's own setting up to the start, and keeps the state. Returns a sentence where it fails.
std::string make_start(const StudyFrame& frame, std::int64_t seed);

/// Whether that state is there.
bool has_start(const StudyFrame& frame, std::int64_t seed);

/// Runs one setting from the state kept for a seed, on this thread: lets it settle, and measures. Whatever goes wrong
/// is the row's status.
StudyRow run_setting(const StudyFrame& frame, const Setting& setting, std::int64_t seed);

} // namespace talus
