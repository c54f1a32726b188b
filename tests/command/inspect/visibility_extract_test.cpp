// Writes visibilities of a pack's parts again, and reads them back with hearth extract.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/rewrite.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr float kPi = std::numbers::pi_v<float>;
const std::string kBin = HEARTH_BIN;

/// Open box without a lid: five squares of 4 x 4 quads, whose normals point inwards.
std::string boxObj()
{
    constexpr int kSide = 4;
    const struct
    {
        Float3 corner, u, v;
    } sides[] = {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                 {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                 {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                 {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                 {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
    std::string text;
    int first = 1;
    for (const auto& side : sides)
    {
        for (int i = 0; i <= kSide; ++i)
            for (int j = 0; j <= kSide; ++j)
            {
                const Float3 p = side.corner + side.u * (static_cast<float>(i) / kSide) +
                                 side.v * (static_cast<float>(j) / kSide);
                text +=
                    "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
            }
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j)
            {
                const int at = first + i * (kSide + 1) + j;
                text += "f " + std::to_string(at) + " " + std::to_string(at + kSide + 1) + " " +
                        std::to_string(at + kSide + 2) + " " + std::to_string(at + 1) + "\n";
            }
        first += (kSide + 1) * (kSide + 1);
    }
    return text;
}

/// Moments that differ from vertex to vertex and are valid for any normal.
shared::VisibilityMoments momentsAt(Float3 position, Float3 normal)
{
    const float share = 0.3f + 0.2f * position.x + 0.4f * position.y;
    const Float3 axis = normalizeOr(normal + position * 0.2f, normal);
    const float sine2 = 1 - 0.25f * share;
    return {2 * kPi * share * (1 - std::sqrt(1 - sine2)), axis * (kPi * share * sine2)};
}

void bake(const pages::PageVertices& page, std::span<uint32_t> codes)
{
    size_t next = 0;
    for (const ClusterGeometry& cluster : page.geometry)
        for (uint32_t v = 0; v < cluster.vertexCount(); ++v)
        {
            const auto [m0, m1] = momentsAt(cluster.position(v), cluster.normal(v));
            codes[next++] = encodeVisibility(m0, m1, cluster.normal(v));
        }
}

} // namespace

TEST(VisibilityExtract, givesBackWhatWasWrittenIntoAClustersPart)
{
    Sandbox sandbox;
    sandbox.write("box.obj", boxObj());
    const auto run = [&](std::vector<std::string> command)
    {
        command[0] = kBin + "/" + command[0];
        const ProgramEnd end = sandbox.run(command);
        EXPECT_EQ(end.exit_code, 0) << command[0] << ": " << end.err;
        return end.out;
    };
    run({"hearth-import", "box.obj", "-o", "import.part"});
    run({"hearth-textures", "import.part", "-o", "textures.part"});
    run({"hearth-clusters", "import.part", "-o", "open.part", "--visibility"});
    {
        const auto part = ContainerReader::open(sandbox / "open.part");
        ASSERT_TRUE(part.ok());
        const Status status = pages::rewriteVisibility(*part, sandbox / "baked.part", bake);
        ASSERT_TRUE(status.ok()) << formatMessage(status.error());
    }
    run({"hearth-skinning", "import.part", "baked.part", "-o", "skinning.part"});
    run({"hearth-link", "import.part", "baked.part", "textures.part", "skinning.part", "-o", "box.hearth"});
    run({"hearth", "verify", "box.hearth"});
    EXPECT_NE(run({"hearth", "inspect", "box.hearth"}).find("visibility"), std::string::npos);
    run({"hearth", "extract", "box.hearth", "--mesh", "0", "--error", "0", "-o", "box.ply"});

    const std::string ply = sandbox.read("box.ply");
    const size_t data = ply.find("end_header\n") + std::strlen("end_header\n");
    const std::string header = ply.substr(0, data);
    std::string columns;
    for (size_t at = 0; (at = header.find("property float ", at)) != std::string::npos;)
    {
        at += std::strlen("property float ");
        columns += header.substr(at, header.find('\n', at) - at) + " ";
    }
    ASSERT_EQ(columns, "x y z nx ny nz axis_x axis_y axis_z aperture scale ao m0 m1_x m1_y m1_z ");
    const size_t count = std::stoul(header.substr(header.find("element vertex ") + 15));
    ASSERT_GE(count, 125u);
    for (size_t i = 0; i < count; ++i)
    {
        struct
        {
            Float3 position, normal, axis;
            float aperture, scale, ao, m0;
            Float3 m1;
        } vertex;
        std::memcpy(&vertex, ply.data() + data + i * sizeof(vertex), sizeof(vertex));
        const auto [m0, m1] = momentsAt(vertex.position, vertex.normal);
        ASSERT_NEAR(vertex.ao, dot(m1, vertex.normal) / kPi, 1.0 / 1022 + 1e-5);
        ASSERT_NEAR(vertex.m0, m0, 0.1f);
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_NEAR(vertex.m1[axis], m1[axis], kPi * (2.0f / 508 + 1.0f / 1022));
        const shared::VisibilityCone cone = shared::visibilityCone(vertex.m0, vertex.m1, vertex.normal);
        ASSERT_EQ(vertex.aperture, cone.aperture);
        ASSERT_EQ(vertex.scale, cone.scale);
        ASSERT_EQ(vertex.axis, cone.axis);
    }
}

} // namespace hearth::test
