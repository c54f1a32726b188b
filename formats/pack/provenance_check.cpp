// Checks the chunks about the origin of contents.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/affine3d.h"
#include "formats/pack/check_tools.h"

#include <utility>

namespace hearth::formats::check
{

namespace
{

constexpr const char* kAssetKind = "asset";

bool isInRange(Range range, uint32_t index)
{
    return index >= range.first && index - range.first < range.count;
}

/// True if `inner` lies in the asset's box, within kSphereSlack of the coordinates.
bool isInBox(const AssetRecord& asset, const Box3& inner)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const double low = double{asset.box_min[axis]}, high = double{asset.box_max[axis]};
        const double slack = kSphereSlack * std::max(std::abs(low), std::abs(high));
        if (double{inner.min[axis]} < low - slack || double{inner.max[axis]} > high + slack)
            return false;
    }
    return true;
}

/// Check that an instance of the asset draws one of its meshes, at one of its nodes. The box of a deformed
/// mesh is not checked, because its position at rest depends on its joints.
Status checkInstanceOfAsset(const PackView& view, size_t i, const InstanceRecord& instance)
{
    const AssetRecord& asset = view.assets()[i];
    if (!isInRange(asset.meshes, instance.mesh) || !isInRange(asset.nodes, instance.node))
        return makeError(view, Issue::meaning_reference, kAssetKind, i,
                         "an instance refers to mesh " + std::to_string(instance.mesh) + " or node " +
                             std::to_string(instance.node) + " of another asset");
    const MeshRecord& mesh = view.meshes()[instance.mesh];
    const bool is_deformed = mesh.skinned != 0 || mesh.morph_target_count != 0;
    if (mesh.clusters.count > 0 && !is_deformed &&
        !isInBox(asset, transformBox(widened(instance.world_from_object), {mesh.box_min, mesh.box_max})))
        return makeError(view, Issue::meaning_bounds, kAssetKind, i, "an instance sticks out of its box");
    return success();
}

constexpr const char* kAuthoredLevel = "authored level";

Status checkAuthoredLevel(const PackView& view, size_t i)
{
    const AuthoredLevelRecord& record = view.authoredLevels()[i];
    if (record.mesh >= view.meshes().size())
        return makeError(view, Issue::meaning_reference, kAuthoredLevel, i,
                         "mesh " + std::to_string(record.mesh) + " of " +
                             std::to_string(view.meshes().size()));
    const uint32_t level_count = view.meshes()[record.mesh].levels.count;
    if (record.level == 0 || record.level >= level_count)
        return makeError(view, Issue::meaning_reference, kAuthoredLevel, i,
                         "level " + std::to_string(record.level) + " of a mesh with " +
                             std::to_string(level_count));
    return success();
}

} // namespace

Status checkAssets(const PackView& view)
{
    if (view.assets().empty())
        return success();
    RangeCursor instances(view, kAssetKind, "instance", view.instances().size());
    RangeCursor meshes(view, kAssetKind, "mesh", view.meshes().size());
    RangeCursor nodes(view, kAssetKind, "node", view.nodes().size());
    for (size_t i = 0; i < view.assets().size(); ++i)
    {
        const AssetRecord& asset = view.assets()[i];
        HEARTH_TRY(instances.take(i, asset.instances));
        HEARTH_TRY(meshes.take(i, asset.meshes));
        HEARTH_TRY(nodes.take(i, asset.nodes));
        if (!isValidBox(asset.box_min, asset.box_max))
            return makeError(view, Issue::meaning_value, kAssetKind, i, "its box is not possible");
        for (const InstanceRecord& instance : recordsInRange(view.instances(), asset.instances))
            HEARTH_TRY(checkInstanceOfAsset(view, i, instance));
    }
    HEARTH_TRY(instances.finish());
    HEARTH_TRY(meshes.finish());
    return nodes.finish();
}

Status checkAuthoredLevels(const PackView& view)
{
    const std::span<const AuthoredLevelRecord> records = view.authoredLevels();
    for (size_t i = 0; i < records.size(); ++i)
    {
        HEARTH_TRY(checkAuthoredLevel(view, i));
        const auto key = [&](size_t record)
        { return std::pair(records[record].mesh, records[record].level); };
        if (i > 0 && key(i) <= key(i - 1))
            return makeError(view, Issue::meaning_order, kAuthoredLevel, i,
                             "it is not sorted by mesh and level");
    }
    return success();
}

} // namespace hearth::formats::check
