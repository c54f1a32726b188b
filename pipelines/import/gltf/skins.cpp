// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/skins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hearth::import
{

using namespace formats;

namespace
{

Result<InverseBinds> readInverseBinds(const GltfSkin& skin, GltfAccessors& accessors)
{
    InverseBinds matrices(skin.joints.size());
    const uint32_t index = skin.inverse_bind_matrices;
    if (index == kInvalidIndex)
        return matrices;
    const GltfAccessor& accessor = accessors.accessor(index);
    if (accessor.type != ElementType::mat4 || accessor.component != ComponentType::f32)
        return accessors.error(index, Issue::gltf_value,
                               fmt::format("inverse bind matrices cannot be a {}", formatName(accessor)));
    if (accessor.count < skin.joints.size())
        return accessors.error(index, Issue::gltf_data,
                               fmt::format("{} matrices for {} joints", accessor.count, skin.joints.size()));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> values, accessors.floats(index));
    for (size_t joint = 0; joint < matrices.size(); ++joint)
    {
        const std::span<const float, 16> columns(values.data() + joint * 16, 16);
        if (!std::all_of(columns.begin(), columns.end(), [](float v) { return std::isfinite(v); }))
            return accessors.error(index, Issue::gltf_data, fmt::format("matrix {} is not finite", joint));
        matrices[joint] = transformFromColumns(columns);
    }
    return matrices;
}

} // namespace

Result<std::vector<InverseBinds>> writeSkins(const GltfModel& model, GltfAccessors& accessors,
                                             const GltfContext& context)
{
    std::vector<InverseBinds> all;
    std::set<uint32_t> joint_nodes;
    for (const GltfSkin& skin : model.skins)
    {
        HEARTH_ASSIGN_OR_RETURN(InverseBinds matrices, readInverseBinds(skin, accessors));
        SkinRecord record{};
        record.name = context.part.intern(skin.name);
        record.skeleton_root = skin.skeleton;
        record.joints = {static_cast<uint32_t>(context.part.joints.size()),
                         static_cast<uint32_t>(skin.joints.size())};
        context.part.skins.push_back(record);
        for (size_t joint = 0; joint < matrices.size(); ++joint)
        {
            JointRecord joint_record{};
            joint_record.node = skin.joints[joint];
            joint_record.joint_from_bind = narrowed(matrices[joint]).value_or(Affine3{});
            context.part.joints.push_back(joint_record);
        }
        joint_nodes.insert(skin.joints.begin(), skin.joints.end());
        all.push_back(std::move(matrices));
    }
    context.part.counts.joints = joint_nodes.size();
    return all;
}

} // namespace hearth::import
