// The merge coefficient: how far each level is simplified, and how much its error counts. See cook/clusters/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// How a level becomes the next coarser one.
struct LevelStep
{
    /// Triangles that a group keeps, as part of what it has.
    float keep = 0.5f;
    /// Factor on the error that is stored for the cut. At least 1: the stored error stays a bound.
    float error_weight = 1.0f;
};

/// Bounds of what a profile may ask for. A level that keeps more than nine triangles of ten costs ten times the
/// memory of its source with those that follow; a group's locked border is about one triangle of twenty.
inline constexpr float kSmallestKeep = 0.05f;
inline constexpr float kLargestKeep = 0.9f;
inline constexpr float kLargestErrorWeight = 1e6f;

/// Entry k is for what level k becomes; the last one repeats. Never empty.
using LevelCurve = std::vector<LevelStep>;

/// What is drawn of a mesh at a level, groups that got stuck below it included, shall have so many triangles.
struct LevelTarget
{
    uint32_t level = 1;
    uint64_t triangles = 0;
};

struct Reduction
{
    LevelCurve curve{LevelStep{}};
    /// In place of `curve`, by the material of the source. A group takes the largest `keep` and the largest
    /// `error_weight` among its materials.
    std::map<uint32_t, LevelCurve> curve_of_material{};
    /// Levels from 1 on, ascending. Up to a target's level, it decides how much is kept, and the curves only how that
    /// is spread over the groups.
    std::vector<LevelTarget> targets{};
};

/// What holds for a group of level `level` with these materials, one at least.
LevelStep stepOfGroup(const Reduction& reduction, uint32_t level, std::span<const uint32_t> materials);

} // namespace hearth::clusters
