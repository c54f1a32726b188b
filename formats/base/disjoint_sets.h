// Disjoint sets (union-find).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hearth
{

/// Disjoint sets over [0, count): union by smaller index, path halving. The element that find() returns
/// is the smallest of its set.
class DisjointSets
{
public:
    explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    uint32_t find(uint32_t element)
    {
        HEARTH_RUNTIME_ASSERT(element < parent_.size());
        while (parent_[element] != element)
        {
            parent_[element] = parent_[parent_[element]];
            element = parent_[element];
        }
        return element;
    }

    void unite(uint32_t a, uint32_t b)
    {
        a = find(a);
        b = find(b);
        if (a != b)
            parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parent_;
};

} // namespace hearth
