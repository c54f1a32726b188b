// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/authored_lods.h"

#include "formats/pack/pack_view.h"
#include "pipelines/import/part/bake_transform.h"
#include "pipelines/import/read_source.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::import
{

using namespace formats;

namespace
{

/// Hint for users who did not ask for levels: files become levels by their names alone.
constexpr const char* kOptOutHint =
    "if these files are not levels of one mesh, keep them apart: hearth.toml, [[rule]], import.lods = []";

/// Return the only instance: one mesh in one place. errors: lod_file.
Result<InstanceRecord> requireSingleInstance(std::span<const InstanceRecord> instances,
                                             const std::string& file)
{
    if (instances.size() == 1)
        return instances[0];
    return Error{Issue::lod_file, file, "",
                 fmt::format("draws {} meshes: with levels of detail in files, each file draws one; {}",
                             instances.size(), kOptOutHint)};
}

/// Return the names of the joints of the instance's skin; empty without a skin.
template <typename TextFromRef>
std::vector<std::string> jointNames(std::span<const NodeRecord> nodes, std::span<const SkinRecord> skins,
                                    std::span<const JointRecord> joints, const InstanceRecord& instance,
                                    TextFromRef textFromRef)
{
    std::vector<std::string> names;
    if (instance.node >= nodes.size() || nodes[instance.node].skin == kInvalidIndex)
        return names;
    for (const JointRecord& joint : recordsInRange(joints, skins[nodes[instance.node].skin].joints))
        names.emplace_back(textFromRef(nodes[joint.node].name));
    return names;
}

/// Append the images of a part unchanged.
Status copyImages(const PackView& from, PartBuilder& part)
{
    for (uint32_t i = 0; i < from.images().size(); ++i)
    {
        ImageRecord record = from.images()[i];
        record.name = part.intern(from.text(record.name));
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, from.imageData(i));
        DecodedImage image;
        image.width = record.width;
        image.height = record.height;
        image.type = isUnorm16(record.format)         ? ChannelType::unorm16
                     : texelBytes(record.format) == 8 ? ChannelType::float16
                                                      : ChannelType::unorm8;
        image.texels.assign(data.bytes().begin(), data.bytes().end());
        HEARTH_ASSIGN_OR_RETURN(const uint32_t added, part.addImage(record, image));
        static_cast<void>(added);
    }
    return success();
}

void copyMaterials(const PackView& from, uint32_t first_image, PartBuilder& part)
{
    const auto first_material = static_cast<uint32_t>(part.materials.size());
    for (MaterialRecord material : from.materials())
    {
        material.name = part.intern(from.text(material.name));
        for (TextureRef* texture :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.occlusion_texture, &material.emissive_texture})
            if (texture->image != kInvalidIndex)
                texture->image += first_image;
        part.materials.push_back(material);
    }
    for (MaterialLayersRecord layers : from.materialLayers())
    {
        layers.material += first_material;
        for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
            if ((layers.*texture).image != kInvalidIndex)
                (layers.*texture).image += first_image;
        part.material_layers.push_back(layers);
    }
}

/// Finest mesh, which a level of detail must match.
struct BaseMesh
{
    InstanceRecord instance;
    std::vector<std::string> joints; ///< names; empty without a skin
};

Status addLevel(const PackView& from, const tools::LodFile& file, const BaseMesh& base, PartBuilder& part)
{
    const std::string name = file.path.substr(file.path.rfind('/') + 1); // npos + 1 is 0
    HEARTH_ASSIGN_OR_RETURN(const InstanceRecord instance,
                            requireSingleInstance(from.instances(), file.path));
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh mesh, mesh::readSourceMesh(from.container(), instance.mesh));
    const auto drop = [&](const char* why)
    {
        // the part stores the message, so it must not contain folders of this machine
        part.warn(Issue::dropped, "", fmt::format("level of detail {} {}: it is not kept", name, why));
    };
    const auto textFromRef = [&](StringRef text) { return from.text(text); };
    if (jointNames(from.nodes(), from.skins(), from.joints(), instance, textFromRef) != base.joints)
    {
        drop("has not the joints of its source");
        return success();
    }
    const auto object_from_world = inverted(widened(base.instance.world_from_object));
    if (!object_from_world || !bakeTransform(mesh, *object_from_world * widened(instance.world_from_object)))
    {
        drop("cannot be moved to the place of its source");
        return success();
    }
    if (!from.extras().empty())
        part.warn(Issue::dropped, "",
                  fmt::format("extras of level of detail {} are not kept: those of its source are", name));
    const auto first_material = static_cast<uint32_t>(part.materials.size());
    for (uint32_t& material : mesh.triangle_materials)
        material += material == kInvalidIndex ? 0 : first_material;
    const uint32_t first_image = part.imageCount();
    HEARTH_TRY(copyImages(from, part));
    copyMaterials(from, first_image, part);
    return part.addLod(base.instance.mesh, mesh, {file.level, name});
}

} // namespace

Status addAuthoredLods(std::span<const tools::LodFile> files, const std::string& folder,
                       const ImportOptions& options, PartBuilder& part)
{
    HEARTH_ASSIGN_OR_RETURN(const InstanceRecord instance,
                            requireSingleInstance(part.instances, part.sourceName()));
    if (part.hasLods())
        return Error{
            Issue::lod_file, part.sourceName(), "",
            std::string("has levels of detail of its own: they cannot be mixed with those of files; ") +
                kOptOutHint};
    const auto textFromRef = [&](StringRef name) { return part.text(name); };
    const BaseMesh base{instance, jointNames<decltype(textFromRef)>(part.nodes, part.skins, part.joints,
                                                                    instance, textFromRef)};
    for (const tools::LodFile& file : files)
    {
        const std::string path = fmt::format("{}/{}.part", folder, file.level);
        HEARTH_ASSIGN_OR_RETURN(PartBuilder level, PartBuilder::create(path, file.path));
        HEARTH_TRY(readSource(file.path, options, level));
        HEARTH_TRY(level.finish());
        part.mergeReport(level);
        HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
        HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(std::move(reader)));
        HEARTH_TRY(addLevel(view, file, base, part));
    }
    return success();
}

} // namespace hearth::import
