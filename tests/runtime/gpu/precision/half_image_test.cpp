// Tests that half precision does not show: images of scenes where every relaxed value of the shaders is a
// half, beside images in full precision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/flip.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/precision/relaxed_precision.h"
#include "tests/runtime/gpu/precision/shader_rewriter.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kHalfWidth = 320, kHalfHeight = 180;

/// Largest FLIP between half and full precision where surfaces cover a quarter of the image, and largest
/// difference of a channel. FLIP counts pixels that round to the next step of 255.
constexpr double kMaxHalfFlip = 0.002;
constexpr int kMaxHalfStep = 1;

/// Return a normal map of bumps, and a map of their roughness and metalness.
std::vector<uint32_t> makeBumps(uint32_t size, bool normals)
{
    std::vector<uint32_t> texels;
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x)
        {
            const float u = 0.7f * std::sin(static_cast<float>(x) * 0.8f);
            const float v = 0.7f * std::cos(static_cast<float>(y) * 0.5f);
            const Float3 n = normalizeOr({u, v, 1}, {});
            const auto byte = [](float value) { return static_cast<uint32_t>(value * 127 + 128); };
            texels.push_back(normals ? byte(n.x) | byte(n.y) << 8 | byte(n.z) << 16
                                     : byte(u) | byte(v * 0.8f) << 8 | byte(u * v) << 16);
        }
    return texels;
}

/// Scene of the comparison.
struct HalfScene
{
    TestScene test;
    std::vector<MaterialLayersRecord> layers;
    uint32_t sphere = 0;

    explicit HalfScene(bool visibility = false)
    {
        clusters::Config config;
        config.visibility = visibility;
        mesh_config = config;
    }

    /// Add a sphere of diameter 0.9 in the column and row of a field of eight by four.
    void addSphere(const MaterialRecord& material, uint32_t column, uint32_t row)
    {
        const uint32_t index = test.addMaterial(material);
        mesh::SourceMesh mesh = withMaterial(shapes::rock(16, 0), index);
        test.addInstance(test.addMesh(mesh, mesh_config), scaled(0.47f, {static_cast<float>(column) - 3.5f,
                                                                         1.5f - static_cast<float>(row), 0}));
    }

    /// Fill the field: roughness rises from left to right, metalness from top to bottom.
    void addSpheres(const std::function<void(MaterialRecord&, uint32_t index)>& change = {})
    {
        for (uint32_t row = 0; row < 4; ++row)
            for (uint32_t column = 0; column < 8; ++column)
            {
                MaterialRecord material = plainMaterial();
                const float hue = static_cast<float>(column + 2 * row);
                material.base_color = {0.5f + 0.45f * std::sin(hue), 0.5f + 0.45f * std::sin(hue + 2),
                                       0.5f + 0.45f * std::sin(hue + 4), 1};
                material.roughness = static_cast<float>(column) / 7;
                material.metallic = static_cast<float>(row) / 3;
                if (change)
                    change(material, row * 8 + column);
                addSphere(material, column, row);
            }
    }

    clusters::Config mesh_config;
};

class HalfImageTest : public GpuTest
{
protected:
    /// Draw a scene with shaders that are rewritten, or as they are.
    viewer::Image drawWith(const PackView& pack, const gpu::SceneOptions& options, uint32_t frames,
                           const RewriteShader& rewrite)
    {
        gpu::DeviceDescription description = host().description();
        if (rewrite)
            description = rewriteShaders(description, rewrite);
        auto created = gpu::Renderer::create(description);
        HEARTH_ASSERT(created.ok());
        gpu::Renderer& renderer = **created;
        std::unique_ptr<gpu::Scene> scene;
        Status status = host().run(
            [&](VkCommandBuffer commands) -> Status
            {
                HEARTH_ASSIGN_OR_RETURN(scene, renderer.upload(pack, commands, options));
                return success();
            });
        HEARTH_ASSERT(status.ok());
        scene->staging.reset();
        auto targets = renderer.createTargets({kHalfWidth, kHalfHeight});
        HEARTH_ASSERT(targets.ok());
        const shared::FrameView view = makeView(
            *scene, {.position = {1, 2, 14}, .target = {0, 0, 0}, .y_fov_rad = 0.6f, .z_near = 0.01f},
            {.width = kHalfWidth, .height = kHalfHeight});
        for (uint32_t i = 0; i < frames && status.ok(); ++i)
            status = host().run(
                [&](VkCommandBuffer commands)
                {
                    renderer.record(commands, *scene, *targets, {.view = view});
                    return success();
                });
        auto color = host().read(renderer.device(), targets->color(), 4);
        HEARTH_ASSERT(status.ok() && color.ok());
        viewer::Image image(kHalfWidth, kHalfHeight);
        for (size_t i = 0; i < size_t{kHalfWidth} * kHalfHeight; ++i)
            std::memcpy(&image.rgb[3 * i], color->data() + 4 * i, 3);
        return image;
    }

    /// Compare images of a scene: half precision does not show.
    void compare(const char* name, TestScene& test, const gpu::SceneOptions& options = {},
                 uint32_t frames = 1)
    {
        const PackView pack = test.build();
        const viewer::Image full = drawWith(pack, options, frames, {});
        const viewer::Image half = drawWith(pack, options, frames, roundRelaxedToHalf);
        const double shown = viewer::flip(full, half).mean();
        int largest = 0;
        for (size_t i = 0; i < full.rgb.size(); ++i)
            largest = std::max(largest, std::abs(full.rgb[i] - half.rgb[i]));
        std::printf("%-14s FLIP %.5f, largest step %d\n", name, shown, largest);
        EXPECT_LE(shown, kMaxHalfFlip) << name;
        EXPECT_GT(shown, 0) << name; // the halves are there
        EXPECT_LE(largest, kMaxHalfStep) << name;
    }
};

} // namespace

TEST_F(HalfImageTest, spheresUnderSunAndLamps)
{
    HalfScene scene;
    scene.addSpheres();
    scene.test.addLight(sun({0.5f, -0.8f, -0.6f}));
    scene.test.addLight(light(LightType::point, {-3, 2, 1.5f}, {0, -1, 0}, 8));
    scene.test.addLight(light(LightType::spot, {3, 0, 3}, {0, 0, -1}, 20));
    compare("spheres", scene.test);
}

/// The comparison sees precision that is too small: that of everything that shading computes.
TEST_F(HalfImageTest, findsTooLittlePrecision)
{
    HalfScene scene;
    scene.addSpheres();
    const PackView pack = scene.test.build();
    const auto roundAll = [](std::span<const uint32_t> words)
    {
        return roundRelaxedToHalf(hasRelaxedPrecision(words) ? relaxEverything(words)
                                                             : std::vector(words.begin(), words.end()));
    };
    EXPECT_GT(viewer::flip(drawWith(pack, {}, 1, {}), drawWith(pack, {}, 1, roundAll)).mean(),
              10 * kMaxHalfFlip);
}

/// Daylight in lux, and a lamp that touches a sphere.
TEST_F(HalfImageTest, strongLights)
{
    HalfScene scene;
    scene.addSpheres();
    scene.test.addInstance(scene.test.addMesh(makeQuad(12, 12)), lying({0, -2.1f, 0}));
    LightRecord daylight = sun({0.5f, -0.8f, -0.6f});
    daylight.intensity = 100000;
    scene.test.addLight(daylight);
    scene.test.addLight(light(LightType::point, {-0.52f, 0.52f, 0.52f}, {0, -1, 0}, 500000));
    compare("strong lights", scene.test, {.shadows = {.max_maps = 12}});
}

TEST_F(HalfImageTest, texturesAndNormalMaps)
{
    HalfScene scene;
    const uint32_t normals = scene.test.addImage(TexelFormat::rgba8_unorm, 64, 64, makeBumps(64, true));
    const uint32_t data = scene.test.addImage(TexelFormat::rgba8_unorm, 64, 64, makeBumps(64, false));
    const uint32_t color = scene.test.addImage(TexelFormat::rgba8_srgb, 64, 64, makeBumps(64, false));
    scene.addSpheres(
        [&](MaterialRecord& material, uint32_t index)
        {
            material.base_color_texture = makeTextureRef(color);
            material.normal_texture = makeTextureRef(normals);
            material.metallic_roughness_texture =
                index % 2 == 0 ? makeTextureRef(data) : material.metallic_roughness_texture;
            material.occlusion_texture = makeTextureRef(data);
            material.emissive_texture = makeTextureRef(color);
            material.emissive = {index % 5 == 0 ? 0.4f : 0, 0, 0.05f};
        });
    scene.test.addLight(sun({0.5f, -0.8f, -0.6f}));
    compare("textures", scene.test);
}

TEST_F(HalfImageTest, layers)
{
    HalfScene scene;
    scene.addSpheres(
        [&](MaterialRecord&, uint32_t index)
        {
            MaterialLayersRecord layers = neutralLayers(index);
            const float roughness = static_cast<float>(index % 8) / 7;
            if (index < 16)
            {
                layers.clearcoat = index < 8 ? 1 : 0.5f;
                layers.clearcoat_roughness = roughness;
            }
            else
            {
                layers.sheen_color = {0.9f, 0.3f, 0.6f};
                layers.sheen_roughness = roughness;
                layers.ior = index < 24 ? 1.5f : 2.4f;
            }
            scene.layers.push_back(layers);
        });
    scene.test.model().material_layers = scene.layers;
    scene.test.addLight(sun({0.5f, -0.8f, -0.6f}));
    scene.test.addLight(light(LightType::point, {-3, 2, 1.5f}, {0, -1, 0}, 8));
    compare("layers", scene.test);
}

/// Cones of all widths, some of them nearly closed.
TEST_F(HalfImageTest, skyVisibility)
{
    HalfScene scene(true);
    const uint32_t normals = scene.test.addImage(TexelFormat::rgba8_unorm, 64, 64, makeBumps(64, true));
    scene.addSpheres(
        [&](MaterialRecord& material, uint32_t index)
        {
            if (index % 2 == 0)
                material.normal_texture = makeTextureRef(normals);
        });
    scene.test.setVisibility(
        [](uint32_t mesh, Float3 p, Float3 n)
        {
            const float number = static_cast<float>(mesh);
            const Float3 lean{std::sin(3 * p.x + p.y + number), std::cos(2 * p.y), std::sin(4 * p.z)};
            const Float3 axis = normalizeOr(n + lean * 0.6f, n);
            const float cosine = 0.5f + 0.5f * std::sin(5 * p.x - 2 * p.z + number);
            const float scale = 0.5f + 0.5f * std::cos(3 * p.y + p.z);
            const float pi = shared::kVisibilityPi;
            return shared::VisibilityMoments{2 * pi * scale * (1 - cosine),
                                             axis * (pi * scale * (1 - cosine * cosine))};
        });
    compare("visibility", scene.test);
}

/// Light of bricks: a shell around the spheres, of which one side glows.
TEST_F(HalfImageTest, bricks)
{
    HalfScene scene;
    scene.addSpheres();
    constexpr std::array<uint32_t, 3> kShell{24, 16, 24};
    BrickModel shell = brickModel(
        kShell, [](uint32_t x, uint32_t y, uint32_t) { return y < 2 || x < 2; },
        [](std::array<uint32_t, 3> voxel, uint32_t side)
        {
            const bool glows = side == 1 && voxel[0] == 1;
            return FaceLook{{0.4f, 0.5f, 0.6f}, glows ? Float3{2, 0.5f, 0.3f} : Float3{}};
        });
    shell.grid.origin = {-6, -3, -6};
    shell.grid.voxel_size = 0.5f;
    setBricks(scene.test, shell);
    scene.test.addLight(sun({0.5f, -0.8f, -0.6f}));
    compare("bricks", scene.test, {}, 8);
}

} // namespace hearth::test
