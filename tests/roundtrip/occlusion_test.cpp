// Tests baked ambient occlusion from a source through the pack and back out of it, on shapes whose visibility
// has a closed form.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"

#include "formats/base/math.h"
#include "tests/reference/png_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>
#include <tuple>
#include <unistd.h>

namespace hearth::test
{

namespace
{

constexpr double kPi = std::numbers::pi;
const std::string kBin = HEARTH_BIN;

/// Limits of the root mean square error for each quality.
constexpr double kDefault = 0.006;
constexpr double kHigh = 0.002;

struct Shape
{
    std::vector<Float3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

    /// A parallelogram of n x m quads that faces cross(u, v).
    void addGrid(Float3 corner, Float3 u, Float3 v, uint32_t n, uint32_t m)
    {
        addSheet(n, m,
                 [&](double s, double t)
                 { return corner + u * static_cast<float>(s) + v * static_cast<float>(t); });
    }

    /// A sheet with positions `place` over [0, 1]^2; it faces the cross product of its derivatives.
    void addSheet(uint32_t n, uint32_t m, const std::function<Float3(double, double)>& place)
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

    std::string ply() const
    {
        std::ostringstream text;
        text.precision(9);
        text << "ply\nformat ascii 1.0\nelement vertex " << positions.size()
             << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << triangles.size()
             << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const Float3 p : positions)
            text << p.x << ' ' << p.y << ' ' << p.z << '\n';
        for (const auto& t : triangles)
            text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
        return text.str();
    }
};

/// A vertex as hearth extract writes it.
struct Seen
{
    Float3 position, normal, axis;
    float aperture, scale, ao, m0;
    Float3 m1;
};
static_assert(sizeof(Seen) == 16 * sizeof(float));

class Occlusion : public testing::Test
{
protected:
    void bake(const Shape& shape, std::vector<std::string> flags)
    {
        sandbox_.write("shape.ply", shape.ply());
        std::vector<std::string> cook{kBin + "/hearth", "cook", "shape.ply",   "-o",
                                      "shape.hearth",   "-q",   "--visibility"};
        cook.insert(cook.end(), flags.begin(), flags.end());
        const ProgramEnd cooked = sandbox_.run(cook);
        ASSERT_EQ(cooked.exit_code, 0) << cooked.err;
        const ProgramEnd verified = sandbox_.run({kBin + "/hearth", "verify", "shape.hearth"});
        ASSERT_EQ(verified.exit_code, 0) << verified.err;
        const ProgramEnd extracted = sandbox_.run(
            {kBin + "/hearth", "extract", "shape.hearth", "--mesh", "0", "--error", "0", "-o", "seen.ply"});
        ASSERT_EQ(extracted.exit_code, 0) << extracted.err;
        const std::string file = sandbox_.read("seen.ply");
        const std::string end = "end_header\n", element = "element vertex ";
        const size_t count = std::stoul(file.substr(file.find(element) + element.size()));
        const size_t start = file.find(end) + end.size();
        ASSERT_GE(file.size(), start + count * sizeof(Seen));
        seen_.resize(count);
        std::memcpy(seen_.data(), file.data() + start, count * sizeof(Seen));
    }

    /// Root mean square error of ambient occlusion over the vertices for which `wanted` has a value.
    double rms(const std::function<std::optional<double>(const Seen&)>& wanted) const
    {
        double sum = 0;
        size_t count = 0;
        for (const Seen& vertex : seen_)
            if (const auto value = wanted(vertex))
            {
                sum += (vertex.ao - *value) * (vertex.ao - *value);
                ++count;
            }
        EXPECT_GT(count, 0u);
        return std::sqrt(sum / static_cast<double>(std::max<size_t>(count, 1)));
    }

    /// Mean angle between the axes and `wanted`, degrees.
    double axisError(const std::function<std::optional<Float3>(const Seen&)>& wanted) const
    {
        double sum = 0;
        size_t count = 0;
        for (const Seen& vertex : seen_)
            if (const auto axis = wanted(vertex))
            {
                sum += std::acos(std::clamp(double{dot(vertex.axis, normalizeOr(*axis, {}))}, -1.0, 1.0));
                ++count;
            }
        EXPECT_GT(count, 0u);
        return sum / static_cast<double>(std::max<size_t>(count, 1)) * 180 / kPi;
    }

    Sandbox sandbox_;
    std::vector<Seen> seen_;
};

const std::vector<std::string> kAtHigh{"--visibility-quality", "high"};

/// Part of a floor point's hemisphere that a wall occludes: its foot is `distance` away, it is `height` high
/// and reaches `side` to one side.
double hiddenByWall(double distance, double height, double side)
{
    if (distance < 1e-4)
        return side > 1e-4 ? 0.25 : 0; // the grid moves 0 by a little
    const double far = std::hypot(distance, height);
    return (std::atan(side / distance) - distance / far * std::atan(side / far)) / (2 * kPi);
}

Shape bowl(uint32_t n)
{
    // A cap of 120 degrees of the unit sphere, cut off where triangles would be slivers; the hole is closed.
    Shape shape;
    const double first = 0.02, last = 2 * kPi / 3;
    const auto place = [&](double s, double t)
    {
        const double angle = first + (last - first) * s, turn = -2 * kPi * t;
        return Float3{static_cast<float>(std::sin(angle) * std::cos(turn)),
                      static_cast<float>(-std::cos(angle)),
                      static_cast<float>(std::sin(angle) * std::sin(turn))};
    };
    shape.addSheet(n, 2 * n, place);
    return shape;
}

/// Mean of the directions in which a point of the bowl sees the sky, through the disc that closes the bowl
/// (radius sin 60 degrees, half a radius above the centre). Summed over the disc.
Float3 meanThroughOpening(const Seen& vertex)
{
    constexpr int kRings = 40, kTurns = 80;
    const double radius = std::sin(2 * kPi / 3);
    double sum[3] = {0, 0, 0};
    for (int r = 0; r < kRings; ++r)
        for (int t = 0; t < kTurns; ++t)
        {
            const double rho = radius * (r + 0.5) / kRings, turn = 2 * kPi * (t + 0.5) / kTurns;
            const double to[3] = {rho * std::cos(turn) - vertex.position.x, 0.5 - vertex.position.y,
                                  rho * std::sin(turn) - vertex.position.z};
            const double length2 = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
            // weight: cosine at the disc over the distance squared; and the direction
            const double solid = rho * to[1] / (length2 * length2);
            for (int axis = 0; axis < 3; ++axis)
                sum[axis] += to[axis] * solid;
        }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

} // namespace

TEST_F(Occlusion, ofAPlaneIsNone)
{
    Shape plane;
    plane.addGrid({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 20, 20);
    bake(plane, {});
    for (const Seen& vertex : seen_)
    {
        EXPECT_EQ(vertex.ao, 1.0f);
        EXPECT_NEAR(vertex.aperture, kPi / 2, 1e-6);
        EXPECT_EQ(vertex.scale, 1.0f);
    }
}

TEST_F(Occlusion, ofACreaseIsAHalfAndOfACornerAQuarter)
{
    // Three walls of a room, with a crease along each axis.
    constexpr float kSize = 8;
    Shape room;
    room.addGrid({0, 0, 0}, {0, 0, kSize}, {kSize, 0, 0}, 80, 80);
    room.addGrid({0, 0, 0}, {kSize, 0, 0}, {0, kSize, 0}, 80, 80);
    room.addGrid({0, 0, 0}, {0, kSize, 0}, {0, 0, kSize}, 80, 80);
    bake(room, kAtHigh);
    const auto floorAt = [&](const Seen& v) -> std::optional<double>
    {
        if (v.normal.y < 0.99f || v.position.x > 4 || v.position.z > 4)
            return std::nullopt;
        const double x = v.position.x, z = v.position.z;
        if (x < 1e-3 && z < 1e-3) // the limit counts there, tested below
            return std::nullopt;
        return 1 - hiddenByWall(x, kSize, z) - hiddenByWall(x, kSize, kSize - z) - hiddenByWall(z, kSize, x) -
               hiddenByWall(z, kSize, kSize - x);
    };
    EXPECT_LT(rms(floorAt), kHigh);
    size_t corners = 0;
    for (const Seen& vertex : seen_)
        if (length(vertex.position) < 1e-3f)
        {
            ++corners;
            EXPECT_NEAR(vertex.ao, 0.25, 0.01);
            EXPECT_NEAR(vertex.aperture * 180 / kPi, 42.94, 1);
            EXPECT_NEAR(vertex.scale, 0.9330, 0.02);
            EXPECT_GT(dot(vertex.axis, normalizeOr({1, 1, 1}, {})), std::cos(kPi / 180));
        }
    EXPECT_GT(corners, 2u);
}

TEST_F(Occlusion, besideAWall)
{
    // The wall is as long as it is high, and occludes the region behind it.
    constexpr float kHeight = 2, kHalf = 6;
    Shape shape;
    shape.addGrid({0, 0, -kHalf}, {0, 0, 2 * kHalf}, {kHalf, 0, 0}, 120, 60);
    shape.addGrid({0, 0, -kHalf}, {0, kHeight, 0}, {0, 0, 2 * kHalf}, 20, 120);
    const auto floorAt = [&](const Seen& v) -> std::optional<double>
    {
        if (v.normal.y < 0.99f || std::abs(v.position.z) > 4)
            return std::nullopt;
        return 1 - hiddenByWall(v.position.x, kHeight, kHalf - v.position.z) -
               hiddenByWall(v.position.x, kHeight, kHalf + v.position.z);
    };
    bake(shape, {});
    EXPECT_LT(rms(floorAt), kDefault);
    bake(shape, kAtHigh);
    EXPECT_LT(rms(floorAt), kHigh);
}

TEST_F(Occlusion, inAGrooveIsTheSineOfHalfItsAngleOnAverage)
{
    for (const double angle : {kPi / 3, kPi / 2})
    {
        const auto c = static_cast<float>(std::cos(angle / 2)), s = static_cast<float>(std::sin(angle / 2));
        constexpr float kLong = 60;
        Shape groove;
        groove.addGrid({0, 0, 0}, {s, c, 0}, {0, 0, -kLong}, 16, 240);
        groove.addGrid({0, 0, 0}, {0, 0, -kLong}, {-s, c, 0}, 240, 16);
        bake(groove, {});
        double sum = 0, weights = 0;
        for (const Seen& vertex : seen_)
            if (vertex.position.z < -25 && vertex.position.z > -35)
            {
                const bool at_end = vertex.position.y < 1e-3f || vertex.position.y > c - 1e-3f;
                sum += vertex.ao * (at_end ? 0.5 : 1);
                weights += at_end ? 0.5 : 1;
            }
        // Vertices on cluster borders occur twice, but are distributed evenly enough.
        EXPECT_NEAR(sum / weights, std::sin(angle / 2), 0.01) << angle;
    }
}

TEST_F(Occlusion, atTheBottomOfAPit)
{
    for (const double depth : {0.5, 2.0})
    {
        Shape pit;
        const auto ring = [&](double radius, double turn, double height)
        {
            return Float3{static_cast<float>(radius * std::cos(2 * kPi * turn)), static_cast<float>(height),
                          static_cast<float>(radius * std::sin(2 * kPi * turn))};
        };
        pit.addSheet(30, 96, [&](double r, double t) { return ring(0.02 + 0.98 * r, -t, 0); });
        pit.addSheet(40, 96, [&](double h, double t) { return ring(1, -t, h * depth); });
        bake(pit, {});
        // form factor of an opening of radius 1: a disc that faces a parallel element
        const auto bottom = [&](const Seen& v) -> std::optional<double>
        {
            if (v.position.y > 1e-4)
                return std::nullopt;
            const double out2 = v.position.x * v.position.x + v.position.z * v.position.z;
            if (out2 >
                0.97 * 0.97) // at the foot of the wall the slope is infinite, which triangles cannot follow
                return std::nullopt;
            const double sum = out2 + depth * depth + 1;
            return 0.5 * (1 - (sum - 2) / std::sqrt(sum * sum - 4 * out2));
        };
        EXPECT_LT(rms(bottom), kDefault) << depth;
        const auto up = [&](const Seen& v) -> std::optional<Float3>
        {
            const bool middle = v.position.y < 1e-4 && std::hypot(v.position.x, v.position.z) < 0.03;
            return middle ? std::optional(Float3{0, 1, 0}) : std::nullopt;
        };
        EXPECT_LT(axisError(up), 2);
    }
}

TEST_F(Occlusion, belowASphere)
{
    constexpr double kHeight = 1.2;
    Shape shape;
    shape.addGrid({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 96, 96);
    shape.addSheet(48, 96,
                   [&](double s, double t)
                   {
                       const double angle = kPi * (0.005 + 0.99 * s);
                       return Float3{static_cast<float>(std::sin(angle) * std::cos(-2 * kPi * t)),
                                     static_cast<float>(kHeight + std::cos(angle)),
                                     static_cast<float>(std::sin(angle) * std::sin(-2 * kPi * t))};
                   });
    const auto onPlane = [&](const Seen& v) -> std::optional<double>
    {
        if (v.position.y > 1e-4)
            return std::nullopt;
        const double x = std::hypot(v.position.x, v.position.z);
        return 1 - kHeight / std::pow(kHeight * kHeight + x * x, 1.5);
    };
    bake(shape, {});
    EXPECT_LT(rms(onPlane), kDefault);
    bake(shape, kAtHigh);
    EXPECT_LT(rms(onPlane), kHigh);
}

TEST_F(Occlusion, belowACeilingFadesWithDistance)
{
    constexpr double kCeiling = 1, kDistance = 2.5, kRatio = kCeiling / kDistance;
    Shape shape;
    shape.addGrid({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 32, 32);
    shape.addGrid({-4, kCeiling, 4}, {0, 0, -8}, {8, 0, 0}, 32, 32);
    const auto bakeWith = [&](const char* power) {
        bake(shape, {"--visibility-distance", "2.5", "--visibility-power", power});
    };
    const auto middle = [](double value)
    {
        return [value](const Seen& v)
        {
            const bool inside =
                v.position.y < 0.5 && std::abs(v.position.x) < 1.4 && std::abs(v.position.z) < 1.4;
            return inside ? std::optional(value) : std::nullopt;
        };
    };
    bakeWith("1");
    EXPECT_LT(rms(middle(2 * kRatio - kRatio * kRatio)), kDefault);
    bakeWith("2");
    EXPECT_LT(rms(middle(2 * kRatio * kRatio * (0.5 - std::log(kRatio)))), kDefault);
    bakeWith("0");
    EXPECT_LT(rms(middle(kRatio * kRatio)), kDefault) << "what is beyond is open";
}

TEST_F(Occlusion, inABowlIsTheSameEverywhere)
{
    const Shape shape = bowl(48);
    // 1 - A / (4 pi R^2), A = 2 pi R^2 (1 - cos 120 degrees)
    const auto wanted = [](const Seen&) -> std::optional<double> { return 0.25; };
    const auto towardsOpening = [](const Seen& v) -> std::optional<Float3>
    { return v.position.y < 0.2f ? std::optional(meanThroughOpening(v)) : std::nullopt; };
    bake(shape, {});
    EXPECT_LT(rms(wanted), kDefault);
    EXPECT_LT(axisError(towardsOpening), 1);
    bake(shape, kAtHigh);
    EXPECT_LT(rms(wanted), kHigh);
    EXPECT_LT(axisError(towardsOpening), 1);
}

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
    for (const Seen& vertex : seen_)
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
    bake(sheet, {});
    std::sort(seen_.begin(), seen_.end(),
              [](const Seen& a, const Seen& b)
              {
                  return std::tie(a.position.x, a.position.y, a.position.z) <
                         std::tie(b.position.x, b.position.y, b.position.z);
              });
    size_t pairs = 0;
    for (size_t i = 1; i < seen_.size(); ++i)
    {
        const Seen &a = seen_[i - 1], &b = seen_[i];
        if (!(a.position == b.position) || dot(a.normal, b.normal) < 0.999f)
            continue;
        ++pairs;
        EXPECT_EQ(a.ao, b.ao);
        EXPECT_EQ(a.m0, b.m0);
        EXPECT_EQ(a.m1, b.m1);
    }
    EXPECT_GT(pairs, 50u);
}

TEST_F(Occlusion, isWrittenAlikeByAnyNumberOfThreads)
{
    sandbox_.write("bowl.ply", bowl(24).ply());
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

TEST_F(Occlusion, isReportedWithAImage)
{
    bake(bowl(16), {"--visibility-quality", "draft", "--visibility-refine", "--report", "report.json"});
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
