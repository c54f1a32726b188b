// Holds the receivers of a scene against paths through its real geometry, and the choice of lamps of
// their texels against all lamps. SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/receivers/bake/bake.h"
#include "cook/receivers/scene/receiver_scene.h"
#include "cook/tools/open_part.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"
#include "tests/bench/lights/receiver_rules.h"
#include "tests/reference/tracer/light_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <span>

namespace
{

using namespace hearth;
using namespace hearth::receivers;
using reference::Double3;

/// Metres by which a ray begins off a texel to find its surface in the reference.
constexpr double kLift = 1e-3;

struct Arguments
{
    std::string scene;
    double texels_per_metre = 16;
    uint32_t texels = 1000, paths = 4096, draws = 4;
};

Result<formats::PackView> openPack(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(path));
    return formats::PackView::read(std::move(reader));
}

/// Points of a texel along each side, at each of which the reference is asked: near a lamp its light
/// differs within a texel, whose own light is a mean.
constexpr uint32_t kSide = 4;

/// Return the point of a surface within a distance of a place, along a normal that is about its own.
std::optional<reference::ShadedPoint> findBeside(const reference::ShadedScene& scene, Double3 place,
                                                 Double3 normal, double distance)
{
    for (const double reach : {distance, kLift})
        if (const auto point = scene.nearest({place + normal * reach, -normal, 0, 2 * reach}, 0);
            point && dot(reference::litNormal(*point), normal) > 0.8)
            return point;
    return std::nullopt;
}

/// Return the surface points of the reference in a texel, by the world's axes along its plane. Those are
/// left out beside which there is no surface.
std::vector<reference::SeenPoint> findPoints(const BakedTexel& texel, const reference::ShadedScene& scene,
                                             double texels_per_metre)
{
    const Double3 normal(texel.normal), middle(texel.position);
    const Double3 axis = std::abs(normal.y) > 0.7 ? Double3{0, 0, 1} : Double3{0, 1, 0};
    const Double3 across = normalize(cross(axis, normal)), along = cross(normal, across);
    std::vector<reference::SeenPoint> points;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x)
        {
            const Double3 at = middle + across * (((x + 0.5) / kSide - 0.5) / texels_per_metre) +
                               along * (((y + 0.5) / kSide - 0.5) / texels_per_metre);
            if (const auto point = findBeside(scene, at, normal, 0.25 / texels_per_metre))
                points.push_back({*point, normal});
        }
    return points;
}

/// Sums over texels, of which each has the area of its surface as its weight.
struct PathErrors
{
    double squares = 0, truth_squares = 0, light = 0, truth = 0, weights = 0;
    size_t texels = 0;

    void add(Double3 found, const reference::LitPoint& expected, double weight)
    {
        const Double3 all = expected.truth.direct + expected.truth.indirect;
        // the noise of either half of the paths is independent of that of the other: its mean is no error
        const Double3 first = found - expected.truth.direct - expected.halves[0];
        const Double3 second = found - expected.truth.direct - expected.halves[1];
        squares += dot(first, second) * weight;
        truth_squares +=
            dot(expected.truth.direct + expected.halves[0], expected.truth.direct + expected.halves[1]) *
            weight;
        light += (found.x + found.y + found.z) * weight;
        truth += (all.x + all.y + all.z) * weight;
        weights += weight;
        ++texels;
    }
    double rms() const { return std::sqrt(std::max(squares, 0.0) / truth_squares); }
};

/// Return the mean light of a texel, by paths from its points.
reference::LitPoint traceTexel(std::span<const reference::LitPoint> points)
{
    reference::LitPoint mean = points[0];
    mean.truth = {};
    mean.halves[0] = mean.halves[1] = {};
    const double share = 1 / static_cast<double>(points.size());
    for (const reference::LitPoint& point : points)
    {
        mean.truth.direct = mean.truth.direct + point.truth.direct * share;
        mean.truth.indirect = mean.truth.indirect + point.truth.indirect * share;
        for (size_t half = 0; half < 2; ++half)
            mean.halves[half] = mean.halves[half] + point.halves[half] * share;
        mean.near_lamp |= point.near_lamp;
    }
    return mean;
}

void print(const char* texels, const PathErrors& errors)
{
    std::printf("  %-40s %5.1f %% rms of %zu, %5.1f %% of the mean, mean off by %+.1f %%\n", texels,
                100 * errors.rms(), errors.texels,
                100 * std::sqrt(3 * std::max(errors.squares, 0.0) * errors.weights) / errors.truth,
                100 * (errors.light / errors.truth - 1));
}

/// Compare the light of all lamps with paths, at texels that are chosen at random.
/// returns  root mean square of the errors, over that of the light
double compareWithPaths(const BakedReceivers& baked, const reference::ShadedScene& scene,
                        const Arguments& arguments)
{
    std::mt19937 random(1);
    std::uniform_int_distribution<size_t> choose(0, baked.texels.size() - 1);
    PathErrors all, away;
    while (all.texels < arguments.texels)
    {
        const size_t number = choose(random);
        const BakedTexel& texel = baked.texels[number];
        const auto points = findPoints(texel, scene, arguments.texels_per_metre);
        if (texel.is_copy || points.empty())
            continue;
        const reference::LitPoint truth =
            traceTexel(reference::litPoints(scene, points, arguments.paths / (kSide * kSide)));
        Float3 sum;
        for (const Float3& light : baked.light(number))
            sum += light;
        const Double3 found = Double3(sum) * (1 / std::numbers::pi);
        const double weight = static_cast<double>(points.size()) / (kSide * kSide);
        all.add(found, truth, weight);
        if (!truth.near_lamp)
            away.add(found, truth, weight);
    }
    std::printf("all lamps beside %u paths a texel\n", arguments.paths);
    print("texels farther than 0.15 m from lamps", away);
    print("all texels", all);
    return all.rms();
}

/// Return the atlas of a bake with all its lights as lamps, steady light first.
bench::LampAtlas makeAtlas(const BakeScene& scene, const BakedReceivers& baked, double texels_per_metre)
{
    bench::LampAtlas atlas{baked.width, baked.height, {}, {}, {}, {}, {}};
    const size_t lamps = baked.light_count;
    const auto kind = [](formats::ReceiverLampKind value) { return static_cast<uint32_t>(value); };
    atlas.lamps.push_back({kind(formats::ReceiverLampKind::steady), 0});
    for (uint32_t i = 0; i + 1 < lamps; ++i)
        atlas.lamps.push_back(
            i < scene.lamps.size()
                ? formats::ReceiverLampRecord{kind(formats::ReceiverLampKind::light), i}
                : formats::ReceiverLampRecord{kind(formats::ReceiverLampKind::mesh_light), i});
    for (uint32_t i = 0; i < baked.rectangles.size(); ++i)
        if (const InstanceRectangle& rectangle = baked.rectangles[i]; rectangle.size.width > 0)
            atlas.rects.push_back(
                {i, rectangle.place.x, rectangle.place.y, rectangle.size.width, rectangle.size.height, 0});
    atlas.valid.resize(size_t{atlas.width} * atlas.height);
    atlas.light.resize(atlas.valid.size() * lamps);
    std::vector<size_t> texels(atlas.valid.size(), SIZE_MAX);
    const auto are_neighbours = [&](size_t a, size_t b)
    {
        return length(baked.texels[a].position - baked.texels[b].position) < 2 / texels_per_metre &&
               dot(baked.texels[a].normal, baked.texels[b].normal) > 0.9f;
    };
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const BakedTexel& texel = baked.texels[i];
        const size_t cell = size_t{texel.y} * atlas.width + texel.x;
        atlas.valid[cell] = 1;
        std::ranges::rotate_copy(baked.light(i), baked.light(i).end() - 1, &atlas.light[cell * lamps]);
        if (texel.is_copy)
            continue;
        texels[cell] = i;
        for (const size_t other : {cell - 1, cell - atlas.width})
            if (other < texels.size() && texels[other] != SIZE_MAX && are_neighbours(texels[other], i))
                atlas.neighbours.push_back({static_cast<uint32_t>(other), static_cast<uint32_t>(cell)});
    }
    return atlas;
}

/// Light by which a speck exceeds each of its neighbours, over that of the brightest of them.
constexpr float kSpeck = 1.5f;

/// Light, over the mean of its lamp, below which a texel is no speck: nobody sees it.
constexpr float kSpeckLight = 0.02f;

/// Return the specks of a lamp: texels amid four others that are much brighter than each of them.
size_t countSpecks(const bench::LampAtlas& atlas, size_t lamp)
{
    const size_t lamps = atlas.lamps.size();
    const auto find = [&](size_t cell)
    {
        const Float3 light = atlas.light[cell * lamps + lamp];
        return std::max({light.x, light.y, light.z});
    };
    std::vector<uint8_t> neighbours(atlas.valid.size());
    std::vector<float> brightest(atlas.valid.size());
    for (const auto& [first, second] : atlas.neighbours)
        for (const auto& [cell, other] : {std::pair(first, second), std::pair(second, first)})
        {
            ++neighbours[cell];
            brightest[cell] = std::max(brightest[cell], find(other));
        }
    double sum = 0;
    for (size_t cell = 0; cell < atlas.valid.size(); ++cell)
        sum += atlas.valid[cell] != 0 ? double{find(cell)} : 0;
    const auto least =
        static_cast<float>(double{kSpeckLight} * sum / static_cast<double>(atlas.texelCount()));
    size_t specks = 0;
    for (size_t cell = 0; cell < atlas.valid.size(); ++cell)
        specks += neighbours[cell] == 4 && find(cell) > std::max(kSpeck * brightest[cell], least) ? 1 : 0;
    return specks;
}

/// returns  exit code: 1 if an aim is missed
Result<int> run(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(formats::PackView pack, openPack(arguments.scene + ".hearth"));
    HEARTH_ASSIGN_OR_RETURN(reference::PackGeometry geometry, reference::PackGeometry::decode(pack));
    HEARTH_ASSIGN_OR_RETURN(reference::TextureSet textures, reference::TextureSet::load(pack));
    const reference::ShadedScene shaded(geometry, textures, nullptr);
    HEARTH_ASSIGN_OR_RETURN(formats::PackView import, tools::openPart(arguments.scene + ".import.part"));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView clusters, tools::openPart(arguments.scene + ".clusters.part"));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView images, tools::openPart(arguments.scene + ".textures.part"));
    std::vector<bricks::SourceParts> sources;
    sources.push_back({std::move(import), std::move(clusters), std::move(images)});
    HEARTH_ASSIGN_OR_RETURN(const bricks::StaticScene scene, bricks::collectStaticScene(sources));
    HEARTH_ASSIGN_OR_RETURN(const ReceiverScene receiver_scene, makeReceiverScene(scene));

    const auto start = std::chrono::steady_clock::now();
    const BakedReceivers baked =
        bakeReceivers(receiver_scene.bake, {.texels_per_metre = arguments.texels_per_metre}).value();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const bench::LampAtlas atlas = makeAtlas(receiver_scene.bake, baked, arguments.texels_per_metre);
    std::printf("%zu texels, %zu lights with that of the sky, baked in %.1f s\n", atlas.texelCount(),
                baked.light_count, took.count());
    size_t specks = 0;
    for (size_t lamp = 0; lamp < atlas.lamps.size(); ++lamp)
    {
        const size_t found = countSpecks(atlas, lamp);
        std::printf("  lamp %zu: %zu specks\n", lamp, found);
        specks += found;
    }
    bench::Judgement judgement("receiver-scene");
    judgement.record("specks of all lamps", static_cast<double>(specks));
    const bench::RuleFigures chosen = bench::compareRules(atlas, bench::drawWeights(atlas, arguments.draws));
    judgement.record("rms of all on", chosen.all_on.rms());
    judgement.record("rms of random weights", chosen.random.rms());
    judgement.record("jump between neighbouring texels", std::max(chosen.all_on.jump, chosen.random.jump));
    judgement.record("records of 16 bytes a texel", chosen.bytes / 16);
    judgement.record("rms error of all lamps beside paths", compareWithPaths(baked, shaded, arguments));
    return judgement.finish();
}

int program(int argc, char** argv)
{
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    cli::CommandLine app(
        "Holds the receivers of a scene against paths, and the lamps of texels against all lamps.");
    Arguments arguments;
    app.addOption("SCENE", arguments.scene,
                  "PREFIX of PREFIX.hearth and its PREFIX.import.part, .clusters.part, .textures.part")
        .required();
    app.addOption("--texels-per-metre", arguments.texels_per_metre, "density");
    app.addOption("--texels", arguments.texels, "that are compared with paths");
    app.addOption("--paths", arguments.paths, "of each texel");
    app.addOption("--weights", arguments.draws, "draws of random weights");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> end = run(arguments);
    return end.ok() ? *end : reportFailure(end.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_receiver_scene", [&] { return program(argc, argv); });
}
