// Tests the cook with baked occlusion from a source through the pack and back out of it: what has no closed
// form. occlusion_forms_test.cpp has the shapes that have one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/reference/png_image.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <numbers>
#include <tuple>
#include <unistd.h>

namespace hearth::test
{

namespace
{

const std::string kBin = HEARTH_BIN;

class Occlusion : public testing::Test
{
protected:
    void bake(const Shape& shape, const std::vector<std::string>& flags)
    {
        seen_ = bakeShape(sandbox_, shape, flags);
    }

    Sandbox sandbox_;
    std::vector<SeenVertex> seen_;
};

/// Half a ball that is open at its top, as an ordinary curved shape.
Shape makeBowl(uint32_t n)
{
    Shape shape;
    shape.addSheet(n, 2 * n,
                   [](double s, double t)
                   {
                       const double angle = std::numbers::pi * (0.01 + 0.5 * s);
                       const double turn = -2 * std::numbers::pi * t;
                       return Float3{static_cast<float>(std::sin(angle) * std::cos(turn)),
                                     static_cast<float>(-std::cos(angle)),
                                     static_cast<float>(std::sin(angle) * std::sin(turn))};
                   });
    return shape;
}

} // namespace

TEST_F(Occlusion, ofAFloorThatGoesOnBelowARugIsThatOfWhatIsBesideIt)
{
    // A rug of two centimetres covers a third of a floor of two triangles. Beside it the floor is open except
    // for the rug's rim.
    Shape shape;
    shape.addGrid({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 1, 1);
    const float low = 0.005f, high = 0.02f;
    const Float3 side{4, 0, 0}, back{0, 0, -4}, up{0, high - low, 0};
    shape.addGrid({-2, high, 2}, side, back, 8, 8);
    shape.addGrid({-2, low, 2}, back, side, 8, 8);
    shape.addGrid({-2, low, 2}, side, up, 8, 1);
    shape.addGrid({2, low, 2}, back, up, 8, 1);
    shape.addGrid({2, low, -2}, side * -1.0f, up, 8, 1);
    shape.addGrid({-2, low, -2}, back * -1.0f, up, 8, 1);
    bake(shape, {"--report", "report.json"});
    size_t corners = 0;
    for (const SeenVertex& vertex : seen_)
        if (std::abs(vertex.position.y) < 1e-4f)
        {
            ++corners;
            EXPECT_GT(vertex.ao, 0.95f);
        }
    EXPECT_EQ(corners, 4u);
    const auto report = Json::parse(sandbox_.read("report.json")).value();
    const auto& mesh = report["assets"][0]["visibility"]["meshes"][0];
    EXPECT_GT(mesh["interior_samples"].get<double>(), 3);
    EXPECT_LE(mesh["solve"]["iterations"].get<double>(), 20);
}

TEST_F(Occlusion, hasNoSeamWhereVerticesMeet)
{
    // A bent sheet of three strips that share no vertex. The middle one is twice as fine, so that its
    // neighbours have T-junctions. Some triangles are duplicates, some are slivers; a roof occludes half of
    // the sky.
    const auto bent = [](double x, double z) {
        return Float3{static_cast<float>(x), static_cast<float>(0.3 * std::sin(2 * x)),
                      static_cast<float>(-z)};
    };
    Shape sheet;
    sheet.addSheet(16, 16, [&](double s, double t) { return bent(s, 3 * t); });
    sheet.addSheet(16, 32, [&](double s, double t) { return bent(1 + s, 3 * t); });
    sheet.addSheet(16, 16, [&](double s, double t) { return bent(2 + s, 3 * t); });
    for (size_t t = 0; t < 200; t += 3)
        sheet.triangles.push_back(sheet.triangles[t]);
    for (uint32_t i = 0; i + 1 < 16; ++i)
    {
        // a point beside the middle of the edge, a ten-thousandth of the edge off
        const Float3 a = sheet.positions[i], b = sheet.positions[i + 1];
        sheet.positions.push_back((a + b) * 0.5f + Float3{-1e-4f * length(b - a), 0, 0});
        sheet.triangles.push_back({i + 1, i, static_cast<uint32_t>(sheet.positions.size() - 1)});
    }
    sheet.addGrid({0, 1, 0}, {0, 0, -1.5f}, {3, 0, 0}, 4, 4);
    for (const std::vector<std::string>& flags :
         {std::vector<std::string>{}, {"--proxy-from", "clean", "--visibility-proxies", "fit"}})
    {
        bake(sheet, flags);
        std::sort(seen_.begin(), seen_.end(),
                  [](const SeenVertex& a, const SeenVertex& b)
                  {
                      return std::tie(a.position.x, a.position.y, a.position.z) <
                             std::tie(b.position.x, b.position.y, b.position.z);
                  });
        size_t pairs = 0;
        for (size_t i = 1; i < seen_.size(); ++i)
        {
            const SeenVertex &a = seen_[i - 1], &b = seen_[i];
            if (!(a.position == b.position) || dot(a.normal, b.normal) < 0.999f)
                continue;
            ++pairs;
            EXPECT_EQ(a.ao, b.ao);
            EXPECT_EQ(a.m0, b.m0);
            EXPECT_EQ(a.m1, b.m1);
        }
        EXPECT_GT(pairs, 50u);
    }
}

TEST_F(Occlusion, ofALargeMeshIsInterpolatedFromACoarserLevel)
{
    // 400,000 triangles exceed what draft spends
    bake(makeBowl(320), {"--visibility-quality", "draft", "--report", "report.json"});
    const auto report = Json::parse(sandbox_.read("report.json")).value();
    const auto& mesh = report["assets"][0]["visibility"]["meshes"][0];
    EXPECT_GT(mesh["sampled_level"].get<double>(), 0);
    EXPECT_LT(mesh["rays"].get<double>(), 1.02 * 0x1p22);
    // a bowl occludes its area as a share of the whole sphere's
    const double ao = 1 - (std::cos(std::numbers::pi * 0.01) - std::cos(std::numbers::pi * 0.51)) / 2;
    double sum = 0;
    for (const SeenVertex& vertex : seen_)
        sum += std::pow(double{vertex.ao} - ao, 2);
    EXPECT_GT(seen_.size(), 200'000u);
    EXPECT_LT(std::sqrt(sum / static_cast<double>(seen_.size())), 0.03);
}

TEST_F(Occlusion, isWrittenAlikeByAnyNumberOfThreads)
{
    sandbox_.write("bowl.ply", makeBowl(24).ply());
    const auto part = [&](const std::string& kind) { return sandbox_ / (kind + ".part"); };
    ASSERT_EQ(sandbox_.run({kBin + "/hearth-import", "bowl.ply", "-o", part("import")}).exit_code, 0);
    ASSERT_EQ(
        sandbox_.run({kBin + "/hearth-clusters", part("import"), "-o", part("clusters"), "--visibility"})
            .exit_code,
        0);
    for (const std::string jobs : {"1", "2", "7"})
        ASSERT_EQ(sandbox_
                      .run({kBin + "/hearth-visibility", part("import"), part("clusters"), "-o", part(jobs),
                            "-j", jobs})
                      .exit_code,
                  0);
    EXPECT_EQ(sandbox_.read("1.part"), sandbox_.read("2.part"));
    EXPECT_EQ(sandbox_.read("1.part"), sandbox_.read("7.part"));
    EXPECT_NE(sandbox_.read("1.part"), sandbox_.read("clusters.part"));
}

TEST_F(Occlusion, isReportedWithAnImage)
{
    bake(makeBowl(16), {"--visibility-quality", "draft", "--visibility-refine", "--report", "report.json"});
    const auto report = Json::parse(sandbox_.read("report.json")).value();
    const auto& visibility = report["assets"][0]["visibility"];
    const auto& mesh = visibility["meshes"][0];
    EXPECT_EQ(mesh["rays"], 32 * mesh["samples"].get<uint64_t>());
    EXPECT_GT(mesh["seconds"]["rays"].get<double>(), 0);
    EXPECT_GT(mesh["seconds"]["fit"].get<double>(), 0);
    EXPECT_GT(mesh["solve"]["iterations"].get<double>(), 0);
    EXPECT_GE(mesh["solve"]["condition"].get<double>(), 1);
    EXPECT_TRUE(mesh.contains("clamped"));
    EXPECT_FALSE(mesh.contains("ao_error")) << "its noise takes time, and a report asks for none";
    EXPECT_GT(mesh["refined"]["cones"].get<double>(), 0);
    EXPECT_LT(mesh["refined"]["distance"].get<double>(), mesh["refined"]["distance_before"].get<double>());
    // the signature of PNG
    EXPECT_EQ(visibility["image"].get<std::string>().find("data:image/png;base64,iVBORw0KGgo"), 0u);
}

TEST_F(Occlusion, isDrawn)
{
    // a floor, and a dark one below that the upper one hides from the viewer
    Shape shape;
    shape.addGrid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 4, 4);
    shape.addGrid({-0.3f, -0.3f, 0.3f}, {0.6f, 0, 0}, {0, 0, -0.6f}, 4, 4);
    sandbox_.write("floors.ply", shape.ply());
    ASSERT_EQ(sandbox_.run({kBin + "/hearth-import", "floors.ply", "-o", "import.part"}).exit_code, 0);
    ASSERT_EQ(sandbox_.run({kBin + "/hearth-clusters", "import.part", "-o", "clusters.part", "--visibility"})
                  .exit_code,
              0);
    const ProgramEnd end = sandbox_.run({kBin + "/hearth-visibility", "import.part", "clusters.part", "-o",
                                         "out.part", "--image", "seen.png"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const auto image = reference::readPng(sandbox_ / "seen.png");
    ASSERT_TRUE(image.ok());
    ASSERT_EQ(image->width, 640u);
    ASSERT_EQ(image->height, 480u);
    size_t white = 0, dark = 0;
    for (size_t i = 0; i < image->rgb.size(); i += 3)
    {
        white += image->rgb[i] > 250;
        dark += image->rgb[i] == 26;
    }
    // 4 m^2 from 30 degrees above, in an image that the square's 2.8 m, rotated by 37 degrees, fill to 1 /
    // 1.04
    const double metre = 640 / (2.8 * 1.04), pixels = 640 * 480;
    EXPECT_NEAR(static_cast<double>(white), 2 * metre * metre, 0.03 * pixels);
    EXPECT_NEAR(static_cast<double>(white + dark), pixels, 0.01 * pixels) << "but for edges";
    EXPECT_EQ(image->at(0, 0)[0], 26) << "background";
    EXPECT_GT(image->at(320, 260)[0], 250) << "the floor, in front of the lower one";
    EXPECT_EQ(sandbox_
                  .run({kBin + "/hearth-visibility", "import.part", "clusters.part", "-o", "out.part",
                        "--image", "nowhere/seen.png"})
                  .exit_code,
              73);
}

TEST_F(Occlusion, isNotWrittenWhenItIsInterrupted)
{
    Shape plane;
    plane.addGrid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 300, 300);
    sandbox_.write("plane.ply", plane.ply());
    ASSERT_EQ(sandbox_.run({kBin + "/hearth-import", "plane.ply", "-o", "import.part"}).exit_code, 0);
    ASSERT_EQ(sandbox_.run({kBin + "/hearth-clusters", "import.part", "-o", "clusters.part", "--visibility"})
                  .exit_code,
              0);
    const size_t files = sandbox_.list().size();
    const pid_t process = sandbox_.start({kBin + "/hearth-visibility", "import.part", "clusters.part", "-o",
                                          "visibility.part", "--quality", "high"});
    // its rays take many seconds
    ::usleep(1000000);
    ::kill(process, SIGINT);
    const ProgramEnd end = sandbox_.finish(process);
    EXPECT_EQ(end.exit_code, 130) << end.err;
    EXPECT_EQ(sandbox_.list().size(), files);
}

} // namespace hearth::test
