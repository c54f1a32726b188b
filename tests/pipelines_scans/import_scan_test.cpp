// Tests the import of whole scans and single images, up to the part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_view.h"
#include "pipelines/import/image_card.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/scans/import_scan.h"
#include "tests/pipelines_scans/frozen_images.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace hearth::import
{

namespace
{

using namespace formats;
using test::TemporaryFolder;

using ImportFunction = Status (*)(const std::string&, std::span<const std::byte>, const ImportOptions&,
                                  PartBuilder&);

/// Result of one import.
struct Imported
{
    Status status = success();
    SourceCounts counts;
    std::vector<Error> warnings;
    std::vector<MaterialRecord> materials;
    std::vector<ImageRecord> images;
    std::vector<std::byte> first_image;
    mesh::SourceMesh mesh;
    uint32_t instances = 0;

    bool warned(Issue issue, std::string_view part) const
    {
        return std::any_of(warnings.begin(), warnings.end(),
                           [&](const Error& w)
                           { return w.issue == issue && w.detail.find(part) != std::string::npos; });
    }
};

void readBack(const std::string& path, Imported& result)
{
    const auto part = ContainerReader::open(path);
    ASSERT_TRUE(part.ok());
    const auto images = part->records<ImageRecord>(kChunkImages);
    result.images.assign(images->begin(), images->end());
    if (!result.images.empty())
    {
        const auto data = part->read(kChunkImageData, 0);
        result.first_image.assign(data->bytes().begin(), data->bytes().end());
    }
    result.mesh = mesh::readSourceMesh(*part, 0).value();
    result.instances = static_cast<uint32_t>(part->records<InstanceRecord>(kChunkInstances)->size());
}

Imported import(ImportFunction function, const TemporaryFolder& folder, const std::string& name,
                std::string_view content)
{
    Imported result;
    const std::string out = folder.file("out.part");
    auto part = PartBuilder::create(out, name);
    EXPECT_TRUE(part.ok());
    result.status = function(folder.file(name), std::as_bytes(std::span(content)), {}, *part);
    result.counts = part->counts;
    result.warnings = part->warnings();
    result.materials = part->materials;
    if (result.status.ok() && part->finish().ok())
        readBack(out, result);
    return result;
}

void write(const TemporaryFolder& folder, const std::string& name, std::string_view content)
{
    std::ofstream(folder.file(name), std::ios::binary) << content;
}

std::string_view toText(const std::vector<uint8_t>& bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST(ImportScan, aQuadIsOneFaceAndTwoTriangles)
{
    const TemporaryFolder folder;
    const Imported scan = import(importScan, folder, "my scan.obj", kQuad + "f 1 2 3 4\n");
    ASSERT_TRUE(scan.status.ok());
    EXPECT_EQ(scan.counts.faces, 1u);
    EXPECT_EQ(scan.counts.triangles, 2u);
    EXPECT_EQ(scan.counts.vertices, 4u);
    EXPECT_EQ(scan.counts.materials, 0u);
    EXPECT_EQ(scan.mesh.name, "my scan");
    EXPECT_EQ(scan.mesh.normals, std::vector<Float3>(4, {0, 0, 1}));
    EXPECT_EQ(scan.mesh.triangle_materials, (std::vector<uint32_t>{0, 0}));
    ASSERT_EQ(scan.materials.size(), 1u); // default material of scans without materials
    EXPECT_EQ(scan.materials[0].metallic, 0);
    EXPECT_EQ(scan.instances, 1u);
}

TEST(ImportScan, theFormatIsThatOfTheContentThenOfTheName)
{
    const TemporaryFolder folder;
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(import(importScan, folder, "a.obj", off).counts.triangles, 1u);
    EXPECT_EQ(import(importScan, folder, "a.OFF", off).counts.triangles, 1u);
    EXPECT_EQ(import(importScan, folder, "a.txt", kQuad).status.error().issue, Issue::input_kind_unknown);
    EXPECT_EQ(import(importScan, folder, "a.ply", kQuad).status.error().issue, Issue::mesh_syntax);
    EXPECT_EQ(import(importScan, folder, "a.drc", "DRACO").status.error().issue, Issue::codec_failed);
}

TEST(ImportScan, aFileWithoutVerticesIsEmptyAndOneWithoutFacesIsNot)
{
    const TemporaryFolder folder;
    EXPECT_EQ(import(importScan, folder, "a.obj", "# nothing\n").status.error().issue, Issue::mesh_empty);
    const Imported points = import(importScan, folder, "a.obj", "v 0 0 0\n");
    ASSERT_TRUE(points.status.ok());
    EXPECT_EQ(points.counts.vertices, 1u);
    EXPECT_EQ(points.counts.triangles, 0u);
    EXPECT_TRUE(points.warned(Issue::nothing_drawn, "no faces"));
}

TEST(ImportScan, takesMaterialsAndTexturesFromItsFolder)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl",
          "newmtl m\nKd 0.5 0.5 0.5\nNs 30\nmap_Kd -s 2 3 -clamp on t.png\nnewmtl clear\nd 0.5\n");
    write(folder, "t.png", toText(test::kPngRgba8));
    const Imported scan =
        import(importScan, folder, "a.obj",
               "mtllib a.mtl\n" + kQuad +
                   "usemtl m\nf 1/1 2/2 3/3\nusemtl clear\nf 1 3 4\nusemtl m\nf 1/1 2/2 3/3\n");
    ASSERT_TRUE(scan.status.ok());
    EXPECT_TRUE(scan.warnings.empty());
    EXPECT_EQ(scan.counts.materials, 2u);
    ASSERT_EQ(scan.materials.size(), 2u);
    EXPECT_EQ(scan.mesh.triangle_materials, (std::vector<uint32_t>{0, 1, 0}));
    const MaterialRecord& m = scan.materials[0];
    EXPECT_EQ(m.base_color, (Float4{0.5f, 0.5f, 0.5f, 1}));
    EXPECT_NEAR(m.roughness, 0.5f, 1e-6f);
    EXPECT_EQ(m.base_color_texture.image, 0u);
    EXPECT_EQ(m.base_color_texture.wrap_u, static_cast<uint8_t>(Wrap::clamp_to_edge));
    // v = 0.25 from the bottom is 0.75 from the top; scaled by 3, v = 0.75 from the bottom, 0.25 from the top
    EXPECT_FLOAT_EQ(m.base_color_texture.uv_transform[4] * 0.75f + m.base_color_texture.uv_transform[5],
                    0.25f);
    EXPECT_EQ(scan.materials[1].alpha_mode, static_cast<uint32_t>(AlphaMode::blend));
    ASSERT_EQ(scan.images.size(), 1u);
    EXPECT_EQ(scan.images[0].format, static_cast<uint32_t>(TexelFormat::rgba8_srgb));
}

TEST(ImportScan, aBlackColourBesideAMapIsIgnored)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nKd 0 0 0\nmap_Kd t.png\n");
    write(folder, "t.png", toText(test::kPngRgba8));
    const Imported scan =
        import(importScan, folder, "a.obj", "mtllib a.mtl\n" + kQuad + "usemtl m\nf 1 2 3\n");
    EXPECT_EQ(scan.materials.at(0).base_color, (Float4{1, 1, 1, 1}));
}

TEST(ImportScan, missingFilesAreWarningsAndPlaceholders)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nmap_Kd none.png\nnorm none.png\nnewmtl n\nmap_Kd broken.png\n");
    write(folder, "broken.png", toText(test::kPngRgba8).substr(0, 60));
    const Imported scan = import(importScan, folder, "a.obj",
                                 "mtllib a.mtl\nmtllib gone.mtl\n" + kQuad +
                                     "usemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\nusemtl who\nf 1 2 3\n");
    ASSERT_TRUE(scan.status.ok());
    EXPECT_TRUE(scan.warned(Issue::material_missing, "gone.mtl"));
    EXPECT_TRUE(scan.warned(Issue::image_missing, "none.png"));
    EXPECT_TRUE(scan.warned(Issue::image_replaced, "broken.png"));
    EXPECT_TRUE(scan.warned(Issue::degraded, "1 materials"));
    ASSERT_EQ(scan.images.size(), 2u);
    EXPECT_EQ(scan.images[0].flags, kImagePlaceholder);
    EXPECT_EQ(scan.materials[0].normal_texture.image,
              kInvalidIndex); // a placeholder would only disturb the surface
}

TEST(ImportScan, missingFilesAreNamedWithTheirMaterialAndTheNearestFile)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl oak\nmap_Kd wood.PNG\n");
    write(folder, "wood.png", toText(test::kPngRgba8));
    const Imported scan =
        import(importScan, folder, "a.obj", "mtllib A.mtl\nmtllib a.mtl\n" + kQuad + "usemtl oak\nf 1 2 3\n");
    EXPECT_TRUE(scan.warned(Issue::image_missing,
                            "image 'wood.PNG' of material 'oak' beside a.obj: No such file or directory; "
                            "nearest: \"wood.png\", whose letters differ in case"));
    EXPECT_TRUE(scan.warned(Issue::material_missing,
                            "material library 'A.mtl' beside a.obj: No such file or directory; nearest: "
                            "\"a.mtl\", whose letters differ in case"));
}

TEST(ImportScan, neverLeavesItsFolder)
{
    const TemporaryFolder outside;
    write(outside, "secret.mtl", "newmtl m\nKd 0.125 0 0\n");
    write(outside, "secret.png", toText(test::kPngRgba8));
    const TemporaryFolder folder;
    const std::string there = outside.file("secret");
    std::filesystem::create_symlink(there + ".png", folder.file("link.png"));
    write(folder, "a.mtl",
          "newmtl a\nmap_Kd " + there +
              ".png\nnewmtl b\nmap_Kd ../secret.png\nnewmtl c\nmap_Kd link.png\nnewmtl d\nmap_Kd "
              "C:\\secret.png\n");
    const Imported scan = import(importScan, folder, "a.obj",
                                 "mtllib " + there + ".mtl\nmtllib a.mtl\n" + kQuad +
                                     "usemtl m\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 "
                                     "2 3\nusemtl d\nf 1 2 3\n");
    ASSERT_TRUE(scan.status.ok());
    EXPECT_TRUE(scan.warned(Issue::material_missing, "secret.mtl"));
    EXPECT_NE(scan.materials.at(0).base_color.x, 0.125f);
    ASSERT_EQ(scan.images.size(), 4u);
    for (const ImageRecord& image : scan.images)
        EXPECT_EQ(image.flags, kImagePlaceholder);
}

TEST(ImportScan, opacityMapsBecomeAlphaAndAMask)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nmap_Kd t.png\nmap_d g.png\n");
    write(folder, "t.png", toText(test::kPngRgba8));
    write(folder, "g.png", toText(test::kPngGrey8));
    const Imported scan =
        import(importScan, folder, "a.obj", "mtllib a.mtl\n" + kQuad + "usemtl m\nf 1 2 3\n");
    ASSERT_EQ(scan.images.size(), 1u);
    EXPECT_EQ(scan.images[0].flags, kImageAlphaTested);
    EXPECT_EQ(scan.images[0].alpha_cutoff, 0.5f);
    EXPECT_EQ(scan.materials[0].alpha_mode, static_cast<uint32_t>(AlphaMode::mask));
    ASSERT_EQ(scan.first_image.size(), 60u);
    // texel (2, 1): colour of one image, brightness of the other
    EXPECT_EQ(scan.first_image[7 * 4 + 0], std::byte{100});
    EXPECT_EQ(scan.first_image[7 * 4 + 3], std::byte{100});
}

TEST(ImportScan, anOpacityMapOfEightBitsJoinsAColourOfSixteen)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nmap_Kd t.png\nmap_d g.png\n");
    write(folder, "t.png", toText(test::kPngRgba16));
    write(folder, "g.png", toText(test::kPngGrey8));
    const Imported scan =
        import(importScan, folder, "a.obj", "mtllib a.mtl\n" + kQuad + "usemtl m\nf 1 2 3\n");
    ASSERT_EQ(scan.images.size(), 1u);
    EXPECT_EQ(scan.images[0].format, static_cast<uint32_t>(TexelFormat::rgba16_srgb));
    EXPECT_TRUE(scan.warned(Issue::image_depth, "image 't.png' of material 'm': its colours have 16 bits"));
    ASSERT_EQ(scan.first_image.size(), 120u);
    // texel (2, 1): colour of one image, brightness of the other, which is 100 of 255
    uint16_t texel[4];
    std::memcpy(texel, scan.first_image.data() + 7 * sizeof(texel), sizeof(texel));
    EXPECT_EQ(texel[0], 2001);
    EXPECT_EQ(texel[2], 30005);
    EXPECT_EQ(texel[3], 100 * 257);
}

TEST(ImportScan, heightMapsAreNamedAndNormalMapsKept)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nmap_Bump g.png\nnewmtl n\nmap_Bump -bm 0.5 t.png\n");
    write(folder, "g.png", toText(test::kPngGrey8));
    write(folder, "t.png", toText(test::kPngRgba8));
    const Imported scan =
        import(importScan, folder, "a.obj",
               "mtllib a.mtl\n" + kQuad + "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 1/1 2/2 3/3\n");
    EXPECT_TRUE(scan.warned(Issue::dropped, "g.png"));
    EXPECT_EQ(scan.materials[0].normal_texture.image, kInvalidIndex);
    EXPECT_EQ(scan.materials[1].normal_texture.image, 0u);
    EXPECT_EQ(scan.materials[1].normal_scale, 0.5f);
    EXPECT_EQ(scan.images.at(0).flags, kImageNormalMap);
    EXPECT_EQ(scan.mesh.tangents.size(), scan.mesh.vertexCount());
}

TEST(ImportScan, normalMapsOfTwoChannelsGetTheirZ)
{
    const TemporaryFolder folder;
    write(folder, "a.mtl", "newmtl m\nmap_Bump n.tga\n");
    write(folder, "n.tga",
          std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\0\x80\x80", 21)); // 1 x 1 texel
    const Imported scan =
        import(importScan, folder, "a.obj", "mtllib a.mtl\n" + kQuad + "usemtl m\nf 1/1 2/2 3/3\n");
    EXPECT_TRUE(scan.warnings.empty());
    ASSERT_EQ(scan.first_image.size(), 4u);
    EXPECT_EQ(scan.first_image[0], std::byte{128});
    EXPECT_EQ(scan.first_image[2], std::byte{255});
}

TEST(ImportScan, aPlyTakesTheTextureItNames)
{
    const TemporaryFolder folder;
    write(folder, "t.png", toText(test::kPngRgba8));
    const Imported scan = import(importScan, folder, "a.ply",
                                 "ply\nformat ascii 1.0\ncomment TextureFile t.png\nelement vertex "
                                 "3\nproperty float x\nproperty float y\nproperty float z\n"
                                 "property float s\nproperty float t\nelement face 1\nproperty list uchar "
                                 "int vertex_indices\nend_header\n"
                                 "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    ASSERT_TRUE(scan.status.ok());
    ASSERT_EQ(scan.materials.size(), 1u);
    EXPECT_EQ(scan.materials[0].base_color_texture.image, 0u);
}

TEST(ImportImage, anImageBecomesAnUnlitCard)
{
    const TemporaryFolder folder;
    const Imported card = import(importImage, folder, "t.png", toText(test::kPngGrey8));
    ASSERT_TRUE(card.status.ok());
    EXPECT_EQ(card.counts.triangles, 2u);
    EXPECT_EQ(card.counts.vertices, 4u);
    EXPECT_EQ(card.materials.at(0).flags, kMaterialUnlit);
    EXPECT_EQ(card.materials.at(0).alpha_mode, static_cast<uint32_t>(AlphaMode::opaque));
    EXPECT_EQ(card.images.at(0).width, 5u);
    EXPECT_EQ(card.mesh.positions[0], (Float3{-5.0f / 6, -0.5f, 0}));
    EXPECT_EQ(card.mesh.uvs[0][3], (Float2{0, 0})); // upper left
    EXPECT_EQ(card.mesh.positions[3], (Float3{-5.0f / 6, 0.5f, 0}));
}

TEST(ImportImage, lightStaysFloatAndTransparencyBlends)
{
    const TemporaryFolder folder;
    EXPECT_EQ(import(importImage, folder, "a.exr", toText(test::kExrZip)).images.at(0).format,
              static_cast<uint32_t>(TexelFormat::rgba16_float));
    EXPECT_EQ(import(importImage, folder, "a.png", toText(test::kPngRgba8)).materials.at(0).alpha_mode,
              static_cast<uint32_t>(AlphaMode::blend));
}

TEST(ImportImage, aCardWithoutOpacityIsOpaque)
{
    // a TGA of one texel with an alpha of 0, and an extension area of attributes type 2
    std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28\x80\x80\x80\0", 22);
    tga += std::string(494, '\0') + '\2' + std::string("\x16\0\0\0\0\0\0\0TRUEVISION-XFILE.\0", 26);
    const TemporaryFolder folder;
    const Imported card = import(importImage, folder, "a.tga", tga);
    ASSERT_TRUE(card.status.ok()) << formatMessage(card.status.error());
    EXPECT_EQ(card.materials.at(0).alpha_mode, static_cast<uint32_t>(AlphaMode::opaque));
    EXPECT_TRUE(card.warned(Issue::image_alpha, "attributes type 2"));
    write(folder, "a.tga", tga);
    write(folder, "a.mtl", "newmtl m\nmap_Kd a.tga\n");
    const Imported quad =
        import(importScan, folder, "a.obj", "mtllib a.mtl\nusemtl m\n" + kQuad + "f 1/1 2/2 3/3 4/4\n");
    ASSERT_TRUE(quad.status.ok()) << formatMessage(quad.status.error());
    EXPECT_TRUE(quad.warned(Issue::image_alpha, "image 'a.tga' of material 'm': alpha is not opacity"));
}

TEST(ImportImage, aDamagedImageLeavesNothing)
{
    const TemporaryFolder folder;
    const Imported card = import(importImage, folder, "t.png", toText(test::kPngRgba8).substr(0, 50));
    EXPECT_EQ(card.status.error().issue, Issue::image_malformed);
    EXPECT_TRUE(folder.files().empty());
}

} // namespace

} // namespace hearth::import
