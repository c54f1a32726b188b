// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/distinct_triangles.h"

#include <algorithm>
#include <array>

namespace hearth::mesh
{

std::vector<uint32_t> findDistinctTriangles(std::span<const uint32_t> indices)
{
    using Key = std::array<uint32_t, 4>; // corners in ascending order, then the triangle
    std::vector<Key> keys;
    keys.reserve(indices.size() / 3);
    for (uint32_t triangle = 0; triangle < indices.size() / 3; ++triangle)
    {
        const auto corners = indices.subspan(size_t{3} * triangle, 3);
        Key& key = keys.emplace_back(Key{corners[0], corners[1], corners[2], triangle});
        std::sort(key.begin(), key.end() - 1);
    }
    std::ranges::sort(keys);
    const auto copies = std::ranges::unique(keys, [](const Key& a, const Key& b)
                                            { return std::equal(a.begin(), a.end() - 1, b.begin()); });
    keys.erase(copies.begin(), copies.end());
    std::vector<uint32_t> triangles;
    triangles.reserve(keys.size());
    for (const Key& key : keys)
        triangles.push_back(key.back());
    std::ranges::sort(triangles);
    return triangles;
}

std::vector<uint32_t> selectTriangles(std::span<const uint32_t> indices, std::span<const uint32_t> triangles)
{
    std::vector<uint32_t> selected;
    selected.reserve(3 * triangles.size());
    for (const uint32_t triangle : triangles)
        for (const uint32_t index : indices.subspan(size_t{3} * triangle, 3))
            selected.push_back(index);
    return selected;
}

} // namespace hearth::mesh
