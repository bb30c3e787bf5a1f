// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <vector>

namespace talus::multibody
{

/// Small dense matrices of any sizes, one behind the other in memory.
class BlockStore
{
public:
    using View = Eigen::Map<const Eigen::MatrixXd>;

    /// Appends a block; its number is size() − 1.
    void add(const Eigen::Ref<const Eigen::MatrixXd>& block)
    {
        places_.push_back({values_.size(), block.rows(), block.cols()});
        for (Eigen::Index j = 0; j < block.cols(); ++j)
            for (Eigen::Index i = 0; i < block.rows(); ++i) values_.push_back(block(i, j));
    }

    std::size_t size() const { return places_.size(); }

    View operator[](std::size_t k) const
    {
        const Place& place = places_[k];
        return View(values_.data() + place.first, place.rows, place.cols);
    }

private:
    struct Place {
        std::size_t first;
        Eigen::Index rows, cols;
    };
    std::vector<Place> places_;
    std::vector<double> values_;
};

} // namespace talus::multibody
