// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_culling.h"

#include <bit>

namespace hearth::reference
{

using namespace formats;

namespace
{

// Records of the files have the same bytes as those of the shaders; formats/gpu_shared/records_check.h
// asserts it.
shared::Instance sharedRecord(const InstanceRecord& record)
{
    return std::bit_cast<shared::Instance>(record);
}
shared::Group sharedRecord(const GroupRecord& record)
{
    return std::bit_cast<shared::Group>(record);
}
shared::Cluster sharedRecord(const ClusterRecord& record)
{
    return std::bit_cast<shared::Cluster>(record);
}

} // namespace

std::vector<DrawnCluster> cullExhaustively(const PackView& view, const shared::FrameView& frame)
{
    const std::vector<shared::MeshBounds> bounds = shared::makeMeshBounds(view.meshes(), view.clusters());
    std::vector<DrawnCluster> drawn;
    for (uint32_t i = 0; i < view.instances().size(); ++i)
    {
        const InstanceRecord& record = view.instances()[i];
        const shared::Instance instance = sharedRecord(record);
        const shared::InstanceState state =
            shared::decideInstance(frame, instance, shared::makeInstanceInverse(record), bounds[record.mesh]);
        const Range clusters = view.meshes()[record.mesh].clusters;
        for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
        {
            const ClusterRecord& cluster = view.clusters()[c];
            const uint32_t refined =
                cluster.refined_group == kInvalidIndex ? cluster.group : cluster.refined_group;
            if (shared::decideCluster(
                    frame, instance, state, sharedRecord(cluster), sharedRecord(view.groups()[cluster.group]),
                    sharedRecord(view.groups()[refined]), isDoubleSided(view.materials(), cluster.material)))
                drawn.push_back({i, c});
        }
    }
    return drawn;
}

} // namespace hearth::reference
