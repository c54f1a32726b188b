// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"

#include <limits>

namespace hearth::pack
{

using namespace formats;

namespace
{

float residentError(const PackView& view, uint32_t group, std::span<const uint8_t> resident_groups)
{
    return resident_groups.empty() || resident_groups[group] != 0 ? view.groups()[group].error : 0;
}

} // namespace

std::vector<uint8_t> residentGroups(const PackView& view, std::span<const uint8_t> resident_pages)
{
    HEARTH_ASSERT(resident_pages.size() == view.pages().size());
    const auto groups = view.groups();
    std::vector<uint8_t> resident(groups.size());
    // the first group of a set collects the state of all
    for (size_t g = 0; g < groups.size(); ++g)
    {
        uint8_t& first = resident[g - groups[g].set_offset];
        const bool page = resident_pages[groups[g].page] != 0;
        first = page && (groups[g].set_offset == 0 || first != 0) ? 1 : 0;
    }
    for (size_t g = 0; g < groups.size(); ++g)
        resident[g] = resident[g - groups[g].set_offset];
    return resident;
}

bool inCut(const PackView& view, const ClusterRecord& cluster, float error_object,
           std::span<const uint8_t> resident_groups)
{
    const bool fine_enough = cluster.refined_group == kInvalidIndex ||
                             residentError(view, cluster.refined_group, resident_groups) <= error_object;
    const float coarser = residentError(view, cluster.group, resident_groups);
    // a root stays at any error: nothing replaces it
    return fine_enough && (coarser > error_object || coarser == std::numeric_limits<float>::infinity());
}

std::vector<uint32_t> selectCut(const PackView& view, uint32_t mesh, float error_object,
                                std::span<const uint8_t> resident_groups)
{
    HEARTH_ASSERT(mesh < view.meshes().size() && error_object >= 0);
    HEARTH_ASSERT(resident_groups.empty() || resident_groups.size() == view.groups().size());
    const Range clusters = view.meshes()[mesh].clusters;
    std::vector<uint32_t> cut;
    for (uint32_t i = clusters.first; i < clusters.first + clusters.count; ++i)
        if (inCut(view, view.clusters()[i], error_object, resident_groups))
            cut.push_back(i);
    return cut;
}

} // namespace hearth::pack
