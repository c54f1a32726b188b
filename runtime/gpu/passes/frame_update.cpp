// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_update.h"

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_tables.h"
#include "runtime/gpu/textures/streamed_textures.h"

#include <cstring>

namespace hearth::gpu
{

namespace
{

void clear(const Buffer& buffer)
{
    std::memset(buffer.mapped, 0, static_cast<size_t>(buffer.size));
}

/// Take the next of the scene's frames in flight, and bring its tables up to date.
const SceneFrame& beginSceneFrame(const Scene& scene)
{
    SceneTables& tables = *scene.tables;
    tables.frame = (tables.frame + 1) % static_cast<uint32_t>(scene.frames.size());
    for (MirroredTable* table : {&tables.lighting, &tables.instances, &tables.inverses, &tables.bounds})
        table->update(tables.frame);
    if (scene.deformation != nullptr)
        scene.deformation->table.update(tables.frame);
    const SceneFrame& frame = scene.frame();
    clear(frame.tile_draws);
    return frame;
}

/// Begin a frame of targets with motion vectors. Where they have had one in this step, the step ends: what
/// the tables have now becomes their earlier state.
void beginMotion(const Scene& scene, FrameTargets& targets, const shared::FrameView& view)
{
    SceneTables& tables = *scene.tables;
    if (!targets.options().has_motion || !tables.keeps_motion)
        return;
    if (targets.motion().step() == tables.step)
    {
        ++tables.step;
        tables.instances.keepEarlier();
        if (scene.deformation != nullptr)
            scene.deformation->table.keepEarlier();
    }
    targets.motion().beginFrame(view, tables.step);
}

/// Record the copies of streamed pages, of the flags of their groups, and of textures.
void recordStream(const Device& device, VkCommandBuffer commands, const Scene& scene,
                  const WordCopyPass& copy_words, WordCopies& copies)
{
    const SceneFrame& frame = scene.frame();
    const uint32_t number = scene.tables->frame;
    if (scene.stream->takePoolChange(number))
        rebindPool(device, scene, number);
    const SceneStream::Copies ranges = scene.stream->takeChanges(scene.buffers, number, copies);
    for (size_t i = 0; i < ranges.size(); ++i)
        copy_words.record(device, commands, frame.stream_copy_sets[i], ranges[i]);
    scene.stream->recordMoves(commands, scene.buffers);
    if (scene.textures == nullptr)
        return;
    for (const uint32_t row : scene.textures->record(commands, number))
    {
        writeMaterialTextures(device, scene, row, scene.materials[row].sets[number]);
        if (scene.joined_sets != nullptr)
            scene.joined_sets->setMaterial(device, number, row, scene.materials[row].sets[number]);
    }
}

} // namespace

WordCopies recordFrameUpdate(const Device& device, VkCommandBuffer commands, const Scene& scene,
                             FrameTargets& targets, const WordCopyPass& copy_words,
                             const shared::FrameView& view, const FrameChanges& changes)
{
    if (changes.draws)
        beginMotion(scene, targets, view);
    takeMoves(scene, changes.moves);
    takePoses(scene, changes.poses);
    if (changes.daylight != nullptr)
        takeDaylight(scene, *changes.daylight);
    takeLights(scene, changes.lights, changes.lamp_weights);
    if (scene.shadows != nullptr && changes.draws)
        scene.shadows->chooseLights(view, *scene.lights, scene.tables->lighting);
    const SceneFrame& frame = beginSceneFrame(scene);
    writeView(frame.main, view);
    targets.beginFrame(view);
    WordCopies copies(frame.copy_regions);
    if (scene.stream != nullptr)
        recordStream(device, commands, scene, copy_words, copies);
    return copies;
}

void recordViewChange(const Device& device, VkCommandBuffer commands, const SceneView& target,
                      const shared::FrameView& view)
{
    constexpr VkPipelineStageFlags kReaders = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                              VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                              VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    barrier(device, commands, kReaders | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_ACCESS_TRANSFER_WRITE_BIT);
    device.vk.vkCmdUpdateBuffer(commands, target.frame.handle.get(), 0, sizeof(view), &view);
    device.vk.vkCmdFillBuffer(commands, target.material_draws.handle.get(), 0, VK_WHOLE_SIZE, 0);
    if (const shared::ProxyDraw draw = emptyProxyDraw(); target.proxy_draw.mapped != nullptr)
        device.vk.vkCmdUpdateBuffer(commands, target.proxy_draw.handle.get(), 0, sizeof(draw), &draw);
    barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, kReaders,
            VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

void writeView(const SceneView& target, const shared::FrameView& view)
{
    std::memcpy(target.frame.mapped, &view, sizeof(view));
    clear(target.material_draws);
    if (const shared::ProxyDraw draw = emptyProxyDraw(); target.proxy_draw.mapped != nullptr)
        std::memcpy(target.proxy_draw.mapped, &draw, sizeof(draw));
}

} // namespace hearth::gpu
