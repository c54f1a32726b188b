// Checks the tables of deformed meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"
#include "formats/pack/pack_check.h"

namespace hearth::formats::check
{

namespace
{

/// Return the meshes, ascending, that a node draws and that skins or morph targets deform.
std::vector<uint32_t> deformedMeshes(const PackView& view)
{
    std::vector<bool> drawn(view.meshes().size());
    for (const NodeRecord& node : view.nodes())
        if (node.mesh != kInvalidIndex)
            drawn[node.mesh] = true;
    std::vector<uint32_t> meshes;
    for (uint32_t i = 0; i < drawn.size(); ++i)
    {
        const MeshRecord& mesh = view.meshes()[i];
        if (drawn[i] && mesh.clusters.count != 0 && (mesh.skinned != 0 || mesh.morph_target_count != 0))
            meshes.push_back(i);
    }
    return meshes;
}

Status checkDeformedMesh(const PackView& view, size_t i)
{
    constexpr const char* kKind = "deformed mesh";
    const DeformedMeshRecord& record = view.deformedMeshes()[i];
    const MeshRecord& mesh = view.meshes()[record.mesh];
    const bool has_skin = record.skin != kInvalidIndex;
    if (has_skin != (mesh.skinned != 0) || !isNoneOrBelow(record.skin, view.skins().size()))
        return makeError(view, Issue::meaning_reference, kKind, i, "skin " + std::to_string(record.skin));
    const uint32_t joints = has_skin ? view.skins()[record.skin].joints.count : 1;
    if (record.anchor >= joints)
        return makeError(view, Issue::meaning_reference, kKind, i, "anchor " + std::to_string(record.anchor));
    if (record.clusters.count != mesh.clusters.count)
        return makeError(view, Issue::meaning_value, kKind, i,
                         "it has " + std::to_string(record.clusters.count) + " clusters, its mesh " +
                             std::to_string(mesh.clusters.count));
    if (!isValidBox(record.box_min, record.box_max))
        return makeError(view, Issue::meaning_value, kKind, i, "its box is empty or not finite");
    if (record.reserved != 0)
        return makeError(view, Issue::meaning_padding, kKind, i, "a reserved field is not 0");
    return success();
}

/// Check a cluster.
/// joints  joints of the skin; 0 without one
Status checkCluster(const PackView& view, size_t i, uint32_t joints)
{
    constexpr const char* kKind = "deformed cluster";
    const DeformedClusterRecord& record = view.deformedClusters()[i];
    if (record.joint >= std::max(joints, 1u))
        return makeError(view, Issue::meaning_reference, kKind, i, "joint " + std::to_string(record.joint));
    if (!isValidBox(record.box_min, record.box_max))
        return makeError(view, Issue::meaning_value, kKind, i, "its box is empty or not finite");
    if (!isNonNegative(record.cone_back))
        return makeError(view, Issue::meaning_value, kKind, i, "its cone's apex is not possible");
    if (!isNonNegative(record.morph_reach))
        return makeError(view, Issue::meaning_value, kKind, i,
                         "the reach of its morph targets is not possible");
    if (record.reserved != 0)
        return makeError(view, Issue::meaning_padding, kKind, i, "a reserved field is not 0");
    const auto moved = view.clusterJoints().subspan(record.joints.first, record.joints.count);
    if (moved.empty() != (joints == 0) || (!moved.empty() && moved.front() != record.joint))
        return makeError(view, Issue::meaning_value, kKind, i,
                         "its main bone, without a share, is not the first of its joints");
    uint32_t shares = 0, last_share = kWholeShare;
    for (const uint32_t entry : moved)
    {
        if (jointIndex(entry) >= joints)
            return makeError(view, Issue::meaning_reference, kKind, i,
                             "joint " + std::to_string(jointIndex(entry)));
        if (last_share == 0 && jointShare(entry) > 0)
            return makeError(view, Issue::meaning_order, kKind, i,
                             "a joint with a share in its frame follows one without");
        shares += jointShare(entry);
        // the main bone has the rest
        last_share = entry == moved.front() ? kWholeShare : jointShare(entry);
    }
    if (shares >= kWholeShare)
        return makeError(view, Issue::meaning_value, kKind, i,
                         "the shares of its joints leave none for the main bone");
    return success();
}

/// Check that all nodes draw a skinned mesh with the same skin.
Status checkNodeSkins(const PackView& view)
{
    std::vector<uint32_t> skin_of_mesh(view.meshes().size(), kInvalidIndex);
    for (const DeformedMeshRecord& record : view.deformedMeshes())
        skin_of_mesh[record.mesh] = record.skin;
    for (size_t i = 0; i < view.nodes().size(); ++i)
    {
        const NodeRecord& node = view.nodes()[i];
        if (node.mesh != kInvalidIndex && skin_of_mesh[node.mesh] != kInvalidIndex &&
            skin_of_mesh[node.mesh] != node.skin)
            return makeError(view, Issue::meaning_reference, "node", i,
                             "it draws mesh " + std::to_string(node.mesh) +
                                 " with another skin than bounds are for");
    }
    return success();
}

} // namespace

Status checkDeformedMeshes(const PackView& view)
{
    const std::vector<uint32_t> expected = deformedMeshes(view);
    const std::span<const DeformedMeshRecord> records = view.deformedMeshes();
    RangeCursor clusters(view, "deformed mesh", "deformed cluster", view.deformedClusters().size());
    RangeCursor joints(view, "deformed cluster", "joint of a cluster", view.clusterJoints().size());
    for (size_t i = 0; i < records.size(); ++i)
    {
        if (i >= expected.size() || records[i].mesh != expected[i])
            return makeError(view, Issue::meaning_order, "deformed mesh", i,
                             "mesh " + std::to_string(records[i].mesh) + " is not the next that is deformed");
        HEARTH_TRY(checkDeformedMesh(view, i));
        const size_t first = clusters.at();
        HEARTH_TRY(clusters.take(i, records[i].clusters));
        const uint32_t joint_count =
            records[i].skin == kInvalidIndex ? 0 : view.skins()[records[i].skin].joints.count;
        for (size_t c = first; c < clusters.at(); ++c)
        {
            HEARTH_TRY(joints.take(c, view.deformedClusters()[c].joints));
            HEARTH_TRY(checkCluster(view, c, joint_count));
        }
    }
    if (records.size() != expected.size())
        return makeError(view, Issue::meaning_reference, "mesh", expected[records.size()],
                         "it is deformed, and has no bounds");
    HEARTH_TRY(clusters.finish());
    HEARTH_TRY(joints.finish());
    return checkNodeSkins(view);
}

} // namespace hearth::formats::check
