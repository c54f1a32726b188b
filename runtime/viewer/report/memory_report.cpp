// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/report/memory_report.h"

#include "runtime/gpu/scene/scene_shadows.h"

#include <cstdio>

namespace hearth::viewer
{

namespace
{

struct NamedCount
{
    const char* name;
    const char* key; ///< in JSON
    uint64_t bytes;
};

std::vector<NamedCount> named(const MemoryCounts& counts)
{
    return {{"attachments", "attachments", counts.attachments},
            {"attachments on the tile only", "tile_attachments", counts.tile_attachments},
            {"depth pyramid", "pyramid", counts.pyramid},
            {"lists of tiles, gathered light", "lists", counts.lists},
            {"geometry", "geometry", counts.geometry},
            {"textures", "textures", counts.textures},
            {"tables", "tables", counts.tables},
            {"shadow maps", "shadow_maps", counts.shadow_maps}};
}

} // namespace

MemoryCounts countMemory(const gpu::Scene& scene, const gpu::FrameTargets& targets)
{
    MemoryCounts counts;
    for (const gpu::Image* image : {&targets.visibility(), &targets.depth(), &targets.color()})
        counts.attachments += image->bytes;
    counts.tile_attachments = targets.transientBytes();
    counts.attachments -= counts.tile_attachments;
    counts.pyramid = targets.pyramidBytes();
    counts.lists = targets.allocatedBytes() - counts.attachments - counts.pyramid;
    counts.geometry = scene.buffers.pool.bytes();
    for (const gpu::Image& image : scene.images)
        counts.textures += image.bytes;
    counts.tables = scene.arena.allocatedBytes() - counts.textures;
    if (scene.stream != nullptr)
        counts.tables += scene.stream->allocatedBytes();
    if (scene.shadows != nullptr)
        counts.shadow_maps = scene.shadows->allocatedBytes();
    return counts;
}

std::string formatMemoryJson(const MemoryCounts& counts)
{
    std::string text = "{";
    for (const NamedCount& count : named(counts))
        text +=
            (text.size() > 1 ? ",\"" : "\"") + std::string(count.key) + "\":" + std::to_string(count.bytes);
    return text + "}";
}

std::string formatMemoryText(const MemoryCounts& counts)
{
    std::string text;
    for (const NamedCount& count : named(counts))
    {
        if (count.bytes == 0)
            continue;
        char line[80];
        std::snprintf(line, sizeof(line), "%-32s%9.2f MiB\n", count.name,
                      static_cast<double>(count.bytes) / (1 << 20));
        text += line;
    }
    return text;
}

} // namespace hearth::viewer
