// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/part_builder.h"

#include "cook/json/json.h"
#include "formats/base/affine3d.h"
#include "formats/base/assert.h"
#include "formats/container/container_reader.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/lit_material.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::import
{

using namespace formats;

namespace
{

// A hostile file can provoke a message for every element; a user reads the first few.
constexpr size_t kMaxWarnings = 100;

/// Replace every byte that is not part of valid UTF-8 by '?': the string table stores names as UTF-8.
std::string validUtf8(std::string_view text)
{
    const auto continues = [&](size_t i)
    { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u; };
    std::string valid;
    valid.reserve(text.size());
    for (size_t i = 0; i < text.size();)
    {
        const auto first = static_cast<unsigned char>(text[i]);
        const size_t length = first < 0x80                    ? 1
                              : first >= 0xC2 && first < 0xE0 ? 2
                              : first >= 0xE0 && first < 0xF0 ? 3
                              : first >= 0xF0 && first < 0xF5 ? 4
                                                              : 0;
        bool whole = length > 0;
        for (size_t k = 1; k < length; ++k)
            whole = whole && continues(i + k);
        // overlong forms, surrogates and numbers above U+10FFFF
        const auto second = whole && length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0u;
        whole = whole && !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F) &&
                !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
        valid += whole ? text.substr(i, length) : std::string_view("?");
        i += whole ? length : 1;
    }
    return valid;
}

std::string messageJson(const Error& warning)
{
    const IssueInfo& info = issueInfo(warning.issue);
    return fmt::format(R"({{"code":"W{}","severity":"warning","pointer":{},"text":{},"hint":{}}})",
                       static_cast<unsigned>(warning.issue), quoteJson(warning.where),
                       quoteJson(warning.detail.empty() ? info.summary : std::string_view(warning.detail)),
                       quoteJson(info.hint));
}

std::string joinItems(const std::vector<std::string>& items)
{
    std::string text;
    for (const std::string& item : items)
        text += (text.empty() ? "" : ",") + item;
    return "[" + text + "]";
}

std::string countsJson(const SourceCounts& counts, size_t meshes, size_t images, size_t instances)
{
    return fmt::format(R"({{"meshes":{},"instances":{},"images":{},"triangles":{},"faces":{},"vertices":{},)"
                       R"("materials":{},"joints":{},"animations":{},"morph_targets":{}}})",
                       meshes, instances, images, counts.triangles, counts.faces, counts.vertices,
                       counts.materials, counts.joints, counts.animations, counts.morph_targets);
}

std::string clipJson(const animation_compression::ClipStatistics& clip)
{
    return fmt::format(R"({{"keys_before":{},"keys":{},"bytes_before":{},"bytes":{},"stated_error":{},)"
                       R"("proven_error":{}}})",
                       clip.keys_before, clip.keys_after, clip.bytes_before, clip.bytes_after,
                       clip.stated_error, clip.proven_error);
}

/// Return the format of an image in the part.
TexelFormat chooseFormat(ChannelType type, bool is_srgb)
{
    switch (type)
    {
    case ChannelType::unorm8:
        return is_srgb ? TexelFormat::rgba8_srgb : TexelFormat::rgba8_unorm;
    case ChannelType::unorm16:
        return is_srgb ? TexelFormat::rgba16_srgb : TexelFormat::rgba16_unorm;
    case ChannelType::float16:
        break;
    }
    return TexelFormat::rgba16_float;
}

/// Return the distinct materials of a mesh.
std::vector<uint32_t> listMaterials(const mesh::SourceMesh& mesh)
{
    std::vector<uint32_t> materials;
    for (const uint32_t material : mesh.triangle_materials)
        if ((materials.empty() || materials.back() != material) &&
            std::ranges::find(materials, material) == materials.end())
            materials.push_back(material);
    return materials;
}

std::string pointJson(Float3 point)
{
    return fmt::format("[{},{},{}]", point.x, point.y, point.z);
}

std::string boxJson(const Box3& box)
{
    return box.empty() ? "null"
                       : fmt::format(R"({{"min":{},"max":{}}})", pointJson(box.min), pointJson(box.max));
}

std::string proxiesJson(const proxy::ProxyTables& proxies)
{
    std::vector<std::string> items;
    for (const ProxyRecord& record : proxies.proxies)
        items.push_back(
            fmt::format(R"({{"mesh":{},"origin":{},"triangles":{},"vertices":{},"closed":{},"distance":{},)"
                        R"("mesh_distance":{},"bytes":{}}})",
                        record.mesh, quoteJson(kProxyOriginNames[record.origin]), record.indices.count / 3,
                        record.positions.count, record.is_closed != 0, record.distance, record.mesh_distance,
                        proxy::countBytes(record)));
    return joinItems(items);
}

void truncateText(std::string& text)
{
    constexpr size_t kMaxLength = 300;
    if (text.size() > kMaxLength)
        text = text.substr(0, kMaxLength) + "...";
}

} // namespace

Error truncateTexts(Error error)
{
    truncateText(error.where);
    truncateText(error.detail);
    return error;
}

PartBuilder::PartBuilder(ContainerWriter writer, std::string source_name)
    : writer_(std::move(writer)), source_name_(std::move(source_name))
{
}

Result<PartBuilder> PartBuilder::create(const std::string& path, std::string source_name)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::part));
    return PartBuilder(std::move(writer), std::move(source_name));
}

StringRef PartBuilder::intern(std::string_view text)
{
    if (text.empty())
        return {};
    const auto found = string_refs_.find(text);
    if (found != string_refs_.end())
        return found->second;
    const std::string valid = validUtf8(text);
    const StringRef ref{static_cast<uint32_t>(strings_.size()), static_cast<uint32_t>(valid.size())};
    strings_ += valid;
    string_refs_.emplace(text, ref);
    return ref;
}

Status PartBuilder::addMesh(const mesh::SourceMesh& mesh)
{
    vertex_bounds_.push_back(computeVertexBounds(mesh));
    materials_of_mesh_.push_back(listMaterials(mesh));
    return mesh::writeSourceMesh(writer_, mesh_count_++, mesh);
}

Status PartBuilder::addLod(uint32_t of, const mesh::SourceMesh& mesh, const tools::LodLabel& label)
{
    HEARTH_ASSERT(of < mesh_count_);
    lods_.push_back({of, mesh_count_, label.number.value_or(kInvalidIndex), intern(label.name)});
    HEARTH_TRY(addMesh(mesh));
    add(vertex_bounds_[of], vertex_bounds_.back());
    return success();
}

Result<uint32_t> PartBuilder::addImage(ImageRecord record, const DecodedImage& image)
{
    HEARTH_ASSERT(image.texels.size() == size_t{image.width} * image.height * image.texelBytes());
    const auto index = static_cast<uint32_t>(images_.size());
    record.width = image.width;
    record.height = image.height;
    record.mip_count = 1;
    record.format = static_cast<uint32_t>(chooseFormat(image.type, isSrgb(record.format)));
    images_.push_back(record);
    HEARTH_TRY(writer_.addChunk({.type = kChunkImageData, .index = index}, image.texels,
                                static_cast<uint32_t>(image.texelBytes()), Codec::none));
    return index;
}

void PartBuilder::warn(Issue issue, std::string where, std::string detail)
{
    warn(issue, std::move(where), std::move(detail), "");
}

void PartBuilder::warn(Issue issue, std::string where, std::string detail, std::string_view remark)
{
    HEARTH_ASSERT(issueInfo(issue).kind == IssueClass::warning);
    if (warnings_.size() >= kMaxWarnings)
    {
        ++omitted_warning_count_;
        return;
    }
    Error error = truncateTexts({issue, source_name_, std::move(where), std::move(detail)});
    warnings_.push_back({std::move(error), std::string(remark)});
    truncateText(warnings_.back().remark);
}

void PartBuilder::warnOfColorDepth(const DecodedImage& image, const std::string& where,
                                   const std::string& name)
{
    if (image.type == ChannelType::unorm16)
        warn(Issue::image_depth, where,
             name + ": its colours have 16 bits a channel, 8 are kept; mips are made from all 16");
}

void PartBuilder::warnOfTransfer(const DecodedImage& image, bool are_colors, const std::string& where,
                                 const std::string& name)
{
    const Transfer other = are_colors ? Transfer::linear : Transfer::srgb;
    if (image.transfer == other && !image.isFloat())
        warn(Issue::inconsistent, where,
             name +
                 (are_colors
                      ? ": its file says linear numbers, its use colours in sRGB, as which they are read"
                      : ": its file says colours in sRGB, its use linear numbers, as which they are read"));
}

std::vector<Error> PartBuilder::warnings() const
{
    std::vector<Error> errors;
    for (const Warning& warning : warnings_)
    {
        errors.push_back(warning.error);
        errors.back().detail += warning.remark;
    }
    return errors;
}

void PartBuilder::addSource(std::string name, std::span<const std::byte> content)
{
    addSource(std::move(name), content.size(), hashBytes(content));
}

void PartBuilder::addSource(std::string name, uint64_t size, uint64_t hash)
{
    sources_.push_back({std::move(name), size, hash});
}

void PartBuilder::mergeReport(const PartBuilder& other)
{
    sources_.insert(sources_.end(), other.sources_.begin(), other.sources_.end());
    omitted_warning_count_ += other.omitted_warning_count_;
    for (const Warning& warning : other.warnings_)
        if (warnings_.size() < kMaxWarnings)
            warnings_.push_back(warning);
        else
            ++omitted_warning_count_;
}

std::string PartBuilder::report() const
{
    std::vector<std::string> sources;
    for (const SourceFile& source : sources_)
        sources.push_back(fmt::format(R"({{"name":{},"bytes":{},"xxh3":"{:016x}"}})", quoteJson(source.name),
                                      source.size, source.hash));
    std::vector<std::string> messages;
    std::vector<std::string> dropped;
    for (const Warning& warning : warnings_)
    {
        messages.push_back(messageJson(warning.error));
        if (warning.error.issue == Issue::dropped)
            dropped.push_back(quoteJson(warning.error.detail));
    }
    std::vector<std::string> clips;
    for (const animation_compression::ClipStatistics& clip : clip_statistics)
        clips.push_back(clipJson(clip));
    return fmt::format(
        R"({{"schema":"hearth.import/1","tool":{{"name":"hearth-import","version":{}}},"source":{},)"
        R"("sources":{},"counts":{},"clips":{},"messages":{},"messages_left_out":{},"dropped":{}}})",
        quoteJson(HEARTH_VERSION), quoteJson(source_name_.substr(source_name_.rfind('/') + 1)),
        joinItems(sources), countsJson(counts, mesh_count_ - lods_.size(), images_.size(), instances.size()),
        joinItems(clips), joinItems(messages), omitted_warning_count_, joinItems(dropped));
}

std::string PartBuilder::statistics() const
{
    std::string text = report();
    HEARTH_ASSERT(text.ends_with('}'));
    text.pop_back();
    return text + R"(,"lit_box":)" + boxJson(litBox()) + R"(,"proxies":)" + proxiesJson(proxies) + "}";
}

Box3 PartBuilder::litBox() const
{
    const auto isLitMaterial = [&](uint32_t material)
    { return material >= materials.size() || formats::isLit(materials[material]); };
    Box3 box;
    for (const InstanceRecord& instance : instances)
    {
        if (instance.mesh >= vertex_bounds_.size())
            continue;
        const VertexBounds& bounds = vertex_bounds_[instance.mesh];
        const bool is_deformed = !bounds.joint_boxes.empty() || !bounds.morph_distances.empty();
        if (is_deformed || bounds.box[0].empty() ||
            std::ranges::none_of(materials_of_mesh_[instance.mesh], isLitMaterial))
            continue;
        const auto corner = [&](double animation_bounds::Interval::*end) {
            return narrow({bounds.box[0].*end, bounds.box[1].*end, bounds.box[2].*end});
        };
        box.add(
            transformBox(widened(instance.world_from_object), {corner(&animation_bounds::Interval::low),
                                                               corner(&animation_bounds::Interval::high)}));
    }
    return box;
}

Status PartBuilder::addProbe(const ProbeRecord& probe, std::span<const uint32_t> texels)
{
    HEARTH_TRY(writer_.addRecords<ProbeRecord>(kChunkProbes, {&probe, 1}));
    return writer_.addRecords<uint32_t>(kChunkProbeTexels, texels);
}

Status PartBuilder::finish()
{
    HEARTH_TRY(writer_.addText(kChunkMeta, report()));
    HEARTH_TRY(writer_.addText(kChunkStrings, strings_));
    HEARTH_TRY(writer_.addRecords<NodeRecord>(kChunkNodes, nodes));
    HEARTH_TRY(writer_.addRecords<InstanceRecord>(kChunkInstances, instances));
    HEARTH_TRY(writer_.addRecords<CameraRecord>(kChunkCameras, cameras));
    HEARTH_TRY(writer_.addRecords<LightRecord>(kChunkLights, lights));
    HEARTH_TRY(writer_.addRecords<ShadowSphereRecord>(kChunkShadowSpheres, shadow_spheres));
    HEARTH_TRY(writer_.addRecords<MaterialRecord>(kChunkMaterials, materials));
    if (!material_layers.empty())
        HEARTH_TRY(writer_.addRecords<MaterialLayersRecord>(kChunkMaterialLayers, material_layers));
    HEARTH_TRY(writer_.addRecords<ImageRecord>(kChunkImages, images_));
    HEARTH_TRY(writer_.addRecords<SkinRecord>(kChunkSkins, skins));
    HEARTH_TRY(writer_.addRecords<JointRecord>(kChunkJoints, joints));
    HEARTH_TRY(writer_.addRecords<AnimationRecord>(kChunkAnimations, animations));
    HEARTH_TRY(writer_.addRecords<AnimationChannelRecord>(kChunkChannels, channels));
    HEARTH_TRY(writer_.addRecords<float>(kChunkKeys, keys));
    if (!key_bits.empty())
        HEARTH_TRY(writer_.addRecords<uint32_t>(kChunkKeyBits, key_bits));
    HEARTH_TRY(writer_.addRecords<float>(kChunkMorphWeights, morph_weights));
    if (!lods_.empty())
        HEARTH_TRY(writer_.addRecords<AuthoredLodRecord>(kChunkAuthoredLods, lods_));
    if (!extras.empty())
        HEARTH_TRY(writer_.addRecords<ExtrasRecord>(kChunkExtras, extras));
    if (!proxies.proxies.empty())
        HEARTH_TRY(proxies.write(writer_));
    return writer_.finish();
}

} // namespace hearth::import
