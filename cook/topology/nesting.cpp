// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/nesting.h"

#include "cook/topology/box_tree.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <tbb/parallel_for.h>

namespace hearth::topology
{

namespace
{

/// Directions without a regular relation to the axes, along which models have their edges. The next one
/// is tried where a ray passes an edge.
constexpr std::array<Double3, 4> kDirections{{{0.8012, 0.3917, 0.4523},
                                              {-0.2971, 0.9123, -0.2819},
                                              {0.1153, -0.3391, 0.9337},
                                              {-0.5821, -0.5437, -0.6047}}};

/// Share of a triangle within which a hit of its border is doubtful, in doubles far above rounding.
constexpr double kDoubtful = 1e-9;

enum class Hit : uint8_t
{
    none,
    clear,
    doubtful,
};

Hit hitTriangle(Double3 origin, Double3 direction, const std::array<Double3, 3>& triangle)
{
    // T. Möller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997
    const Double3 side_b = triangle[1] - triangle[0], side_c = triangle[2] - triangle[0];
    const Double3 p = cross(direction, side_c);
    const double determinant = dot(side_b, p);
    const double scale = length(side_b) * length(side_c) * length(direction);
    if (std::abs(determinant) <= kDoubtful * scale)
        return Hit::doubtful; // seen edge on; such a triangle may yet be missed by far
    const Double3 offset = origin - triangle[0];
    const double u = dot(offset, p) / determinant;
    const Double3 q = cross(offset, side_b);
    const double v = dot(direction, q) / determinant;
    const double distance = dot(side_c, q) / determinant;
    const double least = std::min({u, v, 1 - u - v});
    const double size = std::max(length(side_b), length(side_c));
    if (least < -kDoubtful || distance * length(direction) < -kDoubtful * size)
        return Hit::none;
    return least > kDoubtful && distance * length(direction) > kDoubtful * size ? Hit::clear : Hit::doubtful;
}

/// True if a ray meets the box.
bool hitsBox(Double3 origin, Double3 direction, const Box3& box)
{
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    const auto clip = [&](double from, double along, double min, double max)
    {
        const double a = (min - from) / along, b = (max - from) / along;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    };
    clip(origin.x, direction.x, double{box.min.x}, double{box.max.x});
    clip(origin.y, direction.y, double{box.min.y}, double{box.max.y});
    clip(origin.z, direction.z, double{box.min.z}, double{box.max.z});
    return enter <= leave * (1 + kDoubtful);
}

bool containsBox(const Box3& outer, const Box3& inner)
{
    return min(outer.min, inner.min) == outer.min && max(outer.max, inner.max) == outer.max;
}

/// Triangles of the closed shells that have a volume.
class Solids
{
public:
    Solids(const Surface& surface, const Shells& shells) : surface_(surface), shells_(shells)
    {
        for (uint32_t t = 0; t < surface.triangleCount(); ++t)
            if (const ShellSide side = shells.shells[shells.shell_of_triangle[t]].side;
                side == ShellSide::outward || side == ShellSide::flipped)
                triangles_.push_back(t);
        std::vector<Box3> boxes(triangles_.size());
        for (size_t i = 0; i < triangles_.size(); ++i)
            for (const Double3 corner : findCorners(triangles_[i]))
                boxes[i].add(narrow(corner));
        tree_ = std::make_unique<BoxTree>(boxes);
    }

    /// Return how many solids are around a shell: those that contain some of its triangles, where rays
    /// tell.
    int countAround(uint32_t shell, std::span<const uint32_t> samples) const
    {
        std::optional<std::vector<uint32_t>> around;
        for (const uint32_t triangle : samples)
        {
            const std::optional<std::vector<uint32_t>> of_sample = findAround(shell, triangle);
            if (!of_sample)
                continue;
            if (!around)
            {
                around = of_sample;
                continue;
            }
            std::vector<uint32_t> both;
            std::set_intersection(around->begin(), around->end(), of_sample->begin(), of_sample->end(),
                                  std::back_inserter(both));
            around = both;
        }
        int count = 0;
        if (around)
            for (const uint32_t other : *around)
                count += shells_.shells[other].volume > 0 ? 1 : -1;
        return count;
    }

private:
    std::array<Double3, 3> findCorners(uint32_t triangle) const
    {
        const uint32_t* const corners = &surface_.corners[size_t{3} * triangle];
        return {widen(surface_.positions[corners[0]]), widen(surface_.positions[corners[1]]),
                widen(surface_.positions[corners[2]])};
    }

    /// Return the shells whose boxes contain the whole shell and which contain the middle of one of its
    /// triangles, ascending; nullopt if no ray from there is clear.
    std::optional<std::vector<uint32_t>> findAround(uint32_t shell, uint32_t triangle) const
    {
        const std::array<Double3, 3> corners = findCorners(triangle);
        const Double3 origin = (corners[0] + corners[1] + corners[2]) * (1.0 / 3);
        for (const Double3 direction : kDirections)
        {
            bool is_clear = true;
            std::vector<uint32_t> hits; // the shell of each hit
            tree_->visit([&](const Box3& box) { return is_clear && hitsBox(origin, direction, box); },
                         [&](uint32_t i)
                         {
                             const uint32_t other = shells_.shell_of_triangle[triangles_[i]];
                             if (other == shell ||
                                 !containsBox(shells_.shells[other].box, shells_.shells[shell].box))
                                 return;
                             const std::array<Double3, 3> others = findCorners(triangles_[i]);
                             Box3 box;
                             for (const Double3 corner : others)
                                 box.add(narrow(corner));
                             if (!hitsBox(origin, direction, box))
                                 return;
                             const Hit hit = hitTriangle(origin, direction, others);
                             is_clear &= hit != Hit::doubtful;
                             if (hit == Hit::clear)
                                 hits.push_back(other);
                         });
            if (!is_clear)
                continue;
            std::sort(hits.begin(), hits.end());
            std::vector<uint32_t> around;
            for (auto hit = hits.begin(); hit != hits.end();)
            {
                const auto end = std::upper_bound(hit, hits.end(), *hit);
                if ((end - hit) % 2 == 1)
                    around.push_back(*hit);
                hit = end;
            }
            return around;
        }
        return std::nullopt;
    }

    const Surface& surface_;
    const Shells& shells_;
    std::vector<uint32_t> triangles_;
    std::unique_ptr<BoxTree> tree_;
};

} // namespace

void judgeInwardShells(const Surface& surface, Shells& shells)
{
    // A shell lies within another only as a whole. Three triangles of it tell it from one that reaches
    // in.
    constexpr size_t kSamples = 3;
    std::vector<uint32_t> inward;
    for (uint32_t s = 0; s < shells.shells.size(); ++s)
        if (shells.shells[s].side == ShellSide::flipped)
            inward.push_back(s);
    if (inward.empty())
        return;
    std::vector<std::array<uint32_t, kSamples>> samples(shells.shells.size());
    std::vector<uint32_t> seen(shells.shells.size(), 0);
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
    {
        const uint32_t s = shells.shell_of_triangle[t];
        const uint32_t last = shells.shells[s].triangles - 1;
        for (uint32_t i = 0; i < kSamples; ++i)
            if (seen[s] == last * i / (kSamples - 1))
                samples[s][i] = t;
        ++seen[s];
    }
    const Solids solids(surface, shells);
    std::vector<int> around(inward.size());
    tbb::parallel_for(size_t{0}, inward.size(),
                      [&](size_t i) { around[i] = solids.countAround(inward[i], samples[inward[i]]); });
    for (size_t i = 0; i < inward.size(); ++i)
        if (around[i] > 0)
            shells.shells[inward[i]].side = ShellSide::cavity;
}

} // namespace hearth::topology
