// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/study/study_result.hpp"

#include <string>

namespace talus
{

/// What stands at the head of the page.
struct PageHead {
    std::string title; ///< of the scene
    std::string what;  ///< was studied: times, seeds, units
};

/// The result as a table with a line for each setting: status, costs, and each error with its spread.
std::string study_csv(const StudyResult& result);

/// The result as one HTML page that needs no network: advice, each error against cost with its front, and the table.
std::string study_page(const StudyResult& result, const PageHead& head);

} // namespace talus
