// Draws metal and paint under the sky of an image, beside paths under the image itself.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/probe.h"
#include "pipelines/environments/read_environment.h"
#include "tests/environments/environments.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/path_tracer.h"
#include "tests/roundtrip/traced_pictures.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hearth::test
{

namespace
{

using environment::Environment;
using environment::Layout;

constexpr uint32_t kSide = 48;   ///< of an image, in pixels
constexpr uint32_t kSamples = 8; ///< of a drawn pixel, along each axis
constexpr float kApart = 40;     ///< metres between balls, so that none sees another

/// Largest FLIP of a ball, and of the mean of the metal ones. At roughness 1 harmonics of degree 2 about the
/// normal stand for the lobe, which is no cosine: the ball differs most.
struct Bounds
{
    double ball, mean;
};

/// Paths of each pixel, traced twice: the difference of both is the noise of the oracle. Paint is no part of
/// the mean, and half of its light is diffuse.
struct Ball
{
    const char* name;
    float metallic, roughness;
    uint32_t paths;
};
constexpr Ball kBalls[] = {{"metal, .05", 1, 0.05f, 208}, {"metal, .25", 1, 0.25f, 208},
                           {"metal, .5", 1, 0.5f, 208},   {"metal, .8", 1, 0.8f, 208},
                           {"metal, 1", 1, 1, 208},       {"paint, .2", 0, 0.2f, 64},
                           {"paint, .9", 0, 0.9f, 64}};

struct NamedSky
{
    std::string name;
    Bounds bounds;
    Environment image;
};

/// Blue above a warm horizon over dark ground, with a sun of three degrees that gives half of the light.
Float3 makeDay(Double3 d)
{
    const Double3 sun{0.48, 0.6, 0.64};
    if (dot(d, sun) > std::cos(0.026))
        return {1500, 1350, 1100};
    const auto height = static_cast<float>(d.y);
    return height < 0 ? Float3{0.12f, 0.1f, 0.08f}
                      : Float3{0.9f - 0.7f * height, 0.8f - 0.4f * height, 0.7f + 0.3f * height};
}

/// Return environments of the tests' own, and real ones where the assets are.
std::vector<NamedSky> listSkies()
{
    std::vector<NamedSky> skies{{"day", {0.06, 0.037}, makeEnvironment(Layout::lat_long, 256, makeDay)}};
    if (const char* assets = std::getenv("HEARTH_ASSETS"))
        for (const char* name : {"env-hdr/hdr_venice_sunset_1k/venice_sunset_1k.hdr",
                                 "env-exr/exr_forest/forest.exr", "env-exr/exr_night/night.exr"})
            skies.push_back({name,
                             {0.038, 0.03},
                             environments::readEnvironment(std::string(assets) + "/good/" + name).value()});
    return skies;
}

class EnvironmentImageTest : public GpuTest
{
protected:
    /// Make a scene with all balls under a sky.
    formats::PackView build(const Environment& sky)
    {
        mesh::SourceMesh ball = shapes::rock(24, 0);
        for (Float3& p : ball.positions)
            p = normalizeOr(p, {});
        ball.normals = ball.positions;
        for (size_t i = 0; i < std::size(kBalls); ++i)
        {
            formats::MaterialRecord material = plainMaterial();
            material.base_color = {0.9f, 0.75f, 0.5f, 1};
            material.metallic = kBalls[i].metallic;
            material.roughness = kBalls[i].roughness;
            test_.addInstance(test_.addMesh(withMaterial(ball, test_.addMaterial(material))),
                              translated({kApart * static_cast<float>(i), 0, 0}));
        }
        probes::Probe probe = probes::cookProbe(sky, "sky", probes::kProbeSide, 512).value();
        probe.record.flags = formats::kProbeIsSky;
        test_.model().probes = {probe.record};
        test_.model().probe_texels = probe.texels;
        return test_.build();
    }

    static shared::Camera look(size_t ball)
    {
        const float x = kApart * static_cast<float>(ball);
        return {.position = {x + 1.6f, 0.7f, 2.6f}, .target = {x, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
    }

    static std::vector<reference::Double3> trace(const reference::ShadedScene& scene, size_t ball,
                                                 uint64_t seed)
    {
        return reference::tracePaths(scene, {.camera = look(ball),
                                             .width = kSide,
                                             .height = kSide,
                                             .samples = kBalls[ball].paths,
                                             .max_bounces = 2,
                                             .seed = seed});
    }

    /// Make pixels black in which no sample shows a surface. The background is another subject: that of paths
    /// has the texels of the image, the drawn one those of a cube.
    static void hideBackground(const Image& drawn, reference::Image& image)
    {
        for (uint32_t i = 0; i < kSide * kSide; ++i)
        {
            bool shows_surface = false;
            for (uint32_t sample = 0; sample < kSamples * kSamples; ++sample)
                shows_surface =
                    shows_surface ||
                    drawn.visibility[(kSamples * (i / kSide) + sample / kSamples) * drawn.width +
                                     kSamples * (i % kSide) + sample % kSamples] != shared::kVisibilitySky;
            for (size_t c = 0; c < 3 && !shows_surface; ++c)
                image.at(i % kSide, i / kSide)[c] = 0;
        }
    }

    TestScene test_;
};

TEST_F(EnvironmentImageTest, ballsLookAsPathsShowThem)
{
    for (NamedSky& sky : listSkies())
    {
        SCOPED_TRACE(sky.name);
        test_ = {};
        const formats::PackView pack = build(sky.image);
        const reference::PackGeometry geometry = reference::PackGeometry::decode(pack).value();
        const reference::TextureSet textures = reference::TextureSet::load(pack).value();
        reference::ShadedScene traced_scene(geometry, textures, nullptr);
        reference::SceneLighting lighting = traced_scene.lighting();
        EXPECT_TRUE(lighting.lights.empty());
        lighting.sky_map = std::make_shared<reference::SkyMap>(std::move(sky.image));
        traced_scene.setLighting(std::move(lighting));
        const auto scene = upload(pack);
        double sum = 0;
        uint32_t metals = 0;
        for (size_t i = 0; i < std::size(kBalls); ++i)
        {
            const Image samples =
                draw(*scene, look(i), {.width = kSamples * kSide, .height = kSamples * kSide});
            const auto show = [&samples](reference::Image image)
            {
                hideBackground(samples, image);
                return image;
            };
            const std::vector<reference::Double3> first = trace(traced_scene, i, 1),
                                                  second = trace(traced_scene, i, 2);
            std::vector<reference::Double3> mean;
            for (size_t pixel = 0; pixel < first.size(); ++pixel)
                mean.push_back((first[pixel] + second[pixel]) / 2);
            const reference::Image drawn = show(averageSamples(samples, kSide, kSamples)),
                                   traced = show(showRadiance(mean, kSide));
            const double difference = reference::flip(traced, drawn).mean(),
                         noise = reference::flip(show(showRadiance(first, kSide)),
                                                 show(showRadiance(second, kSide)))
                                     .mean();
            std::printf("%s, %s: FLIP %.4f, of the halves of the paths %.4f\n", sky.name.c_str(),
                        kBalls[i].name, difference, noise);
            EXPECT_LE(difference, sky.bounds.ball) << kBalls[i].name;
            if (kBalls[i].metallic == 1)
            {
                sum += difference;
                ++metals;
            }
            if (const char* folder = std::getenv("HEARTH_TEST_IMAGES"))
            {
                const std::string name = std::string(folder) + "/" +
                                         sky.name.substr(sky.name.rfind('/') + 1) + "-" + std::to_string(i);
                EXPECT_TRUE(reference::writePng(name + "-drawn.png", drawn).ok());
                EXPECT_TRUE(reference::writePng(name + "-traced.png", traced).ok());
            }
        }
        std::printf("%s: mean FLIP of metal %.4f\n", sky.name.c_str(), sum / metals);
        EXPECT_LE(sum / metals, sky.bounds.mean);
    }
}

} // namespace

} // namespace hearth::test
