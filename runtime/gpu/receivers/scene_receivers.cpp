// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/scene_receivers.h"

#include "formats/base/half.h"
#include "formats/base/index.h"
#include "formats/gpu_shared/record_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hearth::gpu
{

namespace
{

void setEmission(Float3 weight, shared::ReceiverRow& row)
{
    const auto half = [](float value) -> uint32_t { return halfFromFloat(std::min(value, kHalfMax)); };
    row.emission_red_green = half(weight.x) | half(weight.y) << 16;
    row.emission_blue = half(weight.z);
}

/// True if two lights differ by their intensity alone.
bool isInPlace(const shared::Light& light, const shared::Light& loaded)
{
    return light.type == loaded.type && light.position == loaded.position &&
           light.direction == loaded.direction && light.range == loaded.range &&
           light.cone_scale == loaded.cone_scale && light.cone_offset == loaded.cone_offset;
}

/// Return the weight that makes a baked intensity another one. A channel that was baked dark stays dark.
float intensityRatio(float intensity, float baked)
{
    return baked > 0 ? std::clamp(intensity / baked, 0.0f, kHalfMax) : 0.0f;
}

/// Return the irradiance of level ground under the gradient of a sky, over 2 pi.
Float3 levelIrradiance(const shared::Sky& sky)
{
    constexpr int kSteps = 64;
    Float3 sum;
    for (int i = 0; i < kSteps; ++i)
    {
        const float height = (static_cast<float>(i) + 0.5f) / kSteps;
        sum += shared::skyRadiance(sky, {std::sqrt(1 - height * height), height, 0}) * (height / kSteps);
    }
    return sum;
}

} // namespace

SceneReceivers::SceneReceivers(const formats::PackView& pack, std::span<const shared::Light> lights,
                               const shared::LocalProbes& probes)
    : has_faces_(!pack.faceAtlases().empty()),
      probe_weights_(pack, probes),
      lamps_of_lights_(lights.size(), kInvalidIndex),
      lamps_of_instances_(pack.instances().size(), kInvalidIndex),
      loaded_(lights.begin(), lights.end()),
      rows_(pack.instances().size()),
      sizes_(pack.instances().size()),
      schedule_(pack.receivers().lamps.size())
{
    const formats::ReceiverTables tables = pack.receivers();
    for (uint32_t lamp = 0; lamp < tables.lamps.size(); ++lamp)
    {
        const formats::ReceiverLampRecord& record = tables.lamps[lamp];
        const auto kind = static_cast<formats::ReceiverLampKind>(record.kind);
        // lights beyond the most that are drawn keep their baked light
        if (kind == formats::ReceiverLampKind::light && record.index < lamps_of_lights_.size())
            lamps_of_lights_[record.index] = lamp;
        else if (kind == formats::ReceiverLampKind::mesh_light)
            lamps_of_instances_[record.index] = lamp;
        else if (kind == formats::ReceiverLampKind::steady)
            steady_lamp_ = lamp;
    }
    for (shared::ReceiverRow& row : rows_)
        setEmission({1, 1, 1}, row);
    for (const formats::ReceiverRectRecord& rect : tables.rects)
    {
        shared::ReceiverRow& row = rows_[rect.instance];
        row.place = shared::encodeReceiverPlace(rect.x, rect.y) | rect.uv_set << shared::kReceiverUvSetShift;
        row.size = rect.width | rect.height << 16;
        sizes_[rect.instance] = row.size;
    }
    for (uint32_t groups = 0; groups < costs_.size(); ++groups)
    {
        costs_[groups] = pack::countUpdate(tables, groups);
        face_costs_[groups] = pack::countUpdate(pack.faceReceivers(), groups);
    }
}

void SceneReceivers::setLive(uint32_t slot, bool is_live)
{
    if (slot >= is_live_.size())
        is_live_.resize(slot + 1);
    if (is_live && !is_live_[slot])
        ++live_count_;
    else if (!is_live && is_live_[slot])
        --live_count_;
    is_live_[slot] = is_live;
}

uint32_t SceneReceivers::takeLight(uint32_t slot, const shared::Light& light)
{
    setLive(slot, light.intensity != Float3{});
    if (slot >= lamps_of_lights_.size() || lamps_of_lights_[slot] == kInvalidIndex)
        return 0;
    const shared::Light& loaded = loaded_[slot];
    const bool is_in_place = isInPlace(light, loaded);
    Float3 weight{};
    for (int c = 0; c < 3 && is_in_place; ++c)
        weight[c] = intensityRatio(light.intensity[c], loaded.intensity[c]);
    schedule_.setWeight(lamps_of_lights_[slot], weight);
    if (!is_in_place)
        return 0;
    if (has_faces_)
        setLive(slot, false);
    return (has_faces_ ? shared::kLightOnFaces : 0u) |
           (light.type != shared::kLightDirectional ? shared::kLightBaked : 0u);
}

void SceneReceivers::takeSky(const shared::Sky& sky, const shared::Sky& baked)
{
    if (steady_lamp_ == kInvalidIndex)
        return;
    const Float3 now = levelIrradiance(sky), then = levelIrradiance(baked);
    Float3 weight;
    for (int c = 0; c < 3; ++c)
        weight[c] = intensityRatio(now[c], then[c]);
    schedule_.setWeight(steady_lamp_, weight);
}

const shared::ReceiverRow& SceneReceivers::weighEmission(uint32_t instance, Float3 weight)
{
    if (const uint32_t lamp = lamps_of_instances_[instance]; lamp != kInvalidIndex)
        schedule_.setWeight(lamp, weight);
    setEmission(weight, rows_[instance]);
    return rows_[instance];
}

const shared::ReceiverRow& SceneReceivers::takeMove(uint32_t instance, bool is_at_rest)
{
    rows_[instance].size = is_at_rest ? sizes_[instance] : 0;
    return rows_[instance];
}

uint32_t SceneReceivers::beginUpdate(bool shows_drops)
{
    updated_groups_ = schedule_.nextGroups();
    late_face_groups_ |= has_faces_ ? updated_groups_ : 0;
    if (std::exchange(shows_drops_, shows_drops) != shows_drops)
        updated_groups_ = (1u << shared::kReceiverGroups) - 1;
    updated_face_groups_ = 0;
    return updated_groups_;
}

uint32_t SceneReceivers::beginFaceUpdate()
{
    updated_face_groups_ = std::exchange(late_face_groups_, 0);
    return updated_face_groups_;
}

} // namespace hearth::gpu
