// Tests the layers of materials (reflectance of dielectrics, sheen, clear coat) against the material model of
// the reference: pixel by pixel under lights and the cones of the sky, and as images of spheres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/reflectance.h"
#include "formats/scene/sheen.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/reference_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>

namespace hearth::test
{

namespace
{

using namespace formats;
using reference::Coating;
using reference::Double3;

constexpr uint32_t kSize = 48;
constexpr float kYFov = 0.6f;

/// Material with layers, and what they are worth at each point.
struct LayeredCase
{
    const char* name;
    MaterialRecord base = plainMaterial();
    MaterialLayersRecord layers = neutralLayers(0);
};

LayeredCase makeCase(const char* name, Float3 color, float metallic, float roughness)
{
    LayeredCase made{.name = name};
    made.base.base_color = {color.x, color.y, color.z, 1};
    made.base.metallic = metallic;
    made.base.roughness = roughness;
    return made;
}

std::vector<LayeredCase> layeredCases()
{
    std::vector<LayeredCase> cases;
    const auto add = [&](const char* name, Float3 color, float metallic, float roughness,
                         const std::function<void(MaterialLayersRecord&)>& change)
    {
        cases.push_back(makeCase(name, color, metallic, roughness));
        change(cases.back().layers);
    };
    add("water", {0.1f, 0.2f, 0.3f}, 0, 0.2f, [](auto& l) { l.ior = 1.33f; });
    add("diamond", {0.1f, 0.1f, 0.1f}, 0, 0.2f, [](auto& l) { l.ior = 2.42f; });
    add("reflects all", {0.5f, 0.5f, 0.5f}, 0, 0.3f, [](auto& l) { l.ior = 0; });
    add("no reflection", {0.5f, 0.5f, 0.5f}, 0, 0.3f, [](auto& l) { l.specular = 0; });
    add("coloured reflection", {0.2f, 0.2f, 0.2f}, 0.3f, 0.3f,
        [](auto& l)
        {
            l.specular = 0.6f;
            l.specular_color = {9, 2, 0.2f};
        });
    add("lacquer", {0.8f, 0.05f, 0.02f}, 1, 0.6f,
        [](auto& l)
        {
            l.clearcoat = 1;
            l.clearcoat_roughness = 0.1f;
        });
    add("worn lacquer", {0.1f, 0.2f, 0.6f}, 0, 0.3f,
        [](auto& l)
        {
            l.clearcoat = 0.6f;
            l.clearcoat_roughness = 0.7f;
        });
    add("velvet", {0.05f, 0.01f, 0.03f}, 0, 0.9f,
        [](auto& l)
        {
            l.sheen_color = {0.9f, 0.3f, 0.6f};
            l.sheen_roughness = 0.35f;
        });
    add("satin", {0.4f, 0.4f, 0.3f}, 0, 0.5f,
        [](auto& l)
        {
            l.sheen_color = {0.2f, 0.5f, 1};
            l.sheen_roughness = 0.1f;
        });
    add("wool", {0.6f, 0.5f, 0.4f}, 0, 1,
        [](auto& l)
        {
            l.sheen_color = {1, 1, 1};
            l.sheen_roughness = 1;
        });
    add("everything", {0.5f, 0.2f, 0.1f}, 0.2f, 0.5f,
        [](auto& l)
        {
            l.ior = 1.8f;
            l.specular = 0.7f;
            l.specular_color = {1, 0.8f, 0.5f};
            l.clearcoat = 0.8f;
            l.clearcoat_roughness = 0.2f;
            l.sheen_color = {0.3f, 0.6f, 0.4f};
            l.sheen_roughness = 0.6f;
        });
    return cases;
}

/// Material of the reference at every point of a square that faces +z.
Coating makeCoating(const LayeredCase& c)
{
    Coating coating;
    coating.base = Double3(Float3{c.base.base_color.x, c.base.base_color.y, c.base.base_color.z});
    coating.metallic = double{c.base.metallic};
    coating.roughness = double{c.base.roughness};
    coating.occlusion = 1;
    coating.emitted = Double3(c.base.emissive);
    coating.normal = coating.clearcoat_normal = {0, 0, 1};
    const double ratio = (double{c.layers.ior} - 1) / (double{c.layers.ior} + 1);
    const auto f0 = [&](float color)
    { return std::min(ratio * ratio * double{color}, 1.0) * double{c.layers.specular}; };
    coating.dielectric_f0 = {f0(c.layers.specular_color.x), f0(c.layers.specular_color.y),
                             f0(c.layers.specular_color.z)};
    coating.dielectric_f90 = double{c.layers.specular};
    coating.sheen = Double3(c.layers.sheen_color);
    coating.sheen_roughness = double{c.layers.sheen_roughness};
    coating.clearcoat = double{c.layers.clearcoat};
    coating.clearcoat_roughness = double{c.layers.clearcoat_roughness};
    return coating;
}

Float3 narrow(Double3 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sky light by the cones that shading takes, whose means the reference integrates.
Double3 skyByCones(const Coating& c, const reference::SceneLighting& lighting, Double3 view)
{
    const auto mean = [&](const shared::LightCone& cone)
    {
        const double height = std::clamp(double{cone.axis.y}, -1.0, 1.0);
        return lighting.coneRadiance({std::sqrt(1 - height * height), height, 0},
                                     double{cone.cos_half_angle});
    };
    const auto mirrored = [&](double roughness, Double3 normal)
    {
        const float facing = std::abs(static_cast<float>(dot(normal, view)));
        const Double3 mirror = normal * (2 * dot(normal, view)) - view;
        return mean(shared::lobeCone(shared::lobeTotal(static_cast<float>(roughness), facing), narrow(mirror),
                                     narrow(normal)));
    };
    const shared::SheenTotal total = shared::sheenTotal(static_cast<float>(c.sheen_roughness),
                                                        std::abs(static_cast<float>(dot(c.normal, view))));
    const shared::LightCone sheen = shared::sheenCone(total, narrow(view), narrow(c.normal));
    const reference::Albedo part = reference::albedo(c, view);
    return part.diffuse * mean(shared::cosineCone(narrow(c.normal))) +
           part.specular * mirrored(c.roughness, c.normal) + part.sheen * mean(sheen) +
           mirrored(c.clearcoat_roughness, c.clearcoat_normal) * part.clearcoat;
}

double srgb(double radiance)
{
    const double linear = reference::filmic(radiance);
    return 255 * (linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// Square in the plane z = 0 under a sun and a lamp, seen at several elevations.
class LayersTest : public GpuTest
{
protected:
    static shared::Camera camera(double elevation)
    {
        const double distance = 3;
        return {.position = narrow({0, -distance * std::cos(elevation), distance * std::sin(elevation)}),
                .target = {0, 0, 0},
                .up = {0, 0, 1},
                .y_fov_rad = kYFov,
                .z_near = 0.01f};
    }

    static void addLights(TestScene& test)
    {
        LightRecord sun{};
        sun.type = static_cast<uint32_t>(LightType::directional);
        sun.color = {1, 1, 0.9f};
        sun.intensity = 0.7f;
        // shines along (0, 0.8, -0.6), towards the eyes of low cameras
        sun.world_from_light = {{{1, 0, 0, 0}, {0, 0.6f, -0.8f, 0}, {0, 0.8f, 0.6f, 0}}};
        test.addLight(sun);
        LightRecord lamp{};
        lamp.type = static_cast<uint32_t>(LightType::point);
        lamp.color = {0.6f, 0.8f, 1};
        lamp.intensity = 0.5f;
        lamp.world_from_light = translated({0.4f, -0.6f, 0.9f});
        test.addLight(lamp);
    }

    /// Compare an image of a square with what the coating gives at each point.
    void expectCoating(TestScene& test, const LayeredCase& c, const Coating& coating)
    {
        test.model().material_layers = {c.layers};
        mesh::SourceMesh square = withMaterial(makeQuad(1.6f, 1.6f), test.addMaterial(c.base));
        test.addInstance(test.addMesh(square), Affine3{});
        addLights(test);
        const PackView pack = test.build();
        const auto scene = upload(pack);
        const reference::SceneLighting lighting = reference::readLighting(pack);
        for (const double elevation : {1.5, 0.7, 0.25, 0.1})
        {
            const Image image = draw(*scene, camera(elevation), {.width = kSize, .height = kSize});
            const size_t compared = compare(image, c, coating, lighting, elevation);
            EXPECT_GT(compared, elevation < 0.2 ? 30u : 100u) << c.name << ' ' << elevation;
        }
    }

    size_t compare(const Image& image, const LayeredCase& c, const Coating& coating,
                   const reference::SceneLighting& lighting, double elevation)
    {
        const shared::Camera seen = camera(elevation);
        const Double3 eye(seen.position), forward = normalize(-eye);
        const Double3 right = normalize(cross(forward, Double3(seen.up))), up = cross(right, forward);
        const double slope = std::tan(double{kYFov} / 2);
        size_t compared = 0, wrong = 0;
        for (uint32_t y = 0; y < kSize; ++y)
            for (uint32_t x = 0; x < kSize; ++x)
            {
                const Double3 ray = forward + right * ((2 * (x + 0.5) / kSize - 1) * slope) +
                                    up * ((1 - 2 * (y + 0.5) / kSize) * slope);
                if (ray.z >= 0)
                    continue;
                const Double3 point = eye - ray * (eye.z / ray.z);
                if (std::max(std::abs(point.x), std::abs(point.y)) > 0.75)
                    continue;
                ++compared;
                const Double3 view = normalize(eye - point);
                Double3 radiance = emitted(coating, view) + skyByCones(coating, lighting, view);
                for (const reference::SceneLight& light : lighting.lights)
                {
                    const reference::Incident incident = light.at(point);
                    radiance += incident.irradiance * reflected(coating, view, incident.to_light);
                }
                const double wanted[3] = {srgb(radiance.x), srgb(radiance.y), srgb(radiance.z)};
                for (int i = 0; i < 3; ++i)
                    if (std::abs(channel(image.at(x, y), i) - wanted[i]) > 2 && ++wrong < 4)
                        ADD_FAILURE() << c.name << ", elevation " << elevation << ", pixel " << x << ' ' << y
                                      << ", channel " << i << ": " << channel(image.at(x, y), i)
                                      << ", by the reference " << wanted[i];
            }
        EXPECT_EQ(wrong, 0u) << c.name << ", elevation " << elevation;
        return compared;
    }
};

uint32_t texel(uint32_t r, uint32_t g, uint32_t b, uint32_t a)
{
    return r | g << 8 | b << 16 | a << 24;
}

} // namespace

TEST_F(LayersTest, reflectAsTheReferenceSays)
{
    for (const LayeredCase& c : layeredCases())
    {
        TestScene test;
        expectCoating(test, c, makeCoating(c));
    }
}

TEST_F(LayersTest, dimEmissionBelowACoat)
{
    LayeredCase c = makeCase("glowing lacquer", {0, 0, 0}, 0, 1);
    c.base.emissive = {0.5f, 0.3f, 0.1f};
    c.layers.clearcoat = 1;
    c.layers.clearcoat_roughness = 0.3f;
    TestScene test;
    expectCoating(test, c, makeCoating(c));
}

/// Each channel of each texture counts where glTF says, and nowhere else.
TEST_F(LayersTest, multiplyByTheirTextures)
{
    LayeredCase c = makeCase("textured", {0.5f, 0.4f, 0.3f}, 0, 0.4f);
    c.layers.ior = 2;
    c.layers.clearcoat = 0.9f;
    c.layers.clearcoat_roughness = 0.8f;
    c.layers.sheen_color = {0.9f, 0.8f, 0.7f};
    c.layers.sheen_roughness = 0.9f;
    LayeredCase factors = c;
    const auto linear = [](uint32_t byte)
    {
        const double x = byte / 255.0;
        return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
    };
    TestScene test;
    const uint32_t color = test.addImage(TexelFormat::rgba8_srgb, 1, 1, {texel(200, 150, 100, 128)});
    const uint32_t data = test.addImage(TexelFormat::rgba8_unorm, 1, 1, {texel(204, 102, 3, 7)});
    // (0.36, 0.48, 0.8)
    const uint32_t tilt = test.addImage(TexelFormat::rgba8_unorm, 1, 1, {texel(173, 189, 230, 0)});
    c.layers.specular_texture = c.layers.sheen_texture = makeTextureRef(color);
    c.layers.clearcoat_texture = makeTextureRef(data);
    c.layers.clearcoat_normal_texture = makeTextureRef(tilt);
    c.layers.clearcoat_normal_scale = 0.5f;
    const Float3 rgb{linear(200), linear(150), linear(100)};
    factors.layers.specular_color = rgb;
    factors.layers.specular = 128 / 255.0f;
    factors.layers.sheen_color = factors.layers.sheen_color * rgb;
    factors.layers.sheen_roughness *= 128 / 255.0f;
    factors.layers.clearcoat *= 204 / 255.0f;
    factors.layers.clearcoat_roughness *= 102 / 255.0f;
    Coating coating = makeCoating(factors);
    const auto decoded = [](int byte) { return byte / 255.0 * 2 - 1; };
    coating.clearcoat_normal = normalize(Double3{decoded(173) * 0.5, decoded(189) * 0.5, decoded(230)});
    expectCoating(test, c, coating);
}

/// Each texture makes one half of a black square brighter, by a UV set and a transform of its own.
TEST_F(LayersTest, followTheUvTransformsOfTheirTextures)
{
    for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
    {
        TestScene test;
        LayeredCase c = makeCase("halves", {0, 0, 0}, 0, 0.5f);
        if (texture == &MaterialLayersRecord::specular_texture)
            c.layers.ior = 0;
        else
            c.layers.specular = 0;
        if (texture == &MaterialLayersRecord::sheen_texture)
        {
            c.layers.sheen_color = {1, 1, 1};
            c.layers.sheen_roughness = 1;
        }
        const bool normals = texture == &MaterialLayersRecord::clearcoat_normal_texture;
        if (normals || texture == &MaterialLayersRecord::clearcoat_texture)
        {
            c.layers.clearcoat = 1;
            c.layers.clearcoat_roughness = 0.3f;
        }
        const uint32_t bright = normals ? texel(128, 128, 255, 255) : texel(250, 250, 250, 250);
        const uint32_t dark = normals ? texel(128, 20, 160, 255) : texel(5, 5, 5, 5);
        TextureRef& reference = c.layers.*texture;
        reference = makeTextureRef(test.addImage(TexelFormat::rgba8_unorm, 2, 1, {bright, dark}));
        reference.nearest = 1;
        reference.uv_set = 1;
        // the new u is the old v
        const float transform[6] = {0, 1, 0, 1, 0, 0};
        std::copy(std::begin(transform), std::end(transform), reference.uv_transform);
        test.model().material_layers = {c.layers};
        mesh::SourceMesh square = withMaterial(makeQuad(1.6f, 1.6f), test.addMaterial(c.base));
        square.uvs[1] = square.uvs[0];
        square.uvs[0].assign(4, {0.25f, 0.25f});
        test.addInstance(test.addMesh(square), Affine3{});
        LightRecord night{};
        night.color = {1, 1, 1};
        test.addLight(night);
        const PackView pack = test.build();
        const Image image = draw(*upload(pack), camera(0.7), {.width = kSize, .height = kSize});
        const auto at = [&](uint32_t x, uint32_t y) { return channel(image.at(x, y), 1); };
        EXPECT_NEAR(at(kSize / 2 - 8, kSize / 2 - 4), at(kSize / 2 + 8, kSize / 2 - 4), 2);
        EXPECT_GT(at(kSize / 2, kSize / 2 - 4), at(kSize / 2, kSize / 2 + 4) + 12);
    }
}

/// A material without layers is shaded as if the pack had none.
TEST_F(LayersTest, leaveOtherMaterialsAlone)
{
    const auto drawWith = [&](bool layered)
    {
        TestScene test;
        const uint32_t plain = test.addMaterial(plainMaterial());
        const uint32_t other = test.addMaterial(plainMaterial());
        if (layered)
        {
            MaterialLayersRecord layers = neutralLayers(other);
            layers.clearcoat = 1;
            test.model().material_layers = {layers};
        }
        test.addInstance(test.addMesh(withMaterial(makeQuad(1.6f, 1.6f), plain)), Affine3{});
        addLights(test);
        const PackView pack = test.build();
        return draw(*upload(pack), camera(0.7), {.width = kSize, .height = kSize}).color;
    };
    EXPECT_EQ(drawWith(true), drawWith(false));
}

/// The sky over whole lobes, at all angles: cones stand for it in the renderer.
TEST_F(LayersTest, imagesOfSpheresAreWhatRaysGive)
{
    mesh::SourceMesh sphere = shapes::rock(24, 0);
    for (const LayeredCase& c : layeredCases())
    {
        TestScene test;
        test.model().material_layers = {c.layers};
        test.addInstance(test.addMesh(withMaterial(sphere, test.addMaterial(c.base))), Affine3{});
        addLights(test);
        const PackView pack = test.build();
        const shared::Camera front{
            .position = {0, 0.3f, 4}, .target = {0, 0, 0}, .y_fov_rad = kYFov, .z_near = 0.01f};
        const Image drawn = draw(*upload(pack), front, {.width = 128, .height = 128, .error_pixels = 0});
        reference::ReferenceOptions options;
        options.camera = front;
        options.width = options.height = 128;
        options.samples_per_side = 1;
        const auto expected = reference::renderReference(pack, options);
        ASSERT_TRUE(expected.ok()) << formatMessage(expected.error());
        double sum = 0;
        size_t pixels = 0;
        for (uint32_t i = 0; i < 128 * 128; ++i)
            if (drawn.visibility[i] != shared::kVisibilitySky)
            {
                for (int j = 0; j < 3; ++j)
                    sum +=
                        std::abs(channel(drawn.color[i], j) - expected->rgb[3 * i + static_cast<size_t>(j)]);
                pixels += 3;
            }
        std::printf("%-20s mean difference %.2f of 255\n", c.name, sum / static_cast<double>(pixels));
        EXPECT_GT(pixels, 3 * 2000u);
        EXPECT_LT(sum / static_cast<double>(pixels), 3) << c.name;
    }
}

} // namespace hearth::test
