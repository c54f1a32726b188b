// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/inspect/inspect.h"

#include "formats/pack/image_error.h"

namespace hearth::command
{

using namespace formats;

namespace
{

Json pointJson(Float3 p)
{
    return {p.x, p.y, p.z};
}

double ratio(uint64_t part, uint64_t whole)
{
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Json levelJson(const LevelSummary& level)
{
    Json json{{"clusters", level.clusters},         {"triangles", level.triangles},
              {"max_error", level.max_error},       {"position_error", level.position_error},
              {"normal_error", level.normal_error}, {"uv_error", level.uv_error}};
    if (level.authored)
        json["authored"] = {{"name", level.authored->name},
                            {"number", level.authored->number ? Json(*level.authored->number) : Json()}};
    return json;
}

Json meshJson(const MeshSummary& mesh, uint32_t index)
{
    Json json{{"index", index},
              {"name", mesh.name},
              {"attributes", attributeNames(mesh.attributes)},
              {"source",
               {{"triangles", mesh.source_triangles},
                {"vertices", mesh.source_vertices},
                {"faces", mesh.source_faces}}},
              {"degenerate_triangles", mesh.degenerate_triangles},
              {"skinned", mesh.skinned},
              {"morph_targets", mesh.morph_targets},
              {"box", {pointJson(mesh.box_min), pointJson(mesh.box_max)}},
              {"levels", Json::array()},
              {"groups", mesh.groups},
              {"clusters", mesh.clusters},
              {"pages", mesh.pages}};
    for (const LevelSummary& level : mesh.levels)
        json["levels"].push_back(levelJson(level));
    json["fill"] = {{"triangles_per_cluster", ratio(mesh.triangles, mesh.clusters)},
                    {"vertices_per_cluster", ratio(mesh.vertices, mesh.clusters)},
                    {"triangles", ratio(mesh.triangles, uint64_t{mesh.clusters} * kMaxClusterTriangles)}};
    json["bytes"] = {{"vertices", mesh.vertex_bytes}, {"indices", mesh.index_bytes},
                     {"pages", mesh.page_bytes},      {"pages_stored", mesh.stored_page_bytes},
                     {"records", mesh.record_bytes},  {"bounds", mesh.bounds_bytes}};
    return json;
}

Json targetJson(float target)
{
    return target == 0 ? Json() : Json(target);
}

Json imageJson(const PackView& pack, uint32_t index)
{
    const ImageRecord& image = pack.images()[index];
    const ChunkEntry* data = pack.container().find(kChunkImageData, index);
    return {{"index", index},
            {"name", pack.text(image.name)},
            {"width", image.width},
            {"height", image.height},
            {"mips", image.mip_count},
            {"format", std::string(texelFormatName(image.format))},
            {"role", std::string(imageRoleName(image.role))},
            {"error", image.error},
            {"error_p999", image.error_p999},
            {"error_smooth", image.error_smooth},
            {"coverage_error", image.coverage_error},
            {"target", targetJson(image.target)},
            {"target_smooth", targetJson(image.target_smooth)},
            {"holds_target", holdsTargets(image)},
            {"placeholder", (image.flags & kImagePlaceholder) != 0},
            {"bytes", data == nullptr ? 0 : data->size},
            {"bytes_stored", data == nullptr ? 0 : data->stored_size}};
}

Json layersJson(const MaterialLayersRecord& layers)
{
    return {{"ior", layers.ior},
            {"specular", layers.specular},
            {"specular_color", pointJson(layers.specular_color)},
            {"clearcoat", layers.clearcoat},
            {"clearcoat_roughness", layers.clearcoat_roughness},
            {"sheen_color", pointJson(layers.sheen_color)},
            {"sheen_roughness", layers.sheen_roughness}};
}

Json materialJson(const PackView& pack, uint32_t index)
{
    const MaterialRecord& material = pack.materials()[index];
    Json json = {{"index", index},
                 {"name", pack.text(material.name)},
                 {"alpha_mode", alphaModeName(material.alpha_mode)},
                 {"double_sided", (material.flags & kMaterialDoubleSided) != 0},
                 {"unlit", (material.flags & kMaterialUnlit) != 0}};
    if (const MaterialLayersRecord* const layers = findLayers(pack.materialLayers(), index))
        json["layers"] = layersJson(*layers);
    return json;
}

Json assetJson(const PackView& pack, uint32_t index)
{
    const AssetRecord& asset = pack.assets()[index];
    const auto range = [](Range of) -> Json { return {{"first", of.first}, {"count", of.count}}; };
    return {{"index", index},
            {"name", pack.text(asset.name)},
            {"box", {pointJson(asset.box_min), pointJson(asset.box_max)}},
            {"size", pointJson(asset.box_max - asset.box_min)},
            {"instances", range(asset.instances)},
            {"meshes", range(asset.meshes)},
            {"nodes", range(asset.nodes)}};
}

Json extrasJson(const PackView& pack, uint32_t i)
{
    const ExtrasRecord& record = pack.extras()[i];
    return {{"owner", extrasOwnerName(record.owner)},
            {"index", record.index},
            {"name", readOwnerName(pack, record)},
            {"json", pack.text(record.json)}};
}

/// Return an array with an object for each record of a table.
template <typename MakeJson>
Json listJson(size_t count, MakeJson makeJson)
{
    Json list = Json::array();
    for (uint32_t i = 0; i < count; ++i)
        list.push_back(makeJson(i));
    return list;
}

/// Return the compression of a clip by the import.
Json clipJson(const ClipSummary& clip)
{
    return {{"keys", {{"source", clip.keys_before}, {"kept", clip.keys}}},
            {"bytes", {{"source", clip.bytes_before}, {"kept", clip.bytes}}},
            {"errors", {{"stated", clip.stated_error}, {"proven", clip.proven_error}}}};
}

Json sceneJson(const PackView& pack, const PackSummary& summary)
{
    const auto camera = [&](uint32_t i) -> Json
    {
        const bool perspective = pack.cameras()[i].type == static_cast<uint32_t>(CameraType::perspective);
        return {{"index", i},
                {"name", pack.text(pack.cameras()[i].name)},
                {"type", perspective ? "perspective" : "orthographic"}};
    };
    const auto light = [&](uint32_t i) -> Json
    {
        const LightRecord& record = pack.lights()[i];
        Json json{{"index", i},
                  {"name", pack.text(record.name)},
                  {"type", lightTypeName(record.type)},
                  {"intensity", record.intensity}};
        if (record.flicker_rate > 0)
            json["flicker"] = {{"rate", record.flicker_rate},
                               {"amplitude", record.flicker_amplitude},
                               {"seed", record.flicker_seed}};
        return json;
    };
    const auto shadow_sphere = [&](uint32_t i) -> Json
    {
        const ShadowSphereRecord& record = pack.shadowSpheres()[i];
        return {{"index", i},
                {"name", pack.text(pack.nodes()[record.node].name)},
                {"light", record.light == kInvalidIndex ? Json() : Json(record.light)},
                {"center", {record.center.x, record.center.y, record.center.z}},
                {"radius", record.radius},
                {"texels", record.texels}};
    };
    const auto skin = [&](uint32_t i) -> Json
    {
        const SkinRecord& record = pack.skins()[i];
        return {{"index", i}, {"name", pack.text(record.name)}, {"joints", record.joints.count}};
    };
    const auto animation = [&](uint32_t i) -> Json
    {
        const AnimationRecord& record = pack.animations()[i];
        Json json{{"index", i},
                  {"name", pack.text(record.name)},
                  {"channels", record.channels.count},
                  {"light_channels", record.light_channels.count},
                  {"seconds", record.duration},
                  {"error", record.error}};
        if (i < summary.meta.clips.size())
            json.update(clipJson(summary.meta.clips[i]));
        return json;
    };
    const auto specular = [&](uint32_t i) -> Json
    {
        const SpecularTableRecord& record = pack.specularTables()[i];
        return {{"masking", record.masking == 0 ? "separable" : "correlated"},
                {"normal_lambda", record.normal_lambda},
                {"spacing", record.spacing == 0 ? "cosine" : "half-sine"}};
    };
    const auto probe = [&](uint32_t i) -> Json
    {
        const ProbeRecord& record = pack.probes()[i];
        Json json{{"face_size", record.face_size},
                  {"mips", record.mip_count},
                  {"sharp_mips", record.sharp_mips},
                  {"sky", (record.flags & kProbeIsSky) != 0},
                  {"bytes", record.texels.count * sizeof(uint32_t)},
                  {"irradiance", pointJson(record.irradiance)},
                  {"irradiance_luminance", record.irradiance_luminance},
                  {"window", record.window},
                  {"largest", record.largest},
                  {"error", record.error}};
        if (isLocalProbe(record))
            json["place"] = {{"position", pointJson(record.position)},
                             {"box_min", pointJson(record.box_min)},
                             {"box_max", pointJson(record.box_max)},
                             {"influence_min", pointJson(record.influence_min)},
                             {"influence_max", pointJson(record.influence_max)},
                             {"fade", record.fade},
                             {"sky_share", record.sky_share[3]}};
        return json;
    };
    return {
        {"nodes", pack.nodes().size()},
        {"instances", pack.instances().size()},
        {"instanced_triangles", summary.instanced_triangles},
        {"joints", summary.joint_nodes},
        {"morph_targets", summary.morph_targets},
        {"cameras", listJson(pack.cameras().size(), camera)},
        {"lights", listJson(pack.lights().size(), light)},
        {"shadow_spheres", listJson(pack.shadowSpheres().size(), shadow_sphere)},
        {"materials", listJson(pack.materials().size(), [&](uint32_t i) { return materialJson(pack, i); })},
        {"images", listJson(pack.images().size(), [&](uint32_t i) { return imageJson(pack, i); })},
        {"skins", listJson(pack.skins().size(), skin)},
        {"extras", listJson(pack.extras().size(), [&](uint32_t i) { return extrasJson(pack, i); })},
        {"animations", listJson(pack.animations().size(), animation)},
        {"specular_tables", listJson(pack.specularTables().size(), specular)},
        {"probes", listJson(pack.probes().size(), probe)}};
}

Json chunkJson(const ChunkEntry& entry)
{
    return {{"kind", chunkName(entry.type, entry.index).substr(6, 4)},
            {"index", entry.index},
            {"size", entry.size},
            {"stored", entry.stored_size},
            {"codec", codecName(entry.codec)}};
}

/// Return all chunks of the bricks as one row, because they have a meaning only together.
Json brickChunksJson(const PackView& pack)
{
    const BricksSummary summary = summarizeBricks(pack);
    Json json{{"kind", "bricks"},
              {"index", 0},
              {"size", summary.bytes},
              {"stored", summary.stored_bytes},
              {"chunks", Json::array()}};
    for (const ChunkEntry& entry : pack.container().chunks())
        if (isBrickChunk(entry.type))
            json["chunks"].push_back(chunkJson(entry));
    return json;
}

/// Return a row for each chunk in the order of the file, and one row for all chunks of the bricks.
Json chunksJson(const PackView& pack)
{
    Json list = Json::array();
    for (const ChunkEntry& entry : pack.container().chunks())
        if (!isBrickChunk(entry.type))
            list.push_back(chunkJson(entry));
        else if (entry.type == kBrickChunks[0])
            list.push_back(brickChunksJson(pack));
    return list;
}

Json bricksJson(const PackView& pack)
{
    const BrickGridRecord& grid = pack.brickGrid()[0];
    const BricksSummary summary = summarizeBricks(pack);
    return {{"voxel_size", grid.voxel_size},
            {"origin", pointJson(grid.origin)},
            {"dims", {grid.voxels[0], grid.voxels[1], grid.voxels[2]}},
            {"groups", grid.group_count},
            {"bricks", grid.brick_count},
            {"solid_voxels", grid.solid_count},
            {"faces", grid.face_count},
            {"bytes", summary.bytes},
            {"bytes_stored", summary.stored_bytes}};
}

Json receiversJson(const PackView& pack)
{
    const ReceiverTables tables = pack.receivers();
    const ReceiverBytes sum = sumReceiverBytes(pack, kReceiverChunks);
    const ReceiverBytes face_sum = sumReceiverBytes(pack, kFaceReceiverChunks);
    const auto lamp = [&](uint32_t i) -> Json
    {
        const ReceiverLampSummary summary = summarizeLamp(pack, tables.lamps[i]);
        return {{"kind", summary.kind}, {"index", tables.lamps[i].index}, {"name", summary.name}};
    };
    const auto rectangle = [&](uint32_t i) -> Json
    {
        const ReceiverRectRecord& rect = tables.rects[i];
        return {{"instance", rect.instance},
                {"name", readInstanceName(pack, rect.instance)},
                {"x", rect.x},
                {"y", rect.y},
                {"width", rect.width},
                {"height", rect.height},
                {"uv_set", rect.uv_set}};
    };
    return {{"width", tables.atlas.width},
            {"height", tables.atlas.height},
            {"codec", receiverCodecName(tables.atlas.codec)},
            {"scale", tables.atlas.scale},
            {"texels", tables.atlas.texel_count},
            {"bytes", sum.bytes},
            {"bytes_stored", sum.stored_bytes},
            {"faces",
             {{"count", pack.faceReceivers().atlas.texel_count},
              {"bytes", face_sum.bytes},
              {"bytes_stored", face_sum.stored_bytes}}},
            {"lamps", listJson(tables.lamps.size(), lamp)},
            {"rectangles", listJson(tables.rects.size(), rectangle)}};
}

/// Return a distance of a proxy, or null where it is unknown.
Json distanceJson(float distance)
{
    return std::isfinite(distance) ? Json(distance) : Json();
}

Json proxyJson(const PackView& pack, uint32_t index)
{
    const ProxyRecord& proxy = pack.proxies()[index];
    const auto sections = recordsInRange(pack.proxySections(), proxy.sections);
    const auto section = [&](uint32_t i) -> Json
    {
        const uint32_t material = sections[i].material;
        return {{"triangles", sections[i].triangles.count},
                {"material", material == kInvalidIndex ? Json() : Json(material)},
                {"convex", sections[i].is_convex != 0}};
    };
    return {{"mesh", proxy.mesh},
            {"origin", proxyOriginName(proxy.origin)},
            {"triangles", proxy.indices.count / 3},
            {"vertices", proxy.positions.count},
            {"closed", proxy.is_closed != 0},
            {"distance", distanceJson(proxy.distance)},
            {"mesh_distance", distanceJson(proxy.mesh_distance)},
            {"bindings", proxy.bindings.count},
            {"sections", listJson(sections.size(), section)}};
}

Json totalsJson(const PackView& pack, const PackSummary& summary)
{
    MeshSummary total;
    uint64_t levels = 0;
    uint64_t degenerate = 0;
    for (const MeshSummary& mesh : summary.meshes)
    {
        levels += mesh.levels.size();
        degenerate += mesh.degenerate_triangles;
        total.vertex_bytes += mesh.vertex_bytes;
        total.index_bytes += mesh.index_bytes;
        total.page_bytes += mesh.page_bytes;
        total.stored_page_bytes += mesh.stored_page_bytes;
        total.record_bytes += mesh.record_bytes;
        total.bounds_bytes += mesh.bounds_bytes;
    }
    uint64_t image_bytes = 0, image_gpu_bytes = 0;
    for (const ChunkEntry& entry : pack.container().chunks())
        if (entry.type == kChunkImageData)
        {
            image_bytes += entry.stored_size;
            image_gpu_bytes += entry.size;
        }
    return {{"source", summary.meta.counts},
            {"texture_budget_bytes",
             summary.meta.texture_budget == 0 ? Json() : Json(summary.meta.texture_budget)},
            {"meshes", pack.meshes().size()},
            {"levels", levels},
            {"texture_gpu_bytes", image_gpu_bytes},
            {"groups", pack.groups().size()},
            {"clusters", pack.clusters().size()},
            {"pages", pack.pages().size()},
            {"degenerate_triangles", degenerate},
            {"bytes",
             {{"file", pack.container().header().file_size},
              {"vertices", total.vertex_bytes},
              {"indices", total.index_bytes},
              {"pages", total.page_bytes},
              {"pages_stored", total.stored_page_bytes},
              {"records", total.record_bytes},
              {"bounds", total.bounds_bytes},
              {"images_stored", image_bytes}}}};
}

Json messagesJson(const std::vector<MessageSummary>& messages)
{
    Json list = Json::array();
    for (const MessageSummary& message : messages)
        list.push_back({{"source", message.source},
                        {"code", message.code},
                        {"pointer", message.where},
                        {"text", message.text}});
    return list;
}

} // namespace

std::string inspectJson(const PackView& pack, const PackSummary& summary)
{
    const FileHeader& header = pack.container().header();
    Json json{{"schema", "hearth.inspect/1"},
              {"file", pack.name()},
              {"kind", pack.container().kind() == ContainerKind::pack ? "pack" : "part"},
              {"format", {{"major", header.version_major}, {"minor", header.version_minor}}},
              {"tool_version", summary.meta.tool_version},
              {"sources", Json::array()},
              {"totals", totalsJson(pack, summary)},
              {"meshes", Json::array()}};
    for (const SourceSummary& source : summary.meta.sources)
        json["sources"].push_back({{"name", source.name}, {"bytes", source.bytes}, {"xxh3", source.hash}});
    json["assets"] = listJson(pack.assets().size(), [&](uint32_t i) { return assetJson(pack, i); });
    for (uint32_t i = 0; i < summary.meshes.size(); ++i)
        json["meshes"].push_back(meshJson(summary.meshes[i], i));
    json["scene"] = sceneJson(pack, summary);
    if (!pack.brickGrid().empty())
        json["bricks"] = bricksJson(pack);
    if (!pack.receivers().lamps.empty())
        json["receivers"] = receiversJson(pack);
    if (!pack.proxies().empty())
        json["proxies"] = listJson(pack.proxies().size(), [&](uint32_t i) { return proxyJson(pack, i); });
    json["chunks"] = chunksJson(pack);
    json["messages"] = messagesJson(summary.meta.messages);
    json["skipped"] = messagesJson(summary.meta.skipped);
    json["dropped"] = summary.meta.dropped;
    return json.dump(2) + "\n";
}

} // namespace hearth::command
