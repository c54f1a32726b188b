// Tests visibility in images: its debug views, and occlusion of the sky's light, against twins of the shaders
// that share only formulas with them (formats/gpu_shared).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/gpu_shared/instance_visibility.h"
#include "formats/gpu_shared/light_cone.h"
#include "formats/gpu_shared/specular_occlusion.h"
#include "formats/scene/radiance_transfer.h"
#include "formats/scene/reflectance.h"
#include "tests/reference/pack_geometry.h"
#include "tests/reference/tracer/gltf_material.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstring>

namespace hearth::test
{

namespace
{

using namespace shared;
using formats::MaterialRecord;
using reference::Double3;

Double3 wide(Float3 v)
{
    return Double3(v);
}

Float3 narrow(Double3 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Narrow and wide cones that lean in various directions, some of them nearly closed: smooth in the position.
VisibilityMoments leaningCones(uint32_t, Float3 p, Float3 n)
{
    const Float3 lean{std::sin(3 * p.x + p.y), std::cos(2 * p.y), std::sin(4 * p.z)};
    const Float3 axis = normalizeOr(n + lean * 0.6f, n);
    const float cosine = 0.5f + 0.45f * std::sin(5 * p.x - 2 * p.z);
    const float scale = 0.6f + 0.4f * std::cos(3 * p.y + p.z);
    return {2 * kVisibilityPi * scale * (1 - cosine), axis * (kVisibilityPi * scale * (1 - cosine * cosine))};
}

/// Like the sum of rotation, scale and mirror that a similarity is.
Affine3 similarity(float factor, float angle, bool mirrored, Float3 offset)
{
    Affine3 t = translated(offset);
    const float c = std::cos(angle) * factor, s = std::sin(angle) * factor;
    const float x = mirrored ? -1.0f : 1.0f;
    const float rows[3][3] = {{x * c, 0, s}, {0, factor, 0}, {x * -s, 0, c}};
    for (int r = 0; r < 3; ++r)
        for (int column = 0; column < 3; ++column)
            t.m[r][column] = rows[r][column];
    return t;
}

/// Values that the twin computes at a pixel.
struct TwinPoint
{
    const formats::ClusterRecord* cluster;
    bool says = false; ///< the mesh has visibility
    Double3 position, to_eye;
    Double3 geometric; ///< interpolated normal, towards the visible side
    Double3 normal;    ///< bent by the map
    VisibilityCone cone{};
    uint32_t instance = 0;
    VisibilityMoments moments{}; ///< of the visibility
};

class SkyOcclusionTest : public GpuTest
{
protected:
    static constexpr uint32_t kWidth = 160, kHeight = 120;

    clusters::Config withVisibility() const
    {
        clusters::Config config;
        config.visibility = true;
        return config;
    }

    void load(const TestScene::Visibility& visibility = leaningCones)
    {
        test_.setVisibility(visibility);
        pack_.emplace(test_.build());
        geometry_.emplace(reference::PackGeometry::decode(*pack_).value());
        scene_ = upload(*pack_);
    }

    Image show(uint32_t view, uint32_t ambient = kAmbientOcclusionExact,
               uint32_t specular = kSpecularOcclusionFit)
    {
        return draw(*scene_, camera_,
                    {.width = kWidth,
                     .height = kHeight,
                     .debug_view = view,
                     .ambient_occlusion = ambient,
                     .specular_occlusion = specular});
    }

    /// Intersect the ray through the middle of a pixel with the plane of the triangle that was drawn there.
    TwinPoint twinAt(const Image& image, uint32_t x, uint32_t y) const
    {
        const uint32_t id = image.visibility[y * kWidth + x];
        const VisibleCluster slot = image.list.slots.at(id >> kTriangleBits);
        const formats::InstanceRecord& instance = pack_->instances()[slot.instance];
        const auto pose = posed_.find(slot.instance);
        const reference::DoubleAffine world = pose == posed_.end()
                                                  ? reference::DoubleAffine(instance.world_from_object)
                                                  : reference::DoubleAffine(pose->second);
        const formats::ClusterGeometry cluster = geometry_->cluster(slot.cluster);
        const auto vertices = cluster.triangle(id & ((1u << kTriangleBits) - 1));

        const Double3 eye = wide(camera_.position), forward = normalize(wide(camera_.target) - eye);
        const Double3 right = normalize(cross(forward, wide(camera_.up))), up = cross(right, forward);
        const double slope = std::tan(double{camera_.y_fov_rad} / 2), aspect = double{kWidth} / kHeight;
        const Double3 ray = forward + right * ((2 * (x + 0.5) / kWidth - 1) * slope * aspect) +
                            up * ((1 - 2 * (y + 0.5) / kHeight) * slope);

        Double3 corners[3];
        for (size_t i = 0; i < 3; ++i)
            corners[i] = world.point(wide(cluster.position(vertices[i]))) - eye;
        const Double3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], area = cross(e1, e2);
        const Double3 hit = ray * (dot(area, corners[0]) / dot(area, ray));
        const Double3 from = hit - corners[0];
        const double area2 = dot(area, area);
        const double w1 = dot(cross(from, e2), area) / area2, w2 = dot(cross(e1, from), area) / area2;
        const double weights[] = {1 - w1 - w2, w1, w2};

        const bool mirrored = world.determinant() < 0;
        const bool front = (dot(area, ray) < 0) != mirrored;
        Double3 normal, m1;
        double m0 = 0;
        TwinPoint point;
        point.cluster = &pack_->clusters()[slot.cluster];
        point.says = cluster.has(formats::kVertexVisibility);
        for (size_t i = 0; i < 3; ++i)
        {
            normal += wide(cluster.normal(vertices[i])) * weights[i];
            if (!point.says)
                continue;
            const VisibilityMoments moments = cluster.visibility(vertices[i]);
            m0 += double{moments.m0} * weights[i];
            m1 += wide(moments.m1) * weights[i];
        }
        // a similarity rotates directions like all else
        normal = normalize(world.vector(normal));
        m1 = length(m1) > 0 ? normalize(world.vector(m1)) * length(m1) : m1;
        if (!front)
        {
            m1 = m1 - normal * (2 * dot(normal, m1));
            normal = -normal;
        }
        point.position = hit + eye;
        point.to_eye = -normalize(ray);
        point.geometric = point.normal = normal;
        point.instance = slot.instance;
        point.moments = {static_cast<float>(m0), narrow(m1)};
        if (!pack_->surroundings().empty())
        {
            const uint16_t* halves = pack_->surroundings()[slot.instance].visibility;
            point.moments = changedVisibility(point.moments, narrow(normal),
                                              {floatFromHalf(halves[0]), floatFromHalf(halves[1]),
                                               floatFromHalf(halves[2]), floatFromHalf(halves[3])});
        }
        point.cone = visibilityCone(point.moments.m0, point.moments.m1, narrow(normal));
        return point;
    }

    static float twinAmbient(const TwinPoint& p, uint32_t mode)
    {
        return ambientOcclusion(mode, p.cone.scale, p.cone.cos_aperture, p.cone.aperture,
                                cosine(p.cone.axis, p.geometric), cosine(p.cone.axis, p.normal));
    }

    /// Return the colour that the final view shows: white dielectrics of roughness .4 under the first light.
    /// occluders  light of those of each instance; may be empty
    static Float3 twinColor(const TwinPoint& p, const reference::SceneLighting& lighting,
                            std::span<const OccluderLight> occluders, uint32_t ambient, uint32_t specular)
    {
        const auto mean = [&](const LightCone& cone)
        {
            const double height = std::clamp(double{cone.axis.y}, -1.0, 1.0);
            return lighting.coneRadiance({std::sqrt(1 - height * height), height, 0},
                                         double{cone.cos_half_angle});
        };
        const reference::Coating coating{{1, 1, 1}, 0, double{0.4f}, 1, {}, p.normal};
        const reference::Albedo albedo = reference::albedo(coating, p.to_eye);
        const Float3 normal = narrow(p.normal);
        const float facing = std::abs(static_cast<float>(dot(p.normal, p.to_eye)));
        const Float3 mirror = narrow(p.normal * (2 * dot(p.normal, p.to_eye)) - p.to_eye);
        LightCone diffuse = cosineCone(normal);
        const LightCone open = lobeCone(lobeTotal(0.4f, facing), mirror, normal);
        LightCone reflection = open;
        double diffuse_share = 1, mirrored_share = 1;
        if (p.says && ambient != kAmbientOcclusionOff)
        {
            diffuse = visibleCosineCone(p.cone, normal);
            diffuse_share = double{twinAmbient(p, ambient)};
        }
        if (p.says && specular != kSpecularOcclusionOff)
        {
            reflection = visibleLobeCone(reflection, p.cone);
            mirrored_share = double{twinSpecular(p, 0.4f)};
        }
        const OccluderLight occluder = p.says && !occluders.empty() ? occluders[p.instance] : OccluderLight{};
        const Double3 behind = wide(occluderRadiance(
            occluder, meanOccludedDirection(p.moments.m0, p.moments.m1, narrow(p.geometric))));
        const Double3 mirrored =
            wide(occluderRadiance(occluder, open.axis * (0.5f + 0.5f * open.cos_half_angle)));
        const reference::Incident sun = lighting.lights[0].at(p.position);
        const Double3 radiance =
            albedo.diffuse * (mean(diffuse) * diffuse_share + behind * (1 - diffuse_share)) +
            albedo.specular * (mean(reflection) * mirrored_share + mirrored * (1 - mirrored_share)) +
            sun.irradiance * reflected(coating, p.to_eye, sun.to_light);
        const auto shown = [](double value)
        {
            const double linear = reference::filmic(value);
            return static_cast<float>(linear <= 0.0031308 ? linear * 12.92
                                                          : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
        };
        return {shown(radiance.x), shown(radiance.y), shown(radiance.z)};
    }

    static float cosine(Float3 a, Double3 b) { return static_cast<float>(dot(wide(a), b)); }

    static float twinSpecular(const TwinPoint& p, float roughness)
    {
        const double facing = std::abs(dot(p.normal, p.to_eye));
        const Double3 mirror = p.normal * (2 * dot(p.normal, p.to_eye)) - p.to_eye;
        return p.cone.scale * specularOcclusionFit(p.cone.cos_aperture, roughness, static_cast<float>(facing),
                                                   cosine(p.cone.axis, p.normal),
                                                   cosine(p.cone.axis, mirror));
    }

    /// Expect that each pixel of a surface has the `expected` colour (0 to 1, as displayed), to `tolerance`
    /// of 255. A few pixels on the rims of triangles may differ. Returns how many were compared.
    template <typename Expected>
    size_t expectPixels(const Image& image, int tolerance, const Expected& expected)
    {
        size_t seen = 0, wrong = 0;
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
            {
                if (image.visibility[y * kWidth + x] == kVisibilitySky)
                    continue;
                const Float3 color = expected(twinAt(image, x, y));
                bool differs = false;
                for (int c = 0; c < 3; ++c)
                    differs |= std::abs(static_cast<float>(channel(image.at(x, y), c)) - color[c] * 255) >
                               static_cast<float>(tolerance) + 0.5f;
                wrong += differs ? 1 : 0;
                ++seen;
            }
        EXPECT_LE(wrong, seen / 200) << "of " << seen;
        return seen;
    }

    void lookAtBall()
    {
        camera_ = {.position = {1.5f, 2, 6}, .target = {0, 0, 0}, .y_fov_rad = 0.7f, .z_near = 0.05f};
    }

    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::optional<reference::PackGeometry> geometry_;
    std::unique_ptr<gpu::Scene> scene_;
    Camera camera_;
    std::map<uint32_t, Affine3d> posed_; ///< instances whose joints all have this transform
};

constexpr Float3 kNoReflection{0.35f, 0.05f, 0.05f};

Float3 grey(float value)
{
    return {value, value, value};
}

/// Rocks that are rotated, scaled and mirrored, and one without visibility.
class SkyViewTest : public SkyOcclusionTest
{
protected:
    void SetUp() override
    {
        SkyOcclusionTest::SetUp();
        MaterialRecord material = plainMaterial();
        material.roughness = 0.4f;
        const uint32_t plain = test_.addMaterial(material);
        const mesh::SourceMesh source = withMaterial(shapes::rock(12, 0.1f), plain);
        const uint32_t rock = test_.addMesh(source, withVisibility());
        const uint32_t without = test_.addMesh(source);
        test_.addInstance(rock, similarity(1, 0, false, {-1.2f, 0, 0}));
        test_.addInstance(rock, similarity(0.7f, 1.1f, false, {1.2f, 0.5f, 0}));
        test_.addInstance(rock, similarity(0.5f, 2.5f, true, {0.3f, -1, 1}));
        test_.addInstance(without, similarity(0.4f, 0, false, {0.2f, 1.2f, 1}));
        lookAtBall();
        load();
    }
};

} // namespace

TEST_F(SkyViewTest, ambientOcclusionIsThatOfTheInterpolatedMoments)
{
    for (const uint32_t mode : {kAmbientOcclusionExact, kAmbientOcclusionSmoothstep,
                                kAmbientOcclusionQuadratic, kAmbientOcclusionOff})
    {
        size_t dark = 0;
        const size_t seen = expectPixels(show(kViewAmbientOcclusion, mode), 1,
                                         [&](const TwinPoint& p)
                                         {
                                             const float value = p.says ? twinAmbient(p, mode) : 1;
                                             dark += value < 0.5f ? 1u : 0u;
                                             return p.says ? grey(value) : kNoReflection;
                                         });
        EXPECT_GT(seen, 3000u);
        if (mode == kAmbientOcclusionOff)
            EXPECT_EQ(dark, 0u);
        else
            EXPECT_GT(dark, 300u);
    }
}

TEST_F(SkyViewTest, bentNormalAndApertureAreThoseOfTheCone)
{
    expectPixels(show(kViewBentNormal), 1,
                 [&](const TwinPoint& p) {
                     return p.says ? p.cone.axis * 0.5f + Float3{0.5f, 0.5f, 0.5f} : kNoReflection;
                 });
    expectPixels(show(kViewAperture), 1,
                 [&](const TwinPoint& p)
                 { return p.says ? grey(p.cone.aperture / (kVisibilityPi / 2)) : kNoReflection; });
}

TEST_F(SkyViewTest, specularOcclusionIsTheFit)
{
    for (const uint32_t mode : {kSpecularOcclusionFit, kSpecularOcclusionTable, kSpecularOcclusionOff})
        expectPixels(show(kViewSpecularOcclusion, kAmbientOcclusionExact, mode), 1,
                     [&](const TwinPoint& p)
                     {
                         const bool off = mode == kSpecularOcclusionOff; // and there is no table
                         return p.says ? grey(off ? 1 : twinSpecular(p, 0.4f)) : kNoReflection;
                     });
}

/// Table lookup by trilinear interpolation, in doubles.
TEST_F(SkyViewTest, specularOcclusionIsLookedUpInTheTable)
{
    formats::SpecularTableRecord table{};
    table.aperture_nodes = table.roughness_nodes = table.beta_nodes = kSpecularNodes;
    table.min_roughness = kMinSpecularRoughness;
    const auto value = [](uint32_t x, uint32_t y, uint32_t z)
    {
        return static_cast<uint8_t>(x * 15 + (y * z * 30) / 225);
    }; // increases with the aperture, differently at each node
    for (uint32_t i = 0; i < formats::kSpecularTexels; ++i)
        table.values[i] = value(i & 15u, i >> 4 & 15u, i >> 8);
    for (const uint32_t spacing : {kSpecularSpacingCosine, kSpecularSpacingHalfSine})
    {
        table.spacing = spacing;
        test_.model().specular_tables = {table};
        load();
        expectPixels(show(kViewSpecularOcclusion, kAmbientOcclusionExact, kSpecularOcclusionTable), 1,
                     [&](const TwinPoint& p)
                     {
                         if (!p.says)
                             return kNoReflection;
                         const Double3 mirror = p.normal * (2 * dot(p.normal, p.to_eye)) - p.to_eye;
                         const Float3 place = specularTableCoordinates(p.cone.cos_aperture, 0.4f,
                                                                       cosine(p.cone.axis, mirror), spacing);
                         double sum = 0;
                         for (uint32_t corner = 0; corner < 8; ++corner)
                         {
                             double weight = 1;
                             uint32_t node[3];
                             for (int axis = 0; axis < 3; ++axis)
                             {
                                 const double at = double{place[axis]} * 15,
                                              low = std::min(std::floor(at), 14.0);
                                 const bool upper = (corner >> axis & 1u) != 0;
                                 node[axis] = static_cast<uint32_t>(low) + (upper ? 1 : 0);
                                 weight *= upper ? at - low : 1 - (at - low);
                             }
                             sum += weight * value(node[0], node[1], node[2]) / 255;
                         }
                         return grey(static_cast<float>(sum) * p.cone.scale);
                     });
    }
}

/// Image computed by the material model of the reference, which sees the sky through the cones of the shader.
TEST_F(SkyViewTest, theImageIsOccludedByLobe)
{
    const reference::SceneLighting lighting = reference::readLighting(*pack_);
    for (const auto& [ambient, specular] : {std::pair{kAmbientOcclusionExact, kSpecularOcclusionFit},
                                            std::pair{kAmbientOcclusionSmoothstep, kSpecularOcclusionOff},
                                            std::pair{kAmbientOcclusionOff, kSpecularOcclusionFit}})
        expectPixels(show(kViewFinal, ambient, specular), 2,
                     [&, mode = std::pair{ambient, specular}](const TwinPoint& p)
                     { return twinColor(p, lighting, {}, mode.first, mode.second); });
}

/// Two radiance transfers, an instance without one, and one with a visibility of its own.
class SurroundingsTest : public SkyViewTest
{
protected:
    void SetUp() override
    {
        SkyViewTest::SetUp();
        PackModel& model = test_.model();
        std::mt19937 random(7);
        for (int i = 0; i < 2; ++i)
        {
            formats::RadianceTransferRecord transfer{};
            for (uint16_t& value : transfer.values)
                value = halfFromFloat(uniform(random, -0.1f, 0.2f));
            model.radiance_transfers.push_back(transfer);
        }
        model.surroundings.assign(model.instances.size(), formats::kPlainSurroundings);
        model.surroundings[0].transfer = 1;
        const float factor[] = {0.3f, -0.2f, 0.1f, 0.6f};
        std::ranges::transform(factor, model.surroundings[1].visibility, halfFromFloat);
        model.surroundings[1].transfer = 0;
        const formats::LightRecord sun_record = sun({0.3f, -1, -0.5f});
        test_.addLight(sun_record);
        load();
    }

    /// Light of occluders of each instance under a sun.
    std::vector<OccluderLight> makeOccluderLights(const Light& sun) const
    {
        const LightHarmonics harmonics =
            projectDistantLight({kSkyZenith, kSkyHorizon, kSkyGround}, {&sun, 1});
        std::vector<OccluderLight> lights(pack_->instances().size(), OccluderLight{});
        for (size_t i = 0; i < lights.size(); ++i)
            if (const uint32_t transfer = pack_->surroundings()[i].transfer; transfer != kInvalidIndex)
                lights[i] = transferLight(pack_->radianceTransfers()[transfer], harmonics);
        return lights;
    }
};

TEST_F(SurroundingsTest, standsInForTheSkyThatIsOccluded)
{
    const reference::SceneLighting lighting = reference::readLighting(*pack_);
    const std::vector<OccluderLight> occluders = makeOccluderLights(scene_->lights->lights()[0]);
    for (const auto& [ambient, specular] : {std::pair{kAmbientOcclusionExact, kSpecularOcclusionFit},
                                            std::pair{kAmbientOcclusionSmoothstep, kSpecularOcclusionOff},
                                            std::pair{kAmbientOcclusionOff, kSpecularOcclusionFit},
                                            std::pair{kAmbientOcclusionOff, kSpecularOcclusionOff}})
    {
        size_t lighter = 0;
        expectPixels(show(kViewFinal, ambient, specular), 2,
                     [&, mode = std::pair{ambient, specular}](const TwinPoint& p)
                     {
                         const Float3 color = twinColor(p, lighting, occluders, mode.first, mode.second);
                         lighter += color.x > twinColor(p, lighting, {}, mode.first, mode.second).x + 0.02f;
                         return color;
                     });
        if (ambient == kAmbientOcclusionExact)
            EXPECT_GT(lighter, 500u);
        if (ambient == kAmbientOcclusionOff && specular == kSpecularOcclusionOff)
            EXPECT_EQ(lighter, 0u);
    }
}

TEST_F(SurroundingsTest, occlusionIsThatOfTheInstance)
{
    size_t changed = 0;
    expectPixels(show(kViewAmbientOcclusion), 1,
                 [&](const TwinPoint& p)
                 {
                     changed += p.instance == 1 ? 1u : 0u;
                     return p.says ? grey(twinAmbient(p, kAmbientOcclusionExact)) : kNoReflection;
                 });
    EXPECT_GT(changed, 500u);
    const Image with = show(kViewAmbientOcclusion);
    test_.model().surroundings[1] = formats::kPlainSurroundings;
    load();
    EXPECT_NE(with.color, show(kViewAmbientOcclusion).color);
}

/// A sun that has moved there lights occluders as one that was there from the beginning.
TEST_F(SurroundingsTest, followsTheSun)
{
    const formats::LightRecord moved = sun({-0.7f, -0.5f, 0.2f});
    gpu::LightChange change = gpu::changeLight(*scene_, 0, moved).value();
    const Image before = show(kViewFinal);
    const Image after = draw(*scene_, camera_, {.width = kWidth, .height = kHeight, .lights = {&change, 1}});
    test_.model().lights[0].world_from_light = moved.world_from_light;
    load();
    EXPECT_NE(before.color, after.color);
    EXPECT_EQ(after.color, show(kViewFinal).color);
}

/// Occluders give back the light of the sky and the sun of the frame.
TEST_F(SurroundingsTest, followsTheDaylight)
{
    const Daylight evening{.elevation_deg = 12, .azimuth_deg = 70};
    const gpu::DaylightChange change = gpu::changeDaylight(*scene_, evening).value();
    draw(*scene_, camera_, {.width = kWidth, .height = kHeight, .daylight = &change});
    const DaylightColors colors = makeDaylight(evening);
    Light sun = scene_->lights->loaded()[0];
    sun.direction = colors.sun_direction;
    sun.intensity = colors.sun_illuminance;
    const LightHarmonics harmonics =
        projectDistantLight({colors.zenith, colors.horizon, colors.ground}, {&sun, 1});
    const gpu::Buffer& table = scene_->tables->lighting.copy(scene_->tables->frame);
    const std::byte* row = table.mapped + scene_->lights->layout().surroundings;
    ASSERT_FALSE(pack_->radianceTransfers().empty());
    for (const formats::RadianceTransferRecord& transfer : pack_->radianceTransfers())
    {
        const OccluderLight expected = transferLight(transfer, harmonics);
        EXPECT_EQ(std::memcmp(row, &expected, sizeof(expected)), 0);
        row += sizeof(expected);
    }
}

/// Rotating all joints of a limb alike equals rotating the limb.
TEST_F(SkyOcclusionTest, conesOfCharactersTurnWithTheirPose)
{
    DeformedSceneOptions options{
        .limbs = 3, .tentacles = 1, .blobs = 1, .rocks = 0, .pose_count = 1, .rings = 16};
    options.visibility = leaningCones;
    const DeformedScene deformed(options, 5);
    pack_.emplace(deformed.pack());
    geometry_.emplace(reference::PackGeometry::decode(*pack_).value());
    scene_ = upload(*pack_);
    lookAtBall();
    std::mt19937 random(3);
    std::vector<TestPose> poses;
    for (const uint32_t instance : deformed.deformedInstances())
    {
        // the first limb here, a mirrored one beside it, the rest out of view
        TestPose pose = deformed.randomPose(instance, random);
        const bool mirrored = (pack_->instances()[instance].flags & formats::kInstanceMirrored) != 0;
        const bool shown = poses.empty() || mirrored;
        posed_[instance] =
            widened(similarity(0.9f, mirrored ? 2.0f : 0.7f, mirrored,
                               shown ? Float3{mirrored ? 1.3f : -0.7f, -1, 0} : Float3{0, 500, 0}));
        std::fill(pose.world_from_bind.begin(), pose.world_from_bind.end(), posed_[instance]);
        std::fill(pose.morph_weights.begin(), pose.morph_weights.end(), 0.0f);
        pose.free = true;
        poses.push_back(pose);
    }
    const auto views = makeViews(poses);
    for (const uint32_t view : {kViewBentNormal, kViewAmbientOcclusion})
    {
        const Image image =
            draw(*scene_, camera_, {.width = kWidth, .height = kHeight, .debug_view = view, .poses = views});
        const size_t seen = expectPixels(image, 1,
                                         [&](const TwinPoint& p)
                                         {
                                             EXPECT_TRUE(p.says);
                                             return view == kViewBentNormal
                                                        ? p.cone.axis * 0.5f + Float3{0.5f, 0.5f, 0.5f}
                                                        : grey(twinAmbient(p, kAmbientOcclusionExact));
                                         });
        EXPECT_GT(seen, 600u);
    }
}

namespace
{

/// Fixture with one sheet, seen from one side.
class SheetTest : public SkyOcclusionTest
{
protected:
    void addSheet(MaterialRecord material, bool says)
    {
        material.flags |= formats::kMaterialDoubleSided;
        const mesh::SourceMesh sheet = withMaterial(makeQuad(4, 4), test_.addMaterial(material));
        test_.addInstance(test_.addMesh(sheet, says ? withVisibility() : clusters::Config{}),
                          similarity(1, 0.3f, false, {}));
    }
    void look(Float3 from)
    {
        camera_ = {.position = from, .target = {0, 0, 0}, .y_fov_rad = 0.7f, .z_near = 0.05f};
    }
};

} // namespace

TEST_F(SheetTest, theBackSeesWhatTheFrontSeesInAMirror)
{
    addSheet(plainMaterial(), true);
    load();
    for (const Float3 from : {Float3{1, 0.5f, 4}, Float3{1, 0.5f, -4}})
    {
        look(from);
        const size_t seen = expectPixels(show(kViewBentNormal), 1,
                                         [&](const TwinPoint& p)
                                         {
                                             EXPECT_GT(dot(p.geometric, p.to_eye), 0);
                                             return p.cone.axis * 0.5f + Float3{0.5f, 0.5f, 0.5f};
                                         });
        EXPECT_GT(seen, 5000u);
        expectPixels(show(kViewAmbientOcclusion), 1,
                     [&](const TwinPoint& p) { return grey(twinAmbient(p, kAmbientOcclusionExact)); });
    }
}

TEST_F(SheetTest, anOpenSheetLooksLikeOneThatDoesNotSay)
{
    MaterialRecord material = plainMaterial();
    material.roughness = 0.3f;
    material.metallic = 0.5f;
    addSheet(material, true);
    load([](uint32_t, Float3, Float3 n) { return VisibilityMoments{2 * kVisibilityPi, n * kVisibilityPi}; });
    look({1, 0.5f, 4});
    const Image open = show(kViewFinal);
    test_ = {};
    addSheet(material, false);
    load();
    const Image plain = show(kViewFinal);
    for (size_t i = 0; i < open.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(channel(open.color[i], c), channel(plain.color[i], c), 1) << i;
}

/// A normal map of one texel bends the whole sheet alike.
TEST_F(SheetTest, aNormalMapBendsWhatIsLit)
{
    MaterialRecord material = plainMaterial();
    constexpr uint32_t kBent = 190 | 90u << 8 | 220u << 16 | 255u << 24;
    material.normal_texture =
        makeTextureRef(test_.addImage(formats::TexelFormat::rgba8_unorm, 1, 1, {kBent}));
    addSheet(material, true);
    load();
    look({1, 0.5f, 4});
    const auto bent = [&](TwinPoint p)
    {
        const reference::DoubleAffine world(pack_->instances()[0].world_from_object);
        const auto component = [](uint32_t byte) { return byte / 255.0 * 2 - 1; };
        const double x = component(190), y = component(90), z = std::sqrt(1 - x * x - y * y); // not the map's
        p.normal = normalize(world.vector({1, 0, 0}) * x + world.vector({0, 1, 0}) * y +
                             world.vector({0, 0, 1}) * z);
        return p;
    };
    for (const uint32_t mode :
         {kAmbientOcclusionExact, kAmbientOcclusionSmoothstep, kAmbientOcclusionQuadratic})
        expectPixels(show(kViewAmbientOcclusion, mode), 1,
                     [&](const TwinPoint& p) { return grey(twinAmbient(bent(p), mode)); });
    expectPixels(show(kViewSpecularOcclusion), 1,
                 [&](const TwinPoint& p) { return grey(twinSpecular(bent(p), 1)); });
}

/// The texture counts where it occludes more, and nowhere else.
TEST_F(SheetTest, theSmallerOfTextureAndConeCounts)
{
    MaterialRecord material = plainMaterial();
    look({1, 0.5f, 4});
    const auto drawn = [&](uint32_t texel, float ambient)
    {
        test_ = {};
        material.occlusion_texture =
            makeTextureRef(test_.addImage(formats::TexelFormat::rgba8_unorm, 1, 1, {texel | 0xFF000000u}));
        addSheet(material, true);
        load(
            [&](uint32_t, Float3, Float3 n) {
                return VisibilityMoments{2 * kVisibilityPi * ambient, n * (kVisibilityPi * ambient)};
            });
        return show(kViewFinal).at(kWidth / 2, kHeight / 2);
    };
    EXPECT_EQ(drawn(0x808080, 1), drawn(0x808080, 0.75f)) << "the texture";
    EXPECT_EQ(drawn(0xFFFFFF, 0.25f), drawn(0x808080, 0.25f)) << "the cone";
    EXPECT_NE(drawn(0xFFFFFF, 0.25f), drawn(0xFFFFFF, 0.75f));
}

} // namespace hearth::test
