// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/study/settings.hpp"
#include "io/run/study_rows.hpp"

#include <string>
#include <vector>

namespace talus
{

/// A kind of error, and what it is told in.
struct ErrorKind {
    std::string name;
    std::string unit; ///< "1" where it is relative
    std::string meaning;
    bool of_sensor = false;
    bool advised = false; ///< worth a sentence
};

/// An error over all seeds, and its standard error.
struct ErrorValue {
    double value = 0.0;
    double spread = 0.0;
};

/// A setting as the study found it.
struct StudyPoint {
    std::string setting;
    std::string status = "done";         ///< or why it failed, for the first seed where it did
    double cpu = 0.0;                    ///< mean over the seeds and equal settings, for a simulated second [s]
    int equal_settings = 1;              ///< that came to the same bits, this one among them
    double updates = 0.0;                ///< of contacts, mean over the seeds, for a simulated second
    double memory = 0.0;                 ///< the most [B]
    std::vector<ErrorValue> errors = {}; ///< by kind; empty where it failed

    bool is_done() const { return status == "done"; }
};

struct StudyResult {
    std::vector<ErrorKind> kinds;
    std::vector<StudyPoint> points; ///< the reference first, then the default, then the others as they were asked for

    const StudyPoint& reference() const { return points[0]; }
    const StudyPoint& standard() const { return points[1]; } ///< the default: the scene as it is
};

/// Errors of all settings against the reference. What a run tells of itself (residual, overlap, energy that nothing put
/// in) is an error as it is. What it should share with the reference is compared with the reference of the same seed:
/// by the difference, for a sensor as a share of the reference's value; of the force profile it is the worst cut. Over
/// seeds the differences are averaged, so that chance cancels out; the spread is what the scatter over seeds says, or
/// the runs' own spreads where that is more.
StudyResult compare(const std::vector<Setting>& settings, const std::vector<StudyRow>& rows);

/// The settings for which no cheaper one has as small an error, from the cheapest to the dearest; by index. The
/// reference is not among them: it has no error against itself.
std::vector<std::size_t> front(const StudyResult& result, std::size_t kind);

/// What the result advises: a sentence for each kind of error, with the cheapest setting that keeps what the default
/// has; and for sensors the cheapest that is sure (95 %) to be within a per cent, one for all that it is right for.
std::vector<std::string> advice(const StudyResult& result);

} // namespace talus
