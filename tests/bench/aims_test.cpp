// Tests that a bench fails where it misses an aim: the judgement, and hearth_measure_runtime as a whole.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/aims.h"

#include "cook/json/json.h"
#include "formats/gpu_shared/records.h"
#include "formats/records/container.h"
#include "tests/reference/png_image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace hearth::test
{

namespace
{

using bench::Bound;
using bench::Judgement;

constexpr bench::Aim kTwo[] = {
    {"a", "cost", Bound::at_most, 2}, {"a", "gain", Bound::at_least, 3}, {"b", "cost", Bound::at_most, 1}};

TEST(Aims, haveNamesOfTheirOwn)
{
    std::set<std::pair<std::string_view, std::string_view>> names;
    for (const bench::Aim& aim : bench::kAims)
        EXPECT_TRUE(names.emplace(aim.bench, aim.figure).second) << aim.figure;
}

TEST(Judgement, isMetOnlyIfAllAimsOfTheBenchAre)
{
    const auto judge = [](double cost, double gain)
    {
        Judgement judgement("a", kTwo);
        judgement.record("cost", cost);
        judgement.record("gain", gain);
        return judgement.isMet();
    };
    EXPECT_TRUE(judge(2, 3)) << "the limits themselves are met";
    EXPECT_FALSE(judge(2.1, 3));
    EXPECT_FALSE(judge(2, 2.9));
    EXPECT_FALSE(judge(std::nan(""), 3));
    EXPECT_FALSE(judge(2, std::nan("")));
}

TEST(Judgement, countsTheWorstValueAndWhatIsMissing)
{
    Judgement judgement("a", kTwo);
    EXPECT_EQ(judgement.finish(), 1) << "nothing was measured";
    judgement.record("cost", 3);
    judgement.record("cost", 1);
    EXPECT_EQ(judgement.describe(), "aim: cost <= 2: 3, MISSED\naim: gain >= 3: NOT MEASURED\n");
    judgement.leaveOut("gain");
    EXPECT_EQ(judgement.describe(), "aim: cost <= 2: 3, MISSED\naim: gain >= 3: left out\n");
    EXPECT_EQ(judgement.finish(), 1);

    Judgement met("b", kTwo);
    met.record("cost", 1);
    EXPECT_EQ(met.finish(), 0);
}

/// Inputs of hearth_measure_runtime: a small pack, and statistics and images as hearth-render writes them.
struct RuntimeInputs
{
    std::vector<bool> converged{false, false, true, true};
    uint32_t pixels_of_each_cluster = 20;
    uint32_t hidden_clusters = 0;
    uint8_t converged_grey = 100;
};

Json makeStatistics(const RuntimeInputs& inputs)
{
    Json statistics = Json::parse(R"({"schema": "hearth.frame/1", "device": "none", "width": 8, "height": 8,
        "error_pixels": 1, "shaded_area_pixels": 64, "target_bytes": 1, "source_triangles": 1, "scene_bytes": 1,
        "milliseconds": {"cull": 0, "pyramid": 0, "late_cull": 0, "early_visibility": 0, "visibility": 0,
                         "material_tiles": 0, "shading": 0, "frame": 0},
        "streaming": {"budget_bytes": 1, "bytes_streamed": 1, "bytes_resident": 1, "pages_resident": 1,
                      "bytes_in_use": 1, "error_scale": 1}})")
                          .value();
    Json frames = Json::array();
    for (const bool converged : inputs.converged)
    {
        Json frame = Json::object();
        frame["converged"] = converged;
        frames.push_back(frame);
    }
    statistics["streaming"]["frames"] = frames;
    return statistics;
}

/// Bytes of a dump of visible clusters in which four clusters of the pack are seen.
std::string makeDump(const RuntimeInputs& inputs)
{
    std::vector<uint32_t> words;
    const uint32_t seen = 4, slots = seen + inputs.hidden_clusters;
    words.insert(words.end(), {formats::fourCC("HVIS"), inputs.pixels_of_each_cluster, seen, slots});
    for (uint32_t slot = 0; slot < slots; ++slot)
        words.insert(words.end(), {0, slot % seen}); // instance, cluster
    for (uint32_t slot = 0; slot < seen; ++slot)
        words.insert(words.end(), inputs.pixels_of_each_cluster, slot << 7);
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(uint32_t)};
}

ProgramEnd measureRuntime(const RuntimeInputs& inputs)
{
    Sandbox folder;
    const auto bytes = smallPack().bytes();
    folder.write("a.hearth", {reinterpret_cast<const char*>(bytes.span().data()), bytes.size()});
    folder.write("stats.json", makeStatistics(inputs).dump());
    folder.write("a.hvis", makeDump(inputs));
    for (const auto& [name, grey] :
         {std::pair{"resident.png", uint8_t{100}}, std::pair{"last.png", inputs.converged_grey}})
    {
        reference::Image image(8, 8);
        std::fill(image.rgb.begin(), image.rgb.end(), grey);
        EXPECT_TRUE(reference::writePng(folder / name, image).ok());
    }
    return folder.run({HEARTH_BIN "/hearth_measure_runtime", "a.hearth", "--path", "stats.json",
                       "--visibility", "a.hvis", "--cold", "stats.json", "--resident", "resident.png",
                       "--converged", "last.png"});
}

TEST(MeasureRuntime, failsWithTheNameOfEachAimThatItMisses)
{
    const ProgramEnd good = measureRuntime({});
    EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
    EXPECT_EQ(countOccurrences(good.out, ", met\n"), 4u) << good.out;
    EXPECT_NE(good.out.find("frame of convergence from a cold start <= 40: 3, met\n"), std::string::npos);

    const auto expectMissed = [](const RuntimeInputs& inputs, const char* line)
    {
        const ProgramEnd end = measureRuntime(inputs);
        EXPECT_EQ(end.exit_code, 1) << end.out << end.err;
        EXPECT_EQ(countOccurrences(end.out, "MISSED"), 1u) << end.out;
        EXPECT_NE(end.out.find(line), std::string::npos) << end.out;
    };
    expectMissed({.converged = {false, true, true, false}}, "cold start <= 40: inf, MISSED\n");
    expectMissed({.converged = {}}, "cold start <= 40: inf, MISSED\n");
    expectMissed({.pixels_of_each_cluster = 1}, "triangles a covered pixel <= 1.35: 2, MISSED\n");
    expectMissed({.hidden_clusters = 4}, "clusters drawn / seen <= 1.6: 2, MISSED\n");
    expectMissed({.converged_grey = 200}, "mean FLIP within the budget <= 0.01: ");
}

} // namespace

} // namespace hearth::test
