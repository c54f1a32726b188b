// Measures how many triangles a pixel the cut of rough rocks draws, how many of them each part of the rule
// costs, and how far the image is from that of all triangles. Draws in software: needs no graphics device.
// `./dev bench cuts` runs it. Fails if a cut needs more triangles for an equal image than the aim.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "sample_assets/rock.h"
#include "tests/bench/aims.h"
#include "tests/bench/cut_figures.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

namespace
{

using namespace hearth;
using bench::CutDistance;
using bench::CutError;
using bench::CutFacing;
using bench::CutFigures;
using bench::CutRule;
using bench::CutScene;
using bench::ViewMeter;

// Rocks of 500 thousand triangles have as many a pixel at this width as the field of `./dev bench runtime`,
// with 2 million, at twice the width.
constexpr uint32_t kWidth = 640;
constexpr uint32_t kHeight = 360;
constexpr uint32_t kRockCount = 12;

struct Arguments
{
    uint32_t seed = 21;
    uint32_t shapes = 2;
    uint64_t triangles = 500'000;
    std::string images;
};

float randomUnit(uint32_t index, uint32_t seed)
{
    uint32_t x = index * 0x9E3779B9u + seed * 0x85EBCA6Bu;
    x = (x ^ x >> 16) * 0x7FEB352Du;
    x = (x ^ x >> 15) * 0x846CA68Bu;
    return static_cast<float>((x ^ x >> 16) >> 8) * 0x1p-24f;
}

/// Place a rock left or right of the view, larger ones farther away, as the field does.
Affine3 placeRock(uint32_t index)
{
    const auto random = [&](uint32_t which) { return randomUnit(index * 8 + which, 811); };
    const float along = (static_cast<float>(index) + 0.5f) / kRockCount;
    const float scale = (1.2f + 1.4f * random(0)) * (1 + 2.2f * along);
    const float side = index % 2 != 0 ? 1.0f : -1.0f;
    const float angle = random(3) * 6.2831853f, flat = 0.75f + 0.35f * random(2);
    const float c = std::cos(angle) * scale, s = std::sin(angle) * scale;
    Affine3 placed;
    placed.m[0][0] = c;
    placed.m[0][2] = s;
    placed.m[1][1] = scale * flat;
    placed.m[2][0] = -s;
    placed.m[2][2] = c;
    placed.m[0][3] = side * (scale + 1.5f + (4 + 40 * along) * random(1));
    placed.m[1][3] = 0.2f * scale;
    placed.m[2][3] = -8 - 100 * along;
    return placed;
}

std::vector<shared::FrameView> makeViews()
{
    constexpr Float3 kEyes[] = {{0, 3.2f, 0}, {2, 2, -4}, {-14, 9, -20}};
    constexpr Float3 kTargets[] = {{0, 1.2f, -10}, {-4, 1, -14}, {0, 1, -40}};
    std::vector<shared::FrameView> views;
    for (size_t i = 0; i < std::size(kEyes); ++i)
        views.push_back(shared::makeFrameView({.position = kEyes[i], .target = kTargets[i]}, kWidth, kHeight,
                                              1, kRockCount));
    return views;
}

mesh::SourceMesh makeSource(uint64_t triangles, uint32_t seed)
{
    samples::TriangleMesh rock = samples::makeRock(triangles, seed, 3.0f);
    mesh::SourceMesh source;
    source.name = "rock_" + std::to_string(seed);
    source.positions = std::move(rock.positions);
    source.normals = std::move(rock.normals);
    source.uvs[0] = std::move(rock.uvs);
    source.indices = std::move(rock.indices);
    source.triangle_materials.assign(source.triangleCount(), kInvalidIndex);
    source.face_count = static_cast<uint32_t>(source.triangleCount());
    return source;
}

/// Measure all views. images  beginning of the names of files to write; empty: none
Result<CutFigures> measureViews(std::span<const ViewMeter> meters, const CutRule& rule,
                                const std::string& images = {})
{
    CutFigures all;
    for (size_t i = 0; i < meters.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const CutFigures view,
                                meters[i].measure(rule, images.empty() ? "" : images + std::to_string(i)));
        all.add(view);
    }
    return all;
}

/// Triangles a pixel and FLIP of the product's rule, from fine to coarse.
struct CurvePoint
{
    double flip = 0; ///< mean over the covered pixels
    double triangles = 0;
};

/// Interpolate the triangles a pixel that the product's rule needs for a FLIP; nothing beyond the curve.
std::optional<double> trianglesForFlip(std::span<const CurvePoint> curve, double flip)
{
    for (size_t i = 1; i < curve.size(); ++i)
        if (curve[i - 1].flip <= flip && flip <= curve[i].flip)
        {
            const double along = (flip - curve[i - 1].flip) / (curve[i].flip - curve[i - 1].flip);
            return curve[i - 1].triangles * std::pow(curve[i].triangles / curve[i - 1].triangles, along);
        }
    return std::nullopt;
}

/// Print triangles a pixel and FLIP over the threshold, and return them.
Result<std::vector<CurvePoint>> printThresholds(std::span<const ViewMeter> meters)
{
    std::printf("%-54s %10s %8s %8s\n", "Threshold, pixels", "tri/pixel", "FLIP", "4 samples");
    std::vector<CurvePoint> curve;
    for (const float threshold : {-1.0f, 0.5f, 0.7f, 1.0f, 1.4f, 2.0f, 2.8f, 4.0f})
    {
        HEARTH_ASSIGN_OR_RETURN(const CutFigures drawn, measureViews(meters, {.threshold = threshold}));
        std::printf("  %-52s %10.2f %8.4f %8.4f\n",
                    threshold < 0 ? "all triangles" : std::to_string(threshold).substr(0, 3).c_str(),
                    drawn.trianglesPerPixel(), drawn.flip / drawn.pixels, drawn.flip_four / drawn.pixels);
        curve.push_back({drawn.flip / drawn.pixels, drawn.trianglesPerPixel()});
    }
    std::printf("\n");
    return curve;
}

struct Cause
{
    const char* name;
    CutRule rule;
};

constexpr Cause kCauses[] = {
    {"error of the distance alone, without normals and UVs", {.error = CutError::position}},
    {"distance to the nearest vertex, not to the sphere", {.distance = CutDistance::nearest}},
    {"largest sampled error, not the stored bound", {.error = CutError::sampled}},
    {"mean sampled error (rms x 4), not the largest", {.error = CutError::rms}},
    {"a third of the error where a group faces away", {.facing = CutFacing::away}},
    {"error by the cosine between normal and view", {.facing = CutFacing::slant}},
    {"a threshold of two pixels", {.threshold = 2}},
};

/// Print rules with one part replaced by an ideal: the factor in triangles at the same threshold, and at the
/// same FLIP.
Status printCauses(std::span<const ViewMeter> meters, std::span<const CurvePoint> curve,
                   const CutFigures& product)
{
    std::printf("%-54s %10s %8s %8s %10s\n", "Another rule", "tri/pixel", "factor", "FLIP", "equal FLIP");
    for (const Cause& cause : kCauses)
    {
        HEARTH_ASSIGN_OR_RETURN(const CutFigures drawn, measureViews(meters, cause.rule));
        const double flip = drawn.flip / drawn.pixels;
        std::printf("  %-52s %10.2f %8.2f %8.4f", cause.name, drawn.trianglesPerPixel(),
                    product.trianglesPerPixel() / drawn.trianglesPerPixel(), flip);
        if (const std::optional<double> equal = trianglesForFlip(curve, flip))
            std::printf(" %10.2f\n", *equal / drawn.trianglesPerPixel());
        else
            std::printf(" %10s\n", "-");
    }
    return success();
}

/// Print what is left of the drawn triangles without those that change no pixel.
void printUnseen(const CutFigures& product, double share_alone)
{
    const auto print = [&](const char* name, double triangles) {
        std::printf("  %-52s %10.2f %8.2f\n", name, triangles / product.pixels,
                    product.triangles / triangles);
    };
    const double of_cluster = product.triangles / product.clusters;
    std::printf("%-54s %10s %8s\n", "The same image", "tri/pixel", "factor");
    print("as drawn, one pixel of error", product.triangles);
    print("without clusters whose triangles all face away", product.facing_clusters * of_cluster);
    print("without clusters behind the rectangle of their vertices", product.uncovered_clusters * of_cluster);
    print("without clusters that no pixel shows", product.seen_clusters * of_cluster);
    print("... and without their triangles that face away", product.facing_triangles);
    print("only triangles that a pixel shows", product.seen_triangles);
    std::printf("%-54s %10s %8.2f\n\n", "Clusters replaced alone, not by groups, sampled errors", "",
                1 / share_alone);
}

/// returns  exit code: 1 if the aim is missed
Result<int> measure(const Arguments& arguments)
{
    test::TestScene test;
    std::vector<mesh::SourceMesh> sources;
    for (uint32_t shape = 0; shape < arguments.shapes; ++shape)
    {
        sources.push_back(makeSource(arguments.triangles, arguments.seed + shape));
        test.addMesh(sources.back());
    }
    for (uint32_t rock = 0; rock < kRockCount; ++rock)
        test.addInstance(rock % arguments.shapes, placeRock(rock));
    const formats::PackView pack = test.build();
    HEARTH_ASSIGN_OR_RETURN(const CutScene scene, CutScene::read(pack, sources));
    const std::vector<shared::FrameView> views = makeViews();
    std::vector<ViewMeter> meters;
    double share_alone = 0;
    for (const shared::FrameView& view : views)
    {
        meters.emplace_back(scene, view);
        share_alone += bench::shareWithoutGroups(scene, view, {.error = CutError::sampled}) /
                       static_cast<double>(views.size());
    }
    HEARTH_ASSIGN_OR_RETURN(const CutFigures product, measureViews(meters, {}, arguments.images));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<CurvePoint> curve, printThresholds(meters));
    printUnseen(product, share_alone);
    HEARTH_TRY(printCauses(meters, curve, product));
    std::printf("\n");
    bench::Judgement judgement("cuts");
    judgement.record("triangles a pixel for a mean FLIP of 0.1",
                     trianglesForFlip(curve, 0.1).value_or(HUGE_VAL));
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures the triangles a pixel that cuts of rocks draw, and their images.");
    Arguments arguments;
    app.addOption("--seed", arguments.seed, "seed of the first rock");
    app.addOption("--shapes", arguments.shapes, "number of different rocks").range(1u, kRockCount);
    app.addOption("--triangles", arguments.triangles, "triangles of a rock");
    app.addOption("--images", arguments.images, "beginning of the names of images to write");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(arguments);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_view_cuts", [&] { return program(argc, argv); });
}
