// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/pack_entries.h"

#include "cook/json/json.h"
#include "cook/tools/sha256.h"
#include "formats/codecs/channel_keys.h"
#include "formats/pack/image_uses.h"
#include "formats/records/texel_format_name.h"
#include "pipelines/command/inspect/inspect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace hearth::command
{

using namespace formats;

namespace
{

// ---- values

/// Return the first twelve digits of the SHA-256, which tell contents apart.
std::string contentText(std::string_view bytes)
{
    return tools::sha256Of(bytes).substr(0, 12);
}

template <typename T>
std::string_view bytesOf(const T& value)
{
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

template <typename T>
std::string_view bytesOf(std::span<const T> values)
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
std::string nameOf(const PackView& pack, std::span<const Record> table, uint32_t index)
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
        return nameOf(pack, pack.images(), value);
    if (field.name == "mesh")
        return nameOf(pack, pack.meshes(), value);
    if (field.name == "node" || field.name == "skeleton_root")
        return nameOf(pack, pack.nodes(), value);
    if (field.name == "light")
        return nameOf(pack, pack.lights(), value);
    if (field.name == "format")
        return texelFormatName(value);
    if (field.name == "alpha_mode")
        return alphaModeName(value);
    return std::nullopt;
}

// Longer fields are tables, compared by their hash.
constexpr size_t kMaxFieldText_bytes = 256;

std::string fieldText(const PackView& pack, const Field& field, const std::byte* bytes)
{
    if (field.size > kMaxFieldText_bytes)
        return contentText({reinterpret_cast<const char*>(bytes), field.size});
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
void addFields(std::vector<Fact>& facts, const PackView& pack, const Record& record,
               const std::string& prefix = "")
{
    for (const Field& field : FieldsOf<Record>::value)
    {
        const std::byte* bytes = reinterpret_cast<const std::byte*>(&record) + field.offset;
        if (field.name == "reserved" || field.type == StringRef::kTypeName || field.type == Range::kTypeName)
            continue;
        if constexpr (!std::is_same_v<Record, TextureRef>)
            if (field.type == TextureRef::kTypeName)
            {
                TextureRef texture;
                std::memcpy(&texture, bytes, sizeof(texture));
                if (texture.image == kNone)
                    facts.push_back({std::string(field.name), "none"});
                else
                    addFields(facts, pack, texture, std::string(field.name) + ".");
                continue;
            }
        facts.push_back({prefix + std::string(field.name), fieldText(pack, field, bytes),
                         field.size > kMaxFieldText_bytes});
    }
}

template <typename Record>
void addTable(std::vector<Thing>& things, const PackView& pack, const char* kind,
              std::span<const Record> table)
{
    for (const Record& record : table)
    {
        things.push_back({kind, std::string(pack.text(record.name)), {}});
        addFields(things.back().facts, pack, record);
    }
}

// ---- meshes

constexpr uint32_t relative(uint32_t index, Range range)
{
    return index == kNone ? kNone : index - range.first;
}

/// Hash groups and clusters with mesh-local indices, as if the mesh were alone in its pack.
std::string hierarchyText(const PackView& pack, const MeshRecord& mesh)
{
    std::string bytes;
    for (GroupRecord group : recordsOf(pack.groups(), mesh.groups))
    {
        group.clusters.first = relative(group.clusters.first, mesh.clusters);
        group.page = relative(group.page, mesh.pages);
        bytes += bytesOf(group);
    }
    for (ClusterRecord cluster : recordsOf(pack.clusters(), mesh.clusters))
    {
        cluster.material = 0;
        cluster.group = relative(cluster.group, mesh.groups);
        cluster.refined_group = relative(cluster.refined_group, mesh.groups);
        cluster.page = relative(cluster.page, mesh.pages);
        bytes += bytesOf(cluster);
    }
    return contentText(bytes);
}

std::string materialsText(const PackView& pack, const MeshRecord& mesh)
{
    std::set<std::string> names;
    for (const ClusterRecord& cluster : recordsOf(pack.clusters(), mesh.clusters))
        names.insert(nameOf(pack, pack.materials(), cluster.material));
    return fmt::format("{}", fmt::join(names, ", "));
}

Result<std::string> geometryText(const PackView& pack, const MeshRecord& mesh)
{
    std::string hashes;
    for (uint32_t page = mesh.pages.first; page < mesh.pages.first + mesh.pages.count; ++page)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> decoded, pack.decodePage(page));
        hashes += tools::sha256Of(decoded);
    }
    return contentText(hashes);
}

/// Hash the bounds of the mesh over all poses; empty if it is rigid.
std::string boundsText(const PackView& pack, uint32_t mesh)
{
    std::string bytes;
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
        for (DeformedClusterRecord cluster : record.mesh == mesh
                                                 ? recordsOf(pack.deformedClusters(), record.clusters)
                                                 : std::span<const DeformedClusterRecord>())
        {
            const auto joints = recordsOf(pack.clusterJoints(), cluster.joints);
            cluster.joints.first = 0;
            bytes += bytesOf(cluster);
            bytes += bytesOf(joints);
        }
    return bytes.empty() ? "" : contentText(bytes);
}

Result<Thing> meshThing(const PackView& pack, uint32_t index, const MeshSummary& summary)
{
    const MeshRecord& mesh = pack.meshes()[index];
    Thing thing{"mesh", summary.name, {}};
    const auto add = [&](const std::string& what, const std::string& value) {
        thing.facts.push_back({what, value});
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
    thing.facts.push_back({"hierarchy", hierarchyText(pack, mesh), true});
    HEARTH_ASSIGN_OR_RETURN(const std::string geometry, geometryText(pack, mesh));
    thing.facts.push_back({"geometry", geometry, true});
    thing.facts.push_back({"bounds in motion", boundsText(pack, index), true});
    return thing;
}

// ---- the scene

/// List the uses of an image: "baseColor of Bark, normal of Bark and 3 more".
std::string usesText(const PackView& pack, const std::vector<ImageUse>& uses)
{
    constexpr size_t kMaxUses = 2;
    std::string text;
    for (size_t i = 0; i < std::min(uses.size(), kMaxUses); ++i)
        text += fmt::format("{}{} of {}", i == 0 ? "" : ", ", uses[i].role,
                            nameOf(pack, pack.materials(), uses[i].material));
    return uses.size() <= kMaxUses ? text : text + fmt::format(" and {} more", uses.size() - kMaxUses);
}

Result<Thing> textureThing(const PackView& pack, uint32_t index, const std::vector<ImageUse>& uses)
{
    Thing thing{"texture", std::string(pack.text(pack.images()[index].name)), {}, usesText(pack, uses)};
    addFields(thing.facts, pack, pack.images()[index]);
    HEARTH_ASSIGN_OR_RETURN(const ChunkData texels, pack.imageData(index));
    thing.facts.push_back({"texels", contentText(bytesOf(texels.bytes())), true});
    return thing;
}

/// Hash the decoded keys of a channel.
std::string keysText(const PackView& pack, const AnimationChannelRecord& channel)
{
    const ChannelKeys keys(pack.keys(), pack.keyBits(), channel);
    std::string bytes;
    for (uint32_t key = 0; key < keys.count(); ++key)
    {
        const float time = keys.time(key);
        bytes += bytesOf(time);
        for (uint32_t first = 0; first < channel.components; first += 4)
        {
            const uint32_t count = std::min(channel.components - first, 4u);
            bytes += bytesOf(keys.value(key, first, count));
            if (keys.interpolation() != Interpolation::cubic_spline)
                continue;
            bytes += bytesOf(keys.inTangent(key, first, count));
            bytes += bytesOf(keys.outTangent(key, first, count));
        }
    }
    return contentText(bytes);
}

Thing animationThing(const PackView& pack, const AnimationRecord& animation)
{
    static constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
    Thing thing{"animation", std::string(pack.text(animation.name)), {}};
    addFields(thing.facts, pack, animation);
    for (const AnimationChannelRecord& channel : recordsOf(pack.channels(), animation.channels))
    {
        const std::string what =
            fmt::format("{} of {}", kPaths[channel.path % 4], nameOf(pack, pack.nodes(), channel.node));
        thing.facts.push_back(
            {what, fmt::format("{} keys, interpolation {}", channel.key_count, channel.interpolation)});
        thing.facts.push_back({"keys of " + what, keysText(pack, channel), true});
    }
    return thing;
}

Thing skinThing(const PackView& pack, const SkinRecord& skin)
{
    Thing thing{"skin", std::string(pack.text(skin.name)), {}};
    addFields(thing.facts, pack, skin);
    const auto joints = recordsOf(pack.joints(), skin.joints);
    thing.facts.push_back({"joints", std::to_string(joints.size())});
    std::string bytes;
    for (const JointRecord& joint : joints)
    {
        bytes += nameOf(pack, pack.nodes(), joint.node) + '\n';
        bytes += bytesOf(joint.joint_from_bind);
    }
    thing.facts.push_back({"bind pose", contentText(bytes), true});
    return thing;
}

/// Add entries for records without a name, named after their node.
template <typename Record>
void addOfNodes(std::vector<Thing>& things, const PackView& pack, const char* kind,
                std::span<const Record> table)
{
    for (const Record& record : table)
    {
        things.push_back({kind, nameOf(pack, pack.nodes(), record.node), {}});
        addFields(things.back().facts, pack, record);
    }
}

void addLight(std::vector<Thing>& things, const PackView& pack)
{
    for (const SpecularTableRecord& table : pack.specularTables())
    {
        things.push_back({"specular table", "", {}});
        addFields(things.back().facts, pack, table);
    }
    for (const BrickGridRecord& grid : pack.brickGrid())
    {
        things.push_back({"bricks", "", {}});
        addFields(things.back().facts, pack, grid);
        const auto add = [&](const char* what, std::string_view bytes) {
            things.back().facts.push_back({what, contentText(bytes), true});
        };
        add("voxels", std::string(bytesOf(pack.brickGroups())) + std::string(bytesOf(pack.bricks())));
        add("opacity", bytesOf(pack.brickOpacity()));
        add("albedo", bytesOf(pack.brickAlbedo()));
        add("normals", bytesOf(pack.brickNormals()));
        add("emission", bytesOf(pack.brickEmission()));
        add("lighting", bytesOf(pack.brickLighting()));
    }
}

void addMeta(std::vector<Thing>& things, const MetaSummary& meta)
{
    for (const SourceSummary& source : meta.sources)
        things.push_back(
            {"source", source.name, {{"bytes", std::to_string(source.bytes)}, {"xxh3", source.hash, true}}});
    for (const MessageSummary& message : meta.messages)
        things.push_back(
            {"message", message.source + message.where, {{"code", message.code}, {"text", message.text}}});
    for (const std::string& dropped : meta.dropped)
        things.push_back({"dropped", dropped, {}});
}

/// Add a property for each leaf value, named by its JSON pointer.
void addSettings(std::vector<Fact>& settings, const Json& json, const std::string& pointer)
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

Result<std::vector<Thing>> thingsOf(const PackView& pack)
{
    std::vector<Thing> things;
    const PackSummary summary = summarize(pack);
    for (uint32_t i = 0; i < pack.meshes().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Thing mesh, meshThing(pack, i, summary.meshes[i]));
        things.push_back(std::move(mesh));
    }
    addTable(things, pack, "material", pack.materials());
    const auto uses = imageUses(pack.materials(), pack.images().size());
    for (uint32_t i = 0; i < pack.images().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Thing texture, textureThing(pack, i, uses[i]));
        things.push_back(std::move(texture));
    }
    for (const AnimationRecord& animation : pack.animations())
        things.push_back(animationThing(pack, animation));
    for (const SkinRecord& skin : pack.skins())
        things.push_back(skinThing(pack, skin));
    addOfNodes(things, pack, "instance", pack.instances());
    addTable(things, pack, "light", pack.lights());
    addTable(things, pack, "camera", pack.cameras());
    addOfNodes(things, pack, "shadow sphere", pack.shadowSpheres());
    addLight(things, pack);
    addMeta(things, summary.meta);
    return things;
}

std::vector<Fact> settingsOf(const PackView& pack)
{
    Json meta = Json::parse(pack.meta()).value_or(Json());
    if (!meta.is_object())
        return {};
    // these are entries of their own
    for (const char* list : {"sources", "messages", "dropped"})
        meta.erase(list);
    std::vector<Fact> settings;
    addSettings(settings, meta, "");
    std::sort(settings.begin(), settings.end(), [](const Fact& a, const Fact& b) { return a.what < b.what; });
    return settings;
}

} // namespace hearth::command
