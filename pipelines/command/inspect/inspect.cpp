// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/inspect.h"

#include "cook/json/json.h"

#include <algorithm>
#include <set>

namespace hearth::command
{

using namespace formats;

namespace
{

LevelSummary summarizeLevel(const PackView& pack, const LevelRecord& level)
{
    LevelSummary summary;
    summary.clusters = level.clusters.count;
    summary.triangles = level.triangle_count;
    summary.max_error = level.max_error;
    for (const ClusterRecord& cluster : recordsInRange(pack.clusters(), level.clusters))
    {
        // no group, or an invalid index in a part, whose records are not checked
        if (cluster.refined_group >= pack.groups().size())
            continue;
        const GroupRecord& group = pack.groups()[cluster.refined_group];
        summary.position_error = std::max(summary.position_error, group.position_error);
        summary.normal_error = std::max(summary.normal_error, group.normal_error);
        summary.uv_error = std::max(summary.uv_error, group.uv_error);
    }
    return summary;
}

void addAuthoredLevels(const PackView& pack, uint32_t mesh, std::span<LevelSummary> levels)
{
    for (const AuthoredLevelRecord& record : pack.authoredLevels())
        if (record.mesh == mesh && record.level < levels.size())
        {
            AuthoredSummary& authored = levels[record.level].authored.emplace();
            authored.name = pack.text(record.name);
            if (record.number != kInvalidIndex)
                authored.number = record.number;
        }
}

void addClusters(MeshSummary& summary, std::span<const ClusterRecord> clusters)
{
    for (const ClusterRecord& cluster : clusters)
    {
        const uint32_t layout = clusterVertexLayout(cluster, summary.attributes);
        const uint64_t vertex_bytes = clusterBytes(layout, cluster.vertex_count, 0);
        summary.triangles += cluster.triangle_count;
        summary.vertices += cluster.vertex_count;
        summary.vertex_bytes += vertex_bytes;
        summary.index_bytes +=
            clusterBytes(layout, cluster.vertex_count, cluster.triangle_count) - vertex_bytes;
    }
}

void addPages(MeshSummary& summary, std::span<const PageRecord> pages)
{
    for (const PageRecord& page : pages)
    {
        summary.page_bytes += page.size;
        summary.stored_page_bytes += page.stored_size;
        summary.record_bytes += sizeof(PageRecord) + page.parents.count * sizeof(uint32_t);
    }
}

/// Return the bytes of the mesh's bounds under deformation; 0 if it is rigid, or in a part whose bounds are
/// not computed yet (bounds come last).
uint64_t boundsBytes(const PackView& pack, uint32_t mesh)
{
    uint64_t bytes = 0;
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
        if (record.mesh == mesh)
        {
            bytes += sizeof(DeformedMeshRecord);
            for (const DeformedClusterRecord& cluster :
                 recordsInRange(pack.deformedClusters(), record.clusters))
                bytes += sizeof(cluster) + cluster.joints.count * sizeof(uint32_t);
        }
    return bytes;
}

MeshSummary summarizeMesh(const PackView& pack, uint32_t index)
{
    const MeshRecord& mesh = pack.meshes()[index];
    MeshSummary summary;
    summary.name = pack.text(mesh.name);
    summary.attributes = mesh.attributes;
    summary.source_triangles = mesh.source_triangles;
    summary.source_vertices = mesh.source_vertices;
    summary.source_faces = mesh.source_faces;
    summary.degenerate_triangles = mesh.degenerate_triangles;
    summary.morph_targets = mesh.morph_target_count;
    summary.skinned = mesh.skinned != 0;
    summary.box_min = mesh.box_min;
    summary.box_max = mesh.box_max;
    summary.groups = mesh.groups.count;
    summary.clusters = mesh.clusters.count;
    summary.pages = mesh.pages.count;
    for (const LevelRecord& level : recordsInRange(pack.levels(), mesh.levels))
        summary.levels.push_back(summarizeLevel(pack, level));
    addAuthoredLevels(pack, index, summary.levels);
    summary.record_bytes = sizeof(MeshRecord) + mesh.levels.count * sizeof(LevelRecord) +
                           mesh.groups.count * sizeof(GroupRecord) +
                           mesh.clusters.count * sizeof(ClusterRecord);
    addClusters(summary, recordsInRange(pack.clusters(), mesh.clusters));
    addPages(summary, recordsInRange(pack.pages(), mesh.pages));
    summary.bounds_bytes = boundsBytes(pack, index);
    return summary;
}

uint32_t countJointNodes(const PackView& pack)
{
    std::set<uint32_t> nodes;
    for (const JointRecord& joint : pack.joints())
        nodes.insert(joint.node);
    return static_cast<uint32_t>(nodes.size());
}

uint64_t countInstancedTriangles(const PackView& pack, std::span<const MeshSummary> meshes)
{
    uint64_t triangles = 0;
    for (const InstanceRecord& instance : pack.instances())
        if (instance.mesh < meshes.size() && !meshes[instance.mesh].levels.empty())
            triangles += meshes[instance.mesh].levels.front().triangles;
    return triangles;
}

std::string readString(const Json& object, const char* key)
{
    const Json* found = object.find(key);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

uint64_t readCount(const Json& object, const char* key)
{
    const Json* found = object.find(key);
    return found != nullptr && found->is_number_unsigned() ? found->get<uint64_t>() : 0;
}

double readNumber(const Json& object, const char* key)
{
    const Json* found = object.find(key);
    return found != nullptr && found->is_number() ? found->get<double>() : 0;
}

/// Return the objects in the array at `key`.
std::vector<Json> readObjects(const Json& object, const char* key)
{
    std::vector<Json> objects;
    const Json* found = object.find(key);
    if (found != nullptr && found->is_array())
        for (const Json& item : *found)
            if (item.is_object())
                objects.push_back(item);
    return objects;
}

std::vector<MessageSummary> readMessages(const Json& object, const char* key)
{
    std::vector<MessageSummary> messages;
    for (const Json& message : readObjects(object, key))
        messages.push_back({readString(message, "source"), readString(message, "code"),
                            readString(message, "pointer"), readString(message, "text")});
    return messages;
}

} // namespace

MetaSummary readMeta(std::string_view json)
{
    MetaSummary meta;
    const Json root = Json::parse(json).value_or(Json());
    if (!root.is_object())
        return meta;
    if (const Json* tool = root.find("tool"); tool != nullptr && tool->is_object())
        meta.tool_version = readString(*tool, "version");
    for (const Json& source : readObjects(root, "sources"))
        meta.sources.push_back(
            {readString(source, "name"), readCount(source, "bytes"), readString(source, "xxh3")});
    if (const Json* counts = root.find("counts"); counts != nullptr && counts->is_object())
        for (const auto& [key, value] : counts->items())
            if (value.is_number_unsigned())
                meta.counts[key] = value.get<uint64_t>();
    for (const Json& clip : readObjects(root, "clips"))
        meta.clips.push_back({readCount(clip, "keys_before"), readCount(clip, "keys"),
                              readCount(clip, "bytes_before"), readCount(clip, "bytes"),
                              readNumber(clip, "stated_error"), readNumber(clip, "proven_error")});
    if (const Json* settings = root.find("settings"); settings != nullptr && settings->is_object())
    {
        meta.texture_budget = readCount(*settings, "texture_budget");
        if (const Json* bricks = settings->find("bricks"); bricks != nullptr && bricks->is_object())
            meta.no_bricks = readString(*bricks, "none");
        if (const Json* receivers = settings->find("receivers");
            receivers != nullptr && receivers->is_object())
            meta.no_receivers = readString(*receivers, "none");
    }
    meta.messages = readMessages(root, "messages");
    meta.skipped = readMessages(root, "skipped");
    if (const Json* dropped = root.find("dropped"); dropped != nullptr && dropped->is_array())
        for (const Json& item : *dropped)
            if (item.is_string())
                meta.dropped.push_back(item.get<std::string>());
    return meta;
}

BricksSummary summarizeBricks(const PackView& pack)
{
    BricksSummary summary;
    for (const ChunkEntry& entry : pack.container().chunks())
        if (isBrickChunk(entry.type))
        {
            summary.bytes += entry.size;
            summary.stored_bytes += entry.stored_size;
        }
    return summary;
}

std::string_view readInstanceName(const PackView& pack, uint32_t instance)
{
    if (instance >= pack.instances().size() || pack.instances()[instance].node >= pack.nodes().size())
        return {};
    return pack.text(pack.nodes()[pack.instances()[instance].node].name);
}

ReceiverLampSummary summarizeLamp(const PackView& pack, const ReceiverLampRecord& lamp)
{
    switch (static_cast<ReceiverLampKind>(lamp.kind))
    {
    case ReceiverLampKind::light:
        return {"light", lamp.index < pack.lights().size()
                             ? std::string(pack.text(pack.lights()[lamp.index].name))
                             : std::string()};
    case ReceiverLampKind::mesh_light:
        return {"instance", std::string(readInstanceName(pack, lamp.index))};
    default:
        return {"steady", ""};
    }
}

ReceiverBytes sumReceiverBytes(const PackView& pack, std::span<const uint32_t> chunks)
{
    ReceiverBytes sum;
    for (const ChunkEntry& entry : pack.container().chunks())
        if (std::ranges::find(chunks, entry.type) != chunks.end())
        {
            sum.bytes += entry.size;
            sum.stored_bytes += entry.stored_size;
        }
    return sum;
}

const char* receiverCodecName(uint32_t codec)
{
    return codec == static_cast<uint32_t>(ReceiverCodec::rgbm) ? "rgbm" : "rgb9e5";
}

const char* proxyOriginName(uint32_t origin)
{
    return origin < kProxyOriginNames.size() ? kProxyOriginNames[origin].data() : "unknown";
}

PackSummary summarize(const PackView& pack)
{
    PackSummary summary;
    summary.meta = readMeta(pack.meta());
    for (uint32_t i = 0; i < pack.meshes().size(); ++i)
        summary.meshes.push_back(summarizeMesh(pack, i));
    for (const MeshSummary& mesh : summary.meshes)
        summary.morph_targets += mesh.morph_targets;
    summary.joint_nodes = countJointNodes(pack);
    summary.instanced_triangles = countInstancedTriangles(pack, summary.meshes);
    return summary;
}

std::string attributeNames(uint32_t attributes)
{
    const struct
    {
        uint32_t bit;
        const char* name;
    } kNames[] = {{kVertexNormal, "normal"}, {kVertexTangent, "tangent"},
                  {kVertexUv0, "uv0"},       {kVertexUv1, "uv1"},
                  {kVertexUv2, "uv2"},       {kVertexUv3, "uv3"},
                  {kVertexColor, "color"},   {kVertexVisibility, "visibility"}};
    std::string names = "position";
    for (const auto& attribute : kNames)
        if ((attributes & attribute.bit) != 0)
            names += std::string(" ") + attribute.name;
    return names;
}

const char* alphaModeName(uint32_t mode)
{
    switch (static_cast<AlphaMode>(mode))
    {
    case AlphaMode::opaque:
        return "opaque";
    case AlphaMode::mask:
        return "mask";
    case AlphaMode::blend:
        return "blend";
    }
    return "unknown";
}

std::string_view extrasOwnerName(uint32_t owner)
{
    return owner < kExtrasOwnerNames.size() ? kExtrasOwnerNames[owner] : "unknown";
}

std::string_view readOwnerName(const PackView& pack, const ExtrasRecord& extras)
{
    const auto name = [&](const auto& records)
    { return extras.index < records.size() ? pack.text(records[extras.index].name) : std::string_view(); };
    switch (static_cast<ExtrasOwner>(extras.owner))
    {
    case ExtrasOwner::node:
        return name(pack.nodes());
    case ExtrasOwner::mesh:
        return name(pack.meshes());
    case ExtrasOwner::material:
        return name(pack.materials());
    case ExtrasOwner::camera:
        return name(pack.cameras());
    case ExtrasOwner::light:
        return name(pack.lights());
    case ExtrasOwner::skin:
        return name(pack.skins());
    case ExtrasOwner::animation:
        return name(pack.animations());
    case ExtrasOwner::asset:
    case ExtrasOwner::scene:
    case ExtrasOwner::file:
        break;
    }
    return name(pack.assets());
}

const char* lightTypeName(uint32_t type)
{
    switch (static_cast<LightType>(type))
    {
    case LightType::directional:
        return "directional";
    case LightType::point:
        return "point";
    case LightType::spot:
        return "spot";
    }
    return "unknown";
}

const char* codecName(uint32_t codec)
{
    switch (static_cast<Codec>(codec))
    {
    case Codec::none:
        return "none";
    case Codec::zstd:
        return "zstd";
    case Codec::zstd_frames:
        return "zstd frames";
    }
    return "unknown";
}

} // namespace hearth::command
