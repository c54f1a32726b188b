// Tests the parts of the ray-traced reference against values that can be computed by hand.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/shading.h"
#include "tests/reference/tracer/embree_scene.h"
#include "tests/reference/tracer/gltf_material.h"
#include "tests/reference/tracer/reference_renderer.h"
#include "tests/reference/tracer/texture_lookup.h"
#include "tests/support/small_pack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hearth::reference
{
namespace
{

using namespace formats;

constexpr double kPi = 3.14159265358979323846;

/// A pack in memory and its view.
struct HeldPack
{
    test::AlignedBytes bytes;
    PackView view;

    explicit HeldPack(const test::PackModel& model)
        : bytes(model.bytes()),
          view(PackView::read(ContainerReader::fromBytes(bytes.span(), "held.hearth").value()).value())
    {
    }
};

Coating makeCoating(double roughness, double metallic)
{
    return {{0.8, 0.5, 0.2}, metallic, roughness, 1, {}, {0, 1, 0}};
}

Double3 direction(double elevation, double azimuth)
{
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
            std::cos(elevation) * std::sin(azimuth)};
}

/// Midpoint and width of each part of [0, end], dense about `peak` by the fourth power.
std::vector<std::array<double, 2>> denseAbout(double peak, double end)
{
    constexpr int kSteps = 250;
    std::vector<std::array<double, 2>> found;
    for (const double to : {0.0, end})
        for (int i = 0; i < kSteps && to != peak; ++i)
        {
            const double low = std::pow(double{1} * i / kSteps, 4), high = std::pow((i + 1.0) / kSteps, 4);
            found.push_back({peak + (to - peak) * (low + high) / 2, std::abs(to - peak) * (high - low)});
        }
    return found;
}

/// Integrate the light that arrives from everywhere alike and is reflected to `view`, by the angles to the
/// normal (0, 1, 0) and about it, in steps that are narrow about the mirror direction.
Double3 integrateReflected(const Coating& c, double elevation, double azimuth)
{
    Double3 sum;
    for (const auto& [turn, turn_width] : denseAbout(0, kPi))
        for (const auto& [height, height_width] : denseAbout(elevation, kPi / 2))
            sum += reflected(c, direction(elevation, azimuth), direction(height, azimuth + kPi + turn)) *
                   (2 * turn_width * height_width * std::cos(height));
    return sum;
}

TEST(Reflected, keepsAWhiteFurnaceWhite)
{
    for (const double roughness : {0.05, 0.1, 0.3, 0.6, 1.0})
        for (const double metallic : {0.0, 0.5, 1.0})
            for (const double elevation : {0.03, 0.1, 0.4, 1.1, kPi / 2})
            {
                Coating c = makeCoating(roughness, metallic);
                c.base = {1, 1, 1};
                EXPECT_NEAR(integrateReflected(c, elevation, 0).x, 1, 0.01)
                    << "roughness " << roughness << ", metallic " << metallic << ", elevation " << elevation;
            }
}

TEST(Reflected, isWhatItsAlbedosSay)
{
    for (const double roughness : {0.1, 0.4, 1.0})
        for (const double metallic : {0.0, 1.0})
            for (const double elevation : {0.05, 0.4, 1.2})
            {
                const Coating c = makeCoating(roughness, metallic);
                const Double3 view = direction(elevation, 2);
                const Double3 found = integrateReflected(c, elevation, 2);
                const Albedo parts = albedo(c, view);
                EXPECT_NEAR(found.x, parts.diffuse.x + parts.specular.x, 0.006);
                EXPECT_NEAR(found.y, parts.diffuse.y + parts.specular.y, 0.006);
                EXPECT_NEAR(found.z, parts.diffuse.z + parts.specular.z, 0.006);
            }
}

/// White surfaces with all layers, of which each takes light from those below.
TEST(Reflected, keepsAWhiteFurnaceWhiteUnderLayers)
{
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double strength : {0.4, 1.0})
            for (const double elevation : {0.1, 0.4, 1.1})
            {
                Coating c = makeCoating(0.4, 0.3);
                c.base = {1, 1, 1};
                c.dielectric_f0 = Double3{0.2, 0.2, 0.2} * strength;
                c.dielectric_f90 = strength;
                const auto expectWhite = [&](const char* layers)
                {
                    EXPECT_NEAR(integrateReflected(c, elevation, 0).x, 1, 0.01)
                        << layers << ", roughness " << roughness << ", strength " << strength
                        << ", elevation " << elevation;
                };
                expectWhite("specular");
                c.clearcoat = strength;
                c.clearcoat_roughness = roughness;
                c.clearcoat_normal = c.normal;
                expectWhite("clear coat");
                c.sheen = Double3{1, 1, 1} * strength;
                c.sheen_roughness = roughness;
                expectWhite("all");
                const Albedo parts = albedo(c, direction(elevation, 0));
                EXPECT_NEAR(parts.diffuse.x + parts.specular.x + parts.sheen.x + parts.clearcoat, 1, 1e-9);
                // coloured sheen takes as much from all channels as it gives to the brightest
                c.sheen = {strength, 0, 0};
                const Double3 red = integrateReflected(c, elevation, 0);
                EXPECT_NEAR(red.x, 1, 0.01);
                EXPECT_LT(red.y, red.x + 0.001);
            }
}

/// A mirror of dielectric under a coat: at normal incidence the coat reflects 4 %, and leaves 96 % to it.
TEST(Reflected, letsAClearCoatDimWhatIsBelow)
{
    Coating c = makeCoating(0.05, 0);
    c.base = {};
    c.emitted = {1, 2, 3};
    c.clearcoat = 1;
    c.clearcoat_roughness = 0.05;
    c.clearcoat_normal = c.normal;
    const Albedo parts = albedo(c, {0, 1, 0});
    EXPECT_NEAR(parts.clearcoat, 0.04, 2e-4);
    EXPECT_NEAR(parts.specular.x, 0.96 * 0.04, 2e-4);
    EXPECT_NEAR(emitted(c, {0, 1, 0}).z, 3 * 0.96, 1e-3);
    // its own normal turns its highlight, but not that of what is below
    c.clearcoat_normal = normalize({0.3, 1, 0});
    const Double3 light = c.clearcoat_normal * (2 * c.clearcoat_normal.y) - Double3{0, 1, 0};
    EXPECT_GT(reflected(c, {0, 1, 0}, light).x, 100 * reflected(c, {0, 1, 0}, {-light.x, light.y, 0}).x);
}

TEST(Reflected, isLambertsLawForARoughDielectricSeenFromAbove)
{
    const Coating c = makeCoating(1, 0);
    // Straight up and down the Fresnel term is 0.04 and the lobe 0.04 / (4 pi). Under constant light the lobe
    // of one scattering reflects 1 - log(2) times the Fresnel term, which is 0.04 near the normal.
    const double once = 1 - std::log(2.0), several = 1 + 0.04 * (1 / once - 1);
    EXPECT_NEAR(reflected(c, {0, 1, 0}, {0, 1, 0}).x,
                (1 - 0.04 * once * several) * 0.8 / kPi + several * 0.04 / (4 * kPi), 1e-4);
    EXPECT_EQ(reflected(c, {0, 1, 0}, {0, -1, 0}).x, 0);
}

TEST(Filmic, isBlackInTheDarkAndApproachesOne)
{
    EXPECT_EQ(filmic(0), 0);
    EXPECT_EQ(filmic(0.004), 0);
    EXPECT_NEAR(filmic(1e6), 1, 1e-4);
    // x = 0.18: (0.18 * 1.616) / (0.18 * 2.816 + 0.06) = 0.51314 on the display
    EXPECT_NEAR(filmic(0.184), std::pow(0.18 * 1.616 / (0.18 * 2.816 + 0.06), 2.2), 1e-12);
}

TEST(SceneLight, fallsOffAsTheLawSays)
{
    SceneLight light{LightType::point, {0, 3, 0}, {0, -1, 0}, {10, 20, 30}, 0, 1, 0};
    EXPECT_NEAR(light.at({0, 1, 0}).irradiance.y, 20.0 / 4, 1e-12);
    EXPECT_NEAR(light.at({0, 1, 0}).to_light.y, 1, 1e-12);
    light.range = 4;
    EXPECT_NEAR(light.at({0, 1, 0}).irradiance.y, 20.0 / 4 * (1 - 1.0 / 16), 1e-12);
    EXPECT_EQ(light.at({0, -2, 0}).irradiance.y, 0) << "out of range";

    light.type = LightType::spot;
    light.range = 0;
    light.cos_inner = 0.9;
    light.cos_outer = 0.6;
    EXPECT_NEAR(light.at({0, 1, 0}).irradiance.y, 5, 1e-12) << "in the middle of the cone";
    EXPECT_EQ(light.at({10, 1, 0}).irradiance.y, 0) << "outside the cone";
    const double sine = std::sqrt(1 - 0.75 * 0.75);
    EXPECT_NEAR(light.at({2 * sine / 0.75, 1, 0}).irradiance.y, 20 / (4 / (0.75 * 0.75)) * 0.25, 1e-9)
        << "half way between the cosines: a quarter";

    light.type = LightType::directional;
    EXPECT_EQ(light.at({0, 50, 0}).irradiance.z, 30);
}

TEST(TextureSet, filtersBetweenTexelsAndWraps)
{
    test::PackModel model = test::smallPack();
    // image 0, sRGB: 4 x 2; make it data, the first row 0, 51, 102, 153, the second 255
    model.images[0].format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
    for (size_t i = 0; i < 8; ++i)
        for (size_t channel = 0; channel < 4; ++channel)
            model.image_data[0][i * 4 + channel] = static_cast<std::byte>(i < 4 ? i * 51 : 255);
    const HeldPack pack(model);
    const TextureSet textures = TextureSet::load(pack.view).value();
    const auto at = [&](float u, float v, Wrap wrap)
    {
        const TextureRef texture{
            0, 0, static_cast<uint8_t>(wrap), static_cast<uint8_t>(wrap), 0, {1, 0, 0, 0, 1, 0}};
        return textures.sample(texture, {u, v}, 0).rgb.x;
    };
    EXPECT_NEAR(at(0.375f, 0.25f, Wrap::repeat), 0.2, 1e-6) << "the middle of a texel";
    EXPECT_NEAR(at(0.5f, 0.25f, Wrap::repeat), 0.3, 1e-6) << "half way between two";
    EXPECT_NEAR(at(0.375f, 0.5f, Wrap::repeat), 0.6, 1e-6) << "half way between rows";
    EXPECT_NEAR(at(0.0f, 0.25f, Wrap::repeat), 0.3, 1e-6) << "first and last texel";
    EXPECT_NEAR(at(0.0f, 0.25f, Wrap::clamp_to_edge), 0.0, 1e-6);
    EXPECT_NEAR(at(1.125f, 0.25f, Wrap::mirrored_repeat), 0.6, 1e-6);
    EXPECT_NEAR(at(-0.125f, 0.25f, Wrap::mirrored_repeat), 0.0, 1e-6);
    EXPECT_NEAR(at(2.375f, 0.25f, Wrap::repeat), 0.2, 1e-5);
}

TEST(TextureSet, takesTheMipThatASampleCovers)
{
    test::PackModel model = test::smallPack();
    model.images[0].format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
    for (size_t i = 0; i < model.image_data[0].size(); ++i)
        model.image_data[0][i] = static_cast<std::byte>(i < 32 ? 0 : i < 40 ? 100 : 200); // mips 0, 1, 2
    const HeldPack pack(model);
    const TextureSet textures = TextureSet::load(pack.view).value();
    const TextureRef texture{0, 0, 0, 0, 0, {1, 0, 0, 0, 1, 0}};
    const double texel = 1 / std::sqrt(8.0); // a side of the 4 x 2 image, on average
    EXPECT_NEAR(textures.sample(texture, {0.4f, 0.4f}, 0.5 * texel).rgb.x, 0, 1e-9);
    EXPECT_NEAR(textures.sample(texture, {0.4f, 0.4f}, 2 * texel).rgb.x, 100 / 255.0, 1e-9);
    EXPECT_NEAR(textures.sample(texture, {0.4f, 0.4f}, std::sqrt(2) * texel).rgb.x, 50 / 255.0, 1e-9);
    EXPECT_NEAR(textures.sample(texture, {0.4f, 0.4f}, 100 * texel).rgb.x, 200 / 255.0, 1e-9);
}

/// The strip of the small pack alone, in its own place or as the mirrored second instance.
test::PackModel strip(uint32_t instance)
{
    test::PackModel model = test::smallPack();
    model.instances[0].world_from_object = model.instances[instance].world_from_object;
    model.instances.resize(1);
    model.surroundings.clear();
    model.radiance_transfers.clear();
    return model;
}

TEST(EmbreeScene, findsTheTrianglesOfTheFinestLevel)
{
    const HeldPack pack(strip(0));
    const PackGeometry geometry = PackGeometry::decode(pack.view).value();
    const Placement placement(geometry);
    const EmbreeScene all(placement, [](const SurfaceHit&) { return true; });
    // The strip's first quad rises from y = 0 at x = 0 to y = 3/32 at x = 1.
    const auto hit = all.nearest({{0.25, 2, 0.5}, {0, -1, 0}});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->instance, 0u);
    EXPECT_EQ(pack.view.clusters()[hit->cluster].level, 0u);
    EXPECT_NEAR(hit->distance, 2 - 0.0234375, 1e-6);
    EXPECT_TRUE(hit->front);
    const SurfacePoint point = surfaceAt(placement, *hit, 0);
    EXPECT_NEAR(point.position.x, 0.25, 1e-6);
    EXPECT_NEAR(point.position.y, 0.0234375, 1e-6);
    EXPECT_NEAR(point.geometric_normal.x, -0.09375 / std::sqrt(1 + 0.09375 * 0.09375), 1e-6);
    EXPECT_NEAR(double{point.uv[0].x}, 0.25 / 4, 1e-6);
    EXPECT_NEAR(double{point.uv[0].y}, 0.5, 1e-6);

    const auto below = all.nearest({{0.25, -2, 0.5}, {0, 1, 0}});
    ASSERT_TRUE(below.has_value());
    EXPECT_FALSE(below->front);
    EXPECT_FALSE(all.nearest({{0.25, 2, 1.5}, {0, -1, 0}}).has_value()) << "beside the strip";
    EXPECT_TRUE(all.occluded({{0.25, 2, 0.5}, {0, -1, 0}, 0, 3}));
    EXPECT_FALSE(all.occluded({{0.25, 2, 0.5}, {0, -1, 0}, 0, 1})) << "too short";
}

TEST(EmbreeScene, knowsTheFrontOfAMirroredInstance)
{
    const HeldPack pack(strip(1));
    const PackGeometry geometry = PackGeometry::decode(pack.view).value();
    const Placement placement(geometry);
    const EmbreeScene all(placement, [](const SurfaceHit&) { return true; });
    // x -> 5 - 2x
    const auto hit = all.nearest({{4.5, 1, 0.25}, {0, -1, 0}});
    ASSERT_TRUE(hit.has_value());
    EXPECT_TRUE(hit->front);
    EXPECT_NEAR(surfaceAt(placement, *hit, 0).geometric_normal.y, 1 / std::hypot(1, 0.046875), 1e-6);
}

TEST(EmbreeScene, looksThroughWhatIsNotAccepted)
{
    for (const bool is_mirrored : {false, true})
    {
        SCOPED_TRACE(is_mirrored);
        const HeldPack pack(strip(is_mirrored ? 1 : 0));
        const PackGeometry geometry = PackGeometry::decode(pack.view).value();
        const Placement placement(geometry);
        const EmbreeScene fronts(placement, [](const SurfaceHit& hit) { return hit.front; });
        const Double3 above{is_mirrored ? 4.5 : 0.25, 2, is_mirrored ? 0.25 : 0.5};
        EXPECT_TRUE(fronts.nearest({above, {0, -1, 0}}).has_value());
        EXPECT_FALSE(fronts.nearest({above - Double3{0, 4, 0}, {0, 1, 0}}).has_value());
    }
}

/// Mean colour of the reference for a camera straight above the strip.
std::array<double, 3> meanFromAbove(const test::PackModel& model)
{
    const HeldPack pack(model);
    ReferenceOptions options;
    options.camera.position = {2, 1, 0.5f};
    options.camera.target = {2, 0, 0.5f};
    options.camera.up = {0, 0, -1};
    options.camera.y_fov_rad = 0.3f;
    options.width = options.height = 8;
    options.samples_per_side = 1;
    const Image image = renderReference(pack.view, options).value();
    std::array<double, 3> mean{};
    for (size_t i = 0; i < image.rgb.size(); ++i)
        mean[i % 3] += image.rgb[i] / 255.0 / 64;
    return mean;
}

TEST(RenderReference, showsUnlitColoursAsTheyAre)
{
    test::PackModel model = test::smallPack();
    MaterialRecord& material = model.materials[0];
    material.flags = kMaterialDoubleSided | kMaterialUnlit;
    material.alpha_mode = static_cast<uint32_t>(AlphaMode::opaque);
    material.base_color_texture.image = kInvalidIndex;
    material.base_color = {0.25f, 0.5f, 1, 1};
    const auto mean = meanFromAbove(model);
    // the strip's vertices are coloured (1, 0.5, 0.25)
    EXPECT_NEAR(mean[0], srgbFromLinear(0.25), 0.003);
    EXPECT_NEAR(mean[1], srgbFromLinear(0.25), 0.003);
    EXPECT_NEAR(mean[2], srgbFromLinear(0.25), 0.003);
}

TEST(RenderReference, showsTheRadianceOfAnEmissiveSurfaceInTheDark)
{
    test::PackModel model = test::smallPack();
    MaterialRecord& material = model.materials[0];
    material.flags = kMaterialDoubleSided;
    material.alpha_mode = static_cast<uint32_t>(AlphaMode::opaque);
    material.base_color_texture.image = kInvalidIndex;
    material.emissive_texture.image = kInvalidIndex;
    material.base_color = {0, 0, 0, 1};
    material.metallic = 1; // a black metal reflects light only at grazing angles
    material.emissive = {0.2f, 0.5f, 3};
    model.lights.clear();
    const auto mean = meanFromAbove(model);
    EXPECT_NEAR(mean[0], srgbFromLinear(filmic(0.2)), 0.03);
    EXPECT_NEAR(mean[1], srgbFromLinear(filmic(0.5)), 0.02);
    EXPECT_NEAR(mean[2], srgbFromLinear(filmic(3)), 0.01);

    // a sun from below, which lights nothing that is seen, of 100 times the key
    LightRecord sun{};
    sun.type = static_cast<uint32_t>(LightType::directional);
    sun.color = {1, 1, 1};
    sun.intensity = 100 * shared::kKeyIlluminance;
    sun.world_from_light.m[1][1] = sun.world_from_light.m[2][2] = 0;
    sun.world_from_light.m[1][2] = -1;
    sun.world_from_light.m[2][1] = 1;
    model.lights = {sun};
    EXPECT_NEAR(meanFromAbove(model)[2], srgbFromLinear(filmic(0.03)), 0.03);
}

} // namespace
} // namespace hearth::reference
