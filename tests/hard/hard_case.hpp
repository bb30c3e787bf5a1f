// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <string>
#include <vector>

namespace talus::test
{

/// One of the hard cases: what is asked of it and what came out, each as a check of the test and as a row of the table
/// that `tests/run hard` makes.
///
///     TEST_CASE("2 a column of 100 spheres", "[hard]")
///     {
///         HardCase hard("2 a column of 100 spheres");
///         …
///         hard.below("drift of the top over 1e5 steps [d]", drift, 0.1);
///     }
class HardCase
{
public:
    /// @param name begins with the number of the case
    explicit HardCase(std::string name);
    HardCase(const HardCase&) = delete;
    HardCase& operator=(const HardCase&) = delete;
    /// Writes the rows to the folder named by TALUS_HARD_RESULTS, if it is set.
    ~HardCase();

    // Each is one row. `what` has its unit in brackets.
    void below(const std::string& what, double measured, double limit);
    void should_be_below(const std::string& what, double measured, double limit); ///< it fails as a row, not as a test
    void above(const std::string& what, double measured, double limit);
    void between(const std::string& what, double measured, double least, double most);
    void holds(const std::string& what, bool held);
    void tell(const std::string& what, double measured);           ///< a figure of which nothing is asked
    void tell(const std::string& what, const std::string& answer); ///< words of which nothing is asked

private:
    struct Row {
        std::string criterion, measured, verdict;
    };

    std::string name_;
    std::vector<Row> rows_;
    std::clock_t began_ = std::clock();
    int exceptions_;

    void add(const std::string& criterion, const std::string& measured, bool passed);
};

} // namespace talus::test
