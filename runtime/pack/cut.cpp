// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"

#include <limits>

namespace hearth::pack
{

using namespace formats;

bool inCut(const PackView& view, const ClusterRecord& cluster, float error_object)
{
    const bool fine_enough =
        cluster.refined_group == kNone || view.groups()[cluster.refined_group].error <= error_object;
    const float coarser = view.groups()[cluster.group].error;
    // a root stays, whatever is asked: nothing replaces it
    return fine_enough && (coarser > error_object || coarser == std::numeric_limits<float>::infinity());
}

std::vector<uint32_t> selectCut(const PackView& view, uint32_t mesh, float error_object)
{
    HEARTH_ASSERT(mesh < view.meshes().size() && error_object >= 0);
    const Range clusters = view.meshes()[mesh].clusters;
    std::vector<uint32_t> cut;
    for (uint32_t i = clusters.first; i < clusters.first + clusters.count; ++i)
        if (inCut(view, view.clusters()[i], error_object))
            cut.push_back(i);
    return cut;
}

} // namespace hearth::pack
