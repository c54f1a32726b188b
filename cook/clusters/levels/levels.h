// Builds the levels of a hierarchy; holds them while they are built.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/group_errors.h"
#include "cook/clusters/levels/authored_lods.h"
#include "cook/clusters/levels/reduce.h"
#include "cook/clusters/partition/grouping.h"
#include "formats/base/assert.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Group of a level under construction.
struct LevelGroup
{
    Sphere sphere;
    GroupErrors errors;
    ClusterStore clusters; ///< replacement of the group, until the next level takes it
    bool stuck = false;
    bool retried = false;
    uint32_t set_offset = 0; ///< formats::GroupRecord::set_offset
    GroupReduction outcome;  ///< for the counters

    bool isRoot() const { return std::isinf(errors.lod); }
};

/// Level of the hierarchy under construction.
struct Level
{
    ClusterStore store;
    /// Group that each cluster was made from, or kInvalid.
    IdVector<ClusterId, GroupId> refined_group;
    IdVector<ClusterId, uint8_t> retries; ///< number of times that each cluster was passed on unchanged
    Groups groups;
    GroupId first_group{};
    uint64_t drawn_below = 0; ///< triangles of the roots of finer levels
    std::vector<LevelGroup> built;

    /// Return the id of group `g` of the level.
    GroupId groupId(size_t g) const { return toId<GroupId>(toIndex(first_group) + g); }

    /// Return the id of the next level's first group.
    GroupId endGroup() const { return groupId(groups.count()); }
};

/// Levels so far, and lookups by group.
struct Build
{
    PreparedMesh mesh;
    const Config& config;
    std::vector<Level> levels;
    std::span<const AuthoredLod> authored;   ///< authored LODs that are still to come
    std::vector<uint32_t> level_of_authored; ///< level of each authored mesh; kInvalidIndex: not used

    const LevelGroup& group(GroupId id) const
    {
        const auto after =
            std::upper_bound(levels.begin(), levels.end(), id,
                             [](GroupId group, const Level& level) { return group < level.first_group; });
        HEARTH_ASSERT(after != levels.begin());
        const Level& level = *(after - 1);
        const size_t g = toIndex(id) - toIndex(level.first_group);
        HEARTH_ASSERT(g < level.built.size());
        return level.built[g];
    }
};

/// Group, simplify and split level after level until nothing can be simplified further.
void buildLevels(Build& build);

} // namespace hearth::clusters
