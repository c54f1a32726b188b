// Tests that the visibility of `hearth cook --visibility`, with nothing else set, brings the image nearer to
// ray tracing: a room, cooked by the real programs, drawn and traced under the same sky and sun, with the
// light that its surfaces give back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pack.h"
#include "tests/reference/png_image.h"
#include "tests/reference/tracer/path_tracer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/sandbox.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr uint32_t kWidth = 160, kHeight = 120;
constexpr uint32_t kPaths = 32; ///< of each pixel

constexpr gpu::ShadowOptions kShadows{
    .max_maps = 4, .texels = 512, .splits = 4, .split_range = {.near = 1, .far = 12, .blend = 0.5f}};

/// n x n quads between `corner`, corner + u and corner + v, facing cross(u, v).
mesh::SourceMesh patch(Float3 corner, Float3 u, Float3 v, uint32_t n)
{
    mesh::SourceMesh mesh;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i)
        {
            mesh.positions.push_back(corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                     v * (static_cast<float>(j) / static_cast<float>(n)));
            mesh.normals.push_back(normalizeOr(cross(u, v), {}));
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i)
        {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    mesh.face_count = n * n;
    mesh.triangle_materials.assign(size_t{2} * n * n, kInvalidIndex);
    mesh.source_vertex_count = static_cast<uint32_t>(mesh.positions.size());
    return mesh;
}

/// Five sides of a box that stands on the floor.
void appendBox(mesh::SourceMesh& mesh, Float3 low, Float3 high, uint32_t n)
{
    const Float3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    shapes::append(mesh, patch(low + z, x, y, n));
    shapes::append(mesh, patch(low + x + z, z * -1.0f, y, n));
    shapes::append(mesh, patch(low + x, x * -1.0f, y, n));
    shapes::append(mesh, patch(low, z, y, n));
    shapes::append(mesh, patch(low + y + z, x, z * -1.0f, n));
}

/// Floor, two walls, a lid over a part of it, a box and a ball.
mesh::SourceMesh room()
{
    mesh::SourceMesh mesh = patch({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 24);
    shapes::append(mesh, patch({-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}, 20));
    shapes::append(mesh, patch({-2, 0, 2}, {0, 0, -4}, {0, 2.5f, 0}, 20));
    shapes::append(mesh, patch({-2, 2.4f, -2}, {2.5f, 0, 0}, {0, 0, 2.5f}, 14));
    appendBox(mesh, {0.2f, 0, -1.3f}, {1.4f, 1, -0.3f}, 8);
    mesh::SourceMesh ball = shapes::rock(10, 0);
    ball.uvs = {};
    float radius = 0;
    for (const Float3 p : ball.positions)
        radius = std::max(radius, length(p));
    for (Float3& p : ball.positions)
        p = p * (0.5f / radius) + Float3{-0.7f, 0.52f, 0.4f};
    shapes::append(mesh, ball);
    return mesh;
}

/// Write the mesh as NAME.gltf and NAME.bin, with a glossy material. Returns the file's name.
std::string writeSource(const Sandbox& sandbox, const std::string& name, const mesh::SourceMesh& mesh,
                        int metallic)
{
    std::string buffer;
    const auto append = [&](const auto& values)
    { buffer.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])); };
    append(mesh.positions);
    append(mesh.normals);
    append(mesh.indices);
    sandbox.write(name + ".bin", buffer);

    const size_t vertices = mesh.positions.size(), array = vertices * sizeof(Float3);
    Float3 low = mesh.positions[0], high = low;
    for (const Float3 p : mesh.positions)
    {
        low = min(low, p);
        high = max(high, p);
    }
    std::ostringstream text;
    text.precision(9);
    text
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],)"
        << R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.7,0.65,0.6,1],"metallicFactor":)"
        << metallic << R"(,"roughnessFactor":0.4}}],"buffers":[{"uri":")" << name << R"(.bin","byteLength":)"
        << buffer.size() << R"(}],"bufferViews":[{"buffer":0,"byteLength":)" << array
        << R"(},{"buffer":0,"byteOffset":)" << array << R"(,"byteLength":)" << array
        << R"(},{"buffer":0,"byteOffset":)" << 2 * array << R"(,"byteLength":)" << buffer.size() - 2 * array
        << R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" << vertices
        << R"(,"min":[)" << low.x << ',' << low.y << ',' << low.z << R"(],"max":[)" << high.x << ',' << high.y
        << ',' << high.z << R"(]},{"bufferView":1,"componentType":5126,"type":"VEC3","count":)" << vertices
        << R"(},{"bufferView":2,"componentType":5125,"type":"SCALAR","count":)" << mesh.indices.size()
        << "}]}";
    sandbox.write(name + ".gltf", text.str());
    return name + ".gltf";
}

/// Cook a source with the real programs.
pack::Pack cook(Sandbox& sandbox, const std::string& source, const std::vector<std::string>& options)
{
    const std::string output = source + std::to_string(options.size()) + ".hearth";
    std::vector<std::string> command{HEARTH_BIN "/hearth", "cook", source, "-o", output, "-q"};
    command.insert(command.end(), options.begin(), options.end());
    const ProgramEnd end = sandbox.run(withoutLightCookers(std::move(command)));
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return pack::Pack::open(sandbox / output).value();
}

/// Trace the paths of all light: sky, sun with its shadows, and what surfaces give back.
reference::Image trace(const formats::PackView& pack, const Camera& camera, uint32_t width, uint32_t height)
{
    const reference::PackGeometry geometry = reference::PackGeometry::decode(pack).value();
    const reference::TextureSet textures = reference::TextureSet::load(pack).value();
    const reference::ShadedScene scene(geometry, textures, nullptr);
    const std::vector<reference::Double3> radiance =
        reference::tracePaths(scene, {.camera = camera, .width = width, .height = height, .samples = kPaths});
    reference::Image image(width, height);
    for (uint32_t i = 0; i < width * height; ++i)
    {
        const double rgb[] = {radiance[i].x, radiance[i].y, radiance[i].z};
        uint8_t* const out = image.at(i % width, i / width);
        for (size_t c = 0; c < 3; ++c)
            out[c] = static_cast<uint8_t>(
                std::clamp(reference::srgbFromLinear(reference::filmic(rgb[c])), 0.0, 1.0) * 255 + 0.5);
    }
    return image;
}

class SkyImageTest : public GpuTest
{
};

/// Root mean square of the difference of two displayed images, on surfaces of the runtime's image; of 255.
double rms(const Image& drawn, const reference::Image& traced)
{
    double sum = 0, count = 0;
    for (uint32_t y = 0; y < drawn.height; ++y)
        for (uint32_t x = 0; x < drawn.width; ++x)
        {
            if (drawn.visibility[y * drawn.width + x] == kVisibilitySky)
                continue;
            for (int c = 0; c < 3; ++c)
                sum += std::pow(channel(drawn.at(x, y), c) - int{traced.at(x, y)[c]}, 2);
            count += 3;
        }
    return std::sqrt(sum / count);
}

} // namespace

/// Errors of the room's image, with cones and without.
struct ImageErrors
{
    double without = 0, with = 0, smoothstep = 0, diffuse_alone = 0;
};

TEST_F(SkyImageTest, visibilityOfACookBringsTheRoomNearer)
{
    const Camera camera{
        .position = {3.2f, 2.2f, 3.6f}, .target = {-0.3f, 0.7f, -0.3f}, .y_fov_rad = 0.8f, .z_near = 0.05f};
    Sandbox sandbox;
    // a metal shows what the axes of the cones are for
    for (const bool is_metal : {false, true})
    {
        const std::string name = is_metal ? "metal" : "paint";
        const std::string source = writeSource(sandbox, name, room(), is_metal ? 1 : 0);
        const pack::Pack bare = cook(sandbox, source, {}), baked = cook(sandbox, source, {"--visibility"});
        const reference::Image traced = trace(bare.view(), camera, kWidth, kHeight);
        // coarser levels, which the default chooses, have fewer vertices that could hold occlusion
        for (const float error_pixels : {1.0f, 0.0f})
        {
            SCOPED_TRACE(name + ", error of " + std::to_string(error_pixels) + " pixels");
            const auto error = [&](const pack::Pack& pack, uint32_t ambient, uint32_t specular)
            {
                const auto scene = upload(pack.view(), {.shadows = kShadows});
                return rms(draw(*scene, camera,
                                {.width = kWidth,
                                 .height = kHeight,
                                 .error_pixels = error_pixels,
                                 .ambient_occlusion = ambient,
                                 .specular_occlusion = specular}),
                           traced);
            };
            const ImageErrors errors{error(baked, kAmbientOcclusionOff, kSpecularOcclusionOff),
                                     error(baked, kAmbientOcclusionExact, kSpecularOcclusionFit),
                                     error(baked, kAmbientOcclusionSmoothstep, kSpecularOcclusionFit),
                                     error(baked, kAmbientOcclusionExact, kSpecularOcclusionOff)};
            std::printf("%s, error of %.0f pixels, rms of 255: without cones %.2f, with cones %.2f, "
                        "smoothstep %.2f, diffuse alone %.2f\n",
                        name.c_str(), double{error_pixels}, errors.without, errors.with, errors.smoothstep,
                        errors.diffuse_alone);
            EXPECT_GT(errors.without, 8);
            // a pixel's edges are smooth in the reference, and metal mirrors single surfaces
            const double max_share = is_metal ? 0.94 : 0.7;
            EXPECT_LT(errors.with, max_share * errors.without);
            EXPECT_LT(errors.smoothstep, max_share * errors.without);
            EXPECT_LT(errors.with, errors.diffuse_alone);
            EXPECT_NEAR(error(bare, kAmbientOcclusionExact, kSpecularOcclusionFit), errors.without,
                        0.01 * errors.without)
                << "a pack without cones has their error";
        }
    }
}

} // namespace hearth::test
