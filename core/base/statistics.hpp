// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

namespace talus
{

/// Least-squares straight line through points that are added one by one.
class LineFit
{
public:
    void add(double x, double y)
    {
        ++count_;
        const double dx = x - mean_x_;
        mean_x_ += dx / static_cast<double>(count_);
        mean_y_ += (y - mean_y_) / static_cast<double>(count_);
        xx_ += dx * (x - mean_x_);
        xy_ += dx * (y - mean_y_);
    }

    std::size_t count() const { return count_; }

    /// dy/dx; not a number with fewer than two different x.
    double slope() const { return xx_ > 0.0 ? xy_ / xx_ : std::numeric_limits<double>::quiet_NaN(); }

    /// How steeply the line falls [degree].
    double fall_angle() const;

private:
    std::size_t count_ = 0;
    double mean_x_ = 0.0, mean_y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

/// Mean and standard error of numbers that are added one by one; what is not a number is left out.
class MeanAndError
{
public:
    void add(double x);
    std::size_t count() const { return count_; }
    double mean() const { return count_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(); }

    /// Standard deviation / √count; not a number with fewer than two values.
    double standard_error() const;

private:
    std::size_t count_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
};

} // namespace talus
