// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/lights/scene_lights.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/occluder_light.h"
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/shadow.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace hearth::gpu
{

namespace
{

constexpr VkDeviceSize kRowBytes = 16;

/// Room for indices: 256 for each light, twice what a light of the sample `market` takes (1024 lights), up
/// to 128 Ki indices.
uint32_t indexWords(uint32_t capacity)
{
    return std::min(capacity * 256u, 128u * 1024u) / 2;
}

/// Return the number of a frame's lists; of slots, the room for their words.
uint32_t countLists(const shared::LightGridLayout& grid, LightAreas areas)
{
    switch (areas)
    {
    case LightAreas::tiles:
        return grid.tiles.columns * grid.tiles.rows;
    case LightAreas::slots:
        return shared::kMaxLightCells;
    default:
        return grid.grid.cell_count;
    }
}

/// Write the rows of a sky's image.
void writeSkyImage(const shared::SkyImage& image, std::span<std::byte> rows)
{
    std::memcpy(rows.data(), image.texels.data(), sizeof image.texels);
    for (size_t i = 0; i < image.harmonics.size(); ++i)
        std::memcpy(rows.data() + sizeof image.texels + i * kRowBytes, &image.harmonics[i], sizeof(Float3));
    const uint32_t behind[] = {shared::floatBits(image.factor), image.sharp_mips};
    for (size_t i = 0; i < std::size(behind); ++i)
        std::memcpy(rows.data() + sizeof image.texels + i * kRowBytes + sizeof(Float3), &behind[i],
                    sizeof behind[i]);
}

} // namespace

LightBufferLayout LightBufferLayout::make(uint32_t capacity, const shared::SceneLighting& lighting,
                                          uint64_t surroundings_rows, uint64_t receiver_rows)
{
    LightBufferLayout layout{.capacity = capacity, .index_words = indexWords(capacity)};
    layout.sky_image = layout.light(capacity);
    layout.local_probes =
        layout.sky_image + (lighting.sky.image != nullptr ? shared::kSkyImageRows : 0) * kRowBytes;
    layout.surroundings =
        layout.local_probes + lighting.local_probes.tables.size() * shared::kLocalProbeRows * kRowBytes;
    layout.receivers = layout.surroundings + surroundings_rows * kRowBytes;
    layout.lists = layout.receivers + receiver_rows * kRowBytes;
    layout.cells = layout.lists + sizeof(shared::LightListCounts) + VkDeviceSize{capacity} * sizeof(uint32_t);
    layout.indices = layout.cells + VkDeviceSize{shared::kMaxLightCells} * sizeof(uint32_t);
    layout.in_view = layout.indices + VkDeviceSize{layout.index_words} * sizeof(uint32_t);
    layout.in_view = (layout.in_view + sizeof(shared::CellLight) - 1) & ~(sizeof(shared::CellLight) - 1);
    layout.end = layout.in_view + VkDeviceSize{capacity} * sizeof(shared::CellLight);
    return layout;
}

SceneLights::SceneLights(const LightBufferLayout& layout, shared::SceneLighting lighting)
    : layout_(layout), lighting_(std::move(lighting)), loaded_(lighting_.lights), loaded_sky_(lighting_.sky)
{
    HEARTH_ASSERT(lighting_.lights.size() <= layout_.capacity);
    for (const shared::Light& light : loaded_)
        slots_.push_back(
            {.intensity = light.intensity, .steady_luminance = shared::luminance(light.intensity)});
    setSky(lighting_.sky);
    head_.sky_image_row = lighting_.sky.image == nullptr
                              ? shared::kNoSkyImage
                              : static_cast<uint32_t>(layout_.sky_image / kRowBytes);
    head_.local_probe_row = static_cast<uint32_t>(layout_.local_probes / kRowBytes);
    head_.local_probe_count = static_cast<uint32_t>(lighting_.local_probes.tables.size());
    head_.local_probe_side = lighting_.local_probes.side;
    head_.local_probe_mips = lighting_.local_probes.mip_count;
    head_.exposure = lighting_.exposure;
    head_.light_count = static_cast<uint32_t>(lighting_.lights.size());
    const auto word = [](VkDeviceSize bytes) { return static_cast<uint32_t>(bytes / sizeof(uint32_t)); };
    head_.first_list_word = word(layout_.lists);
    head_.first_cell_word = word(layout_.cells);
    head_.first_index_word = word(layout_.indices);
    head_.index_words = layout_.index_words;
    head_.first_in_view = static_cast<uint32_t>(layout_.in_view / sizeof(shared::CellLight));
}

void SceneLights::fill(MirroredTable& table, std::span<const std::byte> surroundings, uint64_t transfer_rows,
                       bool has_surroundings, std::span<const std::byte> receivers)
{
    head_.transfers_row = static_cast<uint32_t>(layout_.surroundings / kRowBytes);
    head_.surroundings_row = has_surroundings ? head_.transfers_row + static_cast<uint32_t>(transfer_rows)
                                              : shared::kNoSurroundings;
    std::vector<std::byte> bytes(static_cast<size_t>(layout_.lists));
    std::memcpy(bytes.data(), &head_, sizeof(head_));
    for (uint32_t slot = 0; slot < lighting_.lights.size(); ++slot)
    {
        const shared::Light light = sharedLight(slot);
        std::memcpy(bytes.data() + layout_.light(slot), &light, sizeof(light));
    }
    if (const shared::SkyImage* image = lighting_.sky.image; image != nullptr)
        writeSkyImage(*image, std::span(bytes).subspan(static_cast<size_t>(layout_.sky_image)));
    const auto probes = std::as_bytes(std::span(lighting_.local_probes.tables));
    std::ranges::copy(probes, bytes.begin() + static_cast<ptrdiff_t>(layout_.local_probes));
    if (!surroundings.empty())
        std::memcpy(bytes.data() + layout_.surroundings, surroundings.data(), surroundings.size());
    if (!receivers.empty())
        std::memcpy(bytes.data() + layout_.receivers, receivers.data(), receivers.size());
    table.fill(bytes);
}

void SceneLights::setAtlas(const formats::ReceiverAtlasRecord& atlas)
{
    head_.receivers_row = static_cast<uint32_t>(layout_.receivers / kRowBytes);
    head_.receiver_scale = atlas.scale;
    head_.receiver_width = static_cast<float>(atlas.width);
    head_.receiver_height = static_cast<float>(atlas.height);
}

/// Make sure that a slot below the capacity is in use.
void SceneLights::reserveSlot(uint32_t slot)
{
    HEARTH_ASSERT(slot < layout_.capacity);
    if (slot < lighting_.lights.size())
        return;
    shared::Light unused{};
    unused.shadow_row = shared::kNoShadow;
    lighting_.lights.resize(slot + 1, unused);
    slots_.resize(slot + 1);
}

shared::Light SceneLights::sharedLight(size_t slot) const
{
    shared::Light light = lighting_.lights[slot];
    light.reflector_axis |= slots_[slot].baked;
    return light;
}

void SceneLights::writeLight(MirroredTable& table, uint32_t slot)
{
    lighting_.lights[slot].intensity = slots_[slot].intensity * slots_[slot].weight;
    const shared::Light light = sharedLight(slot);
    table.write(layout_.light(slot), std::as_bytes(std::span(&light, 1)));
}

void SceneLights::set(MirroredTable& table, uint32_t slot, const shared::Light& light, float steady_luminance)
{
    reserveSlot(slot);
    shared::Light& current = lighting_.lights[slot];
    const uint32_t row = current.shadow_row;
    current = light;
    current.shadow_row = row;
    slots_[slot].intensity = light.intensity;
    slots_[slot].steady_luminance = steady_luminance;
    writeLight(table, slot);
}

void SceneLights::setSky(const shared::Sky& sky)
{
    HEARTH_ASSERT(sky.image == lighting_.sky.image);
    lighting_.sky = sky;
    head_.sky_zenith = sky.zenith;
    head_.sky_horizon = sky.horizon;
    head_.sky_ground = sky.ground;
}

void SceneLights::setWeight(MirroredTable& table, uint32_t slot, Float3 weight)
{
    reserveSlot(slot);
    slots_[slot].weight = weight;
    writeLight(table, slot);
}

void SceneLights::weighProbe(MirroredTable& table, size_t probe, Float3 weight)
{
    shared::LocalProbe weighed = lighting_.local_probes.tables[probe].probe;
    weighed.irradiance_red *= weight.x;
    weighed.irradiance_green *= weight.y;
    weighed.irradiance_blue *= weight.z;
    table.write(layout_.local_probes + probe * sizeof(shared::LocalProbeTable),
                std::as_bytes(std::span(&weighed, 1)));
}

void SceneLights::setBaked(MirroredTable& table, uint32_t slot, uint32_t bits)
{
    HEARTH_ASSERT(slot < slots_.size());
    if (slots_[slot].baked == bits)
        return;
    slots_[slot].baked = bits;
    writeLight(table, slot);
}

float SceneLights::steadyLuminance(uint32_t slot) const
{
    const Slot& held = slots_[slot];
    if (held.weight == Float3{1, 1, 1})
        return held.steady_luminance;
    // the colour of a light without flicker is that with it
    const float luminance = shared::luminance(held.intensity);
    const float weighed = shared::luminance(held.intensity * held.weight);
    return held.steady_luminance * (luminance > 0 ? weighed / luminance : shared::luminance(held.weight));
}

void SceneLights::setShadowRow(MirroredTable& table, uint32_t slot, uint32_t row)
{
    HEARTH_ASSERT(slot < lighting_.lights.size());
    lighting_.lights[slot].shadow_row = row;
    table.write(layout_.light(slot) + offsetof(shared::Light, shadow_row), std::as_bytes(std::span(&row, 1)));
}

uint32_t SceneLights::rangedCount() const
{
    return static_cast<uint32_t>(std::count_if(lighting_.lights.begin(), lighting_.lights.end(),
                                               [](const shared::Light& light) {
                                                   return !shared::isUnrangedLight(light) &&
                                                          !shared::isLightOff(light);
                                               }));
}

void SceneLights::beginFrame(const MirroredTable& table, uint32_t copy, const shared::FrameView& view,
                             LightLister lister, LightAreas areas)
{
    const shared::LightGridLayout grid = shared::makeLightGrid(shared::lightGridView(view));
    head_.light_count = static_cast<uint32_t>(lighting_.lights.size());
    head_.grid = grid.grid;
    std::copy(grid.cascades.begin(), grid.cascades.end(), head_.cascades);
    head_.tiles = grid.tiles;
    head_.list_count = countLists(grid, areas);
    const Buffer& buffer = table.copy(copy);
    std::memcpy(buffer.mapped, &head_, sizeof(head_));
    if (!listsOnDevice(lister, areas))
        lists_.assign(grid, lighting_.lights, listView(buffer));
}

shared::LightListView SceneLights::listView(const Buffer& buffer) const
{
    const auto words = [&](VkDeviceSize offset, size_t count)
    { return std::span(reinterpret_cast<uint32_t*>(buffer.mapped + offset), count); };
    return {.counts = reinterpret_cast<shared::LightListCounts*>(buffer.mapped + layout_.lists),
            .frame = words(layout_.lists + sizeof(shared::LightListCounts), layout_.capacity),
            .cells = words(layout_.cells, shared::kMaxLightCells),
            .indices = words(layout_.indices, layout_.index_words)};
}

} // namespace hearth::gpu
