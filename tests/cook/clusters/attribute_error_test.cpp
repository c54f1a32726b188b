// Tests errors of normals and UVs: the stored error matches what a cut shows, and weights decide how much it
// counts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/attribute_error.h"
#include "cook/clusters/error/group_errors.h"
#include "cook/clusters/levels/validate.h"
#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace
{

using namespace hearth;
using clusters::Config;
using clusters::Hierarchy;
using formats::GroupRecord;
using mesh::SourceMesh;

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// Attributes of a sheet over the unit square, as functions of position.
struct Sheet
{
    std::function<float(Float2)> height = [](Float2) { return 0.0f; };
    std::function<Float3(Float2)> normal = [](Float2) { return Float3{0, 0, 1}; };
    std::function<Float2(Float2)> uv = [](Float2 p) { return p; };

    SourceMesh mesh(uint32_t n) const
    {
        SourceMesh mesh = shapes::grid(n);
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
        {
            const Float2 place{mesh.positions[v].x, mesh.positions[v].y};
            mesh.positions[v].z = height(place);
            mesh.normals[v] = normal(place);
            mesh.uvs[0][v] = uv(place);
        }
        return mesh;
    }
};

Sheet withStretchedUvs()
{
    Sheet sheet;
    sheet.uv = [](Float2 p) {
        return Float2{p.x + 0.02f * std::sin(2 * kTurn * p.x) * std::cos(kTurn * p.y), p.y};
    };
    return sheet;
}

/// Sheet whose normals have waves; its positions have them only if `bent`.
Sheet withWaves(bool bent)
{
    constexpr float kHeight = 0.01f;
    Sheet sheet;
    if (bent)
        sheet.height = [](Float2 p)
        { return kHeight * std::sin(3 * kTurn * p.x) * std::sin(2 * kTurn * p.y); };
    sheet.normal = [](Float2 p)
    {
        const float dx = 3 * kTurn * kHeight * std::cos(3 * kTurn * p.x) * std::sin(2 * kTurn * p.y);
        const float dy = 2 * kTurn * kHeight * std::sin(3 * kTurn * p.x) * std::cos(2 * kTurn * p.y);
        return normalizeOr({-dx, -dy, 1}, {});
    };
    return sheet;
}

/// Area-weighted root mean squares of a level's attribute errors: as stored, and measured against the sheet's
/// functions.
struct Rms
{
    double stored_normal = 0, normal = 0;
    double stored_uv = 0, uv = 0;
};

Rms measure(const Sheet& sheet, const Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded,
            uint32_t level)
{
    constexpr int kSteps = 6;
    Rms rms;
    double area = 0;
    const auto replaced = cuts::cutAtError(hierarchy, hierarchy.levels[level].max_error);
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
    {
        const formats::ClusterRecord& cluster = hierarchy.clusters[c];
        const auto geometry =
            formats::ClusterGeometry::at(decoded.pages[cluster.page], cluster, hierarchy.mesh);
        const GroupRecord group =
            cluster.refined_group == kInvalidIndex ? GroupRecord{} : hierarchy.groups[cluster.refined_group];
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
        {
            const auto corners = geometry->triangle(t);
            const Float3 a = geometry->position(corners[0]);
            const double own{
                length(cross(geometry->position(corners[1]) - a, geometry->position(corners[2]) - a))};
            area += own;
            rms.stored_normal += own * double{group.normal_error} * double{group.normal_error};
            rms.stored_uv += own * double{group.uv_error} * double{group.uv_error};
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps - i; ++j)
                {
                    const float v = (static_cast<float>(i) + 1.0f / 3) / kSteps;
                    const float w = (static_cast<float>(j) + 1.0f / 3) / kSteps;
                    const auto at = [&](auto value) {
                        return value(corners[0]) * (1 - v - w) + value(corners[1]) * v +
                               value(corners[2]) * w;
                    };
                    const Float3 place = at([&](uint32_t k) { return geometry->position(k); });
                    const Float3 normal = at([&](uint32_t k) { return geometry->normal(k); });
                    const Float2 uv =
                        at([&](uint32_t k) { return geometry->uv(k, 0); }) - sheet.uv({place.x, place.y});
                    const Float3 right = sheet.normal({place.x, place.y});
                    const double angle =
                        std::atan2(double{length(cross(normal, right))}, double{dot(normal, right)});
                    const double part = own / (kSteps * (kSteps + 1) / 2);
                    rms.normal += part * angle * angle;
                    rms.uv += part * (double{uv.x} * double{uv.x} + double{uv.y} * double{uv.y});
                }
        }
    }
    const auto root = [&](double sum) { return std::sqrt(sum / area); };
    return {root(rms.stored_normal), root(rms.normal), root(rms.stored_uv), root(rms.uv)};
}

struct Built
{
    Hierarchy hierarchy;
    clusters::DecodedHierarchy decoded;
};

const Config kUsual;

Built build(const SourceMesh& mesh, const Config& config = kUsual)
{
    Built built{clusters::buildHierarchy(mesh, config), {}};
    const Status valid = clusters::validateHierarchy(mesh, built.hierarchy);
    EXPECT_TRUE(valid.ok()) << formatMessage(valid.error());
    auto decoded = clusters::decodeHierarchy(built.hierarchy);
    EXPECT_TRUE(decoded.ok());
    built.decoded = std::move(*decoded);
    return built;
}

/// Return the maximum of a value over all groups but the roots.
float largest(const Hierarchy& hierarchy, float GroupRecord::*value)
{
    float most = 0;
    for (const GroupRecord& group : hierarchy.groups)
        if (std::isfinite(group.error))
            most = std::max(most, group.*value);
    return most;
}

/// Return a config with 16-bit normals, so that quantization does not blur the measurement, and the given cut
/// weights.
Config configWith(float normal_error_weight, float uv_error_weight)
{
    Config config = kUsual;
    config.normal_bits = 16;
    config.normal_error_weight = normal_error_weight;
    config.uv_error_weight = uv_error_weight;
    return config;
}

TEST(AngleOfChord, isTheAngleBetweenUnitVectors)
{
    for (const double angle : {0.0, 1e-9, 1e-3, 0.1, 1.0, 2.0, 3.0, std::numbers::pi})
        EXPECT_NEAR(clusters::angleFromChord(2 * std::sin(angle / 2)), angle, 1e-5 * angle) << angle;
    EXPECT_NEAR(clusters::angleFromChord(2.1), std::numbers::pi, 1e-4)
        << "rounding does not leave the numbers";
}

TEST(GroupErrors, addSquaresOfAttributesOverTheTriangles)
{
    clusters::ErrorAccumulator below(0.001f);
    below.add({2, 1, {0.3f, 0.03f}}, 30);
    below.add({3, 0.5f, {0.0f, 0.04f}}, 10);
    const clusters::GroupErrors errors =
        below.errorsOfReplacement({1.5f, {{0.4f, 0.05f}, 0.5f}, 1}, configWith(0, 0));
    EXPECT_NEAR(errors.attributes.normal, std::sqrt(0.09 * 3 / 4 + 0.16), 1e-6);
    EXPECT_NEAR(errors.attributes.uv, std::sqrt(9e-4 * 3 / 4 + 16e-4 / 4 + 25e-4), 1e-6);
    EXPECT_NEAR(errors.position, 1.5f, 1e-4);
    EXPECT_NEAR(errors.lod, 3, 1e-4) << "no error falls";

    const clusters::GroupErrors same = below.errorsOfReplacement({}, configWith(9, 9));
    EXPECT_EQ(same.attributes.normal, 0.3f) << "nor does a part";
    EXPECT_EQ(same.attributes.uv, 0.04f);
    EXPECT_NEAR(same.position, 1, 1e-4);

    const clusters::GroupErrors authored =
        below.errorsAgainstSource({1.5f, {{0.4f, 0.05f}, 0.5f}, 1}, configWith(0, 0));
    EXPECT_EQ(authored.attributes.normal, 0.4f);
    EXPECT_EQ(authored.attributes.uv, 0.05f);
}

TEST(GroupErrors, weighTheirParts)
{
    const clusters::ErrorAccumulator source(0.001f);
    const clusters::Replacement replacement{1.5f, {{0.4f, 0.05f}, 0.5f}, 1};
    const auto lod = [&](float normal_error_weight, float uv_error_weight, float weight)
    {
        clusters::Replacement weighted = replacement;
        weighted.weight = weight;
        return source.errorsOfReplacement(weighted, configWith(normal_error_weight, uv_error_weight)).lod;
    };
    EXPECT_NEAR(lod(1, 1, 1), 1.5f, 1e-4) << "the largest counts";
    EXPECT_NEAR(lod(1, 100, 1), 5, 1e-4);
    EXPECT_NEAR(lod(100, 1, 1), 100 * 0.4f * 0.5f / kTurn, 1e-4);
    EXPECT_NEAR(lod(1, 100, 3), 15, 1e-3);
}

TEST(AttributeErrors, areNothingWhereNothingIsLost)
{
    // corners of charts may still differ: their error depends on ties, which are frequent on a sheet of
    // squares
    std::vector<float> where_corners_go;
    for (const uint32_t n : {56u, 60u, 64u, 68u, 72u})
    {
        const Built built = build(shapes::grid(n));
        ASSERT_GT(built.hierarchy.levels.size(), 3u);
        EXPECT_LT(largest(built.hierarchy, &GroupRecord::normal_error), 1e-5f);
        where_corners_go.push_back(largest(built.hierarchy, &GroupRecord::uv_error));
    }
    std::sort(where_corners_go.begin(), where_corners_go.end());
    EXPECT_LT(where_corners_go[where_corners_go.size() / 2], 6e-4f);
    EXPECT_LT(where_corners_go.back(), 3e-3f);
}

TEST(AttributeErrors, ofStretchedUvsAreWhatACutShows)
{
    const Sheet sheet = withStretchedUvs();
    // with weight 0 the flat sheet has no error at all, and groups simplify without limit
    const Built built = build(sheet.mesh(96), configWith(0, 1));
    EXPECT_LT(largest(built.hierarchy, &GroupRecord::position_error), 1e-3f) << "but where corners go";
    EXPECT_LT(largest(built.hierarchy, &GroupRecord::normal_error), 1e-5f);
    // from level 1 on, quantization of UVs adds error
    for (const uint32_t level : {2u, 3u, 5u})
    {
        const Rms rms = measure(sheet, built.hierarchy, built.decoded, level);
        EXPECT_GT(rms.uv, 1e-5);
        EXPECT_GT(rms.stored_uv, 0.85 * rms.uv) << "level " << level;
        // each level is fitted to the one below, and so recovers a part of that level's error
        EXPECT_LT(rms.stored_uv, 1.35 * rms.uv) << "level " << level;
    }
}

TEST(AttributeErrors, ofABentSheetAreWhatACutShows)
{
    const Sheet sheet = withWaves(true);
    const Built built = build(sheet.mesh(96), configWith(0, 0));
    // on lower levels, the source's own triangles are as far from the sheet
    for (const uint32_t level : {3u, 4u, 5u})
    {
        const Rms rms = measure(sheet, built.hierarchy, built.decoded, level);
        EXPECT_GT(rms.normal, 1e-3);
        EXPECT_GT(rms.stored_normal, 0.85 * rms.normal) << "level " << level;
        EXPECT_LT(rms.stored_normal, 1.15 * rms.normal) << "level " << level;
    }
}

TEST(AttributeErrors, doNotTakeOneSideOfASeamForTheOther)
{
    // six charts, each a unit square over a face of a cube of size about 2: a UV unit is about two long
    const Built built = build(shapes::rock(40, 0));
    for (const formats::ClusterRecord& cluster : built.hierarchy.clusters)
    {
        if (cluster.level != 1)
            continue;
        EXPECT_LT(built.hierarchy.groups[cluster.refined_group].uv_error, 0.01f);
    }
}

TEST(AttributeErrors, areNumbersWhateverTheUvs)
{
    for (const float most : {1e-30f, 1e20f, 3e38f})
    {
        // two islands that groups merge; UVs on a line say nothing of their length
        SourceMesh mesh = withStretchedUvs().mesh(40);
        SourceMesh other = shapes::grid(40);
        for (size_t v = 0; v < other.vertexCount(); ++v)
        {
            other.positions[v].x += 1.1f;
            other.uvs[0][v] = {v % 2 == 0 ? most : -most, 0};
        }
        shapes::append(mesh, other);
        const Built built = build(mesh);
        for (const GroupRecord& group : built.hierarchy.groups)
        {
            const float limit = std::isinf(group.error) ? 0.0f : 1e7f;
            EXPECT_TRUE(group.uv_error <= limit && group.normal_error <= limit) << most;
        }
    }
}

TEST(AttributeErrors, countForTheCutAsTheWeightsSay)
{
    const SourceMesh mesh = withStretchedUvs().mesh(64);
    const Built unweighted = build(mesh, configWith(0, 0));
    const Built weighted = build(mesh, configWith(0, 3));
    ASSERT_EQ(unweighted.hierarchy.groups.size(), weighted.hierarchy.groups.size());
    for (size_t g = 0; g < unweighted.hierarchy.groups.size(); ++g)
    {
        const GroupRecord& without = unweighted.hierarchy.groups[g];
        const GroupRecord& with = weighted.hierarchy.groups[g];
        if (std::isinf(without.error))
            continue;
        EXPECT_EQ(without.error, without.position_error);
        EXPECT_EQ(with.position_error, without.position_error);
        EXPECT_EQ(with.uv_error, without.uv_error);
        EXPECT_GE(with.error, 2.99f * with.uv_error);
    }
}

TEST(AttributeErrors, ofNormalsCountAsWavesOfTheTrianglesLength)
{
    const SourceMesh flat = withWaves(false).mesh(64);
    const auto lastLevel = [&](float weight)
    {
        const Built built = build(flat, configWith(weight, 0));
        EXPECT_LT(largest(built.hierarchy, &GroupRecord::position_error), 1e-3f);
        const formats::ClusterRecord& cluster = built.hierarchy.clusters.front();
        return built.hierarchy.groups[cluster.refined_group];
    };
    const GroupRecord unweighted = lastLevel(0), weighted = lastLevel(10);
    EXPECT_EQ(unweighted.error, unweighted.position_error);
    EXPECT_EQ(weighted.normal_error, unweighted.normal_error);
    // edges of 128 triangles in a unit square are about 1/8 long
    EXPECT_GT(weighted.error, 10 * weighted.normal_error * 0.08f / kTurn);
    EXPECT_LT(weighted.error, 10 * weighted.normal_error * 0.25f / kTurn);
    EXPECT_NEAR(lastLevel(20).error, 2 * weighted.error, 1e-3f * weighted.error);
}

TEST(AttributeErrors, ofAnAuthoredLevelAreAgainstTheSource)
{
    const SourceMesh source = shapes::grid(64);
    Sheet sheet;
    sheet.uv = [](Float2 p) { return Float2{p.x + 0.03f, p.y - 0.04f}; };
    sheet.normal = [](Float2) { return Float3{0.6f, 0, 0.8f}; };
    const std::vector<SourceMesh> authored{sheet.mesh(32)};
    const Hierarchy hierarchy = clusters::buildHierarchy(source, authored, configWith(0, 1));
    ASSERT_NE(hierarchy.authored_levels[0], kInvalidIndex);
    const Status valid = clusters::validateHierarchy(source, hierarchy, authored);
    EXPECT_TRUE(valid.ok()) << formatMessage(valid.error());
    for (const formats::ClusterRecord& cluster : hierarchy.clusters)
    {
        if (cluster.level != hierarchy.authored_levels[0])
            continue;
        const GroupRecord& group = hierarchy.groups[cluster.refined_group];
        EXPECT_NEAR(group.uv_error, 0.05f, 1e-3f);
        EXPECT_NEAR(group.normal_error, std::acos(0.8f), 1e-3f);
        EXPECT_LT(group.position_error, 1e-5f);
        EXPECT_NEAR(group.error, 0.05f, 1e-3f);
    }
}

} // namespace
