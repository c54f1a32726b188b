// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/skins.h"

#include "pipelines/export/accessors.h"

#include <algorithm>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

bool isBelow(std::span<const NodeRecord> nodes, uint32_t node, uint32_t root)
{
    while (node != kInvalidIndex && node != root)
        node = nodes[node].parent;
    return node == root;
}

/// Append a matrix column by column, as glTF has them.
void appendMatrix(const Affine3& t, std::vector<float>& values)
{
    for (int column = 0; column < 4; ++column)
    {
        for (int row = 0; row < 3; ++row)
            values.push_back(t.m[row][column]);
        values.push_back(column == 3 ? 1.0f : 0.0f);
    }
}

} // namespace

void addSkins(GltfDocument& document, const PackView& pack)
{
    for (const SkinRecord& record : pack.skins())
    {
        Skin skin;
        skin.name = pack.text(record.name);
        std::vector<float> matrices;
        for (const JointRecord& joint : recordsInRange(pack.joints(), record.joints))
        {
            skin.joints.push_back(joint.node);
            appendMatrix(joint.joint_from_bind, matrices);
        }
        skin.inverse_bind_matrices = addFloats(document, matrices, ElementType::mat4, ViewTarget::none);
        const bool is_root =
            record.skeleton_root != kInvalidIndex &&
            std::all_of(skin.joints.begin(), skin.joints.end(),
                        [&](uint32_t joint) { return isBelow(pack.nodes(), joint, record.skeleton_root); });
        skin.skeleton = is_root ? record.skeleton_root : kInvalidIndex;
        document.skins.push_back(std::move(skin));
    }
}

} // namespace hearth::gltf_export
