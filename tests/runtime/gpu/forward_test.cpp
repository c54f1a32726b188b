// Tests shading from the visibility buffer against the same shading of attributes that the rasteriser
// interpolates, and its UV derivatives against exact ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "tests/runtime/gpu/forward_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <array>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;
using Vector = std::array<double, 3>;

constexpr uint32_t kNoOcclusion = kCullEverything & ~kCullOcclusion; // as ForwardRenderer needs it

enum class Mips
{
    none,
    all,
};

/// A smooth pattern of `size` texels a side: channel i is middle[i] plus waves of this height.
std::vector<uint32_t> wavyTexels(uint32_t size, std::array<float, 3> middle, float height, Mips mips)
{
    std::vector<uint32_t> texels;
    const uint32_t last = mips == Mips::all ? 1 : size;
    for (uint32_t side = size; side >= last; side /= 2)
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x)
            {
                uint32_t texel = 0xFF000000u;
                for (uint32_t i = 0; i < 3; ++i)
                {
                    // waves that fade with larger texels
                    const float turn = 6.2831853f * (static_cast<float>(i % 2 == 0 ? x : y) + 0.5f) /
                                       static_cast<float>(side) * static_cast<float>(i + 1);
                    const float fade = 1 - static_cast<float>(size / side) / static_cast<float>(size);
                    const float value = middle[i] + height * fade * std::sin(turn);
                    texel |= static_cast<uint32_t>(value * 255 + 0.5f) << (8 * i);
                }
                texels.push_back(texel);
            }
    return texels;
}

/// A material with textures of every kind, on two UV sets, some with a transform.
formats::MaterialRecord texturedMaterial(TestScene& scene, Mips mips)
{
    const auto image = [&](formats::TexelFormat format, std::array<float, 3> middle, float height)
    { return makeTextureRef(scene.addImage(format, 64, 64, wavyTexels(64, middle, height, mips))); };
    formats::MaterialRecord material = plainMaterial();
    material.metallic = 0.7f;
    material.emissive = {0.3f, 0.2f, 0.1f};
    material.base_color_texture = image(formats::TexelFormat::rgba8_srgb, {0.6f, 0.5f, 0.4f}, 0.3f);
    material.metallic_roughness_texture = image(formats::TexelFormat::rgba8_unorm, {0, 0.6f, 0.5f}, 0.0f);
    material.normal_texture = image(formats::TexelFormat::rgba8_unorm, {0.5f, 0.5f, 0.95f}, 0.05f);
    material.occlusion_texture = image(formats::TexelFormat::rgba8_unorm, {0.7f, 0, 0}, 0.0f);
    material.emissive_texture = image(formats::TexelFormat::rgba8_srgb, {0.4f, 0.4f, 0.4f}, 0.2f);
    material.emissive_texture.uv_set = 1;
    const float turned[6] = {0, 1.5f, 0.25f, -1.5f, 0, 0.5f};
    std::copy(std::begin(turned), std::end(turned), material.emissive_texture.uv_transform);
    return material;
}

/// Add tangents, a second UV set and vertex colours.
mesh::SourceMesh withEverything(mesh::SourceMesh mesh, uint32_t material)
{
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
    {
        const Float3 n = mesh.normals[i];
        const Float3 t = cross(n, std::abs(n.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0});
        const Float3 unit = t / length(t);
        mesh.tangents.push_back({unit.x, unit.y, unit.z, -1});
        mesh.uvs[1].push_back({mesh.uvs[0][i].y * 2, mesh.uvs[0][i].x + 0.5f});
        mesh.colors.push_back({0.5f + 0.5f * n.x * n.x, 1, 0.5f + 0.5f * n.y * n.y, 1});
    }
    return withMaterial(std::move(mesh), material);
}

void addLights(TestScene& scene)
{
    formats::LightRecord light{};
    light.color = {1, 0.9f, 0.7f};
    light.intensity = 2;
    light.outer_cone_rad = 0.9f;
    for (const formats::LightType type :
         {formats::LightType::directional, formats::LightType::point, formats::LightType::spot})
    {
        light.type = static_cast<uint32_t>(type);
        light.world_from_light = translated({static_cast<float>(type) - 1, 2, 5});
        scene.addLight(light);
    }
}

/// Return x with a x.x + b x.y + c x.z = d.
Vector solve(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
    const auto determinant = [](const Vector& p, const Vector& q, const Vector& r)
    {
        return p[0] * (q[1] * r[2] - q[2] * r[1]) - q[0] * (p[1] * r[2] - p[2] * r[1]) +
               r[0] * (p[1] * q[2] - p[2] * q[1]);
    };
    const double all = determinant(a, b, c);
    return {determinant(d, b, c) / all, determinant(a, d, c) / all, determinant(a, b, d) / all};
}

/// UV at a pixel on a makeQuad of this size: intersects the pixel's ray with the quad's plane.
std::array<double, 2> uvOfPixel(const FrameView& view, const Affine3& quad, double size, double x, double y)
{
    const double ndc_x = x * 2 / double{view.width} - 1, ndc_y = y * 2 / double{view.height} - 1;
    const auto row = [](const Float4& r, int i) { return double{i == 0 ? r.x : i == 1 ? r.y : r.z}; };
    const auto getColumn = [&](int i) -> Vector {
        return {row(view.clip_x, i), row(view.clip_y, i), row(view.clip_w, i)};
    };
    const Vector ray = solve(getColumn(0), getColumn(1), getColumn(2), {ndc_x, ndc_y, 1});
    const auto column = [&](int i) -> Vector {
        return {double{quad.m[0][i]}, double{quad.m[1][i]}, double{quad.m[2][i]}};
    };
    const Vector right = column(0), up = column(1), middle = column(3);
    // middle + right * p + up * q = eye + ray * t
    const Vector at = solve(
        right, up, {-ray[0], -ray[1], -ray[2]},
        {double{view.eye.x} - middle[0], double{view.eye.y} - middle[1], double{view.eye.z} - middle[2]});
    return {at[0] / size + 0.5, 0.5 - at[1] / size};
}

/// True if the quad has corners on both sides of the plane through the eye.
bool crossesTheEyePlane(const FrameView& view, const Affine3& quad, float size)
{
    int before = 0;
    for (const Float3 corner : {Float3{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})
    {
        const Float3 relative = transformPoint(quad, corner * (size / 2)) - view.eye;
        before += clipPosition(view, relative).w > 0 ? 1 : 0;
    }
    return before > 0 && before < 4;
}

class ForwardTest : public GpuTest
{
protected:
    /// Draw the scene by both methods and compare pixels whose 2 x 2 quad shows a single triangle: otherwise
    /// the rasteriser differentiates across an edge.
    void expectSame(const formats::PackView& pack, const Camera& camera, DrawOptions options)
    {
        options.flags = kNoOcclusion;
        options.error_pixels = 0;
        const auto scene = upload(pack);
        ForwardRenderer forward(host(), renderer().device());
        const Image image = draw(*scene, camera, options);
        const std::vector<uint32_t> other = forward.draw(*scene, {options.width, options.height});
        const auto id = [&](uint32_t x, uint32_t y) { return image.visibility[y * options.width + x]; };
        for (uint32_t y = 0; y < options.height; ++y)
            for (uint32_t x = 0; x < options.width; ++x)
            {
                const uint32_t left = x & ~1u, top = y & ~1u, seen = id(x, y);
                if (seen == kVisibilitySky || id(left, top) != seen || id(left + 1, top) != seen ||
                    id(left, top + 1) != seen || id(left + 1, top + 1) != seen)
                    continue;
                ++compared_;
                for (int i = 0; i < 3; ++i)
                {
                    const int difference =
                        std::abs(channel(image.at(x, y), i) - channel(other[y * options.width + x], i));
                    largest_ = std::max(largest_, difference);
                    wrong_ += difference > 1 ? 1 : 0;
                }
            }
        // At grazing views the reflectance of smooth surfaces rises so steeply with the cosine that the
        // rounding of interpolated normals shows in a few of a hundred thousand pixels.
        EXPECT_LE(wrong_, compared_ / 50000) << "of " << compared_ << " pixels";
        EXPECT_LE(largest_, 2);
    }

    size_t compared_ = 0, wrong_ = 0;
    int largest_ = 0;
};

} // namespace

TEST_F(ForwardTest, shadesAsTheRasteriserWould)
{
    std::mt19937 random(61);
    TestScene test;
    formats::MaterialRecord one_sided = texturedMaterial(test, Mips::all);
    formats::MaterialRecord two_sided = one_sided;
    two_sided.flags = formats::kMaterialDoubleSided;
    two_sided.normal_texture = makeTextureRef(kInvalidIndex);
    formats::MaterialRecord unlit = plainMaterial();
    unlit.flags = formats::kMaterialUnlit;
    unlit.base_color_texture = one_sided.base_color_texture;
    const uint32_t meshes[] = {
        test.addMesh(withEverything(shapes::rock(6, 0.2f), test.addMaterial(one_sided))),
        test.addMesh(withEverything(shapes::terrain(6), test.addMaterial(two_sided))),
        test.addMesh(withEverything(shapes::rock(4, 0.1f), test.addMaterial(unlit)))};
    for (int i = 0; i < 12; ++i)
        test.addInstance(meshes[i % 3], randomAffine(random, 2.5f));
    addLights(test);
    const formats::PackView pack = test.build();
    for (const Float3 eye : {Float3{4, 3, 6}, {-5, 1, 2}, {1, -6, -3}})
        expectSame(pack, {.position = eye, .target = {0, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f},
                   {.width = 320, .height = 240});
    expectSame(pack, {.position = {4, 3, 6}, .target = {}, .z_near = 0.05f, .half_height = 3, .z_far = 20},
               {.width = 320, .height = 240});
    EXPECT_GT(compared_, 80000u);
}

TEST_F(ForwardTest, shadesTrianglesAcrossTheNearPlaneAsTheRasteriserWould)
{
    // Without mips: towards the horizon their level changes from one pixel to the next, and the rasteriser's
    // differences over two pixels do not measure the derivatives, which the test below compares with exact
    // ones.
    TestScene test;
    formats::MaterialRecord material = texturedMaterial(test, Mips::none);
    material.flags = formats::kMaterialDoubleSided;
    mesh::SourceMesh floor = makeQuad(60, 60);
    floor.tangents.clear();
    test.addInstance(test.addMesh(withEverything(floor, test.addMaterial(material))), Affine3{});
    addLights(test);
    const formats::PackView pack = test.build();
    // under the eye and far behind it
    expectSame(
        pack,
        {.position = {0.3f, 0.2f, 1.0f}, .target = {0.5f, 1.2f, 0.6f}, .up = {0, 0, 1}, .z_near = 0.05f},
        {.width = 320, .height = 240});
    EXPECT_GT(compared_, 40000u);
}

TEST_F(ForwardTest, uvDerivativesAreThoseOfTheExactPlane)
{
    if (renderer().way() != gpu::FrameWay::merged)
        GTEST_SKIP() << "the test's shader reads the visibility buffer as an input attachment";
    std::mt19937 random(71);
    TestScene test;
    formats::MaterialRecord material = plainMaterial();
    material.flags = formats::kMaterialDoubleSided;
    constexpr float kSize = 8;
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(kSize, kSize), test.addMaterial(material)));
    std::vector<Affine3> places;
    for (int i = 0; i < 12; ++i)
    {
        places.push_back(randomAffine(random, 3));
        test.addInstance(mesh, places.back());
    }
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    ForwardRenderer other(host(), renderer().device());
    size_t compared = 0, across_the_eye = 0;
    double largest = 0;
    for (int i = 0; i < 16; ++i)
    {
        // among the quads, so that many cross the eye plane
        const Camera camera = randomCamera(random, 3);
        const DrawOptions options{.width = 160, .height = 120, .error_pixels = 0, .flags = kNoOcclusion};
        gpu::FrameTargets targets = makeTargets(options.width, options.height);
        const Image image = draw(*scene, targets, camera, options);
        const auto derivatives = other.uvDerivatives(*scene, targets);
        const FrameView view = makeView(*scene, camera, options);
        const auto seen = image.seen();
        for (uint32_t pixel = 0; pixel < seen.size(); ++pixel)
        {
            const uint32_t instance = seen[pixel][0];
            if (instance == kVisibilitySky)
                continue;
            const double x = pixel % options.width + 0.5, y = pixel / options.width + 0.5;
            const auto uv = [&](double dx, double dy)
            { return uvOfPixel(view, places[instance], double{kSize}, x + dx, y + dy); };
            constexpr double kStep = 1e-5; // pixels
            for (size_t axis = 0; axis < 2; ++axis)
            {
                const double dx = axis == 0 ? kStep : 0, dy = axis == 1 ? kStep : 0;
                const auto after = uv(dx, dy), before = uv(-dx, -dy);
                const double u = (after[0] - before[0]) / (2 * kStep),
                             v = (after[1] - before[1]) / (2 * kStep);
                const auto* found = &derivatives[pixel][2 * axis];
                largest = std::max(largest,
                                   std::hypot(double{found[0]} - u, double{found[1]} - v) / std::hypot(u, v));
            }
            ++compared;
        }
        for (const Affine3& place : places)
            across_the_eye += crossesTheEyePlane(view, place, kSize) ? 1u : 0u;
    }
    EXPECT_LT(largest, 0.02);
    EXPECT_GT(compared, 100000u);
    EXPECT_GT(across_the_eye, 20u) << "quads that pass the eye are not tested";
}

} // namespace hearth::test
