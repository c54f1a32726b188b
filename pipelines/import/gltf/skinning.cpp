// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/skinning.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

// 8-bit weights that were rounded one by one differ from a sum of 1 by up to 4 * 0.5 / 255
constexpr float kRounding = 0.01f;

/// Return the four weights of a Float4 as an array.
float* components(Float4& weights)
{
    return &weights.x;
}

} // namespace

InfluenceRepair normalizeInfluences(mesh::SourceMesh& mesh)
{
    InfluenceRepair repair = InfluenceRepair::none;
    const size_t sets = mesh.weight_sets.size();
    for (size_t vertex = 0; sets > 0 && vertex < mesh.vertexCount(); ++vertex)
    {
        float sum = 0;
        for (auto& weights : mesh.weight_sets)
            for (size_t k = 0; k < 4; ++k)
            {
                float& weight = components(weights[vertex])[k];
                if (!(weight >= 0.0f) || !std::isfinite(weight))
                {
                    weight = 0;
                    repair = InfluenceRepair::invalid;
                }
                sum += weight;
            }
        if (!(sum > 0.0f) || !std::isfinite(sum))
        {
            for (auto& weights : mesh.weight_sets)
                weights[vertex] = {};
            mesh.weight_sets[0][vertex].x = 1;
            repair = InfluenceRepair::invalid;
            sum = 1;
        }
        else if (std::abs(sum - 1.0f) > kRounding)
            repair = std::max(repair, InfluenceRepair::sum);
        for (size_t set = 0; set < sets; ++set)
            for (size_t k = 0; k < 4; ++k)
            {
                float& weight = components(mesh.weight_sets[set][vertex])[k];
                weight /= sum;
                if (weight == 0.0f)
                    mesh.joint_sets[set][vertex].joint[k] = 0;
            }
    }
    return repair;
}

std::vector<bool> usedJoints(const mesh::SourceMesh& mesh)
{
    std::vector<bool> used;
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        for (size_t vertex = 0; vertex < mesh.joint_sets[set].size(); ++vertex)
        {
            Float4 weights = mesh.weight_sets[set][vertex];
            for (size_t k = 0; k < 4; ++k)
            {
                const uint16_t joint = mesh.joint_sets[set][vertex].joint[k];
                if (components(weights)[k] == 0.0f)
                    continue;
                if (used.size() <= joint)
                    used.resize(joint + size_t{1});
                used[joint] = true;
            }
        }
    return used;
}

} // namespace hearth::import
