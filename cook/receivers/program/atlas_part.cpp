// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/program/atlas_part.h"

#include "cook/json/json.h"
#include "formats/container/container_writer.h"

namespace hearth::receivers
{

using namespace formats;

namespace
{

constexpr const char* kNoReceivers = "no instance that stays in its place has UVs for them";

bool hasReceivers(const CookedReceivers& cooked)
{
    return cooked.atlas.record.width > 0 || cooked.faces.record.width > 0;
}

/// Return the settings and, without receivers, the reason for that.
Json settingsJson(const CookedReceivers& cooked, const CookSettings& settings)
{
    Json json{{"texels_per_metre", settings.bake.texels_per_metre},
              {"lights", settings.atlas.select.max_colors},
              {"codec", settings.atlas.codec == ReceiverCodec::rgbm ? "rgbm" : "rgb9e5"},
              {"bounces", settings.bake.bounces}};
    if (!hasReceivers(cooked))
        json["none"] = kNoReceivers;
    return json;
}

/// Count the bytes of an atlas; its lamps are counted with its texels, not with faces.
uint64_t countBytes(const Atlas& atlas, std::span<const ReceiverLampRecord> lamps)
{
    if (atlas.record.width == 0)
        return 0;
    const auto bytes = [](const auto& table) { return std::span(table).size_bytes(); };
    return sizeof(ReceiverAtlasRecord) + bytes(lamps) + bytes(atlas.rects) + bytes(atlas.blocks) +
           bytes(atlas.words);
}

double ratio(uint64_t part, uint64_t whole)
{
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

Status writeReceiversPart(const std::string& path, const CookedReceivers& cooked,
                          const CookSettings& settings)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::part));
    const Json meta{{"schema", "hearth.meta/1"},
                    {"tool", {{"name", "hearth-receivers"}, {"version", HEARTH_VERSION}}},
                    {"settings", {{"receivers", settingsJson(cooked, settings)}}}};
    HEARTH_TRY(writer.addText(kChunkMeta, meta.dump(1, '\t')));
    const Atlas &atlas = cooked.atlas, &faces = cooked.faces;
    const bool has_texels = atlas.record.width > 0;
    if (hasReceivers(cooked))
        HEARTH_TRY(writer.addRecords<ReceiverLampRecord>(kChunkReceiverLamps,
                                                         has_texels ? atlas.lamps : faces.lamps));
    if (has_texels)
    {
        HEARTH_TRY(writer.addRecords<ReceiverAtlasRecord>(kChunkReceivers, {&atlas.record, 1}));
        HEARTH_TRY(writer.addRecords<ReceiverRectRecord>(kChunkReceiverRects, atlas.rects));
        HEARTH_TRY(writer.addRecords<ReceiverBlockRecord>(kChunkReceiverBlocks, atlas.blocks));
        HEARTH_TRY(writer.addRecords<uint32_t>(kChunkReceiverWords, atlas.words));
    }
    if (faces.record.width > 0)
    {
        HEARTH_TRY(writer.addRecords<ReceiverAtlasRecord>(kChunkFaceReceivers, {&faces.record, 1}));
        HEARTH_TRY(writer.addRecords<ReceiverBlockRecord>(kChunkFaceBlocks, faces.blocks));
        HEARTH_TRY(writer.addRecords<uint32_t>(kChunkFaceWords, faces.words));
    }
    return writer.finish();
}

std::string statisticsJson(const CookedReceivers& cooked, const CookSettings& settings)
{
    const Atlas &atlas = cooked.atlas, &faces = cooked.faces;
    const InstancesWithoutUvs& without = cooked.without_uvs;
    Json json{{"schema", "hearth.receivers/1"}};
    json.update(settingsJson(cooked, settings));
    json["width"] = atlas.record.width;
    json["height"] = atlas.record.height;
    json["texels"] = atlas.record.texel_count;
    json["lamps"] = atlas.lamps.size();
    json["colors_per_texel"] = ratio(atlas.color_count, atlas.record.texel_count);
    const uint64_t bytes = countBytes(atlas, atlas.lamps);
    json["bytes"] = bytes;
    json["bytes_per_texel"] = ratio(bytes, atlas.record.texel_count);
    json["largest_dropped"] = atlas.largest_dropped;
    json["dropping_texels"] = atlas.dropping_count;
    json["faces"] = {{"count", faces.record.texel_count},
                     {"colors_per_face", ratio(faces.color_count, faces.record.texel_count)},
                     {"bytes", countBytes(faces, {})},
                     {"largest_dropped", faces.largest_dropped}};
    json["instances"] = atlas.rects.size();
    json["left_out"] = {{"animated", cooked.left_out.animated},
                        {"deformed", cooked.left_out.deformed},
                        {"unlit", cooked.left_out.unlit},
                        {"transparent", without.transparent},
                        {"no_uvs", without.none},
                        {"flat_uvs", without.flat},
                        {"uvs_outside", without.outside},
                        {"overlapping_uvs", without.overlapping}};
    json["rays"] = {{"shadow", cooked.shadow_rays}, {"gather", cooked.gather_rays}};
    return json.dump(1) + "\n";
}

} // namespace hearth::receivers
