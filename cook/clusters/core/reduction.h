// Simplification settings of each level (the merge coefficient): target size and error weight. See
// cook/clusters/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Settings for the step from a level to the next coarser one.
struct LevelStep
{
    /// Part of its triangles that a group keeps.
    float keep = 0.5f;
    /// Factor on the error that is stored for the cut. At least 1: the stored error stays a bound.
    float error_weight = 1.0f;
};

/// Limits of the settings of a profile. A level that keeps more than nine triangles of ten costs, with the
/// levels that follow, ten times the memory of its source. A group's locked border is about one triangle of
/// twenty.
inline constexpr float kMinKeep = 0.05f;
inline constexpr float kMaxKeep = 0.9f;
inline constexpr float kMaxErrorWeight = 1e6f;

/// Entry k is the step from level k to level k + 1; the last one repeats. Never empty.
using LevelCurve = std::vector<LevelStep>;

/// Triangles to draw of a mesh at a level, including groups that got stuck on finer levels.
struct LevelTarget
{
    uint32_t level = 1;
    uint64_t triangles = 0;
};

/// Simplification settings of a mesh.
struct Reduction
{
    LevelCurve curve{LevelStep{}};
    /// Curves by the source's material, in place of `curve`. A group takes the largest `keep` and the largest
    /// `error_weight` among its materials.
    std::map<uint32_t, LevelCurve> curve_of_material{};
    /// Targets, with levels from 1 on, ascending. Up to a target's level the target decides the number of
    /// triangles, and the curves only their distribution over the groups.
    std::vector<LevelTarget> targets{};
};

/// Return the step for a group of level `level` with these materials, at least one.
LevelStep findGroupStep(const Reduction& reduction, uint32_t level, std::span<const uint32_t> materials);

} // namespace hearth::clusters
