// Imports a single image as a scene: an unlit card, one metre high, that faces +Z.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/image_card.h"

#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/scans/obj_materials.h"
#include "pipelines/import/scans/scan_polygons.h"

namespace hearth::import
{

namespace
{

mesh::SourceMesh cardMesh(float aspect, const std::string& name)
{
    mesh::SourceMesh mesh;
    mesh.name = name;
    const float x = aspect / 2;
    mesh.positions = {{-x, -0.5f, 0}, {x, -0.5f, 0}, {x, 0.5f, 0}, {-x, 0.5f, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.triangle_materials = {0, 0};
    mesh.face_count = 2;
    mesh.source_vertex_count = 4;
    return mesh;
}

/// True if the card shows what is behind it. Floats are an environment map: alpha outside of an EXR's window
/// does not mean transparency.
bool isTransparent(const DecodedImage& image)
{
    return !image.isFloat() && hasAlpha(image);
}

} // namespace

Status importImage(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                   PartBuilder& part)
{
    HEARTH_ASSIGN_OR_RETURN(const DecodedImage image,
                            decodeImage(bytes, path, options.limits, options.artist));
    for (const ImageNote& note : image.notes)
        part.warn(note.issue, "", note.text);
    part.warnOfColorDepth(image, "", "the image");
    part.warnOfTransfer(image, true, "", "the image");
    const std::string name = path.substr(path.rfind('/') + 1);
    formats::ImageRecord record{};
    record.name = part.intern(name);
    record.format = static_cast<uint32_t>(formats::TexelFormat::rgba8_srgb);
    HEARTH_ASSIGN_OR_RETURN(const uint32_t index, part.addImage(record, image));

    formats::MaterialRecord material = defaultScanMaterial();
    material.name = record.name;
    material.flags = formats::kMaterialUnlit;
    material.alpha_mode =
        static_cast<uint32_t>(isTransparent(image) ? formats::AlphaMode::blend : formats::AlphaMode::opaque);
    material.base_color_texture.image = index;
    material.base_color_texture.wrap_u = static_cast<uint8_t>(formats::Wrap::clamp_to_edge);
    material.base_color_texture.wrap_v = static_cast<uint8_t>(formats::Wrap::clamp_to_edge);
    part.materials.push_back(material);

    const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
    HEARTH_TRY(part.addMesh(cardMesh(aspect, name)));
    addOnlyInstance(name, part);
    part.counts.triangles = 2;
    part.counts.faces = 2;
    part.counts.vertices = 4;
    part.counts.materials = 1;
    return success();
}

} // namespace hearth::import
