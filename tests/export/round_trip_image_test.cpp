// Draws packs before and after a way to glTF and back: people see no difference.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/round_trip.h"
#include "tests/reference/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace hearth::test
{

namespace
{

using reference::Image;

/// Return a camera, as hearth-render's option, that has all instances in its picture.
std::string frameScene(const formats::PackView& pack)
{
    Box3 box;
    for (const formats::InstanceRecord& instance : pack.instances())
        for (int corner = 0; corner < 8; ++corner)
        {
            const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
            box.add(transformPoint(instance.world_from_object,
                                   {(corner & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                                    (corner & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                                    (corner & 4) != 0 ? mesh.box_max.z : mesh.box_min.z}));
        }
    const Float3 center = (box.min + box.max) * 0.5f, size = box.max - box.min;
    const float distance = std::sqrt(dot(size, size)) * 1.2f;
    std::ostringstream camera;
    camera << center.x + distance * 0.6f << ',' << center.y + distance * 0.3f << ','
           << center.z + distance * 0.74f << ',' << center.x << ',' << center.y << ',' << center.z << ",45";
    return camera.str();
}

/// Draw the finest triangles of a pack with hearth-render.
Image draw(Sandbox& folder, const std::string& pack, const std::string& camera)
{
    const ProgramEnd end =
        folder.run({HEARTH_BIN "/hearth-render", pack, "-o", "drawn.png", "--size", "320x240", "--samples",
                    "1", "--camera", camera, "--error-pixels", "0"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    auto image = reference::readPng(folder / "drawn.png");
    EXPECT_TRUE(image.ok());
    return image.ok() ? std::move(*image) : Image(1, 1);
}

void expectSamePicture(const std::string& source, const std::string& name)
{
    constexpr double kMaxFlip = .002;
    const RoundTrip trip(source, plainTexels());
    ASSERT_EQ(trip.fault(), "") << name;
    Sandbox folder;
    const std::string camera = frameScene(trip.first());
    const Image first = draw(folder, trip.firstPath(), camera),
                second = draw(folder, trip.secondPath(), camera);
    const double difference = reference::flip(first, second).mean();
    std::printf("%-24s FLIP %.5f\n", name.c_str(), difference);
    EXPECT_LE(difference, kMaxFlip) << name;
    Image black = first;
    std::fill(black.rgb.begin(), black.rgb.end(), uint8_t{0});
    EXPECT_GT(reference::flip(first, black).mean(), 10 * kMaxFlip) << name << " shows nothing";
    if (const char* const kept = std::getenv("HEARTH_KEEP_IMAGES"))
        for (const auto& [image, suffix] : {std::pair(&first, "_first"), std::pair(&second, "_second")})
            EXPECT_TRUE(reference::writePng(std::string(kept) + "/" + name + suffix + ".png", *image).ok());
}

} // namespace

TEST(RoundTripImage, ofSamplesIsTheSame)
{
    Sandbox folder;
    for (const char* kind : {"room", "character", "grass", "spheres"})
    {
        ASSERT_EQ(folder
                      .run({HEARTH_BIN "/hearth-samples", kind, "--triangles", "6000", "--texture-size", "64",
                            "-o", "sample.glb"})
                      .exit_code,
                  0);
        expectSamePicture(folder / "sample.glb", kind);
    }
}

TEST(RoundTripImage, ofModelsIsTheSame)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    for (const char* model : {"animation/milktruck/CesiumMilkTruck.gltf", "skinned/fox/Fox.glb",
                              "extensions/pbr_next_all/sphere.gltf", "alpha/sunflower/sunflower.gltf",
                              "pbr-embedded/specular_test/SpecularTest.glb",
                              "texture-transform/texture_transform_blender/09_texture_transform.gltf"})
    {
        const std::string path = std::string(assets) + "/good/" + model;
        const size_t name = path.rfind('/') + 1;
        expectSamePicture(path, path.substr(name, path.rfind('.') - name));
    }
}

} // namespace hearth::test
