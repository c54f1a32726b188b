// Compares baked occlusion with closed forms, from a source through `hearth cook` and the pack: every shape
// at the default quality and at high, shapes of planes also rotated at random.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/reference/polygon_visibility.h"
#include "tests/roundtrip/occlusion_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>

namespace hearth::test
{

namespace
{

using reference::Double3;
using reference::Polygon;

constexpr double kPi = std::numbers::pi;

/// Limits of the root mean square error of ambient occlusion, as in cook/visibility/README.md.
constexpr double kMaxError = 0.006, kMaxErrorAtHigh = 0.002, kMaxErrorOfPlanesAtHigh = 0.0016,
                 kMaxErrorOnAFifth = 0.006;
/// Limits at high quality: of |m1| over pi, rms; of |m1| over m0, which gives the cone's aperture, rms; and
/// of the axis's mean angle, degrees.
constexpr double kMaxM1Error = 0.002, kMaxRatioError = 0.004, kMaxAxisError = 1;

const std::vector<std::string> kAtHigh{"--visibility-quality", "high"};

/// Visibility of a point in closed form: ambient occlusion, and where there are forms of them both moments
/// and the axis.
struct Truth
{
    double ao = 0;
    std::optional<double> m0{};
    std::optional<Double3> m1{};
    std::optional<Double3> axis{}; ///< of any length
    size_t plane = 0;              ///< of the shape
};

/// Shape with closed forms. `truth` has no value where there is none.
struct KnownShape
{
    std::string name;
    Shape shape{};
    std::function<std::optional<Truth>(const SeenVertex&)> truth{};
    std::vector<std::string> flags{};
    /// Limit of the mean error over one of its planes, at high quality: noise hardly has any. 0: no planes.
    double max_bias = 0;
    double max_axis_error = 1; ///< mean, degrees, at default quality

    friend void PrintTo(const KnownShape& known, std::ostream* stream) { *stream << known.name; }
};

/// Planar quadrangle of n x m quads; its corners run counter-clockwise when seen from its front.
struct Panel
{
    std::array<Double3, 4> corners;
    uint32_t n, m;

    Double3 at(double s, double t) const
    {
        return corners[0] * ((1 - s) * (1 - t)) + corners[1] * (s * (1 - t)) + corners[2] * (s * t) +
               corners[3] * ((1 - s) * t);
    }
    Double3 normal() const { return normalize(cross(corners[1] - corners[0], corners[3] - corners[0])); }
};

Panel makePanel(Double3 corner, Double3 u, Double3 v, uint32_t n, uint32_t m)
{
    return {{corner, corner + u, corner + u + v, corner + v}, n, m};
}

Float3 narrow(Double3 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Rotation, as the images of the axes.
struct Rotation
{
    Double3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    Double3 turned(Double3 v) const { return x * v.x + y * v.y + z * v.z; }
    Double3 turnedBack(Double3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

Rotation randomRotation(uint32_t seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto direction = [&] { return Double3{normal(random), normal(random), normal(random)}; };
    Rotation rotation;
    rotation.x = normalize(direction());
    rotation.y = normalize(cross(rotation.x, direction()));
    rotation.z = cross(rotation.x, rotation.y);
    return rotation;
}

/// Panels, none of which covers a part of another where it is seen.
struct PanelScene
{
    std::string name;
    std::vector<Panel> panels;
    std::function<bool(Double3)> counts; ///< true where the forms hold for vertices
    double max_bias = 0.0006;

    KnownShape rotated(const Rotation& rotation, const std::string& suffix) const;
};

Truth visibleFrom(const std::vector<Panel>& panels, size_t number, Double3 point)
{
    const Double3 normal = panels[number].normal();
    std::vector<Polygon> others;
    for (size_t p = 0; p < panels.size(); ++p)
        if (p != number)
            others.emplace_back(panels[p].corners.begin(), panels[p].corners.end());
    // the limit towards the middle of the panel: vertices in a crease lie in the other panel, too, and all of
    // them have moved to the mesh's grid
    const Double3 on_plane = point - normal * dot(point - panels[number].corners[0], normal);
    const Double3 inside = on_plane + (panels[number].at(0.5, 0.5) - on_plane) * 2e-4;
    const auto moments = reference::visibleBesidePolygons(inside, normal, others);
    return {.ao = dot(moments.m1, normal) / kPi,
            .m0 = moments.m0,
            .m1 = moments.m1,
            .axis = moments.m1,
            .plane = number};
}

KnownShape PanelScene::rotated(const Rotation& rotation, const std::string& suffix) const
{
    std::vector<Panel> moved = panels;
    KnownShape known{.name = name + suffix};
    known.max_bias = max_bias;
    for (Panel& panel : moved)
    {
        for (Double3& corner : panel.corners)
            corner = rotation.turned(corner);
        known.shape.addSheet(panel.n, panel.m, [&](double s, double t) { return narrow(panel.at(s, t)); });
        known.shape.normals.resize(known.shape.positions.size(), narrow(panel.normal()));
    }
    known.truth = [moved, rotation, counts = counts](const SeenVertex& v) -> std::optional<Truth>
    {
        const Double3 point(v.position);
        if (!counts(rotation.turnedBack(point)))
            return std::nullopt;
        for (size_t p = 0; p < moved.size(); ++p)
        {
            const Double3 normal = moved[p].normal();
            if (dot(normal, Double3(v.normal)) > 0.999 &&
                std::abs(dot(normal, point - moved[p].corners[0])) < 1e-3)
                return visibleFrom(moved, p, point);
        }
        return std::nullopt;
    };
    return known;
}

/// Two sides of unit width that meet at an angle along z.
PanelScene groove(int degrees)
{
    const double half = degrees * kPi / 360, length = 4;
    const Double3 right{std::sin(half), std::cos(half), 0}, left{-right.x, right.y, 0}, along{0, 0, length};
    return {"groove" + std::to_string(degrees),
            {makePanel(along * 0.5, right, -along, 16, 32), makePanel(along * -0.5, left, along, 16, 32)},
            [](Double3 p) { return std::abs(p.z) < 1.3; }};
}

/// Three walls of a room, with a crease along each axis. At the corner itself there is a limit along each
/// way; ofACorner tests it.
PanelScene room()
{
    const Double3 x{8, 0, 0}, y{0, 8, 0}, z{0, 0, 8};
    return {"room",
            {makePanel({}, z, x, 24, 24), makePanel({}, x, y, 24, 24), makePanel({}, y, z, 24, 24)},
            [](Double3 p) {
                return std::max({p.x, p.y, p.z}) < 4 && length(p) > 0.01;
            }};
}

/// A wall of two metres along a floor.
PanelScene wall()
{
    const Double3 foot{0, 0, -6}, along{0, 0, 12}, up{0, 2, 0};
    return {"wall",
            {makePanel(foot, along, {6, 0, 0}, 48, 24), makePanel(foot, up, along, 8, 48)},
            [](Double3 p) { return std::abs(p.z) < 4; }};
}

/// A floor with four walls that lean outwards, each by an angle of its own.
PanelScene funnel()
{
    const Double3 a{-1, 0, 1}, b{1, 0, 1}, c{1, 0, -1}, d{-1, 0, -1};
    // corners above a, b, c and d: where the planes of the walls, y = height, and each other meet
    const double left = 1.3, right = 1.8, front = 2.2, back = 1.6, height = 1;
    const Double3 e{-left, height, front}, f{right, height, front}, g{right, height, -back},
        h{-left, height, -back};
    return {"funnel",
            {{{a, b, c, d}, 20, 20},
             {{b, a, e, f}, 20, 14},
             {{c, b, f, g}, 20, 14},
             {{d, c, g, h}, 20, 14},
             {{a, d, h, e}, 20, 14}},
            // around a corner the visibility depends on the direction to it alone, however near it is:
            // triangles cannot follow
            [=](Double3 p)
            {
                double nearest = 1;
                for (const Double3 corner : {a, b, c, d, e, f, g, h})
                    nearest = std::min(nearest, length(p - corner));
                return nearest > 0.7;
            },
            0.001}; // quads are coarser beside the walls than elsewhere
}

std::vector<PanelScene> panelScenes()
{
    return {groove(60), groove(90), groove(120), room(), wall(), funnel()};
}

/// Bottom of a pit of radius 1.
KnownShape pit(double depth)
{
    KnownShape known{.name = depth < 1 ? "shallowPit" : "deepPit"};
    const auto ring = [](double radius, double turn, double height)
    {
        return Float3{static_cast<float>(radius * std::cos(2 * kPi * turn)), static_cast<float>(height),
                      static_cast<float>(radius * std::sin(2 * kPi * turn))};
    };
    known.shape.addSheet(30, 72, [&](double r, double t) { return ring(0.02 + 0.98 * r, -t, 0); });
    known.shape.addSheet(30, 72, [&](double h, double t) { return ring(1, -t, h * depth); });
    known.truth = [depth](const SeenVertex& v) -> std::optional<Truth>
    {
        const double out2 = v.position.x * v.position.x + v.position.z * v.position.z;
        // at the foot of the wall the slope is infinite, which triangles cannot follow
        if (v.position.y > 1e-4 || out2 > 0.97 * 0.97)
            return std::nullopt;
        // form factor of an opening of radius 1: a disc that faces a parallel element
        const double sum = out2 + depth * depth + 1;
        Truth truth{.ao = 0.5 * (1 - (sum - 2) / std::sqrt(sum * sum - 4 * out2))};
        if (out2 < 0.03 * 0.03)
            truth.axis = Double3{0, 1, 0};
        return truth;
    };
    return known;
}

/// A floor below a sphere of radius 1. The sphere is a polyhedron whose cross-section, seen from below, is as
/// large on average as the sphere's.
KnownShape sphere()
{
    constexpr double kHeight = 1.2;
    constexpr int kRings = 40, kSectors = 80;
    KnownShape known{.name = "sphere"};
    known.shape.addGrid({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 60, 60);
    const double sector = 2 * kPi / kSectors, radius = std::sqrt(sector / std::sin(sector));
    known.shape.addSheet(kRings, kSectors,
                         [&](double s, double t)
                         {
                             const double angle = kPi * (0.005 + 0.99 * s), r = radius * std::sin(angle);
                             return Float3{static_cast<float>(r * std::cos(-2 * kPi * t)),
                                           static_cast<float>(kHeight + radius * std::cos(angle)),
                                           static_cast<float>(r * std::sin(-2 * kPi * t))};
                         });
    known.truth = [](const SeenVertex& v) -> std::optional<Truth>
    {
        if (v.position.y > 1e-4)
            return std::nullopt;
        const Double3 to{-double{v.position.x}, kHeight, -double{v.position.z}};
        const double share = 1 / dot(to, to); // sine squared of the half-angle
        const Double3 m1 = (Double3{0, 1, 0} - normalize(to) * share) * kPi;
        return Truth{.ao = m1.y / kPi, .m0 = 2 * kPi * std::sqrt(1 - share), .m1 = m1, .axis = m1};
    };
    return known;
}

/// A floor below a ceiling whose occlusion fades with distance.
KnownShape ceiling(int power)
{
    constexpr double kCeiling = 1, kDistance = 2.5, k = kCeiling / kDistance;
    KnownShape known{.name = "ceilingOfPower" + std::to_string(power)};
    known.shape.addGrid({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 32, 32);
    known.shape.addGrid({-4, kCeiling, 4}, {0, 0, -8}, {8, 0, 0}, 32, 32);
    if (power == 0)
        known.max_axis_error = 2; // a sixth of the sky is visible, and ends abruptly
    known.flags = {"--visibility-distance", "2.5", "--visibility-power", std::to_string(power)};
    const double m0[] = {k, k * (1 - std::log(k)), 2 * k - k * k};
    const double m1[] = {k * k, 2 * k - k * k, 2 * k * k * (0.5 - std::log(k))};
    const Truth truth{.ao = m1[power],
                      .m0 = 2 * kPi * m0[power],
                      .m1 = Double3{0, kPi * m1[power], 0},
                      .axis = Double3{0, 1, 0}};
    known.truth = [truth](const SeenVertex& v)
    {
        const bool inside =
            v.position.y < 0.5 && std::abs(v.position.x) < 1.4 && std::abs(v.position.z) < 1.4;
        return inside ? std::optional(truth) : std::nullopt;
    };
    return known;
}

/// Mean of the directions in which a point of the bowl sees the sky, through the disc that closes the bowl
/// (radius sin 60 degrees, half a radius above the centre). Summed over the disc.
Double3 meanThroughOpening(Double3 point)
{
    constexpr int kRings = 40, kTurns = 80;
    const double radius = std::sin(2 * kPi / 3);
    Double3 sum;
    for (int r = 0; r < kRings; ++r)
        for (int t = 0; t < kTurns; ++t)
        {
            const double rho = radius * (r + 0.5) / kRings, turn = 2 * kPi * (t + 0.5) / kTurns;
            const Double3 to = Double3{rho * std::cos(turn), 0.5, rho * std::sin(turn)} - point;
            const double length2 = dot(to, to);
            // weight: cosine at the disc over the distance squared; and the direction
            sum += to * (rho * to.y / (length2 * length2));
        }
    return sum;
}

/// A cap of 120 degrees of the unit sphere, cut off where triangles would be slivers; the hole is closed.
KnownShape bowl()
{
    KnownShape known{.name = "bowl"};
    known.shape.addSheet(48, 96,
                         [](double s, double t)
                         {
                             const double angle = 0.02 + (2 * kPi / 3 - 0.02) * s, turn = -2 * kPi * t;
                             return Float3{static_cast<float>(std::sin(angle) * std::cos(turn)),
                                           static_cast<float>(-std::cos(angle)),
                                           static_cast<float>(std::sin(angle) * std::sin(turn))};
                         });
    known.truth = [](const SeenVertex& v) -> std::optional<Truth>
    {
        // 1 - A / (4 pi R^2), A = 2 pi R^2 (1 - cos 120 degrees)
        Truth truth{.ao = 0.25};
        if (v.position.y < 0.2f)
            truth.axis = meanThroughOpening(Double3(v.position));
        return truth;
    };
    return known;
}

/// The bowl with normals of 8 bits a component, as rough surfaces have them.
KnownShape coarseBowl()
{
    KnownShape known = bowl();
    known.name = "bowlWithNormalsOf8Bits";
    known.flags = {"--set", "clusters.normal_bits=8"};
    return known;
}

/// Errors over the vertices that have a closed form.
struct Errors
{
    size_t count = 0, axes = 0;
    double ao = 0, m1 = 0, ratio = 0, axis = 0; ///< rms; the axis: mean, degrees
    double bias = 0;                            ///< largest mean error of ambient occlusion over a plane
};

Errors measure(const std::vector<SeenVertex>& vertices, const KnownShape& known)
{
    Errors errors;
    std::vector<std::pair<double, double>> planes; // sum of errors, vertices
    for (const SeenVertex& v : vertices)
    {
        const std::optional<Truth> truth = known.truth(v);
        if (!truth)
            continue;
        ++errors.count;
        const double error = double{v.ao} - truth->ao;
        errors.ao += error * error;
        if (truth->m0)
        {
            const double size = length(*truth->m1), baked_size = double{length(v.m1)};
            errors.m1 += std::pow((baked_size - size) / kPi, 2);
            errors.ratio += std::pow(baked_size / double{v.m0} - size / *truth->m0, 2);
        }
        if (truth->axis)
        {
            ++errors.axes;
            errors.axis += std::acos(std::clamp(dot(Double3(v.axis), normalize(*truth->axis)), -1.0, 1.0));
        }
        planes.resize(std::max(planes.size(), truth->plane + 1));
        planes[truth->plane].first += error;
        planes[truth->plane].second += 1;
    }
    const auto count = static_cast<double>(std::max<size_t>(errors.count, 1));
    for (double* sum : {&errors.ao, &errors.m1, &errors.ratio})
        *sum = std::sqrt(*sum / count);
    errors.axis *= 180 / kPi / static_cast<double>(std::max<size_t>(errors.axes, 1));
    for (const auto& [sum, vertices_of_plane] : planes)
        if (vertices_of_plane > 0)
            errors.bias = std::max(errors.bias, std::abs(sum / vertices_of_plane));
    return errors;
}

void expectClosedForm(const KnownShape& known)
{
    for (const bool high : {false, true})
    {
        SCOPED_TRACE(known.name + (high ? " at high" : " at default"));
        std::vector<std::string> flags = known.flags;
        if (high)
            flags.insert(flags.end(), kAtHigh.begin(), kAtHigh.end());
        Sandbox sandbox;
        const Errors errors = measure(bakeShape(sandbox, known.shape, flags), known);
        std::printf("%-24s %-8s %5zu vertices: ao %.4f, its mean %.4f, m1 %.4f, m1/m0 %.4f, axis %.2f\n",
                    known.name.c_str(), high ? "high" : "default", errors.count, errors.ao, errors.bias,
                    errors.m1, errors.ratio, errors.axis);
        EXPECT_GT(errors.count, 100u);
        if (!high)
        {
            EXPECT_LT(errors.ao, kMaxError);
            EXPECT_LT(errors.axis, known.max_axis_error);
            continue;
        }
        EXPECT_LT(errors.axis, kMaxAxisError);
        EXPECT_LT(errors.ao, known.max_bias > 0 ? kMaxErrorOfPlanesAtHigh : kMaxErrorAtHigh);
        if (known.max_bias > 0)
        {
            EXPECT_LT(errors.bias, known.max_bias);
        }
        EXPECT_LT(errors.m1, kMaxM1Error);
        EXPECT_LT(errors.ratio, kMaxRatioError);
    }
}

struct ProxyBake
{
    Errors errors;
    double fitted_vertices = 0;
};

/// Bake at high quality, with the proxy of the shape.
/// use          of --visibility-proxies
/// proxy_flags  that say which proxy it has
ProxyBake bakeOnProxy(const KnownShape& known, const std::string& use,
                      const std::vector<std::string>& proxy_flags)
{
    std::vector<std::string> flags = known.flags;
    flags.insert(flags.end(), kAtHigh.begin(), kAtHigh.end());
    flags.insert(flags.end(), proxy_flags.begin(), proxy_flags.end());
    flags.insert(flags.end(),
                 {"--proxy-from", "clean", "--visibility-proxies", use, "--report", "report.json"});
    Sandbox sandbox;
    const Errors errors = measure(bakeShape(sandbox, known.shape, flags), known);
    const auto report = Json::parse(sandbox.read("report.json")).value();
    const auto& mesh = report["assets"][0]["visibility"]["meshes"][0];
    EXPECT_EQ(mesh["proxy"], use);
    const ProxyBake baked{errors, mesh["vertices"].get<double>()};
    std::printf("%-24s %-4s %-17s %5.0f of %5zu vertices: ao %.4f, its mean %.4f, m1 %.4f, m1/m0 %.4f, axis "
                "%.2f\n",
                known.name.c_str(), use.c_str(), proxy_flags.front().c_str(), baked.fitted_vertices,
                known.shape.positions.size(), errors.ao, errors.bias, errors.m1, errors.ratio, errors.axis);
    return baked;
}

std::string getName(const testing::TestParamInfo<KnownShape>& info)
{
    return info.param.name;
}

class OcclusionForms : public testing::TestWithParam<KnownShape>
{
};

class OcclusionOnProxies : public testing::TestWithParam<KnownShape>
{
};

std::vector<KnownShape> knownShapes()
{
    std::vector<KnownShape> shapes{pit(0.5),   pit(2),     sphere(), ceiling(0),
                                   ceiling(1), ceiling(2), bowl(),   coarseBowl()};
    for (const PanelScene& scene : panelScenes())
    {
        shapes.push_back(scene.rotated({}, ""));
        shapes.push_back(scene.rotated(randomRotation(1), "Rotated"));
    }
    return shapes;
}

} // namespace

TEST_P(OcclusionForms, areHeld)
{
    expectClosedForm(GetParam());
}
INSTANTIATE_TEST_SUITE_P(All, OcclusionForms, testing::ValuesIn(knownShapes()), getName);

// At high quality, on a proxy that is the whole mesh, cleaned.
TEST_P(OcclusionOnProxies, isThatOfTheMeshWhereTheProxyIsTheMesh)
{
    const ProxyBake baked = bakeOnProxy(GetParam(), "fit", {"--proxy-error", "0"});
    EXPECT_GT(baked.errors.count, 100u);
    EXPECT_LT(baked.errors.ao, GetParam().max_bias > 0 ? kMaxErrorOfPlanesAtHigh : kMaxErrorAtHigh);
}

// The same on a proxy with a fifth of the vertices, which also occludes.
TEST_P(OcclusionOnProxies, isNearlyThatOfTheMeshOnAFifthOfItsVertices)
{
    const std::string triangles = std::to_string(GetParam().shape.triangles.size() / 6);
    for (const std::string use : {"fit", "all"})
    {
        const ProxyBake baked = bakeOnProxy(GetParam(), use, {"--proxy-triangles", triangles});
        EXPECT_LT(baked.fitted_vertices, 0.2 * static_cast<double>(GetParam().shape.positions.size()));
        EXPECT_GT(baked.errors.count, 100u);
        EXPECT_LT(baked.errors.ao, kMaxErrorOnAFifth) << use;
    }
}
INSTANTIATE_TEST_SUITE_P(All, OcclusionOnProxies,
                         testing::Values(pit(2), sphere(), ceiling(1), coarseBowl(),
                                         groove(60).rotated({}, ""),
                                         funnel().rotated(randomRotation(1), "Rotated")),
                         getName);

TEST(OcclusionOfPlanes, isNoneWhereNothingIsInTheWay)
{
    for (const uint32_t seed : {0u, 1u, 2u, 3u})
    {
        const Rotation rotation = seed == 0 ? Rotation{} : randomRotation(seed);
        PanelScene plane{
            "plane", {makePanel({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 10, 10)}, [](Double3) { return true; }};
        Sandbox sandbox;
        const auto vertices = bakeShape(sandbox, plane.rotated(rotation, "").shape, {});
        EXPECT_GE(vertices.size(), 121u);
        for (const SeenVertex& vertex : vertices)
        {
            EXPECT_EQ(vertex.ao, 1.0f);
            EXPECT_NEAR(vertex.aperture, kPi / 2, 1e-6);
            EXPECT_NEAR(vertex.scale, 1, 1e-6);
        }
    }
}

TEST(OcclusionOfPlanes, isAQuarterInACornerOfThree)
{
    Sandbox sandbox;
    size_t corners = 0;
    for (const SeenVertex& vertex : bakeShape(sandbox, room().rotated({}, "").shape, kAtHigh))
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

} // namespace hearth::test
