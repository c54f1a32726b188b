// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/deformation.h"

#include "formats/base/assert.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>
#include <cmath>

namespace hearth::mesh
{

using namespace formats;

namespace
{

constexpr size_t kSetInfluences = 4;
constexpr uint32_t kWeightCodes = 65535;

/// Merge equal joints, drop those without weight, and sort by weight, largest first. returns the number of
/// influences
size_t sortInfluences(std::span<Influence> influences)
{
    std::sort(influences.begin(), influences.end(),
              [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
    size_t count = 0;
    for (const Influence& influence : influences)
    {
        if (!(influence.weight > 0))
            continue;
        if (count > 0 && influences[count - 1].joint == influence.joint)
            influences[count - 1].weight += influence.weight;
        else
            influences[count++] = influence;
    }
    std::stable_sort(influences.begin(), influences.begin() + static_cast<ptrdiff_t>(count),
                     [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    return count;
}

double sumWeights(std::span<const Influence> influences)
{
    double sum = 0;
    for (const Influence& influence : influences)
        sum += influence.weight;
    return sum;
}

/// Choose codes that sum to kWeightCodes, each within one of its weight's share. Codes descend as weights do.
void chooseCodes(std::span<const Influence> influences, std::span<uint32_t> codes)
{
    const double scale = kWeightCodes / sumWeights(influences);
    uint32_t left = kWeightCodes;
    for (size_t i = 0; i < influences.size(); ++i)
    {
        codes[i] = std::min(left, static_cast<uint32_t>(influences[i].weight * scale));
        left -= codes[i];
    }
    // the remainder is smaller than the number of influences: the first ones get one each
    for (size_t i = 0; left > 0; i = (i + 1) % influences.size(), --left)
        ++codes[i];
}

float& part(Float4& weights, size_t i)
{
    return i == 0 ? weights.x : i == 1 ? weights.y : i == 2 ? weights.z : weights.w;
}

std::vector<Influence> influencesAt(const SourceMesh& mesh, size_t vertex)
{
    std::vector<Influence> influences;
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        Float4 weights = mesh.weight_sets[set][vertex];
        for (size_t i = 0; i < kSetInfluences; ++i)
            influences.push_back({mesh.joint_sets[set][vertex].joint[i], double{part(weights, i)}});
    }
    return influences;
}

/// Return the number of influence sets: one if four influences suffice for all vertices, else enough for
/// `most`.
size_t countNeededSets(const SourceMesh& mesh, uint32_t most)
{
    const size_t sets = std::min<size_t>(mesh.joint_sets.size(), most / kSetInfluences);
    for (size_t v = 0; v < mesh.vertexCount() && sets > 1; ++v)
    {
        std::vector<Influence> influences = influencesAt(mesh, v);
        if (sortInfluences(influences) > kSetInfluences)
            return sets;
    }
    return std::min<size_t>(sets, 1);
}

} // namespace

float setInfluences(SourceMesh& mesh, size_t vertex, std::span<Influence> influences)
{
    const size_t most = mesh.joint_sets.size() * kSetInfluences;
    const auto all = influences.first(sortInfluences(influences));
    HEARTH_ASSERT(!all.empty());
    const auto kept = all.first(std::min(all.size(), most));
    const double loss = sumWeights(all.subspan(kept.size())) / sumWeights(all);
    std::array<uint32_t, 2 * kSetInfluences> codes{};
    chooseCodes(kept, codes);
    for (size_t i = 0; i < most; ++i)
    {
        mesh.joint_sets[i / kSetInfluences][vertex].joint[i % kSetInfluences] =
            codes[i] > 0 ? kept[i].joint : uint16_t{0};
        part(mesh.weight_sets[i / kSetInfluences][vertex], i % kSetInfluences) =
            static_cast<float>(codes[i]) / static_cast<float>(kWeightCodes);
    }
    return static_cast<float>(loss);
}

InfluenceLoss reduceInfluences(SourceMesh& mesh, uint32_t most)
{
    HEARTH_ASSERT(most == 4 || most == 8);
    InfluenceLoss loss;
    if (mesh.joint_sets.empty())
        return loss;
    SourceMesh reduced;
    const size_t sets = countNeededSets(mesh, most);
    reduced.joint_sets.assign(sets, std::vector<Joints4>(mesh.vertexCount()));
    reduced.weight_sets.assign(sets, std::vector<Float4>(mesh.vertexCount()));
    double sum = 0;
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
    {
        std::vector<Influence> influences = influencesAt(mesh, v);
        const float lost = setInfluences(reduced, v, influences);
        loss.max_weight = std::max(loss.max_weight, lost);
        loss.vertex_count += lost > 0 ? 1 : 0;
        sum += double{lost};
    }
    loss.mean_weight =
        mesh.vertexCount() > 0 ? static_cast<float>(sum / static_cast<double>(mesh.vertexCount())) : 0.0f;
    mesh.joint_sets = std::move(reduced.joint_sets);
    mesh.weight_sets = std::move(reduced.weight_sets);
    return loss;
}

namespace
{

/// Compute the smallest power of two whose multiples by codes reach all deltas.
float morphStep(std::span<const Float3> deltas)
{
    float most = 0;
    for (const Float3 delta : deltas)
        most = std::max({most, std::abs(delta.x), std::abs(delta.y), std::abs(delta.z)});
    int exponent;
    static_cast<void>(std::frexp(most, &exponent));
    // most < 2^exponent; codes reach 2^19 - 1, which rounding may pass by one
    return std::ldexp(1.0f, std::max(exponent, -100) - 18);
}

} // namespace

Float3 snapMorphPosition(Float3 delta, float step)
{
    const auto snapped = [&](float d) { return std::nearbyint(d / step) * step + 0.0f; };
    return {snapped(delta.x), snapped(delta.y), snapped(delta.z)};
}

Float3 snapMorphNormal(Float3 delta)
{
    const auto snapped = [](float d) {
        return std::clamp(std::nearbyint(d * kMorphNormalSteps), -2047.0f, 2047.0f) / kMorphNormalSteps +
               0.0f;
    };
    return {snapped(delta.x), snapped(delta.y), snapped(delta.z)};
}

std::vector<float> snapMorphTargets(SourceMesh& mesh)
{
    std::vector<float> steps;
    for (MorphTarget& target : mesh.morph_targets)
    {
        target.positions.resize(mesh.vertexCount());
        target.normals.resize(mesh.normals.empty() ? 0 : mesh.vertexCount());
        target.tangents.clear();
        steps.push_back(morphStep(target.positions));
        for (Float3& delta : target.positions)
            delta = snapMorphPosition(delta, steps.back());
        for (Float3& delta : target.normals)
            delta = snapMorphNormal(delta);
    }
    return steps;
}

} // namespace hearth::mesh
