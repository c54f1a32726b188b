// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/fuzz/exercise_pack.h"

#include "formats/codecs/channel_keys.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/records/animation_paths.h"
#include "runtime/pack/cut.h"
#include "runtime/pack/light_player.h"
#include "runtime/pack/pack.h"
#include "runtime/pack/page_graph.h"

#include <limits>

namespace hearth::test
{

using namespace formats;

namespace
{

// Sink that keeps the optimiser from removing reads: every value that is read is added to it.
volatile uint64_t sink;

void use(uint64_t value)
{
    sink = sink + value;
}

/// Read a page and all its clusters like a renderer: without bounds checks.
Status usePage(const pack::Pack& pack, uint32_t page_index)
{
    std::vector<std::byte> buffer(pack.pageSize(page_index));
    HEARTH_ASSIGN_OR_RETURN(const std::span<const std::byte> page, pack.readPage(page_index, buffer));
    const PageRecord& record = pack->pages()[page_index];
    for (uint32_t i = record.clusters.first; i < record.clusters.first + record.clusters.count; ++i)
    {
        const ClusterRecord& cluster = pack->clusters()[i];
        const auto geometry = ClusterGeometry::at(page, cluster, pack->meshes()[record.mesh]);
        HEARTH_ASSERT(geometry.has_value());
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
            for (const uint32_t corner : geometry->triangle(t))
            {
                HEARTH_ASSERT(corner < geometry->vertexCount());
                use(std::bit_cast<uint32_t>(geometry->position(corner).x));
            }
    }
    return success();
}

/// Check that a cut draws something of every mesh with clusters, and never a cluster together with its
/// refinement.
void useCuts(const PackView& view, uint32_t mesh)
{
    const bool has_clusters = view.meshes()[mesh].clusters.count > 0;
    for (const float error : {0.0f, 0.1f, std::numeric_limits<float>::infinity()})
    {
        const std::vector<uint32_t> cut = pack::selectCut(view, mesh, error);
        HEARTH_ASSERT(cut.empty() != has_clusters);
        for (const uint32_t cluster : cut)
            use(view.groups()[view.clusters()[cluster].group].page);
    }
}

/// Use the cut of every mesh if only the pinned pages are resident.
void useCoarsest(const PackView& view)
{
    const pack::PageGraph graph = pack::PageGraph::of(view);
    std::vector<uint8_t> resident(graph.pageCount(), 0);
    for (const uint32_t page : graph.pinned())
        resident[page] = 1;
    const std::vector<uint8_t> resident_groups = pack::residentGroups(view, resident);
    for (uint32_t mesh = 0; mesh < view.meshes().size(); ++mesh)
    {
        const std::vector<uint32_t> cut = pack::selectCut(view, mesh, 0, resident_groups);
        HEARTH_ASSERT(cut.empty() != (view.meshes()[mesh].clusters.count > 0));
        for (const uint32_t cluster : cut)
            HEARTH_ASSERT(graph.isPinned(view.clusters()[cluster].page));
    }
}

/// Walk the scene like a renderer.
void useScene(const PackView& view)
{
    for (const NodeRecord& node : view.nodes())
    {
        size_t depth = 0;
        for (uint32_t parent = node.parent; parent != kInvalidIndex; parent = view.nodes()[parent].parent)
            HEARTH_ASSERT(++depth <= view.nodes().size());
        use(view.text(node.name).size());
        for (const float weight :
             view.morphWeights().subspan(node.morph_weights.first, node.morph_weights.count))
            use(std::bit_cast<uint32_t>(weight));
    }
    for (const AssetRecord& asset : view.assets())
    {
        use(view.text(asset.name).size() + std::bit_cast<uint32_t>(largestSide(asset)));
        for (const InstanceRecord& instance :
             view.instances().subspan(asset.instances.first, asset.instances.count))
            HEARTH_ASSERT(instance.mesh - asset.meshes.first < asset.meshes.count &&
                          instance.node - asset.nodes.first < asset.nodes.count);
    }
    for (const InstanceRecord& instance : view.instances())
        use(view.meshes()[instance.mesh].clusters.count + view.nodes()[instance.node].parent);
    for (const SkinRecord& skin : view.skins())
        for (const JointRecord& joint : view.joints().subspan(skin.joints.first, skin.joints.count))
            use(view.nodes()[joint.node].parent);
    for (const AnimationChannelRecord& channel : view.channels())
    {
        const size_t values =
            size_t{channel.key_count} * channel.components * (channel.interpolation == 2 ? 3 : 1);
        HEARTH_ASSERT(channel.target <
                      (kAnimationPaths[channel.path].of_light ? view.lights().size() : view.nodes().size()));
        const ChannelKeys keys(view.keys(), view.keyBits(), channel);
        use(std::bit_cast<uint32_t>(keys.time(channel.key_count - 1)));
        if (isPacked(channel))
            use(std::bit_cast<uint64_t>(keys.value(channel.key_count - 1, 0, channel.components)[0]));
        else
            use(std::bit_cast<uint32_t>(view.keys()[channel.first_value + values - 1]));
    }
}

/// Play the lights of every clip; they stay as the format allows.
void useLights(const PackView& view)
{
    pack::PosePlayer poses(view);
    pack::LightPlayer player(view);
    for (uint32_t clip = 0; clip < view.animations().size(); ++clip)
    {
        const double seconds = double{view.animations()[clip].duration} * 0.4;
        poses.blend({0, seconds}, {clip, seconds}, 0.5);
        player.update(poses, seconds);
        for (const pack::PlayedLight& played : player.lights())
        {
            const LightRecord& light = played.record;
            for (const float value :
                 {light.color.x, light.color.y, light.color.z, light.intensity, light.range})
                HEARTH_ASSERT(value >= 0 && value <= std::numeric_limits<float>::max());
            HEARTH_ASSERT(light.inner_cone_rad >= 0 && light.inner_cone_rad <= light.outer_cone_rad);
        }
    }
}

Status useImage(const PackView& view, uint32_t index)
{
    const ImageRecord& image = view.images()[index];
    // A huge image of few bytes is legal; unpacking each would only slow the search down.
    if (view.container().find(kChunkImageData, index)->size > (1u << 20))
        return success();
    HEARTH_ASSIGN_OR_RETURN(const ChunkData texels, view.imageData(index));
    HEARTH_ASSERT(texels.bytes().size() == mipOffset(image, image.mip_count));
    return success();
}

/// March through the bricks from corner to corner, and read each face's data.
void useBricks(const PackView& view)
{
    const shared::BrickMasks masks{toBrickGrid(view.brickGrid()[0]), view.brickGroupsAlongAxis(),
                                   view.bricks()};
    const Float3 end{static_cast<float>(masks.grid.voxels_x), static_cast<float>(masks.grid.voxels_y),
                     static_cast<float>(masks.grid.voxels_z)};
    const float size = length(end);
    for (const Float3 corner :
         {Float3{0, 0, 0}, Float3{end.x, 0, 0}, Float3{0, end.y, 0}, Float3{0, 0, end.z}})
    {
        const Float3 way = (end - corner * 2) / size;
        shared::BrickRay ray = shared::brickRayInVoxels(masks.grid, corner, way, shared::kBrickInfinity);
        for (ray = brickMarch(masks, ray); ray.inside != 0;
             ray = brickMarch(masks, brickSkipVoxel(masks, ray)))
        {
            const BrickRecord& brick = view.bricks()[ray.brick];
            use(view.brickOpacity()[brickVoxel(brick, ray.bit)]);
            for (uint32_t face = 0; face < shared::kVoxelFaces; ++face)
                if (const uint32_t index = brickFace(brick, ray.bit, face); index != shared::kNoFace)
                    use(uint64_t{view.brickAlbedo()[index]} + view.brickNormals()[index] +
                        view.brickEmission()[index] + view.brickLighting()[index]);
        }
    }
}

} // namespace

Status exercisePack(std::span<const std::byte> bytes)
{
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::fromBytes(bytes, "fuzz"));
    std::vector<Status> reads;
    for (uint32_t page = 0; page < pack->pages().size(); ++page)
        reads.push_back(usePage(pack, page));
    for (uint32_t mesh = 0; mesh < pack->meshes().size(); ++mesh)
        useCuts(pack.view(), mesh);
    useCoarsest(pack.view());
    useScene(pack.view());
    useLights(pack.view());
    for (uint32_t image = 0; image < pack->images().size(); ++image)
        reads.push_back(useImage(pack.view(), image));
    for (const MaterialRecord& material : pack->materials())
        if (material.base_color_texture.image != kInvalidIndex)
            use(pack->images()[material.base_color_texture.image].width);
    if (!pack->brickGrid().empty())
        useBricks(pack.view());
    for (Status& read : reads)
        if (!read.ok())
        {
            HEARTH_ASSERT(!pack.checkAll().ok());
            return std::move(read);
        }
    return success();
}

} // namespace hearth::test
