// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_surroundings.h"

#include "formats/gpu_shared/record_values.h"

#include <algorithm>
#include <cstring>

namespace hearth::gpu
{

namespace
{

SceneSurroundings::Row packRow(const formats::SurroundingsRecord& record)
{
    const auto pack = [&](uint32_t i)
    { return uint32_t{record.visibility[i]} | uint32_t{record.visibility[i + 1]} << 16; };
    return {record.transfer, pack(0), pack(2), 0};
}

} // namespace

SceneSurroundings::SceneSurroundings(const formats::PackView& pack, shared::SceneLighting lighting)
    : transfers_(pack.radianceTransfers().begin(), pack.radianceTransfers().end()),
      lighting_(std::move(lighting))
{
    std::ranges::transform(pack.surroundings(), std::back_inserter(instances_), packRow);
}

uint64_t SceneSurroundings::countRows(const formats::PackView& pack)
{
    return countTransferRows(pack) + pack.surroundings().size();
}

uint64_t SceneSurroundings::countTransferRows(const formats::PackView& pack)
{
    return pack.radianceTransfers().size() * shared::kOccluderLightRows;
}

std::vector<shared::OccluderLight> SceneSurroundings::makeOccluderLights() const
{
    const shared::LightHarmonics harmonics = shared::projectDistantLight(lighting_.sky, lighting_.lights);
    std::vector<shared::OccluderLight> lights;
    lights.reserve(transfers_.size());
    for (const formats::RadianceTransferRecord& transfer : transfers_)
        lights.push_back(shared::transferLight(transfer, harmonics));
    return lights;
}

std::vector<SceneSurroundings::Row> SceneSurroundings::makeRows() const
{
    const std::vector<shared::OccluderLight> lights = makeOccluderLights();
    std::vector<Row> rows(lights.size() * shared::kOccluderLightRows);
    if (!lights.empty())
        std::memcpy(rows.data(), lights.data(), lights.size() * sizeof(lights[0]));
    rows.insert(rows.end(), instances_.begin(), instances_.end());
    return rows;
}

void SceneSurroundings::change(uint32_t slot, const shared::Light& record)
{
    if (slot >= lighting_.lights.size())
        lighting_.lights.resize(slot + 1);
    changed_ = changed_ || record.type == shared::kLightDirectional ||
               lighting_.lights[slot].type == shared::kLightDirectional;
    lighting_.lights[slot] = record;
}

void SceneSurroundings::changeSky(const shared::Sky& sky)
{
    lighting_.sky = sky;
    changed_ = true;
}

void SceneSurroundings::update(MirroredTable& lighting, VkDeviceSize offset)
{
    if (!changed_)
        return;
    changed_ = false;
    const std::vector<shared::OccluderLight> lights = makeOccluderLights();
    lighting.write(offset, std::as_bytes(std::span(lights)));
}

} // namespace hearth::gpu
