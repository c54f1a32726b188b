// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/occlusion_bake.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <sstream>

namespace hearth::test
{

namespace
{

const std::string kBin = HEARTH_BIN;

} // namespace

void Shape::addGrid(Float3 corner, Float3 u, Float3 v, uint32_t n, uint32_t m)
{
    addSheet(n, m,
             [&](double s, double t)
             { return corner + u * static_cast<float>(s) + v * static_cast<float>(t); });
}

void Shape::addSheet(uint32_t n, uint32_t m, const std::function<Float3(double, double)>& place)
{
    const auto first = static_cast<uint32_t>(positions.size());
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= m; ++j)
            positions.push_back(place(double{1} * i / n, double{1} * j / m));
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < m; ++j)
        {
            const uint32_t a = first + i * (m + 1) + j, b = a + m + 1;
            triangles.push_back({a, b, b + 1});
            triangles.push_back({a, b + 1, a + 1});
        }
}

std::string Shape::ply() const
{
    std::ostringstream text;
    text.precision(9);
    text << "ply\nformat ascii 1.0\nelement vertex " << positions.size()
         << "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!normals.empty())
        text << "property float nx\nproperty float ny\nproperty float nz\n";
    text << "element face " << triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (size_t v = 0; v < positions.size(); ++v)
    {
        text << positions[v].x << ' ' << positions[v].y << ' ' << positions[v].z;
        if (!normals.empty())
            text << ' ' << normals[v].x << ' ' << normals[v].y << ' ' << normals[v].z;
        text << '\n';
    }
    for (const auto& t : triangles)
        text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return text.str();
}

std::vector<SeenVertex> extractVertices(Sandbox& sandbox, const std::string& pack, uint32_t mesh)
{
    const ProgramEnd extracted = sandbox.run({kBin + "/hearth", "extract", pack, "--mesh",
                                              std::to_string(mesh), "--error", "0", "-o", "seen.ply"});
    EXPECT_EQ(extracted.exit_code, 0) << extracted.err;
    if (extracted.exit_code != 0)
        return {};
    const std::string file = sandbox.read("seen.ply");
    const std::string header_end = "end_header\n", element = "element vertex ";
    std::vector<SeenVertex> vertices(std::stoul(file.substr(file.find(element) + element.size())));
    const size_t start = file.find(header_end) + header_end.size();
    EXPECT_GE(file.size(), start + vertices.size() * sizeof(SeenVertex));
    std::memcpy(vertices.data(), file.data() + start,
                std::min(file.size() - start, vertices.size() * sizeof(SeenVertex)));
    return vertices;
}

std::vector<SeenVertex> bakeShape(Sandbox& sandbox, const Shape& shape, const std::vector<std::string>& flags)
{
    sandbox.write("shape.ply", shape.ply());
    std::vector<std::string> cook{kBin + "/hearth", "cook", "shape.ply",   "-o",
                                  "shape.hearth",   "-q",   "--visibility"};
    cook.insert(cook.end(), flags.begin(), flags.end());
    const ProgramEnd cooked = sandbox.run(cook);
    EXPECT_EQ(cooked.exit_code, 0) << cooked.err;
    const ProgramEnd verified = sandbox.run({kBin + "/hearth", "verify", "shape.hearth"});
    EXPECT_EQ(verified.exit_code, 0) << verified.err;
    return extractVertices(sandbox, "shape.hearth");
}

Shape makeBox(Float3 size)
{
    constexpr uint32_t kQuads = 8;
    Shape shape;
    const Float3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z}, none{0, 0, 0};
    shape.addGrid(none, y, x, kQuads, kQuads);
    shape.addGrid(z, x, y, kQuads, kQuads);
    shape.addGrid(none, z, y, kQuads, kQuads);
    shape.addGrid(x, y, z, kQuads, kQuads);
    shape.addGrid(none, x, z, kQuads, kQuads);
    shape.addGrid(y, z, x, kQuads, kQuads);
    return shape;
}

samples::Primitive makePrimitive(const Shape& shape, int material)
{
    samples::Primitive primitive;
    primitive.material = material;
    primitive.mesh.positions = shape.positions;
    for (const auto& triangle : shape.triangles)
        primitive.mesh.indices.insert(primitive.mesh.indices.end(), triangle.begin(), triangle.end());
    return primitive;
}

double rmsDifference(const std::vector<SeenVertex>& a, const std::vector<SeenVertex>& b)
{
    EXPECT_EQ(a.size(), b.size());
    EXPECT_FALSE(a.empty());
    double sum = 0;
    for (size_t v = 0; v < std::min(a.size(), b.size()); ++v)
    {
        EXPECT_EQ(a[v].position, b[v].position);
        sum += std::pow(double{a[v].ao} - b[v].ao, 2);
    }
    return std::sqrt(sum / static_cast<double>(std::max<size_t>(a.size(), 1)));
}

} // namespace hearth::test
