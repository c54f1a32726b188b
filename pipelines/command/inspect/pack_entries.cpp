// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/pack_entries.h"

#include "cook/json/json.h"
#include "cook/tools/sha256.h"
#include "formats/codecs/channel_keys.h"
#include "formats/pack/image_error.h"
#include "formats/pack/image_uses.h"
#include "formats/records/animation_paths.h"
#include "formats/records/texel_format.h"
#include "pipelines/command/extract/extract_texture.h"
#include "pipelines/command/inspect/inspect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <utility>

namespace hearth::command
{

using namespace formats;

namespace
{

// ---- values

/// Return the first twelve digits of the SHA-256, which tell contents apart.
std::string contentHash(std::string_view bytes)
{
    return tools::computeSha256(bytes).substr(0, 12);
}

template <typename T>
std::string_view rawBytes(const T& value)
{
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

template <typename T>
std::string_view rawBytes(std::span<const T> values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <typename T>
std::string numbersText(const std::byte* bytes, size_t size)
{
    std::vector<T> numbers(size / sizeof(T));
    std::memcpy(numbers.data(), bytes, size);
    return numbers.size() == 1 ? fmt::format("{}", numbers[0])
                               : fmt::format("({})", fmt::join(numbers, ", "));
}

/// Return the name of a referenced record. Records without a name are not told apart, because an index
/// depends on the table.
template <typename Record>
std::string recordName(const PackView& pack, std::span<const Record> table, uint32_t index)
{
    if (index >= table.size())
        return "none";
    const std::string_view name = pack.text(table[index].name);
    return name.empty() ? "unnamed" : std::string(name);
}

/// Return the name of the record or enumerator that a field refers to; nullopt for other fields.
std::optional<std::string> referenceText(const PackView& pack, const Field& field, uint32_t value)
{
    if (field.name == "image")
        return recordName(pack, pack.images(), value);
    if (field.name == "mesh")
        return recordName(pack, pack.meshes(), value);
    if (field.name == "node" || field.name == "skeleton_root")
        return recordName(pack, pack.nodes(), value);
    if (field.name == "light")
        return recordName(pack, pack.lights(), value);
    if (field.name == "material")
        return recordName(pack, pack.materials(), value);
    if (field.name == "format")
        return std::string(texelFormatName(value));
    if (field.name == "alpha_mode")
        return alphaModeName(value);
    return std::nullopt;
}

// Longer fields are tables, compared by their hash.
constexpr size_t kMaxFieldText_bytes = 256;

std::string fieldText(const PackView& pack, const Field& field, const std::byte* bytes)
{
    if (field.size > kMaxFieldText_bytes)
        return contentHash({reinterpret_cast<const char*>(bytes), field.size});
    if (field.type.starts_with("f32"))
        return numbersText<float>(bytes, field.size);
    if (field.type.starts_with("u8"))
        return numbersText<uint8_t>(bytes, field.size);
    if (field.type == "u32")
    {
        uint32_t value = 0;
        std::memcpy(&value, bytes, sizeof(value));
        if (auto reference = referenceText(pack, field, value))
            return *reference;
    }
    return numbersText<uint32_t>(bytes, field.size);
}

/// Add a property for each field of a record, except its name and references to other tables.
template <typename Record>
void addFieldProperties(std::vector<Property>& properties, const PackView& pack, const Record& record,
                        const std::string& prefix = "")
{
    for (const Field& field : RecordFields<Record>::value)
    {
        const std::byte* bytes = reinterpret_cast<const std::byte*>(&record) + field.offset;
        if (field.name == "reserved" || field.type == StringRef::kTypeName || field.type == Range::kTypeName)
            continue;
        if constexpr (!std::is_same_v<Record, TextureRef>)
            if (field.type == TextureRef::kTypeName)
            {
                TextureRef texture;
                std::memcpy(&texture, bytes, sizeof(texture));
                if (texture.image == kInvalidIndex)
                    properties.push_back({std::string(field.name), "none"});
                else
                    addFieldProperties(properties, pack, texture, std::string(field.name) + ".");
                continue;
            }
        properties.push_back({prefix + std::string(field.name), fieldText(pack, field, bytes),
                              field.size > kMaxFieldText_bytes});
    }
}

template <typename Record>
void addTableEntries(std::vector<PackEntry>& entries, const PackView& pack, const char* kind,
                     std::span<const Record> table)
{
    for (const Record& record : table)
    {
        entries.push_back({kind, std::string(pack.text(record.name)), {}});
        addFieldProperties(entries.back().properties, pack, record);
    }
}

// ---- meshes

constexpr uint32_t relativeIndex(uint32_t index, Range range)
{
    return index == kInvalidIndex ? kInvalidIndex : index - range.first;
}

/// Hash groups and clusters with mesh-local indices, as if the mesh were alone in its pack.
std::string hierarchyHash(const PackView& pack, const MeshRecord& mesh)
{
    std::string bytes;
    for (GroupRecord group : recordsInRange(pack.groups(), mesh.groups))
    {
        group.clusters.first = relativeIndex(group.clusters.first, mesh.clusters);
        group.page = relativeIndex(group.page, mesh.pages);
        bytes += rawBytes(group);
    }
    for (ClusterRecord cluster : recordsInRange(pack.clusters(), mesh.clusters))
    {
        cluster.material = 0;
        cluster.group = relativeIndex(cluster.group, mesh.groups);
        cluster.refined_group = relativeIndex(cluster.refined_group, mesh.groups);
        cluster.page = relativeIndex(cluster.page, mesh.pages);
        bytes += rawBytes(cluster);
    }
    return contentHash(bytes);
}

std::string materialsText(const PackView& pack, const MeshRecord& mesh)
{
    std::set<std::string> names;
    for (const ClusterRecord& cluster : recordsInRange(pack.clusters(), mesh.clusters))
        names.insert(recordName(pack, pack.materials(), cluster.material));
    return fmt::format("{}", fmt::join(names, ", "));
}

Result<std::string> geometryHash(const PackView& pack, const MeshRecord& mesh)
{
    std::string hashes;
    for (uint32_t page = mesh.pages.first; page < mesh.pages.first + mesh.pages.count; ++page)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> decoded, pack.decodePage(page));
        hashes += tools::computeSha256(decoded);
    }
    return contentHash(hashes);
}

/// Hash the bounds of the mesh over all poses; empty if it is rigid.
std::string boundsHash(const PackView& pack, uint32_t mesh)
{
    std::string bytes;
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
        for (DeformedClusterRecord cluster : record.mesh == mesh
                                                 ? recordsInRange(pack.deformedClusters(), record.clusters)
                                                 : std::span<const DeformedClusterRecord>())
        {
            const auto joints = recordsInRange(pack.clusterJoints(), cluster.joints);
            cluster.joints.first = 0;
            bytes += rawBytes(cluster);
            bytes += rawBytes(joints);
        }
    return bytes.empty() ? "" : contentHash(bytes);
}

Result<PackEntry> makeMeshEntry(const PackView& pack, uint32_t index, const MeshSummary& summary)
{
    const MeshRecord& mesh = pack.meshes()[index];
    PackEntry entry{"mesh", summary.name, {}};
    const auto add = [&](const std::string& name, const std::string& value) {
        entry.properties.push_back({name, value});
    };
    add("source triangles", std::to_string(summary.source_triangles));
    add("source vertices", std::to_string(summary.source_vertices));
    add("attributes", attributeNames(summary.attributes));
    add("box", fmt::format("({}, {}, {}) to ({}, {}, {})", mesh.box_min.x, mesh.box_min.y, mesh.box_min.z,
                           mesh.box_max.x, mesh.box_max.y, mesh.box_max.z));
    add("skinned", summary.skinned ? "yes" : "no");
    add("morph targets", std::to_string(summary.morph_targets));
    add("materials", materialsText(pack, mesh));
    add("levels", std::to_string(summary.levels.size()));
    for (size_t i = 0; i < summary.levels.size(); ++i)
        add(fmt::format("level {}", i),
            fmt::format("{} triangles, {} clusters, error {}", summary.levels[i].triangles,
                        summary.levels[i].clusters, summary.levels[i].max_error));
    add("groups", std::to_string(summary.groups));
    add("clusters", std::to_string(summary.clusters));
    add("stored bytes", std::to_string(summary.stored_page_bytes));
    entry.properties.push_back({"hierarchy", hierarchyHash(pack, mesh), true});
    HEARTH_ASSIGN_OR_RETURN(const std::string geometry, geometryHash(pack, mesh));
    entry.properties.push_back({"geometry", geometry, true});
    entry.properties.push_back({"bounds in motion", boundsHash(pack, index), true});
    return entry;
}

// ---- the scene

/// List the uses of an image: "baseColor of Bark, normal of Bark and 3 more".
std::string usesText(const PackView& pack, const std::vector<ImageUse>& uses)
{
    constexpr size_t kMaxUses = 2;
    std::string text;
    for (size_t i = 0; i < std::min(uses.size(), kMaxUses); ++i)
        text += fmt::format("{}{} of {}", i == 0 ? "" : ", ", uses[i].role,
                            recordName(pack, pack.materials(), uses[i].material));
    return uses.size() <= kMaxUses ? text : text + fmt::format(" and {} more", uses.size() - kMaxUses);
}

/// Express the role of an image, its swizzle and its errors as people do: "normal", "raba", "2.10 degrees
/// (target 3.00)".
void expressEncoding(const ImageRecord& image, std::vector<Property>& properties)
{
    const auto role = static_cast<ImageRole>(image.role);
    const std::pair<std::string_view, std::string> texts[] = {
        {"role", std::string(imageRoleName(image.role))},
        {"swizzle", swizzleText(image)},
        {"error", imageErrorText(role, double{image.error}, double{image.target})},
        {"error_p999", imageErrorText(role, double{image.error_p999})},
        {"error_smooth",
         image.error_smooth == 0 // there may be no smooth areas
             ? imageErrorText(role, 0)
             : imageErrorText(role, double{image.error_smooth}, double{image.target_smooth})}};
    std::erase_if(properties, [](const Property& property) { return property.name.starts_with("target"); });
    for (Property& property : properties)
        for (const auto& [name, text] : texts)
            if (property.name == name)
                property.value = text;
}

Result<PackEntry> makeTextureEntry(const PackView& pack, uint32_t index, const std::vector<ImageUse>& uses)
{
    PackEntry entry{"texture", std::string(pack.text(pack.images()[index].name)), {}, usesText(pack, uses)};
    const ImageRecord& image = pack.images()[index];
    addFieldProperties(entry.properties, pack, image);
    expressEncoding(image, entry.properties);
    HEARTH_ASSIGN_OR_RETURN(const ChunkData texels, pack.imageData(index));
    entry.properties.push_back({"bytes on the GPU", std::to_string(mipOffset(image, image.mip_count))});
    entry.properties.push_back({"texels", contentHash(rawBytes(texels.bytes())), true});
    return entry;
}

/// Hash the decoded keys of a channel.
std::string keysHash(const PackView& pack, const AnimationChannelRecord& channel)
{
    const ChannelKeys keys(pack.keys(), pack.keyBits(), channel);
    std::string bytes;
    for (uint32_t key = 0; key < keys.count(); ++key)
    {
        const float time = keys.time(key);
        bytes += rawBytes(time);
        for (uint32_t first = 0; first < channel.components; first += 4)
        {
            const uint32_t count = std::min(channel.components - first, 4u);
            bytes += rawBytes(keys.value(key, first, count));
            if (keys.interpolation() != Interpolation::cubic_spline)
                continue;
            bytes += rawBytes(keys.inTangent(key, first, count));
            bytes += rawBytes(keys.outTangent(key, first, count));
        }
    }
    return contentHash(bytes);
}

/// Name a channel: "rotation of arm", "intensity of light torch".
std::string channelName(const PackView& pack, const AnimationChannelRecord& channel)
{
    const AnimationPathInfo& path = kAnimationPaths[channel.path];
    return path.of_light
               ? fmt::format("{} of light {}", path.name, recordName(pack, pack.lights(), channel.target))
               : fmt::format("{} of {}", path.name, recordName(pack, pack.nodes(), channel.target));
}

PackEntry makeAnimationEntry(const PackView& pack, const AnimationRecord& animation)
{
    PackEntry entry{"animation", std::string(pack.text(animation.name)), {}};
    addFieldProperties(entry.properties, pack, animation);
    for (const Range channels : {animation.channels, animation.light_channels})
        for (const AnimationChannelRecord& channel : recordsInRange(pack.channels(), channels))
        {
            const std::string name = channelName(pack, channel);
            entry.properties.push_back(
                {name, fmt::format("{} keys, interpolation {}", channel.key_count, channel.interpolation)});
            entry.properties.push_back({"keys of " + name, keysHash(pack, channel), true});
        }
    return entry;
}

PackEntry makeSkinEntry(const PackView& pack, const SkinRecord& skin)
{
    PackEntry entry{"skin", std::string(pack.text(skin.name)), {}};
    addFieldProperties(entry.properties, pack, skin);
    const auto joints = recordsInRange(pack.joints(), skin.joints);
    entry.properties.push_back({"joints", std::to_string(joints.size())});
    std::string bytes;
    for (const JointRecord& joint : joints)
    {
        bytes += recordName(pack, pack.nodes(), joint.node) + '\n';
        bytes += rawBytes(joint.joint_from_bind);
    }
    entry.properties.push_back({"bind pose", contentHash(bytes), true});
    return entry;
}

/// Add entries for records without a name, named after their node.
template <typename Record>
void addNodeEntries(std::vector<PackEntry>& entries, const PackView& pack, const char* kind,
                    std::span<const Record> table)
{
    for (const Record& record : table)
    {
        entries.push_back({kind, recordName(pack, pack.nodes(), record.node), {}});
        addFieldProperties(entries.back().properties, pack, record);
    }
}

void addExtrasEntries(std::vector<PackEntry>& entries, const PackView& pack)
{
    for (const ExtrasRecord& record : pack.extras())
    {
        const std::string_view json = pack.text(record.json);
        const bool is_long = json.size() > kMaxFieldText_bytes;
        entries.push_back({"extras",
                           fmt::format("{} {}", extrasOwnerName(record.owner), readOwnerName(pack, record)),
                           {{"json", is_long ? contentHash(json) : std::string(json), is_long}}});
    }
}

void addProxyEntries(std::vector<PackEntry>& entries, const PackView& pack)
{
    for (const ProxyRecord& proxy : pack.proxies())
    {
        // the mesh of a part is in another one
        PackEntry entry{"proxy",
                        proxy.mesh < pack.meshes().size()
                            ? std::string(pack.text(pack.meshes()[proxy.mesh].name))
                            : fmt::format("{}", proxy.mesh),
                        {{"origin", proxyOriginName(proxy.origin)},
                         {"triangles", std::to_string(proxy.indices.count / 3)},
                         {"closed", proxy.is_closed != 0 ? "yes" : "no"},
                         {"distance", std::to_string(proxy.distance)},
                         {"distance of the mesh", std::to_string(proxy.mesh_distance)}}};
        const auto add = [&](const char* name, std::string_view bytes) {
            entry.properties.push_back({name, contentHash(bytes), true});
        };
        add("positions", rawBytes(recordsInRange(pack.proxyPositions(), proxy.positions)));
        add("indices", rawBytes(recordsInRange(pack.proxyIndices(), proxy.indices)));
        add("sections", rawBytes(recordsInRange(pack.proxySections(), proxy.sections)));
        add("bindings", rawBytes(recordsInRange(pack.proxyBindings(), proxy.bindings)));
        entries.push_back(std::move(entry));
    }
}

void addLightEntries(std::vector<PackEntry>& entries, const PackView& pack)
{
    for (const SpecularTableRecord& table : pack.specularTables())
    {
        entries.push_back({"specular table", "", {}});
        addFieldProperties(entries.back().properties, pack, table);
    }
    for (const ProbeRecord& probe : pack.probes())
    {
        entries.push_back({"probe", "", {}});
        addFieldProperties(entries.back().properties, pack, probe);
        const auto texels = pack.probeTexels().subspan(probe.texels.first, probe.texels.count);
        entries.back().properties.push_back({"texels", contentHash(rawBytes(texels)), true});
    }
    if (!pack.surroundings().empty())
        entries.push_back({"surroundings",
                           "",
                           {{"instances", contentHash(rawBytes(pack.surroundings())), true},
                            {"radiance transfers", contentHash(rawBytes(pack.radianceTransfers())), true}}});
    for (const BrickGridRecord& grid : pack.brickGrid())
    {
        entries.push_back({"bricks", "", {}});
        addFieldProperties(entries.back().properties, pack, grid);
        const auto add = [&](const char* name, std::string_view bytes) {
            entries.back().properties.push_back({name, contentHash(bytes), true});
        };
        add("masks",
            std::string(rawBytes(pack.brickGroupsAlongAxis())) + std::string(rawBytes(pack.bricks())));
        add("opacity", rawBytes(pack.brickOpacity()));
        add("albedo", rawBytes(pack.brickAlbedo()));
        add("normals", rawBytes(pack.brickNormals()));
        add("emission", rawBytes(pack.brickEmission()));
        add("lighting", rawBytes(pack.brickLighting()));
        add("reflectors", rawBytes(pack.reflectors()));
    }
}

/// Add the receivers: one entry, with their lamps by name.
void addReceiverEntry(std::vector<PackEntry>& entries, const PackView& pack)
{
    if (pack.receivers().lamps.empty())
        return;
    const ReceiverTables tables = pack.receivers(), faces = pack.faceReceivers();
    PackEntry entry{"receivers", "", {}};
    addFieldProperties(entry.properties, pack, tables.atlas);
    for (size_t i = 0; i < tables.lamps.size(); ++i)
    {
        const ReceiverLampSummary lamp = summarizeLamp(pack, tables.lamps[i]);
        entry.properties.push_back(
            {fmt::format("lamp {}", i), lamp.name.empty() ? lamp.kind : lamp.kind + (" " + lamp.name)});
    }
    for (const ReceiverRectRecord& rect : tables.rects)
        entry.properties.push_back({fmt::format("rectangle of {}", readInstanceName(pack, rect.instance)),
                                    fmt::format("{} x {} at ({}, {}), UV set {}", rect.width, rect.height,
                                                rect.x, rect.y, rect.uv_set)});
    entry.properties.push_back(
        {"light", contentHash(std::string(rawBytes(tables.blocks)) + std::string(rawBytes(tables.words))),
         true});
    entry.properties.push_back(
        {"light of faces",
         contentHash(std::string(rawBytes(faces.blocks)) + std::string(rawBytes(faces.words))), true});
    entries.push_back(std::move(entry));
}

void addMetaEntries(std::vector<PackEntry>& entries, const MetaSummary& meta)
{
    for (const SourceSummary& source : meta.sources)
        entries.push_back(
            {"source", source.name, {{"bytes", std::to_string(source.bytes)}, {"xxh3", source.hash, true}}});
    for (const MessageSummary& message : meta.messages)
        entries.push_back(
            {"message", message.source + message.where, {{"code", message.code}, {"text", message.text}}});
    for (const std::string& dropped : meta.dropped)
        entries.push_back({"dropped", dropped, {}});
    for (const MessageSummary& failure : meta.skipped)
        entries.push_back(
            {"skipped", failure.source + failure.where, {{"code", failure.code}, {"text", failure.text}}});
}

/// Add a property for each leaf value, named by its JSON pointer.
void addSettings(std::vector<Property>& settings, const Json& json, const std::string& pointer)
{
    if (json.empty())
        settings.push_back({pointer, json.is_array() || json.is_object() ? "null" : json.dump()});
    for (size_t i = 0; json.is_array() && i < json.size(); ++i)
        addSettings(settings, json[i], pointer + "/" + std::to_string(i));
    if (json.is_object())
        for (const auto& [key, value] : json.items())
            addSettings(settings, value, pointer + pointerStep(key));
}

} // namespace

Result<std::vector<PackEntry>> listEntries(const PackView& pack)
{
    std::vector<PackEntry> entries;
    const PackSummary summary = summarize(pack);
    for (uint32_t i = 0; i < pack.meshes().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(PackEntry mesh, makeMeshEntry(pack, i, summary.meshes[i]));
        entries.push_back(std::move(mesh));
    }
    addTableEntries(entries, pack, "material", pack.materials());
    for (const MaterialLayersRecord& layers : pack.materialLayers())
    {
        entries.push_back({"layers of material", recordName(pack, pack.materials(), layers.material), {}});
        addFieldProperties(entries.back().properties, pack, layers);
    }
    const auto uses = imageUses(pack.materials(), pack.materialLayers(), pack.images().size());
    for (uint32_t i = 0; i < pack.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(PackEntry texture, makeTextureEntry(pack, i, uses[i]));
        entries.push_back(std::move(texture));
    }
    for (const AnimationRecord& animation : pack.animations())
        entries.push_back(makeAnimationEntry(pack, animation));
    for (const SkinRecord& skin : pack.skins())
        entries.push_back(makeSkinEntry(pack, skin));
    addNodeEntries(entries, pack, "instance", pack.instances());
    addTableEntries(entries, pack, "light", pack.lights());
    addTableEntries(entries, pack, "camera", pack.cameras());
    addNodeEntries(entries, pack, "shadow sphere", pack.shadowSpheres());
    addExtrasEntries(entries, pack);
    addProxyEntries(entries, pack);
    addLightEntries(entries, pack);
    addReceiverEntry(entries, pack);
    addMetaEntries(entries, summary.meta);
    return entries;
}

std::vector<Property> readMetaSettings(const PackView& pack)
{
    Json meta = Json::parse(pack.meta()).value_or(Json());
    if (!meta.is_object())
        return {};
    // these are entries of their own
    for (const char* list : {"sources", "messages", "dropped", "skipped"})
        meta.erase(list);
    std::vector<Property> settings;
    addSettings(settings, meta, "");
    std::sort(settings.begin(), settings.end(),
              [](const Property& a, const Property& b) { return a.name < b.name; });
    return settings;
}

} // namespace hearth::command
